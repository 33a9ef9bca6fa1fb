"""Layers put elsewhere, larger or smaller: pictures of a page."""

from __future__ import annotations

from dataclasses import replace

from synth.drawing.scene.shapes import Disc, Label, Layer, Point, Shape

__all__ = ["moved"]


def moved(layer: Layer, right: float, down: float) -> Layer:
    """Return a layer somewhere else on the page.

    Examples
    --------
    >>> from synth.drawing.scene.shapes import Line
    >>> moved(Layer("a", (Line([(0, 0), (1, 1)]),)), 2, 3).shapes[0].points
    [(2, 3), (3, 4)]
    """

    def there(place: Point) -> Point:
        return place[0] + right, place[1] + down

    def shape_there(shape: Shape) -> Shape:
        if isinstance(shape, Label):
            return replace(shape, at=there(shape.at))
        if isinstance(shape, Disc):
            return replace(shape, centre=there(shape.centre))
        return replace(shape, points=[there(point) for point in shape.points])

    return Layer(layer.name, tuple(map(shape_there, layer.shapes)))
