"""Cones and cylinders, and the surfaces at a height above them: in space, and unrolled.

A place is an azimuth, a length along the ruling line there, a height outward. Theory: docs/theory/templates.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, tan

import numpy as np
import numpy.typing as npt

from graphs.arrays import Floats
from graphs.errors import InvariantError
from synth.conformed.pose import joint_axes
from synth.surfaces.cone import checked_cone_angle

__all__ = ["Cone", "Cylinder", "Surface"]


@dataclass(frozen=True)
class Cone:
    """A right cone, apex at the origin, in the frame of `synth.conformed.pose`; `angle` is lambda, radians."""

    angle: float

    def __post_init__(self) -> None:
        checked_cone_angle(self.angle)

    def place(self, azimuth: npt.ArrayLike, along: npt.ArrayLike, height: npt.ArrayLike) -> Floats:
        """Return points in space, float[..., 3]: on the ruling line, and outward from it.

        >>> Cone(0.0).place(0.0, 2.0, 1.0).tolist()
        [0.0, 1.0, 2.0]
        """
        t = np.asarray(azimuth, dtype=float)
        rulings = joint_axes(t[..., None], np.full(t.shape, self.angle))[..., 0, :]
        c, s = np.cos(self.angle), np.sin(self.angle)
        outward = np.stack([s * np.sin(t), np.full(t.shape, c), s * np.cos(t)], axis=-1)
        up, out = (np.asarray(one, dtype=float)[..., None] for one in (along, height))
        return np.asarray(up * rulings + out * outward)

    def flat(self, azimuth: npt.ArrayLike, along: npt.ArrayLike, height: float) -> Floats:
        """Return points of the surface unrolled and seen from outside, float[..., 2]; azimuth 0 points upwards.

        The surface at a height is a cone whose apex is height / cos(lambda) higher.

        >>> (Cone(np.radians(60)).flat(np.pi, 2.0, 0.0).round(9) + 0.0).tolist()
        [-2.0, 0.0]
        """
        turn = np.asarray(azimuth, dtype=float) * cos(self.angle)
        radius = np.asarray(along, dtype=float) + height * tan(self.angle)
        return np.stack([-radius * np.sin(turn), radius * np.cos(turn)], axis=-1)

    def width(self, along: float) -> float:
        """Return millimetres for a radian of azimuth at a length along the ruling lines."""
        return along * cos(self.angle)

    def chords(self, width: float, along: float, height: float, off: float) -> int:
        """Return the number of chords, at most `off` millimetres away, for an unrolled arc of `width` radians."""
        radius = along + height * tan(self.angle)
        if radius <= off:
            return 1
        part = 2 * np.arccos(1 - off / radius)
        return max(1, int(np.ceil(width * cos(self.angle) / part)))


@dataclass(frozen=True)
class Cylinder:
    """A right circular cylinder, its axis the y axis.

    Raise InvariantError unless the radius (millimetres) is positive.
    """

    radius: float

    def __post_init__(self) -> None:
        if not 0 < self.radius < float("inf"):
            raise InvariantError("radius", f"a radius of {self.radius!r} mm", "a positive number")

    def place(self, azimuth: npt.ArrayLike, along: npt.ArrayLike, height: npt.ArrayLike) -> Floats:
        """Return points in space, float[..., 3], as `Cone.place` does.

        >>> Cylinder(5.0).place(0.0, 2.0, 1.0).tolist()
        [0.0, -2.0, 6.0]
        """
        t, up, out = np.broadcast_arrays(*(np.asarray(one, dtype=float) for one in (azimuth, along, height)))
        return np.stack([(self.radius + out) * np.sin(t), -up, (self.radius + out) * np.cos(t)], axis=-1)

    def flat(self, azimuth: npt.ArrayLike, along: npt.ArrayLike, height: float) -> Floats:
        """Return points of the surface unrolled and seen from outside, float[..., 2].

        >>> Cylinder(5.0).flat(2.0, 3.0, 1.0).tolist()
        [12.0, -3.0]
        """
        t, up = np.broadcast_arrays(np.asarray(azimuth, dtype=float), np.asarray(along, dtype=float))
        return np.stack([(self.radius + height) * t, -up], axis=-1)

    def width(self, along: float) -> float:
        """Return millimetres for a radian of azimuth, the same along the ruling lines."""
        return self.radius

    def chords(self, width: float, along: float, height: float, off: float) -> int:
        """Return 1: what runs round a cylinder is straight when it is unrolled."""
        return 1


Surface = Cone | Cylinder
