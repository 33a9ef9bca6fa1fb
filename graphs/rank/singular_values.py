"""Numerical rank with its evidence: singular values, the gap between the large and the small ones, a verdict.

Theory: docs/theory/pose.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

__all__ = ["Spectrum", "spectrum"]

_SMALL = 1e-5
"""A singular value below this part of the largest may be a rounded zero."""
_GAP = 1e3
"""What parts zeros from the rest must be at least this ratio."""
_NEARLY = 1e-3
"""Nonzero singular values below this part of the largest are nearly zero."""


@dataclass(frozen=True, slots=True)
class Spectrum:
    """The rank of a matrix of real numbers.

    Attributes
    ----------
    rank : int or None
        None where no gap tells the zeros: indeterminate.
    gap : float
        Smallest nonzero singular value over the largest zero one, which is at least the rounding error.
    smallest, largest_zero : float
        The two, as parts of the largest singular value.
    nearly : int
        Nonzero singular values below a thousandth of the largest.
    """

    rank: int | None
    gap: float
    smallest: float
    largest_zero: float
    nearly: int


def spectrum(matrix: npt.NDArray[np.float64]) -> Spectrum:
    """Return the numerical rank of a matrix.

    Rows are scaled to unit length first: an equation says the same at any scale.

    Parameters
    ----------
    matrix : float[m, n]

    Examples
    --------
    >>> found = spectrum(np.array([[1.0, 0.0], [1.0, 1e-14]]))
    >>> found.rank, found.gap > 1e6
    (1, True)
    >>> hilbert = 1 / (1.0 + np.add.outer(np.arange(12), np.arange(12)))
    >>> spectrum(hilbert).rank is None
    True
    """
    lengths = np.linalg.norm(matrix, axis=1) if matrix.size else np.zeros(0)
    scaled = matrix[lengths > 0] / lengths[lengths > 0, None]
    values = np.linalg.svd(scaled, compute_uv=False) if scaled.size else np.zeros(0)
    if not len(values):
        return Spectrum(0, float("inf"), 0.0, 0.0, 0)
    values = values / values[0]
    floor = np.finfo(float).eps * max(matrix.shape)
    padded = np.maximum(np.append(values, 0.0), floor)
    ratios = padded[:-1] / padded[1:]
    rank = _rank(padded, ratios)
    where = len(values) if rank is None else rank
    return Spectrum(
        rank,
        float(ratios[where - 1] if rank is not None else ratios.max()),
        float(padded[where - 1]),
        float(padded[where]),
        int((values[:where] < _NEARLY).sum()),
    )


def _rank(padded: npt.NDArray[np.float64], ratios: npt.NDArray[np.float64]) -> int | None:
    """Return after how many values the widest gap lies, of the gaps that end below what may be zero."""
    candidates = np.flatnonzero(padded[1:] < _SMALL)
    best = int(candidates[np.argmax(ratios[candidates])])
    return best + 1 if ratios[best] >= _GAP else None
