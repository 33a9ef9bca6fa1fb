"""Compliant members: the linkage with those at rest rigid and active ones released, and its freedoms.

Theory: docs/theory/compliance.md.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain, combinations, islice
from math import comb
from typing import Any, Literal

import networkx as nx
import numpy as np

from graphs.edit.named import known
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.loops.loop import Centre, Loop, signed_cycle
from graphs.mechanism.sc import SCGraph
from graphs.rank.exact import independent_cycles
from graphs.rank.singular_values import null_space, rank_of, spectrum
from graphs.tolerances import DOUBLE, pivots
from graphs.types import Floats, Ints, JointId, LinkId
from synth.analysis.motion.branches import MOST_JOINTS, branches_of, search_for
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.germ import Certainty
from synth.analysis.motion.linkage import Linkage, LinkageLoop


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
        return self.text(len(self))

    def text(self, most: int) -> str:
        """Return the names, at most so many."""
        words = [f"joint {shown(name)}" for name in self.joints] + [f"link {shown(name)}" for name in self.links]
        more = [f"and {len(words) - most} more"] if len(words) > most else []
        return ", ".join([*words[:most], *more]) or "none"

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


def released(linkage: Linkage, compliant: Members, active: Members) -> Linkage:
    """Return the linkage at its configuration, resting members rigid and active ones, which are compliant, released.

    A resting joint makes its two links one, a resting link stays as it is. An active joint turns; an active link
    gives way in any manner, as if it and its joints were absent. Loops of the answer may pass a link twice; it is
    in several parts if only active links were between them.
    """
    left = _without(linkage, active.links) if active.links else linkage
    held = {joint for joint in compliant.joints if joint in left.graph.joints} - set(active.joints)
    return _locked(left, held) if held else left


def _without(linkage: Linkage, gone: Collection[LinkId]) -> Linkage:
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


def _locked(linkage: Linkage, held: Collection[JointId]) -> Linkage:
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


def _restricted(linkage: Linkage, graph: SCGraph, cycles: list[tuple[list[tuple[JointId, int]], Centre]]) -> Linkage:
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
            LinkageLoop(tuple(column[joint] for joint, _ in cycle), tuple(sign for _, sign in cycle), centre)
            for cycle, centre in cycles
            if cycle
        ),
    )


ALL_SETS = 10
"""Of more members not all sets are looked at: there are a thousand."""
MOST_MEMBERS = 1000
_MOST_SETS = 1024
"""So many sets of many members are looked at."""
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
        Proved: no rates close to first order, or the equations are independent; or as
        `synth.analysis.motion.branches_of`.

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


def state_of(linkage: Linkage, compliant: Members, active: Members) -> State:
    """Return the state of a closed linkage with some of its compliant members active.

    Raise `UnsolvableError` if equations depend on each other and there are too many joints to search for branches.
    """
    left = released(linkage, compliant, active)
    apart = _OF_A_BODY * (nx.number_connected_components(left.graph) - 1)
    freedoms, certainty = _freedoms(left)
    return State(active, None if freedoms is None else freedoms + apart, certainty)


def states_of_sets(linkage: Linkage, compliant: Members) -> list[State]:
    """Return the state for each set of active members, smaller sets first: of a few members."""
    return [state_of(linkage, compliant, active) for active in compliant.subsets()]


@dataclass(frozen=True, slots=True)
class SmallestSets:
    """The smallest sets of active members that release a motion, of members too many to look at all sets.

    Attributes
    ----------
    states : tuple of State
        With more freedoms than at rest, and without any of their members with as many. Empty where none has more.
    at_least : int
        No set of fewer members releases a motion.
    complete : bool
        Whether no other set of as many members does.

    Examples
    --------
    >>> SmallestSets((State(Members((0, 3)), 1, "proved"),), 2, complete=True).lines(12)
    ['12 members have too many sets to look at all: the smallest that release a motion have 2 members; there is 1']
    """

    states: tuple[State, ...]
    at_least: int
    complete: bool

    def lines(self, members: int) -> list[str]:
        """Return what is known in a sentence, for a number of members."""
        head = f"{numbered(members, 'member')} have too many sets to look at all"
        if not self.states:
            return [f"{head}: {'none releases' if self.complete else 'it is unknown which release'} a motion"]
        size = len(self.states[0].active)
        if size > self.at_least:
            return [f"{head}: one with {size} releases a motion, and none of fewer than {self.at_least} does"]
        number = len(self.states)
        there = f"there {'is' if number == 1 else 'are'} {number}" if self.complete else f"there are at least {number}"
        return [f"{head}: the smallest that release a motion have {numbered(size, 'member')}; {there}"]

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        sets = [state.active.to_json() for state in self.states]
        return {"sets": sets, "at_least": self.at_least, "complete": self.complete}


def smallest_sets(linkage: Linkage, compliant: Members) -> tuple[list[State], SmallestSets]:
    """Return states of some sets of many compliant joints, smaller ones first, and the smallest that release a motion.

    The states are those at rest, of the smallest sets and of these without one member, and with all active. Freedoms
    never become fewer as a joint is released, and are no more than rates that close to first order; so a set at which
    these are as many as the freedoms at rest is known without a search for branches. Raise `UnsolvableError` for
    too many joints, and for links among them.
    """
    if compliant.links or len(compliant) > MOST_MEMBERS:
        members = numbered(len(compliant), "compliant member")
        wrong = "with links have too many sets of active ones" if compliant.links else "are too many"
        limit = ALL_SETS if compliant.links else MOST_MEMBERS
        raise UnsolvableError(f"{members} {wrong}; expected {limit} at most")
    search = _SetSearch(linkage, compliant)
    found = search.smallest()
    return search.states(found), found


def states_of(linkage: Linkage, compliant: Members) -> tuple[list[State], SmallestSets | None]:
    """Return the states of all sets of a few members; of many as `smallest_sets`."""
    few = len(compliant) <= ALL_SETS
    return (states_of_sets(linkage, compliant), None) if few else smallest_sets(linkage, compliant)


_DEEPEST = 4
"""Dependent sets of so many joints are looked for exhaustively."""
_WORK = 2e10
"""Where that takes no more than so many products of numbers."""
_TRIED = 40
"""Dependent sets of more joints that are tried."""


class _SetSearch:
    """A search for the smallest sets of joints, by their places among the compliant ones, that release a motion."""

    def __init__(self, linkage: Linkage, compliant: Members) -> None:
        self._linkage, self._compliant = linkage, compliant
        self._first = _FirstOrder(linkage, compliant.joints)
        self._known: dict[tuple[int, ...], State] = {}
        self._every = tuple(range(len(compliant)))
        self._rest = self._state(())

    def _state(self, places: tuple[int, ...]) -> State:
        """Return the state of a set, by first order if that decides."""
        if places not in self._known:
            active = Members(tuple(self._compliant.joints[place] for place in places))
            if places and self._rest.freedoms is not None and self._first.flexes(places) <= self._rest.freedoms:
                self._known[places] = State(active, self._rest.freedoms, self._rest.certainty)
            else:
                self._known[places] = state_of(self._linkage, self._compliant, active)
        return self._known[places]

    def _releases(self, places: tuple[int, ...]) -> bool:
        freedoms, rest = self._state(places).freedoms, self._rest.freedoms
        return freedoms is not None and rest is not None and freedoms > rest

    def states(self, found: SmallestSets) -> list[State]:
        """Return what is listed: at rest, the smallest sets and those without one member, all members."""
        place = {joint: number for number, joint in enumerate(self._compliant.joints)}
        sets = {(), self._every}
        for state in found.states:
            whole = tuple(place[joint] for joint in state.active.joints)
            sets |= {whole, *(tuple(one for one in whole if one != left) for left in whole)}
            if len(sets) > _MOST_SETS:
                break
        return [self._state(places) for places in sorted(sets, key=lambda places: (len(places), places))]

    def smallest(self) -> SmallestSets:
        """Look through sets of one member, two, ..., then for one set of any size."""
        if not self._releases(self._every):
            unknown = None in (self._rest.freedoms, self._state(self._every).freedoms)
            return SmallestSets((), 1, complete=not unknown)
        at_least, whole = 1, True
        dependent: list[tuple[int, ...]] = []
        open_sets: list[tuple[int, ...]] | None = [()] if self._first.at_rest != self._rest.freedoms else []
        for size in range(1, _DEEPEST + 1):
            if not self._first.can_look(size):
                break
            circuits = self._first.circuits(size, _MOST_SETS + 1)
            open_sets = self._opened(open_sets, circuits)
            dependent += circuits
            tried = open_sets if open_sets is not None else [*circuits, *_unions(dependent, size)]
            whole = whole and open_sets is not None
            tried = sorted(set(tried))[:_MOST_SETS]
            found = [places for places in tried if self._releases(places)]
            whole = whole and all(self._state(places).freedoms is not None for places in tried)
            at_least = size if found or not whole else size + 1
            if found:
                return SmallestSets(tuple(map(self._state, found)), at_least, complete=whole)
            if not whole:
                break
        least = self._one_set()
        alone = self._first.at_rest == self._rest.freedoms and self._first.some_circuits() == [least]
        return SmallestSets((self._state(least),), len(least) if alone else at_least, complete=alone)

    def _opened(
        self, before: list[tuple[int, ...]] | None, circuits: list[tuple[int, ...]]
    ) -> list[tuple[int, ...]] | None:
        """Return the sets that first order leaves open, of one member more than those before; None of too many.

        They are dependent sets, and what holds a set that was open.
        """
        if before is None or len(circuits) > _MOST_SETS or len(before) * len(self._every) > 10 * _MOST_SETS:
            return None
        larger = {tuple(sorted({*places, more})) for places in before for more in self._every if more not in places}
        larger |= set(circuits)
        return sorted(larger) if len(larger) <= _MOST_SETS else None

    def _one_set(self) -> tuple[int, ...]:
        """Return a set that releases a motion, without one of whose members none does."""
        for places in self._first.some_circuits()[:_TRIED]:
            if self._releases(places):
                return self._least_part(places)
        return self._least_part(self._every)

    def _least_part(self, places: tuple[int, ...]) -> tuple[int, ...]:
        """Return a part of a set that releases a motion, all of whose parts do not: members are left out by halves."""
        step = len(places)
        while step > 1:
            step = -(-step // 2)
            start = 0
            while start < len(places):
                less = places[:start] + places[start + step :]
                if less and self._releases(less):
                    places = less
                else:
                    start += step
        return places


def _unions(sets: list[tuple[int, ...]], size: int) -> list[tuple[int, ...]]:
    """Return the unions of two sets that have so many members."""
    unions = (tuple(sorted({*one, *other})) for one, other in combinations(sets[:_MOST_SETS], 2))
    return [union for union in unions if len(union) == size]


class _FirstOrder:
    """Rates that close to first order while some compliant joints are active and the others rest.

    Each joint is a vector: the part of its closure equations that is across those of all free joints. A set of joints
    has as many rates beyond those at rest as its vectors have dependences.
    """

    def __init__(self, linkage: Linkage, joints: Sequence[JointId]) -> None:
        column = {joint: place for place, joint in enumerate(linkage.graph.joints)}
        places = [column[joint] for joint in joints]
        jacobian = ClosureEquations(linkage).at(linkage.angles)[1].toarray()
        free = np.delete(jacobian, places, axis=1)
        across = null_space(free.T, scale=1.0) if free.shape[1] else np.eye(len(jacobian))
        self.at_rest = free.shape[1] - (len(jacobian) - across.shape[1])
        vectors = across.T @ jacobian[:, places]
        self._vectors = np.asarray(np.linalg.qr(vectors, mode="r")).T if vectors.size else vectors.T

    def flexes(self, places: tuple[int, ...]) -> int:
        """Return the number of rates that close while these joints are active."""
        return int(self.at_rest + len(places) - rank_of(self._vectors[list(places)], scale=1.0))

    def can_look(self, size: int) -> bool:
        """Tell whether all dependent sets of a size can be looked for."""
        count, length = self._vectors.shape
        return bool(comb(count, max(size - 2, 0)) * count**2 * max(length, 1) <= _WORK)

    def circuits(self, size: int, most: int) -> list[tuple[int, ...]]:
        """Return smallest dependent sets of a size, the first of them if there are more than `most`."""
        if size == 1:
            return [(place,) for place in np.flatnonzero(np.linalg.norm(self._vectors, axis=1) <= DOUBLE.zero).tolist()]
        return list(islice(filter(self._is_circuit, self._dependent(size, (), self._vectors)), most))

    def _dependent(self, size: int, chosen: tuple[int, ...], vectors: Floats) -> Iterator[tuple[int, ...]]:
        """Yield sets that hold the chosen joints and later ones, two of which are parallel across the others."""
        lengths = np.linalg.norm(vectors, axis=1)
        start = chosen[-1] + 1 if chosen else 0
        later = [place for place in range(start, len(vectors)) if lengths[place] > DOUBLE.clear]
        if size - len(chosen) > 2:
            for place in later:
                along = vectors[place] / lengths[place]
                yield from self._dependent(size, (*chosen, place), vectors - np.outer(vectors @ along, along))
            return
        units = vectors[later] / lengths[later, None]
        beside = np.triu((units @ units.T) ** 2 > 1.0 - DOUBLE.clear**2, 1)
        for one, other in np.argwhere(beside).tolist():
            yield (*chosen, later[one], later[other])

    def _is_circuit(self, places: tuple[int, ...]) -> bool:
        """Tell whether joints have one dependence, with all of them."""
        shares = null_space(self._vectors[list(places)].T, scale=1.0)
        return shares.shape[1] == 1 and bool(np.abs(shares).min() > DOUBLE.zero_rate)

    def some_circuits(self) -> list[tuple[int, ...]]:
        """Return a smallest dependent set for each rate, those of fewest joints first."""
        shares = null_space(self._vectors.T, scale=1.0)
        if not shares.shape[1]:
            return []
        reduced = shares @ np.linalg.inv(shares[pivots(shares)])
        sets = [tuple(np.flatnonzero(np.abs(one) > DOUBLE.zero_rate).tolist()) for one in reduced.T]
        return sorted(sets, key=lambda places: (len(places), places))


def _freedoms(linkage: Linkage) -> tuple[int | None, Certainty]:
    """Return the finite freedoms from a configuration, on the freest way."""
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
