"""What folding a crease pattern and moving any other linkage have in common: joints driven from a pose.

Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import degrees, pi

import numpy as np

from graphs.edit.named import known
from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.limits import LEAST, MOST, in_reach
from graphs.tolerances import DOUBLE, MARGIN, leading
from graphs.types import Floats, JointId
from synth.motion.beginning import Wanted, beginning
from synth.motion.closure import ClosureEquations
from synth.motion.configuration import Configuration
from synth.motion.linkage import PosedLinkage
from synth.motion.path import Path, PathOptions, driven_path
from synth.motion.walk.allowance import Allowance
from synth.motion.walk.walking import Event

__all__ = ["Asked", "Driven", "check_closed", "driven_from", "goals_of"]

_STEPS, _STEPS_OF_FRAME = 1_000, 20
"""Steps that a motion may take, and as many more for each of its frames: ten times what real patterns need."""


@dataclass(frozen=True, slots=True)
class Asked:
    """The options of a motion.

    `drive` gives the angles of driven joints, radians; without any, the joint that moves most goes as far as it
    can. `along` gives initial rates in their place, and the path goes straight on. The branch is a number or
    signs; `frames` counts those after the first, `report` is called with their number after each; `events` are
    looked for on the way.
    """

    drive: Mapping[JointId, float] = field(default_factory=dict)
    along: Mapping[JointId, float] = field(default_factory=dict)
    branch: int | str | None = None
    frames: int = 20
    report: Callable[[int], None] | None = None
    events: Sequence[Event] = ()


@dataclass(frozen=True, slots=True)
class Driven:
    """A motion, with the branch taken (None where there was no choice).

    `places` are those of the driven joints, `goals` the final angles they were to reach, radians.
    """

    branch: int | None
    places: list[int]
    goals: Mapping[JointId, float]
    path: Path


def check_closed(closure: ClosureEquations, linkage: PosedLinkage) -> None:
    """Raise `UnsolvableError` if loops miss by more than 1e-12, in radians and units of the extent."""
    error = closure.error(linkage.angles)
    if error > DOUBLE.closed:
        raise UnsolvableError(f"loops miss closing by {error:.1e} at the pose, expected {DOUBLE.closed:.0e}")


def goals_of(joints: tuple[JointId, ...], drive: Mapping[JointId, float], most: float) -> tuple[list[int], Floats]:
    """Return the places and the goals of driven joints, radians.

    Raises `InvariantError` if there is no such joint, or an angle is no number or larger than the most.
    """
    places = _places(joints, drive)
    for joint, angle in drive.items():
        if not abs(angle) <= most:
            limits = "between -180 and 180" if most == pi else "a finite angle"
            told = f"joint {shown(joint)} is to turn by {degrees(angle):g} degrees"
            raise InvariantError("joint angle", told, limits)
    return places, np.array(list(drive.values()), dtype=float)


def driven_from(configuration: Configuration, asked: Asked) -> Driven:
    """Drive joints from a configuration, on the branch of the options.

    Raises `UnsolvableError` if nothing moves, or not with the driven joints, `InvariantError` if there is no such
    joint or branch, or an angle is out of range.
    """
    linkage, closure, found = configuration.linkage, configuration.closure, configuration.branches
    joints = configuration.joints
    places, goals = goals_of(joints, asked.drive, configuration.most)
    if asked.along:
        wanted = _along(configuration, asked)
    else:
        turns = goals - linkage.angles[places]
        wanted = Wanted(asked.branch, places, turns)
    number, rates = beginning(configuration, wanted)
    if not places:
        places = [leading(rates)]
        goals = configuration.whole * np.sign(rates[places])
    start = linkage.angles[places]
    if (goals - start) @ rates[places] < -MARGIN * float(np.linalg.norm(goals - start)):
        rates = -rates
    steps = np.arange(1, asked.frames + 1)[:, None] / asked.frames
    limited = np.full(len(joints), configuration.limited)
    by_least_rates = found is not None and found.regular and len(asked.drive) == 1
    direction = None if by_least_rates else rates  # any others might soon turn the driven joint back
    allowance = Allowance(_STEPS + _STEPS_OF_FRAME * asked.frames)
    still = () if number is None or found is None else found.branches[number].still
    options = PathOptions(
        direction,
        limited,
        bool(asked.along),
        asked.report,
        joints,
        allowance,
        still,
        asked.events,
        _signs(configuration, rates, places) if configuration.limited else None,
    )
    path = _path(closure, linkage.angles, places, start + steps * (goals - start), options)
    ends = {joints[place]: float(goal) for place, goal in zip(places, goals, strict=True)}
    return Driven(number, places, ends, path)


def _signs(configuration: Configuration, rates: Floats, driven: Sequence[int]) -> Floats:
    """Return the signs that fold angles are to keep: those they have, those of the rates at zero, else the marks.

    Driven joints go where they are driven. The marks count, or their opposites, where all rates agree with them.
    """
    angles, marks = configuration.linkage.angles, configuration.marks
    rates = np.where(np.abs(rates) > DOUBLE.zero_rate, rates, 0.0)
    turned = rates * marks
    marks = marks * (float(not (turned < 0.0).any()) - float(not (turned > 0.0).any()))
    begun = np.where(rates != 0.0, np.sign(rates), marks)
    signs = np.where(np.abs(angles) > DOUBLE.parallel, np.sign(angles), begun)
    signs[list(driven)] = 0.0
    return np.asarray(signs)


def _path(
    closure: ClosureEquations, start: Floats, places: list[int], values: Floats, options: PathOptions
) -> Path:
    """Return the path on which joints that do not begin to move are locked, or if it ends before, a longer one."""
    if not options.locked or set(options.locked) & set(places):
        return driven_path(closure, start, places, values, options=replace(options, locked=()))
    path = driven_path(closure, start, places, values, options=options)
    if not path.stopped or (path.events and path.events[-1].kind == "collision"):
        return path
    free = driven_path(closure, start, places, values, options=replace(options, locked=()))
    lead = [float(np.abs(one.angles[-1] - start)[places].sum()) for one in (path, free)]
    return free if lead[1] > lead[0] + DOUBLE.moved or not free.stopped else path


def _along(configuration: Configuration, asked: Asked) -> Wanted:
    """Return what is wanted where rates are given: these of their joints, the least ones of others."""
    if asked.drive:
        raise InvariantError("along", "joints are driven too", "rates or angles, not both")
    joints = configuration.joints
    places, rates = _places(joints, asked.along), np.array(list(asked.along.values()), dtype=float)
    if not (in_reach(rates) and np.abs(rates).max(initial=0.0) >= LEAST):
        given = f"rates are {', '.join(map(str, rates))}"
        raise InvariantError("along", given, f"finite ones, not all zero, the largest from {LEAST:g} to {MOST:g}")
    return Wanted(asked.branch, places, rates, along=True)


def _places(joints: tuple[JointId, ...], names: Iterable[JointId]) -> list[int]:
    for joint in names:
        if joint not in joints:
            raise InvariantError("joint", f"{shown(joint)} is no joint", known(joints, str(joint)))
    return [joints.index(joint) for joint in names]
