"""Contracted maps: the contracted graphs of planar chains, drawn on the sphere in all ways.

A chain drawn on the sphere becomes, when its binary links are taken out, a 2-connected map in which every link has
three joints or more, parallel joints allowed. Maps come from each other like the graphs of
`enumerate.contracted.graphs`: cubic ones with one more loop by a joint across a face, the others by contracting
joints, where a map is 2-connected as long as no face meets a link twice. Codes are those of
`enumerate.kernel.maps`. Theory: docs/theory/sc-enumeration.md.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from enumerate.contracted.graphs import cheapest_degree
from enumerate.contracted.growth import Growth
from enumerate.kernel.compiled import compiled
from enumerate.kernel.maps import canonical_map, decode_map, faces_of, from_turns, symmetries_of_map
from enumerate.kernel.row_set import empty_set, insert
from graphs.types import Bytes, Ints

__all__ = ["MOST_MAP_LOOPS", "contracted_maps", "cubic_maps", "map_symmetries"]

MOST_MAP_LOOPS = 9
"""The maps of all levels are held in memory: 4 million for ten loops."""


def contracted_maps(loops: int) -> Iterator[tuple[int, Bytes]]:
    """Yield all contracted maps with a number of loops, those of equally many links together, most links first.

    Parameters
    ----------
    loops : int
        Independent loops L, 2 to 9: the maps have L + 1 faces.

    Yields
    ------
    links : int
        n, from 2 (L - 1) down to 2.
    codes : uint8[k, 3 n + 2 (L - 1)]
        One row a map, no two equal or mirror images on the sphere; `enumerate.kernel.maps.decode_map` gives the
        map.

    Raises
    ------
    InvariantError
        If there are too few or too many loops.

    Examples
    --------
    >>> {links: len(codes) for links, codes in contracted_maps(4)}
    {6: 4, 5: 4, 4: 5, 3: 2, 2: 1}
    """
    yield from _growth().levels(loops)


def cubic_maps(loops: int) -> Bytes:
    """Return the codes of all 2-connected cubic maps with L + 1 faces, one row each.

    Parameters
    ----------
    loops : int
        L, from 2 on.

    Returns
    -------
    uint8[maps, length]

    Raises
    ------
    InvariantError
        If there are too few or too many loops.

    Examples
    --------
    >>> [len(cubic_maps(loops)) for loops in (2, 3, 4, 5)]
    [1, 2, 4, 14]
    """
    return _growth().cubic(loops)


def _growth() -> Growth:
    return Growth(MOST_MAP_LOOPS, _theta, _extend_all, _contract_all)


@compiled
def map_symmetries(turn: Ints, vertex: Ints) -> tuple[Ints, Ints]:
    """Return the symmetries of a map, whichever face lies outside, as permutations of darts and of corners."""
    _, orders, sides = _canonical(turn, vertex)
    return symmetries_of_map(turn, orders, sides)


@compiled
def _canonical(turn: Ints, vertex: Ints) -> tuple[Bytes, Ints, Ints]:
    """Return canonical code and readings; roots are picked by the degrees of the links and faces about a dart."""
    darts = len(vertex)
    face, faces = faces_of(turn)
    degree, length = np.zeros(darts, np.int64), np.zeros(faces, np.int64)
    for d in range(darts):
        degree[vertex[d]] += 1
        length[face[d]] += 1
    key = np.zeros((2, darts), np.int64)
    for d in range(darts):
        ends = 256 * degree[vertex[d]] + degree[vertex[d ^ 1]]
        left, right = length[face[d]], length[face[d ^ 1]]
        key[0, d] = 256 * (256 * ends + left) + right
        key[1, d] = 256 * (256 * ends + right) + left
    none = np.zeros(darts, np.int64)
    return canonical_map(turn, vertex, none, face, none[:0], key)


@compiled
def _theta() -> Bytes:
    """Return the code of two links with three joints."""
    vertex = np.array([0, 1, 0, 1, 0, 1])
    code, _, _ = _canonical(from_turns(np.array([2, 5, 4, 1, 0, 3])), vertex)
    codes = np.zeros((1, len(code)), np.uint8)
    for k in range(len(code)):
        codes[0, k] = code[k]
    return codes


@compiled
def _extend_all(parents: Bytes, links: int) -> Bytes:
    """Return the codes of the cubic maps with two links more than these: with a joint across a face."""
    table, rows, used = empty_set(parents.shape[1] + 8)
    for parent in range(len(parents)):
        turn, vertex, _ = decode_map(parents[parent])
        face, _ = faces_of(turn)
        darts = turn.shape[1]
        for d in range(darts):
            for e in range(d, darts):
                if face[d] == face[e]:
                    after, ends = _bridged(turn, vertex, links, d, e)
                    code, _, _ = _canonical(from_turns(after), ends)
                    table, rows, used = insert(table, rows, used, code)
    return rows[:used].copy()


@compiled
def _bridged(turn: Ints, vertex: Ints, links: int, d: int, e: int) -> tuple[Ints, Ints]:
    """Return ``turn[0]`` and ``vertex`` with new links on the joints of two darts of a face, and a joint between.

    The joint of d may be that of e; both new links are then on it.
    """
    darts = len(vertex)
    after, ends = np.empty(darts + 6, np.int64), np.empty(darts + 6, np.int64)
    for k in range(darts):
        after[k], ends[k] = turn[0, k], vertex[k]
    across = darts + 4
    _subdivide(after, ends, d, darts, links, across)
    _subdivide(after, ends, darts if e == d else e, darts + 2, links + 1, across + 1)
    return after, ends


@compiled
def _subdivide(after: Ints, ends: Ints, d: int, new: int, link: int, across: int) -> None:
    """Put a link on the joint of dart d, with the dart ``across`` on the left of d; ``new`` leads on from there.

    The joint of d keeps its dart d; its other dart moves to the new link. ``new ^ 1`` takes its place.
    """
    back = d ^ 1
    before = back
    while after[before] != back:
        before = after[before]
    after[new ^ 1] = after[back] if before != back else new ^ 1
    if before != back:
        after[before] = new ^ 1
    ends[new ^ 1] = ends[back]
    ends[back] = ends[new] = ends[across] = link
    after[new], after[across], after[back] = across, back, new


@compiled
def _contract_all(parents: Bytes, links: int) -> Bytes:
    """Return the codes of the maps that contracting a joint of a map gives, one row each.

    Any link with four joints or more can be split in two. So of the ways to get a map, only those are taken that
    undo the splitting off of a ternary link from a link of the degree for which there are the fewest ways.
    """
    table, rows, used = empty_set(parents.shape[1] - 3)
    for parent in range(len(parents)):
        turn, vertex, _ = decode_map(parents[parent])
        darts = turn.shape[1]
        face, faces = faces_of(turn)
        meets = np.zeros((faces, links), np.bool_)
        degree = np.zeros(links, np.int64)
        for d in range(darts):
            meets[face[d], vertex[d]] = True
            degree[vertex[d]] += 1
        for d in range(0, darts, 2):
            u, v = vertex[d], vertex[d ^ 1]
            if degree[u] != 3 and degree[v] != 3:
                continue
            common = (
                0  # faces that meet both links: more than the two beside the joint would meet the one link twice
            )
            for f in range(faces):
                common += meets[f, u] and meets[f, v]
            if common == 2 and degree[u] + degree[v] - 2 == cheapest_degree(degree, u, v, True):
                after, ends = _contracted(turn, vertex, d)
                code, _, _ = _canonical(from_turns(after), ends)
                table, rows, used = insert(table, rows, used, code)
    return rows[:used].copy()


@compiled
def _contracted(turn: Ints, vertex: Ints, d: int) -> tuple[Ints, Ints]:
    """Return ``turn[0]`` and ``vertex`` without the joint of an even dart d, its two links made one."""
    darts, kept, gone = len(vertex), vertex[d], vertex[d ^ 1]
    after = np.empty(darts, np.int64)
    for k in range(darts):
        after[k] = turn[0, k]
    after[turn[1, d]] = turn[0, d ^ 1]
    after[turn[1, d ^ 1]] = turn[0, d]
    child, ends = np.empty(darts - 2, np.int64), np.empty(darts - 2, np.int64)
    for k in range(darts):
        if k >> 1 != d >> 1:
            link = kept if vertex[k] == gone else vertex[k]
            place = k - 2 * (k > d)
            child[place] = after[k] - 2 * (after[k] > d)
            ends[place] = link - (link > gone)
    return child, ends
