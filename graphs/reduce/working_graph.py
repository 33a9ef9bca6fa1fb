"""Addenda taken off one after the other, on a working copy of the graph that changes and can be changed back.

Loops are sets of joints here, so that changing a long loop costs as much as what changes. See
:mod:`graphs.reduce.ride_alongs` for what a step is. Theory: docs/theory/reduction.md.
"""

from collections import Counter, defaultdict
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import networkx as nx

from graphs.loops.classes import centre_classes
from graphs.loops.loop import Loop, cut_into_cycles, dependent_loop, in_span_of
from graphs.mechanism.sc import SCGraph
from graphs.types import JointId, Joints, LinkId


@dataclass(frozen=True, slots=True)
class Removal:
    """Two binary links u and v taken out, and what became of the loops; enough to put everything back.

    Joints are a-u, u-v and v-b. `dropped` is the index of the loop that went; `changed` are loops that were
    rerouted, each with the joints that it gained or lost; `reopened` is a closing loop that took the place of a
    dropped one.
    """

    links: tuple[LinkId, LinkId]
    joints: tuple[JointId, JointId, JointId]
    ends: tuple[tuple[LinkId, LinkId], ...]
    dropped: int
    changed: tuple[tuple[int, frozenset[JointId]], ...]
    reopened: int | None


class RideAlongPath(NamedTuple):
    """Two binary links u and v in a row, between two others a and b: links and joints as they are passed."""

    a: LinkId
    before: JointId
    u: LinkId
    middle: JointId
    v: LinkId
    after: JointId
    b: LinkId


class WorkingGraph:
    """A mechanism with links, joints and loops that come and go; its classes are computed once and kept."""

    def __init__(self, sc: SCGraph) -> None:
        self.original = sc
        self.degree: dict[LinkId, int] = dict(sc.degree)
        self.joints: dict[JointId, tuple[LinkId, LinkId]] = dict(sc.joints)
        self.labels = (*sc.loops, *sc.closing)
        self.loops = [set(loop.joints) for loop in self.labels]
        self.alive = [True] * len(self.loops)
        self.closing = set(range(len(sc.loops), len(self.loops)))
        self.through: dict[JointId, set[int]] = defaultdict(set)
        for index, around in enumerate(self.loops):
            for joint in around:
                self.through[joint].add(index)
        self.class_of = {loop: k for k, one in enumerate(sc.centre_classes()) for loop in one.loops}
        self._members = [one.loops for one in sc.centre_classes()]
        self._passing = Counter((j, k) for loop, k in self.class_of.items() for j in self.loops[loop])
        self._full = [self._is_full(one.loops, one.joints) for one in sc.centre_classes()]
        self.block_of: dict[JointId, int] = {}
        self.loops_in_block: list[int] = []
        self._find_blocks(sc)

    def _is_full(self, loops: Sequence[int], joints: Collection[JointId]) -> bool:
        """Whether every cycle over the joints of a class is a sum of its loops."""
        if len(loops) == 1:
            return True
        if any(loop in self.closing for loop in loops):
            return False
        part = nx.Graph()
        part.add_edges_from(self.joints[joint] for joint in joints)
        return bool(len(joints) - len(part) + nx.number_connected_components(part) == len(loops))

    def _find_blocks(self, graph: nx.MultiGraph) -> None:
        """Number the blocks of a graph, and the independent cycles of each."""
        for edges in nx.biconnected_component_edges(graph):
            links, number = set(), 0
            for a, b in edges:
                links.add(a)
                links.add(b)
                for joint in graph[a][b]:
                    self.block_of[joint] = len(self.loops_in_block)
                    number += 1
            self.loops_in_block.append(number - len(links) + 1)

    def other_end(self, joint: JointId, link: LinkId) -> LinkId:
        """Return the link on the other side of a joint."""
        a, b = self.joints[joint]
        return b if a == link else a

    def joints_at(self, link: LinkId) -> list[JointId]:
        """Return the joints of a link that are left; costs as much as it had at first."""
        # The dict itself: the views of networkx triple the time of a reduction.
        return [joint for keys in self.original._adj[link].values() for joint in keys if joint in self.joints]

    def path(self, middle: JointId) -> RideAlongPath | None:
        """Return the path of a joint that joins two binary links."""
        u, v = self.joints[middle]
        if self.degree[u] != 2 or self.degree[v] != 2:
            return None
        (before,) = (joint for joint in self.joints_at(u) if joint != middle)
        (after,) = (joint for joint in self.joints_at(v) if joint != middle)
        a, b = self.other_end(before, u), self.other_end(after, v)
        return None if v == a else RideAlongPath(a, before, u, middle, v, after, b)

    def centred_through(self, joint: JointId) -> list[int]:
        """Return the loops with a centre that pass a joint; round a binary path they are of one class."""
        return sorted(index for index in self.through[joint] if index in self.class_of)

    def member_at_once(self, cycle: frozenset[JointId], middle: JointId) -> tuple[bool, int | None]:
        """Say whether `member_through` knows its answer without an elimination, and if so the answer."""
        passing = self.centred_through(middle)
        if not passing:
            return True, None
        for index in passing:
            if self.loops[index] == cycle:
                return True, index
        which = self.class_of[passing[0]]
        if any(not self._passing[joint, which] for joint in cycle):
            return True, None
        if self._full[which] and len(passing) == 1:
            return True, passing[0]  # the sum holds an odd number of the loops through the joint: this one
        return False, None

    def member_through(self, cycle: frozenset[JointId], middle: JointId) -> int | None:
        """Return a loop through a joint that takes part in a sum of loops of one class giving a cycle, or None."""
        known, member = self.member_at_once(cycle, middle)
        if known:
            return member
        passing = self.centred_through(middle)
        members = [i for i in self._members[self.class_of[passing[0]]] if self.alive[i]]
        summands = in_span_of(cycle, [self.loops[i] for i in members])
        if summands is None:
            return None
        return min((members[i] for i in summands if members[i] in passing), key=lambda i: (i in self.closing, i))

    def remove(
        self,
        path: RideAlongPath,
        dropped: int,
        deltas: Sequence[tuple[int, frozenset[JointId]]],
        reopened: int | None = None,
    ) -> Removal:
        """Take out the two links within a path; ``deltas`` says how the other loops through it change."""
        _, before, u, middle, v, after, _ = path
        joints = before, middle, after
        ends = tuple(self.joints[joint] for joint in joints)
        removal = Removal((u, v), joints, ends, dropped, tuple(deltas), reopened)
        self.repeat(removal)
        return removal

    def repeat(self, removal: Removal) -> None:
        """Make a removal, as it was made before."""
        if removal.reopened is not None:
            self.closing ^= {removal.dropped, removal.reopened}
        self._set_alive(removal.dropped, False)
        for index, delta in removal.changed:
            self._toggle(index, delta)
        self.loops_in_block[self.block_of[removal.joints[1]]] -= 1
        for joint in removal.joints:
            for link in self.joints.pop(joint):
                self.degree[link] -= 1
        for link in removal.links:
            del self.degree[link]

    def renumber_block(self, block: int) -> None:
        """Find the blocks that are left of a block."""
        left = nx.MultiGraph()
        left.add_edges_from((*ends, joint) for joint, ends in self.joints.items() if self.block_of[joint] == block)
        self._find_blocks(left)

    def put_back(self, removal: Removal) -> None:
        """Undo a removal; only the last one that stands can be undone."""
        self.degree |= dict.fromkeys(removal.links, 0)
        for joint, ends in zip(removal.joints, removal.ends, strict=True):
            self.joints[joint] = ends
            for link in ends:
                self.degree[link] += 1
        for index, delta in removal.changed:
            self._toggle(index, delta)
        self._set_alive(removal.dropped, True)
        if removal.reopened is not None:
            self.closing ^= {removal.dropped, removal.reopened}

    def _toggle(self, index: int, delta: frozenset[JointId]) -> None:
        for joint in delta:
            self._pass(index, joint, joint not in self.loops[index])
        self.loops[index] ^= delta

    def _set_alive(self, index: int, alive: bool) -> None:
        self.alive[index] = alive
        for joint in self.loops[index]:
            self._pass(index, joint, alive)

    def _pass(self, index: int, joint: JointId, passes: bool) -> None:
        """Note that a loop passes a joint from now on, or does not."""
        if passes:
            self.through[joint].add(index)
        else:
            self.through[joint].discard(index)
        if index in self.class_of:
            self._passing[joint, self.class_of[index]] += 1 if passes else -1

    def kept_loops(self) -> tuple[list[int], list[int]]:
        """Return the independent loops that are left, and the closing ones that are none of these."""
        independent = [i for i in range(len(self.loops)) if self.alive[i] and i not in self.closing]
        held = {frozenset(self.loops[i]) for i in independent}
        held.add(frozenset())  # a closing loop that was the cycle itself is nothing without it
        closing = [i for i in sorted(self.closing) if self.alive[i] and frozenset(self.loops[i]) not in held]
        return independent, closing

    def graph(self) -> SCGraph:
        """Return the remaining SC graph, with the centre classes of the original."""
        independent, closing = self.kept_loops()
        kept = [*independent, *closing]
        loops = [replace(self.labels[i], joints=tuple(sorted(self.loops[i], key=str))) for i in kept]
        loops = self._with_classes(kept, loops)
        links = [link for link in self.original.nodes if link in self.degree]
        joints: Joints = {joint: self.joints[joint] for joint in self.original.joints if joint in self.joints}
        cut = len(independent)
        return SCGraph(links, joints, loops[:cut], closing=loops[cut:], ground=self.original.ground)

    def _with_classes(self, kept: Sequence[int], loops: list[Loop]) -> list[Loop]:
        """Name the centre of loops that share one although their joints no longer force them to."""
        new_class = {loop: k for k, one in enumerate(centre_classes(loops)) for loop in one.loops}
        members: dict[int, list[int]] = defaultdict(list)
        for place, index in enumerate(kept):
            if index in self.class_of:
                members[self.class_of[index]].append(place)
        used = {loop.at for loop in loops}
        for which, places in members.items():
            if len({new_class[place] for place in places}) > 1:
                name = next(loops[p].at for p in places) or f"centre {which}"
                while name in used and not any(loops[p].at == name for p in places):
                    name += "'"
                for place in places:
                    loops[place] = replace(loops[place], at=name)
        return loops


RULES = ("ride-along", "dyad")


@dataclass(frozen=True, slots=True)
class ReductionTerms:
    """Which addenda may be taken off, without protected links; `fully`: a block may lose its last loop."""

    rule: str
    fully: bool
    protected: frozenset[LinkId]


class TakenAddendum(NamedTuple):
    """An addendum taken off the links a and b (`onto`); the joint a-b takes its place, None for a dyad."""

    removal: Removal
    joint: JointId | None
    onto: tuple[LinkId, LinkId]


_Cycle = tuple[JointId, frozenset[JointId]]
"""A joint, and the cycle that it closes."""


def take_all(work: WorkingGraph, terms: ReductionTerms) -> list[TakenAddendum]:
    """Take addenda off a working graph until none is left; return them in their order."""
    ride_alongs = terms.rule == "ride-along"
    addenda: list[TakenAddendum] = []
    waiting = dict.fromkeys(reversed(list(work.joints)))
    hard: dict[JointId, None] = {}
    while waiting or hard:
        easy_first = bool(waiting)
        middle, _ = waiting.popitem() if waiting else hard.popitem()
        path = _path_that_may_go(work, middle, terms)
        if path is None:
            continue
        if ride_alongs:
            cycles = _cycles(work, path)
            if easy_first and _needs_elimination(work, middle, cycles):
                hard[middle] = None
                continue
            step = _take_ride_along(work, path, cycles)
        else:
            step = _take_dyad(work, path)
        if step is None:
            continue
        addenda.append(step)
        eased = hard.keys() & work.loops[step.removal.dropped]
        for joint in eased:
            del hard[joint]
        waiting |= dict.fromkeys(sorted(eased, key=str))
        for link in step.onto:
            if work.degree[link] == 2:
                waiting |= dict.fromkeys(work.joints_at(link))
    return addenda


def _path_that_may_go(work: WorkingGraph, middle: JointId, terms: ReductionTerms) -> RideAlongPath | None:
    """Return the path of a joint that joins two binary links between two others, if nothing protects them."""
    path = work.path(middle) if middle in work.joints else None
    if path is None:
        return None
    if path.a == path.b or path.u in terms.protected or path.v in terms.protected:
        return None
    return path if terms.fully or work.loops_in_block[work.block_of[middle]] > 1 else None


def _cycles(work: WorkingGraph, path: RideAlongPath) -> list[_Cycle]:
    """Return the joints between the ends of a path, each with the cycle that it closes with it."""
    a, before, _, middle, _, after, b = path
    between = work.original[a][b] if work.original.has_edge(a, b) else ()
    return [(joint, frozenset((before, middle, after, joint))) for joint in sorted(between, key=str)]


def _needs_elimination(work: WorkingGraph, middle: JointId, cycles: list[_Cycle]) -> bool:
    """Return whether only an elimination can decide if the two links of a joint are a ride-along."""
    answers = (work.member_at_once(cycle, middle) for _, cycle in cycles)
    return next((not known for known, member in answers if not known or member is not None), False)


def _take_ride_along(work: WorkingGraph, path: RideAlongPath, cycles: list[_Cycle]) -> TakenAddendum | None:
    """Take off the two links within a path, if they are a ride-along."""
    middle = path.middle
    for joint, cycle in cycles:
        dropped = work.member_through(cycle, middle)
        if dropped is None:
            continue
        reopened = None
        if dropped in work.closing:
            reopened = _independent_member(work, cycle, middle)
            if reopened is None:
                continue
        others = sorted(work.through[middle] - {dropped})
        removal = work.remove(path, dropped, [(index, cycle) for index in others], reopened)
        return TakenAddendum(removal, joint, (path.a, path.b))
    return None


def _independent_member(work: WorkingGraph, cycle: frozenset[JointId], middle: JointId) -> int | None:
    """Return an independent loop with a centre, through a joint, that is part of the sum giving a closing loop."""
    independent = [i for i in range(len(work.loops)) if work.alive[i] and i not in work.closing]
    passing = [i for i in work.centred_through(middle) if i not in work.closing]
    if len(passing) == 1 and len(work.through[middle] - work.closing) == 1:
        return passing[0]
    summands = in_span_of(cycle, [work.loops[i] for i in independent])
    return next((independent[i] for i in summands or () if independent[i] in passing), None)


def _take_dyad(work: WorkingGraph, path: RideAlongPath) -> TakenAddendum | None:
    """Take off the two links within a path, a dyad, if a loop through it has a centre."""
    middle = path.middle
    passing = [i for i in work.centred_through(middle) if i not in work.closing]
    if not passing:
        return None
    dropped = min(passing, key=lambda i: (len(work.loops[i]), i))
    deltas: list[tuple[int, frozenset[JointId]]] = []
    for index in sorted(work.through[middle] - {dropped}):
        merged = _one_cycle(work, index, dropped, [d for d, _ in deltas])
        if merged is None:
            return None
        deltas.append((index, frozenset(work.loops[index] ^ merged)))
    block = work.block_of[middle]
    removal = work.remove(path, dropped, deltas)
    work.renumber_block(block)
    return TakenAddendum(removal, None, (path.a, path.b))


def _one_cycle(work: WorkingGraph, index: int, dropped: int, done: list[int]) -> set[JointId] | None:
    """Return the sum of two loops as one cycle; if it falls apart, a part that is independent of the rest."""
    merged = work.loops[index] ^ work.loops[dropped]
    parts = [set(part) for part in cut_into_cycles(sorted(merged, key=str), work.joints)]
    if len(parts) == 1:
        return parts[0]
    if index in work.closing:
        return None
    skip = {index, dropped, *done}
    rest = [tuple(x) for i, x in enumerate(work.loops) if work.alive[i] and i not in work.closing and i not in skip]
    for part in sorted(parts, key=len, reverse=True):
        if dependent_loop([*rest, tuple(part)]) is None:
            return part
    return None
