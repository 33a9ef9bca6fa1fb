"""Events of a walk: turning points, panels on each other, rank deficiencies, the return to where it began.

Theory: docs/theory/folding.md.
"""

from collections.abc import Sequence
from math import pi

import numpy as np

from graphs.rank.singular_values import rank_of, row_space, split
from graphs.tolerances import DOUBLE, pivots
from graphs.types import Flags, Floats, Ints, JointId
from synth.analysis.motion.closure import MOST_WHOLE, ClosureEquations, Corrected, corrected
from synth.analysis.motion.tangent import TangentSpace
from synth.analysis.motion.walk.step import Step, named
from synth.analysis.motion.walk.walking import Event, Walk, only_rates

_FLAT, _FLAT_BEYOND = 1e-4, 0.02
"""Angles this near to 0 and 180 degrees, radians, are those if loops close with them; the second is for steps that
lead beyond 180 degrees, since where branches meet Newton's method may end on another."""
_SHORT_OF_END = 0.999
"""Part of a step before its end: where that is singular, rates there are more than the curve's."""


class Limit(Event):
    """Panels lie on each other: limited joints, bool[J], do not turn beyond 180 degrees."""

    def __init__(self, limited: Flags, names: Sequence[JointId]) -> None:
        self._limited, self._names = limited, names
        self._over, self._reason = tuple[int, ...](), ""

    def within(self, walk: Walk, step: Step) -> tuple[Step, str] | None:
        """End where a joint would turn farther."""
        exact = self._flattened(step)
        if not self._beyond(exact.after.angles).any():
            return None if exact is step else (exact, "")
        self._over = tuple(np.flatnonzero(self._beyond(exact.after.angles)).tolist())
        self._reason = f"panels lie on each other at {named(self._over, self._names)}"
        free, _ = exact.last(lambda angles: not self._beyond(angles).any())
        exact = self._flattened(exact.up_to(free))
        if np.abs(exact.chord).max() <= _FLAT:
            exact = step.up_to(step.before)  # they lie on each other here, but for what loops tell of it
        return exact, self._reason

    def singular(self, step: Step) -> bool:
        """Tell whether panels come to lie on each other at the end of a step."""
        return bool(self._reached(step))

    def after(self, walk: Walk, step: Step) -> None:
        """Record the joints that lie at 180 degrees."""
        joints = self._reached(step)
        if self._reason and walk.ended == self._reason:
            joints = self._over
            if walk.goal is not None:
                walk.ended += f", with {walk.goal.driver} at {walk.goal.angle(step.after)}"
        if joints:
            walk.record("limit", step.after.angles, joints=joints)

    def _flattened(self, step: Step) -> Step:
        """Return the step, its end made exact where panels lie on each other: loops tell angles roughly there."""
        halves = np.round(step.after.angles / pi)
        near = _FLAT_BEYOND if self._beyond(step.after.angles).any() else _FLAT
        flat = self._limited & (np.abs(step.after.angles - halves * pi) <= near)
        if not (flat & (halves != 0.0)).any():
            return step
        exact = corrected(step.closure, np.where(flat, halves * pi, step.after.angles))
        return step.up_to(exact) if exact.closed and exact.steps == 0 else step

    def _reached(self, step: Step) -> tuple[int, ...]:
        """Return the joints that come to lie at 180 degrees at the end of a step."""
        before, after = (np.abs(end.angles) >= pi - DOUBLE.immobile for end in (step.before, step.after))
        return tuple(np.flatnonzero(self._limited & after & ~before).tolist())

    def _beyond(self, angles: Floats) -> Flags:
        return np.asarray(self._limited & (np.abs(angles) > pi + DOUBLE.immobile))


class RankDeficiency(Event):
    """The closure equations leave more rates than before and after: branches may meet."""

    def __init__(self, closure: ClosureEquations) -> None:
        self._closure = closure

    def after(self, walk: Walk, step: Step) -> None:
        """Record it, with the number of other branches."""
        if walk.drop is not None:
            angles, drop = walk.drop
            walk.record("rank drop", angles, drop=drop, other_ways=other_ways(self._closure, angles))


class TurningPoint(Event):
    """A joint has an extreme angle: the walk lands there, `last`, and goes on.

    The sense is 1.0 or -1.0 as its angle grows or falls until the first such point; by default as the walk begins.
    """

    def __init__(self, joint: int, sense: float = 0.0) -> None:
        self._joint, self._sense = joint, sense
        self.last: Corrected | None = None
        self._next: Corrected | None = None

    def within(self, walk: Walk, step: Step) -> tuple[Step, str] | None:
        """Land on the turning point."""
        self._sense = self._sense or float(np.sign(step.leaving[self._joint]))
        self._next = None
        if not (self._sense * step.arriving[self._joint] < 0.0 and self._turns(step)):
            return None
        part = step.zero(lambda place: self._speed(place, step.leaving))
        top = None if part is None else step.at(part)
        if top is None or not top.closed:
            goal = walk.goal
            return None if goal is None else (step, goal.turns_back(step.after))
        if walk.ended and np.abs(top.angles - step.after.angles).max() <= _FLAT:
            return None  # where panels lie on each other joints turn back by themselves
        self._next = top
        return step.up_to(top), ""

    def after(self, walk: Walk, step: Step) -> None:
        """Record it, if the step was not cut shorter."""
        if step.after is not self._next:
            return
        self.last, self._sense = self._next, -self._sense
        walk.record("turning point", step.after.angles, joints=(self._joint,), frame=len(walk.frames))
        goal = walk.goal
        if goal is not None:
            goal.turned = True
            if not only_rates(step.after, step.leaving):
                how = "the way straight on leads" if walk.straight else "the least rates lead"
                several = f"there are several degrees of freedom, and {how} no farther"
                walk.ended = f"{goal.turns_back(step.after)}; {several}"

    def _turns(self, step: Step) -> bool:
        """Tell whether the joint turns back on a step, not only among the rates of a singular end."""
        if only_rates(step.after, step.leaving):
            return True
        return self._sense * self._speed(step.at(_SHORT_OF_END), step.leaving) < 0.0

    def _speed(self, place: Corrected, onwards: Floats) -> float:
        return float(place.space.projected(onwards)[self._joint])


class Return(Event):
    """A walk comes to a configuration float[J] again, whole turns aside, as it left it along a tangent.

    After `most` steps the walk ends.
    """

    ROUND = "it comes round"

    def __init__(self, angles: Floats, tangent: Floats, reason: str = ROUND, most: int | None = None) -> None:
        self._angles, self._tangent, self._reason, self._most = angles, tangent, reason, most
        self._steps = 0

    def within(self, walk: Walk, step: Step) -> tuple[Step, str] | None:
        """End there. The first step leads away."""
        self._steps += 1
        if self._steps == 1 or step.arriving @ self._tangent <= 0.0:
            return None
        home = step.passing(self._angles, DOUBLE.immobile)
        return None if home is None else (step.up_to(home), self._reason)

    def after(self, walk: Walk, step: Step) -> None:
        """Give up after too many steps."""
        if self._most is not None and self._steps > self._most and not walk.ended:
            walk.ended = f"{self._most} steps did not lead there"


_NUDGE = 1e-3
"""Rates for second differences, radians."""


def other_ways(closure: ClosureEquations, angles: Floats) -> int | None:
    """Return how many other motion branches pass through a singular configuration of a curve, to second order.

    Rates r of the kernel close to second order if w . H(r, r) = 0 for all self-stresses w: where the kernel is a
    plane, quadratic forms in two variables. If they are multiples of one, its two lines are two branches. Angles,
    float[J], are radians. None where the kernel is not a plane, second order does not decide, or joints are too many.
    """
    if closure.joints > MOST_WHOLE:
        return None
    parts = split(closure.dense(angles), DOUBLE.singular)
    kernel, stresses = parts.kernel.T, parts.cokernel.T
    if len(kernel) != 2:
        return None
    first, second, both = (_curved(closure, angles, rates) for rates in (*kernel, kernel.sum(axis=0)))
    forms = stresses @ np.stack([first, (both - first - second) / 2.0, second], axis=1)
    none = 10.0 * DOUBLE.singular  # second differences are good to the square of their step
    rows = row_space(forms, none, 1.0)
    if rows.shape[1] != 1:
        return None
    a, b, c = rows[:, 0]
    return 1 if b * b - a * c > none else None


def _curved(closure: ClosureEquations, angles: Floats, rates: Floats) -> Floats:
    """Return the second derivative of what does not close along rates: float[rows]."""
    ahead, here, back = (closure.evaluated(angles + step * rates)[0] for step in (_NUDGE, 0.0, -_NUDGE))
    return np.asarray((ahead - 2.0 * here + back) / _NUDGE**2)


_BLOCK, _MOST = 8, 512


def free_rates(closure: ClosureEquations, angles: Floats, moving: Ints | None = None) -> Floats | None:
    """Return a basis of the rates at a closed configuration, by random ones projected; None if they are too many.

    Nothing dense is made of the equations of large linkages. Angles, float[J], are in radians. `moving`, int[n],
    are the joints that move, of a branch on which others are immobile: these may have rates of their own there,
    which begin other branches; by default all. The columns are orthonormal, float[n, F].
    """
    spanning = _spanning(closure, angles, moving)
    return None if spanning is None else row_space(spanning, DOUBLE.singular, float(np.sqrt(spanning.shape[1])))


def number_of_free_rates(closure: ClosureEquations, angles: Floats, moving: Ints | None = None) -> int | None:
    """Return how many columns the basis of `free_rates` has, without making it."""
    spanning = _spanning(closure, angles, moving)
    return None if spanning is None else _rank(spanning @ spanning.T, spanning.shape[1])


def _rank(products: Floats, size: int) -> int:
    """Return the rank of random rates by their products, float[k, k].

    Projected random rates have singular values of their number's root, or none, and products the squares of these.
    """
    return rank_of(products, DOUBLE.singular**2, float(size))


def _spanning(closure: ClosureEquations, angles: Floats, moving: Ints | None) -> Floats | None:
    """Return rates, rows of float[k, n], that span all, more than these are."""
    jacobian = closure.at(angles)[1]
    space = TangentSpace(jacobian if moving is None else jacobian[:, moving])
    size = len(angles) if moving is None else len(moving)
    chance = np.random.default_rng(size)
    projected, products = np.zeros((0, size)), np.zeros((0, 0))
    while len(projected) < min(_MOST, size):
        more = np.array([space.projected(chance.normal(size=size)) for _ in range(_BLOCK)])
        between, own = projected @ more.T, more @ more.T
        products = np.block([[products, between], [between.T, own]])
        projected = np.concatenate([projected, more])
        if _rank(products, size) < len(projected):
            return projected
    return None


def independent_joints(basis: Floats, first: int) -> list[int]:
    """Return joints, one first, others far apart, whose rates in a basis float[n, F] determine all others."""
    chosen = []
    left = basis
    own = basis[first]
    if basis.size and np.linalg.norm(own) > DOUBLE.clear:
        chosen = [first]
        left = basis - np.outer(basis @ own, own) / (own @ own)
    return [*chosen, *pivots(left)]
