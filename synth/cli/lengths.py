"""Types of options: lengths and factors in the range of coordinates, and branches by number or signs."""

from __future__ import annotations

from typing import Any

import click

from graphs.limits import LEAST, MOST
from graphs.printing import plain

__all__ = ["BRANCH", "LENGTH", "LENGTH_OR_NONE"]

_MOST_DIGITS = 9
"""Digits of the number of a branch: nobody lists more, and Python converts no more than some thousands."""


class _LengthType(click.ParamType):  # type: ignore[type-arg,unused-ignore]
    """A length, or a factor for lengths, in the range that coordinates have; with ``zero`` also 0."""

    name = "length"

    def __init__(self, *, zero: bool = False) -> None:
        self._zero = zero

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return the number."""
        try:
            number = float(value)
        except ValueError:
            self.fail(f"{plain(str(value), 100)!r} is not a number", param, ctx)
        if not (LEAST <= number <= MOST or (self._zero and number == 0.0)):
            also = "0, or " if self._zero else ""
            self.fail(f"{number:g} is out of range; expected {also}{LEAST:g} to {MOST:g}", param, ctx)
        return number


class _BranchType(click.ParamType):  # type: ignore[type-arg,unused-ignore]
    """A branch, as `synth fold --branches` lists them: its number, or its signs as text."""

    name = "branch"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int | str:
        """Return the number, or the signs."""
        if isinstance(value, int) or not (value.isascii() and value.isdigit()):
            return value  # type: ignore[no-any-return]
        if len(value) > _MOST_DIGITS:
            self.fail(f"a number of {len(value)} digits is the number of no branch", param, ctx)
        return int(value)


LENGTH = _LengthType()
"""The type of --size, --scale, --thickness and the like."""
LENGTH_OR_NONE = _LengthType(zero=True)
"""The type of lengths that may be 0, such as --gap."""
BRANCH = _BranchType()
"""The type of --branch."""
