"""Kinematic chains as the literature draws them; joints in their order round a cone; R/- strings as strips.

Links of a chain are bodies, joints small circles. An order of joints is shown on the circle as seen from the
apex, links as chords between their joints; azimuths are 0 on top and grow counter-clockwise, as in the pictures
of `synth.making.drawing.conformed`, which show more. A string is a strip of paper between two bodies, with fans of
creases that meet in a point.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import cos, hypot, pi, sin

import shapely

from enumerate.strings.panel_strings import ChainString
from graphs.errors import numbered
from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import SurfaceLinkage
from graphs.types import JointId, LinkId
from synth.linkages.conformed.orders import OrderOnCircle
from synth.making.drawing.layout.mechanisms import Layout, layout_of
from synth.making.drawing.mechanisms.labelling import beside, joint_dot, placed
from synth.making.drawing.scene.frame import PLAIN, PictureFrame, PictureOptions, captions_of, framed, page_of
from synth.making.drawing.scene.shapes import NORMAL, SMALL, Disc, Label, Layer, Line, Point, Polygon, Shape
from synth.making.drawing.scene.writing import Scene

_UNIT = 46.0
_BINARY = 3.4
"""Width of a binary link, points."""
_CIRCLE = 60.0
"""The radius of the circle, points, where there is room."""
_SMALL_BOX = 200.0
"""Points of width and height below which letters and dots are smaller."""
_HIGH, _PANEL, _FAN, _END = 1.0, 0.8, 0.55, 0.6
"""Height of a strip; widths of a panel, of a step of a fan, and of a body at an end, in units of the height."""
_ROOM = 0.62
"""Radius of a circle in a body that holds its number, in heights of letters."""
_STRIP = 34.0
"""Height of a strip, points, where there is room."""


@dataclass(frozen=True, slots=True)
class ChainLook:
    """Options of a picture of a chain; the size of letters and the radius of joints are in points."""

    link_numbers: bool = True
    joint_numbers: bool = True
    size: float = SMALL
    dot: float = 2.3


def chain_scene(chain: SCGraph, options: PictureOptions = PLAIN, *, look: ChainLook | None = None) -> Scene:
    """Return a picture of a link-joint graph with links as bodies, without the loops' centres."""
    if look is None:
        look = ChainLook(options.numbers, options.numbers)
        if min(options.box) < _SMALL_BOX:
            look = ChainLook(options.numbers, False, size=5.0, dot=1.6)
    layout = layout_of(chain.nodes, chain.joints)
    corners = [place for outline in layout.outlines.values() for place in outline]
    frame = framed([*layout.links.values(), *layout.joints.values(), *corners], _UNIT, options.box)
    layers = _chain_layers(chain, layout, frame, look)
    said = f"{numbered(len(chain), 'link')}, {numbered(len(chain.joints), 'joint')}"
    if not layout.plane:
        said += "; not planar: lines cross"
    elif layout.mirror:
        said += "; drawn with a mirror"
    return page_of(frame, layers, captions_of(options.caption, said))


def _chain_layers(chain: SCGraph, layout: Layout, frame: PictureFrame, look: ChainLook) -> list[Layer]:
    """Return links, joints and labels of a chain in a frame."""
    outlines = {link: frame.row(row) for link, row in layout.outlines.items()}
    bodies: list[Shape] = []
    # large bodies below, so that those that cross stay visible
    for link in sorted(outlines, key=lambda link: -len(outlines[link])):
        bodies += _body(link, outlines[link], link == chain.ground, look, layout.plane)
    joints = {joint: frame.at(place) for joint, place in layout.joints.items()}
    dots: list[Shape] = [joint_dot(at, joint, look.dot) for joint, at in joints.items()]
    for link, place in layout.links.items():
        if link not in outlines:
            x, y = frame.at(place)
            bodies.append(Line([(x - 6, y), (x + 6, y)], "ink", 2 * NORMAL, data=(("link", str(link)),)))
    labels = _labels(outlines, joints, look)
    return [Layer("links", tuple(bodies)), Layer("joints", tuple(dots)), Layer("labels", tuple(labels))]


def _body(link: LinkId, row: list[Point], ground: bool, look: ChainLook, plane: bool) -> list[Shape]:
    """Return a link as a polygon with round corners, or as a bar: a wide line, and a narrower one on it."""
    data = (("link", str(link)),)
    fill = "ground" if ground else "body"
    wide = _width(row, look)
    opacity = 1.0 if plane else 0.75
    if len(row) < 3:
        return [Line(row, "ink", wide + 1.2), Line(row, fill, wide, data=data)]
    return [
        Polygon(row, None, "ink", wide + 1.4),
        Polygon(row, fill, None, opacity=opacity),
        Polygon(row, None, fill, wide, data=data),
    ]


def _width(row: list[Point], look: ChainLook) -> float:
    """Return how wide a bar is, or the round rim of a polygon, points."""
    return 2 * look.dot * 1.25 if len(row) > 2 else look.dot * _BINARY / 2.3


def _edges(row: list[Point], off: float) -> list[tuple[Point, Point]]:
    """Return the visible outline of a body: lines on both sides of each of its own."""
    edges = []
    for (ax, ay), (bx, by) in zip(row, row[1:] + (row[:1] if len(row) > 2 else []), strict=False):
        long = hypot(bx - ax, by - ay) or 1.0
        across = (-(by - ay) / long * off, (bx - ax) / long * off)
        edges += [
            ((ax + side * across[0], ay + side * across[1]), (bx + side * across[0], by + side * across[1]))
            for side in (1, -1)
        ]
    return edges


def _labels(outlines: dict[LinkId, list[Point]], joints: dict[JointId, Point], look: ChainLook) -> list[Label]:
    """Return the numbers of links, bold, in bodies or beside bars, and those of joints beside them."""
    lines = [edge for row in outlines.values() for edge in _edges(row, _width(row, look) / 2)]
    bodies = [shapely.Polygon(row) for row in outlines.values() if len(row) > 2]
    wishes: list[tuple[Label, list[Point]]] = []
    if look.link_numbers:
        for link, row in sorted(outlines.items(), key=lambda item: -len(item[1])):
            label = Label(
                (0, 0), str(link), look.size, bold=True, halo=len(row) < 3, widest=8, data=(("link", str(link)),)
            )
            wishes.append((label, _for_body(row, look, bodies)))
    if look.joint_numbers:
        for joint, at in joints.items():
            label = Label((0, 0), str(joint), 0.85 * look.size, "grey", widest=8, data=(("joint", str(joint)),))
            wishes.append((label, beside(at, look.dot + 0.75 * look.size)))
    return placed(wishes, [(x, y, look.dot + 0.8) for x, y in joints.values()], lines)


def _for_body(row: list[Point], look: ChainLook, bodies: Sequence[shapely.Polygon]) -> list[Point]:
    """Return places for the number of a body, the best first: inside, or beside it where it is too thin."""
    middle = (sum(x for x, _ in row) / len(row), sum(y for _, y in row) / len(row))
    if len(row) > 2:
        inside = [middle, *beside(middle, 0.6 * look.size)]
        rim = _width(row, look) / 2
        if shapely.Polygon(row).buffer(-_ROOM * look.size).is_empty:
            return [*_beyond(row, rim + 0.75 * look.size, bodies), *inside]
        return inside
    (ax, ay), (bx, by) = row
    long = hypot(bx - ax, by - ay) or 1.0
    across = (-(by - ay) / long, (bx - ax) / long)
    far = 0.5 * _BINARY + 0.75 * look.size
    places = []
    for part in (0.5, 0.38, 0.62):
        foot = (ax + part * (bx - ax), ay + part * (by - ay))
        places += [(foot[0] + side * far * across[0], foot[1] + side * far * across[1]) for side in (1, -1)]
    return [*places, *beside(middle, far)]


def _beyond(row: list[Point], off: float, bodies: Sequence[shapely.Polygon]) -> list[Point]:
    """Return places beside the middles of a body's sides, so far off, that lie in no body, the outermost first."""
    places = []
    for (ax, ay), (bx, by) in zip(row, [*row[1:], row[0]], strict=True):
        long = hypot(bx - ax, by - ay) or 1.0
        across, down = off * (by - ay) / long, -off * (bx - ax) / long
        places += [((ax + bx) / 2 + side * across, (ay + by) / 2 + side * down) for side in (1, -1)]
    middle = shapely.MultiPolygon(bodies).centroid
    free = [point for point in map(shapely.Point, places) if not any(body.contains(point) for body in bodies)]
    return [(point.x, point.y) for point in sorted(free, key=middle.distance, reverse=True)]


def order_of_linkage(linkage: SurfaceLinkage) -> OrderOnCircle:
    """Return the order of a linkage that is defined by steps between its axes.

    Raise InvariantError if the steps disagree, or do not lead to every joint.
    """
    azimuths = linkage.places()
    joints = list(linkage.chain.joints)
    pairs: set[tuple[int, int]] = set()
    for link in linkage.chain.nodes:
        own = [place for place, joint in enumerate(joints) if link in linkage.chain.joints[joint]]
        own.sort(key=lambda place: azimuths[place] % (2 * pi))
        pairs.update((min(a, b), max(a, b)) for a, b in zip(own, own[1:] + own[:1], strict=True) if a != b)
    return OrderOnCircle(linkage.chain, list(map(str, joints)), azimuths, sorted(pairs))


def order_scene(order: OrderOnCircle, options: PictureOptions = PLAIN) -> Scene:
    """Return a picture of an order of joints round a cone; the numbers are the names of joints."""
    size, dot = (5.0, 1.6) if min(options.box) < _SMALL_BOX else (SMALL, 2.1)
    frame = framed([(-1, -1), (1, 1)], _CIRCLE, options.box, margin=2 * size + dot)
    middle, radius = frame.at((0, 0)), frame.scale
    places = [frame.at((-sin(azimuth), cos(azimuth))) for azimuth in order.azimuths]
    chords = [(places[a], places[b]) for a, b in order.pairs]
    dots = [joint_dot(at, name, dot) for at, name in zip(places, order.names, strict=True)]
    layers = [
        Layer("circle", (Disc(middle, radius, None, "grey", NORMAL),)),
        Layer("links", tuple(Line(chord, "class0", 1.2 * NORMAL) for chord in chords)),
        Layer("joints", tuple(dots)),
    ]
    if options.numbers:
        turns = [2 * pi * i / 48 for i in range(49)]
        circle = [(middle[0] + radius * cos(turn), middle[1] + radius * sin(turn)) for turn in turns]
        wishes = []
        for at, azimuth, name in zip(places, order.azimuths, order.names, strict=True):
            label = Label((0, 0), name, size, widest=4, data=(("joint", name),))
            wishes.append((label, beside(at, dot + 0.9 * size, first=-pi / 2 - azimuth)))
        labels = placed(wishes, [(*at, dot + 0.8) for at in places], [*chords, *pairwise(circle)])
        layers.append(Layer("labels", tuple(labels)))
    planar = bool(order.chain.loops) and all(loop.centre is Centre.INFINITE for loop in order.chain.loops)
    where = "cylinder, seen along its axis" if planar else "cone, seen from the apex"
    said = f"{numbered(len(order.names), 'joint')} round a {where}; links are chords between joints"
    return page_of(frame, layers, captions_of(options.caption, said))


def strip_scene(chain: ChainString, options: PictureOptions = PLAIN) -> Scene:
    """Return a picture of an R/- string: the bodies at its ends are grey, a fan meets at the lower edge."""
    creases = _creases_of_strip(chain)
    right = max(top for _, top in creases) + _END
    sides = [(0.0, 0.0), *creases, (right, right)]
    frame = framed([(0, 0), (right, _HIGH)], _STRIP, options.box)
    panels: list[Shape] = []
    for number, ((b0, t0), (b1, t1)) in enumerate(pairwise(sides)):
        corners = [(b0, 0.0), (b1, 0.0), (t1, _HIGH), (t0, _HIGH)]
        row = frame.row(dict.fromkeys(corners))  # the corners of a triangle once
        end = number in (0, len(sides) - 2)
        panels.append(Polygon(row, "ground" if end else "body", "ink", NORMAL, data=(("link", str(number)),)))
    lines = tuple(
        Line(frame.row([(bottom, 0.0), (top, _HIGH)]), "class0", 1.4 * NORMAL, data=(("joint", str(number)),))
        for number, (bottom, top) in enumerate(creases)
    )
    said = f"{chain.text}: {chain.creases} creases"
    return page_of(frame, [Layer("panels", tuple(panels)), Layer("creases", lines)], captions_of(options.caption, said))


def _creases_of_strip(chain: ChainString) -> list[tuple[float, float]]:
    """Return for each crease its x at the lower and at the upper edge."""
    creases = []
    left = _END
    for size in chain.clusters:
        wide = _FAN * (size - 1)
        creases += [(left + wide / 2, left + _FAN * i) for i in range(size)]
        left += wide + _PANEL
    return creases
