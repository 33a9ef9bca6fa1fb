/* The cost of a drawing of panels, with derivatives: the same as the numpy version beside it (drawing.py and
measures.py), which does the work where no compiler was at hand. Plain C, without Python's API; a handle never
changes after it was made. Matrices are rows by columns. Theory: docs/theory/realisation.md. */

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#define EXPORTED __declspec(dllexport)
#else
#define EXPORTED __attribute__((visibility("default")))
#endif

static const double PI = 3.14159265358979323846;

/* Points are the vertices, centres that are no vertices, and the hubs of panels that cannot be convex. Three points
   make a corner, two an edge, three the side of a panel seen from its hub. Corners stand panel by panel; those at
   each vertex from `begin` in `at`. Rings are the border and those round holes: `ring` says where each begins. */
typedef struct {
    int64_t points, vertices, panels, corners, edges, seen, rings, inner, hubs;
    int32_t *corner, *edge, *side, *panel, *begin, *at, *ring, *round, *within, *sides;
    double *widest;
    double sharp, length, border, visible, same, zero; /* sizes, as drawing.py has them; what is zero */
} Drawing;

static void *copied(const void *from, size_t bytes)
{
    void *to = malloc(bytes ? bytes : 1);
    if (to && bytes)
        memcpy(to, from, bytes);
    return to;
}

EXPORTED void drawing_free(Drawing *d)
{
    if (!d)
        return;
    int32_t *parts[] = {d->corner, d->edge, d->side, d->panel, d->begin, d->at, d->ring, d->round, d->within, d->sides};
    for (size_t k = 0; k < sizeof parts / sizeof *parts; k++)
        free(parts[k]);
    free(d->widest);
    free(d);
}

/* Numbers of: points, vertices, panels, corners, edges, sides seen, rings, inner vertices, hubs; then arrays. */
EXPORTED Drawing *drawing_new(const int64_t *number, const int32_t *corner, const int32_t *edge, const int32_t *side,
                              const int32_t *panel, const int32_t *begin, const int32_t *at, const int32_t *ring,
                              const int32_t *round, const int32_t *within, const int32_t *sides, const double *widest,
                              const double *sizes)
{
    Drawing *d = calloc(1, sizeof *d);
    if (!d)
        return NULL;
    memcpy(&d->points, number, 9 * sizeof *number);
    const size_t word = sizeof *corner;
    d->corner = copied(corner, 3 * d->corners * word);
    d->edge = copied(edge, 2 * d->edges * word);
    d->side = copied(side, 3 * d->seen * word);
    d->panel = copied(panel, d->corners * word);
    d->begin = copied(begin, (d->vertices + 1) * word);
    d->at = copied(at, d->corners * word);
    d->ring = copied(ring, (d->rings + 1) * word);
    d->round = copied(round, ring[d->rings] * word);
    d->within = copied(within, d->inner * word);
    d->sides = copied(sides, d->panels * word);
    d->widest = copied(widest, d->corners * sizeof *widest);
    memcpy(&d->sharp, sizes, 6 * sizeof *sizes);
    if (d->corner && d->edge && d->side && d->panel && d->begin && d->at && d->ring && d->round && d->within &&
        d->sides && d->widest)
        return d;
    drawing_free(d);
    return NULL;
}

/* The angle at the middle one of three points, and how it changes with each of them: six numbers. */
static double angle_at(const double *u, const int32_t *three, double *by)
{
    const double *a = u + 2 * three[0], *b = u + 2 * three[1], *c = u + 2 * three[2];
    double back_x = a[0] - b[0], back_y = a[1] - b[1], on_x = c[0] - b[0], on_y = c[1] - b[1];
    double back = back_x * back_x + back_y * back_y, on = on_x * on_x + on_y * on_y;
    by[0] = -back_y / back, by[1] = back_x / back;
    by[4] = on_y / on, by[5] = -on_x / on;
    by[2] = -by[0] - by[4], by[3] = -by[1] - by[5];
    return atan2(on_x * back_y - on_y * back_x, on_x * back_x + on_y * back_y);
}

static void add(double *row, const int32_t *three, const double *by, double factor)
{
    for (int k = 0; k < 3; k++) {
        row[2 * three[k]] += factor * by[2 * k];
        row[2 * three[k] + 1] += factor * by[2 * k + 1];
    }
}

/* Whether two edges cross, or a vertex lies on an edge that does not end there. */
static int crosses(const Drawing *d, const double *u)
{
    double mean[2] = {0.0, 0.0}, extent = 0.0;
    for (int64_t v = 0; v < d->vertices; v++)
        mean[0] += u[2 * v] / d->vertices, mean[1] += u[2 * v + 1] / d->vertices;
    for (int64_t v = 0; v < 2 * d->vertices; v++)
        extent = fmax(extent, fabs(u[v] - mean[v % 2]));
    for (int64_t i = 0; i < d->edges; i++) {
        const int32_t *e = d->edge + 2 * i;
        const double *p = u + 2 * e[0];
        double x = u[2 * e[1]] - p[0], y = u[2 * e[1] + 1] - p[1];
        for (int64_t j = i + 1; j < d->edges; j++) {
            const int32_t *f = d->edge + 2 * j;
            if (e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1])
                continue;
            const double *q = u + 2 * f[0];
            double s = u[2 * f[1]] - q[0], t = u[2 * f[1] + 1] - q[1], off_x = q[0] - p[0], off_y = q[1] - p[1];
            double turned = x * t - y * s, first = x * off_y - y * off_x, second = s * off_y - t * off_x;
            if (first * (first + turned) < -d->same && second * (second + turned) < -d->same)
                return 1;
        }
        for (int32_t v = 0; v < d->vertices; v++) {
            if (v == e[0] || v == e[1])
                continue;
            double off_x = u[2 * v] - p[0], off_y = u[2 * v + 1] - p[1];
            double part = fmin(fmax((off_x * x + off_y * y) / (x * x + y * y), 0.0), 1.0);
            if (hypot(off_x - part * x, off_y - part * y) < d->same * extent)
                return 1;
        }
    }
    return 0;
}

/* Write residuals, with their derivatives by all coordinates: corners near 0, corners near their widest, lengths,
   corners of each ring, sides seen from hubs. Returns 0 where two points coincide, a panel is turned over, the border
   bends inward or edges cross; then what was written means nothing. `room` is for seven numbers of each corner and
   one of each panel and each vertex. */
EXPORTED int drawing_cost(const Drawing *d, const double *u, const double *lengths, int convex, double *residual,
                          double *derivative, double *room)
{
    const int64_t width = 2 * d->points, fixed = d->points - d->hubs;
    for (int64_t i = 0; i < d->vertices + d->hubs; i++) {
        const double *p = u + 2 * (i < d->vertices ? i : fixed + i - d->vertices);
        for (int64_t j = 0; j < i; j++) {
            const double *q = u + 2 * (j < d->vertices ? j : fixed + j - d->vertices);
            if (p[0] == q[0] && p[1] == q[1])
                return 0;
        }
    }
    double *angle = room, *by = angle + d->corners, *turned = by + 6 * d->corners, *around = turned + d->panels;
    memset(turned, 0, (d->panels + d->vertices) * sizeof *turned);
    for (int64_t k = 0; k < d->corners; k++) {
        angle[k] = angle_at(u, d->corner + 3 * k, by + 6 * k);
        if (angle[k] < 0.0 && d->widest[k] > PI)
            angle[k] += 2.0 * PI;
        if (!(angle[k] > 0.0 && angle[k] < d->widest[k]))
            return 0;
        turned[d->panel[k]] += angle[k];
        around[d->corner[3 * k + 1]] += angle[k];
    }
    for (int64_t p = 0; p < d->panels; p++)
        if (fabs(turned[p] - PI * (d->sides[p] - 2)) >= d->zero)
            return 0;
    for (int64_t i = 0; i < d->inner; i++)
        if (fabs(around[d->within[i]] - 2.0 * PI) >= d->zero)
            return 0;
    const int64_t ringed = d->ring[d->rings];
    memset(derivative, 0, (2 * d->corners + d->edges + ringed + d->seen) * width * sizeof *derivative);
    double *row = derivative;
    for (int64_t k = 0; k < d->corners; k++, row += width) {
        double part = d->sharp / angle[k];
        *residual = part * part;
        add(row, d->corner + 3 * k, by + 6 * k, -2.0 * *residual / angle[k]);
        residual++;
    }
    for (int64_t k = 0; k < d->corners; k++, row += width) {
        double left = d->widest[k] - angle[k], part = d->sharp / left;
        *residual = part * part;
        add(row, d->corner + 3 * k, by + 6 * k, 2.0 * *residual / left);
        residual++;
    }
    for (int64_t e = 0; e < d->edges; e++, row += width) {
        const int32_t a = d->edge[2 * e], b = d->edge[2 * e + 1];
        double x = u[2 * b] - u[2 * a], y = u[2 * b + 1] - u[2 * a + 1], square = x * x + y * y;
        double longer = log(square) / 2.0 - lengths[e], rate = d->length * (1.0 + 3.0 * longer * longer);
        *residual++ = d->length * (longer + longer * longer * longer);
        row[2 * b] = rate * (x / square), row[2 * b + 1] = rate * (y / square);
        row[2 * a] = -row[2 * b], row[2 * a + 1] = -row[2 * b + 1];
    }
    for (int64_t r = 0; r < d->rings; r++)
        for (int32_t i = d->ring[r]; i < d->ring[r + 1]; i++, row += width) {
            const int32_t v = d->round[i];
            double left = (convex && !r ? PI : 2.0 * PI) - around[v];
            double part = d->border * 2.0 * PI / (d->ring[r + 1] - d->ring[r]) / left;
            if (!(left > 0.0))
                return 0;
            *residual = part * part;
            for (int32_t k = d->begin[v]; k < d->begin[v + 1]; k++)
                add(row, d->corner + 3 * d->at[k], by + 6 * d->at[k], 2.0 * *residual / left);
            residual++;
        }
    for (int64_t s = 0; s < d->seen; s++, row += width) {
        double change[6], seen = angle_at(u, d->side + 3 * s, change), part = d->visible / seen;
        if (!(seen > 0.0))
            return 0;
        *residual = part * part;
        add(row, d->side + 3 * s, change, -2.0 * *residual / seen);
        residual++;
    }
    return !d->hubs || !crosses(d, u);
}
