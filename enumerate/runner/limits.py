"""Limits of a number that a query asks for: a least and a greatest value.

A query may be given a pair or one number; it keeps limits.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from graphs.errors import InvariantError
from graphs.types import Flags, Ints

__all__ = ["ANY_NUMBER", "ONE_OR_MORE", "Limits", "keep_limits", "key_of"]


@dataclass(frozen=True, slots=True)
class Limits:
    """A least and a greatest value.

    Attributes
    ----------
    least : int
    most : int or None
        None: there is no greatest value.

    Examples
    --------
    >>> 3 in Limits(2), 3 in Limits(0, 2)
    (True, False)
    """

    least: int = 0
    most: int | None = None

    def __contains__(self, value: int) -> bool:
        """Tell whether a value is within the limits."""
        return value >= self.least and (self.most is None or value <= self.most)

    def admitted(self, values: Ints) -> Flags:
        """Tell which of some values are within the limits."""
        enough: Flags = values >= self.least
        return enough if self.most is None else enough & (values <= self.most)


ANY_NUMBER, ONE_OR_MORE = Limits(0), Limits(1)


def keep_limits(query: object, *names: str) -> None:
    """Make limits of the fields of a frozen query that a user may give as a pair or as one number.

    Raises `InvariantError` if the smaller number does not come first.

    >>> from enumerate.chains.query import ChainQuery
    >>> ChainQuery(8, 1, symmetry=2).symmetry
    Limits(least=2, most=2)
    """
    for name in names:
        object.__setattr__(query, name, _limits(name.replace("_", " "), getattr(query, name)))


def _limits(name: str, given: Limits | tuple[int, int | None] | int) -> Limits:
    limits = given
    if isinstance(limits, int):
        limits = limits, limits
    if isinstance(limits, Sequence):
        limits = Limits(*limits)
    if limits.most is not None and limits.most < limits.least:
        raise InvariantError(name, f"the range {limits.least} to {limits.most}", "the smaller number first")
    return limits


def key_of(value: object) -> object:
    """Return a field of a query in JSON values; limits become least and greatest value."""
    if isinstance(value, Limits):
        return [value.least, value.most]
    return list(value) if isinstance(value, tuple) else value
