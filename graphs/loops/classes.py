"""Centre classes: which loops of a mechanism share their centre.

Two distinct axes cannot both join two distinct points, so two loops that share two joints have one centre (Wiener
2016, section 3.3.5). The rule is applied to *classes* of loops until nothing changes. An axis holds one point at
infinity only, so two planar loops that share a single joint are one class too. Classes are found without looking
at all pairs of loops that share a joint: ten thousand loops on one joint have fifty million. Theory:
docs/theory/centre-classes.md.
"""

from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import permutations

from graphs.errors import InvariantError, shown
from graphs.loops.loop import Centre, Loop
from graphs.types import JointId

FEW = 16
"""A joint with more loops is *crowded*: its loops are found by a table, not in pairs, of which 16 have 120, and
1500 a million. Below, pairs are quicker; answers do not depend on it."""


class Merger:
    """A union of loops that have a centre into classes, each known by one of its loops, the root.

    ``members`` maps a root to the loops of its class, ``joints`` to their joints.
    """

    def __init__(self, loops: Sequence[Loop]) -> None:
        self.loops = loops
        self.members = {i: [i] for i, loop in enumerate(loops) if loop.has_centre}
        self.joints: dict[int, set[JointId]] = {i: set(loops[i].joints) for i in self.members}
        self._heir: dict[int, int] = {}

    def root(self, loop: int) -> int:
        """Return the root of the class that a loop is in now."""
        heir, passed = self._heir, []
        while loop in heir:
            passed.append(loop)
            loop = heir[loop]
        for one in passed:
            heir[one] = loop
        return loop

    def merge_named(self) -> None:
        """Merge the loops that name one centre."""
        named: dict[str, int] = {}
        for i in list(self.members):
            name = self.loops[i].at
            if name is not None:
                self.union(named.setdefault(name, i), i)

    def merge_planar(self) -> None:
        """Merge loops with a centre at infinity that share a joint: an axis holds one such point."""
        owner: dict[JointId, int] = {}
        for i, loop in enumerate(self.loops):
            if loop.centre is Centre.INFINITE:
                for joint in loop.joints:
                    self.union(owner.setdefault(joint, i), i)

    def union(self, a: int, b: int) -> None:
        """Make one class of those of two loops; the one with fewer joints is poured into the other."""
        a, b = self.root(a), self.root(b)
        if a == b:
            return
        if self.centre(a) is not self.centre(b):
            self._refuse(a, b)
        heir, gone = (a, b) if len(self.joints[a]) >= len(self.joints[b]) else (b, a)
        self._heir[gone] = heir
        self.members[heir] += self.members.pop(gone)
        self.joints[heir] |= self.joints.pop(gone)

    def centre(self, root: int) -> Centre:
        """Return the kind of centre of a class."""
        return self.loops[root].centre

    def check_kinds(self) -> None:
        """Refuse a finite and an infinite class that share two joints, once no more can be merged."""
        planar = {joint: root for root in self.members if not self._is_finite(root) for joint in self.joints[root]}
        for root in filter(self._is_finite, self.members):
            for other, number in Counter(planar[joint] for joint in self.joints[root] if joint in planar).items():
                if number > 1:
                    self._refuse(*sorted((root, other)))

    def _is_finite(self, root: int) -> bool:
        return self.centre(root) is Centre.FINITE

    def _refuse(self, one: int, other: int) -> None:
        a, b = self.loops[self.members[one][0]], self.loops[self.members[other][0]]
        common = sorted(map(str, self.joints[one] & self.joints[other]))
        because = f"share joints {shown(' '.join(common))}" if common else f"name centre {shown(a.at)}"
        raise InvariantError(
            "centre classes",
            f"{a.label} ({a.centre.value}) and {b.label} ({b.centre.value}) {because}",
            "one kind of centre, since they have one centre",
        )


class _TwoInCommon:
    """Finds classes with a finite centre that share two joints, while classes merge.

    Only joints of several classes count, and only classes with two such joints. Two joints that few classes pass
    are found by pairs of classes with what they share. A crowded joint has a table from every other joint to the
    class that holds both: a second class that would take this place shares the two joints with the first.
    """

    def __init__(self, merger: Merger) -> None:
        self.merger = merger
        self.work: list[tuple[int, int]] = []
        self.shared: dict[int, dict[int, set[JointId]]] = defaultdict(dict)
        self.holder: dict[JointId, dict[JointId, int]] = {}
        finite = {root: merger.joints[root] for root in merger.members if merger.centre(root) is Centre.FINITE}
        for _ in range(2):  # without the classes that cannot merge, some of the joints are no longer shared
            number = Counter(joint for joints in finite.values() for joint in joints)
            finite = {root: {joint for joint in joints if number[joint] > 1} for root, joints in finite.items()}
            finite = {root: joints for root, joints in finite.items() if len(joints) > 1}
        self.joints = finite
        self.crowded: dict[int, set[JointId]] = defaultdict(set)

    def close(self) -> None:
        """Merge until no two classes share two joints."""
        self._look_at_all()
        while self.work:
            a, b = map(self.merger.root, self.work.pop())
            if a != b:
                self._merge(a, b)

    def _look_at_all(self) -> None:
        at_joint: dict[JointId, list[int]] = defaultdict(list)
        for root, joints in self.joints.items():
            for joint in joints:
                at_joint[joint].append(root)
        for joint, here in at_joint.items():
            if len(here) > FEW:
                self.holder[joint] = {}
                for root in here:
                    self.crowded[root].add(joint)
                continue
            for a, b in permutations(here, 2):
                self._share(a, b, {joint})
        for root, crowded in self.crowded.items():
            self._enter(crowded, root, self.joints[root])

    def _share(self, a: int, b: int, joints: set[JointId]) -> None:
        """Note joints that two classes share, for the first of them."""
        common = self.shared[a].setdefault(b, set())
        common |= joints
        if len(common) > 1:
            self.work.append((a, b))

    def _enter(self, crowded: Iterable[JointId], root: int, joints: Iterable[JointId]) -> None:
        """Enter a class as the one that holds crowded joints and others."""
        for joint in crowded:
            holder = self.holder[joint]
            for other in joints:
                if other != joint:
                    before = holder.setdefault(other, root)
                    if before != root and self.merger.root(before) != self.merger.root(root):
                        self.work.append((before, root))

    def _merge(self, a: int, b: int) -> None:
        self.merger.union(a, b)
        heir = self.merger.root(a)
        gone = b if heir == a else a
        more, fewer = self.crowded[gone] - self.crowded[heir], self.crowded[heir] - self.crowded[gone]
        self._enter(more, heir, self.joints[heir])
        self._enter(fewer, heir, self.joints[gone])
        self.crowded[heir] |= self.crowded.pop(gone)
        self.joints[heir] |= self.joints.pop(gone)
        for other, common in self.shared.pop(gone, {}).items():
            del self.shared[other][gone]
            if other != heir:
                self._share(heir, other, common)
                self._share(other, heir, common)


@dataclass(frozen=True, slots=True)
class CentreClass:
    """Loops with one centre.

    Attributes
    ----------
    loops : tuple of int
        Indices of the loops, ascending.
    joints : frozenset of joint ids
        Every joint whose axis passes through the centre.
    centre : Centre
        ``FINITE`` or ``INFINITE``.

    Examples
    --------
    >>> centre_classes([Loop((0, 1, 2)), Loop((1, 2, 3))])[0].loops
    (0, 1)
    """

    loops: tuple[int, ...]
    joints: frozenset[JointId]
    centre: Centre


def centre_classes(loops: Sequence[Loop]) -> tuple[CentreClass, ...]:
    """Return the most general assignment of centres to loops: as few coincidences as the joints force.

    Parameters
    ----------
    loops : sequence of Loop
        Loops without a centre are in no class; classes are in the order of their first loop.

    Raises
    ------
    InvariantError
        If a finite and an infinite centre would have to be one.

    Examples
    --------
    >>> len(centre_classes([Loop((0, 1, 2, 3)), Loop((3, 4, 5, 6))]))  # Watt's chain: two loops share a joint
    2
    """
    if _nothing_forced(loops):
        return tuple(
            CentreClass((i,), frozenset(loop.joints), loop.centre) for i, loop in enumerate(loops) if loop.has_centre
        )
    merged = Merger(loops)
    merged.merge_named()
    merged.merge_planar()
    _TwoInCommon(merged).close()
    merged.check_kinds()
    members = merged.members
    order = sorted(members, key=lambda root: min(members[root]))
    return tuple(
        CentreClass(tuple(sorted(members[root])), frozenset(merged.joints[root]), loops[min(members[root])].centre)
        for root in order
    )


def _nothing_forced(loops: Sequence[Loop]) -> bool:
    """Whether no two loops share more than a joint, and none is planar or named: so it is on most sheets.

    The search ends early, with no, where a joint has many loops, since pairs of them are looked at one by one.
    """
    through: dict[JointId, list[int]] = {}
    pairs: set[int] = set()  # of two loops other < i: i * number of loops + other
    for i, loop in enumerate(loops):
        if not loop.has_centre:
            continue
        if loop.at is not None or loop.centre is Centre.INFINITE:
            return False
        for joint in loop.joints:
            others = through.setdefault(joint, [])
            for other in others:
                pair = i * len(loops) + other
                if pair in pairs:
                    return False
                pairs.add(pair)
            others.append(i)
            if len(others) > FEW:
                return False
    return True
