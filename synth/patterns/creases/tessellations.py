"""Quadrilateral meshes, flat: Miura sheets, chicken wire, Huffman's grid, maps.

Theory: docs/theory/generators.md.
"""

from __future__ import annotations

from collections.abc import Callable
from math import cos, isclose, pi, sin, sqrt, tan

from graphs.errors import InvariantError
from graphs.mechanism.sheet import Sheet
from synth.patterns.panels import Place, sheet_of_faces

__all__ = ["chickenwire", "folded_miura", "huffman_grid", "map_sheet", "miura"]

_Point = tuple[float, float]


def miura(rows: int, columns: int, sector: float, straight: float = 1.0, zigzag: float = 1.0) -> Sheet:
    """Return a flat Miura sheet: ``rows`` panels along each straight line, ``columns`` along each zigzag.

    Parameters
    ----------
    rows, columns : int
    sector : float
        Acute angle of the panels, radians.
    straight, zigzag : float, optional
        Sides of a panel along the two kinds of lines, any unit of length.

    Notes
    -----
    Its folded state has tan(b / 2) = cos(sector) tan(a / 2), a on the zigzag creases, b on the straight ones.
    Source: K. Miura, "Method of packaging and deployment of large membranes in space" (1985).

    Examples
    --------
    >>> miura(3, 4, pi / 3)
    <Sheet: 12 faces, 17 creases, 20 vertices, flat>
    """
    return _mesh(
        rows,
        columns,
        lambda i, j: (j * zigzag * sin(sector), i * straight + j % 2 * zigzag * cos(sector)),
        lambda i, j: "MV"[i % 2],
        lambda i, j: "VM"[(i + j) % 2],
        f"Miura sheet {rows} x {columns}",
    )


def folded_miura(
    rows: int,
    columns: int,
    tilt: float,
    sector: float,
    straight: float = 1.0,
    zigzag: float = 1.0,
    title: str = "",
) -> Sheet:
    """Return a Miura sheet folded until its panels are at an angle, the tilt (radians), to the base plane.

    Rows count panels along the zigzags' normal, columns along the zigzags; sector and sides are those of `miura`.
    Lengths of the unit cell as in M. Schenk and S. D. Guest, "Geometry of Miura-folded metamaterials" (2013).
    """
    height = straight * sin(tilt) * sin(sector)
    wide = cos(tilt) ** 2 * tan(sector) ** 2
    across = zigzag * cos(tilt) * tan(sector) / sqrt(1 + wide)
    along = straight * sqrt(1 - sin(tilt) ** 2 * sin(sector) ** 2)
    shift = zigzag / sqrt(1 + wide)
    return _mesh(
        rows,
        columns,
        lambda i, j: (j * across, i * along + j % 2 * shift, i % 2 * height),
        lambda i, j: "MV"[i % 2],
        lambda i, j: "MV"[(i + j) % 2],
        title or f"Miura mesh {rows} x {columns}, folded",
    )


def chickenwire(rows: int, columns: int, sector: float, straight: float = 2.0) -> Sheet:
    """Return flat chicken wire: hexagons in columns, each halved along a straight line into two trapezoids.

    Parameters
    ----------
    rows, columns : int
        Panels along the straight lines, and across them.
    sector : float
        Acute angle of the trapezoids, radians. Their legs have length 1.
    straight : float, optional
        Middle line of a trapezoid, above cos(sector).

    Notes
    -----
    All vertices are those of a Miura sheet, turned by half a turn from one to the next along a straight line.
    Source: T. A. Evans, R. J. Lang, S. P. Magleby, L. L. Howell, "Rigidly foldable origami gadgets and
    tessellations" (2015).

    Examples
    --------
    >>> chickenwire(2, 3, 1.1)
    <Sheet: 6 faces, 7 creases, 12 vertices, flat>
    """
    return _mesh(
        rows,
        columns,
        lambda i, j: (j * sin(sector), i * straight + (-1) ** (i + j) * cos(sector) / 2),
        lambda i, j: "M",
        lambda i, j: "MV"[(i + j) % 2],
        f"Chicken wire {rows} x {columns}",
    )


def huffman_grid(rows: int, columns: int, first: float, second: float, side: float = 1.0) -> Sheet:
    """Return Huffman's grid: copies of one quadrilateral, each its neighbour turned half about their common side.

    Parameters
    ----------
    rows, columns : int
    first, second : float
        Two neighbouring angles of the quadrilateral, radians, not alike; opposite ones make half a turn.
    side : float, optional
        The other side at the first angle; the side between both is 1.

    Raises
    ------
    InvariantError
        If the angles are alike, or the quadrilateral is not convex.

    Notes
    -----
    Every vertex has the four angles of the quadrilateral round it, and all fold alike: one freedom is left.
    Sources: D. A. Huffman, "Curvature and creases" (1976); A. Kokotsakis (1933) and H. Stachel (2010) for any
    convex quadrilateral.

    Examples
    --------
    >>> huffman_grid(3, 3, 1.3, 1.0)
    <Sheet: 9 faces, 12 creases, 16 vertices, flat>
    """
    if isclose(first, second, abs_tol=1e-3) or isclose(first + second, pi, abs_tol=1e-3):
        raise InvariantError(
            "huffman-grid", f"the angles {first:g} and {second:g}", "neither alike nor together half a turn"
        )
    a, b, d = (0.0, 0.0), (1.0, 0.0), (side * cos(first), side * sin(first))
    c = _meeting(b, pi - second, d, first - second)
    if c is None:
        most = sin(second) / sin(first + second)
        raise InvariantError(
            "huffman-grid", f"no convex quadrilateral has the side {side:g}", f"a side below {most:.6g}"
        )
    corner = {(0, 0): a, (0, 1): b, (1, 1): c, (1, 0): d}
    right = (b[0] + c[0] - a[0] - d[0], b[1] + c[1] - a[1] - d[1])
    up = (c[0] + d[0] - a[0] - b[0], c[1] + d[1] - a[1] - b[1])

    def place(i: int, j: int) -> Place:
        x, y = corner[i % 2, j % 2]
        return (x + j // 2 * right[0] + i // 2 * up[0], y + j // 2 * right[1] + i // 2 * up[1])

    # The smallest angle, the second, is between a mountain and a valley; three creases of a vertex are alike.
    return _mesh(
        rows,
        columns,
        place,
        lambda i, j: "M",
        lambda i, j: "MV"[(i + j) % 2],
        f"Huffman's grid {rows} x {columns}",
    )


def map_sheet(rows: int, columns: int, width: float = 1.3, height: float = 1.0) -> Sheet:
    """Return a map: a flat grid of rectangles, which folds across its columns, as marked, or its rows.

    Parameters
    ----------
    rows, columns : int
    width, height : float, optional
        Of a panel, any unit of length.

    Examples
    --------
    >>> map_sheet(2, 3)
    <Sheet: 6 faces, 7 creases, 12 vertices, flat>
    """
    return _mesh(
        rows,
        columns,
        lambda i, j: (width * j, height * i),
        lambda i, j: "U",
        lambda i, j: "V",
        f"Map {rows} x {columns}",
    )


def _mesh(
    rows: int,
    columns: int,
    place: Callable[[int, int], Place],
    across: Callable[[int, int], str],
    along: Callable[[int, int], str],
    title: str,
) -> Sheet:
    """Return a mesh by the places of its vertices.

    Letters are those of the edges from a vertex to the next in its row, and to the next in its column.
    """
    number = {(i, j): i * (columns + 1) + j for i in range(rows + 1) for j in range(columns + 1)}
    letters = {}
    for (i, j), vertex in number.items():
        if j < columns:
            letters[frozenset((vertex, number[i, j + 1]))] = across(i, j)
        if i < rows:
            letters[frozenset((vertex, number[i + 1, j]))] = along(i, j)
    faces = [
        (number[i, j], number[i, j + 1], number[i + 1, j + 1], number[i + 1, j])
        for i in range(rows)
        for j in range(columns)
    ]
    return sheet_of_faces([place(i, j) for i, j in number], faces, title, letters)


def _meeting(
    one: tuple[float, float], way: float, two: tuple[float, float], other: float
) -> tuple[float, float] | None:
    """Return where two rays meet, or None."""
    turn = sin(other - way)
    x, y = two[0] - one[0], two[1] - one[1]
    far = (x * sin(other) - y * cos(other)) / turn
    near = (x * sin(way) - y * cos(way)) / turn
    return (one[0] + far * cos(way), one[1] + far * sin(way)) if min(far, near) > 1e-6 else None
