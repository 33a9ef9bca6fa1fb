"""Rings of solids by the axes of their joints, or by lengths, twists and angles.

Theory: docs/theory/generators.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, sin

import numpy as np

from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import Axis, HingedSolids
from graphs.types import Floats, JointId

__all__ = ["Line", "chain_frames", "ring", "ring_of_sides", "turned"]

Line = tuple[Sequence[float], Sequence[float]]
"""A point of an axis and its direction."""

DIGITS = 14
"""Special proportions are kept to these: rounding more would close the loops at one pose only."""


def ring(lines: Sequence[Line], digits: int = DIGITS) -> HingedSolids:
    """Return a ring of solids with the given axes: joint i connects solids i - 1 and i.

    >>> ring([((x, 0, 0), (0, x - 1, 1)) for x in range(3)])
    <HingedSolids: <SCGraph: 3 links, 3 joints, 0 centres>>
    """
    n = len(lines)
    chain = SCGraph(n, [((i - 1) % n, i) for i in range(n)])
    axes: dict[JointId, Axis] = {
        i: (_rounded(point, digits), _rounded(along, digits)) for i, (point, along) in enumerate(lines)
    }
    return HingedSolids(chain, axes)


def chain_frames(lengths: Sequence[float], twists: Sequence[float], angles: Sequence[float]) -> Floats:
    """Return frames, float[n + 1, 4, 4], of a chain of joints and its end: each about z, then along and about x.

    Each solid has the length of the common normal of its axes, the twist between them and the angle of the joint
    before it, radians. If the ring closes the last frame is the identity. Source: J. Denavit and R. S. Hartenberg
    (1955).

    >>> from math import pi
    >>> chain_frames([1, 1, 1, 1], [0, 0, 0, 0], [pi / 2] * 4)[-1].round(12).tolist() == np.eye(4).tolist()
    True
    """
    frames = [np.eye(4)]
    for length, twist, angle in zip(lengths, twists, angles, strict=True):
        step = np.eye(4)
        step[0, 3] = length
        frames.append(frames[-1] @ turned(angle, 2) @ step @ turned(twist, 0))
    return np.array(frames)


def lines_of(frames: Floats) -> list[Line]:
    """Return the axis of the joint of each frame but the last."""
    return [(tuple(frame[:3, 3]), tuple(frame[:3, 2])) for frame in frames[:-1]]


def ring_of_sides(across: Floats, lengths: Floats) -> HingedSolids:
    """Return a ring without offsets: axis i along a direction, solid i square to its two axes, of a length.

    `across` has unit vectors, float[n, 3], each square to the next; lengths, float[n], are signed along the
    product of a direction and the next.

    >>> square = np.array([[0, 0, 1], [1, 0, 0], [0, 0, 1], [1, 0, 0.]])
    >>> ring_of_sides(square, np.ones(4)).axes[1][0]
    (0.0, 1.0, 0.0)
    """
    sides = lengths[:, None] * np.cross(across, np.roll(across, -1, axis=0))
    feet = np.concatenate([np.zeros((1, 3)), np.cumsum(sides, axis=0)[:-1]])
    assert abs(sides.sum(axis=0)).max() < 1e-12, "the ring does not close"
    return ring([(tuple(foot), tuple(along)) for foot, along in zip(feet, across, strict=True)])


def turned(angle: float, axis: int) -> Floats:
    """Return a rotation about a coordinate axis, float[4, 4].

    >>> turned(0.0, 2).tolist() == np.eye(4).tolist()
    True
    """
    made = np.eye(4)
    a, b = [(1, 2), (2, 0), (0, 1)][axis]
    made[a, a] = made[b, b] = cos(angle)
    made[a, b], made[b, a] = -sin(angle), sin(angle)
    return made


def _rounded(vector: Sequence[float], digits: int) -> tuple[float, float, float]:
    x, y, z = (round(float(one), digits) + 0.0 for one in vector)
    return (x, y, z)
