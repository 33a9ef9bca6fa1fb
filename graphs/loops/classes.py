"""Centre classes: which loops of a mechanism share their centre.

Two distinct axes cannot both join two distinct points, so two loops that share two joints have one centre
(Wiener 2016, section 3.3.5). The rule is applied to *classes* of loops, not only to loops, until nothing
changes: two classes that share two joints between them are one class though no two of their loops do.
An axis holds one point at infinity only, so two planar loops that share a single joint are one class too.
Theory: docs/theory/centre-classes.md.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import permutations

from graphs.errors import InvariantError, shown
from graphs.ids import JointId
from graphs.loops.loop import Centre, Loop

__all__ = ["CentreClass", "centre_classes", "class_of_loop"]


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
    """

    loops: tuple[int, ...]
    joints: frozenset[JointId]
    centre: Centre


def centre_classes(loops: Sequence[Loop]) -> tuple[CentreClass, ...]:
    """Return the most general assignment of centres to loops: as few coincidences as the joints force.

    Parameters
    ----------
    loops : sequence of Loop
        Loops without a centre are in no class.

    Returns
    -------
    tuple of CentreClass
        Ordered by their first loop.

    Raises
    ------
    InvariantError
        If a finite and an infinite centre would have to be one.

    Examples
    --------
    Watt's chain: two four-bars with one joint in common. Stephenson's: they share two.

    >>> len(centre_classes([Loop((0, 1, 2, 3)), Loop((3, 4, 5, 6))]))
    2
    >>> len(centre_classes([Loop((0, 1, 2, 3)), Loop((2, 3, 4, 5, 6))]))
    1
    """
    if _nothing_forced(loops):
        return tuple(
            CentreClass((i,), frozenset(loop.joints), loop.centre)
            for i, loop in enumerate(loops)
            if loop.has_centre
        )
    merger = _Merger(loops)
    merger.merge_named()
    merger.close()
    members = merger.members
    order = sorted(members, key=lambda root: min(members[root]))
    return tuple(
        CentreClass(tuple(sorted(members[root])), frozenset(merger.joints[root]), loops[min(members[root])].centre)
        for root in order
    )


def class_of_loop(classes: Sequence[CentreClass]) -> dict[int, int]:
    """Return the index of the class of each loop that has one.

    Examples
    --------
    >>> class_of_loop(centre_classes([Loop((0, 1, 2), "none"), Loop((2, 3, 4))]))
    {1: 0}
    """
    return {loop: index for index, one in enumerate(classes) for loop in one.loops}


def _nothing_forced(loops: Sequence[Loop]) -> bool:
    """Whether no two loops share more than a joint, and none is planar or named: so it is on most sheets."""
    through: dict[JointId, list[int]] = {}
    pairs: set[tuple[int, int]] = set()
    for i, loop in enumerate(loops):
        if not loop.has_centre:
            continue
        if loop.at is not None or loop.centre is Centre.INFINITE:
            return False
        for joint in loop.joints:
            others = through.setdefault(joint, [])
            for other in others:
                if (other, i) in pairs:
                    return False
                pairs.add((other, i))
            others.append(i)
    return True


class _Merger:
    """Union of loops into classes, with the joints that two classes share kept up to date."""

    def __init__(self, loops: Sequence[Loop]) -> None:
        self.loops = loops
        self.members = {i: [i] for i, loop in enumerate(loops) if loop.has_centre}
        self.joints: dict[int, set[JointId]] = {i: set(loops[i].joints) for i in self.members}

    def merge_named(self) -> None:
        """Merge the loops that name one centre."""
        named: dict[str, int] = {}
        for i in list(self.members):
            name = self.loops[i].at
            if name is not None and named.setdefault(name, i) != i:
                self._union(named[name], i)

    def close(self) -> None:
        """Merge classes that share enough joints, until no two do."""
        at_joint: dict[JointId, list[int]] = defaultdict(list)
        for root, joints in self.joints.items():
            for joint in joints:
                at_joint[joint].append(root)
        shared: dict[int, dict[int, set[JointId]]] = defaultdict(lambda: defaultdict(set))
        for joint, here in at_joint.items():
            for a, b in permutations(here, 2):
                shared[a][b].add(joint)
        work = [(a, b) for a, row in shared.items() for b in row if a < b and self._forced(a, b, row[b])]
        while work:
            a, b = work.pop()
            if a not in self.members or b not in self.members:
                continue  # one of them has been merged since; its heir was queued anew
            gone, heir = (a, b) if len(shared[a]) <= len(shared[b]) else (b, a)
            self._union(heir, gone)
            for c, common in shared.pop(gone).items():
                del shared[c][gone]
                if c == heir:
                    continue
                shared[heir][c] |= common
                shared[c][heir] |= common
                if self._forced(heir, c, shared[heir][c]):
                    work.append((heir, c))

    def _forced(self, a: int, b: int, shared: set[JointId]) -> bool:
        both_infinite = self._centre(a) is Centre.INFINITE and self._centre(b) is Centre.INFINITE
        return len(shared) >= (1 if both_infinite else 2)

    def _centre(self, root: int) -> Centre:
        return self.loops[self.members[root][0]].centre

    def _union(self, heir: int, gone: int) -> int:
        if self._centre(heir) is not self._centre(gone):
            a, b = self.loops[self.members[heir][0]], self.loops[self.members[gone][0]]
            common = sorted(map(str, self.joints[heir] & self.joints[gone]))
            because = f"share joints {shown(' '.join(common))}" if common else f"name centre {shown(a.at)}"
            raise InvariantError(
                "centre classes",
                f"{a.label} ({a.centre.value}) and {b.label} ({b.centre.value}) {because}",
                "one kind of centre, since they have one centre",
            )
        self.members[heir] += self.members.pop(gone)
        self.joints[heir] |= self.joints.pop(gone)
        return heir
