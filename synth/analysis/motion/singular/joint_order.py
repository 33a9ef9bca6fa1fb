"""An order of the joints that depends on the mechanism alone, not on how a file numbers them.

A search that is cut off, or begins at random numbers, depends on the order of joints; so does a choice among
equals. Joints are told apart by what a motion, a mirror and another unit of length leave: the links they share,
the angles and moments between their axes, their distances from the centres of loops. Classes are refined until
nothing changes (colour refinement); of joints that are still alike one is taken out, and refinement goes on.
Theory: docs/theory/rounding.md.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace

import numpy as np
import scipy

from graphs.geometry import lines_meet
from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from graphs.tolerances import DOUBLE, canonical_order, trailing
from graphs.types import Floats, Ints
from synth.analysis.motion.linkage import Linkage, LinkageLoop

_BENT = 0.37
"""Invariants x count as 1 / (x + this): sums of squares are alike where their terms are not."""

_MOST_PAIRS = 1500
"""Joints and centres of which all pairs are related; of more, those that are in one loop or share a link."""
_PART = 256

_SHARES = (1.0, 0.731, 0.519, 0.347)
"""Weights of the invariants that are added to one."""


def joint_order(linkage: Linkage, marks: Floats | None = None) -> Ints:
    """Return the joints, int[J], in an order that renaming, moving and mirroring leave; marks part like ones."""
    joints = len(linkage.angles)
    if joints < 2:
        return np.arange(joints)
    return _swept(linkage, _labels(linkage, marks))


def _labels(linkage: Linkage, marks: Floats | None) -> Ints:
    """Return the joints in the order of their classes."""
    relations = _Relations.of(linkage)
    angles = np.concatenate([np.cos(linkage.angles), np.full(relations.centres, 2.0)])
    colours = relations.refined(_classes(np.zeros(len(angles), dtype=np.int64), angles))
    if marks is None or not marks.any():
        return relations.order(colours)
    sides = [np.concatenate([sign * marks, np.zeros(relations.centres)]) for sign in _signs(colours, marks)]
    orders = [relations.order(relations.refined(_classes(colours, side))) for side in sides]
    both = zip(orders, sides, strict=True)
    seen = [np.concatenate([side[order], relations.seen(order)]) for order, side in both]
    return orders[canonical_order(seen, DOUBLE.zero)[0]]


def _swept(linkage: Linkage, labels: Ints) -> Ints:
    """Return the joints loop by loop, from one far out to those that share most joints with the loops before."""
    rank = np.argsort(labels)
    centres = {number: _centre(linkage, loop) for number, loop in enumerate(linkage.loops) if _is_about(loop)}
    if not centres:
        return labels
    around = np.array(list(centres.values()))
    far = np.concatenate([np.linalg.norm(part[:, None] - around, axis=2).mean(axis=1) for part in _parts(around)])
    names = [sorted(rank[list(linkage.loops[number].joints)].tolist()) for number in centres]
    by_name = sorted(range(len(names)), key=names.__getitem__)
    start = by_name[trailing(-far[by_name])]
    loops_of: dict[int, list[int]] = {}
    for number, name in enumerate(names):
        for joint in name:
            loops_of.setdefault(joint, []).append(number)
    placed: dict[int, None] = {}
    left, shared, met = set(range(len(names))), Counter[int](), dict[int, int]()
    met[start] = 0
    while left:
        here = [number for number in met if number in left]
        if not here:
            met[next(number for number in by_name if number in left)] = len(met)
            continue
        number = min(here, key=lambda one: (-shared[one], -met[one]))
        left.remove(number)
        new = [joint for joint in names[number] if joint not in placed]
        placed |= dict.fromkeys(new)
        beyond = sorted({other for joint in new for other in loops_of[joint]} & left, key=names.__getitem__)
        for other in beyond:
            met.setdefault(other, len(met))
        shared.update(other for joint in new for other in loops_of[joint])
    rest = [joint for joint in range(len(labels)) if joint not in placed]
    return labels[[*placed, *rest]]


def _parts(points: Floats) -> list[Floats]:
    """Return points in parts, so that their distances from all points are few numbers at a time."""
    return [points[start : start + _PART] for start in range(0, len(points), _PART)]


def _is_about(loop: LinkageLoop) -> bool:
    return loop.centre is Centre.FINITE and len(loop.joints) > 1


def in_order(linkage: Linkage, order: Ints) -> Linkage:
    """Return a linkage with its joints in an order, and its loops by these, beginning at their first joint."""
    graph, names = linkage.graph, list(linkage.graph.joints)
    place = np.argsort(order)
    loops = [_begun_at_first(loop, place) for loop in linkage.loops]
    # those about a point first, in the order of their last joints
    loops.sort(key=lambda loop: (loop.centre is not Centre.FINITE, sorted(loop.joints, reverse=True)))
    joints = {names[old]: graph.joints[names[old]] for old in order.tolist()}
    ordered = SCGraph(graph.nodes, joints, graph.loops, closing=graph.closing, ground=graph.ground)
    points, directions, angles = linkage.points[order], linkage.directions[order], linkage.angles[order]
    return replace(linkage, graph=ordered, points=points, directions=directions, angles=angles, loops=tuple(loops))


def _begun_at_first(loop: LinkageLoop, place: Ints) -> LinkageLoop:
    """Return a loop by new places, from the least on towards the lesser of its neighbours."""
    joints, signs = [int(place[joint]) for joint in loop.joints], list(loop.signs)
    first = joints.index(min(joints))
    joints, signs = joints[first:] + joints[:first], signs[first:] + signs[:first]
    if joints[-1] < joints[1]:
        joints = [joints[0], *joints[:0:-1]]
        signs = [-sign for sign in (signs[0], *signs[:0:-1])]
    return LinkageLoop(tuple(joints), tuple(signs), loop.centre)


def _signs(colours: Ints, marks: Floats) -> tuple[float, ...]:
    """Return the sign of marks that the first class whose marks are not in balance makes positive, or both."""
    sums = np.bincount(colours[: len(marks)], weights=marks)
    uneven = sums[np.abs(sums) > 0.5]
    return (float(np.sign(uneven[0])),) if len(uneven) else (1.0, -1.0)


@dataclass(frozen=True, slots=True)
class _Relations:
    """Invariant relations of joints and centres to each other: the mean over a class distinguishes its members.

    `pairs`, float[n, n], symmetric, the joints first, then the centres of loops about a point: a sum of
    invariants, each with a share of its own. It is sparse if they are many.
    """

    pairs: Floats | scipy.sparse.csr_matrix
    joints: int
    centres: int

    @classmethod
    def of(cls, linkage: Linkage) -> _Relations:
        """Return the relations of the joints of a linkage and the centres of its loops."""
        joints = len(linkage.angles)
        about = [loop for loop in linkage.loops if _is_about(loop)]
        centres = np.array([_centre(linkage, loop) for loop in about]).reshape(-1, 3)
        size = joints + len(about)
        if size > _MOST_PAIRS:
            return cls(_near_pairs(linkage, about, centres), joints, len(about))
        distances, passing = np.zeros((size, size)), np.zeros((size, size))
        apart = ((centres[:, None] - centres[None]) ** 2).sum(axis=2)
        unit = apart.mean() if about else 1.0
        unit = unit if unit > DOUBLE.same_point**2 else 1.0
        distances[joints:, joints:] = apart / unit
        off = centres[None] - linkage.points[:, None]
        off = off - (off * linkage.directions[:, None]).sum(axis=2)[..., None] * linkage.directions[:, None]
        distances[:joints, joints:] = (off**2).sum(axis=2) / unit
        distances[joints:, :joints] = distances[:joints, joints:].T
        for number, loop in enumerate(about):
            passing[list(loop.joints), joints + number] = passing[joints + number, list(loop.joints)] = 1.0
        passing[:joints, :joints] = _links_shared(linkage)
        between = np.zeros((size, size))
        between[:joints, :joints] = 1.0 / ((linkage.directions @ linkage.directions.T) ** 2 + _BENT)
        moments = np.zeros((size, size))
        moments[:joints, :joints] = _moments(linkage)
        invariants = (1.0 / (distances + _BENT), passing, between, moments)
        pairs = sum(share * one for share, one in zip(_SHARES, invariants, strict=True))
        return cls(np.asarray(pairs), joints, len(about))

    def seen(self, order: Ints) -> Floats:
        """Return the relations of the joints in an order, as one array; places of those that are not zero if sparse."""
        if isinstance(self.pairs, np.ndarray):
            return np.asarray(self.pairs[np.ix_(order, order)].ravel())
        there = self.pairs[order][:, order].tocoo()
        first = np.lexsort((there.col, there.row))
        return np.concatenate([there.row[first], there.col[first], there.data[first]]).astype(float)

    def refined(self, colours: Ints) -> Ints:
        """Return the classes that relations to the classes before tell apart, until these are no more."""
        while True:
            classes = int(colours.max()) + 1
            names = np.random.default_rng(classes).uniform(0.5, 1.0, classes)
            finer = _classes(colours, self.pairs @ names[colours] / len(colours))
            if finer.max() == colours.max():
                return colours
            colours = finer

    def order(self, colours: Ints) -> Ints:
        """Return the joints in the order of their classes; of several in a class one is taken out at a time."""
        while True:
            here = colours[: self.joints]
            sizes = np.bincount(here)
            several = np.flatnonzero(sizes > 1)
            if not len(several):
                return np.argsort(here)
            colours = 2 * colours
            colours[int(np.argmax(here == several[0]))] -= 1
            colours = self.refined(np.unique(colours, return_inverse=True)[1])


def _near_pairs(linkage: Linkage, about: list[LinkageLoop], centres: Floats) -> scipy.sparse.csr_matrix:
    """Return the relations of a large linkage: of joints that share a link or a loop, and of these to its centre."""
    joints, size = len(linkage.angles), len(linkage.angles) + len(about)
    loops = [list(loop.joints) for loop in about]
    lengths = [len(loop) for loop in loops]
    around = np.repeat(np.arange(len(about)), lengths), np.concatenate([np.zeros(0, dtype=np.int64), *loops])
    within = scipy.sparse.csr_matrix((np.ones(len(around[0])), around), shape=(len(about), joints))
    number = {link: place for place, link in enumerate(linkage.graph.nodes)}
    ends = np.array([[number[link] for link in pair] for pair in linkage.graph.joints.values()])
    of_links = np.repeat(np.arange(joints), 2), ends.ravel()
    at_links = scipy.sparse.csr_matrix((np.ones(2 * joints), of_links), shape=(joints, len(number)))
    shared = at_links @ at_links.T
    near = (shared + within.T @ within).tocoo()
    one, other = (places[near.row != near.col].astype(np.int64) for places in (near.row, near.col))
    cosines = (linkage.directions[one] * linkage.directions[other]).sum(axis=1)
    off = np.cross(linkage.points, linkage.directions)
    moments = (linkage.directions[one] * off[other]).sum(axis=1) + (linkage.directions[other] * off[one]).sum(axis=1)
    largest = (moments**2).max(initial=0.0)
    values = _SHARES[0] / _BENT + _SHARES[1] * np.asarray(shared[one, other]).ravel()
    values = values + _SHARES[2] / (cosines**2 + _BENT)
    values = values + (_SHARES[3] * moments**2 / largest if largest > DOUBLE.flat**2 else 0.0)
    to_centre = np.full(len(around[0]), _SHARES[0] / _BENT + _SHARES[1])
    rows = np.concatenate([one, around[1], joints + around[0]])
    columns = np.concatenate([other, joints + around[0], around[1]])
    return scipy.sparse.csr_matrix(
        (np.concatenate([values, to_centre, to_centre]), (rows, columns)), shape=(size, size)
    )


def _classes(colours: Ints, seen: Floats) -> Ints:
    """Return classes by the classes before, and within these by numbers that differ by more than rounding."""
    order = np.lexsort((seen, colours))
    new = (np.diff(colours[order]) > 0) | (np.diff(seen[order]) > DOUBLE.zero * np.abs(seen).max(initial=0.0))
    finer = np.empty(len(colours), dtype=np.int64)
    finer[order] = np.concatenate([[0], np.cumsum(new)])
    return finer


def _centre(linkage: Linkage, loop: LinkageLoop) -> Floats:
    joints = list(loop.joints)
    return np.asarray(lines_meet(linkage.points[joints], linkage.directions[joints]).point)


def _links_shared(linkage: Linkage) -> Floats:
    """Return how many links two joints share: float[J, J], 0 on the diagonal."""
    number = {link: place for place, link in enumerate(linkage.graph.nodes)}
    ends = np.zeros((len(linkage.angles), len(number)))
    for place, (first, second) in enumerate(linkage.graph.joints.values()):
        ends[place, number[first]] = ends[place, number[second]] = 1.0
    shared = ends @ ends.T
    np.fill_diagonal(shared, 0.0)
    return np.asarray(shared)


def _moments(linkage: Linkage) -> Floats:
    """Return the squares of the moments between axes, as parts of the largest; zeros where all lie in a plane."""
    off = np.cross(linkage.points, linkage.directions)
    moments = linkage.directions @ off.T
    moments = (moments + moments.T) ** 2
    largest = moments.max(initial=0.0)
    return np.asarray(moments / largest if largest > DOUBLE.flat**2 else np.zeros_like(moments))
