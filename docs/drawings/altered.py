"""Pictures altered for a page: layers and letters left out, shapes laid over, mirrored, cropped, fewer points."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from math import inf

from shapely.geometry import LineString

from synth.making.drawing.scene.shapes import SMALL, Disc, Label, Layer, Polygon, Shape, moved, put
from synth.making.drawing.scene.writing import Scene

__all__ = [
    "DASH",
    "DOTTED",
    "cropped",
    "legible",
    "mirrored",
    "over",
    "plain_graph",
    "thinned",
    "without",
    "without_letters",
]

DASH, DOTTED = (2.5, 2.0), (1.0, 2.0)
"""Strokes and gaps of lines that are added, points."""


def over(scene: Scene, shapes: Iterable[Shape]) -> Scene:
    """Return a picture with shapes laid over it."""
    return replace(scene, layers=(*scene.layers, Layer("over", tuple(shapes))))


def without(scene: Scene, *names: str) -> Scene:
    """Return a picture without some of its layers."""
    return replace(scene, layers=tuple(layer for layer in scene.layers if layer.name not in names))


def without_letters(scene: Scene, lower: float = inf) -> Scene:
    """Return a picture without its letters, or without those that are lower than so many points."""
    return _each(scene, lambda shape: None if isinstance(shape, Label) and shape.size < lower else shape)


def plain_graph(scene: Scene) -> Scene:
    """Return a picture of a graph without bands below ride-alongs, and without letters that are hard to read."""
    return without_letters(without(scene, "ride-alongs"), SMALL)


def mirrored(scene: Scene) -> Scene:
    """Return a picture as a mirror shows it, its letters upright."""
    layers = (put(layer, lambda place: (scene.width - place[0], place[1])) for layer in scene.layers)
    return replace(scene, layers=tuple(layers))


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
