"""Four-bars that turn: which of their links turn fully, and which way links leave the surface."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import groupby
from math import pi

import numpy as np

from drawings.altered import cropped, thinned
from drawings.pieces import in_rows, of_shapes
from drawings.together import beside, said
from graphs.mechanism.sc import SCGraph
from graphs.types import Flags, Floats
from synth.linkages.conformed.rates import ConformedChain
from synth.linkages.conformed.rates_over_angles import links_in_layers
from synth.linkages.fourbar.closing import kind_of_planar
from synth.linkages.fourbar.position import output_planar
from synth.linkages.surfaces.circuit import wrapped
from synth.making.drawing import Scene
from synth.making.drawing.scene.shapes import FINE, NORMAL, STRONG, Disc, Label, Line, Point, Shape

__all__ = ["DRAWINGS", "carried_links", "way_of"]

_LENGTHS = (
    (1.4, 3.4, 3.0, 3.2), (4.0, 1.4, 3.6, 2.6), (4.0, 2.6, 3.6, 1.4), (3.4, 3.0, 1.4, 3.2),
    (2.2, 4.0, 2.4, 2.6), (4.0, 2.2, 2.6, 2.4), (2.4, 2.2, 4.0, 2.6), (2.2, 2.4, 2.6, 4.0),
)  # fmt: skip
"""g, a, h, b of each type: of the first four each link is the shortest, of the others the longest, in turn."""
_UNIT = 10.0
"""Points a unit of length."""


def four_bars() -> Scene:
    """The eight types: where input and output can go."""
    pictures = []
    for lengths in _LENGTHS:
        kind = kind_of_planar(lengths)
        signs = " ".join("+" if difference > 0 else "−" for difference in kind.differences)
        pictures.append(said(_ranges(lengths), kind.name, f"T1 T2 T3: {signs}"))
    return in_rows(pictures, 4, gap=16.0, down=10.0)


def _ranges(lengths: Sequence[float]) -> Scene:
    """Return a four-bar with the arcs that its input and its output can go through."""
    g, a, h, b = lengths
    turns = np.radians(np.arange(0.0, 360.0, 2.0) + 1.0)
    input_there = np.isfinite(output_planar(lengths, turns))
    # seen from C the output is the input: its angle is counted from C O
    output_there = np.isfinite(output_planar((g, b, h, a), pi - turns))
    # a position off the limits, where links would lie in line
    theta = float(turns[input_there][len(turns[input_there]) // 6])
    psi = float(output_planar(lengths, theta, -1))
    o, c = (0.0, 0.0), (g, 0.0)
    at_a, at_b = (a * np.cos(theta), a * np.sin(theta)), (g + b * np.cos(psi), b * np.sin(psi))
    shapes: list[Shape] = [*_arcs(o, a, turns, input_there, "class0", ())]
    shapes += _arcs(c, b, turns, output_there, "class1", (3.0, 2.0))
    shapes.append(Line([_on_page(o), _on_page(c)], "ground", 4.0))
    shapes.append(Line([_on_page(o), _on_page(at_a)], "class0", 2.4))
    shapes.append(Line([_on_page(at_a), _on_page(at_b)], "ink", NORMAL))
    shapes.append(Line([_on_page(c), _on_page(at_b)], "class1", 2.4))
    shapes += [Disc(_on_page(place), 2.0) for place in (o, at_a, at_b, c)]
    return cropped(thinned(of_shapes(1.0, 1.0, shapes)))


def _on_page(place: Sequence[float]) -> Point:
    return _UNIT * float(place[0]), -_UNIT * float(place[1])


def _arcs(
    middle: Point, radius: float, turns: Floats, there: Flags, colour: str, dash: tuple[float, ...]
) -> list[Shape]:
    """Return the whole circle, faint, and the arcs of it that are reached."""
    shapes: list[Shape] = [Disc(_on_page(middle), _UNIT * radius, None, "faint", FINE)]
    places = [_on_page((middle[0] + radius * np.cos(t), middle[1] + radius * np.sin(t))) for t in turns]
    if there.all():
        return [*shapes, Line([*places, places[0]], colour, STRONG, dash)]
    first = int(np.flatnonzero(~there)[0])  # begin where it is not, so that no arc is cut
    order = [*range(first, len(places)), *range(first)]
    for reached, run in groupby(order, key=lambda place: bool(there[place])):
        arc = [places[place] for place in run]
        if reached and len(arc) > 1:
            shapes.append(Line(arc, colour, STRONG, dash))
    return shapes


_RADIUS = 52.0
_TURN = 0.22
"""How far the input is turned, radians."""
_LAYER = 0.07
"""From one layer to the next, in radii."""
_RING = SCGraph(4, {"O": (0, 1), "A": (1, 2), "B": (2, 3), "C": (3, 0)})
_ON = 1e-9
"""Less than that is on the surface."""


def behaviours() -> Scene:
    """Four-bars on a cylinder, seen along it, after a small motion from the conformed position."""
    one_way, both_ways = np.radians([40, 90, 140, 0]), np.radians([0, 75, 180, 285])
    return beside(_moved(one_way, -_TURN), _moved(one_way, _TURN), _moved(both_ways, _TURN), gap=24.0)


def _moved(azimuths: Floats, turn: float) -> Scene:
    """Return links as pieces of the surface after a small motion, those that would lie on each other in layers."""
    links = carried_links(azimuths, turn)
    layers = links_in_layers(ConformedChain.of(_RING), azimuths).layers.tolist()
    shapes: list[Shape] = [Disc((0.0, 0.0), _RADIUS, "front", "grey", FINE)]
    lifted = carried_links(azimuths, turn, [1.0 + _LAYER * layer for layer in layers])
    for number, link in enumerate(lifted):
        colour, width = ("grey", 4.6) if number == 0 else (f"class{number - 1}", 2.6)
        shapes.append(Line(_row(link), colour, width))
    joints = np.array([links[number][-1] for number in range(4)])
    for number, (name, (x, y)) in enumerate(zip("OABC", joints.tolist(), strict=True)):
        ends = [lifted[number][-1], lifted[(number + 1) % 4][0], (x, y)]
        shapes += [Line(_row(np.array(ends)), "ink", NORMAL), Disc(_row(joints)[number], 2.2)]
        shapes.append(Label(_row(0.8 * joints)[number], name))
    ways = [way_of(link) for link in links[1:]]
    name = {"out": "extramobile", "in": "intramobile"}.get(ways[0] if len(set(ways)) == 1 else "", "transmobile")
    return said(cropped(thinned(of_shapes(1.0, 1.0, shapes))), name, _together(ways))


def carried_links(azimuths: Floats, turn: float, radii: Sequence[float] = (1.0,) * 4) -> list[Floats]:
    """Return the links of a four-bar on a cylinder of radius one, its input turned: float[k, 2] of each.

    Parameters
    ----------
    azimuths : float[4]
        Of the joints O, A, B, C, radians; C O is the ground, which comes first.
    turn : float
        Radians.
    radii : float[4], optional
        At which links lie; their joints are at one.
    """
    before = np.stack([-np.sin(azimuths), np.cos(azimuths)], axis=1)
    after = _turned(before, turn)
    links = []
    for (first, last), radius in zip(((3, 0), (0, 1), (1, 2), (2, 3)), radii, strict=True):
        step = float(wrapped(azimuths[last] - azimuths[first]))
        turns = azimuths[first] + np.linspace(0.0, step, 40)
        arc = radius * np.stack([-np.sin(turns), np.cos(turns)], axis=1)
        links.append(_carried(arc, before[[first, last]], after[[first, last]]))
    return links


def way_of(link: Floats) -> str:
    """Return which way a link has left a cylinder of radius one: out, in, both ways."""
    beyond = np.hypot(*link.T) - 1.0
    out, inside = bool(beyond.max() > _ON), bool(beyond.min() < -_ON)
    return "both ways" if out and inside else "out" if out else "in" if inside else "nowhere"


def _together(ways: Sequence[str]) -> str:
    """Return which way the links that move go."""
    if len(set(ways)) == 1:
        return f"all links go {ways[0]}"
    return ", ".join(f"{name} {way}" for name, way in zip(("OA", "AB", "BC"), ways, strict=True))


def _turned(joints: Floats, turn: float) -> Floats:
    """Return the joints O, A, B, C of a planar four-bar, float[4, 2], its input turned; O and C stay."""
    o, a, b, c = joints @ np.array([1.0, 1.0j])
    lengths = [abs(c - o), abs(a - o), abs(b - a), abs(b - c)]
    along = (c - o) / abs(c - o)
    theta, psi = float(np.angle((a - o) / along)), float(np.angle((b - c) / along))
    branch = min((1, -1), key=lambda one: abs(wrapped(output_planar(lengths, theta, one) - psi)))
    after = float(output_planar(lengths, theta + turn, branch))
    moved = [o, o + lengths[1] * along * np.exp(1j * (theta + turn)), c + lengths[3] * along * np.exp(1j * after), c]
    return np.stack([np.real(moved), np.imag(moved)], axis=1)


def _carried(points: Floats, before: Floats, after: Floats) -> Floats:
    """Return points carried with two of their body, float[2, 2] before and after."""
    z, (a, b), (c, d) = (rows @ np.array([1.0, 1.0j]) for rows in (points, before, after))
    carried = c + (z - a) * (d - c) / (b - a)
    return np.stack([carried.real, carried.imag], axis=1)


def _row(points: Floats) -> list[Point]:
    return [(_RADIUS * float(x), -_RADIUS * float(y)) for x, y in points]


DRAWINGS: dict[str, Callable[[], Scene]] = {"four-bars": four_bars, "behaviour": behaviours}
