"""Pictures of a linkage at its conformed position: circle with ICRL and shadow, surface with the links as strips.

Both are seen from the side of the apex, where azimuths grow counter-clockwise. On the surface, links lie in bands, so
that none hides another. The layers drawn are those counted (`synth.linkages.conformed.rates_over_angles`). Hyatt et
al. 2020, Figs. 7 to 9; Hyatt et al. 2021, section 5.
"""

from collections.abc import Mapping
from itertools import pairwise
from math import cos, degrees, pi, radians, sin

import numpy as np
import numpy.typing as npt

from graphs.errors import numbered
from graphs.geometry import unit
from graphs.mechanism.surfaces import Cone, Cylinder, Surface
from graphs.types import Flags, Floats
from synth.linkages.conformed.behaviours import Way, behaviour_of_motion, icrl
from synth.linkages.conformed.rates import ConformedChain, first_order
from synth.linkages.conformed.rates_over_angles import LinksInLayers, links_in_layers
from synth.making.drawing.scene.frame import PictureFrame, captions_of, page_of
from synth.making.drawing.scene.shapes import (
    FINE,
    NORMAL,
    SMALL,
    STRONG,
    Disc,
    Label,
    Layer,
    Line,
    Point,
    Polygon,
    Shape,
    arc_points,
    colour_of_class,
    moved,
    text_width,
)
from synth.making.drawing.scene.writing import Scene
from synth.making.drawing.space.panels import View, view_from

_SIDE = 240.0
"""Side of the squares of the circle and of the surface, points."""
_UNIT = 74.0
"""The radius of the circle, points."""
_FIRST, _STEP, _LAST = 1.07, 0.06, 1.44
"""Radius of the first layer; distance of layers, if there is room; largest radius of the last layer."""
_AIR = 0.03
"""Radians between the end of an arc and its joint."""

_WAYS = {Way.OUTWARD: "out", Way.INWARD: "in", Way.BOTH: "both ways", Way.STILL: "still", Way.UNKNOWN: "not told"}
_ENDS = {"cone": (0.35, 1.05), "cylinder": (0.0, 1.1)}
"""Ends of the surface along its ruling lines: distances from the apex, or from one end in radii."""
_BANDS = 0.89
"""Part of the surface that the bands of links take."""
_LIT, _SHADOWS = pi / 3, 14
"""Azimuth of the light, and number of shadows."""
_POINTS = 40
_BEYOND, _NAMES = 0.05, 0.15
"""Distances of the ends of joint axes, and of their names, beyond the end of the surface."""
_FILLED = 0.88
"""Part of the square that the surface fills."""


def draw_conformed(
    chain: ConformedChain,
    places: npt.ArrayLike,
    surface: Surface | None = None,
    title: str = "",
    *,
    grounded: bool = True,
    begins: Mapping[int, int] | None = None,
) -> Scene:
    """Return a picture of a linkage on its circle and, if it is known, on its surface, in the fewest layers.

    Parameters
    ----------
    chain : ConformedChain
    places : float[J]
        Azimuths of the joints, radians.
    surface : Cone or Cylinder, optional
        With None only the circle is drawn.
    title : str, optional
    grounded : bool, optional
        Whether the first link is fixed; else motions are not drawn.
    begins : mapping of int to int, optional
        Index of a link that spans half a turn to that of the joint at which its arc begins.

    Raises
    ------
    UnsolvableError
        If there are more than 62 joints.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> from graphs.mechanism.surfaces import Cone
    >>> chain = ConformedChain.of(SCGraph(4, dict(zip("OABC", [(0, 1), (1, 2), (2, 3), (3, 0)]))))
    >>> [layer.name for layer in draw_conformed(chain, np.radians([40, 90, 140, 0]), Cone(0.4)).layers]
    ['circle', 'cone', 'legend', 'caption']
    """
    t = np.asarray(places, dtype=float)
    laid = links_in_layers(chain, t, begins)
    seen = "seen along the axis" if isinstance(surface, Cylinder) else "seen from the apex"
    turn = 0.0 if surface is None else _around(t) - pi  # what is at the bottom there is at the bottom here
    shapes, entries = _circle(chain, t - turn, laid._replace(arcs=laid.arcs - [turn, 0.0]), grounded, seen)
    layers = [Layer("circle", tuple(shapes))]
    if surface is not None:
        layers.append(moved(surface_layer(chain, t, laid, surface, _SIDE), _SIDE, 0.0))
    wide = _SIDE * len(layers)
    legend, high = _legend(entries, wide)
    count = numbered(int(laid.layers.max(initial=0)) + 1, "layer")
    said = f"links in {count}, the first innermost; the first link grey"
    layers.append(Layer("legend", tuple(legend)))
    return page_of(PictureFrame(1, 0, 0, 0, 0, wide, _SIDE + high), layers, captions_of(title, said))


def _at(azimuth: float, radius: float = 1.0) -> Point:
    """Return a place of the circle: azimuth 0 is on top, and azimuths grow counter-clockwise, as on the cone."""
    return (_SIDE / 2 - _UNIT * radius * sin(azimuth), _SIDE / 2 - _UNIT * radius * cos(azimuth))


def _circle(
    chain: ConformedChain, t: Floats, laid: LinksInLayers, grounded: bool, seen: str
) -> tuple[list[Shape], list[tuple[str, str]]]:
    """Return circle, links as arcs and chords, ICRL, the shadow of a four-bar; and entries of the legend."""
    motion = first_order(chain, t)
    behaviour = behaviour_of_motion(chain, t, motion, laid.arcs)
    lines = icrl(motion.motions) if grounded else np.full(len(chain.links), np.nan)
    four_bar = grounded and len(chain.links) == 4 and len(t) == 4
    shapes: list[Shape] = list(_shadow(chain, t)) if four_bar else []
    shapes.append(Disc(_at(0, 0), _UNIT, None, "grey", NORMAL))
    step = min(_STEP, (_LAST - _FIRST) / max(1, int(laid.layers.max(initial=0))))
    entries: list[tuple[str, str]] = []
    for number, (joints, layer) in enumerate(zip(chain.joints_of, laid.layers.tolist(), strict=True)):
        colour, data = _colour_of_link(number), (("link", str(chain.links[number])), ("layer", str(layer)))
        if number and np.isfinite(lines[number]):
            ends = [_at(lines[number] + turn, _LAST) for turn in (0, pi)]
            shapes.append(Line(ends, colour, FINE, (4.0, 2.0)))
        start, length = laid.arcs[number]
        shapes.append(Line(_arc(start, length, _FIRST + step * layer), colour, 3.4, data=data))
        order = sorted(joints, key=lambda joint: (t[joint] - start) % (2 * pi))
        corners = [*order, order[0]] if len(order) > 2 else order
        shapes.append(Line([_at(t[joint]) for joint in corners], colour, STRONG, data=data[:1]))
        way = "ground" if number == 0 else _WAYS[Way(int(behaviour.ways[number]))]
        own = ", ".join(str(chain.joints[joint])[:4] for joint in joints)
        name = f"link {str(chain.links[number])[:8]} (joints {own})"
        entries.append((name + (f": {way}" if grounded else ""), colour))
    for joint, place in zip(chain.joints, t, strict=True):
        mark = (("joint", str(joint)),)
        shapes.append(Disc(_at(place), 2.6, "paper", "ink", NORMAL, mark))
        shapes.append(Label(_at(place, 0.87), str(joint), SMALL, widest=8, data=mark))
    shapes += [Line([_at(turn, 0.04), _at(turn + pi, 0.04)], "ink", FINE) for turn in (0, pi / 2)]
    notes = [seen] + ["ICRL dashed"] * bool(np.isfinite(lines).any()) + ["shadow grey"] * four_bar
    shapes.append(Label((_SIDE / 2, SMALL), ", ".join(notes), SMALL, "grey"))
    return shapes, entries


def _arc(start: float, length: float, radius: float) -> list[Point]:
    """Return an arc, its ends a little inside, so that links of a layer that share a joint do not touch."""
    inside = min(_AIR, length / 3)
    # on the page, x to the right and y down, azimuths grow from the top to the left
    first, last = start + inside, start + length - inside
    return arc_points(_at(0, 0), _UNIT * radius, -first - pi / 2, -last - pi / 2)


def _shadow(chain: ConformedChain, t: Floats) -> list[Shape]:
    """Return the double wedge between the lines of the side links that holds ground and coupler."""
    from shapely.geometry import Point as Spot

    ground = chain.joints_of[0]
    sides = [joints for joints in chain.joints_of[1:] if set(joints) & set(ground)]
    (a, b), (c, d) = (
        [_at(t[joint]) for joint in sorted(joints, key=lambda joint: joint not in ground)] for joints in sides
    )
    inside = Spot(_at(0, 0)).buffer(_LAST * _UNIT, 32)
    same = (_off(a, b, d) > 0) == (_off(c, d, b) > 0)
    pieces = [
        inside.intersection(_half_plane(a, b, turned)).intersection(_half_plane(c, d, turned == same))
        for turned in (False, True)
    ]
    return [
        Polygon([(x, y) for x, y in piece.exterior.coords[:-1]], "faint", None, opacity=0.6)
        for piece in pieces
        if piece.geom_type == "Polygon" and not piece.is_empty
    ]


def _off(p: Point, q: Point, at: Point) -> float:
    return (q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0])


def _half_plane(p: Point, q: Point, turned: bool) -> object:
    """Return the part of the page on one side of a line, large enough for a circle."""
    from shapely.geometry import Polygon as Area

    along = unit(np.subtract(q, p)) * 4 * _SIDE
    across = np.array([-along[1], along[0]]) * (1 if turned else -1)
    middle = np.asarray(p)
    return Area([middle - along, middle + along, middle + along + across, middle - along + across])


def _legend(entries: list[tuple[str, str]], wide: float) -> tuple[list[Shape], float]:
    """Return the names of links with their colours, in rows below the square; and the height of the rows."""
    widest = max(text_width(text, SMALL) for text, _ in entries) + 24
    columns = max(1, int((wide - 10) // widest))
    shapes: list[Shape] = []
    for place, (text, colour) in enumerate(entries):
        x, y = 10 + place % columns * (wide - 10) / columns, _SIDE + (place // columns + 0.5) * 1.6 * SMALL
        shapes.append(Line([(x, y), (x + 10, y)], colour, 3.4))
        shapes.append(Label((x + 16, y), text, SMALL, anchor="start", halo=False, widest=60))
    return shapes, 1.6 * SMALL * -(-len(entries) // columns) + 4


def _colour_of_link(number: int) -> str:
    """Return the colour of a link by its index, the first grey."""
    return "grey" if number == 0 else colour_of_class(number - 1)


def surface_layer(chain: ConformedChain, t: Floats, laid: LinksInLayers, surface: Surface, side: float) -> Layer:
    """Return a linkage on its surface, in a square with a side in points.

    `t` are the azimuths of the joints, float[J], radians. Shapes on the far side are drawn first.
    """
    drawn = Cylinder(1.0) if isinstance(surface, Cylinder) else surface
    page = _SurfacePage(drawn, _towards(t, drawn), side)
    inner, outer = _ENDS[surface.kind]
    width = _BANDS * (outer - inner) / (int(laid.layers.max()) + 1)
    far, near = _walls(page)
    for number, layer in enumerate(laid.layers.tolist()):
        start, length = laid.arcs[number]
        begin = inner + 0.04 * (outer - inner) + width * layer
        mark = (("link", str(chain.links[number])), ("layer", str(layer)))
        for faces_us, row in page.strips(start, start + length, (begin, begin + 0.9 * width), _POINTS):
            shape = Polygon(row, _colour_of_link(number), "paper", FINE, data=mark)
            (near if faces_us else far).append(shape)
    names = []
    for joint, place in zip(chain.joints, t.tolist(), strict=True):
        data = (("joint", str(joint)),)
        faces_us = bool(page.faces_us(np.array([place]))[0])
        first = 0.0 if surface.kind == "cone" else inner - _BEYOND
        name = outer + _NAMES if faces_us else inner - _NAMES
        line = page.row(drawn.place(np.full(2, place), np.array([first, outer + _BEYOND]), 0.0))
        (near if faces_us else far).append(Line(line, "ink", NORMAL, data=data))
        names.append(Label(page.row(drawn.place(place, name, 0.0)[None])[0], str(joint), SMALL, widest=8, data=data))
    if isinstance(surface, Cone):
        angle = degrees(surface.angle)
        title = f"cone of λ = {angle:.4g}°, half angle {90.0 - angle:.4g}°, seen from the apex's side"
    else:
        title = f"cylinder of R = {surface.radius:.4g}"
    names.append(Label((side / 2, SMALL), title, SMALL, "grey"))
    return Layer(surface.kind, (*far, *near, *names))


class _SurfacePage:
    """The map from points of the paper's frame to the square, which the surface fills but for a margin."""

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
        """Return the places of points on the page."""
        x, y = (self._seen(points) - self._middle).T * self._scale
        return list(zip((self._side / 2 + x).tolist(), (self._side / 2 - y).tolist(), strict=True))

    def faces_us(self, azimuths: Floats) -> Flags:
        """Return whether the outside is visible at each ruling line: bool[n]."""
        outward = self.surface.place(azimuths, 0.0, 1.0) - self.surface.place(azimuths, 0.0, 0.0)
        return np.asarray(self._view.near(_upright(outward)) > 0.0)

    def strips(
        self, start: float, end: float, ends: tuple[float, float], points: int
    ) -> list[tuple[bool, list[Point]]]:
        """Return a strip between ruling lines as outlines, cut where its outside ceases to be visible."""
        azimuths = np.linspace(start, end, points)
        middles = self.faces_us((azimuths[1:] + azimuths[:-1]) / 2)
        cuts = [0, *(np.flatnonzero(middles[1:] != middles[:-1]) + 1).tolist(), points - 1]
        outlines = []
        for first, last in pairwise(cuts):
            there, back = (self.surface.place(azimuths[first : last + 1], end, 0.0) for end in ends)
            outlines.append((bool(middles[first]), self.row(np.concatenate([there, back[::-1]]))))
        return outlines


def _around(t: Floats) -> float:
    """Return the azimuth that faces the eye: the middle of the joints, a little aside."""
    return float(np.angle(np.exp(1j * t).sum())) + radians(15)


def _towards(t: Floats, surface: Surface) -> Floats:
    """Return the direction of the eye: outside the links, a little aside.

    It is so high that no part of a cone hides another. Of a cylinder the near wall hides a part of the far one.
    """
    around = _around(t)
    above = radians(min(88.0, max(38.0, degrees(surface.angle) + 8))) if isinstance(surface, Cone) else radians(50)
    return np.array([cos(above) * cos(around), cos(above) * sin(around), sin(above)])


def _walls(page: _SurfacePage) -> tuple[list[Shape], list[Shape]]:
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
