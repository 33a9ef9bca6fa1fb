"""Places for labels: beside what they name, on nothing else."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import cos, hypot, pi, sin

from synth.drawing.scene.shapes import Label, Point

__all__ = ["Obstacles", "beside", "overlaps", "placed"]

_WEIGHT_OF_LABEL = 1000.0
_WEIGHT_OF_POINT = 60.0
_AIR = 0.6


@dataclass(slots=True)
class Obstacles:
    """What labels should not lie on.

    Parameters
    ----------
    points : list of (x, y, radius)
    lines : list of ((x, y), (x, y))
    """

    points: list[tuple[float, float, float]]
    lines: list[tuple[Point, Point]]


def overlaps(one: Label, other: Label) -> bool:
    """Tell whether the boxes of two labels have a point in common.

    Examples
    --------
    >>> overlaps(Label((0, 0), "12"), Label((2, 2), "3")), overlaps(Label((0, 0), "12"), Label((9, 9), "3"))
    (True, False)
    """
    a, b = one.box, other.box
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def beside(at: Point, distance: float, directions: int = 12, first: float = -pi / 2) -> list[Point]:
    """Return places round a point, nearer ones first.

    Examples
    --------
    >>> [(round(x, 6), round(y, 6)) for x, y in beside((0, 0), 2, 4)[:2]]
    [(0.0, -2.0), (2.0, 0.0)]
    """
    found = []
    for far in (1.0, 1.35, 1.8, 2.4, 3.2):
        for i in range(directions):
            angle = first + 2 * pi * i / directions
            found.append((at[0] + far * distance * cos(angle), at[1] + far * distance * sin(angle)))
    return found


def placed(wishes: Iterable[tuple[Label, Sequence[Point]]], obstacles: Obstacles) -> list[Label]:
    """Return labels at the best of the places offered to each: on no label, and on as little else as can be.

    A label for which every place lies on another label is left out.

    Parameters
    ----------
    wishes : iterable of (label, places)
        Places in the order of liking.
    obstacles : Obstacles

    Examples
    --------
    >>> wish = (Label((0, 0), "1"), [(0, 0), (20, 0)])
    >>> [label.at for label in placed([wish, wish, wish], Obstacles([], []))]
    [(0, 0), (20, 0)]
    """
    done: list[Label] = []
    for label, places in wishes:
        best, least = None, _WEIGHT_OF_LABEL
        for liking, place in enumerate(places):
            there = replace(label, at=place)
            cost = 0.4 * liking
            if cost >= least:
                break
            cost += _cost(there, obstacles)
            if cost < least and not any(overlaps(there, other) for other in done):
                best, least = there, cost
        if best is not None:
            done.append(best)
    return done


def _cost(label: Label, obstacles: Obstacles) -> float:
    """Return how much a label covers."""
    left, top, right, bottom = label.box
    left, top, right, bottom = left - _AIR, top - _AIR, right + _AIR, bottom + _AIR
    cost = 0.0
    for x, y, radius in obstacles.points:
        off = hypot(x - min(max(x, left), right), y - min(max(y, top), bottom))
        if off < radius:
            cost += _WEIGHT_OF_POINT
    for a, b in obstacles.lines:
        if _meets(a, b, left, top, right, bottom):
            cost += 4.0
    return cost


def _meets(a: Point, b: Point, left: float, top: float, right: float, bottom: float) -> bool:
    """Whether a straight piece has a point in a box: what is left of it after cutting at each side."""
    start, stop = 0.0, 1.0
    for p, step, low, high in ((a[0], b[0] - a[0], left, right), (a[1], b[1] - a[1], top, bottom)):
        if abs(step) < 1e-12:
            if not low <= p <= high:
                return False
            continue
        one, two = sorted(((low - p) / step, (high - p) / step))
        start, stop = max(start, one), min(stop, two)
        if start > stop:
            return False
    return True
