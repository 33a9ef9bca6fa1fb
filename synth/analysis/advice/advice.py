"""Joints to lock or panels to crease for a number of freedoms. Theory: docs/theory/advice.md."""

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice
from math import inf, isfinite
from typing import Any, overload

import numpy as np

from graphs.edit.named import known
from graphs.errors import InvariantError, NumericalError, UnsolvableError, check_argument, numbered, shown
from graphs.mechanism.precision import lies_flat
from graphs.mechanism.sheet import Sheet
from graphs.plain_data import fields_to_json
from graphs.printing import Block, Printed, TableBlock
from graphs.rank.singular_values import spectrum, split
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats, Ints, JointId, LinkId
from synth.analysis.advice.diagonals import (
    Bounds,
    Candidates,
    Diagonal,
    diagonals_of,
    freedoms_when_left_out,
    loads_on_stresses,
    smallest_sets,
)
from synth.analysis.advice.locks import Cost, GeneralConfiguration, cheapest_sets, general_configuration, held
from synth.analysis.folding.configuration import SheetConfiguration
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.germ import Branch
from synth.analysis.motion.walk.step import Allowance
from synth.analysis.moving._configuration_of import Movable, configuration_of

_USED_UP = "; the search ended at its work limit"
_LOOSE = 1e4
"""Amplification of play is printed up to this factor, above as more."""


@dataclass(frozen=True, slots=True)
class Locked:
    """Joints to lock.

    Attributes
    ----------
    joints : tuple of joint ids
    weight : float
        Sum of their weights.
    flaps, immobile : tuple of joint ids
        Those of them that are in no loop: they stop a flap, and nothing else; and other joints that are immobile
        then.
    play : float
        The largest factor by which play in the locked joints is amplified in the others (root of summed squares).
    freedoms : int or None
        By the rank of the closure equations without these joints; None where singular values do not decide.
    left_out : int or None
        Of the flat sheet without these creases, on its freest branch; None if not asked for, or unknown.
    """

    joints: tuple[JointId, ...]
    weight: float
    flaps: tuple[JointId, ...]
    immobile: tuple[JointId, ...]
    play: float
    freedoms: int | None
    left_out: int | None = None

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return fields_to_json(self)


@dataclass(frozen=True, slots=True)
class Creased:
    """Diagonals of panels to crease.

    Attributes
    ----------
    diagonals : tuple of Diagonal
    flaps, freedoms : int
        How many only cut a corner off, which hangs on them; degrees of freedom of the sheet with them, folded.
    """

    diagonals: tuple[Diagonal, ...]
    flaps: int
    freedoms: int

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        diagonals = [{"panel": one.panel, "face": one.face, "vertices": list(one.ends)} for one in self.diagonals]
        return {"diagonals": diagonals, "flaps": self.flaps, "freedoms": self.freedoms}


@dataclass(frozen=True, slots=True, repr=False)
class Advice(Printed):
    """What to lock or to crease. It prints as ``synth advise`` does.

    Attributes
    ----------
    configuration : Configuration
        The input.
    freedoms, wanted : int
        Degrees of freedom M of the mechanism, and K that are required.
    branch : int or None
        The motion branch on which that holds; None where the input configuration is regular.
    flaps : tuple of joint ids
        Joints in no loop: each a freedom by itself.
    locks : tuple of Locked
        Where there are too many freedoms: sets of M - K joints, cheapest first, of equal weight those with fewest
        flaps, then those whose joints move most.
    creases : tuple of Creased
        Where there are too few: the smallest sets of diagonals.
    more, used_up : bool
        Whether there are, or may be, more sets as small; whether the search ended at its work limit.
    searched, refused : int or None, int
        The largest number of diagonals in the search; sets of diagonals that have the rates and, folded, not the
        freedoms.
    """

    configuration: Configuration
    freedoms: int
    wanted: int
    branch: int | None
    flaps: tuple[JointId, ...] = ()
    locks: tuple[Locked, ...] = ()
    creases: tuple[Creased, ...] = ()
    more: bool = False
    used_up: bool = False
    searched: int | None = None
    refused: int = 0

    @property
    def taken(self) -> Branch | None:
        """The motion branch on which that holds; None where nothing moves."""
        return self.configuration.branch(self.branch or 0)

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        at = self.configuration
        fields = fields_to_json(self, without=["configuration"])
        return {"configuration": at.to_json(self.taken), **fields, "mended": list(at.mended)}

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        where = "at this configuration" if self.branch is None else f"near this configuration, on branch {self.branch}"
        freedoms = numbered(self.freedoms, "degree of freedom", "degrees of freedom")
        lines: list[Block] = [f"{freedoms} {where}; required: {self.wanted}"]
        if self.wanted < self.freedoms:
            lines += self._locking()
        else:
            lines += self._creasing() if self.wanted > self.freedoms else ["nothing to change"]
        if self.flaps:
            joints = ", ".join(map(shown, self.flaps))
            lines.append(f"flap joints (in no loop, 1 degree of freedom each): {joints}")
        return [*lines, *(f"repaired: {repair}" for repair in self.configuration.mended)]

    def _locking(self) -> list[Block]:
        size = numbered(self.freedoms - self.wanted, "joint")
        rows: list[tuple[str, ...]] = [
            (
                _names(one.joints),
                f"{one.weight:g}",
                _names(one.flaps),
                _names(one.immobile),
                f"> {_LOOSE:.0f}" if one.play > _LOOSE else f"{one.play:.3g}",
                _number(one.freedoms),
                _number(one.left_out),
            )
            for one in self.locks
        ]
        columns: tuple[str, ...] = ("lock", "weight", "flaps", "then immobile", "play", "DOF", "DOF if left out")
        if all(one.left_out is None for one in self.locks):
            columns, rows = columns[:-1], [row[:-1] for row in rows]
        heading = f"lock {size}: " + self._how_many(len(self.locks))
        return [heading, TableBlock(columns, rows, ["weight", "play", "DOF", "DOF if left out"])]

    def _creasing(self) -> list[Block]:
        lines: list[Block] = []
        if self.refused:
            rejected = f"rejected {numbered(self.refused, 'set')} of diagonals"
            lines.append(f"{rejected}: enough DOF to first order, too few when folded")
        if not self.creases:
            ended = "all were checked"
            if self.more:
                ended = "the search ended at a limit" + (_USED_UP if self.used_up else "")
            return [f"no set of {numbered(self.searched or 0, 'diagonal')} or fewer was found: {ended}", *lines]
        size = numbered(len(self.creases[0].diagonals), "diagonal")
        rows = [
            (
                ", ".join(f"{one.ends[0]}-{one.ends[1]} (panel {one.panel})" for one in creased.diagonals),
                str(creased.flaps),
                str(creased.freedoms),
            )
            for creased in self.creases
        ]
        heading = f"crease {size}: " + self._how_many(len(self.creases))
        return [heading, TableBlock(("from vertex to vertex", "flaps", "DOF"), rows, ["flaps", "DOF"]), *lines]

    def _how_many(self, listed: int) -> str:
        ended = _USED_UP if self.used_up else ""
        if self.more:
            return ("the first set" if listed == 1 else f"the first {listed} sets") + ended
        return f"{numbered(listed, 'set')}, all there are"

    def __repr__(self) -> str:
        return f"<Advice: {self.freedoms} to {self.wanted} freedoms, {len(self.locks) + len(self.creases)} sets>"


def _names(joints: tuple[JointId, ...]) -> str:
    return " ".join(map(shown, joints)) or "-"


def _number(number: int | None) -> str:
    return "?" if number is None else str(number)


_LIMIT = 20
_WORK = 2_000_000_000
"""Numbers of matrices that a search goes through, be they few large or many small ones: some seconds."""
_STEPS = 300_000
"""Steps of a search, however small the matrices."""
_ONE_MORE = 1
"""Diagonals beyond the fewest that are looked for if nothing is said."""
_DIGITS = 6
"""Of how much joints move: what moves alike is told apart by its place."""


@dataclass(frozen=True, slots=True)
class _Protected:
    """What the user protects from change, and weights of joints."""

    joints: Collection[JointId] = ()
    links: Collection[LinkId] = ()
    flaps: bool = False
    weights: Mapping[JointId, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, repr=False)
class AdviceTable(Printed):
    """Joints to lock, for many weights or configurations of one mechanism: N entries, at most L sets of S joints.

    Attributes
    ----------
    configuration : Configuration
        The input.
    joints : tuple of joint id
    wanted : int
        Degrees of freedom that are required.
    freedoms, branch : int[N]
        Degrees of freedom M that there are, -1 where there is no advice; the motion branch on which that holds, -1
        where the configuration is regular.
    locks : int[N, L, S]
        Places of the joints to lock, in the order of `Advice.locks`; -1 beyond those that there are.
    weight, play : float[N, L]
        Of these sets, as of `Locked`; nan beyond.
    left : int[N, L]
        Degrees of freedom with them locked; -1 where singular values do not decide, and beyond.
    more : bool[N]
        Whether there are, or may be, more sets.
    why : mapping of int to str
        Of entries without advice, why.

    Examples
    --------
    >>> from synth.catalogue.patterns import generate
    >>> table = advise(generate("five-bar").mechanism, 1, weights={0: [1.0, 9.0, 0.0]}, limit=2)
    >>> table, table.locks.shape, table.weight.tolist()
    (<AdviceTable: 3 entries, 3 with advice>, (3, 2, 1), [[1.0, 1.0], [1.0, 1.0], [0.0, 1.0]])
    """

    configuration: Configuration
    joints: tuple[JointId, ...]
    wanted: int
    freedoms: Ints
    branch: Ints
    locks: Ints
    weight: Floats
    play: Floats
    left: Ints
    more: Flags
    why: dict[int, str]

    def __len__(self) -> int:
        return len(self.freedoms)

    def to_json(self) -> dict[str, Any]:
        """Return all as plain data; of each entry as many sets as there are, joints by their ids."""
        names = np.array([*self.joints, None], dtype=object)
        count = (self.locks >= 0).any(axis=2).sum(axis=1).tolist()
        sets = [
            [[joint for joint in names[lock].tolist() if joint is not None] for lock in locks[:many]]
            for locks, many in zip(self.locks, count, strict=True)
        ]
        return {
            "configuration": self.configuration.to_json(),
            "wanted": self.wanted,
            "freedoms": [None if number < 0 else number for number in self.freedoms.tolist()],
            "branch": [None if number < 0 else number for number in self.branch.tolist()],
            "locks": sets,
            **{
                name: [row[:many] for row, many in zip(getattr(self, name).tolist(), count, strict=True)]
                for name in ("weight", "play", "left")
            },
            "more": self.more.tolist(),
            "why": {str(entry): why for entry, why in self.why.items()},
        }

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed: the cheapest sets, and of how many entries."""
        cheapest = self.locks[:, 0].tolist() if self.locks.shape[1] else []
        sets = [tuple(self.joints[place] for place in places if place >= 0) for places in cheapest]
        count = Counter(_names(lock) for lock in sets if lock)
        lines: list[Block] = [f"{numbered(len(self), 'entry', 'entries')}; required: {self.wanted}"]
        if count:
            rows = [(name, str(number)) for name, number in count.most_common(_LIMIT)]
            lines.append(TableBlock(("cheapest to lock", "entries"), rows, ["entries"]))
        return [*lines, *(f"entry {entry}: {why}" for entry, why in list(self.why.items())[:_LIMIT])]

    def __repr__(self) -> str:
        advised = int((self.freedoms >= 0).sum())
        return f"<AdviceTable: {numbered(len(self), 'entry', 'entries')}, {advised} with advice>"


@overload
def advise(
    mechanism: Movable,
    freedoms: int,
    *,
    at: None = None,
    branch: int | str | None = None,
    weights: Mapping[JointId, float] | None = None,
    joints: Collection[JointId] = (),
    links: Collection[LinkId] = (),
    flaps: bool = True,
    limit: int = _LIMIT,
    size: int | None = None,
    leave_out: bool = False,
) -> Advice: ...


@overload
def advise(
    mechanism: Movable,
    freedoms: int,
    *,
    at: Floats | None = None,
    branch: int | str | None = None,
    weights: Mapping[JointId, float | Sequence[float] | Floats] | None = None,
    joints: Collection[JointId] = (),
    links: Collection[LinkId] = (),
    flaps: bool = True,
    limit: int = _LIMIT,
) -> AdviceTable: ...


def advise(
    mechanism: Movable,
    freedoms: int,
    *,
    at: Floats | None = None,
    branch: int | str | None = None,
    weights: Mapping[JointId, float] | Mapping[JointId, float | Sequence[float] | Floats] | None = None,
    joints: Collection[JointId] = (),
    links: Collection[LinkId] = (),
    flaps: bool = True,
    limit: int = _LIMIT,
    size: int | None = None,
    leave_out: bool = False,
) -> Advice | AdviceTable:
    """Find joints to lock, or panels to crease, for a number of freedoms.

    Parameters
    ----------
    mechanism : Mechanism, str, Path or Configuration
        With coordinates. Only panels of a sheet can be creased.
    freedoms : int
        Required degrees of freedom, K. Of M that there are, M - K joints are locked, or K - M diagonals and more
        are creased.
    at : float[N, J], optional
        Joint angles of N configurations, radians, in the order of `Configuration.joints`, for instance those of a
        `Sweep`: joints to lock are found at each.
    branch : int or str, optional
        From a singular configuration, above all a flat sheet: the motion branch, by its number or signs. By
        default the assignment chooses it.
    weights : mapping of joint id to float, or to float[N], optional
        Cost of locking a joint, 0 or more; by default 1. With arrays joints to lock are found for each of N weights.
    joints, links : collection of ids, optional
        Protected: the joints, and all joints of the links, are not locked; the links are not creased.
    flaps : bool, optional
        Whether joints in no loop may be locked, and corners be cut off to hang as flaps.
    limit : int, optional
        Largest number of sets in the answer.
    size : int, optional
        Size of the largest set of diagonals in the search; by default one more than K - M.
    leave_out : bool, optional
        Find for each set to lock the freedoms of a flat sheet without these creases, too: left out they stay at 0,
        which is a special angle.

    Returns
    -------
    Advice, or of arrays AdviceTable

    Raises
    ------
    InvariantError
        If a number is out of range, or there is no such joint, link or branch.
    UnsolvableError
        If there are no coordinates, nothing moves, protection leaves too few joints, or there are no panels to
        crease.
    NumericalError
        If no regular configuration is found.

    Examples
    --------
    A vertex of six creases has three freedoms; three creases are locked, not the expensive one:

    >>> from math import cos, pi, sin
    >>> around = [(cos(k * pi / 3 + 0.1 * (k % 2)), sin(k * pi / 3 + 0.1 * (k % 2))) for k in range(6)]
    >>> faces = tuple((0, 1 + k, 1 + (k + 1) % 6) for k in range(6))
    >>> sheet = Sheet(7, tuple((0, k) for k in range(1, 7)), "MVVMVV", faces, ((0.0, 0.0), *around))
    >>> advice = advise(sheet, 0, weights={0: 5.0}, limit=1)
    >>> advice.locks[0].joints, advice.locks[0].weight
    ((1, 3, 4), 3.0)
    """
    check_argument("advise", mechanism, Movable)
    _check_number("freedoms", freedoms, 0)
    _check_number("limit", limit, 1)
    own = configuration_of(mechanism)
    several = _several(weights or {})
    if at is not None or several is not None:
        if size is not None or leave_out:
            raise InvariantError("advise", "arrays with a size, or creases left out", "joints to lock only")
        protected = _Protected(frozenset(joints), frozenset(links), not flaps)
        return _table(own, freedoms, at, (weights or {}, several), (branch, protected, limit))
    costs = {joint: float(weight) for joint, weight in (weights or {}).items()}  # type: ignore[arg-type]
    protected = _Protected(frozenset(joints), frozenset(links), not flaps, costs)
    sheet = own.drawn if isinstance(own, SheetConfiguration) else None
    general = general_configuration(own, branch)
    _check_names(general, protected)
    answer = _begun(own, general, freedoms)
    if freedoms > general.freedoms:
        largest = freedoms - general.freedoms + _ONE_MORE if size is None else size
        _check_number("size", largest, freedoms - general.freedoms)
        return _with_creases(answer, general, protected, (largest, limit))
    if freedoms < general.freedoms:
        answer = _with_locks(answer, general, protected, limit)
    if leave_out:
        answer = replace(answer, locks=tuple(_with_left_out(lock, sheet) for lock in answer.locks))
    return answer


def _begun(at: Configuration, general: GeneralConfiguration, freedoms: int) -> Advice:
    """Return the answer before sets are found."""
    every = list(general.linkage.graph.joints)
    return Advice(at, general.freedoms, freedoms, general.branch, tuple(every[place] for place in general.flaps))


def _several(weights: Mapping[JointId, Any]) -> int | None:
    """Return of how many entries arrays of weights are; None of numbers only."""
    shapes = {np.shape(weight) for weight in weights.values()} - {()}
    if not shapes:
        return None
    if len(shapes) > 1 or len(next(iter(shapes))) != 1:
        listed = ", ".join(map(str, sorted(shapes)))
        raise InvariantError("weights", f"arrays of shapes {listed}", "numbers, and arrays float[N] of one length")
    return int(next(iter(shapes))[0])


def _table(
    own: Configuration,
    freedoms: int,
    at: Floats | None,
    weights: tuple[Mapping[JointId, Any], int | None],
    options: tuple[int | str | None, _Protected, int],
) -> AdviceTable:
    """Return joints to lock for each entry: at a configuration of its own, float[N, J], or with weights of its own."""
    (by_joint, several), (branch, protected, limit) = weights, options
    if at is not None:
        at = np.asarray(at, dtype=float)
        count = several if several is not None else len(at)
        if at.ndim != 2 or at.shape != (count, len(own.joints)):
            expected = f"float[{'N' if several is None else several}, {len(own.joints)}]"
            raise InvariantError("at", f"an array of shape {at.shape}", expected)
    else:
        count = several or 0
    here = None if at is not None else general_configuration(own, branch)
    answers: dict[int, Advice] = {}
    why: dict[int, str] = {}
    for entry in range(count):
        costs = {joint: float(weight[entry] if np.ndim(weight) else weight) for joint, weight in by_joint.items()}
        kept = replace(protected, weights=costs)
        if here is not None:
            _check_names(here, kept)
        try:
            general = here or general_configuration(_in(own, at[entry]), branch)  # type: ignore[index]
            if freedoms > general.freedoms:
                raise UnsolvableError(f"{general.freedoms} degrees of freedom, and arrays are of joints to lock only")
            answer = _begun(own, general, freedoms)
            answers[entry] = answer if freedoms == general.freedoms else _with_locks(answer, general, kept, limit)
        except (UnsolvableError, NumericalError) as error:
            why[entry] = str(error)
    return _as_arrays(own, freedoms, count, answers, why)


def _in(own: Configuration, angles: Floats) -> Configuration:
    """Return the mechanism at other joint angles, float[J]; `UnsolvableError` if its loops are open there."""
    if not np.isfinite(angles).all():
        raise UnsolvableError("no configuration: joint angles are no numbers")
    if (error := own.closure.error(angles)) > DOUBLE.same_configuration:
        raise UnsolvableError(f"no configuration: the loop-closure residual is {error:.1e}")
    return configuration_of(own.at(angles))


def _as_arrays(
    own: Configuration, freedoms: int, count: int, answers: Mapping[int, Advice], why: dict[int, str]
) -> AdviceTable:
    """Return answers by their entry as arrays."""
    most = max((len(answer.locks) for answer in answers.values()), default=0)
    size = max((answer.freedoms - freedoms for answer in answers.values()), default=0)
    place = {joint: number for number, joint in enumerate(own.joints)}
    table = AdviceTable(
        configuration=own,
        joints=own.joints,
        wanted=freedoms,
        freedoms=np.full(count, -1),
        branch=np.full(count, -1),
        locks=np.full((count, most, size), -1),
        weight=np.full((count, most), np.nan),
        play=np.full((count, most), np.nan),
        left=np.full((count, most), -1),
        more=np.zeros(count, dtype=bool),
        why=why,
    )
    for entry, answer in answers.items():
        table.freedoms[entry], table.more[entry] = answer.freedoms, answer.more
        table.branch[entry] = -1 if answer.branch is None else answer.branch
        for row, lock in enumerate(answer.locks):
            table.locks[entry, row, : len(lock.joints)] = [place[joint] for joint in lock.joints]
            table.weight[entry, row], table.play[entry, row] = lock.weight, lock.play
            table.left[entry, row] = -1 if lock.freedoms is None else lock.freedoms
    return table


def _with_locks(answer: Advice, general: GeneralConfiguration, protected: _Protected, limit: int) -> Advice:
    """Return the answer with the cheapest sets of joints to lock."""
    size = general.freedoms - answer.wanted
    flaps = set(general.flaps)
    allowed = [
        place
        for place, (joint, ends) in enumerate(general.linkage.graph.joints.items())
        if joint not in protected.joints
        and not (protected.flaps and place in flaps)
        and not set(ends) & set(protected.links)
    ]
    most = held(general.rates, allowed)
    if most < size:
        least = general.freedoms - most
        raise UnsolvableError(
            f"at least {least} of {numbered(general.freedoms, 'degree of freedom', 'degrees of freedom')} remain: "
            f"locking all joints that are not protected removes {most}, and {size} are to be removed"
        )
    moves = np.round((general.rates**2).sum(axis=1), _DIGITS)
    costs: list[Cost] = [
        (protected.weights.get(joint, 1.0), float(place in flaps), -float(moves[place]))
        for place, joint in enumerate(general.linkage.graph.joints)
    ]
    allowance = _allowance(general.rates)
    first = list(islice(cheapest_sets(general.rates, size, costs, allowed, allowance), limit + 1))
    locks = tuple(_locked(general, places, costs) for places in first[:limit])
    used_up = allowance.left < 0
    return replace(answer, locks=locks, more=len(first) > limit or used_up, used_up=used_up)


def _allowance(matrix: Floats) -> Allowance:
    """Return the steps that a search may take, each of which goes through a matrix."""
    return Allowance(min(_STEPS, _WORK // max(matrix.size, 1)))


def _with_left_out(lock: Locked, sheet: Sheet | None) -> Locked:
    """Return a set with what a flat sheet has without its creases."""
    if sheet is None or not lies_flat(sheet):
        raise UnsolvableError("creases are left out of flat sheets only; those of a folded one can be locked")
    joints = [joint for joint in lock.joints if isinstance(joint, int)]  # numbers of edges
    return replace(lock, left_out=freedoms_when_left_out(sheet, joints))


def _locked(general: GeneralConfiguration, places: tuple[int, ...], costs: Sequence[Cost]) -> Locked:
    """Return a set of joints with what comes of locking them, its freedoms by a rank."""
    every = list(general.linkage.graph.joints)
    chosen = set(places)
    parts = split(general.rates[list(places)])
    immobile = np.abs(general.rates @ parts.right[len(places) :].T).max(axis=1, initial=0.0) <= DOUBLE.zero_rate
    flaps = set(general.flaps)
    matrix: Floats = ClosureEquations(general.linkage).at(general.linkage.angles)[1].toarray()
    others = np.delete(matrix, list(places), axis=1)
    rank = spectrum(others, DOUBLE.derivative).rank
    return Locked(
        tuple(every[place] for place in places),
        sum(costs[place][0] for place in places),
        tuple(every[place] for place in places if place in flaps),
        tuple(joint for place, joint in enumerate(every) if place not in chosen and immobile[place]),
        float(1.0 / parts.values[-1]) if parts.values[-1] else inf,
        None if rank is None else others.shape[1] - rank,
    )


def _with_creases(
    answer: Advice, general: GeneralConfiguration, protected: _Protected, most: tuple[int, int]
) -> Advice:
    """Return the answer with the smallest sets of diagonals that bring the freedoms wanted."""
    at, freedoms = answer.configuration, answer.wanted
    if general.sheet is None or not isinstance(at, SheetConfiguration):
        raise UnsolvableError(
            f"{numbered(general.freedoms, 'degree of freedom', 'degrees of freedom')}, and {freedoms} required: "
            "only panels of a sheet can be creased"
        )
    largest, limit = most
    diagonals = diagonals_of(general, protected.links)
    loads, flaps = loads_on_stresses(general, diagonals)
    chosen = [place for place, flap in enumerate(flaps) if not (flap and protected.flaps)]
    candidates = Candidates([diagonals[place] for place in chosen], loads[:, chosen], _allowance(loads))
    bounds = Bounds(general.freedoms, general.rates.shape[1], freedoms, largest)
    search = smallest_sets(general.sheet, candidates, bounds, limit)
    creases = tuple(
        Creased(
            tuple(_as_given(candidates.diagonals[place], at.drawn) for place in places),
            sum(flaps[chosen[place]] for place in places),
            freedoms,
        )
        for places in search.sets
    )
    return replace(
        answer,
        creases=creases,
        more=search.more,
        used_up=search.used_up,
        searched=search.searched,
        refused=search.refused,
    )


def _as_given(diagonal: Diagonal, sheet: Sheet) -> Diagonal:
    """Return a diagonal with the vertices that the sheet had before it was opened along its cuts."""
    around = sheet.faces[diagonal.face]
    first, last = diagonal.corners
    return Diagonal(diagonal.panel, diagonal.face, diagonal.corners, (around[first], around[last]))


def _check_number(what: str, number: int, least: int) -> None:
    if number < least:
        raise InvariantError(what, f"{what}: {number}", f"{least} or more")


def _check_names(general: GeneralConfiguration, protected: _Protected) -> None:
    """Refuse joints and links that are not there, and weights that are none."""
    graph = general.linkage.graph
    for joint in (*protected.joints, *protected.weights):
        if joint not in graph.joints:
            raise InvariantError("joint", f"{shown(joint)} is no joint", known(graph.joints, str(joint)))
    for link in protected.links:
        if link not in graph:
            raise InvariantError("link", f"{shown(link)} is no link", known(graph.nodes, str(link)))
    for joint, weight in protected.weights.items():
        if not isfinite(weight) or weight < 0.0:
            raise InvariantError("weight", f"the weight of joint {shown(joint)} is {weight:g}", "0 or more")
