"""Joints of all kinds as chains of revolutes: a mechanism of creases that does the same.

S is three revolutes about a point, U two whose axes cross at a right angle, the planar joint three parallel ones,
a slide the linkage of Sarrus (or a knee, `graphs.joints.knees`), C a slide and a revolute along it. Source: Wiener
2016, sections 5.1 and 5.2. Theory: docs/theory/joints.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import count, pairwise

import numpy as np

from graphs.geometry import across, frame_about, unit
from graphs.joints.kinds import JointKind
from graphs.joints.knees import placed_knees
from graphs.joints.linkage import JointedLinkage, JointPlace, plain_vector
from graphs.joints.placing import placed
from graphs.mechanism.precision import extent_of
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import Axis, HingedSolids
from graphs.types import Floats, JointId, LinkId

__all__ = ["revolutes_of"]

_SMALL = 0.1
"""Of what stands for a joint, in units of the extent."""
_ARM = 0.5
"""Height of a knee over the line between its ends, in units of their distance."""
_TRIANGLE = ((0.0, 0.0), (1.0, 0.2), (0.3, 0.9))
"""Axes of a planar joint in its plane: no two sides alike, which tells it from a knee."""

Line = tuple[Floats, Floats]
Row = list[Line]
"""Axes that follow each other, with a link between each two."""


def revolutes_of(linkage: JointedLinkage, seed: int = 0) -> HingedSolids:
    """Return the mechanism of revolutes that a linkage with joints of all kinds is.

    A joint that is one revolute keeps its id; of others the revolutes are called by its id, a colon and a number,
    and so are the links between them.

    Parameters
    ----------
    linkage : JointedLinkage
        Without places it is given random ones.
    seed : int, optional
        Of these.

    Examples
    --------
    A leg of a platform: RR-R-RRR, neighbours sharing axes.

    >>> leg = SCGraph(4, {"u": (0, 1), "p": (1, 2), "s": (2, 3)})
    >>> kinds = {"u": JointKind.UNIVERSAL, "p": JointKind.PRISMATIC, "s": JointKind.SPHERICAL}
    >>> list(revolutes_of(JointedLinkage(leg, kinds)).axes)
    ['u:1', 'u:2', 'p', 's:1', 's:2', 's:3']
    """
    whole = placed(linkage, seed)
    made = _Made(whole)
    knees = {knee.slide: (knee, normal) for knee, normal in placed_knees(whole)}
    shared = {end.joint: (end.place, normal) for knee, normal in knees.values() for end in knee.ends}
    points = {joint: np.array(place.point) for joint, place in whole.places.items()}
    size = _SMALL * (extent_of(np.array(list(points.values())).reshape(-1, 3)) or 1.0)
    for joint, kind in whole.kinds.items():
        if joint in knees:
            knee, normal = knees[joint]
            one, other = (points[end.joint] for end in knee.ends)
            made.add(joint, [[_knee(one, other, normal, size)]])
        elif kind is JointKind.SPHERICAL:
            made.add(joint, [_about_a_point(points[joint], shared.get(joint))])
        else:
            made.add(joint, _rows(kind, whole.places[joint], size), along=_turned_along(kind, whole.places[joint]))
    old = whole.chain
    loops, closing = (
        [loop for loop in some if loop.has_centre and set(loop.joints) <= made.joints.keys()]
        for some in (old.loops, old.closing)
    )  # a slide that the linkage of Sarrus stands for is no axis of a planar loop
    chain = SCGraph(made.links, made.joints, loops, closing=closing, ground=old.ground)
    return HingedSolids(chain, made.axes)


class _Made:
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


def _turned_along(kind: JointKind, place: JointPlace) -> Line | None:
    """Return the revolute that a cylindrical joint has along its slide."""
    return (np.array(place.point), unit(place.axes[0])) if kind is JointKind.CYLINDRICAL else None


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
