"""Closed sheets in space: tubes of Miura strips, storeys of Kresling's pattern.

Theory: docs/theory/generators.md.
"""

from __future__ import annotations

from math import cos, pi, sin

from graphs.mechanism.sheet import Sheet
from synth.patterns.creases.tessellations import folded_miura
from synth.patterns.panels import Corners, Place, sheet_of_panels

__all__ = ["kresling", "miura_tube"]


def miura_tube(columns: int, sector: float, tilt: float, straight: float = 1.0, zigzag: float = 1.0) -> Sheet:
    """Return two folded Miura strips, one the other's image in the plane of their long edges, joined along these.

    Parameters
    ----------
    columns : int
        Panels along the tube; four are round it.
    sector, straight, zigzag : float
        As of `synth.patterns.creases.tessellations.miura`.
    tilt : float
        Angle between a panel and the plane of symmetry, radians.

    Notes
    -----
    Source: T. Tachi and K. Miura, "Rigid-foldable cylinders and cells" (2012).

    Examples
    --------
    >>> miura_tube(3, 1.1, 0.6)
    <Sheet: 12 faces, 20 creases, 16 vertices, in space>
    """
    strip = folded_miura(2, columns, tilt, sector, straight, zigzag)
    assert strip.coordinates is not None
    upper: list[list[Place]] = [[strip.coordinates[v] for v in face] for face in strip.faces]
    lower = [[(x, y, -z) for x, y, z in panel] for panel in upper]
    return sheet_of_panels([*upper, *lower], f"Tube of Miura strips, {columns} long")


def kresling(sides: int, ends: int, turn: float = 0.5, height: float = 0.8) -> Sheet:
    """Return one storey of Kresling's pattern: two regular polygons, one turned, and triangles between them.

    Parameters
    ----------
    sides : int
    ends : int
        How many of the polygons are panels: 0, 1 or 2.
    turn : float, optional
        Of the upper polygon against the lower, radians.
    height : float, optional
        In units of the radius of the polygons.

    Notes
    -----
    A strip of 2 n triangles closes with six equations: 2 n - 6 freedoms. A polygon that is a panel makes it rigid,
    but for an even number of sides turned by half a side with one panel; it snaps to another height as panels
    bend. Source: B. Kresling, "Plant 'design': mechanical simulations
    of growth patterns and bionics" (1996).

    Examples
    --------
    >>> kresling(6, 0)
    <Sheet: 12 faces, 12 creases, 12 vertices, in space>
    """
    below = [(cos(2 * pi * k / sides), sin(2 * pi * k / sides), 0.0) for k in range(sides)]
    above = [(cos(2 * pi * k / sides + turn), sin(2 * pi * k / sides + turn), height) for k in range(sides)]
    panels: list[Corners] = []
    for k in range(sides):
        following = (k + 1) % sides
        panels += [[below[k], below[following], above[k]], [below[following], above[following], above[k]]]
    return sheet_of_panels([*panels, *[below[::-1], above][:ends]], f"Storey of Kresling's pattern, {sides} sides")
