"""Rigid bodies made of plates and round bars, and the hinges between them, in metres and kilograms.

Panels are plates of a thickness about their plane; links that are known by their axes only are bars between their
hinges. Where shapes of one body overlap, both count.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from graphs.geometry import unit
from graphs.types import Floats, JointId, LinkId
from synth.templates.unfolding import Plane


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


Shape: TypeAlias = Plate | Bar


@dataclass(frozen=True, eq=False)
class Body:
    """A link: its name in files, the number of its body, its shapes and its mass."""

    name: str
    link: LinkId
    shapes: tuple[Shape, ...]
    properties: MassProperties


@dataclass(frozen=True, eq=False)
class Hinge:
    """A joint between two bodies, by their numbers.

    The second turns against the first by `angle` about `direction` through `point`, right-handed; `reach` is half
    the length of the hinge. A slide goes along its direction by `angle`, metres. `limits` are those of the joint,
    radians, None where there are none; `stiffness` and `rest` are those of its spring.
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

    def end(self, way: float) -> Floats:
        """Return an end of the hinge, float[3]: 1 along its direction, -1 against it."""
        return self.point + way * self.reach * self.direction


@dataclass(frozen=True, slots=True)
class TreeJoint:
    """A hinge of the tree: its number, the body that carries, the one carried, and 1 where that is the second."""

    hinge: int
    parent: int
    child: int
    sense: float
