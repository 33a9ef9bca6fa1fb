"""Rings of solids with right twists and equal lengths, closed numerically: of all that close the flattest.

An odd number of solids has no symmetry that gives its angles. The closed rings are a curve (seven solids) or more;
of them the one is taken whose angles have the largest sum of cosines, and of the ways to number it, from either
end and seen from either side, the first in order. It does not depend on where the search begins.
Theory: docs/theory/generators.md.
"""

from __future__ import annotations

from math import pi

import numpy as np

from graphs.errors import UnsolvableError
from graphs.tolerances import DOUBLE, canonical_order
from graphs.types import Floats
from synth.patterns.rings.axes import chain_frames

__all__ = ["closed_chain"]

_STARTS, _TRIES = 3, 100
"""Rings that are compared, and starts at most: from most starts, often from all, the same ring is found."""
_STEPS = 8
_NUDGE = 1e-6


def closed_chain(solids: int) -> Floats:
    """Return the frames, as in `chain_frames`, of a closed ring with right twists and lengths 1.

    It has seven or more solids. Raise UnsolvableError if none was found.
    """
    rings: list[Floats] = []
    for start in range(_TRIES):
        angles = _flattest(np.random.default_rng((solids, start)).uniform(-pi, pi, solids))
        if np.abs(_off_closing(angles)).max() < DOUBLE.closed:
            rings += _numbered(angles)
        if len(rings) >= _STARTS * 4 * solids:
            break
    if not rings:
        raise UnsolvableError(f"no closed ring of {solids} solids was found from {_TRIES} random starts")
    keys = [np.concatenate([[-np.cos(one).sum()], -np.cos(one), -np.sin(one)]) for one in rings]
    return _frames(rings[canonical_order(keys)[0]])


def _flattest(start: Floats) -> Floats:
    """Return angles near to some with which the ring closes and is as flat as it can be, to the last digits."""
    from scipy.optimize import least_squares, minimize  # takes half a second to load

    closed: Floats = least_squares(_off_closing, start).x
    closing = {"type": "eq", "fun": _off, "jac": _screws}
    near: Floats = minimize(
        lambda angles: -np.cos(angles).sum(),
        closed,
        jac=np.sin,
        constraints=closing,
        method="SLSQP",
        options={"maxiter": 500},
    ).x
    forces = np.linalg.lstsq(_screws(near).T, -np.sin(near), rcond=None)[0]
    state = np.concatenate([near, forces])
    for _ in range(_STEPS):  # Newton's, on the conditions of Lagrange
        nudges = _NUDGE * np.eye(len(state))
        slopes = [(_off_flattest(state + d) - _off_flattest(state - d)) / (2 * _NUDGE) for d in nudges]
        state = state - np.linalg.lstsq(np.array(slopes).T, _off_flattest(state), rcond=1e-9)[0]
    return state[: len(start)]


def _numbered(angles: Floats) -> list[Floats]:
    """Return the angles of a ring as it may be numbered: from each solid, either way round, from either side."""
    both = [angles, angles[::-1]]
    return [sign * np.roll(one, shift) for one in both for shift in range(len(angles)) for sign in (1.0, -1.0)]


def _off_flattest(state: Floats) -> Floats:
    """Return by how much the conditions of Lagrange are missed, of angles and a multiplier for each equation."""
    angles, forces = state[:-6], state[-6:]
    return np.concatenate([_off(angles), np.sin(angles) + _screws(angles).T @ forces])


def _screws(angles: Floats) -> Floats:
    """Return the motion of the end of the chain by each angle, float[6, n]: of its origin, then its turn."""
    frames = _frames(angles)
    ends, along = frames[-1][:3, 3], frames[:-1, :3, 2]
    return np.hstack([np.cross(along, ends - frames[:-1, :3, 3]), along]).T


def _off(angles: Floats) -> Floats:
    """Return where the end of the chain is, and its small turn: float[6], 0 where it closes."""
    end = _frames(angles)[-1]
    turn = end[:3, :3] - end[:3, :3].T
    return np.array([*end[:3, 3], turn[2, 1] / 2, turn[0, 2] / 2, turn[1, 0] / 2])


def _frames(angles: Floats) -> Floats:
    solids = len(angles)
    return chain_frames([1.0] * solids, [pi / 2] * solids, angles.tolist())


def _off_closing(angles: Floats) -> Floats:
    """Return by how much the end of a chain of solids with right twists and lengths 1 is not its beginning.

    All of the rotation: what is not symmetric of it alone would take half a turn for none.
    """
    off: Floats = (_frames(angles)[-1] - np.eye(4))[:3].ravel()
    return off
