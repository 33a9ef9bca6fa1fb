"""Links of a conformed linkage in layers: which part of the surface each takes, where tabs and slots are.

Theory: docs/theory/templates.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi

import numpy as np

from graphs.arrays import Floats
from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.mechanism.surfaces import Surface
from graphs.plain_text import plain
from graphs.tolerances import DOUBLE
from synth.conformed.all_angles import links_in_layers
from synth.conformed.linkages import OnSurface
from synth.conformed.rates import ConformedChain
from synth.templates.scale import GREATEST

__all__ = ["Dimensions", "Joining", "LayeredLink", "LayeredLinkage", "layered"]

_INNER = 0.35
"""Where links begin, in units of the length of the ruling lines."""
_TAB_OF_GAP, _SLOT_OF_GAP = 0.45, 0.2
"""Tabs and half slots are no wider than these parts of the least step between two joints."""
_RIM = 0.1
"""What is left of ruling lines at both ends of tabs, in units of the length of links."""
_SLOT_LONGER = 0.02
"""By so much of the length of links a slot is longer than its tab, at each end."""
_SLOT_WIDTH = 3.0
"""Millimetres, at the inner edge of links."""
_LONGEST_NAME = 16


@dataclass(frozen=True)
class Dimensions:
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

    def reaches(self, joint: str, side: int) -> bool:
        """Tell whether it goes on from a joint to a side: -1 or 1."""
        return self.at_end(joint) != side


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


@dataclass(frozen=True)
class LayeredLinkage:
    """The links of a linkage in layers on a surface, with one joining for each joint.

    `places` are the azimuths of the joints; `tab` is the width of tabs and `slot` half that of slots, all in
    radians.
    """

    surface: Surface
    dimensions: Dimensions
    links: tuple[LayeredLink, ...]
    joinings: tuple[Joining, ...]
    places: dict[str, float]
    tab: float
    slot: float

    def height(self, layer: float) -> float:
        """Return how far the middle of a layer is outside the surface, millimetres."""
        return layer * self.dimensions.apart


def layered(linkage: OnSurface, surface: Surface, dimensions: Dimensions) -> LayeredLinkage:
    """Return the links of a linkage in the fewest layers; only its chain and its azimuths matter.

    Raise UnsolvableError if two joints are on one ruling line, or a link has one joint only.

    >>> from synth.conformed.linkages import loop_of_steps
    >>> from graphs.mechanism.surfaces import Cone
    >>> made = layered(loop_of_steps(np.radians([40, 50, 50])), Cone(0.5), Dimensions())
    >>> [(link.layer, round(np.degrees(link.width))) for link in made.links]
    [(0, 40), (0, 50), (0, 50), (1, 140)]
    """
    chain = ConformedChain.of(linkage.chain)
    places = np.remainder(np.asarray(linkage.places, dtype=float), 2 * pi)
    least = _least_step(places, chain)
    for link, own in zip(chain.links, chain.joints_of, strict=True):
        if len(own) < 2:
            raise UnsolvableError(f"link {shown(link)} has one joint: it takes no part of the surface")
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
    joinings = tuple(_joining(name, bare) for name in names)
    at = dict(zip(names, places.tolist(), strict=True))
    links = tuple(_slotted(link, bare, at) for link in bare)
    width = surface.width(sum(dimensions.ends) / 2)
    tab = min(dimensions.tab / width, _TAB_OF_GAP * least)
    slot = min(_SLOT_WIDTH / 2 / surface.width(dimensions.ends[0]), _SLOT_OF_GAP * least)
    return LayeredLinkage(surface, dimensions, links, joinings, at, tab, slot)


def _least_step(places: Floats, chain: ConformedChain) -> float:
    """Return the least step between two joints, and refuse two on one ruling line."""
    order = np.argsort(places)
    steps = np.diff(places[order], append=places[order[0]] + 2 * pi)
    least = int(steps.argmin())
    if steps[least] < DOUBLE.same_configuration:
        pair = shown([str(chain.joints[order[least]]), str(chain.joints[order[(least + 1) % len(order)]])])
        raise UnsolvableError(f"joints {pair} are on one ruling line: pieces have no room for both")
    return float(steps[least])


def _from(start: float, place: float) -> float:
    """Return how far a place is from a start, once round at most; rounding before the start is the start."""
    along = float(np.remainder(place - start, 2 * pi))
    return 0.0 if along > 2 * pi - DOUBLE.same_configuration else along


def _joining(joint: str, links: Sequence[LayeredLink]) -> Joining:
    """Return how the two links of a joint hold together: by a tab that lies flat if it can, on the inner link."""
    first, second = (number for number, link in enumerate(links) if joint in dict(link.joints))
    ways = []
    for tabbed, other in ((first, second), (second, first)):
        side = links[tabbed].at_end(joint)
        if side:
            folded = not links[other].reaches(joint, side)
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
    return LayeredLink(link.name, link.layer, link.start, link.width, link.joints, tuple(slots))
