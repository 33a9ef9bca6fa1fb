"""What is zero and what is equal: tolerances, and choices that do not depend on the last bit.

Every length, angle, rate and singular value that is compared with zero is compared with a field of `Tolerances`,
made from the precision of the coordinates and the size of a mechanism: lengths in units of the extent, angles in
radians, rates as parts of the largest. Canonical choices (of a basis of a null space, of one of several equal
numbers) depend on the space and on the numbers alone: two numbers that agree to a millionth are equal, and of
equals the first comes first. Theory: docs/theory/rounding.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cmp_to_key
from math import sqrt

import numpy as np

from graphs.types import Floats

__all__ = [
    "DOUBLE",
    "EPSILON",
    "MARGIN",
    "Tolerances",
    "canonical_basis",
    "canonical_order",
    "leading",
    "pivots",
    "signed",
    "trailing",
]

EPSILON = 2.0**-52
"""The rounding unit of double precision."""

# Precisions. Errors of coordinates move singular values off zero by what they turn axes: by the precision over the
# length of a crease, which may be a tenth of the extent and less, and a loop sums up several.
_BLURRED = 30.0
# Never more counts as zero, however rough the coordinates: within it mobile and rigid mechanisms cannot be told apart.
_COARSEST = 3e-3
# Errors of a direction. Equations between rates hold where coordinates were meant, and are off by several of them where
# they are rounded, since each sums up the directions round a vertex.
_NEARLY = 8.0
_VAGUE = 0.1  # never more, however short the creases: hardly any two patterns can be told apart above it
# Whoever draws or solves for points of one plane has five digits or more; panels of a design deviate more.
_MEANT_FLAT = 1e-5
_MEANT = 1e-6  # whoever draws lines of one point has the six digits that programs write by default
_MOVED = 4.0  # a length is wrong by the errors of two points along each of three axes, 2 sqrt(3) precisions, rounded up


@dataclass(frozen=True, slots=True)
class Tolerances:
    """What is zero in one mechanism.

    Attributes
    ----------
    precision : float
        Error of a coordinate, in units of the extent.
    closed : float
        Loops that miss by no more are closed: radians and units of the extent. Independent of the precision:
        a configuration is solved for in double precision, whatever the file says.
    derivative : float
        Error of an entry of the closure equations' derivatives at a configuration whose loops are closed.
    zero : float
        A singular value or eigenvalue below this part of the largest is zero.
    singular : float
        A singular value below this is zero at a configuration that was located along a path, to some 1e-7, since
        Newton's method does not lead to singular ones.
    clear : float
        One above this part of the largest is certainly not zero: what proofs rest on.
    zero_rate : float
        A rate below this part of the largest is none.
    immobile : float
        A joint that turns by less, in radians, while others turn by degrees does not move.
    moved : float
        A path that ends before, in radians, shows no motion: so far loops are closed that open at fourth order.
    same_configuration : float
        Two configurations whose angles differ by less, in radians, are one.
    same_point : float
        Two points that are nearer than this are one; two lines or planes that pass nearer meet.
    parallel : float
        Directions that differ by less, in radians, are parallel.
    meant : float
        Lines that pass a point, or are off parallel, by less are meant to meet there or to be parallel.
    flat : float
        Points that are this close to one plane, in units of their own extent, are meant to lie in it.
    """

    precision: float
    closed: float
    derivative: float
    zero: float
    singular: float
    clear: float
    zero_rate: float
    immobile: float
    moved: float
    same_configuration: float
    same_point: float
    parallel: float
    meant: float
    flat: float

    @classmethod
    def of(cls, precision: float, joints: int = 1) -> Tolerances:
        """Return the tolerances of a mechanism by the error of a coordinate, in units of the extent.

        Rounding errors add up as the root of its number of joints.
        """
        rounding = max(precision, EPSILON)
        wrong = _MOVED * precision
        grown = max(1.0, sqrt(joints / 1000.0))  # the fixed values hold for a thousand joints
        closed = 1e-12 * grown
        zero = max(1e-9 * grown, min(_COARSEST, _BLURRED * precision))
        return cls(
            precision=rounding,
            closed=closed,
            derivative=100.0 * closed,
            zero=zero,
            singular=max(1e-5, zero),
            clear=max(1e-6, zero),
            zero_rate=1e-7,
            immobile=1e-9 * grown,
            moved=sqrt(sqrt(closed)),
            same_configuration=1e-6,
            same_point=max(1e-9, wrong),
            parallel=max(1e-9, wrong),
            meant=max(_MEANT, 6.0 * precision),
            flat=max(_MEANT_FLAT, 2.0 * precision),
        )

    @staticmethod
    def nearly(precision: float, length: float) -> float:
        """Return below which part of the largest a value may be zero at the coordinates that were meant.

        Creases are a length long, in units of the extent: their directions are wrong by the precision over it.
        """
        return max(DOUBLE.zero, min(_VAGUE, _NEARLY * precision / length))


DOUBLE = Tolerances.of(EPSILON)
"""For coordinates that are exact but for the rounding of double precision."""


MARGIN = 1e-6
"""Numbers that differ by less than this part of the largest are equal: far above rounding, far below what symmetry
leaves different."""
# Squared length of a row of orthonormal columns that is nothing: rounding leaves 1e-16 to the square, and less.
_DEPENDS = 1e-12


def leading(values: Floats) -> int:
    """Return the place of the largest absolute value of float[n]; of those within a millionth of it, the first."""
    sizes = np.abs(values)
    return int(np.argmax(sizes >= (1.0 - MARGIN) * sizes.max()))


def trailing(values: Floats, scale: float = 0.0) -> int:
    """Return the place of the least value of float[n]; of those greater by no more than a millionth, the first.

    The millionth is a part of ``scale``, by default of the largest absolute value.
    """
    return int(np.argmax(values <= values.min() + MARGIN * (scale or np.abs(values).max())))


def signed(vector: Floats) -> Floats:
    """Return a vector or its negative: the one whose first entry that is not zero is positive.

    Entries below a millionth of the largest are zero.
    """
    sizes = np.abs(vector)
    there = sizes > MARGIN * sizes.max(initial=0.0)
    return -vector if there.any() and vector[int(np.argmax(there))] < 0.0 else vector


def canonical_basis(columns: Floats) -> Floats:
    """Return a basis of the space of orthonormal columns, float[n, s]: it depends on the space alone.

    Its vectors are the projections, made orthogonal one after the other, of those unit vectors (`pivots`) of which
    most lies in the space; the entry of each vector at its pivot is positive.
    """
    return _reduced(columns)[0]


def pivots(columns: Floats) -> list[int]:
    """Return rows of orthonormal columns that determine all others, in the order of `canonical_basis`."""
    return _reduced(columns)[1]


def _reduced(columns: Floats) -> tuple[Floats, list[int]]:
    """Return the canonical basis and its pivots: a QR decomposition of the rows whose pivots have a margin.

    Each row is made orthogonal to those before it a second time: the basis is orthonormal to rounding.
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

    Vectors of one length that differ nowhere by more, in the unit of their entries, keep their order.
    """

    def compared(one: int, other: int) -> int:
        apart = vectors[one] - vectors[other]
        clear = np.abs(apart) > margin
        return int(np.sign(apart[int(np.argmax(clear))])) if clear.any() else 0

    return sorted(range(len(vectors)), key=cmp_to_key(compared))
