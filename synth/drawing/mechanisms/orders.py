"""Joints in their order round a cone: the circle seen from the apex, links as chords between their joints.

Azimuths are 0 on top and grow counter-clockwise, as in the pictures of `synth.drawing.conformed`, which show more.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import cos, pi, sin

from graphs.errors import numbered
from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import SurfaceLinkage
from synth.drawing.mechanisms.labelling import Obstacles, beside, placed
from synth.drawing.mechanisms.signs import joint_dot
from synth.drawing.scene.frame import COLUMN, captions_of, framed, page_of
from synth.drawing.scene.palette import NORMAL, SMALL
from synth.drawing.scene.shapes import Disc, Label, Layer, Line, Scene

__all__ = ["OrderOnCircle", "order_of_linkage", "order_scene"]

_UNIT = 60.0
"""The radius of the circle, points, where there is room."""
_SMALL = 200.0
"""Points of width and height below which letters and dots are smaller."""


@dataclass(frozen=True, slots=True)
class OrderOnCircle:
    """Joints round a cone, at azimuths in radians; the chain is drawn if the order is not shown.

    `pairs` are the indices of the joints that a link has beside each other.
    """

    chain: SCGraph
    names: Sequence[str]
    azimuths: Sequence[float]
    pairs: Sequence[tuple[int, int]]


def order_of_linkage(linkage: SurfaceLinkage) -> OrderOnCircle:
    """Return the order of a linkage that is given by steps between its axes.

    Raise InvariantError if the steps disagree, or do not lead to every joint.

    >>> ring = SCGraph(4, dict(zip("OABC", [(0, 1), (1, 2), (2, 3), (3, 0)])))
    >>> order = order_of_linkage(SurfaceLinkage(ring, steps={("O", "A"): 1.0, ("A", "B"): 1.0, ("B", "C"): 1.0}))
    >>> order.azimuths, order.pairs
    ([0.0, 1.0, 2.0, 3.0], [(0, 1), (0, 3), (1, 2), (2, 3)])
    """
    azimuths = linkage.places()
    joints = list(linkage.chain.joints)
    pairs: set[tuple[int, int]] = set()
    for link in linkage.chain.nodes:
        own = [place for place, joint in enumerate(joints) if link in linkage.chain.joints[joint]]
        own.sort(key=lambda place: azimuths[place] % (2 * pi))
        pairs.update(_sorted(a, b) for a, b in zip(own, own[1:] + own[:1], strict=True) if a != b)
    return OrderOnCircle(linkage.chain, list(map(str, joints)), azimuths, sorted(pairs))


def _sorted(a: int, b: int) -> tuple[int, int]:
    return min(a, b), max(a, b)


def order_scene(
    order: OrderOnCircle,
    *,
    numbers: bool = True,
    box: tuple[float, float] = (COLUMN, COLUMN),
    caption: str | None = "",
) -> Scene:
    """Return a picture of an order of joints round a cone, at most as large as the box, (width, height) in points.

    `numbers`: write the names of joints. The caption comes before the line that describes the picture; with None
    there is neither.
    """
    size, dot = (5.0, 1.6) if min(box) < _SMALL else (SMALL, 2.1)
    frame = framed([(-1, -1), (1, 1)], _UNIT, box, margin=2 * size + dot)
    middle, radius = frame.at((0, 0)), frame.scale
    places = [frame.at((-sin(azimuth), cos(azimuth))) for azimuth in order.azimuths]
    chords = [(places[a], places[b]) for a, b in order.pairs]
    dots = [joint_dot(at, name, dot) for at, name in zip(places, order.names, strict=True)]
    layers = [
        Layer("circle", (Disc(middle, radius, None, "grey", NORMAL),)),
        Layer("links", tuple(Line(chord, "class0", 1.2 * NORMAL) for chord in chords)),
        Layer("joints", tuple(dots)),
    ]
    if numbers:
        obstacles = Obstacles([(*at, dot + 0.8) for at in places], [*chords, *_pieces(middle, radius)])
        wishes = []
        for at, azimuth, name in zip(places, order.azimuths, order.names, strict=True):
            label = Label((0, 0), name, size, widest=4, data=(("joint", name),))
            wishes.append((label, beside(at, dot + 0.9 * size, first=-pi / 2 - azimuth)))
        layers.append(Layer("labels", tuple(placed(wishes, obstacles))))
    planar = bool(order.chain.loops) and all(loop.centre is Centre.INFINITE for loop in order.chain.loops)
    where = "cylinder, seen along its axis" if planar else "cone, seen from the apex"
    said = f"{numbered(len(order.names), 'joint')} round a {where}; links are chords between joints"
    return page_of(frame, layers, captions_of(caption, said))


def _pieces(middle: tuple[float, float], radius: float) -> list[tuple[tuple[float, float], tuple[float, float]]]:
    """Return the circle as straight pieces, which labels keep off."""
    turns = [2 * pi * i / 48 for i in range(49)]
    row = [(middle[0] + radius * cos(turn), middle[1] + radius * sin(turn)) for turn in turns]
    return list(pairwise(row))
