"""Layers put elsewhere: pictures of a page."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from synth.drawing.scene.shapes import Disc, Label, Layer, Point, Shape

__all__ = ["moved", "put"]


def moved(layer: Layer, right: float, down: float) -> Layer:
    """Return a layer at another place on the page.

    >>> from synth.drawing.scene.shapes import Line
    >>> moved(Layer("a", (Line([(0, 0), (1, 1)]),)), 2, 3).shapes[0].points
    [(2, 3), (3, 4)]
    """
    return put(layer, lambda place: (place[0] + right, place[1] + down))


def put(layer: Layer, there: Callable[[Point], Point]) -> Layer:
    """Return a layer with its places mapped by a function; letters stay upright, discs as large.

    >>> put(Layer("a", (Disc((1, 2), 3),)), lambda place: (-place[0], place[1])).shapes[0].centre
    (-1, 2)
    """

    def shape_there(shape: Shape) -> Shape:
        if isinstance(shape, Label):
            return replace(shape, at=there(shape.at))
        if isinstance(shape, Disc):
            return replace(shape, centre=there(shape.centre))
        return replace(shape, points=[there(point) for point in shape.points])

    return Layer(layer.name, tuple(map(shape_there, layer.shapes)))
