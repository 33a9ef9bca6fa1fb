"""Whether what quadratic forms leave is irreducible: one component, by monodromy of its points on a plane.

On a general linear space of m + 1 dimensions m forms have 2^m common points. As the space moves round a loop the points
come back in another order; points of one irreducible component are exchanged, those of two never are. So if loops lead
from one point to all others there is one component: no others exist, since every component of what m forms leave meets
the space. That is numerical, as paths are (A. J. Sommese, J. Verschelde, C. W. Wampler, Symmetric functions applied to
decomposing solution sets of polynomial systems, SIAM J. Numerical Analysis 40 (2002)). Theory: docs/theory/branches.md.
"""

from __future__ import annotations

import numpy as np

from graphs.types import Floats
from synth.analysis.motion.singular.homotopy import Complexes, FormPath, followed_to_end, path_ends

_MOST_FORMS = 7
"""Of more forms 2^m points are too many for what is asked."""
_LOOPS = 12
"""After so many loops that leave points apart it is not known whether they are of one component."""
_SAME = 1e-6
"""Ends are the points that they are nearer to than this, as unit vectors up to a factor."""


def is_irreducible(forms: Floats) -> bool:
    """Tell whether m forms float[m, s, s] in more than m + 1 variables leave one component; False if not known."""
    count, size = forms.shape[:2]
    if count > _MOST_FORMS or size < count + 2:
        return False
    chance = np.random.default_rng((*forms.shape, 1))
    scaled = forms / np.abs(forms).max(axis=(1, 2), keepdims=True)
    plane = chance.normal(size=(size, count + 1))
    ends = path_ends(plane.T @ scaled @ plane)
    if not ends.arrived.all():
        return False
    points = ends.points
    orbit = np.arange(len(points))
    for _ in range(_LOOPS):
        order = _order_after_loop(scaled, plane, points, chance)
        if order is not None:
            orbit = _joined(orbit, order)
        if not orbit.any():
            return True
    return False


def _order_after_loop(
    forms: Floats, plane: Floats, points: Complexes, chance: np.random.Generator
) -> np.ndarray | None:
    """Return which point each comes back as after a loop through two other planes; None if paths are lost."""
    shape = plane.shape
    corners = [chance.normal(size=shape) + 1j * chance.normal(size=shape) for _ in range(2)]
    here: Complexes = plane.astype(complex)
    ends = points
    for first, second in ((here, corners[0]), (corners[0], corners[1]), (corners[1], here)):
        arrived = followed_to_end(_MovingPlane(forms, first, second), ends)
        if not arrived.arrived.all():
            return None
        ends = arrived.points
    near = np.abs(ends.conj() @ points.T)
    order = np.argmax(near, axis=1)
    off = np.sqrt(np.maximum(0.0, 1.0 - near.max(axis=1) ** 2))
    return order if (off < _SAME).all() and len(set(order.tolist())) == len(order) else None


def _joined(orbit: np.ndarray, order: np.ndarray) -> np.ndarray:
    """Return the least point that each is known to be exchanged with."""
    while True:
        least = np.minimum(orbit, orbit[order])
        np.minimum.at(least, order, orbit)
        if (least == orbit).all():
            return orbit
        orbit = least


class _MovingPlane(FormPath):
    """Forms on a plane that goes from one, at parameter 1, to another, at 0."""

    def __init__(self, forms: Floats, first: Complexes, second: Complexes) -> None:
        self.count, self.size = len(forms), first.shape[1]
        self._whole = forms.shape[1]
        self._forms = forms.reshape(-1, self._whole).T.astype(complex)
        self._first, self._second = first, second

    def evaluated(self, points: Complexes, times: Floats) -> tuple[Complexes, Complexes, Complexes]:
        """Return the forms at points of the plane, half their slopes, and their derivatives by the parameter."""
        one, other = points @ self._first.T, points @ self._second.T
        there = times[:, None] * one + (1.0 - times)[:, None] * other
        slopes = (there @ self._forms).reshape(len(points), self.count, self._whole)
        values = (slopes @ there[..., None])[..., 0]
        by_time = 2.0 * (slopes @ (one - other)[..., None])[..., 0]
        mixed = times[:, None, None] * (slopes @ self._first) + (1.0 - times)[:, None, None] * (slopes @ self._second)
        return values, mixed, by_time
