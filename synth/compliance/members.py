"""Compliant members: the linkage that is left where those at rest are rigid and active ones are released.

Theory: docs/theory/compliance.md.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from itertools import chain, combinations

import networkx as nx
import numpy as np

from graphs.edit.named import known
from graphs.errors import InvariantError, shown
from graphs.loops.loop import Loop, signed_cycle
from graphs.mechanism.sc import SCGraph
from graphs.rank.exact import independent_cycles
from graphs.types import Ints, JointId, LinkId
from synth.motion.linkage import PosedLinkage, PosedLoop

__all__ = ["NONE", "Members", "released"]


@dataclass(frozen=True, slots=True)
class Members:
    """Joints and links of a linkage, those that are compliant or some of them.

    Attributes
    ----------
    joints : tuple of joint ids
    links : tuple of link ids

    Examples
    --------
    >>> print(Members((0, 3), ("flap",)))
    joint 0, joint 3, link 'flap'
    """

    joints: tuple[JointId, ...] = ()
    links: tuple[LinkId, ...] = ()

    def __len__(self) -> int:
        return len(self.joints) + len(self.links)

    def __str__(self) -> str:
        words = [*(f"joint {shown(one)}" for one in self.joints), *(f"link {shown(one)}" for one in self.links)]
        return ", ".join(words) or "none"

    def to_json(self) -> dict[str, list[JointId]]:
        """Return plain data."""
        return {"joints": list(self.joints), "links": list(self.links)}

    def within(self, other: Members) -> bool:
        """Tell whether all of these are among others."""
        return set(self.joints) <= set(other.joints) and set(self.links) <= set(other.links)

    def subsets(self) -> Iterator[Members]:
        """Yield all sets of these members, smaller ones first.

        Examples
        --------
        >>> [len(some) for some in Members((0, 1), ("a",)).subsets()]
        [0, 1, 1, 1, 2, 2, 2, 3]
        """
        each = [*((0, joint) for joint in self.joints), *((1, link) for link in self.links)]
        for some in chain.from_iterable(combinations(each, size) for size in range(len(each) + 1)):
            yield Members(
                tuple(name for kind, name in some if kind == 0), tuple(name for kind, name in some if kind == 1)
            )

    def checked(self, graph: SCGraph) -> None:
        """Refuse names that the graph has not, names given twice, and links that hang on one other.

        Raises
        ------
        InvariantError
        """
        for kind, names, there in (("joint", self.joints, graph.joints), ("link", self.links, graph.nodes)):
            for place, name in enumerate(names):
                if name not in there:
                    raise InvariantError(kind, f"{shown(name)} is no {kind}", known(there, str(name)))
                if name in names[:place]:
                    raise InvariantError(kind, f"{kind} {shown(name)} is compliant twice", "each once")
        for link in self.links:
            if len(graph[link]) < 2:
                raise InvariantError(
                    "compliant link", f"link {shown(link)} hangs on one other", "a link between two others or more"
                )


NONE = Members()
"""No member."""


def released(linkage: PosedLinkage, compliant: Members, active: Members) -> PosedLinkage:
    """Return the linkage at its pose in which resting members are rigid and active ones give way.

    A resting joint makes its two links one, a resting link stays as it is. An active joint turns; an active link
    gives way in any manner, as if it and its joints were not there. The active ones are among the compliant. Loops
    of the answer may pass a link twice; it may be in several parts, if active links were all between them.
    """
    left = _without(linkage, active.links) if active.links else linkage
    held = {joint for joint in compliant.joints if joint in left.graph.joints} - set(active.joints)
    return _locked(left, held) if held else left


def _without(linkage: PosedLinkage, gone: Collection[LinkId]) -> PosedLinkage:
    """Return a linkage without some links and their joints: its loops are about them now."""
    joints = {
        joint: ends for joint, ends in linkage.graph.joints.items() if not (ends[0] in gone or ends[1] in gone)
    }
    names = list(linkage.graph.joints)
    whole = [
        Loop(tuple(names[place] for place in loop.joints), loop.centre)
        for loop in linkage.loops
        if all(names[place] in joints for place in loop.joints)
    ]
    graph = SCGraph([link for link in linkage.graph.nodes if link not in gone], joints, whole)
    column = {joint: place for place, joint in enumerate(joints)}
    loops = []
    for loop in independent_cycles(graph):
        signed = list(signed_cycle(loop.joints, joints))
        loops.append(PosedLoop(tuple(column[j] for j, _ in signed), tuple(s for _, s in signed), loop.centre))
    return _restricted(linkage, graph, tuple(loops))


def _locked(linkage: PosedLinkage, held: Collection[JointId]) -> PosedLinkage:
    """Return a linkage some of whose joints do not turn: their links are one.

    A joint that so comes to join a link with itself is held too.
    """
    bodies = nx.utils.UnionFind(linkage.graph.nodes)
    for joint in held:
        bodies.union(*linkage.graph.joints[joint])
    joints = {
        joint: (bodies[a], bodies[b]) for joint, (a, b) in linkage.graph.joints.items() if bodies[a] != bodies[b]
    }
    graph = SCGraph([link for link in linkage.graph.nodes if bodies[link] == link], joints)
    column = {joint: place for place, joint in enumerate(joints)}
    names = list(linkage.graph.joints)
    loops = []
    for loop in linkage.loops:
        turning = [
            (column[names[place]], sign)
            for place, sign in zip(loop.joints, loop.signs, strict=True)
            if names[place] in joints
        ]
        if turning:
            loops.append(PosedLoop(tuple(p for p, _ in turning), tuple(s for _, s in turning), loop.centre))
    return _restricted(linkage, graph, tuple(loops))


def _restricted(linkage: PosedLinkage, graph: SCGraph, loops: tuple[PosedLoop, ...]) -> PosedLinkage:
    """Return the axes of the joints of a smaller graph, with its loops."""
    place = {joint: column for column, joint in enumerate(linkage.graph.joints)}
    kept: Ints = np.array([place[joint] for joint in graph.joints], dtype=np.int64)
    return replace(
        linkage,
        graph=graph,
        points=linkage.points[kept],
        directions=linkage.directions[kept],
        angles=linkage.angles[kept],
        loops=loops,
    )
