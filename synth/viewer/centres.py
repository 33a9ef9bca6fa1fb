"""The spherical centres of a linkage as a page shows them: where they are, of what kind, which joints meet there.

One for each centre class. A vertex of panels round which a loop goes is an explicit centre; where the panels of a
sheet do not reach their centre it is implicit; of other linkages, whose links have no shape, it is finite. Theory:
docs/theory/viewer.md, docs/theory/centre-classes.md.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import Any, Literal

from graphs.geometry import lines_meet
from graphs.loops.classes import CentreClass
from graphs.loops.loop import Centre
from graphs.types import Floats
from synth.folding.configuration import SheetConfiguration
from synth.motion.configuration import Configuration
from synth.motion.linkage import PosedLinkage

__all__ = ["ShownCentre", "centres_of"]

Kind = Literal["explicit", "implicit", "finite", "infinite"]


@dataclass(frozen=True, slots=True)
class ShownCentre:
    """A centre of a number of loops, with the joints whose axes pass through it and a link that carries it.

    An explicit centre is a vertex of links, an implicit one is not reached by them; finite: links have no shape
    that decides; infinite: the axes are parallel to `direction`. The place, float[3], is that at the
    configuration, in units of the extent, about the middle; for an infinite centre, a place among its axes. Link
    and joints are indices.
    """

    kind: Kind
    place: Floats
    direction: Floats | None
    link: int
    joints: tuple[int, ...]
    loops: int

    def to_json(self) -> dict[str, Any]:
        """Return plain data: `CentreData` of web/src/page/types.js."""
        return {
            "kind": self.kind,
            "place": self.place.tolist(),
            "direction": None if self.direction is None else self.direction.tolist(),
            "link": self.link,
            "joints": list(self.joints),
            "loops": self.loops,
        }


def centres_of(configuration: Configuration) -> tuple[ShownCentre, ...]:
    """Return the centres of a mechanism: of panels those at vertices are explicit, others implicit.

    Links of a linkage have no shape that decides, so theirs are finite or infinite.
    """
    if not isinstance(configuration, SheetConfiguration):
        return _centres(configuration.linkage, set(), "finite")
    mechanism = configuration.mechanism
    loops = len(mechanism.sc.loops)
    closing = range(loops, loops + len(mechanism.sc.closing))  # of closed surfaces: they go round vertices too
    return _centres(configuration.linkage, {*range(len(mechanism.loop_vertices)), *closing}, "implicit")


def _centres(linkage: PosedLinkage, at_vertices: set[int], otherwise: Kind) -> tuple[ShownCentre, ...]:
    """Return all centres; those of loops round vertices are explicit, other finite ones of another kind."""
    column = {joint: place for place, joint in enumerate(linkage.graph.joints)}
    return tuple(
        _shown(linkage, one, column, "explicit" if at_vertices.intersection(one.loops) else otherwise)
        for one in linkage.graph.centre_classes()
    )


def _shown(linkage: PosedLinkage, one: CentreClass, column: dict[Any, int], finite: Kind) -> ShownCentre:
    joints = tuple(sorted(column[joint] for joint in one.joints))
    link = _carrier(linkage, joints)
    if one.centre is Centre.INFINITE:
        place = linkage.points[list(joints)].mean(axis=0)
        return ShownCentre("infinite", place, linkage.directions[joints[0]], link, joints, len(one.loops))
    place = lines_meet(linkage.points[list(joints)], linkage.directions[list(joints)]).point
    return ShownCentre(finite, place, None, link, joints, len(one.loops))


def _carrier(linkage: PosedLinkage, joints: tuple[int, ...]) -> int:
    """Return the place of the link with most of some joints: their axes pass through the centre as it moves."""
    pairs = list(linkage.graph.joints.values())
    most = Counter(link for joint in joints for link in pairs[joint]).most_common(1)[0][0]
    return list(linkage.graph.nodes).index(most)
