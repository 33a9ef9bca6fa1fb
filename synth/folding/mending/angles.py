"""Angles of a flat crease pattern that are meant to be alike: what its drawing says about its geometry.

Sectors between neighbouring creases that agree within the precision of the coordinates, or make 180 degrees
together, are meant to; so are creases that go straight on, and those of a loop whose creases are parallel. About
flat vertices only these angles count for motion. Theory: docs/theory/mending.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi

import numpy as np
import scipy.sparse

from graphs.loops.loop import Centre
from graphs.types import Floats
from synth.folding.mending.places import VertexPlaces

__all__ = ["MeantAngles"]

_ROUNDING = 3.0
"""Angles differ by this times what a coordinate's precision makes of them, at most, if they are meant to agree."""


@dataclass(frozen=True, slots=True)
class _Sum:
    """What headings of creases, some of them reversed, add up to, modulo 180 degrees."""

    joints: tuple[int, ...]
    signs: tuple[int, ...]
    value: float


@dataclass(frozen=True, slots=True)
class _Sector:
    """From one crease to the next about a vertex: angle and error, radians."""

    joints: tuple[int, int]
    angle: float
    error: float

    @property
    def acute(self) -> float:
        """The angle, or what is left of it to 180 degrees."""
        return min(self.angle, pi - self.angle)


class MeantAngles:
    """Equations between the headings of creases of a flat sheet; other sheets have none.

    The precision is that of a coordinate, in units of the extent.
    """

    def __init__(self, places: VertexPlaces, precision: float) -> None:
        self._places = places
        self._precision = _ROUNDING * precision
        self._sums: list[_Sum] = []
        if len(places.along) == 2:
            self._normal = np.cross(*places.along)
            sectors = []
            for loop in places.loops:
                if loop.centre is Centre.FINITE:
                    round_vertex = self._sectors(loop.joints)
                    sectors += round_vertex
                    self._sums += _straight(round_vertex)
                elif loop.centre is Centre.INFINITE:
                    first, *others = loop.joints
                    self._sums += [_Sum((joint, first), (1, -1), 0.0) for joint in others]
            self._sums += _alike(sectors)

    def __len__(self) -> int:
        return len(self._sums)

    def _sectors(self, joints: Sequence[int]) -> list[_Sector]:
        """Return the sectors about the vertex in which creases meet, counterclockwise; none if they do not."""
        ends = self._places.ends[list(joints)]
        shared = set(ends[0].tolist()).intersection(*(set(pair.tolist()) for pair in ends))
        if len(shared) != 1 or len(joints) < 2:
            return []
        (vertex,) = shared
        others = np.where(ends[:, 0] == vertex, ends[:, 1], ends[:, 0])
        away = (self._places.given[others] - self._places.given[vertex]) @ self._places.along.T
        headings, errors = np.arctan2(away[:, 1], away[:, 0]), self._precision / np.linalg.norm(away, axis=1)
        order = np.argsort(headings)
        following = np.roll(order, -1)
        return [
            _Sector(
                (joints[i], joints[j]), float(headings[j] - headings[i]) % (2 * pi), float(errors[i] + errors[j])
            )
            for i, j in zip(order, following, strict=True)
        ]

    def off(self, corners: Floats) -> Floats:
        """Return by how much the equations do not hold with vertices at float[V, 3], radians."""
        ends = corners[self._places.ends]
        along = (ends[:, 1] - ends[:, 0]) @ self._places.along.T
        headings = np.arctan2(along[:, 1], along[:, 0])
        off = [float(np.dot(headings[list(one.joints)], one.signs)) - one.value for one in self._sums]
        return np.asarray((np.array(off) + pi / 2) % pi - pi / 2)

    def by_axes(self) -> scipy.sparse.csr_matrix:
        """Return the derivatives by small motions of the axes: sparse float[rows, 6 J]."""
        terms = [
            (row, 6 * joint + c, sign * float(self._normal[c]))
            for row, one in enumerate(self._sums)
            for joint, sign in zip(one.joints, one.signs, strict=True)
            for c in range(3)
        ]
        rows, columns, values = zip(*terms, strict=True) if terms else ((), (), ())
        shape = (len(self._sums), 6 * len(self._places.ends))
        return scipy.sparse.csr_matrix((values, (rows, columns)), shape=shape)


def _straight(sectors: Sequence[_Sector]) -> list[_Sum]:
    """Return what keeps creases straight that go on through a vertex."""
    found = []
    for first in range(len(sectors)):
        angle, error = 0.0, sectors[first].error
        for sector in sectors[first:]:
            angle += sector.angle
            if abs(angle - pi) <= error + sector.error:
                found.append(_Sum((sectors[first].joints[0], sector.joints[1]), (-1, 1), pi))
    return found


def _alike(sectors: Sequence[_Sector]) -> list[_Sum]:
    """Return what makes sectors equal, or supplements, that are so within their errors."""
    rising = sorted((one for one in sectors if 0.0 < one.angle < pi - one.error), key=lambda one: one.acute)
    sums: list[_Sum] = []
    for before, one in zip([None, *rising], rising, strict=False):
        first, last = one.joints
        if pi / 2 - one.acute <= one.error:
            sums.append(_Sum((first, last), (-1, 1), pi / 2))
        elif before is not None and one.acute - before.acute <= one.error + before.error:
            same = (one.angle < pi / 2) == (before.angle < pi / 2)
            ours, theirs = (-1, 1), (1, -1) if same else (-1, 1)
            sums.append(_Sum((first, last, *before.joints), (*ours, *theirs), 0.0))
    return sums
