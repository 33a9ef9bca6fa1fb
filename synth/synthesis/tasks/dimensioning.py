"""Dimensions for each type and placement of a task, by successive halving: units of the runner.

In each round every candidate that is left has some starts, each from a random member of its type; then the half whose
best design is nearest to the wishes goes on with twice as many. What a start begins with depends on the seed, the type,
the placement and the number of the start alone, so a run that was killed comes to the same rows. Guide:
docs/guides/from-a-task.md.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property, lru_cache
from hashlib import sha256
from itertools import permutations
from math import ceil, pi, tau
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from enumerate.runner._run import rows_of, run
from enumerate.runner.job import Column, Progress, Row, Unit, row_as_dict
from enumerate.runner.store import SqliteSink, read_rows
from graphs.errors import StoreError, SynthedraError
from graphs.files.atomic import make_folder
from graphs.joints.linkage import plain_vector
from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import Cone, SurfaceLinkage
from graphs.rank.realisation import Reals, realise
from graphs.types import JointId, LinkId
from synth.catalogue.patterns.generators import GENERATORS
from synth.catalogue.realisation._realise import realise as sheet_realisation
from synth.linkages.guidance.orientations import Orientations
from synth.linkages.guidance.sixbars import GuidedSixBar, links_of, six_bars
from synth.synthesis.designing.defects import Defect, DefectKind, kinds_of
from synth.synthesis.designing.designs import MET_DIGITS, Design, DesignSearch
from synth.synthesis.designing.dimensions import Designable
from synth.synthesis.designing.job import START_WEIGHT
from synth.synthesis.designing.search import seeded
from synth.synthesis.designing.wish_files import wishes_of_document
from synth.synthesis.designing.wishes import LinkOrientation, Wishes
from synth.synthesis.tasks.planes import turned_to_wishes
from synth.synthesis.tasks.record import Task, renamed
from synth.synthesis.tasks.structure import CandidateType, Placement, TaskStructure
from synth.synthesis.tasks.task_files import wishes_document


@dataclass(frozen=True, slots=True)
class HalvingManner:
    """How the starts of a task are made, and how many there are.

    Examples
    --------
    >>> HALVING.starts, HALVING.rounds
    (2, 4)
    """

    starts: int = 2
    """Of each candidate in the first round: one alone may end on another circuit, as 14 of 36 starts of four-bars
    through three orientations did, or turn back."""
    rounds: int = 4
    """With twice as many starts in each, 30 for the best: what succeeds at a tenth of its starts is missed by 4 %."""
    spread: float = 0.3
    """How far starts of a generator are off its default parameters, as parts of them: other proportions, and still
    within the ranges of most parameters. Of other types starts are random."""
    cones: tuple[float, float] = (0.15, 1.2)
    """Least and largest angle of the cones on which starts lie, radians: axes on a narrower one are nearly one line, on
    a wider one nearly in a plane, and there arcs of links hardly depend on the cone angle."""
    populations: int = 4
    """Populations of six-bars that guide, tried at a start: each takes some seconds, and a start is a unit, between
    which alone a run stops."""
    kept: int = 4
    """Candidates whose searches are kept at a time: starts of one come one after the other, and a process has no more
    of them at work."""


HALVING = HalvingManner()
COLUMNS: dict[str, Column] = {
    "candidate": int, "start": int, "success": bool, "miss": float, "residual": float, "freedoms": int, "defects": str,
    "record": str,
}  # fmt: skip
"""Values of a row; `defects` are the values of their kinds, and `record` is the rest of the design as JSON."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """A type with one placement of the roles, by its number among those that a task admits.

    Attributes
    ----------
    number : int
    source, code : str
        As of `CandidateType`.
    links : tuple of link id
        The link of each role.

    Examples
    --------
    >>> Candidate(0, "chains", "k1:Cr", (0, 2)).type_of().name
    'four-bar'
    """

    number: int
    source: str
    code: str
    links: Placement

    def type_of(self, task: Task | None = None) -> CandidateType:
        """Return its type."""
        return CandidateType.of(self.source, self.code, task)


def candidates_of(structure: TaskStructure) -> tuple[Candidate, ...]:
    """Return the candidates of a structure, in the order of its types and placements.

    Parameters
    ----------
    structure : TaskStructure

    Returns
    -------
    tuple of Candidate

    Examples
    --------
    >>> from synth.synthesis.tasks.structure import structure_of
    >>> len(candidates_of(structure_of(Task(sources=("sc",)))))
    29
    """
    every = [(one.type, links) for one in structure.placed for links in one.placements]
    return tuple(Candidate(number, one.source, one.code, links) for number, (one, links) in enumerate(every))


class CandidateSearch:
    """The search for designs of one candidate of a task.

    Parameters
    ----------
    task : Task
        With wishes.
    candidate : Candidate
    seed : int

    Examples
    --------
    >>> from synth.synthesis.tasks.task_files import task_of_document
    >>> wish = {"kind": "orientation", "at": "up", "link": "output", "quaternion": [0.9, 0.1, 0.2, 0.1]}
    >>> wishes = {"configurations": [{"name": "up"}], "wishes": [wish]}
    >>> task = task_of_document({"format": "synthedra/task", "version": 1, "wishes": wishes}, Path("task.json"))
    >>> design = CandidateSearch(task, Candidate(0, "chains", "k1:Cr", (0, 2)), 0).design(0)
    >>> design.closed, design.figures[0].met
    (True, True)
    """

    def __init__(self, task: Task, candidate: Candidate, seed: int) -> None:
        self.task, self.candidate, self.seed = task, candidate, seed
        self.type = _type_of(task.place, candidate.source, candidate.code, _stated(task, candidate.code))
        self.base: LinkId | None = dict(zip(task.roles, candidate.links, strict=True)).get("base")
        assert task.wishes is not None
        link_of = {role: self._link_name(link) for role, link in zip(task.roles, candidate.links, strict=True)}
        joint_of = {}
        for one, other in ((a, b) for a in task.roles for b in task.roles if a != b):
            pair = [candidate.links[task.roles.index(role)] for role in (one, other)]
            joint = self.type.joint_between(pair[0], pair[1])
            if joint is not None:
                joint_of[f"{one}-{other}"] = self._joint_name(joint)
        document = wishes_document(renamed(task.wishes, link_of, joint_of))
        # wishes say how bodies move from where they are, so the motion through the configurations begins there
        self.wishes = replace(wishes_of_document(document, task.place), from_start=True)

    def _link_name(self, link: LinkId) -> str:
        return str(list(self.type.mechanism.nodes).index(link)) if self.type.source == "scd" else str(link)

    def _joint_name(self, joint: JointId) -> str:
        return str(list(self.type.mechanism.joints).index(joint)) if self.type.source == "scd" else str(joint)

    def search(self, start: int) -> DesignSearch:
        """Return the search from a random member of the type; of a generator, from its parameters.

        There is one problem for all starts. Only sheets of SCD graphs have one for each: their rules and folded states
        are read off the sheet.
        """
        if self.type.values is not None:
            return self._whole
        if self.type.source == "scd":
            base = None if self.base is None else list(self.type.mechanism.nodes).index(self.base)
            return self._searched(self.member(start), self.wishes, base)
        return self._whole.begun_at(self.member(start))  # type: ignore[arg-type]

    @cached_property
    def _whole(self) -> DesignSearch:
        """The search with the problem of all starts: it must not depend on which of them is asked for first."""
        if self.type.values is None:
            rng = seeded(f"{self.seed} {self.type.source} {self.type.code} {self.candidate.links} unit", 0)
            return self._searched(self._random(self._chain, rng), self.wishes, self.base)
        if all(one.unit == "count" for one in GENERATORS[self.type.code].parameters):
            assert self.type.made is not None  # without parameters that may change, its vertices or axes do
            return self._searched(self.type.made, self.wishes, self.base)
        wishes = replace(self.wishes, parameters={**self.type.values, **self.wishes.parameters})
        return self._searched(self.candidate.code, wishes, self.base)

    def _searched(self, mechanism: Designable, wishes: Wishes, base: LinkId | None) -> DesignSearch:
        return DesignSearch(mechanism, wishes, HALVING.spread, self.seed, ground=base, freedoms=self.task.freedoms)

    def member(self, start: int) -> HingedSolids | SurfaceLinkage | Sheet:
        """Return a random member of the type, from which a start begins."""
        rng = seeded(f"{self.seed} {self.type.source} {self.type.code} {self.candidate.links}", start)
        if self.type.source == "scd":
            return sheet_realisation(self.type.mechanism, seed=int(rng.integers(2**31)), tries=2).sheet
        guided = self._guided(self._chain, start) if self.task.form == "space" else None
        return self._random(self._chain, rng) if guided is None else guided

    @cached_property
    def _chain(self) -> SCGraph:
        graph = self.type.mechanism
        return SCGraph(graph.nodes, graph.joints, graph.loops, ground=self.base)

    def _random(self, chain: SCGraph, rng: np.random.Generator) -> HingedSolids | SurfaceLinkage:
        if self.task.form == "cone":
            places = rng.uniform(0.0, tau, len(chain.joints)).tolist()
            return SurfaceLinkage.placed(chain, places, Cone(float(rng.uniform(*HALVING.cones))))
        return turned_to_wishes(random_member(chain, int(rng.integers(2**31))), self.wishes.wishes)

    def _guided(self, chain: SCGraph, start: int) -> HingedSolids | None:
        """Return a six-bar of Watt that guides a link through five orientations in order, if these are the wishes.

        None where the populations of that start have none, or the placement of the roles is another.
        """
        wishes, names = self.wishes.wishes, [one.name for one in self.wishes.configurations]
        turns = [one for one in wishes if isinstance(one, LinkOrientation)]
        inputs = any(one.inputs for one in self.wishes.configurations)
        if inputs or len(turns) < len(wishes) or [one.at for one in turns] != names or len(turns) != 4:
            return None
        if len({one.link for one in turns}) > 1:
            return None
        body = next((link for link in chain if str(link) == turns[0].link), None)
        if body is None or not is_watts(chain, body):
            return None
        five = [(1.0, 0.0, 0.0, 0.0), *(one.quaternion for one in turns)]
        first = HALVING.populations * start
        five_turns = Orientations.from_rotation(Rotation.from_quat(five, scalar_first=True))
        found = six_bars(five_turns, tries=HALVING.populations, driven="ground", first=first).six_bars
        return guiding_member(chain, body, found[0]) if found else None

    def design(self, start: int) -> Design | None:
        """Return the design of a start, judged; None where its numbers make no mechanism."""
        one = self.search(start).design(start if self.type.values is not None else 0)
        return None if one is None else replace(one, start=start)

    def of_record(self, start: int, record: Mapping[str, Any]) -> Design:
        """Return the design that a row of a store holds."""
        return self.search(start).of_record(start, record)


def _stated(task: Task, code: str) -> tuple[tuple[str, float], ...]:
    return tuple(sorted((task.generators or {}).get(code, {}).items()))


@lru_cache(maxsize=64)
def _type_of(place: Path, source: str, code: str, stated: tuple[tuple[str, float], ...]) -> CandidateType:
    """Return a type, made once for all its starts: `hexagon-twist` takes seconds to make."""
    task = Task(generators={code: dict(stated)}, place=place) if source == "generators" else None
    return CandidateType.of(source, code, task)


def is_watts(chain: SCGraph, body: LinkId) -> bool:
    """Tell whether a chain with its ground is Watt's spherical six-bar as `six_bars` has it, with that body.

    Parameters
    ----------
    chain : SCGraph
    body : link id

    Examples
    --------
    >>> chain = CandidateType.of("chains", "k1:E`hW").mechanism
    >>> [body for body in chain if is_watts(SCGraph(chain.nodes, chain.joints, chain.loops, ground=0), body)]
    [3]
    """
    finite = all(loop.centre is Centre.FINITE for loop in chain.loops) and len(chain.centre_classes()) == 1
    return finite and _named(chain, body, links_of("ground", 1)) is not None


def guiding_member(chain: SCGraph, body: LinkId, six_bar: GuidedSixBar) -> HingedSolids | None:
    """Return a six-bar as a member of a chain with its ground and body; None where that is another chain.

    Parameters
    ----------
    chain : SCGraph
    body : link id
    six_bar : GuidedSixBar
    """
    names = _named(chain, body, six_bar.links)
    if names is None:
        return None
    place_of = {frozenset(names[link] for link in pair): place for place, pair in enumerate(six_bar.links)}
    directions = {joint: six_bar.axes[place_of[frozenset(pair)]] for joint, pair in chain.joints.items()}
    return HingedSolids(chain, {joint: ((0.0, 0.0, 0.0), plain_vector(axis)) for joint, axis in directions.items()})


def _named(chain: SCGraph, body: LinkId, pairs: Sequence[tuple[int, int]]) -> dict[int, LinkId] | None:
    """Return links of a chain for links 0 to 5, 0 the ground and 3 the body, by which its joints are those pairs."""
    others = [link for link in chain if link not in (chain.ground, body)]
    if len(chain) != 6 or chain.ground is None or body == chain.ground:
        return None
    wanted = sorted(sorted(map(str, pair)) for pair in chain.joints.values())
    for order in permutations(others):
        names = dict(zip((0, 1, 2, 4, 5, 3), (chain.ground, *order, body), strict=True))
        if wanted == sorted(sorted(str(names[link]) for link in pair) for pair in pairs):
            return names
    return None


def random_member(chain: SCGraph, seed: int) -> HingedSolids:
    """Return a random member of a type: its axes pass through the centres of their loops, at random else.

    Parameters
    ----------
    chain : SCGraph
    seed : int

    Raises
    ------
    UnsolvableError
        If centres that must lie in line could not be placed.

    Examples
    --------
    >>> random_member(CandidateType.of("chains", "k1:Cr").mechanism, 0)
    <HingedSolids: 4 links, 4 joints>
    """
    placed = realise(chain, Reals(seed))
    classes = chain.centre_classes()
    axes = {}
    for joint, (direction, moment) in placed.axes.items():
        along, turn = np.array(direction), np.array(moment)
        point = np.cross(along, turn) / (along @ along)
        for one, centre in zip(classes, placed.points, strict=False):
            if joint in one.joints and one.centre is Centre.FINITE:
                point = np.array(centre[:3])
                break
        axes[joint] = (tuple(point.tolist()), tuple((along / np.linalg.norm(along)).tolist()))
    return HingedSolids(chain, axes)


@dataclass(frozen=True)
class HalvingRound:
    """One round of successive halving: some starts of each candidate that is left.

    Attributes
    ----------
    task : Task
    candidates : tuple of Candidate
    first, last : int
        Numbers of the starts, the last not among them.
    seed : int
    number : int
        Of the round.

    Examples
    --------
    >>> some = (Candidate(0, "chains", "k1:Cr", (0, 2)), Candidate(1, "chains", "k1:Cr", (0, 1)))
    >>> [unit.payload for unit in HalvingRound(Task(), some, 0, 2).units()]
    [(0, 0), (0, 1), (1, 0), (1, 1)]
    """

    task: Task
    candidates: tuple[Candidate, ...]
    first: int
    last: int
    seed: int = 0
    number: int = 0
    columns = COLUMNS

    @property
    def key(self) -> dict[str, Any]:
        """The identity of the round: the task, the candidates, the starts."""
        some = json.dumps([[one.number, one.source, one.code, list(map(str, one.links))] for one in self.candidates])
        return {
            "task": self.task.key,
            "candidates": sha256(some.encode()).hexdigest(),
            "starts": [self.first, self.last],
            "seed": self.seed,
            "round": self.number,
        }

    def __getstate__(self) -> dict[str, Any]:
        """Return the state for a worker: without searches, which each makes itself."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @cached_property
    def _search_of(self) -> Callable[[int], CandidateSearch]:
        """The searches of candidates by their places, the last ones kept: starts of one come one after the other."""
        made = lambda place: CandidateSearch(self.task, self.candidates[place], self.seed)  # noqa: E731
        return lru_cache(maxsize=HALVING.kept)(made)

    def units(self) -> list[Unit]:
        """One unit for each start of each candidate."""
        numbers = range(len(self.candidates))
        return [Unit((place, start), START_WEIGHT) for place in numbers for start in range(self.first, self.last)]

    def work(self, payload: tuple[int, int]) -> list[Row]:
        """Return the row of a start."""
        place, start = payload
        candidate = self.candidates[place]
        try:
            one = self._search_of(place).design(start)
        except SynthedraError as error:
            return [_row_without_member(candidate, start, str(error))]
        if one is None:
            return [_row_without_member(candidate, start, "no member at this start")]
        record = json.dumps(one.record(), separators=(",", ":"))
        figures = (one.success, one.miss, one.error, one.freedoms or 0)
        return [(candidate.number, start, *figures, kinds_of(one.defects), record)]


def _row_without_member(candidate: Candidate, start: int, reason: str) -> Row:
    """Return the row of a start that gave no design: it is as far from the wishes as an orientation can be."""
    defect = Defect(DefectKind.NO_MEMBER, reason=reason)
    record = json.dumps({"defects": [defect.to_json()]}, separators=(",", ":"))
    return candidate.number, start, False, pi, 0.0, 0, kinds_of([defect]), record


Rows = list[dict[str, Any]]


def opened_store(folder: Path, *, resume: bool, force: bool) -> Path:
    """Return a folder for a store of each round, made where it is missing; without `resume` empty of them.

    Raise OpenError if it cannot be made, StoreError if it holds some that are neither to be resumed nor removed.
    """
    make_folder(folder)
    rounds = [] if resume else sorted(folder.glob("round-*.sqlite*"))  # with journals that a killed run left
    if rounds and not force:
        raise StoreError(
            f"{folder}: holds the designs of a search; try --resume to continue it, --force to replace them, or "
            "another folder"
        )
    for each in rounds:
        each.unlink(missing_ok=True)
    return folder


def halved(
    structure: TaskStructure,
    *,
    starts: int = HALVING.starts,
    rounds: int = HALVING.rounds,
    seed: int = 0,
    workers: int = 1,
    store: Path | None = None,
    resume: bool = False,
    scheduler: str | None = None,
    report: Callable[[int, Progress], None] | None = None,
) -> Rows:
    """Return the rows of all starts: candidates by successive halving.

    Parameters
    ----------
    structure : TaskStructure
    starts : int, optional
        Of each candidate in the first round; in each further one as many again as there were.
    rounds : int, optional
    seed : int, optional
    workers : int, optional
        Local processes.
    store : Path, optional
        A folder with one store of the runner for each round (`opened_store`).
    resume : bool, optional
        Whether to go on with the stores of that folder.
    scheduler : str, optional
        Address of a Dask scheduler; needs a store.
    report : callable, optional
        Called with the number of a round and its progress.

    Raises
    ------
    StoreError
        If a store is there and is not to be resumed, or is of another task.
    """
    left = candidates_of(structure)
    every: Rows = []
    begun = 0
    for number in range(rounds):
        job = HalvingRound(structure.task, left, begun, begun + starts, seed, number)
        if store is None:
            every += rows_of(job, workers=workers)
        else:
            path = store / f"round-{number}.sqlite"
            told = None if report is None else _reporter(report, number)
            run(job, SqliteSink(path, resume=resume), workers=workers, scheduler=scheduler, report=told)
            every += [row_as_dict(COLUMNS, row) for row in read_rows(path)]
        begun, starts = begun + starts, 2 * starts
        left = tuple(_better_half(left, every))
        if not left:
            break
    return every


def _reporter(report: Callable[[int, Progress], None], number: int) -> Callable[[Progress], None]:
    return lambda progress: report(number, progress)


def _better_half(candidates: Sequence[Candidate], rows: Iterable[Mapping[str, Any]]) -> Iterator[Candidate]:
    """Yield the half of the candidates that look best, in their order; those that meet the wishes are done.

    Ties go to the candidate that comes first: fewer links.
    """
    best: dict[int, tuple[bool, float]] = {}
    for row in rows:
        key = (not row["success"], round(row["miss"], MET_DIGITS))
        best[row["candidate"]] = min(best.get(row["candidate"], (True, pi)), key)
    open_ones = [one for one in candidates if best.get(one.number, (True, pi)) > (False, 0.0)]
    ranked = sorted(open_ones, key=lambda one: (round(best.get(one.number, (True, pi))[1], MET_DIGITS), one.number))
    chosen = {one.number for one in ranked[: ceil(len(ranked) / 2)]}
    yield from (one for one in candidates if one.number in chosen)
