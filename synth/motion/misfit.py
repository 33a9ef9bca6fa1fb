"""How nearly what is rigid moves: by how much its loops stay open when it is turned all the same.

Theory: docs/theory/mending.md.
"""

from __future__ import annotations

from math import degrees, radians

import numpy as np

from graphs.arrays import Floats
from graphs.canonical import leading
from graphs.mechanism.precision import Precision
from graphs.tolerances import DOUBLE
from synth.motion.closure import ClosureEquations
from synth.motion.newton import TangentSpace

__all__ = ["EXACT", "TURNED", "doubt_of", "least_misfit"]

EXACT = DOUBLE.closed
"""Coordinates that are precise to this part of the extent are taken at their word: loops of them close."""

TURNED = radians(10.0)
"""How far the joint that moves most is turned."""
_ROUNDS = 60
_START, _LEAST, _MOST = 1e-6, 1e-13, 1.0
"""Regularisation of a step: at first, and between which bounds."""
_SLOW = 1e-3
_IDLE = 6
"""After so many steps in turn that take less than this part of the sum of squares away it ends: a valley may be
narrow at first, and how narrow rounding decides."""


def least_misfit(closure: ClosureEquations, start: Floats, rates: Floats) -> float:
    """Return by how much loops do not close, at most, at a pose where they do so least.

    One joint is held, turned by ten degrees; the others are moved to where the sum of squares of what does not
    close is least (Levenberg, Marquardt). The joint that the rates move most is held. In radians and units of the
    extent.

    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.motion.linkage import linkage_of_sheet
    >>> corners = ((0, 0), (1, 0), (-.5, .9), (-.5, -.9))
    >>> linkage = linkage_of_sheet(Sheet(4, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 1)), corners))
    >>> round(least_misfit(ClosureEquations(linkage), linkage.angles, np.array([1.0, 0.5, 0.5])), 2)
    0.01
    """
    driver = leading(rates)
    free = np.ones(closure.joints)
    free[driver] = 0.0
    angles = start + TURNED / abs(float(rates[driver])) * rates
    residual, jacobian = closure.at(angles)
    regular, idle = _START, 0
    for _ in range(_ROUNDS):
        jacobian.data *= free[jacobian.indices]
        tried = angles + TangentSpace(jacobian, regular).step(residual)
        after, slopes = closure.at(tried)
        gain = float(residual @ residual - after @ after)
        if gain > 0.0:
            idle = 0 if gain > _SLOW * float(residual @ residual) else idle + 1
            angles, residual, jacobian, regular = tried, after, slopes, max(regular / 10.0, _LEAST)
            if idle == _IDLE:
                break
        elif regular >= _MOST:
            break
        else:
            regular *= 10.0
    return float(np.abs(residual).max(initial=0.0))


def doubt_of(precision: Precision, misfit: float | None = None) -> str:
    """Return what rounded coordinates leave open where nothing moves; empty if they are exact.

    The misfit says by how much loops stay open when a joint is turned all the same.
    """
    if precision.size <= EXACT:
        return ""
    told = f"{precision.size:.0e} of the extent ({precision.source})"
    near = (
        ""
        if misfit is None
        else f"; turned by {degrees(TURNED):g} degrees its loops close to {misfit:.0e} at best"
    )
    return f", with the coordinates as they are written{near}; they are precise to {told}, and exact ones may move"
