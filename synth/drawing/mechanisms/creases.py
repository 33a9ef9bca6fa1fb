"""Crease patterns: mountains, valleys, cuts, borders; panels and creases by number; the SC graph over them.

Mountains are red and whole, valleys blue and dashed, cuts green and dotted, what is unassigned purple, borders
black. Numbers are those of the mechanism: links count panels, joint ids are places in the list of edges, as
messages and JSON have them. Theory: docs/theory/crease-patterns.md. The overlay is that of Wiener 2016, Figs. 21,
32, 35.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from statistics import median

from graphs.convert.duality import SheetMechanism
from graphs.errors import InvariantError, numbered, shown
from graphs.geometry import signed_area
from graphs.loops.loop import Centre
from graphs.mechanism.precision import flat_places
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.types import LinkId
from synth.drawing.mechanisms.labelling import Obstacles, beside, placed
from synth.drawing.mechanisms.motions import Doing, Motions, motions_by_verdict, motions_on_branch
from synth.drawing.mechanisms.sc_graphs import class_numbers
from synth.drawing.mechanisms.signs import SIGN, centre_sign
from synth.drawing.scene.frame import COLUMN, Frame, captions_of, framed, page_of
from synth.drawing.scene.palette import FINE, NORMAL, SMALL, STRONG, colour_of_class
from synth.drawing.scene.shapes import Disc, Label, Layer, Line, Point, Polygon, Scene, Shape, text_width
from synth.drawing.space.panels import panels_made
from synth.folding.configuration import SheetConfiguration

__all__ = ["COLOURINGS", "DrawnPattern", "Overlay", "crease_scene", "inside", "places_on_page", "width_of_lines"]

COLOURINGS = ("letters", "verdict", "branch", "centres", "none")
"""What colours tell: letters of the file; what is still, and moves as one; how creases begin to fold on a branch;
the class of centres; nothing."""

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
    "still": ("grey", NORMAL, (1.0, 2.0)),
    "unknown": ("unassigned", NORMAL, (6.0, 1.5, 1.0, 1.5)),
    "mountain": ("mountain", 1.3, ()),
    "valley": ("valley", 1.3, (4.0, 2.0)),
    "later": ("unassigned", NORMAL, (6.0, 1.5, 1.0, 1.5)),
}
"""Colour, width and dash of what a crease does."""
_WORDS = {"M": "mountain", "V": "valley", "U": "unassigned", "F": "flat", "J": "join", "C": "cut", "B": "border"}
_LEAST_LETTERS = 2.2
"""Height of letters, points, below which numbers are left out: nobody reads them."""
_MANY = 120
"""Labels of which more are put in the middle of what they name, without looking what lies there."""


@dataclass(frozen=True, slots=True)
class DrawnPattern:
    """A sheet on the page with its mechanism."""

    sheet: Sheet
    mechanism: SheetMechanism
    frame: Frame
    places: list[Point]
    motions: Motions

    def middle(self, edge: Sequence[int]) -> Point:
        """Return the middle of an edge on the page."""
        (ax, ay), (bx, by) = (self.places[v] for v in edge)
        return (ax + bx) / 2, (ay + by) / 2


@dataclass(frozen=True, slots=True)
class Overlay:
    """Signs on a crease pattern: a layer of shapes below its creases, and what is said of it.

    `beyond` are places in the plane of the pattern that the picture is to hold too.
    """

    name: str
    shapes: Callable[[DrawnPattern], list[Shape]]
    said: tuple[str, ...]
    beyond: tuple[tuple[float, ...], ...] = ()


def crease_scene(
    sheet: Sheet | SheetConfiguration,
    *,
    colour: str = "letters",
    branch: int | str | None = None,
    numbers: bool = True,
    graph: bool = False,
    box: tuple[float, float] = (COLUMN, COLUMN),
    caption: str | None = "",
    overlay: Overlay | None = None,
) -> Scene:
    """Return a picture of a crease pattern that lies in a plane.

    Parameters
    ----------
    sheet : Sheet or SheetConfiguration
    colour : {"letters", "verdict", "branch", "centres", "none"}, optional
        What the colours of creases tell; see `COLOURINGS`.
    branch : int or str, optional
        With the colouring by branch, which one: its number or signs; by default the one that suits the letters.
    numbers : bool, optional
        Write the numbers of links and joints.
    graph : bool, optional
        Draw the SC graph over it: links in their panels, joints across their creases, the signs of the centres.
    box : (width, height), optional
        Points there are at most.
    caption : str, optional
        Goes before the line that says what is seen; None: no line at all.
    overlay : Overlay, optional
        Signs on it.

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates, or does not lie in a plane.
    InvariantError
        If the colouring or the branch is not known, or a branch is given with another colouring.

    Examples
    --------
    >>> square = Sheet(4, ((0, 1), (1, 2), (2, 3), (3, 0), (0, 2)), "BBBBV", ((0, 1, 2), (0, 2, 3)),
    ...                ((0, 0), (1, 0), (1, 1), (0, 1)))
    >>> [layer.name for layer in crease_scene(square).layers]
    ['panels', 'creases', 'labels', 'caption']
    """
    if colour not in COLOURINGS:
        raise InvariantError("colour", f"the colouring {shown(colour)} is not known", ", ".join(COLOURINGS))
    if branch is not None and colour != "branch":
        raise InvariantError("branch", f"the colouring {shown(colour)} shows none", "the colouring 'branch'")
    given, mechanism = panels_made(sheet)
    whole = with_all_edges(given)
    frame, places = _framed(whole, box, () if overlay is None else overlay.beyond)
    drawn = DrawnPattern(whole, mechanism, frame, places, _motions(sheet, colour, branch))
    layers = [Layer("panels", tuple(_panels(drawn))), Layer("creases", tuple(_creases(drawn, colour, graph)))]
    if overlay is not None:
        layers.insert(1, Layer(overlay.name, tuple(overlay.shapes(drawn))))
    if graph:
        layers.append(Layer("graph", tuple(_graph(drawn))))
    if numbers:
        layers.append(Layer("labels", tuple(_labels(drawn, graph))))
    said = () if overlay is None else overlay.said
    return page_of(frame, layers, captions_of(caption, _said(drawn, colour, graph), drawn.motions.said, *said))


def places_on_page(sheet: Sheet, box: tuple[float, float] = (COLUMN, COLUMN)) -> list[Point]:
    """Return where the vertices of a crease pattern are in its picture, if that has no lines of text below it.

    The box, and the errors, are those of `crease_scene`.
    """
    return _framed(with_all_edges(sheet), box)[1]


def _framed(
    whole: Sheet, box: tuple[float, float], beyond: Sequence[tuple[float, ...]] = ()
) -> tuple[Frame, list[Point]]:
    """Return the frame of a picture, and the places of the vertices in it."""
    flat = flat_places(whole, "a picture of a crease pattern")
    every = [*flat, *beyond]
    extent = max(max(p[i] for p in every) - min(p[i] for p in every) for i in (0, 1)) if every else 1.0
    frame = framed(every, min(box) / (extent or 1.0), box)
    return frame, frame.row(flat)


def _motions(sheet: Sheet | SheetConfiguration, colour: str, branch: int | str | None) -> Motions:
    if colour == "verdict":
        return motions_by_verdict(sheet)
    return motions_on_branch(sheet, branch) if colour == "branch" else Motions()


def _panels(drawn: DrawnPattern) -> list[Shape]:
    link_of = {face: link for link, faces in enumerate(drawn.mechanism.panels) for face in faces}
    cluster_of: dict[LinkId, int] = {}
    for number, links in enumerate(drawn.motions.clusters):
        cluster_of.update(dict.fromkeys(links, number))
    found: list[Shape] = []
    for number, face in enumerate(drawn.sheet.faces):
        if number in link_of:
            link = link_of[number]
            fill = colour_of_class(cluster_of[link]) if link in cluster_of else "body"
            opacity = 0.3 if link in cluster_of else 0.6
            row = [drawn.places[v] for v in face]
            found.append(Polygon(row, fill, None, opacity=opacity, data=(("link", str(link)),)))
    return found


def _creases(drawn: DrawnPattern, colour: str, faint: bool) -> list[Shape]:
    """Return the lines, borders and cuts above creases, so that the outline is whole."""
    joint_of = {frozenset(edge): joint for joint, edges in drawn.mechanism.pieces.items() for edge in edges}
    width = width_of_lines(drawn) * (0.7 if faint else 1.0)
    shrunk = max(width, 0.6)  # dashes of dense patterns are shorter, so that a crease has several
    classes = _class_at(drawn) if colour == "centres" else {}
    found: list[tuple[int, Shape]] = []
    for edge, letter in zip(drawn.sheet.edges, drawn.sheet.assignments, strict=True):
        ends = [drawn.places[v] for v in edge]
        name, dash = _LOOKS.get(letter, _LOOKS["U"])
        dash = tuple(length * shrunk for length in dash)
        joint = joint_of.get(frozenset(edge))
        data = () if joint is None else (("joint", str(joint)),)
        if letter in "BC":
            found.append((1, Line(ends, name, STRONG * width if letter == "B" else NORMAL * width, dash, data)))
        elif colour == "letters":
            found.append((0, Line(ends, name, NORMAL * width if letter in "MVU" else FINE, dash, data)))
        elif joint in drawn.motions.of:
            name, thick, dash = _DOINGS[drawn.motions.of[joint]]
            found.append((0, Line(ends, name, thick * width, tuple(shrunk * length for length in dash), data)))
        elif colour != "centres" or joint is None:
            found.append((0, Line(ends, "grey" if joint is not None else "faint", FINE, (), data)))
        else:
            found += [(0, half) for half in _halves(drawn, edge, classes, width, data)]
    return [shape for _, shape in sorted(found, key=lambda item: item[0])]


def _halves(
    drawn: DrawnPattern,
    edge: Sequence[int],
    classes: Mapping[int, int],
    width: float,
    data: tuple[tuple[str, str], ...],
) -> list[Shape]:
    """Return the halves of a crease, each in the colour of the class of the centre at its end."""
    middle = drawn.middle(edge)
    return [
        Line(
            [drawn.places[v], middle],
            colour_of_class(classes[v]) if v in classes else "grey",
            1.3 * width,
            (),
            data,
        )
        for v in edge
    ]


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
    found: list[Shape] = []
    for joint, hinge in drawn.mechanism.hinges.items():
        a, b = sc.joints[joint]
        row = [middles[a], drawn.middle(hinge), middles[b]]
        found.append(Line(row, "ink", 1.1 * size, data=(("joint", str(joint)),)))
    for link, at in middles.items():
        found.append(Disc(at, 2.4 * size, "ink", "paper", 0.6 * size, (("link", str(link)),)))
    for vertex, number in _class_at(drawn).items():
        found += centre_sign(drawn.places[vertex], Centre.FINITE, colour_of_class(number), SIGN * size)
    return found


def _middle_of_link(drawn: DrawnPattern, faces: Sequence[int]) -> Point:
    rows = [[drawn.places[v] for v in drawn.sheet.faces[face]] for face in faces]
    return inside(max(rows, key=lambda row: abs(float(signed_area(row)))))


def inside(row: Sequence[Point]) -> Point:
    """Return a point inside a polygon: the middle of its area if that lies there, else one that does.

    >>> inside([(0, 0), (2, 0), (2, 2), (0, 2)])
    (1.0, 1.0)
    """
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
        return placed([(label, places[:3]) for label, places in wishes], Obstacles([], []))
    points = [(*place, 1.5) for place in drawn.places]
    lines = [(drawn.places[a], drawn.places[b]) for a, b in drawn.sheet.edges] if not graph else []
    return placed(wishes, Obstacles(points, lines))


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
        there = [word for letter, word in _WORDS.items() if letter in drawn.sheet.assignments]
        looks = {
            "mountain": "red",
            "valley": "blue, dashed",
            "cut": "green",
            "unassigned": "purple",
            "flat": "grey",
        }
        told = [f"{word} {looks[word]}" for word in there if word in looks]
        said += "; " + ", ".join(told) if told else ""
    if colour == "centres":
        said += "; half-creases in the colour of their centre's class"
    return said + ("; SC graph in black" if graph else "")
