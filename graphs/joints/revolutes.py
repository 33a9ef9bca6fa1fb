"""Joints of all kinds as chains of revolutes, a mechanism of creases that does the same; such chains recognised.

S is three revolutes about a point, U two whose axes cross at a right angle, the planar joint three parallel ones,
a slide the linkage of Sarrus (or a knee, `graphs.joints.joint_places`), C a slide and a revolute along it. Source:
Wiener 2016, sections 5.1 and 5.2. Theory: docs/theory/joints.md.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count, pairwise

import numpy as np

from graphs.geometry import across, frame_about, unit
from graphs.joints.joint_places import placed, placed_knees
from graphs.joints.linkage import JointedLinkage, JointKind, JointPlace, Leg, legs, plain_vector
from graphs.mechanism.precision import extent_of, precision_of_axes
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import Axis, HingedSolids
from graphs.tolerances import Tolerances
from graphs.types import Floats, JointId, LinkId

_SMALL = 0.1  # of the extent: any size moves alike; this is neither lost beside the mechanism nor larger than it
_ARM = 0.5  # height of a knee by the distance of its ends: a right angle, farthest from stretched and from folded
# No two sides are equal or parallel to an axis: equal ones could fold up.
_TRIANGLE = ((0.0, 0.0), (1.0, 0.2), (0.3, 0.9))

Line = tuple[Floats, Floats]
Row = list[Line]
"""Axes that follow each other, with a link between each two."""


def revolutes_of(linkage: JointedLinkage, seed: int = 0) -> HingedSolids:
    """Return the mechanism of revolutes that stands for a linkage with joints of all kinds.

    The revolutes of a joint, and the links between them, are called by its id, a colon and a number; one by its
    id.

    Parameters
    ----------
    linkage : JointedLinkage
        Without places it gets random ones.
    seed : int, optional
        Random seed for these.

    Examples
    --------
    >>> leg = SCGraph(4, {"u": (0, 1), "p": (1, 2), "s": (2, 3)})
    >>> list(revolutes_of(JointedLinkage(leg, {"u": JointKind.UNIVERSAL, "p": JointKind.PRISMATIC})).axes)
    ['u:1', 'u:2', 'p', 's']
    """
    whole = placed(linkage, seed)
    mechanism = _RevoluteMechanism(whole)
    knees = {knee.slide: (knee, normal) for knee, normal in placed_knees(whole)}
    shared = {end.joint: (end.place, normal) for knee, normal in knees.values() for end in knee.ends}
    points = {joint: np.array(place.point) for joint, place in whole.places.items()}
    size = _SMALL * (extent_of(np.array(list(points.values())).reshape(-1, 3)) or 1.0)
    for joint, kind in whole.kinds.items():
        if joint in knees:
            knee, normal = knees[joint]
            one, other = (points[end.joint] for end in knee.ends)
            mechanism.add(joint, [[_knee(one, other, normal, size)]])
        elif kind is JointKind.SPHERICAL:
            mechanism.add(joint, [_about_a_point(points[joint], shared.get(joint))])
        else:
            place = whole.places[joint]
            # A cylindrical joint has a revolute along its slide.
            along = (points[joint], unit(place.axes[0])) if kind is JointKind.CYLINDRICAL else None
            mechanism.add(joint, _rows(kind, place, size), along=along)
    old = whole.chain
    loops, closing = (
        [loop for loop in some if loop.has_centre and set(loop.joints) <= mechanism.joints.keys()]
        for some in (old.loops, old.closing)
    )  # a slide that the linkage of Sarrus stands for is no axis of a planar loop
    chain = SCGraph(mechanism.links, mechanism.joints, loops, closing=closing, ground=old.ground)
    return HingedSolids(chain, mechanism.axes)


class _RevoluteMechanism:
    """The mechanism of revolutes as it grows."""

    def __init__(self, linkage: JointedLinkage) -> None:
        self.links: list[LinkId] = list(linkage.chain.nodes)
        self.joints: dict[JointId, tuple[LinkId, LinkId]] = {}
        self.axes: dict[JointId, Axis] = {}
        self._ends: Mapping[JointId, tuple[LinkId, LinkId]] = linkage.chain.joints
        self._names = {str(name) for name in (*self.links, *self._ends)}

    def add(self, joint: JointId, rows: list[Row], along: Line | None = None) -> None:
        """Put rows of revolutes side by side for a joint, and after them one more if there is one along them."""
        first, last = self._ends[joint]
        alone = len(rows) == 1 and len(rows[0]) == 1
        names = iter([joint]) if alone else self._new_names(joint)
        links = self._new_names(joint)
        middle = last if along is None else self._link(next(links))
        for row in rows:
            inner = [self._link(next(links)) for _ in row[1:]]
            self._join((first, *inner, middle), row, names)
        if along is not None:
            self._join((middle, last), [along], names)

    def _link(self, name: LinkId) -> LinkId:
        self.links.append(name)
        return name

    def _join(self, links: tuple[LinkId, ...], row: Row, names: Iterator[JointId]) -> None:
        for ends, (point, direction) in zip(pairwise(links), row, strict=True):
            name = next(names)
            self.joints[name] = ends
            self.axes[name] = plain_vector(point), plain_vector(direction)

    def _new_names(self, joint: JointId) -> Iterator[str]:
        """Yield names that neither the linkage nor another of its joints has."""
        for number in count(1):
            name = f"{joint}:{number}"
            while name in self._names:
                name += "'"
            yield name


def _rows(kind: JointKind, place: JointPlace, size: float) -> list[Row]:
    point, axes = np.array(place.point), [unit(axis) for axis in place.axes]
    if kind in (JointKind.REVOLUTE, JointKind.UNIVERSAL):
        return [[(point, axis) for axis in axes]]
    x, y, _ = frame_about(axes[0])
    if kind is JointKind.PLANAR:
        return [[(point + size * (u * x + v * y), axes[0]) for u, v in _TRIANGLE]]
    step = size * axes[0]  # a prismatic or a cylindrical joint: the linkage of Sarrus
    return [
        [(point - step + size * out, turn), (point + 2 * size * out, turn), (point + step + size * out, turn)]
        for turn, out in ((x, y), (y, x))
    ]


def _knee(one: Floats, other: Floats, normal: Floats, size: float) -> Line:
    """Return the middle axis of a knee between parallel axes through two points."""
    step = across(other - one, normal)
    length = float(np.linalg.norm(step))
    if length < size:  # the two lie on each other: any arm will do
        return one + step / 2 + size * frame_about(normal)[0], normal
    return (one + other) / 2 + _ARM * np.cross(normal, step), normal


def _about_a_point(point: Floats, shared: tuple[int, Floats] | None) -> Row:
    """Return three axes at right angles, the first or the last of them that of a knee beside it."""
    if shared is None:
        return [(point, axis) for axis in np.eye(3)]
    place, normal = shared
    axes = [normal, *frame_about(normal)[:2]]
    return [(point, axis) for axis in (axes if place == 0 else axes[::-1])]


# Volume of three unit vectors. A chain of three axes through a point turns about it in all ways if this is not 0; drawn
# at random it is about 0.4, while axes of one plane with errors of 1e-6 make some 1e-6.
_FLAT = 1e-3


def recognised(solids: HingedSolids) -> JointedLinkage:
    """Return a mechanism of revolutes with its chains of joints recognised as the joints that they stand for.

    Joints of loops with a centre are revolutes. The others are searched in this order: two knees side by side
    between two links, across each other, are a slide (Sarrus), and with a revolute along it a cylindrical joint;
    other knees are slides between the joints beside them; of axes in a row three through a point are a spherical
    joint, two that cross at a right angle a universal one, three that are parallel a planar one.

    Parameters
    ----------
    solids : HingedSolids

    Examples
    --------
    >>> from graphs.joints.revolutes import revolutes_of
    >>> kinds = {"u": JointKind.UNIVERSAL, "p": JointKind.PRISMATIC, "s": JointKind.SPHERICAL}
    >>> leg = JointedLinkage(SCGraph(4, {"u": (0, 1), "p": (1, 2), "s": (2, 3)}), kinds)
    >>> recognised(revolutes_of(leg))
    <JointedLinkage: 4 links, 3 joints: P S U, placed>
    """
    recognition = _Recognition(solids)
    recognition.sarrus()
    recognition.knees()
    recognition.rows()
    recognition.cylinders()
    return recognition.linkage()


@dataclass(frozen=True, slots=True)
class _BentRow:
    """Three parallel axes in a row, the middle one with equal arms, and binary links between them."""

    joints: tuple[JointId, JointId, JointId]
    links: tuple[LinkId, LinkId, LinkId, LinkId]
    normal: Floats
    along: Floats


class _Recognition:
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
        """Return the linkage with the joints recognised so far."""
        chain = self._graph()
        places = {
            joint: JointPlace(plain_vector(self._points[joint]), tuple(map(plain_vector, self._axes[joint])))
            for joint in self._joints
        }
        return JointedLinkage(chain, self._kinds, places)

    def sarrus(self) -> None:
        """Take two knees side by side, across each other, for a slide."""
        beside: dict[frozenset[LinkId], list[_BentRow]] = {}
        used: set[JointId] = set()
        for bent in self._bent():
            others = beside.setdefault(frozenset((bent.links[0], bent.links[3])), [])
            for other in others:
                joints = {*bent.joints, *other.joints}
                crossed = np.linalg.norm(np.cross(bent.normal, other.normal)) > _FLAT
                if crossed and not joints & used and len(joints) == 6 and bent.links[0] != bent.links[3]:
                    used |= joints
                    first, last = other.links[0], other.links[3]
                    ways = [unit(np.cross(other.normal, bent.normal))]
                    inner = (*other.links[1:3], *bent.links[1:3])
                    self._replace([*other.joints, *bent.joints], inner, (first, last), JointKind.PRISMATIC, ways)
                    break
            else:
                others.append(bent)

    def knees(self) -> None:
        """Take the middle axis of a knee for a slide."""
        used: set[JointId] = set()
        for bent in self._bent():
            if not set(bent.joints) & used:
                used.update(bent.joints)
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

    def _bent(self) -> list[_BentRow]:
        rows = []
        for leg in self._legs():
            for place in range(len(leg.joints) - 2):
                joints = leg.joints[place : place + 3]
                plain = all(self._kinds[joint] is JointKind.REVOLUTE for joint in joints)
                if not plain or set(joints) & self._kept or not self._is_parallel(joints):
                    continue
                normal = self._axes[joints[0]][0]
                one, middle, other = (across(self._points[joint] - self._points[joints[0]], normal) for joint in joints)
                arms = np.linalg.norm(middle - one), np.linalg.norm(other - middle)
                length = float(np.linalg.norm(other - one))
                if abs(arms[0] - arms[1]) <= self._near < length and min(arms) > self._near:
                    a, b, c, d = leg.links[place : place + 4]
                    x, y, z = joints
                    rows.append(_BentRow((x, y, z), (a, b, c, d), normal, (other - one) / length))
        return rows

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
        """Return whether axes pass through a point."""
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
        """Return the part of the names of joints before a colon, if they have it in common; else all names."""
        stems = {str(joint).rpartition(":")[0] or str(joint) for joint in joints}
        name = stems.pop() if len(stems) == 1 else "+".join(map(str, joints))
        while name in map(str, self._joints):
            name += "'"
        return int(name) if name.isdecimal() and str(int(name)) == name else name

    def _legs(self) -> list[Leg]:
        """Return the present rows of joints; rings begin between two chains that stand for joints."""
        return [self._well_begun(leg) for leg in legs(self._graph())]

    def _well_begun(self, leg: Leg) -> Leg:
        """Return a ring of binary links from between two chains on; other rows as they are."""
        first = leg.links[0]
        if first == self._chain.ground or sum(first in ends for ends in self._joints.values()) != 2:
            return leg
        for shift in range(len(leg.joints)):
            joints, links = leg.joints[shift:] + leg.joints[:shift], leg.links[shift:-1] + leg.links[: shift + 1]
            if self._parts(joints[-1], joints[0]):
                return Leg(joints, links)
        return leg

    def _parts(self, one: JointId, other: JointId) -> bool:
        """Return whether two joints belong to different chains: their axes neither meet nor are parallel."""
        pair = (one, other)
        if any(self._kinds[joint] is not JointKind.REVOLUTE for joint in pair):
            return True
        return not self._is_parallel(pair) and not self._pass(pair, self._meeting(pair))

    def _graph(self) -> SCGraph:
        return SCGraph(
            self._links, self._joints, self._chain.loops, closing=self._chain.closing, ground=self._chain.ground
        )
