"""Assur groups: the smallest sets of links that can be positioned together, one set after the other.

Each moving link of a spherical or planar mechanism has three freedoms and each joint takes two (an input all
three): as many as there are. Every such freedom is assigned to one of the two links it ties, so that each link
pays for three; a link then depends on the others its freedoms are tied to, and the strong components of these
dependencies are the Assur groups, whatever the assignment (Dulmage and Mendelsohn 1958). Theory:
docs/theory/reduction.md.
"""

from collections import deque
from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import networkx as nx

from graphs.convert.link_joint import sc_from_link_joint_graph
from graphs.count.applicability import mechanism_class
from graphs.count.equations import loop_form
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.mechanism.sc import SCGraph
from graphs.printing import Block, Printed, plain
from graphs.types import JointId, LinkId


@dataclass(frozen=True, slots=True)
class AssurGroup:
    """Links that are positioned together.

    Attributes
    ----------
    links : tuple of link ids
    joints : tuple of joint ids
        Joints between them, and to the ground link or earlier groups.
    inputs : tuple of joint ids
        Those of the joints that are inputs.

    Examples
    --------
    >>> AssurGroup(links=(2, 3), joints=(1, 2, 3), inputs=()).links
    (2, 3)
    """

    links: tuple[LinkId, ...]
    joints: tuple[JointId, ...]
    inputs: tuple[JointId, ...]


@dataclass(frozen=True, slots=True)
class AssurReduction(Printed):
    """A mechanism without the Assur groups that no other depends on.

    Attributes
    ----------
    before, graph : SCGraph
    groups : tuple of AssurGroup
        All groups, each after those it depends on.
    removed : tuple of AssurGroup
        In the order in which they were taken off.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> reduction = reduce_assur(ring, 0, [0])
    >>> len(reduction.groups), len(reduction.graph)
    (2, 2)
    """

    before: SCGraph
    graph: SCGraph
    groups: tuple[AssurGroup, ...]
    removed: tuple[AssurGroup, ...]

    def blocks(self) -> list[Block]:
        """Return the lines that are printed: a line for each group."""
        lines: list[Block] = [
            "{:6}  links {links}, joints {joints}, mobility {mobility}".format(when, **_counts(sc))
            for when, sc in (("before", self.before), ("after", self.graph))
        ]
        removed = {group.links for group in self.removed}
        for number, group in enumerate(self.groups, start=1):
            words = f"group {number}: links {_listed(group.links)}, joints {_listed(group.joints)}"
            words += f", input {_listed(group.inputs)}" if group.inputs else ""
            lines.append(words + ("   (removed)" if group.links in removed else ""))
        return lines

    def __repr__(self) -> str:
        return f"<AssurReduction: {self.before!r} to {self.graph!r}, {numbered(len(self.groups), 'group')}>"

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on, and the groups."""
        return {
            "before": _counts(self.before),
            "after": _counts(self.graph),
            "steps": [_as_json(group) for group in self.removed],
            "groups": [_as_json(group) for group in self.groups],
        }


def assur_groups(sc: SCGraph, ground: LinkId, inputs: Iterable[JointId]) -> tuple[AssurGroup, ...]:
    """Return the Assur groups of a mechanism, each after those it depends on.

    Parameters
    ----------
    sc : SCGraph
        All loops about one centre, finite or infinite; else UnsolvableError.
    ground : link id
    inputs : iterable of joint ids
        As many as there are freedoms; UnsolvableError if they do not drive the mechanism.

    Examples
    --------
    A four-bar driven at its ground: the crank, then a dyad.

    >>> from graphs.loops.loop import Loop
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> [group.links for group in assur_groups(four_bar, 0, [0])]
    [(1,), (2, 3)]
    """
    driven = _checked(sc, ground, inputs)
    payer = _shared_out(sc, ground, driven)
    depends_on = nx.DiGraph()
    depends_on.add_nodes_from(link for link in sc if link != ground)
    for (joint, _), link in payer.items():
        a, b = sc.joints[joint]
        other = b if link == a else a
        if other != ground:
            depends_on.add_edge(link, other)
    parts = nx.condensation(depends_on)
    place = {link: i for i, link in enumerate(sc)}
    first = {part: min(place[link] for link in parts.nodes[part]["members"]) for part in parts}
    order = list(nx.lexicographical_topological_sort(parts.reverse(), key=first.__getitem__))
    rank = {link: i for i, part in enumerate(order) for link in parts.nodes[part]["members"]}
    groups = []
    for i, part in enumerate(order):
        links = sorted(parts.nodes[part]["members"], key=place.__getitem__)
        joints = tuple(joint for joint, ends in sc.joints.items() if max(rank.get(end, -1) for end in ends) == i)
        groups.append(AssurGroup(tuple(links), joints, tuple(joint for joint in joints if joint in driven)))
    return tuple(groups)


def _checked(sc: SCGraph, ground: LinkId, inputs: Iterable[JointId]) -> frozenset[JointId]:
    """Return the inputs; refuse a mechanism with several centres, or another number of inputs than freedoms."""
    driven = frozenset(inputs)
    if ground not in sc:
        wrong = f"ground {shown(ground)} is no link"
        raise InvariantError("ground is a link", wrong, "a link", ("ground", ground))
    for joint in driven:
        if joint not in sc.joints:
            raise InvariantError("inputs are joints", f"input {shown(joint)} is no joint", "a joint")
    kind = mechanism_class(sc)
    if kind not in ("spherical", "planar") or sc.components != 1:
        raise UnsolvableError(f"Assur groups need one centre for all loops of a connected mechanism; got {kind}")
    freedoms = loop_form(len(sc.joints), len(sc.centred_loops), 0)
    if len(driven) != freedoms:
        expected = numbered(freedoms, "degree of freedom", "degrees of freedom")
        raise UnsolvableError(f"{numbered(len(driven), 'input')} for {expected}; expected {freedoms}")
    return driven


def _shared_out(sc: SCGraph, ground: LinkId, driven: frozenset[JointId]) -> dict[tuple[JointId, int], LinkId]:
    """Assign every freedom that a joint takes to one of its links, three to each, by augmenting paths."""
    payer: dict[tuple[JointId, int], LinkId] = {}
    paid: dict[LinkId, list[tuple[JointId, int]]] = {link: [] for link in sc if link != ground}

    def settle(start: tuple[JointId, int]) -> bool:
        """Look breadth-first for a link that can still pay; then each link on the path pays for its freedom."""
        reached_by: dict[LinkId, tuple[JointId, int]] = {}
        waiting = deque([start])
        while waiting:
            freedom = waiting.popleft()
            for link in sc.joints[freedom[0]]:
                if link == ground or link in reached_by:
                    continue
                reached_by[link] = freedom
                if len(paid[link]) == 3:
                    waiting.extend(paid[link])
                    continue
                while True:
                    freedom = reached_by[link]
                    before = payer.get(freedom)
                    payer[freedom] = link
                    paid[link].append(freedom)
                    if before is None:
                        return True
                    paid[before].remove(freedom)
                    link = before  # noqa: PLW2901 - its place is free now
        return False

    for joint in sc.joints:
        for k in range(3 if joint in driven else 2):
            if not settle((joint, k)):
                wrong = f"these inputs constrain the part at joint {shown(joint)} twice, and leave another mobile"
                raise UnsolvableError(wrong)
    return payer


def reduce_assur(sc: SCGraph, ground: LinkId, inputs: Iterable[JointId]) -> AssurReduction:
    """Take off Assur groups without inputs that no other depends on, until none is left; the mobility stays.

    Parameters
    ----------
    sc, ground, inputs
        As for `assur_groups`, with its errors.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> [link for link in reduce_assur(four_bar, 0, [0]).graph]
    [0, 1]
    """
    groups = assur_groups(sc, ground, inputs)
    left = list(groups)
    removed: list[AssurGroup] = []
    for group in reversed(groups):
        ends = {end for other in left if other is not group for joint in other.joints for end in sc.joints[joint]}
        if not group.inputs and ends.isdisjoint(group.links):
            left.remove(group)
            removed.append(group)
    return AssurReduction(sc, _remaining(sc, ground, left), groups, tuple(removed))


def _remaining(sc: SCGraph, ground: LinkId, groups: Sequence[AssurGroup]) -> SCGraph:
    kept = {ground}.union(*(group.links for group in groups))
    graph = nx.MultiGraph()
    graph.add_nodes_from(link for link in sc if link in kept)
    for group in groups:
        for joint in group.joints:
            graph.add_edge(*sc.joints[joint], key=joint)
    remaining = sc_from_link_joint_graph(graph, sc.centred_loops[0].centre)
    return SCGraph(remaining.nodes, remaining.joints, remaining.loops, ground=ground)


def _counts(sc: SCGraph) -> dict[str, int]:
    mobility = loop_form(len(sc.joints), len(sc.centred_loops), sc.spatial_loops)
    return {"links": len(sc), "joints": len(sc.joints), "mobility": mobility}


def _listed(names: tuple[Hashable, ...]) -> str:
    return plain(", ".join(map(str, names)), 200)


def _as_json(group: AssurGroup) -> dict[str, Any]:
    return {"links": list(group.links), "joints": list(group.joints), "inputs": list(group.inputs)}
