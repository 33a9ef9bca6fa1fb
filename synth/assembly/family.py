"""A family of linkages: closure equations with the axes and the driven angles as complex parameters.

Joint angles, axes and inputs may be complex: then the number of positions is the same for all members but special
ones, and can be followed from one to another. An axis through a finite centre has two angles, one across a plane
its point there, so that everything is an entire function and no root has to choose a sign. Theory:
docs/theory/positions.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import atan2, hypot

import numpy as np

from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.geometry import frame_about, lines_meet
from graphs.loops.loop import Centre
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats, Ints, JointId
from synth.assembly.kernel import (
    ARRIVED,
    DIRECTION,
    FAR,
    POINT,
    SLIDE,
    Complexes,
    Type,
    corrected_all,
    evaluated,
    followed_all,
)
from synth.motion.linkage import PosedLinkage, PosedLoop

__all__ = ["SMALL", "Curves", "Family", "Followed", "family_of"]

Curves = tuple[Complexes, Complexes, Complexes]
SMALL = 3e-3
"""Of corrections along a path, radians."""


@dataclass(frozen=True, slots=True)
class Family:
    """Linkages of one type with joints driven.

    Parameters of a member: two numbers for each axis, and the angle or length of each driven joint. Rows of
    `loops`, int[L, K], are the axes of each loop in order, filled up with -1; `signs` says which way they are
    passed, 1 or -1. `axes`, int[A, 2], has the joint of each axis and how its parameters give it: DIRECTION in
    loops with a finite centre, POINT or SLIDE in those with parallel axes (`synth.assembly.kernel`). `joints` are
    all that are in loops; `column` is the place of each among the unknown ones, and for a driven one -1 - (its
    place among the driven).
    """

    loops: Ints
    signs: Floats
    axes: Ints
    joints: tuple[JointId, ...]
    column: Ints

    @property
    def unknowns(self) -> int:
        """Number of joints that are not driven."""
        return int((self.column >= 0).sum())

    @property
    def driven(self) -> int:
        """Number of joints that are driven."""
        return len(self.column) - self.unknowns

    @property
    def turning(self) -> Flags:
        """Whether an unknown is an angle, and not the length of a slide: bool[U]."""
        turning = np.ones(self.unknowns, dtype=bool)
        slides = self.column[self.axes[self.axes[:, 1] == SLIDE, 0]]
        turning[slides[slides >= 0]] = False
        return turning

    def followed(self, curves: Curves, values: Complexes, small: float = SMALL) -> Followed:
        """Follow solutions from members of the family to others.

        Curves are three complex[P, parameters], start, end and bend of the parameters: at s, start + s (end -
        start) + s (1 - s) bend. Values are the solutions at the starts, complex[P, U]. The smaller the corrections
        that are allowed (`small`, radians), the less likely a path changes for another.
        """
        solutions = values.astype(complex)
        ends = followed_all(self._type, curves, solutions, small)
        return Followed(solutions, ends == ARRIVED, ends == FAR)

    def corrected(self, parameters: Complexes, values: Complexes, steps: int) -> tuple[Complexes, Floats]:
        """Return solutions by Newton's method, complex[P, U], and by how much loops do not close, float[P]."""
        solutions = values.astype(complex)
        return solutions, corrected_all(self._type, parameters, solutions, steps)

    def derivatives(self, parameters: Complexes, values: Complexes) -> Complexes:
        """Return the derivatives of what does not close by the unknowns: complex[3 L, U]."""
        return self.at(parameters, values)[1]

    def at(self, parameters: Complexes, values: Complexes) -> tuple[Complexes, Complexes]:
        """Return what does not close, complex[3 L], and its derivatives by the unknowns, complex[3 L, U]."""
        jacobian = np.empty((3 * len(self.loops), self.unknowns), dtype=complex)
        residual = np.empty(3 * len(self.loops), dtype=complex)
        evaluated(self._type, parameters, values, residual, jacobian)
        return residual, jacobian

    @property
    def _type(self) -> Type:
        return self.loops, self.signs, self.axes, self.column


@dataclass(frozen=True, slots=True)
class Followed:
    """Where paths came to: values, complex[P, U], and which arrived at the end or are far, gone to infinity.

    The others stopped on their way.
    """

    values: Complexes
    arrived: Flags
    far: Flags


def family_of(linkage: PosedLinkage, driven: Sequence[JointId]) -> tuple[Family, Floats]:
    """Return the family of a linkage with joints driven, and the parameters of this member's axes: float[2 A].

    Joints in no loop are left out. Raises `UnsolvableError` if a loop is neither spherical nor planar, or if so
    many driven joints do not determine the others by count, `InvariantError` if a driven joint is in no loop, or
    named twice.
    """
    joints = _joints_of_loops(linkage)
    _check_driven(joints, driven, len(joints) - 3 * len(linkage.loops))
    axes = _Axes(linkage)
    longest = max((len(loop.joints) for loop in linkage.loops), default=0)
    loops = np.full((len(linkage.loops), longest), -1, dtype=np.int64)
    signs = np.zeros(loops.shape)
    for row, loop in enumerate(linkage.loops):
        numbers, ways = axes.of_loop(loop)
        loops[row, : len(numbers)] = numbers
        signs[row, : len(numbers)] = np.multiply(loop.signs, ways)
    column = np.empty(len(joints), dtype=np.int64)
    known = [joints.index(joint) for joint in driven]
    column[known] = -1 - np.arange(len(known))
    column[np.setdiff1d(np.arange(len(joints)), known)] = np.arange(len(joints) - len(known))
    place = {list(linkage.graph.joints).index(joint): number for number, joint in enumerate(joints)}
    kinds = np.array([(place[joint], kind) for joint, kind in axes.kinds], dtype=np.int64).reshape(-1, 2)
    return Family(loops, signs, kinds, joints, column), np.array(axes.parameters, dtype=float).ravel()


def _joints_of_loops(linkage: PosedLinkage) -> tuple[JointId, ...]:
    names = list(linkage.graph.joints)
    return tuple(names[joint] for joint in sorted({joint for loop in linkage.loops for joint in loop.joints}))


def _check_driven(joints: Sequence[JointId], driven: Sequence[JointId], freedoms: int) -> None:
    for number, joint in enumerate(driven):
        if joint not in joints:
            raise InvariantError("joint", f"{shown(joint)} is no joint of a loop", "joints of loops to be driven")
        if joint in driven[:number]:
            raise InvariantError("joint", f"joint {shown(joint)} is driven twice", "once")
    if len(driven) != freedoms:
        raise UnsolvableError(
            f"{numbered(len(driven), 'joint')} driven, and M = {freedoms} by count: positions are counted where "
            "as many joints are driven as there are degrees of freedom"
        )


class _Axes:
    """The axes of a member, each with two parameters: one for each joint in each plane or sphere that it is in."""

    def __init__(self, linkage: PosedLinkage) -> None:
        self._linkage = linkage
        self._slides = set(linkage.slides)
        self._normals: list[Floats] = []
        self._numbers: dict[tuple[int, int], int] = {}
        self.kinds: list[tuple[int, int]] = []
        self.parameters: list[tuple[float, float]] = []

    def of_loop(self, loop: PosedLoop) -> tuple[list[int], list[int]]:
        """Return the axis of each joint of a loop, and -1 where it points against the normal of the plane."""
        directions = self._linkage.directions
        centre = self._centre(loop)
        if centre is Centre.FINITE:
            angles = [_tilt_and_turn(directions[joint]) for joint in loop.joints]
            numbers = [
                self._added(joint, -1, DIRECTION, pair) for joint, pair in zip(loop.joints, angles, strict=True)
            ]
            return numbers, [1] * len(loop.joints)
        if centre is not Centre.INFINITE:
            names = list(self._linkage.graph.joints)
            ids = shown([names[joint] for joint in loop.joints])
            raise UnsolvableError(
                "positions are found of loops whose axes meet in a point or are parallel, "
                f"and those of loop {ids} do neither"
            )
        turning = [joint for joint in loop.joints if joint not in self._slides]
        plane, frame = self._plane(directions[turning])
        numbers, ways = [], []
        for joint in loop.joints:
            if joint in self._slides:
                x, y = frame[:2] @ directions[joint]
                numbers.append(self._added(joint, plane, SLIDE, (float(np.arctan2(y, x)), 0.0)))
                ways.append(1)
            else:
                x, y = frame[:2] @ self._linkage.points[joint]
                numbers.append(self._added(joint, plane, POINT, (float(x), float(y))))
                ways.append(1 if directions[joint] @ frame[2] > 0.0 else -1)
        return numbers, ways

    def _centre(self, loop: PosedLoop) -> Centre:
        """Return the centre of a loop, found from its axes where it is not declared."""
        if loop.centre is not Centre.NONE:
            return loop.centre
        turning = [joint for joint in loop.joints if joint not in self._slides]
        sliding = [joint for joint in loop.joints if joint in self._slides]
        axes, ways = self._linkage.directions[turning], self._linkage.directions[sliding]
        if (
            len(axes)
            and max(np.abs(np.cross(axes, axes[0])).max(), np.abs(ways @ axes[0]).max(initial=0.0)) <= DOUBLE.meant
        ):
            return Centre.INFINITE
        if not sliding and float(lines_meet(self._linkage.points[turning], axes).off.max()) <= DOUBLE.meant:
            return Centre.FINITE
        return Centre.NONE

    def _plane(self, axes: Floats) -> tuple[int, Floats]:
        """Return the number of the plane across some axes, and its frame: one for all parallel planes."""
        for number, normal in enumerate(self._normals):
            if np.abs(np.cross(normal, axes[0])).max() <= DOUBLE.meant:
                return number, frame_about(normal)
        self._normals.append(axes[0])
        return len(self._normals) - 1, frame_about(axes[0])

    def _added(self, joint: int, plane: int, kind: int, parameters: tuple[float, float]) -> int:
        number = self._numbers.setdefault((joint, plane), len(self.kinds))
        if number == len(self.kinds):
            self.kinds.append((joint, kind))
            self.parameters.append(parameters)
        return number


def _tilt_and_turn(direction: Floats) -> tuple[float, float]:
    x, y, z = direction.tolist()
    return atan2(hypot(x, y), z), atan2(y, x)
