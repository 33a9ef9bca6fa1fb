"""What a picture shows: shapes in layers, in typographic points, y downwards from the upper left corner."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import cos, pi, sin
from typing import TypeAlias

from graphs.printing import plain
from synth.drawing.scene.palette import NORMAL, SMALL

__all__ = ["Disc", "Label", "Layer", "Line", "Point", "Polygon", "Scene", "Shape", "arc_points", "text_width"]

Point: TypeAlias = tuple[float, float]
Data: TypeAlias = tuple[tuple[str, str], ...]

_LETTER = 0.62
_WIDE_LETTER = 1.0
_STEP = pi / 60


@dataclass(frozen=True, slots=True)
class Line:
    """A row of straight pieces.

    Parameters
    ----------
    points : sequence of (x, y)
    colour : str, optional
        A name of the palette.
    width : float, optional
        Points.
    dash : tuple of float, optional
        Lengths of strokes and gaps, points.
    data : tuple of (key, value), optional
        What it stands for: ``("joint", id)``, ``("link", id)``.
    """

    points: Sequence[Point]
    colour: str = "ink"
    width: float = NORMAL
    dash: tuple[float, ...] = ()
    data: Data = ()


@dataclass(frozen=True, slots=True)
class Polygon:
    """A closed row of straight pieces, filled, outlined or both; corners are round.

    Parameters
    ----------
    points : sequence of (x, y)
    fill, colour : str or None, optional
        Names of the palette: inside and outline.
    width : float, optional
        Of the outline.
    opacity : float, optional
        Of the inside, 0 to 1.
    data : tuple of (key, value), optional
    """

    points: Sequence[Point]
    fill: str | None = "body"
    colour: str | None = None
    width: float = NORMAL
    opacity: float = 1.0
    data: Data = ()


@dataclass(frozen=True, slots=True)
class Disc:
    """A disc or a circle.

    Parameters
    ----------
    centre : (x, y)
    radius : float
    fill, colour : str or None, optional
    width : float, optional
    data : tuple of (key, value), optional
    """

    centre: Point
    radius: float
    fill: str | None = "paper"
    colour: str | None = "ink"
    width: float = NORMAL
    data: Data = ()


@dataclass(frozen=True, slots=True)
class Label:
    r"""A line of text; its middle, or its left end, is at a point.

    What is not printable is escaped, and long text is cut: names come from files.

    Parameters
    ----------
    at : (x, y)
    text : str
    size : float, optional
        Height of the letters, points.
    colour : str, optional
    anchor : {"middle", "start"}, optional
    bold : bool, optional
    halo : bool, optional
        A rim in the colour of the paper, where it lies on lines.
    widest : int, optional
        Most letters.
    data : tuple of (key, value), optional

    Examples
    --------
    >>> Label((0, 0), "a\x1b[2J").text
    'a\\x1b[2J'
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
        """Return left, top, right, bottom: what the letters need at most."""
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


@dataclass(frozen=True, slots=True)
class Scene:
    """A picture before it is written.

    Parameters
    ----------
    width, height : float
        Points, 72 to an inch.
    layers : tuple of Layer
        From below to above.
    title : str, optional
        What is seen, for who cannot see it; it is not drawn.

    Examples
    --------
    >>> Scene(100, 50, (Layer("links", (Disc((50, 25), 4),)),)).layers[0].name
    'links'
    """

    width: float
    height: float
    layers: tuple[Layer, ...]
    title: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "title", plain(self.title, 400))

    def shapes(self) -> Iterator[Shape]:
        """Yield the shapes of all layers, from below to above."""
        for layer in self.layers:
            yield from layer.shapes

    def labels(self) -> list[Label]:
        """Return the labels of all layers."""
        return [shape for shape in self.shapes() if isinstance(shape, Label)]


def text_width(text: str, size: float) -> float:
    """Return the largest width of text, in points: fonts differ, and the widest in use counts.

    >>> text_width("12", 10)
    12.4
    """
    return size * sum(_LETTER if ord(letter) < 0x2000 else _WIDE_LETTER for letter in text)


def arc_points(centre: Point, radius: float, start: float, stop: float) -> list[Point]:
    """Return points along an arc, close enough to each other to look round.

    Angles are in radians, from the x axis towards the y axis.

    >>> [round(x, 3) for x, _ in arc_points((0, 0), 1, 0, pi)][::30]
    [1.0, 0.0, -1.0]
    """
    pieces = max(1, round(abs(stop - start) / _STEP))
    angles = [start + (stop - start) * i / pieces for i in range(pieces + 1)]
    return [(centre[0] + radius * cos(a), centre[1] + radius * sin(a)) for a in angles]
