"""What holds cut hinges together: points of their axes that two bodies share, no more than close the loops.

A hinge is two points of its axis in both bodies: six equations, of which one is redundant, and more where the rest
of a loop keeps the bodies in a plane or about a point. Points are taken in turn as long as they raise the rank of
the equations at the configuration. A regular configuration needs no others; but simulators close loops softly, and
where the equations of a point follow from those of others with large factors, it gives way by as many times their
errors, on the way at least. Such a point is kept: only what others hold firmly all along the motion is left out.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from graphs.rank.singular_values import row_space
from graphs.tolerances import leading
from graphs.types import Floats
from synth.making.simulation.bodies import Hinge, TreeJoint


@dataclass(frozen=True, eq=False)
class Connect:
    """A point float[3] that two bodies share, and how many of its three equations do not follow from others."""

    point: Floats
    rank: int


@dataclass(frozen=True, eq=False)
class CutHinge:
    """A hinge outside the tree, by its number: the points that are held together, and how many follow from these."""

    hinge: int
    connects: tuple[Connect, ...]
    left_out: int


_FIRM = 4.0
"""A point that is left out may give way by so many times the errors of those that are kept."""


def connections(
    frames: Sequence[Sequence[Hinge]],
    tree: Sequence[TreeJoint],
    cut: Sequence[int],
    bodies: int,
    size: float,
    zero: float,
) -> tuple[tuple[CutHinge, ...], Floats]:
    """Return what holds the cut hinges together, and an orthonormal basis of their equations, float[tree, rank].

    Of each hinge the point that parts faster comes first; the second points of all come last. The hinges are those
    at some configurations of the motion, the first one that of the file. Lengths are divided by `size`; singular
    values up to `zero` are zero.
    """
    hinges = frames[0]
    parting = Parting(hinges, tree, bodies, size)
    ways = {number: _first_end(parting, number) for number in cut}
    ranks: dict[tuple[int, float], int] = {}
    known = np.zeros((len(tree), 0))
    for number, way in [*((number, ways[number]) for number in cut), *((number, -ways[number]) for number in cut)]:
        rows = parting.rows(number, way)
        for _ in range(2):  # once more, for what rounding left
            rows = rows - (rows @ known) @ known.T
        new = row_space(rows, zero, 1.0) if rows.size else known[:, :0]
        ranks[number, way] = new.shape[1]
        known = np.hstack([known, new])
    loose = set[tuple[int, float]]()
    for each in frames:
        loose |= _loose(Parting(each, tree, bodies, size), ranks, zero)
    cuts = []
    for number in cut:
        both = [(number, ways[number]), (number, -ways[number])]
        kept = [one for one in both if ranks[one] or one in loose]
        connects = tuple(Connect(hinges[number].end(way), ranks[number, way]) for _, way in kept)
        cuts.append(CutHinge(number, connects, 2 - len(kept)))
    return tuple(cuts), known


def _loose(parting: Parting, ranks: Mapping[tuple[int, float], int], zero: float) -> set[tuple[int, float]]:
    """Return the points of no rank that those with one do not hold firmly."""
    kept = [parting.rows(*point) for point, rank in ranks.items() if rank]
    rest = [point for point, rank in ranks.items() if not rank]
    if not rest or not kept:
        return set()
    firm = np.vstack(kept)
    rows = np.vstack([parting.rows(*point) for point in rest])
    factors = np.linalg.solve(firm @ firm.T + zero**2 * np.eye(len(firm)), firm @ rows.T).T
    missed = np.abs(rows - factors @ firm).reshape(len(rest), -1).max(axis=1)
    sizes = np.linalg.norm(factors.reshape(len(rest), 3, -1), axis=(1, 2))
    pairs = zip(rest, (missed > zero) | (sizes > _FIRM), strict=True)
    return {point for point, is_loose in pairs if is_loose}


def _first_end(parting: Parting, number: int) -> float:
    """Return the end of a cut hinge, -1 or 1, at which its bodies would part faster."""
    return (-1.0, 1.0)[leading(np.array([np.linalg.norm(parting.rows(number, end)) for end in (-1.0, 1.0)]))]


class Parting:
    """How fast bodies part by the joints of the tree."""

    def __init__(self, hinges: Sequence[Hinge], tree: Sequence[TreeJoint], bodies: int, size: float) -> None:
        self._hinges, self._size = hinges, size
        self._before = np.zeros((bodies, len(tree)), dtype=bool)
        for column, joint in enumerate(tree):
            self._before[joint.child] = self._before[joint.parent]
            self._before[joint.child, column] = True
        self._axes = np.array([joint.sense * hinges[joint.hinge].direction for joint in tree]).reshape(-1, 3)
        self._points = np.array([hinges[joint.hinge].point for joint in tree]).reshape(-1, 3)
        self._slides = np.array([hinges[joint.hinge].slide for joint in tree], dtype=bool)

    def rows(self, number: int, end: float) -> Floats:
        """Return how fast the bodies of a hinge part at an end, for each joint of the tree: float[3, joints]."""
        hinge = self._hinges[number]
        point = hinge.end(end)
        velocities = np.cross(self._axes, (point - self._points) / self._size)
        velocities = np.where(self._slides[:, None], self._axes, velocities)
        senses = self._before[hinge.second].astype(float) - self._before[hinge.first]
        return np.asarray((velocities * senses[:, None]).T)

    def twists(self, rates: Floats) -> Floats:
        """Return the motion of each body at rates of the tree: spin, and velocity at the origin, float[bodies, 6]."""
        spins = np.where(self._slides[:, None], 0.0, self._axes) * rates[:, None]
        turning = np.cross(self._points, self._axes) * rates[:, None]
        velocities = np.where(self._slides[:, None], self._axes * (rates * self._size)[:, None], turning)
        return np.asarray(self._before @ np.hstack([spins, velocities]))
