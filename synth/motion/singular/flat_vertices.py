"""Flat vertices of four creases: their two modes, and those whose modes are linear in tan(fold / 2).

In any mode of a flat vertex with four creases one pair of opposite creases folds the same way and the other does
not: three mountains and a valley, or the other way round, or a single straight line. Which pair it is says which
of the two modes. Where opposite sectors make 180 degrees, tan(fold / 2) of the four are in proportion in each.
Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from math import pi

import numpy as np

from graphs.geometry import lines_meet, sectors, unit
from graphs.loops.loop import Centre
from graphs.tolerances import DOUBLE, MARGIN
from graphs.types import Floats
from synth.motion.linkage import PosedLinkage, PosedLoop

__all__ = ["FlatVertices"]


class FlatVertices:
    """The loops of a linkage that are flat vertices of four creases.

    `linear` says whether every loop is one whose opposite sectors make 180 degrees, and all creases are flat.

    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.motion.linkage import linkage_of_sheet
    >>> corners = ((0, 0), (1, 0), (0, 1), (-1, 0), (0, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> cross = FlatVertices(linkage_of_sheet(Sheet(5, (), "", faces, corners)))
    >>> cross.linear, cross.modes(np.array([0.0, 1.0, 0.0, 1.0])), cross.modes(np.zeros(4))
    (True, ((1, 3),), (None,))
    """

    def __init__(self, linkage: PosedLinkage) -> None:
        self._loops = linkage.loops
        self._ways: list[Floats | None] = []
        flat = [np.abs(linkage.angles).max(initial=0.0) <= DOUBLE.parallel]
        for loop in linkage.loops:
            outward = _outward(linkage, loop)
            flat.append(outward is not None and _opposite_make_a_half(outward))
            self._ways.append(None if outward is None else _ways(linkage, loop, outward))
        self.linear = bool(all(flat))

    def modes(self, rates: Floats) -> tuple[tuple[int, int] | None, ...]:
        """Return in which mode each vertex begins to fold.

        A mode is the places of the opposite creases that fold the same way. Rates are general ones of a branch,
        the largest 1 or -1. None for a vertex that does not move, for loops that are no flat vertices, and for
        those with other than four creases.
        """
        return tuple(_mode(loop, ways, rates) for loop, ways in zip(self._loops, self._ways, strict=True))


def _mode(loop: PosedLoop, ways: Floats | None, rates: Floats) -> tuple[int, int] | None:
    if ways is None:
        return None
    folds = rates[list(loop.joints)] * ways
    alike = folds[:2] * folds[2:]
    same = int(alike[1] > alike[0] + MARGIN * abs(float(alike[0])))
    first, second = sorted(loop.joints[same::2])
    return (first, second) if alike[same] > DOUBLE.zero_rate**2 else None


def _ways(linkage: PosedLinkage, loop: PosedLoop, outward: Floats) -> Floats:
    """Return 1 for creases that fold one way at a positive angle, -1 for others: float[4]."""
    along = (outward * linkage.directions[list(loop.joints)]).sum(axis=1)
    return np.asarray(np.sign(along) * loop.signs)


def _opposite_make_a_half(outward: Floats) -> bool:
    first, _, third, _ = sectors(outward)
    return bool(abs(first + third - pi) <= DOUBLE.parallel)


def _outward(linkage: PosedLinkage, loop: PosedLoop) -> Floats | None:
    """Return the directions of four creases away from a flat vertex: float[4, 3]; None of other loops."""
    joints = list(loop.joints)
    if loop.centre is not Centre.FINITE or len(joints) != 4:
        return None
    points = linkage.points[joints]
    away = points - lines_meet(points, linkage.directions[joints]).point
    if np.linalg.norm(away, axis=1).min() <= DOUBLE.same_point:  # no crease, but an axis through that point
        return None
    outward = unit(away)
    return outward if abs(sectors(outward).sum() - 2 * pi) <= DOUBLE.parallel else None
