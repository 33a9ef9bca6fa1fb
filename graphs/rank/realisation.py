"""A random realisation of a type: centres and joint axes placed at random, as general as the type allows.

A joint axis passes through the centres of the classes of its loops. Three centres on one axis are in line, so
later ones are placed on the lines that earlier ones fix. Points are homogeneous (x, y, z, w), w = 0 for a centre
at infinity; axes are Pluecker lines (u, p x u). An SCD graph is placed with its vertices: its *forced geometry*.
Over a prime field of about 2^61 numbers a realisation has the generic rank but for a probability of about (number
of joints) / 2^58 (Schwartz 1980), and never a larger one. Theory: docs/theory/exact-mobility.md.
"""

import random
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from graphs.errors import UnsolvableError
from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph, points_of_joints
from graphs.tolerances import DOUBLE
from graphs.types import JointId

PRIMES = (2**61 - 1, 2**61 - 31)
"""The two largest primes below 2^61: random choices are special with a chance of degree / prime, under 1e-14 for
degrees of a few thousand, and two primes have to agree, since a rank may fall modulo one of them."""


class Field(Protocol):
    """Numbers that are added, multiplied, drawn at random, inverted, and compared with zero."""

    def random(self) -> Any:
        """Return a random number."""

    def reduce(self, value: Any) -> Any:
        """Return the number in its normal form."""

    def inverse(self, value: Any) -> Any:
        """Return 1 / value."""

    def is_zero(self, value: Any) -> bool:
        """Return whether a number in normal form is zero."""


class PrimeField:
    """The integers modulo a prime; the same seed gives the same realisation."""

    def __init__(self, prime: int, seed: int = 0) -> None:
        self.prime = prime
        self._random = random.Random(f"{prime} {seed}")

    def random(self) -> int:
        """Return a random number other than 0."""
        return self._random.randrange(1, self.prime)

    def reduce(self, value: int) -> int:
        """Return the remainder."""
        return value % self.prime

    def inverse(self, value: int) -> int:
        """Return the number whose product with this one is 1."""
        return pow(value, -1, self.prime)

    def is_zero(self, value: int) -> bool:
        """Return whether a remainder is zero."""
        return value == 0


class Reals:
    """Floating-point numbers; random ones are normally distributed, the same for the same seed."""

    def __init__(self, seed: int = 0) -> None:
        self._random = random.Random(seed)

    def random(self) -> float:
        """Return a random number."""
        return self._random.gauss(0.0, 1.0)

    def reduce(self, value: float) -> float:
        """Return the number itself."""
        return value

    def inverse(self, value: float) -> float:
        """Return the reciprocal."""
        return 1.0 / value

    def is_zero(self, value: float) -> bool:
        """Return whether a number of the size of coordinates is rounded zero."""
        return abs(value) < DOUBLE.zero


def null_vectors(rows: Sequence[Sequence[Any]], field: Field) -> list[list[Any]]:
    """Return a basis of the vectors that all rows of a small matrix annihilate."""
    work = [list(row) for row in rows]
    columns = len(work[0])
    pivots: list[int] = []
    for column in range(columns):
        row = len(pivots)
        best = max(range(row, len(work)), key=lambda i: abs(work[i][column]), default=None)
        if best is None or field.is_zero(work[best][column]):
            continue
        work[row], work[best] = work[best], work[row]
        scale = field.inverse(work[row][column])
        work[row] = [field.reduce(value * scale) for value in work[row]]
        for i in range(len(work)):
            if i != row and not field.is_zero(work[i][column]):
                factor = work[i][column]
                work[i] = [field.reduce(a - factor * b) for a, b in zip(work[i], work[row], strict=True)]
        pivots.append(column)
    basis = []
    for free in range(columns):
        if free not in pivots:
            vector: list[Any] = [0] * columns
            vector[free] = 1
            for row, column in enumerate(pivots):
                vector[column] = field.reduce(-work[row][free])
            basis.append(vector)
    return basis


Point = tuple[Any, Any, Any, Any]
Line = tuple[tuple[Any, Any, Any], tuple[Any, Any, Any]]

# Orders of placing points that are tried: as they come, those on busy axes first, then each begun one point on. What
# fits in none is refused, not answered, so more attempts cost time only where there is no answer.
_ATTEMPTS = 24


@dataclass(frozen=True, slots=True)
class Incidence:
    """Points, by the joints whose axes pass through each and whether it lies at infinity; and all joints."""

    joints: tuple[JointId, ...]
    points: tuple[tuple[frozenset[JointId], bool], ...]


@dataclass(frozen=True, slots=True)
class GenericRealisation:
    """Points (x, y, z, w) in the order of the incidence, and the axis of each joint: (u, p x u)."""

    points: tuple[Point, ...]
    axes: Mapping[JointId, Line]


def incidence_of(mechanism: SCGraph, *, forced: bool = True) -> Incidence:
    """Return which points lie on which axes: the centres, and for an SCD graph, if it is forced, its vertices.

    The points come in the order of ``mechanism.centre_classes()``, then the vertices that are no centres.
    """
    classes = mechanism.centre_classes()
    points = [(one.joints, one.centre is Centre.INFINITE) for one in classes]
    if forced and isinstance(mechanism, SCDGraph):
        through: dict[int, set[JointId]] = defaultdict(set)
        for joint, here in points_of_joints(mechanism.drawing, mechanism.centre_classes()).items():
            for point in here:
                through[point].add(joint)
        known = {joints for joints, _ in points}
        # A vertex on a single axis is free on it, and a centre is there already.
        points += [
            (frozenset(joints), False)
            for joints in through.values()
            if len(joints) > 1 and frozenset(joints) not in known
        ]
    return Incidence(tuple(mechanism.joints), tuple(points))


def realise(mechanism: SCGraph, field: Field, *, forced: bool = True) -> GenericRealisation:
    """Place a random realisation of the type of an SC or SCD graph, whose vertices are placed too if it is forced.

    Raises `UnsolvableError` if centres that must lie in line could not be placed: the type is not realised.
    """
    return realise_points(incidence_of(mechanism, forced=forced), field)


def realise_points(incidence: Incidence, field: Field) -> GenericRealisation:
    """Place points and axes; raises `UnsolvableError` if points that must lie in line could not be placed."""
    order = list(range(len(incidence.points)))
    for attempt in range(_ATTEMPTS):
        points = _place(incidence, order, field)
        if points is not None:
            return GenericRealisation(points, _axes(incidence, points, field))
        if attempt == 0:
            busy = _on_axis(incidence)
            order.sort(key=lambda i: -sum(len(busy[joint]) > 2 for joint in incidence.points[i][0]))
        else:
            order = order[1:] + order[:1]
    raise UnsolvableError(
        "not realised: centres that one axis passes through must lie in line, and could not be placed so"
    )


def _on_axis(incidence: Incidence) -> dict[JointId, list[int]]:
    points_on: dict[JointId, list[int]] = defaultdict(list)
    for index, (joints, _) in enumerate(incidence.points):
        for joint in joints:
            points_on[joint].append(index)
    return points_on


def _place(incidence: Incidence, order: Sequence[int], field: Field) -> tuple[Point, ...] | None:
    """Place points in an order, each on the axes that two earlier ones fix; None if one has no place."""
    placed: dict[int, Point] = {}
    on_axis: dict[JointId, list[int]] = defaultdict(list)
    for index in order:
        joints, infinite = incidence.points[index]
        lines = {tuple(on_axis[joint][:2]) for joint in joints if len(on_axis[joint]) >= 2}
        point = _on_lines([(placed[a], placed[b]) for a, b in sorted(lines)], infinite, field)
        if point is None:
            return None
        placed[index] = point
        for joint in joints:
            on_axis[joint].append(index)
    return tuple(placed[i] for i in range(len(incidence.points)))


def _on_lines(lines: Sequence[tuple[Point, Point]], infinite: bool, field: Field) -> Point | None:
    """Return a random point on all of some lines, each through two points; None if there is none."""
    if not lines:
        x, y, z = (field.random() for _ in range(3))
        return (x, y, z, 0 if infinite else 1)
    p, q = lines[0]
    # a p + b q, to lie on each further line, and at infinity where it should
    conditions = [[p[3], q[3]]] if infinite else []
    for r, s in lines[1:]:
        columns = [[p[k], q[k], r[k], s[k]] for k in range(4)]
        meeting = [vector[:2] for vector in null_vectors(columns, field)]
        if not meeting:
            return None
        if len(meeting) == 1:
            a, b = meeting[0]
            conditions.append([field.reduce(-b), a])
    choices = null_vectors(conditions, field) if conditions else [[1, 0], [0, 1]]
    if not choices:
        return None
    weights = [field.random() for _ in choices]
    a, b = (field.reduce(sum(w * choice[k] for w, choice in zip(weights, choices, strict=True))) for k in (0, 1))
    point = tuple(field.reduce(a * p[k] + b * q[k]) for k in range(4))
    if all(field.is_zero(value) for value in point) or (field.is_zero(point[3]) and not infinite):
        return None
    return (point[0], point[1], point[2], point[3])


def _axes(incidence: Incidence, points: Sequence[Point], field: Field) -> dict[JointId, Line]:
    through = _on_axis(incidence)
    axes = {}
    for joint in incidence.joints:
        ends = [points[i] for i in through[joint][:2]]
        while len(ends) < 2:
            ends.append((field.random(), field.random(), field.random(), 1))
        axes[joint] = join(ends[0], ends[1], field)
    return axes


def join(p: Sequence[Any], q: Sequence[Any], field: Field) -> Line:
    """Return the Pluecker line of two homogeneous points: direction u, and moment of a point on it."""
    u = tuple(field.reduce(p[3] * q[k] - q[3] * p[k]) for k in range(3))
    m = tuple(field.reduce(p[i] * q[j] - p[j] * q[i]) for i, j in ((1, 2), (2, 0), (0, 1)))
    return (u[0], u[1], u[2]), (m[0], m[1], m[2])
