"""Canonical labels and automorphisms of small multigraphs, compiled.

The search is the classical one: refine colours until every vertex of a colour sees the same colours, single out
each vertex of a cell in turn, and refine again, until every vertex has a colour of its own; the least matrix
of all such leaves is the canonical form. Branches whose colours refine otherwise than the best one's are cut.
Branches that are images of each other are *not*: every automorphism is met once, as a leaf equal to the best, and
the enumerators need them all. Made for the graphs of this package (2-connected, three joints or more at each
vertex, few vertices), whose groups are small; ids of mechanisms come from `graphs.identity.chains`.

Source: McKay and Piperno, *Practical graph isomorphism, II*, J. Symb. Comput. 60 (2014), section 2.
"""

import numpy as np

from enumerate.kernel._compiled import compiled, doubled
from enumerate.kernel.words import ALL, hashed, mixed
from enumerate.machine_code.kernels import compiled_beside
from graphs.types import Bytes, Words

MOST_VERTICES = 22
"""A pair of vertices must fit one byte."""

# Numbers of parallel joints are below: more than a chain of the loops that are enumerated can have between two links.
_MOST_PARALLEL = 32
_MIX = np.random.default_rng(20161005).integers(1, 2**63, size=(MOST_VERTICES + 1, _MOST_PARALLEL), dtype=np.uint64)
"""Random words for (colour of a neighbour, number of joints to it); any words give correct labels."""


@compiled
def neighbours(adjacency: Bytes, n: int) -> tuple[Bytes, Bytes, Bytes]:
    """Return for each vertex its neighbours, the numbers of joints to them, and how many neighbours there are."""
    ends = np.zeros((n, n), np.uint8)
    joints = np.zeros((n, n), np.uint8)
    count = np.zeros(n, np.uint8)
    for v in range(n):
        for u in range(n):
            if adjacency[v, u]:
                ends[v, count[v]] = u
                joints[v, count[v]] = adjacency[v, u]
                count[v] += 1
    return ends, joints, count


_WORDS = _MIX.tolist()


def _refine(ends: Bytes, joints: Bytes, count: Bytes, n: int, order: Bytes, colour: Bytes, sums: Words) -> np.uint64:
    """Do what `refine` does, on lists: Python reads a number of a list ten times as fast as one of an array."""
    del sums
    rows = zip(ends.tolist(), joints.tolist(), count.tolist(), strict=True)
    around = [list(zip(vertices[:k], numbers[:k], strict=True)) for vertices, numbers, k in rows]
    vertices, colours = order.tolist(), colour.tolist()
    cells = sum(colours[v] == i for i, v in enumerate(vertices))
    trace = 0
    while True:
        keys = [(colours[v], sum(_WORDS[colours[u]][k] for u, k in near) & ALL) for v, near in enumerate(around)]
        vertices.sort(key=keys.__getitem__)
        start = new_cells = 0
        for i, v in enumerate(vertices):
            if i == 0 or keys[v] != keys[vertices[i - 1]]:
                start, new_cells = i, new_cells + 1
            colours[v] = start
            trace = hashed(trace, keys[v][1], start, 29)
        if new_cells in (cells, n):
            order[:], colour[:] = vertices, colours
            return np.uint64(trace)
        cells = new_cells


@compiled_beside(_refine)
def refine(ends: Bytes, joints: Bytes, count: Bytes, n: int, order: Bytes, colour: Bytes, sums: Words) -> np.uint64:
    """Refine a colouring in place until it is equitable; return a hash of how it went.

    Ends, joints and count are those of `neighbours`; `order` holds the vertices by colour and is sorted anew; a
    colour is the number of vertices of smaller colours. `sums` is work space.
    """
    trace = np.uint64(0)
    cells = 0
    for i in range(n):
        cells += colour[order[i]] == i
    while True:
        for v in range(n):
            total = np.uint64(0)
            for k in range(count[v]):
                total += _MIX[colour[ends[v, k]], joints[v, k]]
            sums[v] = total
        new_cells = 1
        i = 0
        while i < n:
            start = i
            first = colour[order[start]]
            i += 1
            while i < n and colour[order[i]] == first:  # insertion sort of the cell by the sums
                v = order[i]
                j = i
                while j > start and sums[order[j - 1]] > sums[v]:
                    order[j] = order[j - 1]
                    j -= 1
                order[j] = v
                i += 1
        previous_colour, previous_sum, start = colour[order[0]], sums[order[0]], 0
        for i in range(n):
            v = order[i]
            if colour[v] != previous_colour or sums[v] != previous_sum:
                previous_colour, previous_sum, start = colour[v], sums[v], i
                new_cells += 1
            colour[v] = start
            trace = mixed(trace, sums[v], np.uint64(start), np.uint64(29))
        if new_cells in (cells, n):  # sums split no cell any more: the colouring is equitable
            return trace
        cells = new_cells


@compiled
def _first_cell(order: Bytes, colour: Bytes, n: int) -> tuple[int, int]:
    """Return start and end of the first smallest cell of two vertices or more; (n, n) where there is none."""
    best, best_end = n, n
    i = 0
    while i < n:
        j = i + 1
        while j < n and colour[order[j]] == i:
            j += 1
        if j - i > 1 and (best == n or j - i < best_end - best):
            best, best_end = i, j
        i = j
    return best, best_end


@compiled
def _compare(adjacency: Bytes, order: Bytes, best: Bytes, n: int) -> int:
    """Compare the matrix in one order of the vertices with that in another: -1 less, 0 equal, 1 greater."""
    for i in range(1, n):
        for j in range(i):
            a, b = adjacency[order[i], order[j]], adjacency[best[i], best[j]]
            if a != b:
                return -1 if a < b else 1
    return 0


@compiled
def canonical_labels(adjacency: Bytes, n: int) -> tuple[Bytes, Bytes]:
    """Return canonical labels of a multigraph of 1 to `MOST_VERTICES` vertices, and its automorphisms.

    The matrix, uint8[>=n, >=n], of numbers of joints is symmetric, below 32, and 0 on the diagonal. The matrix
    ``adjacency[order][:, order]`` is canonical. Automorphisms, uint8[k, n], are all those of the relabelled graph,
    the identity first: vertex i goes to ``automorphisms[a, i]``.
    """
    ends, joints, count = neighbours(adjacency, n)
    orders = np.zeros((n + 1, n), np.uint8)
    colours = np.zeros((n + 1, n), np.uint8)
    sums = np.zeros(n, np.uint64)
    at = np.zeros(n + 1, np.int64)  # of each level: the place in the cell that is being tried, and its end
    end = np.zeros(n + 1, np.int64)
    traces = np.zeros(n + 1, np.uint64)
    # Traces are the same for images under automorphisms, so a node whose trace is greater than the best of its
    # level has no best leaf below it; one with a lesser trace makes all leaves up to now worse.
    known, has_leaf = 0, False  # levels whose best trace is known; is there a leaf for them
    best = np.zeros(n, np.uint8)
    place = np.zeros(n, np.uint8)
    automorphisms = np.zeros((8, n), np.uint8)
    found = 0
    for v in range(n):
        orders[0, v] = v
    depth = 0
    fresh = True  # the node at `depth` is new: refine and judge it
    while depth >= 0:
        if fresh:
            trace = refine(ends, joints, count, n, orders[depth], colours[depth], sums)
            if depth < known and trace > traces[depth]:
                depth -= 1
                fresh = False
                continue
            if depth >= known or trace < traces[depth]:
                traces[depth], known, has_leaf = trace, depth + 1, False
            at[depth], end[depth] = _first_cell(orders[depth], colours[depth], n)
            if at[depth] == n:
                verdict = _compare(adjacency, orders[depth], best, n) if has_leaf else -1
                if verdict < 0:
                    for i in range(n):
                        best[i] = orders[depth, i]
                        place[best[i]] = i
                    found, has_leaf = 0, True
                if verdict <= 0:  # equal matrices: what takes the best order to this one is an automorphism
                    automorphisms = doubled(automorphisms) if found == len(automorphisms) else automorphisms
                    for i in range(n):
                        automorphisms[found, i] = place[orders[depth, i]]
                    found += 1
        if at[depth] == end[depth]:
            depth -= 1
            fresh = False
            continue
        start = colours[depth, orders[depth, at[depth]]]
        for i in range(n):
            orders[depth + 1, i], colours[depth + 1, i] = orders[depth, i], colours[depth, i]
        _single_out(orders[depth + 1], colours[depth + 1], start, at[depth], end[depth])
        at[depth] += 1
        depth += 1
        fresh = True
    return best, automorphisms[:found]


@compiled
def _single_out(order: Bytes, colour: Bytes, start: int, chosen: int, end: int) -> None:
    """Give the vertex at a place of a cell a colour of its own, before the others of the cell."""
    order[start], order[chosen] = order[chosen], order[start]
    for i in range(start + 1, end):
        colour[order[i]] = start + 1
