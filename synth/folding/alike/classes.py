"""Which creases of a flat pattern look alike: those that a motion of the plane takes to each other.

Motions that take the whole pattern to itself make a group; its orbits, and those of its subgroups, are classes.
A piece of a tessellation has few such motions, but more that agree wherever the pattern and its image overlap;
these join the creases that are alike in the whole tessellation. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations_with_replacement

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from graphs.geometry import lines_meet, principal_axes, unit
from graphs.loops.loop import Centre
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet, sides_of_face
from graphs.tolerances import DOUBLE, Tolerances
from graphs.types import Flags, Floats, Ints
from synth.motion.linkage import PosedLinkage, axis_lengths

__all__ = ["alike_classes"]

_LARGEST_GROUP = 24
"""Motions of a group whose pairs are tried as generators of subgroups: those of a polygon of twelve sides."""


@dataclass(frozen=True, slots=True)
class _Plane:
    """A flat pattern seen in its plane, in units of the extent.

    Middles and directions are those of creases, float[J, 2], sides the ends of the sides of the border, float[n,
    2, 2]. Middles and directions of creases closer than `same` are one: both arms that a motion takes to each
    other may err.
    """

    middles: Floats
    directions: Floats
    marks: Floats
    sides: Floats
    same: float

    def inside(self, places: Floats) -> Flags:
        """Tell which places float[n, 2] are within the border.

        A ray from there crosses it an odd number of times. Places on the border are not within.
        """
        (x1, y1), (x2, y2) = self.sides[:, 0].T, self.sides[:, 1].T
        x, y = places[:, :1], places[:, 1:]
        spans = (y1 > y) != (y2 > y)
        crossing = x1 + (y - y1) * (x2 - x1) / np.where(y2 == y1, 1.0, y2 - y1)
        odd = (spans & (crossing > x)).sum(axis=1) % 2 == 1
        along = np.stack([x2 - x1, y2 - y1], axis=-1)
        lengths = np.maximum((along**2).sum(axis=-1), self.same**2)
        part = ((x - x1) * along[:, 0] + (y - y1) * along[:, 1]) / lengths
        part = np.clip(part, 0.0, 1.0)
        off = np.hypot(x - x1 - part * along[:, 0], y - y1 - part * along[:, 1])
        return np.asarray(odd & (off.min(axis=1, initial=np.inf) > self.same))


@dataclass(frozen=True, slots=True)
class _Vertex:
    """A vertex that creases surround: its place, the creases in their order, and their directions outwards."""

    place: Floats
    joints: Ints
    outwards: Floats


def alike_classes(
    sheet: Sheet, linkage: PosedLinkage, marks: Floats, tolerances: Tolerances = DOUBLE
) -> list[Ints]:
    """Return classes of creases that look alike, those of the largest symmetry first.

    First those that are alike in the tessellation that the pattern is a piece of, then the orbits of all motions
    that take the pattern to itself, then those of their subgroups. There are none where no vertex is surrounded
    by creases, and none that leave all creases by themselves.

    Parameters
    ----------
    sheet : Sheet
        Flat.
    linkage : PosedLinkage
        Of the sheet.
    marks : float[J]
        1 for valleys, -1 for mountains, 0 for what is not marked: a motion keeps them.
    tolerances : Tolerances, optional
        Of its coordinates as they were given.

    Returns
    -------
    list of int[J]

    Examples
    --------
    In the waterbomb base the four diagonals are alike, and so are the two halves of the line; with the half turn
    or one of the mirrors alone there are more classes:

    >>> from synth.motion.linkage import linkage_of_sheet
    >>> from synth.patterns.creases.bases import waterbomb_base
    >>> base = waterbomb_base()
    >>> linkage = linkage_of_sheet(base)
    >>> [classes.tolist() for classes in alike_classes(base, linkage, np.array([-1.0, 1, 1, -1, 1, 1]))]
    [[0, 1, 1, 0, 1, 1], [0, 1, 2, 0, 1, 2], [0, 1, 1, 0, 2, 2], [0, 1, 2, 3, 2, 1]]
    """
    plane, count = _plane(sheet, linkage, marks, tolerances), len(marks)
    maps = list(_maps(plane, _vertices(plane, linkage)))
    whole = [one for one in maps if (one >= 0).all()]
    choices = [maps, whole]
    if len(whole) <= _LARGEST_GROUP:
        choices += [list(pair) for pair in combinations_with_replacement(whole, 2)]
    orbits = [_joined(choice, count) for choice in choices]
    found = {classes.tobytes(): classes for classes in orbits if classes.max(initial=0) + 1 < count}
    rest = sorted(found.values(), key=lambda classes: int(classes.max()))
    first = orbits[0].tobytes()  # alike in the tessellation
    return sorted(rest, key=lambda classes: classes.tobytes() != first)


def _plane(sheet: Sheet, linkage: PosedLinkage, marks: Floats, tolerances: Tolerances) -> _Plane:
    assert sheet.coordinates is not None
    local = (in_space(sheet.coordinates) - linkage.middle) / linkage.extent
    used = sorted({vertex for face in sheet.faces for vertex in face})
    across = principal_axes(local[used])[1][:2]
    count: dict[frozenset[int], int] = {}
    for face in sheet.faces:
        for side in sides_of_face(face):
            count[frozenset(side)] = count.get(frozenset(side), 0) + 1
    border = [sorted(side) for side, faces in count.items() if faces == 1 and len(side) == 2]
    sides = (local @ across.T)[np.array(border, dtype=np.int64).reshape(-1, 2)]
    same = 2.0 * tolerances.parallel / float(axis_lengths(linkage).min(initial=1.0))
    return _Plane(linkage.points @ across.T, linkage.directions @ across.T, marks, sides, same)


def _vertices(plane: _Plane, linkage: PosedLinkage) -> list[_Vertex]:
    """Return the vertices about which loops close: where the lines of their creases meet."""
    found = []
    for loop in linkage.loops:
        if loop.centre is not Centre.FINITE:
            continue
        joints = np.array(loop.joints, dtype=np.int64)
        place = lines_meet(plane.middles[joints], plane.directions[joints]).point
        found.append(_Vertex(place, joints, unit(plane.middles[joints] - place)))
    return found


def _maps(plane: _Plane, vertices: list[_Vertex]) -> Iterator[Ints]:
    """Yield the motions of the plane that take a vertex to a vertex and agree wherever pattern and image overlap.

    Each as the crease that each crease is taken to, -1 for none: int[J]. Of the vertices with as many creases one
    is taken to all.
    """
    tree = cKDTree(plane.middles) if len(plane.middles) else None
    first: dict[int, _Vertex] = {}
    for vertex in vertices:
        start = first.setdefault(len(vertex.joints), vertex)
        arm = start.outwards[0]
        for goal in vertex.outwards:
            for mirror in (1.0, -1.0):
                seen = arm * (1.0, mirror)
                cos, sin = float(seen @ goal), float(seen[0] * goal[1] - seen[1] * goal[0])
                matrix = np.array([[cos, -sin], [sin, cos]]) * (1.0, mirror)
                shift = vertex.place - matrix @ start.place
                there = _taken(plane, tree, matrix, shift)
                if there is None or _taken(plane, tree, matrix.T, -matrix.T @ shift) is None:
                    continue
                if set(there[start.joints].tolist()) == set(vertex.joints.tolist()):
                    yield there


def _taken(plane: _Plane, tree: cKDTree, matrix: Floats, shift: Floats) -> Ints | None:
    """Return the crease that each is taken to, -1 where it leaves the sheet; None if one is taken to no crease."""
    middles, directions = plane.middles @ matrix.T + shift, plane.directions @ matrix.T
    off, there = tree.query(middles)
    across = directions[:, 0] * plane.directions[there, 1] - directions[:, 1] * plane.directions[there, 0]
    same = (off <= plane.same) & (np.abs(across) <= plane.same) & (plane.marks == plane.marks[there])
    if plane.inside(middles[~same]).any():
        return None
    return np.where(same, there, -1)


def _joined(maps: list[Ints], count: int) -> Ints:
    """Return the classes of what some maps take to each other, numbered in the order of their first members."""
    starts = np.concatenate([np.zeros(0, np.int64), *(np.flatnonzero(one >= 0) for one in maps)])
    ends = np.concatenate([np.zeros(0, np.int64), *(one[one >= 0] for one in maps)])
    between = coo_matrix((np.ones(len(starts)), (starts, ends)), shape=(count, count))
    labels = connected_components(between, directed=False)[1]
    _, first, where = np.unique(labels, return_index=True, return_inverse=True)
    return np.asarray(np.argsort(np.argsort(first))[where], dtype=np.int64)
