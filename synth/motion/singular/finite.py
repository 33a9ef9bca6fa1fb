"""Motions of a flat sheet found from folded states: Newton's method from angles along the assignment, then back.

At the flat state the loops say of the signs of rates only what second order does, and Newton's method there comes
to rest where branches meet. At fold angles of some tenths of a radian most configurations are regular: it needs
few steps. What it finds belongs to a motion from flat only if it can be followed back there. Theory:
docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import pi

import numpy as np

from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.motion.closure import ClosureEquations
from synth.motion.newton import TangentSpace, corrected
from synth.motion.walk.step import STRAY

__all__ = ["FoldedStart", "folded_start"]

_SCALES, _WEIGHTS = (0.4, 0.2, 0.6), (1.0, 0.7, 1.4)
"""Fold angles of valleys at the starts, radians, and those of mountains as multiples of these: where both are
alike, a symmetric start may lead back to the flat state."""
_FEW = 600
"""Of more joints all start alike."""
_FINITE = 0.05
"""Configurations with smaller angles only, radians, are the flat state but for what Newton's method left."""
_STEPS, _PATIENCE = 30, 4
"""Steps from one start, and so many in turn that do not make the residual less."""
_BACK, _LEAST_BACK = 0.6, 0.98
"""Angles after a step back as part of those before, and where no such step is possible."""
_SMALL = 0.02
"""The way back ends where the largest angle is smaller, radians: loops there close to fourth order by rates."""


@dataclass(frozen=True, slots=True)
class FoldedStart:
    """A motion that was found at a folded state and followed back towards the flat one.

    Attributes
    ----------
    rates : float[J]
        Fold angles at the end of the way back, the largest 1 or -1.
    agree : int
        How many joints turn as is wanted there.
    found_at, back_to : float
        Largest fold angles where it was found, and where the way back ends, radians.
    """

    rates: Floats
    agree: int
    found_at: float
    back_to: float


def folded_start(closure: ClosureEquations, wanted: Floats) -> FoldedStart | None:
    """Return a motion from the flat state on which most joints turn as is wanted; None where none was found.

    Wanted are signs, float[J], 0 where there is none; the search ends at the first motion that has them all. The
    linkage is flat where its angles are zero.
    """
    best = None
    goal = int(np.count_nonzero(wanted))
    for start in _starts(wanted):
        angles = _closed(closure, start)
        if angles is None or (best is not None and _agree(angles, wanted) <= best.agree):
            continue
        back = _followed_back(closure, angles)
        if back is None:
            continue
        small, largest = back, float(np.abs(back).max())
        found = FoldedStart(small / largest, _agree(small, wanted), float(np.abs(angles).max()), largest)
        if best is None or found.agree > best.agree:
            best = found
        if best.agree == goal:
            break
    return best


def _starts(wanted: Floats) -> Iterator[Floats]:
    """Yield fold angles along the signs that are wanted, radians."""
    signs = np.sign(wanted)
    for weight in _WEIGHTS if len(wanted) <= _FEW and (signs > 0).any() and (signs < 0).any() else _WEIGHTS[:1]:
        for scale in _SCALES:
            yield scale * np.where(signs < 0.0, weight, 1.0) * signs


def _agree(angles: Floats, wanted: Floats) -> int:
    """Return how many joints are turned as is wanted."""
    return int((angles * wanted > DOUBLE.zero_rate * np.abs(angles).max(initial=0.0)).sum())


def _closed(closure: ClosureEquations, start: Floats) -> Floats | None:
    """Return a closed folded configuration near given angles, by Newton's method with all its derivatives.

    It ends where the residual does not fall any more, or a joint has turned once round.
    """
    angles, least, idle = start, np.inf, 0
    for _ in range(_STEPS):
        residual, jacobian = closure.at(angles)
        error = float(np.abs(residual).max(initial=0.0))
        if error <= DOUBLE.closed:
            largest = float(np.abs(angles).max(initial=0.0))
            return angles if _FINITE <= largest <= pi else None
        idle = 0 if error < least else idle + 1
        least = min(error, least)
        if idle == _PATIENCE or np.abs(angles).max() > 2.0 * pi:
            return None
        angles = angles + TangentSpace(jacobian).step(residual)
    return None


def _followed_back(closure: ClosureEquations, angles: Floats) -> Floats | None:
    """Return the small angles at the end of the way back to the flat state; None where it does not lead there.

    All angles are made less in proportion, and corrected; a step is taken smaller where the correction is more
    than a part of it, or a joint turns over.
    """
    part = _BACK
    while float(np.abs(angles).max()) > _SMALL:
        end = corrected(closure, part * angles)
        largest = float(np.abs(angles).max())
        stray = float(np.abs(end.angles - part * angles).max())
        if not end.closed or stray > STRAY * (1.0 - part) * largest or _turned_over(angles, end.angles):
            part = 1.0 - (1.0 - part) / 2.0
            if part > _LEAST_BACK:
                return None
            continue
        angles = end.angles
    return angles


def _turned_over(before: Floats, after: Floats) -> bool:
    """Tell whether the sign of a joint's angle is another after a step."""
    return bool((before * after < -(DOUBLE.zero_rate**2) * float(before @ before)).any())
