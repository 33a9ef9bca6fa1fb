"""Kaleidocycles: rings of solids with right twists and equal lengths. Theory: docs/theory/generators.md.

Source: P. Schatz (1929); D. Schattschneider and W. Walker, "M. C. Escher Kaleidocycles" (1977).
"""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np

from graphs.errors import InvariantError
from graphs.mechanism.solids import HingedSolids
from synth.patterns.rings.axes import lines_of, ring, ring_of_sides
from synth.patterns.rings.bricard import around
from synth.patterns.rings.closing import closed_chain

__all__ = ["kaleidocycle"]

_DIGITS = 9
"""Of a ring that is closed numerically: it moves with any proportions, and these are the same on every machine."""


def kaleidocycle(solids: int, tilt: float = 0.9) -> HingedSolids:
    """Return a ring of solids with right twists and lengths 1.

    An even number is turned inside out so far as is said, alike all round; an odd number is closed numerically, as
    flat as it can be: the sum of the cosines of its angles is the largest.

    Parameters
    ----------
    solids : int
        Six or more.
    tilt : float, optional
        Angle between every second axis and the axis of the ring, radians; of an even number only.

    Raises
    ------
    InvariantError
        If there are less than six solids.
    UnsolvableError
        If an odd number was not closed.

    Examples
    --------
    >>> kaleidocycle(8)
    <HingedSolids: <SCGraph: 8 links, 8 joints, 0 centres>>
    """
    if solids < 6:
        raise InvariantError("kaleidocycle", f"{solids} solids", "six or more: fewer with right twists are rigid")
    if solids % 2:
        return ring(lines_of(closed_chain(solids)), _DIGITS)
    half = solids // 2
    azimuths = np.arange(half) * 2 * pi / half
    corners = [np.array((sin(tilt) * cos(t), sin(tilt) * sin(t), cos(tilt))) for t in azimuths]
    return ring_of_sides(around(*corners), np.tile([1.0, -1.0], half))
