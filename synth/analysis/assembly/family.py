"""Families of linkages with complex axes and inputs, whose loops close to any quaternion.

Joint angles, axes and inputs may be complex: then the number of positions is the same for all members but special
ones, and positions can be followed from one member to another. An axis through a finite centre has two angles, one
across a plane its point there, so that everything is an entire function and no root has to choose a sign.

What each loop has to close to is a parameter too, 1 in linkages that are assembled as they were read: a member is cut
open once in each loop, and joined again with a rotation between. So every joint angle and every axis is a solution of
some member: solutions and members together are one irreducible variety, on which curves lead from each solution of a
member to each other. (Members whose loops all close where the joint angles are 0 have that solution for ever, and no
curve of them leads to another one.) Theory: docs/theory/positions.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import atan2, hypot
from typing import Any, NamedTuple

import networkx as nx
import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.geometry import frame_about
from graphs.loops.loop import Centre
from graphs.tolerances import DOUBLE, Tolerances
from graphs.types import Flags, Floats, Ints, JointId
from synth.analysis.assembly.kernel import ARRIVED, DIRECTION, FAR, POINT, SLIDE, Complexes, Line, Type
from synth.analysis.assembly.tracking import corrected_all, evaluated, followed_all
from synth.analysis.motion.linkage import Linkage, LinkageLoop, centre_of

Curves = tuple[Complexes, Complexes, Complexes]
SMALL = 3e-3
"""Of corrections along a path, radians."""


@dataclass(frozen=True, slots=True)
class Family:
    """Linkages of one type with driven joints; loops, signs, axes and column are those of `kernel.Type`.

    Parameters of a member: two numbers for each axis, the angle or length of each driven joint, and the quaternion
    that each loop has to close to. `joints` are all that are in loops, `links`, int[J, 2], the numbers of the links
    that they join. Axes of one link that coincide stay so in the family: `alike`, int[A, 2], is the first of them
    and 1, or -1 where it points the other way.
    """

    loops: Ints
    signs: Floats
    axes: Ints
    joints: tuple[JointId, ...]
    column: Ints
    links: Ints
    alike: Ints

    @property
    def driven(self) -> int:
        """Number of driven joints."""
        return len(self.joints) - self.unknowns

    def member(self, axes: npt.NDArray[Any], inputs: npt.NDArray[Any], cuts: Complexes | None = None) -> Complexes:
        """Return the parameters of a member: axes[2 A], inputs[D], and what loops close to, by default 1."""
        if cuts is None:
            cuts = np.tile(np.array([1.0, 0.0, 0.0, 0.0], dtype=complex), (len(self.loops), 1))
        return np.concatenate([axes, inputs, cuts.ravel()]).astype(complex)

    def coincident(self, pairs: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """Return parameters of axes, complex[A, 2], with those that coincide alike: complex[2 A]."""
        first, opposite = pairs[self.alike[:, 0]], self.alike[:, 1] < 0
        first[opposite] = np.pi + first[opposite] * np.array([-1.0, 1.0])
        return np.asarray(first.ravel())

    def closed_to(self, parameters: Complexes, values: Complexes) -> Complexes:
        """Return the quaternion that each loop closes to with unknowns complex[U]: complex[L, 4]."""
        # the residual is the vector part of the product times a conjugate: of 1 that of the product, of i less its
        # real part in the first place
        plain = parameters.copy()
        parts = []
        for unit_of in range(2):
            cuts = np.zeros((len(self.loops), 4), dtype=complex)
            cuts[:, unit_of] = 1.0
            plain[-cuts.size :] = cuts.ravel()
            parts.append(self.at(plain, values)[0].reshape(-1, 3))
        return np.concatenate([-parts[1][:, :1], parts[0]], axis=1)

    @property
    def unknowns(self) -> int:
        """Number of joints that are not driven."""
        return int((self.column >= 0).sum())

    @property
    def turning(self) -> Flags:
        """Whether an unknown is an angle, and not the length of a slide: bool[U]."""
        turning = np.ones(self.unknowns, dtype=bool)
        slides = self.column[self.axes[self.axes[:, 1] == SLIDE, 0]]
        turning[slides[slides >= 0]] = False
        return turning

    def followed(
        self, curves: Curves, values: Complexes, small: float = SMALL, line: Line | None = None
    ) -> TrackedPaths:
        """Follow solutions, complex[P, U], from members of the family to others.

        Curves are start, end and bend of the parameters, complex[P, parameters]: at s, start + s (end - start) + s
        (1 - s) bend. The smaller the allowed corrections (`small`, radians), the surer each path stays its own. On a
        line of members, curves are of the hyperplanes that meet the curve of their solutions (`kernel.Line`).
        """
        solutions = np.array(values, dtype=complex, order="C")
        ends = followed_all(self._type, curves, solutions, small, line)
        return TrackedPaths(solutions, ends == ARRIVED, ends == FAR)

    def corrected(self, parameters: Complexes, values: Complexes, steps: int) -> tuple[Complexes, Floats]:
        """Return solutions by Newton's method, complex[P, U], and by how much loops do not close, float[P]."""
        solutions = np.array(values, dtype=complex, order="C")
        return solutions, corrected_all(self._type, parameters, solutions, steps)

    def at(self, parameters: Complexes, values: Complexes) -> tuple[Complexes, Complexes]:
        """Return the closure residual, complex[3 L], and its derivatives by the unknowns, complex[3 L, U]."""
        jacobian = np.empty((3 * len(self.loops), self.unknowns), dtype=complex)
        residual = np.empty(3 * len(self.loops), dtype=complex)
        evaluated(self._type, parameters, values, residual, jacobian)
        return residual, jacobian

    @property
    def _type(self) -> Type:
        return self.loops, self.signs, self.axes, self.column


class TrackedPaths(NamedTuple):
    """Ends of paths: values, complex[P, U], and which arrived or are far, at infinity; the others stopped."""

    values: Complexes
    arrived: Flags
    far: Flags


def family_of(linkage: Linkage, driven: Sequence[JointId], tolerances: Tolerances = DOUBLE) -> tuple[Family, Floats]:
    """Return the family of a linkage with driven joints, and the parameters of this member's axes: float[2 A].

    Joints in no loop are left out. Axes meet or are parallel within the tolerances. Raise `UnsolvableError` if a loop
    is neither spherical nor planar, or if so many driven joints do not determine the others by count, `InvariantError`
    if a driven joint is in no loop, or named twice. Without loops there is nothing to solve, which is an
    `UnsolvableError` too.
    """
    if not linkage.loops:
        raise UnsolvableError("positions requires a closed loop; here each joint moves by itself")
    names = list(linkage.graph.joints)
    numbers_in_loops = sorted({joint for loop in linkage.loops for joint in loop.joints})
    joints = tuple(names[joint] for joint in numbers_in_loops)
    _check_names(joints, driven)
    axes = _Axes(linkage, tolerances)
    longest = max((len(loop.joints) for loop in linkage.loops), default=0)
    loops = np.full((len(linkage.loops), longest), -1, dtype=np.int64)
    signs = np.zeros(loops.shape)
    for row, loop in enumerate(linkage.loops):
        numbers, senses = axes.of_loop(loop)
        loops[row, : len(numbers)] = numbers
        signs[row, : len(numbers)] = np.multiply(loop.signs, senses)
    _check_number(driven, len(joints) - 3 * len(linkage.loops))  # a count that holds where no loop is spatial
    column = np.empty(len(joints), dtype=np.int64)
    known = [joints.index(joint) for joint in driven]
    column[known] = -1 - np.arange(len(known))
    column[np.setdiff1d(np.arange(len(joints)), known)] = np.arange(len(joints) - len(known))
    place = {joint: number for number, joint in enumerate(numbers_in_loops)}
    kinds = np.array([(place[joint], kind) for joint, kind in axes.kinds], dtype=np.int64).reshape(-1, 2)
    number_of = {link: number for number, link in enumerate(linkage.graph.nodes)}
    links = np.array([[number_of[link] for link in linkage.graph.joints[joint]] for joint in joints], dtype=np.int64)
    # joints with one axis are read with equal coordinates, whatever the precision of these
    alike = _alike(kinds, links, np.array(axes.lines), DOUBLE.same_point)
    family = Family(loops, signs, kinds, joints, column, links, alike)
    return family, family.coincident(np.array(axes.parameters, dtype=float))


def _alike(kinds: Ints, links: Ints, lines: Floats, same: float) -> Ints:
    """Return of each axis the first that coincides with it in its links, and links of these, and how it points.

    Lines, float[A, 3], are directions of axes through a centre, and points in a numbered plane. Slides stay apart.
    """
    joined = nx.Graph()
    joined.add_nodes_from(range(len(kinds)))
    for one in range(len(kinds)):
        near = np.flatnonzero((kinds[:one, 1] == kinds[one, 1]) & (kinds[one, 1] != SLIDE))
        near = near[(links[kinds[near, 0]][:, :, None] == links[kinds[one, 0]]).any(axis=(1, 2))]
        sense = 1.0 if kinds[one, 1] == POINT else np.sign(lines[near] @ lines[one])[:, None]
        off = np.abs(lines[near] - sense * lines[one]).max(axis=1, initial=0.0)
        joined.add_edges_from((one, int(other)) for other in near[off <= same])
    alike = np.stack([np.arange(len(kinds)), np.ones(len(kinds), dtype=np.int64)], axis=1)
    for part in nx.connected_components(joined):
        first = min(part)
        for one in part:
            opposite = kinds[one, 1] == DIRECTION and lines[one] @ lines[first] < 0.0
            alike[one] = first, -1 if opposite else 1
    return alike


def _check_names(joints: Sequence[JointId], driven: Sequence[JointId]) -> None:
    for number, joint in enumerate(driven):
        if joint not in joints:
            raise InvariantError("joint", f"{shown(joint)} is no joint of a loop", "a joint of a loop")
        if joint in driven[:number]:
            raise InvariantError("joint", f"joint {shown(joint)} is driven twice", "once")


def _check_number(driven: Sequence[JointId], freedoms: int) -> None:
    if len(driven) != freedoms:
        raise UnsolvableError(
            f"{numbered(len(driven), 'joint')} driven; expected as many as there are degrees of freedom, "
            f"M = {freedoms} by count"
        )


class _Axes:
    """The axes of a member, each with two parameters: one for each joint in each plane or sphere that it is in."""

    def __init__(self, linkage: Linkage, tolerances: Tolerances) -> None:
        self._linkage = linkage
        self._tolerances = tolerances
        self._slides = set(linkage.slides)
        self._normals: list[Floats] = []
        self._numbers: dict[tuple[int, int], int] = {}
        self.kinds: list[tuple[int, int]] = []
        self.parameters: list[tuple[float, float]] = []
        self.lines: list[tuple[float, float, float]] = []

    def of_loop(self, loop: LinkageLoop) -> tuple[list[int], list[int]]:
        """Return the axis of each joint of a loop, and -1 where it points against the normal of the plane."""
        directions = self._linkage.directions
        centre = centre_of(self._linkage, loop, self._tolerances)
        if centre is Centre.FINITE:
            numbers = []
            for joint in loop.joints:
                x, y, z = directions[joint].tolist()
                numbers.append(self._added(joint, -1, DIRECTION, (atan2(hypot(x, y), z), atan2(y, x))))
            return numbers, [1] * len(loop.joints)
        if centre is not Centre.INFINITE:
            names = list(self._linkage.graph.joints)
            ids = ", ".join(shown(names[joint]) for joint in loop.joints)
            raise UnsolvableError(
                f"the axes of loop {ids} neither meet in a point nor are parallel, as positions require; "
                "try `synth fold`, which drives joints along the motion"
            )
        turning = [joint for joint in loop.joints if joint not in self._slides]
        plane, frame = self._plane(directions[turning])
        numbers, senses = [], []
        for joint in loop.joints:
            if joint in self._slides:
                x, y = frame[:2] @ directions[joint]
                numbers.append(self._added(joint, plane, SLIDE, (float(np.arctan2(y, x)), 0.0)))
                senses.append(1)
            else:
                x, y = frame[:2] @ self._linkage.points[joint]
                numbers.append(self._added(joint, plane, POINT, (float(x), float(y))))
                senses.append(1 if directions[joint] @ frame[2] > 0.0 else -1)
        return numbers, senses

    def _plane(self, axes: Floats) -> tuple[int, Floats]:
        """Return the number of the plane across some axes, and its frame: one for all parallel planes."""
        for number, normal in enumerate(self._normals):
            if np.abs(np.cross(normal, axes[0])).max() <= self._tolerances.meant:
                return number, frame_about(normal)
        self._normals.append(axes[0])
        return len(self._normals) - 1, frame_about(axes[0])

    def _added(self, joint: int, plane: int, kind: int, parameters: tuple[float, float]) -> int:
        number = self._numbers.setdefault((joint, plane), len(self.kinds))
        if number == len(self.kinds):
            self.kinds.append((joint, kind))
            self.parameters.append(parameters)
            x, y, z = self._linkage.directions[joint].tolist()
            self.lines.append((x, y, z) if kind == DIRECTION else (*parameters, float(plane)))
        return number


def apart(values: Complexes, turning: Flags) -> Complexes:
    """Return solutions each once; angles, which `turning` (bool[U]) marks, are the same but for whole turns."""
    kept: list[Complexes] = []
    for solution in values:
        if not same(np.array(kept).reshape(-1, len(turning)), solution, turning).any():
            kept.append(solution)
    return np.array(kept).reshape(-1, values.shape[1])


def same(values: Complexes, solution: Complexes, turning: Flags) -> Flags:
    """Return which of some solutions, complex[N, U], are one solution, complex[U]: bool[N]."""
    off = values - solution
    off = off - 2 * np.pi * np.where(turning, np.rint(off.real / (2 * np.pi)), 0.0)
    return np.asarray(np.abs(off).max(axis=1, initial=0.0) <= DOUBLE.same_configuration)


def as_real(matrix: Complexes) -> Floats:
    """Return a complex matrix as a real one of twice its size, and twice its rank."""
    return np.block([[matrix.real, -matrix.imag], [matrix.imag, matrix.real]])
