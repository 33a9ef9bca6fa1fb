"""Numerical rank with its evidence: which singular values are zero, which only nearly, and what cannot be decided.

A singular value is changed by errors of the coordinates by no more than a few times its *floor*, the length of
(error of column j) v_j, v its right vector. Values up to six floors are noise; values a little above may be
either, and then the rank is indeterminate; a value that an error of a thousandth of the size would explain is
counted, and reported as nearly zero. For matrices known to a relative zero, that part of the largest value is the
bound. Bases are canonical (`graphs.tolerances.canonical_basis`). Theory: docs/theory/pose.md.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from graphs.tolerances import DOUBLE, MARGIN, canonical_basis
from graphs.types import Floats, Ints

NEARLY = 2e-3
"""The error of coordinates that would make a nearly mobile mechanism mobile: a thousandth of the size, in units of
the extent, which is half of it."""

NOISE = 6.0
"""Noise stays below this many floors: at most 4.5 in thousands of disturbed crease patterns."""
_CLEAR = 20.0
"""From this many floors on a singular value is certainly none: four times the most that was met as noise. What
lies between is undecided, and said to be."""
_LARGE = 1e-3
"""What is larger than this part of the largest singular value is never called noise, however rough the coordinates are:
coordinates of two digits would make all equations redundant."""

Certainty = Literal["numerical", "nearly mobile", "indeterminate"]


@dataclass(frozen=True, slots=True)
class NoiseVerdict:
    """Which singular values of one matrix or many are zero but for noise, undecided, nearly zero: bool[..., k]."""

    noise: npt.NDArray[np.bool_]
    undecided: npt.NDArray[np.bool_]
    nearly: npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Spectrum:
    """The rank of a matrix of real numbers.

    Attributes
    ----------
    rank : int or None
        None where a singular value may be noise and may be not: indeterminate.
    gap : float
        Smallest singular value counted over the bound of those that are noise; infinite where none is. The bound
        is the same on all processors, the noise itself is not.
    smallest, largest_zero : float
        The two, as parts of the largest singular value.
    nearly : int
        Singular values counted that an error of a thousandth would explain.
    noise : float
        What noise may come to, as part of the largest singular value.
    undecided : tuple of float
        The singular values that are near the noise, as parts of the largest.
    """

    rank: int | None
    gap: float
    smallest: float
    largest_zero: float
    nearly: int
    noise: float
    undecided: tuple[float, ...] = ()

    @property
    def certainty(self) -> Certainty:
        """The certainty of the rank: numerical, true but for small strains, or indeterminate."""
        if self.rank is None:
            return "indeterminate"
        return "nearly mobile" if self.nearly else "numerical"


ZERO_SPECTRUM = Spectrum(0, float("inf"), 0.0, 0.0, 0, 0.0)
"""The spectrum of a matrix without entries, or of zeros only."""


def verdict(values: Floats, floors: Floats, nearly: Floats | float = 0.0) -> NoiseVerdict:
    """Judge singular values, as parts of the largest, by the effect of errors.

    Floors say what errors of the size of the data's precision do to each, in the mean; nearly likewise for an
    error of a thousandth of the size.
    """
    noise = values <= np.minimum(NOISE * floors, _LARGE)
    undecided = ~noise & (values <= _CLEAR * floors)
    return NoiseVerdict(noise, undecided, ~noise & ~undecided & (values <= NOISE * nearly))


def spectrum(matrix: Floats, error: float | Floats = 0.0, nearly: float | Floats = 0.0) -> Spectrum:
    """Return the numerical rank of a matrix, float[m, n].

    The error, float or float[n], is that of the entries of each column, to which rounding errors of double
    precision are added; ``nearly`` likewise the errors that count as nearly mobile.
    """
    if not matrix.size or not matrix.any():
        return ZERO_SPECTRUM
    _, values, right = np.linalg.svd(matrix, full_matrices=False)
    effects = [np.linalg.norm(right * of, axis=1) / values[0] for of in (error, nearly)]
    return judged(values / values[0], rounding(matrix.shape) + effects[0], effects[1])


@dataclass(frozen=True, slots=True)
class Spectra:
    """The singular values of many matrices of one shape, descending, judged.

    Rows, float[..., n, n], are the right singular vectors, not canonical; floors say what errors do to each value,
    as parts of the largest.
    """

    values: Floats
    rows: Floats
    floors: Floats
    verdict: NoiseVerdict

    @property
    def parts(self) -> Floats:
        """The values as parts of the largest: float[..., k]."""
        return self.values / self.values[..., :1]


def spectra(matrices: Floats, error: float, nearly: float) -> Spectra:
    """Return singular values of many matrices, each judged as `spectrum` judges those of one.

    No matrix, float[..., m, n], is zero; error and nearly are the length of the errors of the entries of a column.
    """
    _, values, rows = np.linalg.svd(matrices, full_matrices=True)
    largest = values[..., :1]
    floors = np.broadcast_to(rounding(matrices.shape[-2:]) + error / largest, values.shape)
    return Spectra(values, rows, floors, verdict(values / largest, floors, nearly / largest))


def rounding(shape: tuple[int, int]) -> float:
    """Return the floor that rounding in double precision makes, as part of the largest singular value."""
    return float(np.finfo(float).eps * max(shape) / NOISE)


def judged_at(values: Floats, zero: float) -> Spectrum:
    """Return the rank of descending singular values in any unit; those up to `zero` times the largest are zero."""
    if not values.max(initial=0.0) > 0.0:
        return ZERO_SPECTRUM
    return judged(values / values[0], np.full(len(values), zero / NOISE), np.zeros(len(values)))


def judged(values: Floats, floors: Floats, nearly: Floats, larger: int = 0) -> Spectrum:
    """Return the rank of singular values, and of `larger` more, known to be large without their figures.

    Values, floors and nearly are as for :func:`verdict`.
    """
    found = verdict(values, floors, nearly)
    counted = values[~found.noise & ~found.undecided]
    zeros = values[found.noise]
    rank = None if found.undecided.any() else larger + len(counted)
    smallest = float(counted.min(initial=1.0)) if larger or len(counted) else 0.0
    most = min(NOISE * float(floors[found.noise].max(initial=0.0)), _LARGE)
    return Spectrum(
        rank,
        smallest / max(float(zeros.max()), most) if len(zeros) else float("inf"),
        smallest,
        float(zeros.max(initial=0.0)),
        int(found.nearly.sum()),
        NOISE * float(floors.max(initial=0.0)),
        tuple(values[found.undecided].tolist()),
    )


@dataclass(frozen=True, slots=True)
class Split:
    """A matrix taken apart: A = left[:, :k] @ diag(values) @ right[:k], k the lesser of m and n.

    Left singular vectors, float[m, m], are columns, right ones, float[n, n], rows; neither are canonical. Values
    are descending; ``rank`` of them are counted, those up to the part ``zero`` of the largest are zero.
    """

    rank: int
    left: Floats
    values: Floats
    right: Floats
    zero: float

    @property
    def kernel(self) -> Floats:
        """The canonical basis of the kernel: orthonormal columns, float[n, n - rank]."""
        return canonical_basis(self.right[self.rank :].T)

    @property
    def cokernel(self) -> Floats:
        """The canonical basis of the complement of the column space: orthonormal columns, float[m, m - rank]."""
        return canonical_basis(self.left[:, self.rank :])

    @property
    def evidence(self) -> Spectrum:
        """The rank with its gap; the rank is None where a value cannot be told from zero."""
        return judged_at(self.values, self.zero)


def split(matrix: Floats, zero: float = DOUBLE.zero) -> Split:
    """Return the rank of a matrix, float[m, n], with its kernel and cokernel.

    Singular values up to the part ``zero`` of the largest are zero (`graphs.tolerances.Tolerances.zero`).
    """
    left, values, right = np.linalg.svd(matrix)
    return Split(_counted(values, zero), left, values, right, zero)


def null_space(matrix: Floats, zero: float = DOUBLE.zero, scale: float | None = None) -> Floats:
    """Return the canonical basis of the kernel of a matrix, float[m, n]: orthonormal columns, float[n, n - rank].

    Values up to ``zero`` times the scale are zero; by default the scale is the largest value, which does not do
    where the matrix may be zero but for rounding.
    """
    _, values, right = np.linalg.svd(matrix, full_matrices=matrix.shape[0] < matrix.shape[1])
    return canonical_basis(right[_counted(values, zero, scale) :].T)


def null_vectors(matrices: Floats, zero: float = DOUBLE.zero) -> tuple[Ints, Floats]:
    """Return the ranks of matrices, float[n, m, k], m at least k: int[n], and a vector of each: float[n, k].

    It is that of the least singular value, the canonical basis of a kernel of one dimension.
    """
    _, values, right = np.linalg.svd(matrices, full_matrices=False)
    vectors = right[:, -1]
    sizes = vectors**2
    place = (sizes >= (1.0 - MARGIN) * sizes.max(axis=1, keepdims=True)).argmax(axis=1)
    ranks = (values > zero * values.max(axis=1, keepdims=True)).sum(axis=1)
    return ranks, vectors * np.sign(np.take_along_axis(vectors, place[:, None], axis=1))


def row_space(matrix: Floats, zero: float = DOUBLE.zero, scale: float | None = None) -> Floats:
    """Return the canonical basis of the rows of a matrix, float[m, n]: orthonormal columns, float[n, rank]."""
    _, values, right = np.linalg.svd(matrix, full_matrices=False)
    return canonical_basis(right[: _counted(values, zero, scale)].T)


def rank_of(matrix: Floats, zero: float = DOUBLE.zero, scale: float | None = None) -> int:
    """Return the rank of a matrix, float[m, n]; what is zero is as for `null_space`."""
    return _counted(singular_values(matrix), zero, scale)


def singular_values(matrices: Floats) -> Floats:
    """Return the singular values of matrices, descending: float[..., k]."""
    return np.asarray(np.linalg.svd(matrices, compute_uv=False))


def right_vectors(matrices: Floats) -> tuple[Floats, Floats]:
    """Return singular values of matrices float[..., m, n], the largest first, and right vectors float[..., n, n]."""
    _, values, right = np.linalg.svd(matrices)
    return values, right


def _counted(values: Floats, zero: float, scale: float | None = None) -> int:
    """Return how many singular values are none; all that are greater than the floor, where some are undecided."""
    return int((values > zero * (values.max(initial=0.0) if scale is None else scale)).sum())


@dataclass(frozen=True, slots=True)
class Inertia:
    """Symmetric matrices by their eigenvalues, float[..., s], ascending.

    Vectors are columns, not canonical. The signs, int[..., s], are 0 for values that are zero.
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
    """Return the eigenvalues of symmetric matrices, float[..., s, s], and which are positive, zero and negative.

    Eigenvalues up to the part ``zero`` of the largest of each matrix are zero; a scale replaces the largest where
    a matrix may consist of rounding errors only.
    """
    values, vectors = np.linalg.eigh(forms)
    sizes = np.abs(values)
    largest = sizes.max(axis=-1, keepdims=True, initial=0.0) if scale is None else scale
    signs = np.where(sizes > zero * largest, np.sign(values), 0.0)
    return Inertia(values, vectors, signs.astype(np.int64))
