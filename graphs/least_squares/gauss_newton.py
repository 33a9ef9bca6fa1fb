"""Gauss and Newton's method by shortest steps, undamped: to where equations hold, near where they nearly do.

Which step is shortest is the problem's own: of a full matrix `minimum_norm_step`, of a sparse one that of normal
equations. The best iterate is kept, so that steps that lead away do no harm. Theory: docs/theory/least-squares.md.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from graphs.least_squares.stop_reason import StopReason
from graphs.tolerances import DOUBLE


@dataclass(frozen=True, slots=True, kw_only=True)
class GaussNewton:
    """When the search ends."""

    most_steps: int
    """Most steps: near a solution their errors are squared, so a few are enough."""
    solved: float = DOUBLE.closed / 100.0
    """A residual whose entries are no larger is zero: a hundredth of what counts as closed."""
    slow: float = 1.0
    """A step that leaves more than this part of the least residual so far is slow."""
    patience: int | None = None
    """So many slow steps, one after the other, are the last; None where all steps are taken."""


Iterate = TypeVar("Iterate", bound="_Iterate")


class _Iterate(Protocol):
    """Unknowns with a residual, and the step to the next."""

    @property
    def error(self) -> float:
        """The largest residual."""

    def onwards(self: Iterate) -> Iterate | None:
        """Return what the shortest step leads to; None where there are no derivatives, or no residual."""


@dataclass(frozen=True, slots=True)
class Root(Generic[Iterate]):
    """The iterate with the least residual, why the search ended, and the number of steps."""

    at: Iterate
    reason: StopReason
    steps: int


def find_root(start: Iterate, rule: GaussNewton, *, may_step: Callable[[], bool] = lambda: True) -> Root[Iterate]:
    """Follow shortest steps until the residual is zero, or the rule ends the search.

    Parameters
    ----------
    start : Iterate
        Has `error`, the largest residual, and `onwards()`, which returns the next iterate or None.
    rule : GaussNewton
    may_step : callable
        Asked before each step: an allowance of work.

    Returns
    -------
    Root
    """
    best, here, slow = start, start, 0
    for steps in range(rule.most_steps + 1):
        if best.error <= rule.solved:
            return Root(best, StopReason.SOLVED, steps)
        if slow == rule.patience:
            return Root(best, StopReason.STALLED, steps)
        if steps == rule.most_steps:
            break
        if not may_step():
            return Root(best, StopReason.ALLOWANCE, steps)
        there = here.onwards()
        if there is None:
            return Root(best, StopReason.UNDEFINED, steps)
        here = there
        slow = slow + 1 if here.error > rule.slow * best.error else 0
        if here.error < best.error:
            best = here
    return Root(best, StopReason.STEPS, rule.most_steps)
