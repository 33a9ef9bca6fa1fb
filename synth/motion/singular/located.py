"""A configuration that is singular all along its branch, located to all digits.

Along a flex that does not close to second order, loops closed to 1e-12 leave open the root of that: Newton's
method ends anywhere within 1e-6 of the branch, and singular values that are zero on it are as large there. So the
end of a path is taken across its flexes to where these are zero, before its rank is.
Theory: docs/theory/folding.md.
"""

from __future__ import annotations

import numpy as np

from graphs.rank.singular_values import Split, singular_values, split
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.motion.closure import ClosureEquations
from synth.motion.newton import corrected

__all__ = ["located"]

_STEPS = 6
_NUDGE = 1e-4
"""Radians, of the differences by which derivatives change along a flex."""


def located(closure: ClosureEquations, angles: Floats) -> Floats:
    """Return the closed configuration beside a given one at which singular values that are nearly zero are zero.

    The given one, joint angles float[J] in radians, is closed to `Tolerances.closed`; singular values up to
    `Tolerances.singular` are looked at. It is returned where there are none but zeros, or they do not vanish near
    it: then they are none.

    Examples
    --------
    Two bars in line between fixed points, 2 apart, as a triangle of no height: its flex is wrong by 1e-6.

    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.motion.linkage import linkage_of_axes
    >>> three = SCGraph(3, [(0, 1), (1, 2), (2, 0)], [Loop((0, 1, 2), "infinite")])
    >>> line = linkage_of_axes(three, {joint: ((joint, 0, 0), (0, 0, 1)) for joint in range(3)})
    >>> closure = ClosureEquations(line)
    >>> beside = 1e-7 * np.array([1.0, -2.0, 1.0])
    >>> float(abs(located(closure, beside)).max()) < 1e-12
    True
    """
    matrix = closure.at(angles)[1].toarray()
    if not _nearly(singular_values(matrix)):
        return angles
    here, parts = angles, split(matrix, DOUBLE.singular)
    size = parts.right.shape[0] - parts.rank
    for _ in range(_STEPS):
        here = corrected(closure, here + _across(closure, here, parts)).angles
        if np.abs(here - angles).max() > DOUBLE.moved:
            return angles
        parts = split(closure.at(here)[1].toarray(), DOUBLE.singular)
        if parts.right.shape[0] - parts.rank != size:
            return angles
        if not _nearly(parts.values):
            return here if closure.error(here) <= DOUBLE.closed else angles
    return angles


def _nearly(values: Floats) -> int:
    """Return how many singular values are small, and not zero."""
    largest = values.max(initial=0.0)
    return int(((values > DOUBLE.zero * largest) & (values <= DOUBLE.singular * largest)).sum())


def _across(closure: ClosureEquations, angles: Floats, parts: Split) -> Floats:
    """Return the least change along flexes at which none of them parts loops to first order: float[J].

    Between flexes and self-stresses the derivatives J are a small matrix, S' J F; along each flex it changes at a
    rate, and the changes that make it zero are a system of linear equations.
    """
    flexes, stresses = parts.right[parts.rank :], parts.left[:, parts.rank :]

    def between(at: Floats) -> Floats:
        return np.asarray(stresses.T @ (closure.at(at)[1] @ flexes.T))

    slopes = [
        ((between(angles + _NUDGE * flex) - between(angles - _NUDGE * flex)) / (2.0 * _NUDGE)).ravel()
        for flex in flexes
    ]
    shares = np.linalg.lstsq(np.array(slopes).T, -between(angles).ravel(), rcond=DOUBLE.zero**0.5)[0]
    return np.asarray(shares @ flexes)
