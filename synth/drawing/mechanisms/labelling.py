"""Places for labels: beside what they name, on nothing else."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import cos, hypot, pi, sin
from typing import TypeAlias

from synth.drawing.scene.shapes import Label, Point

__all__ = ["Obstacles", "beside", "overlaps", "placed"]

_WEIGHT_OF_LABEL = 1000.0
_WEIGHT_OF_POINT = 60.0
_AIR = 0.6
_SQUARE = 16.0
_Box: TypeAlias = tuple[float, float, float, float]
"""Left, top, right, bottom."""


@dataclass(slots=True)
class Obstacles:
    """What labels should not lie on: points, each (x, y, radius), and lines."""

    points: list[tuple[float, float, float]]
    lines: list[tuple[Point, Point]]


def overlaps(one: Label, other: Label) -> bool:
    """Say whether the boxes of two labels have a point in common."""
    a, b = one.box, other.box
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def beside(at: Point, distance: float, directions: int = 12, first: float = -pi / 2) -> list[Point]:
    """Return places round a point, nearer ones first.

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
    taken = _Taken()
    for label, places in wishes:
        x, y = label.at
        left, top, right, bottom = label.box
        best, least = None, _WEIGHT_OF_LABEL
        for liking, place in enumerate(places):
            cost = 0.4 * liking
            if cost >= least:
                break
            across, down = place[0] - x, place[1] - y
            box = (left + across, top + down, right + across, bottom + down)
            if not taken.is_free(box):
                continue
            cost += _cost(box, obstacles)
            if cost < least:
                best, least = (place, box), cost
        if best is not None:
            done.append(replace(label, at=best[0]))
            taken.add(best[1])
    return done


class _Taken:
    """Boxes that are taken, found by the squares that they reach into."""

    def __init__(self) -> None:
        self._squares: dict[tuple[int, int], list[_Box]] = {}

    def is_free(self, box: _Box) -> bool:
        return not any(
            box[0] < other[2] and other[0] < box[2] and box[1] < other[3] and other[1] < box[3]
            for square in _squares_of(box)
            for other in self._squares.get(square, ())
        )

    def add(self, box: _Box) -> None:
        for square in _squares_of(box):
            self._squares.setdefault(square, []).append(box)


def _squares_of(box: _Box) -> list[tuple[int, int]]:
    left, top, right, bottom = (int(edge // _SQUARE) for edge in box)
    return [(x, y) for x in range(left, right + 1) for y in range(top, bottom + 1)]


def _cost(box: _Box, obstacles: Obstacles) -> float:
    """Return how much of what is drawn a label would cover."""
    left, top, right, bottom = box[0] - _AIR, box[1] - _AIR, box[2] + _AIR, box[3] + _AIR
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
