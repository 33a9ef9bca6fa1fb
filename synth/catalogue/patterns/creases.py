"""Crease patterns by their parameters: single vertices and bases, meshes, triangles, twists, tubes, a cylinder.

Angles are radians, lengths any unit. Theory: docs/theory/generators.md, docs/theory/activating-constraints.md.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import acos, cos, degrees, dist, isclose, log, pi, sin, sqrt, tan

import numpy as np

from graphs.errors import InvariantError
from graphs.mechanism.sheet import Sheet, sides_of_face
from graphs.types import Floats
from synth.catalogue.patterns.panels import Corners, Place, sheet_of_faces, sheet_of_panels


def fan(directions: Sequence[float], letters: str = "", title: str = "") -> Sheet:
    """Return a flat vertex with creases of length 1 in rising directions, radians, unassigned without letters."""
    n = len(directions)
    places = ((0.0, 0.0), *((cos(t), sin(t)) for t in directions))
    faces = tuple((0, i + 1, (i + 1) % n + 1) for i in range(n))
    return Sheet(n + 1, tuple((0, i + 1) for i in range(n)), letters or "U" * n, faces, places, title)


def waterbomb_base() -> Sheet:
    """Return the waterbomb base: two diagonals and one line between middles of sides."""
    return fan([k * pi / 4 for k in (0, 1, 3, 4, 5, 7)], "MVVMVV", "Waterbomb base")


def preliminary_base() -> Sheet:
    """Return the preliminary base with all its creases: two diagonals, two lines between middles of sides."""
    return fan([k * pi / 4 for k in range(8)], "VUVMVUVM", "Preliminary base")


def bird_base() -> Sheet:
    """Return the crease pattern of the bird base of a square of side 2: 16 triangles, flat.

    Creases from a corner bisect half of its right angle. They meet the lines between the middles of the sides at 1
    - tan(pi / 8) = 2 - sqrt(2) from the centre: the tips.
    """
    tip_at = 2 - sqrt(2)
    corners: list[Place] = [(1, 1), (-1, 1), (-1, -1), (1, -1)]
    middles: list[Place] = [(1, 0), (0, 1), (-1, 0), (0, -1)]
    tips = [(tip_at * x, tip_at * y) for x, y in middles]
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
    return sheet_of_faces([(0, 0), *corners, *middles, *tips], faces, "Bird base", letters)


def fortune_teller() -> Sheet:
    """Return the fortune teller: a square with diagonals, lines between middles of sides, and creases across corners.

    Eight triangles are about the centre, and a pair at each corner. The creases across a corner meet its diagonal at
    right angles: the corner is folded back, and its diagonal stays flat, or it follows its diagonal. It is unassigned:
    it opens in two ways.
    """
    places: list[Place] = [(0, 0), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)]
    places += [(0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5), (0.5, -0.5)]
    faces: list[tuple[int, ...]] = []
    for k in range(4):
        before, corner, after, bend = 2 * k + 1, 2 * k + 2, (2 * k + 2) % 8 + 1, 9 + k
        faces += [(0, before, bend), (0, bend, after), (bend, before, corner), (bend, corner, after)]
    return sheet_of_faces(places, faces, "Fortune teller")


def miura(rows: int, columns: int, sector: float, straight: float = 1.0, zigzag: float = 1.0) -> Sheet:
    """Return a flat Miura sheet: ``rows`` panels along each straight line, ``columns`` along each zigzag."""
    # K. Miura, "Method of packaging and deployment of large membranes in space" (1985).

    def place(i: int, j: int) -> Place:
        return (j * zigzag * sin(sector), i * straight + j % 2 * zigzag * cos(sector))

    return _mesh(rows, columns, place, "MV", "VM", f"Miura sheet {rows} x {columns}")


def folded_miura(
    rows: int, columns: int, tilt: float, sector: float, straight: float = 1.0, zigzag: float = 1.0, title: str = ""
) -> Sheet:
    """Return a Miura sheet folded until its panels are at an angle, the tilt (radians), to the base plane."""
    # Lengths of the unit cell: M. Schenk and S. D. Guest, "Geometry of Miura-folded metamaterials" (2013).
    height = straight * sin(tilt) * sin(sector)
    wide = cos(tilt) ** 2 * tan(sector) ** 2
    across = zigzag * cos(tilt) * tan(sector) / sqrt(1 + wide)
    along = straight * sqrt(1 - sin(tilt) ** 2 * sin(sector) ** 2)
    shift = zigzag / sqrt(1 + wide)

    def place(i: int, j: int) -> Place:
        return (j * across, i * along + j % 2 * shift, i % 2 * height)

    return _mesh(rows, columns, place, "MV", "MV", title or f"Miura mesh {rows} x {columns}, folded")


def chickenwire(rows: int, columns: int, sector: float, straight: float = 2.0) -> Sheet:
    """Return flat chicken wire: hexagons in columns, each halved along a straight line into two trapezoids."""
    # T. A. Evans and others, "Rigidly foldable origami gadgets and tessellations" (2015).

    def place(i: int, j: int) -> Place:
        return (j * sin(sector), i * straight + (-1) ** (i + j) * cos(sector) / 2)

    return _mesh(rows, columns, place, "M", "MV", f"Chicken wire {rows} x {columns}")


def huffman_grid(rows: int, columns: int, first: float, second: float, side: float = 1.0) -> Sheet:
    """Return Huffman's grid: copies of one quadrilateral, each rotated by a half turn about the side it shares.

    Raise InvariantError where the quadrilateral is not convex, or its angles `first` and `second` are equal or
    supplementary.
    """
    # D. A. Huffman, "Curvature and creases" (1976); any convex one: A. Kokotsakis (1933), H. Stachel (2010).
    if isclose(first, second, abs_tol=1e-3) or isclose(first + second, pi, abs_tol=1e-3):
        angles = f"{degrees(first):g} and {degrees(second):g} degrees"
        raise InvariantError("huffman-grid", f"angles of {angles}", "neither equal nor together 180 degrees")
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
    return _mesh(rows, columns, place, "M", "MV", f"Huffman's grid {rows} x {columns}")


def map_sheet(rows: int, columns: int, width: float = 1.3, height: float = 1.0) -> Sheet:
    """Return a map: a flat grid of rectangles, which folds across its columns, as assigned, or across its rows."""
    return _mesh(rows, columns, lambda i, j: (width * j, height * i), "U", "V", f"Map {rows} x {columns}")


def _mesh(rows: int, columns: int, place: Callable[[int, int], Place], across: str, along: str, title: str) -> Sheet:
    """Return a mesh by its vertices; edges in rows have letters in turn by row, others by diagonal."""
    number = {(i, j): i * (columns + 1) + j for i in range(rows + 1) for j in range(columns + 1)}
    letters = {}
    for (i, j), vertex in number.items():
        if j < columns:
            letters[frozenset((vertex, number[i, j + 1]))] = across[i % len(across)]
        if i < rows:
            letters[frozenset((vertex, number[i + 1, j]))] = along[(i + j) % len(along)]
    faces = [
        (number[i, j], number[i, j + 1], number[i + 1, j + 1], number[i + 1, j])
        for i in range(rows)
        for j in range(columns)
    ]
    return sheet_of_faces([place(i, j) for i, j in number], faces, title, letters)


def _meeting(start: Place, way: float, other_start: Place, other_way: float) -> Place | None:
    """Return where two rays, each from a point in a direction (radians), meet; None if they do not."""
    turn = sin(other_way - way)
    x, y = other_start[0] - start[0], other_start[1] - start[1]
    far = (x * sin(other_way) - y * cos(other_way)) / turn  # along the first ray
    near = (x * sin(way) - y * cos(way)) / turn  # along the other
    return (start[0] + far * cos(way), start[1] + far * sin(way)) if min(far, near) > 1e-6 else None


def freedoms_of_triangles(sheet: Sheet) -> int:
    """Return the freedoms of a disc of triangles: its border's vertices less three."""
    # Each triangle more adds a border vertex and a freedom, or closes a vertex with three equations.
    border = {v for edge, letter in zip(sheet.edges, sheet.assignments, strict=True) if letter == "B" for v in edge}
    return len(border) - 3


def yoshimura(rows: int, columns: int, width: float = 1.0, height: float = 0.6) -> Sheet:
    """Return Yoshimura's pattern: diamonds, each halved by a valley along its row."""
    # Y. Yoshimura, "On the mechanism of buckling of a circular cylindrical shell under axial compression" (1955).

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
    """Return the waterbomb tessellation: waterbomb bases of side 2, columns shifted by half a square."""
    # Y. Chen, H. Feng, J. Ma, R. Peng, Z. You, "Symmetric waterbomb origami" (2016).
    panels: list[list[Place]] = []
    for column in range(columns):
        for row in range(rows):
            x, y = 2.0 * column + 1, 2.0 * row + 1 + column % 2
            border = [(x - 1, y - 1), (x + 1, y - 1), (x + 1, y), (x + 1, y + 1), (x - 1, y + 1), (x - 1, y)]
            panels += [[(x, y), a, b] for a, b in sides_of_face(border)]
    sheet = sheet_of_panels(panels, f"Waterbomb tessellation {rows} x {columns}")
    return _lettered(sheet, lambda a, b: "V" if min(abs(a[0] - b[0]), abs(a[1] - b[1])) > 0.5 else "M")


def resch(rows: int, columns: int) -> Sheet:
    """Return Resch's triangles: tiles of side 1, and triangles of side 2 that fold to stars of three arms.

    A large triangle is divided from its middle into six with angles of 30, 60 and 90 degrees. Sources: R. D.
    Resch, "Self-supporting structural unit having a series of repetitious geometrical modules", patent (1968); T.
    Tachi, "Designing freeform origami tessellations by generalizing Resch's patterns" (2013).
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
                middle_of_tile = tuple(round(sum(c[k] for c in tile) / 3, 6) + 0.0 for k in (0, 1))
                tiles.setdefault(middle_of_tile, tile)  # neighbouring triangles share it
    sheet = sheet_of_panels([*panels, *tiles.values()], f"Resch's triangles {rows} x {columns}")
    # Folded, long spokes are the lower edges of fins; where tiles bend down, and fins meet, there are mountains.
    return _lettered(sheet, lambda a, b: "V" if dist(a, b) > _LONG else "M")


_LONG = 1.1
"""Between the sides of tiles and the lines from the middle of a large triangle to its corners."""


def _lettered(sheet: Sheet, letter: Callable[[Place, Place], str]) -> Sheet:
    """Return a sheet whose creases have the letters that `letter` gives for their ends."""
    places = sheet.coordinates
    assert places is not None
    letters = [
        "B" if mark == "B" else letter(places[a], places[b])
        for (a, b), mark in zip(sheet.edges, sheet.assignments, strict=True)
    ]
    return replace(sheet, assignments="".join(letters))


def _off(middle: Place, radius: float, angle: float) -> Place:
    return (middle[0] + radius * cos(angle), middle[1] + radius * sin(angle))


def _beyond(a: Place, b: Place) -> Place:
    """Return the third corner of the equilateral triangle to the right of a line."""
    x, y = b[0] - a[0], b[1] - a[1]
    return (a[0] + x / 2 + y * sqrt(3.0) / 2, a[1] + y / 2 - x * sqrt(3.0) / 2)


def polygon_twist(sides: int, twist: float, radius: float = 0.35, letters: str = "", title: str = "") -> Sheet:
    """Return a twist: a regular polygon in the middle of another, and a straight pleat from each of its sides.

    `letters` has one for each side of the middle polygon, then two for the creases of each pleat; by default sides
    and second creases are mountains, first creases valleys.
    """
    step = 2 * pi / sides
    inner = [_off((0.0, 0.0), radius, k * step - step / 2 - twist) for k in range(sides)]
    places: list[Place] = list(inner)
    ends = {}
    for k in range(sides):  # pleat k leaves the polygon across its side k, square to a side of the sheet
        for v in (k, (k + 1) % sides):
            ends[k, v] = len(places)
            places.append(_turned((1.0, _turned(inner[v], -k, sides)[1]), k, sides))
    corners = range(len(places), len(places) + sides)
    places += [_turned((1.0, sin(step / 2) / cos(step / 2)), k, sides) for k in range(sides)]
    faces: list[tuple[int, ...]] = [tuple(range(sides))]
    marks = {}
    assigned = letters or "M" * sides + "V" * sides + "M" * sides
    for k in range(sides):
        after = (k + 1) % sides
        faces.append((k, ends[k, k], ends[k, after], after))
        faces.append((after, ends[k, after], corners[k], ends[after, after]))
        marks[frozenset((k, after))] = assigned[k]
        marks[frozenset((k, ends[k, k]))] = assigned[sides + k]
        marks[frozenset((after, ends[k, after]))] = assigned[2 * sides + k]
    return sheet_of_faces(places, faces, title or f"Twist of {sides} sides", marks)


def square_twist(twist: float, radius: float = 0.35) -> Sheet:
    """Return a square twist, assigned so that it is rigid-foldable: two neighbouring vertices in either mode."""
    return polygon_twist(4, twist, radius, "MMVV" + "VVMM" + "MMVV", "Square twist")


def hexagon_twist(other: int, radius: float = 0.35) -> Sheet:
    """Return a rigid-foldable hexagon twist with 1 or 2 vertices in the `other` mode."""
    if other not in (1, 2):
        raise InvariantError("hexagon-twist", f"{other} vertices in the other mode", "1 or 2")
    firsts = "M" * other + "V" * (6 - other)
    seconds = firsts[1:] + firsts[0]  # the second crease of a pleat ends at the next vertex
    swapped = seconds.translate(str.maketrans("MV", "VM"))
    return polygon_twist(6, _rigid_twist(other), radius, "M" * 6 + firsts + swapped, "Hexagon twist")


def _rigid_twist(other: int) -> float:
    """Return the twist at which the product of the multipliers of a hexagon's vertices is 1.

    With g = tan(60 degrees), x = tan((90 degrees - twist) / 2) they are (g x + 1) / (g x - 1) and (g - x) / (g +
    x).
    """
    from scipy.optimize import brentq  # takes half a second to load

    slope = tan(pi / 3)

    def product(twist: float) -> float:
        half = tan((pi / 2 - twist) / 2)
        return other * log((slope * half + 1) / (slope * half - 1)) - (6 - other) * log((slope + half) / (slope - half))

    return float(brentq(product, 0.0, pi / 6 - 1e-9, xtol=1e-16, rtol=1e-15))


def _turned(point: Place, steps: int, sides: int) -> Place:
    """Return a point rotated by steps of a regular polygon; quarter turns are exact."""
    x, y = point
    if sides == 4:
        for _ in range(steps % 4):
            x, y = -y, x
        return (x, y)
    c, s = cos(2 * pi * steps / sides), sin(2 * pi * steps / sides)
    return (c * x - s * y, s * x + c * y)


def miura_tube(columns: int, sector: float, tilt: float, straight: float = 1.0, zigzag: float = 1.0) -> Sheet:
    """Return two folded Miura strips, mirror images in the plane of their long edges, joined along these."""
    # T. Tachi and K. Miura, "Rigid-foldable cylinders and cells" (2012).
    strip = folded_miura(2, columns, tilt, sector, straight, zigzag)
    assert strip.coordinates is not None
    upper: list[list[Place]] = [[strip.coordinates[v] for v in face] for face in strip.faces]
    lower = [[(x, y, -z) for x, y, z in panel] for panel in upper]
    return sheet_of_panels([*upper, *lower], f"Tube of Miura strips, {columns} long")


def kresling(sides: int, ends: int, turn: float = 0.5, height: float = 0.8) -> Sheet:
    """Return one storey of Kresling's pattern: two regular polygons, `ends` of them panels, triangles between."""
    # B. Kresling, "Plant 'design': mechanical simulations of growth patterns and bionics" (1996).
    below = [(cos(2 * pi * k / sides), sin(2 * pi * k / sides), 0.0) for k in range(sides)]
    above = [(cos(2 * pi * k / sides + turn), sin(2 * pi * k / sides + turn), height) for k in range(sides)]
    panels: list[Corners] = []
    for k in range(sides):
        following = (k + 1) % sides
        panels += [[below[k], below[following], above[k]], [below[following], above[following], above[k]]]
    return sheet_of_panels([*panels, *[below[::-1], above][:ends]], f"Storey of Kresling's pattern, {sides} sides")


_MIDDLE = 0.45
"""Length of the crease between the links of a ride-along, in widths of a wall: a little less than half a wall."""


def sectors_of_ride_alongs(pleats: int, slack: float) -> tuple[float, float]:
    """Return the sector of each ride-along link at an outer and at an inner crease, radians.

    A ride-along is straight where the angle between the walls is twice the sector. The angles at inner creases,
    seen from outside, are together 360 degrees more than those at outer ones, so both kinds are straight at once.
    """
    return pi / 2 - pi / pleats - slack, pi / 2 - slack


def deployable_cylinder(pleats: int, short: float, slack: float, height: float = 1.0) -> Sheet:
    """Return a ring of pleats with a ride-along on each crease, which stops it where the ride-along is straight.

    Walls are 1 wide. Raise InvariantError if they would coincide or pass each other. Source of the principle:
    Wiener 2016, section 6.3; the proportions are chosen here.
    """
    outer, inner = sectors_of_ride_alongs(pleats, slack)
    opening = 2.0 * outer - short
    if opening <= 0.0:
        what = f"short = {degrees(short):g} degrees leaves no angle between the walls at outer creases"
        raise InvariantError("short", what, f"less than {degrees(2.0 * outer):g} degrees")
    feet, up = _feet(pleats, opening), np.array([0.0, 0.0, height])
    tops, middles = feet + up, (feet + np.roll(feet, -1, axis=0)) / 2.0 + up  # of creases, and of walls
    walls = [feet, np.roll(feet, -1, axis=0), np.roll(tops, -1, axis=0), middles, tops]
    panels: list[Corners] = np.stack(walls, axis=1).tolist()
    for k, top in enumerate(tops):
        panels += _ride_along(middles[k - 1], top, middles[k], inner if k % 2 else outer)
    return sheet_of_panels(panels, f"Radially deployable cylinder of {pleats} pleats")


def _feet(pleats: int, opening: float) -> Floats:
    """Return where creases meet the floor, the first an outer one, of walls 1 wide: float[2 pleats, 3]."""
    turn = pi / pleats
    far, near = (sin(angle) / sin(turn) for angle in (turn + opening / 2.0, opening / 2.0))
    places = enumerate((far, near) * pleats)
    return np.array([(radius * cos(k * turn), radius * sin(k * turn), 0.0) for k, radius in places])


def _ride_along(left: Floats, top: Floats, right: Floats, sector: float) -> list[Corners]:
    """Return the two triangles on the upper half edges of the walls at a crease, from its upper end."""
    towards = (left + right) / 2.0 - top
    half_way = float((towards * towards).sum()) ** 0.5
    lean = acos(min(1.0, cos(sector) / (2.0 * half_way)))
    tip = top + _MIDDLE * cos(lean) / half_way * towards + np.array([0.0, 0.0, _MIDDLE * sin(lean)])
    triangles: list[Corners] = np.array([[top, left, tip], [top, tip, right]]).tolist()
    return triangles
