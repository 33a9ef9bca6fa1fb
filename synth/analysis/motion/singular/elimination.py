"""Common points of quadratic forms by elimination: how many there are, with multiplicities, and which.

The products of the forms with all monomials span, in each degree, what vanishes wherever all forms do (Macaulay's
matrix). If finitely many projective points are left, its corank in the degree that is the number of variables is at
least the number of these, multiplicities counted. The null space of the matrix is spanned by the monomials at the
points and their derivatives there: multiplication by the coordinates acts on it, with the points as eigenvalues (H. J.
Stetter, Numerical Polynomial Algebra, SIAM 2004). Ranks are numerical, and so is what follows from them. Theory:
docs/theory/branches.md.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import combinations_with_replacement

import numpy as np

from graphs.rank.singular_values import null_space, rank_of
from graphs.tolerances import DOUBLE, signed
from graphs.types import Floats, Ints

MOST_VARIABLES = 5
"""Of more variables the matrices are too large: 792 monomials of six."""
_NEARLY_REAL = 1e-3
"""A point of multiplicity k is known to the k-th root of rounding: eigenvalues as real as this are tried as real."""
_ROUNDS = 60
_SAME = 1e-4
"""Unit vectors nearer than this are one point: a point of multiplicity is approached by halves."""


def real_points(forms: Floats) -> list[Floats] | None:
    """Return the real points, unit vectors, at which forms float[m, s, s] vanish; None if these are not finitely many.

    None too if the variables are more than `MOST_VARIABLES`. Each point is listed once, whatever its multiplicity.
    """
    size = forms.shape[1]
    if size > MOST_VARIABLES:
        return None
    if size == 1:
        vanish = np.abs(forms).max(initial=0.0) <= DOUBLE.zero
        return [np.ones(1)] if vanish else []
    null = null_space(_macaulay(forms, size), DOUBLE.zero)
    points: list[Floats] = []
    starts = _eigenpoints(null, size)
    if starts is None:
        return None
    for start in starts:
        point = _polished(forms, start)
        if point is not None and not any(np.abs(point - other).max() <= _SAME for other in points):
            points.append(point)
    return points


def _macaulay(forms: Floats, degree: int) -> Floats:
    """Return the products of forms with all monomials of a degree less two, as rows of coefficients."""
    pairs, places, count = _multiples(forms.shape[1], degree)
    twice = np.where(pairs[:, 0] == pairs[:, 1], 1.0, 2.0)
    coefficients = forms[:, pairs[:, 0], pairs[:, 1]] * twice
    matrix = np.zeros((len(forms), len(places), count))
    rows = np.arange(len(places))[:, None]
    for block, own in zip(matrix, coefficients, strict=True):
        block[rows, places] = own / np.linalg.norm(own)
    return matrix.reshape(-1, count)


@lru_cache(maxsize=32)
def _monomials(size: int, degree: int) -> dict[tuple[int, ...], int]:
    """Return the places of the monomials of a degree, each as its variables in order."""
    return {term: place for place, term in enumerate(combinations_with_replacement(range(size), degree))}


@lru_cache(maxsize=32)
def _multiples(size: int, degree: int) -> tuple[Ints, Ints, int]:
    """Return pairs of variables, and where the product of each monomial with each pair is among those of a degree."""
    pairs, terms = _monomials(size, 2), _monomials(size, degree)
    places = [[terms[tuple(sorted(term + pair))] for pair in pairs] for term in _monomials(size, degree - 2)]
    return np.array(list(pairs)), np.array(places), len(terms)


def _eigenpoints(null: Floats, size: int) -> list[Floats] | None:
    """Return nearly real points whose monomials of degree s span a null space; None if there may be infinitely many.

    They are finitely many where a general linear form times the monomials of one degree less determines all: then no
    solution is on the plane where that form vanishes, as part of any curve would be.
    """
    if not null.shape[1]:
        return []
    terms = _monomials(size, size)
    below = list(_monomials(size, size - 1))
    shifted = np.array([null[[terms[tuple(sorted((*term, one)))] for term in below]] for one in range(size)])
    chance = np.random.default_rng(null.shape)
    unit, mixture = chance.normal(size=(2, size))
    whole = np.tensordot(unit, shifted, 1)
    if rank_of(whole, DOUBLE.clear) < null.shape[1]:
        return None
    products = np.linalg.pinv(whole) @ shifted
    vectors = np.linalg.eig(np.tensordot(mixture, products, 1))[1]
    points = []
    for vector in vectors.T:
        values = np.einsum("i,kij,j->k", vector.conj(), products, vector)
        point = values / values[int(np.argmax(np.abs(values)))]
        if np.abs(point.imag).max() <= _NEARLY_REAL:
            points.append(point.real / np.linalg.norm(point.real))
    return points


def _polished(forms: Floats, point: Floats) -> Floats | None:
    """Return the point near another at which forms vanish, by Newton's method in the sense of least squares."""
    for _ in range(_ROUNDS):
        slopes = forms @ point
        values = slopes @ point
        if np.abs(values).max() <= DOUBLE.derivative * DOUBLE.closed**0.25:
            return signed(point)
        point = point - np.linalg.lstsq(2.0 * slopes, values, rcond=DOUBLE.zero)[0]
        point = point / np.linalg.norm(point)
    return None
