"""Contracted graphs: what is left of a kinematic chain when its binary links are taken out.

A chain with L >= 2 loops becomes a 2-connected multigraph without self-joints in which every link has three joints
or more: n <= 2 (L - 1) links, n + L - 1 joints. Those with the most links are cubic; every other one comes from a
graph with one link more by contracting a joint, since any split of the joints of a link into two sets of two or
more gives such a graph. So joints are contracted only at a ternary link, and only where the new link has the one
degree that can be split in the fewest ways (`cheapest_degree`). A graph is held as its *code*: the places of its
joints in the lower triangle of the canonical matrix, in order, a byte each. *Level by level*, repeated graphs are
thrown away, all of a size being in memory. *Streamed*, a graph is taken only from the parent that the first of its
splits undoes (McKay, *Isomorph-free exhaustive generation*, J. Algorithms 26, 1998), so each comes from one cubic
graph. Theory: docs/theory/chains.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from enumerate.kernel._compiled import compiled, doubled, empty_set, insert
from enumerate.kernel.labelling import canonical_labels
from enumerate.machine_code.weights import expect, placing
from graphs.errors import InvariantError
from graphs.types import Bytes, Ints

MOST_LOOPS = 11
"""20 links at most, so that a place in the matrix fits a byte, and the conditions on placements their counters."""


def contracted_graphs(loops: int) -> Iterator[tuple[int, Bytes]]:
    """Yield all contracted graphs with a number of loops, those of equally many links together, most links first.

    Parameters
    ----------
    loops : int
        Independent loops L, 2 to 11.

    Yields
    ------
    links : int
        n, from 2 (L - 1) down to 2.
    codes : uint8[k, n + L - 1]
        One row a graph, no two isomorphic; `decode` gives the matrices.

    Raises
    ------
    InvariantError
        If there are too few or too many loops.

    Examples
    --------
    >>> {links: len(codes) for links, codes in contracted_graphs(4)}
    {6: 5, 5: 4, 4: 5, 3: 2, 2: 1}
    """
    yield from _growth(loops).levels(loops)


def cubic_graphs(loops: int) -> Bytes:
    """Return the codes of all 2-connected cubic multigraphs with 2 (L - 1) links, one row each: uint8[k, m].

    Each comes from one with two links less by subdividing two joints, or one joint twice, and joining the new
    links: the last ear of an ear decomposition of a cubic graph is a single joint.

    Parameters
    ----------
    loops : int
        As for `contracted_graphs`, with its errors.

    Examples
    --------
    >>> [len(cubic_graphs(loops)) for loops in (2, 3, 4, 5)]
    [1, 2, 5, 16]
    """
    return _growth(loops).cubic(loops)


def _growth(loops: int) -> Growth:
    """Return how contracted graphs of so many loops come from each other, and use machine code where it pays."""
    expect(placing(loops, 1))
    two_links_with_three_joints = np.zeros((1, 3), np.uint8)
    return Growth(MOST_LOOPS, two_links_with_three_joints, _extend_all, _contract_all)


@compiled
def decode(code: Bytes, n: int) -> Bytes:
    """Return the matrix of a code: uint8[n, n], the numbers of joints between links."""
    adjacency = np.zeros((n, n), np.uint8)
    for place in code:
        u, v = _ends(place)
        adjacency[u, v] += 1
        adjacency[v, u] += 1
    return adjacency


@compiled
def _ends(place: int) -> tuple[int, int]:
    """Return row and column of a place in the lower triangle."""
    row, first = 1, 0
    while place >= first + row:
        first += row
        row += 1
    return row, int(place) - first


@compiled
def encode(adjacency: Bytes, order: Bytes, code: Bytes) -> None:
    """Write the code of a matrix whose links are taken in the order given."""
    k = 0
    for i in range(1, len(order)):
        for j in range(i):
            for _ in range(adjacency[order[i], order[j]]):
                code[k] = i * (i - 1) // 2 + j
                k += 1


@compiled
def graph_key(adjacency: Bytes, n: int) -> Bytes:
    """Return the code of a contracted graph given by its matrix."""
    code = np.empty(int(adjacency.sum()) // 2, np.uint8)
    order, _ = canonical_labels(adjacency, n)
    encode(adjacency, order, code)
    return code


@compiled
def _contract_all(parents: Bytes, n: int) -> Bytes:
    """Return the codes of the graphs that contracting a joint of a graph with n links gives, one row each."""
    table, rows, used = empty_set(parents.shape[1] - 1)
    for parent in range(len(parents)):
        adjacency = decode(parents[parent], n)
        _, automorphisms = canonical_labels(adjacency, n)
        degree = degrees(parents[parent], n)
        for u in range(n):
            for v in range(u):
                if is_contracted(adjacency, n, degree, automorphisms, u, v):
                    code = graph_key(contract(adjacency, n, u, v), n - 1)
                    table, rows, used = insert(table, rows, used, code)
    return rows[:used].copy()


@compiled
def degrees(code: Bytes, n: int) -> Ints:
    """Return the numbers of joints at the links of a code."""
    degree = np.zeros(n, np.int64)
    for place in code:
        u, v = _ends(place)
        degree[u] += 1
        degree[v] += 1
    return degree


@compiled
def is_contracted(adjacency: Bytes, n: int, degree: Ints, automorphisms: Bytes, u: int, v: int) -> bool:
    """Tell whether graphs are looked for by making one link of two, u > v: where it can be done, and is cheap."""
    return bool(
        adjacency[u, v] == 1
        and (degree[u] == 3 or degree[v] == 3)
        and degree[u] + degree[v] - 2 == cheapest_degree(degree, u, v, False)
        and _is_first(u, v, automorphisms)
        and _stays_connected(adjacency, n, u, v)
    )


@compiled
def cheapest_degree(degree: Ints, u: int, v: int, drawn: bool) -> int:
    """Return the degree, above 3, whose links can be split in the fewest ways once u and v are one link.

    A graph's link is split by any two of its joints, a drawn one by two joints beside each other.
    """
    count = np.zeros(64, np.int64)
    for w in range(len(degree)):
        if w not in (u, v):
            count[degree[w]] += 1
    count[degree[u] + degree[v] - 2] += 1
    best, fewest = 0, 0
    for d in range(4, 64):
        splits = d if drawn else d * (d - 1) // 2
        ways = count[d] * (splits // 2 if d == 4 else splits)
        if ways and (best == 0 or ways < fewest):
            best, fewest = d, ways
    return best


@compiled
def _is_first(u: int, v: int, automorphisms: Bytes) -> bool:
    """Tell whether no automorphism takes the pair u > v to one that comes earlier in the matrix."""
    place = u * (u - 1) // 2 + v
    for a in range(1, len(automorphisms)):
        i, j = np.int64(automorphisms[a, u]), np.int64(automorphisms[a, v])
        if i < j:
            i, j = j, i
        if i * (i - 1) // 2 + j < place:
            return False
    return True


@compiled
def _stays_connected(adjacency: Bytes, n: int, u: int, v: int) -> bool:
    """Tell whether the graph without the links u and v is connected."""
    seen = np.zeros(n, np.bool_)
    seen[u] = seen[v] = True
    stack = np.empty(n, np.int64)
    first = 0
    while first in (u, v):
        first += 1
    stack[0], top, left = first, 1, n - 3
    seen[first] = True
    while top:
        top -= 1
        w = stack[top]
        for x in range(n):
            if adjacency[w, x] and not seen[x]:
                seen[x] = True
                stack[top] = x
                top += 1
                left -= 1
    return left == 0


@compiled
def contract(adjacency: Bytes, n: int, u: int, v: int) -> Bytes:
    """Return the matrix with u > v made one link, the joint between them gone."""
    child = np.zeros((n - 1, n - 1), np.uint8)
    for i in range(n):
        for j in range(i):
            if i == u and j == v:
                continue
            a, b = v if i == u else i - (i > u), v if j == u else j - (j > u)
            child[a, b] += adjacency[i, j]
            child[b, a] += adjacency[i, j]
    return child


@compiled
def _extend_all(parents: Bytes, n: int) -> Bytes:
    """Return the codes of the cubic graphs with two links more than these with n links."""
    table, rows, used = empty_set(parents.shape[1] + 3)
    for parent in range(len(parents)):
        adjacency = decode(parents[parent], n + 2)
        for place in parents[parent]:
            for other in parents[parent]:
                if other > place:
                    break
                for twice in range(2 if place == other else 1):
                    child = _bridge(adjacency, n, place, other, twice == 1)
                    if len(child):
                        table, rows, used = insert(table, rows, used, graph_key(child, n + 2))
    return rows[:used].copy()


@compiled
def _bridge(adjacency: Bytes, n: int, place: int, other: int, twice: bool) -> Bytes:
    """Return the matrix with links n and n + 1 put on two joints and joined; an empty one where that cannot be.

    With equal places: on two parallel joints, or, if ``twice``, both on one joint.
    """
    a, b = _ends(place)
    c, d = _ends(other)
    child = adjacency.copy()
    if place == other and not twice and adjacency[a, b] < 2:
        return child[:0]
    s, t = n, n + 1
    _add(child, a, b, -1)
    _add(child, a, s, 1)
    _add(child, t, d, 1)
    _add(child, s, t, 1)
    if twice:
        _add(child, s, t, 1)
    else:
        _add(child, s, b, 1)
        _add(child, c, d, -1)
        _add(child, c, t, 1)
    return child


@compiled
def _add(adjacency: Bytes, u: int, v: int, joints: int) -> None:
    """Add joints between two links."""
    adjacency[u, v] = int(adjacency[u, v]) + joints
    adjacency[v, u] = int(adjacency[v, u]) + joints


class Growth(NamedTuple):
    """A kind of cubic graphs or maps that extend to larger ones, and whose joints can be contracted.

    `smallest` holds the codes of those with two links and two loops; `extend` and `contract` take codes and
    their number of links, and return the codes of those with two links more, and one loop more, or with a link
    less.
    """

    most_loops: int
    smallest: Bytes
    extend: Callable[[Bytes, int], Bytes]
    contract: Callable[[Bytes, int], Bytes]

    def cubic(self, loops: int) -> Bytes:
        """Return the codes of all cubic ones with so many loops.

        Raises `InvariantError` if these are too few or too many.
        """
        if not 2 <= loops <= self.most_loops:
            raise InvariantError("loops", f"{loops} loops", f"2 to {self.most_loops}")
        codes = self.smallest
        for links in range(2, 2 * (loops - 1), 2):
            codes = self.extend(codes, links)
        return codes

    def levels(self, loops: int) -> Iterator[tuple[int, Bytes]]:
        """Yield numbers of links, most first, and the codes of all with so many links and loops."""
        codes = self.cubic(loops)
        most = 2 * (loops - 1)
        yield most, codes
        for links in range(most, 2, -1):
            codes = self.contract(codes, links)
            yield links - 1, codes


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
            joints += int(adjacency[link, w])
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
