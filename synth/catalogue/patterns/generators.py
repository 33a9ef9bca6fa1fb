"""All generators, by name, with their parameters, conditions and sources. Theory: docs/theory/generators.md."""

from functools import partial
from math import isclose, pi

from graphs.joints.linkage import JointedLinkage
from synth.catalogue.patterns import cartons, creases, hinged_rings, platforms, scissors
from synth.catalogue.patterns.generator import Generator, Parameter, Values, angle, count, length

_MESH = (
    count("rows", 3, 2, 400, "number of rows of panels"),
    count("columns", 3, 2, 400, "number of columns of panels"),
)
_TILES = (
    count("rows", 2, 1, 150, "number of rows of units"),
    count("columns", 2, 1, 150, "number of columns of units"),
)
_SECTOR = angle("sector", 60, 20, 85, "acute angle of the panels")
_SIDES = (
    length("straight", 1.0, 0.1, 10, "side of a panel along the straight lines"),
    length("zigzag", 1.0, 0.1, 10, "side of a panel along the zigzags"),
)
_TRIANGLES = "all panels are triangles: the number of border vertices minus three"


def _of_storey(values: Values) -> int:
    """Return the freedoms of a storey.

    Round a panel the triangles' angles determine each other; rotated by half a side they do so both ways alike.
    """
    sides = int(values["sides"])
    if not values["ends"]:
        return 2 * sides - 6
    half_a_side = isclose(values["turn"], pi / sides, abs_tol=1e-9)
    return int(values["ends"] == 1 and sides % 2 == 0 and half_a_side)


_CREASES = (
    Generator(
        "miura", "Miura sheet", creases.miura, (*_MESH, _SECTOR, *_SIDES), lambda _: 1,
        "on the assigned branch; on another branch the straight lines fold alone", "Miura 1985", True,
    ),
    Generator(
        "miura-tube", "Tube of two Miura strips", creases.miura_tube,
        (
            count("columns", 3, 1, 20, "number of panels along the tube"),
            _SECTOR,
            angle("tilt", 35, 5, 80, "angle between a panel and the plane of symmetry"),
            *_SIDES,
        ),
        lambda _: 1, "the strips are mirror images of each other", "Tachi and Miura 2012",
    ),
    Generator(
        "yoshimura", "Yoshimura's pattern", creases.yoshimura,
        (
            count("rows", 3, 1, 10, "number of rows of triangles"),
            count("columns", 2, 1, 10, "number of pairs of triangles in a row"),
            length("width", 1.0, 0.1, 10, "width of a triangle"),
            length("height", 0.6, 0.1, 10, "height of a triangle"),
        ),
        lambda v: int(2 * (v["rows"] + v["columns"])) - 3, _TRIANGLES, "Yoshimura 1955", True,
    ),
    Generator(
        "waterbomb", "Waterbomb tessellation", creases.waterbomb, _TILES,
        lambda v: int(4 * (v["rows"] + v["columns"])) - 5, _TRIANGLES, "Chen, Feng, Ma, Peng, You 2016", True,
    ),
    Generator(
        "resch", "Resch's triangles", creases.resch,
        (
            count("rows", 1, 1, 100, "number of rows of large triangles"),
            count("columns", 1, 1, 100, "number of columns of large triangles"),
        ),
        lambda v: creases.freedoms_of_triangles(creases.resch(int(v["rows"]), int(v["columns"]))),
        _TRIANGLES, "Resch 1968; Tachi 2013", True,
    ),
    Generator(
        "square-twist", "Square twist", creases.square_twist,
        (
            angle("twist", 22.5, 5, 40, "rotation of the middle square"),
            length("radius", 0.35, 0.1, 0.5, "radius of the middle square's corners; the sheet has sides of 2"),
        ),
        lambda _: 1, "two vertices in either mode, as assigned; not with all four alike",
        "Evans, Lang, Magleby, Howell 2015", True,
    ),
    Generator(
        "hexagon-twist", "Hexagon twist", creases.hexagon_twist,
        (
            count("other", 2, 1, 2, "number of vertices in the other mode, which determines the twist"),
            length("radius", 0.35, 0.1, 0.5, "radius of the middle hexagon's corners; the sheet's sides are at 1"),
        ),
        lambda _: 1,
        "the product of the six multipliers is 1: sin(twist) = 1/4 for two vertices in the other mode",
        "Evans, Lang, Magleby, Howell 2015", True,
    ),
    Generator(
        "huffman-grid", "Huffman's grid", creases.huffman_grid,
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
        "kresling", "Storey of Kresling's pattern", creases.kresling,
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
        "deployable-cylinder", "Radially deployable cylinder", creases.deployable_cylinder,
        (
            count("pleats", 4, 3, 12, "number of pairs of walls"),
            angle("short", 30, 1, 45, "angle by which each crease is short of straight ride-alongs"),
            angle("slack", 5, 1, 10, "half the angle of walls at inner creases from flat, ride-alongs straight"),
            length("height", 1.0, 0.2, 10, "height of the walls, whose width is 1"),
        ),
        lambda v: 2 * int(v["pleats"]) - 3,
        "until the ride-alongs are straight, where it stops; rigid while they are held straight, "
        "see `synth limits`",
        "Wiener 2016, 6.3; proportions chosen", relations="short is less than 180 - 360 / pleats - 2 slack",
    ),
    Generator(
        "map", "Map", creases.map_sheet,
        (
            *_MESH,
            length("width", 1.3, 0.1, 10, "width of a panel"),
            length("height", 1.0, 0.1, 10, "height of a panel"),
        ),
        lambda v: int(v["columns"]) - 1, "across its columns, as assigned; across its rows, rows - 1",
        "vertices of four creases in two lines", True,
    ),
    Generator(
        "chickenwire", "Chicken wire", creases.chickenwire,
        (*_MESH, _SECTOR, length("straight", 2.0, 1.1, 10, "middle line of a panel; its legs are 1")),
        lambda _: 1, "on the assigned branch; on another branch the straight lines fold alone",
        "Evans, Lang, Magleby, Howell 2015", True,
    ),
    Generator(
        "waterbomb-base", "Waterbomb base", creases.waterbomb_base, (), lambda _: 3, "six creases at a vertex",
        "a spherical loop of six", True,
    ),
    Generator(
        "preliminary-base", "Preliminary base", creases.preliminary_base, (), lambda _: 5,
        "eight creases at a vertex", "a spherical loop of eight", True,
    ),
    Generator(
        "bird-base", "Bird base", creases.bird_base, (), lambda _: 5,
        "on each of its 16 branches; the tips are at 2 - sqrt(2) of half the side", "tradition", True,
    ),
    Generator(
        "fortune-teller", "Fortune teller", creases.fortune_teller, (), lambda _: 5,
        "on each of its 17 branches: a corner is folded back, or follows its diagonal", "Wiener 2016, 4.1.4.4", True,
    ),
)  # fmt: skip


_FIRST = angle("first", 60, 20, 160, "angle of the first joint")
_TWIST = angle("twist", 40, 15, 55, "angle between the axes of a solid")
_FIVE = ", no five by more than 720"
_ARCS = (75, 80, 70, 85, 65, 60)


def _arcs(links: int) -> tuple[Parameter, ...]:
    return tuple(angle(f"arc{i + 1}", _ARCS[i], 5, 175, f"arc of link {i}") for i in range(links))


_RINGS = (
    Generator(
        "sarrus", "Linkage of Sarrus", hinged_rings.sarrus,
        (
            length("side", 1.0, 0.1, 10, "side of the plates"),
            length("height", 1.6, 0.1, 10, "height between the plates"),
            length("out", 0.6, 0.1, 10, "distance of the knees from the plates"),
        ),
        lambda _: 1, "two triples of parallel axes, not parallel to each other", "Sarrus 1853",
    ),
    Generator(
        "bennett", "Bennett's linkage", hinged_rings.bennett,
        (_FIRST, _TWIST, angle("other", 70, 60, 120, "angle between the axes of the adjacent solids")),
        lambda _: 1, "opposite solids alike, lengths proportional to the sines of the twists", "Bennett 1903",
    ),
    Generator(
        "goldberg", "Goldberg's linkage of five", hinged_rings.goldberg,
        (
            _FIRST,
            _TWIST,
            angle("shared", 70, 60, 85, "twist of the solid that is left out"),
            angle("other", 100, 96, 115, "twist of the second linkage's own solids"),
            angle("offset", 0, 0, 120, "angle between the two solids that are joined to one"),
        ),
        lambda _: 1,
        "two Bennett linkages with a solid in common, lengths proportional to the sines of the twists",
        "Goldberg 1943", relations="other + shared is not 180 degrees",
    ),
    Generator(
        "myard", "Myard's linkage of five", hinged_rings.myard, (_FIRST, _TWIST), lambda _: 1,
        "Goldberg's linkage of two mirror images with a common twist of 90 degrees", "Myard 1931",
    ),
    Generator(
        "bricard-line-symmetric", "Bricard's line-symmetric linkage", hinged_rings.line_symmetric,
        (angle("lean", 0, 0, 40, "rotation of three of the axes about the x axis"),),
        lambda _: 1, "a half turn about the z axis maps each axis to its opposite", "Bricard 1927",
    ),
    Generator(
        "bricard-plane-symmetric", "Bricard's plane-symmetric linkage", hinged_rings.plane_symmetric,
        (length("height", 0.0, 0.0, 0.5, "height of the second axis and its mirror image"),),
        lambda _: 1, "two axes in the plane y = 0, and mirror symmetry of the others in it", "Bricard 1927",
    ),
    Generator(
        "bricard-trihedral", "Bricard's trihedral linkage", hinged_rings.trihedral,
        tuple(
            length(name, default, 0.5, 2.0, f"{name} length of a solid; three more follow from the others")
            for name, default in (("first", 1.0), ("second", 0.8), ("third", 1.3))
        ),
        lambda _: 1, "right-angle twists, no offsets, and equal sums of the squares of alternate lengths",
        "Bricard 1927",
    ),
    Generator(
        "kaleidocycle", "Kaleidocycle", hinged_rings.kaleidocycle,
        (
            count("solids", 6, 6, 24, "number of solids in the ring"),
            angle("tilt", 50, 35, 52, "angle of every second axis to the ring's; for an even number only"),
        ),
        lambda v: max(int(v["solids"]) - 6, 1),
        "right-angle twists and equal lengths; with seven or more solids, on the general branch",
        "Schatz 1929; Schattschneider and Walker 1977",
    ),
    *(
        Generator(
            f"{word}-bar", f"Spherical {word}-bar", lambda **arcs: hinged_rings.spherical_ring([*arcs.values()]),
            _arcs(links), lambda v: len(v) - 3, "axes through one point", "three equations per loop",
            relations="no arc is longer than the others together, no three by more than 360 degrees" + more,
        )
        for word, links, more in (("four", 4, ""), ("five", 5, _FIVE), ("six", 6, _FIVE))
    ),
)  # fmt: skip


_OPENING = angle("opening", 90, 10, 170, "angle between the halves of the card")
_MORE = length("more", 0.5, 0.1, 5, "extra distance of the crease on the right half")

_GOODS = (
    Generator(
        "parallel-pop-up", "Pop-up across a fold, creases parallel to it", cartons.parallel_pop_up,
        (
            _OPENING,
            length("left", 2.0, 1.5, 2.5, "distance from the fold to the panel on the left half"),
            length("right", 2.0, 1.5, 2.5, "distance from the fold to the panel on the right half"),
            length("first", 3.0, 2.6, 4.0, "width of the panel on the left half"),
            length("second", 3.0, 2.6, 4.0, "width of the panel on the right half"),
        ),
        lambda _: 1, "the panels reach each other; the card closes if left + first = right + second",
        "Glassner 2002; a planar four-bar",
        relations="sqrt(left^2 + right^2 - 2 left right cos(opening)) is less than first + second, "
        "and more than their difference",
    ),
    Generator(
        "angle-pop-up", "Pop-up across a fold, creases that meet on it", cartons.angle_pop_up,
        (
            _OPENING,
            angle("base", 40, 10, 60, "angle between the fold and the creases on the card"),
            angle("rise", 75, 61, 89, "angle of each panel between its crease on the card and the ridge"),
        ),
        lambda _: 1, "panels alike on both sides that reach each other", "Glassner 2002; a spherical four-bar",
    ),
    Generator(
        "box-pop-up", "Box cut out of a card", cartons.box_pop_up,
        (
            length("depth", 1.0, 0.2, 5, "distance from the fold to the crease on the left half"),
            _MORE,
            length("width", 1.0, 0.1, 5, "width of the box"),
        ),
        lambda _: 1, "on either of two branches: the box pops up, or stays flat", "Glassner 2002", True,
    ),
    Generator(
        "beaked-box", "Box cut out of a card, whose ridge ends in a beak", cartons.beaked_box,
        (
            length("depth", 1.0, 0.6, 5, "distance from the fold to the crease on the left half"),
            _MORE,
            length("width", 1.0, 0.7, 5, "width of the box"),
            angle("angle", 40, 5, 55, "angle between the ridge and the creases of the beak"),
            length("reach", 0.6, 0.05, 0.95, "length of the beak along the ridge"),
        ),
        lambda _: 1, "a planar and a spherical loop of four that share the ridge, on each branch",
        "Wiener 2016, Fig. 36, element 1: a six-bar of one planar and one spherical loop", True,
        relations="reach is less than width, reach tan(angle) less than depth",
    ),
    Generator(
        "slit-array", "Card with a row of boxes", cartons.slit_card,
        (
            count("strips", 2, 1, 6, "number of boxes"),
            length("depth", 1.0, 0.2, 5, "distance from the fold to the creases on the left half"),
            length("more", 0.5, 0.1, 5, "extra distance of the creases on the right half"),
            length("width", 1.0, 0.1, 5, "width of a box, and of the strip between two boxes"),
        ),
        lambda _: 1, "on each branch: every box pops up or stays flat", "Glassner 2002", True,
    ),
    Generator(
        "webbed-tray", "Tray with webbed corners", cartons.webbed_tray,
        (
            length("length", 3.0, 0.5, 10, "length of the bottom"),
            length("width", 2.0, 0.5, 10, "width of the bottom"),
            length("height", 0.8, 0.1, 5, "height of the walls"),
        ),
        lambda _: 4, "one degree of freedom per wall", "spherical loops of five links at the corners", True,
    ),
    Generator(
        "crash-lock", "Carton with a crash-lock bottom", cartons.crash_lock,
        (
            angle("opening", 70, 5, 85, "angle between walls at a glued corner; at 90 degrees the bottom locks"),
            length("length", 2.0, 0.5, 10, "length of the bottom"),
            length("width", 1.4, 0.5, 10, "width of the bottom"),
            length("height", 2.0, 0.5, 10, "height of the walls"),
        ),
        lambda _: 1, "until the creases of the bottom are flat, at a right angle", "Dai and Cannella 2008",
    ),
)  # fmt: skip


_RADII = (length("base", 1.0, 0.5, 10, "radius of the feet"), length("top", 0.6, 0.1, 10, "radius of the heads"))
_HEIGHT = length("height", 1.0, 0.3, 10, "height of the top over the base")
_GAP = angle("gap", 30, 5, 50, "angle between the two feet, and the two heads, of a pair")
_OUT = length("out", 0.4, 0.1, 10, "distance of the knees from the line from foot to head")


_NONE_REMOVED = "no leg removes a degree of freedom: {} - {}"


def _platform(legs: str, freedoms: int, conditions: str, source: str) -> Generator:
    """Return the generator of a platform by its number of legs and their joints, such as ``6-UPS``."""
    number, letters = int(legs[0]), legs[2:]
    more = (*([_GAP] if number == 6 else []), *([] if "P" in letters else [_OUT]))
    make = partial(platforms.platform, letters, number)
    return Generator(
        "stewart" if legs == "6-UPS" else legs.lower(),
        f"Platform on {'six' if number == 6 else 'three'} {letters} legs", make, (*_RADII, _HEIGHT, *more),
        lambda _: freedoms, conditions, source, relations="base and top differ" if number == 3 else "",
    )  # fmt: skip


_PLATFORMS = (
    _platform("6-UPS", 6, _NONE_REMOVED.format(36, 30), "Stewart 1965; Hunt 1983"),
    _platform(
        "6-SPS", 12, "six of them are rotations of the legs about themselves: 42 - 30", "Stewart 1965; Hunt 1983"
    ),
    _platform("6-RUS", 6, _NONE_REMOVED.format(36, 30), "Hunt 1983"),
    _platform("6-UUU", 6, _NONE_REMOVED.format(36, 30), "count of freedoms (Kutzbach)"),
    _platform("3-RPS", 3, "each leg removes one degree of freedom: 15 - 12", "Hunt 1983"),
    _platform(
        "3-UPU", 3, "the axes of each leg at base and top are parallel, and so are its two transverse axes: "
        "the top only translates", "Tsai 1996",
    ),
    _platform("3-UUU", 6, _NONE_REMOVED.format(18, 12), "count of freedoms (Kutzbach)"),
    Generator(
        "3-crr", "Platform on three CRR legs that only translates", platforms.translating_platform,
        (
            length("size", 1.0, 0.1, 10, "length of the links of the legs"),
            angle("bent", 70, 20, 160, "bend angle of the legs"),
        ),
        lambda _: 3, "axes parallel in each leg, and perpendicular to those of the others",
        "Tsai's platform: Wampler, Larson, Erdman 2007, Fig. 16b; Kim and Tsai 2003",
    ),
)  # fmt: skip


_SOURCE = "Hoberman 1990; Wampler, Larson, Erdman 2007, Figs. 13 to 18"


def _opening(default: float, most: float) -> tuple[Parameter, ...]:
    meaning = "angle between an arm and the perpendicular from its pin to the ray on which it ends"
    return (angle("opening", default, 10, most, meaning),)


def _polyhedron(name: str, corners: scissors.Corners, default: float, most: float) -> Generator:
    return Generator(
        f"scissor-{name}", f"{name.capitalize()} of kinked scissors",
        partial(scissors.scissor_polyhedron, corners), _opening(default, most), lambda _: 1, _KINKS, _SOURCE,
    )  # fmt: skip


def _prism(sides: int, opening: float) -> JointedLinkage:
    return scissors.scissor_polyhedron(scissors.prism(sides), opening)


_KINKS = "arms alike, kinks of 180 degrees minus the angle between the rays to neighbouring corners"

_SCISSORS = (
    Generator(
        "scissor-ring", "Ring of kinked scissors in a plane", scissors.scissor_ring,
        (count("scissors", 10, 4, 24, "number of scissors in the ring"), *_opening(30, 44)),
        lambda _: 1, "arms alike, kinks of 180 degrees minus 360 degrees divided by the number of scissors",
        _SOURCE,
    ),
    _polyhedron("tetrahedron", scissors.TETRAHEDRON, 20, 34),
    _polyhedron("cube", scissors.CUBE, 30, 54),
    _polyhedron("octahedron", scissors.OCTAHEDRON, 30, 44),
    Generator(
        "scissor-prism", "Prism of kinked scissors", _prism,
        (count("sides", 3, 3, 6, "number of sides of the end polygons"), *_opening(30, 48)), lambda _: 1,
        f"{_KINKS}, all of which are one; besides it has flexes to first order, as the cube has", _SOURCE,
    ),
)  # fmt: skip


GENERATORS: dict[str, Generator] = {one.name: one for one in (*_CREASES, *_RINGS, *_GOODS, *_PLATFORMS, *_SCISSORS)}
