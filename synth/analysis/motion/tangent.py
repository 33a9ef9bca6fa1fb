"""Rates at a configuration: least-squares solutions with the derivatives of closure equations.

Equations may depend on each other and leave freedoms. So normal equations are regularised, and of a solution only
the sum of rows of the derivatives is kept that it stands for: that has no part along the freedoms. Theory:
docs/theory/folding.md.
"""

from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np
import scipy

from graphs.errors import NumericalError
from graphs.tolerances import DOUBLE
from graphs.types import Floats

REGULAR = 1e-9
"""Part of the largest diagonal entry that is added to all: what is less than its root is no equation. Rounding
along freedoms is multiplied by its inverse."""
_DENSE = 40
"""Matrices of up to this many joints are full; larger full ones would wait for threads of BLAS."""
_MANY = 30_000
"""Linkages of more joints have singular values near the root of what is added: rates are freed of these vectors too."""
_LEFT, _ROUNDS = 1e-11, 60
"""By so much of the largest rate loops may part at rates that are free of them, found in at most so many rounds."""
FREE = 0.5
"""Part of a vector across the freedoms that is left, at most, where it has become one of them after a step."""
_SWEEPS = 24
_SETTLED, _UNSETTLED = 1e-14, 1e-9
"""Refinement ends where a sweep changes less than the first; where the last one changed more than the second, a
singular value is too small to count and too large to be none."""


class Factor(Protocol):
    """Factorised normal equations J' J + added of some derivatives J, float[shape]: of rows, and of joints."""

    shape: tuple[int, int]

    def image(self, rates: Floats) -> Floats:
        """Return by what loops part at rates float[J]: float[rows]."""

    def sum_of_rows(self, forces: Floats) -> Floats:
        """Return the sum of rows, each as often as forces float[rows] say: float[J]."""

    def solved(self, right_side: Floats) -> Floats:
        """Return the solution of the normal equations: float[J]."""

    def least(self, off: Floats) -> Floats:
        """Return the least rates at which loops part by float[rows], as a sum of rows: float[J]."""

    def least_exactly(self, off: Floats) -> Floats:
        """Return the same with all digits: float[J]."""

    def projected(self, rates: Floats) -> Floats:
        """Return the rates nearest to float[J] at which all loops stay closed to first order: float[J]."""


class SparseFactor:
    """Normal equations of any sparse matrix float[rows, J], by scipy; `regular` is the part that is added."""

    def __init__(self, jacobian: scipy.sparse.csr_matrix, regular: float = REGULAR) -> None:
        self._jacobian, self.shape = jacobian, jacobian.shape
        self._transposed = jacobian.T.tocsr()
        self.solved, self._added = _solver(jacobian, self._transposed, regular)

    def image(self, rates: Floats) -> Floats:
        """Return by what loops part."""
        return np.asarray(self._jacobian @ rates)

    def sum_of_rows(self, forces: Floats) -> Floats:
        """Return a sum of rows."""
        return np.asarray(self._transposed @ forces)

    def least(self, off: Floats) -> Floats:
        """Return the least rates: none of them along freedoms.

        The solution x of (J' J + e) x = J' b is J' (b - J x) / e too. Solved for, it has rounding along freedoms
        that was divided by e, and paths with several freedoms would go where that leads; a sum of rows of J has
        no part along freedoms. Across them half the digits are lost.
        """
        return self._as_sum(off, self.solved(self.sum_of_rows(off)))

    def least_exactly(self, off: Floats) -> Floats:
        """Return the same with all digits: what two solutions differ by has the lost ones across freedoms."""
        rates = self.solved(self.sum_of_rows(off))
        least = self._as_sum(off, rates)
        return least + self.least(self.image(rates - least))

    def projected(self, rates: Floats) -> Floats:
        """Return the nearest rates at which loops stay closed."""
        kept = rates
        for _ in range(2):  # the second takes off what regularisation left
            kept = kept - self.least(self.image(kept))
        return kept

    def _as_sum(self, off: Floats, rates: Floats) -> Floats:
        return self.sum_of_rows((off - self.image(rates)) / self._added)


class TangentSpace:
    """Least-squares solutions with the derivatives of closure equations at one place: a factor, or a sparse matrix."""

    def __init__(self, derivatives: scipy.sparse.csr_matrix | Factor, regular: float = REGULAR) -> None:
        sparse = scipy.sparse.issparse(derivatives)
        self._factor: Factor = SparseFactor(derivatives, regular) if sparse else derivatives
        self._moves: dict[int, Floats] = {}
        self.image = self._factor.image

    def step(self, residual: Floats, held: Sequence[int] = ()) -> Floats:
        """Return the least change of angles that takes a residual away; held joints stay if they can."""
        change = self._factor.least_exactly(-residual)
        if not held:
            return change
        if len(held) == 1:
            move = self.move(held[0])
            return change - change[held[0]] / move[held[0]] * move if move[held[0]] else change
        moves = np.stack([self.move(joint) for joint in held])
        places = list(held)
        shares = np.linalg.lstsq(moves[:, places], change[places], rcond=DOUBLE.zero)[0]
        return np.asarray(change - shares @ moves)

    def projected(self, rates: Floats) -> Floats:
        """Return the rates nearest to some at which loops stay closed to first order: float[J]."""
        nearest = self._factor.projected(rates)
        return nearest if self._factor.shape[1] <= _MANY else closed_rates(self._factor, nearest)

    def sharpened(self, across: Floats) -> Floats:
        """Return a unit vector nearer to the least singular vector across the freedoms: inverse iteration.

        Of a vector that has become a freedom, its part along the freedoms.
        """
        free = self.projected(across)
        kept = across - free
        size = float(np.linalg.norm(kept))
        if size <= FREE * float(np.linalg.norm(across)):
            return np.asarray(free / np.linalg.norm(free))
        sharper = self._factor.solved(kept / size)
        sharper = sharper - self.projected(sharper)
        return np.asarray(sharper / np.linalg.norm(sharper))

    def solution(self, off: Floats) -> tuple[Floats, Floats]:
        """Return the least rates that part loops nearly by `off`, and what is left of that, to all digits."""
        left = self.beyond(off)
        within, none = off - left, np.zeros(self._factor.shape[1])
        return _refined(lambda rates: self._factor.least(within - self.image(rates)), none, off), left

    def beyond(self, off: Floats) -> Floats:
        """Return the part of float[rows] that no rates make: what redundant equations say of it, to all digits."""
        factor, none = self._factor, np.zeros_like(off)
        return off - _refined(lambda part: self.image(factor.solved(factor.sum_of_rows(off - part))), none, off)

    def free(self, rates: Floats) -> Floats:
        """Return the rates nearest to some that keep loops closed: `projected` to all digits, float[J]."""
        none = np.zeros_like(rates)
        return rates - _refined(lambda across: self._factor.least(self.image(rates - across)), none, rates)

    def forces(self, rates: Floats) -> Floats:
        """Return the least forces float[rows] whose sum of rows is the part of float[J] across the freedoms."""
        factor, across, none = self._factor, rates - self.free(rates), np.zeros(self._factor.shape[0])
        return _refined(lambda forces: self.image(factor.solved(across - factor.sum_of_rows(forces))), none, rates)

    def move(self, joint: int) -> Floats:
        """Return the rates nearest to those of one joint alone at which loops stay closed: float[J]."""
        if joint not in self._moves:
            alone = np.zeros(self._factor.shape[1])
            alone[joint] = 1.0
            self._moves[joint] = self.projected(alone)
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
    last, size = np.inf, largest_of(residual)
    for _ in range(_SWEEPS):
        change = correction(total)
        total = total + change
        largest, whole = largest_of(change), max(largest_of(total), size)
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
        import scipy.linalg  # slow to load, and not needed where the library is

        full = jacobian.toarray()
        normal = full.T @ full
        diagonal = np.einsum("ii->i", normal)
        added = regular * max(float(diagonal.max(initial=0.0)), 1.0)
        diagonal += added
        factor = scipy.linalg.cho_factor(normal, lower=True, overwrite_a=True, check_finite=False)
        return lambda right_side: np.asarray(scipy.linalg.cho_solve(factor, right_side, check_finite=False)), added
    from scipy.sparse.linalg import splu  # slow to load too

    sparse = (transposed @ jacobian).tocsc()
    diagonal = sparse.diagonal()
    added = regular * max(float(diagonal.max(initial=0.0)), 1.0)
    sparse.setdiag(diagonal + added)
    factors = splu(sparse, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    return lambda right_side: np.asarray(factors.solve(right_side)), added


def closed_rates(factor: Factor, rates: Floats) -> Floats:
    """Return the rates nearest to some at which loops stay closed, however small a singular value is: float[J].

    With a factor one round takes off a part s^2 / (s^2 + m) of singular vectors, s being their values and m what was
    added. Conjugate gradients, with the factor as preconditioner, leave only the few to be found for which that is
    little, one in each round (A. Bjorck, Numerical Methods for Least Squares Problems, 1996, chapter 7).
    """
    nearest, parted = rates, factor.image(rates)
    most, step, last = _LEFT * largest_of(rates), np.zeros_like(rates), 1.0
    for _ in range(_ROUNDS):
        if largest_of(parted) <= most:
            break
        least = factor.least(parted)
        size = inner(factor.sum_of_rows(parted), least)
        step = least + size / last * step
        moved = factor.image(step)
        share = size / inner(moved, moved)
        nearest, parted, last = nearest - share * step, parted - share * moved, size
    return nearest


def inner(one: Floats, other: Floats) -> float:
    """Return the inner product of two vectors, not by BLAS: its threads take longer to start than the sum."""
    return float(np.einsum("i,i->", one, other))


def largest_of(residual: Floats) -> float:
    """Return the largest absolute value, 0.0 of none."""
    return float(np.abs(residual).max(initial=0.0))
