"""From numbers to the page: the frame of a layout, with a caption below; curves against axes with ticks."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import ceil, floor, log10
from textwrap import wrap
from typing import TypeAlias

from graphs.printing import plain
from graphs.types import Floats
from synth.making.drawing.scene.shapes import FINE, NORMAL, SMALL, Label, Layer, Line, Point, Shape, moved, text_width
from synth.making.drawing.scene.writing import Scene

COLUMN = 340.0
"""The width of a picture at most, points: it fits a page with margins, and a half of it is a column."""
Box: TypeAlias = tuple[float, float]
"""Largest width and height of a picture, points."""
BOX: Box = (COLUMN, COLUMN)
_MARGIN = 16.0
_LINE = 1.5 * SMALL
_LETTERS, _LONGEST = 84, 336
"""Letters of a line below a picture, which is as wide as a picture at most; letters of a text of several lines."""
_TICK = 3.0
_STEPS = (1.0, 2.0, 5.0, 10.0)


@dataclass(frozen=True, slots=True)
class PictureOptions:
    """Options of a picture, which is at most as large as `box`, (width, height) in points.

    `colour` is a colouring of a crease pattern; `branch` goes with ``colour="branch"``: its number or its signs,
    or None for the one nearest to the assignment. `numbers` are those of links and joints; `graph` puts the SC
    graph over a crease pattern. `caption` comes before the lines that describe the picture; with None there are
    none.
    """

    colour: str = "letters"
    branch: int | str | None = None
    numbers: bool = True
    graph: bool = False
    box: Box = BOX
    caption: str | None = ""


PLAIN = PictureOptions()


@dataclass(frozen=True, slots=True)
class PictureFrame:
    """The map from places of a layout, y upwards, to the page, y downwards, in points.

    `scale` is points per unit. The layout's least x, `left`, and greatest y, `top`, lie at `across` and `down`;
    width and height are those of the picture.
    """

    scale: float
    left: float
    top: float
    across: float
    down: float
    width: float
    height: float

    def at(self, place: Sequence[float]) -> Point:
        """Return the point of the page for a place of the layout."""
        return (self.across + self.scale * (place[0] - self.left), self.down + self.scale * (self.top - place[1]))

    def row(self, places: Iterable[Sequence[float]]) -> list[Point]:
        """Return the points of the page for places of the layout."""
        return [self.at(place) for place in places]


def framed(places: Iterable[Sequence[float]], unit: float, box: Box = BOX, margin: float = _MARGIN) -> PictureFrame:
    """Return a frame round places for a box, (width, height), and a margin on each side, all in points.

    A unit of the layout is `unit` points long, if there is room.
    """
    rows = list(places) or [(0.0, 0.0)]
    left, right = min(p[0] for p in rows), max(p[0] for p in rows)
    low, high = min(p[1] for p in rows), max(p[1] for p in rows)
    wide, tall = right - left, high - low
    scale = unit
    for extent, room in ((wide, box[0]), (tall, box[1])):
        if extent * scale > room - 2 * margin:
            scale = (room - 2 * margin) / extent
    return PictureFrame(scale, left, high, margin, margin, wide * scale + 2 * margin, tall * scale + 2 * margin)


def captions_of(caption: str | None, *said: str) -> list[str]:
    """Return the lines below a picture, the caption, if any, before others; none if the caption is None."""
    return [] if caption is None else [text for text in (caption, *said) if text]


def page_of(frame: PictureFrame, layers: Iterable[Layer], captions: Sequence[str] = ()) -> Scene:
    """Return a scene as large as its frame, with lines of text below; long ones are broken."""
    lines = [line for text in captions for line in wrap(plain(text, _LONGEST), _LETTERS)]
    wide = max([frame.width, *(text_width(line, SMALL) + 8 for line in lines)])
    shift = (wide - frame.width) / 2
    below = []
    for number, line in enumerate(lines):
        place = (4.0, frame.height + (number + 0.5) * _LINE)
        below.append(Label(place, line, SMALL, "grey", "start", halo=False, widest=_LETTERS))
    centred = [moved(layer, shift, 0.0) for layer in layers] if shift else list(layers)
    high = frame.height + len(lines) * _LINE
    return Scene(wide, high, (*centred, Layer("caption", tuple(below))), ", ".join(captions))


@dataclass(frozen=True, slots=True)
class Plot:
    """A rectangle of the page, in points, on which numbers are drawn against each other.

    `x` and `y` are the numbers at its edges: left and right, below and above.
    """

    left: float
    top: float
    width: float
    height: float
    x: tuple[float, float]
    y: tuple[float, float]

    def at(self, x: float, y: float) -> Point:
        """Return the point of the page for a pair of numbers."""
        across = (x - self.x[0]) / (self.x[1] - self.x[0])
        up = (y - self.y[0]) / (self.y[1] - self.y[0])
        return self.left + across * self.width, self.top + (1 - up) * self.height

    def row(self, x: Floats, y: Floats) -> list[Point]:
        """Return the points of a curve on the page."""
        return [self.at(*pair) for pair in zip(x.tolist(), y.tolist(), strict=True)]

    def below(self, ticks: Iterable[float], name: str) -> list[Shape]:
        """Return the axis below with its ticks, their numbers and its name."""
        floor_ = self.top + self.height
        shapes: list[Shape] = [Line([(self.left, floor_), (self.left + self.width, floor_)], "ink", NORMAL)]
        for tick in ticks:
            x, _ = self.at(tick, self.y[0])
            shapes.append(Line([(x, floor_), (x, floor_ + _TICK)], "ink", FINE))
            shapes.append(Label((x, floor_ + 2.2 * SMALL / 2 + 2), signed(tick), SMALL, halo=False))
        shapes.append(Label((self.left + self.width / 2, floor_ + 2.9 * SMALL), name, SMALL, halo=False))
        return shapes

    def beside(self, ticks: Iterable[float], name: str) -> list[Shape]:
        """Return the axis on the left with its ticks and their numbers; its name stands above it."""
        shapes: list[Shape] = [Line([(self.left, self.top), (self.left, self.top + self.height)], "ink", NORMAL)]
        for tick in ticks:
            _, y = self.at(self.x[0], tick)
            shapes.append(Line([(self.left - _TICK, y), (self.left, y)], "ink", FINE))
            text = signed(tick)
            shapes.append(Label((self.left - 2 * _TICK - 0.31 * SMALL * len(text), y), text, SMALL, halo=False))
        shapes.append(Label((2.0, self.top - 1.5 * SMALL), name, SMALL, anchor="start", halo=False))
        return shapes


def round_steps(low: float, high: float, most: int = 7) -> list[float]:
    """Return at most so many round numbers from low to high (not equal), equally far from each other."""
    rough = (high - low) / most
    size = 10.0 ** floor(log10(rough))
    step = next(size * factor for factor in _STEPS if size * factor >= rough * (1 - 1e-9))
    first, last = ceil(low / step - 1e-9), floor(high / step + 1e-9)
    return [float(f"{number * step:.12g}") for number in range(first, last + 1)]


def signed(number: float) -> str:
    """Return a number as axes and legends show it, with a minus as long as a plus."""
    return f"{number:.6g}".replace("-", "−")
