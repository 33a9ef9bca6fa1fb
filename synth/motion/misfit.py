"""What rounded coordinates leave open where nothing moves, in words.

Theory: docs/theory/mending.md.
"""

from __future__ import annotations

from math import ceil, floor, log10

from graphs.mechanism.precision import Precision
from graphs.tolerances import DOUBLE, EPSILON

__all__ = ["EXACT", "at_most", "doubt_of", "doubt_of_rigid", "size_of"]

EXACT = DOUBLE.closed
"""Coordinates that are precise to this part of the extent are taken at their word: loops of them close."""


def doubt_of(precision: Precision) -> str:
    """Return what rounded coordinates leave open where a motion is not found or ends; empty if they are exact."""
    if precision.size <= EXACT:
        return ""
    precise = f"they are precise to {size_of(precision)}"
    return f", with the coordinates as written; {precise}, and exact coordinates may allow motion"


def size_of(precision: Precision) -> str:
    """Return how precise coordinates are, with the source.

    >>> size_of(Precision(5e-5, "4 decimals"))
    '5e-05 of the extent (4 decimals)'
    """
    return str(precision)


def doubt_of_rigid(
    precision: Precision, misfit: float | None, unsettled: bool = False, too_large: str = ""
) -> str:
    """Return how near what does not move is to what does, after "rigid"; empty where that is all.

    The misfit is the largest displacement of a vertex, in units of the extent, in the nearest pattern that moves,
    or None if none was found; unsettled is what may move within the precision. `too_large` says why none was
    looked for.

    >>> doubt_of_rigid(Precision(0.0, "exact"), 2.03e-3)
    '; the nearest rigid-foldable pattern has vertices moved by up to 3e-03 of the extent'
    """
    exact = precision.size <= EXACT
    within = "" if exact else f" within the drawing's precision, {size_of(precision)}"
    if misfit is None:
        nearly = "; some branches nearly exist, and whether any does there is unknown" if unsettled else ""
        unsought = f"; the nearest rigid-foldable pattern was not searched for: {too_large}" if too_large else ""
        return within + (nearly or unsought)
    times = "" if exact else f", {misfit / precision.size:.0f} times the precision"
    moved = f"vertices moved by up to {at_most(misfit)} of the extent{times}"
    return f"{within}; the nearest rigid-foldable pattern has {moved}"


def at_most(number: float) -> str:
    """Return a positive number to one digit, rounded up.

    >>> at_most(2.03e-3), at_most(3e-6)
    ('3e-03', '3e-06')
    """
    unit = 10.0 ** floor(log10(number))
    return f"{ceil(number / unit * (1.0 - 4.0 * EPSILON)) * unit:.0e}"
