"""A linkage on its cone: the links as strips in bands, so that none hides another, and the joint axes."""

from __future__ import annotations

from math import cos, degrees, pi, radians, sin

import numpy as np

from graphs.arrays import Floats
from synth.conformed.layers import LinksInLayers
from synth.conformed.pose import joint_axes, strip
from synth.conformed.rates import ConformedChain
from synth.drawing.scene.palette import FINE, NORMAL, SMALL, colour_of_class
from synth.drawing.scene.shapes import Label, Layer, Line, Point, Polygon, Shape
from synth.drawing.space.view import View, view_from

__all__ = ["colour_of_link", "cone_layer"]

_INNER, _OUTER = 0.35, 1.05
"""Where the reference cone begins and ends, in units of the distance from the apex."""
_BANDS = 0.62
_LIT, _SHADOWS = pi / 3, 14
"""The azimuth that the light meets, and how many shadows there are."""
_POINTS = 40
_REACH, _FILLED = 1.2, 0.88
"""How far what is drawn reaches, and how much of the square that fills."""


def colour_of_link(number: int) -> str:
    """Return the colour of a link by its place, the first grey.

    >>> colour_of_link(0), colour_of_link(1)
    ('grey', 'class0')
    """
    return "grey" if number == 0 else colour_of_class(number - 1)


def cone_layer(chain: ConformedChain, t: Floats, laid: LinksInLayers, cone_angle: float, side: float) -> Layer:
    """Return a linkage on its cone, in a square with a side in points.

    `t` are the azimuths of the joints, float[J], and `cone_angle` is lambda, both in radians.
    """
    page = _Page(_view(t, cone_angle), cone_angle, side)
    shapes = [*_surface(page, cone_angle)]
    width = _BANDS / (int(laid.layers.max()) + 1)
    for number, layer in enumerate(laid.layers.tolist()):
        start, length = laid.arcs[number]
        inner = _INNER + 0.03 + width * layer
        edges = strip(start, start + length, cone_angle, (inner, inner + 0.9 * width), _POINTS)
        mark = (("link", str(chain.links[number])), ("layer", str(layer)))
        row = page.row(np.concatenate([edges[0], edges[1][::-1]]))
        shapes.append(Polygon(row, colour_of_link(number), "paper", FINE, data=mark))
    for joint, axis in zip(chain.joints, joint_axes(t, cone_angle), strict=True):
        of = (("joint", str(joint)),)
        shapes.append(Line(page.row(np.stack([np.zeros(3), 1.1 * axis])), "ink", NORMAL, data=of))
        shapes.append(Label(page.row(1.2 * axis[None])[0], str(joint), SMALL, widest=8, data=of))
    title = f"cone of λ = {degrees(cone_angle):.4g}°, seen from the apex's side"
    shapes.append(Label((side / 2, SMALL), title, SMALL, "grey"))
    return Layer("cone", tuple(shapes))


class _Page:
    """Where points of the paper's frame lie in the square, which all that is drawn fills but for a margin."""

    def __init__(self, view: View, cone_angle: float, side: float) -> None:
        rim = _REACH * joint_axes(np.linspace(0, 2 * pi, 73), cone_angle)
        seen = view.places(_upright(np.concatenate([rim, np.zeros((1, 3))])))
        low, high = seen.min(axis=0), seen.max(axis=0)
        self._view, self._side = view, side
        self._middle, self._scale = (low + high) / 2, _FILLED * side / float((high - low).max())

    def row(self, points: Floats) -> list[Point]:
        """Return where points lie on the page."""
        x, y = (self._view.places(_upright(points)) - self._middle).T * self._scale
        return list(zip((self._side / 2 + x).tolist(), (self._side / 2 - y).tolist(), strict=True))


def _view(t: Floats, cone_angle: float) -> View:
    """Return the view from outside the links, a little aside; so high that no part of the cone hides another."""
    around = float(np.angle(np.exp(1j * t).sum())) + radians(15)
    above = radians(min(88.0, max(38.0, degrees(cone_angle) + 8)))
    towards = np.array([cos(above) * cos(around), cos(above) * sin(around), sin(above)])
    return view_from(towards, np.array([0.0, 0.0, 1.0]))


def _surface(page: _Page, cone_angle: float) -> list[Shape]:
    """Return the reference cone and its rims: light from one side, away from it in shadows that lie on each other.

    Wedges side by side would show where they meet.
    """
    found: list[Shape] = []
    for number in range(_SHADOWS + 1):
        half = pi * (1 - number / (_SHADOWS + 1))
        edges = strip(_LIT + pi - half, _LIT + pi + half, cone_angle, (_INNER, _OUTER), 73)
        row = page.row(np.concatenate([edges[0], edges[1][::-1]]))
        found.append(Polygon(row, "shadow", None, opacity=0.018) if number else Polygon(row, "body", None))
    rims = strip(0, 2 * pi, cone_angle, (_INNER, _OUTER), 91)
    return found + [Line(page.row(rim), "grey", FINE) for rim in rims]


def _upright(points: Floats) -> Floats:
    """Return coordinates with the cone's axis upright: (z, x, y) of the paper's frame."""
    return np.asarray(points[..., [2, 0, 1]])
