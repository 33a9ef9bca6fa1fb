"""Faces of a sheet as it is read: creases on none of them, traced anew, refused where one crosses itself.

Files written by hand or by several programs have creases that are no side of a face. Where the sheet lies flat all
its lines are traced. A face that crosses itself is refused: a panel has an inside. Theory:
docs/theory/crease-patterns.md.
"""

from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from graphs.errors import InvariantError
from graphs.mechanism.precision import flattened
from graphs.mechanism.sheet import COLLINEAR, HINGES, Sheet, sides_of_face
from graphs.types import Floats

# Part of the area of all faces. Drawn coordinates of six digits make neighbours overlap by slivers of this size; a face
# that truly covers another covers far more.
_OVERLAP = 1e-6


def creases_on_no_face(sheet: Sheet) -> int:
    """Return how many edges of hinges are no side of a face."""
    hinges = [edge for edge, letter in zip(sheet.edges, sheet.assignments, strict=True) if letter in HINGES]
    sides = {side for face in sheet.faces for side in sides_of_face(face)}
    return sum((a, b) not in sides and (b, a) not in sides for a, b in hinges)


def joins_faces(sheet: Sheet) -> bool:
    """Say whether an edge that is a hinge lies between two faces."""
    faces_at = Counter(frozenset(side) for face in sheet.faces for side in sides_of_face(face))
    return any(
        letter in HINGES and faces_at[frozenset(edge)] > 1
        for edge, letter in zip(sheet.edges, sheet.assignments, strict=True)
    )


def traced_anew(sheet: Sheet) -> Sheet | None:
    """Trace the faces of a sheet anew; None if it does not lie flat, or its faces lie over each other."""
    from graphs.convert.tracing import MOST, Lines, trace_sheet  # tracing loads shapely

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
    traced = trace_sheet(Lines(ends, letters, angles), title=sheet.title)
    turned = (flat.turned,) if flat.turned else ()
    return replace(traced, repairs=(*turned, *sheet.repairs, *traced.repairs), precision=sheet.precision)


def _overlap(places: Floats, faces: tuple[tuple[int, ...], ...]) -> bool:
    """Return whether faces cover less than the sum of their areas."""
    import shapely

    polygons = np.array([shapely.Polygon(places[list(face)]) for face in faces], dtype=object)
    if not bool(shapely.is_valid(polygons).all()):
        return True
    total = float(shapely.area(polygons).sum())
    return total - float(shapely.union_all(polygons).area) > _OVERLAP * total


def with_simple_faces(sheet: Sheet) -> Sheet:
    """Return a sheet; InvariantError with face and point for a flat one with a face that crosses itself."""
    if all(len(face) == 3 for face in sheet.faces):
        return sheet
    flat = flattened(sheet)
    if flat is None:
        return sheet
    for face in _not_convex(flat.places, sheet.faces):
        if (point := _own_crossing(flat.places[list(sheet.faces[face])])) is not None:
            place = "({:.6g}, {:.6g})".format(*point) + (" of its plane" if flat.turned else "")
            wrong = f"face {face} crosses itself at {place}"
            raise InvariantError("face", wrong, "sides that do not cross", ("faces", face))
    return sheet


def _not_convex(places: Floats, faces: tuple[tuple[int, ...], ...]) -> Iterator[int]:
    """Yield the faces that turn both ways, or more than once round; no other face can cross itself."""
    of_size: dict[int, list[int]] = defaultdict(list)
    for index, face in enumerate(faces):
        of_size[len(face)].append(index)
    of_size.pop(3, None)
    for indices in of_size.values():
        corners = places[np.array([faces[index] for index in indices])]
        side = np.roll(corners, -1, axis=1) - corners
        size = np.abs(side).max(axis=(1, 2), keepdims=True)
        side = side / np.where(size > 0, size, 1.0)
        after = np.roll(side, -1, axis=1)
        turn = np.arctan2(side[..., 0] * after[..., 1] - side[..., 1] * after[..., 0], (side * after).sum(axis=-1))
        one_way = (turn >= 0).all(axis=1) | (turn <= 0).all(axis=1)
        once = np.abs(turn.sum(axis=1)) < 3 * np.pi
        yield from np.array(indices)[~(one_way & once)].tolist()


def _own_crossing(corners: Floats) -> Floats | None:
    """Return a point where two sides of a polygon cross away from their ends."""
    import shapely

    from graphs.convert.tracing import crossings

    if shapely.Polygon(corners).is_valid:
        return None
    ends = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
    meetings = crossings(ends, COLLINEAR * float(np.ptp(corners, axis=0).max()))
    return meetings[0] if len(meetings) else None
