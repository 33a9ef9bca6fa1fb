"""Levenberg and Marquardt's method for one problem, with second-order corrections, bounds and shortest steps.

A trial step of an iterate is accepted where it reduces the cost; the damping falls where the actual reduction is near
the predicted one and grows where it is not. What an iterate is, and how a step leads to the next, is its own: a
drawing steps along its conditions, a design is closed again after each step. `least_squares` is the common case, a
system of residuals within bounds.

Sources: D. W. Marquardt, SIAM J. 11 (1963); J. J. Moré, The Levenberg-Marquardt algorithm (1978). Theory:
docs/theory/least-squares.md.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import inf
from typing import Generic, Protocol, TypeVar

import numpy as np

from graphs.least_squares.steps import Bounds, bounded_step
from graphs.least_squares.stop_reason import StopReason
from graphs.tolerances import DOUBLE
from graphs.types import Floats

System = Callable[[Floats], tuple[Floats, Floats] | None]
"""Residual float[m] at unknowns float[n], and the Jacobian float[m, n]; None where there are none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LevenbergMarquardt:
    """How steps are damped, which are accepted, and when the search ends. Reductions are parts of the cost.

    The fields without a default depend on the problem: each search states its own, and why.
    """

    first: float
    """Damping of the first step."""
    raised: float
    """Factor of the damping after a step that is rejected, or that reduces the cost much less than predicted."""
    lowered: tuple[float, ...]
    """Divisors of the damping after a good step: by the number of second-order corrections that it took."""
    most_steps: int | None = None
    """Most steps that are accepted."""
    most_trials: int | None = None
    """Most steps that are tried."""
    least: float = 0.0
    """Least damping: zero where J keeps full rank."""
    least_of_cost: float = 0.0
    """Least damping over the cost: far from a solution the linear model does not deserve a longer step."""
    most: float = inf
    """A damping above this says that no step, however short, is accepted."""
    cautious: float | None = None
    """Divisor after a good step that came after rejected ones, if it is another."""
    poor: float = 0.0
    """Below this part of the predicted reduction a step is corrected, and the damping raised; at 0 no step is poor."""
    good: float = 0.0
    """Above this part of the predicted reduction the damping is lowered; at 0 after each accepted step."""
    required: float = 0.0
    """Reduction that a step must exceed to be accepted: above rounding, where the cost has some."""
    least_gain: float = 0.0
    """A step that is accepted and reduces the cost by no more is the last."""
    longest: float = inf
    """Longest step: farther away derivatives say nothing."""
    shortest: float = 0.0
    """A rejected step that changes no unknown by more is the last: a shorter one would be rounding."""
    corrections: int = 0
    """Most second-order corrections of a step."""
    solved: float = DOUBLE.closed / 100.0
    """A residual whose entries are no larger is zero: a hundredth of what counts as closed, which Newton reaches."""

    def damping_at(self, damping: float, cost: float) -> float:
        """Return a damping, or the least one at a cost."""
        return max(damping, self.least, self.least_of_cost * cost)


Iterate = TypeVar("Iterate", bound="_Iterate")


@dataclass(frozen=True, slots=True)
class Trial(Generic[Iterate]):
    """A step that is tried: where it leads, None where there is no cost.

    `predicted` is the reduction of the cost that the linear model predicts, 0 where that is not known; `damping` may
    be more than was asked for, so that the step is not too long. `length` is the largest change of an unknown,
    `corrections` the number of second-order corrections.
    """

    at: Iterate | None
    damping: float
    predicted: float = 0.0
    length: float = inf
    corrections: int = 0


class _Iterate(Protocol):
    """Unknowns with a cost, from which steps can be tried."""

    @property
    def cost(self) -> float:
        """The sum of squares, or another merit that is to fall."""

    @property
    def solved(self) -> bool:
        """Whether nothing is left to reduce."""

    def trial(self: Iterate, damping: float) -> Trial[Iterate]:
        """Return the step with a damping."""


@dataclass(frozen=True, slots=True)
class Minimum(Generic[Iterate]):
    """Where a search ended, why, after how many accepted steps and trials, and the damping then."""

    at: Iterate
    reason: StopReason
    steps: int
    trials: int
    damping: float


def minimise(
    start: Iterate,
    rule: LevenbergMarquardt,
    *,
    may_try: Callable[[], bool] = lambda: True,
    least_gain: Callable[[Iterate], float] | None = None,
) -> Minimum[Iterate]:
    """Follow damped steps from an iterate until the rule ends the search.

    Parameters
    ----------
    start : Iterate
        Has `cost`, `solved`, and `trial(damping)`, which returns a `Trial`.
    rule : LevenbergMarquardt
    may_try : callable
        Asked before each trial: an allowance of work.
    least_gain : callable, optional
        Of the iterate that a step led to: `LevenbergMarquardt.least_gain`, where it depends on that.

    Returns
    -------
    Minimum
    """
    here, damping = start, rule.damping_at(rule.first, start.cost)
    steps, trials, rejected = 0, 0, False

    def ended(reason: StopReason) -> Minimum[Iterate]:
        return Minimum(here, reason, steps, trials, damping)

    while not here.solved:
        if damping > rule.most:
            return ended(StopReason.STALLED)
        if steps == rule.most_steps or trials == rule.most_trials:
            return ended(StopReason.STEPS)
        if not may_try():
            return ended(StopReason.ALLOWANCE)
        trial, cost = here.trial(damping), here.cost
        trials, damping = trials + 1, trial.damping
        there = trial.at
        if there is None or not there.cost < (1.0 - rule.required) * cost:
            damping, rejected = damping * rule.raised, True
            if trial.length <= rule.shortest:
                return ended(StopReason.STALLED)
            continue
        here, steps = there, steps + 1
        reduction = cost - here.cost
        good_enough = reduction > rule.poor * trial.predicted
        if good_enough and reduction <= cost * (least_gain(here) if least_gain else rule.least_gain):
            return ended(StopReason.SETTLED)
        damping = _after(rule, trial, reduction, here.cost, rejected=rejected)
        rejected = False
    return ended(StopReason.SOLVED)


def _after(rule: LevenbergMarquardt, trial: Trial[Iterate], reduction: float, cost: float, *, rejected: bool) -> float:
    """Return the damping after an accepted step, by how much of the predicted reduction it had."""
    if reduction < rule.poor * trial.predicted:
        return rule.damping_at(trial.damping * rule.raised, cost)
    if reduction <= rule.good * trial.predicted:
        return rule.damping_at(trial.damping, cost)
    divisor = rule.lowered[trial.corrections]
    if rejected and rule.cautious is not None:
        divisor = rule.cautious
    return rule.damping_at(trial.damping / divisor, cost)


@dataclass(frozen=True)
class LeastSquaresIterate:
    """Unknowns float[n] of a system within bounds, with its residual float[m] and Jacobian float[m, n] there."""

    system: System
    bounds: Bounds
    rule: LevenbergMarquardt
    unknowns: Floats
    residual: Floats
    jacobian: Floats

    @cached_property
    def cost(self) -> float:
        """The sum of squares."""
        return float(self.residual @ self.residual)

    @property
    def solved(self) -> bool:
        """Whether all residuals are zero but for rounding."""
        return float(np.abs(self.residual).max(initial=0.0)) <= self.rule.solved

    def trial(self, damping: float) -> Trial[LeastSquaresIterate]:
        """Return the shortest damped step, corrected where the residual curves away from what was predicted."""
        moved = self._moved(self.residual, damping)
        while np.linalg.norm(moved - self.unknowns) > self.rule.longest:
            damping *= self.rule.raised
            moved = self._moved(self.residual, damping)
        linear = self.residual + self.jacobian @ (moved - self.unknowns)
        predicted = self.cost - float((linear**2).sum())
        there, corrections = self._at(moved), 0
        # The Jacobian of the first step is kept; what the residual has besides its linear part is taken away, so
        # that steps along curved solutions need not be short (Geodesic acceleration does the same to first order.)
        while there is not None and corrections < self.rule.corrections:
            if self.cost - there.cost > self.rule.poor * predicted:
                break
            missed = there.residual if corrections else there.residual - linear
            corrected = there.unknowns + (self._moved(missed, damping) - self.unknowns)
            second, corrections = self._at(np.clip(corrected, *self.bounds)), corrections + 1
            if second is None or not second.cost < there.cost:
                break
            there = second
        end = moved if there is None else there.unknowns
        length = float(np.abs(end - self.unknowns).max(initial=0.0))
        return Trial(there, damping, predicted, length, corrections)

    def _moved(self, residual: Floats, damping: float) -> Floats:
        return bounded_step(self.unknowns, self.jacobian, residual, self.bounds, damping)

    def _at(self, unknowns: Floats) -> LeastSquaresIterate | None:
        return _iterate(self.system, self.bounds, self.rule, unknowns)


def least_squares(
    system: System,
    start: Floats,
    rule: LevenbergMarquardt,
    bounds: Bounds | None = None,
    *,
    may_try: Callable[[], bool] = lambda: True,
) -> Minimum[LeastSquaresIterate] | None:
    """Minimise a sum of squares by shortest damped steps; None if there is no residual at the start.

    Parameters
    ----------
    system : callable
        Residual float[m] and Jacobian float[m, n] at unknowns float[n]; None where there are none.
    start : float[n]
    rule : LevenbergMarquardt
    bounds : (float[n], float[n]), optional
        Least and greatest unknowns; the start is clipped to them.
    may_try : callable
        Asked before each trial: an allowance of work.

    Returns
    -------
    Minimum or None
        `at` has `unknowns`, `residual`, `jacobian` and `cost`.

    Examples
    --------
    >>> def circle(x):
    ...     return np.array([x @ x - 1.0]), 2.0 * x[None]
    >>> rule = LevenbergMarquardt(first=1e-2, raised=4.0, lowered=(8.0,), most_trials=80)
    >>> found = least_squares(circle, np.array([3.0, 4.0]), rule)
    >>> found.reason.name, found.at.unknowns.round(9).tolist()
    ('SOLVED', [0.6, 0.8])
    """
    bounds = bounds or (np.full(len(start), -inf), np.full(len(start), inf))
    first = _iterate(system, bounds, rule, np.clip(start, *bounds))
    return None if first is None else minimise(first, rule, may_try=may_try)


def _iterate(system: System, bounds: Bounds, rule: LevenbergMarquardt, unknowns: Floats) -> LeastSquaresIterate | None:
    there = system(unknowns)
    return None if there is None else LeastSquaresIterate(system, bounds, rule, unknowns, *there)
