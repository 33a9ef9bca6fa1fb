"""Wishes about sizes: boxes and radii of configurations, their ratios, the area of a sheet.

Theory: docs/theory/design.md.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from graphs.tolerances import DOUBLE
from synth.designing.poses import Derived, DesignFrame, DesignPoint, PosedDesign
from synth.designing.wishes import Goal, Wish, within_goal

Size = Literal["longest", "area", "radius"]
"""The longest edge of the box along principal axes, the product of its two longest, or the largest distance from the
middle."""


def _measured_size(which: Size, places: Derived, thickness: float) -> Derived:
    """Return the size of points, where the outermost ones are unique; edges are at least so long as the thickness."""
    points = places.values.reshape(-1, 3)
    count = len(points)
    centred = points - points.mean(axis=0)
    centring = (np.eye(count) - 1.0 / count)[:, None, :, None] * np.eye(3)[:, None, :]
    middle = centring.reshape(3 * count, 3 * count)
    if which == "radius":
        distances = np.linalg.norm(centred, axis=1)
        far = int(distances.argmax())
        along = centred[far] / distances[far]
        return places.through(np.array([distances[far]]), along[None] @ middle[3 * far : 3 * far + 3])
    values, axes = np.linalg.eigh(centred.T @ centred)
    edges, slopes = np.zeros(3), np.zeros((3, 3 * count))
    for place in range(3):
        along = centred @ axes[:, place]
        ends = (int(along.argmax()), int(along.argmin()))
        edges[place] = along[ends[0]] - along[ends[1]]
        slopes[place, 3 * ends[0] : 3 * ends[0] + 3] += axes[:, place]
        slopes[place, 3 * ends[1] : 3 * ends[1] + 3] -= axes[:, place]
        span = centred[ends[0]] - centred[ends[1]]
        for other in range(3):  # how the principal axis turns
            if other != place and abs(values[place] - values[other]) > DOUBLE.zero * values[2]:
                both = np.outer(axes[:, other], axes[:, place])
                turn = (centred @ (both + both.T)).ravel() / (values[place] - values[other])
                slopes[place] += (span @ axes[:, other]) * turn
        if edges[place] < thickness:
            edges[place], slopes[place] = thickness, 0.0
    slopes = slopes @ middle
    order = np.argsort(edges)[::-1]
    if which == "longest":
        return places.through(edges[order[:1]], slopes[order[:1]])
    first, second = order[:2]
    product = edges[second] * slopes[first] + edges[first] * slopes[second]
    return places.through(np.array([edges[first] * edges[second]]), product[None])


@dataclass(frozen=True, kw_only=True)
class BoxSize(Wish):
    """How large a configuration is: `longest`, `area` or `radius` of some points, by default all vertices.

    Attributes
    ----------
    at : str
        Name of a configuration.
    size_of : {"longest", "area", "radius"}
    goal : Goal
    points : tuple of DesignPoint
    thickness : float
        Edges of the box are at least so long.
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(BoxSize(at="stowed", size_of="radius", goal=Goal(at_most=1.0)))
    radius at stowed
    """

    size_of: Size
    goal: Goal
    points: tuple[DesignPoint, ...] = ()
    thickness: float = 0.0

    def check(self, frame: DesignFrame) -> None:
        """Check links and vertices."""
        for point in self.points or frame.all_vertices():
            frame.check_point(point)

    def scale(self, extent: float) -> float:
        """Return the unit of its misses."""
        return extent**2 if self.size_of == "area" else extent

    def missed(self, pose: PosedDesign) -> Derived:
        """Return how far the size is off."""
        points = self.points or pose.frame.all_vertices()
        return within_goal(self.goal, _measured_size(self.size_of, pose.places(points), self.thickness))

    def __str__(self) -> str:
        return f"{self.size_of} at {self.at}"


@dataclass(frozen=True, kw_only=True)
class SizeRatio(Wish):
    """The size at one configuration over that at another: stowed over deployed.

    Attributes
    ----------
    at : str
        Name of a configuration.
    over : str
        Name of the other configuration.
    size_of : {"longest", "area", "radius"}
    goal : Goal
    points : tuple of DesignPoint
    thickness : float
        Edges of the box are at least so long.
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(SizeRatio(at="stowed", over="deployed", size_of="area", goal=Goal(at_most=0.2)))
    area at stowed over deployed
    """

    over: str
    size_of: Size
    goal: Goal
    points: tuple[DesignPoint, ...] = ()
    thickness: float = 0.0

    @property
    def configurations(self) -> tuple[str, ...]:
        """Both configurations."""
        return (self.at, self.over)

    def check(self, frame: DesignFrame) -> None:
        """Check links and vertices."""
        for point in self.points or frame.all_vertices():
            frame.check_point(point)

    def misses(self, poses: Mapping[str, PosedDesign]) -> dict[str, Derived]:
        """Return how far the ratio is off, by both configurations."""
        points = self.points or poses[self.at].frame.all_vertices()
        one, other = (
            _measured_size(self.size_of, poses[name].places(points), self.thickness) for name in self.configurations
        )
        ratio = one.values / other.values
        off = self.goal.misses(ratio)
        on = 1.0 if self.goal.equals is not None else (off != 0.0).astype(float)
        by = (on / other.values)[:, None]
        less = -by * ratio[:, None]
        numbers = by * one.by_numbers + less * other.by_numbers
        return {
            self.at: Derived(off, by * one.by_angles, numbers),
            self.over: Derived(off, less * other.by_angles, np.zeros_like(numbers)),
        }

    def __str__(self) -> str:
        return f"{self.size_of} at {self.at} over {self.over}"


@dataclass(frozen=True, kw_only=True)
class SheetArea(Wish):
    """The area of the panels of a sheet, all together.

    Attributes
    ----------
    at : str
        Name of a configuration.
    goal : Goal
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(SheetArea(goal=Goal(at_most=4.0)))
    area of material
    """

    goal: Goal
    unit = "area"

    @property
    def configurations(self) -> tuple[str, ...]:
        """None: it is the same at all."""
        return ()

    def check(self, frame: DesignFrame) -> None:
        """Check that there are panels."""
        frame.all_vertices()

    def missed(self, pose: PosedDesign) -> Derived:
        """Return how far the area is off."""
        sheet = pose.frame.family.sheet
        assert sheet is not None
        vertices, extent = pose.design.vertices, pose.frame.extent
        slope, total = np.zeros((len(vertices), 3)), 0.0
        for face in sheet.faces:
            around = list(face)
            after, before = around[1:] + around[:1], around[-1:] + around[:-1]
            vector = np.cross(vertices[around], vertices[after]).sum(axis=0) / 2.0
            size = float(np.linalg.norm(vector))
            total += size
            slope[around] += np.cross(vertices[after] - vertices[before], vector / size) / 2.0
        by = extent**2 * np.einsum("vi,vin->n", slope, pose.design.by_vertices)
        none = np.zeros((1, len(pose.angles)))
        return within_goal(self.goal, Derived(np.array([extent**2 * total]), none, by[None]))

    def __str__(self) -> str:
        return "area of material"
