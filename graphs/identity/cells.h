/* Ordered cells of the vertices of a graph, and their refinement: what the search of leaves.c does at each level.

A cell is named by its place, the number of vertices in the cells before it. Splits are kept in their order, so that all
can be undone. */

#ifndef SYNTHEDRA_CELLS_H
#define SYNTHEDRA_CELLS_H

#include <setjmp.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Entries of certificates are compared as one number: the kind first, splits before edges, then two places. */
enum { SPLIT = 0, EDGE = 1 };
typedef uint64_t Entry;

/* A block of memory in the list of all: what is left of a search that ends early is released with it. */
typedef struct Block {
    struct Block *before, *after;
} Block;

typedef struct {
    int n;
    int *first, *near, *colour; /* the neighbours of each vertex, one after the other; colours may be NULL: all alike */
    /* The vertices by place, and the position of each among them; where the cell of each vertex begins, and the size of
       the cell that begins at each place. */
    int *elements, *position, *place, *size, cells;
    /* A ring of the places of the cells by which the others are still to be refined. */
    int *queue, head, waiting;
    char *waits;
    /* The splits: from which cell, to which new place. */
    int *parent, *part, splits;
    /* The vertices that were singled out, one on each level, and where the entries of each level begin. */
    int *path, depth, recorded;
    char *on_path;
    Entry *certificate;
    int64_t *level, length, room;
    /* Work space; `number`, `hit`, `seen`, `around` are zero between calls. */
    int *number, *hit, *touched, *splitter, *seen, *around, *met;
    int64_t *key;
    Block blocks;
    jmp_buf no_memory;
} Cells;

/* To where splits, levels and entries are undone. */
typedef struct {
    int splits, depth;
    int64_t length;
} Mark;

/* Memory ---------------------------------------------------------------------------------------- */

static void *allocated(Cells *c, int64_t bytes)
{
    Block *block = bytes >= 0 && (uint64_t)bytes < SIZE_MAX - sizeof *block ? malloc(sizeof *block + bytes) : NULL;
    if (!block) longjmp(c->no_memory, 1);
    block->before = &c->blocks, block->after = c->blocks.after;
    if (block->after) block->after->before = block;
    c->blocks.after = block;
    return block + 1;
}

static void release(void *memory)
{
    if (!memory) return;
    Block *block = (Block *)memory - 1;
    block->before->after = block->after;
    if (block->after) block->after->before = block->before;
    free(block);
}

static void *zeros(Cells *c, int64_t bytes)
{
    return memset(allocated(c, bytes), 0, bytes);
}

static void *copied(Cells *c, const void *from, int64_t bytes)
{
    void *copy = allocated(c, bytes);
    return bytes ? memcpy(copy, from, bytes) : copy;
}

/* Return room for one more than `used`, twice as much as before where there is none. */
static void *grown(Cells *c, void *memory, int64_t used, int64_t more, int64_t *room, int64_t width)
{
    if (used + more <= *room) return memory;
    *room = 2 * (used + more);
    void *larger = allocated(c, *room * width);
    if (used) memcpy(larger, memory, used * width);
    release(memory);
    return larger;
}

static void free_all(Cells *c)
{
    while (c->blocks.after) release(c->blocks.after + 1);
}

/* Sorting: shell sort, since most lists are short. ----------------------------------------------- */

static void sort_numbers(int *items, int count)
{
    for (int gap = count < 16 ? 1 : count / 2; gap; gap = gap == 2 ? 1 : gap * 5 / 11)
        for (int i = gap; i < count; i++) {
            int item = items[i], j = i;
            for (; j >= gap && items[j - gap] > item; j -= gap) items[j] = items[j - gap];
            items[j] = item;
        }
}

static void sort_by_key(int *items, const int64_t *key, int count)
{
    for (int gap = count < 16 ? 1 : count / 2; gap; gap = gap == 2 ? 1 : gap * 5 / 11)
        for (int i = gap; i < count; i++) {
            int item = items[i], j = i;
            for (; j >= gap && key[items[j - gap]] > key[item]; j -= gap) items[j] = items[j - gap];
            items[j] = item;
        }
}

/* Cells ------------------------------------------------------------------------------------------ */

/* Let a cell wait: before all others if it is one vertex, else behind them. */
static void enqueue(Cells *c, int place, int size)
{
    if (size == 1) {
        c->head = c->head ? c->head - 1 : c->n - 1;
        c->queue[c->head] = place;
    } else {
        int at = c->head + c->waiting;
        c->queue[at < c->n ? at : at - c->n] = place;
    }
    c->waiting++;
    c->waits[place] = 1;
}

static void forget_waiting(Cells *c)
{
    for (; c->waiting; c->waiting--) {
        c->waits[c->queue[c->head]] = 0;
        c->head = c->head + 1 < c->n ? c->head + 1 : 0;
    }
}

static void swap(Cells *c, int vertex, int at)
{
    int other = c->elements[at], from = c->position[vertex];
    c->elements[at] = vertex, c->position[vertex] = at;
    c->elements[from] = other, c->position[other] = from;
}

/* Let the vertices from one place to another be a cell, parted from the cell at `from`. */
static void part_off(Cells *c, int from, int place, int end)
{
    for (int i = place; i < end; i++) c->place[c->elements[i]] = place;
    c->size[place] = end - place;
    c->parent[c->splits] = from, c->part[c->splits] = place;
    c->splits++, c->cells++;
}

/* Undo splits, levels and entries. Which vertices a cell holds is as before, their order within it is not. */
static void undo(Cells *c, Mark mark)
{
    while (c->splits > mark.splits) {
        int from = c->parent[--c->splits], place = c->part[c->splits];
        for (int i = place; i < place + c->size[place]; i++) c->place[c->elements[i]] = from;
        c->size[from] += c->size[place];
        c->cells--;
    }
    while (c->depth > mark.depth) c->on_path[c->path[--c->depth]] = 0;
    c->length = mark.length;
}

static Mark mark_here(const Cells *c)
{
    return (Mark){c->splits, c->depth, c->length};
}

/* Give a vertex a cell of its own, behind the others of its cell; what is one vertex now waits. */
static void single_out(Cells *c, int vertex)
{
    int place = c->place[vertex], last = place + c->size[place] - 1;
    swap(c, vertex, last);
    c->size[place]--;
    part_off(c, place, last, last + 1);
    if (c->size[place] == 1) enqueue(c, place, 1);
    enqueue(c, last, 1);
}

/* Let the parts of a cell wait that was split: `first` is the first new one, `most` the greatest number. */
static void parts_wait(Cells *c, int place, int first, int end, int most)
{
    if (c->waits[place]) {
        /* For bliss, a new cell still holds the vertices behind it. */
        for (int p = first; p < end; p += c->size[p]) enqueue(c, p, end - p);
        return;
    }
    /* All wait but the largest, which waits only if it is one vertex: then its edges belong to the certificate. */
    int largest = place;
    for (int p = first; p < end; p += c->size[p]) {
        int size = c->size[p], other = c->size[largest];
        if (size > other || (size == other && most == 1)) { /* of numbers 0 and 1, the first of equals waits */
            enqueue(c, largest, other);
            largest = p;
        } else {
            enqueue(c, p, size);
        }
    }
    if (c->size[largest] == 1) enqueue(c, largest, 1);
}

/* Split a cell by the numbers of its vertices, lowest first; those that have any, `hit` of them, stand behind the
   others. Return where the last part begins. */
static int split(Cells *c, int place)
{
    int count = c->size[place], end = place + count, hit = c->hit[place], *at = c->elements + end - hit;
    int equal = 1, last = place;
    for (int i = 1; i < hit && equal; i++) equal = c->number[at[i]] == c->number[at[0]];
    if (equal && hit == count) return place;
    if (!equal) {
        for (int i = 0; i < hit; i++) c->key[at[i]] = c->number[at[i]];
        sort_by_key(at, c->key, hit);
        for (int i = end - hit; i < end; i++) c->position[c->elements[i]] = i;
    }
    int first = -1, most = c->number[c->elements[end - 1]];
    for (int p = end - hit > place ? end - hit : place, q; p < end; p = q) {
        int number = c->number[c->elements[p]];
        for (q = p + 1; q < end && c->number[c->elements[q]] == number; q++) {}
        if (p == place) continue; /* the first part keeps the place */
        if (first < 0) first = p, c->size[place] = p - place;
        part_off(c, place, p, q);
        last = p;
    }
    parts_wait(c, place, first, end, most);
    return last;
}

/* Refining ---------------------------------------------------------------------------------------- */

/* What a level of another path met, to be compared entry by entry: `order` is 0 as long as all are equal, -1 if what is
   met is less, 1 if it is greater, or there is nothing to compare with. */
typedef struct {
    const Entry *next, *end;
    int order;
} Comparison;

static const Comparison NONE = {NULL, NULL, 1};

static void record(Cells *c, Comparison *with, uint64_t kind, int a, int b)
{
    if (!c->recorded) return;
    Entry entry = kind << 62 | (uint64_t)a << 31 | (uint64_t)b;
    c->certificate = grown(c, c->certificate, c->length, 1, &c->room, sizeof entry);
    c->certificate[c->length++] = entry;
    if (with->order) return;
    if (with->next == with->end || entry > *with->next) with->order = 1;
    else if (entry < *with->next) with->order = -1;
    else with->next++;
}

/* Count the neighbours in a cell of all vertices, move those that have any behind the others of their cells, and
   return how many cells have such, sorted. */
static int touch(Cells *c, int place)
{
    int touched = 0, size = c->size[place];
    memcpy(c->splitter, c->elements + place, size * sizeof *c->splitter);
    for (int i = 0; i < size; i++)
        for (int k = c->first[c->splitter[i]]; k < c->first[c->splitter[i] + 1]; k++) {
            int vertex = c->near[k], cell = c->place[vertex];
            if (c->number[vertex]++) continue;
            if (!c->hit[cell]) c->touched[touched++] = cell;
            swap(c, vertex, cell + c->size[cell] - ++c->hit[cell]);
        }
    sort_numbers(c->touched, touched);
    return touched;
}

/* Split one touched cell, and record what is met. */
static void split_and_record(Cells *c, int place, int single, int splitter, Comparison *with)
{
    int end = place + c->size[place];
    if (single) {
        /* The neighbours of a vertex come last in their cell: these edges have their final numbers. */
        int last = split(c, place);
        for (int i = last; i < end; i++) record(c, with, EDGE, splitter, i);
    } else if (end - place > 1) {
        split(c, place);
        for (int p = place; p < end; p += c->size[p]) record(c, with, SPLIT, p, c->size[p]);
    }
}

/* Split cells until the vertices of each have equally many neighbours in any other, or until what is met is less than
   what it is compared with; return the order of the two. */
static int refine(Cells *c, Comparison with)
{
    while (c->waiting && with.order >= 0 && (c->recorded || c->cells < c->n)) {
        int splitter = c->queue[c->head], single = c->size[splitter] == 1;
        c->head = c->head + 1 < c->n ? c->head + 1 : 0;
        c->waiting--;
        c->waits[splitter] = 0;
        int vertices = c->size[splitter], touched = touch(c, splitter);
        for (int i = 0; i < touched; i++) {
            if (with.order >= 0) split_and_record(c, c->touched[i], single, splitter, &with);
            c->hit[c->touched[i]] = 0;
        }
        for (int i = 0; i < vertices; i++)
            for (int k = c->first[c->splitter[i]]; k < c->first[c->splitter[i] + 1]; k++) c->number[c->near[k]] = 0;
    }
    forget_waiting(c);
    return with.order == 0 && with.next < with.end ? -1 : with.order;
}

/* Single a vertex out and refine, as one level more. */
static int descend(Cells *c, int vertex, Comparison with)
{
    c->path[c->depth] = vertex, c->on_path[vertex] = 1;
    c->depth++;
    single_out(c, vertex);
    int order = refine(c, with);
    c->level[c->depth] = c->length;
    return order;
}

/* Put vertices of equal colour and degree into one cell, and refine. */
static void start(Cells *c)
{
    for (int v = 0; v < c->n; v++) {
        c->elements[v] = v;
        c->key[v] = (int64_t)(c->colour ? c->colour[v] : 0) * ((int64_t)1 << 31) + (c->first[v + 1] - c->first[v]);
    }
    sort_by_key(c->elements, c->key, c->n);
    c->cells = c->splits = c->depth = c->head = c->waiting = 0;
    c->length = 0;
    for (int p = 0, q; p < c->n; p = q) {
        for (q = p; q < c->n && c->key[c->elements[q]] == c->key[c->elements[p]]; q++) {
            c->position[c->elements[q]] = q;
            c->place[c->elements[q]] = p;
        }
        c->size[p] = q - p;
        c->cells++;
        enqueue(c, p, q - p);
    }
    refine(c, NONE);
    c->length = 0;
    c->level[0] = 0;
}

/* Components -------------------------------------------------------------------------------------- */

/* Return the place of the cell to split next in a region, that with most neighbour cells, -1 if all are single, and
   the places of the cells of its component in `met`. The component is that of the first cell of two vertices or more;
   cells belong together where their vertices are neighbours of some, not all, vertices of the other. */
static int component_of(Cells *c, const int *region, int count, int *cells)
{
    int first = c->n, chosen = -1, most = -1, met = 0;
    for (int i = 0; i < count && c->cells < c->n; i++) {
        int place = c->place[region[i]];
        if (place < first && c->size[place] > 1) first = place;
    }
    if (first == c->n) return -1;
    c->met[met++] = first, c->seen[first] = 1;
    for (int i = 0; i < met; i++) {
        int place = c->met[i], vertex = c->elements[place], beside = 0;
        for (int k = c->first[vertex]; k < c->first[vertex + 1]; k++) c->around[c->place[c->near[k]]]++;
        for (int k = c->first[vertex]; k < c->first[vertex + 1]; k++) {
            int other = c->place[c->near[k]], number = c->around[other];
            c->around[other] = 0;
            if (!number || number == c->size[other]) continue;
            beside++;
            if (!c->seen[other]) c->met[met++] = other, c->seen[other] = 1;
        }
        if (beside > most || (beside == most && place < chosen)) chosen = place, most = beside;
    }
    for (int i = 0; i < met; i++) c->seen[c->met[i]] = 0;
    *cells = met;
    return chosen;
}

/* Write the vertices of cells one after the other; return how many. */
static int vertices_of(const Cells *c, const int *places, int cells, int *vertices)
{
    int count = 0;
    for (int i = 0; i < cells; i++) {
        memcpy(vertices + count, c->elements + places[i], c->size[places[i]] * sizeof *vertices);
        count += c->size[places[i]];
    }
    return count;
}

/* Say whether a cell that is a component by itself is complete or empty: then all its permutations are symmetries. */
static int all_alike(const Cells *c, int place)
{
    int vertex = c->elements[place], inside = 0;
    for (int k = c->first[vertex]; k < c->first[vertex + 1]; k++) inside += c->place[c->near[k]] == place;
    return inside == 0 || inside == c->size[place] - 1;
}

/* Graphs in ------------------------------------------------------------------------------------ */

static void make_room(Cells *c, int n, int64_t edges)
{
    int **numbers[] = {&c->elements, &c->position, &c->place, &c->size, &c->queue, &c->parent, &c->part, &c->path,
                       &c->number, &c->touched, &c->splitter, &c->hit, &c->seen, &c->met, &c->around};
    c->n = n;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) *numbers[i] = zeros(c, (n + 1) * sizeof(int));
    c->first = zeros(c, (n + 2) * sizeof(int));
    c->near = zeros(c, (2 * edges + 1) * sizeof(int));
    c->waits = zeros(c, n + 1);
    c->on_path = zeros(c, n + 1);
    c->key = zeros(c, (n + 1) * sizeof *c->key);
    c->level = zeros(c, (n + 2) * sizeof *c->level);
}

/* Take a graph in: the neighbours of each vertex, one after the other. */
static void take_edges(Cells *c, const int64_t *edges, int64_t count)
{
    memset(c->first, 0, (c->n + 2) * sizeof *c->first);
    for (int64_t k = 0; k < 2 * count; k++) c->first[edges[k] + 2]++;
    for (int v = 0; v < c->n; v++) c->first[v + 2] += c->first[v + 1];
    for (int64_t k = 0; k < 2 * count; k++) c->near[c->first[edges[k] + 1]++] = (int)edges[k ^ 1];
}

#endif
