"""Known crease patterns and strips for tests of folding: maps, pleats, bases, twists, pop-ups, Kresling's storey."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, pi, sin

import numpy as np

from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.rank.closure import independent_cycles

Place = tuple[float, ...]
Corners = Sequence[Place]


def of_panels(panels: Sequence[Corners]) -> Sheet:
    """Return the sheet of panels given by the places of their corners; corners at one place are one vertex."""
    number: dict[Place, int] = {}
    faces = []
    for panel in panels:
        faces.append(tuple(number.setdefault(tuple(round(x, 12) for x in place), len(number)) for place in panel))
    places: list[Place] = [()] * len(number)
    for panel, face in zip(panels, faces, strict=True):
        for place, vertex in zip(panel, face, strict=True):
            places[vertex] = tuple(place)
    return Sheet(len(number), (), "", tuple(faces), tuple(places))


def map_sheet(rows: int, columns: int) -> Sheet:
    """Return a map: a flat grid of rectangles."""
    x, y = [1.3 * j + 0.1 * j * j for j in range(columns + 1)], [float(i) for i in range(rows + 1)]
    return of_panels(
        [
            [(x[j], y[i]), (x[j + 1], y[i]), (x[j + 1], y[i + 1]), (x[j], y[i + 1])]
            for i in range(rows)
            for j in range(columns)
        ]
    )


def pleated_hypar(rings: int, *, middle_creased: bool) -> Sheet:
    """Return concentric squares and the diagonals of the outermost; the middle square is one panel or four."""
    square = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
    panels: list[Corners] = []
    for k in range(4):
        (a, b), (c, d) = square[k], square[(k + 1) % 4]
        panels += [
            [(a * r, b * r), (c * r, d * r), (c * (r + 1), d * (r + 1)), (a * (r + 1), b * (r + 1))]
            for r in range(1, rings + 1)
        ]
        if middle_creased:
            panels.append([(0.0, 0.0), (a, b), (c, d)])
    return of_panels(panels if middle_creased else [*panels, square])


def frog_base() -> Sheet:
    """Return the frog base: eight triangles about the middle of a square, in each the rabbit ear's bisectors.

    The perpendiculars from where they meet fall on the lines from the middle to the middles of the sides.
    """
    r = 1.0 - 0.5**0.5  # the radius of the inscribed circles
    panels: list[Corners] = []
    for quarter in range(4):
        c, s = round(cos(quarter * pi / 2)), round(sin(quarter * pi / 2))
        for side in (1.0, -1.0):
            middle, inner, corner = (1.0, 0.0), (1.0 - r, side * r), (1.0, side)
            foot, centre = (1.0 - r, 0.0), (0.0, 0.0)
            for panel in (
                [centre, foot, inner],
                [foot, middle, inner],
                [middle, corner, inner],
                [corner, centre, inner],
            ):
                panels.append([(c * x - s * y, s * x + c * y) for x, y in panel])
    return of_panels(panels)


def box_pop_up(*, depth: float = 1.0) -> Sheet:
    """Return a card with two slits across its fold and a strip between them, creased beside the fold.

    The card and the strip are four links about four parallel axes, all in the plane.
    """
    x = (-3.0, -depth, 0.0, depth + 0.5, 3.0)  # the strip is creased at the second and fourth, and at the line
    low, high = 1.0, 2.0
    middle = x[1] + x[3]  # so far from the fold as makes the strip as long as the card below
    faces = (
        (0, 1, 6, 5, 9, 8, 7, 2, 3, 4),
        (1, 11, 12, 2, 7, 15, 14, 6),
        (5, 10, 13, 9),
        (10, 14, 15, 13),
    )
    places = (
        (x[0], 0.0), (x[2], 0.0), (x[2], 3.0), (x[0], 3.0), (x[0], 1.5), (x[1], low), (x[2], low), (x[2], high),
        (x[1] / 2, high), (x[1], high), (middle, low), (x[4], 0.0), (x[4], 3.0), (middle, high), (x[3], low),
        (x[3], high),
    )  # fmt: skip
    return Sheet(16, (), "", faces, places)


def triangulated(rows: int, columns: int, rng: np.random.Generator) -> Sheet:
    """Return a grid with diagonals, its vertices moved a little: inside six creases meet at each."""
    place = {
        (i, j): (j + 0.15 * rng.uniform(-1, 1), i + 0.15 * rng.uniform(-1, 1))
        for i in range(rows + 1)
        for j in range(columns + 1)
    }
    panels: list[Corners] = []
    for i in range(rows):
        for j in range(columns):
            a, b, c, d = place[i, j], place[i, j + 1], place[i + 1, j + 1], place[i + 1, j]
            panels += [(a, b, c), (a, c, d)]
    return of_panels(panels)


def tube(columns: int) -> Sheet:
    """Return two folded Miura strips, one the other's image in the plane of their long edges, joined along these."""
    panels: list[Corners] = []
    for side in (0.6, -0.6):
        corner = {
            (i, j): (1.0 * j, 0.8 * i + 0.5 * (j % 2), side * (i % 2))
            for i in range(3)
            for j in range(columns + 1)
        }
        for i in range(2):
            for j in range(columns):
                panels.append((corner[i, j], corner[i, j + 1], corner[i + 1, j + 1], corner[i + 1, j]))
    return of_panels(panels)


def kresling(sides: int, *, ends: int, turn: float = 0.5, height: float = 0.8) -> Sheet:
    """Return one storey of Kresling's pattern: two regular polygons, one turned, and triangles between them.

    Parameters
    ----------
    ends : int
        How many of the polygons are panels: 0, 1 or 2.
    """
    below = [(cos(2 * pi * k / sides), sin(2 * pi * k / sides), 0.0) for k in range(sides)]
    above = [(cos(2 * pi * k / sides + turn), sin(2 * pi * k / sides + turn), height) for k in range(sides)]
    panels: list[Corners] = []
    for k in range(sides):
        following = (k + 1) % sides
        panels += [[below[k], below[following], above[k]], [below[following], above[following], above[k]]]
    return of_panels([*panels, *[below[::-1], above][:ends]])


def spoked_cube() -> tuple[SCGraph, dict[int, tuple[Place, Place]]]:
    """Return the locked cube of collapsible polyhedra: a triangle from the middle to each edge, hinged on the spokes.

    Three triangles meet on each spoke, in two hinges; all axes pass through the middle. Five of the six faces' loops
    are independent.
    """
    corners = [(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)]
    sides = [
        (a, b)
        for b in range(8)
        for a in range(b)
        if sum(p != q for p, q in zip(corners[a], corners[b], strict=True)) == 1
    ]
    joints: list[tuple[int, int]] = []
    axes: dict[int, tuple[Place, Place]] = {}
    for corner in range(8):
        first, *others = (number for number, side in enumerate(sides) if corner in side)
        for other in others:
            axes[len(joints)] = ((0.0, 0.0, 0.0), corners[corner])
            joints.append((first, other))
    graph = SCGraph(len(sides), joints)
    loops = [Loop(loop.joints, "finite", None, "middle") for loop in independent_cycles(graph)]
    return SCGraph(len(sides), joints, loops), axes
