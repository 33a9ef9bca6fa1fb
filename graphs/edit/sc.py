"""Edits of SC graphs, each with the change of mobility that the relative equations predict.

An edit returns a new graph; nothing is changed in place. Source: Wiener 2016, sections 4.2 and 6.3.2, Eqs. 5 and
6. Edits that keep the sides of the links are in :mod:`graphs.edit.scd`. Theory: docs/theory/edits.md.
"""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from graphs.count.equations import relative_cgk, relative_spherical_system
from graphs.count.report import mobility_report
from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.loops.loop import Centre, Loop, cut_into_cycles, dependent_loop
from graphs.mechanism.sc import SCGraph
from graphs.types import JointId, LinkId

__all__ = ["Edit", "add_crease", "add_loop", "add_ride_along", "fresh", "lock_joint"]


@dataclass(frozen=True, slots=True)
class Edit:
    """A mechanism before and after an edit.

    Attributes
    ----------
    what : str
        The edit in words.
    before, graph : SCGraph
        The mechanism before and after.
    predicted : int
        The change of mobility that the relative equation gives for the parts added and taken away.
    equation : str
        That equation.

    Examples
    --------
    >>> edit = lock_joint(SCGraph(3, [(0, 1), (1, 2)]), 0)
    >>> edit.what, edit.predicted, edit.counted, edit.equation
    ('lock joint 0', -1, -1, 'Eq. 6')
    """

    what: str
    before: SCGraph
    graph: SCGraph
    predicted: int
    equation: str

    @property
    def counted(self) -> int:
        """The change of mobility as the difference of the two counts."""
        after, before = mobility_report(self.graph).mobility, mobility_report(self.before).mobility
        assert after is not None
        assert before is not None
        return after - before

    def to_json(self) -> dict[str, Any]:
        """Return the edit as plain data."""
        return {
            "what": self.what,
            "equation": self.equation,
            "predicted": self.predicted,
            "counted": self.counted,
            "links": len(self.graph),
            "joints": len(self.graph.joints),
            "mobility": mobility_report(self.graph).mobility,
        }


def fresh(taken: Iterable[Hashable], number: int) -> list[int]:
    """Return new integer ids whose text is not taken.

    >>> fresh([0, 1, "2"], 2)
    [3, 4]
    """
    texts = {str(name) for name in taken}
    start = len(texts)
    found: list[int] = []
    while len(found) < number:
        if str(start) not in texts:
            found.append(start)
        start += 1
    return found


def add_loop(
    sc: SCGraph,
    a: LinkId,
    b: LinkId,
    links: int,
    *,
    centre: Centre | str = Centre.FINITE,
    through: Sequence[JointId] | None = None,
) -> Edit:
    """Append a chain of new links between two links, and so close a loop.

    Parameters
    ----------
    sc : SCGraph
    a, b : link ids
        Different links.
    links : int
        Number of new links, 0 for a joint only.
    centre : Centre, optional
        Of the new loop; ``"none"`` for a spatial one.
    through : sequence of joint ids, optional
        The rest of the loop, a path from a to b; by default the joint between them.

    Returns
    -------
    Edit
        dM = 3 k - 2 (k + 1) for k links and a loop with a centre (Eq. 6), k - 5 for a spatial one (Eq. 5).

    Raises
    ------
    InvariantError
        If a or b is no link, or the loop is no cycle.
    UnsolvableError
        If a and b are not joined by one joint and ``through`` is not given.

    Examples
    --------
    Wiener 4.2.5.1: three links and four joints add one freedom.

    >>> ring = SCGraph(6, [(i, (i + 1) % 6) for i in range(6)], [Loop(range(6))])
    >>> edit = add_loop(ring, 0, 1, 3)
    >>> edit.predicted, edit.counted
    (1, 1)
    """
    _check_links(sc, a, b)
    if links < 0:
        raise InvariantError("chain of links", f"a chain of {links} links", "0 or more")
    if through is None:
        between = list(sc[a][b]) if sc.has_edge(a, b) else []
        if len(between) != 1:
            raise UnsolvableError(
                f"links {shown(a)} and {shown(b)} have {len(between)} joints between them: say which joints the "
                "new loop goes through"
            )
        through = between
    new_links = fresh(sc.nodes, links)
    new_joints = fresh(sc.joints, links + 1)
    chain = [a, *new_links, b]
    joints = dict(sc.joints) | {joint: (chain[i], chain[i + 1]) for i, joint in enumerate(new_joints)}
    loop = Loop((*through, *new_joints), Centre(centre))
    spatial = loop.centre is Centre.NONE
    predicted = relative_cgk(links, links + 1, 6) if spatial else relative_spherical_system(links, links + 1)
    graph = SCGraph([*sc.nodes, *new_links], joints, [*sc.loops, loop], closing=sc.closing, ground=sc.ground)
    kind = "spatial" if spatial else "spherical" if loop.centre is Centre.FINITE else "planar"
    what = f"{kind} loop of {links} new link(s) between {shown(a)} and {shown(b)}"
    return Edit(what, sc, graph, predicted, "Eq. 5" if spatial else "Eq. 6")


def add_ride_along(sc: SCGraph, a: LinkId, b: LinkId) -> Edit:
    """Append a ride-along to two adjacent links: two links, three joints, one finite centre, dM = 0.

    Parameters
    ----------
    sc : SCGraph
    a, b : link ids
        Links with one joint between them.

    Returns
    -------
    Edit

    Raises
    ------
    InvariantError, UnsolvableError
        As :func:`add_loop`.

    Examples
    --------
    >>> ring = SCGraph(4, [(i, (i + 1) % 4) for i in range(4)], [Loop(range(4))])
    >>> edit = add_ride_along(ring, 0, 1)
    >>> edit.predicted, edit.counted, len(edit.graph)
    (0, 0, 6)
    """
    edit = add_loop(sc, a, b, 2)
    return replace(edit, what=f"ride-along on {shown(a)} and {shown(b)}")


def add_crease(sc: SCGraph, link: LinkId, moved: Collection[JointId]) -> Edit:
    """Crease a link: part of its joints goes to a new link, which a new joint joins to the old one. dM = 1.

    Parameters
    ----------
    sc : SCGraph
    link : link id
    moved : collection of joint ids
        The joints of the link that lie beyond the crease; none for a flap.

    Returns
    -------
    Edit
        A loop with a joint on either side of the crease passes the crease too.

    Raises
    ------
    InvariantError
        If ``link`` is no link, or a joint to move is not at it.

    Examples
    --------
    >>> ring = SCGraph(4, [(i, (i + 1) % 4) for i in range(4)], [Loop(range(4))])
    >>> edit = add_crease(ring, 0, [3])
    >>> edit.predicted, edit.counted, edit.graph.loops[0].joints
    (1, 1, (0, 1, 2, 3, 4))
    """
    _check_links(sc, link)
    beyond = set(moved)
    for joint in moved:
        if joint not in sc.joints or link not in sc.joints[joint]:
            raise InvariantError(
                "crease", f"joint {shown(joint)} is not at link {shown(link)}", "one of its joints"
            )
    (half,) = fresh(sc.nodes, 1)
    (crease,) = fresh(sc.joints, 1)
    joints = {
        joint: tuple(half if end == link and joint in beyond else end for end in ends)
        for joint, ends in sc.joints.items()
    }
    at_link = {joint for joint, ends in sc.joints.items() if link in ends}

    def creased(loop: Loop) -> Loop:
        here = at_link.intersection(loop.joints)
        parted = bool(here & beyond) and bool(here - beyond)
        return replace(loop, joints=(*loop.joints, crease)) if parted else loop

    graph = SCGraph(
        [*sc.nodes, half],
        {**{joint: (ends[0], ends[1]) for joint, ends in joints.items()}, crease: (link, half)},
        map(creased, sc.loops),
        closing=map(creased, sc.closing),
        ground=sc.ground,
    )
    return Edit(f"crease in {shown(link)}", sc, graph, relative_spherical_system(1, 1), "Eq. 6")


def lock_joint(sc: SCGraph, joint: JointId) -> Edit:
    """Lock a joint: its two links become one, the first. dM = -1 (thesis 6.3.2).

    Parameters
    ----------
    sc : SCGraph
    joint : joint id

    Returns
    -------
    Edit

    Raises
    ------
    InvariantError
        If there is no such joint.
    UnsolvableError
        If other joints join the same two links: they would join the link to itself.

    Examples
    --------
    >>> ring = SCGraph(5, [(i, (i + 1) % 5) for i in range(5)], [Loop(range(5))])
    >>> edit = lock_joint(ring, 0)
    >>> edit.predicted, edit.counted, len(edit.graph)
    (-1, -1, 4)
    """
    if joint not in sc.joints:
        raise InvariantError("lock", f"{shown(joint)} is no joint", "one of the joints")
    kept, gone = sc.joints[joint]
    beside = [other for other in sc[kept][gone] if other != joint]
    if beside:
        raise UnsolvableError(f"joint {shown(beside[0])} joins the same two links as joint {shown(joint)}")
    joints = {
        other: (kept if a == gone else a, kept if b == gone else b)
        for other, (a, b) in sc.joints.items()
        if other != joint
    }
    loops = _contracted(sc.loops, joint, joints)
    closing = [
        loop
        for loop in _contracted(sc.closing, joint, joints)
        if not any(set(loop.joints) == set(other.joints) for other in loops)
    ]
    graph = SCGraph(
        [link for link in sc.nodes if link != gone],
        joints,
        loops,
        closing=closing,
        ground=kept if sc.ground == gone else sc.ground,
    )
    return Edit(f"lock joint {shown(joint)}", sc, graph, relative_spherical_system(-1, -1), "Eq. 6")


def _contracted(loops: Sequence[Loop], joint: JointId, joints: dict[JointId, tuple[LinkId, LinkId]]) -> list[Loop]:
    """Take a joint out of loops; of a loop that then passes a link twice keep a part independent of the rest."""
    result = [tuple(other for other in loop.joints if other != joint) for loop in loops]
    for i, around in enumerate(result):
        parts = cut_into_cycles(around, joints)
        if len(parts) > 1:
            rest = [other for k, other in enumerate(result) if k != i]
            result[i] = next(part for part in parts if dependent_loop([*rest, part]) is None)
    return [replace(loop, joints=around) for loop, around in zip(loops, result, strict=True)]


def _check_links(sc: SCGraph, *links: LinkId) -> None:
    for link in links:
        if link not in sc:
            raise InvariantError("edit", f"{shown(link)} is no link", "one of the links")
    if len(set(links)) < len(links):
        raise InvariantError("edit", f"link {shown(links[0])} is named twice", "two different links")
