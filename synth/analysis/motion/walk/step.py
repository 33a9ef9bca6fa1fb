"""Parts of a walk: its steps, the work it may do, the record of its events, and the watch over the rank.

The least singular value across the freedoms is followed by one step of inverse iteration per configuration; with a
sign, kept by the continuity of its image, it passes through zero where the rank drops. Such steps, and those where
it dips, are examined: a configuration is reported only where singular values are found to be zero. Of two values
near each other the vector may go over from one to the other, and a drop be missed. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import degrees, remainder, sqrt, tau
from typing import Any, Literal

import numpy as np

from graphs.errors import numbered, shown
from graphs.rank.dissection import number_below
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId
from synth.analysis.motion.closure import ClosureEquations, Corrected, corrected, exactly_held
from synth.analysis.motion.tangent import TangentSpace


@dataclass(slots=True)
class Allowance:
    """Work that a search may do, such as steps: counted, not timed, to be the same on every machine."""

    left: float

    def take(self, work: float = 1) -> bool:
        """Take a step, or another amount of work, if it is left."""
        self.left -= work
        return self.left >= 0

    @property
    def used_up(self) -> bool:
        """Whether more work was called for than there was."""
        return self.left < 0


EventKind = Literal["turning point", "limit", "rank drop", "collision", "turns over"]


_DIGITS: dict[EventKind, int] = {"turning point": 6, "limit": 4, "rank drop": 3, "collision": 6, "turns over": 2}
"""Decimals of a degree: a singular value of zero, and panels that lie flat on each other, are found to the root of
rounding."""


@dataclass(frozen=True, slots=True)
class PathEvent:
    """An event on a path, at joint angles float[J], radians; `frame` is the last one before it, or at it.

    Turning point: the `driver` (its place) has its extreme angle. Limit: panels lie on each other at the `joints`.
    Rank drop: the closure equations leave `drop` more rates than before and after; `other_ways` counts the other
    motion branches there, to second order, None where that does not tell. Collision: two `panels` begin to pass
    through each other. Turns over: the angle of a crease changes its sign.
    """

    kind: EventKind
    frame: int
    driver: int
    joints: tuple[int, ...]
    angles: Floats
    drop: int = 0
    other_ways: int | None = None
    panels: tuple[int, ...] = ()

    def to_json(self, names: Sequence[JointId]) -> dict[str, Any]:
        """Return the event as plain data, angles in degrees."""
        return {
            "kind": self.kind,
            "frame": self.frame,
            "driver": names[self.driver],
            "at_deg": self._at_deg,
            "joints": [names[joint] for joint in self.joints],
            "drop": self.drop,
            "other_ways": self.other_ways,
            "panels": list(self.panels),
        }

    @property
    def _at_deg(self) -> float:
        """The angle of the driver in degrees, to the digits that the place of the event is known to."""
        return round(degrees(float(self.angles[self.driver])), _DIGITS[self.kind]) + 0.0

    def line(self, names: Sequence[JointId]) -> str:
        """Return the event in one line, joints called by names: sequence of J ids."""
        at = f"at joint {shown(names[self.driver])} = {self._at_deg:.6g}°"
        if self.kind == "turning point":
            return f"turning point {at}"
        if self.kind == "limit":
            return f"limit {at}: panels lie on each other at {named(self.joints, names)}"
        if self.kind == "collision":
            return f"collision {at}: panels {self.panels[0]} and {self.panels[1]}"
        if self.kind == "turns over":
            return f"sign change {at}: {named(self.joints, names, 'crease')}, since no motion keeps all signs"
        others = self.other_ways
        lower = f"rank of the closure equations {self.drop} lower"
        branches = "branches may meet"
        if others is not None:
            branches = f"{numbered(others, 'other motion branch', 'other motion branches')} (second order)"
        return f"singular configuration {at}: {lower}; {branches}"


def in_degrees(angle: float, decimals: int = 6) -> str:
    """Return an angle, radians, as printed text: "60°"."""
    return f"{round(degrees(angle), decimals) + 0.0:.6g}°"


def named(joints: Sequence[int], names: Sequence[JointId], noun: str = "joint") -> str:
    """Return some joints by their names, after what they are: "joints 'a', 'c'"."""
    return (noun if len(joints) == 1 else f"{noun}s") + " " + ", ".join(shown(names[joint]) for joint in joints)


def length_of(vector: Floats) -> float:
    """Return the length of a vector: as numpy's norm, which looks longer at what it is given."""
    return sqrt(vector @ vector)


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
    """One step of a walk between closed configurations; the rates along the curve, float[J], have any size."""

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
        """Return joint angles at a part of the step, 0 to 1: float[J], radians.

        A cubic through both ends with the rates of both keeps to the curve to the fourth power of the step, so
        that Newton's method does not stray to another branch that passes there.
        """
        return self.cubic()(part)

    def cubic(self) -> Callable[[float], Floats]:
        """Return what `expected` returns for a part."""
        chord, start = self.chord, self.before.angles
        size = length_of(chord)
        out, back = (rates * (size / length_of(rates)) - chord for rates in (self.leaving, self.arriving))

        def expected(part: float) -> Floats:
            rest = 1.0 - part
            return np.asarray(start + part * chord + part * rest * (rest * out - part * back))

        return expected

    def at(self, part: float) -> Corrected:
        """Return the closed configuration at a part of the step."""
        if part in (0.0, 1.0):
            return self.after if part else self.before
        return corrected(self.closure, self.expected(part))

    def piece(self, low: float, high: float) -> Step:
        """Return the step between two parts of this one."""
        first, second = self.at(low), self.at(high)
        leaving, arriving = (end.space.projected(self.chord) for end in (first, second))
        return Step(self.closure, first, second, leaving, arriving)

    def up_to(self, end: Corrected) -> Step:
        """Return the step as far as a closed configuration on it."""
        return Step(self.closure, self.before, end, self.leaving, end.space.projected(self.leaving))

    def zero(self, of: Callable[[Corrected], float]) -> float | None:
        """Return the part of the step at which a function is zero; None if its sign does not change."""
        if of(self.before) * of(self.after) > 0.0:
            return None
        from scipy.optimize import brentq  # takes a third of a second to load

        return float(brentq(lambda part: of(self.at(part)), 0.0, 1.0, xtol=_NEAR))

    def landing(self, joint: int, value: float) -> Corrected | None:
        """Return the closed configuration at which a joint has an angle between those at the ends; else None."""
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

        What is near the step may be on another curve. So the configuration of the step beside the given one is
        approached along the chord, and has to be the same.
        """
        chord = self.chord
        square = float(chord @ chord)
        sizes = np.abs(chord)
        lead = int(sizes.argmax())
        largest = float(sizes[lead])
        # the cubic strays from the chord by at most half of its length: most steps are told by one joint
        off = remainder(float(angles[lead] - self.before.angles[lead] - chord[lead] / 2.0), tau)
        if abs(off) > (0.5 + STRAY) * largest + 0.5 * sqrt(square):
            return None
        turned = angles - 2.0 * np.pi * np.rint((angles - self.before.angles - chord / 2.0) / (2.0 * np.pi))
        part = float((turned - self.before.angles) @ chord) / square
        if not -_AT_END <= part <= 1.0 + _AT_END:
            return None
        beside = self.expected(part)
        if np.abs(turned - beside).max() > STRAY * largest:
            return None
        for _ in range(_NEARINGS):
            beside = corrected(self.closure, beside).angles
            beside = beside + (turned - beside) @ chord / square * chord
        beside = corrected(self.closure, beside).angles
        return corrected(self.closure, turned) if np.abs(beside - turned).max() <= near else None


WATCHED = 10_000
"""Linkages of more joints are not watched."""
_WHOLE = 400
"""To look into a step of up to so many joints all their singular values are taken; of more only that which is followed,
and those near zero are counted."""
_SHARPENED = 3
"""Steps of inverse iteration for that value, from its vector at the end of the step."""
SINGULAR = 10.0 * DOUBLE.singular
"""A least singular value that is all but zero."""
_DIP = 0.1
"""Part of a squared singular value that is left at the bottom of a dip worth looking into."""
_AROUND = 0.05
"""Half of the part of a step that is looked into a second time."""
_ROUGH, _EXACT = 1e-3, 1e-7
_FAR = 0.05
"""A singular value that stays above this on the cubic of a step is not zero beside it."""
_MOST_LOOKS = 12
"""Steps of one path that are looked into at most."""


class RankWatch:
    """The least singular value across the freedoms; `singular` if it is all but zero at the last place."""

    def __init__(self, closure: ClosureEquations) -> None:
        self._closure = closure
        start = np.random.default_rng(closure.joints).normal(size=closure.joints)
        self._across, self._image = start / np.linalg.norm(start), np.zeros(closure.rows)
        self._values: list[float] = []
        self._steps: list[Step] = []
        self._lengths: list[float] = []
        self._looks = 0
        # many joints have singular values this small where they are only near to lie flat
        self._zero = DOUBLE.singular if closure.joints <= _WHOLE else DOUBLE.clear
        self.singular = False

    @property
    def begun(self) -> bool:
        """Whether a step was watched."""
        return bool(self._steps)

    @property
    def across(self) -> tuple[Floats, Floats]:
        """The vector across the freedoms that is followed, and its image."""
        return self._across, self._image

    def dropped(
        self, step: Step, *, flat: bool = False, across: tuple[Floats, Floats] | None = None
    ) -> tuple[Floats, int] | None:
        """Go on by one step; return joint angles on it or the last one where the rank drops, and by how much.

        Where panels lie flat on each other, at its end, the rank is always looked at. The vector across the freedoms
        at its end, and its image, may be known.
        """
        value = self._followed(step, across)
        self.singular = abs(value) <= SINGULAR
        self._values, self._steps = [*self._values, value][-3:], [*self._steps, step][-2:]
        self._lengths = [*self._lengths, length_of(step.chord)][-2:]
        if self._looks >= _MOST_LOOKS:
            return None
        drop = None
        if flat or abs(value) <= self._zero:
            drop = self._deficient(step.after.angles, step)
        elif len(self._values) > 1 and self._values[-2] * value < 0.0:
            drop = self._examined(step)
        elif self._dips():
            drop = self._examined(self._steps[0]) or self._examined(step)
        else:
            return None
        self.singular |= drop is not None and drop[0] is step.after.angles
        self._values = [] if self.singular else [value]
        return drop

    def _followed(self, step: Step, known: tuple[Floats, Floats] | None) -> float:
        """Return the least singular value at the end of a step, with the sign that continuity gives it."""
        across, image = known or self._sharpened(step.after.space)
        before = self._values[-1] if self._values else 1.0
        sign = np.sign(before) if image @ self._image >= 0.0 else -np.sign(before)
        self._across, self._image = across, image
        return float(sign * length_of(image))

    def _sharpened(self, space: TangentSpace) -> tuple[Floats, Floats]:
        if not self._steps:
            self._across = _across_freedoms(space, self._across)
        across = space.sharpened(self._across)
        across = across if across @ self._across >= 0.0 else -across
        return across, space.image(across)

    def _dips(self) -> bool:
        """Tell whether a parabola through the last squares has a bottom near zero in the last two steps."""
        if len(self._values) < 3:
            return False
        first, second = self._lengths
        if not (first and second):  # a step of no length: nothing was passed
            return False
        before, here, after = (value * value for value in self._values)
        slope, onwards = (here - before) / first, (after - here) / second
        bend = (onwards - slope) / (first + second)
        if not bend > 0.0:
            return False
        slope += bend * first
        bottom = -slope / (2.0 * bend)
        return bool(-first < bottom < second and here - bend * bottom**2 <= _DIP * here)

    def _examined(self, step: Step) -> tuple[Floats, int] | None:
        """Look for a configuration on a step at which singular values are zero."""
        self._looks += 1
        freedoms = self._zeros(step.before.angles)
        part, square = self._least(step, freedoms, _ROUGH)
        if square > _FAR**2:
            return None
        narrow = step.piece(max(part - _AROUND, 0.0), min(part + _AROUND, 1.0))
        return self._deficient(narrow.expected(self._least(narrow, freedoms, _EXACT)[0]), step)

    def _least(self, step: Step, freedoms: int, exact: float) -> tuple[float, float]:
        """Return the part of a step at which the least singular value across the freedoms is least; its square."""
        expected = step.cubic()

        def square(part: float) -> float:
            if self._closure.joints > _WHOLE:
                return self._square_followed(expected(part))
            return float(self._squares(expected(part))[freedoms])

        from scipy.optimize import minimize_scalar  # takes a third of a second to load

        least = minimize_scalar(square, bounds=(0.0, 1.0), method="bounded", options={"xatol": exact})
        return float(least.x), float(least.fun)

    def _deficient(self, angles: Floats, step: Step) -> tuple[Floats, int] | None:
        drop = self._zeros(angles) - self._zeros(step.before.angles)
        return (angles, drop) if drop > 0 else None

    def _square_followed(self, angles: Floats) -> float:
        """Return the square of the singular value of the vector that is followed, sharpened there."""
        space, across = self._closure.space(self._closure.evaluated(angles)[1]), self._across
        for _ in range(_SHARPENED):
            across = space.sharpened(across)
        return length_of(space.image(across)) ** 2

    def _zeros(self, angles: Floats) -> int:
        if self._closure.joints > _WHOLE:
            return number_below(self._closure.at(angles)[1], self._zero)
        return int((self._squares(angles) <= DOUBLE.singular**2).sum())

    def _squares(self, angles: Floats) -> Floats:
        """Return the squares of the singular values, of all joints, the least first: float[J]."""
        jacobian = self._closure.dense(angles)
        return np.asarray(np.linalg.eigvalsh(jacobian.T @ jacobian))


def _across_freedoms(space: TangentSpace, start: Floats) -> Floats:
    """Return the part of a unit vector across the freedoms, to begin with; if all rates are free, itself."""
    across = start - space.projected(start)
    size = float(np.linalg.norm(across))
    return across / size if size > DOUBLE.clear else start
