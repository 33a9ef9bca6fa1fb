"""Steps along a path, each no longer than can be trusted.

A step goes along rates at which loops stay closed, bent as the last step was, and is corrected by Newton's
method; where driven joints land on angles that are asked for they are held there. A step is halved if its end does
not close, lies far from where it was expected, or goes on in another direction: paths that come near each other
are not confused. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf, sqrt

import numpy as np

from graphs.arrays import Flags, Floats
from graphs.ids import JointId
from synth.motion.closure import ClosureEquations
from synth.motion.newton import Corrected, corrected, exactly_held
from synth.motion.walk.between import Step

__all__ = ["PathOptions", "Stepping"]

_FIRST, _LARGEST, _LEAST = 0.02, 0.2, 1e-6
"""Steps, radians of the joint that moves most."""
_STRAY = 0.5
"""A corrected pose is at most this part of its step from where it was expected."""
_ALIKE = 0.6
"""Cosine of the angle between directions before and after a step, at least."""
_HARDLY = 0.05
"""A driven joint that has less than this part of the largest rate may be about to turn back."""
_EASY = 5
"""Steps of Newton's method after which a step of the path may be longer."""
_ALONG = 1e-6
"""Part of rates that is left across the path where there is one freedom."""


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
    names : sequence of J joint ids, optional
        How joints are told; by default by their places.
    allowance : Allowance, optional
        Steps that may be taken, by this path and others that share it.
    locked : sequence of int, optional
        Places of joints that keep their angles: those that do not move on the branch. Their closure equations may
        be squares there, which tell angles to the root of their error only.
    """

    direction: Floats | None = None
    limited: Flags | bool = False
    straight: bool = False
    report: Callable[[int], None] | None = None
    names: Sequence[JointId] | None = None
    allowance: Allowance | None = None
    locked: Sequence[int] = ()


@dataclass(slots=True)
class Allowance:
    """Work that a search may do altogether, such as the steps of all its paths.

    Where panels are all but nothing ways are endless. Work is counted, not timed, so that answers are the same on
    slow and on fast machines.

    Attributes
    ----------
    left : float
        Steps, or other units of work.

    Examples
    --------
    >>> some = Allowance(1)
    >>> some.take(), some.take()
    (True, False)
    """

    left: float

    def take(self, work: float = 1) -> bool:
        """Take a step, or some work, if it is left."""
        self.left -= work
        return self.left >= 0

    @property
    def used_up(self) -> bool:
        """Whether more was asked for than there was."""
        return self.left < 0


class Stepping:
    """Steps along a path; their length, direction and bend go on from one frame to the next."""

    def __init__(self, closure: ClosureEquations, drivers: list[int], options: PathOptions) -> None:
        self._closure, self._drivers, self._straight = closure, drivers, options.straight
        self._length = _FIRST
        self._rates = options.direction
        self._bend = np.zeros(closure.joints)
        self._begun = self._singular = False

    def turn_towards(self, joint: int, way: float) -> None:
        """Go back along the path if a joint does not go the way it is to go."""
        if self._begun and self._rates is not None and way * self._rates[joint] < 0.0:
            self._rates = -self._rates

    def onwards(self, here: Corrected, left: Floats) -> Floats:
        """Return the rates to go on with, the largest 1 or -1: the least ones that move the driven joints.

        Where these hardly can, or branches meet, those nearest to the rates before. Zeros if nothing moves.
        """
        rates = self._onwards(here, left)
        size = float(np.abs(rates).max(initial=0.0))
        return rates / size if size else rates

    def _onwards(self, here: Corrected, left: Floats) -> Floats:
        before = self._rates
        if before is not None and not self._begun:
            return before  # at a singular pose: it was chosen
        if before is not None and (self._straight or (self._singular and len(self._drivers) == 1)):
            return here.space.projected(before)
        least = here.space.least_rates(self._drivers, left)
        if before is None or len(self._drivers) > 1:
            return least
        least = least * np.sign(least @ before)
        hardly = np.abs(least[self._drivers]).max() <= _HARDLY * np.abs(least).max(initial=0.0)
        return here.space.projected(before) if hardly or not _alike(least, before) else least

    def taken(self, here: Corrected, rates: Floats, left: Floats, lead: int) -> Step | None:
        """Take one step of the length that can be trusted, at most to what is left of the driven joints' way.

        Parameters
        ----------
        here : Corrected
        rates : float[J]
            The largest 1 or -1.
        left : float[D]
            How far the driven joints are to turn, radians.
        lead : int
            Which of them has farthest to go.
        """
        several = len(self._drivers) > 1
        bend = np.zeros_like(rates) if several else self._bend
        joint = self._drivers[lead]
        most = _reach(float(rates[joint]), float(bend[joint]), float(left[lead]))
        while self._length >= _LEAST:
            lands = self._length >= most
            length = most if lands else self._length
            expected = here.angles + length * rates + length**2 / 2.0 * bend
            held = self._drivers if lands or several else []
            expected[held] = here.angles[held] + (left if lands else length / most * left)[: len(held)]
            end = corrected(self._closure, expected, held)
            if end.closed and np.abs(end.angles - expected).max() <= _STRAY * length:
                arriving = end.space.projected(rates)
                easy = end.steps <= _EASY and not lands
                end = exactly_held(self._closure, end, held, expected[held])
                if end.closed and (several or _alike(arriving, rates)):
                    if easy:
                        self._length = min(1.5 * self._length, _LARGEST)
                    return Step(self._closure, here, end, rates, arriving)
            self._length = length / 2.0
        self._length = _FIRST
        return None

    def take(self, step: Step, *, singular: bool) -> None:
        """Go on from the end of a step; say if it is at a singular pose, where rates are more than the path's."""
        self._begun, self._singular = True, singular
        chord = step.after.angles - step.before.angles
        length = float(np.abs(chord).max(initial=0.0))
        if not length:
            return
        self._rates = 2.0 * chord / length - step.leaving if singular else step.arriving
        bend = (step.arriving / max(float(np.abs(step.arriving).max()), _LEAST) - step.leaving) / length
        self._bend = bend if np.abs(bend).max() * self._length <= _STRAY and not singular else np.zeros_like(bend)

    def single(self, pose: Corrected, rates: Floats) -> bool:
        """Tell whether a pose has one freedom, to first order: all rates there are those of the path."""
        along = pose.space.projected(rates)
        along = along / np.linalg.norm(along)
        any_rates = pose.space.projected(np.random.default_rng(len(rates)).normal(size=len(rates)))
        across = any_rates - (any_rates @ along) * along
        return bool(np.linalg.norm(across) <= _ALONG * np.linalg.norm(any_rates))


def _reach(speed: float, bend: float, left: float) -> float:
    """Return after which length a joint has gone as far as it is to go; infinite if it turns back before."""
    if left < 0.0:
        speed, bend, left = -speed, -bend, -left
    square = speed * speed + 2.0 * bend * left
    if square <= 0.0 or speed + sqrt(square) <= 0.0:
        return inf
    return 2.0 * left / (speed + sqrt(square))


def _alike(one: Floats, other: Floats) -> bool:
    return bool(one @ other > _ALIKE * np.linalg.norm(one) * np.linalg.norm(other))
