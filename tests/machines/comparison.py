"""Two transcripts compared: words are the same, numbers too but for the last digit that is shown."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

__all__ = ["Answer", "Difference", "differences"]

_NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.])", re.I)

_DECIMALS = 9
"""Digits that a number of ours is good for at most: more of them are shown by mistake, and are not compared."""

_RESIDUAL = 1e-9
"""Closures, distances of vertices, parts of panels: below this what is left is rounding, which differs from machine
to machine; so do ratios of singular values to those that are zero but for rounding, above the inverse."""


@dataclass(frozen=True)
class Answer:
    """What a command did.

    Attributes
    ----------
    command : str
    status : int
    lines : tuple of str
        What it printed, and the files it wrote.
    """

    command: str
    status: int
    lines: tuple[str, ...]


@dataclass(frozen=True)
class Difference:
    """A command that answers otherwise.

    Attributes
    ----------
    command : str
    lines : tuple of (str, str)
        Pairs of lines that differ, the first and the second transcript's.
    """

    command: str
    lines: tuple[tuple[str, str], ...]


def differences(first: list[Answer], second: list[Answer]) -> Iterator[Difference]:
    """Yield the commands whose answers are not the same; both transcripts are of the same commands."""
    for one, other in zip(first, second, strict=True):
        assert one.command == other.command
        pairs = [pair for pair in zip(_padded(one, other), _padded(other, one), strict=True) if not same_line(*pair)]
        if one.status != other.status:
            pairs.insert(0, (f"exit status {one.status}", f"exit status {other.status}"))
        if pairs:
            yield Difference(one.command, tuple(pairs))


def _padded(one: Answer, other: Answer) -> list[str]:
    return [*one.lines, *[""] * (len(other.lines) - len(one.lines))]


def same_line(one: str, other: str) -> bool:
    """Tell whether two lines have the same words, and numbers that agree."""
    if one == other:
        return True
    return _words(one) == _words(other) and all(map(_same_number, _NUMBER.findall(one), _NUMBER.findall(other)))


def _words(line: str) -> str:
    """Return a line with each number, and runs of spaces and rules, as one sign."""
    return re.sub(r"[ ─]+", " ", _NUMBER.sub("#", line))


def _same_number(one: str, other: str) -> bool:
    if one == other:
        return True
    first, second = float(one), float(other)
    if all(abs(number) < _RESIDUAL for number in (first, second)):
        return True
    if all(abs(number) > 1 / _RESIDUAL for number in (first, second)):
        return True
    unit = max(min(_unit(one), _unit(other)), 10.0**-_DECIMALS)
    if unit == 1.0 and "." not in one + other and "e" not in (one + other).lower():
        return False  # whole numbers are counts
    return abs(first - second) <= 1.01 * unit


def _unit(number: str) -> float:
    """Return what one in the last digit of a number is worth."""
    mantissa, _, exponent = number.lower().partition("e")
    return float(10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2])))
