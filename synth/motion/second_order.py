"""Which rates at a singular pose can be the beginning of a motion: what second order says.

Rates at which loops close to first order form a space. To second order each self-stress of the closure equations
adds one quadratic equation on it (`synth.motion.singular.quadrics`). Where an equation is a product of two linear
ones the rates fall into two subspaces: the two modes of a vertex of four creases. The solutions are found by
taking one mode or the other, as long as anything is left. If nothing is left, nothing moves.
Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from math import inf

import numpy as np
import scipy.linalg
import scipy.sparse

from graphs.rank.singular_values import inertia, null_space, split
from graphs.tolerances import DOUBLE, canonical_basis, canonical_order, signed
from graphs.types import Floats, Ints
from synth.motion.closure import ClosureEquations
from synth.motion.newton import TangentSpace
from synth.motion.singular.definite import definite_weights
from synth.motion.singular.quadrics import Quadric, local_forms
from synth.motion.walk.allowance import Allowance

__all__ = ["RateSpace", "largest_only", "rate_spaces", "rates_at", "rates_near", "spaces_within"]

_STEPS = 40
_MANY = 600
_CASE = 3e4
"""Work on a case besides that on its matrices, in products of numbers."""
_LOST = 10.0
"""Spaces that are this many times closer than what counts as zero are one."""


@dataclass(frozen=True, slots=True)
class RateSpace:
    """Rates that agree to second order: a linear space, on which a few equations may be left.

    The basis, float[J, s], is orthonormal; the equations are no products of linear ones on this space.
    """

    basis: Floats
    left: tuple[Quadric, ...]

    def in_order(self, order: Ints) -> RateSpace:
        """Return the same space with joints in another order, int[J]: their places in the present one."""
        place = np.argsort(order)
        left = (replace(one, joints=tuple(place[list(one.joints)].tolist())) for one in self.left)
        return RateSpace(self.basis[order], tuple(left))


def rate_spaces(
    closure: ClosureEquations,
    angles: Floats,
    quadrics: Sequence[Quadric],
    most: int = 4096,
    zero: float = DOUBLE.zero,
) -> tuple[list[RateSpace], bool]:
    """Return the spaces of rates that agree to second order, none part of another, and whether these are all.

    The pose is given by angles in radians; the search ends after `most` spaces. Singular values and eigenvalues
    below `zero` times the largest are zero: what coordinates can tell apart.
    """
    found = list(islice(spaces_within(rates_at(closure, angles, zero), quadrics, zero), most + 1))
    return largest_only(found[:most], zero), len(found) <= most


def spaces_within(
    tangent: Floats, quadrics: Sequence[Quadric], zero: float = DOUBLE.zero, allowance: Allowance | None = None
) -> Iterator[RateSpace]:
    """Yield spaces that hold all rates which agree to second order, depth first; some may be part of others.

    The tangent, float[J, s], holds the rates that agree to first order (`rates_at`). Eigenvalues below `zero`
    times the largest are zero. The search ends where the allowance, counted in products of numbers, is used up.
    """
    quadrics = tuple(quadrics)
    case = _Case(tangent, quadrics, local_forms(tangent, quadrics), zero)
    yield from _split(case, allowance or Allowance(inf))


def largest_only(spaces: Sequence[RateSpace], zero: float = DOUBLE.zero) -> list[RateSpace]:
    """Return the spaces that are not part of another, each once, in their order."""
    kept: dict[int, list[int]] = {}
    for size in sorted({space.basis.shape[1] for space in spaces}, reverse=True):
        for number, space in enumerate(spaces):
            if space.basis.shape[1] == size and not _within_one(space, spaces, kept, zero):
                kept.setdefault(size, []).append(number)
    return [spaces[number] for number in sorted(number for numbers in kept.values() for number in numbers)]


def rates_near(
    closure: ClosureEquations,
    angles: Floats,
    quadrics: Sequence[Quadric],
    wanted: Floats,
    zero: float = DOUBLE.closed,
) -> Floats | None:
    """Return rates that agree to second order, near wanted ones, by Newton's method; for linkages of any size.

    Angles, radians, are those of the pose. Wanted are rates or their signs, float[J]; the answer is as long as
    they are, and leaves at most `zero` of the equations; None where none were found near them. Where two solutions
    cross, Newton's method comes near by halves and stays 1e-5 away, which squares of rates hardly show: of exact
    coordinates `zero` is far below other zeros.
    """
    _, jacobian = closure.at(angles)
    size = float(np.linalg.norm(wanted))
    rates = TangentSpace(jacobian).projected(wanted)
    rows = np.repeat(np.arange(len(quadrics)), [len(quadric.joints) for quadric in quadrics])
    columns = np.array([joint for quadric in quadrics for joint in quadric.joints], dtype=np.int64)
    for _ in range(_STEPS):
        if not np.linalg.norm(rates) > DOUBLE.zero_rate * size:
            return None
        rates = rates * (size / np.linalg.norm(rates))
        slopes = [quadric.form @ rates[list(quadric.joints)] for quadric in quadrics]
        values = np.concatenate([np.zeros(0), *slopes])
        quadratic = scipy.sparse.csr_matrix((values, (rows, columns)), shape=(len(quadrics), len(rates)))
        off = np.concatenate([jacobian @ rates, quadratic @ rates])
        if np.abs(off).max(initial=0.0) <= zero:
            return rates
        both = scipy.sparse.vstack([jacobian, 2.0 * quadratic], format="csr")
        rates = rates + TangentSpace(both).step(off)
    return None


def rates_at(closure: ClosureEquations, angles: Floats, zero: float = DOUBLE.zero) -> Floats:
    """Return the rates at which loops stay closed to first order: float[J, s], orthonormal columns.

    By singular values; of many joints by orthogonal columns, the largest of what is left first, which takes a
    third of the time. The columns depend on the space alone (`graphs.tolerances`).
    """
    matrix = closure.at(angles)[1].toarray()
    if closure.joints <= _MANY:
        return null_space(matrix, zero)
    columns, triangle, _ = scipy.linalg.qr(matrix.T, pivoting=True, overwrite_a=True, check_finite=False)
    sizes = np.abs(np.diag(triangle))
    return canonical_basis(columns[:, int((sizes > zero * sizes.max(initial=0.0)).sum()) :])


def _within_one(
    space: RateSpace, spaces: Sequence[RateSpace], kept: Mapping[int, Sequence[int]], zero: float
) -> bool:
    """Tell whether all rates of a space are those of one of the spaces kept, which are listed by their size."""
    same = max(DOUBLE.clear, _LOST * zero)
    one = space.basis.sum(axis=1)  # most spaces differ here already
    for numbers in kept.values():
        bases = np.concatenate([spaces[number].basis for number in numbers], axis=1)
        inside = ((one @ bases).reshape(len(numbers), -1) ** 2).sum(axis=1)
        near = np.flatnonzero(inside > (1.0 - same) * (one @ one))
        if any(_within(space, spaces[numbers[place]], zero) for place in near.tolist()):
            return True
    return False


def _within(space: RateSpace, other: RateSpace, zero: float) -> bool:
    """Tell whether all rates of one space are those of another."""
    outside = space.basis - other.basis @ (other.basis.T @ space.basis)
    if np.abs(outside).max(initial=0.0) > max(DOUBLE.clear, _LOST * zero):
        return False
    theirs = [quadric for quadric in other.left if not any(quadric is mine for mine in space.left)]
    return bool(np.abs(local_forms(space.basis, theirs)).max(initial=0.0) <= zero)


@dataclass(frozen=True, slots=True)
class _Case:
    """A space, and the equations that need not hold on it: what they are as forms on it."""

    basis: Floats
    left: tuple[Quadric, ...]
    forms: Floats
    zero: float

    def only(self, places: Ints) -> _Case:
        """Return the same space with some of the equations."""
        return replace(self, left=tuple(self.left[place] for place in places), forms=self.forms[places])

    def across(self, normals: Floats) -> _Case:
        """Return the part of the space across one normal, float[s], or several, float[s, n]."""
        parts = split(normals.reshape(len(normals), -1).T, self.zero)
        part = parts.right[parts.rank :].T
        return replace(self, basis=self.basis @ part, forms=part.T @ self.forms @ part)


def _split(case: _Case, allowance: Allowance) -> Iterator[RateSpace]:
    """Yield the spaces of solutions within a space, depth first, until an allowance of work is used up."""
    if not allowance.take(_CASE + (len(case.left) + 1) * case.basis.shape[1] ** 3):
        return
    case, factors = _simplified(case)
    if not case.basis.shape[1]:
        return
    if factors is not None:
        by_joints = [signed(case.basis @ normal) for normal in factors]
        for place in canonical_order([one / np.linalg.norm(one) for one in by_joints]):
            yield from _split(case.across(factors[place]), allowance)
    elif len(case.left) < 2 or definite_weights(case.forms, max(case.zero, DOUBLE.clear)) is None:
        yield RateSpace(canonical_basis(case.basis), case.left)


def _simplified(case: _Case) -> tuple[_Case, tuple[Floats, Floats] | None]:
    """Use up the equations that are linear on a space; return what is left, and one that is a product.

    An equation that is a product is among those left too: it vanishes on either part. One whose form has one sign
    holds only where all linear ones do that it is a sum of squares of.
    """
    while case.basis.shape[1]:
        case = case.only(np.flatnonzero(np.abs(case.forms).max(axis=(1, 2), initial=0.0) > case.zero))
        if not case.left:
            return case, None
        found = inertia(case.forms, case.zero)
        definite = np.flatnonzero((found.positive == 0) | (found.negative == 0))
        if not len(definite):
            products = np.flatnonzero((found.positive == 1) & (found.negative == 1))
            return case, _factors(found.values[products[0]], found.vectors[products[0]]) if len(products) else None
        normals = [found.vectors[one][:, found.signs[one] != 0] for one in definite]
        case = case.across(np.concatenate(normals, axis=1))
    return case.only(np.zeros(0, dtype=np.int64)), None


def _factors(values: Floats, vectors: Floats) -> tuple[Floats, Floats]:
    """Return the normals of the two linear equations whose product a form is, by its eigenvectors."""
    plus, minus = np.sqrt(values[-1]) * vectors[:, -1], np.sqrt(-values[0]) * vectors[:, 0]
    return plus + minus, plus - minus
