"""Labels placed beside what they name and on nothing else; signs of the thesis for centres and joints."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import cos, hypot, pi, sin
from typing import TypeAlias

from graphs.loops.loop import Centre
from synth.drawing.scene.shapes import FINE, NORMAL, Disc, Label, Line, Point, Shape

SIGN = 4.2
"""Radius of the sign of a centre, points."""
_WEIGHT_OF_LABEL = 1000.0
_WEIGHT_OF_POINT = 60.0
_AIR = 0.6
_SQUARE = 16.0
_Box: TypeAlias = tuple[float, float, float, float]
"""Left, top, right, bottom."""


@dataclass(slots=True)
class Obstacles:
    """Points, each (x, y, radius), and lines that labels should not cover."""

    points: list[tuple[float, float, float]]
    lines: list[tuple[Point, Point]]


def beside(at: Point, distance: float, directions: int = 12, first: float = -pi / 2) -> list[Point]:
    """Return places round a point, nearer ones first."""
    places = []
    for far in (1.0, 1.35, 1.8, 2.4, 3.2):
        for i in range(directions):
            angle = first + 2 * pi * i / directions
            places.append((at[0] + far * distance * cos(angle), at[1] + far * distance * sin(angle)))
    return places


def placed(wishes: Iterable[tuple[Label, Sequence[Point]]], obstacles: Obstacles) -> list[Label]:
    """Return labels at the best of the places offered to each: on no label, and on as little else as can be.

    Places are in order of preference. A label for which every place lies on another label is left out.
    """
    labels: list[Label] = []
    boxes = _Boxes()
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
            if not boxes.leave_free(box):
                continue
            cost += _cost(box, obstacles)
            if cost < least:
                best, least = (place, box), cost
        if best is not None:
            labels.append(replace(label, at=best[0]))
            boxes.add(best[1])
    return labels


class _Boxes:
    """Boxes of labels, found by the squares of a grid that they reach into."""

    def __init__(self) -> None:
        self._squares: dict[tuple[int, int], list[_Box]] = {}

    def leave_free(self, box: _Box) -> bool:
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
    """Return a penalty for the points and lines that a label would cover."""
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
    """Whether a straight piece has a point in a box: whether any of it is left after clipping at each side."""
    start, stop = 0.0, 1.0
    for p, step, low, high in ((a[0], b[0] - a[0], left, right), (a[1], b[1] - a[1], top, bottom)):
        if abs(step) < 1e-12:
            if not low <= p <= high:
                return False
            continue
        enters, leaves = sorted(((low - p) / step, (high - p) / step))
        start, stop = max(start, enters), min(stop, leaves)
        if start > stop:
            return False
    return True


def centre_sign(at: Point, centre: Centre, colour: str, size: float = SIGN) -> list[Shape]:
    """Return the sign of a loop's centre: a circled dot, or a lying eight for one at infinity, or nothing."""
    if centre is Centre.FINITE:
        return [Disc(at, size, "paper", colour, 1.1 * NORMAL), Disc(at, 0.32 * size, colour, None)]
    if centre is Centre.INFINITE:
        # Bernoulli's lemniscate, stretched upwards a little
        turns = [2 * pi * i / 48 for i in range(49)]
        row = [
            (
                at[0] + 1.5 * size * cos(a) / (1 + sin(a) ** 2),
                at[1] + 1.9 * size * sin(a) * cos(a) / (1 + sin(a) ** 2),
            )
            for a in turns
        ]
        return [Line(row, "paper", 3 * NORMAL), Line(row, colour, 1.2 * NORMAL)]
    return []


def joint_dot(at: Point, joint: object, radius: float = 2.1) -> Disc:
    """Return a revolute joint: a small circle, empty, as on drawings of mechanisms."""
    return Disc(at, radius, "paper", "ink", NORMAL if radius > 1.5 else FINE, (("joint", str(joint)),))
