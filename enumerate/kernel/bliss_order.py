"""Canonical numbers of simple graphs as bliss gives them, without its search, compiled.

bliss refines colours, gives one vertex of a cell a colour of its own, refines again, and so on, and of all leaves
takes the best (`graphs.identity.leaves`). Where each cell that was split is one orbit of the symmetries that are
left, any leaf is as good; that is so exactly if the lengths of these cells multiply to the number of
automorphisms, which whoever places binary links knows. So one path is followed here; a graph whose numbers do not
come that way is left to bliss. The order of the cells is bliss's own. A cell is a set of vertices, one bit each;
its place is the number of vertices in the cells before it. Theory: docs/theory/chains.md.

Source: Junttila and Kaski, *Engineering an efficient canonical labeling tool for large and sparse graphs*, ALENEX
2007; *Conflict propagation and component recursion for canonical labeling*, TAPAS 2011.
"""

from typing import NamedTuple

import numpy as np

from enumerate.kernel.compiled import compiled, number_of_bits
from graphs.types import Ints

MOST_NODES = 62
"""The vertices of a set are bits of a word that has a sign, and of graph6 the number of nodes is one byte."""

_QUEUE = 64
_BEGIN, _WAITING, _NUMBER = 0, 1, 2


class _Cells(NamedTuple):
    """Ordered cells of vertices, and those among them by which the others are still to be refined.

    `at` holds the vertices of the cell at each place, 0 where none begins, `place` the place of the cell of each
    vertex. `queue` is a ring of 64 places; `state` says where it begins, the set of the places in it, and the
    number of cells. `parts` is work space, all zero.
    """

    at: Ints
    place: Ints
    queue: Ints
    state: Ints
    parts: Ints


@compiled
def bliss_orders(n: int, joints: Ints, automorphisms: Ints) -> tuple[Ints, Ints]:
    """Return canonical numbers of the nodes of simple graphs, and the graphs that have to be given to bliss.

    Node i of a graph has number ``order[i]``, as `graphs.identity.chains.canonical_numbers` says up to an
    automorphism; rows of the graphs for bliss hold nothing. There are `MOST_NODES` at most, and joints, int64[r,
    J, 2], are pairs, no pair twice. With 1 automorphism where their number is not known, only graphs are numbered
    that need no choice at all, and so have no symmetries.
    """
    rows = len(joints)
    order, left = np.empty((rows, n), np.int64), np.empty(rows, np.int64)
    cells = _Cells(
        np.zeros(n, np.int64),
        np.zeros(n, np.int64),
        np.zeros(_QUEUE, np.int64),
        np.zeros(3, np.int64),
        np.zeros(n, np.int64),
    )
    adjacent = np.zeros(n, np.int64)
    missing = 0
    for r in range(rows):
        for v in range(n):
            adjacent[v] = 0
        for k in range(joints.shape[1]):
            a, b = joints[r, k, 0], joints[r, k, 1]
            adjacent[a] |= 1 << b
            adjacent[b] |= 1 << a
        if _numbered(adjacent, cells, automorphisms[r]):
            for v in range(n):
                order[r, v] = cells.place[v]
        else:
            left[missing] = r
            missing += 1
    return order, left[:missing].copy()


@compiled
def _numbered(adjacent: Ints, cells: _Cells, automorphisms: int) -> bool:
    """Follow one path to a leaf; tell whether all leaves are images of it."""
    n = len(adjacent)
    _begin(adjacent, cells)
    _refine(adjacent, cells)
    regions, depth = np.empty(n, np.int64), 0
    regions[0] = (1 << n) - 1
    choices = 1
    while True:
        unsettled = 0
        for p in range(n):
            if not _is_single(cells.at[p]):
                unsettled |= cells.at[p]
        if not unsettled:
            return choices == automorphisms
        while not regions[depth] & unsettled:
            depth -= 1
        chosen, component = _chosen_cell(adjacent, cells, regions[depth])
        if component != regions[depth] & unsettled:
            depth += 1
            regions[depth] = component
        # If each cell that is split is one orbit of the stabiliser of the vertices before it, the product of their
        # sizes is the order of the group (orbit-stabiliser); otherwise it is greater.
        choices *= number_of_bits(cells.at[chosen])
        if choices > automorphisms:
            return False
        _single_out(cells, chosen)
        _refine(adjacent, cells)


@compiled
def _lowest(members: int) -> int:
    """Return the least in a set that is not empty."""
    return number_of_bits((members & -members) - 1)


@compiled
def _is_single(members: int) -> bool:
    """Tell whether there is one in a set, or none."""
    return members & (members - 1) == 0


@compiled
def _begin(adjacent: Ints, cells: _Cells) -> None:
    """Put vertices of equal degree into one cell, least degree first; all cells wait."""
    n = len(adjacent)
    for v in range(n):
        cells.at[v] = 0
        cells.parts[number_of_bits(adjacent[v])] |= 1 << v
    cells.state[_BEGIN] = cells.state[_WAITING] = cells.state[_NUMBER] = 0
    p = 0
    for degree in range(n):
        if cells.parts[degree]:
            _set_cell(cells, p, cells.parts[degree])
            p += number_of_bits(cells.parts[degree])
            cells.parts[degree] = 0
    for p in range(n):
        if cells.at[p]:
            _add(cells, p, _is_single(cells.at[p]))


@compiled
def _set_cell(cells: _Cells, p: int, members: int) -> None:
    """Let a set be the cell at a place."""
    cells.state[_NUMBER] += cells.at[p] == 0
    cells.at[p] = members
    while members:
        cells.place[_lowest(members)] = p
        members &= members - 1


@compiled
def _add(cells: _Cells, p: int, single: bool) -> None:
    """Let the cell at a place wait: before all others if it is one vertex, else behind them."""
    begin, waiting = cells.state[_BEGIN], cells.state[_WAITING]
    if single:
        begin = (begin - 1) % _QUEUE
        cells.state[_BEGIN] = begin
        cells.queue[begin] = p
    else:
        cells.queue[(begin + number_of_bits(waiting)) % _QUEUE] = p
    cells.state[_WAITING] = waiting | (1 << p)


@compiled
def _refine(adjacent: Ints, cells: _Cells) -> None:
    """Split cells until the vertices of each have equally many neighbours in any other."""
    while cells.state[_WAITING] and cells.state[_NUMBER] < len(adjacent):
        begin = cells.state[_BEGIN]
        p = cells.queue[begin]
        cells.state[_BEGIN] = (begin + 1) % _QUEUE
        cells.state[_WAITING] &= ~(1 << p)
        splitter = left = cells.at[p]
        beside = 0
        while left:
            beside |= adjacent[_lowest(left)]
            left &= left - 1
        touched = _places(cells, beside)
        while touched:
            _split(adjacent, cells, _lowest(touched), splitter)
            touched &= touched - 1


@compiled
def _places(cells: _Cells, members: int) -> int:
    """Return the places of the cells, of two vertices or more, that hold some vertices."""
    places = 0
    while members:
        p = cells.place[_lowest(members)]
        if not _is_single(cells.at[p]):
            places |= 1 << p
        members &= ~cells.at[p]
    return places


@compiled
def _split(adjacent: Ints, cells: _Cells, p: int, splitter: int) -> None:
    """Split a cell by how many neighbours in a set its vertices have, fewest first."""
    parts, left, most = cells.parts, cells.at[p], 0
    waits = (cells.state[_WAITING] >> p) & 1
    if _is_single(splitter):
        beside = adjacent[_lowest(splitter)]
        parts[0], parts[1], most, left = left & ~beside, left & beside, 1, 0
    while left:
        count = number_of_bits(adjacent[_lowest(left)] & splitter)
        parts[count] |= left & -left
        most = max(most, count)
        left &= left - 1
    if parts[most] == cells.at[p]:
        parts[most] = 0
        return
    largest, first, end = -1, p, p + number_of_bits(cells.at[p])
    for count in range(most + 1):
        if parts[count] == 0:
            continue
        _set_cell(cells, p, parts[count])
        parts[count] = 0
        if waits and p > first:
            _add(cells, p, p == end - 1)  # for bliss, it still holds the vertices behind it
        elif not waits:
            largest = _passed_over(cells, largest, p, most)
        p += number_of_bits(cells.at[p])
    if not waits and _is_single(cells.at[largest]):
        _add(cells, largest, True)


@compiled
def _passed_over(cells: _Cells, largest: int, p: int, most: int) -> int:
    """Let a new cell wait, or the largest up to now if it is larger than that; return which does not."""
    if largest < 0:
        return p
    size, other = number_of_bits(cells.at[p]), number_of_bits(cells.at[largest])
    if size > other or (size == other and most == 1):  # with two numbers of neighbours, 0 and 1, the first waits
        _add(cells, largest, other == 1)
        return p
    _add(cells, p, size == 1)
    return largest


@compiled
def _chosen_cell(adjacent: Ints, cells: _Cells, region: int) -> tuple[int, int]:
    """Return the place of the cell to split next, and the vertices of its component.

    The component is that of the first cell in a region that has two vertices or more; cells belong together where
    their vertices are neighbours of some, not all, vertices of the other.
    """
    first = 0
    while _is_single(cells.at[first]) or not cells.at[first] & region:
        first += 1
    found = todo = 1 << first
    chosen, most, component = first, -1, 0
    while todo:
        p = _lowest(todo)
        todo &= todo - 1
        component |= cells.at[p]
        beside = adjacent[_lowest(cells.at[p])]
        near, number = _places(cells, beside), 0
        while near:
            q = _lowest(near)
            near &= near - 1
            if cells.at[q] & ~beside:
                number += 1
                todo |= (1 << q) & ~found
                found |= 1 << q
        if number > most or (number == most and p < chosen):
            chosen, most = p, number
    return chosen, component


@compiled
def _single_out(cells: _Cells, p: int) -> None:
    """Give one vertex of a cell a cell of its own, behind the others."""
    members = cells.at[p]
    vertex = members & -members
    last = p + number_of_bits(members) - 1
    _set_cell(cells, p, members & ~vertex)
    _set_cell(cells, last, vertex)
    if _is_single(cells.at[p]):
        _add(cells, p, True)
    _add(cells, last, True)
