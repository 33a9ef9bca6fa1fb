"""Axes that meet conditions, and poses that close along one motion, found by damped least squares.

The axes at the reference, and the joint angles of poses along one motion, are unknowns of one problem: one joint
is driven by twelve degrees from pose to pose, and all loops close at all of them. A pose is added when those
before close. Conditions may be dependent where they hold, so steps are damped (Levenberg, Marquardt).
Theory:
docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import ceil, radians

import numpy as np

from graphs.mechanism.sc import SCGraph
from graphs.tolerances import DOUBLE, leading
from graphs.types import Floats
from synth.motion.closure import ClosureEquations
from synth.motion.derivatives import dependence_on_axes
from synth.motion.linkage import PosedLinkage, linkage_of_axes
from synth.motion.walk.allowance import Allowance
from synth.realisation.special.conditions import AxisCondition, derivatives

__all__ = ["axes_along_a_motion", "axes_meeting", "linkage_at"]

_TURN = radians(12.0)
_POSES = 5
"""So many poses have to close, at most, beside the reference."""
_ROUNDS = 40
_TIGHT = 1e-14
_DAMPING, _LEAST, _MOST = 1e-2, 1e-16, 1e6
_GAIN = 1e-3
"""A step that lessens the sum of squares by less than this part is of no use: the search has come to rest."""
_UNIT = 60.0
"""A step with up to so many unknowns is a unit of work; one with more counts in proportion."""

System = Callable[[Floats], tuple[Floats, Floats]]
"""Of unknowns float[n]: numbers to be zero, and their derivatives."""


def linkage_at(graph: SCGraph, axes: Floats) -> PosedLinkage:
    """Return a linkage with axes float[J, 6], a point and a direction each."""
    pairs = zip(graph.joints, axes.tolist(), strict=True)
    return linkage_of_axes(graph, {joint: (axis[:3], axis[3:]) for joint, axis in pairs})


def axes_meeting(conditions: Sequence[AxisCondition], start: Floats, work: Allowance) -> Floats | None:
    """Return unknowns near a start, float[rows, 6], that meet conditions; None if none were found.

    >>> from synth.realisation.special.conditions import normal
    >>> axes_meeting([normal(1)], np.ones((1, 6)), Allowance(100)).round(6).tolist()
    [[0.57735, 0.57735, 0.57735, 0.57735, 0.57735, 0.57735]]
    """

    def system(unknowns: Floats) -> tuple[Floats, Floats]:
        rows = unknowns.reshape(start.shape)
        return _stacked(conditions, rows)

    found = _solved(system, start.ravel(), work)
    return None if found is None else found.reshape(start.shape)


def axes_along_a_motion(
    graph: SCGraph, conditions: Sequence[AxisCondition], start: Floats, work: Allowance
) -> Floats | None:
    """Return unknowns near a start that meet conditions, with loops that close at poses along one motion.

    The start, float[rows, 6], meets the conditions. None if nothing closed at all poses.
    """
    joints = len(graph.joints)
    closure = ClosureEquations(linkage_at(graph, start[:joints]))
    jacobian = closure.at(np.zeros(joints))[1].toarray()
    rates = np.linalg.eigh(jacobian.T @ jacobian)[1][:, 0]
    poses = _Poses(graph, conditions, start.shape, leading(rates))
    rates = rates / rates[poses.driver]
    rows, angles = start, np.zeros((1, joints))
    for number in range(1, _needed(closure) + 1):
        angles = np.vstack([angles, angles[-1] + rates * _TURN])
        found = _solved(poses.system(number), poses.joined(rows, angles[1:]), work)
        if found is None:
            return None
        rows, solved = poses.parted(found, number)
        angles = np.vstack([np.zeros((1, joints)), solved])
        rates = (angles[-1] - angles[-2]) / _TURN
    return rows


def _needed(closure: ClosureEquations) -> int:
    """Return the poses after which a linkage that closes at all has no dimension left to choose, or a few."""
    each = closure.rows - (closure.joints - 1)
    return min(_POSES, ceil((4 * closure.joints - 7) / max(each, 1)) + 1)


@dataclass(frozen=True)
class _Poses:
    """Unknowns of axes, and of the angles of all joints but the driven one at each pose."""

    graph: SCGraph
    conditions: Sequence[AxisCondition]
    shape: tuple[int, ...]
    driver: int

    @property
    def _free(self) -> list[int]:
        return [place for place in range(len(self.graph.joints)) if place != self.driver]

    def joined(self, rows: Floats, angles: Floats) -> Floats:
        """Return axes and angles, float[K, J], as one vector of unknowns."""
        return np.concatenate([rows.ravel(), angles[:, self._free].ravel()])

    def parted(self, unknowns: Floats, number: int) -> tuple[Floats, Floats]:
        """Return axes and angles of a number of poses."""
        size = int(np.prod(self.shape))
        angles = np.zeros((number, len(self.graph.joints)))
        angles[:, self._free] = unknowns[size:].reshape(number, -1)
        angles[:, self.driver] = _TURN * np.arange(1, number + 1)
        return unknowns[:size].reshape(self.shape), angles

    def system(self, number: int) -> System:
        """Return what does not hold, and its derivatives, with a number of poses."""
        joints, free = len(self.graph.joints), self._free

        def system(unknowns: Floats) -> tuple[Floats, Floats]:
            rows, angles = self.parted(unknowns, number)
            linkage = linkage_at(self.graph, rows[:joints])
            closure, by_numbers = ClosureEquations(linkage), dependence_on_axes(linkage).twists
            off, by_rows = _stacked(self.conditions, rows)
            residuals, size = [off], rows.size
            parts = [np.hstack([by_rows, np.zeros((len(off), number * len(free)))])]
            for place, at in enumerate(angles):
                residual, jacobian = closure.at(at)
                by = np.zeros((len(residual), size + number * len(free)))
                by[:, : 6 * joints] = (closure.by_axes(at) @ by_numbers).toarray()
                by[:, size + place * len(free) : size + (place + 1) * len(free)] = jacobian.toarray()[:, free]
                residuals.append(residual)
                parts.append(by)
            return np.concatenate(residuals), np.vstack(parts)

        return system


def _stacked(conditions: Sequence[AxisCondition], rows: Floats) -> tuple[Floats, Floats]:
    off = [np.asarray(condition(rows)) for condition in conditions]
    return np.concatenate(off), np.concatenate([derivatives(condition, rows) for condition in conditions])


def _solved(system: System, start: Floats, work: Allowance) -> Floats | None:
    """Return unknowns at which all is zero, near a start; None if the search came to rest elsewhere."""
    unknowns, damping = start, _DAMPING
    off, by = system(unknowns)
    for _ in range(_ROUNDS):
        if np.abs(off).max(initial=0.0) <= _TIGHT:
            break
        better = None
        while better is None and damping <= _MOST and work.take(max(1.0, len(unknowns) / _UNIT)):
            step = _damped(by, off, damping)
            tried = system(unknowns + step)
            if tried[0] @ tried[0] < (1.0 - _GAIN) * (off @ off):
                better = tried
            else:
                damping *= 4.0
        if better is None:
            break
        unknowns, (off, by), damping = unknowns + step, better, max(damping / 8.0, _LEAST)
    return unknowns if np.abs(off).max(initial=0.0) <= DOUBLE.closed else None


def _damped(by: Floats, off: Floats, damping: float) -> Floats:
    """Return the damped step of least squares, by a QR decomposition."""
    size = by.shape[1]
    q, r = np.linalg.qr(np.vstack([by, np.sqrt(damping) * np.eye(size)]))
    return np.asarray(-np.linalg.solve(r, q[: len(by)].T @ off))
