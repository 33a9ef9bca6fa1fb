"""Fold angles that keep their signs on a walk: of several freedoms rates are taken at which no crease turns over.

The rates nearest to those that a walk would take, among those at which loops stay closed, driven joints go on as
they do, and no crease that is nearly unfolded goes on to unfold: a least-distance problem with few inequalities,
solved as a non-negative least-squares problem (C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, 1974,
chapter 23). Its solution is unique, so that it does not hang on bases. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.optimize import nnls

from graphs.tolerances import DOUBLE, leading
from graphs.types import Flags, Floats
from synth.motion.newton import Corrected, TangentSpace
from synth.motion.walk.step import Step
from synth.motion.walk.walking import Steering, Walk

__all__ = ["KeptSigns"]

_KEPT, _FLOOR = 0.5, 1e-3
"""A step leaves at least this part of a fold angle, and none is unfolded below the second, radians."""
_SHORTEST = 0.01
"""Where no rates keep all signs for longer, radians of the joint that moves most, a crease turns over."""
_ROUNDS = 40


class KeptSigns(Steering):
    """Fold angles that do not change their signs as long as there is a motion on which they do not.

    Parameters
    ----------
    signs : float[J]
        1 and -1 for joints whose angles are to be positive and negative; 0 for others.
    """

    def __init__(self, signs: Floats) -> None:
        self._signs, self._kept = np.sign(signs), np.sign(signs)
        self._crossing: list[int] = []
        self.bound = []

    def admitted(self, walk: Walk, rates: Floats) -> tuple[Floats, float]:
        """Return rates near given ones at which no sign is lost on the next step, and how long that may be.

        Given rates, the largest 1 or -1, close to first order. Where no others keep all signs, though the step is
        short, creases are given up until some do: of a contradiction the one first that would turn over fastest.
        """
        here, length = walk.here, walk.length
        held = [] if walk.goal is None else walk.goal.drivers
        signs = self._kept = self._signs.copy()
        signs[held] = 0.0
        while True:
            found, bound = _nearest(here, rates, signs, held, length)
            if found is not None:
                self.bound = np.flatnonzero(bound).tolist()
                return found / np.abs(found).max(), length
            if length > _SHORTEST:
                length = max(length / 4.0, _SHORTEST)
                continue
            signs[leading(np.where(bound, np.minimum(signs * rates, -DOUBLE.zero_rate), 0.0))] = 0.0
            length = walk.length

    def lost(self, angles: Floats, length: float) -> bool:
        """Tell whether a sign is lost at the end of a step that might have kept it, were it shorter."""
        return length > _SHORTEST and bool((self._kept * angles < -DOUBLE.immobile).any())

    def within(self, walk: Walk, step: Step) -> tuple[Step, str] | None:
        """Note which joints change their signs on a step, without ending it."""
        before, after = (self._signs * end.angles for end in (step.before, step.after))
        self._crossing = np.flatnonzero((before >= 0.0) & (after < -DOUBLE.immobile)).tolist()
        return None

    def after(self, walk: Walk, step: Step) -> None:
        """Record the creases that turned over on a step."""
        for joint in self._crossing:
            part = step.zero(lambda place, joint=joint: float(place.angles[joint]))  # type: ignore[misc]
            walk.record("turns over", (step.after if part is None else step.at(part)).angles, joints=(joint,))
            self._signs[joint] = 0.0  # it has turned: from there on it is free


def _nearest(
    here: Corrected, rates: Floats, signs: Floats, held: Sequence[int], length: float
) -> tuple[Floats | None, Flags]:
    """Return the rates nearest to given ones at which signs are kept, or None and the joints that contradict.

    Joints `held` keep the rates they have. Inequalities are added as they are needed.
    """
    least, sized = _least_rates(here.angles, signs, length), DOUBLE.zero**0.5
    chosen, bound = rates, np.zeros(len(rates), dtype=bool)
    for _ in range(_ROUNDS):
        broken = (signs != 0.0) & ~bound & (signs * chosen < least - sized)
        if not broken.any():
            return chosen, bound
        bound |= broken
        places = np.flatnonzero(bound)
        moves = signs[places][:, None] * _moves(here.space, places.tolist(), held)
        change, contradiction = _least_change(moves, (least - signs * rates)[places])
        if change is None:
            blamed = np.zeros(len(rates), dtype=bool)
            blamed[places[contradiction]] = True
            return None, blamed
        chosen = rates + change
    return chosen, bound


def _least_rates(angles: Floats, signs: Floats, length: float) -> Floats:
    """Return the least rates, by their signs, at which enough of each fold angle is left after a step."""
    size = signs * angles
    spare = np.maximum(size - np.maximum(_KEPT * size, _FLOOR), 0.0)
    return np.asarray(np.where(size < 0.0, -np.inf, -spare / length))


def _moves(space: TangentSpace, places: Sequence[int], held: Sequence[int]) -> Floats:
    """Return the least rates that move each of some joints, across those that move held ones: float[n, J]."""
    moves = np.array([space.move(joint) for joint in places])
    if not held:
        return moves
    fixed = np.array([space.move(joint) for joint in held])
    gram = fixed[:, list(held)]
    return np.asarray(moves - np.linalg.lstsq(gram, moves[:, list(held)].T, rcond=DOUBLE.zero)[0].T @ fixed)


def _least_change(moves: Floats, wanted: Floats) -> tuple[Floats | None, Flags]:
    """Return the least x with ``moves @ x >= wanted``, or None; and of which inequalities a sum contradicts.

    The least-distance problem: of non-negative multiples of the rows [moves, wanted] the sum is taken that is
    nearest to the last unit vector. What is left of that is x, but for a factor; if nothing is, there is no x.
    """
    size = max(float(np.abs(wanted).max()), DOUBLE.zero)
    rows = np.concatenate([moves, wanted[:, None] / size], axis=1)
    target = np.eye(1, rows.shape[1], rows.shape[1] - 1)[0]
    shares, _ = nnls(rows.T, target, maxiter=50 * len(rows))
    left = rows.T @ shares - target
    if abs(left[-1]) <= DOUBLE.clear:
        return None, shares > 0.0
    return -left[:-1] / left[-1] * size, shares > 0.0
