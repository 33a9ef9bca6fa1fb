"""Crease patterns and a linkage for tests of folding that have no generator: pleats, a base, random triangles, a cube."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np

from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.rank.exact import independent_cycles
from synth.catalogue.patterns.panels import Corners, Place, sheet_of_panels


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
    return sheet_of_panels(panels if middle_creased else [*panels, square])


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
    return sheet_of_panels(panels)


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
    return sheet_of_panels(panels)


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
