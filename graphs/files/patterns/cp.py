"""Crease patterns as ``.cp``: a line of ``type x1 y1 x2 y2`` each; 1 border, 2 mountain, 3 valley, 4 auxiliary."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from graphs.convert.tracing import MOST
from graphs.convert.welding import Lines
from graphs.errors import FileError, UnsolvableError, shown
from graphs.files.check import Checker
from graphs.files.patterns.traced import traced_sheet
from graphs.files.text import read_text
from graphs.mechanism.precision import flat_places
from graphs.mechanism.sheet import Sheet, with_all_edges

__all__ = ["cp_text", "sheet_from_cp"]

_LETTERS = {"1": "B", "2": "M", "3": "V", "4": "F"}
_TYPES = {"B": 1, "C": 1, "M": 2, "V": 3, "U": 3, "F": 4, "J": 4}


def sheet_from_cp(path: Path) -> Sheet:
    """Read a ``.cp`` file and trace its faces.

    A FileError names the line, or why the lines make no pattern (:mod:`graphs.files.patterns.traced`).
    """
    ends, letters = [], []
    for number, line in enumerate(read_text(path).splitlines(), start=1):
        words = line.split()
        if not words:
            continue
        place = f"line {number}"
        if len(words) != 5 or words[0] not in _LETTERS:
            raise FileError(path, place, shown(line.strip()), "a type from 1 to 4 and four numbers")
        try:
            x1, y1, x2, y2 = map(float, words[1:])
        except ValueError:
            raise FileError(path, place, shown(line.strip()), "four numbers after the type") from None
        if not all(abs(x) < MOST for x in (x1, y1, x2, y2)):
            raise FileError(path, place, "a number that is not finite, or too large", "coordinates")
        ends.append(((x1, y1), (x2, y2)))
        letters.append(_LETTERS[words[0]])
    lines = np.array(ends, dtype=float).reshape(-1, 2, 2)
    return traced_sheet(Lines(lines, "".join(letters)), Checker(path), border="border lines (type 1)")


def cp_text(sheet: Sheet) -> str:
    """Return the ``.cp`` text of a flat sheet; unassigned creases are written as valleys, cuts as borders.

    Raise UnsolvableError if the sheet has no coordinates, does not lie in a plane, or has no line.
    """
    if not (sheet.edges or sheet.faces):
        raise UnsolvableError("a .cp file needs lines, and the sheet has none")
    sheet = with_all_edges(sheet)
    at = [(repr(x), repr(y)) for x, y in flat_places(sheet, "a .cp file")]
    return "".join(
        f"{_TYPES[letter]} {' '.join(at[a])} {' '.join(at[b])}\n"
        for (a, b), letter in zip(sheet.edges, sheet.assignments, strict=True)
    )
