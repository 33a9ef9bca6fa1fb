"""The plane that points lie in, however it stands in space, and the points as they are seen in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphs.arrays import Floats

__all__ = ["COLLINEAR", "Flattened", "flattened", "in_one_plane"]

COLLINEAR = 1e-6
"""Points are in one line or plane if they lie this close to it, in units of their extent.

It is the tight tolerance: of hinges, coarser ones are tried too (``graphs.convert.hinges``).
"""
_NO_TILT = 1e-9
"""Components of a unit normal below this are rounding."""
_PLANES = ("yz", "xz", "xy")


@dataclass(frozen=True)
class Flattened:
    """Points in a plane.

    Attributes
    ----------
    places : array of shape (n, 2)
        Distances and the side that is seen are kept.
    turned : str
        What was done to bring them there; empty where they lay in a plane z = constant.
    """

    places: Floats
    turned: str


def in_one_plane(points: Sequence[Sequence[float]]) -> bool:
    """Tell whether points lie in one plane, but for a millionth of their extent.

    Examples
    --------
    >>> in_one_plane([(0, 0, 1), (1, 0, 1), (0, 1, 1), (5, 5, 1)])
    True
    """
    places = np.asarray(points, dtype=float)
    if places.size == 0 or places.shape[1] < 3:
        return True
    places = _of_size_one(places)
    sizes = np.linalg.svd(places - places.mean(axis=0), compute_uv=False)
    return bool(len(sizes) < 3 or sizes[2] <= COLLINEAR * sizes[0])


def flattened(points: Sequence[Sequence[float]], faces: Sequence[Sequence[int]] = ()) -> Flattened | None:
    """Return points as they are seen in their plane; None if they do not lie in one.

    Parameters
    ----------
    points : sequence of (x, y) or (x, y, z)
    faces : sequence of vertex cycles, optional
        Most of them turn counter-clockwise as they are seen. Without them, and in a plane z = constant, the
        plane is seen against its positive axis.

    Examples
    --------
    A square in the plane y = 1, seen from the side of larger y:

    >>> square = flattened([(0, 1, 0), (2, 1, 0), (2, 1, 2), (0, 1, 2)])
    >>> square.places.tolist(), square.turned
    ([[0.0, 0.0], [2.0, 0.0], [2.0, -2.0], [0.0, -2.0]], 'turned from the xz plane into the xy plane')
    """
    places = np.asarray(points, dtype=float)
    if places.size == 0 or places.shape[1] < 3 or len(set(places[:, 2].tolist())) == 1:
        return Flattened(places.reshape(len(places), -1)[:, :2], "")
    if not in_one_plane(points):
        return None
    size_one = _of_size_one(places)
    normal = _normal(size_one)
    upright = abs(normal) == 1
    if upright[2]:
        return Flattened(places[:, :2], "flattened: points were a little off the xy plane")
    if (facing := float(_area_vector(size_one, faces) @ normal)) != 0:
        normal = normal * np.sign(facing)
    along = np.eye(3)[1 if abs(normal[0]) > 0.9 else 0]
    along = along - (along @ normal) * normal
    along /= np.linalg.norm(along)
    seen: Floats = places @ np.column_stack([along, np.cross(normal, along)])
    came_from = f"the {_PLANES[int(upright.argmax())]} plane" if upright.any() else "a slanted plane"
    return Flattened(seen + 0.0, f"turned from {came_from} into the xy plane")


def _of_size_one(places: Floats) -> Floats:
    """Return points scaled so that products of their coordinates stay finite."""
    scaled: Floats = places / (float(np.abs(places).max()) or 1.0)
    return scaled


def _normal(places: Floats) -> Floats:
    """Return the unit normal whose largest component is positive; an axis where the plane stands on one."""
    for axis in (2, 1, 0):
        if not np.ptp(places[:, axis]):
            upright: Floats = np.eye(3)[axis]
            return upright
    arms = places - places.mean(axis=0)
    normal: Floats = np.linalg.eigh(arms.T @ arms)[1][:, 0]
    normal = np.where(np.abs(normal) < _NO_TILT, 0.0, normal)
    normal /= np.linalg.norm(normal) * np.sign(normal[np.abs(normal).argmax()])
    return normal


def _area_vector(places: Floats, faces: Sequence[Sequence[int]]) -> Floats:
    """Return the sum of the areas of faces, as vectors."""
    total = np.zeros(3)
    for face in faces:
        corners = places[list(face)] - places[face[0]]
        total += np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    return total
