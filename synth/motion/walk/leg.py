"""A path from one frame to the next: steps until the driven joints have the angles asked for.

With one freedom the path is a curve, and goes on past the points at which the driven joint turns back, until it
has its angle, comes round, or ends. What it meets is kept as events. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi

import numpy as np

from graphs.arrays import Flags, Floats
from graphs.canonical import leading, trailing
from graphs.errors import shown
from graphs.ids import JointId
from synth.motion.closure import ClosureEquations
from synth.motion.newton import Corrected, corrected
from synth.motion.walk.between import Step
from synth.motion.walk.event import EventKind, PathEvent, angle_told, joints_told
from synth.motion.walk.parting import other_ways
from synth.motion.walk.rank import WATCHED, RankWatch
from synth.motion.walk.stepping import PathOptions, Stepping

__all__ = ["Leg", "Legs"]

_STILL = 1e-7
"""Rates below this part of the largest are none."""
_ROUNDED = 1e-9
_FLAT, _FLAT_BEYOND = 1e-4, 0.02
"""Angles this near to 0 and 180 degrees, radians, are those if loops close with them; the second is for steps that
lead beyond 180 degrees, since where branches meet Newton's method may end on another."""
_MOST_STEPS = 20_000
_MOST_PAST = 1_000
"""Steps past a turning point."""


@dataclass(frozen=True, slots=True)
class Leg:
    """A path from one frame to the next.

    Attributes
    ----------
    poses : list of Corrected
        Turning points that were passed, and where it ended.
    events : list of PathEvent
        What it met; frames count from the one before the leg.
    stopped : str
        Why it ended before its goal; empty if it did not.
    """

    poses: list[Corrected]
    events: list[PathEvent]
    stopped: str


class Legs:
    """Legs of one path, one after the other."""

    def __init__(self, closure: ClosureEquations, drivers: list[int], options: PathOptions) -> None:
        self.drivers, self.options = drivers, options
        self.names: Sequence[JointId] = range(closure.joints) if options.names is None else options.names
        self.closure = closure
        self.moving = closure.locked(options.locked) if options.locked else closure
        self.stepping = Stepping(self.moving, drivers, options)
        self.watch = RankWatch(closure) if 0 < closure.joints <= WATCHED and closure.rows else None

    def to(self, here: Corrected, value: Floats) -> Leg:
        """Go on until the driven joints have given angles float[D], radians, or to where that ends."""
        return _Following(self, here, value).leg()


class _Following:
    """One leg while it is followed."""

    def __init__(self, legs: Legs, here: Corrected, value: Floats) -> None:
        self._legs, self._stepping = legs, legs.stepping
        self._here, self._value = here, value
        left = value - here.angles[legs.drivers]
        self._lead = leading(left)
        self._joint, self._way = legs.drivers[self._lead], float(np.sign(left[self._lead]))
        self._last: Step | None = None
        self._tops: list[Corrected] = []
        self._events: list[PathEvent] = []
        self._first_turn: tuple[Floats, Floats] | None = None
        self._past = 0
        self._stepping.turn_towards(self._joint, self._way)

    def leg(self) -> Leg:
        """Follow the path."""
        allowance = self._legs.options.allowance
        for _ in range(_MOST_STEPS):
            if allowance is not None and not allowance.take():
                return self._ended("the allowance of steps was used up")
            stopped = "" if self._left(self._here) == 0.0 else self._onwards()
            if stopped or self._left(self._here) == 0.0:
                return self._ended(stopped)
        return self._ended(f"{_MOST_STEPS} steps were not enough")

    def _left(self, pose: Corrected) -> float:
        """Return how far the driven joint has to go, negative if it is past its goal."""
        return self._way * (float(self._value[self._lead]) - float(pose.angles[self._joint]))

    def _onwards(self) -> str:
        """Take one step; return why there is none, or none after it."""
        here, drivers = self._here, self._legs.drivers
        left = self._value - here.angles[drivers]
        rates = self._stepping.onwards(here, left)
        speed = self._way * float(rates[self._joint])
        last = self._last
        if last is not None and len(drivers) == 1 and rates[self._joint] * last.leaving[self._joint] < 0.0:
            stopped = self._turned(last)
            if stopped or self._left(self._here) == 0.0:
                return stopped
        if 0.0 <= speed <= _STILL and not self._tops:
            return f"{self._driver} cannot move from {angle_told(self._at(here))}"
        if speed < 0.0 and not self._tops:
            return self._turns_back(here)
        step = self._stepping.taken(here, rates, left, self._lead)
        if step is None:
            return self._lost(here)
        return self._taken(step)

    def _taken(self, step: Step) -> str:
        """Go to the end of a step, or to the goal or the limit within it."""
        stopped, step = "", self._flattened(step)
        if self._beyond(step.after.angles).any():
            over = step.after.angles
            step = self._flattened(step.up_to(step.last(lambda angles: not self._beyond(angles).any())))
            joints = tuple(np.flatnonzero(self._beyond(over)).tolist())
            if np.abs(step.after.angles - step.before.angles).max() <= _FLAT:
                step = step.up_to(step.before)  # they lie on each other here, but for what loops tell of it
            stopped = f"panels lie on each other at joint(s) {joints_told(joints, self._legs.names)}"
        if len(self._legs.drivers) == 1 and self._left(step.after) < 0.0:
            landed = step.landing(self._joint, float(self._value[0]))
            if landed is None:
                return self._lost(self._here)
            step, stopped = step.up_to(landed), ""
        self._look_out(step)
        if not stopped:
            joints = self._at_limit(step)
        if joints:
            self._note("limit", step.after.angles, joints=joints)
        if stopped:
            stopped += f", with {self._driver} at {angle_told(self._at(step.after))}"
        self._here, self._last = step.after, step
        return stopped or self._come_round(step)

    def _flattened(self, step: Step) -> Step:
        """Return the step, its end made exact where panels lie flat on each other.

        Branches meet there, and loops tell angles to the root of their error only.
        """
        if not np.any(self._legs.options.limited):
            return step
        halves = np.round(step.after.angles / pi)
        near = _FLAT_BEYOND if self._beyond(step.after.angles).any() else _FLAT
        flat = self._legs.options.limited & (np.abs(step.after.angles - halves * pi) <= near)
        if not (flat & (halves != 0.0)).any():
            return step
        exact = corrected(step.closure, np.where(flat, halves * pi, step.after.angles))
        return step.up_to(exact) if exact.closed and exact.steps == 0 else step

    def _at_limit(self, step: Step) -> tuple[int, ...]:
        """Return the joints that come to lie at 180 degrees at the end of a step."""
        before, after = (np.abs(end.angles) >= pi - _ROUNDED for end in (step.before, step.after))
        return tuple(np.flatnonzero(self._legs.options.limited & after & ~before).tolist())

    def _look_out(self, step: Step) -> None:
        """Watch the rank on a step, and go on from its end."""
        watch = self._legs.watch
        flat = bool(self._at_limit(step))
        found = None if watch is None else watch.dropped(step, flat=flat)
        if found is not None:
            ways = other_ways(self._legs.closure, found[0])
            self._events.append(
                PathEvent("rank drop", len(self._tops), self._joint, (self._joint,), found[0], found[1], ways)
            )
        self._stepping.take(step, singular=watch is not None and watch.singular)

    def _turned(self, step: Step) -> str:
        """Pass the turning point of the driver on the last step; return why it is not passed."""
        part = step.zero(lambda pose: float(pose.space.projected(step.leaving)[self._joint]))
        top = None if part is None else step.pose(part)
        if top is None or not top.closed:
            return self._turns_back(self._here)
        if self._left(top) < 0.0:
            landed = step.up_to(top).landing(self._joint, float(self._value[0]))
            self._here = top if landed is None else landed
            return "" if landed is not None else self._turns_back(top)
        self._note("turning point", top.angles)
        if not self._stepping.single(top, step.leaving):
            self._here = top
            how = "the way straight on leads" if self._legs.options.straight else "the least rates lead"
            return f"{self._turns_back(top)}; there are several freedoms, and {how} no farther"
        if self._first_turn is None:
            self._first_turn = top.angles, top.space.projected(step.leaving)
        self._tops.append(top)
        return ""

    def _come_round(self, step: Step) -> str:
        """Tell whether a step past a turning point leads through the first one again, or there were too many."""
        if self._first_turn is None:
            return ""
        self._past += 1
        if self._past > _MOST_PAST:
            return f"{_MOST_PAST} steps did not lead there"
        angles, rates = self._first_turn
        chord = step.after.angles - step.before.angles
        beyond = np.remainder(step.after.angles - angles + pi, 2.0 * pi) - pi
        passed = (beyond - chord) @ rates < 0.0 <= beyond @ rates
        near = max(float(np.linalg.norm(beyond)), float(np.linalg.norm(beyond - chord))) <= np.linalg.norm(chord)
        alike = step.arriving @ rates > 0.0
        return "the path comes round to there" if passed and near and alike else ""

    def _ended(self, stopped: str) -> Leg:
        """Return the leg; where it did not reach its goal, up to where the driver came nearest to that."""
        poses = [*self._tops, self._here]
        if not stopped or not self._tops:
            return Leg(poses, self._events, stopped)
        best = trailing(np.array([self._left(pose) for pose in poses]), scale=1.0)
        if best == len(self._tops):
            return Leg(poses, self._events, stopped)
        turns = [place for place, event in enumerate(self._events) if event.kind == "turning point"]
        stopped = f"{self._turns_back(poses[best])}; past that, {stopped}"
        return Leg(poses[: best + 1], self._events[: turns[best] + 1], stopped)

    def _note(
        self,
        kind: EventKind,
        angles: Floats,
        *,
        joints: tuple[int, ...] = (),
    ) -> None:
        at = len(self._tops) + (kind == "turning point")
        self._events.append(PathEvent(kind, at, self._joint, joints or (self._joint,), angles))

    def _beyond(self, angles: Floats) -> Flags:
        return np.asarray(self._legs.options.limited & (np.abs(angles) > pi + _ROUNDED))

    @property
    def _driver(self) -> str:
        return f"the driven joint {shown(self._legs.names[self._joint])}"

    def _at(self, pose: Corrected) -> float:
        return float(pose.angles[self._joint])

    def _lost(self, here: Corrected) -> str:
        """Say that there is no step from a pose: how near it comes to where that is so, rounding decides."""
        return f"no closed pose is found beyond {angle_told(self._at(here), decimals=1)} of {self._driver}"

    def _turns_back(self, pose: Corrected) -> str:
        asked = angle_told(float(self._value[self._lead]))
        return f"{self._driver} turns back at {angle_told(self._at(pose))}, before {asked}"
