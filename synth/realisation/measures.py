"""Angles and lengths of a drawn pattern, with their derivatives by the coordinates of the vertices.

Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

import numpy as np

from graphs.tolerances import DOUBLE
from graphs.types import Floats, Ints
from synth.realisation.pattern import Pattern

__all__ = ["corner_angles", "edge_lengths", "is_drawn", "opened_angles", "sums_at"]


def corner_angles(places: Floats, corners: Ints) -> tuple[Floats, Floats]:
    """Return the angle of each corner, in (-pi, pi], and its derivatives, float[K, 2 V].

    Corners, int64[K, 3], are vertices before, at and after, counter-clockwise. The angle is negative where the
    corner is turned over.
    """
    back, on = places[corners[:, 0]] - places[corners[:, 1]], places[corners[:, 2]] - places[corners[:, 1]]
    angles = np.arctan2(on[:, 0] * back[:, 1] - on[:, 1] * back[:, 0], (on * back).sum(axis=1))
    derivatives = np.zeros((len(corners), len(places), 2))
    rows = np.arange(len(corners))
    for vertex, arm, sign in ((0, back, 1.0), (2, on, -1.0)):
        by = sign * np.column_stack([-arm[:, 1], arm[:, 0]]) / (arm**2).sum(axis=1)[:, None]
        derivatives[rows, corners[:, vertex]] += by
        derivatives[rows, corners[:, 1]] -= by
    return angles, derivatives.reshape(len(corners), -1)


def edge_lengths(places: Floats, edges: Ints) -> tuple[Floats, Floats]:
    """Return the logarithm of the length of each edge, float[E], and its derivatives, float[E, 2 V].

    >>> edge_lengths(np.array([[0.0, 0], [1, 0]]), np.array([[0, 1]]))[0].tolist()
    [0.0]
    """
    along = places[edges[:, 1]] - places[edges[:, 0]]
    squares = (along**2).sum(axis=1)
    derivatives = np.zeros((len(edges), len(places), 2))
    rows = np.arange(len(edges))
    derivatives[rows, edges[:, 1]] = along / squares[:, None]
    derivatives[rows, edges[:, 0]] = -along / squares[:, None]
    return np.log(squares) / 2, derivatives.reshape(len(edges), -1)


def sums_at(pattern: Pattern, vertices: Ints) -> Floats:
    """Return float[n, K], which sums the corners at each of some vertices."""
    at: Floats = (pattern.corners[None, :, 1] == vertices[:, None]).astype(np.float64)
    return at


def is_drawn(pattern: Pattern, angles: Floats) -> bool:
    """Return whether panels are strictly convex where they can be, lie one way up, and go once round vertices.

    Those are the inner vertices; the angles of the corners are as `opened_angles` gives them.
    """
    if not (np.isfinite(angles).all() and angles.min() > 0.0 and (angles < pattern.widest).all()):
        return False
    sides = np.array([len(panel) for panel in pattern.panels])
    turns = np.bincount(pattern.panel_of_corner, angles, len(sides)) - np.pi * (sides - 2)
    inner = sums_at(pattern, pattern.inner) @ angles - 2 * np.pi
    return bool(np.abs([*turns, *inner]).max() < DOUBLE.same_configuration)


def opened_angles(pattern: Pattern, places: Floats) -> tuple[Floats, Floats]:
    """Return the angles of all corners, up to 360 degrees in panels that cannot be convex, and derivatives.

    Radians, negative where a corner is turned over; derivatives are float[K, 2 V].
    """
    angles, by = corner_angles(places, pattern.corners)
    return np.where((angles < 0.0) & (pattern.widest > np.pi), angles + 2 * np.pi, angles), by
