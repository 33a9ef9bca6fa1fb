"""More than five orientations: the dyads that come nearest to them, by least squares.

The error at an orientation is how far the angle between G and M_i W, that of the dyad's link, is from its mean.
Theory: docs/theory/dyads.md.
"""

from __future__ import annotations

import numpy as np

from graphs.errors import UnsolvableError
from graphs.tolerances import DOUBLE, canonical_order
from graphs.types import Floats
from synth.guidance.dyads import Dyad, dyad_of
from synth.guidance.order import nearest_moving_axis
from synth.guidance.orientations import Orientations

__all__ = ["dyads_by_least_squares", "fibonacci_sphere"]

_GRID = 2000
_NEIGHBOURS = 7
_MOST_STARTS = 100
_MOST = 12
"""How many dyads are given; those that fit worse are left out."""


def dyads_by_least_squares(orientations: Orientations) -> tuple[Dyad, ...]:
    """Return dyads that guide a body nearly through orientations, those with the least error first.

    Each is a local minimum of the sum of squared errors. To find them all, the fixed axis is tried on a grid over
    the sphere, with the best moving axis for each; every point of the grid that is better than those around it is
    the start of a least-squares fit. Minima narrower than the grid (4 degrees) may be missed.

    Parameters
    ----------
    orientations : Orientations
        Five or more.

    Raises
    ------
    UnsolvableError
        If there are fewer than five, which have infinitely many dyads without error, or if more have as many (as
        where all are turns about one axis).

    Examples
    --------
    >>> from scipy.spatial.transform import Rotation
    >>> angles = [(0, 0), (40, 10), (70, 60), (120, 100), (200, 170), (300, 10), (330, 99)]
    >>> orientations = Orientations.from_rotation(Rotation.from_euler("ZX", angles, degrees=True))
    >>> best = dyads_by_least_squares(orientations)[0]
    >>> bool(np.allclose(best.fixed, (0, 0, 1)) and np.allclose(best.moving, (1, 0, 0))), best.misfit < 1e-9
    (True, True)
    """
    if len(orientations) < 5:
        raise UnsolvableError(f"{len(orientations)} orientations have dyads without error; choose among those")
    found: list[tuple[float, Dyad]] = []
    for start in _starts(orientations):
        error, dyad = _fitted(orientations, start)
        if all(
            min(_apart(dyad.fixed, d.fixed), 1.0) + _apart(dyad.moving, d.moving) > DOUBLE.same_configuration
            for _, d in found
        ):
            found.append((error, dyad))
    order = canonical_order([np.concatenate([[error], dyad.fixed, dyad.moving]) for error, dyad in found])
    return tuple(found[place][1] for place in order[:_MOST])


def fibonacci_sphere(count: int) -> Floats:
    """Return points spread evenly over the sphere: float[count, 3]."""
    k = np.arange(count) + 0.5
    z = 1.0 - 2.0 * k / count
    turn = k * np.pi * (3.0 - np.sqrt(5.0))
    across = np.sqrt(1.0 - z * z)
    return np.stack([across * np.cos(turn), across * np.sin(turn), z], axis=1)


def _starts(orientations: Orientations) -> Floats:
    """Return the points of a grid of fixed axes that are better than their neighbours."""
    from scipy.spatial import cKDTree

    grid = fibonacci_sphere(2 * _GRID)
    grid = grid[grid[:, 2] > 0.0]
    apart = orientations.matrices - orientations.matrices.mean(axis=0)
    moments = np.tensordot(apart, apart, axes=(0, 0))  # no array grows with both grid and orientations
    errors = np.linalg.eigvalsh(np.einsum("ma,ajbk,mb->mjk", grid, moments, grid))[:, 0]
    if np.median(errors) < DOUBLE.zero * np.trace(np.einsum("ajbj->ab", moments)):
        raise UnsolvableError("infinitely many dyads take these orientations (are they turns about one axis?)")
    both_ends = np.concatenate([grid, -grid])
    _, near = cKDTree(both_ends).query(grid, _NEIGHBOURS)
    lowest = np.flatnonzero(errors <= errors[near % len(grid)].min(axis=1))
    return np.asarray(grid[lowest[np.argsort(errors[lowest])][:_MOST_STARTS]])


def _fitted(orientations: Orientations, start: Floats) -> tuple[float, Dyad]:
    from scipy.optimize import least_squares

    m = orientations.matrices

    def errors(axes: Floats) -> Floats:
        g, w = axes[:3], axes[3:]
        lengths = np.array([np.linalg.norm(g), np.linalg.norm(w)])
        angles = np.arccos(np.clip(m @ w @ g / lengths.prod(), -1.0, 1.0))
        return np.concatenate([angles - angles.mean(), lengths - 1.0])

    best = least_squares(
        errors,
        np.concatenate([start, nearest_moving_axis(orientations, start)]),
        xtol=1e-15,
        ftol=1e-15,
        gtol=1e-15,
    )
    return float(best.cost), dyad_of(orientations, best.x[:3], best.x[3:])


def _apart(a: Floats, b: Floats) -> float:
    return float(np.linalg.norm(np.cross(a, b)))
