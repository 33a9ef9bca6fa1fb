"""Faces that cross themselves refused: a panel has an inside."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

import numpy as np

from graphs.errors import InvariantError
from graphs.mechanism.precision import flattened
from graphs.mechanism.sheet import COLLINEAR, Sheet
from graphs.types import Floats

__all__ = ["with_simple_faces"]


def with_simple_faces(sheet: Sheet) -> Sheet:
    """Return a sheet; refuse a flat one with a face that crosses itself, by an InvariantError with face and point.

    Faces of sheets that do not lie flat need not be planar, and pass.

    >>> square = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
    >>> with_simple_faces(Sheet(4, (), "", ((0, 1, 3, 2),), square))
    Traceback (most recent call last):
    ...
    graphs.errors.InvariantError: face 0 crosses itself at (0.5, 0.5); expected sides that do not cross [face]
    """
    if all(len(face) == 3 for face in sheet.faces):
        return sheet
    flat = flattened(sheet)
    if flat is None:
        return sheet
    for face in _not_convex(flat.places, sheet.faces):
        if (point := _own_crossing(flat.places[list(sheet.faces[face])])) is not None:
            place = "({:.6g}, {:.6g})".format(*point) + (" of its plane" if flat.turned else "")
            found = f"face {face} crosses itself at {place}"
            raise InvariantError("face", found, "sides that do not cross", ("faces", face))
    return sheet


def _not_convex(places: Floats, faces: tuple[tuple[int, ...], ...]) -> Iterator[int]:
    """Yield the faces that turn both ways, or more than once round; what does neither cannot cross itself."""
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

    from graphs.convert.welding import crossings

    if shapely.Polygon(corners).is_valid:
        return None
    ends = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
    found = crossings(ends, COLLINEAR * float(np.ptp(corners, axis=0).max()))
    return found[0] if len(found) else None
