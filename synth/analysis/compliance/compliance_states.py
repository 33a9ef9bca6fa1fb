"""The compliance states of a mechanism, and what springs do to it. Theory: docs/theory/compliance.md."""

from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import degrees
from typing import Any, NamedTuple, overload

import numpy as np
from scipy.optimize import brentq

from graphs.errors import InvariantError, NumericalError, UnsolvableError, check_argument, numbered, shown
from graphs.printing import Block, Printed, TableBlock
from graphs.tolerances import DOUBLE, canonical_order, leading
from graphs.types import Flags, Floats, JointId, LinkId
from synth.analysis.compliance.members import (
    Members,
    SmallestSets,
    State,
    freedoms_text,
    number_or_unknown,
    state_of,
    states_of,
)
from synth.analysis.compliance.springs import (
    ElasticLinkage,
    Equilibrium,
    LoadPath,
    Masses,
    SmallMotion,
    SpringArrays,
    Springs,
    equilibrium,
    load_path,
    small_motions,
)
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.driven_motion import goals_of
from synth.analysis.motion.linkage import Linkage, moved
from synth.analysis.moving._configuration_of import Movable, configuration_of

_LISTED = 20
"""Sets, transitions, configurations and modes that are printed; data has all."""
_NAMED = 12
"""Members of a set that are named."""

_OTHER_QUESTION = "states reports the degrees of freedom of each set of active members, on the freest branch"


@dataclass(frozen=True, slots=True)
class Transition:
    """A change of state that makes a mechanism one of a class, by the class's name."""

    name: str
    before: State
    after: State

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {"class": self.name, "before": self.before.to_json(), "after": self.after.to_json()}

    def line(self) -> str:
        """Return the transition as a line."""
        return f"{self.name}: from {_summary(self.before)} to {_summary(self.after)}"


class LoadPathPoint(NamedTuple):
    """A configuration of the load path, and the state of the mechanism there."""

    balance: Equilibrium
    state: State


class RestPassed(NamedTuple):
    """A compliant joint that comes to rest on the load path, where the driver is at `driven`, radians."""

    joint: JointId
    driven: float


@dataclass(frozen=True, slots=True, repr=False)
class Elastic:
    """The configuration at which springs and moments are in balance, a load path from there, and modes about it.

    `joints` are the columns of angles and rates; `path` holds the equilibria while the driver is driven, `stopped` says
    why they end before the goal. `modes` is None without masses.
    """

    joints: tuple[JointId, ...]
    balance: Equilibrium
    driver: JointId | None = None
    path: tuple[LoadPathPoint, ...] = ()
    passed: tuple[RestPassed, ...] = ()
    stopped: str = ""
    modes: tuple[SmallMotion, ...] | None = None

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        modes = [
            {"frequency": mode.frequency, "growth": mode.growth, "rates": self._named(mode.rates)}
            for mode in self.modes or ()
        ]
        return {
            "equilibrium": self._equilibrium_to_json(self.balance),
            "driver": self.driver,
            "path": [
                {
                    "driven_deg": degrees(float(point.balance.angles[self._column])),
                    "moment": float(point.balance.held[0]),
                    **self._equilibrium_to_json(point.balance),
                    "state": point.state.to_json(),
                }
                for point in self.path
            ],
            "rest_passed": [{"joint": rest.joint, "driven_deg": degrees(rest.driven)} for rest in self.passed],
            "stopped": self.stopped or None,
            "modes": None if self.modes is None else modes,
        }

    @property
    def _column(self) -> int:
        assert self.driver is not None
        return self.joints.index(self.driver)

    def _named(self, values: Floats) -> dict[str, float]:
        return {str(joint): value for joint, value in zip(self.joints, values.tolist(), strict=True)}

    def _equilibrium_to_json(self, balance: Equilibrium) -> dict[str, Any]:
        return {
            "angles_deg": self._named(np.degrees(balance.angles)),
            "energy": balance.energy,
            "stable": balance.stable,
            "least_curvature": balance.least,
            "unbalanced": balance.unbalanced,
            "closure": balance.error,
        }

    def blocks(self) -> list[Block]:
        """Return the lines and tables that are printed."""
        how = "stable" if self.balance.stable else "not stable"
        ends = ", ".join(
            f"{shown(joint)} = {degrees(angle):.6g}°"
            for joint, angle in zip(self.joints, self.balance.angles.tolist(), strict=True)
        )
        summary = f"equilibrium of the springs: {how}, energy {self.balance.energy:.6g}"
        evidence = f"residual moments {self.balance.unbalanced:.0e}, loop-closure residual {self.balance.error:.0e}"
        return [f"{summary}   ({evidence})", f"joint angles: {ends}", *self._load_path(), *self._small_motions()]

    def __repr__(self) -> str:
        return f"<Elastic: {numbered(len(self.path), 'configuration')}, {numbered(len(self.modes or ()), 'mode')}>"

    def _load_path(self) -> list[Block]:
        if self.driver is None:
            return []
        level = DOUBLE.zero * max(abs(float(point.balance.held[0])) for point in self.path)
        step = -(-len(self.path) // _LISTED)
        rows = [self._row(point, level) for point in (*self.path[:-1:step], self.path[-1])]
        columns = ("driven (deg)", "moment", "energy", "stable", "DOF", "state")
        table = TableBlock(columns, rows, ("driven (deg)", "moment", "energy", "DOF"))
        lines: list[Block] = [f"load path of joint {shown(self.driver)}:", table]
        if len(rows) < len(self.path):
            lines.append(f"{len(rows)} of {len(self.path)} configurations")
        lines += [
            f"joint {shown(rest.joint)} comes to rest where the driven joint is at {degrees(rest.driven):.6g}°"
            for rest in self.passed
        ]
        return [*lines, *([f"stopped: {self.stopped}"] if self.stopped else [])]

    def _row(self, point: LoadPathPoint, level: float) -> tuple[str, ...]:
        moment = float(point.balance.held[0])
        return (
            f"{degrees(float(point.balance.angles[self._column])):.6g}",
            f"{moment:.6g}" if abs(moment) > level else "0",
            f"{point.balance.energy:.6g}",
            "yes" if point.balance.stable else "no",
            number_or_unknown(point.state.freedoms),
            point.state.kind,
        )

    def _small_motions(self) -> list[Block]:
        if self.modes is None:
            return []
        rows = []
        for mode in self.modes[:_LISTED]:
            rate = f"{mode.frequency:.6g}" if mode.frequency is not None else f"grows at {mode.growth:.6g}"
            largest = canonical_order(list(-np.abs(mode.rates)[:, None]))[:6]
            moves = ", ".join(f"{shown(self.joints[place])}: {mode.rates[place]:.3g}" for place in largest)
            rows.append((rate, moves))
        table = TableBlock(("frequency", "joints that move most"), rows, ("frequency",))
        more = len(self.modes) - len(rows)
        return ["small motions about the equilibrium:", table, *([f"and {more} faster modes"] if more else [])]


@dataclass(frozen=True, slots=True, repr=False)
class States(Printed):
    """The compliance states of a mechanism at its configuration. It prints as ``synth states`` does.

    Attributes
    ----------
    configuration : Configuration
        The input.
    compliant : Members
    now : State
        Members are active whose springs are not at rest.
    sets : tuple of State
        For each set of active members, smaller ones first; of more than ten members of a few sets.
    transitions : tuple of Transition
        The smallest that make it a mechanism of each class.
    elastic : Elastic or None
        What springs do, where there are any.
    smallest : SmallestSets or None
        Of more than ten members, the smallest sets that release a motion.

    Examples
    --------
    >>> from synth.catalogue.patterns import generate
    >>> states(generate("four-bar").mechanism, joints=[0])
    <States: rigid immobile; compliant mechanism>
    """

    configuration: Configuration
    compliant: Members
    now: State
    sets: tuple[State, ...]
    transitions: tuple[Transition, ...]
    elastic: Elastic | None = None
    smallest: SmallestSets | None = None

    @property
    def classes(self) -> tuple[str, ...]:
        """The classes that transitions at this configuration make it one of."""
        return tuple(dict.fromkeys(transition.name for transition in self.transitions))

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "configuration": self.configuration.to_json(other_question=_OTHER_QUESTION),
            "compliant": self.compliant.to_json(),
            "state": self.now.to_json(),
            "sets": [state.to_json() for state in self.sets],
            "classes": list(self.classes),
            "transitions": [transition.to_json() for transition in self.transitions],
            "elastic": None if self.elastic is None else self.elastic.to_json(),
            "smallest": None if self.smallest is None else self.smallest.to_json(),
        }

    def blocks(self) -> list[Block]:
        """Return the lines and tables that are printed."""
        lines: list[Block] = [
            f"at this configuration: {_summary(self.now)}   ({self.now.certainty})",
            f"compliant: {self.compliant.text(_NAMED)}",
        ]
        if _branches_meet(self.configuration):
            lines.append(f"the sheet lies flat, where motion branches meet; {_folded(self.configuration)}")
        chosen = _distinctive(self.sets) if self.smallest is None else self._listed_of_many(self.smallest)
        rows = [
            (state.active.text(_NAMED), number_or_unknown(state.freedoms), state.kind, state.certainty)
            for state in chosen[:_LISTED]
        ]
        lines.append(TableBlock(("active", "DOF", "state", "evidence"), rows, ("DOF",)))
        if self.smallest is not None:
            lines += self.smallest.lines(len(self.compliant))
        elif len(self.sets) > len(rows):
            first = "" if len(rows) == len(chosen) else "the first of "
            lines.append(
                f"{len(rows)} of {numbered(len(self.sets), 'set')}: {first}those whose degrees of freedom change "
                "whenever one active member is left out"
            )
        lines += [transition.line() for transition in self.transitions[:_LISTED]] or [
            "no transition of any class at this configuration"
        ]
        if len(self.transitions) > _LISTED:
            lines.append(f"and {len(self.transitions) - _LISTED} more transitions")
        return [*lines, *([] if self.elastic is None else self.elastic.blocks())]

    def _listed_of_many(self, smallest: SmallestSets) -> list[State]:
        """Return the states at rest, with all members active, and of the smallest sets that release a motion."""
        return [self.sets[0], self.sets[-1], *(state for state in smallest.states if state is not self.sets[-1])]

    def __repr__(self) -> str:
        return f"<States: {self.now.kind}; {', '.join(self.classes) or 'no class'}>"


def _distinctive(sets: Sequence[State]) -> list[State]:
    """Return the states of which no state with one active member less has the same freedoms."""
    return [
        state
        for state in sets
        if all(other.freedoms != state.freedoms for other in sets if other.active.is_one_less_than(state.active))
    ]


def _summary(state: State) -> str:
    active = f", active: {state.active.text(_NAMED)}" if len(state.active) else ""
    return f"{state.kind} ({freedoms_text(state.freedoms)}{active})"


@dataclass(frozen=True, slots=True)
class DrivenJoint:
    """A driven joint.

    Attributes
    ----------
    joint : joint id
    to : float
        Radians, from the zero of the joint.
    frames : int
        Configurations after the first.

    Examples
    --------
    >>> DrivenJoint(0, 0.5).frames
    20
    """

    joint: JointId
    to: float
    frames: int = 20

    def __post_init__(self) -> None:
        if self.frames < 1:
            raise InvariantError("frames", f"a path of {self.frames} frames", "1 or more")


@dataclass(frozen=True, slots=True, repr=False)
class StateTable(Printed):
    """What the springs of many copies of one mechanism do: N copies, J joints, F configurations of a load path.

    Attributes
    ----------
    configuration : Configuration
        The input.
    joints : tuple of joint id
        The columns of angles.
    now : tuple of State
        Of each copy at the input: members are active whose springs are not at rest.
    angles : float[N, J]
        Of the equilibria, radians; nan where none was found.
    energy, least, unbalanced, residuals : float[N]
        Of the equilibria, as of `Equilibrium`; least curvatures are nan where there are none.
    stable : bool[N]
        Whether the energy rises along all motions.
    frequencies : float[N, M] or None
        Of small motions, slowest first, in cycles per unit of time; nan where a motion grows. None without masses.
    driven : joint id or None
    path : float[N, F, J]
        Joint angles while the driven joint is driven, radians; nan after the end. F is 0 without it.
    moments, energies : float[N, F]
        On the load path: of the driven joint, and of the springs.
    why : mapping of int to str
        Of copies without an equilibrium, and those whose load path ends early, why.

    Examples
    --------
    >>> from synth.catalogue.patterns import generate
    >>> table = states(generate("four-bar").mechanism, springs=SpringArrays({0: [1.0, 2.0], 1: 1.0}, rest={0: 0.1}))
    >>> table, table.angles.shape, table.stable.tolist()
    (<StateTable: 2 copies, 2 equilibria>, (2, 4), [True, True])
    """

    configuration: Configuration
    joints: tuple[JointId, ...]
    now: tuple[State, ...]
    angles: Floats
    energy: Floats
    least: Floats
    unbalanced: Floats
    residuals: Floats
    stable: Flags
    frequencies: Floats | None
    driven: JointId | None
    path: Floats
    moments: Floats
    energies: Floats
    why: dict[int, str]

    def __len__(self) -> int:
        return len(self.angles)

    @property
    def balanced(self) -> Flags:
        """Which copies have an equilibrium: bool[N]."""
        return np.asarray(~np.isnan(self.energy))

    def to_json(self) -> dict[str, Any]:
        """Return all as plain data, angles in radians; null where there is no number."""
        arrays = ("angles", "energy", "least", "unbalanced", "residuals", "path", "moments", "energies")
        return {
            "configuration": self.configuration.to_json(other_question=_OTHER_QUESTION),
            "joints": list(self.joints),
            "states": [state.to_json() for state in self.now],
            "stable": self.stable.tolist(),
            **{name: _numbers(getattr(self, name)) for name in arrays},
            "frequencies": None if self.frequencies is None else _numbers(self.frequencies),
            "driven": self.driven,
            "why": {str(copy): why for copy, why in self.why.items()},
        }

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        count = Counter((state.kind, stable) for state, stable in zip(self.now, self.stable.tolist(), strict=True))
        rows = [(kind, "stable" if stable else "not stable", str(number)) for (kind, stable), number in count.items()]
        found = int(self.balanced.sum())
        lines: list[Block] = [f"springs of {numbered(len(self), 'copy', 'copies')}; an equilibrium for {found} of them"]
        if rows:
            lines.append(TableBlock(("state at this configuration", "equilibrium", "copies"), rows, ["copies"]))
        if found:
            lines.append(f"largest loop-closure residual: {np.nanmax(self.residuals):.1e}")
        return [*lines, *(f"copy {copy}: {why}" for copy, why in list(self.why.items())[:_LISTED])]

    def __repr__(self) -> str:
        found = numbered(int(self.balanced.sum()), "equilibrium", "equilibria")
        return f"<StateTable: {numbered(len(self), 'copy', 'copies')}, {found}>"


def _numbers(array: Floats) -> list[Any]:
    """Return numbers as lists, with None for nan."""
    numbers = array.astype(object)
    numbers[np.isnan(array)] = None
    return list(numbers.tolist())


@overload
def states(
    mechanism: Movable,
    *,
    joints: Collection[JointId] = (),
    links: Collection[LinkId] = (),
    springs: Springs | None = None,
    drive: DrivenJoint | None = None,
    masses: Masses | None = None,
) -> States: ...


@overload
def states(
    mechanism: Movable,
    *,
    joints: Collection[JointId] = (),
    links: Collection[LinkId] = (),
    springs: SpringArrays,
    drive: DrivenJoint | None = None,
    masses: Masses | None = None,
) -> StateTable: ...


def states(
    mechanism: Movable,
    *,
    joints: Collection[JointId] = (),
    links: Collection[LinkId] = (),
    springs: Springs | SpringArrays | None = None,
    drive: DrivenJoint | None = None,
    masses: Masses | None = None,
) -> States | StateTable:
    """Find the compliance states of a mechanism, and what its springs do.

    Parameters
    ----------
    mechanism : Mechanism or Linkage
        With coordinates; of a sheet with several frames the first that has them.
    joints, links : collection of ids
        Compliant members. Joints with a stiffness are compliant too.
    springs : Springs or SpringArrays, optional
        At joints, with moments. The search for the equilibrium starts at the input configuration. With arrays it is
        done for each of N copies, whose equilibria and load paths are returned as arrays.
    drive : DrivenJoint, optional
        A joint whose load path is followed from the equilibrium.
    masses : Masses, optional
        For modes and frequencies of small motions about the equilibrium.

    Returns
    -------
    States, or of arrays StateTable

    Raises
    ------
    InvariantError
        If there is no such joint or link, or a number is out of range.
    UnsolvableError
        If it has no coordinates, nothing is compliant, there are too many members, or springs have nothing to
        move.
    NumericalError
        If springs come to no balance.

    Examples
    --------
    >>> from synth.catalogue.patterns import generate
    >>> answer = states(generate("four-bar").mechanism, joints=[0])
    >>> answer.classes, [(len(state.active), state.freedoms) for state in answer.sets]
    (('compliant mechanism',), [(0, 0), (1, 1)])
    """
    check_argument("states", mechanism, Movable)
    at = configuration_of(mechanism)
    linkage = at.linkage
    if isinstance(springs, SpringArrays):
        _check_regular(at)
        return _of_copies(
            at, [_compliant(at, joints, links, springs[copy]) for copy in range(len(springs))], springs, drive, masses
        )
    compliant = _compliant(at, joints, links, springs)
    if springs is None and (drive is not None or masses is not None):
        raise UnsolvableError("a load path and frequencies require springs; expected the stiffness of a joint")
    if springs is not None:
        _check_regular(at)
    sets, smallest = states_of(linkage, compliant)
    analysis = _SpringAnalysis(linkage, compliant, springs or Springs())
    active = analysis.active(linkage.angles)
    here = (state for state in sets if state.active.within(active) and active.within(state.active))
    now = next(here, None) or state_of(linkage, compliant, active)
    elastic = None if springs is None else analysis.elastic(drive, masses)
    return States(at, compliant, now, tuple(sets), tuple(_transitions(sets)), elastic, smallest)


def _compliant(
    at: Configuration, joints: Collection[JointId], links: Collection[LinkId], springs: Springs | None
) -> Members:
    """Return the compliant members: those that are named, and joints with a stiffness."""
    stiff = () if springs is None else tuple(joint for joint, value in springs.stiffness.items() if value)
    compliant = Members(tuple(dict.fromkeys((*joints, *stiff))), tuple(dict.fromkeys(links)))
    compliant.check_names(at.linkage.graph)
    if not len(compliant):
        raise UnsolvableError(
            "nothing is compliant; expected one or more compliant joints or links; try --joint, --link or --stiffness"
        )
    return compliant


def _check_regular(at: Configuration) -> None:
    if _branches_meet(at):
        raise UnsolvableError(
            "springs require a regular configuration, and the sheet lies flat, where motion branches meet; "
            + _folded(at)
        )


def _of_copies(
    at: Configuration,
    compliant: Sequence[Members],
    springs: SpringArrays,
    drive: DrivenJoint | None,
    masses: Masses | None,
) -> StateTable:
    """Return what springs do for each copy, from the same search for branches and with the same closure equations."""
    linkage, count = at.linkage, len(springs)
    if any(members.links for members in compliant) and drive is not None:
        raise UnsolvableError("a load path cannot have compliant links; expected compliant joints only")
    joints, rows = len(linkage.angles), 0 if drive is None else drive.frames + 1
    bending = ElasticLinkage(linkage, springs[0]) if count else None
    balance = {name: np.full(count, np.nan) for name in ("energy", "least", "unbalanced", "residuals")}
    on_path = {name: np.full((count, rows), np.nan) for name in ("moments", "energies")}
    table = StateTable(
        configuration=at,
        joints=at.joints,
        now=tuple(_states_at_input(linkage, compliant, springs)),
        angles=np.full((count, joints), np.nan),
        stable=np.zeros(count, dtype=bool),
        frequencies=None if masses is None else np.full((count, bending.freedoms if bending else 0), np.nan),
        driven=None if drive is None else drive.joint,
        path=np.full((count, rows, joints), np.nan),
        why={},
        **balance,
        **on_path,
    )
    for copy in range(count):
        assert bending is not None
        own = bending.with_springs(springs[copy])
        try:
            found = equilibrium(own)
            _write_equilibrium(table, copy, found)
            if table.frequencies is not None and masses is not None:
                modes = small_motions(own, found, masses)
                table.frequencies[copy] = [np.nan if mode.frequency is None else mode.frequency for mode in modes]
            if drive is not None:
                _write_path(table, copy, _driven(own, found, drive))
        except NumericalError as error:
            table.why[copy] = str(error)
    return table


def _states_at_input(linkage: Linkage, compliant: Sequence[Members], springs: SpringArrays) -> Iterator[State]:
    """Yield the state of each copy at the input; copies with the same active members have the same."""
    known: dict[tuple[Members, Members], State] = {}
    for copy, members in enumerate(compliant):
        active = _SpringAnalysis(linkage, members, springs[copy]).active(linkage.angles)
        if (members, active) not in known:
            known[members, active] = state_of(linkage, members, active)
        yield known[members, active]


def _write_equilibrium(table: StateTable, copy: int, balance: Equilibrium) -> None:
    """Write an equilibrium into the row of a copy."""
    table.angles[copy], table.energy[copy], table.stable[copy] = balance.angles, balance.energy, balance.stable
    table.least[copy] = np.nan if balance.least is None else balance.least
    table.unbalanced[copy], table.residuals[copy] = balance.unbalanced, balance.error


def _write_path(table: StateTable, copy: int, path: LoadPath) -> None:
    """Write a load path into the row of a copy."""
    for row, balance in enumerate(path.equilibria):
        table.path[copy, row], table.energies[copy, row] = balance.angles, balance.energy
        table.moments[copy, row] = balance.held[0]
    if path.stopped:
        table.why[copy] = path.stopped


def _branches_meet(at: Configuration) -> bool:
    """Check whether a sheet lies flat, and not all its motions are one branch."""
    return at.flat and bool(at.joints) and (at.branches is None or not at.branches.regular)


def _folded(at: Configuration) -> str:
    """Return the option with which a flat sheet is folded first."""
    branch = at.branch(at.chosen)
    place = 0 if branch is None else leading(np.abs(branch.rates))
    sign = "-" if branch is not None and branch.rates[place] < 0.0 else ""
    return f"try --at {shown(at.joints[place])}={sign}30, which folds a crease first"


@dataclass(frozen=True, slots=True)
class _SpringAnalysis:
    """A linkage, its compliant members, and the springs at its joints."""

    linkage: Linkage
    compliant: Members
    springs: Springs

    def off_rest(self, joint: JointId, angles: Floats) -> float:
        """Return how far a compliant joint is from rest, radians; without a spring it rests at the input."""
        place = list(self.linkage.graph.joints).index(joint)
        return float(angles[place]) - self.springs.rest.get(joint, float(self.linkage.angles[place]))

    def active(self, angles: Floats) -> Members:
        """Return the members that are not at rest. Links have no springs, and count as at rest."""
        return Members(tuple(name for name in self.compliant.joints if not _is_rest(self.off_rest(name, angles))))

    def elastic(self, drive: DrivenJoint | None, masses: Masses | None) -> Elastic:
        """Return what springs do."""
        if self.compliant.links and drive is not None:
            raise UnsolvableError("a load path cannot have compliant links; expected compliant joints only")
        bending = ElasticLinkage(self.linkage, self.springs)
        balance = equilibrium(bending)
        modes = None if masses is None else tuple(small_motions(bending, balance, masses))
        joints = tuple(self.linkage.graph.joints)
        if drive is None:
            return Elastic(joints, balance, modes=modes)
        path = _driven(bending, balance, drive)
        points = tuple(
            LoadPathPoint(at, state_of(moved(self.linkage, at.angles), self.compliant, self.active(at.angles)))
            for at in path.equilibria
        )
        passed = tuple(self.rests_passed(bending, path))
        return Elastic(joints, balance, drive.joint, points, passed, path.stopped, modes)

    def rests_passed(self, bending: ElasticLinkage, path: LoadPath) -> Iterator[RestPassed]:
        """Yield where compliant joints come to rest after the beginning."""
        for before, after in pairwise(path.equilibria):
            ends = [float(balance.angles[path.driver]) for balance in (before, after)]
            for joint in self.compliant.joints:
                was, now = (self.off_rest(joint, balance.angles) for balance in (before, after))
                if _is_rest(was) or (was * now > 0.0 and not _is_rest(now)):
                    continue

                def off(driven: float, joint: JointId = joint, start: Floats = before.angles) -> float:
                    between = load_path(bending, start, path.driver, [driven])
                    return self.off_rest(joint, between.equilibria[-1].angles)

                passed = ends[1] if _is_rest(now) else brentq(off, *ends, xtol=DOUBLE.same_configuration)
                yield RestPassed(joint, passed)


def _driven(bending: ElasticLinkage, at: Equilibrium, drive: DrivenJoint) -> LoadPath:
    """Return the load path of a driven joint from an equilibrium."""
    [driver], goal = goals_of(tuple(bending.linkage.graph.joints), {drive.joint: drive.to}, np.finfo(float).max)
    return load_path(bending, at.angles, driver, np.linspace(at.angles[driver], goal[0], drive.frames + 1)[1:])


def _is_rest(off: float) -> bool:
    """Check whether a joint that is so far from the angle of its spring, in radians, is at rest."""
    return abs(off) <= DOUBLE.same_configuration


def _transitions(sets: Sequence[State]) -> Iterator[Transition]:
    """Yield the transitions of each class: those to the smallest sets, or between sets that differ by a member."""
    rest = sets[0]
    moving = [state for state in sets[1:] if state.freedoms is not None and state.freedoms > (rest.freedoms or 0)]
    if rest.freedoms is not None and moving:
        name = "variable mobility" if rest.freedoms else "compliant mechanism"
        fewest = len(moving[0].active)
        yield from (Transition(name, rest, state) for state in moving if len(state.active) == fewest)
    locking = [
        Transition("compliant locking", before, after)
        for before in sets
        if before.freedoms
        for after in sets[1:]
        if after.freedoms == 0 and after.active.is_one_less_than(before.active)
    ]
    fewest = min((len(change.before.active) for change in locking), default=0)
    yield from (change for change in locking if len(change.before.active) == fewest)
