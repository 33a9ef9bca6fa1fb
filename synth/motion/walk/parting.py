"""How many ways part where the rank drops on a path, to second order.

Rates r of the kernel close to second order if w . H(r, r) = 0 for all self-stresses w. Where the kernel is a plane
these are quadratic forms in two variables; if they are multiples of one, its two lines are two ways. Theory:
docs/theory/folding.md.
"""

from __future__ import annotations

import numpy as np

from graphs.rank.singular_values import row_space, split
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.motion.closure import ClosureEquations

__all__ = ["other_ways"]

_NUDGE = 1e-3
"""Rates for second differences, radians."""


def other_ways(closure: ClosureEquations, angles: Floats) -> int | None:
    """Return how many ways there are at a singular pose of a curve besides that of the curve.

    None where the kernel is not a plane, or second order does not tell.

    Parameters
    ----------
    closure : ClosureEquations
    angles : float[J]
        The pose, radians.

    Examples
    --------
    A parallelogram in one line, where it may become an antiparallelogram:

    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.motion.linkage import linkage_of_axes
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3), "infinite")])
    >>> places = [0, 2, 3, 1]
    >>> flat = linkage_of_axes(four_bar, {joint: ((places[joint], 0, 0), (0, 0, 1)) for joint in range(4)})
    >>> other_ways(ClosureEquations(flat), flat.angles)
    1
    """
    parts = split(closure.at(angles)[1].toarray(), DOUBLE.singular)
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
    ahead, here, back = (closure.at(angles + step * rates)[0] for step in (_NUDGE, 0.0, -_NUDGE))
    return np.asarray((ahead - 2.0 * here + back) / _NUDGE**2)
