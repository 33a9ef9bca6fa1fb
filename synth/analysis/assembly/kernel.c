/* Closure equations with complex unknowns, and solutions followed along parameters.

The same as the Python file beside it (kernel.py), which is compiled by numba where no compiler of C was at hand. Plain
C, without Python's API: arrays go in and out, and nothing is kept. Theory: docs/theory/positions.md. */

#include <complex.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#define EXPORTED __declspec(dllexport)
#else
#define EXPORTED __attribute__((visibility("default")))
#endif

typedef double complex number;
enum { DIRECTION = 0, POINT = 1, SLIDE = 2 };        /* how two parameters give an axis */
enum { STOPPED = 0, ARRIVED = 1, FAR = 2 };              /* what became of a path */

static const double FIRST = 0.05, LARGEST = 0.25, LEAST = 1e-12, NUDGE = 1e-6, VERY_FAR = 30.0, FAR_ALONG = 1e4;
enum { CORRECTIONS = 3, MOST = 5000 };

/* The loops of a type as kernel.py has them, int[loops, longest], filled up with -1; signs likewise; of each axis its
   joint and how it is given; the place of each joint among the unknowns, or -1 - that among the driven. On a line of
   members, base + s direction, s is one more unknown, and one more equation says where a hyperplane meets the curve of
   their solutions; else base is NULL. */
typedef struct {
    int64_t loops, longest, axes, joints, members;
    const int64_t *loop, *kind, *column;
    const double *sign;
    const number *base, *direction;
    int64_t unknowns, parameters;
} Type;

typedef struct {
    number *axis, *quaternion, *residual, *jacobian, *rates, *tried, *given, *member, *inner, *all;
} Work;

static int work_new(const Type *t, Work *w)
{
    int64_t n = t->unknowns, a = t->axes;
    w->all = malloc((7 * a + 8 * n + 2 * n * n + t->parameters + t->members + 1) * sizeof *w->all);
    if (!w->all) return 0;
    w->axis = w->all, w->quaternion = w->axis + 3 * a, w->residual = w->quaternion + 4 * a;
    w->rates = w->residual + n, w->tried = w->rates + 4 * n, w->jacobian = w->tried + 2 * n;
    w->given = w->jacobian + n * n, w->member = w->given + t->parameters, w->inner = w->member + t->members;
    return 1;
}

static inline number made_of(double real, double imaginary)
{
    union {
        double parts[2];
        number whole;
    } both = {{real, imaginary}};
    return both.whole;
}

/* Sine and cosine at once: of real numbers they are real. */
static void sine_cosine(number z, number *sine, number *cosine)
{
    double x = creal(z), y = cimag(z), s = sin(x), c = cos(x);
    if (y == 0.0) {
        *sine = s, *cosine = c;
        return;
    }
    double sh = sinh(y), ch = cosh(y);
    *sine = made_of(s * ch, c * sh), *cosine = made_of(c * ch, -s * sh);
}

static inline number times(number a, number b) /* without a look at what is infinite */
{
    return made_of(creal(a) * creal(b) - cimag(a) * cimag(b), creal(a) * cimag(b) + cimag(a) * creal(b));
}

static inline int finite_number(number a) { return isfinite(creal(a)) && isfinite(cimag(a)); }

static inline double size_of(number a) { return hypot(creal(a), cimag(a)); }

/* All axes, and the quaternions of the joints' rotations about them. */
static void placed_axes(const Type *t, const number *given, const number *unknowns, Work *w)
{
    for (int64_t i = 0; i < t->axes; i++) {
        int64_t place = t->column[t->kind[2 * i]];
        number value = place >= 0 ? unknowns[place] : given[2 * t->axes - 1 - place];
        number first = given[2 * i], second = given[2 * i + 1], sine, s, c;
        number *axis = w->axis + 3 * i, *q = w->quaternion + 4 * i;
        sine_cosine(0.5 * value, &sine, q);
        if (t->kind[2 * i + 1] == DIRECTION) {
            number tilt;
            sine_cosine(first, &tilt, axis + 2);
            sine_cosine(second, &s, &c);
            axis[0] = times(tilt, c), axis[1] = times(tilt, s);
        } else if (t->kind[2 * i + 1] == POINT) {
            axis[0] = first, axis[1] = second, axis[2] = 1.0;
        } else { /* a slide is a rotation by a small angle about an axis that is far away */
            sine_cosine(first, &s, &c);
            axis[0] = -s, axis[1] = c, axis[2] = 0.0;
            sine = 0.5 * value, q[0] = 1.0;
        }
        for (int k = 0; k < 3; k++) q[k + 1] = times(sine, axis[k]);
    }
}

/* The closure residual, [3 loops], and its derivatives by the unknowns, [3 loops, joints], unless these are NULL. */
static void loops_evaluated(const Type *t, const number *given, const number *unknowns, number *residual,
                            number *jacobian, Work *w)
{
    int64_t n = t->joints;
    const number *cuts = given + t->members - 4 * t->loops; /* the quaternion that each loop has to close to */
    placed_axes(t, given, unknowns, w);
    if (jacobian) memset(jacobian, 0, 3 * t->loops * n * sizeof *jacobian);
    for (int64_t l = 0; l < t->loops; l++) {
        const int64_t *loop = t->loop + l * t->longest;
        const double *signs = t->sign + l * t->longest;
        /* in a plane x and y are measured in a very large radius: products of two of them vanish */
        double curved = t->kind[2 * loop[0] + 1] == DIRECTION ? 1.0 : 0.0;
        number W = 1.0, x = 0.0, y = 0.0, z = 0.0, *row = jacobian ? jacobian + 3 * l * n : NULL;
        for (int64_t i = 0; i < t->longest && loop[i] >= 0; i++) {
            int64_t j = loop[i], place = t->column[t->kind[2 * j]];
            double sign = signs[i];
            const number *axis = w->axis + 3 * j, *other = w->quaternion + 4 * j;
            if (row && place >= 0) { /* the axis where the joints before it have taken it */
                number a = axis[0], b = axis[1], c = axis[2];
                number u = times(y, c) - times(z, b), v = times(z, a) - times(x, c);
                number r = curved * (times(x, b) - times(y, a));
                row[place] = 0.5 * sign * (a + 2.0 * (times(W, u) + times(y, r) - times(z, v)));
                row[n + place] = 0.5 * sign * (b + 2.0 * (times(W, v) + times(z, u) - times(x, r)));
                row[2 * n + place] = 0.5 * sign * (c + 2.0 * (times(W, r) + curved * (times(x, v) - times(y, u))));
            }
            number p = other[0], q = sign * other[1], r = sign * other[2], s = sign * other[3];
            number next = times(W, p) - curved * (times(x, q) + times(y, r)) - times(z, s);
            number X = times(W, q) + times(x, p) + times(y, s) - times(z, r);
            number Y = times(W, r) - times(x, s) + times(y, p) + times(z, q);
            z = times(W, s) + curved * (times(x, r) - times(y, q)) + times(z, p);
            W = next, x = X, y = Y;
        }
        number p = cuts[4 * l], q = -cuts[4 * l + 1], r = -cuts[4 * l + 2], v = -cuts[4 * l + 3];
        number next = times(W, p) - curved * (times(x, q) + times(y, r)) - times(z, v);
        number X = times(W, q) + times(x, p) + times(y, v) - times(z, r);
        number Y = times(W, r) - times(x, v) + times(y, p) + times(z, q);
        z = times(W, v) + curved * (times(x, r) - times(y, q)) + times(z, p);
        W = next, x = X, y = Y;
        residual[3 * l] = x, residual[3 * l + 1] = y, residual[3 * l + 2] = z;
        for (int64_t i = 0; row && i < t->longest && loop[i] >= 0; i++) {
            int64_t place = t->column[t->kind[2 * loop[i]]];
            if (place < 0) continue;
            number a = row[place], b = row[n + place], c = row[2 * n + place];
            row[place] = times(W, a) + times(b, z) - times(c, y);
            row[n + place] = times(W, b) + times(c, x) - times(a, z);
            row[2 * n + place] = times(W, c) + curved * (times(a, y) - times(b, x));
        }
    }
}

/* The same on a line of members. The unknowns are those of a member and s, the parameters weights[unknowns] and c: the
   last equation is sum of weights times tangents of half angles (of slides lengths) and s = c. Closure is linear in the
   quaternions to close to, in which alone members of the line differ: its derivative by s is that at the direction. */
static void slice_evaluated(const Type *t, const number *given, const number *unknowns, number *residual,
                            number *jacobian, Work *w)
{
    int64_t n = t->unknowns, joints = t->joints;
    number s = unknowns[joints], sum = times(given[joints], s) - given[n], *inner = jacobian ? w->inner : NULL;
    for (int64_t i = 0; i < t->members; i++) w->member[i] = t->base[i] + times(s, t->direction[i]);
    loops_evaluated(t, w->member, unknowns, residual, inner, w);
    for (int64_t i = 0; jacobian && i < joints; i++)
        memcpy(jacobian + i * n, inner + i * joints, joints * sizeof *jacobian);
    for (int64_t a = 0; a < t->axes; a++) { /* joints of several axes are taken once, by their last */
        int64_t place = t->column[t->kind[2 * a]];
        if (place < 0) continue;
        w->inner[place] = t->kind[2 * a + 1] == SLIDE ? 1.0 : 0.0;
    }
    for (int64_t i = 0; i < joints; i++) {
        number value = unknowns[i], slope = 1.0;
        if (w->inner[i] == 0.0) {
            number sine, cosine;
            sine_cosine(0.5 * value, &sine, &cosine);
            value = sine / cosine, slope = 0.5 + 0.5 * times(value, value);
        }
        sum += times(given[i], value);
        if (jacobian) jacobian[joints * n + i] = times(given[i], slope);
    }
    residual[joints] = sum;
    if (!jacobian) return;
    jacobian[joints * n + joints] = given[joints];
    for (int64_t i = 0; i < t->members; i++) w->member[i] = t->direction[i];
    for (int64_t i = 0; i < t->members - 4 * t->loops; i++) w->member[i] = t->base[i];
    loops_evaluated(t, w->member, unknowns, w->inner, NULL, w);
    for (int64_t i = 0; i < joints; i++) jacobian[i * n + joints] = w->inner[i];
}

static void evaluated(const Type *t, const number *given, const number *unknowns, number *residual, number *jacobian,
                      Work *w)
{
    if (t->base)
        slice_evaluated(t, given, unknowns, residual, jacobian, w);
    else
        loops_evaluated(t, given, unknowns, residual, jacobian, w);
}

/* Solve a square system, pivots chosen by column; the solution takes the place of the right side. */
static int solved(int64_t n, number *matrix, number *right)
{
    for (int64_t k = 0; k < n; k++) {
        int64_t best = k;
        double size = 0.0;
        for (int64_t i = k; i < n; i++) {
            double other = size_of(matrix[i * n + k]);
            if (other > size) best = i, size = other;
        }
        if (size == 0.0 || !isfinite(size)) return 0;
        if (best != k) {
            for (int64_t j = k; j < n; j++) {
                number kept = matrix[k * n + j];
                matrix[k * n + j] = matrix[best * n + j], matrix[best * n + j] = kept;
            }
            number kept = right[k];
            right[k] = right[best], right[best] = kept;
        }
        number inverse = conj(matrix[k * n + k]) / (size * size);
        for (int64_t i = k + 1; i < n; i++) {
            number part = times(matrix[i * n + k], inverse);
            for (int64_t j = k + 1; j < n; j++) matrix[i * n + j] -= times(part, matrix[k * n + j]);
            right[i] -= times(part, right[k]);
        }
        matrix[k * n + k] = inverse;
    }
    for (int64_t k = n - 1; k >= 0; k--) {
        for (int64_t j = k + 1; j < n; j++) right[k] -= times(matrix[k * n + j], right[j]);
        right[k] = times(right[k], matrix[k * n + k]);
    }
    return 1;
}

/* Correct unknowns in place; give the length of the first step, return the closure residual. */
static double corrected(const Type *t, const number *given, number *unknowns, int steps, double *first, Work *w)
{
    int64_t n = t->unknowns;
    *first = 0.0;
    for (int step = 0; step < steps; step++) {
        evaluated(t, given, unknowns, w->residual, w->jacobian, w);
        double length = 0.0;
        int good = solved(n, w->jacobian, w->residual);
        for (int64_t i = 0; good && i < n; i++) {
            double size = size_of(w->residual[i]);
            unknowns[i] -= w->residual[i];
            good = finite_number(w->residual[i]);
            if (size > length) length = size;
        }
        if (step == 0) *first = length;
        if (!good) return *first = INFINITY;
    }
    evaluated(t, given, unknowns, w->residual, NULL, w);
    double error = 0.0;
    for (int64_t i = 0; i < n; i++) {
        double size = size_of(w->residual[i]);
        if (!(size <= error)) error = size;
    }
    return error;
}

/* A curve of members: start, end and bend of the parameters. */
typedef struct {
    const number *start, *end, *bend;
} Curve;

static void parameters_at(const Type *t, const Curve *curve, double s, number *given)
{
    for (int64_t i = 0; i < t->parameters; i++)
        given[i] = curve->start[i] + s * (curve->end[i] - curve->start[i]) + s * (1.0 - s) * curve->bend[i];
}

/* The derivatives of the unknowns along a curve; 0 if these are not determined. */
static int tangent(const Type *t, const Curve *curve, double s, const number *unknowns, number *rates, Work *w)
{
    int64_t n = t->unknowns;
    parameters_at(t, curve, s + NUDGE, w->given);
    evaluated(t, w->given, unknowns, w->residual, NULL, w);
    parameters_at(t, curve, s, w->given);
    evaluated(t, w->given, unknowns, rates, w->jacobian, w);
    for (int64_t i = 0; i < n; i++) rates[i] = (rates[i] - w->residual[i]) / NUDGE;
    return solved(n, w->jacobian, rates);
}

static int gone_far(const Type *t, const number *unknowns)
{
    for (int64_t i = 0; i < t->axes; i++) {
        int64_t place = t->column[t->kind[2 * i]];
        if (place < 0) continue;
        if (t->kind[2 * i + 1] == SLIDE ? size_of(unknowns[place]) > FAR_ALONG
                                        : fabs(cimag(unknowns[place])) > VERY_FAR)
            return 1;
    }
    return 0;
}

/* Follow a solution along a curve, in place: a step is halved where the first correction is not `small`, radians. */
static int followed(const Type *t, const Curve *curve, number *unknowns, double small, double closed, Work *w)
{
    int64_t n = t->unknowns;
    number *tried = w->tried, *rates = w->rates;
    double s = 0.0, step = FIRST;
    for (int round = 0; round < MOST; round++) {
        double length = step < 1.0 - s ? step : 1.0 - s;
        /* predictor: Runge and Kutta's method of fourth order on the tangents */
        int good = tangent(t, curve, s, unknowns, rates, w);
        for (int stage = 1; good && stage < 4; stage++) {
            double part = stage == 3 ? length : 0.5 * length;
            for (int64_t i = 0; i < n; i++) tried[i] = unknowns[i] + part * rates[(stage - 1) * n + i];
            good = tangent(t, curve, s + part, tried, rates + stage * n, w);
        }
        if (good) {
            for (int64_t i = 0; i < n; i++)
                tried[i] = unknowns[i] + length / 6.0 * (rates[i] + 2.0 * rates[n + i] + 2.0 * rates[2 * n + i] +
                                                         rates[3 * n + i]);
            double onwards = length >= 1.0 - s ? 1.0 : s + length, first;
            /* corrector: a first correction that is not small may lead to another path */
            parameters_at(t, curve, onwards, w->given);
            double error = corrected(t, w->given, tried, CORRECTIONS, &first, w);
            if (first <= small && error <= closed) {
                memcpy(unknowns, tried, n * sizeof *tried);
                if (gone_far(t, unknowns)) return FAR;
                if (onwards == 1.0) return ARRIVED;
                s = onwards, step = 1.7 * length < LARGEST ? 1.7 * length : LARGEST;
                continue;
            }
        }
        step = 0.5 * length;
        if (step < LEAST) return STOPPED;
    }
    return STOPPED;
}

/* Sizes are loops, longest, axes, unknown joints, parameters of a member. */
static Type type_of(const int64_t *sizes, const int64_t *loop, const double *sign, const int64_t *kind,
                    const int64_t *column)
{
    Type t = {sizes[0], sizes[1], sizes[2], sizes[3], sizes[4], loop, kind, column, sign, NULL, NULL, sizes[3], sizes[4]};
    return t;
}

/* Follow solutions values[paths, unknowns] along curves, each along its own, in place; ends[paths]: what became of
   them. Curves are arrays [paths, parameters]. With a line of members, base and direction, values are [paths, unknowns
   + 1] and parameters those of hyperplanes; else these are NULL. Returns 0 without memory. */
EXPORTED int all_followed(const int64_t *sizes, const int64_t *loop, const double *sign, const int64_t *kind,
                          const int64_t *column, int64_t paths, const number *start, const number *end,
                          const number *bend, number *values, double small, double closed, int64_t *ends,
                          const number *base, const number *direction)
{
    Type t = type_of(sizes, loop, sign, kind, column);
    Work w;
    t.base = base, t.direction = direction;
    if (base) t.unknowns = t.joints + 1, t.parameters = t.joints + 2;
    if (!work_new(&t, &w)) return 0;
    for (int64_t p = 0; p < paths; p++) {
        int64_t at = p * t.parameters;
        Curve curve = {start + at, end + at, bend + at};
        ends[p] = followed(&t, &curve, values + p * t.unknowns, small, closed, &w);
    }
    free(w.all);
    return 1;
}

/* Correct solutions of members given[paths, parameters], in place; errors[paths]: their closure residuals. */
EXPORTED int all_corrected(const int64_t *sizes, const int64_t *loop, const double *sign, const int64_t *kind,
                           const int64_t *column, int64_t paths, const number *given, number *values, int64_t steps,
                           double *errors)
{
    Type t = type_of(sizes, loop, sign, kind, column);
    Work w;
    double first;
    if (!work_new(&t, &w)) return 0;
    for (int64_t p = 0; p < paths; p++)
        errors[p] = corrected(&t, given + p * t.parameters, values + p * t.unknowns, (int)steps, &first, &w);
    free(w.all);
    return 1;
}

/* The closure residual of one member, and its derivatives. */
EXPORTED int all_evaluated(const int64_t *sizes, const int64_t *loop, const double *sign, const int64_t *kind,
                           const int64_t *column, const number *given, const number *unknowns, number *residual,
                           number *jacobian)
{
    Type t = type_of(sizes, loop, sign, kind, column);
    Work w;
    if (!work_new(&t, &w)) return 0;
    evaluated(&t, given, unknowns, residual, jacobian, &w);
    free(w.all);
    return 1;
}
