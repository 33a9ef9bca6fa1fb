/* Loop sums: every circle on which the joints of a loop can lie, for many loops and all patterns of signs.

The same as the numpy version beside it (loop_sums.py), which does the work where no compiler was at hand and says what
all this means. Plain C, without Python's API: arrays go in and out. Theory: docs/theory/loop-sums.md. */

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#ifdef _WIN32
#define EXPORTED __declspec(dllexport)
#else
#define EXPORTED __attribute__((visibility("default")))
#endif

enum { MOST_LINKS = 16, MOST_STEPS = 200 };
static const double PI = 3.14159265358979323846;

/* A loop with some signs: reaches in rising order, the weights of its steps, base 1 on a cone and 0 on a cylinder. */
typedef struct {
    int links, base;
    double reach[MOST_LINKS];
} Loop;

static double rounding_of(const Loop *loop, double total) { return (loop->links + 4) * DBL_EPSILON * total; }

static double most_sensitive(void) { return 1.0 / sqrt(8.0 * DBL_EPSILON); }

static double half_step(double size, double reach, int base)
{
    double left = reach - size;
    return atan2(sqrt(base + size), sqrt(left > 0.0 ? left : 0.0));
}

static double loop_sum(const Loop *loop, const double *weights, double size)
{
    double total = 0.0;
    for (int i = 0; i < loop->links; i++)
        if (weights[i] != 0.0) total += weights[i] * half_step(size, loop->reach[i], loop->base);
    return 2.0 * total;
}

static double sum_rounding(const Loop *loop, const double *weights, double size)
{
    double total = 0.0, most = most_sensitive();
    for (int i = 0; i < loop->links; i++) {
        double c = loop->reach[i], step = 2.0 * half_step(size, c, loop->base), left = c - size;
        if (left < c / (most * most)) left = c / (most * most);
        double change = 2.0 * sqrt(c / (loop->base + c) * (loop->base + size) / left);
        total += fabs(weights[i]) * (c <= size || step > change ? step : change);
    }
    return rounding_of(loop, total);
}

/* A function of the tower: sum w_i ((C - z) / (C_i - z))^(level + 1/2), with C the least reach that has a weight. */
static double of_tower(const Loop *loop, const double *weights, int level, double size)
{
    double total = 0.0, nearest = 0.0;
    int first = 1;
    for (int i = 0; i < loop->links; i++) {
        if (weights[i] == 0.0) continue;
        if (first) nearest = loop->reach[i];
        double ratio = first || loop->reach[i] == nearest ? 1.0 : (nearest - size) / (loop->reach[i] - size);
        double value = weights[i] * sqrt(ratio);
        for (int k = 0; k < level; k++) value *= ratio;
        total += value, first = 0;
    }
    return total;
}

/* What a root is looked for of: a function of the tower, or where the level is -1 the loop sum less a goal. */
typedef struct {
    const Loop *loop;
    const double *weights;
    int level;
    double goal;
} Sought;

static double value_of(const Sought *sought, double size)
{
    if (sought->level >= 0) return of_tower(sought->loop, sought->weights, sought->level, size);
    return loop_sum(sought->loop, sought->weights, size) - sought->goal;
}

static int sign_of(double value) { return (value > 0.0) - (value < 0.0); }

/* The root between two points where values differ in sign: Chandrupatla's method. */
static double root_of(const Sought *sought, double first, double second)
{
    double at_first = value_of(sought, first), at_second = value_of(sought, second), part = 0.5, best = first;
    for (int step = 0; step < MOST_STEPS; step++) {
        double tried = first + part * (second - first), at_tried = value_of(sought, tried), third, at_third;
        if (sign_of(at_tried) == sign_of(at_first)) {
            third = first, at_third = at_first;
        } else {
            third = second, at_third = at_second, second = first, at_second = at_first;
        }
        first = tried, at_first = at_tried;
        best = fabs(at_first) < fabs(at_second) ? first : second;
        double width = fabs(second - first), least = (4.0 * DBL_EPSILON * fabs(best) + DBL_MIN) / width;
        if (least > 0.5 || at_first == 0.0 || at_second == 0.0 || width == 0.0) break;
        double along = (first - second) / (third - second), up = (at_first - at_second) / (at_third - at_second);
        double low = least < 0.5 ? least : 0.5, high = 1.0 - least > 0.5 ? 1.0 - least : 0.5;
        part = 0.5;
        if (up * up < along && (1.0 - up) * (1.0 - up) < 1.0 - along) {
            double slope = at_first / (at_third - at_first) * at_second / (at_third - at_second);
            part = at_first / (at_second - at_first) * at_third / (at_second - at_third);
            part += (third - first) / (second - first) * slope;
        }
        if (part < low) part = low;
        if (part > high) part = high;
    }
    return best;
}

static int sign_changes(const Loop *loop, const double *weights)
{
    int changes = 0, last = 0;
    for (int i = 0; i < loop->links; i++) {
        int sign = sign_of(weights[i]);
        changes += sign * last < 0;
        if (sign) last = sign;
    }
    return changes;
}

/* The weights of the next function of the tower: times C_j - C_i, j before the first sign change. */
static void one_change_fewer(const Loop *loop, const double *weights, double *fewer)
{
    int last = 0, place = 0;
    for (int i = 0; i < loop->links; i++) {
        int sign = sign_of(weights[i]);
        if (sign * last < 0) break;
        if (sign) last = sign, place = i;
    }
    double most = 0.0;
    for (int i = 0; i < loop->links; i++) {
        fewer[i] = weights[i] * (loop->reach[place] - loop->reach[i]);
        if (fabs(fewer[i]) > most) most = fabs(fewer[i]);
    }
    for (int i = 0; i < loop->links; i++) fewer[i] /= most;
}

/* Where monotone pieces of a loop sum meet: 0, the zeros of its derivative, and the least reach, which is repeated if
   zeros lack. Returns their number. */
static int nodes_of(const Loop *loop, const double *weights, int changes, double *nodes)
{
    double tower[MOST_LINKS][MOST_LINKS], values[MOST_LINKS + 1];
    int count = 2;
    memcpy(tower[0], weights, sizeof tower[0]);
    for (int k = 0; k < changes; k++) one_change_fewer(loop, tower[k], tower[k + 1]);
    nodes[0] = 0.0, nodes[1] = loop->reach[0];
    for (int level = changes - 1; level >= 0; level--) { /* back from the function without zeros to the derivative */
        Sought sought = {loop, tower[level], level, 0.0};
        double last = nodes[count - 1], zeros[MOST_LINKS + 1];
        int found = 0;
        for (int j = 0; j < count; j++) values[j] = value_of(&sought, nodes[j]);
        for (int j = 0; j + 1 < count; j++)
            if (values[j] * values[j + 1] < 0.0) zeros[found++] = root_of(&sought, nodes[j], nodes[j + 1]);
        for (int j = 0; j < found; j++) nodes[j + 1] = zeros[j]; /* between rising nodes: they rise too */
        for (int j = found + 1; j <= count; j++) nodes[j] = last;
        count++;
    }
    return count;
}

/* Roots found: columns loop, pattern, turns, size, residual, whether double; families: loop, pattern, whether exact. */
typedef struct {
    int64_t room, roots, families;
    int64_t *loop, *pattern, *turns, *twice, *family;
    double *size, *residual;
} Found;

static void add_root(Found *f, int64_t loop, int64_t pattern, int turns, double size, double residual, int twice)
{
    if (f->roots < f->room) {
        f->loop[f->roots] = loop, f->pattern[f->roots] = pattern, f->turns[f->roots] = turns;
        f->size[f->roots] = size, f->residual[f->roots] = residual, f->twice[f->roots] = twice;
    }
    f->roots++;
}

static void add_family(Found *f, int64_t loop, int64_t pattern, int exact)
{
    if (f->families < f->room) {
        int64_t *row = f->family + 3 * f->families;
        row[0] = loop, row[1] = pattern, row[2] = exact;
    }
    f->families++;
}

/* Where monotone pieces of the loop sum of one pattern of signs cross 2 pi k, or touch it. */
static void crossings(const Loop *loop, const double *weights, const double *nodes, int count, int64_t number,
                      int64_t pattern, Found *found)
{
    double sums[MOST_LINKS + 1], noise[MOST_LINKS + 1], total = 0.0, low = INFINITY, high = -INFINITY;
    int vanish = 1;
    for (int i = 0; i < loop->links; i++) total += fabs(2.0 * most_sensitive() * weights[i]);
    double most = rounding_of(loop, total); /* elsewhere rounding decides nothing */
    for (int j = 0; j < count; j++) {
        sums[j] = loop_sum(loop, weights, nodes[j]);
        double turn = fmod(sums[j] + PI, 2.0 * PI);
        if (turn < 0.0) turn += 2.0 * PI;
        noise[j] = fabs(turn - PI) <= most ? sum_rounding(loop, weights, nodes[j]) : 0.0;
        vanish = vanish && fabs(sums[j]) <= noise[j];
        if (sums[j] - noise[j] < low) low = sums[j] - noise[j];
        if (sums[j] + noise[j] > high) high = sums[j] + noise[j];
    }
    if (vanish) add_family(found, number, pattern, 0);
    for (int turns = -(loop->links / 2); turns <= loop->links / 2; turns++) {
        double goal = 2.0 * PI * turns;
        if (!(low <= goal && high >= goal) || (vanish && turns == 0)) continue;
        Sought sought = {loop, weights, -1, goal};
        int before = 1;
        for (int j = 0; j < count; j++) {
            double over = sums[j] - goal;
            int side = fabs(over) <= noise[j] ? 0 : sign_of(over);
            if (j && side * before < 0) {
                double size = root_of(&sought, nodes[j - 1], nodes[j]);
                add_root(found, number, pattern, turns, size, value_of(&sought, size), 0);
            }
            /* neighbouring nodes may be the same root; an infinite radius is none */
            int touching = side == 0 && (!j || before != 0) && !(!j && loop->base == 0 && turns == 0);
            if (touching) add_root(found, number, pattern, turns, nodes[j], over, 1);
            before = side;
        }
    }
}

/* All roots of loops with reaches[loops, links] and signs[patterns, links]; columns have room for so many. counts[2]:
   how many roots and families there are, which may be more than there is room for. */
EXPORTED void all_roots(int64_t loops, int64_t links, int64_t patterns, int64_t base, const double *reaches,
                        const int8_t *signs, int64_t first, int64_t room, int64_t *loop, int64_t *pattern,
                        int64_t *turns, double *size, double *residual, int64_t *twice, int64_t *family,
                        int64_t *counts)
{
    Found found = {room, 0, 0, loop, pattern, turns, twice, family, size, residual};
    int n = (int)links;
    for (int64_t l = 0; l < loops; l++) {
        const double *given = reaches + l * links;
        int order[MOST_LINKS];
        Loop one = {n, (int)base, {0.0}};
        for (int i = 0; i < n; i++) {
            int j = i;
            for (; j > 0 && given[order[j - 1]] > given[i]; j--) order[j] = order[j - 1];
            order[j] = i;
        }
        for (int i = 0; i < n; i++) one.reach[i] = given[order[i]];
        for (int64_t p = 0; p < patterns; p++) {
            double weights[MOST_LINKS] = {0.0}, nodes[MOST_LINKS + 2];
            int any = 0;
            for (int i = 0; i < n; i++) { /* signs of equal reaches are put together */
                weights[i] = signs[p * links + order[i]];
                if (i && one.reach[i] == one.reach[i - 1]) weights[i] += weights[i - 1], weights[i - 1] = 0.0;
            }
            for (int i = 0; i < n; i++) any |= weights[i] != 0.0;
            if (!any) {
                add_family(&found, first + l, p, 1);
                continue;
            }
            int count = nodes_of(&one, weights, sign_changes(&one, weights), nodes);
            crossings(&one, weights, nodes, count, first + l, p, &found);
        }
    }
    counts[0] = found.roots, counts[1] = found.families;
}
