"""Choices that do not hang on the last bit: bases of spaces, signs of vectors, the largest of several, an order.

A singular value decomposition returns one of many bases of a null space, and the last bits of a processor decide
which; of several equal numbers they decide which is the largest. What is chosen here depends on the space and on
the numbers alone: two numbers that agree to a millionth are equal, and of equals the first comes first.
Theory: docs/theory/rounding.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cmp_to_key

import numpy as np

from graphs.arrays import Floats

__all__ = ["MARGIN", "canonical_basis", "canonical_order", "leading", "pivots", "signed", "trailing"]

MARGIN = 1e-6
"""Numbers that differ by less than this part of the largest are equal: far above rounding, far below what symmetry
leaves different."""
_DEPENDS = 1e-12
"""Squared length, of rows of orthonormal columns, below which nothing is left of a row."""


def leading(values: Floats) -> int:
    """Return the place of the largest absolute value; of those within a millionth of it, the first.

    Parameters
    ----------
    values : float[n]
        At least one.

    Examples
    --------
    >>> leading(np.array([0.5, -1.0 + 1e-12, 1.0]))
    1
    """
    sizes = np.abs(values)
    return int(np.argmax(sizes >= (1.0 - MARGIN) * sizes.max()))


def trailing(values: Floats, scale: float = 0.0) -> int:
    """Return the place of the least value; of those greater by no more than a millionth, the first.

    Parameters
    ----------
    values : float[n]
        At least one.
    scale : float, optional
        What the millionth is a part of; by default the largest absolute value.

    Examples
    --------
    >>> trailing(np.array([3.0, 1.0 + 1e-12, 1.0]))
    1
    """
    return int(np.argmax(values <= values.min() + MARGIN * (scale or np.abs(values).max())))


def signed(vector: Floats) -> Floats:
    """Return a vector or its negative: the one whose first entry that is not zero is positive.

    Parameters
    ----------
    vector : float[n]
        Entries below a millionth of the largest are zero.

    Examples
    --------
    >>> signed(np.array([1e-17, -0.5, 1.0])).tolist()
    [-1e-17, 0.5, -1.0]
    """
    sizes = np.abs(vector)
    there = sizes > MARGIN * sizes.max(initial=0.0)
    return -vector if there.any() and vector[int(np.argmax(there))] < 0.0 else vector


def canonical_basis(columns: Floats) -> Floats:
    """Return an orthonormal basis of a space that depends on the space alone.

    Its vectors are the projections of some unit vectors onto the space, made orthogonal one after the other: of
    the unit vectors (`pivots`) those are taken of which most lies in the space. The entry of each vector at its
    pivot is positive.

    Parameters
    ----------
    columns : float[n, s]
        Orthonormal columns that span the space.

    Returns
    -------
    float[n, s]

    Examples
    --------
    Any basis of a plane in space leads to the same:

    >>> plane = np.array([[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]])
    >>> turn = np.array([[0.6, -0.8], [0.8, 0.6]])
    >>> (canonical_basis(plane @ turn).round(12) + 0.0).tolist()
    [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]
    """
    return _reduced(columns)[0]


def pivots(columns: Floats) -> list[int]:
    """Return rows of a basis that tell all others, in the order in which `canonical_basis` takes them.

    Parameters
    ----------
    columns : float[n, s]
        Orthonormal columns.

    Examples
    --------
    >>> pivots(np.array([[0.6, 0.0], [0.8, 0.0], [0.0, 1.0]]))
    [2, 1]
    """
    return _reduced(columns)[1]


def _reduced(columns: Floats) -> tuple[Floats, list[int]]:
    """Return the canonical basis and its pivots: a QR decomposition of the rows whose pivots have a margin.

    Each row is made orthogonal to the directions before it a second time, so that the basis is orthonormal to
    rounding.
    """
    left = np.array(columns, dtype=float)
    directions = np.zeros((columns.shape[1], columns.shape[1]))
    rows: list[int] = []
    for number in range(columns.shape[1]):
        sizes = np.einsum("ij,ij->i", left, left)
        if not sizes.max(initial=0.0) > _DEPENDS:
            break
        row = leading(sizes)
        known = directions[:number]
        direction = left[row] - (known @ left[row]) @ known
        direction /= np.linalg.norm(direction)
        left -= np.outer(left @ direction, direction)
        directions[number] = direction
        rows.append(row)
    return np.asarray(columns @ directions[: len(rows)].T), rows


def canonical_order(vectors: Sequence[Floats], margin: float = MARGIN) -> list[int]:
    """Return the places of vectors in order: by the first entry in which two differ by more than a margin.

    Vectors that differ nowhere by more keep their order.

    Parameters
    ----------
    vectors : sequence of float[n]
        Of one length.
    margin : float, optional
        In the unit of the entries.

    Examples
    --------
    >>> canonical_order([np.array([1.0, 2.0]), np.array([1.0 + 1e-12, 1.0])])
    [1, 0]
    """

    def compared(one: int, other: int) -> int:
        apart = vectors[one] - vectors[other]
        clear = np.abs(apart) > margin
        return int(np.sign(apart[int(np.argmax(clear))])) if clear.any() else 0

    return sorted(range(len(vectors)), key=cmp_to_key(compared))
