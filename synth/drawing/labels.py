"""Places for labels beside points, so that they do not lie on each other."""

from __future__ import annotations

import numpy as np

from graphs.geometry import unit
from graphs.types import Floats

__all__ = ["spread"]

_ROUNDS = 400


def spread(points: Floats, reach: float, gap: float, only_x: bool = False) -> Floats:
    """Return a place for the label of each point, both float[n, 2].

    Labels start at a distance `reach` from their points, away from the middle of all, and push each other away
    (only left and right with `only_x`), and off the points, until none are nearer than `gap`.
    """
    if not len(points):
        return points
    random = np.random.default_rng(7)  # to part points that are one
    away = unit(points - points.mean(axis=0) + 1e-3 * random.normal(size=points.shape))
    places = points + max(reach, 1e-3 * gap) * away
    if only_x:
        places[:, 1] = points[:, 1]
    for _ in range(_ROUNDS):
        push = _pushes(places, places, gap)
        if not only_x:
            push += _pushes(places, points, 0.7 * gap)
        if only_x:
            push[:, 1] = 0.0
        if np.abs(push).max(initial=0.0) < 1e-4 * gap:
            break
        places = places + 0.5 * push
    return np.asarray(places)


def _pushes(places: Floats, others: Floats, gap: float) -> Floats:
    """Return by how much each place is pushed by what is nearer than the gap."""
    apart = places[:, None] - others[None]
    distance = np.linalg.norm(apart, axis=2)
    short = np.where((distance > 0.0) & (distance < gap), gap - distance, 0.0)
    return np.asarray((apart / np.maximum(distance, 1e-12)[:, :, None] * short[:, :, None]).sum(axis=1))
