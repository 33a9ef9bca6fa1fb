"""The generators of crease patterns. Theory: docs/theory/generators.md."""

from __future__ import annotations

from math import isclose, pi

from synth.patterns.creases import bases, cylinders, tessellations, triangulated, tubes, twists
from synth.patterns.generator import Generator, Values, angle, count, length

__all__ = ["GENERATORS"]

_MESH = (
    count("rows", 3, 2, 12, "number of rows of panels"),
    count("columns", 3, 2, 12, "number of columns of panels"),
)
_TILES = (
    count("rows", 2, 1, 8, "number of rows of units"),
    count("columns", 2, 1, 8, "number of columns of units"),
)
_SECTOR = angle("sector", 60, 20, 85, "acute angle of the panels")
_SIDES = (
    length("straight", 1.0, 0.1, 10, "side of a panel along the straight lines"),
    length("zigzag", 1.0, 0.1, 10, "side of a panel along the zigzags"),
)
_TRIANGLES = "all panels are triangles: the number of border vertices minus three"


def _of_storey(values: Values) -> int:
    """Return the freedoms of a storey.

    Round a panel the triangles' angles follow from each other; turned by half a side they do so both ways
    alike, and an even number of them alternates between two.
    """
    sides = int(values["sides"])
    if not values["ends"]:
        return 2 * sides - 6
    half_a_side = isclose(values["turn"], pi / sides, abs_tol=1e-9)
    return int(values["ends"] == 1 and sides % 2 == 0 and half_a_side)


GENERATORS = (
    Generator(
        "miura", "Miura sheet", tessellations.miura, (*_MESH, _SECTOR, *_SIDES), lambda _: 1,
        "on the assigned branch; on another branch the straight lines fold alone", "Miura 1985", True,
    ),
    Generator(
        "miura-tube", "Tube of two Miura strips", tubes.miura_tube,
        (
            count("columns", 3, 1, 20, "number of panels along the tube"),
            _SECTOR,
            angle("tilt", 35, 5, 80, "angle between a panel and the plane of symmetry"),
            *_SIDES,
        ),
        lambda _: 1, "the strips are mirror images of each other", "Tachi and Miura 2012",
    ),
    Generator(
        "yoshimura", "Yoshimura's pattern", triangulated.yoshimura,
        (
            count("rows", 3, 1, 10, "number of rows of triangles"),
            count("columns", 2, 1, 10, "number of pairs of triangles in a row"),
            length("width", 1.0, 0.1, 10, "width of a triangle"),
            length("height", 0.6, 0.1, 10, "height of a triangle"),
        ),
        lambda v: int(2 * (v["rows"] + v["columns"])) - 3, _TRIANGLES, "Yoshimura 1955", True,
    ),
    Generator(
        "waterbomb", "Waterbomb tessellation", triangulated.waterbomb, _TILES,
        lambda v: int(4 * (v["rows"] + v["columns"])) - 5, _TRIANGLES, "Chen, Feng, Ma, Peng, You 2016", True,
    ),
    Generator(
        "resch", "Resch's triangles", triangulated.resch,
        (
            count("rows", 1, 1, 5, "number of rows of large triangles"),
            count("columns", 1, 1, 5, "number of columns of large triangles"),
        ),
        lambda v: triangulated.freedoms_of_triangles(triangulated.resch(int(v["rows"]), int(v["columns"]))),
        _TRIANGLES, "Resch 1968; Tachi 2013", True,
    ),
    Generator(
        "square-twist", "Square twist", twists.square_twist,
        (
            angle("twist", 22.5, 5, 40, "rotation of the middle square"),
            length("radius", 0.35, 0.1, 0.5, "radius of the middle square's corners; the sheet has sides of 2"),
        ),
        lambda _: 1, "two vertices in either mode, as assigned; not with all four alike",
        "Evans, Lang, Magleby, Howell 2015", True,
    ),
    Generator(
        "hexagon-twist", "Hexagon twist", twists.hexagon_twist,
        (
            count("other", 2, 1, 2, "number of vertices in the other mode, which determines the twist"),
            length("radius", 0.35, 0.1, 0.5, "radius of the middle hexagon's corners; the sheet's sides are at 1"),
        ),
        lambda _: 1, "the product of the six multipliers is 1: sin(twist) = 1/4 for two vertices in the "
"other mode",
        "Evans, Lang, Magleby, Howell 2015", True,
    ),
    Generator(
        "huffman-grid", "Huffman's grid", tessellations.huffman_grid,
        (
            *_MESH,
            angle("first", 75, 70, 88, "first angle of the quadrilateral"),
            angle("second", 60, 56, 68, "second angle of the quadrilateral, next to the first"),
            length("side", 1.0, 0.8, 1.2, "side at the first angle; the side between both angles is 1"),
        ),
        lambda _: 1, "all vertices fold alike", "Huffman 1976; Kokotsakis 1933; Stachel 2010", True,
        "side sin(first + second) is less than sin(second)",
    ),
    Generator(
        "kresling", "Storey of Kresling's pattern", tubes.kresling,
        (
            count("sides", 6, 4, 24, "number of sides of the polygons"),
            count("ends", 0, 0, 2, "number of polygons that are panels"),
            angle("turn", 20, 5, 60, "rotation of the upper polygon relative to the lower"),
            length("height", 0.8, 0.2, 3, "height in radii of the polygons"),
        ),
        _of_storey,
        "open ends: 2 sides - 6; a polygon that is a panel: none, but 1 if the other is open, sides are even "
        "and turn is half a side", "Kresling 1996",
    ),
    Generator(
        "deployable-cylinder", "Radially deployable cylinder", cylinders.deployable_cylinder,
        (
            count("pleats", 4, 3, 12, "number of pairs of walls"),
            angle("short", 30, 1, 45, "angle by which each crease is short of straight ride-alongs"),
            angle("slack", 5, 1, 10, "half the angle of walls at inner creases from flat, ride-alongs straight"),
            length("height", 1.0, 0.2, 10, "height of the walls, whose width is 1"),
        ),
        lambda v: 2 * int(v["pleats"]) - 3,
        "until the ride-alongs are straight, where it stops; rigid while they are held "
"straight, see `synth limits`",
        "Wiener 2016, 6.3; proportions chosen", relations="short is less than 180 - 360 / pleats - 2 slack",
    ),
    Generator(
        "map", "Map", tessellations.map_sheet,
        (
            *_MESH,
            length("width", 1.3, 0.1, 10, "width of a panel"),
            length("height", 1.0, 0.1, 10, "height of a panel"),
        ),
        lambda v: int(v["columns"]) - 1, "across its columns, as assigned; across its rows, rows - 1",
        "vertices of four creases in two lines", True,
    ),
    Generator(
        "chickenwire", "Chicken wire", tessellations.chickenwire,
        (*_MESH, _SECTOR, length("straight", 2.0, 1.1, 10, "middle line of a panel; its legs are 1")),
        lambda _: 1, "on the assigned branch; on another branch the straight lines fold alone",
        "Evans, Lang, Magleby, Howell 2015", True,
    ),
    Generator(
        "waterbomb-base", "Waterbomb base", bases.waterbomb_base, (), lambda _: 3, "six creases at a vertex",
        "a spherical loop of six", True,
    ),
    Generator(
        "preliminary-base", "Preliminary base", bases.preliminary_base, (), lambda _: 5,
        "eight creases at a vertex", "a spherical loop of eight", True,
    ),
    Generator(
        "bird-base", "Bird base", bases.bird_base, (), lambda _: 5,
        "on each of its 16 branches; the tips are at 2 - sqrt(2) of half the side", "tradition", True,
    ),
)  # fmt: skip
