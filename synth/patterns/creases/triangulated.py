"""Crease patterns of triangles, flat: Yoshimura's, the waterbomb's, Resch's. Theory: docs/theory/generators.md."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import cos, dist, pi, sin, sqrt

from graphs.mechanism.sheet import Sheet, sides_of_face
from synth.patterns.panels import Place, sheet_of_panels

__all__ = ["freedoms_of_triangles", "resch", "waterbomb", "yoshimura"]


def freedoms_of_triangles(sheet: Sheet) -> int:
    """Return the freedoms of a disc of triangles: its border's vertices less three.

    Each triangle more adds a border vertex and a freedom, or closes a vertex with three equations.

    >>> freedoms_of_triangles(waterbomb(1, 1))
    3
    """
    border = {
        v for edge, letter in zip(sheet.edges, sheet.assignments, strict=True) if letter == "B" for v in edge
    }
    return len(border) - 3


def yoshimura(rows: int, columns: int, width: float = 1.0, height: float = 0.6) -> Sheet:
    """Return Yoshimura's pattern: diamonds, each halved by a valley along its row.

    Parameters
    ----------
    rows, columns : int
        Rows of triangles, and twice as many triangles in each as there are columns.
    width, height : float, optional
        Of a triangle, any unit of length.

    Notes
    -----
    Source: Y. Yoshimura, "On the mechanism of buckling of a circular cylindrical shell under axial compression"
    (1955).

    Examples
    --------
    >>> yoshimura(2, 2)
    <Sheet: 8 faces, 8 creases, 9 vertices, flat>
    """

    def at(i: int, j: int) -> Place:
        return (width * (j + i % 2 / 2), height * i)

    panels: list[list[Place]] = []
    for i in range(rows):
        for j in range(columns):
            a, b, c, d = at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)
            panels += [[a, b, d], [b, c, d]] if i % 2 == 0 else [[a, b, c], [a, c, d]]
    sheet = sheet_of_panels(panels, f"Yoshimura's pattern {rows} x {columns}")
    return _lettered(sheet, lambda a, b: "V" if abs(a[1] - b[1]) < height / 2 else "M")


def waterbomb(rows: int, columns: int) -> Sheet:
    """Return the waterbomb tessellation: waterbomb bases of side 2, columns shifted by half a square.

    Parameters
    ----------
    rows, columns : int

    Notes
    -----
    Inside six creases meet at every vertex; mountains are parallel to the sides. Source: Y. Chen, H. Feng, J. Ma,
    R. Peng, Z. You, "Symmetric waterbomb origami" (2016).

    Examples
    --------
    >>> waterbomb(1, 1)
    <Sheet: 6 faces, 6 creases, 7 vertices, flat>
    """
    panels: list[list[Place]] = []
    for column in range(columns):
        for row in range(rows):
            x, y = 2.0 * column + 1, 2.0 * row + 1 + column % 2
            round_it = [(x - 1, y - 1), (x + 1, y - 1), (x + 1, y), (x + 1, y + 1), (x - 1, y + 1), (x - 1, y)]
            panels += [[(x, y), a, b] for a, b in sides_of_face(round_it)]
    sheet = sheet_of_panels(panels, f"Waterbomb tessellation {rows} x {columns}")
    return _lettered(sheet, lambda a, b: "V" if min(abs(a[0] - b[0]), abs(a[1] - b[1])) > 0.5 else "M")


def resch(rows: int, columns: int) -> Sheet:
    """Return Resch's triangles: tiles of side 1, and triangles of side 2 that fold to stars of three arms.

    A large triangle is parted from its middle by lines to its corners and to the middles of its sides into six
    with angles of 30, 60 and 90 degrees; folded flat, the middles of its sides meet, its middle below them.

    Parameters
    ----------
    rows, columns : int
        Of large triangles, each with the six tiles round it.

    Notes
    -----
    Sources: R. D. Resch, "Self-supporting structural unit having a series of repetitious geometrical modules",
    patent (1968); T. Tachi, "Designing freeform origami tessellations by generalizing Resch's patterns" (2013).

    Examples
    --------
    >>> resch(1, 1)
    <Sheet: 12 faces, 12 creases, 13 vertices, flat>
    """
    panels: list[list[Place]] = []
    tiles: dict[Place, list[Place]] = {}
    for row in range(rows):
        for column in range(columns):
            middle = (sqrt(3.0) * (column + row / 2), 1.5 * row)
            star = [_off(middle, (1 + k % 2) / sqrt(3.0), k * pi / 3) for k in range(6)]
            panels += [[middle, a, b] for a, b in sides_of_face(star)]
            for a, b in sides_of_face(star):
                tile = [b, a, _beyond(a, b)]
                tiles.setdefault(_tile_at(tile), tile)
    sheet = sheet_of_panels([*panels, *tiles.values()], f"Resch's triangles {rows} x {columns}")
    # Folded, long spokes are the lower edges of fins; where tiles bend down, and fins meet, there are mountains.
    return _lettered(sheet, lambda a, b: "V" if dist(a, b) > _LONG else "M")


_LONG = 1.1
"""Between the sides of tiles and the lines from the middle of a large triangle to its corners."""


def _lettered(sheet: Sheet, letter: Callable[[Place, Place], str]) -> Sheet:
    """Return a sheet whose creases have the letters that their ends say."""
    places = sheet.coordinates
    assert places is not None
    letters = [
        "B" if given == "B" else letter(places[a], places[b])
        for (a, b), given in zip(sheet.edges, sheet.assignments, strict=True)
    ]
    return replace(sheet, assignments="".join(letters))


def _off(middle: Place, radius: float, angle: float) -> Place:
    return (middle[0] + radius * cos(angle), middle[1] + radius * sin(angle))


def _beyond(a: Place, b: Place) -> Place:
    """Return the third corner of the equilateral triangle to the right of a line."""
    x, y = b[0] - a[0], b[1] - a[1]
    return (a[0] + x / 2 + y * sqrt(3.0) / 2, a[1] + y / 2 - x * sqrt(3.0) / 2)


def _tile_at(corners: list[Place]) -> Place:
    """Return the middle of a tile, by which it is known."""
    return tuple(round(sum(c[k] for c in corners) / 3, 6) + 0.0 for k in (0, 1))
