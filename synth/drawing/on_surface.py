"""A linkage on its cone or cylinder: links as strips in bands, so that none hides another, and the joint axes."""

from __future__ import annotations

from itertools import pairwise
from math import cos, degrees, pi, radians, sin

import numpy as np

from graphs.arrays import Flags, Floats
from graphs.mechanism.surfaces import Cone, Cylinder, Surface
from synth.conformed.all_angles import LinksInLayers
from synth.conformed.rates import ConformedChain
from synth.drawing.scene.palette import FINE, NORMAL, SMALL, colour_of_class
from synth.drawing.scene.shapes import Label, Layer, Line, Point, Polygon, Shape
from synth.drawing.space.view import View, view_from

__all__ = ["colour_of_link", "surface_layer"]

_ENDS = {"cone": (0.35, 1.05), "cylinder": (0.0, 1.1)}
"""Where the surface begins and ends along its ruling lines: from the apex, in units of the drawing; in radii."""
_BANDS = 0.89
"""What part of it the bands of links take."""
_LIT, _SHADOWS = pi / 3, 14
"""The azimuth that the light meets, and how many shadows there are."""
_POINTS = 40
_BEYOND, _NAMES = 0.05, 0.15
"""How far joint axes and their names are beyond the end of the surface."""
_FILLED = 0.88
"""How much of the square is filled."""


def colour_of_link(number: int) -> str:
    """Return the colour of a link by its place, the first grey.

    >>> colour_of_link(0), colour_of_link(1)
    ('grey', 'class0')
    """
    return "grey" if number == 0 else colour_of_class(number - 1)


def surface_layer(chain: ConformedChain, t: Floats, laid: LinksInLayers, surface: Surface, side: float) -> Layer:
    """Return a linkage on its surface, in a square with a side in points.

    `t` are the azimuths of the joints, float[J], radians. What lies on the far side is drawn first.
    """
    drawn = Cylinder(1.0) if isinstance(surface, Cylinder) else surface
    page = _Page(drawn, _towards(t, drawn), side)
    inner, outer = _ENDS[surface.kind]
    width = _BANDS * (outer - inner) / (int(laid.layers.max()) + 1)
    far, near = _walls(page)
    for number, layer in enumerate(laid.layers.tolist()):
        start, length = laid.arcs[number]
        begin = inner + 0.04 * (outer - inner) + width * layer
        mark = (("link", str(chain.links[number])), ("layer", str(layer)))
        for faces_us, row in page.strips(start, start + length, (begin, begin + 0.9 * width), _POINTS):
            shape = Polygon(row, colour_of_link(number), "paper", FINE, data=mark)
            (near if faces_us else far).append(shape)
    names = []
    for joint, place in zip(chain.joints, t.tolist(), strict=True):
        of = (("joint", str(joint)),)
        faces_us = bool(page.faces_us(np.array([place]))[0])
        first = 0.0 if surface.kind == "cone" else inner - _BEYOND
        name = outer + _NAMES if faces_us else inner - _NAMES
        line = page.row(drawn.place(np.full(2, place), np.array([first, outer + _BEYOND]), 0.0))
        (near if faces_us else far).append(Line(line, "ink", NORMAL, data=of))
        names.append(Label(page.row(drawn.place(place, name, 0.0)[None])[0], str(joint), SMALL, widest=8, data=of))
    if isinstance(surface, Cone):
        title = f"cone of λ = {degrees(surface.angle):.4g}°, seen from the apex's side"
    else:
        title = f"cylinder of R = {surface.radius:.4g}"
    names.append(Label((side / 2, SMALL), title, SMALL, "grey"))
    return Layer(surface.kind, (*far, *near, *names))


class _Page:
    """Where points of the paper's frame lie in the square, which all that is drawn fills but for a margin."""

    def __init__(self, surface: Surface, towards: Floats, side: float) -> None:
        self.surface = surface
        self._view: View = view_from(towards, np.array([0.0, 0.0, 1.0]))
        inner, outer = _ENDS[surface.kind]
        reach = np.array([0.0 if surface.kind == "cone" else inner - _NAMES, outer + _NAMES])
        seen = self._seen(surface.place(np.linspace(0, 2 * pi, 73)[:, None], reach, 0.0).reshape(-1, 3))
        low, high = seen.min(axis=0), seen.max(axis=0)
        self._side = side
        self._middle, self._scale = (low + high) / 2, _FILLED * side / float((high - low).max())

    def _seen(self, points: Floats) -> Floats:
        return self._view.places(_upright(points))

    def row(self, points: Floats) -> list[Point]:
        """Return where points lie on the page."""
        x, y = (self._seen(points) - self._middle).T * self._scale
        return list(zip((self._side / 2 + x).tolist(), (self._side / 2 - y).tolist(), strict=True))

    def faces_us(self, azimuths: Floats) -> Flags:
        """Return of which ruling lines the outside is seen: bool[n]."""
        outward = self.surface.place(azimuths, 0.0, 1.0) - self.surface.place(azimuths, 0.0, 0.0)
        return np.asarray(self._view.near(_upright(outward)) > 0.0)

    def strips(
        self, start: float, end: float, ends: tuple[float, float], points: int
    ) -> list[tuple[bool, list[Point]]]:
        """Return a strip between ruling lines as outlines, cut where its outside ceases to be seen."""
        azimuths = np.linspace(start, end, points)
        middles = self.faces_us((azimuths[1:] + azimuths[:-1]) / 2)
        cuts = [0, *(np.flatnonzero(middles[1:] != middles[:-1]) + 1).tolist(), points - 1]
        return [
            (bool(middles[first]), self._outline(azimuths[first : last + 1], ends))
            for first, last in pairwise(cuts)
        ]

    def _outline(self, azimuths: Floats, ends: tuple[float, float]) -> list[Point]:
        there, back = (self.surface.place(azimuths, end, 0.0) for end in ends)
        return self.row(np.concatenate([there, back[::-1]]))


def _towards(t: Floats, surface: Surface) -> Floats:
    """Return the direction of the eye: outside the links, a little aside.

    It is so high that no part of a cone hides another. Of a cylinder the near wall hides a part of the far one.
    """
    around = float(np.angle(np.exp(1j * t).sum())) + radians(15)
    above = radians(min(88.0, max(38.0, degrees(surface.angle) + 8))) if isinstance(surface, Cone) else radians(50)
    return np.array([cos(above) * cos(around), cos(above) * sin(around), sin(above)])


def _walls(page: _Page) -> tuple[list[Shape], list[Shape]]:
    """Return the surface and its rims, far and near: light from one side, shadows that lie on each other.

    Wedges side by side would show where they meet. The near wall is seen through.
    """
    ends = _ENDS[page.surface.kind]
    walls: tuple[list[Shape], list[Shape]] = ([], [])
    for number in range(_SHADOWS + 1):
        half = pi * (1 - number / (_SHADOWS + 1))
        for faces_us, row in page.strips(_LIT + pi - half, _LIT + pi + half, ends, 73):
            if number:
                walls[faces_us].append(Polygon(row, "shadow", None, opacity=0.018))
            else:
                through = 1.0 if page.surface.kind == "cone" else 0.55
                walls[faces_us].append(Polygon(row, "body", None, opacity=through if faces_us else 1.0))
    round_it = np.linspace(0, 2 * pi, 91)
    rims = [Line(page.row(page.surface.place(round_it, end, 0.0)), "grey", FINE) for end in ends]
    return walls[0] + rims[:1], [*walls[1], *(rims if page.surface.kind == "cone" else rims[1:])]


def _upright(points: Floats) -> Floats:
    """Return coordinates with the surface's axis upright: (z, x, y) of the paper's frame."""
    return np.asarray(points[..., [2, 0, 1]])
