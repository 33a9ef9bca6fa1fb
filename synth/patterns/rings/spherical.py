"""Spherical linkages of one loop by the arcs of their links. Theory: docs/theory/generators.md."""

from __future__ import annotations

from collections.abc import Sequence
from math import acos, cos, degrees, pi, sin

import numpy as np

from graphs.errors import InvariantError
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids

__all__ = ["spherical_ring"]

_Range = tuple[float, float]


def spherical_ring(arcs: Sequence[float]) -> HingedSolids:
    """Return a spherical loop of links with given arcs, at a convex pose about the middle of its range.

    Parameters
    ----------
    arcs : sequence of float
        Angle between the two axes of each link, radians, below half a turn.

    Raises
    ------
    InvariantError
        If the arcs do not close: one is longer than the others together, or all together and it are too long.

    Notes
    -----
    n - 3 freedoms. The diagonals from the first joint are chosen one after the other, each in the middle of what
    the links before and after it leave; so the pose is no dead point unless the links allow but one.

    Examples
    --------
    >>> spherical_ring([1.0, 1.2, 0.9, 1.4])
    <HingedSolids: <SCGraph: 4 links, 4 joints, 1 centre>>
    """
    n = len(arcs)
    diagonals = _diagonals(arcs)
    azimuth, spots = 0.0, [(0.0, 0.0), (arcs[0], 0.0)]
    for before, arc, after in zip(diagonals, arcs[1:], diagonals[1:], strict=False):
        azimuth += _angle(before, after, arc)
        spots.append((after, azimuth))
    directions = [(sin(far) * cos(t), sin(far) * sin(t), cos(far)) for far, t in spots]
    chain = SCGraph(n, [((i - 1) % n, i) for i in range(n)], [Loop(tuple(range(n)), Centre.FINITE)])
    return HingedSolids(chain, {i: ((0.0, 0.0, 0.0), one) for i, one in enumerate(directions)})


def _diagonals(arcs: Sequence[float]) -> list[float]:
    """Return the arcs from joint 0 to joints 1 ... n - 1."""
    reach: list[_Range] = [(arcs[0], arcs[0])]
    for arc in arcs[1:-1]:
        reach.append(_third(reach[-1], arc))
    found = [arcs[-1]]
    if not reach[-1][0] - 1e-12 <= arcs[-1] <= reach[-1][1] + 1e-12:
        raise _do_not_close(arcs)
    for arc, (least, most) in zip(reversed(arcs[1:-1]), reversed(reach[:-1]), strict=True):
        low, high = _third((found[-1], found[-1]), arc)
        found.append((max(low, least) + min(high, most)) / 2)
    return found[::-1]


def _do_not_close(arcs: Sequence[float]) -> InvariantError:
    """Return why: the longest is too long, or an odd number of the longest together.

    A loop of arcs closes on the sphere if no odd number k of them is longer than the others together by more than
    k - 1 half turns: with the opposite point for a joint two arcs become what they lack to half a turn, and each
    of these conditions becomes that of the longest.
    """
    told = ", ".join(f"{degrees(arc):g}" for arc in arcs)
    if 2.0 * max(arcs) > sum(arcs):
        why, expected = "the longest is longer than the others together", "none as long as that"
    else:
        longest = sorted(arcs, reverse=True)
        odd = [k for k in range(3, len(arcs) + 1, 2) if 2.0 * sum(longest[:k]) - sum(arcs) > (k - 1) * pi]
        numbers = {3: ("three", 360), 5: ("five", 720)}
        least = min(odd, default=3)
        many, turns = numbers.get(least, (str(least), (least - 1) * 180))
        why = "they are too long for the sphere"
        expected = f"no {many} longer than the others together by more than {turns} degrees"
    return InvariantError("arcs", f"links of {told} degrees do not close: {why}", expected)


def _third(side: _Range, arc: float) -> _Range:
    """Return how long the third side of a spherical triangle may be, of which one side has a range."""
    low, high = side
    least = max(low - arc, arc - high, 0.0)
    most = min(high + arc, 2 * pi - low - arc)
    if low <= pi - arc <= high:
        most = pi
    return least, most


def _angle(one: float, two: float, opposite: float) -> float:
    """Return the angle of a spherical triangle between two sides."""
    value = (cos(opposite) - cos(one) * cos(two)) / (sin(one) * sin(two))
    return acos(float(np.clip(value, -1.0, 1.0)))
