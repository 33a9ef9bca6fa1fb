"""Families of axes in space whose members may move although counts say no.

Each family adds conditions to those of the type: a symmetry, groups of axes that are parallel or meet, equal
links, poses along a motion that close. Starts are random, and symmetric where the family is. Theory:
docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from graphs.geometry import lines_meet, unit
from graphs.loops.loop import Centre, signed_cycle
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.rank.exact import independent_cycles
from graphs.types import Floats
from synth.motion.walk.allowance import Allowance
from synth.realisation.special.conditions import (
    AxisCondition,
    AxisGroup,
    AxisSymmetry,
    equal_links,
    meeting,
    normal,
    symmetric,
)
from synth.realisation.special.solving import axes_along_a_motion, axes_meeting
from synth.realisation.special.symmetries import named_motions

__all__ = ["AxisFamily", "TypeOfAxes", "axis_families", "degenerate", "solids_of", "type_of_axes"]

_TRIPLES = (
    ("two triples of parallel axes", Centre.INFINITE, Centre.INFINITE),
    ("three parallel axes and three through a point", Centre.INFINITE, Centre.FINITE),
    ("two triples of axes through a point each", Centre.FINITE, Centre.FINITE),
)
_NOISE = 0.3
"""By how much joints of equal links begin off a circle: from places anywhere loops fold up, two axes being one."""
_APART = 0.02
"""Axes, and centres, that are nearer than this part of the extent and, of axes, of a radian, are taken as one."""


@dataclass(frozen=True)
class TypeOfAxes:
    """What a type says about axes: which meet in which centre, and which loops have none."""

    graph: SCGraph
    meetings: tuple[AxisGroup, ...]
    spatial: tuple[tuple[int, ...], ...]


def type_of_axes(graph: SCGraph) -> TypeOfAxes:
    """Return what a type says about axes.

    >>> type_of_axes(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])).spatial
    ((0, 1, 2, 3),)
    """
    place = {joint: number for number, joint in enumerate(graph.joints)}
    meetings = tuple(
        AxisGroup(tuple(sorted(place[joint] for joint in one.joints)), one.centre)
        for one in graph.centre_classes()
    )
    spatial = tuple(
        tuple(place[joint] for joint, _ in signed_cycle(loop.joints, graph.joints))
        for loop in independent_cycles(graph)
        if loop.centre is Centre.NONE
    )
    return TypeOfAxes(graph, meetings, tuple(_from_least(loop) for loop in spatial))


def _from_least(loop: tuple[int, ...]) -> tuple[int, ...]:
    """Return a cycle from its least place on, towards the lesser of its neighbours."""
    first = loop.index(min(loop))
    turned = loop[first:] + loop[:first]
    back = turned[:1] + turned[:0:-1]
    return min(turned, back)


@dataclass(frozen=True)
class AxisFamily:
    """Members of a type whose axes obey further conditions.

    Attributes
    ----------
    name : str
    meetings : tuple of AxisGroup
        Axes that are parallel, or meet, besides those of the type.
    motion : AxisSymmetry or None
        A symmetry.
    equal : tuple of tuple of int
        Loops of equal links.
    poses : bool
        Whether loops have to close at several poses.
    """

    name: str
    meetings: tuple[AxisGroup, ...] = ()
    motion: AxisSymmetry | None = None
    equal: tuple[tuple[int, ...], ...] = ()
    poses: bool = field(default=False, kw_only=True)

    def member(self, of: TypeOfAxes, random: np.random.Generator, work: Allowance) -> Floats | None:
        """Return axes of a member, float[J, 6], from a random start; None if none was found."""
        joints = len(of.graph.joints)
        groups = (*of.meetings, *self.meetings)
        conditions: list[AxisCondition] = [normal(joints), meeting(groups, joints)]
        start = random.standard_normal((joints + len(groups), 6))
        if self.motion is not None:
            conditions.append(symmetric(self.motion, joints))
            start = _carried(start, self.motion)
        for loop in self.equal:
            conditions.append(equal_links(loop))
            start[list(loop), :3] = _round_a_circle(len(loop)) + _NOISE * start[list(loop), :3]
        start[:, 3:] = unit(start[:, 3:])
        found = axes_meeting(conditions, start, work)
        if found is not None and self.poses:
            found = axes_along_a_motion(of.graph, conditions, found, work)
        return None if found is None else found[:joints]


def _round_a_circle(count: int) -> Floats:
    angles = 2.0 * np.pi * np.arange(count) / count
    return np.column_stack([np.cos(angles), np.sin(angles), np.zeros(count)])


def _carried(start: Floats, motion: AxisSymmetry) -> Floats:
    """Return rows of which each is where the motion takes the row before it in its cycle."""
    rows, done = start.copy(), set()
    for first in range(len(motion.image)):
        place = first
        while place not in done:
            done.add(place)
            to = motion.image[place]
            if to not in done:
                rows[to] = np.concatenate([motion.matrix @ rows[place, :3], motion.matrix @ rows[place, 3:]])
            place = to
    return rows


def axis_families(of: TypeOfAxes) -> Iterator[AxisFamily]:
    """Yield the families that are tried, in their order: groups of axes, equal links, symmetries, poses."""
    for number, loop in enumerate(of.spatial):
        where = f" in loop {number}" if len(of.spatial) > 1 else ""
        if len(loop) == 6:
            yield from _triples(loop, where)
    if of.spatial and all(len(loop) > 5 for loop in of.spatial):
        yield AxisFamily("equal links, right twists and no offsets", equal=of.spatial)
    motions = named_motions(of.graph)
    for name, motion in motions:
        yield AxisFamily(name, motion=motion)
    for name, motion in motions:
        if np.allclose(motion.matrix @ motion.matrix, np.eye(3)):
            yield AxisFamily(f"{name}, poses that close", motion=motion, poses=True)
    yield AxisFamily("poses that close", poses=True)


def _triples(loop: tuple[int, ...], where: str) -> Iterator[AxisFamily]:
    for name, first, second in _TRIPLES:
        yield AxisFamily(name + where, meetings=(AxisGroup(loop[:3], first), AxisGroup(loop[3:], second)))


def solids_of(of: TypeOfAxes, axes: Floats) -> HingedSolids:
    """Return a member as a linkage of hinged solids."""
    pairs = zip(of.graph.joints, axes.tolist(), strict=True)
    return HingedSolids(of.graph, {joint: (tuple(axis[:3]), tuple(axis[3:])) for joint, axis in pairs})


def degenerate(of: TypeOfAxes, axes: Floats) -> str | None:
    """Return why axes float[J, 6] are of no member of the type, or of one with links of no length; else None."""
    points, directions = axes[:, :3], unit(axes[:, 3:])
    turned = np.linalg.norm(np.cross(directions[:, None], directions[None]), axis=2)
    apart = np.linalg.norm(np.cross(points[:, None] - points[None], directions[None]), axis=2)
    if (np.maximum(turned, apart)[np.triu_indices(len(axes), 1)] < _APART).any():
        return "two joints have one axis"
    for loop in of.spatial:
        on = list(loop)
        if turned[np.ix_(on, on)].max() < _APART:
            return "the axes of a spatial loop are parallel"
        if lines_meet(points[on], directions[on]).off.max() < _APART:
            return "the axes of a spatial loop meet in a point"
    return _one_centre(of, points, directions)


def _one_centre(of: TypeOfAxes, points: Floats, directions: Floats) -> str | None:
    finite, infinite = [], []
    for group in of.meetings:
        on = list(group.joints)
        if group.centre is Centre.INFINITE:
            infinite.append(directions[on[0]])
        elif np.linalg.norm(np.cross(directions[on], directions[on[0]]), axis=1).max() < _APART:
            return "axes that meet in a point are parallel"
        else:
            finite.append(lines_meet(points[on], directions[on]).point)
    for number, one in enumerate(finite):
        if any(np.linalg.norm(one - other) < _APART for other in finite[:number]):
            return "two centres are one"
    for number, one in enumerate(infinite):
        if any(np.linalg.norm(np.cross(one, other)) < _APART for other in infinite[:number]):
            return "two centres at infinity are one"
    return None
