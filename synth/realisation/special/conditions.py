"""Conditions on the axes of a linkage: polynomials that are to be zero, and their derivatives.

The unknowns are rows of six numbers: a point and a direction for each joint, then a point and a direction for each
centre, of which a finite one uses the point, one at infinity the direction. Conditions take complex numbers and
leading dimensions, so that all derivatives come from one call (a complex step, exact for polynomials). Theory:
docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.loops.loop import Centre
from graphs.types import Floats

__all__ = [
    "AxisCondition",
    "AxisGroup",
    "AxisSymmetry",
    "derivatives",
    "equal_links",
    "meeting",
    "normal",
    "symmetric",
]

Unknowns = npt.NDArray[Any]
"""Float or complex [..., rows, 6]."""
AxisCondition = Callable[[Unknowns], Unknowns]
"""Of unknowns [..., rows, 6]: numbers [..., n] that are to be zero."""

_STEP = 2.0**-100


@dataclass(frozen=True, slots=True)
class AxisGroup:
    """Axes, by their places, that meet in a finite centre, or are parallel for one at infinity."""

    joints: tuple[int, ...]
    centre: Centre


@dataclass(frozen=True, slots=True)
class AxisSymmetry:
    """An isometry about the origin, float[3, 3], that takes each row of the unknowns to another."""

    image: tuple[int, ...]
    matrix: Floats


def derivatives(condition: AxisCondition, unknowns: Floats) -> Floats:
    """Return the derivatives of a condition by all unknowns: float[n, 6 rows].

    >>> derivatives(lambda rows: (rows**2).sum(axis=-1), np.ones((1, 6))).tolist()
    [[2.0, 2.0, 2.0, 2.0, 2.0, 2.0]]
    """
    size = unknowns.size
    steps = (1j * _STEP * np.eye(size)).reshape(size, *unknowns.shape)
    return np.asarray(condition(unknowns + steps).imag.T / _STEP)


def normal(joints: int) -> AxisCondition:
    """Return that directions are unit vectors, and the points of the axes about 1 from the origin."""

    def condition(rows: Unknowns) -> Unknowns:
        points, directions = rows[..., :joints, :3], rows[..., 3:]
        size = (points**2).sum(axis=(-1, -2))[..., None] / joints - 1.0
        return np.concatenate([(directions**2).sum(axis=-1) - 1.0, size], axis=-1)

    return condition


def meeting(groups: Sequence[AxisGroup], joints: int) -> AxisCondition:
    """Return that the axes of each group meet in its centre; row ``joints + k`` is the centre of group k."""

    def condition(rows: Unknowns) -> Unknowns:
        parts = [np.zeros((*rows.shape[:-2], 0))]
        for number, group in enumerate(groups):
            axes, centre = rows[..., list(group.joints), :], rows[..., joints + number, None, :]
            if group.centre is Centre.FINITE:
                parts.append(_flat(np.cross(axes[..., :3] - centre[..., :3], axes[..., 3:])))
            else:
                parts.append(_flat(np.cross(axes[..., 3:], np.broadcast_to(centre[..., 3:], axes[..., 3:].shape))))
        return np.concatenate(parts, axis=-1)

    return condition


def symmetric(motion: AxisSymmetry, joints: int) -> AxisCondition:
    """Return that an isometry takes each axis, and each centre, to its image."""
    image = list(motion.image)

    def condition(rows: Unknowns) -> Unknowns:
        moved = np.concatenate([rows[..., :3] @ motion.matrix.T, rows[..., 3:] @ motion.matrix.T], axis=-1)
        there = rows[..., image, :]
        apart = moved[..., :3] - there[..., :3]
        parallel = np.cross(moved[..., 3:], there[..., 3:])
        on_axes = np.cross(apart[..., :joints, :], there[..., :joints, 3:])
        return np.concatenate([_flat(parallel), _flat(on_axes), _flat(apart[..., joints:, :])], axis=-1)

    return condition


def equal_links(loop: Sequence[int]) -> AxisCondition:
    """Return that the links of a loop have right twists, equal lengths and no offsets.

    Points of axes are then the feet of both common normals.
    """
    here, after = list(loop), [*loop[1:], loop[0]]

    def condition(rows: Unknowns) -> Unknowns:
        one, other = rows[..., here, :], rows[..., after, :]
        between = other[..., :3] - one[..., :3]
        squares = (between**2).sum(axis=-1)
        return np.concatenate(
            [
                (between * one[..., 3:]).sum(axis=-1),
                (between * other[..., 3:]).sum(axis=-1),
                (one[..., 3:] * other[..., 3:]).sum(axis=-1),
                squares - squares[..., :1] / 2.0 - squares[..., -1:] / 2.0,
            ],
            axis=-1,
        )

    return condition


def _flat(vectors: Unknowns) -> Unknowns:
    return vectors.reshape(*vectors.shape[:-2], -1)
