"""Kaleidocycles: rings of solids with right twists and equal lengths. Theory: docs/theory/generators.md.

Source: P. Schatz (1929); D. Schattschneider and W. Walker, "M. C. Escher Kaleidocycles" (1977).
"""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np

from graphs.arrays import Floats
from graphs.errors import InvariantError, UnsolvableError
from graphs.mechanism.solids import HingedSolids
from synth.patterns.rings.axes import chain_frames, lines_of, ring, ring_of_sides
from synth.patterns.rings.bricard import around

__all__ = ["kaleidocycle"]

_CLOSED = 1e-12
_TRIES = 100
_STEPS = 4
_NUDGE = 1e-6


def kaleidocycle(solids: int, tilt: float = 0.9) -> HingedSolids:
    """Return a ring of solids with right twists and lengths 1.

    An even number is turned inside out so far as is said, alike all round; an odd number is closed numerically.

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
        return _closed_ring(solids)
    half = solids // 2
    azimuths = np.arange(half) * 2 * pi / half
    corners = [np.array((sin(tilt) * cos(t), sin(tilt) * sin(t), cos(tilt))) for t in azimuths]
    return ring_of_sides(around(*corners), np.tile([1.0, -1.0], half))


def _closed_ring(solids: int) -> HingedSolids:
    """Return a ring of solids with right twists and lengths 1, by random angles from which it closes."""
    from scipy.optimize import least_squares  # takes half a second to load

    random = np.random.default_rng(solids)
    for _ in range(_TRIES):
        angles: Floats = least_squares(_off_closing, random.uniform(-pi, pi, solids)).x
        for _ in range(_STEPS):  # Newton's, to the last digits
            nudges = _NUDGE * np.eye(solids)
            slopes = [(_off_closing(angles + d) - _off_closing(angles - d)) / (2 * _NUDGE) for d in nudges]
            angles = angles - np.linalg.lstsq(np.array(slopes).T, _off_closing(angles), rcond=1e-7)[0]
        if np.abs(_off_closing(angles)).max() < _CLOSED:
            return ring(lines_of(_frames(angles)))
    raise UnsolvableError(f"no closed ring of {solids} solids was found from {_TRIES} random starts")


def _frames(angles: Floats) -> Floats:
    solids = len(angles)
    return chain_frames([1.0] * solids, [pi / 2] * solids, angles.tolist())


def _off_closing(angles: Floats) -> Floats:
    """Return by how much the end of a chain of solids with right twists and lengths 1 is not its beginning.

    All of the rotation: what is not symmetric of it alone would take half a turn for none.
    """
    off: Floats = (_frames(angles)[-1] - np.eye(4))[:3].ravel()
    return off
