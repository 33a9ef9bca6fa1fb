"""Things in space as an eye far away sees them, and which of their panels hide others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphs.geometry import across, principal_axes, unit
from graphs.tolerances import DOUBLE, trailing
from graphs.types import Floats

__all__ = ["View", "drawn_order", "view_from", "view_from_above", "view_of_motion"]

_EYE = np.array([0.40, 0.62, 0.68])
"""Where the eye is, along the axes in which the thing is long, less long, and short."""
_ASLANT = np.array([0.41, -0.71, 0.57])
"""Where it is when things move: 35 degrees above the ground."""


@dataclass(frozen=True, slots=True)
class View:
    """An eye far away.

    Attributes
    ----------
    right, up, towards : float[3]
        Unit vectors: of the picture, and towards the eye.
    """

    right: Floats
    up: Floats
    towards: Floats

    def places(self, points: Floats) -> Floats:
        """Return where points are seen: float[..., 2], x to the right and y upwards."""
        return np.asarray(points @ np.column_stack([self.right, self.up]))

    def near(self, points: Floats) -> Floats:
        """Return how near points are to the eye: float[...]."""
        return np.asarray(points @ self.towards)


def view_from(towards: Floats, upright: Floats) -> View:
    """Return the view from a direction, another one being upwards: float[3] of any length, not parallel.

    >>> view_from(np.array([0, 0, 1.0]), np.array([0, 2.0, 0])).right.tolist()
    [1.0, 0.0, 0.0]
    """
    towards, up = unit(towards), unit(across(upright, towards))
    return View(np.cross(up, towards), up, towards)


def view_from_above(points: Floats) -> View:
    """Return the view of a thing from above the plane in which it is widest; of a flat one, straight from above.

    Parameters
    ----------
    points : float[n, 3]

    Examples
    --------
    >>> view_from_above(np.eye(3)).places(np.eye(3)).shape
    (3, 2)
    """
    axes, flat = _axes(points)
    return view_from(axes[2], axes[1]) if flat else view_from(axes.T @ _EYE, axes[2])


def _axes(points: Floats) -> tuple[Floats, bool]:
    """Return the directions in which points are long, less long and short; and whether they lie in a plane."""
    if len(points) < 3:
        return np.eye(3), False
    sizes, axes = principal_axes(points)
    if np.linalg.det(axes) < 0:
        axes[1] = -axes[1]
    return axes, bool(sizes[2] < DOUBLE.flat * sizes[0])


def view_of_motion(points: Floats) -> View:
    """Return the view of what moves from a pose: aslant from above its plane, or with z upwards where it has none.

    Parameters
    ----------
    points : float[n, 3]
        At the first pose.

    Examples
    --------
    >>> view = view_of_motion(np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]]))
    >>> view.up.round(2).tolist()
    [-0.29, 0.49, 0.82]
    """
    axes, flat = _axes(points)
    upright = axes[2] if flat else np.array([0.0, 0.0, 1.0])
    # on the ground the axis of the coordinates that lies flattest: those of a square would be any
    ahead = unit(across(np.eye(3)[trailing(np.abs(upright))], upright))
    return view_from(_ASLANT @ np.stack([ahead, np.cross(upright, ahead), upright]), upright)


def drawn_order(places: Floats, near: Floats, faces: Sequence[Sequence[int]]) -> list[int]:
    """Return faces (vertex cycles) in the order in which they are drawn: those behind first.

    `places`, float[n, 2], are the vertices as they are seen, `near`, float[n], how near each is to the eye.
    """
    from shapely import STRtree
    from shapely.geometry import Polygon as Area

    areas = [Area(places[list(face)]).buffer(0) for face in faces]
    behind: dict[int, set[int]] = {i: set() for i in range(len(faces))}
    least = 1e-6 * float(np.ptp(places, axis=0).max() or 1.0) ** 2
    for a, b in zip(*STRtree(areas).query(areas, predicate="intersects"), strict=True):
        if a >= b:
            continue
        common = areas[a].intersection(areas[b])
        if common.area <= least:
            continue
        spot = common.representative_point()
        at = np.array([spot.x, spot.y])
        heights = [_height(at, places[list(faces[i])], near[list(faces[i])]) for i in (a, b)]
        if abs(heights[0] - heights[1]) > 1e-9 * max(1.0, abs(heights[0])):
            front, back = (int(a), int(b)) if heights[0] > heights[1] else (int(b), int(a))
            behind[front].add(back)
    order: list[int] = []
    left = sorted(behind, key=lambda i: (float(near[list(faces[i])].mean()), i))
    done: set[int] = set()
    while left:
        ready = next((i for i in left if behind[i] <= done), left[0])
        left.remove(ready)
        done.add(ready)
        order.append(ready)
    return order


def _height(at: Floats, corners: Floats, near: Floats) -> float:
    """Return how near a panel is to the eye at a place, by the plane through its corners."""
    terms = np.column_stack([corners, np.ones(len(corners))])
    plane = np.linalg.lstsq(terms, near, rcond=None)[0]
    return float(plane @ np.array([*at, 1.0]))
