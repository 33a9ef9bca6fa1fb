"""Crease patterns for data/: those of `synth.catalogue.patterns` with the sizes chosen here, and a vertex."""

from __future__ import annotations

from math import cos, pi, sin, sqrt

from graphs.mechanism.sheet import Sheet
from synth.catalogue.patterns import creases
from synth.catalogue.patterns.panels import sheet_of_faces

Point = tuple[float, ...]


def miura(rows: int, columns: int, fold_deg: float = 40.0, title: str = "") -> Sheet:
    """Return a folded Miura mesh of rows x columns parallelograms (sides 1 and 1.3, acute angle 65 degrees)."""
    mesh = creases.folded_miura(rows, columns, fold_deg * pi / 180, 65 * pi / 180, 1.0, 1.3, title)
    return mesh


def bird_base() -> Sheet:
    """Return the crease pattern of the bird base: 16 triangles, flat."""
    return creases.bird_base()


def square_twist(twist_deg: float = 22.5) -> Sheet:
    """Return a square twist: a central square, four pleats and four corners, flat; all vertices marked alike."""
    return creases.polygon_twist(4, twist_deg * pi / 180, title="Square twist")


def fourbar_vertex() -> Sheet:
    """Return a vertex of degree four, folded by a little: one spherical four-bar."""
    sectors = [60 * pi / 180, 75 * pi / 180, 120 * pi / 180, 105 * pi / 180]
    directions = _folded_vertex(sectors, 30 * pi / 180)
    points: list[Point] = [(0.0, 0.0, 0.0), *directions]
    faces = [(0, 1 + k, 1 + (k + 1) % 4) for k in range(4)]
    letters = {frozenset((0, 1 + k)): letter for k, letter in enumerate("VMMM")}
    title = "A flat-foldable vertex of degree four, partly folded"
    return sheet_of_faces(points, faces, title, letters)


def _folded_vertex(sectors: list[float], rise: float) -> list[Point]:
    """Place the four creases of a spherical four-bar with the given arcs; crease 0 and 2 an angle apart."""
    a, b, c, d = sectors
    between = a + b - rise  # the arc from crease 0 to crease 2, shorter than when flat
    third = (cos(between), sin(between), 0.0)
    return [(1.0, 0.0, 0.0), _apex(between, a, b, 1), third, _apex(between, d, c, -1)]


def _apex(between: float, to_first: float, to_third: float, sign: int) -> Point:
    """Return the unit vector at the given arcs from the x axis and from the direction ``between`` away."""
    x = cos(to_first)
    y = (cos(to_third) - x * cos(between)) / sin(between)
    return (x, y, sign * sqrt(1 - x * x - y * y))
