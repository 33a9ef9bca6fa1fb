"""Closure equations of a linkage at joint angles, and their derivatives: what motion has to keep at zero.

A loop closes if the product of its joint rotations, each about its axis as it lies at the pose, is the identity
(product of exponentials). About a finite centre that are three equations (a rotation), about an infinite one three
(a motion in a plane), else six (a screw). The derivative by a joint angle is the axis of the joint where it is
now. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass

import numpy as np
import scipy.sparse

from graphs.geometry import common_direction, frame_about, rotations
from graphs.loops.loop import Centre
from graphs.types import Floats, Ints
from synth.motion.linkage import PosedLinkage, PosedLoop

__all__ = ["ClosureEquations", "carried", "frames_of"]


@dataclass(frozen=True, slots=True)
class _Alike:
    """Loops of one kind and length k, at the pose: joints and signs [L, k], axes and points float[L, k, 3].

    Frames, float[L, 3, 3], are those of loops with parallel axes: two directions across the axes, and theirs. Of
    joints that slide `turning`, float[L, k], is 0, of others 1.
    """

    joints: Ints
    axes: Floats
    points: Floats
    signs: Floats
    centre: Centre
    frames: Floats
    turning: Floats

    @property
    def equations(self) -> int:
        """Of each loop."""
        return 6 if self.centre is Centre.NONE else 3

    def by_axes(self, angles: Floats) -> Floats:
        """Return derivatives by small motions of the axes, each a rotation and a shift: float[L, e, 6 k]."""
        loops, k = self.joints.shape
        values = angles[self.joints] * self.signs
        steps, slid = rotations(self.axes, values * self.turning), self._slid(values)
        before = carried(np.broadcast_to(np.eye(3), (loops, 3, 3)), np.zeros((loops, 3)))
        rotation, moved = np.broadcast_to(np.eye(3), (loops, 3, 3)), np.zeros((loops, 3))
        made = np.empty((loops, 6, k, 6))
        for i in range(k):
            point = self.points[:, i, :, None]
            moved = moved + (rotation @ (point - steps[:, i] @ point + slid[:, i, :, None]))[..., 0]
            rotation = rotation @ steps[:, i]
            after = carried(rotation, moved)
            made[:, :, i] = before - after
            before = after
        twists = made.reshape(loops, 6, 6 * k)
        if self.centre is Centre.FINITE:
            return twists[:, :3]
        return self._in_plane(twists) if self.centre is Centre.INFINITE else twists

    def evaluated(self, angles: Floats) -> tuple[Floats, Floats]:
        """Return residuals float[L, e] and derivatives float[L, e, k]."""
        loops, k = self.joints.shape
        spherical = self.centre is Centre.FINITE
        values = angles[self.joints] * self.signs
        steps = rotations(self.axes, values * self.turning)
        slid = None if spherical else self._slid(values)
        rotation = np.broadcast_to(np.eye(3), (loops, 3, 3))
        moved = np.zeros((loops, 3))
        twists = np.empty((loops, 3 if spherical else 6, k))
        for i in range(k):
            axis = (rotation @ self.axes[:, i, :, None])[..., 0]
            twists[:, :3, i] = axis
            if slid is not None:
                point = self.points[:, i, :, None]
                twists[:, 3:, i] = np.cross((rotation @ point)[..., 0] + moved, axis)
                moved = moved + (rotation @ (point - steps[:, i] @ point + slid[:, i, :, None]))[..., 0]
            rotation = rotation @ steps[:, i]
        twists = self._with_slides(twists)
        twists *= self.signs[:, None, :]
        off = _rotation_vectors(rotation)
        if not spherical:
            off = np.concatenate([off, moved], axis=1)
        if self.centre is Centre.INFINITE:
            return self._in_plane(off[..., None])[..., 0], self._in_plane(twists)
        return off, twists

    def _slid(self, values: Floats) -> Floats:
        """Return the translations of joints that slide, zeros for others: float[L, k, 3]."""
        return (values * (1.0 - self.turning))[..., None] * self.axes

    def _with_slides(self, twists: Floats) -> Floats:
        """Return twists with those of joints that slide, whose direction is where their axis would be."""
        if self.turning.all():
            return twists
        along = np.concatenate([np.zeros_like(twists[:, :3]), twists[:, :3]], axis=1)
        return np.where(self.turning[:, None, :] == 1.0, twists, along)

    def _in_plane(self, twists: Floats) -> Floats:
        """Return the rotation about parallel axes and the shift across them: float[L, 3, n]."""
        turned = (self.frames @ twists[:, :3])[:, 2:]
        return np.concatenate([turned, (self.frames @ twists[:, 3:])[:, :2]], axis=1)


class ClosureEquations:
    """The closure equations of a linkage.

    Parameters
    ----------
    linkage : PosedLinkage

    Attributes
    ----------
    rows, joints : int
        Numbers of equations and unknowns.

    Examples
    --------
    A square four-bar in the plane; opposite joints turn alike, neighbours against each other:

    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.motion.linkage import linkage_of_axes
    >>> square = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3), "infinite")])
    >>> corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    >>> closure = ClosureEquations(linkage_of_axes(square, {j: (corners[j], (0, 0, 1)) for j in range(4)}))
    >>> residual, jacobian = closure.at(np.array([0.3, -0.3, 0.3, -0.3]))
    >>> float(abs(residual).max()) < 1e-15, jacobian.shape
    (True, (3, 4))
    """

    def __init__(self, linkage: PosedLinkage) -> None:
        self._zero = linkage.angles
        self._groups = _grouped(linkage)
        self.joints = len(linkage.angles)
        self.rows = sum(group.equations * len(group.joints) for group in self._groups)
        self._places, self._columns, self._starts = self._pattern()
        self._free: Floats | None = None

    def locked(self, joints: Sequence[int]) -> ClosureEquations:
        """Return the equations of the same linkage with some joints locked: derivatives by these are zero.

        Parameters
        ----------
        joints : sequence of int
            Places of the joints that keep their angles.
        """
        made = copy(self)
        made._free = np.ones(self.joints)
        made._free[list(joints)] = 0.0
        return made

    def by_axes(self, angles: Floats) -> scipy.sparse.csr_matrix:
        """Return the derivatives of what does not close by small motions of the axes.

        Where an axis is moved by a rotation w about the origin and a shift v, the loops it is in change as if its
        links were: exp(t x) becomes g exp(t x) g^-1.

        Parameters
        ----------
        angles : float[J]
            Radians, from the zero of each joint.

        Returns
        -------
        sparse float[rows, 6 J]
            By (w, v) of each joint in turn, at the pose of the linkage.
        """
        rows, columns, values, start = [], [], [], 0
        for group in self._groups:
            made = group.by_axes(angles - self._zero)
            row = start + np.arange(made.shape[0] * made.shape[1]).reshape(*made.shape[:2], 1)
            column = (6 * group.joints[..., None] + np.arange(6)).reshape(made.shape[0], 1, -1)
            rows.append(np.broadcast_to(row, made.shape).ravel())
            columns.append(np.broadcast_to(column, made.shape).ravel())
            values.append(made.ravel())
            start += made.shape[0] * made.shape[1]
        if not rows:
            return scipy.sparse.csr_matrix((0, 6 * self.joints))
        places = (np.concatenate(rows), np.concatenate(columns))
        return scipy.sparse.csr_matrix((np.concatenate(values), places), shape=(self.rows, 6 * self.joints))

    def _pattern(self) -> tuple[Ints, Ints, Ints]:
        """Return where in a row-by-row matrix each derivative goes, its columns and the starts of its rows."""
        rows, columns, start = [np.zeros(0, np.int64)], [np.zeros(0, np.int64)], 0
        for group in self._groups:
            loops, k = group.joints.shape
            row = start + np.arange(loops * group.equations).reshape(loops, group.equations, 1)
            rows.append(np.broadcast_to(row, (loops, group.equations, k)).ravel())
            columns.append(np.broadcast_to(group.joints[:, None, :], (loops, group.equations, k)).ravel())
            start += loops * group.equations
        row_of, column_of = np.concatenate(rows), np.concatenate(columns)
        order = np.lexsort((column_of, row_of))
        starts = np.searchsorted(row_of[order], np.arange(self.rows + 1))
        return order, column_of[order], starts

    def at(self, angles: Floats) -> tuple[Floats, scipy.sparse.csr_matrix]:
        """Return what does not close at joint angles, and its derivatives by them.

        Parameters
        ----------
        angles : float[J]
            Radians, from the zero of each joint.

        Returns
        -------
        (float[rows], sparse float[rows, J])
            Radians, and lengths in units of the extent.
        """
        evaluated = [group.evaluated(angles - self._zero) for group in self._groups]
        residual = np.concatenate([np.zeros(0), *(off.ravel() for off, _ in evaluated)])
        values = np.concatenate([np.zeros(0), *(twists.ravel() for _, twists in evaluated)])[self._places]
        if self._free is not None:
            values = values * self._free[self._columns]
        shape = (len(self._starts) - 1, self.joints)
        matrix = scipy.sparse.csr_matrix((values, self._columns, self._starts), shape=shape)
        return residual, matrix

    def error(self, angles: Floats) -> float:
        """Return by how much loops do not close at joint angles, at most."""
        return float(np.abs(self.at(angles)[0]).max(initial=0.0))


def carried(rotations: Floats, shifts: Floats) -> Floats:
    """Return what rigid motions make of twists (w, v), rotation about the origin and shift: the adjoint matrices.

    >>> (carried(np.eye(3)[None], np.array([[2.0, 0.0, 0.0]]))[0] @ [0, 0, 1, 0, 0, 0]).tolist()
    [0.0, 0.0, 1.0, 0.0, -2.0, 0.0]
    """
    made = np.zeros((len(rotations), 6, 6))
    made[:, :3, :3] = made[:, 3:, 3:] = rotations
    made[:, 3:, :3] = np.cross(shifts[:, None, :], rotations.transpose(0, 2, 1)).transpose(0, 2, 1)
    return made


def _grouped(linkage: PosedLinkage) -> list[_Alike]:
    kinds: dict[tuple[Centre, int], list[PosedLoop]] = {}
    for loop in linkage.loops:
        kinds.setdefault((loop.centre, len(loop.joints)), []).append(loop)
    turns = np.ones(len(linkage.angles))
    turns[list(linkage.slides)] = 0.0
    groups = []
    for (centre, _), loops in kinds.items():
        joints = np.array([loop.joints for loop in loops], dtype=np.int64)
        signs = np.array([loop.signs for loop in loops], dtype=float)
        axes, turning = linkage.directions[joints], turns[joints]
        frames = (
            frames_of(axes * turning[..., None]) if centre is Centre.INFINITE else np.zeros((len(loops), 3, 3))
        )
        groups.append(_Alike(joints, axes, linkage.points[joints], signs, centre, frames, turning))
    return groups


def frames_of(axes: Floats) -> Floats:
    """Return orthonormal frames of loops with parallel axes: two directions across them, then theirs.

    >>> abs(frames_of(np.array([[[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]]))[0, 2]).round(12).tolist()
    [0.0, 0.0, 1.0]
    """
    return frame_about(common_direction(axes))


def _rotation_vectors(rotations: Floats) -> Floats:
    """Return axis times angle of rotations: float[L, 3]."""
    sine = (
        np.stack(
            [
                rotations[:, 2, 1] - rotations[:, 1, 2],
                rotations[:, 0, 2] - rotations[:, 2, 0],
                rotations[:, 1, 0] - rotations[:, 0, 1],
            ],
            axis=1,
        )
        / 2.0
    )
    s = np.linalg.norm(sine, axis=1)
    angle = np.arctan2(s, (np.trace(rotations, axis1=1, axis2=2) - 1.0) / 2.0)
    small = s < 1e-8  # the quotient is 1 to the last digit, or no axis is known
    return sine * np.where(small, 1.0, angle / np.where(small, 1.0, s))[:, None]
