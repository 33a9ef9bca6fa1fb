"""What a template is drawn of: strokes and texts in millimetres, y upwards, and how each kind of them looks."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Literal

__all__ = ["LOOKS", "Kind", "Look", "Piece", "Point", "Stroke", "Text"]

Point = tuple[float, float]
Kind = Literal["CUT", "MOUNTAIN", "VALLEY", "CREASE", "MARKS"]


@dataclass(frozen=True, slots=True)
class Look:
    """The look of strokes of a kind.

    `colour` is ``#rrggbb`` (for cuts and folds, the colours by which crease patterns are read: docs/files.md),
    `number` the colour's number in DXF. `width` is in millimetres, as are the dashes and gaps, in turn, of `dash`
    (empty for a full line); `meaning` is for the foot of a page.
    """

    colour: str
    number: int
    width: float
    dash: tuple[float, ...]
    meaning: str


LOOKS: dict[Kind, Look] = {
    "CUT": Look("#000000", 7, 0.3, (), "black: cut"),
    "MOUNTAIN": Look("#ff0000", 1, 0.25, (4, 1, 0.6, 1), "red, dash and dot: mountain, away from you"),
    "VALLEY": Look("#0000ff", 5, 0.25, (3, 1.5), "blue, dashes: valley, towards you"),
    "CREASE": Look("#ff00ff", 6, 0.25, (1, 1), "magenta, dots: fold, either way"),
    "MARKS": Look("#808080", 8, 0.15, (), ""),
}
"""Kind of stroke to its look, in the order in which they are drawn; the kind is the name of its layer.

Marks are grey, which no reader of crease patterns takes for a line of the pattern.
"""


@dataclass(frozen=True, slots=True)
class Stroke:
    """A straight line of a template, millimetres."""

    kind: Kind
    start: Point
    end: Point

    def moved(self, right: float, up: float) -> Stroke:
        """Return the stroke elsewhere."""
        return Stroke(self.kind, *((x + right, y + up) for x, y in (self.start, self.end)))

    def turned(self) -> Stroke:
        """Return the stroke turned by a quarter, counter-clockwise about the origin."""
        return Stroke(self.kind, *((-y, x) for x, y in (self.start, self.end)))


@dataclass(frozen=True, slots=True)
class Text:
    """A word on a template: where its left end is, or its middle, its middle height, and its size, millimetres."""

    at: Point
    words: str
    size: float = 3.0
    middle: bool = True


@dataclass(frozen=True)
class Piece:
    """A part of a template that is cut out whole; `covered` is its material, a shapely geometry."""

    strokes: tuple[Stroke, ...]
    texts: tuple[Text, ...]
    covered: Any

    @property
    def box(self) -> tuple[float, float, float, float]:
        """The least and greatest x and y of its strokes: left, low, right, high."""
        xs, ys = zip(*(end for stroke in self.strokes for end in (stroke.start, stroke.end)), strict=True)
        return min(xs), min(ys), max(xs), max(ys)

    @property
    def size(self) -> tuple[float, float]:
        """Width and height."""
        left, low, right, high = self.box
        return right - left, high - low

    def at_origin(self) -> Piece:
        """Return the piece with the lower left corner of its box at the origin."""
        left, low, _, _ = self.box
        return self.moved(-left, -low)

    def moved(self, right: float, up: float) -> Piece:
        """Return the piece elsewhere."""
        from shapely.affinity import translate

        return Piece(
            tuple(stroke.moved(right, up) for stroke in self.strokes),
            tuple(replace(text, at=(text.at[0] + right, text.at[1] + up)) for text in self.texts),
            translate(self.covered, right, up),
        )

    def turned(self) -> Piece:
        """Return the piece turned by a quarter, its lower left corner at the origin."""
        from shapely.affinity import affine_transform

        return Piece(
            tuple(stroke.turned() for stroke in self.strokes),
            tuple(replace(text, at=(-text.at[1], text.at[0])) for text in self.texts),
            affine_transform(self.covered, (0, -1, 1, 0, 0, 0)),
        ).at_origin()
