"""Conical candidates evaluated: a job for the runner of every enumerator (`enumerate.runner._run`).

A row is a cyclic order of a chain's joints, or an order with opposites, or joints on slots or at sampled angles.
Candidates come from `enumerate.conical.query`, their values from `synth.synthesis.candidates.rows`. Theory:
docs/theory/conical-candidates.md.
"""

from collections.abc import Mapping
from dataclasses import astuple, dataclass
from functools import cached_property
from math import degrees
from typing import Any

import numpy as np

from enumerate.conical.query import ConicalQuery, Portion
from enumerate.machine_code.weights import PLACED, SIGNS
from enumerate.runner._run import rows_of
from enumerate.runner.job import Column, Counting, Row, Unit
from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.files.native import dumps
from graphs.identity.chains import chain_id
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import Cone, Cylinder, Surface, SurfaceLinkage
from graphs.types import Floats, Ints, LinkId
from synth.linkages.conformed.rates import ConformedChain, loops_of_chain
from synth.synthesis.candidates.rows import CandidateChain, order_rows, placed_rows

_PLACED, _SETS = 20_000, 1 << 15
"""Placements per unit, without symmetric ones; orders with opposites per unit of cyclic orders."""


@dataclass(frozen=True, slots=True)
class Filter:
    """A condition on a column: a value, or limits.

    Attributes
    ----------
    column : str
    value : object
        The required value of the column; None: see the limits.
    least, most : int or None

    Examples
    --------
    >>> Filter("layers", most=2).admits(3)
    False
    """

    column: str
    value: object = None
    least: int | None = None
    most: int | None = None

    def admits(self, value: Any) -> bool:
        """Check whether a value meets the condition."""
        if self.value is not None:
            return bool(value == self.value)
        return (self.least is None or value >= self.least) and (self.most is None or value <= self.most)


@dataclass(frozen=True)
class CandidateJob:
    """All conical candidates of a chain, as rows.

    Attributes
    ----------
    chain : SCGraph
        Connected.
    grounds : tuple of (link id or None)
        Fixed links; None: no link is fixed, and rows have no senses of rotation.
    slots : int, optional
        Joints on so many equal slots of the circle; else cyclic orders.
    opposites : bool
        A row for each order with opposites.
    samples : int, optional
        So many random sets of angles for each cyclic order.
    seed : int
    surface : Cone or Cylinder, optional
        Link angles, or lengths, and Grashof classes on it. Without it the classes are those on a cylinder.
    filters : tuple of Filter
        Only rows that meet all.

    Raises
    ------
    InvariantError
        If the chain is in several parts or has fewer than three joints, a filter names no column, or slots,
        opposites and samples are not one of the three.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> chain = SCGraph(4, dict(zip("OABC", [(0, 1), (1, 2), (2, 3), (3, 0)])), [Loop(tuple("OABC"))])
    >>> job = CandidateJob(chain, (0,))
    >>> for row in job.rows():
    ...     print(row["order"], row["circuits"], row["linkage"], row["one_way"])
    ['O', 'A', 'B', 'C'] ['open'] by angles 2
    ['O', 'A', 'C', 'B'] ['crossed'] by angles 2
    ['O', 'B', 'A', 'C'] ['crossed'] by angles 4
    """

    chain: SCGraph
    grounds: tuple[LinkId | None, ...] = (None,)
    slots: int | None = None
    opposites: bool = False
    samples: int | None = None
    seed: int = 0
    surface: Surface | None = None
    filters: tuple[Filter, ...] = ()

    def __post_init__(self) -> None:
        if sum((self.slots is not None, self.opposites, self.samples is not None)) > 1:
            raise InvariantError("candidates", "several of slots, opposites and samples", "one of them")
        if self.surface is not None and not self.placed:
            what = f"a {self.surface.kind} for orders without angles"
            raise InvariantError("surface", what, "slots or samples with it")
        for ground in self.grounds:
            ConformedChain.of(self.chain, ground)  # connected, and the ground is a link
        if not self.chain.independent_loops:
            raise UnsolvableError("the chain has no loops, so all placements of its joints are equivalent")
        _ = self.query
        for condition in self.filters:
            if condition.column not in self.columns:
                what = f"there is no column {shown(condition.column)} in these rows"
                raise InvariantError("filter", what, f"one of {', '.join(self.columns)}")

    @property
    def placed(self) -> bool:
        """Whether rows have angles."""
        return self.slots is not None or self.samples is not None

    @cached_property
    def query(self) -> ConicalQuery:
        """Which candidates are enumerated."""
        return ConicalQuery(tuple(self.chain.joints.items()), self.grounds, self.slots, self.opposites)

    @cached_property
    def _candidate_chains(self) -> dict[LinkId | None, CandidateChain]:
        number = {joint: i for i, joint in enumerate(self.chain.joints)}
        loops = tuple(tuple(number[joint] for joint in loop) for loop in loops_of_chain(self.chain))
        code, links = chain_id(self.chain), tuple(map(str, self.chain))
        return {
            ground: CandidateChain(ConformedChain.of(self.chain, ground), code, ground is not None, links, loops)
            for ground in self.grounds
        }

    @cached_property
    def columns(self) -> dict[str, Column]:
        """Names and types of the values of a row."""
        candidate = self._candidate_chains[self.grounds[0]]
        return candidate.columns(self.placed, self.opposites, self.surface, self.slots is not None)

    @property
    def key(self) -> dict[str, Any]:
        """The identity of the job, in JSON values."""
        return {
            "enumerate": "conical",
            **self.query.key,
            "samples": self.samples,
            "seed": self.seed if self.samples is not None else None,
            "lambda_deg": round(degrees(self.surface.angle), 12) if isinstance(self.surface, Cone) else None,
            **({"radius": self.surface.radius} if isinstance(self.surface, Cylinder) else {}),
            "filters": [list(astuple(condition)) for condition in self.filters],
        }

    def units(self) -> list[Unit]:
        """Units of some thousands of placements, or of orders with opposites, each."""
        most = max(_PLACED // (self.samples or 1), 1) if self.placed else self._orders_at_once
        return [Unit(portion, weight) for portion, weight in self.query.portions(most)]

    @property
    def _orders_at_once(self) -> int:
        return _SETS if self.opposites else max(_SETS >> (len(self.chain.joints) - 1), 1)

    def interpreted(self, weight: int) -> float:
        """Return about how many seconds the job takes with kernels interpreted, for so many placements."""
        if self.placed:
            return PLACED * weight * (self.samples or 1)
        return SIGNS * weight * (1 if self.opposites else 2.0 ** (len(self.chain.joints) - 1))

    def work(self, payload: Portion) -> list[Row]:
        """Return the rows of a unit."""
        slots, symmetry = self.query.placements(payload)
        if not len(slots):
            return []
        candidate = self._candidate_chains[payload.ground]
        if not self.placed:
            size = self._orders_at_once
            rows = [
                row
                for i in range(0, len(slots), size)
                for row in order_rows(candidate, slots[i : i + size], symmetry[i : i + size], self.opposites)
            ]
        elif self.samples is not None:
            places = self._sampled(slots, payload)
            slots, symmetry = (np.repeat(rows, self.samples, axis=0) for rows in (slots, symmetry))
            rows = placed_rows(candidate, places, slots, symmetry, False, self.surface)
        else:
            places = np.asarray(slots * (2 * np.pi / self.query.rounds.slots), dtype=float)
            rows = placed_rows(candidate, places, slots, symmetry, True, self.surface)
        if self.filters:
            names = list(self.columns)
            conditions = [(names.index(condition.column), condition) for condition in self.filters]
            rows = [row for row in rows if all(condition.admits(row[place]) for place, condition in conditions)]
        return rows

    def _sampled(self, slots: Ints, payload: Portion) -> Floats:
        """Return random azimuths in some cyclic orders; the portion seeds them, so that runs agree."""
        assert self.samples is not None
        rng = np.random.default_rng([self.seed, self.grounds.index(payload.ground), *payload.prefix])
        count, joints = len(slots) * self.samples, slots.shape[1]
        gaps = rng.exponential(size=(count, joints)) + 1e-6
        ends = np.cumsum(gaps, axis=1)
        starts = 2 * np.pi * (ends - gaps) / ends[:, -1:]
        return np.asarray(np.take_along_axis(starts, np.repeat(slots, self.samples, axis=0), axis=1))

    def rows(self) -> list[dict[str, Any]]:
        """Return all rows as dictionaries, computed in this process."""
        return list(rows_of(self))

    def places(self, row: Mapping[str, Any]) -> Floats:
        """Return the azimuths of the joints of a row, radians; of an order, evenly spaced, opposites too."""
        if "azimuths_deg" in row:
            return np.asarray(np.radians(row["azimuths_deg"]))
        return np.array(row["slots"]) * (2 * np.pi / self.query.rounds.slots)

    def linkage(self, row: Mapping[str, Any]) -> SurfaceLinkage:
        """Return the linkage of a row; of an order, one whose joints, with the opposites, are evenly spaced."""
        chain = self.chain
        ground = next((link for link in chain if str(link) == row.get("ground")), None)
        fixed = SCGraph(chain.nodes, chain.joints, chain.loops, ground=ground)
        return SurfaceLinkage.placed(fixed, self.places(row).tolist(), self.surface)

    def mechanism_text(self, row: Mapping[str, Any]) -> str:
        """Return the file of the linkage of a row, ``synthedra/conical`` or ``synthedra/cylindrical``."""
        return dumps(self.linkage(row))


@dataclass(frozen=True)
class CandidateCountJob(Counting):
    """The number of rows of a job, where they have to be made to be counted.

    Attributes
    ----------
    rows : CandidateJob

    Examples
    --------
    >>> from enumerate.runner._run import total_of
    >>> from graphs.loops.loop import Loop
    >>> chain = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> total_of(CandidateCountJob(CandidateJob(chain, (0,))))
    3
    """

    rows: CandidateJob

    @property
    def key(self) -> dict[str, Any]:
        """The identity of the job, in JSON values."""
        return {"count": "conical", **self.rows.key}

    def units(self) -> list[Unit]:
        """Return the units of the job."""
        return self.rows.units()

    def interpreted(self, weight: int) -> float:
        """Return what the job says."""
        return self.rows.interpreted(weight)

    def work(self, payload: Portion) -> list[Row]:
        """Return the number of rows of a unit."""
        return [(len(self.rows.work(payload)),)]
