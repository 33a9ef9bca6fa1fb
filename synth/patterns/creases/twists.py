"""Twists, flat: a regular polygon, a pleat at each side, a corner between pleats.

Theory: docs/theory/generators.md.
"""

from __future__ import annotations

from math import cos, log, pi, sin, tan

from graphs.errors import InvariantError
from graphs.mechanism.sheet import Sheet
from synth.patterns.panels import Place, sheet_of_faces

__all__ = ["hexagon_twist", "polygon_twist", "square_twist"]


def polygon_twist(sides: int, twist: float, radius: float = 0.35, letters: str = "", title: str = "") -> Sheet:
    """Return a twist: a regular polygon in the middle of another, and a straight pleat from each of its sides.

    `twist` is the angle of the middle polygon to the sheet, radians; `radius` is that of its corners (the sheet's
    sides are at distance 1 from the middle). `letters` has one for each side of the middle polygon, then two for
    the creases of each pleat; by default sides and second creases are mountains, first creases valleys.
    """
    step = 2 * pi / sides
    inner = [
        (radius * cos(k * step - step / 2 - twist), radius * sin(k * step - step / 2 - twist))
        for k in range(sides)
    ]
    places: list[Place] = list(inner)
    ends = {}
    for k in range(sides):  # pleat k leaves the polygon across its side k, square to a side of the sheet
        for v in (k, (k + 1) % sides):
            ends[k, v] = len(places)
            places.append(_turned((1.0, _turned(inner[v], -k, sides)[1]), k, sides))
    corners = []
    for k in range(sides):
        corners.append(len(places))
        places.append(_turned((1.0, sin(step / 2) / cos(step / 2)), k, sides))
    faces: list[tuple[int, ...]] = [tuple(range(sides))]
    marks = {}
    given = letters or "M" * sides + "V" * sides + "M" * sides
    for k in range(sides):
        after = (k + 1) % sides
        faces.append((k, ends[k, k], ends[k, after], after))
        faces.append((after, ends[k, after], corners[k], ends[after, after]))
        marks[frozenset((k, after))] = given[k]
        marks[frozenset((k, ends[k, k]))] = given[sides + k]
        marks[frozenset((after, ends[k, after]))] = given[2 * sides + k]
    return sheet_of_faces(places, faces, title or f"Twist of {sides} sides", marks)


def square_twist(twist: float, radius: float = 0.35) -> Sheet:
    """Return a square twist, marked so that it folds with rigid panels: two neighbouring vertices in either mode.

    Parameters
    ----------
    twist, radius : float
        As of `polygon_twist`.

    Examples
    --------
    >>> square_twist(0.4)
    <Sheet: 9 faces, 12 creases, 16 vertices, flat>
    """
    return polygon_twist(4, twist, radius, "MMVV" + "VVMM" + "MMVV", "Square twist")


def hexagon_twist(other: int, radius: float = 0.35) -> Sheet:
    """Return a hexagon twist that folds with rigid panels, by how many of its vertices are in the other mode.

    Round the hexagon tangents of half the fold angles are multiplied at each vertex, by a number for each mode;
    the six make 1 only at one twist.

    Parameters
    ----------
    other : int
        1 or 2.
    radius : float, optional
        As of `polygon_twist`.

    Raises
    ------
    InvariantError
        If there is no twist for so many vertices.

    Examples
    --------
    >>> hexagon_twist(2)
    <Sheet: 13 faces, 18 creases, 24 vertices, flat>
    """
    if other not in (1, 2):
        raise InvariantError(
            "hexagon-twist", f"{other} vertices in the other mode", "1 or 2: others need no twist"
        )
    firsts = "M" * other + "V" * (6 - other)
    seconds = firsts[1:] + firsts[0]  # the second crease of a pleat ends at the next vertex
    swapped = seconds.translate(str.maketrans("MV", "VM"))
    return polygon_twist(6, _rigid_twist(other), radius, "M" * 6 + firsts + swapped, "Hexagon twist")


def _rigid_twist(other: int) -> float:
    """Return the twist at which the multipliers of a hexagon's vertices make 1.

    With g = tan(60 degrees) and x = tan((90 degrees - twist) / 2) they are (g x + 1) / (g x - 1) and
    (g - x) / (g + x).
    """
    from scipy.optimize import brentq  # takes half a second to load

    slope = tan(pi / 3)

    def product(twist: float) -> float:
        half = tan((pi / 2 - twist) / 2)
        return other * log((slope * half + 1) / (slope * half - 1)) - (6 - other) * log(
            (slope + half) / (slope - half)
        )

    return float(brentq(product, 0.0, pi / 6 - 1e-9, xtol=1e-16, rtol=1e-15))


def _turned(point: Place, steps: int, sides: int) -> Place:
    """Return a point turned by steps of a regular polygon; quarter turns are exact."""
    x, y = point
    if sides == 4:
        for _ in range(steps % 4):
            x, y = -y, x
        return (x, y)
    c, s = cos(2 * pi * steps / sides), sin(2 * pi * steps / sides)
    return (c * x - s * y, s * x + c * y)
