"""Contracted graphs streamed: each comes from one parent, so none has to be looked up among others, compiled.

`enumerate.contracted.graphs` contracts joints and throws away what was found before; all graphs of a size are in
memory for that. Here a graph is taken from one parent only, which it chooses itself: of the ways to split a link
that are looked at (`enumerate.contracted.graphs.cheapest_degree`), the first by the canonical numbers of links.
A contraction whose undoing is no image of that one under the graph's automorphisms gives the graph to another
parent, and is passed over. So the graphs that come from one cubic graph are its own, and those of all cubic
graphs, made anywhere and in any order, are all there are, each once. Theory: docs/theory/chains.md.

Source: McKay, *Isomorph-free exhaustive generation*, J. Algorithms 26 (1998).
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from enumerate.contracted.graphs import contract, cubic_graphs, decode, degrees, encode, is_contracted
from enumerate.kernel.compiled import compiled, doubled
from enumerate.kernel.labelling import canonical_labels
from graphs.types import Bytes, Ints

__all__ = ["descendants", "streamed_graphs"]

_ANCESTORS = 32
"""Cubic graphs whose descendants are made together: some ten thousands of graphs with ten loops."""


def streamed_graphs(loops: int) -> Iterator[tuple[int, Bytes]]:
    """Yield all contracted graphs with a number of loops in batches; only the cubic ones are in memory at once.

    Parameters
    ----------
    loops : int
        Independent loops L, 2 to 11.

    Yields
    ------
    links : int
        n, which is that of many batches.
    codes : uint8[k, n + L - 1]
        One row a graph, no two isomorphic in all batches: the graphs of
        `enumerate.contracted.graphs.contracted_graphs`, in another order.

    Raises
    ------
    InvariantError
        If there are too few or too many loops.

    Examples
    --------
    >>> sum(len(codes) for _, codes in streamed_graphs(5))
    118
    """
    cubic = cubic_graphs(loops)
    for start in range(0, len(cubic), _ANCESTORS):
        yield from descendants(cubic[start : start + _ANCESTORS], 2 * (loops - 1))


def descendants(codes: Bytes, n: int) -> Iterator[tuple[int, Bytes]]:
    """Yield contracted graphs and all that come from them and from no others, those with most links first.

    Parameters
    ----------
    codes : uint8[k, m]
        Contracted graphs, all different.
    n : int
        Their number of links.

    Yields
    ------
    links : int
        From n down to 2, or to where there are none.
    codes : uint8[k, m - n + links]

    Examples
    --------
    >>> {links: len(codes) for links, codes in descendants(cubic_graphs(4)[:1], 6)}
    {6: 1, 5: 2, 4: 4, 3: 1, 2: 1}
    """
    while len(codes):
        yield n, codes
        if n == 2:
            return
        codes, n = _children(codes, n), n - 1


@compiled
def _children(parents: Bytes, n: int) -> Bytes:
    """Return the codes of the graphs with a link less that come from these graphs with n links."""
    joints = parents.shape[1] - 1
    rows, used = np.zeros((64, joints), np.uint8), 0
    for parent in range(len(parents)):
        adjacency = decode(parents[parent], n)
        _, automorphisms = canonical_labels(adjacency, n)
        degree = degrees(parents[parent], n)
        for u in range(n):
            for v in range(u):
                if not is_contracted(adjacency, n, degree, automorphisms, u, v):
                    continue
                child = contract(adjacency, n, u, v)
                order, symmetries = canonical_labels(child, n - 1)
                numbers = np.zeros(n - 1, np.int64)
                for i in range(n - 1):
                    numbers[order[i]] = i
                halves = _halves(adjacency, n, u, v, numbers)
                if not _is_first_split(child, order, symmetries, numbers[v], halves):
                    continue
                rows = doubled(rows) if used == len(rows) else rows
                encode(child, order, rows[used])
                used += 1
    return rows[:used].copy()


@compiled
def _halves(adjacency: Bytes, n: int, u: int, v: int, numbers: Ints) -> Ints:
    """Return where the other two joints of a ternary link of two lead, u > v, that become one: int64[h, 2].

    A row for u, for v, or for each if both are ternary, the lesser number first; `numbers`, int64[n - 1], are
    those that links have when u is gone.
    """
    found = np.zeros((2, 2), np.int64)
    used = 0
    for k in range(2):
        link, other = (u, v) if k == 0 else (v, u)
        joints = 0
        for w in range(n):
            joints += adjacency[link, w]
        if joints != 3:
            continue
        at = 0
        for w in range(n):
            for _ in range(adjacency[link, w] if w != other else 0):
                found[used, at] = numbers[w - (w > u)]
                at += 1
        if found[used, 0] > found[used, 1]:
            found[used, 0], found[used, 1] = found[used, 1], found[used, 0]
        used += 1
    return found[:used]


@compiled
def _is_first_split(child: Bytes, order: Bytes, symmetries: Bytes, link: int, halves: Ints) -> bool:
    """Return whether a symmetry takes a split of a graph to the first of all that are looked at.

    The first split takes the first link of a degree, and the first two of its joints. `order` is the link that has
    each canonical number, symmetries, uint8[a, n], are automorphisms of these numbers; halves, int64[h, 2], are
    numbers of the links to which two joints lead that are split off, and in the other row, where there are two,
    those of the joints that are left.
    """
    n = len(order)
    degree = np.zeros(n, np.int64)
    for i in range(n):
        for j in range(n):
            degree[i] += child[order[i], order[j]]
    first = 0
    while degree[first] != degree[link]:
        first += 1
    one = other = -1
    for w in range(n):
        for _ in range(child[order[first], order[w]]):
            if one < 0:
                one = w
            elif other < 0:
                other = w
    for a in range(len(symmetries)):
        if symmetries[a, link] != first:
            continue
        for h in range(len(halves)):
            p, q = symmetries[a, halves[h, 0]], symmetries[a, halves[h, 1]]
            if min(p, q) == one and max(p, q) == other:
                return True
    return False
