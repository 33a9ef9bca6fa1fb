"""Orientations of a body on a known dyad: the truth to compare with."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from synth.linkages.guidance.orientations import Orientations


@dataclass(frozen=True)
class Problem:
    """A dyad, its crank angles from orientation 1 (counter-clockwise, radians) and the orientations it passes."""

    fixed: np.ndarray
    moving: np.ndarray
    turned: np.ndarray
    orientations: Orientations


def direction(rng):
    vector = rng.normal(size=3)
    return vector / np.linalg.norm(vector)


def apart(n, rng, least=1e-4):
    """Angles in [0, 2 pi), the first zero, in any order, none two nearer than the least."""
    while True:
        angles = np.concatenate([[0.0], rng.uniform(0.0, 2.0 * np.pi, n - 1)])
        if np.diff(np.sort(angles), append=2.0 * np.pi).min() > least:
            return angles


def problem(n, rng, order="any"):
    """A random dyad at random crank angles; with order "ccw" or "cw" they grow that way."""
    turned = apart(n, rng)
    if order != "any":
        turned = np.sort(turned)
    if order == "cw":
        turned = np.mod(-turned, 2.0 * np.pi)
    fixed, moving = direction(rng), direction(rng)
    first = Rotation.from_quat(rng.normal(size=4))
    # W stays where the crank has it, whatever the body's turn about it
    body = (
        Rotation.from_rotvec(np.outer(turned, fixed))
        * first
        * Rotation.from_rotvec(np.outer(rng.uniform(0.0, 2.0 * np.pi, n), moving))
    )
    return Problem(fixed, moving, turned, Orientations.from_rotation(body))


def order_of(turned):
    """The direction in which angles from the first grow in their order, counted by hand."""
    if all(a < b for a, b in zip(turned, turned[1:], strict=False)):
        return "ccw"
    falling = [turned[0] + 2.0 * np.pi, *turned[1:]]
    return "cw" if all(a > b for a, b in zip(falling, falling[1:], strict=False)) else None


def random_orientations(n, rng):
    return Orientations.from_rotation(Rotation.from_quat(rng.normal(size=(n, 4))))


def lines_apart(a, b):
    """Sine of the angle between two lines."""
    return float(np.linalg.norm(np.cross(a, b)))
