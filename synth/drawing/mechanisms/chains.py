"""Kinematic chains as the literature of mechanisms draws them: links as bodies, joints as small circles."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

from graphs.errors import numbered
from graphs.mechanism.sc import SCGraph
from graphs.types import JointId, LinkId
from synth.drawing.layout.mechanisms import Layout, layout_of
from synth.drawing.mechanisms.labelling import Obstacles, beside, placed
from synth.drawing.mechanisms.signs import joint_dot
from synth.drawing.scene.frame import COLUMN, Frame, captions_of, framed, page_of
from synth.drawing.scene.palette import NORMAL, SMALL
from synth.drawing.scene.shapes import Label, Layer, Line, Point, Polygon, Scene, Shape

__all__ = ["ChainLook", "chain_layers", "chain_scene"]

_UNIT = 46.0
_BINARY = 3.4
"""Width of a binary link, points."""


@dataclass(frozen=True, slots=True)
class ChainLook:
    """What a picture of a chain shows; the size of letters and the radius of joints are in points."""

    link_numbers: bool = True
    joint_numbers: bool = True
    size: float = SMALL
    dot: float = 2.3


def chain_scene(
    chain: SCGraph,
    *,
    look: ChainLook | None = None,
    box: tuple[float, float] = (COLUMN, COLUMN),
    caption: str | None = "",
) -> Scene:
    """Return a picture of a link-joint graph with links as bodies: the loops' centres are not shown.

    Parameters
    ----------
    chain : SCGraph
    look : ChainLook, optional
    box : (width, height), optional
        Points there are at most.
    caption : str, optional
        Goes before the line that says what is seen; None: no line at all.

    Examples
    --------
    >>> scene = chain_scene(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))
    >>> [layer.name for layer in scene.layers]
    ['links', 'joints', 'labels', 'caption']
    """
    layout = layout_of(chain.nodes, chain.joints)
    frame = framed([place for row in _places(layout) for place in row], _UNIT, box)
    layers = chain_layers(chain, layout, frame, look or ChainLook())
    return page_of(frame, layers, captions_of(caption, _said(chain, layout)))


def _places(layout: Layout) -> list[list[Point]]:
    return [list(layout.links.values()), list(layout.joints.values()), *map(list, layout.outlines.values())]


def _said(chain: SCGraph, layout: Layout) -> str:
    said = f"{numbered(len(chain), 'link')}, {numbered(len(chain.joints), 'joint')}"
    if not layout.plane:
        return said + "; not planar: lines cross"
    return said + ("; drawn with a mirror" if layout.mirror else "")


def chain_layers(chain: SCGraph, layout: Layout, frame: Frame, look: ChainLook) -> list[Layer]:
    """Return links, joints and labels of a chain in a frame."""
    outlines = {link: frame.row(row) for link, row in layout.outlines.items()}
    bodies: list[Shape] = []
    # large bodies below, so that those that cross stay visible
    for link in sorted(outlines, key=lambda link: -len(outlines[link])):
        bodies += _body(link, outlines[link], link == chain.ground, look, layout.plane)
    joints = {joint: frame.at(place) for joint, place in layout.joints.items()}
    dots: list[Shape] = [joint_dot(at, joint, look.dot) for joint, at in joints.items()]
    single = [_single(link, frame.at(layout.links[link])) for link in layout.links if link not in outlines]
    labels = _labels(outlines, joints, look)
    return [Layer("links", (*bodies, *single)), Layer("joints", tuple(dots)), Layer("labels", tuple(labels))]


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
    """Return what is seen of the outline of a body: lines on both sides of each of its own."""
    found = []
    for (ax, ay), (bx, by) in zip(row, row[1:] + (row[:1] if len(row) > 2 else []), strict=False):
        long = hypot(bx - ax, by - ay) or 1.0
        across = (-(by - ay) / long * off, (bx - ax) / long * off)
        found += [
            ((ax + side * across[0], ay + side * across[1]), (bx + side * across[0], by + side * across[1]))
            for side in (1, -1)
        ]
    return found


def _single(link: LinkId, at: Point) -> Shape:
    row = [(at[0] - 6, at[1]), (at[0] + 6, at[1])]
    return Line(row, "ink", 2 * NORMAL, data=(("link", str(link)),))


def _labels(outlines: dict[LinkId, list[Point]], joints: dict[JointId, Point], look: ChainLook) -> list[Label]:
    """Return the numbers of links, bold, in bodies or beside bars, and those of joints beside them."""
    lines = [edge for row in outlines.values() for edge in _edges(row, _width(row, look) / 2)]
    obstacles = Obstacles([(x, y, look.dot + 0.8) for x, y in joints.values()], lines)
    wishes: list[tuple[Label, list[Point]]] = []
    if look.link_numbers:
        for link, row in sorted(outlines.items(), key=lambda item: -len(item[1])):
            label = Label(
                (0, 0), str(link), look.size, bold=True, halo=len(row) < 3, widest=8, data=(("link", str(link)),)
            )
            wishes.append((label, _for_body(row, look)))
    if look.joint_numbers:
        for joint, at in joints.items():
            label = Label((0, 0), str(joint), 0.85 * look.size, "grey", widest=8, data=(("joint", str(joint)),))
            wishes.append((label, beside(at, look.dot + 0.75 * look.size)))
    return placed(wishes, obstacles)


def _for_body(row: list[Point], look: ChainLook) -> list[Point]:
    middle = (sum(x for x, _ in row) / len(row), sum(y for _, y in row) / len(row))
    if len(row) > 2:
        return [middle, *beside(middle, 0.6 * look.size)]
    (ax, ay), (bx, by) = row
    long = hypot(bx - ax, by - ay) or 1.0
    across = (-(by - ay) / long, (bx - ax) / long)
    far = 0.5 * _BINARY + 0.75 * look.size
    places = []
    for part in (0.5, 0.38, 0.62):
        foot = (ax + part * (bx - ax), ay + part * (by - ay))
        places += [(foot[0] + side * far * across[0], foot[1] + side * far * across[1]) for side in (1, -1)]
    return [*places, *beside(middle, far)]
