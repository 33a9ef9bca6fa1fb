"""What a realised type looks like, in figures.

Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from graphs.geometry import angles_between
from graphs.mechanism.precision import extent_of, off_panel_planes
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.realisation.pattern import Pattern

__all__ = ["ShapeFigures", "crossings", "figures_of"]

_SHARP, _RATIO = float(np.radians(15.0)), 0.15


@dataclass(frozen=True, slots=True)
class ShapeFigures:
    """Shape of the panels.

    Angles are those of their corners, radians, more than pi where one is bent inward. The edge ratio is the
    shortest side by the longest. Planarity says how far a vertex is off the plane of its panel at most,
    `least_distance` is that of two vertices, both in units of the extent.
    """

    least_angle: float
    greatest_angle: float
    edge_ratio: float
    planarity: float
    least_distance: float

    @property
    def quality(self) -> float:
        """1 where the sharpest corner has 15 degrees and the edge ratio is 0.15, or the worse of the two less."""
        return min(self.least_angle / _SHARP, self.edge_ratio / _RATIO)

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on."""
        return {
            "least_angle_deg": float(np.degrees(self.least_angle)),
            "greatest_angle_deg": float(np.degrees(self.greatest_angle)),
            "edge_ratio": self.edge_ratio,
            "planarity": self.planarity,
            "least_distance": self.least_distance,
        }


def figures_of(pattern: Pattern, sheet: Sheet, bent: Floats) -> ShapeFigures:
    """Return the figures of a placed pattern, a sheet with coordinates.

    The angles of the corners in the drawing, float[K], say which of them are bent inward.
    """
    points = np.zeros((sheet.vertices, 3))
    given = np.asarray(sheet.coordinates, dtype=float)
    points[:, : given.shape[1]] = given
    before, at, after = points[pattern.corners.T]
    back, on = before - at, after - at
    angles = angles_between(on, back)
    angles = np.where(bent > np.pi, 2 * np.pi - angles, angles)
    lengths = np.linalg.norm(points[pattern.edges[:, 1]] - points[pattern.edges[:, 0]], axis=1)
    one, other = np.triu_indices(len(points), 1)
    least = float(np.linalg.norm(points[one] - points[other], axis=1).min())
    return ShapeFigures(
        float(angles.min()),
        float(angles.max()),
        float(lengths.min() / lengths.max()),
        off_panel_planes(sheet),
        least / extent_of(points),
    )


def crossings(pattern: Pattern, places: Floats) -> int:
    """Return how many pairs of edges cross in a drawing, and how many vertices lie on edges not ending there."""
    one, other = np.triu_indices(len(pattern.edges), 1)
    a, b = (places[ends] for ends in pattern.edges[one].T)
    c, d = (places[ends] for ends in pattern.edges[other].T)
    same = DOUBLE.same_point
    met = (_side(a, b, c) * _side(a, b, d) < -same) & (_side(c, d, a) * _side(c, d, b) < -same)
    return int(met.sum()) + int((_from_edges(pattern, places) < same * extent_of(places)).sum())


def _side(a: Floats, b: Floats, c: Floats) -> Floats:
    """Return how far a point is to the left of a line, by the length of the line."""
    side: Floats = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    return side


def _from_edges(pattern: Pattern, places: Floats) -> Floats:
    """Return the distance of each vertex from each edge that does not end in it."""
    start = places[pattern.edges[:, 0]]
    along = places[pattern.edges[:, 1]] - start
    to = places[:, None] - start[None]
    part = np.clip((to * along).sum(axis=2) / (along**2).sum(axis=1), 0.0, 1.0)
    distance: Floats = np.linalg.norm(to - part[:, :, None] * along, axis=2)
    own = (pattern.edges[None] == np.arange(len(places))[:, None, None]).any(axis=2)
    others: Floats = distance[~own]
    return others
