"""Closed meshes of triangles."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from graphs.types import Floats

__all__ = ["Mesh", "is_watertight"]


@dataclass(frozen=True)
class Mesh:
    """A solid of one material: corners float[n, 3], millimetres, and triangles of them, int[m, 3].

    Triangles are counter-clockwise seen from outside.
    """

    name: str
    corners: Floats
    triangles: npt.NDArray[np.int64]

    def volume(self) -> float:
        """Return the volume, cubic millimetres; below zero if it is inside out."""
        a, b, c = (self.corners[self.triangles[:, k]] for k in range(3))
        return float((a * np.cross(b, c)).sum() / 6)


def is_watertight(mesh: Mesh) -> bool:
    """Say whether each side of a triangle is a side of one other, the other way round."""
    sides = Counter((a, b) for one in mesh.triangles.tolist() for a, b in zip(one, one[1:] + one[:1], strict=True))
    return all(number == 1 and sides[b, a] == 1 for (a, b), number in sides.items())
