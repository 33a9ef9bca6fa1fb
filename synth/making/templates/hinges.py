"""Folds of thick material: strips of a stated width in their place, creased twice, cut in rows, or left out.

A strip of half the width is taken off each panel along its folds. What is between two panels then is bent along
both sides (offset creases, after J. S. Ku and E. D. Demaine, *Journal of Mechanisms and Robotics* 8, 2016), or
made soft by rows of cuts (a living hinge), or is not there (a gap). Theory: docs/theory/templates.md.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, isfinite
from typing import Any, Literal, get_args

import numpy as np
import shapely

from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.types import Floats
from synth.making.templates import pieces

HingeKind = Literal["offset", "living", "gap"]
_STRAIGHT = 5e-7
"""Corners this close to a straight line, in millimetres, are none."""
_THIN = 1e-5
"""Millimetres: a fold of this width separates panels without changing them."""
_SPECK = 1e-3
"""Square millimetres: smaller areas are not parts of a panel."""
_ROWS_APART, _CUT, _BRIDGE = 2.0, 15.0, 2.5
"""Living hinge, in millimetres: distance between rows, and approximate length of a cut and of a bridge."""
_LETTERS: dict[pieces.Kind, str] = {"MOUNTAIN": "M", "VALLEY": "V"}
_CLEAR = 1.8
"""Millimetres from the middle of a letter to the nearest cut."""


@dataclass(frozen=True)
class Hinges:
    """Hinges in place of folds, for thick material.

    Attributes
    ----------
    kind : {"offset", "living", "gap"}
        Two folds per crease, rows of cuts, or panels apart.
    width : float
        Millimetres, positive.

    Examples
    --------
    >>> Hinges("living", 8.0).width
    8.0
    """

    kind: HingeKind
    width: float

    def __post_init__(self) -> None:
        if self.kind not in get_args(HingeKind):
            raise InvariantError("hinges", f"hinges {shown(self.kind)}", ", ".join(get_args(HingeKind)))
        if not (isfinite(self.width) and self.width > 0):
            raise InvariantError("hinges", f"a width of {self.width!r} mm", "a positive number")


@dataclass(frozen=True)
class _Strip:
    """The strip between two panels in place of a fold, from `first` to `last` along it, in millimetres."""

    fold: pieces.TemplateLine
    start: Floats
    along: Floats
    off: Floats
    width: float
    first: float
    last: float

    def at(self, along: float, across: float) -> pieces.Point:
        """Return a place by millimetres along the fold, and by half widths across it."""
        return pieces.point_of(self.start + along * self.along + across * self.width / 2 * self.off)

    def line(self, kind: pieces.Kind, across: float, first: float, last: float) -> pieces.TemplateLine:
        """Return a line along the fold."""
        return pieces.TemplateLine(kind, self.at(first, across), self.at(last, across))

    def sides(self) -> list[pieces.TemplateLine]:
        """Return its borders with the panels."""
        return [self.line(self.fold.kind, across, self.first, self.last) for across in (-1, 1)]

    def ends(self) -> list[pieces.TemplateLine]:
        """Return the cuts at its ends."""
        return [pieces.TemplateLine("CUT", self.at(along, -1), self.at(along, 1)) for along in (self.first, self.last)]

    def polygon(self) -> Any:
        """Return its area."""
        return shapely.Polygon([end for side in self.ends() for end in (side.start, side.end)]).convex_hull


def with_hinges(piece: pieces.Piece, met: Sequence[pieces.TemplateLine], hinges: Hinges) -> pieces.Piece:
    """Return a piece with strips in the place of its folds.

    `met` are the edges that meet others when it is put together; a gap is left there too. Raise UnsolvableError if
    a panel is narrower than the hinges, or a fold too short for one.
    """
    folds = [stroke for stroke in piece.strokes if stroke.kind not in ("CUT", "MARKS")]
    apart = [*folds, *met] if hinges.kind == "gap" else folds
    if not apart:
        return piece
    panels = _panels(piece, apart, hinges.width)
    strips = [] if hinges.kind == "gap" else _all_strips(folds, panels, hinges)
    cuts = _cuts(piece, panels, strips)
    more = [line for strip in strips for line in (strip.sides() if hinges.kind == "offset" else _rows(strip))]
    words = [] if hinges.kind == "offset" else list(_letters(folds, strips, [*cuts, *more]))
    marks = [stroke for stroke in piece.strokes if stroke.kind == "MARKS"]
    covered = pieces.united([*panels, *(strip.polygon() for strip in strips)])
    return pieces.Piece((*pieces.cut_once(cuts), *more, *marks), (*piece.texts, *words), covered)


def _panels(piece: pieces.Piece, lines: Sequence[pieces.TemplateLine], width: float) -> list[Any]:
    """Return the panels without the strips at their own hinges; each must remain in one part."""
    every = [shapely.LineString([line.start, line.end]) for line in lines]
    parted = pieces.united(shapely.buffer(every, _THIN, cap_style="square"))
    panels = []
    for part in _parts(shapely.difference(piece.covered, parted, grid_size=pieces.GRID)):
        wider = part.buffer(2 * _THIN, join_style="mitre")
        panel = shapely.intersection(wider, piece.covered, grid_size=pieces.GRID)
        own = [line for line in every if line.intersection(panel).length > line.length / 10]
        strips = pieces.united(shapely.buffer(own, width / 2, cap_style="square"))
        left = _parts(shapely.difference(panel, strips, grid_size=pieces.GRID).simplify(_STRAIGHT))
        if len(left) != 1:
            raise UnsolvableError(
                f"a panel has no room for hinges of {width:g} mm; try a smaller --hinge-width or a larger --size"
            )
        panels += left
    return panels


def _parts(shape: Any) -> list[Any]:
    return [part for part in getattr(shape, "geoms", [shape]) if part.area > _SPECK]


def _all_strips(folds: Sequence[pieces.TemplateLine], panels: Sequence[Any], hinges: Hinges) -> list[_Strip]:
    rings = [ring for panel in panels for ring in (panel.exterior, *panel.interiors)]
    sides = np.array([ends for ring in rings for ends in pairwise(ring.coords)]).reshape(-1, 2, 2)
    strips = [strip for fold in folds for strip in _strips(fold, sides, hinges)]
    areas = [strip.polygon() for strip in strips]
    together = float(pieces.united(areas).area)
    if sum(area.area for area in areas) - together > _SPECK:
        raise UnsolvableError(f"hinges of {hinges.width:g} mm overlap; try a smaller --hinge-width, or a larger --size")
    return strips


def _strips(fold: pieces.TemplateLine, sides: Floats, hinges: Hinges) -> Iterator[_Strip]:
    """Yield the strips of a fold: where it has a panel on both sides."""
    start, end = np.array(fold.start), np.array(fold.end)
    length = float(np.linalg.norm(end - start))
    along = (end - start) / length
    off = np.array([-along[1], along[0]])
    width, least = hinges.width, 3 * _BRIDGE if hinges.kind == "living" else _SPECK
    beside = [pieces.spans_on(start + side * width / 2 * off, along, sides) for side in (-1, 1)]
    there = pieces.common_spans(
        [(0.0, length)], pieces.common_spans(*beside)
    )  # another fold may go on in the same line
    spans = [span for span in there if span[1] - span[0] > least]
    if not spans:
        raise UnsolvableError(
            f"a fold of {length:.3g} mm is too short for a hinge {width:g} mm wide; try a smaller --hinge-width"
        )
    for first, last in spans:
        yield _Strip(fold, start, along, off, width, first, last)


def _cuts(piece: pieces.Piece, panels: Sequence[Any], strips: Sequence[_Strip]) -> list[pieces.TemplateLine]:
    """Return the outlines of panels except at strips, the slits, and the ends of strips."""
    joined = np.array([(side.start, side.end) for strip in strips for side in strip.sides()]).reshape(-1, 2, 2)
    cuts = []
    for panel in panels:
        for ring in (panel.exterior, *panel.interiors):
            for start, end in pairwise(ring.coords):
                cuts += pieces.uncovered(pieces.TemplateLine("CUT", start, end), joined)
    removed = shapely.difference(piece.covered, pieces.united(panels), grid_size=pieces.GRID)
    border = piece.covered.boundary.buffer(_THIN, cap_style="square")
    for stroke in piece.strokes:
        line = shapely.LineString([stroke.start, stroke.end])
        if stroke.kind == "CUT" and not border.covers(line):  # sides of the sheet are those of panels
            rest = line.difference(removed)
            for part in getattr(rest, "geoms", [rest]):
                cuts += [pieces.TemplateLine("CUT", start, end) for start, end in pairwise(part.coords)]
    return cuts + [end for strip in strips for end in strip.ends()]


def _rows(strip: _Strip) -> list[pieces.TemplateLine]:
    """Return the cuts of a living hinge: in rows along it, every other row shifted by half a cut."""
    rows = max(2, ceil(strip.width / _ROWS_APART))
    length = strip.last - strip.first
    count = max(1, round(length / (_CUT + _BRIDGE)))
    pitch = length / count
    cuts = []
    for row in range(rows):
        across = (2 * row + 1) / rows - 1
        bridges = [pitch * (place + 0.5 * (row % 2)) for place in range(count + 1)]
        ends = [(0.0, bridges[0] - _BRIDGE / 2)] if row % 2 else []
        ends += [(here + _BRIDGE / 2, min(after - _BRIDGE / 2, length)) for here, after in pairwise(bridges)]
        cuts += [strip.line("CUT", across, strip.first + start, strip.first + end) for start, end in ends]
    return cuts


def _letters(
    folds: Sequence[pieces.TemplateLine], strips: Sequence[_Strip], cuts: Sequence[pieces.TemplateLine]
) -> Iterator[pieces.Text]:
    """Yield the letters of folds that are not lines any more: beside a strip, where no cut crosses them if possible."""
    lines = shapely.union_all([shapely.LineString([cut.start, cut.end]) for cut in cuts])
    strip_of = {id(strip.fold): strip for strip in strips}
    for fold in folds:
        letter = _LETTERS.get(fold.kind)
        if letter is None:
            continue
        (ax, ay), (bx, by) = fold.start, fold.end
        places = [((ax + bx) / 2, (ay + by) / 2)]
        if id(fold) in strip_of:
            strip, size = strip_of[id(fold)], pieces.Text((0.0, 0.0), letter).size
            off = 1.0 + 1.5 * size / strip.width  # in halves of the width
            parts = (0.5, 0.35, 0.65, 0.2, 0.8)
            places = [
                strip.at(strip.first + part * (strip.last - strip.first), side * off)
                for part in parts
                for side in (1, -1)
            ]
        clear = [place for place in places if shapely.Point(place).distance(lines) > _CLEAR]
        yield pieces.Text((clear or places)[0], letter)
