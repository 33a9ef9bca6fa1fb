/* Canonical numbers and symmetries of coloured graphs: the search of leaves.py beside it, which says what all this
means, and returns the same, number for number, where no compiler was at hand.

Plain C, without Python's API: arrays go in and out, and nothing is kept between calls. The search keeps a stack of its
own, so that graphs of any depth fit, and undoes splits instead of copying cells. Theory: docs/theory/chains.md. */

#include "cells.h"

#ifdef _WIN32
#define EXPORTED __declspec(dllexport)
#else
#define EXPORTED __attribute__((visibility("default")))
#endif

/* As leaves.py has it. */
enum { LOOKED_AT = 4 };

/* A leaf: what each level met from the root on, the vertex that each level singled out, the place of every vertex.
   `equal`: its levels are those of the bound that it was searched with. */
typedef struct {
    Entry *certificate;
    int64_t *level;
    int *path, *place, depth, equal;
    double size;
} Leaf;

/* One step of the search: the greatest leaf of a region (chosen < 0), or of one component of it, whose chosen cell is
   split. `resumed`: the step above it on the stack has ended. */
typedef struct {
    int chosen, resumed;
    const Leaf *bound;
    Mark mark;
    int *vertices, count;
    /* Of a region: where its component of now begins; were there others before, is it the last. */
    Mark component;
    int several, last;
    double size;
    /* Of a component: the members of its cell, their orbits, whether all are alike; the next to be singled out, the one
       of the best leaf, whether the level of the last equals the bound; up to where generators were seen, and which of
       them are older than the step. */
    int *members, *orbit, many, alike, next, origin, equal;
    int64_t absorbed, known;
    Leaf *best;
} Step;

/* A generator of the symmetries is the vertices that it moves, each with its image: `generator` says where those of
   each begin among the `moves`. */
typedef struct {
    Cells c;
    Step *steps;
    int64_t step_count, step_room;
    Leaf *returned;
    int64_t *generator, generators, generator_room;
    int *moves;
    int64_t move_room;
} Search;

/* Symmetries -------------------------------------------------------------------------------------- */

static void move(Search *s, int vertex, int image)
{
    int64_t used = s->generator[s->generators];
    s->moves = grown(&s->c, s->moves, used, 2, &s->move_room, sizeof *s->moves);
    s->moves[used] = vertex, s->moves[used + 1] = image;
    s->generator[s->generators] = used + 2;
}

/* Begin a new generator; `move` then says what it moves. */
static void begin_generator(Search *s)
{
    int64_t begin = s->generators ? s->generator[s->generators] : 0;
    s->generator = grown(&s->c, s->generator, s->generators ? s->generators + 1 : 0, 2, &s->generator_room,
                         sizeof *s->generator);
    s->generator[s->generators] = s->generator[s->generators + 1] = begin;
    s->generators++;
}

/* Add the symmetry that takes each vertex of a component to that with the same place in another leaf. */
static void exchange(Search *s, const Step *step, const Leaf *leaf)
{
    begin_generator(s);
    for (int i = 0; i < step->count; i++) s->c.met[leaf->place[step->vertices[i]]] = step->vertices[i];
    for (int i = 0; i < step->count; i++) {
        int vertex = step->vertices[i], image = s->c.met[step->best->place[vertex]];
        if (image != vertex) move(s, vertex, image);
    }
}

static int orbit_of(int *orbit, int i)
{
    while (orbit[i] != i) i = orbit[i] = orbit[orbit[i]];
    return i;
}

static int index_of(const int *members, int count, int vertex)
{
    int low = 0;
    while (count > 1) {
        int half = count / 2;
        if (members[low + half] <= vertex) low += half, count -= half;
        else count = half;
    }
    return members[low] == vertex ? low : -1;
}

/* Join the orbits of the members of a cell by the generators that were found since; each orbit is known by its first.
   Of those found before the step began, those count that leave in place all that was singled out. */
static void absorb(Search *s, Step *step)
{
    for (; step->absorbed < s->generators; step->absorbed++) {
        int64_t begin = s->generator[step->absorbed], end = s->generator[step->absorbed + 1];
        int kept = 1;
        if (step->absorbed < step->known)
            for (int64_t k = begin; kept && k < end; k += 2) kept = !s->c.on_path[s->moves[k]];
        for (int64_t k = begin; kept && k < end; k += 2) {
            int i = index_of(step->members, step->many, s->moves[k]);
            if (i < 0) continue;
            i = orbit_of(step->orbit, i);
            int j = orbit_of(step->orbit, index_of(step->members, step->many, s->moves[k + 1]));
            step->orbit[i > j ? i : j] = i < j ? i : j;
        }
    }
}

/* Return whether a member is the first of its orbit. Most steps end with their first member, which always is: orbits
   are made, and members sorted, when there is a second. */
static int is_first(Search *s, Step *step, int i)
{
    if (i == 0) {
        for (int k = 1, least; k < step->many; k++)
            if ((least = step->members[k]) < step->members[0]) step->members[k] = step->members[0], step->members[0] = least;
        return 1;
    }
    if (!step->orbit) {
        sort_numbers(step->members, step->many);
        step->orbit = allocated(&s->c, step->many * sizeof *step->orbit);
        for (int k = 0; k < step->many; k++) step->orbit[k] = k;
    }
    absorb(s, step);
    return orbit_of(step->orbit, i) == i;
}

/* The search -------------------------------------------------------------------------------------- */

static Leaf *leaf_here(Search *s)
{
    Leaf *leaf = allocated(&s->c, sizeof *leaf);
    leaf->certificate = copied(&s->c, s->c.certificate, s->c.length * sizeof *s->c.certificate);
    leaf->level = copied(&s->c, s->c.level, (s->c.depth + 1) * sizeof *s->c.level);
    leaf->path = copied(&s->c, s->c.path, s->c.depth * sizeof *s->c.path);
    leaf->place = copied(&s->c, s->c.place, s->c.n * sizeof *s->c.place);
    leaf->depth = s->c.depth;
    return leaf;
}

static void free_leaf(Leaf *leaf)
{
    if (!leaf) return;
    release(leaf->certificate), release(leaf->level), release(leaf->path), release(leaf->place);
    release(leaf);
}

static Step *push(Search *s, int chosen, const Leaf *bound)
{
    s->steps = grown(&s->c, s->steps, s->step_count, 1, &s->step_room, sizeof *s->steps);
    Step *step = s->steps + s->step_count++;
    memset(step, 0, sizeof *step);
    step->chosen = chosen, step->bound = bound, step->mark = mark_here(&s->c);
    return step;
}

static void push_region(Search *s, int *vertices, int count, const Leaf *bound)
{
    Step *step = push(s, -1, bound);
    step->vertices = vertices, step->count = count, step->size = 1.0;
}

static void push_component(Search *s, int chosen, int cells, const Leaf *bound)
{
    Step *step = push(s, chosen, bound);
    int count = 0;
    for (int i = 0; i < cells; i++) count += s->c.size[s->c.met[i]];
    step->vertices = allocated(&s->c, count * sizeof *step->vertices);
    step->count = vertices_of(&s->c, s->c.met, cells, step->vertices);
    step->many = s->c.size[chosen];
    step->members = copied(&s->c, s->c.elements + chosen, step->many * sizeof *step->members);
    step->alike = step->many == count && all_alike(&s->c, chosen);
    step->known = s->generators;
}

/* End the last step with a leaf, or NULL: all leaves were less than its bound. */
static void end(Search *s, Leaf *leaf, double size, int equal)
{
    Step *step = s->steps + --s->step_count;
    if (step->chosen >= 0) release(step->vertices), release(step->members), release(step->orbit);
    if (leaf) leaf->size = size, leaf->equal = equal;
    s->returned = leaf;
}

/* Take in the greatest leaf of a component of a region; return whether the step has ended. */
static int take_component(Search *s, Step *step)
{
    Leaf *part = s->returned;
    step->resumed = 0;
    if (!part) {
        end(s, NULL, 0.0, 0);
        return 1;
    }
    if (step->bound && !part->equal) {
        step->bound = NULL;
        if (step->several) {
            /* Greater than the bound. Where earlier components equalled it, their symmetries are not known. */
            free_leaf(part);
            undo(&s->c, step->mark);
            step->several = 0, step->size = 1.0;
            return 0;
        }
    }
    step->size *= part->size;
    if (step->last) {
        end(s, part, step->size, step->bound != NULL);
        return 1;
    }
    undo(&s->c, step->component);
    for (int d = s->c.depth; d < part->depth; d++) descend(&s->c, part->path[d], NONE);
    free_leaf(part);
    step->several = 1;
    return 0;
}

/* Search a region, component after component. */
static void search_region(Search *s, Step *step)
{
    if (step->resumed && take_component(s, step)) return;
    int cells, chosen = component_of(&s->c, step->vertices, step->count, &cells);
    if (chosen < 0) {
        end(s, leaf_here(s), step->size, step->bound != NULL);
        return;
    }
    int left = 0;
    for (int i = 0; i < step->count; i++) left += s->c.size[s->c.place[step->vertices[i]]] > 1;
    for (int i = 0; i < cells; i++) left -= s->c.size[s->c.met[i]];
    step->last = left == 0;
    step->component = mark_here(&s->c);
    step->resumed = 1;
    push_component(s, chosen, cells, step->bound);
}

/* Take in the greatest leaf below a member of the cell that is split; return whether the step has ended. */
static int take_leaf(Search *s, Step *step)
{
    Leaf *leaf = s->returned;
    step->resumed = 0;
    undo(&s->c, step->mark);
    if (!leaf) return 0;
    if (step->equal && leaf->equal) {
        if (!step->best) {
            end(s, leaf, leaf->size, 1);
            return 1;
        }
        exchange(s, step, leaf);
        free_leaf(leaf);
    } else {
        free_leaf(step->best);
        step->best = leaf, step->origin = step->next - 1;
    }
    if (!step->alike) return 0;
    /* Those of the others were found below. */
    begin_generator(s);
    sort_numbers(step->members, step->many);
    move(s, step->members[0], step->members[1]), move(s, step->members[1], step->members[0]);
    end(s, step->best, step->best->size * step->many, 0);
    return 1;
}

/* A level of a leaf to compare with; of no leaf, none. */
static Comparison level_of(const Leaf *leaf, int depth)
{
    if (!leaf) return NONE;
    return (Comparison){leaf->certificate + leaf->level[depth], leaf->certificate + leaf->level[depth + 1], 0};
}

/* Before the search below a member whose level is greater than those before, look for one that is greater still, until
   some in a row are as great: what is found below a member counts for nothing once there is a greater one. */
static void look_on(Search *s, Step *step)
{
    Entry *kept = NULL;
    int64_t count = 0;
    int equal = 0, order = 1;
    for (int i = step->next; i <= step->many && equal < LOOKED_AT; i++) {
        if (order > 0) {
            step->next = i;
            release(kept);
            count = s->c.length - step->mark.length;
            kept = copied(&s->c, s->c.certificate + step->mark.length, count * sizeof *kept);
            equal = 0;
        }
        order = -1;
        undo(&s->c, step->mark);
        if (i == step->many || !is_first(s, step, i)) continue;
        order = descend(&s->c, step->members[i], (Comparison){kept, kept + count, 0});
        equal += order == 0;
    }
    release(kept);
    undo(&s->c, step->mark);
    descend(&s->c, step->members[step->next - 1], NONE);
}

/* Search a component: each vertex of a cell is singled out in turn, but those that symmetries exchange with one before
   (they have equal leaves). A leaf that equals the greatest up to now gives a symmetry. */
static void search_component(Search *s, Step *step)
{
    if (step->resumed && take_leaf(s, step)) return;
    const Leaf *bound = step->best ? step->best : step->bound;
    while (step->next < (step->alike ? 1 : step->many)) {
        int i = step->next++;
        if (!is_first(s, step, i)) continue;
        int order = descend(&s->c, step->members[i], level_of(bound, step->mark.depth));
        if (order < 0) {
            undo(&s->c, step->mark);
            continue;
        }
        if (order > 0 && !step->alike && s->c.cells < s->c.n) look_on(s, step);
        step->equal = order == 0;
        step->resumed = 1;
        push_region(s, step->vertices, step->count, step->equal ? bound : NULL);
        return;
    }
    if (!step->best) {
        end(s, NULL, 0.0, 0);
        return;
    }
    /* Orbit-stabiliser: each symmetry takes the vertex to one of its orbit, those below leave it in place. */
    absorb(s, step);
    int orbit = 0;
    for (int i = 0; i < step->many; i++) orbit += orbit_of(step->orbit, i) == orbit_of(step->orbit, step->origin);
    end(s, step->best, step->best->size * orbit, 0);
}

static Leaf *searched(Search *s)
{
    int *all = allocated(&s->c, s->c.n * sizeof *all);
    memcpy(all, s->c.elements, s->c.n * sizeof *all);
    push_region(s, all, s->c.n, NULL);
    while (s->step_count) {
        Step *step = s->steps + s->step_count - 1;
        if (step->chosen < 0) search_region(s, step);
        else search_component(s, step);
    }
    release(all);
    return s->returned;
}

/* Follow one path to a leaf; return whether all leaves are images of it. That is so if each cell that is split is one
   orbit of the symmetries that are left: then the sizes of these cells multiply to the number of automorphisms
   (orbit-stabiliser); otherwise the product is greater. `regions`, int[n + 1][n], and their sizes are work space. */
static int one_path_is_enough(Search *s, int64_t automorphisms, int *regions, int *sizes)
{
    int depth = 0, cells;
    double choices = 1.0;
    memcpy(regions, s->c.elements, s->c.n * sizeof *regions);
    sizes[0] = s->c.n;
    while (s->c.cells < s->c.n) {
        int chosen = component_of(&s->c, regions + (int64_t)depth * s->c.n, sizes[depth], &cells);
        if (chosen < 0) {
            depth--;
            continue;
        }
        choices *= s->c.size[chosen];
        if (choices > (double)automorphisms) return 0;
        depth++;
        sizes[depth] = vertices_of(&s->c, s->c.met, cells, regions + (int64_t)depth * s->c.n);
        int least = s->c.elements[chosen];
        for (int i = chosen; i < chosen + s->c.size[chosen]; i++)
            if (s->c.elements[i] < least) least = s->c.elements[i];
        descend(&s->c, least, NONE);
    }
    return choices == (double)automorphisms;
}

/* Graphs in, numbers out ------------------------------------------------------------------------- */

static void search_graph(Search *s, int64_t n, int64_t count, const int64_t *edges, const int32_t *colours)
{
    make_room(&s->c, (int)n, count);
    take_edges(&s->c, edges, count);
    s->c.colour = colours ? (int *)copied(&s->c, colours, n * sizeof(int)) : NULL;
    s->c.recorded = 1;
    start(&s->c);
    s->returned = searched(s);
}

/* Write the generators, as rows of n images. Return NULL if there is no memory for it. */
static int64_t *rows_of_generators(const Search *s, int64_t n)
{
    int64_t *rows = malloc((s->generators * n + 1) * sizeof *rows);
    for (int64_t g = 0; rows && g < s->generators; g++) {
        for (int v = 0; v < n; v++) rows[g * n + v] = v;
        for (int64_t k = s->generator[g]; k < s->generator[g + 1]; k += 2) rows[g * n + s->moves[k]] = s->moves[k + 1];
    }
    return rows;
}

/* Search a graph. Edges are int64[count, 2], colours int32[n] or NULL. Written are the numbers of the vertices, int64[n],
   the number of automorphisms, and how many generators there are; these, int64[generators, n], are at `found`, to be
   freed by `leaves_free`. Return 0 if there is no memory for it. */
EXPORTED int leaves_of_graph(int64_t n, int64_t count, const int64_t *edges, const int32_t *colours, int64_t *numbers,
                             double *size, int64_t *generators, int64_t **found)
{
    Search *s = calloc(1, sizeof *s);
    *found = NULL;
    if (s && !setjmp(s->c.no_memory)) {
        search_graph(s, n, count, edges, colours);
        for (int v = 0; v < n; v++) numbers[v] = s->returned->place[v];
        *size = s->returned->size, *generators = s->generators;
        *found = rows_of_generators(s, n);
    }
    if (s) free_all(&s->c);
    free(s);
    return *found != NULL;
}

EXPORTED void leaves_free(int64_t *found)
{
    free(found);
}

/* Number the vertices of a graph; `regions` and `sizes` are work space (`one_path_is_enough`). */
static void number_graph(Search *s, int64_t automorphisms, int *regions, int *sizes, int64_t *numbers)
{
    Cells *c = &s->c;
    Leaf *leaf = NULL;
    c->recorded = 0; /* nothing is compared */
    start(c);
    if (!one_path_is_enough(s, automorphisms, regions, sizes)) {
        undo(c, (Mark){0, 0, 0});
        c->recorded = 1;
        start(c);
        leaf = searched(s);
        s->generators = 0;
    }
    for (int v = 0; v < c->n; v++) numbers[v] = leaf ? leaf->place[v] : c->place[v];
    free_leaf(leaf);
    undo(c, (Mark){0, 0, 0});
}

/* Number many graphs of one size: joints are int64[rows, count, 2], the numbers of automorphisms int64[rows], 1 where
   they are not known. Written are the numbers of the vertices, int64[rows, n]. Return 0 if there is no memory for it. */
EXPORTED int leaves_of_rows(int64_t n, int64_t count, int64_t rows, const int64_t *joints, const int64_t *automorphisms,
                            int64_t *numbers)
{
    Search *s = calloc(1, sizeof *s);
    volatile int done = 0;
    if (s && !setjmp(s->c.no_memory)) {
        make_room(&s->c, (int)n, count);
        int *regions = allocated(&s->c, (n + 1) * (n + 1) * sizeof *regions);
        int *sizes = allocated(&s->c, (n + 1) * sizeof *sizes);
        for (int64_t r = 0; r < rows; r++) {
            take_edges(&s->c, joints + 2 * count * r, count);
            number_graph(s, automorphisms[r], regions, sizes, numbers + n * r);
        }
        done = 1;
    }
    if (s) free_all(&s->c);
    free(s);
    return done;
}
