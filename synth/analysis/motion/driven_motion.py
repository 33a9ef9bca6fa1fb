"""Joints driven from a configuration: which branch is taken, the initial rates on it, how far it goes.

Theory: docs/theory/folding.md.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import degrees, pi, radians, tau

import numpy as np

from graphs.edit.named import known
from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.input_limits import LEAST, MOST, in_reach
from graphs.rank.singular_values import null_space
from graphs.tolerances import DOUBLE, MARGIN, canonical_basis, leading
from graphs.types import Flags, Floats, JointId
from synth.analysis.motion.assigned_branch import marked_rates, rates_as_marked
from synth.analysis.motion.branches import MOST_JOINTS
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.germ import Branch, Branches
from synth.analysis.motion.path import Path, PathOptions, driven_path
from synth.analysis.motion.singular.motion_near_rates import begun_near
from synth.analysis.motion.singular.sampling import rates_towards
from synth.analysis.motion.singular.second_order import RateSpace
from synth.analysis.motion.walk.step import Allowance
from synth.analysis.motion.walk.walking import Event

_LARGE = 10**9
_STARTS = 8
"""Starts of the search for rates with all marks at which several joints are driven."""
_DIGITS = 6
"""Decimals of a cosine: among branches that point along rates alike the first is taken."""


@dataclass(frozen=True, slots=True)
class BranchChoice:
    """The options for the beginning of a motion.

    The branch is a number or signs; by default the configuration chooses it. `turns` says how far each driven
    joint (by its place) is to turn, radians; with `along` they are rates, and the branch nearest to them is taken.
    """

    branch: int | str | None = None
    driven: Sequence[int] = ()
    turns: Floats = field(default_factory=lambda: np.zeros(0))
    along: bool = False

    def towards(self, configuration: Configuration) -> Floats:
        """Return the wanted rates, float[J]: the initial rates of the options, or the signs of the assignment."""
        if not self.along:
            return configuration.wanted
        rates = np.zeros(len(configuration.joints))
        rates[list(self.driven)] = self.turns
        return rates


def beginning(configuration: Configuration, choice: BranchChoice) -> tuple[int | None, Floats]:
    """Return the branch to take, None without a choice, and initial rates on it; an error if nothing moves."""
    branches, towards = configuration.branches, choice.towards(configuration)
    if branches is None or (configuration.one_way and choice.branch is None):
        if choice.branch is not None:
            limits = f"more than {MOST_JOINTS} joints and many branches, or many vertices of more than 4 creases"
            raise UnsolvableError(f"no branches are listed for this mechanism: it has {limits}")
        closure, linkage = configuration.closure, configuration.linkage
        begun = begun_near(closure, linkage, towards) if choice.along else configuration.begun
        if begun.rates is None:
            raise UnsolvableError(f"found no motion near the assignment{configuration.doubt}")
        return None, begun.rates
    if not branches.branches:
        written = "exactly as written, " if configuration.nearly else ""
        raise UnsolvableError(f"{written}{_no_motion(branches)}{configuration.doubt}")
    number = _chosen(configuration, branches, choice)
    marked = configuration.marked.rates
    if marked is not None and choice.branch is None and len(choice.driven) < 2 and not choice.along:
        return None if branches.regular else number, marked
    rates = _rates(branches.branch(number), choice, towards, configuration.marks)
    return None if branches.regular else number, rates


def _no_motion(branches: Branches) -> str:
    """Return that nothing moves from here, with the proof if there is one."""
    proofs = {
        "no rates": "no rates close the loops to first order",
        "definite stress": "a self-stress is definite on all flexes",
        "cases": "no rates agree to second order",
    }
    proof = branches.rigidity.proof if branches.rigidity is not None else None
    if proof:
        return f"no motion begins at this configuration (proved: {proofs[proof]})"
    return "no motion was found at this configuration"


def _chosen(configuration: Configuration, branches: Branches, choice: BranchChoice) -> int:
    name, most = choice.branch, branches.numbered
    if isinstance(name, int):
        if not 0 <= name < most:
            label = str(name) if abs(name) < max(_LARGE, _LARGE * most) else "of so large a number"
            raise InvariantError("branch", f"there is no branch {label}", f"one from 0 to {most - 1}")
        return name
    if isinstance(name, str):
        number = branches.number_of(name)
        if number is None:
            signs = known([branch.signs for branch in branches.branches], name)
            raise InvariantError("branch", f"no branch has the signs {shown(name)}", signs)
        return number
    if not choice.along:
        return configuration.chosen or 0
    return _pointing_best(
        branches, choice.towards(configuration), np.isin(range(len(configuration.joints)), choice.driven)
    )


def _pointing_best(branches: Branches, towards: Floats, driven: Flags) -> int:
    """Return the number of the branch with rates that point along wanted ones best; of each part its own."""
    if branches.parts:
        parts = [(part, part.joints) for part in branches.parts]
        best = [_pointing_best(part.branches, towards[own], driven[own]) if part.choices else 0 for part, own in parts]
        return branches.number_of_choice(best)
    every = branches.branches
    return max(range(len(every)), key=lambda number: (_cosine(every[number], towards, driven), -number))


def _cosine(branch: Branch, towards: Floats, driven: Flags) -> float:
    """Return the cosine between wanted rates and the nearest ones of a branch, of the driven joints."""
    begun, turns = rates_towards(branch.space, towards)[driven], towards[driven]
    sizes = float(np.linalg.norm(begun) * np.linalg.norm(turns))
    return round(float(begun @ turns) / sizes, _DIGITS) if sizes else -1.0


def _rates(branch: Branch, choice: BranchChoice, towards: Floats, marks: Floats) -> Floats:
    """Return rates of a branch at which driven joints begin in proportion; with all marks, if there are such."""
    space = _in_proportion(branch.space, choice) if len(choice.driven) > 1 else branch.space
    if len(choice.driven) < 2 and not choice.along:
        return rates_as_marked(branch, towards) if choice.branch is None else branch.rates
    assigned = marked_rates(space, marks, _STARTS) if marks.any() and not choice.along else []
    for begun in assigned:
        if np.abs(begun[list(choice.driven)]).max() > DOUBLE.zero_rate:
            return np.asarray(begun / np.abs(begun).max())
    for start in (towards, space.basis.sum(axis=1)):
        begun = rates_towards(space, start)
        if np.abs(begun[list(choice.driven)]).max() > DOUBLE.zero_rate:
            return begun
    which = "joints" if choice.along else "driven joints"
    raise UnsolvableError(f"the {which} cannot begin to turn in these proportions on this branch")


def _in_proportion(space: RateSpace, choice: BranchChoice) -> RateSpace:
    """Return the part of a space in which driven joints turn in proportion."""
    across = null_space(choice.turns[None])
    normals = space.basis[list(choice.driven)].T @ across  # of unit vectors: what is small beside 1 is none
    return replace(space, basis=canonical_basis(space.basis @ null_space(normals.T, scale=1.0)))


_STEPS, _STEPS_OF_FRAME = 1_000, 20
"""Steps that a motion may take, and as many more for each of its frames: ten times what real patterns need."""
_NEARLY_HALF = radians(179.0)
"""How far a joint is driven by default that ends at 180 degrees, where panels lie on each other."""


@dataclass(frozen=True, slots=True)
class MotionOptions:
    """The options of a motion.

    `drive` gives the angles of driven joints, radians; by default the joint that moves most goes as far as it can.
    `along` gives initial rates in their place, and the path goes straight on. The branch is a number or signs;
    `frames` counts those after the first, `report` is called with their number; `events` are looked for on the
    way. With `values`, float[F, D], driven joints have these angles one after the other, in place of even steps.
    """

    drive: Mapping[JointId, float] = field(default_factory=dict)
    along: Mapping[JointId, float] = field(default_factory=dict)
    branch: int | str | None = None
    frames: int = 20
    report: Callable[[int], None] | None = None
    events: Sequence[Event] = ()
    values: Floats | None = None


@dataclass(frozen=True, slots=True)
class DrivenMotion:
    """The branch taken (None without a choice), driven joints (places), their final angles, and the path."""

    branch: int | None
    places: list[int]
    goals: Mapping[JointId, float]
    path: Path


def goals_of(joints: tuple[JointId, ...], drive: Mapping[JointId, float], most: float) -> tuple[list[int], Floats]:
    """Return the places and the goals of driven joints, radians; `InvariantError` if one does not exist."""
    places = _places(joints, drive)
    for joint, angle in drive.items():
        if not abs(angle) <= most:
            limits = "between -180 and 180" if most == pi else "a finite angle"
            raise InvariantError("joint angle", f"joint {shown(joint)} is driven to {degrees(angle):g}°", limits)
    return places, np.array(list(drive.values()), dtype=float)


def driven_from(configuration: Configuration, options: MotionOptions) -> DrivenMotion:
    """Drive joints from a configuration, on the branch of the options; the errors are those of `motion_of`."""
    linkage, closure, branches = configuration.linkage, configuration.closure, configuration.branches
    joints = configuration.joints
    largest = pi if configuration.limited else float(np.finfo(float).max)
    places, goals = goals_of(joints, options.drive, largest)
    choice = BranchChoice(options.branch, places, goals - linkage.angles[places])
    number, rates = beginning(configuration, _along(configuration, options) if options.along else choice)
    if not places:
        places = [leading(rates)]
        goals = (_NEARLY_HALF if configuration.limited else tau) * np.sign(rates[places])
    start = linkage.angles[places]
    if (goals - start) @ rates[places] < -MARGIN * float(np.linalg.norm(goals - start)):
        rates = -rates
    steps = np.arange(1, options.frames + 1)[:, None] / options.frames
    limited = np.full(len(joints), configuration.limited)
    by_least_rates = branches is not None and branches.regular and len(options.drive) == 1
    direction = None if by_least_rates else rates  # any others might soon turn the driven joint back
    allowance = Allowance(_STEPS + _STEPS_OF_FRAME * options.frames)
    immobile = () if number is None or branches is None else branches.branch(number).immobile
    signs = _signs(configuration, rates, places) if configuration.limited else None
    straight, report, events = bool(options.along), options.report, options.events
    on_path = PathOptions(direction, limited, straight, report, joints, allowance, immobile, events, signs)
    values = start + steps * (goals - start) if options.values is None else options.values
    path = _path(closure, linkage.angles, places, values, on_path)
    ends = {joints[place]: float(goal) for place, goal in zip(places, goals, strict=True)}
    return DrivenMotion(number, places, ends, path)


def _signs(configuration: Configuration, rates: Floats, driven: Sequence[int]) -> Floats:
    """Return the signs that fold angles are to keep: their own, else of rates, else of marks that agree."""
    angles, marks = configuration.linkage.angles, configuration.marks
    rates = np.where(np.abs(rates) > DOUBLE.zero_rate, rates, 0.0)
    turned = rates * marks
    marks = marks * (float(not (turned < 0.0).any()) - float(not (turned > 0.0).any()))
    begun = np.where(rates != 0.0, np.sign(rates), marks)
    signs = np.where(np.abs(angles) > DOUBLE.parallel, np.sign(angles), begun)
    signs[list(driven)] = 0.0
    return np.asarray(signs)


def _path(closure: ClosureEquations, start: Floats, places: list[int], values: Floats, options: PathOptions) -> Path:
    """Return the path on which joints that do not begin to move are locked, or if it ends before, a longer one."""
    if not options.locked or set(options.locked) & set(places):
        return driven_path(closure, start, places, values, options=replace(options, locked=()))
    path = driven_path(closure, start, places, values, options=options)
    if not path.stopped or (path.events and path.events[-1].kind == "collision"):
        return path
    free = driven_path(closure, start, places, values, options=replace(options, locked=()))
    lead = [float(np.abs(each.angles[-1] - start)[places].sum()) for each in (path, free)]
    return free if lead[1] > lead[0] + DOUBLE.moved or not free.stopped else path


def _along(configuration: Configuration, options: MotionOptions) -> BranchChoice:
    """Return the wanted beginning for initial rates of some joints: the least ones of others."""
    if options.drive:
        raise InvariantError("along", "both initial rates and driven joints", "rates or angles, not both")
    joints = configuration.joints
    places, rates = _places(joints, options.along), np.array(list(options.along.values()), dtype=float)
    if not (in_reach(rates) and np.abs(rates).max(initial=0.0) >= LEAST):
        bounds = f"finite ones, not all zero, the largest from {LEAST:g} to {MOST:g}"
        raise InvariantError("along", f"the rates are {', '.join(map(str, rates))}", bounds)
    return BranchChoice(options.branch, places, rates, along=True)


def _places(joints: tuple[JointId, ...], names: Iterable[JointId]) -> list[int]:
    for joint in names:
        if joint not in joints:
            raise InvariantError("joint", f"{shown(joint)} is no joint", known(joints, str(joint)))
    return [joints.index(joint) for joint in names]
