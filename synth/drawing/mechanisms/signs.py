"""Signs of the thesis: a circled dot is a finite centre, a lying eight one at infinity; no centre has no sign."""

from __future__ import annotations

from math import cos, pi, sin

from graphs.loops.loop import Centre
from synth.drawing.scene.palette import FINE, NORMAL
from synth.drawing.scene.shapes import Disc, Line, Point, Shape

__all__ = ["SIGN", "centre_sign", "joint_dot"]

SIGN = 4.2
"""Radius of the sign of a centre, points."""


def centre_sign(at: Point, centre: Centre, colour: str, size: float = SIGN) -> list[Shape]:
    """Return the sign of a loop's centre.

    >>> len(centre_sign((0, 0), Centre.FINITE, "ink")), len(centre_sign((0, 0), Centre.NONE, "ink"))
    (2, 0)
    """
    if centre is Centre.FINITE:
        return [Disc(at, size, "paper", colour, 1.1 * NORMAL), Disc(at, 0.32 * size, colour, None)]
    if centre is Centre.INFINITE:
        # Bernoulli's lemniscate, stretched upwards a little
        turns = [2 * pi * i / 48 for i in range(49)]
        row = [
            (
                at[0] + 1.5 * size * cos(a) / (1 + sin(a) ** 2),
                at[1] + 1.9 * size * sin(a) * cos(a) / (1 + sin(a) ** 2),
            )
            for a in turns
        ]
        return [Line(row, "paper", 3 * NORMAL), Line(row, colour, 1.2 * NORMAL)]
    return []


def joint_dot(at: Point, joint: object, radius: float = 2.1) -> Disc:
    """Return a revolute joint: a small circle, empty, as on drawings of mechanisms."""
    return Disc(at, radius, "paper", "ink", NORMAL if radius > 1.5 else FINE, (("joint", str(joint)),))
