"""A family of spherical linkages: closure equations with the axes and the driven angles as complex parameters.

Joint angles, axes and inputs may be complex: then the number of positions is the same for all members but special
ones, and can be followed from one to another. Axes are given by two angles each, so that everything is an entire
function and no root has to choose a sign. Theory: docs/theory/positions.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphs.arrays import Flags, Floats, Ints
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.ids import JointId
from graphs.loops.loop import Centre
from synth.assembly.kernel import ARRIVED, FAR, Complexes, corrected_all, evaluated, followed_all
from synth.motion.linkage import PosedLinkage

__all__ = ["SMALL", "Curves", "Family", "Followed", "family_of"]

Curves = tuple[Complexes, Complexes, Complexes]
SMALL = 3e-3
"""Of corrections along a path, radians."""


@dataclass(frozen=True, slots=True)
class Family:
    """Linkages of one type with joints driven.

    Parameters of a member: two angles of each axis, and the angle of each driven joint. Rows of `loops`, int[L,
    K], are the joints of each loop in order, filled up with -1; `signs` says which way they are passed, 1 or -1.
    `joints` are all that are in loops; `column` is the place of each among the unknown ones, and for a driven one
    -1 - (its place among the driven).
    """

    loops: Ints
    signs: Floats
    joints: tuple[JointId, ...]
    column: Ints

    @property
    def unknowns(self) -> int:
        """Joints that are not driven."""
        return int((self.column >= 0).sum())

    @property
    def driven(self) -> int:
        """Joints that are driven."""
        return len(self.column) - self.unknowns

    def followed(self, curves: Curves, values: Complexes, small: float = SMALL) -> Followed:
        """Follow solutions from members of the family to others.

        Curves are three complex[P, parameters], start, end and bend of the parameters: at s, start + s (end -
        start) + s (1 - s) bend. Values are the solutions at the starts, complex[P, U]. The smaller the corrections
        that are allowed (`small`, radians), the less likely a path changes for another.
        """
        found = values.astype(complex)
        ends = followed_all(self.loops, self.signs, self.column, curves, found, small)
        return Followed(found, ends == ARRIVED, ends == FAR)

    def corrected(self, parameters: Complexes, values: Complexes, steps: int) -> tuple[Complexes, Floats]:
        """Return solutions by Newton's method, complex[P, U], and by how much loops do not close, float[P]."""
        found = values.astype(complex)
        return found, corrected_all(self.loops, self.signs, self.column, parameters, found, steps)

    def derivatives(self, parameters: Complexes, values: Complexes) -> Complexes:
        """Return the derivatives of what does not close by the unknown angles: complex[3 L, U]."""
        jacobian = np.empty((3 * len(self.loops), self.unknowns), dtype=complex)
        off = np.empty(3 * len(self.loops), dtype=complex)
        evaluated(self.loops, self.signs, self.column, parameters, values, off, jacobian)
        return jacobian


@dataclass(frozen=True, slots=True)
class Followed:
    """Where paths came to: values, complex[P, U], and which arrived at the end or are far, gone to infinity.

    The others stopped on their way.
    """

    values: Complexes
    arrived: Flags
    far: Flags


def family_of(linkage: PosedLinkage, driven: Sequence[JointId]) -> tuple[Family, Floats]:
    """Return the family of a spherical linkage with joints driven, and the angles of the axes of this member.

    The angles are float[2 J]; joints in no loop are left out. Raises `UnsolvableError` if a loop has no finite
    centre, or if so many driven joints do not determine the others by count, `InvariantError` if a driven joint is
    in no loop, or named twice.
    """
    names = list(linkage.graph.joints)
    for loop in linkage.loops:
        if loop.centre is not Centre.FINITE:
            told = shown([names[joint] for joint in loop.joints])
            raise UnsolvableError(f"positions are found of spherical linkages: loop {told} has no finite centre")
    inside = sorted({joint for loop in linkage.loops for joint in loop.joints})
    place = {joint: number for number, joint in enumerate(inside)}
    joints = tuple(names[joint] for joint in inside)
    for number, joint in enumerate(driven):
        if joint not in joints:
            raise InvariantError("joint", f"{shown(joint)} is no joint of a loop", "joints of loops to be driven")
        if joint in driven[:number]:
            raise InvariantError("joint", f"joint {shown(joint)} is driven twice", "once")
    wanted = len(joints) - 3 * len(linkage.loops)
    if len(driven) != wanted:
        told = f"{numbered(len(driven), 'joint')} driven, and M = {wanted} by count"
        raise UnsolvableError(
            f"{told}: positions are counted where as many joints are driven as there are freedoms"
        )
    column = np.empty(len(joints), dtype=np.int64)
    known = [joints.index(joint) for joint in driven]
    column[known] = -1 - np.arange(len(known))
    column[np.setdiff1d(np.arange(len(joints)), known)] = np.arange(len(joints) - len(known))
    longest = max((len(loop.joints) for loop in linkage.loops), default=0)
    loops = np.full((len(linkage.loops), longest), -1, dtype=np.int64)
    signs = np.zeros(loops.shape)
    for row, loop in enumerate(linkage.loops):
        loops[row, : len(loop.joints)] = [place[joint] for joint in loop.joints]
        signs[row, : len(loop.joints)] = loop.signs
    x, y, z = linkage.directions[inside].T
    pairs = np.stack([np.arctan2(np.hypot(x, y), z), np.arctan2(y, x)], axis=1)
    return Family(loops, signs, joints, column), np.asarray(pairs.ravel())
