"""Compliant members: the linkage with those at rest rigid and active ones released, and its freedoms.

Theory: docs/theory/compliance.md.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from itertools import chain, combinations
from typing import Any, Literal

import networkx as nx
import numpy as np

from graphs.edit.named import known
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.loops.loop import Centre, Loop, signed_cycle
from graphs.mechanism.sc import SCGraph
from graphs.rank.exact import independent_cycles
from graphs.rank.singular_values import spectrum
from graphs.tolerances import DOUBLE
from graphs.types import Ints, JointId, LinkId
from synth.motion.branches import MOST_JOINTS, Certainty, branches_of, search_for
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage, PosedLoop


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
        words = [f"joint {shown(name)}" for name in self.joints] + [f"link {shown(name)}" for name in self.links]
        return ", ".join(words) or "none"

    def to_json(self) -> dict[str, list[JointId]]:
        """Return plain data."""
        return {"joints": list(self.joints), "links": list(self.links)}

    def within(self, other: Members) -> bool:
        """Check whether all of these are among others."""
        return set(self.joints) <= set(other.joints) and set(self.links) <= set(other.links)

    def is_one_less_than(self, other: Members) -> bool:
        """Check whether these are all of some others but one."""
        return len(self) == len(other) - 1 and self.within(other)

    def subsets(self) -> Iterator[Members]:
        """Yield all sets of these members, smaller ones first."""
        each = [*((joint, True) for joint in self.joints), *((link, False) for link in self.links)]
        for some in chain.from_iterable(combinations(each, size) for size in range(len(each) + 1)):
            joints = tuple(name for name, is_joint in some if is_joint)
            yield Members(joints, tuple(name for name, is_joint in some if not is_joint))

    def check_names(self, graph: SCGraph) -> None:
        """Raise `InvariantError` for names not in the graph, repeated names, and links that hang on one other."""
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
    """Return the linkage at its pose with resting members rigid and active ones, which are compliant, released.

    A resting joint makes its two links one, a resting link stays as it is. An active joint turns; an active link
    gives way in any manner, as if it and its joints were absent. Loops of the answer may pass a link twice; it is
    in several parts if only active links were between them.
    """
    left = _without(linkage, active.links) if active.links else linkage
    held = {joint for joint in compliant.joints if joint in left.graph.joints} - set(active.joints)
    return _locked(left, held) if held else left


def _without(linkage: PosedLinkage, gone: Collection[LinkId]) -> PosedLinkage:
    """Return a linkage without some links and their joints: its loops are about them now."""
    joints = {joint: ends for joint, ends in linkage.graph.joints.items() if not (ends[0] in gone or ends[1] in gone)}
    names = list(linkage.graph.joints)
    whole = [
        Loop(tuple(names[place] for place in loop.joints), loop.centre)
        for loop in linkage.loops
        if all(names[place] in joints for place in loop.joints)
    ]
    graph = SCGraph([link for link in linkage.graph.nodes if link not in gone], joints, whole)
    cycles = [(list(signed_cycle(loop.joints, joints)), loop.centre) for loop in independent_cycles(graph)]
    return _restricted(linkage, graph, cycles)


def _locked(linkage: PosedLinkage, held: Collection[JointId]) -> PosedLinkage:
    """Return a linkage with locked joints: their links are one; joints from a link to itself are locked too."""
    bodies = nx.utils.UnionFind(linkage.graph.nodes)
    for joint in held:
        bodies.union(*linkage.graph.joints[joint])
    joints = {joint: (bodies[a], bodies[b]) for joint, (a, b) in linkage.graph.joints.items() if bodies[a] != bodies[b]}
    graph = SCGraph([link for link in linkage.graph.nodes if bodies[link] == link], joints)
    names = list(linkage.graph.joints)
    cycles = []
    for loop in linkage.loops:
        signed = [(names[place], sign) for place, sign in zip(loop.joints, loop.signs, strict=True)]
        cycles.append(([(joint, sign) for joint, sign in signed if joint in joints], loop.centre))
    return _restricted(linkage, graph, cycles)


def _restricted(
    linkage: PosedLinkage, graph: SCGraph, cycles: list[tuple[list[tuple[JointId, int]], Centre]]
) -> PosedLinkage:
    """Return the linkage of a smaller graph, with loops of joints and signs, those without joints left out."""
    place = {joint: column for column, joint in enumerate(linkage.graph.joints)}
    column = {joint: number for number, joint in enumerate(graph.joints)}
    kept: Ints = np.array([place[joint] for joint in graph.joints], dtype=np.int64)
    return replace(
        linkage,
        graph=graph,
        points=linkage.points[kept],
        directions=linkage.directions[kept],
        angles=linkage.angles[kept],
        loops=tuple(
            PosedLoop(tuple(column[joint] for joint, _ in cycle), tuple(sign for _, sign in cycle), centre)
            for cycle, centre in cycles
            if cycle
        ),
    )


MOST_MEMBERS = 10
"""Of more members not all sets are looked at: there are a thousand."""
_OF_A_BODY = 6
"""Freedoms of a part that hangs on active links only."""


def freedoms_text(freedoms: int | None) -> str:
    """Return a number of freedoms in words; None if it is unknown."""
    return (
        "degrees of freedom not known"
        if freedoms is None
        else numbered(freedoms, "degree of freedom", "degrees of freedom")
    )


def number_or_unknown(number: int | None) -> str:
    """Return a number as a cell of a table; None if it is unknown."""
    return "?" if number is None else str(number)


Kind = Literal["rigid immobile", "rigid mobile", "compliant immobile", "compliant mobile", "not known"]


@dataclass(frozen=True, slots=True)
class State:
    """A linkage with some of its compliant members active, the others at rest.

    Attributes
    ----------
    active : Members
    freedoms : int or None
        Of finite motion, with resting members rigid and active ones released; on the freest branch. None if
        unknown.
    certainty : {"proved", "numerical", "not known"}
        Proved: no rates close to first order, or the equations are independent; or as `synth.motion.branches_of`.

    Examples
    --------
    >>> State(Members((0,)), 1, "proved").kind
    'compliant mobile'
    """

    active: Members
    freedoms: int | None
    certainty: Certainty

    @property
    def kind(self) -> Kind:
        """Rigid while all members are at rest, else compliant; mobile with a freedom or more."""
        if self.freedoms is None:
            return "not known"
        if len(self.active):
            return "compliant mobile" if self.freedoms else "compliant immobile"
        return "rigid mobile" if self.freedoms else "rigid immobile"

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "active": self.active.to_json(),
            "freedoms": self.freedoms,
            "kind": self.kind,
            "certainty": self.certainty,
        }


def state_of(linkage: PosedLinkage, compliant: Members, active: Members) -> State:
    """Return the state of a closed linkage with some of its compliant members active.

    Raise `UnsolvableError` if equations depend on each other and there are too many joints to search for branches.
    """
    left = released(linkage, compliant, active)
    apart = _OF_A_BODY * (nx.number_connected_components(left.graph) - 1)
    freedoms, certainty = _freedoms(left)
    return State(active, None if freedoms is None else freedoms + apart, certainty)


def states_of_sets(linkage: PosedLinkage, compliant: Members) -> list[State]:
    """Return the state for each set of active members, smaller sets first; too many are refused."""
    if len(compliant) > MOST_MEMBERS:
        members = numbered(len(compliant), "compliant member")
        raise UnsolvableError(f"{members} have too many sets of active ones; expected {MOST_MEMBERS} at most")
    return [state_of(linkage, compliant, active) for active in compliant.subsets()]


def _freedoms(linkage: PosedLinkage) -> tuple[int | None, Certainty]:
    """Return the finite freedoms from a pose, on the freest way."""
    joints = len(linkage.angles)
    closure = ClosureEquations(linkage)
    rank = spectrum(closure.at(linkage.angles)[1].toarray(), DOUBLE.derivative).rank
    if rank in (joints, closure.rows):
        return joints - rank, "proved"
    if joints > MOST_JOINTS:
        raise UnsolvableError(
            f"{joints} joints are too many to search for motion branches; expected {MOST_JOINTS} at most"
        )
    branches = branches_of(linkage, closure, search_for(joints, None))
    if branches.no_motion == "proved":
        return 0, "proved"
    known = [branch for branch in branches.branches if branch.freedoms is not None and branch.certainty != "not known"]
    if not known:
        return None, "not known"
    freest = max(known, key=lambda branch: branch.freedoms or 0)
    return freest.freedoms, freest.certainty
