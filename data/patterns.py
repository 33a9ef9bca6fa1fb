"""Crease patterns made from their geometry, for data/patterns/."""

from __future__ import annotations

from math import cos, pi, sin, sqrt, tan

from graphs.mechanism.sheet import Sheet

Point = tuple[float, ...]


def miura(rows: int, columns: int, fold_deg: float = 40.0, title: str = "") -> Sheet:
    """Return a folded Miura mesh of rows x columns parallelograms (sides 1 and 1.3, acute angle 65 degrees)."""
    a, b, theta, phi = 1.0, 1.3, 65 * pi / 180, fold_deg * pi / 180
    # phi: angle between a panel and the base plane; the usual unit-cell lengths (Schenk and Guest 2013).
    height = a * sin(phi) * sin(theta)
    half_s = b * cos(phi) * tan(theta) / sqrt(1 + cos(phi) ** 2 * tan(theta) ** 2)
    half_l = a * sqrt(1 - sin(phi) ** 2 * sin(theta) ** 2)
    shift = b / sqrt(1 + cos(phi) ** 2 * tan(theta) ** 2)
    points: list[Point] = [
        (j * half_s, i * half_l + (j % 2) * shift, (i % 2) * height)
        for i in range(rows + 1)
        for j in range(columns + 1)
    ]
    at = {(i, j): i * (columns + 1) + j for i in range(rows + 1) for j in range(columns + 1)}
    faces = [(at[i, j], at[i, j + 1], at[i + 1, j + 1], at[i + 1, j]) for i in range(rows) for j in range(columns)]
    return _sheet(
        points, faces, title or f"Miura mesh {rows} x {columns}, folded", _miura_letters(rows, columns, at)
    )


def _miura_letters(rows: int, columns: int, at: dict[tuple[int, int], int]) -> dict[frozenset[int], str]:
    letters = {}
    for i in range(rows + 1):
        for j in range(columns + 1):
            if j < columns:  # across the zigzag: mountain and valley by row
                letters[frozenset((at[i, j], at[i, j + 1]))] = "MV"[i % 2]
            if i < rows:  # along the straight lines they alternate
                letters[frozenset((at[i, j], at[i + 1, j]))] = "MV"[(i + j) % 2]
    return letters


def bird_base() -> Sheet:
    """Return the crease pattern of the bird base: 16 triangles, flat."""
    t = sqrt(2) - 1
    points: list[Point] = [(0, 0), (1, 1), (-1, 1), (-1, -1), (1, -1), (1, 0), (0, 1), (-1, 0), (0, -1)]
    points += [(t, 0), (0, t), (-t, 0), (0, -t)]
    faces, letters = [], {}
    for k in range(4):
        middle, tip = 5 + k, 9 + k
        for corner in (1 + (k - 1) % 4, 1 + k):
            faces += [(0, tip, corner), (tip, middle, corner)]
            letters[frozenset((tip, corner))] = "V"
            # Mountains along one diagonal; the other is folded over and back, and left open here.
            letters[frozenset((0, corner))] = "MU"[corner % 2]
        letters[frozenset((0, tip))] = "V"
        letters[frozenset((tip, middle))] = "M"
    return _sheet(points, faces, "Bird base", letters)


def square_twist(twist_deg: float = 22.5) -> Sheet:
    """Return a square twist: a central square, four pleats and four corners, flat."""
    twist, r = twist_deg * pi / 180, 0.35
    inner = [(r * cos(k * pi / 2 - pi / 4 - twist), r * sin(k * pi / 2 - pi / 4 - twist)) for k in range(4)]
    points: list[Point] = list(inner)
    ends = {}
    for k in range(4):  # pleat k leaves the square across its side k, parallel to an edge of the sheet
        for v in (k, (k + 1) % 4):
            ends[k, v] = len(points)
            points.append(_turned((1.0, _turned(inner[v], -k)[1]), k))
    corners = []
    for k in range(4):
        corners.append(len(points))
        points.append(_turned((1.0, 1.0), k))
    faces: list[tuple[int, ...]] = [(0, 1, 2, 3)]
    letters = {}
    for k in range(4):
        after = (k + 1) % 4
        faces.append((k, ends[k, k], ends[k, after], after))
        faces.append((after, ends[k, after], corners[k], ends[after, after]))
        letters[frozenset((k, after))] = "M"
        letters[frozenset((k, ends[k, k]))] = "V"
        letters[frozenset((after, ends[k, after]))] = "M"
    return _sheet(points, faces, "Square twist", letters)


def _turned(point: Point, quarters: int) -> Point:
    x, y = point
    for _ in range(quarters % 4):
        x, y = -y, x
    return (x, y)


def fourbar_vertex() -> Sheet:
    """Return a vertex of degree four, folded by a little: one spherical four-bar."""
    sectors = [60 * pi / 180, 75 * pi / 180, 120 * pi / 180, 105 * pi / 180]
    directions = _folded_vertex(sectors, 30 * pi / 180)
    points: list[Point] = [(0.0, 0.0, 0.0), *directions]
    faces = [(0, 1 + k, 1 + (k + 1) % 4) for k in range(4)]
    letters = {frozenset((0, 1 + k)): letter for k, letter in enumerate("VMVV")}
    return _sheet(points, faces, "A flat-foldable vertex of degree four, partly folded", letters)


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


def _sheet(
    points: list[Point], faces: list[tuple[int, ...]], title: str, letters: dict[frozenset[int], str]
) -> Sheet:
    sides: dict[frozenset[int], int] = {}
    for face in faces:
        for side in zip(face, face[1:] + face[:1], strict=True):
            sides[frozenset(side)] = sides.get(frozenset(side), 0) + 1
    edges = tuple((min(side), max(side)) for side in sides)
    marks = "".join(letters.get(side, "U") if number == 2 else "B" for side, number in sides.items())
    rounded = tuple(tuple(round(x, 12) + 0.0 for x in point) for point in points)
    return Sheet(len(points), edges, marks, tuple(faces), rounded, title)
