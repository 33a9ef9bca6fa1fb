"""Loops of a mechanism: what a loop is, and that it is a cycle.

A *loop* is a cycle of links and joints. Where all its joint axes pass through one point, that point is its
*spherical centre*; it is at infinity for a planar loop (parallel axes) and absent for a spatial one
(Wiener 2016, sections 3.3.1 to 3.3.3). Theory: docs/theory/sc-graphs.md.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

from graphs.errors import InvariantError, shown
from graphs.ids import JointId, Joints, LinkId

__all__ = [
    "Centre",
    "Loop",
    "cyclic_order",
]


class Centre(Enum):
    """Where the joint axes of a loop meet.

    Attributes
    ----------
    FINITE
        In one point: a spherical loop.
    INFINITE
        At infinity: parallel axes, a planar loop.
    NONE
        Nowhere: a spatial loop.

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
        Name of the centre. Loops that give the same ``at`` share one centre although nothing forces them to
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
            raise InvariantError(
                "centre", f"{self.label} has no centre but names one, {shown(self.at)}", "no 'at'"
            )

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

    A set of joints that is a cycle has one cyclic order up to start and direction. The joint given first
    stays first, and the direction is that of the given order where the given order is cyclic.

    Parameters
    ----------
    loop : Loop
        A loop; its joints may come in any order.
    joints : mapping of joint id to (link, link)
        The joints of the graph.

    Returns
    -------
    tuple of joint ids

    Raises
    ------
    InvariantError
        If a joint is unknown or repeated, or the joints are not one cycle.

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
        raise InvariantError("loop is a cycle", f"{loop.label} has {len(seen)} joint(s)", "at least two")
    for link, here in at_link.items():
        if len(here) != 2:
            raise InvariantError(
                "loop is a cycle", f"{loop.label} meets link {shown(link)} in {len(here)} joint(s)", "two"
            )
    order = _walk(loop.joints, at_link, joints)
    if len(order) != len(seen):
        raise InvariantError(
            "loop is a cycle", f"{loop.label} falls apart: {len(order)} of {len(seen)} joints hang together"
        )
    return order


def _is_cyclic(around: Sequence[JointId], joints: Joints) -> bool:
    """Whether joints are one cycle in the order given: the common case, told without a dictionary of links."""
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


def _walk(
    given: Sequence[JointId], at_link: Mapping[LinkId, list[JointId]], joints: Joints
) -> tuple[JointId, ...]:
    """Follow a 2-regular set of joints from the one given first."""
    first = given[0]
    start, link = joints[first]
    if given[1] in at_link[start] and given[1] not in at_link[link]:
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
