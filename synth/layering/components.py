"""Components: variables that conditions tie to each other, before equal ones are made one.

They are those that Flat-Folder lists: two variables are of one component if a condition speaks of both that is not
kept whatever they are. A transitivity is left out where two of its variables are equal since creases join the panels
on one side of it. A component may fall into independent parts later (`synth.layering.reduction`), of which it has the
product of the counts. Source: J. Ku, Flat-Folder. Theory: docs/theory/layer-orders.md.
"""

from functools import cache
from itertools import product

import numpy as np

from graphs.types import Flags, Ints, Signs
from synth.layering.constraints import LayerConstraints, PairTable, joined, pairs_of


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
