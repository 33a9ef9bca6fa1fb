"""Ride-alongs in pictures of SC graphs: what can be taken off lies on a band of another colour.

Which links and joints these are `graphs.reduce` says, and `synth reduce` lists.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from graphs.errors import numbered
from graphs.mechanism.sc import SCGraph
from graphs.reduce.ride_alongs import Reduction, reduce
from graphs.types import JointId, LinkId
from synth.drawing.scene.shapes import Disc, Line, Point, Shape

__all__ = ["bands", "said_of_ride_alongs", "taken_off"]

_BAND = 0.9
"""Width of a band, in units of the radius of a link."""
_RIM = 1.45
"""Radius of what lies below a link, likewise."""


def taken_off(sc: SCGraph) -> Reduction:
    """Return the reduction by ride-alongs, chains of them included, of an SC or SCD graph."""
    return reduce(sc)


def bands(
    reduction: Reduction, ways: Mapping[JointId, Sequence[Point]], links: Mapping[LinkId, Point], radius: float
) -> list[Shape]:
    """Return bands below the joints and links that are removed.

    `ways` are the points of each joint as it is drawn; `radius` is that of a link, points.
    """
    found: list[Shape] = []
    for step in reduction.steps:
        found += [Line(ways[joint], "marked", 2 * _BAND * radius) for joint in step.joints]
        found += [Disc(links[link], _RIM * radius, "marked", None) for link in step.removed]
    return found


def said_of_ride_alongs(reduction: Reduction) -> list[str]:
    """Return the line below the picture, if there is something to say."""
    if not reduction.steps:
        return []
    count = len(reduction.steps)
    return [f"{numbered(count, 'ride-along')} (yellow band); without, {len(reduction.graph)} links stay"]
