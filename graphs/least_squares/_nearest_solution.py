"""The solution of equations that is nearest to a start, from a solution: equations may leave unknowns free.

Solutions are a curved space. A step goes from one of them towards the start, as far as that changes no residual to
first order, and back to the space by the shortest way; where steps end the line to the start is perpendicular to the
space. So residuals and start decide, not the way. Theory: docs/theory/least-squares.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphs.least_squares.levenberg_marquardt import System
from graphs.least_squares.steps import Bounds
from graphs.least_squares.stop_reason import StopReason
from graphs.rank.singular_values import rank_of, right_vectors
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats


@dataclass(frozen=True, slots=True, kw_only=True)
class _Rule:
    """How steps are taken, and when the search ends."""

    most_trials: int
    kept: int
    rounds: int
    shortest: float


_RULE = _Rule(
    most_trials=40,  # steps converge linearly, extrapolated ones in about ten; a design that needs more is told as such
    kept=5,  # steps that are extrapolated from: more are nearly dependent, and their combinations rounding
    rounds=4,  # of adding conditions and bounds that a step would pass: those added last may free none before
    shortest=0.004,  # part of a step, eight halvings: below it the space is too curved to go on
)


@dataclass(frozen=True, slots=True)
class NearestSolution:
    """Unknowns nearest to a start, float[n], and why the search ended: `SOLVED` where no step is left."""

    unknowns: Floats
    reason: StopReason

    @property
    def settled(self) -> bool:
        """Whether the nearest solution was reached."""
        return self.reason is StopReason.SOLVED


@dataclass(frozen=True, slots=True)
class _Place:
    """Residual and Jacobian at some unknowns; of conditions that do not act there, those of where they last did.

    `one_sided` are conditions that somewhere did not act, `signs` those of their residuals where they did.
    """

    unknowns: Floats
    residual: Floats
    jacobian: Floats
    one_sided: Flags
    signs: Floats
    rank: int


def nearest_solution(system: System, unknowns: Floats, start: Floats, bounds: Bounds) -> NearestSolution:
    """Return the unknowns nearest to a start at which all residuals are zero, from some at which they are.

    Parameters
    ----------
    system : callable
        Residual float[m] and Jacobian float[m, n] at unknowns float[n]; None where there are none. Conditions that
        ask for no less or no more than a value have neither residual nor derivatives where they do not act.
    unknowns : float[n]
        A solution.
    start : float[n]
    bounds : (float[n], float[n])

    Returns
    -------
    NearestSolution

    Examples
    --------
    >>> def circle(x):
    ...     return np.array([x @ x - 1.0]), 2.0 * x[None]
    >>> far = np.full(2, 9.0)
    >>> found = nearest_solution(circle, np.array([1.0, 0.0]), np.array([3.0, 4.0]), (-far, far))
    >>> found.settled, found.unknowns.round(9).tolist()
    (True, [0.6, 0.8])
    """
    here, begun = system(unknowns), system(start)
    if here is None:
        return NearestSolution(unknowns, StopReason.UNDEFINED)
    one_sided = _idle(*here) | (_idle(*begun) if begun is not None else False)
    place = _Place(unknowns, *here, one_sided, np.sign(here[0]), rank_of(here[1][~one_sided]))
    step, part = _towards(place, start, bounds), 1.0
    before: list[tuple[Floats, Floats]] = []
    for _ in range(_RULE.most_trials):
        if np.abs(step).max(initial=0.0) <= DOUBLE.same_point:
            return NearestSolution(np.clip(place.unknowns + step, *bounds), StopReason.SOLVED)
        extrapolated = step if part < 1.0 else _extrapolated(place.unknowns, step, before)
        tried = _at(system, place, np.clip(place.unknowns + part * extrapolated, *bounds))
        after = None if tried is None else _towards(tried, start, bounds)
        if tried is None or after is None or not after @ after < step @ step:
            part = part / 2.0 if part < 1.0 or not before else 0.5
            before.clear()
            if part < _RULE.shortest:
                return NearestSolution(place.unknowns, StopReason.STALLED)
            continue
        before = [*before, (place.unknowns, step)][-_RULE.kept :]
        place, step, part = tried, after, min(1.0, 2.0 * part)
    return NearestSolution(place.unknowns, StopReason.STEPS)


def _idle(residual: Floats, jacobian: Floats) -> Flags:
    return np.asarray((residual == 0.0) & ~jacobian.any(axis=1))


def _at(system: System, last: _Place, unknowns: Floats) -> _Place | None:
    """Return the place with other unknowns; conditions that no longer act keep their derivatives."""
    there = system(unknowns)
    if there is None:
        return None
    residual, jacobian = there
    idle = _idle(residual, jacobian)
    residual = np.where(idle, last.residual + last.jacobian @ (unknowns - last.unknowns), residual)
    jacobian = np.where(idle[:, None], last.jacobian, jacobian)
    signs = np.where(idle, last.signs, np.sign(residual))
    return _Place(unknowns, residual, jacobian, last.one_sided | idle, signs, last.rank)


def _towards(place: _Place, start: Floats, bounds: Bounds) -> Floats:
    """Return the step to the nearest unknowns to a start at which linear equations hold, and conditions and bounds."""
    here, held = place.unknowns, ~place.one_sided
    at_bound = np.zeros(len(here), dtype=bool)
    step = np.zeros(len(here))
    for _ in range(_RULE.rounds):
        jacobian = place.jacobian[held]
        residual = place.residual[held] + jacobian[:, at_bound] @ step[at_bound]
        most = place.rank + int(held[place.one_sided].sum())
        step[~at_bound] = _projected((start - here)[~at_bound], residual, jacobian[:, ~at_bound], most)
        linear = place.signs * (place.residual + place.jacobian @ step)
        hurt = place.one_sided & ~held & (linear > DOUBLE.closed)
        beyond = ~at_bound & ((here + step < bounds[0]) | (here + step > bounds[1]))
        if not hurt.any() and not beyond.any():
            break
        held, at_bound = held | hurt, at_bound | beyond
        step = np.where(at_bound, np.clip(here + step, *bounds) - here, step)
    return step


def _projected(pull: Floats, residual: Floats, jacobian: Floats, most: int) -> Floats:
    """Return the part of a pull that changes no linear equation, and the shortest step to where they hold.

    So many equations are independent at most: where they do not hold yet, others seem so that follow from them.
    """
    if not jacobian.size or not jacobian.any():
        return pull
    values, right = right_vectors(np.asarray(np.linalg.qr(jacobian, mode="r")))
    rank = min(most, int((values > DOUBLE.zero * values[0]).sum()))
    rows = right[:rank]
    return np.asarray(pull - (rows @ pull + (rows @ (jacobian.T @ residual)) / values[:rank] ** 2) @ rows)


def _extrapolated(unknowns: Floats, step: Floats, before: Sequence[tuple[Floats, Floats]]) -> Floats:
    """Return the step to where, by the last steps, there would be none: Anderson's extrapolation."""
    if not before:
        return step
    moves = np.array([unknowns - point for point, _ in before]).T
    changes = np.array([step - one for _, one in before]).T
    parts = np.linalg.lstsq(changes, step, rcond=DOUBLE.same_configuration)[0]
    return np.asarray(step - (moves + changes) @ parts)
