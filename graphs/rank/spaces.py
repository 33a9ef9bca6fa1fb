"""Rank, kernel and cokernel of a matrix of real numbers that are known to a relative zero: one decision for all.

A singular value up to ``zero`` times the largest is zero, as a floor of noise of that size says
(`graphs.rank.singular_values`). Where one lies a little above, so that the rank is indeterminate, the evidence
says so and the value is counted. Bases are canonical (`graphs.canonical`). Theory: docs/theory/pose.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphs.arrays import Floats, Ints
from graphs.canonical import canonical_basis
from graphs.rank.singular_values import Spectrum, judged_at
from graphs.tolerances import DOUBLE

__all__ = ["Inertia", "Split", "inertia", "null_space", "rank_of", "row_space", "singular_values", "split"]


@dataclass(frozen=True, slots=True)
class Split:
    """A matrix taken apart: A = left[:, :k] @ diag(values) @ right[:k].

    Attributes
    ----------
    rank : int
        How many singular values are counted.
    left : float[m, m]
        Left singular vectors, as columns; not canonical.
    values : float[k]
        Singular values, descending; k is the lesser of m and n.
    right : float[n, n]
        Right singular vectors, as rows; not canonical.
    zero : float
        What the values were judged by: the part of the largest up to which they are zero.

    Examples
    --------
    >>> parts = split(np.diag([1.0, 2e-9]))
    >>> parts.rank, parts.evidence.rank
    (2, None)
    """

    rank: int
    left: Floats
    values: Floats
    right: Floats
    zero: float

    @property
    def kernel(self) -> Floats:
        """The canonical basis of what the matrix takes to zero: orthonormal columns, float[n, n - rank]."""
        return canonical_basis(self.right[self.rank :].T)

    @property
    def cokernel(self) -> Floats:
        """The canonical basis of what is across all columns: orthonormal columns, float[m, m - rank]."""
        return canonical_basis(self.left[:, self.rank :])

    @property
    def evidence(self) -> Spectrum:
        """The rank with its gap; None for the rank where a value is not told from zero."""
        return judged_at(self.values, self.zero)


def split(matrix: Floats, zero: float = DOUBLE.zero) -> Split:
    """Return the rank of a matrix with its kernel and cokernel.

    Parameters
    ----------
    matrix : float[m, n]
    zero : float, optional
        Singular values up to this part of the largest are zero (`graphs.tolerances.Tolerances.zero`).

    Examples
    --------
    >>> parts = split(np.array([[1.0, 1.0, 0.0], [2.0, 2.0, 0.0]]))
    >>> parts.rank, parts.kernel.shape, parts.cokernel.shape, parts.evidence.certainty
    (1, (3, 2), (2, 1), 'numerical')
    """
    left, values, right = np.linalg.svd(matrix)
    return Split(_counted(values, zero), left, values, right, zero)


def null_space(matrix: Floats, zero: float = DOUBLE.zero, scale: float | None = None) -> Floats:
    """Return the canonical basis of the kernel of a matrix: orthonormal columns, float[n, n - rank].

    Parameters
    ----------
    matrix : float[m, n]
    zero : float, optional
        As for `split`.
    scale : float, optional
        What `zero` is a part of, where the matrix may be zero but for rounding; by default the largest value.

    Examples
    --------
    >>> null_space(np.array([[1.0, 1.0, 0.0]])).round(3).tolist()
    [[0.0, 0.707], [0.0, -0.707], [1.0, 0.0]]
    """
    _, values, right = np.linalg.svd(matrix, full_matrices=matrix.shape[0] < matrix.shape[1])
    return canonical_basis(right[_counted(values, zero, scale) :].T)


def row_space(matrix: Floats, zero: float = DOUBLE.zero, scale: float | None = None) -> Floats:
    """Return the canonical basis of the rows of a matrix: orthonormal columns, float[n, rank].

    Parameters
    ----------
    matrix : float[m, n]
    zero, scale : float, optional
        As for `null_space`.

    Examples
    --------
    >>> row_space(np.array([[1.0, 0.0, 1.0], [2.0, 0.0, 2.0]])).round(3).tolist()
    [[0.707], [0.0], [0.707]]
    """
    _, values, right = np.linalg.svd(matrix, full_matrices=False)
    return canonical_basis(right[: _counted(values, zero, scale)].T)


def rank_of(matrix: Floats, zero: float = DOUBLE.zero, scale: float | None = None) -> int:
    """Return the rank of a matrix.

    Parameters
    ----------
    matrix : float[m, n]
    zero, scale : float, optional
        As for `split`.

    Examples
    --------
    >>> rank_of(np.array([[1.0, 2.0], [2.0, 4.0 + 1e-12]]))
    1
    """
    return _counted(singular_values(matrix), zero, scale)


def singular_values(matrices: Floats) -> Floats:
    """Return the singular values of matrices, descending: float[..., k].

    >>> singular_values(np.diag([1.0, 3.0])).tolist()
    [3.0, 1.0]
    """
    return np.asarray(np.linalg.svd(matrices, compute_uv=False))


def _counted(values: Floats, zero: float, scale: float | None = None) -> int:
    """Return how many singular values are none; all that are greater than the floor, where some are undecided."""
    return int((values > zero * (values.max(initial=0.0) if scale is None else scale)).sum())


@dataclass(frozen=True, slots=True)
class Inertia:
    """Symmetric matrices by their eigenvalues.

    Attributes
    ----------
    values : float[..., s]
        Ascending.
    vectors : float[..., s, s]
        Columns; not canonical.
    signs : int[..., s]
        Of the values; 0 for those that are zero.

    Examples
    --------
    >>> saddle = inertia(np.diag([1.0, -1.0]))
    >>> saddle.signs.tolist(), int(saddle.positive)
    ([-1, 1], 1)
    """

    values: Floats
    vectors: Floats
    signs: Ints

    @property
    def positive(self) -> Ints:
        """How many eigenvalues are positive: int[...]."""
        return np.asarray((self.signs > 0).sum(axis=-1))

    @property
    def negative(self) -> Ints:
        """How many eigenvalues are negative: int[...]."""
        return np.asarray((self.signs < 0).sum(axis=-1))


def inertia(forms: Floats, zero: float = DOUBLE.zero, scale: float | None = None) -> Inertia:
    """Return the eigenvalues of symmetric matrices, and which are positive, zero and negative.

    Parameters
    ----------
    forms : float[..., s, s]
    zero : float, optional
        Eigenvalues up to this part of the largest, of each matrix, are zero.
    scale : float, optional
        What takes the place of the largest, where a matrix may be nothing but rounding.

    Examples
    --------
    >>> found = inertia(np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1e-14]]))
    >>> found.signs.tolist(), int(found.positive), int(found.negative)
    ([-1, 0, 1], 1, 1)
    """
    values, vectors = np.linalg.eigh(forms)
    sizes = np.abs(values)
    largest = sizes.max(axis=-1, keepdims=True, initial=0.0) if scale is None else scale
    signs = np.where(sizes > zero * largest, np.sign(values), 0.0)
    return Inertia(values, vectors, signs.astype(np.int64))
