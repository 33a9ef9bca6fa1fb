"""Designs of a task ranked: the best of each type, the Pareto list, and why the other types fell out.

Three figures are compared: by how much the wishes are missed, the number of links, and the largest sensitivity of a
wish to a dimension: how exactly it has to be made. Guide: docs/guides/from-a-task.md.
"""

from __future__ import annotations

import json
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cached_property
from math import degrees, inf, pi
from typing import Any

from graphs.errors import numbered
from graphs.printing import Block, Printed, TableBlock
from synth.synthesis.designing.defects import Defect, DefectKind, first_kind, sentence_of
from synth.synthesis.designing.designs import MET_DIGITS, Design
from synth.synthesis.tasks.dimensioning import Candidate, CandidateSearch, Rows, candidates_of
from synth.synthesis.tasks.record import Task
from synth.synthesis.tasks.structure import PlacedType, TaskStructure, reasons_text

WITHIN = 1e-6
"""Radians, or parts of the extent: a design whose weighted misses are larger has not met the wishes. Wishes in files
are rounded, as quaternions of nine digits, and a design that meets them as they were meant may miss them by that."""
_FIGURES = 6
"""Figures of a sensitivity by which designs are compared; later ones differ among processors."""
_HEADS = ("rank", "type", "links", "roles", "largest miss", "sensitivity", "travel", "Pareto")
_MISSED_HEADS = ("not ranked", "links", "roles", "largest miss", "defect", "starts by defect")
_MOST_MISSED = 10
"""Types that are not ranked, and are printed: all are in the JSON and in the report."""


class Outcome(Enum):
    """What became of a start whose design has no defect: it meets the wishes, or misses them.

    Examples
    --------
    >>> Outcome.MISSED.title
    'misses above 1e-06'
    """

    SUCCESS = "success"
    MISSED = "missed"

    @property
    def title(self) -> str:
        """What is counted, in words."""
        return "success" if self is Outcome.SUCCESS else f"misses above {WITHIN:g}"


StartOutcome = Outcome | DefectKind
"""What is counted of a start: a design that meets the wishes and is no success has the kind of its first defect."""


@dataclass(frozen=True)
class RankedDesign:
    """The best design of a type for a task.

    Attributes
    ----------
    candidate : Candidate
        The type, and the placement of the roles.
    start : int
    miss : float
        The largest weighted miss of a wish, radians or parts of the extent.
    misses : tuple of float
        Those of the wishes, without weights.
    sensitivity : float
        The largest change of a wish for a unit change of a dimension.
    travel : float or None
        How far the driven joint turns from the first configuration to the last, radians; None if none is driven.
    defects : tuple of Defect
        Why it is no success; none of a success.
    pareto : bool
        Whether no other success is better in one figure, and as good in the others.
    record : mapping
        The row of the design.

    Examples
    --------
    >>> RankedDesign(Candidate(0, "chains", "k1:Cr", (0, 2)), 0, 0.0, (0.0,), 2.0, None, (), True, {}).meets
    True
    """

    candidate: Candidate
    start: int
    miss: float
    misses: tuple[float, ...]
    sensitivity: float
    travel: float | None
    defects: tuple[Defect, ...]
    pareto: bool = False
    record: Mapping[str, Any] = field(default_factory=dict, compare=False)

    @property
    def meets(self) -> bool:
        """Whether its wishes are met, whatever its defects are."""
        return self.miss <= WITHIN

    @property
    def outcome(self) -> StartOutcome:
        """What is counted of its start: no member, else wishes that are missed, else the first of its defects."""
        kind = first_kind(self.defects)
        if kind is DefectKind.NO_MEMBER:
            return kind
        if not self.meets:
            return Outcome.MISSED
        return Outcome.SUCCESS if kind is None else kind

    @property
    def faults(self) -> str:
        """Its defects in sentences, to be printed."""
        return "; ".join(map(sentence_of, self.defects))

    @property
    def figures(self) -> tuple[float, int, float]:
        """What is compared: miss, numbers of links are added by the ranking, sensitivity."""
        return round(self.miss, MET_DIGITS), 0, float(f"{self.sensitivity:.{_FIGURES}g}")


@dataclass(frozen=True, repr=False)
class RankedTypes(Printed):
    """The answer to a task with wishes: types that can do it, ranked; and why the others cannot.

    Attributes
    ----------
    structure : TaskStructure
    ranked : tuple of RankedDesign
        The best design of each type that meets the wishes without defects.
    missed : tuple of RankedDesign
        The best of each other type, nearest first.
    starts : int
        How many starts were made.
    seed : int
    outcomes : mapping of (str, str) to mapping of StartOutcome to int
        For each source and id of a type, numbers of starts: successes, and by the reason why they are none.

    Examples
    --------
    >>> from synth.synthesis.tasks.dimensioning import halved
    >>> from synth.synthesis.tasks.structure import structure_of
    >>> from synth.synthesis.tasks.task_files import read_task
    >>> structure = structure_of(read_task("data/tasks/lid.json"))
    >>> ranked_types(structure, halved(structure, starts=2, rounds=1))
    <RankedTypes: 1 of 2 types>
    """

    structure: TaskStructure
    ranked: tuple[RankedDesign, ...]
    missed: tuple[RankedDesign, ...]
    starts: int
    seed: int = 0
    outcomes: Mapping[tuple[str, str], Mapping[StartOutcome, int]] = field(default_factory=dict)

    @property
    def task(self) -> Task:
        """The task."""
        return self.structure.task

    @property
    def best(self) -> RankedDesign | None:
        """The first; None if no type can do it."""
        return self.ranked[0] if self.ranked else None

    @cached_property
    def fell_out(self) -> dict[StartOutcome, int]:
        """Numbers of types that fell out when they were designed, by what became of the best design of each."""
        return counted(one.outcome for one in self.missed)

    def design(self, one: RankedDesign) -> Design:
        """Return a ranked design with its mechanism."""
        return CandidateSearch(self.task, one.candidate, self.seed).of_record(one.start, one.record)

    def name(self, one: RankedDesign) -> str:
        """Return the name of the type of a design."""
        return self._placed[one.candidate.code, one.candidate.source].type.name

    def links(self, one: RankedDesign) -> int:
        """Return the number of links of the type of a design."""
        return len(self._placed[one.candidate.code, one.candidate.source].type.bodies)

    @cached_property
    def _placed(self) -> dict[tuple[str, str], PlacedType]:
        return {(one.type.code, one.type.source): one for one in self.structure.placed}

    def __repr__(self) -> str:
        return f"<RankedTypes: {len(self.ranked)} of {numbered(self.structure.types, 'type')}>"

    def first_lines(self) -> list[str]:
        """Return the answer in sentences."""
        of, starts = numbered(self.structure.types, "type"), numbered(self.starts, "start")
        lines = [f"{len(self.ranked)} of {of} can do it ({starts})"]
        left_out = {**self.structure.left_out, **{one.title: number for one, number in self.fell_out.items()}}
        if left_out:
            lines.append("types left out: " + reasons_text(left_out))
        if not self.ranked and self.missed:
            one = self.missed[0]
            fault = f"; {one.faults}" if one.faults else ""
            miss = "all wishes met" if round(one.miss, MET_DIGITS) == 0.0 else f"largest miss {one.miss:.2e}"
            lines.append(f"nearest: {self.name(one)} ({self._roles(one)}), {miss}{fault}")
        return lines

    def rows(self) -> list[tuple[str, ...]]:
        """Return the row of each ranked design."""
        return [
            (
                str(place), self.name(one), str(self.links(one)), self._roles(one),
                "met" if round(one.miss, MET_DIGITS) == 0.0 else f"{one.miss:.1e}",
                f"{one.sensitivity:.3g}", "" if one.travel is None else f"{degrees(one.travel):.1f}°",
                "yes" if one.pareto else "",
            )
            for place, one in enumerate(self.ranked, 1)
        ]  # fmt: skip

    def ranked_table(self) -> TableBlock:
        """Return the table of ranked designs."""
        return TableBlock(_HEADS, self.rows(), ("rank", "links"))

    def missed_table(self, most: int | None = None) -> TableBlock:
        """Return the table of types that are not ranked, nearest first: defects of the best design, of all starts."""
        rows = []
        for one in self.missed[:most]:
            starts = self.outcomes.get((one.candidate.source, one.candidate.code), {})
            counts = ", ".join(f"{_short(outcome)}: {number}" for outcome, number in starts.items())
            miss = "met" if one.meets else f"{one.miss:.1e}"
            rows.append((self.name(one), str(self.links(one)), self._roles(one), miss, one.faults, counts))
        return TableBlock(_MISSED_HEADS, rows, ("links",))

    def _roles(self, one: RankedDesign) -> str:
        return ", ".join(f"{role} {link}" for role, link in zip(self.task.roles, one.candidate.links, strict=True))

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        lines: list[Block] = list(self.first_lines())
        if self.ranked:
            lines.append(self.ranked_table())
        if self.missed:
            lines.append(self.missed_table(_MOST_MISSED))
        if len(self.missed) > _MOST_MISSED:
            lines.append(f"and {numbered(len(self.missed) - _MOST_MISSED, 'type')} farther off")
        return lines

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on (docs/command-json.md)."""
        return {
            "types": self.structure.types,
            "placements": self.structure.placements,
            "starts": self.starts,
            "left_out": {**self.structure.left_out, **{one.value: number for one, number in self.fell_out.items()}},
            "placements_left_out": dict(self.structure.placements_left_out),
            "ranked": [self._json(one) for one in self.ranked],
            "missed": [self._json(one) for one in self.missed],
        }

    def _json(self, one: RankedDesign) -> dict[str, Any]:
        pairs = zip(self.task.roles, one.candidate.links, strict=True)
        outcomes = self.outcomes.get((one.candidate.source, one.candidate.code), {})
        return {
            "type": one.candidate.code,
            "name": self.name(one),
            "from": one.candidate.source,
            "links": self.links(one),
            "roles": {role: str(link) for role, link in pairs},
            "start": one.start,
            "miss": one.miss,
            "misses": list(one.misses),
            "residual": one.record.get("error"),
            "sensitivity": one.sensitivity,
            "travel_deg": None if one.travel is None else degrees(one.travel),
            "pareto": one.pareto,
            "defects": [defect.to_json() for defect in one.defects],
            "faults": one.faults,
            "outcomes": {outcome.value: number for outcome, number in outcomes.items()},
        }


def ranked_types(
    structure: TaskStructure, rows: Rows, weights: Mapping[int, float] | None = None, seed: int = 0
) -> RankedTypes:
    """Rank the designs that a task's starts gave.

    Parameters
    ----------
    structure : TaskStructure
    rows : list of dict
        As `synth.synthesis.tasks.dimensioning.halved` returns them.
    weights : mapping of int to float, optional
        Weights of wishes by their numbers, from 0, in place of 1: a wish of weight 0 does not count.
    seed : int, optional
        Of the starts.

    Returns
    -------
    RankedTypes

    Examples
    --------
    >>> from synth.synthesis.tasks.structure import structure_of
    >>> ranked_types(structure_of(Task(sources=("sc",))), [])
    <RankedTypes: 0 of 5 types>
    """
    candidates = candidates_of(structure)
    by_type: dict[tuple[str, str], list[RankedDesign]] = defaultdict(list)
    for row in rows:
        candidate = candidates[row["candidate"]]
        by_type[candidate.source, candidate.code].append(_of_row(candidate, row, weights or {}))
    size = {(one.type.source, one.type.code): len(one.type.bodies) for one in structure.placed}
    best = [min(some, key=_order) for some in by_type.values()]
    successes = [one for one in best if one.outcome is Outcome.SUCCESS]
    links = {id(one): size[one.candidate.source, one.candidate.code] for one in best}

    def figures(one: RankedDesign) -> tuple[float, int, float]:
        miss, _, sensitivity = one.figures
        return miss, links[id(one)], sensitivity

    marked = [(one, not any(_beats(figures(other), figures(one)) for other in successes)) for one in successes]
    marked.sort(key=lambda pair: (not pair[1], *_ranks(figures(pair[0])), pair[0].candidate.number))
    ranked = tuple(replace(one, pareto=pareto) for one, pareto in marked)
    missed = sorted((one for one in best if one.outcome is not Outcome.SUCCESS), key=_order)
    outcomes = {key: counted(one.outcome for one in some) for key, some in by_type.items()}
    return RankedTypes(structure, ranked, tuple(missed), len(rows), seed, outcomes)


def _ranks(figures: tuple[float, int, float]) -> tuple[float, ...]:
    """Return the order of successes: fewest links first, then how exactly they have to be made, then the miss."""
    miss, links, sensitivity = figures
    return links, sensitivity, miss


def _beats(one: Sequence[float], other: Sequence[float]) -> bool:
    return all(a <= b for a, b in zip(one, other, strict=True)) and tuple(one) != tuple(other)


def _order(one: RankedDesign) -> tuple[float, ...]:
    """Return the order of designs of one type: successes, then the nearest, the least defects, the least sensitive."""
    success = one.outcome is Outcome.SUCCESS
    return not success, round(one.miss, MET_DIGITS), *_severity(one), one.figures[2], one.candidate.number, one.start


def _severity(one: RankedDesign) -> tuple[int, int]:
    """Return how bad the defects of a design are: it has none, its motion has some, or it does not move as it is to.

    The second number is that of the configurations on other circuits than the first.
    """
    kind = first_kind(one.defects)
    if kind is None:
        return 0, 0
    if not kind.of_motion:
        return 2, 0
    return 1, sum(len(defect.configurations) for defect in one.defects if defect.kind is DefectKind.CIRCUIT)


def _of_row(candidate: Candidate, row: Mapping[str, Any], weights: Mapping[int, float]) -> RankedDesign:
    """Return the design of a row, its misses weighed anew."""
    record = json.loads(row["record"])
    defects = tuple(map(Defect.of_json, record["defects"]))
    if first_kind(defects) is DefectKind.NO_MEMBER:
        return RankedDesign(candidate, row["start"], pi, (), inf, None, defects)
    misses = tuple(figure["part"] for figure in record["figures"])
    weighed = [part * weights.get(number, 1.0) for number, part in enumerate(misses)]
    sensitivity = max((max(one["sensitivity"].values(), default=0.0) for one in record["figures"]), default=0.0)
    inputs = record["inputs"]
    travel = max(inputs) - min(inputs) if inputs else None
    most = max(weighed, default=0.0)
    return RankedDesign(candidate, row["start"], most, misses, sensitivity, travel, defects, False, record)


def counted(outcomes: Iterable[StartOutcome]) -> dict[StartOutcome, int]:
    """Return how often each outcome is among some, in the order of their values.

    >>> counted([DefectKind.ORDER, Outcome.SUCCESS, DefectKind.ORDER])
    {<DefectKind.ORDER: 'order'>: 2, <Outcome.SUCCESS: 'success'>: 1}
    """
    return dict(sorted(Counter(outcomes).items(), key=lambda pair: pair[0].value))


def _short(outcome: StartOutcome) -> str:
    """Return an outcome for a cell of a table: the defects of a motion by their names in Chase and Mirth 1993."""
    of_motion = isinstance(outcome, DefectKind) and outcome.of_motion
    return outcome.value if of_motion else outcome.title
