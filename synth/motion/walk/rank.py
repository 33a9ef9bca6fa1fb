"""Where along a path the rank of the closure equations drops.

The least singular value across the freedoms is followed by one step of inverse iteration a pose, so that its
vector goes on from pose to pose; with a sign, kept by the continuity of its image, it passes through zero where
the rank drops. Such steps, and those where it dips, are looked into: a pose is named only where singular values
are found to be zero. Of two values near each other the vector may go over from one to the other, and a drop with
it be missed.
Theory: docs/theory/folding.md.
"""

from __future__ import annotations

import numpy as np
import scipy.linalg
from scipy.optimize import minimize_scalar

from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.motion.closure import ClosureEquations
from synth.motion.newton import TangentSpace
from synth.motion.walk.step import Step

__all__ = ["WATCHED", "RankWatch"]

WATCHED = 400
"""Linkages of more joints are not watched: to look into a step all their singular values are needed."""
_DIP = 0.1
"""Part of a squared singular value that is left at the bottom of a dip worth looking into."""
_AROUND = 0.05
"""Half of the part of a step that is looked into a second time."""
_ROUGH, _EXACT = 1e-3, 1e-7
_FAR = 0.05
"""A singular value that stays above this on the cubic of a step is not zero beside it."""
_MOST_LOOKS = 12
"""Steps of one path that are looked into at most."""


class RankWatch:
    """The least singular value across the freedoms, from pose to pose.

    Parameters
    ----------
    closure : ClosureEquations

    Attributes
    ----------
    singular : bool
        Whether the rank is less at the last pose, or hardly more.
    """

    def __init__(self, closure: ClosureEquations) -> None:
        self._closure = closure
        start = np.random.default_rng(closure.joints).normal(size=closure.joints)
        self._across, self._image = start / np.linalg.norm(start), np.zeros(closure.rows)
        self._values: list[float] = []
        self._steps: list[Step] = []
        self._looks = 0
        self.singular = False

    def dropped(self, step: Step, *, flat: bool = False) -> tuple[Floats, int] | None:
        """Go on by one step; return joint angles on it or the last one where the rank drops, and by how much.

        Where panels lie flat on each other, at its end, the rank is always looked at.
        """
        value = self._followed(step)
        self.singular = abs(value) <= 10.0 * DOUBLE.singular
        self._values, self._steps = [*self._values, value][-3:], [*self._steps, step][-2:]
        if self._looks >= _MOST_LOOKS:
            return None
        found = None
        if flat or abs(value) <= DOUBLE.singular:
            found = self._deficient(step.after.angles, step)
        elif len(self._values) > 1 and self._values[-2] * value < 0.0:
            found = self._examined(step)
        elif self._dips():
            found = self._examined(self._steps[0]) or self._examined(step)
        else:
            return None
        self.singular |= found is not None and found[0] is step.after.angles
        self._values = [] if self.singular else [value]
        return found

    def _followed(self, step: Step) -> float:
        """Return the least singular value at the end of a step, with the sign that continuity gives it."""
        space = step.after.space
        if not self._steps:
            self._across = _across_freedoms(space, self._across)
        across = space.sharpened(self._across)
        across = across if across @ self._across >= 0.0 else -across
        image = space.image(across)
        before = self._values[-1] if self._values else 1.0
        sign = np.sign(before) if image @ self._image >= 0.0 else -np.sign(before)
        self._across, self._image = across, image
        return float(sign * np.linalg.norm(image))

    def _dips(self) -> bool:
        """Tell whether a parabola through the last squares has a bottom near zero in the last two steps."""
        if len(self._values) < 3:
            return False
        first, second = (float(np.linalg.norm(one.after.angles - one.before.angles)) for one in self._steps)
        if not (first and second):  # a step of no length: nothing was passed
            return False
        squares = np.square(self._values)
        slopes = np.diff(squares) / (first, second)
        bend = (slopes[1] - slopes[0]) / (first + second)
        if not bend > 0.0:
            return False
        slope = slopes[0] + bend * first
        bottom = -slope / (2.0 * bend)
        return bool(-first < bottom < second and squares[1] - bend * bottom**2 <= _DIP * squares[1])

    def _examined(self, step: Step) -> tuple[Floats, int] | None:
        """Look for a configuration on a step at which singular values are zero."""
        self._looks += 1
        freedoms = self._zeros(step.before.angles)
        part, square = self._least(step, freedoms, _ROUGH)
        if square > _FAR**2:
            return None
        narrow = step.piece(max(part - _AROUND, 0.0), min(part + _AROUND, 1.0))
        return self._deficient(narrow.expected(self._least(narrow, freedoms, _EXACT)[0]), step)

    def _least(self, step: Step, freedoms: int, exact: float) -> tuple[float, float]:
        """Return the part of a step at which the least singular value across the freedoms is least; its square."""

        def square(part: float) -> float:
            return float(self._squares(step.expected(part))[freedoms])

        least = minimize_scalar(square, bounds=(0.0, 1.0), method="bounded", options={"xatol": exact})
        return float(least.x), float(least.fun)

    def _deficient(self, angles: Floats, step: Step) -> tuple[Floats, int] | None:
        drop = self._zeros(angles) - self._zeros(step.before.angles)
        return (angles, drop) if drop > 0 else None

    def _zeros(self, angles: Floats) -> int:
        return int((self._squares(angles) <= DOUBLE.singular**2).sum())

    def _squares(self, angles: Floats) -> Floats:
        """Return the squares of the singular values, of all joints, the least first: float[J]."""
        jacobian = self._closure.at(angles)[1]
        return np.asarray(scipy.linalg.eigvalsh((jacobian.T @ jacobian).toarray()))


def _across_freedoms(space: TangentSpace, start: Floats) -> Floats:
    """Return the part of a unit vector across the freedoms, to begin with: a unit vector float[J].

    Where most rates are freedoms, most of a random vector is one, and what is followed from there would be taken
    for a singular value of zero. Where all are, the vector itself.
    """
    across = start - space.projected(start)
    size = float(np.linalg.norm(across))
    return across / size if size > DOUBLE.clear else start
