"""A page: strokes and texts, and on the page of assembly a picture."""

from __future__ import annotations

from dataclasses import dataclass

from synth.drawing.scene.shapes import Scene
from synth.templates.lines import LOOKS, Point, Stroke, Text
from synth.templates.paper import Paper

__all__ = ["Page", "Picture"]


@dataclass(frozen=True)
class Picture:
    """A scene on a page; its corner is (left, low) in millimetres, its scale millimetres per point."""

    scene: Scene
    corner: Point
    scale: float


@dataclass(frozen=True)
class Page:
    """A page: strokes and texts in millimetres from its lower left corner.

    Nothing is cut from the page of assembly: it alone has a picture, and `is_note`.
    """

    paper: Paper
    strokes: tuple[Stroke, ...]
    texts: tuple[Text, ...]
    picture: Picture | None = None
    is_note: bool = False

    @property
    def ink(self) -> str:
        """The colour of texts, ``#rrggbb``: where lines are cut, it is that of marks, which no machine cuts."""
        return LOOKS["CUT" if self.is_note else "MARKS"].colour
