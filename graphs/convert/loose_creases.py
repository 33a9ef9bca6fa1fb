"""Crease lines that lie on no face: the faces were given, and not by these lines.

Programs write the paper as one face and the creases on it as edges, or faces whose sides are longer than the edges
drawn along them. Where the sheet lies flat all its lines are traced. Theory: docs/theory/crease-patterns.md.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np

from graphs.mechanism.precision import flattened
from graphs.mechanism.sheet import HINGES, Edge, Sheet, sides_of_face
from graphs.types import Floats

__all__ = ["creases_on_no_face", "joins_faces", "traced_anew"]

_OVERLAP = 1e-6
"""Faces overlap if they cover less than their areas by this part."""


def creases_on_no_face(sheet: Sheet) -> int:
    """Return how many edges of hinges are no side of a face.

    >>> creases_on_no_face(Sheet(4, ((0, 2), (1, 3)), "MV", ((0, 1, 2), (0, 2, 3))))
    1
    """
    hinges = [edge for edge, letter in zip(sheet.edges, sheet.assignments, strict=True) if letter in HINGES]
    sides: set[Edge] = set()
    for face in sheet.faces:
        sides.update(zip(face, (*face[1:], *face[:1]), strict=True))
    return sum((a, b) not in sides and (b, a) not in sides for a, b in hinges)


def joins_faces(sheet: Sheet) -> bool:
    """Say whether an edge that is a hinge lies between two faces.

    >>> joins_faces(Sheet(4, ((0, 2), (1, 3)), "FV", ((0, 1, 2), (0, 2, 3))))
    False
    """
    faces_at = Counter(frozenset(side) for face in sheet.faces for side in sides_of_face(face))
    return any(
        letter in HINGES and faces_at[frozenset(edge)] > 1
        for edge, letter in zip(sheet.edges, sheet.assignments, strict=True)
    )


def traced_anew(sheet: Sheet) -> Sheet | None:
    """Trace the faces of a sheet from its edges and the sides of its faces together.

    Return None if the sheet does not lie flat, or its faces lie over each other, folded flat. The paper as one
    face, and a crease across it:

    The paper as one face, and a crease across it:

    >>> square = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
    >>> found = traced_anew(Sheet(4, ((0, 2),), "M", ((0, 1, 2, 3),), square))
    >>> len(found.faces), found.assignments.count("M")
    (2, 1)
    """
    from graphs.convert.tracing import MOST, trace_sheet  # tracing loads shapely
    from graphs.convert.welding import Lines

    if sheet.coordinates is None or any(abs(x) >= MOST for place in sheet.coordinates for x in place):
        return None
    flat = flattened(sheet)
    if flat is None or _overlap(flat.places, sheet.faces):
        return None
    listed = {frozenset(edge) for edge in sheet.edges}
    faces_at = Counter(frozenset(side) for face in sheet.faces for side in sides_of_face(face))
    unlisted = [side for side in faces_at if side not in listed]
    letters = sheet.assignments + "".join("U" if faces_at[side] > 1 else "B" for side in unlisted)
    angles = (*(sheet.fold_angles or (None,) * len(sheet.edges)), *(None for _ in unlisted))
    ends = flat.places[np.array([*sheet.edges, *(tuple(side) for side in unlisted)])]
    found = trace_sheet(Lines(ends, letters, angles), title=sheet.title)
    turned = (flat.turned,) if flat.turned else ()
    return replace(found, repairs=(*turned, *sheet.repairs, *found.repairs), precision=sheet.precision)


def _overlap(places: Floats, faces: tuple[tuple[int, ...], ...]) -> bool:
    """Tell whether faces cover less than the sum of their areas."""
    import shapely

    polygons = np.array([shapely.Polygon(places[list(face)]) for face in faces], dtype=object)
    if not bool(shapely.is_valid(polygons).all()):
        return True
    total = float(shapely.area(polygons).sum())
    return total - float(shapely.union_all(polygons).area) > _OVERLAP * total
