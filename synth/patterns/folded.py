"""A flat pattern folded so far as is asked. Theory: docs/theory/generators.md."""

from __future__ import annotations

from math import degrees

import numpy as np

from graphs.errors import UnsolvableError
from graphs.mechanism.sheet import Sheet
from synth.folding.beginning import Wanted, beginning
from synth.folding.motion import fold
from synth.folding.prepared import prepared

__all__ = ["folded"]

_LONGEST_STEP = np.radians(15.0)


def folded(sheet: Sheet, angle: float) -> Sheet:
    """Return a flat sheet folded on the way that its letters say, until the crease that moves most has an angle.

    Parameters
    ----------
    sheet : Sheet
    angle : float
        Radians.

    Raises
    ------
    UnsolvableError
        If it does not fold, or not so far.

    Examples
    --------
    >>> from synth.patterns.creases.tessellations import miura
    >>> folded(miura(2, 2, 1.0), 0.5)
    <Sheet: 4 faces, 4 creases, 9 vertices, folded>
    """
    pattern = prepared(sheet)
    marks = pattern.wanted
    number, rates = beginning(
        pattern.closure, pattern.linkage, pattern.branches, Wanted(None, marks, [], np.zeros(0))
    )
    driver = int(np.abs(rates).argmax())
    joint = list(pattern.linkage.graph.joints)[driver]
    goal = float(np.sign(rates[driver])) * angle
    found = fold(sheet, drive={joint: goal}, branch=number, frames=int(np.ceil(angle / _LONGEST_STEP)))
    if found.path.stopped:
        raise UnsolvableError(f"it does not fold to {degrees(angle):g} degrees: {found.path.stopped}")
    return found.frames()[-1]
