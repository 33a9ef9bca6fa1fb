"""Right cones and circular cylinders, and linkages on them by their links' sizes, or by steps between joint axes.

A place is an azimuth, a length along the ruling line there, a height outward. A cylinder is the limit of cones, its
apex at infinity, and linkages on it are planar. How a linkage lies on surfaces: ``synth.linkages.surfaces``. Theory:
docs/theory/mapping.md, docs/theory/multiloop.md, docs/theory/templates.md.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import cos, degrees, inf, isfinite, pi, remainder, sin, tan, tau
from typing import Any, ClassVar, Literal

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, numbered, shown
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.types import Floats, JointId


def checked_cone_angle(cone_angle: npt.ArrayLike) -> Floats:
    """Return cone angles; raises `InvariantError` unless 0 <= lambda < pi / 2."""
    angles = np.asarray(cone_angle, dtype=float)
    wrong = angles[~((angles >= 0) & (angles < np.pi / 2))]
    if wrong.size:
        angle = f"{np.degrees(wrong.flat[0]):.12g} degrees"
        raise InvariantError(
            "cone angle", f"the cone angle is {angle}", "0 or more, and less than 90", ("lambda", None)
        )
    return angles


def joint_axes(places: npt.ArrayLike, cone_angle: npt.ArrayLike) -> Floats:
    """Return the directions of joint axes, float[..., J, 3] (Hyatt et al. 2020, Eq. 17).

    They are unit vectors (cos lambda sin t, -sin lambda, cos lambda cos t).

    Parameters
    ----------
    places, cone_angle : float[..., J], float[...]
        Azimuths, and lambda of each linkage, radians.

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
    """A right cone, apex at the origin, its axis the y axis.

    Attributes
    ----------
    angle : float
        lambda, between a ruling line and the plane perpendicular to the axis, radians.
    kind, centre : "cone", Centre
        The centre of each loop is its apex.
    spans : (float, float)
        Where ruling lines begin and end in a picture.

    Examples
    --------
    >>> print(Cone(np.pi / 6))
    lambda 30 degrees (half angle 60 degrees)
    """

    angle: float
    kind: ClassVar[str] = "cone"
    centre: ClassVar[Centre] = Centre.FINITE
    spans: ClassVar[tuple[float, float]] = (0.35, 1.05)

    def __post_init__(self) -> None:
        checked_cone_angle(self.angle)

    def __str__(self) -> str:
        return f"lambda {degrees(self.angle):.10g} degrees (half angle {90.0 - degrees(self.angle):.10g} degrees)"

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
        """Return points in space, float[..., 3]: on the ruling line, and outward from it."""
        t = np.asarray(azimuth, dtype=float)
        rulings = joint_axes(t[..., None], np.full(t.shape, self.angle))[..., 0, :]
        c, s = np.cos(self.angle), np.sin(self.angle)
        outward = np.stack([s * np.sin(t), np.full(t.shape, c), s * np.cos(t)], axis=-1)
        up, out = (np.asarray(one, dtype=float)[..., None] for one in (along, height))
        return np.asarray(up * rulings + out * outward)

    def flat(self, azimuth: npt.ArrayLike, along: npt.ArrayLike, height: float) -> Floats:
        """Return points of the surface unrolled and seen from outside, float[..., 2]; azimuth 0 points upwards.

        The surface at a height is a cone whose apex is height / cos(lambda) higher.
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

    Attributes
    ----------
    radius : float
        Positive, in the unit of the lengths.
    kind, centre : "cylinder", Centre
        The centre of each loop is at infinity.

    Examples
    --------
    >>> print(Cylinder(2.5))
    radius 2.5
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
        """Return points in space, float[..., 3], as `Cone.place` does."""
        t, up, out = np.broadcast_arrays(*(np.asarray(one, dtype=float) for one in (azimuth, along, height)))
        return np.stack([(self.radius + out) * np.sin(t), -up, (self.radius + out) * np.cos(t)], axis=-1)

    def flat(self, azimuth: npt.ArrayLike, along: npt.ArrayLike, height: float) -> Floats:
        """Return points of the surface unrolled and seen from outside, float[..., 2]."""
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
    """Return the size of a surface as plain data."""
    return {
        "lambda_deg": degrees(surface.angle) if isinstance(surface, Cone) else None,
        "half_angle_deg": 90.0 - degrees(surface.angle) if isinstance(surface, Cone) else None,
        "radius": surface.radius if isinstance(surface, Cylinder) else None,
    }


Pair = tuple[JointId, JointId]
"""Two joints of one link."""


@dataclass(frozen=True, slots=True, repr=False)
class SurfaceLinkage:
    """A linkage whose joint axes are ruling lines of a cone or a cylinder: a developable mechanism.

    It has the sizes of its links, link angles of a spherical linkage or lengths of a planar one, which determine
    the surfaces; or steps round a surface.

    Attributes
    ----------
    chain : SCGraph
        On a cylinder all its loops have their centre at infinity.
    angles, lengths : mapping of (joint, joint) to float, or None
        Link angles, radians: on a cone; distances of joints, any one unit: on a cylinder.
    steps : mapping of (joint, joint) to float, or None
        Signed projected angles, radians; they lead to every joint.
    surface : Cone, Cylinder or None
        With steps, where it is known.
    azimuth : float
        With steps: the azimuth of the joint that they name first, radians.

    Examples
    --------
    >>> SurfaceLinkage(ring(4), steps={("1", "2"): 1.0, ("2", "3"): 0.5, ("1", "4"): -1.0}).places()
    [0.0, 1.0, 1.5, -1.0]
    """

    chain: SCGraph
    angles: Mapping[Pair, float] | None = None
    steps: Mapping[Pair, float] | None = None
    surface: Surface | None = None
    lengths: Mapping[Pair, float] | None = None
    azimuth: float = 0.0

    @classmethod
    def loop(cls, sizes: Sequence[float], kind: Literal["cone", "cylinder"] = "cone") -> SurfaceLinkage:
        """Return one loop of links: link i, counted from 1, lies between joints i and i + 1.

        Parameters
        ----------
        sizes : float[n]
            In loop order: link angles, radians, or on a cylinder lengths; `InvariantError` if one is out of range.
        kind : {"cone", "cylinder"}, optional

        Examples
        --------
        >>> SurfaceLinkage.loop([2.1, 1.7, 0.8, 1.5]).angles[("2", "3")]
        1.7
        """
        for number, size in enumerate(sizes, start=1):
            if kind == "cone" and not 0.0 < size < pi:
                wrong = f"link angle {number} is {degrees(size):.12g} degrees"
                raise InvariantError("link angle", wrong, "the angle between two axes, between 0 and 180")
            if not (size > 0.0 and isfinite(size)):
                raise InvariantError("length", f"length {number} is {size:.12g}", "a length above 0")
        chain = ring(len(sizes))
        joints = list(chain.joints)
        after = [*joints[1:], joints[0]]
        size_of = dict(zip(zip(joints, after, strict=True), map(float, sizes), strict=True))
        return cls(chain, angles=size_of) if kind == "cone" else cls(as_planar(chain), lengths=size_of)

    @classmethod
    def placed(cls, chain: SCGraph, places: Sequence[float], surface: Surface | None = None) -> SurfaceLinkage:
        """Return a linkage whose joints lie at azimuths, by the steps from each joint to the next.

        Parameters
        ----------
        chain : SCGraph
        places : float[J]
            Azimuths of the joints, radians, in the order of the chain's joints.
        surface : Cone or Cylinder, optional

        Examples
        --------
        >>> SurfaceLinkage.placed(ring(3), [0.0, 1.5, 1.0]).steps
        {('1', '2'): 1.5, ('2', '3'): -0.5}
        """
        steps = (_shorter_way(float(b) - float(a)) for a, b in pairwise(places))
        if isinstance(surface, Cylinder):
            chain = as_planar(chain)
        every = dict(zip(pairwise(chain.joints), steps, strict=True))
        return cls(chain, steps=every, surface=surface, azimuth=_shorter_way(float(places[0])))

    @property
    def kind(self) -> Literal["cone", "cylinder"]:
        """Whether it lies on cones or on cylinders; steps alone, where no centre is at infinity, on cones."""
        planar = bool(self.chain.loops) and all(loop.centre is Centre.INFINITE for loop in self.chain.loops)
        if self.lengths is not None or isinstance(self.surface, Cylinder):
            return "cylinder"
        return "cylinder" if planar and self.angles is None and self.surface is None else "cone"

    @property
    def sizes(self) -> Mapping[Pair, float] | None:
        """The link angles, or the lengths."""
        return self.lengths if self.angles is None else self.angles

    def __repr__(self) -> str:
        sizes = "steps" if self.steps is not None else "lengths" if self.lengths is not None else "link angles"
        links, joints = numbered(len(self.chain), "link"), numbered(len(self.chain.joints), "joint")
        return f"<SurfaceLinkage: {links}, {joints}, on a {self.kind}, by {sizes}>"

    def places(self) -> list[float]:
        """Return the azimuths of the joints, radians, in the order of the chain's joints.

        Raises `InvariantError` if the steps disagree, or do not lead to every joint.
        """
        placed = places_of_steps(self.steps or {})
        return [self.azimuth + placed[joint] for joint in self.chain.joints]


def _shorter_way(step: float) -> float:
    """Return a step in (-pi, pi]."""
    turned = remainder(step, tau)
    return pi if turned <= -pi + 1e-15 else turned


def ring(links: int) -> SCGraph:
    """Return a loop whose link i lies between joints i and i + 1, counted from 1."""
    joints = {str(i + 1): ((i - 1) % links + 1, i + 1) for i in range(links)}
    return SCGraph(range(1, links + 1), joints, [Loop(tuple(joints))])


def as_planar(chain: SCGraph) -> SCGraph:
    """Return a chain with the centres of all loops at infinity: all axes are parallel."""
    return chain.with_loops([replace(loop, centre=Centre.INFINITE) for loop in chain.loops])


def places_of_steps(steps: Mapping[Pair, float], tolerance: float = 1e-7) -> dict[JointId, float]:
    """Return the azimuths of joints from signed steps, projected angles in radians, from one joint to another.

    The first joint named is at 0. Raises `InvariantError` if steps that lead to one joint two ways disagree by
    more than the tolerance, or leave joints unconnected.
    """
    placed: dict[JointId, float] = {}
    left = dict(steps)
    if left:
        placed[next(iter(left))[0]] = 0.0
    while left:
        ready = next((pair for pair in left if pair[0] in placed or pair[1] in placed), None)
        if ready is None:
            a, b = next(iter(left))
            raise InvariantError(
                "steps", f"no steps lead from joint {shown(next(iter(placed)))} to {shown(a)}", "connected steps"
            )
        (a, b), step = ready, left.pop(ready)
        if a not in placed:
            placed[a] = placed[b] - step
        elif b not in placed:
            placed[b] = placed[a] + step
        elif abs(off := remainder(placed[a] + step - placed[b], tau)) > tolerance:
            raise InvariantError(
                "steps",
                f"the step from {shown(a)} to {shown(b)} misses by {degrees(off):.6g} degrees",
                "steps that agree",
            )
    return placed
