"""A template as DXF: all pieces side by side at true scale, a layer for each kind of line. Pages are for paper."""

from __future__ import annotations

from math import sqrt

from graphs.files.patterns.dxf import DxfLayer, DxfLine, DxfWord, dxf_of
from synth.templates.lines import LOOKS, Piece, Stroke, Text
from synth.templates.marks import gauge
from synth.templates.pages import laid_out
from synth.templates.template import Template

__all__ = ["dxf_of_template"]

_BELOW = -8.0
"""Height of the gauge, millimetres; the pieces begin at 0."""
_ROW = 1.5
"""A row of pieces is so much longer than the side of a square of their boxes."""
_LAYERS = [DxfLayer(kind, look.number) for kind, look in LOOKS.items()]


def dxf_of_template(template: Template) -> str:
    """Return a template as DXF R12 in millimetres."""
    pieces = [piece.at_origin() for piece in template.pieces]
    strokes, texts = _side_by_side(pieces)
    ruler, words = gauge((0.0, _BELOW))
    lines = [DxfLine(stroke.kind, stroke.start, stroke.end) for stroke in (*strokes, *ruler)]
    named = [DxfWord("MARKS", text.at, text.words, text.size, text.middle) for text in (*texts, *words)]
    return dxf_of(_LAYERS, lines, named, remark="millimetres")


def _side_by_side(pieces: list[Piece]) -> tuple[list[Stroke], list[Text]]:
    """Return the strokes and texts of all pieces, in rows without end."""
    widest = max(piece.size[0] for piece in pieces)
    width = max(widest, _ROW * sqrt(sum(piece.size[0] * piece.size[1] for piece in pieces)))
    moved = [piece.moved(right, up) for laid in laid_out(pieces, width, float("inf")) for piece, right, up in laid]
    return [one for piece in moved for one in piece.strokes], [one for piece in moved for one in piece.texts]
