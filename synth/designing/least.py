"""Least squares by steps that are as short as can be: what the equations leave free stays where it was.

Levenberg and Marquardt's method with a damping that is the same for all unknowns: each step is a combination of the
rows of the derivatives, so no step has a part along which nothing changes, and rounding adds none. Theory:
docs/theory/design.md.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf

import numpy as np

from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.realisation.measures import damped_least_squares

System = Callable[[Floats], tuple[Floats, Floats] | None]
"""Residuals float[m] at unknowns float[n], and their derivatives float[m, n]; None where there are none."""

_FIRST, _LEAST, _PART, _MOST = 0.03, 1e-7, 0.01, 1e3
"""Weight of a step at first, and its bounds; below the least one rounding would show along what is free."""
_MORE, _LESS, _BOWS = 4.0, (5.0, 2.5, 1.5), 2
_LONGEST = 1.0
"""Length of a step, in radians and units of dimensions: farther away derivatives say nothing."""
_POOR, _GOOD = 0.25, 0.5
"""Below and above these parts of the gain that derivatives promise, the weight grows and falls."""


@dataclass(frozen=True, slots=True)
class LeastSquares:
    """Unknowns at which a sum of squares is least, and whether the search ended by its criterion, not by its steps."""

    unknowns: Floats
    residual: Floats
    slopes: Floats
    settled: bool

    @property
    def cost(self) -> float:
        """The sum of squares."""
        return float(self.residual @ self.residual)


def least_squares(
    system: System, start: Floats, bounds: tuple[Floats, Floats], steps: int, gain: float
) -> LeastSquares | None:
    """Return unknowns of least squares near a start, None if there are no residuals there.

    The search ends where all residuals are zero but for rounding, where a step takes away less than a part ``gain`` of
    the sum of squares, or with so many steps.
    """
    unknowns = np.clip(start, *bounds)
    first = system(unknowns)
    if first is None:
        return None
    (off, by), weight = first, _FIRST
    for _ in range(steps):
        cost = float(off @ off)
        if np.abs(off).max(initial=0.0) <= DOUBLE.closed / 100:
            return LeastSquares(unknowns, off, by, True)
        weight = max(weight, least_weight(cost))
        moved = shortest_step(unknowns, off, by, bounds, weight)
        while np.linalg.norm(moved - unknowns) > _LONGEST:
            weight *= _MORE
            moved = shortest_step(unknowns, off, by, bounds, weight)
        promised = cost - float(((off + by @ (moved - unknowns)) ** 2).sum())
        there = system(moved)
        bows = 0
        while there is not None and bows < _BOWS and not _gained(cost, there) > _POOR * promised:
            bent = there[0] - (off + by @ (moved - unknowns)) if not bows else there[0]
            bowed = np.clip(moved + (shortest_step(unknowns, bent, by, bounds, weight) - unknowns), *bounds)
            second, bows = system(bowed), bows + 1
            if second is None or not _gained(cost, second) > _gained(cost, there):
                break
            moved, there = bowed, second
        gained = -inf if there is None else _gained(cost, there)
        if there is None or not gained > 0.0:
            weight *= _MORE
            if weight > _MOST or np.abs(moved - unknowns).max() <= DOUBLE.closed:
                return LeastSquares(unknowns, off, by, True)
            continue
        unknowns, (off, by) = moved, there
        if gained <= gain * cost and gained > _POOR * promised:
            return LeastSquares(unknowns, off, by, True)
        if gained < _POOR * promised:
            weight *= _MORE
        elif gained > _GOOD * promised:
            weight /= _LESS[bows]
    return LeastSquares(unknowns, off, by, False)


def shortest_step(unknowns: Floats, off: Floats, by: Floats, bounds: tuple[Floats, Floats], weight: float) -> Floats:
    """Return the unknowns after a damped step of least squares; those at a bound that push against it stay."""
    low, high = bounds
    uphill = by.T @ off
    free = np.flatnonzero(~(((unknowns <= low) & (uphill > 0.0)) | ((unknowns >= high) & (uphill < 0.0))))
    moved = unknowns.copy()
    if len(free):
        moved[free] += damped_least_squares(by[:, free], -off, weight)
    return np.asarray(np.clip(moved, low, high))


def _gained(cost: float, there: tuple[Floats, Floats]) -> float:
    return cost - float(there[0] @ there[0])


def least_weight(cost: float) -> float:
    """Return the least weight of a step from some sum of squares: below it rounding shows along what is free."""
    return max(_LEAST, _PART * float(np.sqrt(cost)))
