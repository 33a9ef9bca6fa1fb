"""A step of a walk: the configurations between its ends, and where on it something is so.

A cubic through both ends with the rates of both keeps to the curve to the fourth power of the step, so that
Newton's method does not stray to another branch that passes there.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from graphs.types import Floats
from synth.motion.closure import ClosureEquations
from synth.motion.newton import Corrected, corrected, exactly_held

__all__ = ["STRAY", "Step"]

STRAY = 0.25
"""A corrected configuration is at most this part of its step from where it was expected."""
_NEAR = 1e-9
"""Parts of a step that are told apart."""
_HALVINGS = 40
_NEARINGS = 4
_AT_END = 1e-6
"""Beyond the ends of a step by this part of it, what lies there is still on the step."""


@dataclass(frozen=True, slots=True)
class Step:
    """One step of a walk.

    Attributes
    ----------
    closure : ClosureEquations
    before, after : Corrected
        Its ends.
    leaving, arriving : float[J]
        Rates along the curve at its ends, of any size.
    """

    closure: ClosureEquations
    before: Corrected
    after: Corrected
    leaving: Floats
    arriving: Floats

    @property
    def chord(self) -> Floats:
        """From one end to the other, radians: float[J]."""
        return np.asarray(self.after.angles - self.before.angles)

    def expected(self, part: float) -> Floats:
        """Return joint angles at a part of the step, 0 to 1, to fourth order: float[J], radians."""
        chord = self.chord
        size = float(np.linalg.norm(chord))
        out, back = (rates * (size / np.linalg.norm(rates)) for rates in (self.leaving, self.arriving))
        rest = 1.0 - part
        bulge = part * rest * (rest * (out - chord) - part * (back - chord))
        return np.asarray(self.before.angles + part * chord + bulge)

    def at(self, part: float) -> Corrected:
        """Return the closed configuration at a part of the step."""
        if part in (0.0, 1.0):
            return self.after if part else self.before
        return corrected(self.closure, self.expected(part))

    def piece(self, low: float, high: float) -> Step:
        """Return the step between two parts of this one."""
        first, second = self.at(low), self.at(high)
        return Step(
            self.closure, first, second, first.space.projected(self.chord), second.space.projected(self.chord)
        )

    def up_to(self, end: Corrected) -> Step:
        """Return the step as far as a closed configuration on it."""
        return Step(self.closure, self.before, end, self.leaving, end.space.projected(self.leaving))

    def zero(self, of: Callable[[Corrected], float]) -> float | None:
        """Return the part of the step at which a function is zero; None if its sign does not change."""
        if of(self.before) * of(self.after) > 0.0:
            return None
        return float(brentq(lambda part: of(self.at(part)), 0.0, 1.0, xtol=_NEAR))

    def landing(self, joint: int, value: float) -> Corrected | None:
        """Return the configuration at which a joint has an angle between those it has at the ends.

        None if there is no closed one.
        """
        low, high = 0.0, 1.0
        ends = [float(end.angles[joint]) for end in (self.before, self.after)]
        for _ in range(_HALVINGS):
            part = low + (high - low) * (value - ends[0]) / (ends[1] - ends[0])
            expected = self.expected(part)
            length = float(np.abs(self.chord).max()) * (high - low)
            expected[joint] = value
            held = corrected(self.closure, expected, [joint])
            held = exactly_held(self.closure, held, [joint], expected[[joint]])
            if held.closed and np.abs(held.angles - expected).max() <= length:
                return held
            part = (low + high) / 2.0
            middle = float(self.at(part).angles[joint])
            if (middle - value) * (ends[0] - value) > 0.0:
                low, ends[0] = part, middle
            else:
                high, ends[1] = part, middle
        return None

    def last(self, holds: Callable[[Floats], bool]) -> tuple[Corrected, Corrected]:
        """Return the last closed configuration of which something holds, as of the first one, and the next."""
        low, high, kept, beyond = 0.0, 1.0, self.before, self.after
        while high - low > _NEAR:
            middle = (low + high) / 2.0
            between = self.at(middle)
            if not between.closed:
                high = middle
            elif holds(between.angles):
                low, kept = middle, between
            else:
                high, beyond = middle, between
        return kept, beyond

    def passing(self, angles: Floats, near: float) -> Corrected | None:
        """Return a given closed configuration, whole turns on, if the step passes it to so many radians.

        What is near the step need not be on it: another curve may pass there. So the configuration of the step
        beside the given one is approached along the chord, and has to be the same.
        """
        chord = self.chord
        square = float(chord @ chord)
        turned = angles - 2.0 * np.pi * np.rint((angles - self.before.angles - chord / 2.0) / (2.0 * np.pi))
        part = float((turned - self.before.angles) @ chord) / square
        if not -_AT_END <= part <= 1.0 + _AT_END:
            return None
        beside = self.expected(part)
        if np.abs(turned - beside).max() > STRAY * np.abs(chord).max():
            return None
        for _ in range(_NEARINGS):
            beside = corrected(self.closure, beside).angles
            beside = beside + (turned - beside) @ chord / square * chord
        beside = corrected(self.closure, beside).angles
        return corrected(self.closure, turned) if np.abs(beside - turned).max() <= near else None
