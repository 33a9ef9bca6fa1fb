"""Drawn lines traced, and refused where no pattern comes of them.

What is left of a drawing without a border, or with its creases in the colour of borders, is a panel or some that
nothing joins: it would have a mobility, and not that of what was meant.
"""

from __future__ import annotations

from dataclasses import replace

from graphs.convert.loose_creases import joins_faces
from graphs.convert.tracing import trace_sheet
from graphs.convert.welding import Lines
from graphs.errors import FileError, numbered
from graphs.files.check import Checker
from graphs.files.patterns.legend import Understood
from graphs.mechanism.precision import written_by
from graphs.mechanism.sheet import HINGES, Reading, Sheet, WrittenPrecision

__all__ = ["traced_sheet"]

_BORDERS = "BC"


def traced_sheet(
    lines: Lines,
    check: Checker,
    *,
    title: str = "",
    border: str = "",
    understood: Understood | None = None,
    precision: WrittenPrecision | None = None,
) -> Sheet:
    """Trace the lines of a file.

    The precision is that of their ends as they are written; by default their digits say it, before welding.
    `border` is what a border is in this format; without it a drawing needs none, and its lines may have no
    assignment. `understood` says what was made of the strokes of a drawing. Raise FileError if
    there is no border, no face, no crease between two faces although creases were drawn, or several faces and no
    crease. One face with nothing in it is a panel.

    >>> import numpy as np
    >>> from pathlib import Path
    >>> ends = np.array([[[0, 0], [1, 0]], [[1, 0], [0, 1]], [[0, 1], [0, 0]]], dtype=float)
    >>> traced_sheet(Lines(ends, "MMM"), Checker(Path("a.cp")), border="border lines (type 1)")
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: a.cp: no border among 3 lines; expected border lines (type 1)
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
        raise FileError(
            check.path,
            "",
            f"{numbered(count, 'line')} enclose{'s' * (count == 1)} no face{unread}",
            "a border that is closed",
        )
    # Where nothing is a border, what is unassigned may be one.
    creases = sum(letter in (HINGES if bordered else "MV") for letter in lines.letters)
    if creases and not joins_faces(sheet):
        found = f"none of {numbered(creases, 'crease line')} lies between two faces"
        raise FileError(check.path, "", found + unread, "creases that reach the border or each other")
    if len(sheet.faces) > 1 and set(lines.letters) <= set(_BORDERS):
        raise FileError(check.path, "", f"{len(sheet.faces)} faces and no crease{unread}", "mountains or valleys")
    sheet = replace(sheet, precision=precision or written_by(lines.ends))
    if understood is None:
        return sheet
    reading = Reading(() if sheet.reading is None else sheet.reading.repairs, left_out)
    notes = (*understood.notes, *([left_out] if left_out else []))
    return replace(sheet, repairs=(*sheet.repairs, *notes), reading=reading)
