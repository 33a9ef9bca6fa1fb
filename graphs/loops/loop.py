"""Loops of a mechanism, and cycles over GF(2): independence, sums, and signs of the joints that a cycle passes.

A *loop* is a cycle of links and joints. Where all its joint axes pass through one point, that point is its
*spherical centre*; it is at infinity for a planar loop (parallel axes) and absent for a spatial one (Wiener 2016,
sections 3.3.1 to 3.3.3). A cycle is a set of joints; the sum of two is the joints in just one of them. Rows of
bits stand for cycles. Theory: docs/theory/sc-graphs.md.
"""

from collections import Counter, defaultdict
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

from graphs.errors import InvariantError, numbered, shown
from graphs.types import JointId, Joints, LinkId


class Centre(Enum):
    """Where the joint axes of a loop meet.

    Attributes
    ----------
    FINITE, INFINITE, NONE
        In one point (spherical loop), at infinity (parallel axes, planar loop), nowhere (spatial loop).

    Examples
    --------
    >>> Loop((0, 1, 2), "infinite").centre is Centre.INFINITE
    True
    """

    FINITE = "finite"
    INFINITE = "infinite"
    NONE = "none"


@dataclass(frozen=True, slots=True)
class Loop:
    """A cycle of joints, with its centre.

    Parameters
    ----------
    joints : tuple of joint ids
        The joints of the cycle, each once. An SC graph stores them in cyclic order.
    centre : Centre or {"finite", "infinite", "none"}
        Where their axes meet.
    name : str, optional
        A name for the loop.
    at : str, optional
        Name of the centre. Loops that have the same ``at`` share one centre although nothing forces them to
        (a *specialised* mechanism: the spherical analogue of Watt's chain, say). Leave it out for the most
        general mechanism.

    Examples
    --------
    >>> Loop(("a", "b", "c", "d")).centre
    <Centre.FINITE: 'finite'>
    """

    joints: tuple[JointId, ...]
    centre: Centre = Centre.FINITE
    name: str | None = None
    at: str | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "joints", tuple(self.joints))
        if not isinstance(self.centre, Centre):
            try:
                object.__setattr__(self, "centre", Centre(self.centre))
            except ValueError:
                raise InvariantError(
                    "centre", f"{self.label} has the centre {shown(self.centre)}", "finite, infinite or none"
                ) from None
        if self.at is not None and self.centre is Centre.NONE:
            raise InvariantError("centre", f"{self.label} has no centre but names one, {shown(self.at)}", "no 'at'")

    @property
    def has_centre(self) -> bool:
        """Whether the loop is spherical or planar, and so constrains 3 freedoms and not 6."""
        return self.centre is not Centre.NONE

    @property
    def label(self) -> str:
        """Return the name of the loop for messages: its own, or its joints."""
        if self.name is not None:
            return f"loop {shown(self.name)}"
        return "loop " + shown(" ".join(str(j) for j in self.joints[:12]))


def cyclic_order(loop: Loop, joints: Joints) -> tuple[JointId, ...]:
    """Return the joints of a loop in cyclic order; refuse what is not one cycle.

    The first joint stays first, and the direction is kept where the joints are in cyclic order already.

    Parameters
    ----------
    loop : Loop
        Its joints may come in any order; `InvariantError` if one is unknown or repeated, or they are not one
        cycle.
    joints : mapping of joint id to (link, link)
        The joints of the graph.

    Examples
    --------
    >>> square = {"a": (0, 1), "b": (1, 2), "c": (2, 3), "d": (3, 0)}
    >>> cyclic_order(Loop(("a", "c", "b", "d")), square)
    ('a', 'b', 'c', 'd')
    """
    if _is_cyclic(loop.joints, joints):
        return loop.joints
    at_link: dict[LinkId, list[JointId]] = defaultdict(list)
    seen: set[JointId] = set()
    for joint in loop.joints:
        if joint not in joints:
            raise InvariantError("loop is a cycle", f"{loop.label} names {shown(joint)}, which is no joint")
        if joint in seen:
            raise InvariantError("loop is a cycle", f"{loop.label} passes joint {shown(joint)} twice", "once")
        seen.add(joint)
        for link in joints[joint]:
            at_link[link].append(joint)
    if len(seen) < 2:
        raise InvariantError("loop is a cycle", f"{loop.label} has {numbered(len(seen), 'joint')}", "at least two")
    for link, here in at_link.items():
        if len(here) != 2:
            raise InvariantError(
                "loop is a cycle", f"{loop.label} meets link {shown(link)} in {numbered(len(here), 'joint')}", "two"
            )
    order = _walk(loop.joints, at_link, joints)
    if len(order) != len(seen):
        raise InvariantError(
            "loop is a cycle", f"{loop.label} falls apart: {len(order)} of {len(seen)} joints hang together"
        )
    return order


def _is_cyclic(around: Sequence[JointId], joints: Joints) -> bool:
    """Return whether joints are one cycle in their order: the common case, found without a dictionary of links."""
    if len(around) < 3 or any(joint not in joints for joint in around):
        return False
    a, b = joints[around[-1]]
    start = b if b in joints[around[0]] else a
    link, met = start, set()
    for joint in around:
        a, b = joints[joint]
        if link == a:
            link = b
        elif link == b:
            link = a
        else:
            return False
        met.add(link)
    return link == start and len(met) == len(around)


def _walk(around: Sequence[JointId], at_link: Mapping[LinkId, list[JointId]], joints: Joints) -> tuple[JointId, ...]:
    """Follow a 2-regular set of joints from the first."""
    first = around[0]
    start, link = joints[first]
    if around[1] in at_link[start] and around[1] not in at_link[link]:
        link = start
    order = [first]
    while True:
        here = at_link[link]
        following = here[1] if here[0] == order[-1] else here[0]
        if following == first:
            return tuple(order)
        order.append(following)
        a, b = joints[following]
        link = b if a == link else a


def dependent_loop(cycles: Sequence[Sequence[JointId]]) -> int | None:
    """Return the index of a cycle that is a GF(2) sum of others, or None if they are independent.

    Cycles that own a joint no other has are peeled off first, again and again; this settles the bounded faces of
    an embedding in linear time. Only what is left is eliminated.
    """
    rest = _peel(cycles)
    if not rest:
        return None
    cover = Counter(joint for index in rest for joint in cycles[index])
    if set(cover.values()) == {2}:
        return rest[-1]  # a closed surface: the sum of all that is left vanishes
    independent = _are_independent([cycles[i] for i in rest])
    return next((index for index, one in zip(rest, independent, strict=True) if not one), None)


def split_dependent(cycles: Sequence[Sequence[JointId]]) -> tuple[list[int], list[int]]:
    """Split cycles into independent ones and ones that depend on these; return the indices of both, ascending.

    Round the vertices of a closed surface the last cycle is the sum of the others.
    """
    kept, dependent = list(range(len(cycles))), []
    while (index := dependent_loop([cycles[i] for i in kept])) is not None:
        dependent.append(kept.pop(index))
    return kept, sorted(dependent)


def added_independent(cycles: Sequence[Collection[JointId]], candidates: Sequence[Collection[JointId]]) -> list[int]:
    """Return the indices of the candidates, ascending, that are no GF(2) sum of the cycles and earlier candidates.

    The cycles may depend on each other.
    """
    independent = list(_are_independent([*cycles, *candidates]))
    return [index for index, one in enumerate(independent[len(cycles) :]) if one]


def in_span_of(cycle: Collection[JointId], cycles: Sequence[Collection[JointId]]) -> tuple[int, ...] | None:
    """Return the indices of cycles that sum to a cycle over GF(2), ascending, or None if it is no such sum.

    The cycles may depend on each other: then the sum is one of several.
    """
    *rows, target = _bit_rows([*cycles, cycle])
    shift = max(row.bit_length() for row in (*rows, target))
    # The low bits hold the cycle, the bits above them which cycles have been added.
    basis: dict[int, int] = {}

    def reduced(row: int) -> int:
        while low := row & ((1 << shift) - 1):
            pivot = basis.get(low.bit_length())
            if pivot is None:
                return row
            row ^= pivot
        return row

    for index, row in enumerate(rows):
        left = reduced(row | 1 << (shift + index))
        if low := left & ((1 << shift) - 1):
            basis[low.bit_length()] = left
    left = reduced(target)
    if left & ((1 << shift) - 1):
        return None
    used = left >> shift
    return tuple(index for index in range(len(rows)) if used >> index & 1)


def cut_into_cycles(even: Collection[JointId], joints: Joints) -> list[tuple[JointId, ...]]:
    """Cut joints that meet every link an even number of times into cycles, each in cyclic order."""
    at_link: dict[LinkId, list[JointId]] = defaultdict(list)
    for joint in even:
        for link in joints[joint]:
            at_link[link].append(joint)
    left, cycles = dict.fromkeys(even), []
    while left:
        link = joints[next(iter(left))][0]
        order: list[tuple[LinkId, JointId]] = []
        entered: dict[LinkId, int] = {}
        while link not in entered:
            entered[link] = len(order)
            came = order[-1][1] if order else None
            joint = next(j for j in at_link[link] if j in left and (came is None or j != came))
            order.append((link, joint))
            a, b = joints[joint]
            link = b if a == link else a
        cycles.append(tuple(joint for _, joint in order[entered[link] :]))
        for joint in cycles[-1]:
            del left[joint]
    return cycles


def signed_cycle(cycle: Sequence[JointId], joints: Joints) -> Iterator[tuple[JointId, int]]:
    """Yield the joints of a cycle with 1 where it passes from a joint's first link to the second, else -1.

    The cycle is in cyclic order, as an SC graph stores its loops.
    """
    a, b = joints[cycle[0]]
    link = a if b in joints[cycle[1]] else b
    for joint in cycle:
        first, second = joints[joint]
        if link == first:
            yield joint, 1
            link = second
        else:
            yield joint, -1
            link = first


def _peel(cycles: Sequence[Sequence[JointId]]) -> list[int]:
    """Return the indices of the cycles left when those with a joint of their own are taken off, repeatedly.

    For each joint, how many cycles pass it and the exclusive or of their indices: where one is left, that is it.
    """
    number: dict[JointId, int] = {}
    mixed: dict[JointId, int] = {}
    for index, cycle in enumerate(cycles):
        for joint in cycle:
            number[joint] = number.get(joint, 0) + 1
            mixed[joint] = mixed.get(joint, 0) ^ index
    left = [True] * len(cycles)
    work = [mixed[joint] for joint, count in number.items() if count == 1]
    while work:
        index = work.pop()
        if not left[index]:
            continue
        left[index] = False
        for joint in cycles[index]:
            number[joint] -= 1
            mixed[joint] ^= index
            if number[joint] == 1:
                work.append(mixed[joint])
    return [index for index, there in enumerate(left) if there]


def _bit_rows(cycles: Sequence[Collection[JointId]]) -> list[int]:
    """Write cycles as integers, one bit a joint."""
    place: dict[JointId, int] = {}
    return [sum(1 << place.setdefault(joint, len(place)) for joint in cycle) for cycle in cycles]


def _are_independent(cycles: Sequence[Collection[JointId]]) -> Iterator[bool]:
    """Yield for each cycle whether it is no GF(2) sum of those before it."""
    basis: dict[int, int] = {}  # by leading bit; a row is reduced until its own is new, or nothing is left
    for left in _bit_rows(cycles):
        while pivot := basis.get(left.bit_length()):
            left ^= pivot  # noqa: PLW2901 - one step of the reduction
        if left:
            basis[left.bit_length()] = left
        yield left > 0
