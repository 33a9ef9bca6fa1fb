"""Closed meshes of triangles."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from graphs.arrays import Floats

__all__ = ["Mesh", "is_watertight"]


@dataclass(frozen=True)
class Mesh:
    """A solid of one material.

    Attributes
    ----------
    name : str
    corners : float[n, 3]
        Millimetres.
    triangles : int[m, 3]
        Corners, counter-clockwise seen from outside.
    """

    name: str
    corners: Floats
    triangles: npt.NDArray[np.int64]

    def volume(self) -> float:
        """Return the volume, cubic millimetres; below zero if it is inside out."""
        a, b, c = (self.corners[self.triangles[:, k]] for k in range(3))
        return float((a * np.cross(b, c)).sum() / 6)


def is_watertight(mesh: Mesh) -> bool:
    """Tell whether each side of a triangle is a side of one other, the other way round.

    Examples
    --------
    >>> corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    >>> faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    >>> is_watertight(Mesh("a", corners, faces)), is_watertight(Mesh("a", corners, faces[:3]))
    (True, False)
    """
    sides = Counter((a, b) for one in mesh.triangles.tolist() for a, b in zip(one, one[1:] + one[:1], strict=True))
    return all(number == 1 and sides[b, a] == 1 for (a, b), number in sides.items())
