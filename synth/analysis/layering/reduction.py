"""Literals that are equal made one, what follows from creases, and the independent parts of the rest.

*Components* are variables that conditions tie to each other before equal ones are made one. They are those that
Flat-Folder lists: two variables are of one component if a condition speaks of both that is not kept whatever they are.
A transitivity is left out where two of its variables are equal since creases join the panels on one side of it. A
component may fall into independent parts later (`reduced`), of which it has the product of the counts. Source: J. Ku,
Flat-Folder. Theory: docs/theory/layer-orders.md.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import product

import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components

from graphs.types import Flags, Ints, Signs
from synth.analysis.layering.constraints import FALSE, TRUE, LayerConstraints, PairTable, joined, pairs_of
from synth.analysis.layering.counting.problem import LayerProblem
from synth.analysis.layering.counting.propagation import probed, settled


def components(constraints: LayerConstraints, values: Signs) -> Ints:
    """Return the component of each variable, -1 where it is decided; `values` are 0, 1, and -1 for open ones."""
    table = constraints.table
    one, other = [np.empty(0, dtype=np.int64)], [np.empty(0, dtype=np.int64)]
    first, second, *_ = constraints.beside
    one.append(first >> 1)
    other.append(second >> 1)
    one.append(constraints.bundled[0] >> 1)
    other.append(constraints.bundled[1] >> 1)
    tied = _tied(constraints)
    for cell in range(len(table.sizes)):
        for pair in _by_transitivity(table, cell, values, tied):
            one.append(pair[:, 0])
            other.append(pair[:, 1])
    literals = _of_creases(constraints)
    alive = _interleaving(_truths(values, literals))
    open_ = (values[literals >> 1] < 0) & alive[:, None]
    for column in range(6):
        for before in range(column):
            both = open_[:, column] & open_[:, before]
            one.append(literals[both, before] >> 1)
            other.append(literals[both, column] >> 1)
    part = joined(constraints.variables, np.concatenate(one), np.concatenate(other))
    found: Ints = np.where(values < 0, part, -1)
    return found


def _truths(values: Signs, literals: Ints) -> Signs:
    here = values[literals >> 1]
    found: Signs = np.where(here < 0, here, here ^ (literals & 1).astype(np.int8))
    return found


def _tied(constraints: LayerConstraints) -> Ints:
    """Return for each variable a part by its lower and by its higher panel, int[n, 2].

    Two variables that share a panel are in one part of it if creases that it runs across join their other panels.
    """
    first, second, turn, panel = constraints.beside
    ends = []
    for literal, other in ((first, constraints.turns.one[turn]), (second, constraints.turns.other[turn])):
        ends.append(2 * (literal >> 1) + (panel > other))
    return joined(2 * constraints.variables, *ends).reshape(-1, 2)


def _by_transitivity(table: PairTable, cell: int, values: Signs, tied: Ints) -> list[Ints]:
    """Return pairs of variables that are open and in one transitivity that is not kept yet."""
    size = int(table.sizes[cell])
    here = table.variable[table.first[cell] : table.first[cell + 1]]
    undecided = np.flatnonzero(values[here] < 0)
    if size < 3 or not len(undecided):
        return []
    low, high = pairs_of(size)
    variable = np.zeros((size, size), dtype=np.int64)
    variable[low, high] = variable[high, low] = here
    over = np.zeros((size, size), dtype=np.int8)  # whether i is over k, -1 if open
    truth = values[here]
    over[low, high], over[high, low] = truth, np.where(truth < 0, truth, 1 - truth)
    by = np.zeros((size, size), dtype=np.int64)  # the part of the variable by the panel of the row
    by[low, high], by[high, low] = tied[here, 0], tied[here, 1]
    i, j = low[undecided], high[undecided]
    third = np.broadcast_to(np.arange(size), (len(i), size))
    after, back = over[j], over[:, i].T
    alive = (third != i[:, None]) & (third != j[:, None])
    alive &= (after < 0) | (back < 0) | (after == back)
    alive &= (by[i, j][:, None] != by[i]) & (by[j, i][:, None] != by[j]) & (by[:, i].T != by[:, j].T)
    found = []
    for order, others in ((after, variable[j]), (back, variable[:, i].T)):
        both = alive & (order < 0)
        mine = np.broadcast_to(here[undecided][:, None], both.shape)
        found.append(np.unique(np.column_stack([mine[both], others[both]]), axis=0))
    return found


def _of_creases(constraints: LayerConstraints) -> Ints:
    """Return literals of the six pairs of the panels of two creases: of each crease, and a-c, a-d, b-c, b-d."""
    literals, one, other = constraints.nested
    turns, table = constraints.turns, constraints.table
    rows = [
        (
            int(table.literals(turns.cell[i], turns.one[i], turns.other[i])),
            int(table.literals(turns.cell[k], turns.one[k], turns.other[k])),
        )
        for i, k in zip(one.tolist(), other.tolist(), strict=True)
    ]
    return np.column_stack([np.array(rows, dtype=np.int64).reshape(-1, 2), literals])


@cache
def _table() -> Flags:
    """Return for the values of six pairs, 0, 1 and 2 for open, in base 3, whether some of what they leave is wrong."""
    orders = list(product((0, 1), repeat=6))

    def possible(order: tuple[int, ...]) -> bool:
        ab, cd, ac, ad, bc, bd = order
        circle = [(ab, bc, 1 - ac), (ab, bd, 1 - ad), (ac, cd, 1 - ad), (bc, cd, 1 - bd)]
        return (ac + ad + bc + bd) % 2 == 0 and all(0 < sum(three) < 3 for three in circle)

    wrong = [order for order in orders if not possible(order)]
    return np.array(
        [
            any(all(w in (2, o) for w, o in zip(written, order, strict=True)) for order in wrong)
            for written in product((0, 1, 2), repeat=6)
        ]
    )


def _interleaving(values: Signs) -> Flags:
    """Return which rows of six values leave an order that is wrong."""
    digits = np.where(values < 0, 2, values).astype(np.int64)
    found: Flags = _table()[digits @ 3 ** np.arange(5, -1, -1)]
    return found


def merged(count: int, one: Ints, other: Ints) -> Ints | None:
    """Return the new literal of each of 2 count literals where some are equal; None if one equals its opposite.

    Variable 0 is what is true. Classes are numbered by their first variables.
    """
    ends = np.concatenate([one, one ^ 1]), np.concatenate([other, other ^ 1])
    joined = coo_array((np.ones(len(ends[0]), dtype=np.int8), ends), shape=(2 * count, 2 * count))
    _, part = connected_components(joined, directed=False)
    if (part[0::2] == part[1::2]).any():
        return None
    _, first = np.unique(part, return_index=True)
    leader = first[part]  # the lowest literal that is equal
    _, number = np.unique(leader // 2, return_inverse=True)
    literals: Ints = 2 * number.ravel() + leader % 2
    return literals


@dataclass(frozen=True, eq=False)
class ReducedLayers:
    """Constraints after what follows from them at once.

    `literal` has for each literal of a variable that of its class; `parts` are the independent problems, each with
    the classes that are its variables; `components` are the places of those parts that conditions tie together.
    """

    literal: Ints
    parts: tuple[tuple[LayerProblem, Ints], ...]
    components: tuple[tuple[int, ...], ...]


def reduced(constraints: LayerConstraints, known: Ints) -> ReducedLayers | None:
    """Return what is left where some literals are known to be true; None if they contradict each other."""
    table = constraints.table
    count = constraints.variables + 1  # variable 0 is what is true, the others come after it
    one, other, *_ = constraints.beside
    first, second = constraints.bundled
    known = np.concatenate([known, constraints.decided[0]])
    ends = np.concatenate([one, first, known]) + 2, np.concatenate([other + 2, second + 2, np.full(len(known), TRUE)])
    literal = merged(count, *ends)
    component: Ints | None = None  # those of what creases and transitivity leave open at first
    while literal is not None:
        rows = literal[2 * (table.variable + 1)]
        parities = literal[constraints.nested[0] + 2]
        values = settled(table, rows, int(literal.max()) // 2 + 1, parities)
        if values is None:
            return None
        fixed = np.flatnonzero(values >= 0)
        step = _merged_again(literal, 2 * fixed + (values[fixed] == 0), np.full(len(fixed), TRUE))
        if step is None:
            return None
        literal = step
        if component is None:
            component = components(constraints, _values(literal))
        problem = _residual(constraints, literal)
        found = _equal(problem)
        if not len(found[0]):
            fails = np.flatnonzero(probed(problem)[2:]) + 2
            found = fails ^ 1, np.full(len(fails), TRUE)
        if not len(found[0]):
            parts = tuple(_parts(problem))
            return ReducedLayers(literal[2:], parts, _tied_parts(literal, parts, component))
        literal = _merged_again(literal, *found)
    return None


def _values(literal: Ints) -> Signs:
    """Return the values of the variables, -1 where they are open."""
    mine = literal[2::2]
    found: Signs = np.where(mine > FALSE, -1, mine == TRUE).astype(np.int8)
    return found


def _tied_parts(
    literal: Ints, parts: Sequence[tuple[LayerProblem, Ints]], component: Ints
) -> tuple[tuple[int, ...], ...]:
    """Return the places of the parts that are of one component."""
    part_of = np.full(int(literal.max()) // 2 + 1, -1, dtype=np.int64)
    for place, (_, classes) in enumerate(parts):
        part_of[classes] = place
    here = part_of[literal[2::2] >> 1]
    there = here >= 0
    label = joined(len(parts) + len(component), here[there], len(parts) + component[there])
    together: dict[int, list[int]] = {}
    for place in range(len(parts)):
        together.setdefault(int(label[place]), []).append(place)
    return tuple(map(tuple, together.values()))


def _merged_again(literal: Ints, one: Ints, other: Ints) -> Ints | None:
    step = merged(int(literal.max()) // 2 + 1, one, other)
    return None if step is None else step[literal]


def _residual(constraints: LayerConstraints, literal: Ints) -> LayerProblem:
    """Return the conditions on classes that are not decided."""
    table = constraints.table
    rows = literal[2 * (table.variable + 1)]
    size = int(literal.max()) + 2
    codes = [np.empty(0, dtype=np.int64)]
    for cell in range(len(table.sizes)):
        low, middle, high = np.sort(_open_triples(table, cell, rows), axis=1).T
        kept = (low ^ 1 != middle) & (middle ^ 1 != high) & ~((low == TRUE) & (middle == FALSE))
        codes.append(np.unique((low[kept] * size + middle[kept]) * size + high[kept]))
    code = np.unique(np.concatenate(codes))
    triples = np.column_stack([code // (size * size), code // size % size, code % size])
    constant = triples[:, 0] <= FALSE
    sign = (triples[constant, :1] == TRUE).astype(np.int64)  # not all true: one of the opposites of the others is
    clauses = np.unique(np.sort(triples[constant, 1:] ^ sign, axis=1), axis=0)
    free = triples[~constant]
    free[free[:, 0] % 2 == 1] ^= 1  # a triple and its opposite are one condition
    parities = _parity_rows(literal[constraints.nested[0] + 2])
    return LayerProblem(size // 2, np.unique(np.sort(free, axis=1), axis=0), clauses, parities)


def _open_triples(table: PairTable, cell: int, rows: Ints) -> Ints:
    """Return literals of three panels over a cell in a circle, int[n, 3], those of two panels that are open first."""
    size = int(table.sizes[cell])
    here = rows[table.first[cell] : table.first[cell + 1]]
    undecided = np.flatnonzero(here > FALSE)
    if size < 3 or not len(undecided):
        return np.empty((0, 3), dtype=np.int64)
    order = np.full((size, size), FALSE, dtype=np.int64)  # the literal that i is over k
    low, high = pairs_of(size)
    order[low, high], order[high, low] = here, here ^ 1
    i, j = low[undecided], high[undecided]
    around = np.stack([np.broadcast_to(here[undecided, None], (len(i), size)), order[j], order[:, i].T], axis=2)
    apart = np.ones((len(i), size), dtype=bool)
    apart[np.arange(len(i)), i] = apart[np.arange(len(i)), j] = False
    found: Ints = around[apart]
    return found


def _parity_rows(rows: Ints) -> Ints:
    """Return rows of literals an even number of which is true, without what cancels, in one form each."""
    found = set()
    for row in np.unique(np.sort(rows, axis=1), axis=0).tolist():
        odd: set[int] = set()
        flips = 0
        for literal in row:
            flips ^= literal & 1
            if literal > FALSE:
                odd ^= {literal & ~1}
            else:
                flips ^= 1  # what is true counts
        if odd:
            first, *others = sorted(odd)
            found.add((first ^ flips, *others, *[-1] * (3 - len(others))))
        elif flips:
            found.add((TRUE, -1, -1, -1))
    return np.array(sorted(found), dtype=np.int64).reshape(-1, 4)


def _equal(problem: LayerProblem) -> tuple[Ints, Ints]:
    """Return pairs of literals that conditions make equal: by themselves, or as implications in a circle."""
    pairs: list[Ints] = [np.empty((0, 2), dtype=np.int64)]
    triples, parities, clauses = problem.triples, problem.parities, problem.clauses
    for i, j, k in ((0, 1, 2), (0, 2, 1), (1, 2, 0)):
        alike = triples[:, i] == triples[:, j]
        pairs.append(np.column_stack([triples[alike, i], triples[alike, k] ^ 1]))
    alike = clauses[:, 0] == clauses[:, 1]
    pairs.append(np.column_stack([clauses[alike, 0], np.full(int(alike.sum()), TRUE)]))
    long = (parities >= 0).sum(axis=1)
    pairs.append(np.column_stack([parities[long == 1, 0], np.full(int((long == 1).sum()), FALSE)]))
    pairs.append(parities[long == 2, :2])
    size = 2 * problem.variables
    tails, heads = (
        np.concatenate([clauses[:, 0] ^ 1, clauses[:, 1] ^ 1]),
        np.concatenate([clauses[:, 1], clauses[:, 0]]),
    )
    implied = csr_array((np.ones(len(tails), dtype=np.int8), (tails, heads)), shape=(size, size))
    _, part = connected_components(implied, directed=True, connection="strong")
    _, first, place = np.unique(part, return_index=True, return_inverse=True)
    leader = first[place.ravel()]
    circled = np.flatnonzero(leader != np.arange(size))
    pairs.append(np.column_stack([circled, leader[circled]]))
    found = np.concatenate(pairs)
    return found[:, 0], found[:, 1]


def _parts(problem: LayerProblem) -> Sequence[tuple[LayerProblem, Ints]]:
    """Return the independent problems, those with fewer variables first, and the classes that are their variables."""
    conditions = [problem.triples, problem.clauses, problem.parities]
    ones, others = [np.empty(0, dtype=np.int64)], [np.empty(0, dtype=np.int64)]
    for rows in conditions:
        for column in range(1, rows.shape[1]):
            there = rows[:, column] >= 0
            ones.append(rows[there, 0] // 2)
            others.append(rows[there, column] // 2)
    one, other = np.concatenate(ones), np.concatenate(others)
    count = problem.variables
    joined = coo_array((np.ones(len(one), dtype=np.int8), (one, other)), shape=(count, count))
    _, part = connected_components(joined, directed=False)
    members: dict[int, list[int]] = {}
    for variable in range(1, count):
        members.setdefault(int(part[variable]), []).append(variable)
    inside = [part[rows[:, 0] // 2] for rows in conditions]
    parts = []
    for label, variables in sorted(members.items(), key=lambda item: (len(item[1]), item[1])):
        chosen = np.array(variables)
        local = np.full(2 * count, -1, dtype=np.int64)
        local[2 * chosen], local[2 * chosen + 1] = 2 * np.arange(len(chosen)), 2 * np.arange(len(chosen)) + 1
        rows3 = [
            np.where(rows[where == label] >= 0, local[rows[where == label]], -1)
            for rows, where in zip(conditions, inside, strict=True)
        ]
        parts.append((LayerProblem(len(chosen), *rows3), chosen))
    return parts
