"""Closure equations of a linkage, their derivatives, and Newton's method for the nearest joint angles that close.

A loop closes if the product of its joint rotations, each about its axis where the linkage was read, is the
identity (product of exponentials): three equations about a finite centre (a rotation) or an infinite one (a motion
in a plane), else six (a screw). The derivative by a joint angle is the axis of the joint where it is now.
Equations may depend on each other and leave freedoms, so each step of Newton's method is the least one in the
sense of least squares, by regularised normal equations; the residual is always that of the loops. Theory:
docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
import scipy

from graphs.errors import UnsolvableError
from graphs.geometry import common_direction, crossing, frame_about, rotations
from graphs.loops.loop import Centre
from graphs.tolerances import DOUBLE
from graphs.types import Floats, Ints
from synth.analysis.motion.closure_kernel import KernelEquations, KernelFactor, kernel
from synth.analysis.motion.linkage import Linkage, LinkageLoop
from synth.analysis.motion.tangent import REGULAR, TangentSpace, largest_of

_SMALL = 0.01
"""Radians, below which a series is taken: the next term is a part of some 1e-12 there, and the formula divides by the
square of the angle."""
MOST_WHOLE = 1500
"""Joints of the largest linkage whose closure equations are taken apart as a full matrix."""


@dataclass(frozen=True, slots=True)
class _LoopGroup:
    """Loops of one kind and length k, at the configuration: joints and signs [L, k], axes and points float[L, k, 3].

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

    def with_axes(self, points: Floats, directions: Floats) -> _LoopGroup:
        """Return the same loops with axes through points float[J, 3] along unit vectors float[J, 3]."""
        axes, frames = directions[self.joints], np.zeros((len(self.joints), 3, 3))
        if self.centre is Centre.INFINITE:
            frames = frames_of(axes * self.turning[..., None])
        return replace(self, axes=axes, points=points[self.joints], frames=frames)

    @property
    def equations(self) -> int:
        """Number of equations of each loop."""
        return 6 if self.centre is Centre.NONE else 3

    def by_axes(self, angles: Floats) -> Floats:
        """Return derivatives by small motions of the axes, each a rotation and a shift: float[L, e, 6 k]."""
        loops, k = self.joints.shape
        values = angles[self.joints] * self.signs
        steps, slid = rotations(self.axes, values * self.turning), self._slid(values)
        before = carried(np.broadcast_to(np.eye(3), (loops, 3, 3)), np.zeros((loops, 3)))
        rotation, moved = np.broadcast_to(np.eye(3), (loops, 3, 3)), np.zeros((loops, 3))
        changes = np.empty((loops, 6, k, 6))
        for i in range(k):
            point = self.points[:, i, :, None]
            moved = moved + (rotation @ (point - steps[:, i] @ point + slid[:, i, :, None]))[..., 0]
            rotation = rotation @ steps[:, i]
            after = carried(rotation, moved)
            changes[:, :, i] = before - after
            before = after
        twists = changes.reshape(loops, 6, 6 * k)
        if self.centre is Centre.FINITE:
            return twists[:, :3]
        return self._in_plane(twists) if self.centre is Centre.INFINITE else twists

    def opened(self, off: Floats) -> Floats:
        """Return the derivatives of residuals float[L, e] by twists of the last link: float[L, e, e]."""
        matrices = np.broadcast_to(np.eye(self.equations), (len(off), self.equations, self.equations)).copy()
        if self.centre is Centre.INFINITE:
            matrices[:, 1, 0], matrices[:, 2, 0] = -off[:, 2], off[:, 1]
            return matrices
        angle = np.linalg.norm(off[:, :3], axis=1)
        small = angle < _SMALL  # the series 1 / 12 + angle^2 / 720 has all digits
        half = np.where(small, 1.0, angle / 2.0)
        factor = np.where(small, 1.0 / 12.0 + angle**2 / 720.0, (1.0 - half / np.tan(half)) / (4.0 * half**2))
        cross = crossing(off[:, :3])
        matrices[:, :3, :3] += -cross / 2.0 + factor[:, None, None] * (cross @ cross)
        if self.centre is Centre.NONE:
            matrices[:, 3:, :3] = -crossing(off[:, 3:])
        return matrices

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
    linkage : Linkage

    Attributes
    ----------
    rows, joints : int
        Numbers of equations and unknowns.

    Examples
    --------
    >>> from synth.analysis.moving._configuration_of import configuration_of
    >>> from synth.catalogue.patterns import generate
    >>> linkage = configuration_of(generate("bennett").mechanism).linkage
    >>> closure = ClosureEquations(linkage)
    >>> residual, jacobian = closure.at(linkage.angles)
    >>> float(abs(residual).max()) < 1e-12, jacobian.shape
    (True, (6, 4))
    """

    def __init__(self, linkage: Linkage) -> None:
        self._zero = linkage.angles
        self._groups = _grouped(linkage)
        self.joints = len(linkage.angles)
        self.rows = sum(group.equations * len(group.joints) for group in self._groups)
        self._kernel = _in_kernel(self.joints, self._groups)
        self._free: Floats | None = None

    def with_axes(self, linkage: Linkage) -> ClosureEquations:
        """Return the equations of a linkage of the same joints and loops with other axes, and another configuration.

        Which loops are alike, and where entries stand in the matrix, is found once for all of them.
        """
        _ = self._pattern  # kept, and shared from here on
        equations = object.__new__(type(self))
        equations.__dict__.update(self.__dict__)
        equations._zero, equations._free = linkage.angles, None
        equations._groups = [group.with_axes(linkage.points, linkage.directions) for group in self._groups]
        equations._kernel = _in_kernel(self.joints, equations._groups)
        return equations

    def __getstate__(self) -> dict[str, Any]:
        """Return the state for another process, which has a library of its own."""
        return {**self.__dict__, "_kernel": None}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._kernel = _in_kernel(self.joints, self._groups)

    def locked(self, joints: Sequence[int]) -> ClosureEquations:
        """Return the equations with the joints at some places locked: derivatives by these are zero."""
        equations = object.__new__(type(self))
        equations.__dict__.update(self.__dict__)  # with the same library: `copy` would make it anew
        equations._free = np.ones(self.joints)
        equations._free[list(joints)] = 0.0
        return equations

    def by_axes(self, angles: Floats) -> scipy.sparse.csr_matrix:
        """Return the derivatives of the residuals by small motions of the axes: sparse float[rows, 6 J].

        By a rotation w about the origin and a shift v of each axis in turn, at the configuration of the linkage; joint
        angles, float[J], are radians. The loops that an axis is in change as if its links were moved: exp(t x)
        becomes g exp(t x) g^-1.
        """
        rows, columns, values, start = [], [], [], 0
        for group in self._groups:
            changes = group.by_axes(angles - self._zero)
            row = start + np.arange(changes.shape[0] * changes.shape[1]).reshape(*changes.shape[:2], 1)
            column = (6 * group.joints[..., None] + np.arange(6)).reshape(changes.shape[0], 1, -1)
            rows.append(np.broadcast_to(row, changes.shape).ravel())
            columns.append(np.broadcast_to(column, changes.shape).ravel())
            values.append(changes.ravel())
            start += changes.shape[0] * changes.shape[1]
        if not rows:
            return scipy.sparse.csr_matrix((0, 6 * self.joints))
        places = (np.concatenate(rows), np.concatenate(columns))
        return scipy.sparse.csr_matrix((np.concatenate(values), places), shape=(self.rows, 6 * self.joints))

    def opened(self, residual: Floats, derivatives: Floats) -> Floats:
        """Return derivatives float[rows, n] as they are where loops are open by a residual float[rows].

        Derivatives are twists of the last link against the first; these turn the residual, a rotation vector and a
        shift, as they do at closed loops only to first order.
        """
        turned, start = np.empty_like(derivatives), 0
        for group in self._groups:
            loops = len(group.joints)
            rows = slice(start, start + loops * group.equations)
            by = group.opened(residual[rows].reshape(loops, group.equations))
            turned[rows] = (by @ derivatives[rows].reshape(*by.shape[:2], -1)).reshape(turned[rows].shape)
            start = rows.stop
        return turned

    @cached_property
    def _pattern(self) -> tuple[Ints, Ints, Ints]:
        """Where in a row-by-row matrix each derivative of the groups goes, its columns and the starts of its rows."""
        rows, columns, start = [np.zeros(0, np.int64)], [np.zeros(0, np.int64)], 0
        for group in self._groups:
            loops, k = group.joints.shape
            row = start + np.arange(loops * group.equations).reshape(loops, group.equations, 1)
            rows.append(np.broadcast_to(row, (loops, group.equations, k)).ravel())
            columns.append(np.broadcast_to(group.joints[:, None, :], (loops, group.equations, k)).ravel())
            start += loops * group.equations
        row_of, column_of = np.concatenate(rows), np.concatenate(columns)
        order = np.lexsort((column_of, row_of))
        starts = np.searchsorted(row_of[order], np.arange(start + 1))
        return order, column_of[order], starts

    @cached_property
    def _places(self) -> Ints:
        """Where in a full matrix, row after row, each entry goes."""
        _, columns, starts = self._pattern
        return np.asarray(np.repeat(np.arange(self.rows) * self.joints, np.diff(starts)) + columns)

    def evaluated(self, angles: Floats) -> tuple[Floats, Floats]:
        """Return the residuals float[rows] at joint angles float[J], and the entries of their derivatives in order."""
        if self._kernel is not None:
            return self._kernel.at(angles - self._zero, self._free)
        places, columns, _ = self._pattern
        evaluated = [group.evaluated(angles - self._zero) for group in self._groups]
        residual = np.concatenate([np.zeros(0), *(off.ravel() for off, _ in evaluated)])
        entries = np.concatenate([np.zeros(0), *(twists.ravel() for _, twists in evaluated)])[places]
        return residual, entries if self._free is None else entries * self._free[columns]

    def matrix(self, entries: Floats) -> scipy.sparse.csr_matrix:
        """Return derivatives by their entries: sparse float[rows, J]."""
        _, columns, starts = self._pattern
        return scipy.sparse.csr_matrix((entries, columns, starts), shape=(len(starts) - 1, self.joints))

    def space(self, entries: Floats) -> TangentSpace:
        """Return the rates where derivatives have these entries."""
        if self._kernel is None:
            return TangentSpace(self.matrix(entries))
        return TangentSpace(KernelFactor(self._kernel, entries, REGULAR))

    def at(self, angles: Floats) -> tuple[Floats, scipy.sparse.csr_matrix]:
        """Return the residuals float[rows] at joint angles float[J], and their derivatives, sparse float[rows, J].

        Angles are radians, from the zero of each joint; residuals are radians, and lengths in units of the extent.
        """
        residual, entries = self.evaluated(angles)
        return residual, self.matrix(entries)

    def corrected(self, angles: Floats) -> Corrected | None:
        """Return joint angles near some at which all loops close, by the library if there is one: `corrected`."""
        if self._kernel is None or not self.rows:
            return None
        end, entries, error, steps = self._kernel.corrected(_NEWTON, angles, self._zero, self._free)
        return Corrected(end, error, steps, self, entries)

    def walked(self, manner: Floats, place: dict[str, Any], most: int) -> tuple[dict[str, Floats], int] | None:
        """Take steps of a walk in the library (`KernelEquations.walked`), if there is one."""
        manner = np.concatenate([_NEWTON, manner])
        return None if self._kernel is None else self._kernel.walked(manner, place, most, self._zero, self._free)

    def dense(self, angles: Floats) -> Floats:
        """Return the derivatives of the residuals at joint angles float[J], float[rows, J]: for few joints."""
        matrix = np.zeros(self.rows * self.joints)
        matrix[self._places] = self.evaluated(angles)[1]
        return matrix.reshape(self.rows, self.joints)

    def error(self, angles: Floats) -> float:
        """Return the loop-closure residual at joint angles, float[J]: the largest equation."""
        return largest_of(self.evaluated(angles)[0])

    def check_closed(self, angles: Floats) -> None:
        """Raise `UnsolvableError` if loops miss by more than 1e-12 at joint angles, float[J]."""
        error = self.error(angles)
        if error > DOUBLE.closed:
            most = f"expected at most {DOUBLE.closed:.0e}"
            raise UnsolvableError(f"the loop-closure residual is {error:.1e} at this configuration; {most}")


def carried(rotations: Floats, shifts: Floats) -> Floats:
    """Return the adjoint matrices of rigid motions, for twists (w, v): rotation about the origin and shift."""
    adjoints = np.zeros((len(rotations), 6, 6))
    adjoints[:, :3, :3] = adjoints[:, 3:, 3:] = rotations
    adjoints[:, 3:, :3] = crossing(shifts) @ rotations
    return adjoints


def _grouped(linkage: Linkage) -> list[_LoopGroup]:
    kinds: dict[tuple[Centre, int], list[LinkageLoop]] = {}
    for loop in linkage.loops:
        kinds.setdefault((loop.centre, len(loop.joints)), []).append(loop)
    turns = np.ones(len(linkage.angles))
    turns[list(linkage.slides)] = 0.0
    groups = []
    for (centre, _), loops in kinds.items():
        joints = np.array([loop.joints for loop in loops], dtype=np.int64)
        signs = np.array([loop.signs for loop in loops], dtype=float)
        nowhere = np.zeros((0, 3))
        group = _LoopGroup(joints, nowhere, nowhere, signs, centre, nowhere, turns[joints])
        groups.append(group.with_axes(linkage.points, linkage.directions))
    return groups


def _in_kernel(joints: int, groups: Sequence[_LoopGroup]) -> KernelEquations | None:
    """Return the same equations in the library, loop after loop; None where there is no library."""
    library = kernel()
    if library is None:
        return None
    kinds = [group.centre for group in groups for _ in group.joints]
    lengths = [group.joints.shape[1] for group in groups for _ in group.joints]
    begin = np.concatenate([np.zeros(1, dtype=np.int64), np.cumsum(lengths, dtype=np.int64)])
    shapes = {"joints": (-1,), "signs": (-1,), "turning": (-1,), "axes": (-1, 3), "points": (-1, 3), "frames": (-1, 9)}
    parts = {
        name: np.concatenate([np.zeros(0), *(getattr(group, name).ravel() for group in groups)]).reshape(shape)
        for name, shape in shapes.items()
    }
    return KernelEquations(library, joints, kinds, begin, parts)


def frames_of(axes: Floats) -> Floats:
    """Return orthonormal frames of loops with parallel axes: two directions across them, then theirs."""
    return frame_about(common_direction(axes))


def _rotation_vectors(rotations: Floats) -> Floats:
    """Return axis times angle of rotations: float[L, 3]."""
    skew = (rotations - rotations.transpose(0, 2, 1)) / 2.0
    sine = np.stack([skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]], axis=1)
    s = np.linalg.norm(sine, axis=1)
    angle = np.arctan2(s, (np.trace(rotations, axis1=1, axis2=2) - 1.0) / 2.0)
    small = s < 1e-8  # the quotient is 1 to the last digit, or no axis is known
    return sine * np.where(small, 1.0, angle / np.where(small, 1.0, s))[:, None]


_STEPS = 12
"""Newton's method doubles the digits at each step: 12 are enough from wherever it leads to a closed configuration."""
_HOLDS = 2
"""Corrections after held joints were put back: the first leaves the square of an error of some digits."""
_SLOW = 0.1
"""A step that leaves more of the error than this is the last with its derivatives."""
_NEWTON = np.array([DOUBLE.closed, _SLOW, _STEPS, REGULAR])
"""These numbers as closure_kernel.c takes them."""


@dataclass(frozen=True)
class Corrected:
    """The result of Newton's method: angles in radians, the loop-closure residual, and the derivatives there."""

    angles: Floats
    error: float
    steps: int
    closure: ClosureEquations
    entries: Floats

    @property
    def closed(self) -> bool:
        """Whether all loops close."""
        return self.error <= DOUBLE.closed

    @cached_property
    def space(self) -> TangentSpace:
        """Rates there. A little beside a closed configuration overconstrained linkages have none."""
        return self.closure.space(self.entries)

    @property
    def jacobian(self) -> scipy.sparse.csr_matrix:
        """The derivatives of the closure equations there: sparse float[rows, J]."""
        return self.closure.matrix(self.entries)


def corrected(closure: ClosureEquations, angles: Floats, held: Sequence[int] = ()) -> Corrected:
    """Return joint angles near some at which all loops close, radians; held joints stay if others can follow.

    Matrices are factorised anew only where a step with the last one left too much. It ends when loops are closed
    and a further step would not make them better, or steps do not make the error less.
    """
    by_library = None if held else closure.corrected(angles)
    if by_library is not None:
        return by_library
    residual, entries = closure.evaluated(angles)
    best, off = Corrected(angles, largest_of(residual), 0, closure, entries), residual
    space, fresh = None, True
    for steps in range(1, _STEPS + 1):
        if best.error <= DOUBLE.closed / 100:
            break
        space = space or best.space
        moved = best.angles + space.step(off, held)
        residual, entries = closure.evaluated(moved)
        tried = Corrected(moved, largest_of(residual), steps, closure, entries)
        slow = tried.error > _SLOW * best.error
        if tried.error < best.error:
            best, off, fresh = tried, residual, False
        elif fresh:
            break
        if slow:
            if best.closed:
                break
            space, fresh = None, True
    return best


def exactly_held(closure: ClosureEquations, closed: Corrected, held: Sequence[int], values: Floats) -> Corrected:
    """Return a configuration found with joints held, with these at `values`, radians, to the last digit.

    Newton's method keeps held joints to some digits only, and what it left in them is error of the loops.
    """
    places = list(held)
    for _ in range(_HOLDS):
        angles = closed.angles.copy()
        angles[places] = values
        if np.array_equal(angles, closed.angles):
            return closed
        closed = corrected(closure, angles, held)
    angles = closed.angles.copy()
    angles[places] = values
    residual, entries = closure.evaluated(angles)
    return Corrected(angles, largest_of(residual), closed.steps, closure, entries)
