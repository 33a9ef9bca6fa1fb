/* Many members of one type, each taken through given inputs.

The same as the numpy version beside it (kernel.py), which does the work where no compiler was at hand and says what
all this means. Plain C, without Python's API: arrays go in and out, nothing is kept, so that several threads may each
take some of the members. Theory: docs/theory/members.md. */

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#define EXPORTED __declspec(dllexport)
#else
#define EXPORTED __attribute__((visibility("default")))
#endif

enum { CLOSED = 0, TURNS_BACK = 1, OPEN = 2 };
enum { CORRECTIONS = 8, MOST_STEPS = 400 };

/* The loops of a type, one after the other: begin[loops + 1] says where their passages begin, of which each has its
   joint, sign, and whether that slides. column[joints]: the place among the unknowns, or -1 - that of an input.
   curved[loops]: 1 where axes meet in a point, 0 in a plane. */
typedef struct {
    int64_t loops, joints, unknowns, inputs;
    const int64_t *begin, *joint, *slides, *column, *curved;
    const double *sign;
    double closed, stray, least;
} Type;

/* A member: the axis of each passage, and the quaternion of each loop that its joints are to undo; the cosines and
   sines of half the angles of its joints. */
typedef struct {
    double *axis, *undone, *cosine, *sine;
} Member;

/* Where a member is: unknowns, their rates by the way, how far the way has led, and the sign of the determinant. */
typedef struct {
    double *unknowns, *rates, way;
    int sign;
} Place;

typedef struct {
    double *residual, *jacobian, *factor, *by_inputs, *expected, *tried, *inputs, *start, *onwards, *last;
    int64_t *pivot;
    int sign;
} Work;

static void halved(const Member *m, int64_t joint, double value, int64_t slides)
{
    m->cosine[joint] = slides ? 1.0 : cos(0.5 * value), m->sine[joint] = slides ? 0.5 * value : sin(0.5 * value);
}

/* By how much one loop does not close, and the derivatives by its joints: the axes where those before have taken
   them. In a plane x and y are measured in a very large radius: products of two of them vanish. */
static inline double loop_at(const Type *t, const Member *m, int64_t l, double *residual, double *columns,
                             double *inputs, const double curved)
{
    int64_t n = t->unknowns, many = t->inputs;
    const double *start = m->undone + 4 * l;
    double w = start[0], x = start[1], y = start[2], z = start[3];
    for (int64_t i = t->begin[l]; i < t->begin[l + 1]; i++) {
        int64_t joint = t->joint[i], place = t->column[joint];
        double sign = t->sign[i], a = m->axis[3 * i], b = m->axis[3 * i + 1], c = m->axis[3 * i + 2];
        if (columns) {
            double u = y * c - z * b, v = z * a - x * c, r = curved * (x * b - y * a);
            double *to = place >= 0 ? columns + place : inputs + (-1 - place);
            int64_t row = place >= 0 ? n : many;
            to[0] += sign * (a + 2.0 * (w * u + y * r - z * v));
            to[row] += sign * (b + 2.0 * (w * v + z * u - x * r));
            to[2 * row] += sign * (c + 2.0 * (w * r + curved * (x * v - y * u)));
        }
        double p = m->cosine[joint], s = sign * m->sine[joint], q = s * a, r = s * b, k = s * c;
        double W = w * p - curved * (x * q + y * r) - z * k, X = w * q + x * p + y * k - z * r;
        double Y = w * r - x * k + y * p + z * q;
        z = w * k + curved * (x * r - y * q) + z * p, w = W, x = X, y = Y;
    }
    double twice = w < 0.0 ? -2.0 : 2.0, most = 0.0;
    residual[0] = twice * x, residual[1] = twice * y, residual[2] = twice * z;
    for (int i = 0; i < 3; i++)
        if (!(fabs(residual[i]) <= most)) most = fabs(residual[i]);
    return most;
}

/* All loops; derivatives, by unknowns and by inputs, only if asked for. */
static double evaluated(const Type *t, const Member *m, Work *w, int derivatives)
{
    double most = 0.0;
    int64_t n = t->unknowns;
    if (derivatives) {
        memset(w->jacobian, 0, n * n * sizeof *w->jacobian);
        memset(w->by_inputs, 0, n * (t->inputs + 1) * sizeof *w->by_inputs);
    }
    for (int64_t l = 0; l < t->loops; l++) {
        double *columns = derivatives ? w->jacobian + 3 * l * n : NULL, *inputs = w->by_inputs + 3 * l * t->inputs;
        double off = t->curved[l] ? loop_at(t, m, l, w->residual + 3 * l, columns, inputs, 1.0)
                                  : loop_at(t, m, l, w->residual + 3 * l, columns, inputs, 0.0);
        if (!(off <= most)) most = off;
    }
    return most;
}

/* Take the derivatives apart, pivots chosen by column: 0 if they are singular. */
static int factorised(const Type *t, Work *w)
{
    int64_t n = t->unknowns;
    double *f = w->factor;
    memcpy(f, w->jacobian, n * n * sizeof *f);
    w->sign = 1;
    for (int64_t k = 0; k < n; k++) {
        int64_t best = k;
        for (int64_t i = k + 1; i < n; i++)
            if (fabs(f[i * n + k]) > fabs(f[best * n + k])) best = i;
        w->pivot[k] = best;
        if (!(fabs(f[best * n + k]) > 0.0) || !isfinite(f[best * n + k])) return 0;
        if (best != k) {
            w->sign = -w->sign;
            for (int64_t j = 0; j < n; j++) {
                double kept = f[k * n + j];
                f[k * n + j] = f[best * n + j], f[best * n + j] = kept;
            }
        }
        if (f[k * n + k] < 0.0) w->sign = -w->sign;
        double inverse = 1.0 / f[k * n + k];
        for (int64_t i = k + 1; i < n; i++) {
            double part = f[i * n + k] *= inverse;
            for (int64_t j = k + 1; j < n; j++) f[i * n + j] -= part * f[k * n + j];
        }
    }
    return 1;
}

static void solved(const Type *t, const Work *w, double *right)
{
    int64_t n = t->unknowns;
    const double *f = w->factor;
    for (int64_t k = 0; k < n; k++) {
        double kept = right[w->pivot[k]];
        right[w->pivot[k]] = right[k], right[k] = kept;
    }
    for (int64_t k = 0; k < n; k++)
        for (int64_t i = k + 1; i < n; i++) right[i] -= f[i * n + k] * right[k];
    for (int64_t k = n - 1; k >= 0; k--) {
        for (int64_t j = k + 1; j < n; j++) right[k] -= f[k * n + j] * right[j];
        right[k] /= f[k * n + k];
    }
}

static void set_unknowns(const Type *t, const Member *m, const double *unknowns)
{
    for (int64_t j = 0; j < t->joints; j++)
        if (t->column[j] >= 0) halved(m, j, unknowns[t->column[j]], t->slides[j]);
}

static void set_inputs(const Type *t, const Member *m, const double *inputs)
{
    for (int64_t j = 0; j < t->joints; j++)
        if (t->column[j] < 0) halved(m, j, inputs[-1 - t->column[j]], t->slides[j]);
}

/* Newton's method at given inputs from `tried`, in place, until loops close to a hundredth of what counts as closed or
   get no better; derivatives are taken anew while much is left. Returns the error. */
static double corrected(const Type *t, const Member *m, Work *w)
{
    int64_t n = t->unknowns;
    double error = evaluated(t, m, w, 1);
    if (!factorised(t, w)) return INFINITY;
    for (int step = 0; step < CORRECTIONS && !(error <= t->closed / 100.0); step++) {
        solved(t, w, w->residual);
        for (int64_t i = 0; i < n; i++) w->tried[i] -= w->residual[i];
        set_unknowns(t, m, w->tried);
        int far = error > 1e-4;
        double next = evaluated(t, m, w, far);
        if (!(next < error)) return next <= t->closed ? next : error <= t->closed ? next : INFINITY;
        error = next;
        if (far && !factorised(t, w)) return INFINITY;
    }
    return error;
}

static double largest_between(int64_t n, const double *a, const double *b)
{
    double most = 0.0;
    for (int64_t i = 0; i < n; i++)
        if (!(fabs(a[i] - b[i]) <= most)) most = fabs(a[i] - b[i]);
    return most;
}

/* Where the unknowns are expected after a length: by the cubic through two places and their rates, or the tangent. */
static void expected(const Type *t, const Place *before, const Place *here, double length, double *to)
{
    double back = here->way - before->way, s = 1.0 + length / back;
    int64_t n = t->unknowns;
    if (back > 0.0 && length <= 2.0 * back) {
        double square = s * s, cube = square * s, a = 2.0 * cube - 3.0 * square + 1.0;
        double b = (cube - 2.0 * square + s) * back, c = 3.0 * square - 2.0 * cube, d = (cube - square) * back;
        for (int64_t i = 0; i < n; i++)
            to[i] = a * before->unknowns[i] + b * before->rates[i] + c * here->unknowns[i] + d * here->rates[i];
    } else {
        for (int64_t i = 0; i < n; i++) to[i] = here->unknowns[i] + length * here->rates[i];
    }
}

/* The rates of unknowns while inputs go on, by the derivatives that were factorised last. */
static void find_rates(const Type *t, const Work *w, double *rates)
{
    for (int64_t i = 0; i < t->unknowns; i++) {
        rates[i] = 0.0;
        for (int64_t k = 0; k < t->inputs; k++) rates[i] -= w->by_inputs[i * t->inputs + k] * w->onwards[k];
    }
    solved(t, w, rates);
}

static void exchanged(Place *one, Place *other)
{
    Place kept = *one;
    *one = *other, *other = kept;
}

/* Go from `here` to inputs w->inputs, from those in w->start: 1 and the error if they are reached, else 0. Steps are
   halved where the corrected place is far from the expected one, or on another branch: there the determinant of the
   derivatives has another sign, or Newton's method has gone astray. */
static int went(const Type *t, const Member *m, Place *here, Place *before, Place *next, Work *w, double *error)
{
    int64_t n = t->unknowns;
    double whole = largest_between(t->inputs, w->start, w->inputs), done = 0.0, length = whole;
    for (int64_t k = 0; k < t->inputs; k++) w->onwards[k] = whole ? (w->inputs[k] - w->start[k]) / whole : 0.0;
    for (int step = 0; step < MOST_STEPS; step++) {
        int lands = length >= whole - done;
        if (lands) length = whole - done;
        for (int64_t j = 0; j < t->joints; j++) {
            int64_t k = -1 - t->column[j];
            if (k < 0) continue;
            double value = lands ? w->inputs[k] : w->start[k] + (done + length) * w->onwards[k];
            halved(m, j, value, t->slides[j]);
        }
        expected(t, before, here, length, w->expected);
        memcpy(w->tried, w->expected, n * sizeof *w->tried);
        set_unknowns(t, m, w->tried);
        *error = corrected(t, m, w);
        double chord = largest_between(n, w->tried, here->unknowns);
        if (chord < length) chord = length;
        if (*error <= t->closed && w->sign == here->sign &&
            largest_between(n, w->tried, w->expected) <= t->stray * chord) {
            memcpy(next->unknowns, w->tried, n * sizeof *w->tried);
            find_rates(t, w, next->rates);
            next->sign = w->sign, next->way = here->way + length;
            exchanged(before, here), exchanged(here, next);
            done += length;
            if (lands) return 1;
            length *= 2.0;
        } else {
            length *= 0.5;
            if (length < t->least) return 0;
        }
    }
    return 0;
}

/* The axes of passages after links have been bent: in each loop, each link turns what comes after it about its normal. */
static void bent(const Type *t, const double *axes, const double *normals, const double *bends, double part,
                 Member *m)
{
    for (int64_t l = 0; l < t->loops; l++) {
        double w = 1.0, x = 0.0, y = 0.0, z = 0.0;
        for (int64_t i = t->begin[l]; i < t->begin[l + 1]; i++) {
            double a = axes[3 * i], b = axes[3 * i + 1], c = axes[3 * i + 2];
            double u = y * c - z * b, v = z * a - x * c, r = x * b - y * a;
            m->axis[3 * i] = a + 2.0 * (w * u + y * r - z * v);
            m->axis[3 * i + 1] = b + 2.0 * (w * v + z * u - x * r);
            m->axis[3 * i + 2] = c + 2.0 * (w * r + x * v - y * u);
            double p = cos(0.5 * part * bends[i]), s = sin(0.5 * part * bends[i]);
            double q = s * normals[3 * i], f = s * normals[3 * i + 1], k = s * normals[3 * i + 2];
            double W = w * p - x * q - y * f - z * k, X = w * q + x * p + y * k - z * f;
            double Y = w * f - x * k + y * p + z * q;
            z = w * k + x * f - y * q + z * p, w = W, x = X, y = Y;
        }
        double *undone = m->undone + 4 * l;
        undone[0] = w, undone[1] = x, undone[2] = y, undone[3] = z;
    }
}

/* Bend the links of the mechanism to those of a member while inputs stay: 1, or 0 if loops do not stay closed. The
   first step of Newton's method is along the tangent, and the others may not lead far from it. */
static int became(const Type *t, Member *m, const double *axes, const double *normals, const double *bends,
                  int64_t passages, Place *here, Work *w)
{
    int64_t n = t->unknowns;
    double done = 0.0, length = 1.0, most = 0.0;
    for (int64_t i = 0; i < passages; i++)
        if (fabs(bends[i]) > most) most = fabs(bends[i]);
    for (int step = 0; step < MOST_STEPS; step++) {
        int lands = length >= 1.0 - done;
        if (lands) length = 1.0 - done;
        bent(t, axes, normals, bends, done + length, m);
        set_unknowns(t, m, here->unknowns);
        evaluated(t, m, w, 1);
        if (factorised(t, w)) {
            solved(t, w, w->residual);
            for (int64_t i = 0; i < n; i++) w->tried[i] = w->expected[i] = here->unknowns[i] - w->residual[i];
            set_unknowns(t, m, w->tried);
            double error = corrected(t, m, w), chord = largest_between(n, w->tried, here->unknowns);
            if (chord < t->least) chord = t->least;
            if (error <= t->closed && w->sign == here->sign &&
                largest_between(n, w->tried, w->expected) <= t->stray * chord) {
                memcpy(here->unknowns, w->tried, n * sizeof *w->tried);
                done += length;
                if (lands) return 1;
                length *= 2.0;
                continue;
            }
        }
        length *= 0.5;
        if (length * most < t->least) return 0;
    }
    return 0;
}

/* Derivatives at a place, and their sign: 0 if they are singular, or loops do not close there. */
static int placed(const Type *t, const Member *m, Place *here, Work *w)
{
    set_unknowns(t, m, here->unknowns);
    if (!(evaluated(t, m, w, 1) <= t->closed) || !factorised(t, w)) return 0;
    here->sign = w->sign;
    return 1;
}

typedef struct {
    int64_t many, rows, out;         /* members, rows of inputs, joints whose angles are written */
    const int64_t *columns;          /* of each of these its place among the unknowns, or -1 - that of an input */
    const double *axes, *normals, *bends, *start, *inputs;
    int64_t own_axes, own_start, own_inputs; /* whether each member has its own, or all share one */
    double *angles, *residual;
    int8_t *status;
} Sweep;

/* Take one member through its inputs. */
static void swept(const Type *t, const Sweep *s, int64_t number, Member *m, Place places[3], Work *w)
{
    int64_t n = t->unknowns, many = t->inputs, passages = t->begin[t->loops];
    Place *here = places, *before = places + 1, *next = places + 2;
    const double *axes = s->axes + (s->own_axes ? number * passages * 3 : 0);
    const double *start = s->start + (s->own_start ? number * (n + many) : 0);
    const double *rows = s->inputs + (s->own_inputs ? number * s->rows * many : 0);
    double low = -INFINITY, high = INFINITY;
    memcpy(here->unknowns, start, n * sizeof *start), memcpy(w->start, start + n, many * sizeof *start);
    memcpy(m->axis, axes, 3 * passages * sizeof *axes);
    for (int64_t l = 0; l < t->loops; l++) {
        double *undone = m->undone + 4 * l;
        undone[0] = 1.0, undone[1] = undone[2] = undone[3] = 0.0;
    }
    set_inputs(t, m, w->start);
    int good = placed(t, m, here, w), known = 0;
    if (good && s->bends) good = became(t, m, axes, s->normals, s->bends + number * passages, passages, here, w);
    for (int64_t f = 0; f < s->rows; f++) {
        double *angles = s->angles + (number * s->rows + f) * s->out, *residual = s->residual + number * s->rows + f;
        int8_t *status = s->status + number * s->rows + f;
        const double *row = rows + f * many;
        int beyond = many == 1 && (row[0] >= high || row[0] <= low), reached = 0;
        double whole = largest_between(many, w->start, row);
        if (good && whole == 0.0) {
            set_inputs(t, m, w->start), set_unknowns(t, m, here->unknowns);
            *residual = evaluated(t, m, w, 0), reached = 1;
        } else if (good && !beyond) {
            if (!known || many != 1) { /* rates along this way */
                set_inputs(t, m, w->start);
                good = placed(t, m, here, w), known = 1;
                for (int64_t k = 0; k < many; k++) w->onwards[k] = (row[k] - w->start[k]) / whole;
                if (good) find_rates(t, w, here->rates);
                here->way = before->way = 0.0;
            } else if ((row[0] > w->start[0]) != (w->onwards[0] > 0.0)) { /* back along the same way */
                for (int64_t i = 0; i < n; i++) here->rates[i] = -here->rates[i];
                before->way = here->way;
            }
            memcpy(w->inputs, row, many * sizeof *row);
            memcpy(w->last, here->unknowns, n * sizeof *w->last);
            memcpy(w->last + n, here->rates, n * sizeof *w->last);
            int sign = here->sign;
            reached = good && went(t, m, here, before, next, w, residual);
            if (reached) {
                memcpy(w->start, row, many * sizeof *row);
            } else if (good) { /* back to where it came from */
                memcpy(here->unknowns, w->last, n * sizeof *w->last);
                memcpy(here->rates, w->last + n, n * sizeof *w->last);
                here->way = before->way = 0.0, here->sign = sign;
                if (many == 1 && row[0] > w->start[0]) high = row[0];
                if (many == 1 && row[0] < w->start[0]) low = row[0];
            }
        }
        *status = !good ? OPEN : reached ? CLOSED : TURNS_BACK;
        if (!reached) *residual = NAN;
        for (int64_t k = 0; k < s->out; k++) {
            int64_t place = s->columns[k];
            angles[k] = !reached ? NAN : place >= 0 ? here->unknowns[place] : row[-1 - place];
        }
    }
}

/* Take members first to last - 1 of a sweep through their inputs; 0 without memory. sizes: loops, joints, unknowns,
   inputs, rows, joints written, whether axes, starts and inputs are each member's own. numbers: what is closed, part of
   a step by which it may go astray, least step. Bends, and with them normals, may be NULL. */
EXPORTED int members_swept(const int64_t *sizes, const double *numbers, const int64_t *begin, const int64_t *joint,
                           const double *sign, const int64_t *slides, const int64_t *column, const int64_t *curved,
                           const int64_t *columns, const double *axes, const double *normals, const double *bends,
                           const double *start, const double *inputs, int64_t first, int64_t last, double *angles,
                           double *residual, int8_t *status)
{
    Type t = {sizes[0], sizes[1], sizes[2], sizes[3], begin,      joint,      slides,
              column,   curved,   sign,     numbers[0], numbers[1], numbers[2]};
    Sweep s = {last,   sizes[4], sizes[5], columns,  axes,   normals,  bends, start,
               inputs, sizes[6], sizes[7], sizes[8], angles, residual, status};
    int64_t n = t.unknowns, passages = begin[t.loops];
    size_t room = 3 * passages + 4 * t.loops + 2 * t.joints + 2 * n * n + n * (t.inputs + 1) + 11 * n + 3 * t.inputs + 8;
    double *all = calloc(room, sizeof *all);
    int64_t *pivot = calloc(n + 1, sizeof *pivot);
    if (!all || !pivot) {
        free(all), free(pivot);
        return 0;
    }
    double *at = all;
    Member m = {at, at + 3 * passages, at + 3 * passages + 4 * t.loops, at + 3 * passages + 4 * t.loops + t.joints};
    Place places[3];
    Work w;
    at += 3 * passages + 4 * t.loops + 2 * t.joints;
    for (int k = 0; k < 3; k++) {
        Place place = {at, at + n, 0.0, 0};
        places[k] = place, at += 2 * n;
    }
    w.jacobian = at, at += n * n, w.factor = at, at += n * n, w.by_inputs = at, at += n * (t.inputs + 1);
    w.residual = at, at += n, w.expected = at, at += n, w.tried = at, at += n, w.last = at, at += 2 * n;
    w.inputs = at, at += t.inputs, w.start = at, at += t.inputs, w.onwards = at;
    w.pivot = pivot, w.sign = 0;
    for (int64_t number = first; number < last; number++) swept(&t, &s, number, &m, places, &w);
    free(all), free(pivot);
    return 1;
}
