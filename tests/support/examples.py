"""Examples of the documentation: blocks of commands and of Python, run in order, and what they print compared.

A block of commands is fenced as ``console``: a line that begins with ``$ synth`` is a command, the lines to the next
are what it prints. A line of three dots stands for any lines, three dots in a line for any text. Numbers are equal to
the digits that are written, one in the last place apart; residuals, and gaps above them, are only small, or large.
A block of JSON after "as `name.json`:" is saved so, as a reader would save it.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from dataclasses import dataclass

from click.testing import CliRunner

from synth.cli.main import main

__all__ = ["Command", "Fence", "agree", "commands_of", "fences_of", "printed_by"]

_FENCE = re.compile(r"(?:as `(?P<place>[\w.-]+)`:\n\n)?^```(?P<language>\w+)\n(?P<text>.*?)^```$", re.M | re.S | re.I)
_NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.])")
_DOTS = "..."
_ROUNDING = 1e-6


@dataclass(frozen=True)
class Fence:
    """A block of a document.

    Attributes
    ----------
    language : str
    text : str
    start, end : int
        Of the text in the document.
    place : str or None
        The file it is saved as.
    """

    language: str
    text: str
    start: int
    end: int
    place: str | None


@dataclass(frozen=True)
class Command:
    """A command of a block, and what it prints there.

    Attributes
    ----------
    words : tuple of str
        After ``synth``.
    output : tuple of str
        Lines.
    """

    words: tuple[str, ...]
    output: tuple[str, ...]


def fences_of(document: str) -> list[Fence]:
    """Return the blocks of a document that name their language."""
    return [
        Fence(match["language"], match["text"], match.start("text"), match.end("text"), match["place"])
        for match in _FENCE.finditer(document)
    ]


def commands_of(block: str) -> Iterator[Command]:
    """Yield the commands of a block; a command goes on where its line ends in a backslash."""
    parts = re.split(r"^\$ ", block.replace("\\\n", " "), flags=re.MULTILINE)
    assert not parts[0].strip(), f"a block begins with what is no command: {parts[0]!r}"
    for part in parts[1:]:
        line, _, output = part.partition("\n")
        words = shlex.split(line, comments=True)
        assert words[0] == "synth", line
        yield Command(tuple(words[1:]), tuple(trimmed(output)))


def trimmed(output: str) -> list[str]:
    """Return the lines of an output that have something in them, without spaces at their ends."""
    return [line.rstrip() for line in output.splitlines() if line.strip()]


def printed_by(words: tuple[str, ...]) -> list[str]:
    """Return what a command prints, here and now."""
    result = CliRunner().invoke(main, list(words))
    assert result.exception is None or isinstance(result.exception, SystemExit), (words, result.exception)
    return trimmed(result.output)


def agree(expected: list[str] | tuple[str, ...], printed: list[str]) -> bool:
    """Tell whether what is printed is as written."""
    if not expected:
        return not printed
    first, *rest = expected
    if first.strip() == _DOTS:
        return any(agree(rest, printed[start:]) for start in range(len(printed) + 1))
    return bool(printed) and _same_line(first, printed[0]) and agree(rest, printed[1:])


def _same_line(expected: str, printed: str) -> bool:
    parts = [re.escape(_masked(part)) for part in expected.split(_DOTS)]
    if not re.fullmatch(".*".join(parts), _masked(printed)):
        return False
    return _DOTS in expected or all(map(_same_number, _NUMBER.findall(expected), _NUMBER.findall(printed)))


def _masked(line: str) -> str:
    """Return a line with each number, the spaces before it and runs of spaces and rules as one sign."""
    return re.sub(r"[ ─]+", " ", _NUMBER.sub("#", line))


def _same_number(expected: str, printed: str) -> bool:
    if expected == printed:
        return True
    if all(_is_rounding(float(number)) for number in (expected, printed)):
        return True
    mantissa, _, exponent = expected.partition("e")
    digits = len(mantissa.partition(".")[2])
    if not digits and not exponent:
        return False  # whole numbers are counts
    return abs(float(expected) - float(printed)) <= 1.01 * 10.0 ** (int(exponent or 0) - digits)


def _is_rounding(number: float) -> bool:
    """Tell whether a number is that of rounding, or a ratio to it: it differs from machine to machine."""
    return abs(number) < _ROUNDING or abs(number) > 1 / _ROUNDING
