"""Shapes in layers, in typographic points, y downwards from the upper left corner; colours by name.

The palette has colours for light and for dark paper, for all kinds of sight: the eight colours of classes are
those of Okabe and Ito, but for yellow, which is too light on paper; on dark paper the darker ones are lightened.
Whatever a colour shows is shown by a dash, a sign or a number too.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import cos, pi, sin
from typing import TypeAlias

from graphs.errors import InvariantError, shown
from graphs.printing import plain

FINE, NORMAL, STRONG = 0.5, 1.0, 1.6
"""Widths of lines in points: for secondary lines, for the mechanism, for what should be seen first."""

SMALL, LARGE = 6.5, 9.0
"""Sizes of letters in points: numbers in a picture, titles."""

_CLASSES = 8
"""Number of colours of classes; further classes repeat them, and are told apart by their numbers."""

_COLOURS = {
    "paper": ("#ffffff", "#14171a"),
    "ink": ("#1a1a1a", "#ececec"),
    "grey": ("#767676", "#9d9d9d"),
    "faint": ("#d4d4d4", "#42474c"),
    "body": ("#e8ecf0", "#2b3238"),
    "ground": ("#b9bec4", "#59626b"),
    "front": ("#f4f5f6", "#a5adb5"),
    "back": ("#a9d4ef", "#5b9cc7"),
    "shadow": ("#4a535c", "#101316"),
    "marked": ("#f5e27a", "#6b5c12"),
    "mountain": ("#c8242b", "#ff6f6a"),
    "valley": ("#0a64ad", "#6cb4f5"),
    "cut": ("#00795a", "#3fcf9f"),
    "unassigned": ("#9a4f7c", "#e3a0c8"),
    "flat": ("#b0b0b0", "#6a6f75"),
    "class0": ("#0072b2", "#4aa8e0"),
    "class1": ("#d55e00", "#ff9147"),
    "class2": ("#009e73", "#35c79c"),
    "class3": ("#cc79a7", "#e3a0c8"),
    "class4": ("#b8860b", "#e6b84a"),
    "class5": ("#56b4e9", "#8ccff5"),
    "class6": ("#8c564b", "#c4938a"),
    "class7": ("#6a3d9a", "#b08ee0"),
}
"""Name of a colour to its value on light and on dark paper."""
_PAPERS = ("light", "dark")


def colour_of(name: str, paper: str) -> str:
    """Return a colour as ``#rrggbb``; raise InvariantError if the colour or the paper is unknown.

    A colour that is ``#rrggbb`` already is the same on both papers.
    """
    if paper not in _PAPERS:
        raise InvariantError("paper", f"unknown paper {shown(paper)}", " or ".join(_PAPERS))
    if name.startswith("#"):
        return name
    if name not in _COLOURS:
        raise InvariantError("colour", f"unknown colour {shown(name)}", ", ".join(_COLOURS))
    return _COLOURS[name][_PAPERS.index(paper)]


def colour_of_class(number: int) -> str:
    """Return the name of the colour of a class of joints, loops or links."""
    return f"class{number % _CLASSES}"


Point: TypeAlias = tuple[float, float]
Data: TypeAlias = tuple[tuple[str, str], ...]

_LETTER = 0.62
_WIDE_LETTER = 1.0
_STEP = pi / 60


@dataclass(frozen=True, slots=True)
class Line:
    """A row of straight pieces, (x, y).

    The colour is a name of the palette, width and dash (lengths of strokes and gaps) are in points. `data` are
    pairs of key and value that say what it stands for: ``("joint", id)``, ``("link", id)``.
    """

    points: Sequence[Point]
    colour: str = "ink"
    width: float = NORMAL
    dash: tuple[float, ...] = ()
    data: Data = ()


@dataclass(frozen=True, slots=True)
class Polygon:
    """A closed row of straight pieces, filled, outlined or both; corners are round.

    `fill` and `colour` are names of the palette, for the inside and the outline, or None; `opacity`, 0 to 1, is
    that of the inside.
    """

    points: Sequence[Point]
    fill: str | None = "body"
    colour: str | None = None
    width: float = NORMAL
    opacity: float = 1.0
    data: Data = ()


@dataclass(frozen=True, slots=True)
class Disc:
    """A disc or a circle; `fill` and `colour`, inside and outline, are names of the palette or None."""

    centre: Point
    radius: float
    fill: str | None = "paper"
    colour: str | None = "ink"
    width: float = NORMAL
    data: Data = ()


@dataclass(frozen=True, slots=True)
class Label:
    """A line of text; its middle, or its left end (`anchor` is "start"), is at a point.

    Unprintable letters are escaped, and text of more than `widest` letters is cut: names come from files. `size`
    is the height of the letters in points. A halo is a rim in the colour of the paper, for text on lines.
    """

    at: Point
    text: str
    size: float = SMALL
    colour: str = "ink"
    anchor: str = "middle"
    bold: bool = False
    halo: bool = True
    widest: int = 60
    data: Data = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "text", plain(self.text, self.widest))

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Left, top, right, bottom: the largest space that the letters take."""
        x, y = self.at
        wide, high = text_width(self.text, self.size), self.size
        left = x - wide / 2 if self.anchor == "middle" else x
        return left, y - high / 2, left + wide, y + high / 2


Shape: TypeAlias = Line | Polygon | Disc | Label


@dataclass(frozen=True, slots=True)
class Layer:
    """Shapes that lie at one height; later shapes lie on earlier ones."""

    name: str
    shapes: tuple[Shape, ...]


def text_width(text: str, size: float) -> float:
    """Return the largest width of text, in points: fonts differ, and the widest in use counts."""
    return size * sum(_LETTER if ord(letter) < 0x2000 else _WIDE_LETTER for letter in text)


def arc_points(centre: Point, radius: float, start: float, stop: float) -> list[Point]:
    """Return points along an arc, close enough to each other to look round.

    Angles are in radians, from the x axis towards the y axis.
    """
    pieces = max(1, round(abs(stop - start) / _STEP))
    angles = [start + (stop - start) * i / pieces for i in range(pieces + 1)]
    return [(centre[0] + radius * cos(a), centre[1] + radius * sin(a)) for a in angles]


def part_in_box(start: Point, end: Point, box: tuple[float, float, float, float]) -> tuple[float, float]:
    """Return the part of a straight piece in a box: where it begins and ends, from 0 to 1; none if it ends before.

    The box has its two low edges before the high ones. The method is that of Liang and Barsky.
    """
    first, last = 0.0, 1.0
    for axis in (0, 1):
        way = end[axis] - start[axis]
        low, high = box[axis] - start[axis], box[axis + 2] - start[axis]
        if way == 0:
            if low > 0 or high < 0:
                return 1.0, 0.0
            continue
        enter, leave = sorted((low / way, high / way))
        first, last = max(first, enter), min(last, leave)
    return first, last


def moved(layer: Layer, right: float, down: float) -> Layer:
    """Return a layer at another place on the page."""
    return put(layer, lambda place: (place[0] + right, place[1] + down))


def put(layer: Layer, there: Callable[[Point], Point]) -> Layer:
    """Return a layer with its places mapped by a function; letters stay upright, discs keep their size."""

    def shape_there(shape: Shape) -> Shape:
        if isinstance(shape, Label):
            return replace(shape, at=there(shape.at))
        if isinstance(shape, Disc):
            return replace(shape, centre=there(shape.centre))
        return replace(shape, points=[there(point) for point in shape.points])

    return Layer(layer.name, tuple(map(shape_there, layer.shapes)))


def scaled(layer: Layer, factor: float) -> Layer:
    """Return a layer in which places, widths of lines, dashes, discs and letters are larger by a factor."""

    def larger(shape: Shape) -> Shape:
        if isinstance(shape, Label):
            return replace(shape, size=factor * shape.size)
        if isinstance(shape, Disc):
            return replace(shape, radius=factor * shape.radius, width=factor * shape.width)
        if isinstance(shape, Line):
            dash = tuple(factor * part for part in shape.dash)
            return replace(shape, width=factor * shape.width, dash=dash)
        return replace(shape, width=factor * shape.width)

    placed = put(layer, lambda place: (factor * place[0], factor * place[1]))
    return Layer(layer.name, tuple(map(larger, placed.shapes)))
