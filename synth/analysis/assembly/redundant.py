"""Redundant bars get an elbow, so that they no longer count, and assembly modes are those in which it is straight.

Theory: docs/theory/positions.md.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations, islice

import numpy as np

from graphs.errors import UnsolvableError
from graphs.geometry import frame_about, unit
from graphs.loops.loop import Centre, signed_cycle
from graphs.mechanism.sc import SCGraph
from graphs.tolerances import DOUBLE, Tolerances
from graphs.types import Floats, JointId, LinkId
from synth.analysis.assembly.family import family_of
from synth.analysis.assembly.general import determines
from synth.analysis.assembly.kernel import CLOSED
from synth.analysis.motion.linkage import Linkage, LinkageLoop, centre_of

_TRIED = 500
"""Sets of bars that are tried."""
_MOVED, _STEPS = 0.01, 12
"""By how much driven joints are moved to see whether an elbow bends, radians and extents; steps of Newton's method."""
_BENT = 1e-6
"""Part of that by which an elbow bends for certain."""


@dataclass(frozen=True, slots=True)
class Loosened:
    """A linkage whose redundant bars have an elbow: their joints come after all others, and these links are they."""

    linkage: Linkage
    bars: tuple[LinkId, ...]

    @property
    def elbows(self) -> set[JointId]:
        """The joints that were added."""
        return {("elbow", bar) for bar in self.bars}


def loosened(linkage: Linkage, driven: Sequence[JointId], tolerances: Tolerances) -> Loosened:
    """Return the linkage with an elbow in as many bars as driven joints are more than the count allows.

    A bar whose length is implied by the rest of the linkage is an equation too many in the count of freedoms. With an
    elbow it is none; the assembly modes are those in which the elbow is as in the linkage. The linkage is returned as
    it is if nothing is to be loosened, or no bars are such that the driven joints then determine the others.
    """
    in_loops = {joint for loop in linkage.loops for joint in loop.joints}
    more = len(driven) - (len(in_loops) - 3 * len(linkage.loops))
    bars = _bars(linkage, driven, tolerances) if more > 0 else []
    for chosen in islice(combinations(bars, more), _TRIED) if bars else ():
        trial = linkage
        for bar in chosen:
            trial = _with_elbow(trial, bar, tolerances)
        found = Loosened(trial, chosen)
        try:
            if _stays_straight(found, driven, tolerances):
                return found
        except UnsolvableError:
            break
    return Loosened(linkage, ())


def _stays_straight(loose: Loosened, driven: Sequence[JointId], tolerances: Tolerances) -> bool:
    """Whether driven joints determine the others, and elbows do not bend when these are moved a little.

    An elbow that bends is in a bar that is needed: the linkage has fewer freedoms than driven joints.
    """
    family, axes = family_of(loose.linkage, driven, tolerances)
    if not determines(family):
        return False
    moved = family.member(axes, _MOVED * np.cos(1.0 + np.arange(len(driven))))
    values, error = family.corrected(moved[None], np.zeros((1, family.unknowns), dtype=complex), _STEPS)
    elbows = [family.column[place] for place, joint in enumerate(family.joints) if joint in loose.elbows]
    return bool(error[0] <= CLOSED) and bool(np.abs(values[0, elbows]).max() <= _MOVED * max(_BENT, tolerances.zero))


def _bars(linkage: Linkage, driven: Sequence[JointId], tolerances: Tolerances) -> list[LinkId]:
    """Return the links with two joints, which turn, are in loops about a centre or in a plane, and are not driven."""
    names = list(linkage.graph.joints)
    centred = {
        joint
        for loop in linkage.loops
        if centre_of(linkage, loop, tolerances) is not Centre.NONE
        for joint in loop.joints
    }
    of_link: dict[LinkId, list[int]] = {link: [] for link in linkage.graph.nodes}
    for place, links in enumerate(linkage.graph.joints.values()):
        for link in links:
            of_link[link].append(place)
    held = {names.index(joint) for joint in driven if joint in names} | set(linkage.slides)
    return [
        link
        for link, places in of_link.items()
        if len(places) == 2 and centred.issuperset(places) and held.isdisjoint(places)
    ]


def _with_elbow(linkage: Linkage, bar: LinkId, tolerances: Tolerances) -> Linkage:
    """Return the linkage with a bar in two, joined off the line between its joints."""
    graph, names = linkage.graph, list(linkage.graph.joints)
    first, second = (joint for joint, links in graph.joints.items() if bar in links)
    half, elbow = ("half", bar), ("elbow", bar)
    joints: dict[JointId, tuple[LinkId, LinkId]] = {**graph.joints, elbow: (bar, half)}
    one, another = joints[second]
    joints[second] = (half, another) if one == bar else (one, half)
    loops = []
    for loop in linkage.loops:
        order = [names[place] for place in loop.joints]
        if first in order and second in order:
            ends = order.index(first), order.index(second)
            order.insert(max(ends) if abs(ends[0] - ends[1]) == 1 else 0, elbow)
        passed, signs = zip(*signed_cycle(order, joints), strict=True)
        column = [len(names) if joint == elbow else names.index(joint) for joint in passed]
        loops.append(LinkageLoop(tuple(column), signs, centre_of(linkage, loop, tolerances)))
    centre = next(loop.centre for loop in loops if len(names) in loop.joints)
    point, direction = _elbow(linkage, names.index(first), names.index(second), centre)
    return replace(
        linkage,
        graph=SCGraph([*graph.nodes, half], joints),
        points=np.vstack([linkage.points, point]),
        directions=np.vstack([linkage.directions, direction]),
        angles=np.append(linkage.angles, 0.0),
        loops=tuple(loops),
    )


def _elbow(linkage: Linkage, first: int, second: int, centre: Centre) -> tuple[Floats, Floats]:
    """Return an axis between two, at a right angle off their line or arc: stretched, the elbow would be singular."""
    (p, q), (a, b) = linkage.points[[first, second]], linkage.directions[[first, second]]
    if centre is Centre.INFINITE:
        along = q - p - ((q - p) @ a) * a
        across = np.cross(a, along) if np.abs(along).max() > 0.0 else frame_about(a)[0]
        return 0.5 * (p + q + across), a
    off = np.cross(a, b)
    return p, unit(a + b + off if np.abs(off).max() > DOUBLE.parallel else a + frame_about(a)[0])
