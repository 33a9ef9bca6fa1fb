"""The design nearest to the start, among all that meet the wishes as well: so wishes and start decide, not the way.

Where equations leave unknowns free, those at which all equations hold are a curved space. A step goes from one of
them towards the start, as far as that changes no equation to first order, and back to the space by the shortest way;
where steps end the line to the start is perpendicular to the space. Theory: docs/theory/design.md.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphs.rank.singular_values import rank_of, right_vectors
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats
from synth.designing.least import System

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
