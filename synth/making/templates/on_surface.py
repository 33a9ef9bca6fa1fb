"""Linkages on cones and cylinders as templates and as solids: links in layers, with tabs and slots.

Theory: docs/theory/templates.md.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import cos, degrees, pi

import numpy as np
import numpy.typing as npt
import shapely

from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.files.solids.meshes import SolidMesh
from graphs.mechanism.surfaces import Cone, Cylinder, Surface
from graphs.printing import plain
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.linkages.conformed.linkage_behaviour import OnSurface
from synth.linkages.conformed.rates import ConformedChain
from synth.linkages.conformed.rates_over_angles import links_in_layers
from synth.making.drawing.conformed import surface_layer
from synth.making.drawing.scene.writing import Scene
from synth.making.templates.pieces import Kind, Piece, Point, TemplateLine, Text
from synth.making.templates.template import GREATEST, Template

_INNER = 0.35
"""Inner end of links, in units of the length of the ruling lines."""
_TAB_OF_GAP, _SLOT_OF_GAP = 0.45, 0.2
"""Tabs and half slots are no wider than these parts of the least step between two joints."""
_RIM = 0.1
"""Length of ruling lines beyond both ends of tabs, in units of the length of links."""
_SLOT_LONGER = 0.02
"""A slot exceeds its tab at each end by this part of the length of links."""
_SLOT_WIDTH = 3.0
"""Millimetres, at the inner edge of links."""
_LONGEST_NAME = 16


@dataclass(frozen=True)
class TemplateSizes:
    """Dimensions of a linkage on a surface, millimetres; InvariantError unless all are positive.

    `size` is the length of the ruling lines (from the apex of a cone), `tab` the width of tabs. Layers are three
    times `thickness` apart, which leaves room for tabs between them.
    """

    size: float = 100.0
    tab: float = 8.0
    thickness: float = 0.3

    def __post_init__(self) -> None:
        for name in ("size", "tab", "thickness"):
            value = getattr(self, name)
            if not 0 < value <= GREATEST:
                raise InvariantError(name, f"{name} {value!r}", f"a positive number, at most {GREATEST:g}")

    @property
    def apart(self) -> float:
        """From layer to layer."""
        return 3 * self.thickness

    @property
    def ends(self) -> tuple[float, float]:
        """Where links begin and end along ruling lines."""
        return _INNER * self.size, self.size

    @property
    def tab_ends(self) -> tuple[float, float]:
        """Where tabs begin and end along ruling lines."""
        inner, outer = self.ends
        return inner + _RIM * (outer - inner), outer - _RIM * (outer - inner)

    @property
    def slot_ends(self) -> tuple[float, float]:
        """Where slots begin and end along ruling lines."""
        inner, outer = self.tab_ends
        more = _SLOT_LONGER * (self.ends[1] - self.ends[0])
        return inner - more, outer + more


@dataclass(frozen=True)
class LayeredLink:
    """A link as a part of a surface. Layers count from 0, the innermost.

    Azimuths are in radians: where the link starts, how wide it is, and how far from its start (0 to the width)
    each of its joints is, and each slot, through which a joint of other links passes.
    """

    name: str
    layer: int
    start: float
    width: float
    joints: tuple[tuple[str, float], ...]
    slots: tuple[tuple[str, float], ...]

    def at_end(self, joint: str) -> int:
        """Return -1 for a joint at which it begins, 1 where it ends, 0 between."""
        along = dict(self.joints)[joint]
        least = DOUBLE.same_configuration
        return -1 if along <= least else 1 if along >= self.width - least else 0


@dataclass(frozen=True)
class Joining:
    """How two links hold together at a joint.

    `tabbed` and `other` are the indices of the link that has a tab there, if one has, and of the one on which it
    is glued. `side` is the side of the joint on which the unfolded tab lies, -1 or 1; 0 without a tab, where
    neither link ends. `folded`: the tab is folded back, as the other link lies over or under the first.
    """

    joint: str
    tabbed: int
    other: int
    side: int
    folded: bool


class LayeredLinkage:
    """The links of a linkage in the fewest layers on a surface, with one joining for each joint.

    Only its chain and its azimuths matter. `places` are the azimuths of the joints; `tab` is the width of tabs and
    `slot` half that of slots, all in radians. Raise UnsolvableError if two joints are on one ruling line, or one
    of the links has one joint only.
    """

    def __init__(self, linkage: OnSurface, surface: Surface, dimensions: TemplateSizes) -> None:
        self.surface, self.dimensions = surface, dimensions
        chain = ConformedChain.of(linkage.chain)
        places = np.remainder(np.asarray(linkage.places, dtype=float), 2 * pi)
        least = _least_step(places, chain)
        for link, own in zip(chain.links, chain.joints_of, strict=True):
            if len(own) < 2:
                raise UnsolvableError(
                    f"link {shown(link)} has one joint, so it covers no part of the surface; expected two or more"
                )
        laid = links_in_layers(chain, places, linkage.begins(chain))
        names = [plain(str(joint), _LONGEST_NAME) for joint in chain.joints]
        bare = [
            LayeredLink(
                plain(str(link), _LONGEST_NAME),
                int(laid.layers[number]),
                float(laid.arcs[number, 0]),
                float(laid.arcs[number, 1]),
                tuple((names[joint], _from(laid.arcs[number, 0], places[joint])) for joint in own),
                (),
            )
            for number, (link, own) in enumerate(zip(chain.links, chain.joints_of, strict=True))
        ]
        self.joinings = tuple(_joining(name, bare) for name in names)
        self.places = dict(zip(names, places.tolist(), strict=True))
        self.links = tuple(_slotted(link, bare, self.places) for link in bare)
        self.tab = min(dimensions.tab / surface.width(sum(dimensions.ends) / 2), _TAB_OF_GAP * least)
        self.slot = min(_SLOT_WIDTH / 2 / surface.width(dimensions.ends[0]), _SLOT_OF_GAP * least)

    def height(self, layer: float) -> float:
        """Return how far the middle of a layer is outside the surface, millimetres."""
        return layer * self.dimensions.apart


def _least_step(places: Floats, chain: ConformedChain) -> float:
    """Return the least step between two joints, and refuse two on one ruling line."""
    order = np.argsort(places)
    steps = np.diff(places[order], append=places[order[0]] + 2 * pi)
    least = int(steps.argmin())
    if steps[least] < DOUBLE.same_configuration:
        pair = shown([str(chain.joints[order[least]]), str(chain.joints[order[(least + 1) % len(order)]])])
        raise UnsolvableError(f"joints {pair} are on one ruling line, where pieces have no room for both")
    return float(steps[least])


def _from(start: float, place: float) -> float:
    """Return the azimuth from a start to a place, in [0, 2 pi); within rounding of a full turn it is 0."""
    along = float(np.remainder(place - start, 2 * pi))
    return 0.0 if along > 2 * pi - DOUBLE.same_configuration else along


def _joining(joint: str, links: Sequence[LayeredLink]) -> Joining:
    """Return how the two links of a joint hold together: by a tab that lies flat if it can, on the inner link."""
    first, second = (number for number, link in enumerate(links) if joint in dict(link.joints))
    ways = []
    for tabbed, other in ((first, second), (second, first)):
        side = links[tabbed].at_end(joint)
        if side:
            folded = links[other].at_end(joint) == side
            ways.append((folded, links[tabbed].layer, tabbed, other, side))
    if not ways:
        return Joining(joint, first, second, 0, folded=False)
    folded, _, tabbed, other, side = min(ways)
    return Joining(joint, tabbed, other, side, folded=folded)


def _slotted(link: LayeredLink, links: Sequence[LayeredLink], places: dict[str, float]) -> LayeredLink:
    """Return a link with slots for the joints of links on both sides of it."""
    slots = []
    for joint, place in places.items():
        layers = sorted(other.layer for other in links if joint in dict(other.joints))
        along = _from(link.start, place)
        within = DOUBLE.same_configuration < along < link.width - DOUBLE.same_configuration
        if within and layers[0] < link.layer < layers[-1]:
            slots.append((joint, along))
    return replace(link, slots=tuple(slots))


_OFF = 0.004
"""Millimetres by which a chord may miss its arc."""
_NAME, _SMALL = 4.0, 2.8
"""Sizes of names of links and of joints, millimetres."""
_FROM_RIM = 5.0
"""Millimetres from the outer edge to names of joints."""
_SLANT = 0.05
"""A tab runs in by this part of its length at each end."""
_Corner = tuple[float, float]
"""Azimuth and length along the ruling line there."""


@dataclass(frozen=True)
class _Unrolled:
    """The plane of a piece; `middle` is the azimuth that points upwards."""

    linkage: LayeredLinkage
    layer: float
    middle: float

    def at(self, azimuth: float, along: float) -> Point:
        """Return where a place lies."""
        height = self.linkage.height(self.layer)
        x, y = self.linkage.surface.flat(azimuth - self.middle, along, height).tolist()
        return x, y

    def points(self, corners: Sequence[_Corner]) -> list[Point]:
        """Return a way along corners; from one to the next at the same length it goes along the arc."""
        height, ways = self.linkage.height(self.layer), [np.array(corners[:1])]
        for (azimuth, along), (after, then) in pairwise(corners):
            count = 1
            if along == then:
                count = self.linkage.surface.chords(abs(after - azimuth), along, height, _OFF)
            parts = np.arange(1, count + 1)[:, None] / count
            ways.append(np.array([azimuth, along]) * (1 - parts) + np.array([after, then]) * parts)
        azimuths, lengths = np.concatenate(ways).T
        flat = self.linkage.surface.flat(azimuths - self.middle, lengths, height).tolist()
        return [(x, y) for x, y in flat]

    def lines(self, kind: Kind, corners: Sequence[_Corner]) -> list[TemplateLine]:
        """Return the strokes of a way along corners."""
        return [TemplateLine(kind, a, b) for a, b in pairwise(self.points(corners))]


def _piece_of_surface(linkage: LayeredLinkage) -> Piece:
    """Return the surface under all links, cut open half way between the two joints that are farthest apart."""
    places = sorted(linkage.places.values())
    gaps = [after - here for here, after in pairwise([*places, places[0] + 2 * pi])]
    widest = int(np.argmax(gaps))
    start = places[widest] + gaps[widest] / 2
    end, middle = start + 2 * pi, start + pi
    unrolled = _Unrolled(linkage, -1, middle)
    inner, outer = ends = linkage.dimensions.ends
    tab = _tab_corners(end, 1, min(linkage.tab, gaps[widest] / 4), ends)
    outline = [(end, outer), (start, outer), (start, inner), (end, inner), *tab[1:-1], (end, outer)]
    strokes = [*unrolled.lines("CUT", outline), *unrolled.lines("CREASE", [(end, inner), (end, outer)])]
    texts = [Text(unrolled.at(middle, (inner + outer) / 2), "surface", _NAME)]
    for name, place in linkage.places.items():
        azimuth = start + float(np.remainder(place - start, 2 * pi))
        strokes += unrolled.lines("MARKS", [(azimuth, inner), (azimuth, outer)])
        texts.append(Text(unrolled.at(azimuth, outer - _FROM_RIM), name, _SMALL))
    return Piece(tuple(strokes), tuple(texts), shapely.Polygon(unrolled.points(outline)))


def _piece_of_link(linkage: LayeredLinkage, number: int) -> Piece:
    """Return the piece of a link."""
    link = linkage.links[number]
    start, end = link.start, link.start + link.width
    inner, outer = linkage.dimensions.ends
    unrolled = _Unrolled(linkage, link.layer, start + link.width / 2)
    joinings = {joining.side: joining for joining in linkage.joinings if joining.tabbed == number and joining.side}
    tabs = {
        side: _tab_corners(azimuth, side, linkage.tab, linkage.dimensions.tab_ends)
        for side, azimuth in ((-1, start), (1, end))
        if side in joinings
    }
    outline = [(start, inner), *tabs.get(-1, []), (start, outer), (end, outer), *tabs.get(1, [])[::-1], (end, inner)]
    strokes = unrolled.lines("CUT", [*outline, outline[0]])
    texts = [Text(unrolled.at(*_free_place(linkage, link)), f"{link.name}, layer {link.layer}", _NAME)]
    for side, tab in tabs.items():
        strokes += unrolled.lines(_fold(linkage, joinings[side]), [tab[0], tab[-1]])
        middle = (tab[1][0] + tab[0][0]) / 2, sum(linkage.dimensions.ends) / 2
        texts.append(Text(unrolled.at(*middle), joinings[side].joint, _SMALL))
    for name, along in link.joints:
        side = link.at_end(name)
        if not side:
            strokes += unrolled.lines("MARKS", [(start + along, inner), (start + along, outer)])
        inside = start + along - side * min(linkage.tab, link.width) / 2
        texts.append(Text(unrolled.at(inside, outer - _FROM_RIM), name, _SMALL))
    slots = [_slot_corners(linkage, start + along) for _, along in link.slots]
    strokes += [stroke for slot in slots for stroke in unrolled.lines("CUT", slot)]
    holes = shapely.union_all([shapely.Polygon(unrolled.points(slot)) for slot in slots])
    covered = shapely.Polygon(unrolled.points(outline)).difference(holes)
    return Piece(tuple(strokes), tuple(texts), covered)


def _tab_corners(azimuth: float, side: int, width: float, ends: tuple[float, float]) -> list[_Corner]:
    """Return the corners of a tab beside a ruling line, from its inner end to its outer one."""
    low, high = ends
    slant, beyond = _SLANT * (high - low), azimuth + side * width
    return [(azimuth, low), (beyond, low + slant), (beyond, high - slant), (azimuth, high)]


def _slot_corners(linkage: LayeredLinkage, azimuth: float) -> list[_Corner]:
    """Return the corners of a slot along a ruling line, the first again at the end."""
    (low, high), half = linkage.dimensions.slot_ends, linkage.slot
    ring = [(azimuth - half, low), (azimuth - half, high), (azimuth + half, high), (azimuth + half, low)]
    return [*ring, ring[0]]


def _fold(linkage: LayeredLinkage, joining: Joining) -> Kind:
    """Return how a tab is folded, seen from outside: back over or under its link, or it lies flat and hinges."""
    if not joining.folded:
        return "CREASE"
    outside = linkage.links[joining.other].layer > linkage.links[joining.tabbed].layer
    return "VALLEY" if outside else "MOUNTAIN"


def _free_place(linkage: LayeredLinkage, link: LayeredLink) -> _Corner:
    """Return the middle of the widest part of a link without a ruling line of a joint or a slot."""
    lines = sorted({along for _, along in (*link.joints, *link.slots)})
    widest = max(pairwise(lines), key=lambda pair: pair[1] - pair[0])
    return link.start + sum(widest) / 2, sum(linkage.dimensions.ends) / 2


_SIDE = 420.0
"""Points of the side of the picture."""


def surface_of(linkage: OnSurface, radius: float | None = None) -> Surface:
    """Return the surface of a linkage, or a cylinder of a radius; a template takes it for millimetres.

    A linkage given by its azimuths fits every cone and cylinder. Raise UnsolvableError without a surface or a
    radius.
    """
    if radius is not None:
        return Cylinder(radius)
    if linkage.surface is None:
        raise UnsolvableError("the linkage lies on any cone; try --lambda, the cone angle, or --radius")
    return linkage.surface


def template_on_surface(
    linkage: OnSurface, surface: Surface, dimensions: TemplateSizes | None = None, title: str = ""
) -> Template:
    """Return the template of a linkage on a cone or a cylinder: a piece for the surface, and one for each link.

    All pieces are seen from outside; the arcs of their edges are chords that miss them by 0.004 mm at most.
    Raise UnsolvableError if two joints are on one ruling line, or a link has one joint only.
    """
    links = LayeredLinkage(linkage, surface, dimensions or TemplateSizes())
    picture = _picture(linkage, surface)
    below = "It then looks as below; the picture puts layers beside each other, so that none hides another."
    steps = [*_steps(links), below]
    pieces = (_piece_of_surface(links), *(_piece_of_link(links, number) for number in range(len(links.links))))
    return Template(pieces, None, linkage, title, (), tuple(steps), picture)


def _picture(linkage: OnSurface, surface: Surface) -> Scene:
    chain, places = ConformedChain.of(linkage.chain), np.asarray(linkage.places, dtype=float)
    layer = surface_layer(chain, places, links_in_layers(chain, places, linkage.begins(chain)), surface, _SIDE)
    return Scene(_SIDE, _SIDE, (layer,))


def _steps(linkage: LayeredLinkage) -> list[str]:
    """Return how a linkage on a surface is put together."""
    count = 1 + max(link.layer for link in linkage.links)
    surface = linkage.surface
    if isinstance(surface, Cone):
        sector = 360 * cos(surface.angle)
        half_angle = 90.0 - degrees(surface.angle)
        rolled = f"a sector of {sector:.4g} degrees, as a cone with a half angle of {half_angle:.4g} degrees"
    else:
        rolled = f"as a cylinder of radius {surface.radius:.4g} mm"
    steps = [
        f"Cut out {numbered(len(linkage.links) + 1, 'piece')} along the black lines, slots too. You see their outside.",
        f"Roll the surface, {rolled}; glue its seam.",
        f"Put the links on it in {numbered(count, 'layer')}, layer 0 first, each along the lines of its joints.",
    ]
    return [*steps, *(_step_of_joint(linkage, joining) for joining in linkage.joinings)]


def _step_of_joint(linkage: LayeredLinkage, joining: Joining) -> str:
    tabbed, other = (linkage.links[number] for number in (joining.tabbed, joining.other))
    through = [link.name for link in linkage.links if joining.joint in dict(link.slots)]
    way = f", through the slot of {', '.join(through)}" if through else ""
    if not joining.side:
        return (
            f"Joint {joining.joint}: sew links {tabbed.name} and {other.name} together along the line{way}; "
            "neither ends there."
        )
    face = "outside" if tabbed.layer > other.layer else "inside"
    tab, place = f"the tab of link {tabbed.name}", f"the {face} of link {other.name}{way}"
    if joining.folded:
        return f"Joint {joining.joint}: fold {tab} back and glue it to {place}."
    return f"Joint {joining.joint}: glue {tab} to {place}; its fold is the hinge."


_STEP = np.radians(3.0)
"""Azimuth of a facet, at most."""


def solids_on_surface(linkage: LayeredLinkage, gap: float) -> list[SolidMesh]:
    """Return the surface and each link as a closed shell of the material's thickness.

    `gap` is that between a link that ends at a joint and its neighbour, at the inner edge, millimetres. Raise
    UnsolvableError if a link is narrower than the gap.
    """
    ends = linkage.dimensions.ends
    off = gap / 2 / linkage.surface.width(ends[0])
    whole = np.arange(0.0, 1.0, _STEP / (2 * pi)) * 2 * pi
    surface = _shell(linkage, "surface", -1, whole, np.array(ends), np.ones((len(whole), 1), bool), closed=True)
    return [surface, *(_link(linkage, link, off) for link in linkage.links)]


def _link(linkage: LayeredLinkage, link: LayeredLink, off: float) -> SolidMesh:
    """Return a link, as cells of azimuth and length of which those in slots are left out."""
    if link.width <= 2 * off:
        raise UnsolvableError(
            f"link {link.name} is narrower than the gap at its hinges; try a smaller --gap, or a larger --size"
        )
    start, end = link.start + off, link.start + link.width - off
    slots = [(link.start + along - linkage.slot, link.start + along + linkage.slot) for _, along in link.slots]
    fixed = sorted({start, end, *(azimuth for slot in slots for azimuth in slot)})
    azimuths = [fixed[0]]
    for here, after in pairwise(fixed):
        count = max(1, int(np.ceil((after - here) / _STEP)))
        azimuths += [*(here + (after - here) * part / count for part in range(1, count)), after]
    inner, outer = linkage.dimensions.ends
    low, high = linkage.dimensions.slot_ends
    lengths = np.array([inner, low, high, outer] if slots else [inner, outer])
    middles = (np.array(azimuths)[1:] + np.array(azimuths)[:-1]) / 2
    there = np.ones((len(middles), len(lengths) - 1), bool)
    for first, last in slots:
        there[(middles > first) & (middles < last), 1] = False
    return _shell(linkage, f"link {link.name}", link.layer, np.array(azimuths), lengths, there, closed=False)


def _shell(
    linkage: LayeredLinkage,
    name: str,
    layer: int,
    azimuths: Floats,
    lengths: Floats,
    there: npt.NDArray[np.bool_],
    *,
    closed: bool,
) -> SolidMesh:
    """Return the closed mesh of the cells that are there, about the middle of a layer.

    `there` is bool[columns, rows], `lengths` float[rows + 1], `azimuths` float[columns + 1] (float[columns] if
    closed).
    """
    half = linkage.dimensions.thickness / 2
    heights = np.array([linkage.height(layer) - half, linkage.height(layer) + half])
    grid = np.meshgrid(heights, azimuths, lengths, indexing="ij")
    corners = linkage.surface.place(grid[1], grid[2], grid[0]).reshape(-1, 3)
    columns, rows = len(azimuths), len(lengths)

    def at(side: int, column: int, row: int) -> int:
        return (side * columns + column % columns) * rows + row

    def holds(column: int, row: int) -> bool:
        if closed:
            column %= len(there)
        return 0 <= column < len(there) and 0 <= row < rows - 1 and bool(there[column, row])

    quads: list[list[int]] = []
    for column, row in np.argwhere(there).tolist():
        ring = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)]
        beyond = [(column, row - 1), (column + 1, row), (column, row + 1), (column - 1, row)]
        quads.append([at(1, *corner) for corner in ring[::-1]])
        quads.append([at(0, *corner) for corner in ring])
        for side in range(4):
            if not holds(*beyond[side]):
                a, b = ring[side], ring[(side + 1) % 4]
                quads.append([at(0, *b), at(0, *a), at(1, *a), at(1, *b)])
    triangles = np.array([triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))])
    used, renumbered = np.unique(triangles, return_inverse=True)
    return SolidMesh(name, corners[used], renumbered.reshape(-1, 3))
