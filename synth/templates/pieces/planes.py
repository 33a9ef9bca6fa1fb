"""The plane of a panel, with axes in it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from graphs.errors import UnsolvableError
from graphs.geometry import across, area_vector, unit
from graphs.mechanism.sheet import COLLINEAR
from graphs.tolerances import DOUBLE, trailing
from graphs.types import Floats

__all__ = ["Plane", "plane_of_panel"]


@dataclass(frozen=True)
class Plane:
    """A frame in the plane of a panel; its origin is the mean of the corners.

    The columns of `axes`, float[3, 3], are two axes in the plane and the normal, round which the corners go
    counter-clockwise; `flat`, float[corners, 2], are the corners in the frame.
    """

    origin: Floats
    axes: Floats
    flat: Floats

    @property
    def normal(self) -> Floats:
        """The unit normal, float[3]."""
        column: Floats = self.axes[:, 2]
        return column


def plane_of_panel(corners: Floats, face: int) -> Plane:
    """Return the plane of a panel with corners float[corners, 3]; messages name its number, the face.

    Raise UnsolvableError if the corners lie in no plane or in a line, a side has no length, or sides cross.

    >>> plane_of_panel(np.array([[0, 0, 5], [1, 0, 5], [0, 1, 5.0]]), 0).normal.tolist()
    [0.0, 0.0, 1.0]
    """
    origin: Floats = corners.mean(axis=0)
    arms = corners - origin
    area = 2 * area_vector(corners)
    size = float(np.abs(arms).max())
    if np.linalg.norm(area) <= COLLINEAR * size**2:
        raise UnsolvableError(f"panel {face} has no area")
    normal = unit(area)
    if float(np.abs(arms @ normal).max()) > DOUBLE.flat * size:
        raise UnsolvableError(f"panel {face} is not plane, and cannot be cut of a sheet")
    along = unit(across(np.eye(3)[trailing(np.abs(normal))], normal))
    axes = np.column_stack([along, np.cross(normal, along), normal])
    flat = arms @ axes[:, :2]
    if np.linalg.norm(flat - np.roll(flat, -1, axis=0), axis=1).min() <= DOUBLE.same_point * size:
        raise UnsolvableError(f"panel {face} has a side without length")
    if not shapely.Polygon(flat).is_valid:
        raise UnsolvableError(f"the border of panel {face} crosses or touches itself, so it cannot be cut out")
    return Plane(origin, axes, flat)
