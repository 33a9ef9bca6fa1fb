"""Crease patterns as DXF: lines by the names of their layers, or else by their colours.

Names that say what a line is are known in the forms that drawing programs and paper cutters use. Other names say
nothing, and the colour counts, and the legend (:mod:`graphs.files.patterns.legend`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from graphs.convert.tracing import MOST
from graphs.convert.welding import Lines
from graphs.errors import FileError, UnsolvableError
from graphs.files.check import Checker
from graphs.files.patterns.dxf.colours import rgb_of_number
from graphs.files.patterns.dxf.records import Record, records
from graphs.files.patterns.dxf.shapes import drawn_shapes
from graphs.files.patterns.dxf.written import DxfLayer, DxfLine, dxf_of
from graphs.files.patterns.legend import LEFT_OUT, UNSTATED, Legend
from graphs.files.patterns.strokes import Dash, Stroke, dash_of_line_type
from graphs.files.patterns.traced import traced_sheet
from graphs.files.text import read_text
from graphs.mechanism.precision import flat_places
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.printing import plain

__all__ = ["dxf_text", "sheet_from_dxf"]

_NAMES = {
    "B": "border borders boundary outline edge edges contour",
    "C": "cut cuts cutting",
    "M": "mountain mountains mountain_folds m",
    "V": "valley valleys valley_folds v",
    "F": "flat facet auxiliary aux",
    "J": "join joins",
    "U": "crease creases fold folds score hinge unassigned",
}
_LETTERS = {name: letter for letter, names in _NAMES.items() for name in names.split()}
_NOTES = ("TEXT", "MTEXT", "DIMENSION", "LEADER", "POINT", "HATCH", "VIEWPORT", "ATTDEF", "IMAGE")
"""Records that are no lines of a drawing, and are not missed."""
_WRITTEN = {
    "B": DxfLayer("BORDER", 7),
    "C": DxfLayer("CUT", 3),
    "M": DxfLayer("MOUNTAIN", 1),
    "V": DxfLayer("VALLEY", 5),
    "F": DxfLayer("FLAT", 2),
    "J": DxfLayer("JOIN", 2),
    "U": DxfLayer("UNASSIGNED", 6),
}
_BY_BLOCK, _BY_LAYER = 0, 256
_PAPER_SPACE = 67
_LONGEST = 40


@dataclass(frozen=True, slots=True)
class _Layer:
    """What shapes of a layer take from it."""

    colour: int
    line_type: str


_PLAIN = _Layer(7, "CONTINUOUS")


def sheet_from_dxf(path: Path, legend: Legend = UNSTATED) -> Sheet:
    """Read the lines of a DXF file and trace its faces; the legend says what strokes are, where that was stated.

    A FileError names the record, or why the lines make no pattern (:mod:`graphs.files.patterns.traced`).
    """
    check = Checker(path)
    held = list(records(read_text(path), path))
    layers = {
        one.word(2): _Layer(one.whole(62, 7), one.word(6, "CONTINUOUS"))
        for one in held
        if (one.section, one.name) == ("TABLES", "LAYER")
    }
    drawn = list(drawn_shapes([one for one in held if one.section == "ENTITIES"]))
    strokes = [_stroke(record, layers.get(record.word(8), _PLAIN), pieces) for record, pieces in drawn]
    understood = check.build(lambda: legend.understood(strokes))
    ends: list[tuple[tuple[float, float], tuple[float, float]]] = []
    letters = ""
    for (_, pieces), letter in zip(drawn, understood.letters, strict=True):
        if pieces is not None and letter is not None and letter != LEFT_OUT:
            ends += pieces
            letters += letter * len(pieces)
    array = np.array(ends, dtype=float).reshape(-1, 2, 2)
    if not np.all(np.abs(array) < MOST):
        raise FileError(path, "", "an arc that is too large", "coordinates")
    border = "border lines (a layer CUT or BORDER, or black)"
    return traced_sheet(Lines(array, letters), check, border=border, understood=understood)


def _stroke(record: Record, layer: _Layer, pieces: Sequence[object] | None) -> Stroke:
    """Return how a record looks: of no colour, and no line to be missed, what is hidden or a note."""
    colour, name = _colour(record, layer), record.word(8, "0")
    kind = _kind(record, layer, shape=pieces is not None)
    hidden = colour < 0 or record.whole(_PAPER_SPACE, 0) != 0
    if hidden or pieces is None:
        return Stroke(None, kind=kind, lines=int(not hidden and record.name not in _NOTES))
    true = record.whole(420, -1)
    rgb = (true >> 16 & 255, true >> 8 & 255, true & 255) if true >= 0 else rgb_of_number(colour)
    letter = _LETTERS.get(name.lower())
    return Stroke(rgb, _dash(record, layer), (name,), None if true >= 0 else colour, letter, kind, len(pieces))


def _colour(record: Record, layer: _Layer) -> int:
    """Return the number of a shape's colour; below zero its layer is off."""
    colour = record.whole(62, _BY_LAYER)
    if layer.colour < 0:
        return layer.colour
    return {_BY_LAYER: layer.colour, _BY_BLOCK: _PLAIN.colour}.get(colour, colour)


def _dash(record: Record, layer: _Layer) -> Dash:
    own = record.word(6, "BYLAYER").upper()
    return dash_of_line_type(layer.line_type if own == "BYLAYER" else own)


def _kind(record: Record, layer: _Layer, *, shape: bool) -> str:
    """Return how a record that was left out looks, for messages."""
    name = plain(record.name, _LONGEST)
    if not shape:
        return name
    dash = _dash(record, layer)
    if dash != "solid":
        name = f"{dash} {name}"
    return f"{name} of colour {_colour(record, layer)} on layer {plain(record.word(8, '0'), _LONGEST)}"


def dxf_text(sheet: Sheet) -> str:
    """Return the DXF text (R12) of a flat sheet, a layer for each assignment.

    Raise UnsolvableError if the sheet has no coordinates, does not lie in a plane, or has no line.

    >>> text = dxf_text(Sheet(2, ((0, 1),), "M", (), ((0.0, 0.0), (1.0, 0.5))))
    >>> text.split("ENTITIES")[1].split()[:4]
    ['0', 'LINE', '8', 'MOUNTAIN']
    """
    places = flat_places(sheet, "a DXF crease pattern")
    if not (sheet.edges or sheet.faces):
        raise UnsolvableError("a DXF crease pattern needs lines, and the sheet has none")
    sheet = with_all_edges(sheet)
    lines = [
        DxfLine(_WRITTEN[letter].name, places[a], places[b])
        for (a, b), letter in zip(sheet.edges, sheet.assignments, strict=True)
    ]
    return dxf_of(list(_WRITTEN.values()), lines)
