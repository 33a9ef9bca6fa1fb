"""Axes in space that meet conditions, and configurations that close along one motion, by damped least squares.

The unknowns are rows of six numbers: a point and a direction for each joint, then for each centre, of which a
finite one uses the point, one at infinity the direction. Conditions are polynomials that are to be zero; they take
complex numbers and leading dimensions, so that all derivatives come from one call (a complex step, exact for
polynomials). Theory: docs/theory/realisation.md.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import ceil, radians
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from graphs.tolerances import DOUBLE, leading
from graphs.types import Floats
from synth.motion.closure import ClosureEquations
from synth.motion.derivatives import dependence_on_axes
from synth.motion.linkage import PosedLinkage, linkage_of_axes
from synth.motion.walk.step import Allowance
from synth.realisation.measures import damped_least_squares

Unknowns = npt.NDArray[Any]
"""Float or complex [..., rows, 6]."""
AxisCondition = Callable[[Unknowns], Unknowns]
"""Of unknowns [..., rows, 6]: numbers [..., n] that are to be zero."""

_STEP = 2.0**-100
"""Complex step: its square is lost beside 1, and polynomials have no other error."""


@dataclass(frozen=True, slots=True)
class AxisGroup:
    """Axes, by their places, that meet in a finite centre, or are parallel for one at infinity."""

    joints: tuple[int, ...]
    centre: Centre


@dataclass(frozen=True, slots=True)
class AxisSymmetry:
    """An isometry about the origin, float[3, 3], that takes each row of the unknowns to another."""

    image: tuple[int, ...]
    matrix: Floats


def derivatives(condition: AxisCondition, unknowns: Floats) -> Floats:
    """Return the derivatives of a condition by all unknowns: float[n, 6 rows]."""
    size = unknowns.size
    steps = (1j * _STEP * np.eye(size)).reshape(size, *unknowns.shape)
    return np.asarray(condition(unknowns + steps).imag.T / _STEP)


def normal(joints: int) -> AxisCondition:
    """Return that directions are unit vectors, and the points of the axes about 1 from the origin."""

    def condition(rows: Unknowns) -> Unknowns:
        points, directions = rows[..., :joints, :3], rows[..., 3:]
        size = (points**2).sum(axis=(-1, -2))[..., None] / joints - 1.0
        return np.concatenate([(directions**2).sum(axis=-1) - 1.0, size], axis=-1)

    return condition


def meeting(groups: Sequence[AxisGroup], joints: int) -> AxisCondition:
    """Return that the axes of each group meet in its centre; row ``joints + k`` is the centre of group k."""

    def condition(rows: Unknowns) -> Unknowns:
        parts = [np.zeros((*rows.shape[:-2], 0))]
        for number, group in enumerate(groups):
            axes, centre = rows[..., list(group.joints), :], rows[..., joints + number, None, :]
            if group.centre is Centre.FINITE:
                parts.append(_flat(np.cross(axes[..., :3] - centre[..., :3], axes[..., 3:])))
            else:
                parts.append(_flat(np.cross(axes[..., 3:], np.broadcast_to(centre[..., 3:], axes[..., 3:].shape))))
        return np.concatenate(parts, axis=-1)

    return condition


def symmetric(motion: AxisSymmetry, joints: int) -> AxisCondition:
    """Return that an isometry takes each axis, and each centre, to its image."""
    image = list(motion.image)

    def condition(rows: Unknowns) -> Unknowns:
        moved = np.concatenate([rows[..., :3] @ motion.matrix.T, rows[..., 3:] @ motion.matrix.T], axis=-1)
        there = rows[..., image, :]
        apart = moved[..., :3] - there[..., :3]
        parallel = np.cross(moved[..., 3:], there[..., 3:])
        on_axes = np.cross(apart[..., :joints, :], there[..., :joints, 3:])
        return np.concatenate([_flat(parallel), _flat(on_axes), _flat(apart[..., joints:, :])], axis=-1)

    return condition


def equal_links(loop: Sequence[int]) -> AxisCondition:
    """Return that the links of a loop have right twists, equal lengths and no offsets.

    Points of axes are then the feet of both common normals.
    """
    here, after = list(loop), [*loop[1:], loop[0]]

    def condition(rows: Unknowns) -> Unknowns:
        axis, following = rows[..., here, :], rows[..., after, :]
        between = following[..., :3] - axis[..., :3]
        squares = (between**2).sum(axis=-1)
        return np.concatenate(
            [
                (between * axis[..., 3:]).sum(axis=-1),
                (between * following[..., 3:]).sum(axis=-1),
                (axis[..., 3:] * following[..., 3:]).sum(axis=-1),
                squares - squares[..., :1] / 2.0 - squares[..., -1:] / 2.0,
            ],
            axis=-1,
        )

    return condition


def _flat(vectors: Unknowns) -> Unknowns:
    return vectors.reshape(*vectors.shape[:-2], -1)


_TURN = radians(12.0)
_POSES = 5
"""Most configurations that have to close, besides the reference."""
_ROUNDS = 40
_TIGHT = 1e-14
_DAMPING, _LEAST, _MOST = 1e-2, 1e-16, 1e6
_GAIN = 1e-3
"""A step that reduces the sum of squares by less than this part is the last: the search has come to rest."""
_UNIT = 60.0
"""A step with up to so many unknowns is a unit of work; one with more counts in proportion."""

System = Callable[[Floats], tuple[Floats, Floats]]
"""Of unknowns float[n]: numbers to be zero, and their derivatives."""


def linkage_at(graph: SCGraph, axes: Floats) -> PosedLinkage:
    """Return a linkage with axes float[J, 6], a point and a direction each."""
    pairs = zip(graph.joints, axes.tolist(), strict=True)
    return linkage_of_axes(graph, {joint: (axis[:3], axis[3:]) for joint, axis in pairs})


def axes_meeting(conditions: Sequence[AxisCondition], start: Floats, work: Allowance) -> Floats | None:
    """Return unknowns near a start, float[rows, 6], that meet conditions; None if none were found."""
    solution = _solved(lambda unknowns: _stacked(conditions, unknowns.reshape(start.shape)), start.ravel(), work)
    return None if solution is None else solution.reshape(start.shape)


def axes_along_a_motion(
    graph: SCGraph, conditions: Sequence[AxisCondition], start: Floats, work: Allowance
) -> Floats | None:
    """Return unknowns near a start that meet conditions, with loops that close at configurations along one motion.

    The start, float[rows, 6], meets the conditions. None if not all configurations closed.
    """
    # The axes at the reference, and the joint angles of the configurations, are unknowns of one problem: one joint
    # is driven by twelve degrees from one configuration to the next. One is added when those before close.
    joints = len(graph.joints)
    closure = ClosureEquations(linkage_at(graph, start[:joints]))
    jacobian = closure.at(np.zeros(joints))[1].toarray()
    rates = np.linalg.eigh(jacobian.T @ jacobian)[1][:, 0]
    poses = _Poses(graph, conditions, start.shape, leading(rates))
    rates = rates / rates[poses.driver]
    rows, angles = start, np.zeros((1, joints))
    # each configuration adds equations: after so many no dimension, or a few, is left to choose
    each = closure.rows - (closure.joints - 1)
    needed = min(_POSES, ceil((4 * closure.joints - 7) / max(each, 1)) + 1)
    for number in range(1, needed + 1):
        angles = np.vstack([angles, angles[-1] + rates * _TURN])
        solution = _solved(poses.system(number), poses.joined(rows, angles[1:]), work)
        if solution is None:
            return None
        rows, at_poses = poses.parted(solution, number)
        angles = np.vstack([np.zeros((1, joints)), at_poses])
        rates = (angles[-1] - angles[-2]) / _TURN
    return rows


@dataclass(frozen=True)
class _Poses:
    """Unknowns of axes, and of the angles of all joints but the driven one at each configuration."""

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
        """Return axes and angles of a number of configurations."""
        size = int(np.prod(self.shape))
        angles = np.zeros((number, len(self.graph.joints)))
        angles[:, self._free] = unknowns[size:].reshape(number, -1)
        angles[:, self.driver] = _TURN * np.arange(1, number + 1)
        return unknowns[:size].reshape(self.shape), angles

    def system(self, number: int) -> System:
        """Return the system of conditions and closure equations for a number of configurations."""
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
    """Return unknowns at which all is zero, near a start; None if the search came to rest elsewhere.

    Conditions may be dependent where they hold, so steps are damped (Levenberg, Marquardt).
    """
    unknowns, damping = start, _DAMPING
    off, by = system(unknowns)
    for _ in range(_ROUNDS):
        if np.abs(off).max(initial=0.0) <= _TIGHT:
            break
        better = None
        while better is None and damping <= _MOST and work.take(max(1.0, len(unknowns) / _UNIT)):
            step = -damped_least_squares(by, off, np.sqrt(damping))
            tried = system(unknowns + step)
            if tried[0] @ tried[0] < (1.0 - _GAIN) * (off @ off):
                better = tried
            else:
                damping *= 4.0
        if better is None:
            break
        unknowns, (off, by), damping = unknowns + step, better, max(damping / 8.0, _LEAST)
    return unknowns if np.abs(off).max(initial=0.0) <= DOUBLE.closed else None
