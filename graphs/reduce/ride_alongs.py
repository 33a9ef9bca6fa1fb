"""Reducing adjunct addenda: ride-alongs taken off one by one, to a fixed point.

A *ride-along addendum* is two binary links u, v appended to two adjacent links a, b so that the four meet in one
centre; its relative mobility is 0. An *adjunct addendum* is a chain of them. Source: Wiener 2016, sections
4.2.4 and 4.2.5. Theory: docs/theory/reduction.md.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import networkx as nx

from graphs.convert.table import Mechanism, to_sc
from graphs.count.report import mobility_report
from graphs.errors import InvariantError, shown
from graphs.ids import JointId, LinkId
from graphs.loops.cycle_space import cut_into_cycles, dependent_loop, in_span_of
from graphs.mechanism.sc import SCGraph
from graphs.reduce.working import Removal, WorkingGraph

__all__ = ["RULES", "Reduction", "ReductionStep", "reduce"]

RULES = ("ride-along", "dyad")


@dataclass(frozen=True, slots=True)
class ReductionStep:
    """One addendum taken off.

    Attributes
    ----------
    removed : (link, link)
        u and v.
    onto : (link, link)
        a and b, the links they were appended to: a is joined to u, b to v.
    joints : (joint, joint, joint)
        a-u, u-v and v-b.
    joint : joint id or None
        The joint a-b that takes their place; None for a dyad.
    sits_on : int or None
        The step that takes off a or b later on: this addendum sits on that one.
    """

    removed: tuple[LinkId, LinkId]
    onto: tuple[LinkId, LinkId]
    joints: tuple[JointId, JointId, JointId]
    joint: JointId | None
    sits_on: int | None


@dataclass(frozen=True, slots=True)
class Reduction:
    """A reduced mechanism, and how it came about.

    Attributes
    ----------
    original, graph : SCGraph
        Before and after.
    rule : str
    steps : tuple of ReductionStep
        In the order in which they were taken.
    removals : tuple of Removal
        The same, with what is needed to undo them.
    """

    original: SCGraph
    graph: SCGraph
    rule: str
    steps: tuple[ReductionStep, ...]
    removals: tuple[Removal, ...]
    _work: WorkingGraph

    def undo(self, steps: int | None = None) -> SCGraph:
        """Put back what the last steps took off, all of them unless told how many.

        Parameters
        ----------
        steps : int, optional

        Returns
        -------
        SCGraph
            Undoing all steps gives the original, ids included.

        Raises
        ------
        ValueError
            If there are fewer steps.
        """
        number = len(self.removals) if steps is None else steps
        if not 0 <= number <= len(self.removals):
            raise ValueError(f"cannot undo {number} of {len(self.removals)} steps")
        last = self.removals[len(self.removals) - number :]
        for removal in reversed(last):
            self._work.put_back(removal)
        graph = self._work.graph()
        for removal in last:
            self._work.remove(removal.joints[1], removal.dropped, removal.changed, removal.reopened)
        return graph

    def chains(self) -> list[nx.DiGraph]:
        """Return the adjunct addenda: a tree of steps each, from the one on the mechanism outwards."""
        forest = nx.DiGraph()
        forest.add_nodes_from(range(len(self.steps)))
        for i, step in enumerate(self.steps):
            if step.sits_on is not None:
                forest.add_edge(step.sits_on, i)
        return [forest.subgraph(sorted(part)).copy() for part in nx.weakly_connected_components(forest)]

    def to_json(self) -> dict[str, Any]:
        """Return the reduction as plain data, with the keys that scripts rely on (docs/files.md)."""

        def counts(sc: SCGraph) -> dict[str, Any]:
            return {"links": len(sc), "joints": len(sc.joints), "mobility": mobility_report(sc).mobility}

        return {
            "rule": self.rule,
            "before": counts(self.original),
            "after": counts(self.graph),
            "steps": [
                {
                    "removed": list(map(str, step.removed)),
                    "onto": list(map(str, step.onto)),
                    "joints": list(map(str, step.joints)),
                    "joint": None if step.joint is None else str(step.joint),
                    "sits_on": step.sits_on,
                }
                for step in self.steps
            ],
        }


def reduce(
    mechanism: Mechanism, *, rule: str = "ride-along", fully: bool = False, keep: Iterable[LinkId] = ()
) -> Reduction:
    """Take off ride-alongs (or dyads) until none is left.

    Parameters
    ----------
    mechanism : SCGraph, or anything that has an SC graph
        Its SC graph is reduced.
    rule : {"ride-along", "dyad"}, optional
        ``"ride-along"``: a and b are joined, and the cycle a-u-v-b is a sum of loops of one class.
        ``"dyad"``: a and b need not be joined; some loop through u and v has a centre.
    fully : bool, optional
        Take off an addendum even where its block then has no loop left.
    keep : iterable of link ids, optional
        Links that stay: inputs, outputs. The ground link always stays.

    Returns
    -------
    Reduction

    Raises
    ------
    InvariantError
        If a link to keep is not there.
    ValueError
        For an unknown rule.

    Notes
    -----
    The mobility count stays. Ride-along reduction takes linear time and, up to isomorphism, gives the same
    graph in whichever order steps are taken; dyad reduction promises neither.

    Examples
    --------
    A double strip of three by two squares is a four-bar with a ride-along:

    >>> from graphs.convert.panels import scd_from_panels
    >>> squares = [(0, 1, 4, 3), (1, 2, 5, 4), (3, 4, 7, 6), (4, 5, 8, 7), (6, 7, 10, 9), (7, 8, 11, 10)]
    >>> reduction = reduce(scd_from_panels(squares))
    >>> len(reduction.graph), [step.removed for step in reduction.steps]
    (4, [(0, 1)])
    """
    if rule not in RULES:
        raise ValueError(f"the rule {rule!r} is not one of {', '.join(RULES)}")
    sc = to_sc(mechanism)
    protected = set(keep)
    for link in protected:
        if link not in sc:
            raise InvariantError("keep", f"{shown(link)} is to be kept and is no link", "one of the links")
    if sc.ground is not None:
        protected.add(sc.ground)
    work = WorkingGraph(sc)
    take = _take_ride_along if rule == "ride-along" else _take_dyad
    taken: list[tuple[Removal, JointId | None, tuple[LinkId, LinkId]]] = []
    waiting = dict.fromkeys(reversed(list(work.joints)))
    while waiting:
        middle, _ = waiting.popitem()
        found = work.path(middle) if middle in work.joints else None
        if found is None or found[2] in protected or found[3] in protected or found[0] == found[5]:
            continue
        if work.loops_in_block[work.block_of[middle]] == 1 and not fully:
            continue
        step = take(work, middle)
        if step is None:
            continue
        a, b = found[0], found[5]
        taken.append((*step, (a, b)))
        for link in (a, b):
            if work.degree[link] == 2:
                waiting |= dict.fromkeys(work.joints_at(link))
    return Reduction(sc, work.graph(), rule, _steps(taken), tuple(removal for removal, _, _ in taken), work)


def _steps(
    taken: list[tuple[Removal, JointId | None, tuple[LinkId, LinkId]]],
) -> tuple[ReductionStep, ...]:
    """Add to each step the one it sits on: the first that takes off one of its two bases."""
    taker = {link: i for i, (removal, _, _) in enumerate(taken) for link in removal.links}
    steps = []
    for removal, joint, onto in taken:
        later = [taker[link] for link in onto if link in taker]
        steps.append(ReductionStep(removal.links, onto, removal.joints, joint, min(later, default=None)))
    return tuple(steps)


def _take_ride_along(work: WorkingGraph, middle: JointId) -> tuple[Removal, JointId] | None:
    """Take off the ride-along whose two links a joint joins, if it is one."""
    found = work.path(middle)
    assert found is not None
    a, before, _, _, after, b = found
    between = work.original[a][b] if work.original.has_edge(a, b) else ()
    for joint in sorted(between, key=str):
        cycle = frozenset((before, middle, after, joint))
        dropped = work.member_through(cycle, middle)
        if dropped is None:
            continue
        reopened = None
        if dropped in work.closing:
            reopened = _independent_member(work, cycle, middle)
            if reopened is None:
                continue
        others = sorted(work.through[middle] - {dropped})
        return work.remove(middle, dropped, [(index, cycle) for index in others], reopened), joint
    return None


def _independent_member(work: WorkingGraph, cycle: frozenset[JointId], middle: JointId) -> int | None:
    """Return an independent loop through a joint that takes part in the sum that gives a closing loop."""
    independent = [i for i in range(len(work.loops)) if work.alive[i] and i not in work.closing]
    passing = [i for i in independent if i in work.through[middle]]
    if len(passing) == 1:
        return passing[0]
    summands = in_span_of(cycle, [work.loops[i] for i in independent])
    return (
        None if summands is None else next((independent[i] for i in summands if independent[i] in passing), None)
    )


def _take_dyad(work: WorkingGraph, middle: JointId) -> tuple[Removal, None] | None:
    """Take off the dyad whose two links a joint joins, if a loop through it has a centre."""
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
    removal = work.remove(middle, dropped, deltas)
    work.renumber_block(block)
    return removal, None


def _one_cycle(work: WorkingGraph, index: int, dropped: int, done: list[int]) -> set[JointId] | None:
    """Return the sum of two loops as one cycle; if it falls apart, a part that is independent of the rest."""
    merged = work.loops[index] ^ work.loops[dropped]
    parts = [set(part) for part in cut_into_cycles(sorted(merged, key=str), work.joints)]
    if len(parts) == 1:
        return parts[0]
    if index in work.closing:
        return None
    skip = {index, dropped, *done}
    rest = [
        tuple(x) for i, x in enumerate(work.loops) if work.alive[i] and i not in work.closing and i not in skip
    ]
    for part in sorted(parts, key=len, reverse=True):
        if dependent_loop([*rest, tuple(part)]) is None:
            return part
    return None
