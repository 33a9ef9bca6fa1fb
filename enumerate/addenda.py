"""Every addendum of a mechanism: chains of new links between two of its links that close one loop more.

The mechanism stays what it is: none of its axes loses a freedom to lie where it lay. So the new loop is one of

* *ride-along*, or *spherical loop*, on a joint: it passes one joint of the mechanism and has a centre of its own
  on its axis; a ride-along has two new links;
* *dyad*, or *spherical loop*, in a class: it passes joints of one class only, and has its centre; a dyad has two
  new links;
* *spatial loop*: it has no centre, and it does not matter which way it goes through the mechanism.

A chain of k links changes the mobility by k - 2, without a centre by k - 5 (Wiener 2016, Eqs. 5 and 6); every
result is checked by its exact rank. Of those that a symmetry of the mechanism exchanges, one is listed.

Source: Wiener 2016, section 4.2. Theory: docs/theory/scd-enumeration.md.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import networkx as nx
import numpy as np

from enumerate.contracted.binary_links import orbits_of
from enumerate.runner._run import rows_of
from enumerate.runner.job import Column, ListColumn, Row, RowCount, Unit, batches
from graphs.arguments import keywords_checked
from graphs.convert.conversions import graph_of
from graphs.edit.edits import Edit, add_loop
from graphs.errors import InvariantError
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.files.native import dumps
from graphs.identity.chains import chain_id, class_code, symmetries_of_links
from graphs.loops.classes import CentreClass
from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.rank.exact import exact_mobility
from graphs.types import JointId, LinkId

__all__ = ["Addendum", "AddendumJob", "addenda", "addendum_count_job"]

_COLUMNS: dict[str, Column] = {
    "kind": str,
    "a": str,
    "b": str,
    "through": ListColumn(" ", kind=str),
    "new_links": int,
    "links": int,
    "joints": int,
    "centres": int,
    "exact_dof": int,
    "chain": str,
    "mechanism": str,
}

_PAIRS = 50
"""Pairs of links of a unit: each pair is tried with all loops through it, which takes longer than sending the unit."""


@dataclass(frozen=True, slots=True, repr=False)
class Addendum:
    """A mechanism with an addendum.

    Attributes
    ----------
    kind : str
        ``"ride-along"``, ``"dyad"``, ``"spherical loop"`` or ``"spatial loop"``.
    ends : (link, link)
        The links that carry it.
    through : tuple of joint ids
        The joints of the mechanism that the new loop passes.
    edit : Edit
        Before and after.
    mobility : int
        By the exact rank, after.

    Examples
    --------
    >>> next(addenda("k1:Cr")).kind
    'ride-along'
    """

    kind: str
    ends: tuple[LinkId, LinkId]
    through: tuple[JointId, ...]
    edit: Edit
    mobility: int

    def __repr__(self) -> str:
        return f"<Addendum: {self.kind} on {self.ends[0]!r} and {self.ends[1]!r}, M = {self.mobility}>"


@keywords_checked
def addenda(mechanism: MechanismLike, delta_dof: int = 0, *, workers: int = 1) -> Iterator[Addendum]:
    """Yield every addendum that changes the mobility of a mechanism by a number, one of each orbit.

    Parameters
    ----------
    mechanism : Mechanism, str or Path
        Connected. Its SC graph is taken: addenda have no sides yet. Its ground link counts.
    delta_dof : int, optional
        dM; -2 or more: two links have K + 2 new ones between them, or K + 5 in a spatial loop.
    workers : int
        Processes.

    Raises
    ------
    InvariantError
        If the number is too small, or the mechanism has several parts.
    UnsolvableError
        If the mechanism cannot be placed to find its rank.

    Examples
    --------
    On a spherical four-bar: a ride-along on its joint, dyads between neighbours and opposite links, spatial loops:

    >>> from graphs.loops.loop import Loop
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> [(addendum.kind, len(addendum.through)) for addendum in addenda(four_bar, 0)]
    [('ride-along', 1), ('dyad', 3), ('spatial loop', 1), ('dyad', 2), ('spatial loop', 2)]
    """
    graph = graph_of(mechanism_for("addenda", mechanism))
    for row in rows_of(AddendumJob(graph, delta_dof, as_rows=False), workers=workers):
        yield row["addendum"]


@dataclass(frozen=True)
class AddendumJob:
    """All addenda of a mechanism as rows; see `addenda`.

    Attributes
    ----------
    mechanism : SCGraph
    delta_dof : int
    as_rows : bool
        Without it, a row holds the `Addendum` itself, for this process: no file takes it.
    """

    mechanism: SCGraph
    delta_dof: int
    as_rows: bool = True

    def __post_init__(self) -> None:
        if self.delta_dof < -2:
            raise InvariantError("relative mobility", f"a change of {self.delta_dof}", "-2 or more")
        if self.mechanism.components != 1:
            raise InvariantError("connected", f"the mechanism has {self.mechanism.components} parts", "one")
        if isinstance(self.mechanism, SCDGraph):
            object.__setattr__(self, "mechanism", self.mechanism.sc_graph())

    @property
    def columns(self) -> dict[str, Column]:
        """Names and types of the values of a row."""
        return _COLUMNS if self.as_rows else {"addendum": Addendum}

    @property
    def key(self) -> dict[str, Any]:
        """What the job is, in JSON values."""
        return {"enumerate": "addenda", "of": dumps(self.mechanism), "delta_dof": self.delta_dof}

    def pairs(self) -> list[tuple[LinkId, LinkId]]:
        """Return one pair of links of each orbit under the symmetries of the mechanism."""
        pairs = list(combinations(self.mechanism.nodes, 2))
        number = {frozenset(pair): i for i, pair in enumerate(pairs)}
        moves = [
            [number[frozenset((moved[a], moved[b]))] for a, b in pairs] for moved in symmetries_of_links(self.mechanism)
        ]
        least = orbits_of(np.array([range(len(pairs)), *moves], np.int64))
        return [pair for i, pair in enumerate(pairs) if least[i] == i]

    def units(self) -> list[Unit]:
        """Units of some pairs of links each."""
        return [Unit(tuple(pairs), len(pairs)) for pairs in batches(self.pairs(), _PAIRS)]

    def work(self, payload: Sequence[tuple[LinkId, LinkId]]) -> list[Row]:
        """Return the rows of a unit."""
        before = exact_mobility(self.mechanism).mobility
        addenda = (addendum for a, b in payload for addendum in self._between(a, b, before))
        return [_row(addendum) if self.as_rows else (addendum,) for addendum in addenda]

    def interpreted(self, weight: int) -> float:
        """Return no seconds: kernels find orbits only."""
        del weight
        return 0.0

    def number(self, payload: Sequence[tuple[LinkId, LinkId]]) -> int:
        """Return the number of rows of a unit."""
        return len(self.work(payload))

    def _between(self, a: LinkId, b: LinkId, before: int) -> Iterator[Addendum]:
        """Yield the addenda between two links of a mechanism of so much mobility; no symmetry exchanges two."""
        seen: set[Any] = set()
        for kind, through, links, centre in self._loops(a, b):
            edit = add_loop(self.mechanism, a, b, links, centre=centre, through=through)
            new = set(edit.graph.nodes) - set(self.mechanism.nodes)
            code = class_code(edit.graph, new)
            if code in seen:
                continue
            seen.add(code)
            mobility = exact_mobility(edit.graph).mobility
            if mobility == before + self.delta_dof:
                yield Addendum(kind, (a, b), tuple(through), edit, mobility)

    def _loops(self, a: LinkId, b: LinkId) -> Iterator[tuple[str, list[JointId], int, Centre]]:
        """Yield kind, joints passed, number of new links and centre of each new loop between two links."""
        links = self.delta_dof + 2
        between = list(self.mechanism[a].get(b, ()))
        if links > 0 or not between:  # two links are joined once
            for joint in between:
                yield "ride-along" if links == 2 else "spherical loop", [joint], links, Centre.FINITE
            for centre_class in self.mechanism.centre_classes():
                path = self._path(a, b, centre_class)
                if path:
                    yield "dyad" if links == 2 else "spherical loop", path, links, centre_class.centre
        links = self.delta_dof + 5
        yield "spatial loop", self._path(a, b, None) or between[:1], links, Centre.NONE

    def _path(self, a: LinkId, b: LinkId, centre_class: CentreClass | None) -> list[JointId]:
        """Return a shortest path of two joints or more, within a class if one is named; empty if there is none."""
        inside = nx.Graph()
        for joint in self.mechanism.joints if centre_class is None else centre_class.joints:
            u, v = self.mechanism.joints[joint]
            if {u, v} != {a, b}:
                inside.add_edge(u, v, joint=joint)
        if centre_class is None and self.mechanism.has_edge(a, b):
            return []
        if not (a in inside and b in inside and nx.has_path(inside, a, b)):
            return []
        path = nx.shortest_path(inside, a, b)
        return [inside[u][v]["joint"] for u, v in nx.utils.pairwise(path)]


def _row(addendum: Addendum) -> Row:
    after = addendum.edit.graph
    return (
        addendum.kind,
        *map(str, addendum.ends),
        tuple(map(str, addendum.through)),
        len(after) - len(addendum.edit.before),
        len(after),
        len(after.joints),
        len(after.centre_classes()),
        addendum.mobility,
        chain_id(nx.MultiGraph(after)),
        dumps(after),
    )


def addendum_count_job(job: AddendumJob) -> RowCount:
    """Return the job that counts the addenda of a mechanism.

    Parameters
    ----------
    job : AddendumJob
        The job that lists them.

    Examples
    --------
    >>> from enumerate.runner._run import total_of
    >>> from graphs.loops.loop import Loop
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> total_of(addendum_count_job(AddendumJob(four_bar, 0)))
    5
    """
    return RowCount(job, {"count": "addenda", **job.key})
