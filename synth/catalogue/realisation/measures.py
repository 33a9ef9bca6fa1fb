"""Angles and lengths of a drawn pattern with their derivatives, its crossings, and the shape of its panels.

Theory: docs/theory/realisation.md.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from graphs.errors import numbered
from graphs.geometry import angles_between
from graphs.mechanism.precision import extent_of, off_panel_planes
from graphs.mechanism.sheet import Sheet
from graphs.plain_data import fields_to_json
from graphs.tolerances import DOUBLE
from graphs.types import Floats, Ints
from synth.catalogue.realisation.pattern import Pattern

_TURNS = np.array([[[-1.0, 1.0]], [[1.0, -1.0]]])
"""Signs of (y, x), by which the arms of a corner are turned outward."""


def corner_angles(places: Floats, corners: Ints) -> tuple[Floats, Floats]:
    """Return the angle of each corner, in (-pi, pi], and its derivatives, float[K, 2 V].

    Corners, int64[K, 3], are vertices before, at and after, counter-clockwise. The angle is negative where the
    corner is turned over.
    """
    ends = places[corners.T]
    arms = ends[::2] - ends[1]
    (back_x, back_y), (on_x, on_y) = arms[0].T, arms[1].T
    angles = np.arctan2(on_x * back_y - on_y * back_x, on_x * back_x + on_y * back_y)
    by_ends = arms[:, :, ::-1] * _TURNS / (arms**2).sum(axis=2)[:, :, None]
    derivatives = np.zeros((len(corners), len(places), 2))
    rows = np.arange(len(corners))
    derivatives[rows, corners[:, 0]], derivatives[rows, corners[:, 2]] = by_ends
    derivatives[rows, corners[:, 1]] = -by_ends[0] - by_ends[1]
    return angles, derivatives.reshape(len(corners), -1)


def edge_lengths(places: Floats, edges: Ints) -> tuple[Floats, Floats]:
    """Return the logarithm of the length of each edge, float[E], and its derivatives, float[E, 2 V]."""
    along = places[edges[:, 1]] - places[edges[:, 0]]
    squares = (along**2).sum(axis=1)
    derivatives = np.zeros((len(edges), len(places), 2))
    rows = np.arange(len(edges))
    derivatives[rows, edges[:, 1]] = along / squares[:, None]
    derivatives[rows, edges[:, 0]] = -along / squares[:, None]
    return np.log(squares) / 2, derivatives.reshape(len(edges), -1)


def is_drawn(pattern: Pattern, angles: Floats) -> bool:
    """Check that panels are strictly convex where they can be, lie one way up, and go once round inner vertices.

    The angles of the corners are those of `opened_angles`.
    """
    if not (np.isfinite(angles).all() and angles.min() > 0.0 and (angles < pattern.widest).all()):
        return False
    turns = np.bincount(pattern.panel_of_corner, angles) - pattern.turns_of_panels
    inner = pattern.sums_at_inner @ angles - 2 * np.pi
    return bool(max(np.abs(turns).max(), np.abs(inner).max(initial=0.0)) < DOUBLE.same_configuration)


def opened_angles(pattern: Pattern, places: Floats) -> tuple[Floats, Floats]:
    """Return the angles of all corners, up to 360 degrees in panels that cannot be convex, and derivatives.

    Radians, negative where a corner is turned over; derivatives are float[K, 2 V].
    """
    angles, jacobian = corner_angles(places, pattern.corners)
    return np.where((angles < 0.0) & (pattern.widest > np.pi), angles + 2 * np.pi, angles), jacobian


@dataclass(frozen=True, slots=True, kw_only=True)
class _Worst:
    """Of panels that can just be cut and folded by hand."""

    angle: float
    edge_ratio: float


_WORST = _Worst(
    angle=float(np.radians(15.0)),  # sharper corners tear, and are hard to draw legibly
    edge_ratio=0.15,  # shorter edges are creases that can hardly be folded beside the longest one
)


def first_order_freedoms(freedoms: int | None) -> str:
    """Return a number of infinitesimal degrees of freedom in words; None if it is unknown."""
    several = "infinitesimal degrees of freedom"
    if freedoms is None:
        return f"an unknown number of {several}"
    return numbered(freedoms, "infinitesimal degree of freedom", several)


@dataclass(frozen=True, slots=True)
class ShapeFigures:
    """Shape of the panels.

    Angles are those of their corners, radians, more than pi where one is bent inward. The edge ratio is the
    shortest side by the longest. Planarity is the largest distance of a vertex from the plane of its panel,
    `least_distance` that of two vertices, both in units of the extent.
    """

    least_angle: float
    greatest_angle: float
    edge_ratio: float
    planarity: float
    least_distance: float

    @property
    def quality(self) -> float:
        """The worse of sharpest corner and edge ratio; 1 at 15 degrees, and at 0.15."""
        return min(self.least_angle / _WORST.angle, self.edge_ratio / _WORST.edge_ratio)

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on."""
        return fields_to_json(
            self,
            keys={"least_angle": "least_angle_deg", "greatest_angle": "greatest_angle_deg"},
            least_angle=np.degrees(self.least_angle),
            greatest_angle=np.degrees(self.greatest_angle),
        )


def figures_of(pattern: Pattern, sheet: Sheet, bent: Floats) -> ShapeFigures:
    """Return the figures of a placed pattern; corners bent inward are those of the drawing's angles, float[K]."""
    points = np.zeros((sheet.vertices, 3))
    coordinates = np.asarray(sheet.coordinates, dtype=float)
    points[:, : coordinates.shape[1]] = coordinates
    before, at, after = points[pattern.corners.T]
    back, on = before - at, after - at
    angles = angles_between(on, back)
    angles = np.where(bent > np.pi, 2 * np.pi - angles, angles)
    lengths = np.linalg.norm(points[pattern.edges[:, 1]] - points[pattern.edges[:, 0]], axis=1)
    first, second = np.triu_indices(len(points), 1)
    least = float(np.linalg.norm(points[first] - points[second], axis=1).min())
    return ShapeFigures(
        float(angles.min()),
        float(angles.max()),
        float(lengths.min() / lengths.max()),
        off_panel_planes(sheet),
        least / extent_of(points),
    )


def crossings(pattern: Pattern, places: Floats) -> int:
    """Return how many pairs of edges cross in a drawing, and how many vertices lie on edges not ending there."""
    # Three products say on which sides of each of two edges the other's ends lie.
    x, y = places.T
    start, end = pattern.edges.T
    to_x, to_y = x[end] - x[start], y[end] - y[start]
    first, second = pattern.pairs_of_edges
    off_x, off_y = (x[start])[second] - (x[start])[first], (y[start])[second] - (y[start])[first]
    a_x, a_y, b_x, b_y = to_x[first], to_y[first], to_x[second], to_y[second]
    turned, of_first, of_second = a_x * b_y - a_y * b_x, a_x * off_y - a_y * off_x, b_x * off_y - b_y * off_x
    same = DOUBLE.same_point
    crossing = (of_first * (of_first + turned) < -same) & (of_second * (of_second + turned) < -same)
    vertex, edge = pattern.vertices_off_edges
    along_x, along_y, from_x, from_y = to_x[edge], to_y[edge], x[vertex] - x[start[edge]], y[vertex] - y[start[edge]]
    part = np.clip((from_x * along_x + from_y * along_y) / (along_x**2 + along_y**2), 0.0, 1.0)
    distance = np.hypot(from_x - part * along_x, from_y - part * along_y)
    return int(crossing.sum()) + int((distance < same * extent_of(places)).sum())
