"""Reducing adjunct addenda: ride-alongs taken off one by one, to a fixed point.

A *ride-along addendum* is two binary links u, v appended to two adjacent links a, b so that the four meet in one
centre; its relative mobility is 0. An *adjunct addendum* is a chain of them. Source: Wiener 2016, sections
4.2.4 and 4.2.5. Theory: docs/theory/reduction.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import networkx as nx

from graphs.convert.table import Mechanism, to_sc
from graphs.count.report import mobility_report
from graphs.errors import InvariantError, check_argument, numbered, shown
from graphs.mechanism.sc import SCGraph
from graphs.printing import Block, Printed, plain
from graphs.reduce.staying import links_of_loops_that_stay
from graphs.reduce.taking import RULES, Taken, Terms, take_all
from graphs.reduce.working import Removal, WorkingGraph
from graphs.types import JointId, LinkId

__all__ = ["Reduction", "ReductionStep", "reduce"]

_MOST_SHOWN = 200


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

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> squares = [(0, 1, 4, 3), (1, 2, 5, 4), (3, 4, 7, 6), (4, 5, 8, 7), (6, 7, 10, 9), (7, 8, 11, 10)]
    >>> [step] = reduce(scd_from_panels(squares)).steps
    >>> step.removed, step.onto, step.sits_on
    ((0, 1), (2, 3), None)
    """

    removed: tuple[LinkId, LinkId]
    onto: tuple[LinkId, LinkId]
    joints: tuple[JointId, JointId, JointId]
    joint: JointId | None
    sits_on: int | None


@dataclass(frozen=True, slots=True)
class Reduction(Printed):
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

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> squares = [(0, 1, 4, 3), (1, 2, 5, 4), (3, 4, 7, 6), (4, 5, 8, 7), (6, 7, 10, 9), (7, 8, 11, 10)]
    >>> reduction = reduce(scd_from_panels(squares))
    >>> len(reduction.original), len(reduction.graph)
    (6, 4)
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
            self._work.repeat(removal)
        return graph

    def chains(self) -> list[nx.DiGraph]:
        """Return the adjunct addenda: a tree of steps each, from the one on the mechanism outwards."""
        forest = nx.DiGraph()
        forest.add_nodes_from(range(len(self.steps)))
        for i, step in enumerate(self.steps):
            if step.sits_on is not None:
                forest.add_edge(step.sits_on, i)
        return [forest.subgraph(sorted(part)).copy() for part in nx.weakly_connected_components(forest)]

    def blocks(self) -> list[Block]:
        """Return the lines that are printed: a tree of steps for each adjunct addendum."""
        counts: list[Block] = [
            f"{when:6}  links {len(sc)}, joints {len(sc.joints)}, mobility {mobility_report(sc).mobility}"
            for when, sc in (("before", self.original), ("after", self.graph))
        ]
        if not self.steps:
            return [*counts, "nothing to take off"]
        chains = self.chains()
        told = f"{len(self.steps)} step(s) in {len(chains)} adjunct addend{'um' if len(chains) == 1 else 'a'}"
        if len(self.steps) > _MOST_SHOWN:
            return [*counts, told, f"more than {_MOST_SHOWN} steps: --json (in Python to_json) lists them"]
        return [*counts, told, *(line for chain in chains for line in self._tree(chain))]

    def _tree(self, chain: nx.DiGraph) -> list[str]:
        """Draw an adjunct addendum from the mechanism outwards."""
        (root,) = (step for step in chain if not chain.in_degree(step))
        lines, waiting = [], [(root, "", "")]
        while waiting:
            number, before, under = waiting.pop()
            step = self.steps[number]
            u, v, a, b = map(plain, (*step.removed, *step.onto))
            lines.append(f"{before}step {number + 1}: links {u}, {v} on {a}, {b}")
            above = sorted(chain.successors(number), reverse=True)
            for place, one in enumerate(above):  # the last comes first, and is taken last
                corner, beside = ("└── ", "    ") if place == 0 else ("├── ", "│   ")
                waiting.append((one, under + corner, under + beside))
        return lines

    def __repr__(self) -> str:
        return f"<Reduction: {self.original!r} to {self.graph!r}, {numbered(len(self.steps), 'step')}>"

    def to_json(self) -> dict[str, Any]:
        """Return the reduction as plain data, with the keys that scripts rely on (docs/command-json.md)."""

        def counts(sc: SCGraph) -> dict[str, Any]:
            return {"links": len(sc), "joints": len(sc.joints), "mobility": mobility_report(sc).mobility}

        return {
            "rule": self.rule,
            "before": counts(self.original),
            "after": counts(self.graph),
            "steps": [
                {
                    "removed": list(step.removed),
                    "onto": list(step.onto),
                    "joints": list(step.joints),
                    "joint": step.joint,
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
    The mobility count stays. Ride-along reduction takes linear time and, up to isomorphism, gives the same graph,
    with the same centres, in whichever order the parts of the mechanism are given. Where a block comes down to
    a single four-bar and several of its four-bars could be it, one of the most general kind stays: a finite centre
    before one at infinity, a centre of its own before one that another block has too (docs/theory/reduction.md).
    Dyad reduction promises neither.

    Examples
    --------
    A double strip of three by two squares is a four-bar with a ride-along:

    >>> from graphs.convert.panels import scd_from_panels
    >>> squares = [(0, 1, 4, 3), (1, 2, 5, 4), (3, 4, 7, 6), (4, 5, 8, 7), (6, 7, 10, 9), (7, 8, 11, 10)]
    >>> reduction = reduce(scd_from_panels(squares))
    >>> len(reduction.graph), [step.removed for step in reduction.steps]
    (4, [(0, 1)])
    """
    check_argument("reduce", mechanism, Mechanism)
    if rule not in RULES:
        raise InvariantError("rule", f"the rule {shown(rule)}", "one of " + ", ".join(RULES))
    sc = to_sc(mechanism)
    protected = set(keep)
    for link in protected:
        if link not in sc:
            raise InvariantError("keep", f"{shown(link)} is to be kept and is no link", "one of the links")
    if sc.ground is not None:
        protected.add(sc.ground)
    terms = Terms(rule, fully, frozenset(protected))
    work = WorkingGraph(sc)
    taken = take_all(work, terms)
    if rule == "ride-along" and not fully and (stay := links_of_loops_that_stay(work, taken, terms.protected)):
        work = WorkingGraph(sc)
        taken = take_all(work, Terms(rule, fully, terms.protected | stay))
    return Reduction(sc, work.graph(), rule, _steps(taken), tuple(one.removal for one in taken), work)


def _steps(taken: Sequence[Taken]) -> tuple[ReductionStep, ...]:
    """Add to each step the one it sits on: the first that takes off one of its two bases."""
    taker = {link: i for i, one in enumerate(taken) for link in one.removal.links}
    steps = []
    for removal, joint, onto in taken:
        later = [taker[link] for link in onto if link in taker]
        steps.append(ReductionStep(removal.links, onto, removal.joints, joint, min(later, default=None)))
    return tuple(steps)
