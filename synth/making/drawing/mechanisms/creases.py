"""Crease patterns: mountains, valleys, cuts, borders; panels and creases by number; overlays.

Mountains are red and whole, valleys blue and dashed, cuts green and dotted, unassigned creases purple, borders
black. Creases can also be coloured by what they do when the pattern moves. Overlays are the SC graph (as in
Wiener 2016, Figs. 21, 32, 35), creases that disagree with a branch, and repairs made when a drawing was read.
Numbers are those of the mechanism: links count panels, joint ids are places in the list of edges, as messages and
JSON have them. Theory: docs/theory/crease-patterns.md.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from statistics import median
from typing import Literal, TypeAlias

import numpy as np

from graphs.convert.duality import SheetMechanism
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.geometry import signed_area
from graphs.loops.loop import Centre
from graphs.mechanism.precision import flat_places
from graphs.mechanism.sheet import Reading, RepairKind, Sheet, with_all_edges
from graphs.tolerances import DOUBLE
from graphs.types import JointId, LinkId
from synth.analysis.folding.configuration import SheetConfiguration
from synth.analysis.motion.assigned_branch import disagreement_with
from synth.analysis.motion.driven_motion import BranchChoice, beginning
from synth.analysis.motion.germ import Branch
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.verdict._mobility import verdict_of_motion
from synth.making.drawing.mechanisms.labelling import SIGN, beside, centre_sign, placed
from synth.making.drawing.mechanisms.sc_graphs import class_numbers
from synth.making.drawing.scene.frame import BOX, PLAIN, Box, PictureFrame, PictureOptions, captions_of, framed, page_of
from synth.making.drawing.scene.shapes import (
    FINE,
    NORMAL,
    SMALL,
    STRONG,
    Disc,
    Label,
    Layer,
    Line,
    Point,
    Polygon,
    Shape,
    colour_of_class,
    text_width,
)
from synth.making.drawing.scene.writing import Scene
from synth.making.drawing.space.panels import sheet_and_mechanism

COLOURINGS = ("letters", "verdict", "branch", "centres", "none")
"""Colours show the assignment; immobile creases and panels that move as one; how creases begin to fold on a
branch; the class of centres; nothing."""

Doing: TypeAlias = Literal["moves", "immobile", "unknown", "mountain", "valley", "later"]
"""What a crease does; later: it is at rest as the motion begins, but not immobile."""

_LOOKS: Mapping[str, tuple[str, tuple[float, ...]]] = {
    "M": ("mountain", ()),
    "V": ("valley", (4.0, 2.0)),
    "U": ("unassigned", (6.0, 1.5, 1.0, 1.5)),
    "F": ("flat", (1.0, 1.5)),
    "J": ("flat", (0.5, 1.5)),
    "C": ("cut", (1.5, 2.0)),
    "B": ("ink", ()),
}
_DOINGS: Mapping[Doing, tuple[str, float, tuple[float, ...]]] = {
    "moves": ("class1", 1.3, ()),
    "immobile": ("grey", NORMAL, (1.0, 2.0)),
    "unknown": ("unassigned", NORMAL, (6.0, 1.5, 1.0, 1.5)),
    "mountain": ("mountain", 1.3, ()),
    "valley": ("valley", 1.3, (4.0, 2.0)),
    "later": ("unassigned", NORMAL, (6.0, 1.5, 1.0, 1.5)),
}
"""Colour, width and dash of what a crease does."""
_LEGEND = {
    "M": "mountain red",
    "V": "valley blue, dashed",
    "U": "unassigned purple",
    "F": "flat grey",
    "C": "cut green",
}
_LEAST_LETTERS = 2.2
"""Height of letters, points, below which numbers are left out: they would be illegible."""
_MANY = 120
"""Number of labels above which each is put in the middle of its panel or crease, without a search for space."""
_BAND = 6.0
"""Width of a band of the marks, in widths of a crease."""
_SIZE = 3.5
"""Half the size of the sign of a repair, points."""


@dataclass(frozen=True, slots=True)
class DrawnPattern:
    """A sheet on the page with its mechanism."""

    sheet: Sheet
    mechanism: SheetMechanism
    frame: PictureFrame
    places: list[Point]
    motions: Motions

    def middle(self, edge: Sequence[int]) -> Point:
        """Return the middle of an edge on the page."""
        (ax, ay), (bx, by) = (self.places[v] for v in edge)
        return (ax + bx) / 2, (ay + by) / 2


@dataclass(frozen=True, slots=True)
class Overlay:
    """Signs on a crease pattern: a layer of shapes below its creases, and the lines that explain them.

    `beyond` are places in the plane of the pattern that the picture must contain too.
    """

    name: str
    shapes: Callable[[DrawnPattern], list[Shape]]
    said: tuple[str, ...]
    beyond: tuple[tuple[float, ...], ...] = ()


def crease_scene(
    sheet: Sheet | SheetConfiguration, options: PictureOptions = PLAIN, *, overlay: Overlay | None = None
) -> Scene:
    """Return a picture of a crease pattern that lies in a plane; its colouring is one of `COLOURINGS`.

    The SC graph over the pattern has links in their panels, joints across their creases, the signs of the centres.
    Raise UnsolvableError if the sheet has no coordinates or does not lie in a plane; InvariantError if the
    colouring or the branch is unknown, or a branch comes with another colouring.
    """
    colour, graph = options.colour, options.graph
    if colour not in COLOURINGS:
        raise InvariantError("colour", f"unknown colouring {shown(colour)}", ", ".join(COLOURINGS))
    if options.branch is not None and colour != "branch":
        raise InvariantError("branch", f"the colouring {shown(colour)} shows no branch", "the colouring 'branch'")
    drawn_sheet, mechanism = sheet_and_mechanism(sheet)
    whole = with_all_edges(drawn_sheet)
    frame, places = _framed(whole, options.box, () if overlay is None else overlay.beyond)
    motions = Motions()
    if colour == "verdict":
        motions = motions_by_verdict(sheet)
    elif colour == "branch":
        motions = motions_on_branch(sheet, options.branch)
    drawn = DrawnPattern(whole, mechanism, frame, places, motions)
    layers = [Layer("panels", tuple(_panels(drawn))), Layer("creases", tuple(_creases(drawn, colour, graph)))]
    if overlay is not None:
        layers.insert(1, Layer(overlay.name, tuple(overlay.shapes(drawn))))
    if graph:
        layers.append(Layer("graph", tuple(_graph(drawn))))
    if options.numbers:
        layers.append(Layer("labels", tuple(_labels(drawn, graph))))
    said = () if overlay is None else overlay.said
    return page_of(frame, layers, captions_of(options.caption, _said(drawn, colour, graph), drawn.motions.said, *said))


def places_on_page(sheet: Sheet, box: Box = BOX) -> list[Point]:
    """Return where the vertices of a crease pattern are in its picture, if that has no lines of text below it.

    The box, and the errors, are those of `crease_scene`.
    """
    return _framed(with_all_edges(sheet), box)[1]


def _framed(whole: Sheet, box: Box, beyond: Sequence[tuple[float, ...]] = ()) -> tuple[PictureFrame, list[Point]]:
    """Return the frame of a picture, and the places of the vertices in it."""
    flat = flat_places(whole, "a picture of a crease pattern")
    every = [*flat, *beyond]
    extent = max(max(p[i] for p in every) - min(p[i] for p in every) for i in (0, 1)) if every else 1.0
    frame = framed(every, min(box) / (extent or 1.0), box)
    return frame, frame.row(flat)


def _panels(drawn: DrawnPattern) -> list[Shape]:
    link_of = {face: link for link, faces in enumerate(drawn.mechanism.panels) for face in faces}
    cluster_of = {link: number for number, links in enumerate(drawn.motions.clusters) for link in links}
    shapes: list[Shape] = []
    for number, face in enumerate(drawn.sheet.faces):
        if number in link_of:
            link = link_of[number]
            fill = colour_of_class(cluster_of[link]) if link in cluster_of else "body"
            opacity = 0.3 if link in cluster_of else 0.6
            row = [drawn.places[v] for v in face]
            shapes.append(Polygon(row, fill, None, opacity=opacity, data=(("link", str(link)),)))
    return shapes


def _creases(drawn: DrawnPattern, colour: str, faint: bool) -> list[Shape]:
    """Return the lines, borders and cuts above creases, so that the outline is whole."""
    joint_of = {frozenset(edge): joint for joint, edges in drawn.mechanism.pieces.items() for edge in edges}
    width = width_of_lines(drawn) * (0.7 if faint else 1.0)
    shrunk = max(width, 0.6)  # dashes of dense patterns are shorter, so that a crease has several
    classes = _class_at(drawn) if colour == "centres" else {}
    outline: list[Shape] = []
    creases: list[Shape] = []
    for edge, letter in zip(drawn.sheet.edges, drawn.sheet.assignments, strict=True):
        ends = [drawn.places[v] for v in edge]
        name, dash = _LOOKS.get(letter, _LOOKS["U"])
        dash = tuple(length * shrunk for length in dash)
        joint = joint_of.get(frozenset(edge))
        data = () if joint is None else (("joint", str(joint)),)
        if letter in "BC":
            outline.append(Line(ends, name, STRONG * width if letter == "B" else NORMAL * width, dash, data))
        elif colour == "letters":
            creases.append(Line(ends, name, NORMAL * width if letter in "MVU" else FINE, dash, data))
        elif joint in drawn.motions.of:
            name, thick, dash = _DOINGS[drawn.motions.of[joint]]
            creases.append(Line(ends, name, thick * width, tuple(shrunk * length for length in dash), data))
        elif colour != "centres" or joint is None:
            creases.append(Line(ends, "grey" if joint is not None else "faint", FINE, (), data))
        else:  # each half in the colour of the class of the centre at its end
            for v in edge:
                name = colour_of_class(classes[v]) if v in classes else "grey"
                creases.append(Line([drawn.places[v], drawn.middle(edge)], name, 1.3 * width, (), data))
    return creases + outline


def _class_at(drawn: DrawnPattern) -> dict[int, int]:
    """Return the centre class of each vertex that is a centre."""
    numbers = class_numbers(drawn.mechanism.sc)
    return {vertex: numbers[loop] for loop, vertex in enumerate(drawn.mechanism.loop_vertices) if loop in numbers}


def width_of_lines(drawn: DrawnPattern) -> float:
    """Return how wide lines are: less on dense patterns."""
    lengths = _lengths(drawn)
    return 1.0 if not lengths else min(1.0, max(0.3, median(lengths) / 26))


def _lengths(drawn: DrawnPattern) -> list[float]:
    ends = [(drawn.places[a], drawn.places[b]) for a, b in drawn.mechanism.hinges.values()]
    return [((ax - bx) ** 2 + (ay - by) ** 2) ** 0.5 for (ax, ay), (bx, by) in ends]


def _graph(drawn: DrawnPattern) -> list[Shape]:
    """Return the SC graph: a line for each joint by way of its crease, a dot for each link, the centres' signs."""
    sc, size = drawn.mechanism.sc, max(0.25, width_of_lines(drawn))
    middles: dict[LinkId, Point] = {
        link: _middle_of_link(drawn, faces) for link, faces in enumerate(drawn.mechanism.panels)
    }
    shapes: list[Shape] = []
    for joint, hinge in drawn.mechanism.hinges.items():
        a, b = sc.joints[joint]
        row = [middles[a], drawn.middle(hinge), middles[b]]
        shapes.append(Line(row, "ink", 1.1 * size, data=(("joint", str(joint)),)))
    for link, at in middles.items():
        shapes.append(Disc(at, 2.4 * size, "ink", "paper", 0.6 * size, (("link", str(link)),)))
    for vertex, number in _class_at(drawn).items():
        shapes += centre_sign(drawn.places[vertex], Centre.FINITE, colour_of_class(number), SIGN * size)
    return shapes


def _middle_of_link(drawn: DrawnPattern, faces: Sequence[int]) -> Point:
    rows = [[drawn.places[v] for v in drawn.sheet.faces[face]] for face in faces]
    return inside(max(rows, key=lambda row: abs(float(signed_area(row)))))


def inside(row: Sequence[Point]) -> Point:
    """Return a point inside a polygon: the middle of its area if that lies there, else another."""
    from shapely.geometry import Polygon as Area

    area = Area(row)
    middle = area.centroid
    if not area.is_valid:
        return sum(x for x, _ in row) / len(row), sum(y for _, y in row) / len(row)
    if not area.contains(middle):
        middle = area.representative_point()
    return float(middle.x), float(middle.y)


def _labels(drawn: DrawnPattern, graph: bool) -> list[Label]:
    """Return the numbers of links, bold, in their panels, and of joints, beside the middles of their creases."""
    lengths = _lengths(drawn)
    size = min(SMALL, 0.3 * median(lengths), _fitting(drawn, median(lengths))) if lengths else SMALL
    if size < _LEAST_LETTERS:
        return []
    wishes: list[tuple[Label, list[Point]]] = []
    for link, faces in enumerate(drawn.mechanism.panels):
        label = Label((0, 0), str(link), size, bold=True, halo=graph, data=(("link", str(link)),))
        middle = _middle_of_link(drawn, faces)
        wishes.append((label, beside(middle, 0.9 * size) if graph else [middle, *beside(middle, 0.8 * size)]))
    for joint, edge in drawn.mechanism.hinges.items():
        label = Label((0, 0), str(joint), 0.85 * size, "grey", data=(("joint", str(joint)),))
        middle = drawn.middle(edge)
        wishes.append((label, [middle, *beside(middle, 0.8 * size, 8)] if not graph else beside(middle, size, 8)))
    if len(wishes) > _MANY:
        return placed([(label, places[:3]) for label, places in wishes])
    points = [(*place, 1.5) for place in drawn.places]
    lines = [(drawn.places[a], drawn.places[b]) for a, b in drawn.sheet.edges] if not graph else []
    return placed(wishes, points, lines)


def _fitting(drawn: DrawnPattern, length: float) -> float:
    """Return the height of letters at which the numbers of a link and of a joint fit beside each other."""
    link = max(map(str, range(len(drawn.mechanism.panels))), key=len, default="")
    joint = max(map(str, drawn.mechanism.hinges), key=len, default="")
    return 0.8 * length / (text_width(link, 1.0) + text_width(joint, 0.85))


def _said(drawn: DrawnPattern, colour: str, graph: bool) -> str:
    sc = drawn.mechanism.sc
    counts = ((len(sc), "link"), (len(sc.joints), "joint"), (len(sc.centre_classes()), "centre"))
    said = ", ".join(numbered(number, word) for number, word in counts)
    if colour == "letters":
        legend = [text for letter, text in _LEGEND.items() if letter in drawn.sheet.assignments]
        said += "; " + ", ".join(legend) if legend else ""
    if colour == "centres":
        said += "; half-creases in the colour of their centre's class"
    return said + ("; SC graph in black" if graph else "")


@dataclass(frozen=True, slots=True)
class Motions:
    """The action of each joint, and the clusters of panels that move as one; `said` explains the colours."""

    of: Mapping[JointId, Doing] = field(default_factory=dict)
    clusters: tuple[tuple[LinkId, ...], ...] = ()
    said: str = ""


def motions_by_verdict(sheet: Sheet | SheetConfiguration) -> Motions:
    """Return the motions of the joints by the verdict on a sheet: moving on some branch, immobile, or unknown.

    Raise UnsolvableError if the sheet has no coordinates, or its panels do not fit at its configuration.
    """
    pattern = configuration_of(sheet)
    verdict = verdict_of_motion(pattern)
    immobile = set() if verdict.certainty == "not known" else set(verdict.immobile_joints)
    branches = [set(way.immobile_joints) for way in verdict.branches if way.certainty != "not known"]
    of: dict[JointId, Doing] = {}
    for joint in pattern.linkage.graph.joints:
        if joint in immobile:
            of[joint] = "immobile"
        else:
            of[joint] = "moves" if any(joint not in at_rest for at_rest in branches) else "unknown"
    clusters = verdict.clusters if immobile else ()
    return Motions(of, clusters, _said_of_verdict(of, verdict.certainty))


def _said_of_verdict(of: Mapping[JointId, Doing], certainty: str) -> str:
    does = list(of.values())
    moving, immobile, unknown = (does.count(doing) for doing in ("moves", "immobile", "unknown"))
    if moving == len(does):
        return f"every crease moves (orange; {certainty})"
    if immobile == len(does):
        return f"no crease moves (grey, dotted; {certainty}); panels of one colour move as one"
    if unknown == len(does):
        return "which creases move is not known (purple)"
    parts = [f"{numbered(moving, 'crease')} move{'s' * (moving == 1)} (orange)"] if moving else []
    if immobile:
        parts.append(f"{immobile} immobile (grey, dotted; {certainty}), panels of one colour move as one")
    if unknown:
        parts.append(f"of {unknown} (purple) it is not known")
    return "; ".join(parts)


def motions_on_branch(sheet: Sheet | SheetConfiguration, branch: int | str | None = None) -> Motions:
    """Return the motions with which joints start on a branch.

    A branch is its number, as `synth fold --branches` lists them, or its signs; by default the one nearest to the
    assignment. Raise UnsolvableError if the sheet has no coordinates or is rigid, or panels do not fit at its
    configuration; InvariantError if there is no such branch.
    """
    pattern = configuration_of(sheet)
    branches = pattern.branches
    number, rates = beginning(pattern, BranchChoice(branch))
    chosen = branches.branch(number or 0) if branches is not None else None
    immobile = set(chosen.immobile) if chosen is not None else set()
    of: dict[JointId, Doing] = {}
    for index, (joint, rate) in enumerate(zip(pattern.linkage.graph.joints, rates / np.abs(rates).max(), strict=True)):
        if abs(rate) > DOUBLE.zero_rate:
            of[joint] = "valley" if rate > 0 else "mountain"
        else:
            of[joint] = "immobile" if index in immobile else "later"
    which = "one way to move"
    if branches is not None and chosen is not None:
        which = f"way {number or 0} of {branches.count} ({_freedoms_of(chosen)}, {chosen.certainty})"
    looks = {"mountain": "red", "valley": "blue, dashed", "later": "purple", "immobile": "grey, dotted"}
    legend = [f"{doing} {look}" for doing, look in looks.items() if doing in of.values()]
    return Motions(of, (), f"{which}: {', '.join(legend)}")


def _freedoms_of(branch: Branch) -> str:
    return "freedoms not known" if branch.freedoms is None else numbered(branch.freedoms, "freedom")


def overlay_of_marks(sheet: Sheet | SheetConfiguration, branch: int | str | None = None) -> Overlay:
    """Return bands for the creases that disagree with a branch: its number or signs, by default the nearest.

    Raise UnsolvableError if nothing is assigned, the sheet is not flat, or it is rigid; InvariantError if there
    is no such branch.
    """
    at = configuration_of(sheet)
    if not at.flat or not isinstance(at, SheetConfiguration) or not _is_assigned(at):
        raise UnsolvableError("marks require a flat crease pattern with mountains and valleys")
    number, _ = beginning(at, BranchChoice(branch))
    chosen = at.branch(number or 0)
    near = at.disagreement
    if chosen is None or near is None:
        raise UnsolvableError("the crease pattern is too large to find its branches")
    if branch is not None:
        near = disagreement_with(number or 0, chosen, at.marks)
    opposite, immobile = ({at.joints[index] for index in indices} for indices in (near.opposite, near.immobile))

    def shapes(drawn: DrawnPattern) -> list[Shape]:
        return [*_bands(drawn, opposite, "marked"), *_bands(drawn, immobile, "class5", dotted=True)]

    which = f"branch {near.number} ({_freedoms_of(chosen)})"
    if not near.size:
        return Overlay("marks", shapes, (f"all creases are marked as {which} begins",))
    other, unmoved = len(near.opposite), len(near.immobile)
    bands = [f"{other} turn{'s' * (other == 1)} the other way (yellow bands)"] if other else []
    bands += [f"{unmoved} {'is' if unmoved == 1 else 'are'} immobile (light blue dots)"] if unmoved else []
    every = numbered(int(np.count_nonzero(at.marks)), "assigned crease")
    line = f"{near.size} of {every} disagree{'s' * (near.size == 1)} with {which}: {', '.join(bands)}"
    return Overlay("marks", shapes, (line,))


def _is_assigned(at: SheetConfiguration) -> bool:
    return any(at.sheet.assignments[joint] in "MV" for joint in at.mechanism.hinges if joint < len(at.sheet.edges))


def _bands(drawn: DrawnPattern, joints: Collection[JointId], colour: str, *, dotted: bool = False) -> list[Shape]:
    """Return a band along each piece of joints; its ends are round, and so are dots."""
    wide = _BAND * max(width_of_lines(drawn), 0.4)
    dash = (wide / 10, 1.6 * wide) if dotted else ()
    return [
        Line([drawn.places[v] for v in edge], colour, wide, dash, (("joint", str(joint)),))
        for joint, pieces in drawn.mechanism.pieces.items()
        if joint in joints
        for edge in pieces
    ]


def overlay_of_repairs(sheet: Sheet) -> Overlay:
    """Return signs of the repairs made when a drawing was traced; a sheet that was not traced has none.

    Signs differ in shape as well as in colour, and the lines below the picture name each kind with its sign.
    """
    reading = sheet.reading or Reading()
    repairs = [repair for repair in reading.repairs if repair.places]

    def shapes(drawn: DrawnPattern) -> list[Shape]:
        signs = [
            shape
            for repair in repairs
            for place in repair.places
            for shape in _sign_of_repair(repair.kind, drawn.frame.row(place))
        ]
        return sorted(signs, key=lambda shape: not isinstance(shape, Line))  # signs of points lie above lines

    said = [f"{repair.what} ({_SIGNS[repair.kind][0]})" for repair in repairs]
    if reading.left_out:
        said.append(reading.left_out)
    beyond = tuple(point for repair in repairs for place in repair.places for point in place)
    return Overlay("repairs", shapes, tuple(said) or ("nothing was repaired when it was read",), beyond=beyond)


_SIGNS: Mapping[RepairKind, tuple[str, str]] = {
    "crossing split": ("green rings", "class2"),
    "line split at an end": ("blue triangles", "class0"),
    "ends welded": ("orange squares", "class1"),
    "line drawn twice": ("light blue bands", "class5"),
    "line of no length": ("purple crosses", "class7"),
    "line pruned": ("pink dotted lines", "class3"),
    "vertex taken out": ("brown diamonds", "class6"),
    "hole": ("yellow areas", "class4"),
}
"""Kind of a repair to the name of its sign, and its colour."""
_CORNERS: Mapping[RepairKind, tuple[Point, ...]] = {
    "ends welded": ((-1, -1), (1, -1), (1, 1), (-1, 1)),
    "line split at an end": ((0, -1.2), (1.1, 0.8), (-1.1, 0.8)),
    "vertex taken out": ((0, -1.1), (1.1, 0), (0, 1.1), (-1.1, 0)),
}
"""Corners of signs that are polygons, in units of half their size."""


def _sign_of_repair(kind: RepairKind, points: list[Point]) -> list[Shape]:
    """Return the sign of a repair at its points on the page."""
    colour = _SIGNS[kind][1]
    if kind == "hole":
        return [Polygon(points, colour, colour, NORMAL, 0.35)]
    if kind == "line drawn twice":
        return [Line(points, colour, 3 * STRONG)]
    if kind == "line pruned":
        return [Line(points, colour, 2 * STRONG, (STRONG, 2 * STRONG))]
    x, y = points[0]
    if kind == "crossing split":
        return [Disc((x, y), _SIZE, None, colour, STRONG)]
    if kind in _CORNERS:
        return [Polygon([(x + _SIZE * u, y + _SIZE * v) for u, v in _CORNERS[kind]], None, colour, STRONG)]
    strokes = [[(x - _SIZE, y - _SIZE), (x + _SIZE, y + _SIZE)], [(x - _SIZE, y + _SIZE), (x + _SIZE, y - _SIZE)]]
    return [Line(stroke, colour, STRONG) for stroke in strokes]
