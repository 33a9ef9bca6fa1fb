"""A sheet that lies flat as a piece: which of its edges are cut and which folded."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from itertools import pairwise
from typing import Any

import numpy as np
import shapely
from scipy.spatial import cKDTree

from graphs.errors import numbered
from graphs.mechanism.sheet import Sheet, sides_of_face
from graphs.types import Floats
from synth.templates.lines import Kind, Piece, Point, Stroke
from synth.templates.pieces.cuts import cut_once
from synth.templates.pieces.overlaps import united

__all__ = ["FOLDS", "is_laid_out", "piece_of_flat_sheet", "put_together"]

_SLIT = 1e-6
"""Millimetres: corners so near to each other are one; square ones: what is no larger is no area."""
_OVERLAP = 1e-6
"""Panels lie side by side if no more than this part of their area is covered twice."""
_GRID = 1e-10
"""Of the extent: overlays in floating point can lose a panel, on a grid they do not."""
FOLDS: dict[str, Kind] = {"M": "MOUNTAIN", "V": "VALLEY", "U": "CREASE"}
"""Assignment of a hinge to the kind of its stroke."""


def is_laid_out(sheet: Sheet, places: Floats) -> bool:
    """Say whether the panels of a sheet, at places float[vertices, 2], lie side by side, none over another.

    >>> import numpy as np
    >>> folded = Sheet(4, (), "", ((0, 1, 2), (2, 1, 3)))
    >>> is_laid_out(folded, np.array([[0, 0], [1, 0], [0, 1], [1, 1.0]]))
    True
    >>> is_laid_out(folded, np.array([[0, 0], [1, 0], [0, 1], [0.1, 0.1]]))
    False
    """
    polygons = [shapely.Polygon(places[list(face)]) for face in sheet.faces]
    each = float(sum(polygon.area for polygon in polygons))
    grid = _GRID * float(np.ptp(places, axis=0).max())
    return each - float(shapely.union_all(polygons, grid_size=grid).area) <= _OVERLAP * each


def piece_of_flat_sheet(sheet: Sheet, places: Floats) -> tuple[Piece, tuple[str, ...]]:
    """Return a sheet as one piece, and what its strokes do not show.

    All edges of the sheet are listed; the places are float[vertices, 2], millimetres.
    """
    faces = Counter(frozenset(side) for face in sheet.faces for side in sides_of_face(face))
    strokes, flat, loose, seen = [], 0, 0, set()
    for edge, letter in zip(sheet.edges, sheet.assignments, strict=True):
        pair = frozenset(edge)
        if pair in seen:
            continue
        seen.add(pair)
        kind = _kind(letter, faces[pair])
        if kind is not None:
            start, end = (_point(places[vertex]) for vertex in edge)
            strokes.append(Stroke(kind, start, end))
        elif faces[pair]:
            flat += 1
        else:
            loose += 1
    polygons = [shapely.Polygon(places[list(face)]) for face in sheet.faces]
    told = [numbered(flat, "flat edge")] if flat else []
    told += [f"{numbered(loose, 'line')} between no panels"] if loose else []
    return Piece(tuple(cut_once(strokes)), (), put_together(polygons)), tuple(told)


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

    >>> put_together([shapely.box(0, 0, 9, 9), shapely.box(9 + 1e-12, 0, 20, 9)]).geom_type
    'Polygon'
    """
    rings = [np.array(polygon.exterior.coords)[:-1] for polygon in polygons]
    corners = np.concatenate(rings)
    near = cKDTree(corners).query_ball_point(corners, _SLIT)
    same = corners[[min(places) for places in near]]
    ends = np.cumsum([0, *map(len, rings)])
    area = united([shapely.Polygon(same[a:b]) for a, b in pairwise(ends)])
    parts = [part for part in getattr(area, "geoms", [area]) if part.area > _SLIT]
    return parts[0] if len(parts) == 1 else shapely.MultiPolygon(parts)


def _point(place: Floats) -> Point:
    return float(place[0]), float(place[1])
