"""What drawings of several pictures are made of besides: arrows, words, rows."""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot

from drawings.together import above, beside
from synth.making.drawing.scene.shapes import NORMAL, SMALL, Label, Layer, Line, Point, Polygon, Shape, text_width
from synth.making.drawing.scene.writing import Scene

__all__ = ["arrow", "head", "in_rows", "of_shapes", "on_air", "words"]

_HEAD = 4.0


def arrow(*lines: str, long: float = 0.0) -> Scene:
    """Return an arrow to the right with words above it.

    Parameters
    ----------
    *lines : str
    long : float, optional
        Points at least.
    """
    wide = max([18.0, long, *(text_width(line, SMALL) for line in lines)])
    labels = [Label((wide / 2, (number + 0.5) * 1.5 * SMALL), line) for number, line in enumerate(lines)]
    # as much air below, so that the arrow is at the height of what it leads to
    y = 1.5 * SMALL * len(lines) + _HEAD
    shaft = Line([(0.0, y), (wide - _HEAD / 2, y)], "grey", NORMAL)
    return of_shapes(wide, 2 * y, [shaft, head((0.0, y), (wide, y), "grey"), *labels])


def head(start: Point, tip: Point, colour: str) -> Polygon:
    """Return the head of an arrow whose tip is at a point, coming from another."""
    long = hypot(tip[0] - start[0], tip[1] - start[1])
    x, y = _HEAD * (tip[0] - start[0]) / long, _HEAD * (tip[1] - start[1]) / long
    foot = (tip[0] - x, tip[1] - y)
    return Polygon([tip, (foot[0] - y / 2, foot[1] + x / 2), (foot[0] + y / 2, foot[1] - x / 2)], colour)


def words(*lines: str) -> Scene:
    """Return lines of text, one below the other."""
    wide = max(text_width(line, SMALL) for line in lines)
    labels = [
        Label((wide / 2, (number + 0.6) * 1.5 * SMALL), line, halo=False, widest=120)
        for number, line in enumerate(lines)
    ]
    return of_shapes(wide, 1.5 * SMALL * len(lines), labels)


def of_shapes(wide: float, high: float, shapes: Sequence[Shape], title: str = "") -> Scene:
    """Return a scene of one layer."""
    return Scene(wide, high, (Layer("drawn", tuple(shapes)),), title)


def in_rows(scenes: Sequence[Scene], columns: int, gap: float = 10.0, down: float | None = None) -> Scene:
    """Return pictures in rows of so many, those of a column below each other.

    Parameters
    ----------
    scenes : sequence of Scene
    columns : int
    gap, down : float, optional
        Between columns, and between rows, points; the same if only one is named.
    """
    wide = [max(scene.width for scene in scenes[place::columns]) for place in range(columns)]
    even = [on_air(scene, wide[place % columns]) for place, scene in enumerate(scenes)]
    rows = [beside(*even[first : first + columns], gap=gap) for first in range(0, len(even), columns)]
    return above(*rows, gap=gap if down is None else down)


def on_air(scene: Scene, wide: float, high: float = 0.0) -> Scene:
    """Return a picture with air round it, so wide and so high at least."""
    wide, high = max(wide, scene.width), max(high, scene.height)
    around = beside(scene, of_shapes(0.0, high, []), gap=0.0)
    return above(around, of_shapes(wide, 0.0, []), gap=0.0, title=scene.title)
