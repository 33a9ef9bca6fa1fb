/* The closure equations of a linkage, their derivatives, and the factor of their normal equations.

The same as the numpy version beside it (closure.py), which does the work where no compiler was at hand. Plain C,
without Python's API: arrays go in and out, nothing is kept but what a handle holds, which never changes after it
was made but for one spare room, so that several threads may use it. All matrices are rows by columns. Theory: docs/theory/folding.md. */

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#define EXPORTED __declspec(dllexport)
#else
#define EXPORTED __attribute__((visibility("default")))
#endif

#include "factor.h"

enum { FINITE = 0, INFINITE = 1, NONE = 2 }; /* the centre of a loop: a point, a direction, or none */

/* The equations: loops one after the other, each with its joints in loop order. A derivative stands in row-by-row
   order, the columns of a row sorted; `column` says where those of each joint of a loop stand in its rows.
   `pattern` is that of the factor of the normal equations, `place` says where the products of two columns of a loop are
   added there. */
typedef struct {
    int64_t joints, loops, rows, derivatives;
    int64_t *begin, *value, *equation;
    int32_t *kind, *joint, *column;
    double *sign, *turning, *axis, *point, *frame;
    Pattern pattern;
    int64_t *place;
    void **spare; /* the room of a factor that is no longer needed, or NULL: the system gives new room page by page */
    int analysed;
} Equations;

static int equations_of(int kind) { return kind == NONE ? 6 : 3; }

EXPORTED void equations_free(Equations *e)
{
    if (!e) return;
    free(e->begin), free(e->value), free(e->equation), free(e->kind), free(e->joint), free(e->column);
    free(e->sign), free(e->turning), free(e->axis), free(e->point), free(e->frame);
    if (e->spare) free(*e->spare);
    pattern_clear(&e->pattern), free(e->place), free(e->spare), free(e);
}

/* Loops of some kinds: begin[loops + 1] says where their joints begin in the lists that follow; frames are nine
   numbers for each loop, read where its axes are parallel. Returns NULL if there is no memory. */
EXPORTED Equations *equations_new(int64_t joints, int64_t loops, const int64_t *begin, const int32_t *kind,
                                  const int32_t *joint, const double *sign, const double *turning,
                                  const double *axis, const double *point, const double *frame)
{
    Equations *e = calloc(1, sizeof *e);
    if (!e) return NULL;
    size_t members = (size_t)begin[loops];
    e->joints = joints, e->loops = loops;
    e->begin = copied(begin, (loops + 1) * sizeof *begin);
    e->kind = copied(kind, loops * sizeof *kind);
    e->joint = copied(joint, members * sizeof *joint);
    e->sign = copied(sign, members * sizeof *sign);
    e->turning = copied(turning, members * sizeof *turning);
    e->axis = copied(axis, 3 * members * sizeof *axis);
    e->point = copied(point, 3 * members * sizeof *point);
    e->frame = copied(frame, 9 * loops * sizeof *frame);
    e->value = malloc((loops + 1) * sizeof *e->value);
    e->equation = malloc((loops + 1) * sizeof *e->equation);
    e->column = malloc((members ? members : 1) * sizeof *e->column);
    e->spare = calloc(1, sizeof *e->spare);
    if (!(e->spare && e->begin && e->kind && e->joint && e->sign && e->turning && e->axis && e->point && e->frame && e->value &&
          e->equation && e->column)) {
        equations_free(e);
        return NULL;
    }
    e->value[0] = e->equation[0] = 0;
    for (int64_t l = 0; l < loops; l++) {
        int64_t from = begin[l], k = begin[l + 1] - from;
        e->equation[l + 1] = e->equation[l] + equations_of(kind[l]);
        e->value[l + 1] = e->value[l] + equations_of(kind[l]) * k;
        for (int64_t i = 0; i < k; i++) {
            int32_t before = 0;
            for (int64_t j = 0; j < k; j++) before += joint[from + j] < joint[from + i];
            e->column[from + i] = before;
        }
    }
    e->rows = e->equation[loops], e->derivatives = e->value[loops];
    return e;
}

EXPORTED int64_t equations_rows(const Equations *e) { return e->rows; }
EXPORTED int64_t equations_entries(const Equations *e) { return e->derivatives; }

static void times3(const double m[9], const double v[3], double out[3])
{
    for (int i = 0; i < 3; i++) out[i] = m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2];
}

static void cross3(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1], out[1] = a[2] * b[0] - a[0] * b[2], out[2] = a[0] * b[1] - a[1] * b[0];
}

/* A rotation about a unit vector after another rotation: turned = turned * exp([axis] angle). Rodrigues. */
static void turn(double turned[9], const double a[3], double angle)
{
    double c = cos(angle), s = sin(angle), v = 1.0 - c, x = a[0], y = a[1], z = a[2];
    double m[9] = {c + x * x * v,     x * y * v - z * s, x * z * v + y * s, x * y * v + z * s, c + y * y * v,
                   y * z * v - x * s, x * z * v - y * s, y * z * v + x * s, c + z * z * v};
    for (int i = 0; i < 3; i++) {
        double p = turned[3 * i], q = turned[3 * i + 1], r = turned[3 * i + 2];
        for (int j = 0; j < 3; j++) turned[3 * i + j] = p * m[j] + q * m[3 + j] + r * m[6 + j];
    }
}

/* Axis times angle of a rotation. */
static void rotation_vector(const double m[9], double out[3])
{
    double w[3] = {0.5 * (m[7] - m[5]), 0.5 * (m[2] - m[6]), 0.5 * (m[3] - m[1])};
    double sine = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    double factor = 1.0; /* to the last digit where the angle is small; where it is pi no axis is known */
    if (sine >= 1e-8) factor = atan2(sine, 0.5 * (m[0] + m[4] + m[8] - 1.0)) / sine;
    for (int i = 0; i < 3; i++) out[i] = factor * w[i];
}

static const double IDENTITY[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

/* How far loops are from closing at joint angles from the pose, residual[rows], and the derivatives[derivatives]:
   of joints whose `freed` is 0 these are 0; NULL frees all. */
EXPORTED void equations_at(const Equations *e, const double *angles, const double *freed, double *residual,
                           double *derivatives)
{
    for (int64_t l = 0; l < e->loops; l++) {
        int64_t from = e->begin[l], k = e->begin[l + 1] - from;
        int kind = e->kind[l], many = equations_of(kind);
        double turned[9], moved[3] = {0, 0, 0}, off[6];
        const double *frame = e->frame + 9 * l;
        double *out = derivatives + e->value[l];
        memcpy(turned, IDENTITY, sizeof turned);
        for (int64_t i = 0; i < k; i++) {
            const double *axis = e->axis + 3 * (from + i), *point = e->point + 3 * (from + i);
            int32_t joint = e->joint[from + i];
            double sign = e->sign[from + i], value = angles[joint] * sign, twist[6];
            int turns = e->turning[from + i] != 0.0;
            times3(turned, axis, twist);
            if (kind != FINITE) {
                double place[3], at[3];
                times3(turned, point, place);
                for (int c = 0; c < 3; c++) at[c] = place[c] + moved[c];
                if (turns) {
                    cross3(at, twist, twist + 3);
                    turn(turned, axis, value);
                    times3(turned, point, place);
                    for (int c = 0; c < 3; c++) moved[c] = at[c] - place[c];
                } else {
                    for (int c = 0; c < 3; c++) {
                        twist[3 + c] = twist[c], twist[c] = 0.0;
                        moved[c] += value * twist[3 + c];
                    }
                }
            } else {
                turn(turned, axis, value);
            }
            if (freed) sign *= freed[joint];
            double *at = out + e->column[from + i];
            if (kind == INFINITE) {
                double w[3], v[3];
                times3(frame, twist, w), times3(frame, twist + 3, v);
                at[0] = sign * w[2], at[k] = sign * v[0], at[2 * k] = sign * v[1];
            } else {
                for (int r = 0; r < many; r++) at[r * k] = sign * twist[r];
            }
        }
        rotation_vector(turned, off);
        double *to = residual + e->equation[l];
        if (kind == INFINITE) {
            double w[3], v[3];
            times3(frame, off, w), times3(frame, moved, v);
            to[0] = w[2], to[1] = v[0], to[2] = v[1];
        } else {
            memcpy(to, off, 3 * sizeof *to);
            if (kind == NONE) memcpy(to + 3, moved, 3 * sizeof *to);
        }
    }
}

/* By what loops part at some rates: image[rows] = J rates. */
EXPORTED void image_of(const Equations *e, const double *derivatives, const double *rates, double *image)
{
    double local[64], *values = local, *more = NULL;
    for (int64_t l = 0; l < e->loops; l++) {
        int64_t from = e->begin[l], k = e->begin[l + 1] - from, rows = e->equation[l + 1] - e->equation[l];
        if (k > 64) values = more = realloc(more, k * sizeof *more);
        for (int64_t i = 0; i < k; i++) values[e->column[from + i]] = rates[e->joint[from + i]];
        const double *row = derivatives + e->value[l];
        for (int64_t r = 0; r < rows; r++, row += k) {
            double sum = 0.0;
            for (int64_t i = 0; i < k; i++) sum += row[i] * values[i];
            image[e->equation[l] + r] = sum;
        }
        values = local;
    }
    free(more);
}

/* A sum of rows: sum[joints] = J' forces. */
EXPORTED void sum_of_rows(const Equations *e, const double *derivatives, const double *forces, double *sum)
{
    memset(sum, 0, e->joints * sizeof *sum);
    for (int64_t l = 0; l < e->loops; l++) {
        int64_t from = e->begin[l], k = e->begin[l + 1] - from, rows = e->equation[l + 1] - e->equation[l];
        const double *block = derivatives + e->value[l], *force = forces + e->equation[l];
        for (int64_t i = 0; i < k; i++) {
            double part = 0.0;
            const double *at = block + e->column[from + i];
            for (int64_t r = 0; r < rows; r++) part += at[r * k] * force[r];
            sum[e->joint[from + i]] += part;
        }
    }
}

/* The joints beside each joint: those of its loops. */
static int neighbours(const Equations *e, int64_t **starts, int32_t **lists)
{
    int64_t n = e->joints, members = e->begin[e->loops], most = 0;
    int64_t *first = calloc(n + 2, sizeof *first), *start = calloc(n + 1, sizeof *start);
    int32_t *loops = malloc((members ? members : 1) * sizeof *loops), *seen = malloc((n + 1) * sizeof *seen);
    for (int64_t l = 0; l < e->loops; l++) {
        int64_t k = e->begin[l + 1] - e->begin[l];
        most += k * (k - 1);
    }
    int32_t *list = malloc((most ? most : 1) * sizeof *list);
    int good = first && start && loops && seen && list;
    if (good) {
        for (int64_t m = 0; m < members; m++) first[e->joint[m] + 2]++;
        for (int64_t i = 0; i < n; i++) first[i + 2] += first[i + 1];
        for (int64_t l = 0; l < e->loops; l++)
            for (int64_t m = e->begin[l]; m < e->begin[l + 1]; m++) loops[first[e->joint[m] + 1]++] = (int32_t)l;
        for (int64_t i = 0; i <= n; i++) seen[i] = -1;
        int64_t many = 0;
        for (int64_t i = 0; i < n; i++) {
            seen[i] = (int32_t)i;
            for (int64_t q = first[i]; q < first[i + 1]; q++)
                for (int64_t m = e->begin[loops[q]]; m < e->begin[loops[q] + 1]; m++)
                    if (seen[e->joint[m]] != i) seen[e->joint[m]] = (int32_t)i, list[many++] = e->joint[m];
            start[i + 1] = many;
        }
    }
    free(first), free(loops), free(seen);
    if (!good) free(start), free(list);
    else *starts = start, *lists = list;
    return good;
}

/* Where the products of two columns of each loop are added in the normal matrix. */
static int placed(Equations *e)
{
    int64_t pairs = 0, at = 0;
    for (int64_t l = 0; l < e->loops; l++) {
        int64_t k = e->begin[l + 1] - e->begin[l];
        pairs += k * (k + 1) / 2;
    }
    e->place = malloc((pairs ? pairs : 1) * sizeof *e->place);
    if (!e->place) return 0;
    for (int64_t l = 0; l < e->loops; l++)
        for (int64_t m = e->begin[l]; m < e->begin[l + 1]; m++)
            for (int64_t o = e->begin[l]; o <= m; o++)
                e->place[at++] = place_of(&e->pattern, e->joint[m], e->joint[o]);
    return 1;
}

/* Find the order of elimination and the pattern of the factor, once: 1, or 0 if there is no memory. Not for several
   threads at once. */
EXPORTED int equations_analysed(Equations *e)
{
    if (e->analysed) return 1;
    int64_t *start = NULL;
    int32_t *list = NULL;
    if (!neighbours(e, &start, &list)) return 0;
    e->analysed = pattern_found(&e->pattern, e->joints, start, list) && placed(e);
    free(start), free(list);
    return e->analysed;
}

/* The factor L D L' of the normal equations J' J + added. */
typedef struct {
    double added, *values;
} Factor;

/* Put a room, or none, in place of the spare one, which is returned. */
static void *exchanged_spare(const Equations *e, void *room)
{
#ifdef __GNUC__
    return __atomic_exchange_n(e->spare, room, __ATOMIC_ACQ_REL);
#else
    (void)e;
    return room; /* no room is spared */
#endif
}

EXPORTED void factor_free(const Equations *e, Factor *f)
{
    if (f) free(exchanged_spare(e, f->values)), free(f);
}

EXPORTED Factor *factor_new(const Equations *e)
{
    Factor *f = calloc(1, sizeof *f);
    if (!f) return NULL;
    f->values = exchanged_spare(e, NULL);
    if (!f->values) f->values = malloc((e->pattern.panel[e->pattern.blocks] + 1) * sizeof *f->values);
    if (f->values) return f;
    free(f);
    return NULL;
}

/* Add up the normal matrix, row by row of each loop. */
static void normal(const Equations *e, const double *derivatives, double *values)
{
    memset(values, 0, e->pattern.panel[e->pattern.blocks] * sizeof *values);
    const int64_t *place = e->place;
    for (int64_t l = 0; l < e->loops; l++) {
        int64_t from = e->begin[l], k = e->begin[l + 1] - from, rows = e->equation[l + 1] - e->equation[l];
        const double *block = derivatives + e->value[l];
        for (int64_t m = 0; m < k; m++)
            for (int64_t o = 0; o <= m; o++) {
                const double *a = block + e->column[from + m], *b = block + e->column[from + o];
                double sum = 0.0;
                for (int64_t r = 0; r < rows; r++) sum += a[r * k] * b[r * k];
                values[*place++] += sum;
            }
    }
}

/* Factorise J' J with `regular` times its largest diagonal entry, at least that of 1, added: 1, or 0 without memory. */
EXPORTED int factorised(const Equations *e, Factor *f, const double *derivatives, double regular)
{
    const Pattern *p = &e->pattern;
    double largest = 1.0;
    normal(e, derivatives, f->values);
    for (int64_t b = 0; b < p->blocks; b++) {
        int64_t rows = p->at[b + 1] - p->at[b], columns = p->first[b + 1] - p->first[b];
        for (int64_t c = 0; c < columns; c++) {
            double diagonal = f->values[p->panel[b] + c * (rows + 1)];
            if (diagonal > largest) largest = diagonal;
        }
    }
    f->added = regular * largest;
    for (int64_t b = 0; b < p->blocks; b++) {
        int64_t rows = p->at[b + 1] - p->at[b], columns = p->first[b + 1] - p->first[b];
        for (int64_t c = 0; c < columns; c++) f->values[p->panel[b] + c * (rows + 1)] += f->added;
    }
    return pattern_factorised(p, f->values);
}

/* Solve (J' J + added) x = b; work has room for twice as many numbers. */
static void solved(const Equations *e, const Factor *f, const double *b, double *x, double *work)
{
    const Pattern *p = &e->pattern;
    for (int64_t k = 0; k < p->n; k++) work[k] = b[p->order[k]];
    pattern_solved(p, f->values, work, work + p->n);
    for (int64_t k = 0; k < p->n; k++) x[p->order[k]] = work[k];
}

EXPORTED int factor_solved(const Equations *e, const Factor *f, const double *b, double *x)
{
    double *work = malloc((2 * e->joints + 1) * sizeof *work);
    if (!work) return 0;
    solved(e, f, b, x, work);
    free(work);
    return 1;
}

/* The least rates at which loops part by off[rows], as a sum of rows of J: x = J' (off - J r) / added with the
   solution r, since r itself has rounding along the freedoms that was divided by `added`. `work` has room for
   3 joints and rows. */
static void least(const Equations *e, const Factor *f, const double *derivatives, const double *off, double *x,
                  double *work)
{
    double *rates = work + 2 * e->joints, *parted = rates + e->joints;
    sum_of_rows(e, derivatives, off, x);
    solved(e, f, x, rates, work);
    image_of(e, derivatives, rates, parted);
    for (int64_t r = 0; r < e->rows; r++) parted[r] = (off[r] - parted[r]) / f->added;
    sum_of_rows(e, derivatives, parted, x);
}

EXPORTED int factor_least(const Equations *e, const Factor *f, const double *derivatives, const double *off, double *x)
{
    double *work = malloc((3 * e->joints + e->rows + 1) * sizeof *work);
    if (!work) return 0;
    least(e, f, derivatives, off, x, work);
    free(work);
    return 1;
}

/* The same to all digits: what the two solutions differ by has the lost ones across the freedoms. */
EXPORTED int factor_least_exactly(const Equations *e, const Factor *f, const double *derivatives, const double *off,
                                  double *x)
{
    int64_t n = e->joints;
    double *work = malloc((4 * n + 2 * e->rows + 1) * sizeof *work);
    if (!work) return 0;
    double *more = work + 3 * n + e->rows, *parted = more + n, *rates = work + 2 * n;
    least(e, f, derivatives, off, x, work);
    for (int64_t i = 0; i < n; i++) rates[i] -= x[i];
    image_of(e, derivatives, rates, parted);
    least(e, f, derivatives, parted, more, work);
    for (int64_t i = 0; i < n; i++) x[i] += more[i];
    free(work);
    return 1;
}

/* The rates nearest to some at which loops stay closed to first order; the second round takes off what
   regularisation left. */
EXPORTED int factor_projected(const Equations *e, const Factor *f, const double *derivatives, const double *rates,
                              double *x)
{
    int64_t n = e->joints;
    double *work = malloc((4 * n + 2 * e->rows + 1) * sizeof *work);
    if (!work) return 0;
    double *across = work + 3 * n + e->rows, *parted = across + n;
    memcpy(x, rates, n * sizeof *x);
    for (int round = 0; round < 2; round++) {
        image_of(e, derivatives, x, parted);
        least(e, f, derivatives, parted, across, work);
        for (int64_t i = 0; i < n; i++) x[i] -= across[i];
    }
    free(work);
    return 1;
}

/* How Newton's method and a walk go on; what these numbers mean is said where Python has them (closure.py, walk). */
typedef struct {
    double closed, slow, corrections, regular, free, clear;
    double first, largest, least, stray, stray_first, alike, easy, singular;
} Manner;

/* Room for one step: arrays of joints, of equations and of derivatives. */
typedef struct {
    const Equations *e;
    const Manner *how;
    const double *zero, *freed;
    Factor *factor;
    double *rates, *expected, *end, *tried, *change, *arriving, *turned, *chord, *off, *left, *residual, *entries,
        *others, *factored, *all;
} Stride;

static void stride_free(Stride *s) { factor_free(s->e, s->factor), free(s->all); }

static int stride_new(Stride *s, const Equations *e, const Manner *how, const double *zero, const double *freed)
{
    int64_t n = e->joints + 1, m = e->rows + 1, d = e->derivatives + 1;
    s->e = e, s->how = how, s->zero = zero, s->freed = freed, s->factor = factor_new(e);
    s->all = malloc((8 * n + 3 * m + 3 * d) * sizeof *s->all);
    if (!s->factor || !s->all) {
        stride_free(s);
        return 0;
    }
    s->rates = s->all, s->expected = s->rates + n, s->end = s->expected + n, s->tried = s->end + n;
    s->change = s->tried + n, s->arriving = s->change + n, s->turned = s->arriving + n, s->chord = s->turned + n;
    s->off = s->chord + n, s->left = s->off + m, s->residual = s->left + m, s->entries = s->residual + m;
    s->others = s->entries + d, s->factored = s->others + d;
    return 1;
}

static double largest_of(int64_t n, const double *values)
{
    double largest = 0.0;
    for (int64_t i = 0; i < n; i++)
        if (!(fabs(values[i]) <= largest)) largest = fabs(values[i]);
    return largest;
}

static double product_of(int64_t n, const double *a, const double *b)
{
    double sum = 0.0;
    for (int64_t i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

static double norm_of(int64_t n, const double *a) { return sqrt(product_of(n, a, a)); }

static void exchanged(double **one, double **other)
{
    double *kept = *one;
    *one = *other, *other = kept;
}

static double off_at(Stride *s, const double *angles, double *residual, double *entries)
{
    for (int64_t i = 0; i < s->e->joints; i++) s->turned[i] = angles[i] - s->zero[i];
    equations_at(s->e, s->turned, s->freed, residual, entries);
    return largest_of(s->e->rows, residual);
}

static int factored_at(Stride *s, const double *entries)
{
    memcpy(s->factored, entries, s->e->derivatives * sizeof *entries);
    return factorised(s->e, s->factor, s->factored, s->how->regular);
}

/* Newton's method from `end`, in place, with the derivatives there in `entries`: as `corrected` in closure.py. */
static int corrected(Stride *s, double *error, int *steps)
{
    int64_t n = s->e->joints;
    int fresh = 1, known = 0;
    *error = off_at(s, s->end, s->off, s->entries), *steps = 0;
    for (int step = 1; step <= s->how->corrections && !(*error <= s->how->closed / 100.0); step++) {
        if (!known && !factored_at(s, s->entries)) return 0;
        known = 1;
        for (int64_t r = 0; r < s->e->rows; r++) s->left[r] = -s->off[r];
        if (!factor_least_exactly(s->e, s->factor, s->factored, s->left, s->change)) return 0;
        for (int64_t i = 0; i < n; i++) s->tried[i] = s->end[i] + s->change[i];
        double off = off_at(s, s->tried, s->residual, s->others);
        int slow = off > s->how->slow * *error;
        if (off < *error) {
            exchanged(&s->end, &s->tried), exchanged(&s->off, &s->residual), exchanged(&s->entries, &s->others);
            *error = off, *steps = step, fresh = 0;
        } else if (fresh) {
            break;
        }
        if (slow) {
            if (*error <= s->how->closed) break;
            known = 0, fresh = 1;
        }
    }
    return 1;
}

/* A unit vector nearer to the least singular vector across the freedoms: as `sharpened` in tangent.py. */
static int sharpened(Stride *s, double *across)
{
    const Equations *e = s->e;
    int64_t n = e->joints;
    double *free_part = s->change, *kept = s->tried, whole = norm_of(n, across);
    if (!factor_projected(e, s->factor, s->factored, across, free_part)) return 0;
    for (int64_t i = 0; i < n; i++) kept[i] = across[i] - free_part[i];
    double size = norm_of(n, kept);
    if (size <= s->how->free * whole) {
        size = norm_of(n, free_part);
        for (int64_t i = 0; i < n; i++) across[i] = free_part[i] / size;
        return 1;
    }
    for (int64_t i = 0; i < n; i++) kept[i] /= size;
    if (!factor_solved(e, s->factor, kept, across)) return 0;
    if (!factor_projected(e, s->factor, s->factored, across, free_part)) return 0;
    for (int64_t i = 0; i < n; i++) across[i] -= free_part[i];
    size = norm_of(n, across);
    for (int64_t i = 0; i < n; i++) across[i] /= size;
    return 1;
}

/* Where a walk is, and what it goes on with: joint angles, derivatives there, rates, how they bend, the vector across
   the freedoms; the length of the next step; whether a step was taken; whether `across` is followed: 0 no, 1 from the
   next step on, 2 yes. After each step the same is written for it, with the rates of the step and its error. */
typedef struct {
    double *angles, *entries, *tangent, *bend, *across, *image, *leaving, *arriving, *error, *length;
    int64_t *steps, *singular;
} Place;

static Place next_place(Place p, const Equations *e)
{
    int64_t n = e->joints;
    Place q = {p.angles + n, p.entries + e->derivatives, p.tangent + n, p.bend + n, p.across + n, p.image + e->rows,
               p.leaving + n, p.arriving + n, p.error + 1, p.length + 1, p.steps + 1, p.singular + 1};
    return q;
}

/* Find the next closed configuration, in `end`: 1, 0 if there is none, or -1 without memory. */
static int stepped(Stride *s, double *length, double stray, double *bend, const double *here, double *error, int *steps)
{
    int64_t n = s->e->joints;
    while (*length >= s->how->least) {
        double step = *length, astray = 0.0;
        for (int64_t i = 0; i < n; i++)
            s->end[i] = s->expected[i] = here[i] + step * s->rates[i] + step * step / 2.0 * bend[i];
        if (!corrected(s, error, steps)) return -1;
        for (int64_t i = 0; i < n; i++) {
            double off = fabs(s->end[i] - s->expected[i]);
            if (!(off <= astray)) astray = off;
        }
        if (*error <= s->how->closed && astray <= stray * step) {
            if (!factored_at(s, s->entries)) return -1;
            if (!factor_projected(s->e, s->factor, s->factored, s->rates, s->arriving)) return -1;
            double sizes = norm_of(n, s->arriving) * norm_of(n, s->rates);
            if (product_of(n, s->arriving, s->rates) > s->how->alike * sizes) {
                if (*steps <= s->how->easy) *length = 1.5 * step < s->how->largest ? 1.5 * step : s->how->largest;
                return 1;
            }
        }
        *length = step / 2.0;
    }
    return 0;
}

/* Note rates and bend at the end of a step that is in `end`: as `_arrive` in walking.py. */
static void arrived(Stride *s, const Place *from, Place *to)
{
    int64_t n = s->e->joints;
    for (int64_t i = 0; i < n; i++) s->chord[i] = s->end[i] - from->angles[i];
    double length = largest_of(n, s->chord), size = largest_of(n, s->arriving), most = 0.0;
    memcpy(to->tangent, from->tangent, n * sizeof *to->tangent), memcpy(to->bend, from->bend, n * sizeof *to->bend);
    if (length == 0.0) return;
    if (size < s->how->least) size = s->how->least;
    for (int64_t i = 0; i < n; i++) {
        to->tangent[i] = *to->singular ? 2.0 * s->chord[i] / length - s->rates[i] : s->arriving[i];
        to->bend[i] = (s->arriving[i] / size - s->rates[i]) / length;
        if (fabs(to->bend[i]) > most) most = fabs(to->bend[i]);
    }
    if (*to->singular || most * *to->length > s->how->stray) memset(to->bend, 0, n * sizeof *to->bend);
}

/* Take up to `most` steps along a curve where no joint is driven; places[0] is where the walk is, the others are
   written. Returns how many were taken, or -1 without memory. */
EXPORTED int64_t curve_walked(const Equations *e, const double *manner, const double *zero, const double *freed,
                              int64_t begun, int64_t watched, int64_t most, double *angles, double *entries,
                              double *tangent, double *bend, double *across, double *image, double *leaving,
                              double *arriving, double *error, double *length, int64_t *steps, int64_t *singular)
{
    Place from = {angles,  entries,  tangent, bend,   across, image,
                  leaving, arriving, error,   length, steps,  singular};
    Stride s;
    int64_t n = e->joints, taken = 0;
    if (!stride_new(&s, e, (const Manner *)manner, zero, freed)) return -1;
    int good = factored_at(&s, from.entries);
    for (; good && taken < most; taken++) {
        Place to = next_place(from, e);
        int corrections = 0, found;
        memcpy(s.rates, from.tangent, n * sizeof *s.rates);
        if (begun) good = factor_projected(e, s.factor, s.factored, from.tangent, s.rates);
        double size = largest_of(n, s.rates);
        for (int64_t i = 0; size && i < n; i++) s.rates[i] /= size;
        *to.length = *from.length;
        found = good ? stepped(&s, to.length, begun ? s.how->stray : s.how->stray_first, from.bend, from.angles,
                               to.error, &corrections)
                     : -1;
        good = found >= 0;
        if (found != 1) break;
        begun = 1, *to.steps = corrections, *to.singular = 0;
        memcpy(to.angles, s.end, n * sizeof *s.end);
        memcpy(to.entries, s.entries, e->derivatives * sizeof *s.entries);
        memcpy(to.leaving, s.rates, n * sizeof *s.rates), memcpy(to.arriving, s.arriving, n * sizeof *s.rates);
        memcpy(to.across, from.across, n * sizeof *to.across);
        if (watched) {
            double *part = s.change;
            if (watched == 1) { /* the part of a vector across the freedoms, to begin with */
                good = factor_projected(e, s.factor, s.factored, to.across, part);
                for (int64_t i = 0; i < n; i++) part[i] = to.across[i] - part[i];
                size = norm_of(n, part);
                for (int64_t i = 0; size > s.how->clear && i < n; i++) to.across[i] = part[i] / size;
            }
            watched = 2;
            good = good && sharpened(&s, to.across);
            image_of(e, s.factored, to.across, to.image);
            if (product_of(n, to.across, from.across) < 0.0) {
                for (int64_t i = 0; i < n; i++) to.across[i] = -to.across[i];
                for (int64_t i = 0; i < e->rows; i++) to.image[i] = -to.image[i];
            }
            *to.singular = norm_of(e->rows, to.image) <= s.how->singular;
        }
        arrived(&s, &from, &to);
        from = to;
    }
    stride_free(&s);
    return good ? taken : -1;
}

/* Newton's method from joint angles end[joints], in place; the derivatives where it ends, the error and the number of
   steps: 1, or 0 without memory. Of `manner` only the numbers of Newton's method are read. */
EXPORTED int equations_corrected(const Equations *e, const double *manner, const double *zero, const double *freed,
                                 double *end, double *entries, double *error, int64_t *steps)
{
    Stride s;
    int taken = 0;
    if (!stride_new(&s, e, (const Manner *)manner, zero, freed)) return 0;
    memcpy(s.end, end, e->joints * sizeof *end);
    int good = corrected(&s, error, &taken);
    memcpy(end, s.end, e->joints * sizeof *end), memcpy(entries, s.entries, e->derivatives * sizeof *entries);
    *steps = taken;
    stride_free(&s);
    return good;
}
