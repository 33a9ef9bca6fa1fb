"""Least squares by steps that are as short as can be: what the equations leave free stays where it was.

Levenberg and Marquardt's method with a damping that is the same for all unknowns: each step is a combination of the
rows of the derivatives, so no step has a part along which nothing changes, and rounding adds none.

Where all equations hold and leave unknowns free, the nearest solution to the start is chosen: so wishes and start
decide, not the way. Solutions are a curved space. A step goes from one of them towards the start, as far as that
changes no equation to first order, and back to the space by the shortest way; where steps end the line to the start
is perpendicular to the space. Theory: docs/theory/design.md.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np

from graphs.rank.singular_values import rank_of, right_vectors
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats
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


_TRIES, _KEPT, _ROUNDS = 40, 5, 4
"""Most points tried; steps from which the next is foreseen; rounds in which conditions that would be hurt are added."""
_SMALLEST = 0.004
"""Part of a step, below which the space is too curved to go on."""


@dataclass(frozen=True, slots=True)
class NearestPoint:
    """Unknowns nearest to a start, and whether the steps ended there."""

    unknowns: Floats
    settled: bool


@dataclass(frozen=True, slots=True)
class _Place:
    """Residuals and slopes at some unknowns; of conditions that do not act there, those of where they last did."""

    unknowns: Floats
    off: Floats
    by: Floats
    sided: Flags
    signs: Floats
    rank: int


def nearest(system: System, unknowns: Floats, start: Floats, bounds: tuple[Floats, Floats]) -> NearestPoint:
    """Return the unknowns nearest to a start at which all residuals are zero, from some at which they are.

    Conditions that ask for no less or no more than a value have neither residual nor slopes where they do not act.
    """
    here, begun = system(unknowns), system(start)
    if here is None:
        return NearestPoint(unknowns, False)
    sided = _idle(*here) | (_idle(*begun) if begun is not None else False)
    place = _Place(unknowns, *here, sided, np.sign(here[0]), rank_of(here[1][~sided]))
    step, part = _towards(place, start, bounds), 1.0
    before: list[tuple[Floats, Floats]] = []
    for _ in range(_TRIES):
        if np.abs(step).max(initial=0.0) <= DOUBLE.same_point:
            return NearestPoint(np.clip(place.unknowns + step, *bounds), True)
        foreseen = step if part < 1.0 else _foreseen(place.unknowns, step, before)
        tried = _at(system, place, np.clip(place.unknowns + part * foreseen, *bounds))
        after = None if tried is None else _towards(tried, start, bounds)
        if tried is None or after is None or not after @ after < step @ step:
            part = part / 2.0 if part < 1.0 or not before else 0.5
            before.clear()
            if part < _SMALLEST:
                break
            continue
        before = [*before, (place.unknowns, step)][-_KEPT:]
        place, step, part = tried, after, min(1.0, 2.0 * part)
    return NearestPoint(place.unknowns, False)


def _idle(off: Floats, by: Floats) -> Flags:
    return np.asarray((off == 0.0) & ~by.any(axis=1))


def _at(system: System, last: _Place, unknowns: Floats) -> _Place | None:
    """Return the place with other unknowns; conditions that no longer act keep their slopes."""
    there = system(unknowns)
    if there is None:
        return None
    off, by = there
    idle = _idle(off, by)
    off = np.where(idle, last.off + last.by @ (unknowns - last.unknowns), off)
    by = np.where(idle[:, None], last.by, by)
    return _Place(unknowns, off, by, last.sided | idle, np.where(idle, last.signs, np.sign(off)), last.rank)


def _towards(place: _Place, start: Floats, bounds: tuple[Floats, Floats]) -> Floats:
    """Return the step to the nearest unknowns to a start at which linear equations hold, and conditions and bounds."""
    here, held = place.unknowns, ~place.sided
    kept = np.zeros(len(here), dtype=bool)
    step = np.zeros(len(here))
    for _ in range(_ROUNDS):
        by = place.by[held]
        off = place.off[held] + by[:, kept] @ step[kept]
        step[~kept] = _projected((start - here)[~kept], off, by[:, ~kept], place.rank + int(held[place.sided].sum()))
        hurt = place.sided & ~held & (place.signs * (place.off + place.by @ step) > DOUBLE.closed)
        beyond = ~kept & ((here + step < bounds[0]) | (here + step > bounds[1]))
        if not hurt.any() and not beyond.any():
            break
        held, kept = held | hurt, kept | beyond
        step = np.where(kept, np.clip(here + step, *bounds) - here, step)
    return step


def _projected(pull: Floats, off: Floats, by: Floats, most: int) -> Floats:
    """Return the part of a pull that changes no linear equation, and the shortest step to where they hold.

    So many equations are independent at most: where they do not hold yet, others seem so that follow from them.
    """
    if not by.size or not by.any():
        return pull
    values, right = right_vectors(np.asarray(np.linalg.qr(by, mode="r")))
    rank = min(most, int((values > DOUBLE.zero * values[0]).sum()))
    rows = right[:rank]
    return np.asarray(pull - (rows @ pull + (rows @ (by.T @ off)) / values[:rank] ** 2) @ rows)


def _foreseen(unknowns: Floats, step: Floats, before: Sequence[tuple[Floats, Floats]]) -> Floats:
    """Return the step to where, by the last steps, there would be none: Anderson's extrapolation."""
    if not before:
        return step
    moves = np.array([unknowns - point for point, _ in before]).T
    changes = np.array([step - one for _, one in before]).T
    parts = np.linalg.lstsq(changes, step, rcond=DOUBLE.same_configuration)[0]
    return np.asarray(step - (moves + changes) @ parts)
