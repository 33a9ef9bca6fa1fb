"""Creases that point to a centre across a hole: how far they are off it.

A finite centre is a point, an infinite one a direction; both are unknowns beside the vertices.
Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

import numpy as np

from graphs.arrays import Floats
from synth.realisation.pattern import Pattern, Pointing

__all__ = ["first_unknowns", "off_centres"]


def first_unknowns(pattern: Pattern, places: Floats, in_holes: Floats, in_panels: Floats) -> Floats:
    """Return the unknowns of a drawing: vertices, a point for each centre that is no vertex, hubs of bent panels.

    The point of an infinite centre is its direction, of length 1.

    Parameters
    ----------
    pattern : Pattern
    places : float[V, 2]
    in_holes : float[H, 2]
    in_panels : float[B, 2]
        Hubs, as of `barycentric_start`.

    Returns
    -------
    float[V + C + B, 2]
    """
    free = [one for one in pattern.pointings if one.vertex is None]
    points = [
        _common_direction(pattern, places, one) if one.infinite else in_holes[list(one.holes)].mean(axis=0)
        for one in free
    ]
    return np.concatenate([places, np.array(points).reshape(-1, 2), in_panels])


def off_centres(pattern: Pattern, unknowns: Floats) -> tuple[Floats, Floats]:
    """Return the sine of the angle by which each crease misses its centre, and the derivatives.

    Lengths are taken as constant in the derivatives, which are exact where nothing is off.

    Parameters
    ----------
    pattern : Pattern
    unknowns : float[V + C + B, 2]

    Returns
    -------
    off : float[P]
        Then, for each infinite centre, by how much its direction is longer than 1.
    derivatives : float[P, 2 (V + C + B)]
    """
    values: list[float] = []
    rows: list[Floats] = []
    free = pattern.vertices
    for one in pattern.pointings:
        centre = free if one.vertex is None else one.vertex
        free += one.vertex is None
        for crease in one.creases:
            value, row = _off(unknowns, pattern.creases[crease], centre, one.infinite)
            values.append(value)
            rows.append(row)
        if one.infinite:
            row = np.zeros_like(unknowns)
            row[centre] = unknowns[centre]
            values.append((unknowns[centre] @ unknowns[centre] - 1.0) / 2)
            rows.append(row)
    return np.array(values), np.array(rows).reshape(len(rows), unknowns.size)


def _off(unknowns: Floats, crease: tuple[int, int], centre: int, infinite: bool) -> tuple[float, Floats]:
    a, b = crease
    along = unknowns[b] - unknowns[a]
    to = unknowns[centre] if infinite else unknowns[centre] - (unknowns[a] + unknowns[b]) / 2
    scale = float(np.linalg.norm(along) * np.linalg.norm(to))
    by_along, by_to = np.array([to[1], -to[0]]) / scale, np.array([-along[1], along[0]]) / scale
    row = np.zeros_like(unknowns)
    row[b] += by_along
    row[a] -= by_along
    row[centre] += by_to
    if not infinite:
        row[a] -= by_to / 2
        row[b] -= by_to / 2
    return float(along[0] * to[1] - along[1] * to[0]) / scale, row.ravel()


def _common_direction(pattern: Pattern, places: Floats, one: Pointing) -> Floats:
    """Return the direction that creases have in the mean, whichever way they run."""
    ends = places[[pattern.creases[crease] for crease in one.creases]]
    along = ends[:, 1] - ends[:, 0]
    direction: Floats = np.linalg.svd(along / np.linalg.norm(along, axis=1)[:, None])[2][0]
    return direction
