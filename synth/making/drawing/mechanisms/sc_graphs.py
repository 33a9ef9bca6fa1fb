"""SC and SCD graphs in the notation of the thesis: links as discs, joints as lines, in each loop its sign.

A finite centre is a circled dot, one at infinity a lying eight; loops without a centre are empty. Loops that
share their centre have signs of one colour. Signs have the numbers of their loops, from 0, as files and options have
them, and name the loops that share their centre. Open edges of an SCD graph are stubs. Ride-alongs, which `synth
reduce` lists, lie on yellow bands. Source: Wiener 2016, 3.3, 3.4 and 4.2.4.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import pairwise
from math import atan2, cos, hypot, inf, pi, sin
from typing import TypeAlias

from scipy.spatial.distance import pdist

from graphs.errors import UnsolvableError, numbered
from graphs.identity.drawings import drawing_of
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.drawing import trace_faces
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.reduce.ride_alongs import Reduction, reduce
from graphs.types import JointId, LinkId
from synth.making.drawing.layout.mechanisms import Layout, layout_of
from synth.making.drawing.mechanisms.labelling import SIGN, beside, centre_sign, placed
from synth.making.drawing.scene.frame import PLAIN, PictureFrame, PictureOptions, captions_of, framed, page_of
from synth.making.drawing.scene.shapes import (
    NORMAL,
    SMALL,
    STRONG,
    Disc,
    Label,
    Layer,
    Line,
    Point,
    Shape,
    colour_of_class,
    text_width,
)
from synth.making.drawing.scene.writing import Scene

_UNIT = 58.0
_LINK = 6.6
_STUB = 10.0
_SMALL_BOX, _SMALLEST = 110.0, 0.6
"""Points of width and height below which margins and letters are reduced, and by how much at most."""
_LOOSE_LOOPS = 12
"""Largest number of loops that are not faces and are listed below; more are counted."""
_BAND = 0.9
"""Half the width of the band below a removed joint, in units of the radius of a link."""
_RIM = 1.45
"""Radius of the disc below a removed link, likewise."""
_Sign: TypeAlias = tuple[Point, int, list[Shape]]
"""Place, number and shapes of the sign of a centre class."""


def sc_scene(sc: SCGraph, options: PictureOptions = PLAIN) -> Scene:
    """Return a picture of an SC or SCD graph, the latter by its rotations, with its open edges."""
    rotation, outer = _kept_drawing(sc)
    layout = layout_of(sc.nodes, sc.joints, as_bodies=False, rotation=rotation, outer=outer)
    places = [*layout.links.values(), *layout.joints.values()]
    small = min(1.0, max(_SMALLEST, min(options.box) / _SMALL_BOX))
    frame = framed(places, _UNIT, options.box, margin=small * (_STUB + 2 * _LINK))
    numbers = class_numbers(sc)
    ways = {joint: frame.row(row) for joint, row in layout.ways.items()}
    drawn = {joint: _bent(row) for joint, row in ways.items()}
    links = {link: frame.at(place) for link, place in layout.links.items()}
    radius = min(
        _LINK, 0.042 * min(options.box), 0.24 * frame.scale, 0.42 * pdist(list(links.values())).min(initial=inf)
    )
    signs, loose = _signs(sc, layout, frame, numbers)
    stubs = _stubs(sc, ways, links, radius) if isinstance(sc, SCDGraph) else []
    labels = _labels(ways, links, radius, signs, numbers, small)
    joints = [Line(row, "ink", 1.2 * NORMAL, data=(("joint", str(joint)),)) for joint, row in drawn.items()]
    reduction = reduce(sc)
    layers = [
        Layer("ride-alongs", tuple(_ride_alongs(reduction, drawn, links, radius))),
        Layer("joints", (*stubs, *joints)),
        Layer("links", tuple(_links(sc, links, radius))),
        Layer("centres", tuple(shape for shapes in signs.values() for shape in shapes[2])),
        Layer("labels", tuple(labels)),
    ]
    said = _said(sc, layout, loose, numbers)
    if reduction.steps:
        count = numbered(len(reduction.steps), "ride-along")
        said.append(f"{count} (yellow band); without, {len(reduction.graph)} links stay")
    return page_of(frame, layers, captions_of(options.caption, *said))


def class_numbers(sc: SCGraph) -> dict[int, int]:
    """Return the number of the centre class of each loop: independent loops first, then closing ones."""
    return {loop: number for number, centre in enumerate(sc.centre_classes()) for loop in centre.loops}


def _kept_drawing(sc: SCGraph) -> tuple[dict[LinkId, tuple[JointId, ...]] | None, tuple[JointId, ...]]:
    """Return the rotations and the outer face of the drawing whose faces are the loops, if there is one."""
    try:
        rotation, (joint, link) = drawing_of(sc)
    except UnsolvableError:
        return None, ()
    bare = {name: tuple(side for side in sides if side is not None) for name, sides in rotation.items()}
    faces, left_of = trace_faces(sc.joints, bare)
    return bare, faces[left_of[joint, link]].joints


def _signs(
    sc: SCGraph, layout: Layout, frame: PictureFrame, numbers: Mapping[int, int]
) -> tuple[dict[int, _Sign], list[Loop]]:
    """Return the sign of each loop that is a face; and the loops with a centre that are not."""
    places = {frozenset(face.joints): frame.at(face.at) for face in layout.faces}
    middles = frame.row([*layout.joints.values(), *layout.links.values()])
    signs: dict[int, _Sign] = {}
    loose: list[Loop] = []
    for index, loop in enumerate((*sc.loops, *sc.closing)):
        at = places.get(frozenset(loop.joints))
        if not loop.has_centre:
            continue
        if at is None or index >= len(sc.loops):
            loose.append(loop)
            continue
        nearest = min(hypot(at[0] - x, at[1] - y) for x, y in middles)
        size = max(1.2, min(SIGN, 0.1 * frame.scale, 0.4 * nearest))
        signs[index] = (at, numbers[index], centre_sign(at, loop.centre, colour_of_class(numbers[index]), size))
    return signs, loose


def _bent(row: Sequence[Point]) -> list[Point]:
    """Return a curve through three points, where a joint has a place of its own; else the straight line."""
    if len(row) < 3:
        return list(row)
    (ax, ay), (mx, my), (bx, by) = row
    cx, cy = 2 * mx - (ax + bx) / 2, 2 * my - (ay + by) / 2
    return [
        ((1 - t) ** 2 * ax + 2 * t * (1 - t) * cx + t * t * bx, (1 - t) ** 2 * ay + 2 * t * (1 - t) * cy + t * t * by)
        for t in (i / 16 for i in range(17))
    ]


def _links(sc: SCGraph, links: Mapping[LinkId, Point], radius: float) -> list[Shape]:
    shapes: list[Shape] = []
    for link, at in links.items():
        data = (("link", str(link)),)
        shapes.append(Disc(at, radius, "ground" if link == sc.ground else "body", "ink", NORMAL, data))
        size = min(SMALL, 1.9 * radius / max(1.0, text_width(str(link)[:5], 1.0)))
        if size > 2.5:
            shapes.append(Label(at, str(link), size, bold=True, halo=False, widest=5, data=data))
    return shapes


def _labels(
    ways: Mapping[JointId, Sequence[Point]],
    links: Mapping[LinkId, Point],
    radius: float,
    signs: Mapping[int, _Sign],
    numbers: Mapping[int, int],
    small: float,
) -> list[Label]:
    """Return the numbers of loops beside their signs, if there are several, and of joints, reduced by a factor."""
    lines = [piece for row in ways.values() for piece in pairwise(row)]
    discs = [(x, y, radius + 0.5) for x, y in links.values()]
    discs += [(at[0], at[1], small * SIGN + 0.5) for at, _, _ in signs.values()]
    wishes = []
    if len(numbers) > 1:
        for loop, (at, number, _) in signs.items():
            same = [loop, *(other for other in numbers if numbers[other] == number and other != loop)]
            label = Label((0, 0), " = ".join(map(str, same)), 0.9 * small * SMALL, colour_of_class(number))
            wishes.append((label, beside(at, small * (SIGN + 4.5), 8, 0.0)))
    for joint, row in ways.items():
        middle = row[1] if len(row) == 3 else ((row[0][0] + row[1][0]) / 2, (row[0][1] + row[1][1]) / 2)
        label = Label((0, 0), str(joint), 0.8 * small * SMALL, "grey", widest=8, data=(("joint", str(joint)),))
        wishes.append((label, beside(middle, small * 4.5)))
    return placed(wishes, discs, lines)


def _stubs(
    scd: SCDGraph, ways: Mapping[JointId, Sequence[Point]], links: Mapping[LinkId, Point], radius: float
) -> list[Shape]:
    """Return a short line for each open edge, between its two neighbouring joints."""
    shapes: list[Shape] = []
    for link, sides in scd.rotation.items():
        x, y = links[link]
        for angle in _open_angles(sides, partial(_direction, ways, (x, y))):
            ends = [(x + far * cos(angle), y - far * sin(angle)) for far in (radius, radius + _STUB * radius / _LINK)]
            shapes.append(Line(ends, "grey", STRONG, data=(("link", str(link)),)))
    return shapes


def _direction(ways: Mapping[JointId, Sequence[Point]], link: Point, joint: JointId) -> float:
    """Return the angle, counter-clockwise as it is seen, at which a joint leaves a link."""
    row = ways[joint]
    far = row[1] if row[0] == link else row[-2]
    return atan2(link[1] - far[1], far[0] - link[0])


def _open_angles(sides: Sequence[JointId | None], angle_of: Callable[[JointId], float]) -> list[float]:
    """Return the angles of the open edges, evenly between those of the joints before and after."""
    size = len(sides)
    joined = [i for i, side in enumerate(sides) if side is not None]
    if not joined:
        return [2 * pi * i / size for i in range(size)]
    angles = []
    for place, i in enumerate(joined):
        after = joined[(place + 1) % len(joined)]
        gap = (after - i) % size or size
        start = angle_of(sides[i])
        wide = (angle_of(sides[after]) - start) % (2 * pi) or 2 * pi
        angles += [start + wide * k / gap for k in range(1, gap)]
    return angles


def _said(sc: SCGraph, layout: Layout, loose: Sequence[Loop], numbers: Mapping[int, int]) -> list[str]:
    """Return lines that count links, joints and centres, and list the loops that are not faces."""
    counts = [(len(sc), "link", ""), (len(sc.joints), "joint", "")]
    classes = sc.centre_classes()
    if classes and all(one.centre is Centre.INFINITE for one in classes):
        counts.append((len(classes), "centre at infinity", "centres at infinity"))
    else:
        counts.append((len(classes), "centre", ""))
    if sc.spatial_loops:
        counts.append((sc.spatial_loops, "spatial loop", ""))
    said = ", ".join(numbered(*count) for count in counts)
    lines = [said + ("" if layout.plane else "; not planar: lines cross")]
    every = [*sc.loops, *sc.closing]
    for loop in loose[:_LOOSE_LOOPS]:
        where = "at infinity" if loop.centre is Centre.INFINITE else "finite"
        joints = " ".join(str(joint)[:12] for joint in loop.joints)
        lines.append(f"not a face inside: centre of loop {every.index(loop)} ({where}), joints {joints}")
    if len(loose) > _LOOSE_LOOPS:
        lines.append(f"and {len(loose) - _LOOSE_LOOPS} more loops that are no faces")
    return lines


def _ride_alongs(
    reduction: Reduction, ways: Mapping[JointId, Sequence[Point]], links: Mapping[LinkId, Point], radius: float
) -> list[Shape]:
    """Return bands below the joints and links of ride-alongs.

    `ways` are the points of each joint as it is drawn; `radius` is that of a link, points.
    """
    shapes: list[Shape] = []
    for step in reduction.steps:
        shapes += [Line(ways[joint], "marked", 2 * _BAND * radius) for joint in step.joints]
        shapes += [Disc(links[link], _RIM * radius, "marked", None) for link in step.removed]
    return shapes
