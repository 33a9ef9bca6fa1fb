"""The numbers that mechanisms are placed with: a prime field, where ranks are exact, or the reals.

A general member of a type is one with coordinates chosen at random. Over a field of about 2^61 numbers a random
member has the generic rank but for a probability of about (number of joints) / 2^58 (Schwartz 1980): a smaller
rank is possible, a larger one is not. Theory: docs/theory/exact-mobility.md.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import Any, Protocol

from graphs.tolerances import DOUBLE

__all__ = ["PRIMES", "Field", "PrimeField", "Reals", "null_vectors"]

PRIMES = (2**61 - 1, 2**61 - 31)
"""The two largest primes below 2^61."""


class Field(Protocol):
    """Numbers that are added, multiplied, drawn at random, inverted, and told from zero.

    Examples
    --------
    A member of a type is placed with any of them; the rank modulo a prime is exact:

    >>> fields: list[Field] = [PrimeField(7), Reals()]
    >>> [field.is_zero(field.reduce(field.inverse(2) * 2 - 1)) for field in fields]
    [True, True]
    """

    def random(self) -> Any:
        """Return a random number."""

    def reduce(self, value: Any) -> Any:
        """Return the number in its normal form."""

    def inverse(self, value: Any) -> Any:
        """Return 1 / value."""

    def is_zero(self, value: Any) -> bool:
        """Tell whether a number in normal form is zero."""


class PrimeField:
    """The integers modulo a prime.

    Parameters
    ----------
    prime : int
    seed : int, optional
        Of the random numbers; the same seed gives the same member.

    Examples
    --------
    >>> field = PrimeField(7)
    >>> field.reduce(3 * field.inverse(3))
    1
    """

    def __init__(self, prime: int, seed: int = 0) -> None:
        self.prime = prime
        self._random = random.Random(f"{prime} {seed}")

    def random(self) -> int:
        """Return a random number other than 0."""
        return self._random.randrange(1, self.prime)

    def reduce(self, value: int) -> int:
        """Return the remainder."""
        return value % self.prime

    def inverse(self, value: int) -> int:
        """Return the number whose product with this one is 1."""
        return pow(value, -1, self.prime)

    def is_zero(self, value: int) -> bool:
        """Tell whether a remainder is zero."""
        return value == 0


class Reals:
    """Floating-point numbers; random ones are normally distributed.

    Parameters
    ----------
    seed : int, optional
        Of the random numbers; the same seed gives the same member.

    Examples
    --------
    >>> Reals().is_zero(1e-12)
    True
    """

    def __init__(self, seed: int = 0) -> None:
        self._random = random.Random(seed)

    def random(self) -> float:
        """Return a random number."""
        return self._random.gauss(0.0, 1.0)

    def reduce(self, value: float) -> float:
        """Return the number itself."""
        return value

    def inverse(self, value: float) -> float:
        """Return the reciprocal."""
        return 1.0 / value

    def is_zero(self, value: float) -> bool:
        """Tell whether a number of the size of coordinates is rounded zero."""
        return abs(value) < DOUBLE.zero


def null_vectors(rows: Sequence[Sequence[Any]], field: Field) -> list[list[Any]]:
    """Return a basis of the vectors that all rows of a small matrix annihilate.

    >>> null_vectors([[1, 2], [2, 4]], PrimeField(7))
    [[5, 1]]
    """
    work = [list(row) for row in rows]
    columns = len(work[0])
    pivots: list[int] = []
    for column in range(columns):
        row = len(pivots)
        best = max(range(row, len(work)), key=lambda i: abs(work[i][column]), default=None)
        if best is None or field.is_zero(work[best][column]):
            continue
        work[row], work[best] = work[best], work[row]
        scale = field.inverse(work[row][column])
        work[row] = [field.reduce(value * scale) for value in work[row]]
        for i in range(len(work)):
            if i != row and not field.is_zero(work[i][column]):
                factor = work[i][column]
                work[i] = [field.reduce(a - factor * b) for a, b in zip(work[i], work[row], strict=True)]
        pivots.append(column)
    basis = []
    for free in range(columns):
        if free not in pivots:
            vector: list[Any] = [0] * columns
            vector[free] = 1
            for row, column in enumerate(pivots):
                vector[column] = field.reduce(-work[row][free])
            basis.append(vector)
    return basis
