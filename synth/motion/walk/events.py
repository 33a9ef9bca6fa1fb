"""What a walk meets by itself: turning points, panels on each other, less rank, the place where it began."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi

import numpy as np

from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats, JointId
from synth.motion.closure import ClosureEquations
from synth.motion.newton import Corrected, corrected
from synth.motion.walk.event import named
from synth.motion.walk.parting import other_ways
from synth.motion.walk.step import Step
from synth.motion.walk.walking import Event, Walk, only_rates

__all__ = ["Limit", "RankDeficiency", "Return", "TurningPoint"]

_FLAT, _FLAT_BEYOND = 1e-4, 0.02
"""Angles this near to 0 and 180 degrees, radians, are those if loops close with them; the second is for steps that
lead beyond 180 degrees, since where branches meet Newton's method may end on another."""
_SHORT_OF_END = 0.999
"""Part of a step before its end: where that is singular, rates there are more than the curve's."""


class Limit(Event):
    """Panels lie on each other: joints do not turn beyond 180 degrees.

    Parameters
    ----------
    limited : bool[J]
        Joints that do not.
    names : sequence of J joint ids
    """

    def __init__(self, limited: Flags, names: Sequence[JointId]) -> None:
        self._limited, self._names = limited, names
        self._over, self._reason = tuple[int, ...](), ""

    def within(self, walk: Walk, step: Step) -> tuple[Step, str] | None:
        """End where a joint would turn farther."""
        exact = self._flattened(step)
        if not self._beyond(exact.after.angles).any():
            return None if exact is step else (exact, "")
        self._over = tuple(np.flatnonzero(self._beyond(exact.after.angles)).tolist())
        self._reason = f"panels lie on each other at {named(self._over, self._names)}"
        free, _ = exact.last(lambda angles: not self._beyond(angles).any())
        exact = self._flattened(exact.up_to(free))
        if np.abs(exact.chord).max() <= _FLAT:
            exact = step.up_to(step.before)  # they lie on each other here, but for what loops tell of it
        return exact, self._reason

    def singular(self, step: Step) -> bool:
        """Tell whether panels come to lie on each other at the end of a step."""
        return bool(self._reached(step))

    def after(self, walk: Walk, step: Step) -> None:
        """Record the joints that lie at 180 degrees."""
        joints = self._reached(step)
        if self._reason and walk.ended == self._reason:
            joints = self._over
            if walk.goal is not None:
                walk.ended += f", with {walk.goal.driver} at {walk.goal.angle(step.after)}"
        if joints:
            walk.record("limit", step.after.angles, joints=joints)

    def _flattened(self, step: Step) -> Step:
        """Return the step, its end made exact where panels lie flat on each other.

        Branches meet there, and loops tell angles to the root of their error only.
        """
        halves = np.round(step.after.angles / pi)
        near = _FLAT_BEYOND if self._beyond(step.after.angles).any() else _FLAT
        flat = self._limited & (np.abs(step.after.angles - halves * pi) <= near)
        if not (flat & (halves != 0.0)).any():
            return step
        exact = corrected(step.closure, np.where(flat, halves * pi, step.after.angles))
        return step.up_to(exact) if exact.closed and exact.steps == 0 else step

    def _reached(self, step: Step) -> tuple[int, ...]:
        """Return the joints that come to lie at 180 degrees at the end of a step."""
        before, after = (np.abs(end.angles) >= pi - DOUBLE.immobile for end in (step.before, step.after))
        return tuple(np.flatnonzero(self._limited & after & ~before).tolist())

    def _beyond(self, angles: Floats) -> Flags:
        return np.asarray(self._limited & (np.abs(angles) > pi + DOUBLE.immobile))


class RankDeficiency(Event):
    """The closure equations leave more rates than before and after: branches may part.

    Parameters
    ----------
    closure : ClosureEquations
    """

    def __init__(self, closure: ClosureEquations) -> None:
        self._closure = closure

    def after(self, walk: Walk, step: Step) -> None:
        """Record it, with the number of other branches."""
        if walk.drop is not None:
            angles, drop = walk.drop
            walk.record("rank drop", angles, drop=drop, other_ways=other_ways(self._closure, angles))


class TurningPoint(Event):
    """A joint has an extreme angle. The walk lands there, and goes on.

    Parameters
    ----------
    joint : int
    sense : float, optional
        1.0 or -1.0 as its angle grows or falls until the first one; by default as the walk begins.

    Attributes
    ----------
    last : Corrected or None
        The last one that was met.
    """

    def __init__(self, joint: int, sense: float = 0.0) -> None:
        self._joint, self._sense = joint, sense
        self.last: Corrected | None = None
        self._next: Corrected | None = None

    def within(self, walk: Walk, step: Step) -> tuple[Step, str] | None:
        """Land on the turning point."""
        self._sense = self._sense or float(np.sign(step.leaving[self._joint]))
        self._next = None
        if not (self._sense * step.arriving[self._joint] < 0.0 and self._turns(step)):
            return None
        part = step.zero(lambda place: self._speed(place, step.leaving))
        top = None if part is None else step.at(part)
        if top is None or not top.closed:
            goal = walk.goal
            return None if goal is None else (step, goal.turns_back(step.after))
        if walk.ended and np.abs(top.angles - step.after.angles).max() <= _FLAT:
            return None  # where panels lie on each other joints turn back by themselves
        self._next = top
        return step.up_to(top), ""

    def after(self, walk: Walk, step: Step) -> None:
        """Record it, if the step was not cut shorter."""
        if step.after is not self._next:
            return
        self.last, self._sense = self._next, -self._sense
        walk.record("turning point", step.after.angles, joints=(self._joint,), frame=len(walk.frames))
        goal = walk.goal
        if goal is not None:
            goal.turned = True
            if not only_rates(step.after, step.leaving):
                how = "the way straight on leads" if walk.straight else "the least rates lead"
                several = f"there are several degrees of freedom, and {how} no farther"
                walk.ended = f"{goal.turns_back(step.after)}; {several}"

    def _turns(self, step: Step) -> bool:
        """Tell whether the joint turns back on a step, not only among the rates of a singular end."""
        if only_rates(step.after, step.leaving):
            return True
        return self._sense * self._speed(step.at(_SHORT_OF_END), step.leaving) < 0.0

    def _speed(self, place: Corrected, onwards: Floats) -> float:
        return float(place.space.projected(onwards)[self._joint])


class Return(Event):
    """A walk comes to a configuration again, whole turns aside, the same way as it left it.

    Parameters
    ----------
    angles : float[J]
        The configuration, radians.
    tangent : float[J]
        The way on from there.
    most : int, optional
        After so many steps the walk ends.
    """

    ROUND = "it comes round"

    def __init__(self, angles: Floats, tangent: Floats, reason: str = ROUND, most: int | None = None) -> None:
        self._angles, self._tangent, self._reason, self._most = angles, tangent, reason, most
        self._steps = 0

    def within(self, walk: Walk, step: Step) -> tuple[Step, str] | None:
        """End there. The first step leads away."""
        self._steps += 1
        if self._steps == 1 or step.arriving @ self._tangent <= 0.0:
            return None
        home = step.passing(self._angles, DOUBLE.immobile)
        return None if home is None else (step.up_to(home), self._reason)

    def after(self, walk: Walk, step: Step) -> None:
        """Give up after too many steps."""
        if self._most is not None and self._steps > self._most and not walk.ended:
            walk.ended = f"{self._most} steps did not lead there"
