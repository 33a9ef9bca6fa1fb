"""How far coordinates may reach: the one check of extent, whatever they are coordinates of.

Nobody draws anything that is 1e50 of a unit wide, and where somebody does, the sixth powers that ranks, areas and
normals are made of are no numbers any more. What is outside the range is refused when the object is built, so that
all questions about it agree.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import chain
from math import hypot

from graphs.errors import InvariantError

__all__ = ["LEAST", "MOST", "check_area", "check_extent", "in_reach"]

MOST = 1e50
"""No coordinate is larger."""
LEAST = 1e-50
"""No extent is smaller: the larger of the differences of coordinates along the axes."""
_RANGE = f"an extent of {LEAST:g} to {MOST:g}"
_THIN = 1e-12
"""Points in one line lie this close to it, in units of their extent: rounding puts them farther off by nothing."""


def in_reach(numbers: Iterable[float]) -> bool:
    """Tell whether numbers are finite and none is beyond the range of coordinates.

    Parameters
    ----------
    numbers : iterable of float

    Returns
    -------
    bool

    Examples
    --------
    >>> in_reach((1.0, -2.5)), in_reach((1.0, 1e160)), in_reach((float("nan"),))
    (True, False, False)
    """
    return all(abs(number) <= MOST for number in numbers)


def check_extent(points: Sequence[Sequence[float]]) -> float:
    """Refuse coordinates that reach too far, or lie too close together; a single place has no extent.

    Parameters
    ----------
    points : sequence of points
        All of them with two or three coordinates.

    Returns
    -------
    float
        The extent.

    Raises
    ------
    InvariantError
        With the range.

    Examples
    --------
    >>> check_extent([(0.0, 0.0), (3.0, 1.0)])
    3.0
    >>> check_extent([(0.0, 0.0), (1e160, 1.0)])
    Traceback (most recent call last):
    ...
    graphs.errors.InvariantError: a coordinate is 1e+160; expected an extent of 1e-50 to 1e+50 [extent]
    """
    if not in_reach(chain.from_iterable(points)):
        farthest = next(x for x in chain.from_iterable(points) if not in_reach((x,)))
        raise InvariantError("extent", f"a coordinate is {farthest:g}", _RANGE)
    extent = max((max(axis) - min(axis) for axis in zip(*points, strict=True)), default=0.0)
    if 0.0 < extent < LEAST:
        raise InvariantError("extent", f"the extent is {extent:g}", _RANGE)
    return extent


def check_area(points: Sequence[Sequence[float]]) -> None:
    """Refuse points that all lie in one line: a pattern of them has no area.

    Parameters
    ----------
    points : sequence of points
        As of `check_extent`, which they have passed.

    Raises
    ------
    InvariantError

    Examples
    --------
    >>> check_area([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)])
    >>> check_area([(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)])
    Traceback (most recent call last):
    ...
    graphs.errors.InvariantError: the pattern has no area: all its vertices lie in one line [area]
    """
    if not points:
        return
    first = points[0]
    offsets = [tuple(x - y for x, y in zip(point, first, strict=True)) for point in points]
    along = max(offsets, key=lambda offset: hypot(*offset))
    length = hypot(*along)
    if length == 0.0:
        raise InvariantError("area", "the pattern has no area: all its vertices lie in one place")
    unit = [x / length for x in along]
    for offset in offsets:
        reach = sum(x * y for x, y in zip(offset, unit, strict=True))
        if hypot(*(x - reach * y for x, y in zip(offset, unit, strict=True))) > _THIN * length:
            return
    raise InvariantError("area", "the pattern has no area: all its vertices lie in one line")
