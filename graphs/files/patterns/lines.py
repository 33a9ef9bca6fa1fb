"""Crease patterns that come as lines, traced: ``.cp``, ORIPA's ``.opx``, and the lines of drawings.

A drawing without a border, or with its creases in the colour of borders, would have a mobility, but not that of
the intended mechanism. So it is refused. ``.opx`` is what Java's ``XMLEncoder`` writes of ``oripa.OriLineProxy``,
without properties that are zero.
"""

from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from graphs.convert.faces import joins_faces
from graphs.convert.tracing import MOST, Lines, trace_sheet
from graphs.errors import FileError, UnsolvableError, numbered, shown
from graphs.files.patterns.legend import Interpretation
from graphs.files.text import Checker, read_text
from graphs.mechanism.precision import flat_places, written_by
from graphs.mechanism.sheet import HINGES, Reading, Sheet, WrittenPrecision, with_all_edges

_BORDERS = "BC"


def traced_sheet(
    lines: Lines,
    check: Checker,
    *,
    title: str = "",
    border: str = "",
    understood: Interpretation | None = None,
    precision: WrittenPrecision | None = None,
) -> Sheet:
    """Trace the lines of a file, of a precision or that of their digits before welding.

    `border` describes a border in this format; without it a drawing needs none, and its lines may have no
    assignment. `understood` has the assignments of the strokes of a drawing. Raise FileError if there is no
    border, no face, no crease between two faces although creases were drawn, or several faces and no crease.
    """
    left_out = "" if understood is None else understood.left_out
    unread = f"; {left_out}" if left_out else ""
    count = len(lines.letters)
    bordered = any(letter in _BORDERS for letter in lines.letters)
    if unread and not lines.size:
        raise FileError(check.path, "", f"the pattern has no line of any length{unread}", "lines")
    if border and lines.size and not bordered:
        raise FileError(check.path, "", f"no border among {numbered(count, 'line')}{unread}", border)
    sheet = check.build(lambda: trace_sheet(lines, title=title), lambda part: part[0])
    if not sheet.faces:
        wrong = f"{numbered(count, 'line')} enclose{'s' * (count == 1)} no face{unread}"
        raise FileError(check.path, "", wrong, "a closed border")
    # Without borders an unassigned line may be one.
    creases = sum(letter in (HINGES if bordered else "MV") for letter in lines.letters)
    if creases and not joins_faces(sheet):
        wrong = f"none of {numbered(creases, 'crease line')} lies between two faces"
        raise FileError(check.path, "", wrong + unread, "creases that reach the border or each other")
    if len(sheet.faces) > 1 and set(lines.letters) <= set(_BORDERS):
        raise FileError(check.path, "", f"{len(sheet.faces)} faces and no crease{unread}", "mountains or valleys")
    sheet = replace(sheet, precision=precision or written_by(lines.ends))
    if understood is None:
        return sheet
    reading = Reading(() if sheet.reading is None else sheet.reading.repairs, left_out)
    notes = (*understood.notes, *([left_out] if left_out else []))
    return replace(sheet, repairs=(*sheet.repairs, *notes), reading=reading)


_CP_LETTERS = {"1": "B", "2": "M", "3": "V", "4": "F"}
_CP_TYPES = {"B": 1, "C": 1, "M": 2, "V": 3, "U": 3, "F": 4, "J": 4}


def sheet_from_cp(path: Path) -> Sheet:
    """Read a ``.cp`` file and trace its faces; a FileError names the line, or why the lines make no pattern."""
    ends, letters = [], []
    for number, line in enumerate(read_text(path).splitlines(), start=1):
        words = line.split()
        if not words:
            continue
        place = f"line {number}"
        if len(words) != 5 or words[0] not in _CP_LETTERS:
            raise FileError(path, place, shown(line.strip()), "a type from 1 to 4 and four numbers")
        try:
            x1, y1, x2, y2 = map(float, words[1:])
        except ValueError:
            raise FileError(path, place, shown(line.strip()), "four numbers after the type") from None
        _check_size(path, place, x1, y1, x2, y2)
        ends.append(((x1, y1), (x2, y2)))
        letters.append(_CP_LETTERS[words[0]])
    lines = np.array(ends, dtype=float).reshape(-1, 2, 2)
    return traced_sheet(Lines(lines, "".join(letters)), Checker(path), border="border lines (type 1)")


def cp_text(sheet: Sheet) -> str:
    """Return the ``.cp`` text of a flat sheet; unassigned creases are written as valleys, cuts as borders."""
    if not (sheet.edges or sheet.faces):
        raise UnsolvableError("a .cp file needs lines, and the sheet has none")
    sheet = with_all_edges(sheet)
    at = [(repr(x), repr(y)) for x, y in flat_places(sheet, "a .cp file")]
    return "".join(
        f"{_CP_TYPES[letter]} {' '.join(at[a])} {' '.join(at[b])}\n"
        for (a, b), letter in zip(sheet.edges, sheet.assignments, strict=True)
    )


_LINE = "oripa.OriLineProxy"
_COORDINATES = ("x0", "y0", "x1", "y1")
_OPX_LETTERS = {"0": "F", "1": "B", "2": "M", "3": "V", "4": "U"}


def sheet_from_opx(path: Path) -> Sheet:
    """Read the lines of an ORIPA file and trace its faces; a FileError names the line."""
    try:
        text = read_text(path)
        if "<!DOCTYPE" in text:  # its entities could make a small file a huge one
            raise FileError(path, "", "a document type definition", "an ORIPA file, which has none")
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        row, column = error.position
        raise FileError(path, f"line {row} column {column}", "not XML", "an ORIPA file") from None
    objects = [element for element in root.iter("object") if element.get("class") == _LINE]
    if not objects:
        raise FileError(path, "", f"no object of class {_LINE}", "an ORIPA file")
    ends, letters = [], []
    for number, line in enumerate(objects):
        place = f"{_LINE} {number}"
        values = _properties(line, path, place)
        kind = values.get("type", "0")
        if kind not in _OPX_LETTERS:
            raise FileError(path, place, f"type {shown(kind)}", "a type from 0 to 4")
        letters.append(_OPX_LETTERS[kind])
        ends.append([_coordinate(values.get(name, "0"), path, f"{place} {name}") for name in _COORDINATES])
    lines = Lines(np.array(ends).reshape(-1, 2, 2), "".join(letters))
    return traced_sheet(lines, Checker(path), border="border lines (type 1)")


def _properties(line: ElementTree.Element, path: Path, place: str) -> dict[str, str]:
    """Return the properties of a line as text."""
    values = {}
    for element in line.findall("void"):
        if len(element) != 1:
            raise FileError(path, place, f"a property of {numbered(len(element), 'value')}", "one")
        values[element.get("property", "")] = (element[0].text or "").strip()
    return values


def _coordinate(text: str, path: Path, place: str) -> float:
    """Read a finite number."""
    try:
        number = float(text)
    except ValueError:
        raise FileError(path, place, shown(text), "a number") from None
    _check_size(path, place, number)
    return number


def _check_size(path: Path, place: str, *numbers: float) -> None:
    """Refuse coordinates that faces cannot be traced with."""
    if not all(abs(number) < MOST for number in numbers):
        raise FileError(path, place, "a number that is not finite, or too large", "coordinates")
