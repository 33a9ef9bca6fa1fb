"""Rigid bodies made of plates, shells and round bars, and the hinges between them, in metres and kilograms.

Panels are plates of a thickness about their plane; links on a cone or a cylinder are parts of a shell; links that
are known by their axes only are bars between their hinges. Where shapes of one body overlap, both count.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from graphs.errors import numbered
from graphs.geometry import unit
from graphs.types import Floats, Ints, JointId, LinkId
from synth.making.templates.unfolding import Plane


@dataclass(frozen=True, eq=False)
class MassProperties:
    """Mass, centre float[3], and inertia about the centre float[3, 3], in the axes of the world."""

    mass: float
    centre: Floats
    inertia: Floats

    @classmethod
    def together(cls, parts: Sequence[MassProperties]) -> MassProperties:
        """Return those of several parts, by the theorem of parallel axes."""
        mass = sum(part.mass for part in parts)
        centre = np.asarray(sum(part.mass * part.centre for part in parts) / mass)
        inertia = np.zeros((3, 3))
        for part in parts:
            arm = part.centre - centre
            inertia += part.inertia + part.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
        return cls(mass, centre, inertia)


@dataclass(frozen=True, eq=False)
class Plate:
    """A plane panel, float[corners, 2] in the frame of its plane, as a prism of a thickness about the plane."""

    plane: Plane
    thickness: float

    def properties(self, density: float) -> MassProperties:
        """Return its mass, centre and inertia, exactly, by sums over the sides of the polygon."""
        here, after = self.plane.flat, np.roll(self.plane.flat, -1, axis=0)
        doubled = here[:, 0] * after[:, 1] - after[:, 0] * here[:, 1]
        area = doubled.sum() / 2.0
        centre = ((here + after) * doubled[:, None]).sum(axis=0) / (6.0 * area)
        products = here[:, :, None] * after[:, None, :]
        squares = here[:, :, None] * here[:, None, :] + after[:, :, None] * after[:, None, :]
        moments = ((squares + (products + products.transpose(0, 2, 1)) / 2.0) * doubled[:, None, None]).sum(axis=0)
        second = np.zeros((3, 3))
        second[:2, :2] = moments / (12.0 * area) - np.outer(centre, centre)
        second[2, 2] = self.thickness**2 / 12.0
        mass = float(density * area * self.thickness)
        axes = self.plane.axes
        inertia = mass * axes @ (np.trace(second) * np.eye(3) - second) @ axes.T
        return MassProperties(mass, self.plane.origin + axes[:, :2] @ centre, inertia)


@dataclass(frozen=True, eq=False)
class Bar:
    """A round bar between two points float[3]."""

    start: Floats
    end: Floats
    radius: float

    def properties(self, density: float) -> MassProperties:
        """Return its mass, centre and inertia."""
        along = self.end - self.start
        length = float(np.linalg.norm(along))
        mass = float(density * np.pi * self.radius**2 * length)
        outer = np.outer(unit(along), unit(along))
        across = mass * (3.0 * self.radius**2 + length**2) / 12.0
        inertia = across * (np.eye(3) - outer) + mass * self.radius**2 / 2.0 * outer
        return MassProperties(mass, (self.start + self.end) / 2.0, inertia)


@dataclass(frozen=True, eq=False)
class Shell:
    """A part of a conical or cylindrical shell: a profile that is swept about an axis.

    The axis is the second column of `axes`, through `origin`; azimuths go from the third to the first. `profile`,
    float[4, 2], has distances from the axis and heights along it of a parallelogram, counter-clockwise: its first
    two corners lie on the outer surface.
    """

    origin: Floats
    axes: Floats
    profile: Floats
    start: float
    width: float

    def at(self, azimuths: Floats) -> Floats:
        """Return the corners of the profile at azimuths, float[n, 4, 3]."""
        outward = np.outer(np.sin(azimuths), self.axes[:, 0]) + np.outer(np.cos(azimuths), self.axes[:, 2])
        distances, heights = self.profile.T
        return np.asarray(self.origin + distances[:, None] * outward[:, None] + heights[:, None] * self.axes[:, 1])

    def properties(self, density: float) -> MassProperties:
        """Return its mass, centre and inertia, exactly.

        Integrals of products of two coordinates over the volume are those over the profile of polynomials of the
        third degree, for which Gauss's rule with two points a side is exact, times integrals over the azimuth.
        """
        nodes = np.array([-1.0, 1.0]) / np.sqrt(12.0) + 0.5
        corner, sides = self.profile[0], self.profile[[1, 3]] - self.profile[0]
        area = abs(float(np.linalg.det(sides)))
        places = [corner + a * sides[0] + b * sides[1] for a in nodes for b in nodes]
        end, middle = self.start + self.width, self.start + self.width / 2.0
        chord = 2.0 * np.sin(self.width / 2.0)
        outward = chord * np.array([np.sin(middle), np.cos(middle)])
        double = (np.sin(2.0 * end) - np.sin(2.0 * self.start)) / 4.0
        mixed = (np.cos(2.0 * self.start) - np.cos(2.0 * end)) / 4.0
        squares = np.array([[self.width / 2.0 - double, mixed], [mixed, self.width / 2.0 + double]])
        mass, first, second = 0.0, np.zeros(3), np.zeros((3, 3))
        for distance, height in places:
            weight = density * area / 4.0 * distance
            first_here = np.array([distance * outward[0], height * self.width, distance * outward[1]])
            mass += weight * self.width
            first += weight * first_here
            here = np.zeros((3, 3))
            here[np.ix_([0, 2], [0, 2])] = distance**2 * squares
            here[1] = here[:, 1] = height * first_here
            second += weight * here
        centre = first / mass
        about = second - mass * np.outer(centre, centre)
        inertia = self.axes @ (np.trace(about) * np.eye(3) - about) @ self.axes.T
        return MassProperties(float(mass), self.origin + self.axes @ centre, inertia)

    def plates(self) -> list[Plate]:
        """Return plates along its middle surface, each a trapezium between two ruling lines, for want of shells."""
        count = max(1, int(np.ceil(self.width / _FACET)))
        corners = self.at(self.start + self.width * np.arange(count + 1) / count)
        outer, inner = corners[:, [0, 3]].mean(axis=1), corners[:, [1, 2]].mean(axis=1)
        thickness = float(np.linalg.norm(self.profile[3] - self.profile[0]))
        rings = zip(inner, outer, outer[1:], inner[1:], strict=False)
        return [Plate(Plane(np.array(ring), number), thickness) for number, ring in enumerate(rings)]


@dataclass(frozen=True, eq=False)
class Polyhedron:
    """A closed solid by corners float[n, 3] and triangles int[m, 3], counter-clockwise seen from outside."""

    corners: Floats
    triangles: Ints

    def properties(self, density: float) -> MassProperties:
        """Return its mass, centre and inertia, exactly: those of tetrahedra from a corner to each triangle, signed."""
        origin = self.corners[0]
        sides = self.corners[self.triangles] - origin
        volumes = np.einsum("ti,ti->t", sides[:, 0], np.cross(sides[:, 1], sides[:, 2])) / 6.0
        mass, sums = float(density * volumes.sum()), sides.sum(axis=1)
        centre = density * (volumes[:, None] * sums / 4.0).sum(axis=0) / mass
        products = np.einsum("tki,tkj->tij", sides, sides) + sums[:, :, None] * sums[:, None, :]
        second = density * (volumes[:, None, None] * products / 20.0).sum(axis=0) - mass * np.outer(centre, centre)
        return MassProperties(mass, origin + centre, np.trace(second) * np.eye(3) - second)

    def plates(self) -> list[Plate]:
        """Return no plates: formats that have only these do not hold it."""
        return []


_FACET = np.radians(10.0)
"""Azimuth of a plate in place of a shell, at most."""
Shape: TypeAlias = Plate | Bar | Shell | Polyhedron


@dataclass(frozen=True, eq=False)
class Body:
    """A link: its name in files, the number of its body, its shapes and its mass."""

    name: str
    link: LinkId
    shapes: tuple[Shape, ...]
    properties: MassProperties

    def flat_shapes(self) -> list[list[Plate] | Bar]:
        """Return bars, and the plates of each other shape: formats without curved shells have plates for these."""
        return [
            shape if isinstance(shape, Bar) else [shape] if isinstance(shape, Plate) else shape.plates()
            for shape in self.shapes
        ]


@dataclass(frozen=True, eq=False)
class Hinge:
    """A joint between two bodies, by their numbers.

    The second turns against the first by `angle` about `direction` through `point`, right-handed; `reach` is half
    the length of the hinge. A slide goes along its direction by `angle`, metres. `limits` are those of the joint,
    radians, None where there are none; `stiffness` and `rest` are those of its spring, `moment` one that acts always.
    """

    name: str
    joint: JointId
    first: int
    second: int
    point: Floats
    direction: Floats
    reach: float
    angle: float
    slide: bool = False
    limits: tuple[float, float] | None = None
    stiffness: float = 0.0
    rest: float = 0.0
    moment: float = 0.0

    def end(self, way: float) -> Floats:
        """Return an end of the hinge, float[3]: 1 along its direction, -1 against it."""
        return self.point + way * self.reach * self.direction


def springs_and_moments(hinges: Sequence[Hinge]) -> tuple[str, ...]:
    """Return how many hinges have springs, and how many have moments, for what a format does not hold."""
    springs, moments = sum(bool(hinge.stiffness) for hinge in hinges), sum(bool(hinge.moment) for hinge in hinges)
    return tuple(numbered(count, word) for count, word in ((springs, "spring"), (moments, "moment")) if count)


@dataclass(frozen=True, slots=True)
class TreeJoint:
    """A hinge of the tree: its number, the body that carries, the one carried, and 1 where that is the second."""

    hinge: int
    parent: int
    child: int
    sense: float
