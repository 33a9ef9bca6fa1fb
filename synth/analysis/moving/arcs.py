"""How far arcs of a surface lie outside it after a motion: heights p cos t + q sin t over an arc of azimuths.

Theory: docs/theory/moving.md.
"""

from math import cos, inf, sin, tau

import numpy as np

from graphs.tolerances import DOUBLE
from graphs.types import Floats


def heights_over(p: Floats, q: Floats, begin: float, length: float) -> tuple[Floats, Floats]:
    """Return the least and greatest p cos t + q sin t over an arc."""
    size, top = np.hypot(p, q), np.arctan2(q, p)
    ends = p * cos(begin) + q * sin(begin), p * cos(begin + length) + q * sin(begin + length)
    high = np.where(np.remainder(top - begin, tau) < length, size, np.maximum(*ends))
    low = np.where(np.remainder(top + np.pi - begin, tau) < length, -size, np.minimum(*ends))
    return low, high


def heights_about(pivot: float, p: Floats, q: Floats, begin: float, length: float) -> tuple[Floats, Floats]:
    """Return the least and greatest height of an arc that turns about its own point at `pivot`, where it has none.

    There p cos t + q sin t + c is zero, so that it is 2 sin u (q cos(pivot + u) - p sin(pivot + u)) at t = pivot +
    2 u: the height in proportion to the chord 2 sin u from the pivot is an arc of its own, half as long. It changes
    its sign with the direction of the link; the height itself, where the link lies along the surface beyond its
    pivot, only touches zero, and a change would be seen too late by the root of the rounding.
    """
    before = float(np.remainder(pivot - begin, tau))
    before = 0.0 if tau - before < DOUBLE.same_configuration else min(before, length)
    low, high = np.full(p.shape, inf), np.full(p.shape, -inf)
    for side, part in ((1.0, length - before), (-1.0, before)):  # the chord is negative before the pivot
        if part > DOUBLE.same_configuration:
            start = pivot if side > 0 else pivot - part / 2
            ends = heights_over(side * q, -side * p, start, part / 2)
            low, high = np.minimum(low, ends[0]), np.maximum(high, ends[1])
    return low, high
