"""Paths of closed poses: one joint driven, all loops kept closed, each step no larger than can be trusted.

A step goes along the rates at which loops stay closed, the least ones that move the driven joint, and is corrected
by Newton's method; where the driven joint lands on an angle that is asked for it is held there. A step is halved
if its end does not close, lies far from where it was expected, or goes on in another direction: paths that come
near each other are not confused. Where a path ends before its goal it says why. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import degrees, pi

import numpy as np

from graphs.arrays import Flags, Floats, Ints
from synth.folding.closure import ClosureEquations
from synth.folding.newton import Corrected, corrected

__all__ = ["DrivenPath", "driven_path"]

_FIRST, _LARGEST, _LEAST = 0.02, 0.2, 1e-6
"""Steps, radians of the joint that moves most."""
_STRAY = 0.5
"""A corrected pose is at most this part of its step from where it was expected."""
_BEND = 0.6
"""Cosine of the angle between directions before and after a step, at least."""
_STILL = 1e-7
"""Rates below this part of the largest are none."""
_HARDLY = 0.05
"""A driven joint that has less than this part of the largest rate may be about to turn back."""
_EASY = 4
"""Steps of Newton's method after which a step of the path may be longer."""
_ROUNDED = 1e-9
_MOST_STEPS = 20_000


@dataclass(frozen=True, slots=True)
class DrivenPath:
    """Poses that a linkage passes through while one joint is driven.

    Attributes
    ----------
    angles : float[F, J]
        Joint angles of each frame, radians; the first is where it began.
    errors : float[F]
        By how much loops do not close, at most, in radians and units of the extent.
    stopped : str
        Why it ended before its goal; empty if it did not.
    """

    angles: Floats
    errors: Floats
    stopped: str


def driven_path(
    closure: ClosureEquations,
    start: Floats,
    driver: int,
    values: Sequence[float],
    *,
    direction: Floats | None = None,
    limited: Flags | None = None,
    straight: bool = False,
    report: Callable[[int], None] | None = None,
) -> DrivenPath:
    """Return the closed poses at which a joint has given angles, one after the other.

    Parameters
    ----------
    closure : ClosureEquations
    start : float[J]
        A closed pose, radians.
    driver : int
        Place of the joint that is driven.
    values : sequence of float
        Its angles, radians, in the order in which they are to come.
    direction : float[J], optional
        Rates to begin with, where the pose is singular: a flat sheet has several ways to fold. By default the
        least ones that move the driven joint.
    limited : bool[J], optional
        Joints that do not turn beyond 180 degrees: panels lie on each other there.
    straight : bool, optional
        With several freedoms, go on in the direction it began as far as that is possible; by default by the
        least rates that move the driven joint.
    report : callable, optional
        Called with the number of frames after each.

    Examples
    --------
    A parallelogram in the plane, its first joint turned by 90 degrees:

    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.folding.linkage import linkage_of_axes
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3), "infinite")])
    >>> corners = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]
    >>> linkage = linkage_of_axes(four_bar, {joint: (corners[joint], (0, 0, 1)) for joint in range(4)})
    >>> path = driven_path(ClosureEquations(linkage), linkage.angles, 0, [np.pi / 4, np.pi / 2 - 1e-3])
    >>> np.degrees(path.angles[-1]).round(3).tolist(), path.stopped
    ([89.943, -89.943, 89.943, -89.943], '')
    """
    never = np.zeros(len(start), dtype=bool)
    walk = _Walk(closure, driver, never if limited is None else limited, straight)
    here = corrected(closure, start)
    if direction is None:
        way = np.sign(values[0] - start[driver]) if len(values) else 1.0
        direction = way * here.space.least_rates(driver)
    frames, stopped = [here], ""
    for value in values:
        here, direction, stopped = walk.to(here, value, direction)
        if not stopped or not np.array_equal(here.angles, frames[-1].angles):
            frames.append(here)
        if stopped:
            break
        if report is not None:
            report(len(frames))
    return DrivenPath(np.array([f.angles for f in frames]), np.array([f.error for f in frames]), stopped)


class _Walk:
    """Steps along a path; their length goes from one frame to the next."""

    def __init__(self, closure: ClosureEquations, driver: int, limited: Flags, straight: bool) -> None:
        self._closure, self._driver, self._limited, self._straight = closure, driver, limited, straight
        self._length = _FIRST

    def to(self, here: Corrected, value: float, rates: Floats) -> tuple[Corrected, Floats, str]:
        """Go on until the driven joint has an angle; return where it ends, the rates there, why it stopped."""
        way = float(np.sign(value - here.angles[self._driver])) or 1.0
        for _ in range(_MOST_STEPS):
            at = float(here.angles[self._driver])
            if at == value:
                return here, rates, ""
            size = float(np.abs(rates).max(initial=0.0))
            speed = way * float(rates[self._driver]) / size if size else 0.0
            if size == 0.0 or 0.0 <= speed <= _STILL:
                return here, rates, f"the driven joint cannot move from {_told(at)}"
            if speed < 0.0:
                return here, rates, f"the driven joint turns back at {_told(at)}, before {_told(value)}"
            end = self._step(here, rates / size, abs(value - at) / speed, value)
            if end is None:
                return here, rates, f"no closed pose is found beyond {_told(at)} of the driven joint"
            over = np.flatnonzero(self._beyond(end.angles))
            if len(over):
                return self._last_before(here, end), rates, f"panels lie on each other at joint(s) {_listed(over)}"
            here, rates = end, self._onwards(end, rates)
        return here, rates, f"{_MOST_STEPS} steps were not enough"

    def _onwards(self, here: Corrected, rates: Floats) -> Floats:
        """Return the rates to go on with: the least that move the driver, unless it hardly moves."""
        if self._straight:
            return here.space.projected(rates)
        least = here.space.least_rates(self._driver)
        least = least * np.sign(least @ rates)
        if _alike(least, rates) and abs(least[self._driver]) > _HARDLY * np.abs(least).max():
            return least
        return here.space.projected(rates)

    def _step(self, here: Corrected, rates: Floats, most: float, value: float) -> Corrected | None:
        """Take one step, of the length that can be trusted, at most as far as the value asked for."""
        while self._length >= _LEAST:
            lands = self._length >= most
            length = most if lands else self._length
            expected = here.angles + length * rates
            if lands:
                expected[self._driver] = value
            end = corrected(self._closure, expected, [self._driver] if lands else ())
            if lands and end.closed:
                end.angles[self._driver] = value  # it was held but for rounding
            if end.closed and np.abs(end.angles - expected).max() <= _STRAY * length:
                if _alike(end.space.projected(rates), rates):
                    if end.steps <= _EASY and not lands:
                        self._length = min(1.5 * self._length, _LARGEST)
                    return end
            self._length = length / 2.0
        self._length = _FIRST
        return None

    def _beyond(self, angles: Floats) -> Flags:
        return np.asarray(self._limited & (np.abs(angles) > pi + _ROUNDED))

    def _last_before(self, here: Corrected, end: Corrected) -> Corrected:
        """Return the last closed pose, between two, at which no panels have passed each other."""
        low, high, last = 0.0, 1.0, here
        while high - low > _ROUNDED:
            middle = (low + high) / 2.0
            between = corrected(self._closure, here.angles + middle * (end.angles - here.angles))
            if between.closed and not self._beyond(between.angles).any():
                low, last = middle, between
            else:
                high = middle
        return last


def _alike(one: Floats, other: Floats) -> bool:
    return bool(one @ other > _BEND * np.linalg.norm(one) * np.linalg.norm(other))


def _told(angle: float) -> str:
    return f"{degrees(angle):.6g} degrees"


def _listed(joints: Ints) -> str:
    return ", ".join(map(str, joints.tolist()))
