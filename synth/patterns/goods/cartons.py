"""Cartons: a tray with webbed corners, a tube with a crash-lock bottom. Theory: docs/theory/generators.md."""

from __future__ import annotations

from math import cos, degrees, pi, sin, sqrt

from graphs.errors import InvariantError
from graphs.mechanism.sheet import Sheet
from synth.patterns.panels import Place, sheet_of_faces

__all__ = ["crash_lock", "webbed_tray"]


def webbed_tray(length: float = 3.0, width: float = 2.0, height: float = 0.8) -> Sheet:
    """Return the flat blank of a tray: a bottom, four walls, at each corner a square web creased to it.

    Parameters
    ----------
    length, width, height : float, optional
        Any unit of length.

    Notes
    -----
    Each corner is a spherical loop of five links; with the angles of its two walls it is known. So there are four
    freedoms, one a wall.

    Examples
    --------
    >>> webbed_tray()
    <Sheet: 13 faces, 16 creases, 16 vertices, flat>
    """
    x, y = (-height, 0.0, length, length + height), (-height, 0.0, width, width + height)
    places = [(x[j], y[i]) for i in range(4) for j in range(4)]
    faces: list[tuple[int, ...]] = []
    letters = {}
    for i in range(3):
        for j in range(3):
            a, b, c, d = 4 * i + j, 4 * i + j + 1, 4 * i + j + 5, 4 * i + j + 4
            if i == 1 or j == 1:
                faces.append((a, b, c, d))
            elif i == j:
                faces += [(a, b, c), (a, c, d)]
                letters[frozenset((a, c))] = "M"
            else:
                faces += [(a, b, d), (b, c, d)]
                letters[frozenset((b, d))] = "M"
    for a, b in ((5, 6), (6, 10), (10, 9), (9, 5)):
        letters[frozenset((a, b))] = "V"
    return sheet_of_faces(places, faces, "Tray with webbed corners", letters)


def crash_lock(opening: float, length: float = 2.0, width: float = 1.4, height: float = 2.0) -> Sheet:
    """Return a tube of four walls with a crash-lock bottom, opened so far.

    At two opposite corners a panel of the bottom has a crease at 45 degrees, beyond which it is glued to the panel
    beside it; so the bottom unfolds when the tube is opened, and locks where the crease is flat.

    Parameters
    ----------
    opening : float
        Angle between the walls at the glued corners, radians; a right angle is the end.
    length, width, height : float, optional
        Of the tube, any unit of length.

    Raises
    ------
    InvariantError
        If the tube is closed, or open to a right angle.

    Notes
    -----
    Walls are four links about parallel axes, each glued corner is four links about a point: ten joints, three
    loops, one freedom. Source: J. S. Dai and F. Cannella, "Stiffness characteristics of carton folds for
    packaging" (2008).

    Examples
    --------
    >>> crash_lock(1.2)
    <Sheet: 8 faces, 10 creases, 10 vertices, in space>
    """
    if not 0.0 < opening < pi / 2:
        told = f"the tube is opened to {degrees(opening):g} degrees"
        raise InvariantError("crash-lock", told, "more than 0, less than 90")
    away = (width * cos(opening), width * sin(opening))
    ground: list[Place] = [(0.0, 0.0), (length, 0.0), (length + away[0], away[1]), away]
    # The crease makes 45 degrees with both bottom edges of its corner: it rises into the tube.
    near = sqrt(0.5) / cos(opening / 2)
    crease = 0.45 * min(length, width)
    inward = (crease * near * cos(opening / 2), crease * near * sin(opening / 2), crease * sqrt(1 - near * near))
    ends = [inward, (ground[2][0] - inward[0], ground[2][1] - inward[1], inward[2])]
    places = [(x, y, z) for z in (0.0, height) for x, y in ground] + ends
    walls = [(k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k) for k in range(4)]
    bottom = [(0, 1, 8), (3, 0, 8), (2, 3, 9), (1, 2, 9)]
    return sheet_of_faces(places, [*walls, *bottom], "Carton with a crash-lock bottom")
