/* Layers of panels: what follows from some orders, and how many orders there are. `synth.analysis.layering.counting.problem` does the
 * same in Python. Literals are 2 v and 2 v + 1 (the opposite); all arrays are owned by the caller.
 */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#if defined(_WIN32)
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

typedef unsigned __int128 wide;

enum { UNKNOWN = -1 };
enum { COUNTED = 0, STOPPED = 1, TOO_LARGE = 2, NO_MEMORY = 3 };

/* ---- what follows from orders that are known: transitivity in all cells, and parities ---- */

typedef struct {
    int8_t *value;
    int64_t *queue;
    int64_t end;
    int64_t *why; /* for each class four others that it follows from, -1 fills up; the last row is the contradiction */
    int64_t *contradiction;
} known;

static int contradicted(known *k, const int64_t *because, int64_t v)
{
    memcpy(k->contradiction, because, 3 * sizeof *because);
    k->contradiction[3] = v;
    return 0;
}

/* Make a literal true, since three classes have the values that they have. */
static int learn(known *k, int64_t literal, const int64_t *because)
{
    int64_t v = literal >> 1;
    int8_t truth = (int8_t)!(literal & 1);
    if (k->value[v] != UNKNOWN) return k->value[v] == truth || contradicted(k, because, v);
    k->value[v] = truth;
    memcpy(k->why + 4 * v, because, 3 * sizeof *because);
    k->queue[k->end++] = v;
    return 1;
}

static int truth_of(const int8_t *value, int64_t literal)
{
    int8_t here = value[literal >> 1];
    return here == UNKNOWN ? UNKNOWN : here ^ (int)(literal & 1);
}

static int64_t row_of(int64_t size, int64_t i, int64_t j) { return i * (2 * size - i - 1) / 2 + j - i - 1; }

/* Return the literal that i is over j, in the rows of one cell. */
static int64_t over(const int64_t *rows, int64_t size, int64_t i, int64_t j)
{
    return i < j ? rows[row_of(size, i, j)] : rows[row_of(size, j, i)] ^ 1;
}

static int settle_cell(known *k, const int64_t *rows, int64_t size, int64_t i, int64_t j)
{
    int64_t here = over(rows, size, i, j);
    int first = truth_of(k->value, here);
    for (int64_t other = 0; other < size; other++) {
        if (other == i || other == j) continue;
        int64_t after = over(rows, size, j, other), back = over(rows, size, other, i);
        int one = truth_of(k->value, after), two = truth_of(k->value, back);
        if (one == first && two != !first && !learn(k, back ^ first, (int64_t[3]){here >> 1, after >> 1, -1})) return 0;
        if (two == first && one == UNKNOWN && !learn(k, after ^ first, (int64_t[3]){here >> 1, back >> 1, -1})) return 0;
    }
    return 1;
}

static int settle_parity(known *k, const int64_t *row, int64_t width)
{
    int64_t left = -1, because[4] = {-1, -1, -1, -1};
    int odd = 0, met = 0;
    for (int64_t i = 0; i < width; i++) {
        if (row[i] < 0) continue;
        int here = truth_of(k->value, row[i]);
        if (here == UNKNOWN && left >= 0 && (left >> 1) != (row[i] >> 1)) return 1;
        if (here == UNKNOWN && left >= 0) { /* twice the same variable: they cancel */
            odd ^= (int)((left ^ row[i]) & 1);
            left = -1;
        } else if (here == UNKNOWN) {
            left = row[i];
        } else {
            odd ^= here;
            because[met++] = row[i] >> 1;
        }
    }
    if (left < 0) return !odd || contradicted(k, because, because[3]);
    return learn(k, left ^ !odd, because);
}

/* Values of classes, -1 where unknown: what is known is extended; 1 if all is consistent, 0 if not, -1 no memory.
 * Why has four classes for each class that was found, -1 fills up, and four for the contradiction, in the last row. */
EXPORT int settled(int64_t cells, const int64_t *sizes, const int64_t *first, const int64_t *rows, int64_t classes,
                   int64_t parities, const int64_t *parity, int8_t *value, int64_t *why)
{
    int64_t count = first[cells], width = 4;
    int64_t *begin = calloc((size_t)classes + 1, sizeof *begin), *place = malloc(((size_t)count + 1) * sizeof *place);
    int64_t *begin4 = calloc((size_t)classes + 1, sizeof *begin4);
    int64_t *place4 = malloc(((size_t)(parities * width) + 1) * sizeof *place4);
    int32_t *where = malloc(((size_t)count + 1) * 3 * sizeof *where);
    int64_t *queue = malloc(((size_t)classes + 1) * sizeof *queue);
    int good = begin && place && begin4 && place4 && where && queue ? 1 : -1;
    if (good == 1) {
        for (int64_t c = 0; c < cells; c++) {
            int64_t row = first[c];
            for (int64_t i = 0; i < sizes[c]; i++)
                for (int64_t j = i + 1; j < sizes[c]; j++, row++) {
                    where[3 * row] = (int32_t)c, where[3 * row + 1] = (int32_t)i, where[3 * row + 2] = (int32_t)j;
                    begin[rows[row] >> 1]++;
                }
        }
        for (int64_t i = 0; i < parities * width; i++)
            if (parity[i] >= 0) begin4[parity[i] >> 1]++;
        for (int64_t v = 0, sum = 0, sum4 = 0; v <= classes; v++) {
            sum += v < classes ? begin[v] : 0, sum4 += v < classes ? begin4[v] : 0;
            begin[v] = sum, begin4[v] = sum4;
        }
        for (int64_t row = count; row-- > 0;) place[--begin[rows[row] >> 1]] = row;
        for (int64_t i = parities * width; i-- > 0;)
            if (parity[i] >= 0) place4[--begin4[parity[i] >> 1]] = i / width;
        begin[classes] = count;
        known k = {value, queue, 0, why, why + 4 * classes};
        for (int64_t v = 0; v < classes; v++)
            if (value[v] != UNKNOWN) queue[k.end++] = v;
        for (int64_t i = 0; good == 1 && i < parities; i++) good = settle_parity(&k, parity + i * width, width);
        for (int64_t next = 0; good == 1 && next < k.end; next++) {
            int64_t v = queue[next];
            for (int64_t at = begin[v]; good == 1 && at < begin[v + 1]; at++) {
                const int32_t *pair = where + 3 * place[at];
                good = settle_cell(&k, rows + first[pair[0]], sizes[pair[0]], pair[1], pair[2]);
            }
            for (int64_t at = begin4[v]; good == 1 && at < begin4[v + 1]; at++)
                good = settle_parity(&k, parity + place4[at] * width, width);
        }
    }
    free(begin), free(place), free(begin4), free(place4), free(where), free(queue);
    return good;
}

/* ---- a problem: triples that are not all equal, clauses, parities ---- */

typedef struct {
    int64_t offset;
    uint64_t hash;
    wide count;
} entry;

typedef struct {
    int32_t variables, conditions;
    int32_t *begin, *of;       /* the conditions of each variable */
    int32_t *literal;          /* four literals of each condition, -1 fills up */
    uint8_t *kind;             /* 3 triple, 2 clause, 4 parity */
    int8_t *value;
    int32_t *trail;
    int64_t *seen, *marked, stamp;
    int32_t trailed;
    int32_t *stack;            /* members of parts, one part after the other */
    int64_t stack_end, stack_size;
    uint64_t *mask;
    uint8_t *key;
    int64_t key_size;
    /* the cache */
    entry *table;
    int64_t slots, used;
    uint8_t *arena;
    int64_t arena_end, arena_size, arena_most;
    volatile int32_t *stop;
    int state;
    int64_t nodes;
} problem;

static int assign(problem *p, int32_t literal)
{
    int32_t v = literal >> 1;
    int8_t truth = (int8_t)!(literal & 1);
    if (p->value[v] != UNKNOWN) return p->value[v] == truth;
    p->value[v] = truth;
    p->trail[p->trailed++] = v;
    return 1;
}

static int truth(const problem *p, int32_t literal)
{
    int8_t here = p->value[literal >> 1];
    return here == UNKNOWN ? UNKNOWN : here ^ (literal & 1);
}

static int follow_condition(problem *p, int32_t c)
{
    const int32_t *row = p->literal + 4 * (int64_t)c;
    if (p->kind[c] == 2) {
        int one = truth(p, row[0]), two = truth(p, row[1]);
        if (one == 1 || two == 1) return 1;
        if (one == 0) return assign(p, row[1]);
        return two == 0 ? assign(p, row[0]) : 1;
    }
    if (p->kind[c] == 3) {
        int count[2] = {0, 0};
        int32_t left = -1;
        for (int i = 0; i < 3; i++) {
            int here = truth(p, row[i]);
            if (here == UNKNOWN) left = row[i];
            else count[here]++;
        }
        if (count[0] && count[1]) return 1;
        if (count[0] == 3 || count[1] == 3) return 0;
        if (count[0] == 2) return assign(p, left);
        return count[1] == 2 ? assign(p, left ^ 1) : 1;
    }
    int open = 0, odd = 0;
    int32_t left = -1;
    for (int i = 0; i < 4 && row[i] >= 0; i++) {
        int here = truth(p, row[i]);
        if (here == UNKNOWN) open++, left = row[i];
        else odd ^= here;
    }
    if (open == 0) return !odd;
    return open == 1 ? assign(p, left ^ !odd) : 1;
}

/* Follow what is on the trail from a place on. */
static int follow(problem *p, int32_t from)
{
    for (int32_t next = from; next < p->trailed; next++) {
        int32_t v = p->trail[next];
        for (int32_t at = p->begin[v]; at < p->begin[v + 1]; at++)
            if (!follow_condition(p, p->of[at])) return 0;
    }
    return 1;
}

static void undo(problem *p, int32_t to)
{
    while (p->trailed > to) p->value[p->trail[--p->trailed]] = UNKNOWN;
}

/* How many variables of a condition are open, 0 if it holds whatever they are. */
static int open_in(const problem *p, int32_t c)
{
    const int32_t *row = p->literal + 4 * (int64_t)c;
    int open = 0, count[2] = {0, 0};
    for (int i = 0; i < 4 && row[i] >= 0; i++) {
        int here = truth(p, row[i]);
        if (here == UNKNOWN) open++;
        else count[here]++;
    }
    if (p->kind[c] == 3 && count[0] && count[1]) return 0;
    if (p->kind[c] == 2 && count[1]) return 0;
    return open;
}

static void free_problem(problem *p)
{
    free(p->begin), free(p->of), free(p->literal), free(p->kind), free(p->value), free(p->trail), free(p->seen);
    free(p->marked), free(p->stack), free(p->mask), free(p->key), free(p->table), free(p->arena);
}

static int make_problem(problem *p, int64_t variables, int64_t triples, const int64_t *triple, int64_t clauses,
                        const int64_t *clause, int64_t parities, const int64_t *parity)
{
    int64_t conditions = triples + clauses + parities;
    memset(p, 0, sizeof *p);
    p->variables = (int32_t)variables, p->conditions = (int32_t)conditions;
    p->begin = calloc((size_t)variables + 2, sizeof *p->begin);
    p->of = malloc(((size_t)conditions * 4 + 1) * sizeof *p->of);
    p->literal = malloc(((size_t)conditions * 4 + 1) * sizeof *p->literal);
    p->kind = malloc((size_t)conditions + 1);
    p->value = malloc((size_t)variables + 1);
    p->trail = malloc(((size_t)variables + 1) * sizeof *p->trail);
    p->seen = calloc((size_t)variables + 1, sizeof *p->seen);
    p->marked = calloc((size_t)conditions + 1, sizeof *p->marked);
    p->stack_size = 4 * variables + 64;
    p->stack = malloc((size_t)p->stack_size * sizeof *p->stack);
    p->mask = calloc((size_t)variables / 64 + 1, sizeof *p->mask);
    p->key_size = variables / 8 + conditions / 8 + 64;
    p->key = malloc((size_t)p->key_size);
    if (!(p->begin && p->of && p->literal && p->kind && p->value && p->trail && p->seen && p->marked &&
          p->stack && p->mask && p->key))
        return 0;
    for (int64_t v = 0; v < variables; v++) p->value[v] = UNKNOWN;
    const int64_t *from[3] = {triple, clause, parity};
    const int64_t many[3] = {triples, clauses, parities}, width[3] = {3, 2, 4};
    int64_t c = 0;
    for (int part = 0; part < 3; part++)
        for (int64_t row = 0; row < many[part]; row++, c++) {
            p->kind[c] = (uint8_t)width[part];
            for (int64_t i = 0; i < 4; i++) {
                int64_t literal = i < width[part] ? from[part][row * width[part] + i] : -1;
                p->literal[4 * c + i] = (int32_t)literal;
                if (literal >= 0) p->begin[(literal >> 1) + 1]++;
            }
        }
    for (int64_t v = 0; v < variables; v++) p->begin[v + 1] += p->begin[v];
    int32_t *next = malloc(((size_t)variables + 1) * sizeof *next);
    if (!next) return 0;
    memcpy(next, p->begin, ((size_t)variables + 1) * sizeof *next);
    for (c = 0; c < conditions; c++)
        for (int i = 0; i < 4; i++)
            if (p->literal[4 * c + i] >= 0) p->of[next[p->literal[4 * c + i] >> 1]++] = (int32_t)c;
    free(next);
    return 1;
}

/* For each literal whether it leads to a contradiction, by itself: int8[2 variables]. */
EXPORT int probed(int64_t variables, int64_t triples, const int64_t *triple, int64_t clauses, const int64_t *clause,
                  int64_t parities, const int64_t *parity, int8_t *fails)
{
    problem p;
    if (!make_problem(&p, variables, triples, triple, clauses, clause, parities, parity)) {
        free_problem(&p);
        return 0;
    }
    for (int32_t literal = 0; literal < 2 * (int32_t)variables; literal++) {
        fails[literal] = (int8_t)!(assign(&p, literal) && follow(&p, 0));
        undo(&p, 0);
    }
    free_problem(&p);
    return 1;
}

static int push(problem *p, int32_t v)
{
    if (p->stack_end == p->stack_size) {
        int64_t size = 2 * p->stack_size;
        int32_t *stack = realloc(p->stack, (size_t)size * sizeof *stack);
        if (!stack) return 0;
        p->stack = stack, p->stack_size = size;
    }
    p->stack[p->stack_end++] = v;
    return 1;
}

/* Push the part that a variable is in; return how many members it has, -1 without memory. */
static int64_t push_part(problem *p, int32_t v)
{
    int64_t begin = p->stack_end;
    p->seen[v] = p->stamp;
    if (!push(p, v)) return -1;
    for (int64_t next = begin; next < p->stack_end; next++) {
        int32_t here = p->stack[next];
        for (int32_t at = p->begin[here]; at < p->begin[here + 1]; at++) {
            int32_t c = p->of[at];
            if (p->marked[c] == p->stamp) continue;
            p->marked[c] = p->stamp;
            if (open_in(p, c) < 2) continue;
            const int32_t *row = p->literal + 4 * (int64_t)c;
            for (int i = 0; i < 4 && row[i] >= 0; i++) {
                int32_t other = row[i] >> 1;
                if (p->value[other] == UNKNOWN && p->seen[other] != p->stamp) {
                    p->seen[other] = p->stamp;
                    if (!push(p, other)) return -1;
                }
            }
        }
    }
    return p->stack_end - begin;
}

/* The key of a part: which variables are open, and what the others make of conditions that are not yet kept. */
static int64_t key_of(problem *p, int64_t begin, int64_t size)
{
    int32_t low = p->stack[begin] >> 6, high = low;
    for (int64_t i = begin; i < begin + size; i++) {
        int32_t v = p->stack[i];
        p->mask[v >> 6] |= (uint64_t)1 << (v & 63);
        low = (v >> 6) < low ? v >> 6 : low;
        high = (v >> 6) > high ? v >> 6 : high;
    }
    int64_t end = 0;
    memcpy(p->key, &low, 4), memcpy(p->key + 4, &high, 4);
    end = 8;
    memcpy(p->key + end, p->mask + low, (size_t)(high - low + 1) * 8);
    end += (int64_t)(high - low + 1) * 8;
    unsigned bits = 0, filled = 0;
    p->stamp++;
    for (int32_t word = low; word <= high; word++) {
        uint64_t left = p->mask[word];
        p->mask[word] = 0;
        while (left) {
            int32_t v = 64 * word + __builtin_ctzll(left);
            left &= left - 1;
            for (int32_t at = p->begin[v]; at < p->begin[v + 1]; at++) {
                int32_t c = p->of[at];
                if (p->marked[c] == p->stamp) continue;
                p->marked[c] = p->stamp;
                if (p->kind[c] == 2) continue; /* both open, or it is kept */
                const int32_t *row = p->literal + 4 * (int64_t)c;
                int open = 0, odd = 0, fixed = 0;
                for (int i = 0; i < 4 && row[i] >= 0; i++) {
                    int here = truth(p, row[i]);
                    if (here == UNKNOWN) open++;
                    else odd ^= here, fixed++;
                }
                if (!fixed || open < 2) continue;
                bits |= (unsigned)odd << filled++;
                if (filled == 8) p->key[end++] = (uint8_t)bits, bits = filled = 0;
            }
        }
    }
    if (filled) p->key[end++] = (uint8_t)bits;
    return end;
}

static uint64_t hash_of(const uint8_t *key, int64_t size)
{
    uint64_t hash = 0x9E3779B97F4A7C15u ^ (uint64_t)size;
    for (; size >= 8; key += 8, size -= 8) {
        uint64_t word;
        memcpy(&word, key, 8);
        hash = (hash ^ word) * 0xD6E8FEB86659FD93u;
        hash ^= hash >> 32;
    }
    for (; size > 0; key++, size--) hash = (hash ^ *key) * 0x100000001B3u;
    hash ^= hash >> 29;
    hash *= 0xBF58476D1CE4E5B9u;
    return hash ^ hash >> 32;
}

static entry *slot_of(problem *p, uint64_t hash, const uint8_t *key, int64_t size)
{
    int64_t at = (int64_t)(hash & (uint64_t)(p->slots - 1));
    while (p->table[at].offset >= 0) {
        const entry *here = p->table + at;
        if (here->hash == hash) {
            int64_t length;
            memcpy(&length, p->arena + here->offset, 8);
            if (length == size && !memcmp(p->arena + here->offset + 8, key, (size_t)size)) break;
        }
        at = (at + 1) & (p->slots - 1);
    }
    return p->table + at;
}

static int make_table(problem *p, int64_t slots)
{
    entry *old = p->table;
    int64_t before = p->slots;
    p->table = malloc((size_t)slots * sizeof *p->table);
    if (!p->table) {
        p->table = old;
        return 0;
    }
    p->slots = slots;
    for (int64_t i = 0; i < slots; i++) p->table[i].offset = -1;
    for (int64_t i = 0; i < before; i++)
        if (old[i].offset >= 0) {
            int64_t at = (int64_t)(old[i].hash & (uint64_t)(slots - 1));
            while (p->table[at].offset >= 0) at = (at + 1) & (slots - 1);
            p->table[at] = old[i];
        }
    free(old);
    return 1;
}

/* Keep the count of a key; where there is no room left all others are dropped first. */
static void keep(problem *p, const uint8_t *key, int64_t size, uint64_t hash, wide count)
{
    int64_t needed = size + 8;
    if (p->arena_end + needed > p->arena_size && p->arena_size < p->arena_most) {
        int64_t larger = 2 * p->arena_size < p->arena_most ? 2 * p->arena_size : p->arena_most;
        uint8_t *arena = realloc(p->arena, (size_t)larger);
        if (arena) p->arena = arena, p->arena_size = larger;
    }
    if (p->arena_end + needed > p->arena_size) {
        if (needed > p->arena_size) return;
        for (int64_t i = 0; i < p->slots; i++) p->table[i].offset = -1;
        p->used = p->arena_end = 0;
    }
    if (2 * (p->used + 1) > p->slots && !make_table(p, 2 * p->slots)) return;
    entry *slot = slot_of(p, hash, key, size);
    if (slot->offset >= 0) return;
    memcpy(p->arena + p->arena_end, &size, 8);
    memcpy(p->arena + p->arena_end + 8, key, (size_t)size);
    slot->offset = p->arena_end, slot->hash = hash, slot->count = count;
    p->arena_end += needed;
    p->used++;
}

/* The variable of a part that most conditions speak of; those that nearly decide count more. */
static int32_t chosen(const problem *p, int64_t begin, int64_t size)
{
    int32_t best = p->stack[begin];
    int64_t most = -1;
    for (int64_t i = begin; i < begin + size; i++) {
        int32_t v = p->stack[i];
        int64_t weight = 0;
        for (int32_t at = p->begin[v]; at < p->begin[v + 1]; at++) {
            int open = open_in(p, p->of[at]);
            weight += open < 2 ? 0 : open == 2 ? 4 : 1;
        }
        if (weight > most || (weight == most && v < best)) most = weight, best = v;
    }
    return best;
}

static wide count_part(problem *p, int64_t begin, int64_t size);

/* The product of the counts of the parts of some variables, members of the stack. */
static wide count_rest(problem *p, int64_t begin, int64_t size)
{
    wide product = 1;
    int64_t first = p->stack_end;
    p->stamp++;
    /* all parts are found before any is counted, since counting takes new stamps */
    int64_t parts = 0, sizes_begin;
    for (int64_t i = begin; i < begin + size; i++) {
        int32_t v = p->stack[i];
        if (p->value[v] != UNKNOWN || p->seen[v] == p->stamp) continue;
        if (!push(p, 0)) goto no_memory;
        int64_t mark = p->stack_end - 1, here = push_part(p, v);
        if (here < 0) goto no_memory;
        p->stack[mark] = (int32_t)here;
        parts++;
    }
    sizes_begin = first;
    while (parts-- > 0 && product && p->state == COUNTED) {
        int64_t here = p->stack[sizes_begin];
        wide count = here == 1 ? 2 : count_part(p, sizes_begin + 1, here);
        if (__builtin_mul_overflow(product, count, &product)) p->state = TOO_LARGE;
        sizes_begin += here + 1;
    }
    p->stack_end = first;
    return product;
no_memory:
    p->state = NO_MEMORY;
    p->stack_end = first;
    return 0;
}

static wide count_part(problem *p, int64_t begin, int64_t size)
{
    if ((++p->nodes & 255) == 0 && *p->stop) p->state = STOPPED;
    if (p->state != COUNTED) return 0;
    int64_t length = key_of(p, begin, size);
    uint64_t hash = hash_of(p->key, length);
    entry *slot = slot_of(p, hash, p->key, length);
    if (slot->offset >= 0) return slot->count;
    uint8_t *key = malloc((size_t)length);
    if (!key) {
        p->state = NO_MEMORY;
        return 0;
    }
    memcpy(key, p->key, (size_t)length);
    int32_t v = chosen(p, begin, size);
    wide total = 0;
    for (int way = 0; way < 2 && p->state == COUNTED; way++) {
        int32_t to = p->trailed;
        if (assign(p, 2 * v + way) && follow(p, to)) {
            wide count = count_rest(p, begin, size);
            if (__builtin_add_overflow(total, count, &total)) p->state = TOO_LARGE;
        }
        undo(p, to);
    }
    if (p->state == COUNTED) keep(p, key, length, hash, total);
    free(key);
    return total;
}

/* How many values of the variables keep all conditions and some literals: halves uint64[2], the lower one first.
 * Return 0, or why not: 1 stopped, 2 more than 128 bits, 3 no memory. */
EXPORT int counted(int64_t variables, int64_t triples, const int64_t *triple, int64_t clauses, const int64_t *clause,
                   int64_t parities, const int64_t *parity, int64_t given, const int64_t *literals, int64_t bytes,
                   volatile int32_t *stop, uint64_t *halves, int64_t *nodes)
{
    problem p;
    int state = NO_MEMORY;
    wide total = 0;
    int ready = make_problem(&p, variables, triples, triple, clauses, clause, parities, parity);
    p.stop = stop;
    p.arena_most = bytes;
    p.arena_size = bytes < 65536 ? bytes : 65536;
    p.arena = malloc((size_t)p.arena_size + 1);
    if (ready && p.arena && make_table(&p, 1024)) {
        int good = 1;
        for (int64_t i = 0; good && i < given; i++) good = assign(&p, (int32_t)literals[i]);
        if (good && follow(&p, 0)) {
            for (int32_t v = 0; v < p.variables; v++)
                if (!push(&p, v)) p.state = NO_MEMORY;
            total = count_rest(&p, 0, p.variables);
        }
        state = p.state;
    }
    halves[0] = (uint64_t)total, halves[1] = (uint64_t)(total >> 64);
    *nodes = p.nodes;
    free_problem(&p);
    return state;
}
