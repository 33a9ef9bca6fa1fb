"""Creases that point to a centre across a hole: how far they are off it.

A finite centre is a point, an infinite one a direction; both are unknowns beside the vertices.
Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

import numpy as np

from graphs.geometry import common_direction, unit
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.realisation.pattern import Pattern, Pointing

__all__ = ["first_unknowns", "off_centres"]

_LEFT, _RIGHT = np.array([-1.0, 1.0]), np.array([1.0, -1.0])
"""Signs of (y, x), by which a vector (x, y) is turned to the left, to the right."""


def first_unknowns(pattern: Pattern, places: Floats, in_holes: Floats, in_panels: Floats) -> Floats:
    """Return the unknowns of a drawing: vertices, a point for each centre that is no vertex, hubs of bent panels.

    The point of an infinite centre is its direction, of length 1. Points in holes are float[H, 2]; hubs of panels,
    float[B, 2], are those of `barycentric_start`. Returns float[V + C + B, 2].
    """
    free = [one for one in pattern.pointings if one.vertex is None]
    points = [
        _common_direction(pattern, places, one) if one.infinite else in_holes[list(one.holes)].mean(axis=0)
        for one in free
    ]
    return np.concatenate([places, np.array(points).reshape(-1, 2), in_panels])


def off_centres(pattern: Pattern, unknowns: Floats) -> tuple[Floats, Floats]:
    """Return the sine of the angle by which each crease misses its centre, and the derivatives.

    Lengths are taken as constant in the derivatives, which are exact where nothing is off. A value for each row of
    ``Pattern.aims``, then by how much the direction of each infinite centre is longer than 1: float[A + D], with
    derivatives float[A + D, 2 (V + C + B)].
    """
    a, b, centre, infinite = pattern.aims.T
    along = unknowns[b] - unknowns[a]
    reach = (1 - infinite)[:, None] / 2
    to = unknowns[centre] - reach * (unknowns[a] + unknowns[b])
    sizes = np.sqrt((along**2).sum(axis=1) * (to**2).sum(axis=1))
    scale = np.maximum(sizes, DOUBLE.same_point)  # in the middle of a crease a centre has no direction from there
    by_along, by_to = to[:, ::-1] * _RIGHT / scale[:, None], along[:, ::-1] * _LEFT / scale[:, None]
    half = reach * by_to
    rows, directions = np.arange(len(pattern.aims)), pattern.directions
    derivatives = np.zeros((len(rows) + len(directions), *unknowns.shape))
    derivatives[rows, b] = by_along - half
    derivatives[rows, a] = -by_along - half
    derivatives[rows, centre] += by_to
    derivatives[len(rows) + np.arange(len(directions)), directions] = unknowns[directions]
    off = (along[:, 0] * to[:, 1] - along[:, 1] * to[:, 0]) / scale
    longer = ((unknowns[directions] ** 2).sum(axis=1) - 1.0) / 2
    return np.concatenate([off, longer]), derivatives.reshape(len(derivatives), unknowns.size)


def _common_direction(pattern: Pattern, places: Floats, one: Pointing) -> Floats:
    """Return the direction that creases have in the mean, whichever way they run."""
    ends = places[[pattern.creases[crease] for crease in one.creases]]
    along = ends[:, 1] - ends[:, 0]
    return common_direction(unit(along))
