"""The plane that a sheet lies in, however it stands in space, and the sheet as it is seen in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphs.arrays import Floats
from graphs.errors import UnsolvableError
from graphs.geometry import across, best_plane, unit
from graphs.mechanism.precision import extent_of, off_plane, precision_as_written
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE, Tolerances

__all__ = ["Flattened", "flat_places", "flattened", "in_space", "lies_flat"]

_WHOLE = 1e15
"""Numbers as large have no decimals to be rounded."""
_PLANES = ("yz", "xz", "xy")


@dataclass(frozen=True)
class Flattened:
    """A sheet in the plane, float[n, 2]: distances and the side that is seen are kept.

    `turned` says what was done to bring the vertices there; it is empty where they lay in a plane z = constant.
    """

    places: Floats
    turned: str


def in_space(coordinates: Sequence[Sequence[float]]) -> Floats:
    """Return points in space, float[n, 3]: z is 0 where the coordinates, in any unit of length, have none.

    >>> in_space([(1, 2), (3, 4)]).tolist()
    [[1.0, 2.0, 0.0], [3.0, 4.0, 0.0]]
    """
    points = np.zeros((len(coordinates), 3))
    if len(coordinates):
        points[:, : len(coordinates[0])] = coordinates
    return points


def lies_flat(sheet: Sheet) -> bool:
    """Return whether a sheet lies in one plane, as far as its coordinates are precise.

    >>> lies_flat(Sheet(4, (), "", ((0, 1, 2, 3),), ((0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1))))
    True
    """
    return flattened(sheet) is not None


def flattened(sheet: Sheet) -> Flattened | None:
    """Return a sheet as it is seen in its plane; None if it does not lie in one, or has no coordinates.

    Seen is the side on which most faces turn counter-clockwise. A sheet without faces, or in a plane z = constant,
    is seen against the positive axis.

    Examples
    --------
    A square in the plane y = 1, its face seen from the side of smaller y:

    >>> square = flattened(Sheet(4, (), "", ((0, 1, 2, 3),), ((0, 1, 0), (2, 1, 0), (2, 1, 2), (0, 1, 2))))
    >>> square.places.tolist(), square.turned
    ([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]], 'turned from the xz plane into the xy plane')
    """
    if sheet.coordinates is None:
        return None
    places = np.asarray(sheet.coordinates, dtype=float)
    if places.size == 0 or places.shape[1] < 3 or len(set(places[:, 2].tolist())) == 1:
        return Flattened(places.reshape(len(places), -1)[:, :2], "")
    size = float(np.abs(places).max())
    scaled = places / size  # products of coordinates stay finite
    normal = _normal_of_sheet(sheet, places, scaled)
    if normal is None:
        return None
    upright = abs(normal) == 1
    if upright[2]:
        return Flattened(places[:, :2], "flattened: points were a little off the xy plane")
    if (facing := float(_area_vector(scaled, sheet.faces) @ normal)) != 0:
        normal = normal * np.sign(facing)
    along = unit(across(np.eye(3)[1 if abs(normal[0]) > 0.9 else 0], normal))
    seen: Floats = places @ np.column_stack([along, np.cross(normal, along)])
    came_from = f"the {_PLANES[int(upright.argmax())]} plane" if upright.any() else "a slanted plane"
    return Flattened(seen + 0.0, f"turned from {came_from} into the xy plane")


def flat_places(sheet: Sheet, what: str) -> list[tuple[float, float]]:
    """Return the coordinates of a sheet as they are seen in its plane, for a format that is flat.

    Raises `UnsolvableError` if the sheet has none, or does not lie in a plane.

    >>> flat_places(Sheet(1, (), "", (), ((1.0, 2.0, 0.0),)), "a picture")
    [(1.0, 2.0)]
    """
    if sheet.coordinates is None:
        raise UnsolvableError(f"{what} needs coordinates, and the sheet has none")
    flat = flattened(sheet)
    if flat is None:
        raise UnsolvableError(f"{what} is flat, and the sheet is not")
    return [(x, y) for x, y in flat.places.tolist()]


def _normal_of_sheet(sheet: Sheet, places: Floats, scaled: Floats) -> Floats | None:
    """Return the normal of the plane that a sheet lies in, None if in none; precision matters off an axis only."""
    still = np.flatnonzero(places.min(axis=0) == places.max(axis=0))
    if len(still):
        upright: Floats = np.eye(3)[still[-1]]
        return upright
    has_decimals = np.abs(places).max() <= _WHOLE
    tolerance = Tolerances.of(precision_as_written(sheet).size).flat if has_decimals else DOUBLE.flat
    return None if off_plane(scaled) > tolerance else _normal(scaled, tolerance)


def _normal(places: Floats, tolerance: float) -> Floats:
    """Return the unit normal whose largest component is positive; an axis where the plane stands on one."""
    for axis in (2, 1, 0):
        if np.ptp(places[:, axis]) <= tolerance * extent_of(places):
            upright: Floats = np.eye(3)[axis]
            return upright
    return best_plane(places).direction


def _area_vector(places: Floats, faces: Sequence[Sequence[int]]) -> Floats:
    """Return the sum of the areas of faces, as vectors."""
    starts = np.array([vertex for face in faces for vertex in face], dtype=np.int64)
    ends = np.array([vertex for face in faces for vertex in (*face[1:], face[0])], dtype=np.int64)
    middle = places.mean(axis=0)
    total: Floats = np.cross(places[starts] - middle, places[ends] - middle).sum(axis=0)
    return total
