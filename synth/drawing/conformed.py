"""Pictures of a linkage at its conformed position: circle with ICRL and shadow, surface with the links as strips.

Both are seen from the side of the apex, where azimuths grow counter-clockwise. The layers drawn are those counted
(`synth.conformed.all_angles`). Static pictures; Hyatt et al. 2020, Figs. 7 to 9; Hyatt et al. 2021, section 5.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, pi, sin

import numpy as np
import numpy.typing as npt

from graphs.arrays import Floats
from graphs.geometry import unit
from graphs.mechanism.surfaces import Cylinder, Surface
from synth.conformed.all_angles import LinksInLayers, links_in_layers
from synth.conformed.behaviours import Way, behaviour_of_motion, icrl
from synth.conformed.rates import ConformedChain, first_order
from synth.drawing.on_surface import colour_of_link, surface_layer
from synth.drawing.scene.frame import Frame, captions_of, page_of
from synth.drawing.scene.moving import moved
from synth.drawing.scene.palette import FINE, NORMAL, SMALL, STRONG
from synth.drawing.scene.shapes import Disc, Label, Layer, Line, Point, Polygon, Scene, Shape, arc_points

__all__ = ["draw_conformed"]

_SIDE = 240.0
"""Of the square that circle and cone each take, points."""
_UNIT = 74.0
"""The radius of the circle, points."""
_FIRST, _STEP, _LAST = 1.07, 0.06, 1.44
"""Radii of the first layer; from one to the next, if there is room; of the last at most."""
_AIR = 0.03
"""Radians between the end of an arc and its joint."""

_WAYS = {
    Way.OUTWARD: "out",
    Way.INWARD: "in",
    Way.BOTH: "both ways",
    Way.STILL: "still",
    Way.UNKNOWN: "not told",
}


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
        None for any, of which only the circle is drawn.
    title : str, optional
    grounded : bool, optional
        Whether the first link is fixed; else nothing is drawn of motions.
    begins : mapping of int to int, optional
        Number of a link that spans half a turn to that of the joint at which its arc begins.

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
    shapes, told = _circle(chain, t, laid, grounded, seen)
    layers = [Layer("circle", tuple(shapes))]
    if surface is not None:
        layers.append(moved(surface_layer(chain, t, laid, surface, _SIDE), _SIDE, 0.0))
    wide = _SIDE * len(layers)
    legend, high = _legend(told, wide)
    layers.append(Layer("legend", tuple(legend)))
    return page_of(Frame(1, 0, 0, 0, 0, wide, _SIDE + high), layers, captions_of(title, _said(laid)))


def _said(laid: LinksInLayers) -> str:
    count = int(laid.layers.max(initial=0)) + 1
    return f"links in {count} layer{'s' * (count != 1)}, the first innermost; the first link grey"


def _at(azimuth: float, radius: float = 1.0) -> Point:
    """Return a place of the circle: 0 on top, growing counter-clockwise, as the cone shows them."""
    return (_SIDE / 2 - _UNIT * radius * sin(azimuth), _SIDE / 2 - _UNIT * radius * cos(azimuth))


def _circle(
    chain: ConformedChain, t: Floats, laid: LinksInLayers, grounded: bool, seen: str
) -> tuple[list[Shape], list[tuple[str, str]]]:
    """Return circle, links as arcs and chords, ICRL, the shadow of a four-bar; and the words of the legend."""
    motion = first_order(chain, t)
    behaviour = behaviour_of_motion(chain, t, motion, laid.arcs)
    lines = icrl(motion.motions) if grounded else np.full(len(chain.links), np.nan)
    four_bar = grounded and len(chain.links) == 4 and len(t) == 4
    shapes: list[Shape] = list(_shadow(chain, t)) if four_bar else []
    shapes.append(Disc(_at(0, 0), _UNIT, None, "grey", NORMAL))
    step = min(_STEP, (_LAST - _FIRST) / max(1, int(laid.layers.max(initial=0))))
    told: list[tuple[str, str]] = []
    for number, (joints, layer) in enumerate(zip(chain.joints_of, laid.layers.tolist(), strict=True)):
        colour, data = colour_of_link(number), (("link", str(chain.links[number])), ("layer", str(layer)))
        if number and np.isfinite(lines[number]):
            ends = [_at(lines[number] + turn, _LAST) for turn in (0, pi)]
            shapes.append(Line(ends, colour, FINE, (4.0, 2.0)))
        start, length = laid.arcs[number]
        shapes.append(Line(_arc(start, length, _FIRST + step * layer), colour, 3.4, data=data))
        order = sorted(joints, key=lambda joint: (t[joint] - start) % (2 * pi))
        corners = [*order, order[0]] if len(order) > 2 else order
        shapes.append(Line([_at(t[joint]) for joint in corners], colour, STRONG, data=data[:1]))
        way = "ground" if number == 0 else _WAYS[Way(int(behaviour.ways[number]))]
        told.append((_name(chain, number) + (f": {way}" if grounded else ""), colour))
    for joint, place in zip(chain.joints, t, strict=True):
        mark = (("joint", str(joint)),)
        shapes.append(Disc(_at(place), 2.6, "paper", "ink", NORMAL, mark))
        shapes.append(Label(_at(place, 0.87), str(joint), SMALL, widest=8, data=mark))
    shapes += [Line([_at(turn, 0.04), _at(turn + pi, 0.04)], "ink", FINE) for turn in (0, pi / 2)]
    notes = [seen] + ["ICRL dashed"] * bool(np.isfinite(lines).any()) + ["shadow grey"] * four_bar
    shapes.append(Label((_SIDE / 2, SMALL), ", ".join(notes), SMALL, "grey"))
    return shapes, told


def _arc(start: float, length: float, radius: float) -> list[Point]:
    """Return an arc, its ends a little inside, so that links of a layer that share a joint do not touch."""
    inside = min(_AIR, length / 3)
    # on the page, x to the right and y down, azimuths grow from the top to the left
    first, last = start + inside, start + length - inside
    return arc_points(_at(0, 0), _UNIT * radius, -first - pi / 2, -last - pi / 2)


def _name(chain: ConformedChain, number: int) -> str:
    return "link " + "".join(str(chain.joints[joint])[:4] for joint in chain.joints_of[number])


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
    pieces = []
    for turned in (False, True):
        first = _half_plane(a, b, turned)
        second = _half_plane(c, d, turned == same)
        pieces.append(inside.intersection(first).intersection(second))
    return [
        Polygon([(x, y) for x, y in piece.exterior.coords[:-1]], "faint", None, opacity=0.6)
        for piece in pieces
        if piece.geom_type == "Polygon" and not piece.is_empty
    ]


def _off(p: Point, q: Point, at: Point) -> float:
    return (q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0])


def _half_plane(p: Point, q: Point, turned: bool) -> object:
    """Return what of the page is on one side of a line, far enough for a circle."""
    from shapely.geometry import Polygon as Area

    along = unit(np.subtract(q, p)) * 4 * _SIDE
    across = np.array([-along[1], along[0]]) * (1 if turned else -1)
    middle = np.asarray(p)
    return Area([middle - along, middle + along, middle + along + across, middle - along + across])


def _legend(told: list[tuple[str, str]], wide: float) -> tuple[list[Shape], float]:
    """Return the names of links with their colours, in rows, below the square; and how high they are."""
    columns = max(1, int(wide // 118))
    shapes: list[Shape] = []
    for place, (text, colour) in enumerate(told):
        x, y = 10 + place % columns * (wide - 10) / columns, _SIDE + (place // columns + 0.5) * 1.6 * SMALL
        shapes.append(Line([(x, y), (x + 10, y)], colour, 3.4))
        shapes.append(Label((x + 16, y), text, SMALL, anchor="start", halo=False, widest=26))
    return shapes, 1.6 * SMALL * -(-len(told) // columns) + 4
