"""Poses between two poses of a path, and where along the step something is zero or ceases to hold.

A cubic through both poses with the rates of both keeps to the path to the fourth power of the step, so that
Newton's method does not stray to another branch that passes there.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from graphs.arrays import Floats
from synth.motion.closure import ClosureEquations
from synth.motion.newton import Corrected, corrected, exactly_held

__all__ = ["Step"]

_NEAR = 1e-9
"""Parts of a step that are told apart."""
_HALVINGS = 40


@dataclass(frozen=True, slots=True)
class Step:
    """One step of a path.

    Attributes
    ----------
    closure : ClosureEquations
    before, after : Corrected
        Its ends.
    leaving, arriving : float[J]
        Rates along the path at its ends, of any size.
    """

    closure: ClosureEquations
    before: Corrected
    after: Corrected
    leaving: Floats
    arriving: Floats

    def expected(self, part: float) -> Floats:
        """Return joint angles at a part of the step, 0 to 1, to fourth order: float[J], radians."""
        chord = self.after.angles - self.before.angles
        size = float(np.linalg.norm(chord))
        out, back = (rates * (size / np.linalg.norm(rates)) for rates in (self.leaving, self.arriving))
        rest = 1.0 - part
        bulge = part * rest * (rest * (out - chord) - part * (back - chord))
        return np.asarray(self.before.angles + part * chord + bulge)

    def pose(self, part: float) -> Corrected:
        """Return the closed pose at a part of the step."""
        return corrected(self.closure, self.expected(part))

    def piece(self, low: float, high: float) -> Step:
        """Return the step between two parts of this one."""
        first, second = self._at(low), self._at(high)
        chord = self.after.angles - self.before.angles
        return Step(self.closure, first, second, first.space.projected(chord), second.space.projected(chord))

    def up_to(self, end: Corrected) -> Step:
        """Return the step as far as a closed pose on it."""
        return Step(self.closure, self.before, end, self.leaving, end.space.projected(self.leaving))

    def landing(self, joint: int, value: float) -> Corrected | None:
        """Return the pose within the step at which a joint has an angle between those it has at the ends.

        None if there is no closed one.
        """
        low, high = 0.0, 1.0
        ends = [float(end.angles[joint]) for end in (self.before, self.after)]
        for _ in range(_HALVINGS):
            part = low + (high - low) * (value - ends[0]) / (ends[1] - ends[0])
            expected = self.expected(part)
            length = float(np.abs(self.after.angles - self.before.angles).max()) * (high - low)
            expected[joint] = value
            held = corrected(self.closure, expected, [joint])
            held = exactly_held(self.closure, held, [joint], expected[[joint]])
            if held.closed and np.abs(held.angles - expected).max() <= length:
                return held
            part = (low + high) / 2.0
            middle = float(self.pose(part).angles[joint])
            if (middle - value) * (ends[0] - value) > 0.0:
                low, ends[0] = part, middle
            else:
                high, ends[1] = part, middle
        return None

    def zero(self, of: Callable[[Corrected], float]) -> float | None:
        """Return the part of the step at which a function of poses is zero; None if its sign does not change."""
        if of(self.before) * of(self.after) > 0.0:
            return None
        return float(brentq(lambda part: of(self._at(part)), 0.0, 1.0, xtol=_NEAR))

    def last(self, holds: Callable[[Floats], bool]) -> Corrected:
        """Return the last closed pose of the step whose angles are as they should, the first one being so."""
        low, high, kept = 0.0, 1.0, self.before
        while high - low > _NEAR:
            middle = (low + high) / 2.0
            between = self.pose(middle)
            if between.closed and holds(between.angles):
                low, kept = middle, between
            else:
                high = middle
        return kept

    def _at(self, part: float) -> Corrected:
        if part in (0.0, 1.0):
            return self.after if part else self.before
        return self.pose(part)
