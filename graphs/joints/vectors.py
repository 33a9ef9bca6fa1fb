"""Vectors of places and axes: made of length one, across each other, plain. Theory: docs/theory/joints.md."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from graphs.arrays import Floats
from graphs.joints.linkage import Vector

__all__ = ["across", "beside", "plain_vector", "unit"]


def unit(vector: Iterable[float]) -> Floats:
    """Return a vector made of length one: float[3].

    Examples
    --------
    >>> unit((0, 0, 2)).tolist()
    [0.0, 0.0, 1.0]
    """
    one: Floats = np.array(list(vector), dtype=float)
    return np.asarray(one / np.linalg.norm(one))


def across(one: Floats, axis: Floats) -> Floats:
    """Return the part of a vector that is at a right angle to an axis of any length.

    Examples
    --------
    >>> across(np.array([1.0, 1.0, 0.0]), np.array([0.0, 3.0, 0.0])).tolist()
    [1.0, 0.0, 0.0]
    """
    part: Floats = one - (one @ axis) / (axis @ axis) * axis
    return part


def beside(axis: Floats) -> tuple[Floats, Floats]:
    """Return two directions that are at right angles with a unit vector and each other, right-handed.

    Examples
    --------
    >>> x, y = beside(np.array([0.0, 0.0, 1.0]))
    >>> float(np.cross(x, y)[2])
    1.0
    """
    least = np.eye(3)[int(np.abs(axis).argmin())]
    x = unit(np.cross(axis, least))
    return x, np.cross(axis, x)


def plain_vector(one: Floats) -> Vector:
    """Return a vector as three plain numbers."""
    x, y, z = one.tolist()
    return (x, y, z)
