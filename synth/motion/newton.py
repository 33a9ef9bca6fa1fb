"""Newton's method for closure equations: the nearest joint angles that close.

The equations may depend on each other (most linkages that move are overconstrained) and leave freedoms, so each
step is the least one in the sense of least squares, by normal equations with a trace of regularisation. Rounding
of these does no harm: the residual is always that of the loops themselves. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.linalg
import scipy.sparse
from scipy.sparse.linalg import splu

from graphs.errors import NumericalError
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.motion.closure import ClosureEquations

__all__ = ["Corrected", "TangentSpace", "corrected", "exactly_held"]

_REGULAR = 1e-9
"""Part of the largest diagonal entry that is added to all: what is less than its root is no equation. Rounding
along freedoms is multiplied by its inverse."""
_DENSE = 40
"""Up to this many joints matrices are full; larger full ones would wait for threads of BLAS."""
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
    """Least-squares solutions with the derivatives of closure equations at one place, sparse float[rows, J].

    `regular` times the largest diagonal entry of the normal equations is added to all of them.
    """

    def __init__(self, jacobian: scipy.sparse.csr_matrix, regular: float = _REGULAR) -> None:
        self._jacobian = jacobian
        self._transposed = jacobian.T.tocsr()
        self._solve, self._added = _solver(jacobian, self._transposed, regular)
        self._joints = jacobian.shape[1]
        self._moves: dict[int, Floats] = {}

    def step(self, residual: Floats, held: Sequence[int] = ()) -> Floats:
        """Return the least change of joint angles that takes a residual, float[rows], away to first order.

        Joints at the places `held` do not move, unless they must.
        """
        change = self._least_exactly(-residual)
        if not held:
            return change
        moves = np.stack([self.move(joint) for joint in held])
        places = list(held)
        shares = np.linalg.lstsq(moves[:, places], change[places], rcond=DOUBLE.zero)[0]
        return np.asarray(change - shares @ moves)

    def projected(self, rates: Floats) -> Floats:
        """Return the rates nearest to given ones at which all loops stay closed to first order: float[J]."""
        kept = rates
        for _ in range(2):  # the second takes off what regularisation left
            kept = kept - self._least(self._jacobian @ kept)
        return kept

    def sharpened(self, across: Floats) -> Floats:
        """Return what is nearer to the least singular vector across the freedoms: a unit vector float[J].

        One step of inverse iteration. Of a vector that has become a freedom, its part along the freedoms.
        """
        free = self.projected(across)
        kept = across - free
        size = float(np.linalg.norm(kept))
        if size <= _FREE * float(np.linalg.norm(across)):
            return np.asarray(free / np.linalg.norm(free))
        found = self._solve(kept / size)
        found = found - self.projected(found)
        return np.asarray(found / np.linalg.norm(found))

    def solution(self, off: Floats) -> tuple[Floats, Floats]:
        """Return the least rates that part loops as nearly as they can as given, and what is left of that.

        Both to all digits that the condition of the derivatives leaves. Raises `NumericalError` if their rank is
        not clear.
        """
        left = self.beyond(off)
        within = off - left

        def more(rates: Floats) -> Floats:
            return self._least(within - self._jacobian @ rates)

        return _refined(more, np.zeros(self._joints), off), left

    def beyond(self, off: Floats) -> Floats:
        """Return the part of float[rows] that no rates make: what redundant equations say of it, to all digits."""

        def more(part: Floats) -> Floats:
            return self.image(self._solve(self._transposed @ (off - part)))

        return off - _refined(more, np.zeros_like(off), off)

    def free(self, rates: Floats) -> Floats:
        """Return the rates nearest to given ones that keep loops closed: `projected` to all digits, float[J]."""

        def more(across: Floats) -> Floats:
            return self._least(self._jacobian @ (rates - across))

        return rates - _refined(more, np.zeros_like(rates), rates)

    def forces(self, rates: Floats) -> Floats:
        """Return the least forces float[rows] whose sum of rows is the part of float[J] across the freedoms.

        So `solution` and this are each other's transposed.
        """
        across = rates - self.free(rates)

        def more(forces: Floats) -> Floats:
            return self.image(self._solve(across - self._transposed @ forces))

        return _refined(more, np.zeros(self._jacobian.shape[0]), rates)

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


def _refined(more: Callable[[Floats], Floats], found: Floats, given: Floats) -> Floats:
    """Return what corrections add up to: each leaves a part m / (s^2 + m) of what was to be taken off.

    Here s is a singular value and m what regularises. Corrections are measured by what is found or is given.
    """
    last, size = np.inf, _largest(given)
    for _ in range(_SWEEPS):
        change = more(found)
        found = found + change
        largest, whole = _largest(change), max(_largest(found), size)
        if largest <= _SETTLED * whole or (last / 2 <= largest <= _UNSETTLED * whole):
            return found
        last = largest
    if last > _UNSETTLED * whole:
        raise NumericalError(
            "the configuration is nearly singular: the rank of its closure equations is not clear"
        )
    return found


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
        return lambda given: np.asarray(scipy.linalg.cho_solve(factor, given, check_finite=False)), added
    sparse = (transposed @ jacobian).tocsc()
    diagonal = sparse.diagonal()
    added = regular * max(float(diagonal.max(initial=0.0)), 1.0)
    sparse.setdiag(diagonal + added)
    factors = splu(sparse, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    return lambda given: np.asarray(factors.solve(given)), added


@dataclass(frozen=True)
class Corrected:
    """Where Newton's method came to: angles in radians, the loop-closure residual, and the derivatives there."""

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
    """Return joint angles near given ones at which all loops close, radians.

    Held joints (by their places) stay if the others can follow. Matrices are factorised anew only where a step
    with the last one left too much. It ends when loops are closed and a further step would not make them better,
    or steps do not make the error less.
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
    """Return a pose with held joints at their angles to the last digit; its error is that of the angles it has.

    Newton's method keeps held joints to some digits only, and what it left in them is error of the loops. The pose
    was found with the joints at these places held; values are their angles, radians.
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
