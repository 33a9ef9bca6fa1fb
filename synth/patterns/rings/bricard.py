"""Bricard's mobile hexagons: symmetric about a line, about a plane, trihedral. Theory: docs/theory/generators.md.

Source: R. Bricard, "Lecons de cinematique" (1927).
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, hypot, sin

import numpy as np

from graphs.geometry import unit
from graphs.mechanism.solids import HingedSolids
from graphs.types import Floats
from synth.patterns.rings.axes import Line, ring, ring_of_sides

__all__ = ["line_symmetric", "plane_symmetric", "trihedral"]

_HALF: tuple[Line, ...] = (
    ((1, 0, 0.2), (0.3, 1, 2)),
    ((0.6, 1.1, -0.1), (1, -0.4, 0.7)),
    ((-0.7, 0.9, 0.5), (1, 1, -1)),
)
_CORNERS = ((4.0, 1.0, 0.0), (-1.0, 3.0, 1.0), (0.0, -1.0, 3.0))


def line_symmetric(lean: float = 0.0, half: Sequence[Line] | None = None) -> HingedSolids:
    """Return Bricard's line-symmetric linkage: half a turn about the z axis takes axes 0, 1, 2 to 3, 4, 5.

    Parameters
    ----------
    lean : float, optional
        Turn of the three axes about the x axis, radians: another linkage for each.
    half : sequence of three lines, optional
        Points and directions of axes 0, 1, 2. Any three lines do.

    Examples
    --------
    >>> line_symmetric()
    <HingedSolids: <SCGraph: 6 links, 6 joints, 0 centres>>
    """
    lines = [_leaning(line, lean) for line in half or _HALF]
    return ring([*lines, *(((-x, -y, z), (-u, -v, w)) for (x, y, z), (u, v, w) in lines)])


def plane_symmetric(height: float = 0.0) -> HingedSolids:
    """Return Bricard's plane-symmetric linkage: axes 0 and 3 in the plane y = 0, 5 and 4 the images of 1 and 2.

    Parameters
    ----------
    height : float, optional
        By how much axis 1 and its image are raised along z, in units of about a quarter of the linkage.

    Examples
    --------
    >>> plane_symmetric()
    <HingedSolids: <SCGraph: 6 links, 6 joints, 0 centres>>
    """
    first, last = ((1.2, 0, 0), (0.4, 0, 1)), ((-1, 0, 0.3), (-0.5, 0, 1))
    half: list[Line] = [((0.7, 0.9, 0.1 + height), (1, 0.3, 0.8)), ((-0.5, 1.1, -0.2), (0.2, 1, 1.1))]
    images = [((x, -y, z), (u, -v, w)) for (x, y, z), (u, v, w) in half]
    return ring([first, *half, last, images[1], images[0]])


def trihedral(first: float = 1.0, second: float = 0.8, third: float = 1.3) -> HingedSolids:
    """Return Bricard's trihedral linkage: right twists, no offsets, the squares of alternate lengths alike in sum.

    Axes 0, 2, 4 have the directions of the corners of a spherical triangle, 1, 3, 5 those of its polar triangle.
    Each side goes across its two axes; three lengths close the hexagon, and then the sums are equal.

    Parameters
    ----------
    first, second, third : float, optional
        Lengths of the first three solids, any unit; the others follow.

    Examples
    --------
    >>> trihedral()
    <HingedSolids: <SCGraph: 6 links, 6 joints, 0 centres>>
    """
    across = around(*(np.array(one) / hypot(*one) for one in _CORNERS))
    sides = np.cross(across, np.roll(across, -1, axis=0))
    chosen = np.array([first, second, third])
    return ring_of_sides(across, np.concatenate([chosen, -np.linalg.solve(sides[3:].T, sides[:3].T @ chosen)]))


def around(*corners: Floats) -> Floats:
    """Return directions round a spherical polygon: a corner, the pole of its side, the next corner, ..."""
    directions = []
    for here, there in zip(corners, (*corners[1:], corners[0]), strict=True):
        directions += [here, unit(np.cross(here, there))]
    return np.array(directions)


def _leaning(line: Line, angle: float) -> Line:
    if not angle:
        return line
    c, s = cos(angle), sin(angle)
    (x, y, z), (u, v, w) = line
    return (x, c * y - s * z, s * y + c * z), (u, c * v - s * w, s * v + c * w)
