"""Centres that geometry gives to loops round holes and cuts.

Round a hole or a cut the creases that end there make a loop of panels that no vertex is the centre of. Where their
lines are parallel it is planar, where they meet in one point spherical, as they lie and as they fold: adjacent
lines belong to one panel and keep their place to each other. Theory: docs/theory/crease-patterns.md.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from graphs.geometry import common_direction, lines_meet
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.precision import extent_of, in_space, precision_as_written
from graphs.mechanism.sheet import Edge, Sheet
from graphs.tolerances import DOUBLE, Tolerances
from graphs.types import Floats

__all__ = ["axes_meet", "loops_with_centres"]

_FARTHEST = 1e3
"""A point where lines meet that is farther than this, in units of the extent, is not told from infinity."""


def loops_with_centres(sheet: Sheet, cycles: Sequence[tuple[int, ...]], hinges: Mapping[int, Edge]) -> list[Loop]:
    """Return those cycles of joints whose axes are parallel or meet in a point, by the coordinates, as loops.

    >>> sheet = Sheet(6, (), "", (), ((0, 0), (1, 0), (0, 1), (2, 1), (0, 3), (1, 3)))
    >>> loops_with_centres(sheet, [(7, 8, 9)], {7: (0, 1), 8: (2, 3), 9: (4, 5)})[0].centre
    <Centre.INFINITE: 'infinite'>
    """
    points = in_space(sheet.coordinates or ())
    points = (points - points.mean(axis=0)) / (extent_of(points) or 1.0)
    tolerance = Tolerances.of(precision_as_written(sheet).size).meant
    centres = [axes_meet(points, [hinges[joint] for joint in cycle], tolerance) for cycle in cycles]
    return [
        Loop(cycle, centre) for cycle, centre in zip(cycles, centres, strict=True) if centre is not Centre.NONE
    ]


def axes_meet(points: Floats, hinges: Sequence[Edge], tolerance: float) -> Centre:
    """Return where two or more lines, each through two points, float[n, 3], meet.

    The tolerance is that of each point.
    """
    ends = np.array(hinges)
    start, along = points[ends[:, 0]], points[ends[:, 1]] - points[ends[:, 0]]
    lengths = np.linalg.norm(along, axis=1)
    if not lengths.all():
        return Centre.NONE
    if (np.linalg.norm(np.cross(along, common_direction(along)), axis=1) <= 2 * tolerance).all():
        return Centre.INFINITE
    meeting = lines_meet(start, along)
    if meeting.spread <= DOUBLE.parallel or np.abs(meeting.point).max() > _FARTHEST:
        return Centre.NONE
    reach = np.linalg.norm(meeting.point - (start + along / 2), axis=1)
    return Centre.FINITE if (meeting.off <= tolerance * (1 + 2 * reach / lengths)).all() else Centre.NONE
