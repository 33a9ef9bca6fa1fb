"""Lines and pieces of a template, in millimetres: looks of lines, cuts made once, overlays, flat sheets."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, Literal

import numpy as np
import shapely
from scipy.spatial import cKDTree

from graphs.errors import numbered
from graphs.mechanism.sheet import Sheet, sides_of_face
from graphs.types import Floats

Point = tuple[float, float]
Kind = Literal["CUT", "MOUNTAIN", "VALLEY", "CREASE", "MARKS"]


@dataclass(frozen=True, slots=True)
class Look:
    """The look of strokes of a kind.

    `colour` is ``#rrggbb`` (for cuts and folds, the colours by which crease patterns are read: docs/files.md),
    `number` the colour's number in DXF. `width` is in millimetres, as are the dashes and gaps, in turn, of `dash`
    (empty for a full line); `meaning` is for the foot of a page.
    """

    colour: str
    number: int
    width: float
    dash: tuple[float, ...]
    meaning: str


LOOKS: dict[Kind, Look] = {
    "CUT": Look("#000000", 7, 0.3, (), "black: cut"),
    "MOUNTAIN": Look("#ff0000", 1, 0.25, (4, 1, 0.6, 1), "red, dash and dot: mountain, away from you"),
    "VALLEY": Look("#0000ff", 5, 0.25, (3, 1.5), "blue, dashes: valley, towards you"),
    "CREASE": Look("#ff00ff", 6, 0.25, (1, 1), "magenta, dots: fold, either way"),
    "MARKS": Look("#808080", 8, 0.15, (), ""),
}
"""Kind of stroke to its look, in the order in which they are drawn; the kind is the name of its layer.

Marks are grey, which no reader of crease patterns takes for a line of the pattern.
"""


@dataclass(frozen=True, slots=True)
class TemplateLine:
    """A straight line of a template, millimetres."""

    kind: Kind
    start: Point
    end: Point

    def moved(self, right: float, up: float) -> TemplateLine:
        """Return the stroke elsewhere."""
        return TemplateLine(self.kind, *((x + right, y + up) for x, y in (self.start, self.end)))

    def turned(self) -> TemplateLine:
        """Return the stroke turned by a quarter, counter-clockwise about the origin."""
        return TemplateLine(self.kind, *((-y, x) for x, y in (self.start, self.end)))


@dataclass(frozen=True, slots=True)
class Text:
    """A word on a template: where its left end is, or its middle, its middle height, and its size, millimetres."""

    at: Point
    words: str
    size: float = 3.0
    middle: bool = True

    def moved(self, right: float, up: float) -> Text:
        """Return the word elsewhere."""
        return replace(self, at=(self.at[0] + right, self.at[1] + up))


@dataclass(frozen=True)
class Piece:
    """A part of a template that is cut out whole; `covered` is its material, a shapely geometry."""

    strokes: tuple[TemplateLine, ...]
    texts: tuple[Text, ...]
    covered: Any

    @property
    def box(self) -> tuple[float, float, float, float]:
        """The least and greatest x and y of its strokes: left, low, right, high."""
        xs, ys = zip(*(end for stroke in self.strokes for end in (stroke.start, stroke.end)), strict=True)
        return min(xs), min(ys), max(xs), max(ys)

    @property
    def size(self) -> tuple[float, float]:
        """Width and height."""
        left, low, right, high = self.box
        return right - left, high - low

    def at_origin(self) -> Piece:
        """Return the piece with the lower left corner of its box at the origin."""
        left, low, _, _ = self.box
        return self.moved(-left, -low)

    def moved(self, right: float, up: float) -> Piece:
        """Return the piece elsewhere."""
        from shapely.affinity import translate

        return Piece(
            tuple(stroke.moved(right, up) for stroke in self.strokes),
            tuple(text.moved(right, up) for text in self.texts),
            translate(self.covered, right, up),
        )

    def turned(self) -> Piece:
        """Return the piece turned by a quarter, its lower left corner at the origin."""
        from shapely.affinity import affine_transform

        return Piece(
            tuple(stroke.turned() for stroke in self.strokes),
            tuple(replace(text, at=(-text.at[1], text.at[0])) for text in self.texts),
            affine_transform(self.covered, (0, -1, 1, 0, 0, 0)),
        ).at_origin()


_NEAR = 1e-6
"""Millimetres: borders this close are one line, and shorter remainders of a line are dropped."""


def cut_once(strokes: Iterable[TemplateLine]) -> list[TemplateLine]:
    """Return strokes; of cuts, only the parts that no cut before them covers.

    A machine that cuts twice burns; knives tear.
    """
    parts: list[TemplateLine] = []
    ends: list[tuple[Point, Point]] = []
    for stroke in strokes:
        kept = [stroke]
        if stroke.kind == "CUT":
            kept = uncovered(stroke, np.array(ends).reshape(-1, 2, 2))
            ends += [(part.start, part.end) for part in kept]
        parts += kept
    return parts


def uncovered(stroke: TemplateLine, ends: Floats) -> list[TemplateLine]:
    """Return the parts of a stroke, of some length, that no line covers; the lines are float[lines, 2, 2]."""
    start, end = np.array(stroke.start), np.array(stroke.end)
    length = float(np.linalg.norm(end - start))
    if length == 0:
        return []
    along = (end - start) / length
    free = _between(length, spans_on(start, along, ends))
    if free == [(0.0, length)]:
        return [stroke]
    return [TemplateLine(stroke.kind, point_of(start + a * along), point_of(start + b * along)) for a, b in free]


def spans_on(start: Floats, along: Floats, ends: Floats) -> list[tuple[float, float]]:
    """Return where lines lie on a line, as spans in millimetres from its start, in order.

    `start` and the unit vector `along` are float[2], the ends of the lines float[lines, 2, 2].
    """
    arms = ends - start
    off = np.abs(arms @ np.array([-along[1], along[0]])).max(axis=1, initial=0.0)
    spans = np.sort((arms @ along)[off <= _NEAR], axis=1)
    return sorted((float(low), float(high)) for low, high in spans)


def common_spans(
    first: Sequence[tuple[float, float]], second: Sequence[tuple[float, float]]
) -> list[tuple[float, float]]:
    """Return the spans that are in both lists, in order."""
    common = ((max(a, c), min(b, d)) for a, b in first for c, d in second)
    return sorted((low, high) for low, high in common if high - low > _NEAR)


def _between(length: float, covered: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return the parts of a line that spans leave, those of any length."""
    free, reached = [], 0.0
    for low, high in covered:
        if low - reached > _NEAR and reached < length:
            free.append((reached, min(low, length)))
        reached = max(reached, high)
    if length - reached > _NEAR:
        free.append((reached, length))
    return free


def point_of(place: Floats) -> Point:
    """Return a place, float[2], as a point."""
    return float(place[0]), float(place[1])


GRID = 1e-7
"""Millimetres, to which corners of overlays are rounded."""

_INSIDE = 1e-4
"""Millimetres by which a shape is made smaller: points this close to an edge are on it."""


def united(shapes: Sequence[Any]) -> Any:
    """Return the area that shapes cover, its corners rounded to the grid."""
    return shapely.union_all(shapely.set_precision(list(shapes), GRID), grid_size=GRID)


def lies_over(shape: Any, others: Sequence[Any]) -> bool:
    """Check whether a shapely polygon (millimetres) shares more than an edge with one of others."""
    return bool(shapely.intersects(shape.buffer(-_INSIDE), list(others)).any())


def lies_within(shape: Any, area: Any) -> bool:
    """Check whether a shape lies within an area, up to its edge."""
    return bool(shapely.covers(area, shape.buffer(-_INSIDE)))


_SLIT = 1e-6
"""Millimetres: corners this near to each other are one. Square millimetres: smaller areas are dropped."""
_OVERLAP = 1e-6
"""Panels lie side by side if no more than this part of their area is covered twice."""
_GRID = 1e-10
"""In units of the extent: overlays in floating point can lose a panel, on a grid they do not."""
FOLDS: dict[str, Kind] = {"M": "MOUNTAIN", "V": "VALLEY", "U": "CREASE"}
"""Assignment of a hinge to the kind of its stroke."""


def is_laid_out(sheet: Sheet, places: Floats) -> bool:
    """Check whether the panels of a sheet, at places float[vertices, 2], lie side by side, none over another."""
    polygons = [shapely.Polygon(places[list(face)]) for face in sheet.faces]
    each = float(sum(polygon.area for polygon in polygons))
    grid = _GRID * float(np.ptp(places, axis=0).max())
    return each - float(shapely.union_all(polygons, grid_size=grid).area) <= _OVERLAP * each


def piece_of_flat_sheet(sheet: Sheet, places: Floats) -> tuple[Piece, tuple[str, ...]]:
    """Return a sheet as one piece, and what its strokes do not show.

    All edges of the sheet are listed; the places are float[vertices, 2], millimetres.
    """
    faces = Counter(frozenset(side) for face in sheet.faces for side in sides_of_face(face))
    strokes, flat, loose = [], 0, 0
    for number, letter in edges_once(sheet):
        start, end = sheet.edges[number]
        at = faces[frozenset((start, end))]
        if kind := _kind(letter, at):
            strokes.append(TemplateLine(kind, point_of(places[start]), point_of(places[end])))
        elif at:
            flat += 1
        else:
            loose += 1
    polygons = [shapely.Polygon(places[list(face)]) for face in sheet.faces]
    not_shown = [numbered(flat, "flat edge")] if flat else []
    not_shown += [f"{numbered(loose, 'line')} between no panels"] if loose else []
    return Piece(tuple(cut_once(strokes)), (), put_together(polygons)), tuple(not_shown)


def edges_once(sheet: Sheet) -> list[tuple[int, str]]:
    """Return the edges by their numbers, each pair of vertices once, with their letters."""
    first: dict[frozenset[int], int] = {}
    for number, edge in enumerate(sheet.edges):
        first.setdefault(frozenset(edge), number)
    return [(number, sheet.assignments[number]) for number in first.values()]


def _kind(letter: str, faces: int) -> Kind | None:
    """Return the kind of an edge by its letter and the number of panels at it; None is not drawn."""
    if letter == "C" or faces == 1 or (letter == "B" and faces):
        return "CUT"
    return FOLDS.get(letter) if faces else None


def put_together(polygons: Iterable[Any]) -> Any:
    """Return the area that polygons cover, without the slits that rounding leaves between them.

    Corners as good as equal are made equal, each the first of its kind. Rounding them to a grid would not do: one
    corner of two polygons can be rounded two ways. Nor would making all wider and the whole narrower again: there
    GEOS now and then leaves nothing.
    """
    rings = [np.array(polygon.exterior.coords)[:-1] for polygon in polygons]
    corners = np.concatenate(rings)
    near = cKDTree(corners).query_ball_point(corners, _SLIT)
    same = corners[[min(places) for places in near]]
    ends = np.cumsum([0, *map(len, rings)])
    area = united([shapely.Polygon(same[a:b]) for a, b in pairwise(ends)])
    parts = [part for part in getattr(area, "geoms", [area]) if part.area > _SLIT]
    return parts[0] if len(parts) == 1 else shapely.MultiPolygon(parts)
