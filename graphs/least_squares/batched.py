"""Levenberg and Marquardt's method for many small problems of one shape, each with its own damping, together.

Residuals and Jacobians of all problems are arrays: Python's work is that of one. A Jacobian is found anew only where a
problem has moved. Theory: docs/theory/least-squares.md.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np

from graphs.least_squares.levenberg_marquardt import LevenbergMarquardt
from graphs.least_squares.steps import Scaling, normal_step
from graphs.least_squares.stop_reason import StopReason
from graphs.types import Flags, Floats, Ints


class BatchedSystem(Protocol):
    """Problems of one shape; `which`, int[k], are those that are asked for."""

    def residual(self, which: Ints, unknowns: Floats) -> tuple[Floats, Floats]:
        """Return residuals float[k, m] at unknowns float[k, u], infinite where there are none, and their data.

        Data, float[k, ...], are what the Jacobian is made of.
        """

    def jacobian(self, which: Ints, unknowns: Floats, residual: Floats, data: Floats) -> Floats:
        """Return the derivatives of residuals float[k, m] by steps: float[k, m, n]."""

    def moved(self, which: Ints, unknowns: Floats, step: Floats) -> Floats:
        """Return unknowns after steps float[k, n]: float[k, u]."""


class BatchedSearch:
    """Searches that go on together.

    Of the rule count the dampings, `required` and `least_gain`; how many steps are taken is said with each run. The
    model predicts nothing.

    Parameters
    ----------
    system : BatchedSystem
    unknowns : float[N, u]
        The starts.
    rule : LevenbergMarquardt
    scaling : callable
        What is damped: `graphs.least_squares.steps.by_the_mean` or `by_each_unknown`.
    begun : (float[N, m], float[N, ...]), optional
        Residuals and data at the starts, where they are known.

    Attributes
    ----------
    unknowns : float[N, u]
    residual : float[N, m]
    costs : float[N]
        Sums of squares, infinite where there is no residual.
    damping : float[N]
    running : bool[N]
        Problems of which further steps may be taken.
    reasons : list of (StopReason or None)
        Why the others ended.

    Examples
    --------
    >>> from graphs.least_squares.steps import by_the_mean
    >>> class Roots:  # of 1, 2 and 3
    ...     def residual(self, which, unknowns):
    ...         return unknowns**2 - (which + 1.0)[:, None], unknowns
    ...     def jacobian(self, which, unknowns, residual, data):
    ...         return 2.0 * data[:, :, None]
    ...     def moved(self, which, unknowns, step):
    ...         return unknowns + step
    >>> rule = LevenbergMarquardt(first=1e-3, raised=8.0, lowered=(8.0,))
    >>> search = BatchedSearch(Roots(), np.ones((3, 1)), rule, by_the_mean)
    >>> search.run(20, np.arange(3))
    >>> (search.unknowns[:, 0] ** 2).round(9).tolist()
    [1.0, 2.0, 3.0]
    """

    def __init__(
        self,
        system: BatchedSystem,
        unknowns: Floats,
        rule: LevenbergMarquardt,
        scaling: Scaling,
        begun: tuple[Floats, Floats] | None = None,
    ) -> None:
        every = np.arange(len(unknowns))
        self.unknowns, self.rule, self._system, self._scaling = unknowns.copy(), rule, system, scaling
        residual, data = begun or system.residual(every, unknowns)
        self.residual, self._data = residual.copy(), data.copy()
        self.costs: Floats = (self.residual**2).sum(axis=1)
        self.damping = np.full(len(unknowns), rule.first)
        self._jacobian: Floats | None = None
        self._stale = np.ones(len(unknowns), dtype=bool)
        self.running: Flags = np.isfinite(self.costs)
        self.reasons: list[StopReason | None] = [None if runs else StopReason.UNDEFINED for runs in self.running]

    def run(self, steps: int, which: Ints) -> None:
        """Try so many steps of some problems, or fewer where all of them have ended."""
        for _ in range(steps):
            running = which[self.running[which]]
            if not len(running):
                return
            self.step(running)

    def step(self, which: Ints) -> None:
        """Try a step of some problems: it is accepted where it reduces the cost, else the next is shorter."""
        jacobian, rule = self.jacobian(which), self.rule
        step = normal_step(jacobian, self.residual[which], self.damping[which], self._scaling)
        unknowns = self._system.moved(which, self.unknowns[which], step)
        residual, data = self._system.residual(which, unknowns)
        costs, before = (residual**2).sum(axis=1), self.costs[which]
        accepted = costs < (1.0 - rule.required) * before
        better = which[accepted]
        self.unknowns[better], self.residual[better] = unknowns[accepted], residual[accepted]
        self._data[better], self.costs[better], self._stale[better] = data[accepted], costs[accepted], True
        gained = 1.0 - costs[accepted] / before[accepted]
        damping = self.damping[which]
        self.damping[which] = np.where(accepted, damping / rule.lowered[0], damping * rule.raised)
        self._end(better[gained < rule.least_gain], StopReason.SETTLED)
        self._end(which[self.damping[which] > rule.most], StopReason.STALLED)

    def jacobian(self, which: Ints) -> Floats:
        """Return the derivatives of the residuals of some problems where they are: float[k, m, n]."""
        stale = which[self._stale[which]]
        if len(stale):
            there = self._system.jacobian(stale, self.unknowns[stale], self.residual[stale], self._data[stale])
            if self._jacobian is None:
                self._jacobian = np.zeros((len(self.unknowns), *there.shape[1:]))
            self._jacobian[stale], self._stale[stale] = there, False
        assert self._jacobian is not None or not len(which)
        return np.zeros((0, self.residual.shape[1], 0)) if self._jacobian is None else self._jacobian[which]

    def _end(self, which: Ints, reason: StopReason) -> None:
        self.running[which] = False
        for problem in which.tolist():
            self.reasons[problem] = reason
