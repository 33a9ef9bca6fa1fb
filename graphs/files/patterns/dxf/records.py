"""Records of a DXF file: what its pairs of lines, a group code and a value, make up.

A pair with the code 0 begins a record; records are in sections. Only text is read: binary DXF is refused.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from graphs.convert.tracing import MOST
from graphs.errors import FileError, shown

__all__ = ["Record", "records"]

_CODE = re.compile(r"[ \t]*-?[0-9]{1,4}[ \t]*")
_BREAK = re.compile(r"\r\n|\n|\r")


@dataclass(frozen=True)
class Record:
    """A record of a DXF file.

    A section is ``ENTITIES``, ``TABLES``, ..., a name ``LINE``, ``LAYER``, ..., a group (code, value); path and
    line, where the record starts, are for messages.
    """

    section: str
    name: str
    groups: tuple[tuple[int, str], ...]
    path: Path
    line: int

    def word(self, code: int, default: str = "") -> str:
        """Return the first value of a group code."""
        return next((value for held, value in self.groups if held == code), default)

    def number(self, code: int, default: str | None = None) -> float:
        """Return the first value of a group code as a number.

        Raise FileError if there is none and no default, or it is no coordinate.
        """
        value = self.word(code, "" if default is None else default)
        if not value:
            raise self.fault(f"no group {code}")
        return self.as_number(code, value)

    def whole(self, code: int, default: int) -> int:
        """Return the first value of a group code as a whole number: flags, numbers of colours."""
        value = self.word(code, str(default))
        if re.fullmatch(r"[-+]?\d{1,9}", value) is None:
            raise self.fault(f"group {code} is {shown(value)}", "a whole number")
        return int(value)

    def as_number(self, code: int, value: str) -> float:
        """Return a value of the record as a number of a size that can be reckoned with."""
        try:
            number = float(value)
        except ValueError:
            raise self.fault(f"group {code} is {shown(value)}", "a number") from None
        if not abs(number) < MOST:
            raise self.fault(f"group {code} is a number that is not finite, or too large", "a coordinate")
        return number

    def fault(self, found: str, expected: str = "a DXF record as R12 has it") -> FileError:
        """Return the error that says what is wrong with the record."""
        return FileError(self.path, f"{self.name} at line {self.line}", found, expected)


def records(text: str, path: Path) -> Iterator[Record]:
    r"""Yield the records of a DXF text that are in sections; a FileError names the line if it is not DXF.

    >>> text = "\n".join("0 SECTION 2 ENTITIES 0 POINT 8 CUT 10 1.5 0 ENDSEC 0 EOF".split())
    >>> [(one.section, one.name, one.number(10)) for one in records(text, Path("a.dxf"))]
    [('ENTITIES', 'POINT', 1.5)]
    """
    section, name, begun = "", "", 0
    groups: list[tuple[int, str]] = []
    for line, code, value in _pairs(text, path):
        if code != 0:
            groups.append((code, value))
            continue
        if name == "SECTION":
            section = next((held for number, held in groups if number == 2), "")
        elif name == "ENDSEC":
            section = ""
        elif section and name:
            yield Record(section, name, tuple(groups), path, begun)
        name, begun, groups = value, line, []
    if name != "EOF":
        raise FileError(path, "", "it does not end with EOF", "a whole DXF file")


def _pairs(text: str, path: Path) -> Iterator[tuple[int, int, str]]:
    """Yield line numbers, codes and values."""
    lines = _BREAK.split(text)
    while lines and not lines[-1].strip():
        lines.pop()
    for at in range(0, len(lines), 2):
        if _CODE.fullmatch(lines[at]) is None:
            raise FileError(path, f"line {at + 1}", shown(lines[at].strip()), "a group code of DXF")
        if at + 1 == len(lines):
            raise FileError(path, f"line {at + 1}", "a group code without a value", "a whole DXF file")
        yield at + 1, int(lines[at]), lines[at + 1].strip()
