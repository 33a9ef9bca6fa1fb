"""Chains of revolutes seen as joints of other kinds, by where their axes lie. Theory: docs/theory/joints.md."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphs.geometry import across, unit
from graphs.joints.kinds import JointKind
from graphs.joints.linkage import JointedLinkage, JointPlace, Leg, legs, plain_vector
from graphs.mechanism.precision import extent_of, precision_of_axes
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.tolerances import Tolerances
from graphs.types import Floats, JointId, LinkId

__all__ = ["recognised"]

_FLAT = 1e-3
"""Volume of three unit vectors through a point that turn about it in all ways, at least."""


def recognised(solids: HingedSolids) -> JointedLinkage:
    """Return a mechanism of revolutes with its chains of joints seen as the joints that they stand for.

    Joints of loops with a centre are revolutes. The others are looked through in this order: two knees side by
    side between two links, across each other, are a slide (Sarrus), and with a revolute along it a cylindrical
    joint; other knees are slides between the joints beside them; of axes in a row three through a point are a
    spherical joint, two that cross at a right angle a universal one, three that are parallel a planar one. Links
    that go into a joint have no other joints, and are not the ground.

    Parameters
    ----------
    solids : HingedSolids

    Examples
    --------
    >>> from graphs.joints.as_revolutes import revolutes_of
    >>> kinds = {"u": JointKind.UNIVERSAL, "p": JointKind.PRISMATIC, "s": JointKind.SPHERICAL}
    >>> leg = JointedLinkage(SCGraph(4, {"u": (0, 1), "p": (1, 2), "s": (2, 3)}), kinds)
    >>> recognised(revolutes_of(leg))
    <JointedLinkage: 4 links, 3 joints: P S U, placed>
    """
    seen = _Seen(solids)
    seen.sarrus()
    seen.knees()
    seen.rows()
    seen.cylinders()
    return seen.linkage()


@dataclass(frozen=True, slots=True)
class _Bent:
    """Three parallel axes in a row, the middle one with equal arms, and binary links between them."""

    joints: tuple[JointId, JointId, JointId]
    links: tuple[LinkId, LinkId, LinkId, LinkId]
    normal: Floats
    along: Floats


class _Seen:
    """A linkage in which more and more joints are not revolutes."""

    def __init__(self, solids: HingedSolids) -> None:
        self._chain = solids.chain
        self._joints: dict[JointId, tuple[LinkId, LinkId]] = dict(solids.chain.joints)
        self._links: list[LinkId] = list(solids.chain.nodes)
        points = np.array([point for point, _ in solids.axes.values()], dtype=float).reshape(-1, 3)
        axes = np.array([axis for _, axis in solids.axes.values()], dtype=float).reshape(-1, 3)
        tolerances = Tolerances.of(precision_of_axes(points, axes).size)
        axes = unit(axes)
        self._near = tolerances.same_point * (extent_of(points) or 1.0)
        self._parallel = tolerances.parallel
        self._points: dict[JointId, Floats] = dict(zip(solids.axes, points, strict=True))
        self._axes: dict[JointId, list[Floats]] = {j: [one] for j, one in zip(solids.axes, axes, strict=True)}
        self._kinds = dict.fromkeys(self._joints, JointKind.REVOLUTE)
        loops = (*solids.chain.loops, *solids.chain.closing)
        self._kept = {joint for loop in loops if loop.has_centre for joint in loop.joints}

    def linkage(self) -> JointedLinkage:
        """Return what was seen."""
        chain = self._graph()
        places = {
            joint: JointPlace(plain_vector(self._points[joint]), tuple(map(plain_vector, self._axes[joint])))
            for joint in self._joints
        }
        return JointedLinkage(chain, self._kinds, places)

    def sarrus(self) -> None:
        """Take two knees side by side, across each other, for a slide."""
        beside: dict[frozenset[LinkId], list[_Bent]] = {}
        taken: set[JointId] = set()
        for bent in self._bent():
            others = beside.setdefault(frozenset((bent.links[0], bent.links[3])), [])
            for other in others:
                joints = {*bent.joints, *other.joints}
                crossed = np.linalg.norm(np.cross(bent.normal, other.normal)) > _FLAT
                if crossed and not joints & taken and len(joints) == 6 and bent.links[0] != bent.links[3]:
                    taken |= joints
                    first, last = other.links[0], other.links[3]
                    ways = [unit(np.cross(other.normal, bent.normal))]
                    inner = (*other.links[1:3], *bent.links[1:3])
                    self._replace([*other.joints, *bent.joints], inner, (first, last), JointKind.PRISMATIC, ways)
                    break
            else:
                others.append(bent)

    def knees(self) -> None:
        """Take the middle axis of a knee for a slide."""
        taken: set[JointId] = set()
        for bent in self._bent():
            if not set(bent.joints) & taken:
                taken.update(bent.joints)
                self._kinds[bent.joints[1]] = JointKind.PRISMATIC
                self._axes[bent.joints[1]] = [bent.along]

    def rows(self) -> None:
        """Take revolutes in a row for spherical, universal and planar joints."""
        for leg in self._legs():
            place = 0
            while place < len(leg.joints):
                place += self._grouped(leg, place)

    def cylinders(self) -> None:
        """Take a slide and a revolute along it, nothing else between them, for a cylindrical joint."""
        for leg in self._legs():
            for place in range(len(leg.joints) - 1):
                pair = leg.joints[place : place + 2]
                kinds = [self._kinds.get(joint) for joint in pair]
                ends = (leg.links[place], leg.links[place + 2])
                if set(kinds) != {JointKind.REVOLUTE, JointKind.PRISMATIC} or ends[0] == ends[1]:
                    continue
                if self._is_parallel(pair):
                    turning = pair[kinds.index(JointKind.REVOLUTE)]
                    point, axes = self._points[turning], self._axes[turning]
                    self._replace(pair, leg.links[place + 1 : place + 2], ends, JointKind.CYLINDRICAL, axes, point)

    def _grouped(self, leg: Leg, place: int) -> int:
        """Take the revolutes from a place of a row on for one joint; return how many they are."""
        for size, kind, is_it in (
            (3, JointKind.SPHERICAL, self._is_spherical),
            (2, JointKind.UNIVERSAL, self._is_universal),
            (3, JointKind.PLANAR, self._is_parallel),
        ):
            joints = leg.joints[place : place + size]
            if len(joints) < size or leg.links[place] == leg.links[place + size]:
                continue
            if any(self._kinds[joint] is not JointKind.REVOLUTE for joint in joints):
                continue
            if not set(joints) & self._kept and is_it(joints):
                axes = [self._axes[joint][0] for joint in joints][: kind.axes]
                ends = (leg.links[place], leg.links[place + size])
                where = self._points[joints[0]] if kind is JointKind.PLANAR else self._meeting(joints[:2])
                self._replace(joints, leg.links[place + 1 : place + size], ends, kind, axes, where)
                return size
        return 1

    def _bent(self) -> list[_Bent]:
        found = []
        for leg in self._legs():
            for place in range(len(leg.joints) - 2):
                joints = leg.joints[place : place + 3]
                plain = all(self._kinds[joint] is JointKind.REVOLUTE for joint in joints)
                if not plain or set(joints) & self._kept or not self._is_parallel(joints):
                    continue
                normal = self._axes[joints[0]][0]
                one, middle, other = (
                    across(self._points[joint] - self._points[joints[0]], normal) for joint in joints
                )
                arms = np.linalg.norm(middle - one), np.linalg.norm(other - middle)
                length = float(np.linalg.norm(other - one))
                if abs(arms[0] - arms[1]) <= self._near < length and min(arms) > self._near:
                    a, b, c, d = leg.links[place : place + 4]
                    x, y, z = joints
                    found.append(_Bent((x, y, z), (a, b, c, d), normal, (other - one) / length))
        return found

    def _is_parallel(self, joints: Sequence[JointId]) -> bool:
        first = self._axes[joints[0]][0]
        return all(np.linalg.norm(np.cross(first, self._axes[joint][0])) <= self._parallel for joint in joints[1:])

    def _is_universal(self, joints: Sequence[JointId]) -> bool:
        one, other = (self._axes[joint][0] for joint in joints)
        return abs(float(one @ other)) <= self._parallel and self._pass(joints, self._meeting(joints))

    def _is_spherical(self, joints: Sequence[JointId]) -> bool:
        axes = np.array([self._axes[joint][0] for joint in joints])
        if self._is_parallel(joints[:2]) or abs(float(np.linalg.det(axes))) <= _FLAT:
            return False
        return self._pass(joints, self._meeting(joints[:2]))

    def _meeting(self, joints: Sequence[JointId]) -> Floats:
        """Return the point of the first axis that is nearest to the second."""
        (p, u), (q, v) = ((self._points[joint], self._axes[joint][0]) for joint in joints)
        cosine = u @ v
        along = ((q - p) @ (u - cosine * v)) / (1.0 - cosine**2)
        return p + along * u

    def _pass(self, joints: Sequence[JointId], point: Floats) -> bool:
        """Tell whether axes pass through a point."""
        offs = (across(point - self._points[joint], self._axes[joint][0]) for joint in joints)
        return all(np.linalg.norm(off) <= self._near for off in offs)

    def _replace(
        self,
        joints: Sequence[JointId],
        inner: Sequence[LinkId],
        ends: tuple[LinkId, LinkId],
        kind: JointKind,
        axes: list[Floats],
        point: Floats | None = None,
    ) -> None:
        """Put one joint in the place of several and of the links between them."""
        where = np.mean([self._points[joint] for joint in joints], axis=0) if point is None else point
        for joint in joints:
            for held in (self._joints, self._kinds, self._points, self._axes):
                del held[joint]
        for link in inner:
            self._links.remove(link)
        name = self._name(joints)
        self._joints[name], self._kinds[name] = ends, kind
        self._points[name], self._axes[name] = where, axes

    def _name(self, joints: Sequence[JointId]) -> JointId:
        """Return what the names of joints are before a colon, if that is the same of all; else all names."""
        stems = {str(joint).rpartition(":")[0] or str(joint) for joint in joints}
        name = stems.pop() if len(stems) == 1 else "+".join(map(str, joints))
        while name in map(str, self._joints):
            name += "'"
        return int(name) if name.isdecimal() and str(int(name)) == name else name

    def _legs(self) -> list[Leg]:
        """Return the rows of joints that there are now; rings begin where no joint would be cut in two."""
        return [self._well_begun(leg) for leg in legs(self._graph())]

    def _well_begun(self, leg: Leg) -> Leg:
        """Return a ring of binary links as it begins between two joints; other rows begin where they must."""
        first = leg.links[0]
        if first == self._chain.ground or self._degree(first) != 2:
            return leg
        for shift in range(len(leg.joints)):
            joints, links = leg.joints[shift:] + leg.joints[:shift], leg.links[shift:-1] + leg.links[: shift + 1]
            if self._parts(joints[-1], joints[0]):
                return Leg(joints, links)
        return leg

    def _degree(self, link: LinkId) -> int:
        return sum(link in ends for ends in self._joints.values())

    def _parts(self, one: JointId, other: JointId) -> bool:
        """Tell whether two joints belong to different chains: their axes neither meet nor are parallel."""
        pair = (one, other)
        if any(self._kinds[joint] is not JointKind.REVOLUTE for joint in pair):
            return True
        return not self._is_parallel(pair) and not self._pass(pair, self._meeting(pair))

    def _graph(self) -> SCGraph:
        return SCGraph(
            self._links, self._joints, self._chain.loops, closing=self._chain.closing, ground=self._chain.ground
        )
