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
import numpy.typing as npt

from graphs.arrays import Flags, Floats, Ints
from synth.folding.closure import ClosureEquations
from synth.folding.newton import Corrected, corrected

__all__ = ["DrivenPath", "PathOptions", "driven_path"]

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


@dataclass(frozen=True, slots=True)
class PathOptions:
    """How a path is followed.

    Attributes
    ----------
    direction : float[J], optional
        Rates to begin with, where the pose is singular: a flat sheet has several ways to fold. By default the
        least ones that move the driven joints.
    limited : bool[J] or False, optional
        Joints that do not turn beyond 180 degrees: panels lie on each other there.
    straight : bool, optional
        With several freedoms, go on in the direction it began as far as that is possible; by default by the
        least rates that move the driven joints.
    report : callable, optional
        Called with the number of frames after each.
    """

    direction: Floats | None = None
    limited: Flags | bool = False
    straight: bool = False
    report: Callable[[int], None] | None = None


def driven_path(
    closure: ClosureEquations,
    start: Floats,
    drivers: Sequence[int],
    values: npt.ArrayLike,
    *,
    options: PathOptions | None = None,
) -> DrivenPath:
    """Return the closed poses at which some joints have given angles, one after the other.

    Parameters
    ----------
    closure : ClosureEquations
    start : float[J]
        A closed pose, radians.
    drivers : sequence of int
        Places of the joints that are driven.
    values : float[F, D]
        Their angles in each frame, radians.
    options : PathOptions, optional

    Examples
    --------
    A parallelogram in the plane, its first joint turned by 90 degrees:

    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.folding.linkage import linkage_of_axes
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3), "infinite")])
    >>> corners = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]
    >>> linkage = linkage_of_axes(four_bar, {joint: (corners[joint], (0, 0, 1)) for joint in range(4)})
    >>> path = driven_path(ClosureEquations(linkage), linkage.angles, [0], [[np.pi / 4], [np.pi / 2 - 1e-3]])
    >>> np.degrees(path.angles[-1]).round(3).tolist(), path.stopped
    ([89.943, -89.943, 89.943, -89.943], '')
    """
    options = options or PathOptions()
    walk = _Walk(closure, list(drivers), options)
    here = corrected(closure, start)
    frames, stopped = [here], ""
    for value in np.asarray(values, dtype=float).reshape(-1, len(drivers)):
        here, stopped = walk.to(here, value)
        if not stopped or not np.array_equal(here.angles, frames[-1].angles):
            frames.append(here)
        if stopped:
            break
        if options.report is not None:
            options.report(len(frames))
    return DrivenPath(np.array([f.angles for f in frames]), np.array([f.error for f in frames]), stopped)


class _Walk:
    """Steps along a path; their length and direction go on from one frame to the next."""

    def __init__(self, closure: ClosureEquations, drivers: list[int], options: PathOptions) -> None:
        self._closure, self._drivers, self._options = closure, drivers, options
        self._length = _FIRST
        self._rates = options.direction
        self._begun = False

    def to(self, here: Corrected, value: Floats) -> tuple[Corrected, str]:
        """Go on until the driven joints have given angles; return where it ends, and why if it is not there."""
        left = value - here.angles[self._drivers]
        lead = int(np.abs(left).argmax())
        joint, way = self._drivers[lead], float(np.sign(left[lead]))
        if self._begun and self._rates is not None and way * self._rates[joint] < 0.0:
            self._rates = -self._rates
        for _ in range(_MOST_STEPS):
            at = float(here.angles[joint])
            if at == value[lead]:
                return here, ""
            left = value - here.angles[self._drivers]
            rates = self._onwards(here, left)
            size = float(np.abs(rates).max(initial=0.0))
            speed = way * float(rates[joint]) / size if size else 0.0
            if 0.0 <= speed <= _STILL:
                return here, f"the driven joint cannot move from {_told(at)}"
            if speed < 0.0:
                return here, f"the driven joint turns back at {_told(at)}, before {_told(value[lead])}"
            self._rates = rates
            end = self._step(here, rates / size, abs(left[lead]) / speed, left)
            if end is None:
                return here, f"no closed pose is found beyond {_told(at)} of the driven joint"
            over = np.flatnonzero(self._beyond(end.angles))
            if len(over):
                return self._last_before(here, end), f"panels lie on each other at joint(s) {_listed(over)}"
            here, self._begun = end, True
        return here, f"{_MOST_STEPS} steps were not enough"

    def _onwards(self, here: Corrected, left: Floats) -> Floats:
        """Return the rates to go on with: the least that move the driven joints, unless they hardly can."""
        before = self._rates
        if before is not None and not self._begun:
            return before  # at a singular pose: it was chosen
        if before is not None and self._options.straight:
            return here.space.projected(before)
        least = here.space.least_rates(self._drivers, left)
        if before is None or len(self._drivers) > 1:
            return least
        least = least * np.sign(least @ before)
        hardly = np.abs(least[self._drivers]).max() <= _HARDLY * np.abs(least).max(initial=0.0)
        return here.space.projected(before) if hardly or not _alike(least, before) else least

    def _step(self, here: Corrected, rates: Floats, most: float, left: Floats) -> Corrected | None:
        """Take one step of the length that can be trusted, at most to what is left of the driven joints' way."""
        several = len(self._drivers) > 1
        while self._length >= _LEAST:
            lands = self._length >= most
            length = most if lands else self._length
            expected = here.angles + length * rates
            held = self._drivers if lands or several else []
            expected[held] = here.angles[held] + (left if lands else length / most * left)[: len(held)]
            end = corrected(self._closure, expected, held)
            near = end.closed and np.abs(end.angles - expected).max() <= _STRAY * length
            if near and (several or _alike(end.space.projected(rates), rates)):
                end.angles[held] = expected[held]  # they were held but for rounding
                if end.steps <= _EASY and not lands:
                    self._length = min(1.5 * self._length, _LARGEST)
                return end
            self._length = length / 2.0
        self._length = _FIRST
        return None

    def _beyond(self, angles: Floats) -> Flags:
        return np.asarray(self._options.limited & (np.abs(angles) > pi + _ROUNDED))

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
