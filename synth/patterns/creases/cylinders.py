"""A cylinder that is deployed radially, and stopped by ride-alongs that go straight.

Theory: docs/theory/activating-constraints.md.
"""

from __future__ import annotations

from math import acos, cos, degrees, pi, sin

from graphs.errors import InvariantError
from graphs.mechanism.sheet import Sheet
from synth.patterns.panels import Corners, sheet_of_panels

__all__ = ["deployable_cylinder", "sectors_of_ride_alongs"]

Point = tuple[float, float, float]
_MIDDLE = 0.45
"""Length of the crease between the links of a ride-along, in widths of a wall: a little less than half a wall."""


def sectors_of_ride_alongs(pleats: int, slack: float) -> tuple[float, float]:
    """Return the sector of each ride-along link at an outer and at an inner crease, radians.

    Both sit at right angles to their crease, so that they are straight where the angle between the walls is twice
    the sector. Round the cylinder the angles at inner creases, seen from without, are together 360 degrees more
    than those at outer ones: both kinds are straight at once, with walls at inner creases ``2 slack`` from flat.

    >>> [round(degrees(sector), 6) for sector in sectors_of_ride_alongs(4, 0.0)]
    [45.0, 90.0]
    """
    return pi / 2 - pi / pleats - slack, pi / 2 - slack


def deployable_cylinder(pleats: int, short: float, slack: float, height: float = 1.0) -> Sheet:
    """Return a ring of pleats, on each crease of which a ride-along sits that stops it where it goes straight.

    Parameters
    ----------
    pleats : int
        Pairs of walls.
    short : float
        By how much the angle of the walls at each crease is less than where ride-alongs are straight, radians.
    slack : float
        Half of the angle by which walls at inner creases are from flat then, radians.
    height : float, optional
        Of the walls, in units of their width.

    Raises
    ------
    InvariantError
        If walls would lie on each other, or beyond.

    Notes
    -----
    Source of the principle: Wiener 2016, section 6.3; the proportions are chosen here.

    Examples
    --------
    >>> deployable_cylinder(4, 0.5, 0.1)
    <Sheet: 24 faces, 32 creases, 32 vertices, in space>
    """
    outer, inner = sectors_of_ride_alongs(pleats, slack)
    opening = 2.0 * outer - short
    if opening <= 0.0:
        raise InvariantError(
            "short",
            f"walls at outer creases come to {degrees(2.0 * outer):g} degrees, less {degrees(short):g}",
            f"short below {degrees(2.0 * outer):g} degrees",
        )
    feet = _feet(pleats, opening)
    panels: list[Corners] = []
    for k, foot in enumerate(feet):
        panels.append(_wall(foot, feet[(k + 1) % len(feet)], height))
    for k, foot in enumerate(feet):
        before, after = feet[k - 1], feet[(k + 1) % len(feet)]
        panels += _ride_along((before, foot, after), height, inner if k % 2 else outer)
    return sheet_of_panels(panels, f"Radially deployable cylinder of {pleats} pleats")


def _feet(pleats: int, opening: float) -> list[Point]:
    """Return where creases meet the floor, the first an outer one, of walls of width 1 with an angle at these."""
    turn = pi / pleats
    far, near = (sin(angle) / sin(turn) for angle in (turn + opening / 2.0, opening / 2.0))
    return [(radius * cos(k * turn), radius * sin(k * turn), 0.0) for k, radius in enumerate((far, near) * pleats)]


def _wall(foot: Point, following: Point, height: float) -> list[Point]:
    """Return a wall, with a corner in the middle of its upper edge, which two ride-alongs share."""
    middle = _between(foot, following)
    return [foot, following, _raised(following, height), _raised(middle, height), _raised(foot, height)]


def _ride_along(feet: tuple[Point, Point, Point], height: float, sector: float) -> list[Corners]:
    """Return the two triangles on the upper half edges of the walls at a crease."""
    before, foot, after = feet
    one, other = (_raised(_between(foot, end), height) for end in (before, after))
    top = _raised(foot, height)
    towards = [(a + b) / 2.0 - c for a, b, c in zip(one, other, top, strict=True)]
    half_way = sum(x * x for x in towards) ** 0.5
    lean = acos(min(1.0, cos(sector) / (2.0 * half_way)))
    level = _MIDDLE * cos(lean) / half_way
    tip = (top[0] + level * towards[0], top[1] + level * towards[1], top[2] + _MIDDLE * sin(lean))
    return [[top, one, tip], [top, tip, other]]


def _between(a: Point, b: Point) -> Point:
    return ((a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0, (a[2] + b[2]) / 2.0)


def _raised(a: Point, height: float) -> Point:
    return (a[0], a[1], a[2] + height)
