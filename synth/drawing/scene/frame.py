"""From a layout to the page: scale, margins, a caption below."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from textwrap import wrap

from graphs.printing import plain
from synth.drawing.scene.palette import SMALL
from synth.drawing.scene.shapes import Label, Layer, Point, Scene, text_width

__all__ = ["COLUMN", "Frame", "captions_of", "framed", "page_of"]

COLUMN = 340.0
"""The width of a picture at most, points: it fits a page with margins, and a half of it is a column."""
_MARGIN = 16.0
_LINE = 1.5 * SMALL
_LETTERS, _LONGEST = 84, 336
"""Letters of a line below a picture, which is as wide as a picture at most; letters of a text of several lines."""


@dataclass(frozen=True, slots=True)
class Frame:
    """The map from places of a layout, y upwards, to the page, y downwards, in points; `scale` is points per unit.

    The layout's least x, `left`, and greatest y, `top`, lie at `across` and `down`; width and height are those of
    the picture.
    """

    scale: float
    left: float
    top: float
    across: float
    down: float
    width: float
    height: float

    def at(self, place: Sequence[float]) -> Point:
        """Return where a place of the layout lies."""
        return (
            self.across + self.scale * (place[0] - self.left),
            self.down + self.scale * (self.top - place[1]),
        )

    def row(self, places: Iterable[Sequence[float]]) -> list[Point]:
        """Return where places of the layout lie."""
        return [self.at(place) for place in places]


def framed(
    places: Iterable[Sequence[float]],
    unit: float,
    box: tuple[float, float] = (COLUMN, COLUMN),
    margin: float = _MARGIN,
) -> Frame:
    """Return a frame round places for a box, (width, height), and a margin on each side, all in points.

    A unit of the layout is `unit` points long, if there is room.

    >>> framed([(0, 0), (2, 1)], 30, margin=10).at((0, 1))
    (10, 10)
    """
    rows = list(places) or [(0.0, 0.0)]
    left, right = min(p[0] for p in rows), max(p[0] for p in rows)
    low, high = min(p[1] for p in rows), max(p[1] for p in rows)
    wide, tall = right - left, high - low
    scale = unit
    for extent, room in ((wide, box[0]), (tall, box[1])):
        if extent * scale > room - 2 * margin:
            scale = (room - 2 * margin) / extent
    return Frame(scale, left, high, margin, margin, wide * scale + 2 * margin, tall * scale + 2 * margin)


def captions_of(caption: str | None, *said: str) -> list[str]:
    """Return the lines below a picture: the caption, if any, and those that describe it; with None there are none.

    >>> captions_of("", "4 links"), captions_of("a", "4 links"), captions_of(None, "4 links")
    (['4 links'], ['a', '4 links'], [])
    """
    return [] if caption is None else [text for text in (caption, *said) if text]


def page_of(frame: Frame, layers: Iterable[Layer], captions: Sequence[str] = (), title: str = "") -> Scene:
    """Return a scene as large as its frame, with lines of text below; long ones are broken.

    >>> page_of(framed([(0, 0), (1, 1)], 30), [], ["a square"]).height
    71.75
    """
    lines = [line for text in captions for line in wrap(plain(text, _LONGEST), _LETTERS)]
    wide = max([frame.width, *(text_width(line, SMALL) + 8 for line in lines)])
    shift = (wide - frame.width) / 2
    below = []
    for number, line in enumerate(lines):
        place = (4.0, frame.height + (number + 0.5) * _LINE)
        below.append(Label(place, line, SMALL, "grey", "start", halo=False, widest=_LETTERS))
    moved = [_moved(layer, shift) for layer in layers] if shift else list(layers)
    high = frame.height + len(lines) * _LINE
    return Scene(wide, high, (*moved, Layer("caption", tuple(below))), title or ", ".join(captions))


def _moved(layer: Layer, shift: float) -> Layer:
    from synth.drawing.scene.moving import moved

    return moved(layer, shift, 0.0)
