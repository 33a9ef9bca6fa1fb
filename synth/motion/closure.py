"""Closure equations of a linkage, their derivatives, and Newton's method for the nearest joint angles that close.

A loop closes if the product of its joint rotations, each about its axis where the linkage was read, is the
identity (product of exponentials): three equations about a finite centre (a rotation) or an infinite one (a motion
in a plane), else six (a screw). The derivative by a joint angle is the axis of the joint where it is now.
Equations may depend on each other and leave freedoms, so each step of Newton's method is the least one in the
sense of least squares, by regularised normal equations; the residual is always that of the loops. Theory:
docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.linalg
import scipy.sparse
from scipy.sparse.linalg import splu

from graphs.errors import NumericalError, UnsolvableError
from graphs.geometry import common_direction, frame_about, rotations
from graphs.loops.loop import Centre
from graphs.tolerances import DOUBLE
from graphs.types import Floats, Ints
from synth.motion.linkage import PosedLinkage, PosedLoop


@dataclass(frozen=True, slots=True)
class _LoopGroup:
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
    >>> from synth.moving.made import configuration_of
    >>> from synth.patterns import generate
    >>> linkage = configuration_of(generate("bennett").mechanism).linkage
    >>> closure = ClosureEquations(linkage)
    >>> residual, jacobian = closure.at(linkage.angles)
    >>> float(abs(residual).max()) < 1e-12, jacobian.shape
    (True, (6, 4))
    """

    def __init__(self, linkage: PosedLinkage) -> None:
        self._zero = linkage.angles
        self._groups = _grouped(linkage)
        self.joints = len(linkage.angles)
        self.rows = sum(group.equations * len(group.joints) for group in self._groups)
        self._places, self._columns, self._starts = self._pattern()
        self._free: Floats | None = None

    def locked(self, joints: Sequence[int]) -> ClosureEquations:
        """Return the equations with the joints at some places locked: derivatives by these are zero."""
        equations = copy(self)
        equations._free = np.ones(self.joints)
        equations._free[list(joints)] = 0.0
        return equations

    def by_axes(self, angles: Floats) -> scipy.sparse.csr_matrix:
        """Return the derivatives of the residuals by small motions of the axes: sparse float[rows, 6 J].

        By a rotation w about the origin and a shift v of each axis in turn, at the pose of the linkage; joint
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
        """Return the residuals float[rows] at joint angles float[J], and their derivatives, sparse float[rows, J].

        Angles are radians, from the zero of each joint; residuals are radians, and lengths in units of the extent.
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
        """Return the loop-closure residual at joint angles, float[J]: the largest equation."""
        return float(np.abs(self.at(angles)[0]).max(initial=0.0))

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
    adjoints[:, 3:, :3] = np.cross(shifts[:, None, :], rotations.transpose(0, 2, 1)).transpose(0, 2, 1)
    return adjoints


def _grouped(linkage: PosedLinkage) -> list[_LoopGroup]:
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
        frames = np.zeros((len(loops), 3, 3))
        if centre is Centre.INFINITE:
            frames = frames_of(axes * turning[..., None])
        groups.append(_LoopGroup(joints, axes, linkage.points[joints], signs, centre, frames, turning))
    return groups


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


_REGULAR = 1e-9
"""Part of the largest diagonal entry that is added to all: what is less than its root is no equation. Rounding
along freedoms is multiplied by its inverse."""
_DENSE = 40
"""Matrices of up to this many joints are full; larger full ones would wait for threads of BLAS."""
_STEPS = 12
_HOLDS = 2
"""Corrections after held joints were put back."""
_SLOW = 0.1
"""A step that leaves more of the error than this is the last with its derivatives."""
_FREE = 0.5
"""Part of a vector across the freedoms that is left, at most, where it has become one of them after a step."""
_SWEEPS = 24
_SETTLED, _UNSETTLED = 1e-14, 1e-9
"""Refinement ends where a sweep changes less than the first; where the last one changed more than the second, a
singular value is too small to count and too large to be none."""


class TangentSpace:
    """Least-squares solutions with derivatives of closure equations, sparse float[rows, J], at one place.

    `regular` times the largest diagonal entry of the normal equations is added to all of them.
    """

    def __init__(self, jacobian: scipy.sparse.csr_matrix, regular: float = _REGULAR) -> None:
        self._jacobian = jacobian
        self._transposed = jacobian.T.tocsr()
        self._solve, self._added = _solver(jacobian, self._transposed, regular)
        self._joints = jacobian.shape[1]
        self._moves: dict[int, Floats] = {}

    def step(self, residual: Floats, held: Sequence[int] = ()) -> Floats:
        """Return the least change of angles that takes a residual away; held joints stay if they can."""
        change = self._least_exactly(-residual)
        if not held:
            return change
        moves = np.stack([self.move(joint) for joint in held])
        places = list(held)
        shares = np.linalg.lstsq(moves[:, places], change[places], rcond=DOUBLE.zero)[0]
        return np.asarray(change - shares @ moves)

    def projected(self, rates: Floats) -> Floats:
        """Return the rates nearest to some at which all loops stay closed to first order: float[J]."""
        kept = rates
        for _ in range(2):  # the second takes off what regularisation left
            kept = kept - self._least(self._jacobian @ kept)
        return kept

    def sharpened(self, across: Floats) -> Floats:
        """Return a unit vector nearer to the least singular vector across the freedoms: inverse iteration.

        Of a vector that has become a freedom, its part along the freedoms.
        """
        free = self.projected(across)
        kept = across - free
        size = float(np.linalg.norm(kept))
        if size <= _FREE * float(np.linalg.norm(across)):
            return np.asarray(free / np.linalg.norm(free))
        sharper = self._solve(kept / size)
        sharper = sharper - self.projected(sharper)
        return np.asarray(sharper / np.linalg.norm(sharper))

    def solution(self, off: Floats) -> tuple[Floats, Floats]:
        """Return the least rates that part loops nearly by `off`, and what is left of that, to all digits."""
        left = self.beyond(off)
        within, none = off - left, np.zeros(self._joints)
        return _refined(lambda rates: self._least(within - self._jacobian @ rates), none, off), left

    def beyond(self, off: Floats) -> Floats:
        """Return the part of float[rows] that no rates make: what redundant equations say of it, to all digits."""
        none = np.zeros_like(off)
        return off - _refined(lambda part: self.image(self._solve(self._transposed @ (off - part))), none, off)

    def free(self, rates: Floats) -> Floats:
        """Return the rates nearest to some that keep loops closed: `projected` to all digits, float[J]."""
        none = np.zeros_like(rates)
        return rates - _refined(lambda across: self._least(self._jacobian @ (rates - across)), none, rates)

    def forces(self, rates: Floats) -> Floats:
        """Return the least forces float[rows] whose sum of rows is the part of float[J] across the freedoms."""
        across, none = rates - self.free(rates), np.zeros(self._jacobian.shape[0])
        return _refined(lambda forces: self.image(self._solve(across - self._transposed @ forces)), none, rates)

    def image(self, rates: Floats) -> Floats:
        """Return by what loops part at some rates: float[rows]."""
        return np.asarray(self._jacobian @ rates)

    def _least(self, off: Floats) -> Floats:
        """Return the least rates at which loops part by float[rows]: none of them along freedoms.

        The solution x of (J' J + e) x = J' b is J' (b - J x) / e too. Solved for, it has rounding along freedoms
        that was divided by e, and paths with several freedoms would go where that leads; a sum of rows of J has
        no part along freedoms. Across them half the digits are lost.
        """
        return self._sum_of_rows(off, self._solve(self._transposed @ off))

    def _least_exactly(self, off: Floats) -> Floats:
        """Return the same with all digits: what two solutions differ by has the lost ones across freedoms."""
        rates = self._solve(self._transposed @ off)
        least = self._sum_of_rows(off, rates)
        return least + self._least(self._jacobian @ (rates - least))

    def _sum_of_rows(self, off: Floats, rates: Floats) -> Floats:
        """Return a solution of the normal equations, float[J], as a sum of the rows of J."""
        return np.asarray(self._transposed @ ((off - self._jacobian @ rates) / self._added))

    def move(self, joint: int) -> Floats:
        """Return the rates nearest to those of one joint alone at which loops stay closed: float[J]."""
        if joint not in self._moves:
            self._moves[joint] = self.projected(np.eye(1, self._joints, joint)[0])
        return self._moves[joint]

    def least_rates(self, joints: Sequence[int], wanted: Floats) -> Floats:
        """Return the least rates at which some joints have wanted ones; zeros if they cannot: float[J]."""
        moves = np.stack([self.move(joint) for joint in joints])
        places = list(joints)
        shares, _, rank, _ = np.linalg.lstsq(moves[:, places], wanted, rcond=DOUBLE.zero)
        rates = shares @ moves
        # normal equations keep half the digits
        possible = rank and np.abs(rates[places] - wanted).max() <= DOUBLE.zero**0.5 * np.abs(wanted).max()
        return rates if possible and moves[:, places].max() > DOUBLE.zero else np.zeros_like(rates)


def _refined(correction: Callable[[Floats], Floats], total: Floats, residual: Floats) -> Floats:
    """Return the sum of corrections, each of which leaves a part m / (s^2 + m) of what was to be taken off.

    Here s is a singular value and m the regularisation; corrections are measured by the sum so far or the
    residual.
    """
    last, size = np.inf, _largest(residual)
    for _ in range(_SWEEPS):
        change = correction(total)
        total = total + change
        largest, whole = _largest(change), max(_largest(total), size)
        if largest <= _SETTLED * whole or (last / 2 <= largest <= _UNSETTLED * whole):
            return total
        last = largest
    if last > _UNSETTLED * whole:
        unclear = "the rank of the closure equations is not clear"
        raise NumericalError(f"the configuration is nearly singular: {unclear}")
    return total


def _solver(
    jacobian: scipy.sparse.csr_matrix, transposed: scipy.sparse.csr_matrix, regular: float
) -> tuple[Callable[[Floats], Floats], float]:
    """Return what solves the normal equations, and what is added to their diagonal."""
    if jacobian.shape[1] <= _DENSE:
        full = jacobian.toarray()
        normal = full.T @ full
        diagonal = np.einsum("ii->i", normal)
        added = regular * max(float(diagonal.max(initial=0.0)), 1.0)
        diagonal += added
        factor = scipy.linalg.cho_factor(normal, lower=True, overwrite_a=True, check_finite=False)
        return lambda right_side: np.asarray(scipy.linalg.cho_solve(factor, right_side, check_finite=False)), added
    sparse = (transposed @ jacobian).tocsc()
    diagonal = sparse.diagonal()
    added = regular * max(float(diagonal.max(initial=0.0)), 1.0)
    sparse.setdiag(diagonal + added)
    factors = splu(sparse, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    return lambda right_side: np.asarray(factors.solve(right_side)), added


@dataclass(frozen=True)
class Corrected:
    """The result of Newton's method: angles in radians, the loop-closure residual, and the derivatives there."""

    angles: Floats
    error: float
    steps: int
    jacobian: scipy.sparse.csr_matrix

    @property
    def closed(self) -> bool:
        """Whether all loops close."""
        return self.error <= DOUBLE.closed

    @cached_property
    def space(self) -> TangentSpace:
        """Rates there. A little beside a closed pose overconstrained linkages have none."""
        return TangentSpace(self.jacobian)


def corrected(closure: ClosureEquations, angles: Floats, held: Sequence[int] = ()) -> Corrected:
    """Return joint angles near some at which all loops close, radians; held joints stay if others can follow.

    Matrices are factorised anew only where a step with the last one left too much. It ends when loops are closed
    and a further step would not make them better, or steps do not make the error less.
    """
    residual, jacobian = closure.at(angles)
    best, off = Corrected(angles, _largest(residual), 0, jacobian), residual
    space, fresh = None, True
    for steps in range(1, _STEPS + 1):
        if best.error <= DOUBLE.closed / 100:
            break
        space = space or best.space
        moved = best.angles + space.step(off, held)
        residual, jacobian = closure.at(moved)
        tried = Corrected(moved, _largest(residual), steps, jacobian)
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


def exactly_held(closure: ClosureEquations, pose: Corrected, held: Sequence[int], values: Floats) -> Corrected:
    """Return a pose found with joints held, with these at `values`, radians, to the last digit.

    Newton's method keeps held joints to some digits only, and what it left in them is error of the loops.
    """
    places = list(held)
    for _ in range(_HOLDS):
        angles = pose.angles.copy()
        angles[places] = values
        if np.array_equal(angles, pose.angles):
            return pose
        pose = corrected(closure, angles, held)
    angles = pose.angles.copy()
    angles[places] = values
    residual, jacobian = closure.at(angles)
    return Corrected(angles, _largest(residual), pose.steps, jacobian)


def _largest(residual: Floats) -> float:
    return float(np.abs(residual).max(initial=0.0))
