"""Pictures altered for a page: layers and small letters left out, shapes laid over, the whole mirrored."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from math import inf

from synth.drawing.scene.palette import SMALL
from synth.drawing.scene.shapes import Disc, Label, Layer, Point, Scene, Shape

__all__ = ["DASH", "DOTTED", "mirrored", "over", "plain_graph", "without", "without_letters"]

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

    def stays(shape: Shape) -> bool:
        return not isinstance(shape, Label) or shape.size >= lower

    return replace(scene, layers=tuple(Layer(one.name, tuple(filter(stays, one.shapes))) for one in scene.layers))


def plain_graph(scene: Scene) -> Scene:
    """Return a picture of a graph without bands below ride-alongs, and without letters that are hard to read."""
    return without_letters(without(scene, "ride-alongs"), SMALL)


def mirrored(scene: Scene) -> Scene:
    """Return a picture as a mirror shows it, its letters upright."""

    def there(place: Point) -> Point:
        return scene.width - place[0], place[1]

    def mirrored_shape(shape: Shape) -> Shape:
        if isinstance(shape, Label):
            return replace(shape, at=there(shape.at))
        if isinstance(shape, Disc):
            return replace(shape, centre=there(shape.centre))
        return replace(shape, points=[there(point) for point in shape.points])

    return replace(
        scene, layers=tuple(Layer(layer.name, tuple(map(mirrored_shape, layer.shapes))) for layer in scene.layers)
    )
