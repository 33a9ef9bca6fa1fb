"""Crease patterns of ORIPA, ``.opx``: lines and their types.

The file is what Java's ``XMLEncoder`` writes of a list of ``oripa.OriLineProxy``: properties ``x0``, ``y0``,
``x1``, ``y1``, ``type``, sorted by name, those that are zero left out. What stands round the lines differs from
version to version and is left alone. Types: 0 auxiliary (flat), 1 border, 2 mountain, 3 valley, 4 unassigned.
"""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from graphs.convert.tracing import MOST
from graphs.convert.welding import Lines
from graphs.errors import FileError, shown
from graphs.files.check import Checker
from graphs.files.patterns.traced import traced_sheet
from graphs.files.text import read_text
from graphs.mechanism.sheet import Sheet

__all__ = ["sheet_from_opx"]

_LINE = "oripa.OriLineProxy"
_COORDINATES = ("x0", "y0", "x1", "y1")
_LETTERS = {"0": "F", "1": "B", "2": "M", "3": "V", "4": "U"}


def sheet_from_opx(path: Path) -> Sheet:
    """Read the lines of an ORIPA file and trace its faces.

    Coordinates are kept as they are written, like those of ``.cp``. A FileError names the line, or why the lines
    make no pattern (:mod:`graphs.files.patterns.traced`).
    """
    try:
        root = ElementTree.fromstring(_without_entities(read_text(path), path))
    except ElementTree.ParseError as error:
        row, column = error.position
        raise FileError(path, f"line {row} column {column}", "not XML", "an ORIPA file") from None
    found = [one for one in root.iter("object") if one.get("class") == _LINE]
    if not found:
        raise FileError(path, "", f"no object of class {_LINE}", "an ORIPA file")
    ends, letters = [], []
    for number, line in enumerate(found):
        place = f"{_LINE} {number}"
        values = _properties(line, path, place)
        kind = values.get("type", "0")
        if kind not in _LETTERS:
            raise FileError(path, place, f"type {shown(kind)}", "a type from 0 to 4")
        letters.append(_LETTERS[kind])
        ends.append([_coordinate(values.get(name, "0"), path, f"{place} {name}") for name in _COORDINATES])
    lines = Lines(np.array(ends).reshape(-1, 2, 2), "".join(letters))
    return traced_sheet(lines, Checker(path), border="border lines (type 1)")


def _without_entities(text: str, path: Path) -> str:
    """Refuse a document type: entities of it could make a small file a huge one."""
    if "<!DOCTYPE" in text:
        raise FileError(path, "", "a document type definition", "an ORIPA file, which has none")
    return text


def _properties(line: ElementTree.Element, path: Path, place: str) -> dict[str, str]:
    """Return the properties of a line as text."""
    values = {}
    for one in line.findall("void"):
        if len(one) != 1:
            raise FileError(path, place, f"a property of {len(one)} values", "one")
        values[one.get("property", "")] = (one[0].text or "").strip()
    return values


def _coordinate(text: str, path: Path, place: str) -> float:
    """Read a finite number."""
    try:
        number = float(text)
    except ValueError:
        raise FileError(path, place, shown(text), "a number") from None
    if not abs(number) < MOST:
        raise FileError(path, place, "a number that is not finite, or too large", "a coordinate")
    return number
