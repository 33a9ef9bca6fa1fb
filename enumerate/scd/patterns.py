"""Open edges in the corners of a drawn mechanism: the rules they obey, compiled.

Rules S1 and S2 (`graphs.mechanism.scd`) look at the points that joints and links share: the centres of the
classes, and the vertices in faces without a centre that several joints end in. These depend on one thing only: in
which corners of the faces without a centre there is no open edge. A *pattern* says so for every such corner; it is
valid or not, however many open edges there are elsewhere. Theory: docs/theory/scd-enumeration.md.
"""

from __future__ import annotations

import numpy as np

from enumerate.kernel.centre_labels import FINITE, INFINITE
from enumerate.kernel.compiled import compiled, doubled
from enumerate.kernel.ranks import FREE
from graphs.types import Bytes, Ints, Words

__all__ = ["ANY", "CLOSED", "OPENED", "has_centre", "label_faces", "patterns", "points_of_pattern"]

CLOSED, OPENED, ANY = 0, 1, 2
"""What a pattern says of a corner: no open edge, one or more, either."""

_MOST_POINTS = 63


@compiled
def label_faces(turn: Ints, vertex: Ints, face: Ints, labels: Ints) -> Ints:
    """Return the labels of faces by their numbers, given in the order in which the code of the map meets them."""
    found = np.full(len(labels), -1, np.int64)
    start = np.full(len(vertex), -1, np.int64)
    for d in range(len(vertex)):  # a link is met by the joint of the least number
        if start[vertex[d]] < 0:
            start[vertex[d]] = d
    met = 0
    for link in range(len(vertex)):
        d = start[link]
        while d >= 0:
            if found[face[d]] < 0:
                found[face[d]] = labels[met]
                met += 1
            d = turn[0, d]
            if d == start[link]:
                break
    return found


@compiled
def patterns(turn: Ints, vertex: Ints, face: Ints, labels: Ints, number: Ints, most: int) -> Bytes:
    """Return the valid patterns of a mechanism: uint8[p, D].

    They are `CLOSED`, `OPENED` or `ANY` for the corners of faces without a centre, `CLOSED` elsewhere. `number`
    holds the classes of the faces, `most` is the greatest link degree.
    """
    darts = len(vertex)
    found = np.zeros((4, darts), np.uint8)
    if len(labels) == 1:  # a tree: no pattern breaks a rule
        for d in range(darts):
            found[0, d] = ANY
        return found[:1]
    free, pattern = _undecided(turn, vertex, face, labels, number, most)
    used = 0
    for choice in range(1 << len(free)):
        for i in range(len(free)):
            pattern[free[i]] = (choice >> i) & 1
        if _opens(face, labels, pattern) and _keeps_apart(turn, vertex, face, number, pattern):
            found = doubled(found) if used == len(found) else found
            for d in range(darts):
                found[used, d] = pattern[d]
            used += 1
    return found[:used]


@compiled
def _undecided(turn: Ints, vertex: Ints, face: Ints, labels: Ints, number: Ints, most: int) -> tuple[Ints, Bytes]:
    """Return the corners that can have open edges or none, and a pattern with the others decided.

    Without an open edge the two joints of a corner have a vertex in common, so they must not have a centre in
    common.
    """
    darts = len(vertex)
    degree = np.zeros(darts, np.int64)
    for d in range(darts):
        degree[vertex[d]] += 1
    pattern = np.zeros(darts, np.uint8)
    free = np.zeros(darts, np.int64)
    unsure = 0
    for d in range(darts):
        if has_centre(labels[face[d]]):
            continue
        one, other = number[face[d ^ 1]], number[face[turn[0, d]]]
        if one >= 0 and one == other:
            pattern[d] = OPENED
        elif degree[vertex[d]] < most:
            free[unsure] = d
            unsure += 1
    return free[:unsure], pattern


@compiled
def has_centre(label: int) -> bool:
    """Tell whether a face with this label has a centre."""
    return label == FINITE or label == INFINITE  # noqa: PLR1714 - numba takes long over a tuple


@compiled
def _opens(face: Ints, labels: Ints, pattern: Bytes) -> bool:
    """Tell whether each face without a centre has open edges in three corners."""
    for f in range(len(labels)):
        if not has_centre(labels[f]):
            corners = 0
            for d in range(len(face)):
                corners += face[d] == f and pattern[d] != CLOSED
            if corners < 3:
                return False
    return True


@compiled
def points_of_pattern(turn: Ints, face: Ints, number: Ints, pattern: Bytes) -> tuple[Ints, int]:
    """Return the points that the axis of each joint shares with others: int64[J, 2], and the number of points.

    Points are the classes, then the vertices in faces without a centre in which several joints end.
    """
    darts = len(face)
    count = np.int64(0)
    end = np.full(darts, FREE, np.int64)  # the point on the left of each dart
    for d in range(darts):
        end[d] = number[face[d]]
        count = max(count, number[face[d]] + 1)
    for d in range(darts):  # a vertex reaches from a corner with open edges to the next one
        if pattern[d] != OPENED or pattern[turn[1, d ^ 1]] != CLOSED or number[face[d]] >= 0:
            continue
        following = d
        end[d] = count
        while pattern[turn[1, following ^ 1]] == CLOSED:
            following = turn[1, following ^ 1]
            end[following] = count
        count += 1
    points = np.full((darts // 2, 2), FREE, np.int64)
    for k in range(darts // 2):
        left, right = end[2 * k], end[2 * k + 1]
        points[k, 0] = left if left >= 0 else right
        if left >= 0 and right != left:
            points[k, 1] = right
    return points, int(count)


@compiled
def _keeps_apart(turn: Ints, vertex: Ints, face: Ints, number: Ints, pattern: Bytes) -> bool:
    """Tell whether a pattern keeps rules S1 and S2."""
    points, count = points_of_pattern(turn, face, number, pattern)
    if count > _MOST_POINTS:
        return False
    joints = len(points)
    on_axis = np.zeros(joints, np.uint64)
    at_link = np.zeros(joints + 1, np.uint64)
    for k in range(joints):
        for end in range(2):
            if points[k, end] >= 0:
                on_axis[k] |= np.uint64(1) << np.uint64(points[k, end])
        for i in range(k):
            if _several(on_axis[k] & on_axis[i]):
                return False
        for side in range(2):
            at_link[vertex[2 * k + side]] |= on_axis[k]
    return _links_apart(vertex, on_axis, at_link)


@compiled
def _several(points: np.uint64) -> bool:
    """Tell whether a set of points has two members or more."""
    return bool(points & (points - np.uint64(1)))


@compiled
def _links_apart(vertex: Ints, on_axis: Words, at_link: Words) -> bool:
    """Tell whether links keep rule S2: they share one point, or points of the axis of their joint."""
    for u in range(len(at_link)):
        for v in range(u):
            common = at_link[u] & at_link[v]
            if common == 0:
                continue
            joined = fits = False
            for k in range(len(on_axis)):
                a, b = vertex[2 * k], vertex[2 * k + 1]
                if (a == u and b == v) or (a == v and b == u):
                    joined = True
                    fits |= common & ~on_axis[k] == 0
            if (joined and not fits) or (not joined and _several(common)):
                return False
    return True
