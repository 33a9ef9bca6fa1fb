"""What drawings of several pictures are made of besides: arrows, words, rows; letters to be read, fewer points."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import hypot

from shapely.geometry import LineString

from drawings.together import above, beside
from synth.drawing.scene.moving import moved
from synth.drawing.scene.palette import NORMAL, SMALL
from synth.drawing.scene.shapes import Disc, Label, Layer, Line, Point, Polygon, Scene, Shape, text_width

__all__ = ["arrow", "cropped", "head", "in_rows", "legible", "of_shapes", "on_air", "thinned", "without", "words"]

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


def legible(scene: Scene, joints: bool = False) -> Scene:
    """Return a picture whose letters are all large enough; the numbers of joints only where they are needed."""
    return _each(scene, lambda shape: _legible(shape, joints))


def _legible(shape: Shape, joints: bool) -> Shape | None:
    if not isinstance(shape, Label):
        return shape
    if not joints and any(key == "joint" for key, _ in shape.data):
        return None
    return replace(shape, size=max(shape.size, SMALL))


def thinned(scene: Scene, off: float = 0.05) -> Scene:
    """Return a picture without data, with few points in its lines: they are off by so much at most, points."""
    return _each(scene, lambda shape: _thinned(shape, off))


def _thinned(shape: Shape, off: float) -> Shape:
    shape = replace(shape, data=())
    if isinstance(shape, Label | Disc) or len(shape.points) < 4:
        return shape
    closed = isinstance(shape, Polygon)
    row = LineString([*shape.points, shape.points[0]] if closed else shape.points).simplify(off)
    points = [(round(x, 2), round(y, 2)) for x, y in row.coords]
    return replace(shape, points=points[:-1] if closed else points)


def _each(scene: Scene, change: Callable[[Shape], Shape | None]) -> Scene:
    """Return a picture with every shape changed, or left out."""
    layers = []
    for layer in scene.layers:
        changed = (change(shape) for shape in layer.shapes)
        layers.append(Layer(layer.name, tuple(shape for shape in changed if shape is not None)))
    return replace(scene, layers=tuple(layers))


def without(scene: Scene, *layers: str) -> Scene:
    """Return a picture without some of its layers."""
    return replace(scene, layers=tuple(layer for layer in scene.layers if layer.name not in layers))


def cropped(scene: Scene, air: float = 3.0) -> Scene:
    """Return a picture without the margin round what is drawn, but for a little air."""
    boxes = [_box(shape) for shape in scene.shapes()]
    left, top = (min(box[side] for box in boxes) - air for side in (0, 1))
    right, low = (max(box[side] for box in boxes) + air for side in (2, 3))
    layers = tuple(moved(layer, -left, -top) for layer in scene.layers)
    return replace(scene, width=right - left, height=low - top, layers=layers)


def _box(shape: Shape) -> tuple[float, float, float, float]:
    """Return left, top, right and bottom of what is seen of a shape."""
    if isinstance(shape, Label):
        return shape.box
    if isinstance(shape, Disc):
        (x, y), rim = shape.centre, shape.radius + (shape.width / 2 if shape.colour else 0.0)
        return x - rim, y - rim, x + rim, y + rim
    rim = shape.width / 2 if shape.colour else 0.0
    across, down = [x for x, _ in shape.points], [y for _, y in shape.points]
    return min(across) - rim, min(down) - rim, max(across) + rim, max(down) + rim
