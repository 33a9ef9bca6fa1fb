"""Right cones and circular cylinders, on which linkages lie: ruling lines, and surfaces at a height above them.

A place is an azimuth, a length along the ruling line there, a height outward. A cylinder is the limit of cones:
its apex, in which all axes meet, is at infinity, and linkages on it are planar. Theory: docs/theory/mapping.md,
docs/theory/templates.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, degrees, inf, sin, tan
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from graphs.arrays import Floats
from graphs.errors import InvariantError
from graphs.loops.loop import Centre

__all__ = ["Cone", "Cylinder", "Surface", "checked_cone_angle", "joint_axes", "surface_json"]


def checked_cone_angle(cone_angle: npt.ArrayLike) -> Floats:
    """Return cone angles; InvariantError unless 0 <= lambda < pi / 2.

    >>> checked_cone_angle(np.pi / 2)
    Traceback (most recent call last):
    ...
    graphs.errors.InvariantError: the cone angle is 90 degrees; expected 0 or more, and less than 90 [cone angle]
    """
    given = np.asarray(cone_angle, dtype=float)
    wrong = given[~((given >= 0) & (given < np.pi / 2))]
    if wrong.size:
        told = f"{np.degrees(wrong.flat[0]):.12g}"
        raise InvariantError(
            "cone angle", f"the cone angle is {told} degrees", "0 or more, and less than 90", ("lambda", None)
        )
    return given


def joint_axes(places: npt.ArrayLike, cone_angle: npt.ArrayLike) -> Floats:
    """Return the directions of joint axes (Hyatt et al. 2020, Eq. 17).

    Parameters
    ----------
    places : float[..., J]
        Azimuths, radians.
    cone_angle : float[...]
        lambda of each linkage.

    Returns
    -------
    float[..., J, 3]
        Unit vectors (cos lambda sin t, -sin lambda, cos lambda cos t).

    Raises
    ------
    InvariantError
        If a cone angle is out of range.

    Examples
    --------
    >>> joint_axes([0.0], np.radians(20)).round(12)
    array([[ 0.        , -0.34202014,  0.93969262]])
    """
    t = np.asarray(places, dtype=float)
    lam = checked_cone_angle(cone_angle)[..., np.newaxis]
    c, s = np.cos(lam), np.sin(lam)
    return np.stack([c * np.sin(t), np.broadcast_to(-s, t.shape), c * np.cos(t)], axis=-1)


@dataclass(frozen=True, slots=True)
class Cone:
    """A right cone, apex at the origin, its axis the y axis; `angle` is lambda, radians."""

    angle: float
    kind: ClassVar[str] = "cone"
    centre: ClassVar[Centre] = Centre.FINITE
    spans: ClassVar[tuple[float, float]] = (0.35, 1.05)

    def __post_init__(self) -> None:
        checked_cone_angle(self.angle)

    def __str__(self) -> str:
        return f"lambda {degrees(self.angle):.10g} degrees"

    def axes(self, places: npt.ArrayLike) -> tuple[Floats, Floats]:
        """Return points and directions of the ruling lines at azimuths float[J], each float[J, 3]."""
        directions = joint_axes(places, self.angle)
        return np.zeros_like(directions), directions

    def outward(self, rotations: Floats, shifts: Floats) -> tuple[Floats, Floats, Floats]:
        """Return p, q and c: a point of a moved link, at t and 1 from the apex, is p cos t + q sin t + c outside.

        It lies on the unit sphere, outside of the cone by so much of its height y + sin(lambda). Motions are
        rotations, float[F, 3, 3], and shifts, float[F, 3], from where the link lies on the cone.
        """
        row = rotations[:, 1]
        c, s = cos(self.angle), sin(self.angle)
        return c * row[:, 2], c * row[:, 0], s * (1.0 - row[:, 1])

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
        """Return the width of a radian of azimuth at a length along the ruling lines."""
        return along * cos(self.angle)

    def chords(self, width: float, along: float, height: float, off: float) -> int:
        """Return the number of chords, at most `off` away, for an unrolled arc of `width` radians."""
        radius = along + height * tan(self.angle)
        if radius <= off:
            return 1
        part = 2 * np.arccos(1 - off / radius)
        return max(1, int(np.ceil(width * cos(self.angle) / part)))


@dataclass(frozen=True, slots=True)
class Cylinder:
    """A right circular cylinder, its axis the y axis.

    Raise InvariantError unless the radius is positive.
    """

    radius: float
    kind: ClassVar[str] = "cylinder"
    centre: ClassVar[Centre] = Centre.INFINITE

    def __post_init__(self) -> None:
        if not 0 < self.radius < inf:
            raise InvariantError("radius", f"a radius of {self.radius!r}", "a positive number")

    @property
    def spans(self) -> tuple[float, float]:
        """Where ruling lines begin and end in a picture."""
        return 0.0, 1.6 * self.radius

    def __str__(self) -> str:
        return f"radius {self.radius:.10g}"

    def axes(self, places: npt.ArrayLike) -> tuple[Floats, Floats]:
        """Return points and directions of the ruling lines at azimuths float[J], each float[J, 3]."""
        t = np.asarray(places, dtype=float)
        return self.place(t, 0.0, 0.0), np.broadcast_to([0.0, -1.0, 0.0], (*t.shape, 3)).copy()

    def outward(self, rotations: Floats, shifts: Floats) -> tuple[Floats, Floats, Floats]:
        """Return p, q and c: a point of a moved link, at t, is p cos t + q sin t + c radii outside.

        At distance r from the axis it is (r^2 - R^2) / 2 R^2 outside, so much to first order. Motions are
        rotations, float[F, 3, 3], and shifts, float[F, 3], from where the link lies on the cylinder.
        """
        shift = shifts[:, ::2] / self.radius
        turned = np.einsum("fij,fi->fj", rotations[:, ::2, ::2], shift)
        return turned[:, 1], turned[:, 0], (shift**2).sum(axis=1) / 2

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
        """Return the width of a radian of azimuth, the same along the ruling lines."""
        return self.radius

    def chords(self, width: float, along: float, height: float, off: float) -> int:
        """Return 1: what runs round a cylinder is straight when it is unrolled."""
        return 1


Surface = Cone | Cylinder


def surface_json(surface: Surface | None) -> dict[str, Any]:
    """Return the size of a surface as plain data.

    >>> surface_json(Cylinder(2.5))
    {'lambda_deg': None, 'radius': 2.5}
    """
    return {
        "lambda_deg": degrees(surface.angle) if isinstance(surface, Cone) else None,
        "radius": surface.radius if isinstance(surface, Cylinder) else None,
    }
