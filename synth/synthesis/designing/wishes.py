"""Wishes about a mechanism: what is measured at which configurations, and what it should be.

A wish measures numbers at one or two named configurations (`pose` is that of the file), with derivatives. They are to
be equal to goals, or at most or at least so large; a miss is counted in radians, or in parts of the extent. Angles are
radians, lengths in the unit of the file. Theory: docs/theory/design.md.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import asin, inf, sqrt
from typing import ClassVar, Literal

import numpy as np

from graphs.errors import InvariantError
from graphs.geometry import unit
from graphs.types import Floats
from synth.synthesis.designing.placement import Derived, DesignConfiguration, DesignFrame, DesignPoint, stacked
from synth.synthesis.designing.targets import Target

POSE = "pose"
"""Name of the configuration of the file."""

Unit = Literal["angle", "length", "area", "number"]


@dataclass(frozen=True, slots=True)
class Goal:
    """What numbers should be: equal to a value, or within limits.

    Attributes
    ----------
    equals, at_least, at_most : float or None
        `InvariantError` if all are None, or the limits contradict each other.

    Examples
    --------
    >>> Goal(at_least=1.0).misses(np.array([0.25, 3.0])).tolist()
    [-0.75, 0.0]
    """

    equals: float | None = None
    at_least: float | None = None
    at_most: float | None = None

    def __post_init__(self) -> None:
        if self.equals is None and self.at_least is None and self.at_most is None:
            raise InvariantError("goal", "a wish without a goal", "equals, at_least or at_most")
        if (self.at_least if self.at_least is not None else -inf) > (self.at_most if self.at_most is not None else inf):
            wrong = f"at least {self.at_least:g} and at most {self.at_most:g} contradict each other"
            raise InvariantError("goal", wrong, "the smaller one first")

    @property
    def limits(self) -> tuple[float, float]:
        """The least and the largest number that meets it."""
        if self.equals is not None:
            return self.equals, self.equals
        return (-inf if self.at_least is None else self.at_least, inf if self.at_most is None else self.at_most)

    def excludes(self, other: Goal) -> bool:
        """Whether no number meets both."""
        return max(self.limits[0], other.limits[0]) > min(self.limits[1], other.limits[1])

    def misses(self, values: Floats) -> Floats:
        """Return by how much numbers miss the goal: 0 within limits."""
        if self.equals is not None:
            return values - self.equals
        low = values - (-inf if self.at_least is None else self.at_least)
        high = values - (inf if self.at_most is None else self.at_most)
        return np.asarray(np.minimum(low, 0.0) + np.maximum(high, 0.0))


@dataclass(frozen=True, kw_only=True)
class Wish:
    """What wishes have in common.

    Attributes
    ----------
    at : str
        Name of a configuration.
    weight : float
        Misses are multiplied by it in the search, not in reports.
    unit : {"angle", "length", "area", "number"}
        What is measured.

    Examples
    --------
    >>> Wish(at="open").configurations
    ('open',)
    """

    at: str = POSE
    weight: float = 1.0
    unit: ClassVar[Unit] = "number"

    @property
    def configurations(self) -> tuple[str, ...]:
        """Names of the configurations that it measures."""
        return (self.at,)

    def check(self, frame: DesignFrame) -> None:
        """Raise `InvariantError` if it names a joint, link or vertex that is not there."""

    def contradicts(self, other: Wish) -> bool:
        """Whether a wish that is named alike cannot be met together with it."""
        mine, goal = getattr(self, "goal", None), getattr(other, "goal", None)
        if mine is None or goal is None:
            return replace(other, weight=self.weight) != self
        alike = replace(other, weight=self.weight, goal=mine)  # type: ignore[call-arg]
        return alike == self and bool(mine.excludes(goal))

    def misses(self, configurations: Mapping[str, DesignConfiguration]) -> dict[str, Derived]:
        """Return by how much it misses, at one configuration, or the parts by each of several.

        Values are the same for all; derivatives by numbers stand with the first.
        """
        return {self.at: self.missed(configurations[self.at])}

    def missed(self, configuration: DesignConfiguration) -> Derived:
        """Return by how much it misses at its configuration."""
        raise NotImplementedError

    def size(self, values: Floats) -> float:
        """Return the largest miss of values, radians or in the unit of the file."""
        return float(np.abs(values).max(initial=0.0))

    def scale(self, extent: float) -> float:
        """Return what its misses are divided by in the search."""
        return {"length": extent, "area": extent**2}.get(self.unit, 1.0)

    def __str__(self) -> str:
        return type(self).__name__


@dataclass(frozen=True, kw_only=True)
class GoalWish(Wish):
    """A wish about one measure: what it should be.

    Attributes
    ----------
    at : str
        Name of a configuration.
    goal : Goal
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> GoalWish(goal=Goal(equals=1.0)).goal.limits
    (1.0, 1.0)
    """

    goal: Goal

    def measured(self, configuration: DesignConfiguration) -> Derived:
        """Return what is measured at its configuration."""
        raise NotImplementedError

    def missed(self, configuration: DesignConfiguration) -> Derived:
        """Return by how much the measure is off; within limits it has no derivatives."""
        measured = self.measured(configuration)
        off = self.goal.misses(measured.values)
        slopes = np.ones(len(off)) if self.goal.equals is not None else (off != 0.0).astype(float)
        return Derived(off, slopes[:, None] * measured.by_angles, slopes[:, None] * measured.by_numbers)


@dataclass(frozen=True, kw_only=True)
class ShapeWish(Wish):
    """A wish about dimensions alone: it is the same at all configurations.

    Examples
    --------
    >>> ShapeWish().configurations
    ()
    """

    @property
    def configurations(self) -> tuple[str, ...]:
        """None: it is the same at all."""
        return ()


@dataclass(frozen=True, kw_only=True)
class PointsWish(Wish):
    """A wish about several points, by default all vertices of a sheet.

    Attributes
    ----------
    at : str
        Name of a configuration.
    points : tuple of DesignPoint
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> PointsWish().points
    ()
    """

    points: tuple[DesignPoint, ...] = ()

    def check(self, frame: DesignFrame) -> None:
        """Check links and vertices."""
        for point in self.measured_points(frame):
            frame.check_point(point)

    def measured_points(self, frame: DesignFrame) -> Sequence[DesignPoint]:
        """Return the points; `UnsolvableError` without any, if it has no vertices."""
        return self.points or frame.all_vertices()


def _angle_of(chord: Floats) -> float:
    """Return the angle, radians, of which a vector of the length 2 sin(angle / 2) is the chord."""
    return 2.0 * asin(min(1.0, float(np.linalg.norm(chord)) / 2.0))


@dataclass(frozen=True, kw_only=True)
class LinkOrientation(Wish):
    """The orientation of a link, from where it is in the file: a unit quaternion, scalar first.

    Attributes
    ----------
    at : str
        Name of a configuration.
    link : str
    quaternion : (float, float, float, float)
        Of any norm but 0.
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(LinkOrientation(at="open", link="2", quaternion=(1, 0, 0, 0)))
    orientation of link 2 at open
    """

    link: str
    quaternion: tuple[float, float, float, float]
    unit = "angle"

    def check(self, frame: DesignFrame) -> None:
        """Check the link and the quaternion."""
        frame.row(self.link)
        if not np.linalg.norm(self.quaternion) > 0.0:
            raise InvariantError("quaternion", "a quaternion of norm 0", "a unit quaternion")

    @property
    def matrix(self) -> Floats:
        """The rotation, float[3, 3]."""
        w, x, y, z = np.array(self.quaternion, dtype=float) / np.linalg.norm(self.quaternion)
        cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        return np.asarray(np.eye(3) + 2.0 * w * cross + 2.0 * cross @ cross)

    def missed(self, configuration: DesignConfiguration) -> Derived:
        """Return the difference of rotation matrices: its norm is 2 sin(angle / 2) of the rotation between them."""
        off = configuration.rotation(configuration.frame.row(self.link))
        return off.through((off.values - self.matrix.ravel()) / sqrt(2.0), np.eye(9) / sqrt(2.0))

    def size(self, values: Floats) -> float:
        """Return the angle of the rotation between the orientations."""
        return _angle_of(values)

    def __str__(self) -> str:
        return f"orientation of link {self.link} at {self.at}"


@dataclass(frozen=True, kw_only=True)
class LinkDirection(Wish):
    """Where a direction of a link, by its place in the file, points.

    Attributes
    ----------
    at : str
        Name of a configuration.
    link : str
    vector : (float, float, float)
        The direction in the file.
    equals : (float, float, float)
        Where it is to point.
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(LinkDirection(at="open", link="2", vector=(1, 0, 0), equals=(0, 0, 1)))
    direction of link 2 at open
    """

    link: str
    vector: tuple[float, float, float]
    equals: tuple[float, float, float]
    unit = "angle"

    def check(self, frame: DesignFrame) -> None:
        """Check the link and both vectors."""
        frame.row(self.link)
        if not (np.any(self.vector) and np.any(self.equals)):
            raise InvariantError("direction", "a direction of length 0", "a vector that is not zero")

    def missed(self, configuration: DesignConfiguration) -> Derived:
        """Return the difference of unit vectors."""
        numbers = configuration.design.dependence.twists.shape[1]
        there = configuration.direction(configuration.frame.row(self.link), unit(self.vector), np.zeros((3, numbers)))
        return there.through(there.values - unit(self.equals), np.eye(3))

    def size(self, values: Floats) -> float:
        """Return the angle between the directions."""
        return _angle_of(values)

    def __str__(self) -> str:
        return f"direction of link {self.link} at {self.at}"


@dataclass(frozen=True, kw_only=True)
class JointAngle(Wish):
    """The angle of a joint, radians: of a crease from flat, of others from the configuration of the file.

    Attributes
    ----------
    at : str
        Name of a configuration.
    joint : str
    goal : Goal
        Radians.
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(JointAngle(at="open", joint="3", goal=Goal(at_least=0.5)))
    angle of joint 3 at open
    """

    joint: str
    goal: Goal
    unit = "angle"

    def check(self, frame: DesignFrame) -> None:
        """Check the joint."""
        frame.joint(self.joint)

    def off(self, angle: float) -> float:
        """Return how far an angle is off, radians; an equal one is off by its nearest turn."""
        off = float(self.goal.misses(np.array([angle]))[0])
        return float(np.remainder(off + np.pi, 2.0 * np.pi) - np.pi) if self.goal.equals is not None else off

    def missed(self, configuration: DesignConfiguration) -> Derived:
        """Return how far the angle is off."""
        angle = configuration.angle(configuration.frame.joint(self.joint))
        off = np.array([self.off(float(angle.values[0]))])
        return angle.through(off, np.diag((off != 0.0) | (self.goal.equals is not None)).astype(float))

    def __str__(self) -> str:
        return f"angle of joint {self.joint} at {self.at}"


@dataclass(frozen=True, kw_only=True)
class PointPlace(Wish):
    """Where a point is; coordinates that are None may be anything.

    Attributes
    ----------
    at : str
        Name of a configuration.
    point : DesignPoint
    equals : (float or None, float or None, float or None)
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(PointPlace(at="open", point=DesignPoint(vertex=4), equals=(1.0, None, 0.0)))
    place of vertex 4 at open
    """

    point: DesignPoint
    equals: tuple[float | None, float | None, float | None]
    unit = "length"

    def check(self, frame: DesignFrame) -> None:
        """Check the link or vertex."""
        frame.check_point(self.point)

    def contradicts(self, other: Wish) -> bool:
        """Whether a coordinate is given twice, differently."""
        pairs = zip(self.equals, other.equals, strict=True) if isinstance(other, PointPlace) else ()
        return any(one is not None and two is not None and one != two for one, two in pairs)

    def missed(self, configuration: DesignConfiguration) -> Derived:
        """Return the difference of the coordinates that are given."""
        there = configuration.places([self.point])
        given = [axis for axis in range(3) if self.equals[axis] is not None]
        wanted = np.array([self.equals[axis] for axis in given], dtype=float)
        return there.through(there.values[given] - wanted, np.eye(3)[given])

    def __str__(self) -> str:
        return f"place of {self.point} at {self.at}"


@dataclass(frozen=True, kw_only=True)
class PointDistance(GoalWish):
    """The distance between two points.

    Attributes
    ----------
    at : str
        Name of a configuration.
    points : (DesignPoint, DesignPoint)
    goal : Goal
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(PointDistance(points=(DesignPoint(vertex=0), DesignPoint(vertex=4)), goal=Goal(equals=1.0)))
    distance of vertex 0 and vertex 4 at pose
    """

    points: tuple[DesignPoint, DesignPoint]
    unit = "length"

    def check(self, frame: DesignFrame) -> None:
        """Check links and vertices."""
        for point in self.points:
            frame.check_point(point)

    def measured(self, configuration: DesignConfiguration) -> Derived:
        """Return the distance; of points in one place its derivative is zero."""
        both = configuration.places(self.points)
        along = both.values[3:] - both.values[:3]
        size = float(np.linalg.norm(along))
        direction = along / size if size > 0.0 else along
        return both.through(np.array([size]), np.concatenate([-direction, direction])[None])

    def __str__(self) -> str:
        return f"distance of {self.points[0]} and {self.points[1]} at {self.at}"


@dataclass(frozen=True, kw_only=True)
class PointsOn(PointsWish):
    """Points that lie on a surface or path (`synth.synthesis.designing.targets`); by default all vertices.

    Attributes
    ----------
    at : str
        Name of a configuration.
    target : Target
    points : tuple of DesignPoint
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> from synth.synthesis.designing.targets import Formula
    >>> print(PointsOn(at="open", target=Formula("x**2 + y**2 + z**2 - 1")))
    vertices on x**2 + y**2 + z**2 - 1 at open
    """

    target: Target
    unit = "length"

    def missed(self, configuration: DesignConfiguration) -> Derived:
        """Return how far each point is from the target, to first order."""
        points = self.measured_points(configuration.frame)
        there = configuration.places(points)
        off, slopes = self.target.missed(there.values.reshape(-1, 3))
        rows = off.shape[1]
        by = np.zeros((len(points) * rows, len(there.values)))
        for place in range(len(points)):
            by[place * rows : (place + 1) * rows, 3 * place : 3 * place + 3] = slopes[place]
        return there.through(off.ravel(), by)

    def __str__(self) -> str:
        which = ", ".join(map(str, self.points)) if self.points else "vertices"
        return f"{which} on {self.target} at {self.at}"


@dataclass(frozen=True, kw_only=True)
class TransmissionAngle(Wish):
    """The angle between the arcs of two links at their joint, 0 to pi/2 from its nearest dead position, radians.

    The joints `near` and `far` are on the two links; the angle is that between the planes through their axes and that
    of the joint. Of a four-bar with a driven crank it is the transmission angle at the joint of coupler and follower.

    Attributes
    ----------
    at : str
        Name of a configuration.
    near, joint, far : str
    at_least : float
        Radians.
    weight : float
        As of `Wish`.

    Examples
    --------
    >>> print(TransmissionAngle(at="open", near="1", joint="2", far="3", at_least=0.7))
    transmission angle at joint 2 at open
    """

    near: str
    joint: str
    far: str
    at_least: float
    unit = "angle"

    def check(self, frame: DesignFrame) -> None:
        """Check the joints."""
        for name in (self.near, self.joint, self.far):
            frame.joint(name)

    def contradicts(self, other: Wish) -> bool:
        """Never: the larger of two least angles meets both."""
        return False

    def missed(self, configuration: DesignConfiguration) -> Derived:
        """Return how far the angle is below its least value."""
        frame = configuration.frame
        near, axis, far = (configuration.axis(frame.joint(name)) for name in (self.near, self.joint, self.far))
        both = stacked([near, axis, far])
        angle, slope = _dihedral(near.values, axis.values, far.values)
        folded = angle if angle <= np.pi / 2 else np.pi - angle
        sign = 1.0 if angle <= np.pi / 2 else -1.0
        off = Goal(at_least=self.at_least).misses(np.array([folded]))
        return both.through(off, sign * slope[None] * (off != 0.0))

    def __str__(self) -> str:
        return f"transmission angle at joint {self.joint} at {self.at}"


def _dihedral(a: Floats, k: Floats, b: Floats) -> tuple[float, Floats]:
    """Return the angle, 0 to pi, between planes (a, k) and (k, b), k a unit vector, and its gradient by all three."""
    m, n = np.cross(a, k), np.cross(k, b)
    sine_vector = np.cross(m, n)
    sine, cosine = float(sine_vector @ k), float(m @ n)
    angle = np.arctan2(sine, cosine)
    square = sine**2 + cosine**2
    # sine = k . (m x n), cosine = m . n
    by_m = (cosine * np.cross(n, k) - sine * n) / square
    by_n = (cosine * np.cross(k, m) - sine * m) / square
    by_k = cosine * sine_vector / square
    by_a = np.cross(k, by_m)
    by_b = np.cross(by_n, k)
    by_k = by_k + np.cross(by_m, a) + np.cross(b, by_n)
    sign = 1.0 if angle >= 0.0 else -1.0
    return float(abs(angle)), sign * np.concatenate([by_a, by_k, by_b])


@dataclass(frozen=True)
class WishedConfiguration:
    """A configuration that the design is to have.

    Attributes
    ----------
    name : str
    inputs : mapping of str to float
        Joints whose angles are given, radians.

    Examples
    --------
    >>> WishedConfiguration("open", {"0": 1.5}).name
    'open'
    """

    name: str
    inputs: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Wishes:
    """All wishes about a mechanism, and what of it may change.

    Attributes
    ----------
    wishes : tuple of Wish
    configurations : tuple of WishedConfiguration
        In the order in which the driven joint passes them.
    rules : tuple of Wish
        What must hold, whatever else is missed.
    driver : str or None
        The driven joint; by default that of the first given input, any if a configuration gives all joints, else one of
        the fixed link.
    fixed : tuple of str
        Dimensions that stay.
    parameters : mapping of str to float
        Of a generator, to begin with, radians.
    bounds : mapping of str to (float, float)
        The least and largest value of parameters, or azimuths and the cone angle, radians or lengths.
    flat_foldable : bool
        Keep a flat sheet flat-foldable, and of vertices of four creases let ratios agree round panels.
    closed_form : bool
        Of a sheet that begins as Miura's: change corners and lengths on two sides, from which the others follow.
    in_order : bool
        Configurations are passed in their order.
    between : int
        Closed configurations that are put between each and the next, and at first kept near to each other: so that a
        motion leads from one to the next.
    from_start : bool
        Whether the motion through the configurations begins at that of the file, even if no wish names it. A flat sheet
        is singular and no such configuration: many branches meet there.

    Examples
    --------
    >>> Wishes((JointAngle(at="open", joint="1", goal=Goal(equals=0.3)),), (WishedConfiguration("open"),)).names
    ('pose', 'open')
    """

    wishes: tuple[Wish, ...]
    configurations: tuple[WishedConfiguration, ...] = ()
    rules: tuple[Wish, ...] = ()
    driver: str | None = None
    fixed: tuple[str, ...] = ()
    parameters: Mapping[str, float] = field(default_factory=dict)
    bounds: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    flat_foldable: bool = False
    closed_form: bool = False
    in_order: bool = True
    between: int = 0
    from_start: bool = False

    def __post_init__(self) -> None:
        if len(set(self.names)) < len(self.names):
            raise InvariantError("configurations", "two configurations have one name", "different names")
        for wish in (*self.wishes, *self.rules):
            for name in wish.configurations:
                if name not in self.names:
                    listed = ", ".join(self.names)
                    raise InvariantError("wish", f"there is no configuration {name!r} ({wish})", f"one of {listed}")

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the configurations, that of the file first."""
        return (POSE, *(one.name for one in self.configurations))


def check_wishes(wishes: Wishes, frame: DesignFrame) -> None:
    """Raise `InvariantError` for a joint, link or vertex that is not there."""
    for wish in (*wishes.wishes, *wishes.rules):
        wish.check(frame)
    for one in wishes.configurations:
        for joint in one.inputs:
            frame.joint(joint)
    if wishes.driver is not None:
        frame.joint(wishes.driver)
