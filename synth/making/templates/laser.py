"""Templates for laser cutters: outlines moved by half the kerf, and lines in layers to cut, score and engrave.

Colours are those that programs of laser cutters take by default: red is cut, blue is scored, black is engraved.
Theory: docs/theory/templates.md.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain, pairwise
from math import inf, isfinite, sqrt
from typing import Any

import shapely
from shapely.ops import polygonize

from graphs.errors import InvariantError, UnsolvableError
from synth.making.drawing.scene.shapes import Label, Layer, Line, Shape
from synth.making.drawing.scene.writing import Scene
from synth.making.templates.pages import laid_out, layers_of, strokes_and_texts
from synth.making.templates.pieces import Piece, TemplateLine, united
from synth.making.templates.template import Template

_HAIRLINE = 0.05
"""Width of lines, millimetres: programs of laser cutters take thin lines for paths."""
_ROW = 1.5
"""A row of pieces is so much longer than the side of a square of their boxes."""
LASER_LAYERS = {"CUT": ("#ff0000", 1), "SCORE": ("#0000ff", 5), "ENGRAVE": ("#000000", 7)}
"""Name of a layer to its colour, and the number of this colour in DXF, in the order in which a machine works last."""
_LAYER_OF = {"CUT": "CUT", "MOUNTAIN": "SCORE", "VALLEY": "SCORE", "CREASE": "SCORE"}
"""Kind of lines to the layer; all others are engraved, and so are texts."""
_WIDEST_KERF = 5.0
_SHARPEST = 10.0
"""A corner whose tip would reach further, in halves of the kerf, is blunted."""
_CLOSED = 1e-4
"""Millimetres within which ends of cuts meet."""
_NEAR = 1e-3
"""Millimetres within which a cut runs along an outline."""


def with_kerf(template: Template, kerf: float) -> Template:
    """Return a template whose cut parts have the stated size although the beam takes material away.

    Outlines move outward by half the kerf, holes become smaller by as much; cuts with material on both sides stay.

    Parameters
    ----------
    template : Template
    kerf : float
        Width of the cut, millimetres.

    Raises
    ------
    InvariantError
        If it is negative, or wider than 5 mm.
    UnsolvableError
        If outlines would meet: two of them are nearer than the kerf.

    Examples
    --------
    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.making.templates.template import template_of
    >>> square = Sheet(4, (), "", ((0, 1, 2, 3),), ((0, 0), (1, 0), (1, 1), (0, 1)))
    >>> [piece] = with_kerf(template_of(square, size=100), 0.2).pieces
    >>> [round(side, 6) for side in piece.size]
    [100.2, 100.2]
    """
    if not (isfinite(kerf) and 0.0 <= kerf <= _WIDEST_KERF):
        raise InvariantError("kerf", f"a kerf of {kerf:g} mm", f"0 to {_WIDEST_KERF:g} mm")
    return replace(template, pieces=tuple(_piece_with_kerf(piece, kerf) for piece in template.pieces))


def _piece_with_kerf(piece: Piece, kerf: float) -> Piece:
    cuts = [stroke for stroke in piece.strokes if stroke.kind == "CUT"]
    lines = [shapely.LineString([stroke.start, stroke.end]) for stroke in cuts]
    if not lines or not kerf:
        return piece
    whole = shapely.union_all(lines, grid_size=_CLOSED)
    closed = list(polygonize(getattr(whole, "geoms", [whole])))
    material = united([part for part in closed if _is_material(part, piece.covered)])
    grown = shapely.buffer(material, kerf / 2, join_style="mitre", mitre_limit=_SHARPEST)
    if _outlines(grown) != _outlines(material):
        raise UnsolvableError(f"a kerf of {kerf:g} mm is wider than the gap of two cuts; try a smaller --kerf")
    along = shapely.buffer(material.boundary, _NEAR)
    kept = [part for line in lines for part in _parts_of_line(line.difference(along))]
    drawn = [stroke for stroke in piece.strokes if stroke.kind != "CUT"]
    return Piece((*_outline_strokes(grown), *kept, *drawn), piece.texts, piece.covered)


def _parts_of_line(line: Any) -> Iterator[TemplateLine]:
    """Yield the straight parts of a cut that are not dots."""
    for part in getattr(line, "geoms", [line]):
        if part.length > 2 * _NEAR:
            start, end = part.coords[0], part.coords[-1]
            yield TemplateLine("CUT", (start[0], start[1]), (end[0], end[1]))


def _is_material(part: Any, covered: Any) -> bool:
    return bool(part.intersection(covered).area > part.area / 2)


def _outlines(shape: Any) -> tuple[int, int]:
    """Return how many parts and holes a shape has."""
    parts = list(getattr(shape, "geoms", [shape]))
    return len(parts), sum(len(part.interiors) for part in parts)


def _outline_strokes(shape: Any) -> Iterator[TemplateLine]:
    for part in getattr(shape, "geoms", [shape]):
        for ring in (part.exterior, *part.interiors):
            for start, end in pairwise(ring.coords):
                yield TemplateLine("CUT", (start[0], start[1]), (end[0], end[1]))


def laser_scene(template: Template) -> Scene:
    """Return all pieces of a template side by side, on no page, in the layers of a laser cutter; millimetres."""
    pieces = [piece.at_origin() for piece in template.pieces]
    widest = max(piece.size[0] for piece in pieces)
    room = max(widest, _ROW * sqrt(sum(piece.size[0] * piece.size[1] for piece in pieces)))
    strokes, texts = strokes_and_texts(chain.from_iterable(laid_out(pieces, room, inf)))
    ends = [end for stroke in strokes for end in (stroke.start, stroke.end)]
    width, height = (max(end[axis] for end in ends) for axis in (0, 1))
    shapes: dict[str, list[Shape]] = {name: [] for name in LASER_LAYERS}
    for layer in layers_of(strokes, texts, height, LASER_LAYERS["ENGRAVE"][0]):
        name = _LAYER_OF.get(layer.name, "ENGRAVE")
        shapes[name] += [_burnt(shape, LASER_LAYERS[name][0]) for shape in layer.shapes]
    layers = [Layer(name, tuple(shapes[name])) for name in reversed(LASER_LAYERS) if shapes[name]]
    return Scene(width, height, tuple(layers), title=template.title, unit="mm")


def _burnt(shape: Shape, colour: str) -> Shape:
    """Return a line or text in the colour of its layer, lines thin and without dashes."""
    if isinstance(shape, Line):
        return replace(shape, colour=colour, width=_HAIRLINE, dash=())
    return replace(shape, colour=colour) if isinstance(shape, Label) else shape
