/* The factor L D L' of a sparse positive definite matrix whose pattern stays the same: order of elimination, blocks of
   columns with the same rows below them, and the work on these as on full matrices.

   Columns one after the other whose entries stand in the same rows are one block (a supernode), stored as a full matrix
   column by column: the diagonal part first, then the rows below. Blocks with few entries are joined though some zeros
   are stored then. Each block takes off what the blocks to its left have of it, four columns by four rows at once
   (E. G. Ng, B. W. Peyton, Block sparse Cholesky algorithms on advanced uniprocessor computers, SIAM J. Sci. Comput. 14,
   1993; T. A. Davis, Direct Methods for Sparse Linear Systems, 2006). Part of closure_kernel.c. */

#ifdef _WIN32
static void both_at_once(void *(*work)(void *), void *one, void *other) { work(one), work(other); }
#else
#include <pthread.h>

/* Do two pieces of work at once, or one after the other where no thread can be begun. */
static void both_at_once(void *(*work)(void *), void *one, void *other)
{
    pthread_t thread;
    int begun = !pthread_create(&thread, NULL, work, one);
    work(other);
    if (begun) pthread_join(thread, NULL);
    else work(one);
}
#endif

static void *copied(const void *from, size_t bytes)
{
    void *to = malloc(bytes ? bytes : 1);
    if (to && bytes) memcpy(to, from, bytes);
    return to;
}

/* The order of elimination: of the joints that are left always one that is joined to the fewest, approximately, as
   elimination joins them (P. R. Amestoy, T. A. Davis, I. S. Duff, An approximate minimum degree ordering algorithm,
   SIAM J. Matrix Anal. Appl. 17, 1996). A joint has the joints beside it, and the elements, cliques that
   eliminated joints left; both lists share the room that its neighbours took at the beginning, elements first. */
typedef struct {
    int64_t n, *start, *elements, *length; /* of each joint: where its list starts, how many of it are elements, all */
    int32_t *list;                         /* elements by the joint whose elimination made them */
    int32_t **clique, *size;               /* of each element its joints, NULL once absorbed */
    int32_t *degree, *head, *next, *before, least;
    int64_t *mark, tag;
    char *gone;
} Ordering;

static void unlisted(Ordering *o, int32_t i)
{
    if (o->next[i] >= 0) o->before[o->next[i]] = o->before[i];
    if (o->before[i] >= 0) o->next[o->before[i]] = o->next[i];
    else o->head[o->degree[i]] = o->next[i];
}

static void listed(Ordering *o, int32_t i, int32_t degree)
{
    o->degree[i] = degree, o->before[i] = -1, o->next[i] = o->head[degree];
    if (o->next[i] >= 0) o->before[o->next[i]] = i;
    o->head[degree] = i;
    if (degree < o->least) o->least = degree;
}

/* Eliminate a joint: its clique is all that it is joined to, of which each is joined to each from then on. */
static int eliminated(Ordering *o, int32_t p, int64_t left)
{
    int64_t most = 0, from = o->start[p];
    for (int64_t q = 0; q < o->length[p]; q++)
        most += q < o->elements[p] ? o->size[o->list[from + q]] : 1;
    int32_t *clique = malloc((most ? most : 1) * sizeof *clique), size = 0;
    if (!clique) return 0;
    int64_t here = ++o->tag;
    o->mark[p] = here;
    for (int64_t q = 0; q < o->length[p]; q++) {
        int32_t one = o->list[from + q];
        int32_t *members = q < o->elements[p] ? o->clique[one] : &one;
        int32_t many = q < o->elements[p] ? o->size[one] : 1;
        for (int32_t m = 0; m < many; m++)
            if (o->mark[members[m]] != here && !o->gone[members[m]])
                o->mark[members[m]] = here, clique[size++] = members[m];
        if (q < o->elements[p]) free(o->clique[one]), o->clique[one] = NULL;
    }
    o->gone[p] = 1, o->clique[p] = clique, o->size[p] = size;
    /* Of each element beside the clique, how many of its joints are outside: mark[n + element] counts down. */
    int64_t base = o->tag;
    for (int32_t m = 0; m < size; m++) {
        int32_t i = clique[m];
        for (int64_t q = 0; q < o->elements[i]; q++) {
            int32_t one = o->list[o->start[i] + q];
            if (!o->clique[one] || one == p) continue;
            int64_t *outside = o->mark + o->n + one;
            if (*outside < base) *outside = base + o->size[one];
            (*outside)--;
        }
    }
    for (int32_t m = 0; m < size; m++) {
        int32_t i = clique[m];
        int32_t *list = o->list + o->start[i];
        int64_t kept = 0, degree = size - 1, elements = o->elements[i], length = o->length[i];
        unlisted(o, i);
        for (int64_t q = 0; q < elements; q++) {
            int32_t one = list[q];
            if (!o->clique[one]) continue;
            int64_t outside = o->mark[o->n + one] - base;
            if (outside > 0) degree += outside, list[kept++] = one; /* else it is a part of the new one */
        }
        int64_t joints = kept;
        for (int64_t q = elements; q < length; q++)
            if (o->mark[list[q]] != here && !o->gone[list[q]]) list[joints++] = list[q], degree++;
        /* A place is free: the eliminated joint, or an element of its own, has left the list. */
        memmove(list + kept + 1, list + kept, (joints - kept) * sizeof *list);
        list[kept] = p;
        o->elements[i] = kept + 1, o->length[i] = joints + 1;
        if (degree > o->degree[i] + size - 1) degree = o->degree[i] + size - 1;
        if (degree > left - 2) degree = left - 2;
        listed(o, i, (int32_t)(degree < 0 ? 0 : degree));
    }
    o->tag = base + o->n + 1;
    return 1;
}

static int ordered(int64_t n, const int64_t *start, const int32_t *beside, int32_t *order)
{
    int64_t total = start[n];
    Ordering o = {.n = n, .least = 0};
    o.start = copied(start, (n + 1) * sizeof *start), o.list = copied(beside, total * sizeof *beside);
    o.elements = calloc(n + 1, sizeof *o.elements), o.length = calloc(n + 1, sizeof *o.length);
    o.clique = calloc(n + 1, sizeof *o.clique), o.size = calloc(n + 1, sizeof *o.size);
    o.degree = calloc(n + 1, sizeof *o.degree), o.head = malloc((n + 1) * sizeof *o.head);
    o.next = malloc((n + 1) * sizeof *o.next), o.before = malloc((n + 1) * sizeof *o.before);
    o.mark = calloc(2 * n + 1, sizeof *o.mark), o.gone = calloc(n + 1, 1);
    int good = o.start && o.list && o.elements && o.length && o.clique && o.size && o.degree && o.head && o.next &&
               o.before && o.mark && o.gone;
    for (int64_t i = 0; good && i <= n; i++) o.head[i] = -1;
    for (int64_t i = n - 1; good && i >= 0; i--) {
        o.length[i] = start[i + 1] - start[i];
        listed(&o, (int32_t)i, (int32_t)o.length[i]);
    }
    for (int64_t k = 0; good && k < n; k++) {
        while (o.head[o.least] < 0) o.least++;
        int32_t p = o.head[o.least];
        unlisted(&o, p);
        order[k] = p;
        good = eliminated(&o, p, n - k);
    }
    for (int64_t i = 0; o.clique && i < n; i++) free(o.clique[i]);
    free(o.start), free(o.list), free(o.elements), free(o.length), free(o.clique), free(o.size), free(o.degree);
    free(o.head), free(o.next), free(o.before), free(o.mark), free(o.gone);
    return good;
}

/* The pattern: `order` of elimination and its inverse `rank`; columns first[b] to first[b + 1] are block b, its rows
   row[at[b]] to row[at[b + 1]], sorted, its own columns first; its entries begin at panel[b]. `side` of a block is 0
   or 1 if it is in a subtree that is factorised beside those of the other side, else -1. */
typedef struct {
    int64_t n, blocks, most; /* most: rows of the longest block */
    int32_t *order, *rank, *first, *row, *block;
    int64_t *at, *panel;
    signed char *side;
    int halves; /* whether any block has a side */
} Pattern;

static void pattern_clear(Pattern *p)
{
    free(p->order), free(p->rank), free(p->first), free(p->row), free(p->block), free(p->at), free(p->panel);
    free(p->side);
    memset(p, 0, sizeof *p);
}

/* The elimination tree: the parent of a column is the first later one that its elimination touches. */
static int rooted(const Pattern *p, const int64_t *start, const int32_t *beside, int32_t *parent)
{
    int32_t *root = malloc((p->n + 1) * sizeof *root);
    if (!root) return 0;
    for (int32_t k = 0; k < p->n; k++) {
        parent[k] = -1, root[k] = -1;
        for (int64_t q = start[p->order[k]]; q < start[p->order[k] + 1]; q++)
            for (int32_t i = p->rank[beside[q]], next; i >= 0 && i < k; i = next) {
                next = root[i], root[i] = k;
                if (next < 0) parent[i] = k;
            }
    }
    free(root);
    return 1;
}

/* Go through the tree with each column right after those below it: columns of a block are then one after the other. */
static int postordered(Pattern *p, int32_t *parent)
{
    int64_t n = p->n;
    int32_t *child = malloc((n + 1) * sizeof *child), *sibling = malloc((n + 1) * sizeof *sibling);
    int32_t *stack = malloc((n + 1) * sizeof *stack), *to = malloc((n + 1) * sizeof *to);
    int32_t *order = malloc((n + 1) * sizeof *order), many = 0;
    int good = child && sibling && stack && to && order;
    for (int64_t k = 0; good && k < n; k++) child[k] = -1;
    for (int64_t k = n - 1; good && k >= 0; k--)
        if (parent[k] >= 0) sibling[k] = child[parent[k]], child[parent[k]] = (int32_t)k;
    for (int32_t k = 0; good && k < n; k++) {
        int64_t top = 0;
        if (parent[k] >= 0) continue;
        for (stack[top++] = k; top;) {
            int32_t i = stack[top - 1];
            if (child[i] >= 0) {
                stack[top++] = child[i];
                child[i] = sibling[child[i]];
            } else {
                to[i] = many, order[many++] = p->order[i], top--;
            }
        }
    }
    for (int64_t k = 0; good && k < n; k++) stack[to[k]] = parent[k] < 0 ? -1 : to[parent[k]];
    for (int64_t k = 0; good && k < n; k++) p->rank[order[k]] = (int32_t)k, p->order[k] = order[k], parent[k] = stack[k];
    free(child), free(sibling), free(stack), free(to), free(order);
    return good;
}

/* How many entries each column has, its diagonal too: a row has one wherever the tree leads to it from its own. */
static int counted(const Pattern *p, const int64_t *start, const int32_t *beside, const int32_t *parent, int32_t *count)
{
    int32_t *seen = malloc((p->n + 1) * sizeof *seen);
    if (!seen) return 0;
    for (int32_t k = 0; k < p->n; k++) {
        seen[k] = k, count[k] = 1;
        for (int64_t q = start[p->order[k]]; q < start[p->order[k] + 1]; q++)
            for (int32_t i = p->rank[beside[q]]; i < k && seen[i] != k; i = parent[i]) seen[i] = k, count[i]++;
    }
    free(seen);
    return 1;
}

/* Whether two blocks are joined, of `columns` in all and `rows`, of which `zeros` entries would be zero. */
static int joined(double columns, double rows, double zeros)
{
    double part = zeros / (columns * (columns + 1.0) / 2.0 + columns * (rows - columns));
    return part < 0.05 || (columns <= 4 && part < 0.5) || (columns <= 16 && part < 0.25) ||
           (columns <= 48 && part < 0.1);
}

/* Put columns together: those with the same rows below them, then blocks that are joined to the one before. */
static int blocked(Pattern *p, const int32_t *parent, const int32_t *count)
{
    int64_t n = p->n;
    int32_t *begin = malloc((n + 2) * sizeof *begin), *of = malloc((n + 1) * sizeof *of), many = 0;
    int32_t *columns = malloc((n + 1) * sizeof *columns), *rows = malloc((n + 1) * sizeof *rows);
    int32_t *into = malloc((n + 1) * sizeof *into);
    double *zeros = calloc(n + 1, sizeof *zeros);
    int good = begin && of && columns && rows && into && zeros;
    for (int32_t k = 0; good && k < n; k++) {
        if (!k || parent[k - 1] != k || count[k - 1] != count[k] + 1) begin[many++] = k;
        of[k] = many - 1;
    }
    if (good) begin[many] = (int32_t)n;
    for (int32_t b = many - 1; good && b >= 0; b--) {
        columns[b] = begin[b + 1] - begin[b], rows[b] = count[begin[b]], into[b] = b;
        int32_t above = parent[begin[b + 1] - 1];
        if (above < 0) continue;
        for (above = of[above]; into[above] != above;) above = into[above];
        if (above != b + 1) continue;
        double more = (double)columns[b] * (columns[b] + rows[above] - rows[b]);
        if (!joined(columns[b] + columns[above], columns[b] + rows[above], zeros[b] + zeros[above] + more)) continue;
        zeros[b] += zeros[above] + more, rows[b] = columns[b] + rows[above];
        columns[b] += columns[above], into[above] = b;
    }
    p->first = malloc((many + 1) * sizeof *p->first), p->at = calloc(many + 1, sizeof *p->at);
    p->panel = calloc(many + 1, sizeof *p->panel), p->block = malloc((n + 1) * sizeof *p->block);
    good = good && p->first && p->at && p->panel && p->block;
    for (int32_t b = 0; good && b < many; b++) {
        if (into[b] != b) continue;
        int64_t at = p->blocks++;
        p->first[at] = begin[b], p->first[at + 1] = begin[b] + columns[b];
        p->at[at + 1] = p->at[at] + rows[b], p->panel[at + 1] = p->panel[at] + (int64_t)rows[b] * columns[b];
        if (rows[b] > p->most) p->most = rows[b];
        for (int32_t k = 0; k < columns[b]; k++) p->block[begin[b] + k] = (int32_t)at;
    }
    free(begin), free(of), free(columns), free(rows), free(into), free(zeros);
    return good;
}

static int ascending(const void *one, const void *other)
{
    int32_t a = *(const int32_t *)one, b = *(const int32_t *)other;
    return (a > b) - (a < b);
}

/* The rows of each block: its columns, those of its part of the matrix, and those of the blocks below it in the tree. */
static int filled_in(Pattern *p, const int64_t *start, const int32_t *beside)
{
    int64_t blocks = p->blocks;
    int32_t *child = malloc((blocks + 1) * sizeof *child), *sibling = malloc((blocks + 1) * sizeof *sibling);
    int32_t *seen = malloc((p->n + 1) * sizeof *seen);
    p->row = malloc((p->at[blocks] + 1) * sizeof *p->row);
    int good = child && sibling && seen && p->row;
    for (int64_t b = 0; good && b < blocks; b++) child[b] = -1;
    for (int64_t k = 0; good && k < p->n; k++) seen[k] = -1;
    for (int32_t b = 0; good && b < blocks; b++) {
        int32_t *row = p->row + p->at[b], last = p->first[b + 1], many = 0;
        for (int32_t k = p->first[b]; k < last; k++) row[many++] = k;
        for (int32_t k = p->first[b]; k < last; k++)
            for (int64_t q = start[p->order[k]]; q < start[p->order[k] + 1]; q++) {
                int32_t i = p->rank[beside[q]];
                if (i >= last && seen[i] != b) seen[i] = b, row[many++] = i;
            }
        for (int32_t c = child[b]; c >= 0; c = sibling[c])
            for (int64_t q = p->at[c] + p->first[c + 1] - p->first[c]; q < p->at[c + 1]; q++) {
                int32_t i = p->row[q];
                if (i >= last && seen[i] != b) seen[i] = b, row[many++] = i;
            }
        int32_t own = last - p->first[b];
        qsort(row + own, many - own, sizeof *row, ascending);
        if (many > own) {
            int32_t above = p->block[row[own]];
            sibling[b] = child[above], child[above] = b;
        }
    }
    free(child), free(sibling), free(seen);
    return good;
}

/* How many products each block takes, and with the subtree below it, and how many blocks a subtree has, which stand one
   after the other, its root last. Returns the sum. */
static double weighed(const Pattern *p, double *alone, double *work, int32_t *size)
{
    double sum = 0.0;
    for (int64_t b = 0; b < p->blocks; b++) {
        int64_t rows = p->at[b + 1] - p->at[b], columns = p->first[b + 1] - p->first[b];
        for (int64_t c = 0; c < columns; c++) alone[b] += (double)(rows - c) * (double)(rows - c);
        work[b] += alone[b], size[b]++, sum += alone[b];
        if (columns == rows) continue;
        int32_t above = p->block[p->row[p->at[b] + columns]];
        work[above] += work[b], size[above] += size[b];
    }
    return sum;
}

/* Give subtrees to two sides, the heaviest first, each to the side that has less. The heaviest of all is replaced by
   those below its root as long as the longer side, with what is left above both, may become shorter than `best`. */
static void split(Pattern *p, const double *alone, const double *work, const int32_t *size, double best)
{
    enum { TREES = 64 };
    int32_t tree[TREES], many = 0;
    double above = 0.0;
    for (int64_t b = p->blocks - 1; b >= 0; b -= size[b]) {
        if (many == TREES) return;
        tree[many++] = (int32_t)b;
    }
    for (;;) {
        double load[2] = {0.0, 0.0};
        signed char side[TREES];
        for (int32_t i = 1; i < many; i++)
            for (int32_t j = i; j && work[tree[j]] > work[tree[j - 1]]; j--) {
                int32_t kept = tree[j];
                tree[j] = tree[j - 1], tree[j - 1] = kept;
            }
        for (int32_t i = 0; i < many; i++) side[i] = load[1] < load[0], load[(int)side[i]] += work[tree[i]];
        double longest = above + (load[0] > load[1] ? load[0] : load[1]);
        if (longest < best) {
            best = longest, p->halves = 1, memset(p->side, -1, p->blocks);
            for (int32_t i = 0; i < many; i++) memset(p->side + tree[i] + 1 - size[tree[i]], side[i], size[tree[i]]);
        }
        int32_t root = tree[0], end = root - size[root], count = 0;
        above += alone[root];
        for (int32_t b = root - 1; b > end; b -= size[b]) count++;
        if (above >= best || many - 1 + count > TREES || many - 1 + count == 0) return;
        tree[0] = tree[--many];
        for (int32_t b = root - 1; b > end; b -= size[b]) tree[many++] = b;
    }
}

/* Halve the work; a small matrix is left whole: 1, or 0 if there is no memory. */
static int halved(Pattern *p)
{
    static const double LARGE = 2e7; /* products, some milliseconds: a thread is begun fifty times sooner */
    int64_t blocks = p->blocks;
    double *alone = calloc(blocks + 1, sizeof *alone), *work = calloc(blocks + 1, sizeof *work);
    int32_t *size = calloc(blocks + 1, sizeof *size);
    p->side = malloc(blocks + 1);
    int good = alone && work && size && p->side;
    if (good) {
        memset(p->side, -1, blocks);
        double sum = weighed(p, alone, work, size);
        if (sum >= LARGE) split(p, alone, work, size, sum);
    }
    free(alone), free(work), free(size);
    return good;
}

/* The pattern of a matrix of n unknowns by the neighbours of each, beside[start[i]] to beside[start[i + 1]]: 1, or 0
   if there is no memory. */
static int pattern_found(Pattern *p, int64_t n, const int64_t *start, const int32_t *beside)
{
    memset(p, 0, sizeof *p);
    p->n = n;
    p->order = malloc((n + 1) * sizeof *p->order), p->rank = malloc((n + 1) * sizeof *p->rank);
    int32_t *parent = malloc((n + 1) * sizeof *parent), *count = malloc((n + 1) * sizeof *count);
    int good = p->order && p->rank && parent && count && ordered(n, start, beside, p->order);
    for (int64_t k = 0; good && k < n; k++) p->rank[p->order[k]] = (int32_t)k;
    good = good && rooted(p, start, beside, parent) && postordered(p, parent);
    good = good && counted(p, start, beside, parent, count) && blocked(p, parent, count) && filled_in(p, start, beside) &&
           halved(p);
    free(parent), free(count);
    if (!good) pattern_clear(p);
    return good;
}

/* Where the entry of two unknowns stands. */
static int64_t place_of(const Pattern *p, int32_t one, int32_t other)
{
    int32_t a = p->rank[one], b = p->rank[other], column = a < b ? a : b, row = a < b ? b : a, block = p->block[column];
    int64_t from = p->at[block], rows = p->at[block + 1] - from, low = 0, high = rows - 1;
    while (low < high) {
        int64_t middle = (low + high) / 2;
        if (p->row[from + middle] < row) low = middle + 1;
        else high = middle;
    }
    return p->panel[block] + (column - p->first[block]) * rows + low;
}

enum { TILE = 4, ROWS = 8, ACROSS = 8 * TILE };

/* Where loader, compiler and processor can, loops that take up most of the time run four or eight numbers at once:
   copies are made of them. Sums keep their order, so the numbers are the same. */
#if !defined(WIDE) && defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__)
#define WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#elif !defined(WIDE)
#define WIDE
#endif

/* Fetch in good time what is read 1024 numbers on, or back: a factor is larger than what the processor keeps. */
#ifdef __GNUC__
#define INLINED static inline __attribute__((always_inline))
#define FETCHED(place, way) __builtin_prefetch((const void *)((uintptr_t)(place) + (way) * 1024 * (int)sizeof(double)))
#else
#define INLINED static inline
#define FETCHED(place, way) ((void)0)
#endif

/* What is taken off from: rows `to` of the columns `column` of a full matrix, which are `ld` apart. */
typedef struct {
    double *entries;
    int64_t ld;
    const int32_t *to, *column;
} Target;

/* Take off from a target, at `rows` rows from row i and `across` columns from column j on, sums of products: of the same
   rows of w columns `at`, `ld` apart, with the numbers `by`, four for each of them. */
INLINED void tile_taken_off(const Target *target, int64_t i, int rows, int64_t j, int64_t across, const double *at,
                            int64_t ld, int64_t w, const double *by)
{
    double sum[TILE][ROWS] = {{0.0}};
    for (int64_t q = 0; q < w; q++, at += ld, by += TILE)
        for (int c = 0; c < TILE; c++)
            for (int r = 0; r < rows; r++) sum[c][r] += at[r] * by[c];
    const int32_t *to = target->to + i;
    int together = to[rows - 1] - to[0] == rows - 1;
    for (int64_t c = 0; c < across; c++) {
        double *out = target->entries + target->column[j + c] * target->ld;
        if (together)
            for (int r = 0; r < rows; r++) out[to[0] + r] -= sum[c][r];
        else
            for (int r = 0; r < rows; r++) out[to[r]] -= sum[c][r];
    }
}

/* Take off from a target the products of rows of a panel, `ld` apart, of w columns with diagonal `d` (d[q * step]): of
   all m rows with the first k, eight tiles of columns for each of rows. Entries above the diagonal are written and
   never read. */
WIDE static void taken_off(const double *panel, int64_t ld, int64_t w, const double *d, int64_t step, int64_t m, int64_t k,
                      Target target, double *scaled)
{
    if (w == 1) { /* too little for tiles */
        for (int64_t j = 0; j < k; j++) {
            double *out = target.entries + target.column[j] * target.ld, share = panel[j] * *d;
            for (int64_t i = j; i < m; i++) out[target.to[i]] -= panel[i] * share;
        }
        return;
    }
    for (int64_t from = 0; from < k; from += ACROSS) {
        int64_t end = from + ACROSS < k ? from + ACROSS : k, rows;
        for (int64_t j = from; j < end; j += TILE)
            for (int64_t q = 0; q < w; q++)
                for (int64_t c = 0; c < TILE; c++)
                    scaled[(j - from) * w + q * TILE + c] = j + c < end ? panel[q * ld + j + c] * d[q * step] : 0.0;
        for (int64_t i = from; i < m; i += rows) {
            rows = m - i >= ROWS ? ROWS : m - i >= TILE ? TILE : 1;
            for (int64_t j = from; j < end && j < i + rows; j += TILE) {
                const double *at = panel + i, *by = scaled + (j - from) * w;
                int64_t across = end - j < TILE ? end - j : TILE;
                if (rows == ROWS) tile_taken_off(&target, i, ROWS, j, across, at, ld, w, by);
                else if (rows == TILE) tile_taken_off(&target, i, TILE, j, across, at, ld, w, by);
                else tile_taken_off(&target, i, 1, j, across, at, ld, w, by);
            }
        }
    }
}

/* Factorise a full panel of `rows`, the first `columns` of which are square: its diagonal holds D, below it is L. */
WIDE static void panel_factorised(double *panel, int64_t rows, int64_t columns, const int32_t *each, double *scaled)
{
    for (int64_t j = 0; j < columns; j += TILE) {
        int64_t end = j + TILE < columns ? j + TILE : columns;
        Target target = {panel + j * rows + j, rows, each, each};
        if (j) taken_off(panel + j, rows, j, panel, rows + 1, rows - j, end - j, target, scaled);
        for (int64_t c = j; c < end; c++) {
            double *own = panel + c * rows;
            for (int64_t q = j; q < c; q++) {
                const double *left = panel + q * rows;
                double share = left[c] * left[q];
                for (int64_t r = c; r < rows; r++) own[r] -= left[r] * share;
            }
            double inverse = 1.0 / own[c];
            for (int64_t r = c + 1; r < rows; r++) own[r] *= inverse;
        }
    }
}

/* Which blocks to the left have rows among the columns of a block: a list for each block, that begins at `head` and
   goes on by `next`; `done` says from which of its rows on a block to the left is still to be taken off. */
typedef struct {
    const Pattern *p;
    double *values;
    int32_t *head, *next, *done;
} Lists;

/* Room for one thread, and the blocks of its subtrees that wait for blocks above them, in order, each with the block
   that was worked on. */
typedef struct {
    Lists lists;
    int side;
    double *scaled;
    int32_t *map, *to, *each, *waiting, now;
    int64_t waits, listed;
} Part;

static void part_free(Part *t) { free(t->scaled), free(t->map), free(t->to), free(t->each), free(t->waiting); }

static int part_new(Part *t, Lists lists, int side)
{
    const Pattern *p = lists.p;
    memset(t, 0, sizeof *t);
    t->lists = lists, t->side = side;
    t->scaled = malloc(ACROSS * (p->most + 1) * sizeof *t->scaled), t->map = malloc((p->n + 1) * sizeof *t->map);
    t->to = malloc((p->most + 1) * sizeof *t->to), t->each = malloc((p->most + 1) * sizeof *t->each);
    t->waiting = malloc(2 * (p->blocks + 1) * sizeof *t->waiting);
    if (!(t->scaled && t->map && t->to && t->each && t->waiting)) return 0;
    for (int64_t r = 0; r < p->most; r++) t->each[r] = (int32_t)r;
    return 1;
}

static void listed_next(const Lists *l, int32_t block)
{
    int32_t onwards = l->p->block[l->p->row[l->p->at[block] + l->done[block]]];
    l->next[block] = l->head[onwards], l->head[onwards] = block;
}

/* List a block for the next one that it has rows in; those above the subtrees of a side have to wait. */
static void left_to_next(Part *t, int32_t block, int64_t from)
{
    const Pattern *p = t->lists.p;
    t->lists.done[block] = (int32_t)from;
    if (p->side[p->block[p->row[p->at[block] + from]]] == t->side) listed_next(&t->lists, block);
    else t->waiting[2 * t->waits] = block, t->waiting[2 * t->waits++ + 1] = t->now;
}

static void block_factorised(Part *t, int32_t b)
{
    const Lists *l = &t->lists;
    const Pattern *p = l->p;
    const int32_t *row = p->row + p->at[b];
    int64_t rows = p->at[b + 1] - p->at[b], columns = p->first[b + 1] - p->first[b];
    double *panel = l->values + p->panel[b];
    t->now = b;
    if (l->head[b] >= 0)
        for (int64_t r = 0; r < rows; r++) t->map[row[r]] = (int32_t)r;
    for (int32_t c = l->head[b], after; c >= 0; c = after) { /* blocks to the left with rows among these columns */
        const int32_t *other = p->row + p->at[c];
        int64_t from = l->done[c], whole = p->at[c + 1] - p->at[c], end = from, width = p->first[c + 1] - p->first[c];
        after = l->next[c];
        while (end < whole && other[end] < p->first[b + 1]) end++;
        for (int64_t r = from; r < whole; r++) t->to[r - from] = t->map[other[r]];
        const double *left = l->values + p->panel[c];
        Target target = {panel, rows, t->to, t->to};
        taken_off(left + from, whole, width, left, whole + 1, whole - from, end - from, target, t->scaled);
        if (end < whole) left_to_next(t, c, end);
    }
    panel_factorised(panel, rows, columns, t->each, t->scaled);
    if (columns < rows) left_to_next(t, b, columns);
}

static void *side_factorised(void *part)
{
    Part *t = part;
    for (int32_t b = 0; b < t->lists.p->blocks; b++)
        if (t->lists.p->side[b] == t->side) block_factorised(t, b);
    return NULL;
}

/* Factorise a matrix in place, its entries where place_of says: 1, or 0 without memory. Two sides of a large one are
   worked on at once, and the blocks above them take off the others in the order in which one thread would: the numbers
   are the same. */
static int pattern_factorised(const Pattern *p, double *values)
{
    int64_t blocks = p->blocks;
    Lists l = {p, values, malloc((blocks + 1) * sizeof *l.head), malloc((blocks + 1) * sizeof *l.next),
               malloc((blocks + 1) * sizeof *l.done)};
    Part part[3];
    memset(part, 0, sizeof part);
    int good = l.head && l.next && l.done && part_new(part + 2, l, -1);
    good = good && (!p->halves || (part_new(part, l, 0) && part_new(part + 1, l, 1)));
    for (int64_t b = 0; good && b < blocks; b++) l.head[b] = -1;
    if (good && p->halves) both_at_once(side_factorised, part, part + 1);
    for (int32_t b = 0; good && b < blocks; b++) {
        if (p->side[b] < 0) {
            block_factorised(part + 2, b);
            continue;
        }
        Part *t = part + p->side[b];
        for (; t->listed < t->waits && t->waiting[2 * t->listed + 1] == b; t->listed++)
            listed_next(&l, t->waiting[2 * t->listed]);
    }
    for (int i = 0; i < 3; i++) part_free(part + i);
    free(l.head), free(l.next), free(l.done);
    return good;
}

/* Take off the columns of a panel, each as often as the unknown at its diagonal says, from all rows below that. */
WIDE static void columns_taken_off(const double *panel, int64_t rows, int64_t columns, double *below)
{
    int64_t c = 0;
    for (; c + TILE <= columns; c += TILE) { /* four at once, each number in the order of the columns */
        const double *p0 = panel + c * rows, *p1 = p0 + rows, *p2 = p1 + rows, *p3 = p2 + rows;
        for (int64_t i = 0; i < TILE * rows; i += 8) FETCHED(p0 + i, 1);
        double v0 = below[c], v1 = below[c + 1] - p0[c + 1] * v0;
        double v2 = below[c + 2] - p0[c + 2] * v0 - p1[c + 2] * v1;
        double v3 = below[c + 3] - p0[c + 3] * v0 - p1[c + 3] * v1 - p2[c + 3] * v2;
        below[c + 1] = v1, below[c + 2] = v2, below[c + 3] = v3;
        for (int64_t r = c + TILE; r < rows; r++)
            below[r] = below[r] - p0[r] * v0 - p1[r] * v1 - p2[r] * v2 - p3[r] * v3;
    }
    for (; c < columns; c++) {
        const double *own = panel + c * rows;
        double value = below[c];
        for (int64_t r = c + 1; r < rows; r++) below[r] -= own[r] * value;
    }
}

/* Solve with the columns of a panel, the last first: unknowns below its columns are known. */
static void columns_solved(const double *panel, int64_t rows, int64_t columns, double *below)
{
    for (int64_t c = columns - 1; c >= 0; c--) {
        const double *own = panel + c * rows;
        double sums[TILE] = {0.0}, value = below[c] / own[c];
        int64_t r = c + 1;
        for (; r + TILE <= rows; r += TILE) {
            FETCHED(own + r, -1);
            for (int t = 0; t < TILE; t++) sums[t] += own[r + t] * below[r + t];
        }
        for (; r < rows; r++) value -= own[r] * below[r];
        below[c] = value - ((sums[0] + sums[1]) + (sums[2] + sums[3]));
    }
}

/* Solve with the factor, x in the order of elimination, in place; `below` has room for the rows of a block. */
static void pattern_solved(const Pattern *p, const double *values, double *x, double *below)
{
    for (int64_t b = 0; b < p->blocks; b++) {
        int64_t rows = p->at[b + 1] - p->at[b], columns = p->first[b + 1] - p->first[b];
        const double *panel = values + p->panel[b];
        const int32_t *row = p->row + p->at[b];
        double *own = x + p->first[b];
        if (columns == 1) {
            for (int64_t r = 1; r < rows; r++) x[row[r]] -= panel[r] * own[0];
            continue;
        }
        for (int64_t r = 0; r < rows; r++) below[r] = r < columns ? own[r] : 0.0;
        columns_taken_off(panel, rows, columns, below);
        for (int64_t r = 0; r < columns; r++) own[r] = below[r];
        for (int64_t r = columns; r < rows; r++) x[row[r]] += below[r];
    }
    for (int64_t b = p->blocks - 1; b >= 0; b--) {
        int64_t rows = p->at[b + 1] - p->at[b], columns = p->first[b + 1] - p->first[b];
        const double *panel = values + p->panel[b];
        const int32_t *row = p->row + p->at[b];
        double *own = x + p->first[b];
        if (columns == 1) {
            double value = own[0] / panel[0];
            for (int64_t r = 1; r < rows; r++) value -= panel[r] * x[row[r]];
            own[0] = value;
            continue;
        }
        for (int64_t r = 0; r < columns; r++) below[r] = own[r];
        for (int64_t r = columns; r < rows; r++) below[r] = x[row[r]];
        columns_solved(panel, rows, columns, below);
        for (int64_t r = 0; r < columns; r++) own[r] = below[r];
    }
}
