"""Labels placed beside what they name and on nothing else; signs of the thesis for centres and joints."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from math import cos, hypot, pi, sin
from typing import TypeAlias

from graphs.loops.loop import Centre
from synth.making.drawing.scene.shapes import FINE, NORMAL, Disc, Label, Line, Point, Shape, part_in_box

SIGN = 4.2
"""Radius of the sign of a centre, points."""
_WEIGHT_OF_LABEL = 1000.0
_WEIGHT_OF_POINT = 60.0
_WEIGHT_OF_NEIGHBOUR = 3.0
_AIR = 0.6
_APART = 2.0
"""How near another label beside it may come before both may be read as one, points."""
_SQUARE = 16.0
_Box: TypeAlias = tuple[float, float, float, float]
"""Left, top, right, bottom."""


def beside(at: Point, distance: float, directions: int = 12, first: float = -pi / 2) -> list[Point]:
    """Return places round a point, nearer ones first."""
    places = []
    for far in (1.0, 1.35, 1.8, 2.4, 3.2):
        for i in range(directions):
            angle = first + 2 * pi * i / directions
            places.append((at[0] + far * distance * cos(angle), at[1] + far * distance * sin(angle)))
    return places


def placed(
    wishes: Iterable[tuple[Label, Sequence[Point]]],
    points: Sequence[tuple[float, float, float]] = (),
    lines: Sequence[tuple[Point, Point]] = (),
) -> list[Label]:
    """Return labels at the best of the places offered to each: on no label, and on as little else as can be.

    Places are in order of preference. A label for which every place lies on another label is left out. Points,
    each (x, y, radius), and lines should not be covered.
    """
    labels: list[Label] = []
    boxes: dict[tuple[int, int], list[_Box]] = {}  # by the squares of a grid that they reach into
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
            if any(_overlap(box, other) for square in _squares_of(box) for other in boxes.get(square, ())):
                continue
            cost += _cost(box, points, lines)
            wide = (box[0] - _APART, box[1], box[2] + _APART, box[3])
            if any(_overlap(wide, other) for square in _squares_of(wide) for other in boxes.get(square, ())):
                cost += _WEIGHT_OF_NEIGHBOUR
            if cost < least:
                best, least = (place, box), cost
        if best is not None:
            labels.append(replace(label, at=best[0]))
            for square in _squares_of(best[1]):
                boxes.setdefault(square, []).append(best[1])
    return labels


def _overlap(box: _Box, other: _Box) -> bool:
    return box[0] < other[2] and other[0] < box[2] and box[1] < other[3] and other[1] < box[3]


def _squares_of(box: _Box) -> list[tuple[int, int]]:
    left, top, right, bottom = (int(edge // _SQUARE) for edge in box)
    return [(x, y) for x in range(left, right + 1) for y in range(top, bottom + 1)]


def _cost(box: _Box, points: Sequence[tuple[float, float, float]], lines: Sequence[tuple[Point, Point]]) -> float:
    """Return a penalty for the points and lines that a label would cover."""
    left, top, right, bottom = box[0] - _AIR, box[1] - _AIR, box[2] + _AIR, box[3] + _AIR
    cost = 0.0
    for x, y, radius in points:
        off = hypot(x - min(max(x, left), right), y - min(max(y, top), bottom))
        if off < radius:
            cost += _WEIGHT_OF_POINT
    for a, b in lines:
        first, last = part_in_box(a, b, (left, top, right, bottom))
        if first <= last:
            cost += 4.0
    return cost


def centre_sign(at: Point, centre: Centre, colour: str, size: float = SIGN) -> list[Shape]:
    """Return the sign of a loop's centre: a circled dot, or a lying eight for one at infinity, or nothing."""
    if centre is Centre.FINITE:
        return [Disc(at, size, "paper", colour, 1.1 * NORMAL), Disc(at, 0.32 * size, colour, None)]
    if centre is Centre.INFINITE:
        # Bernoulli's lemniscate, stretched upwards a little
        turns = [2 * pi * i / 48 for i in range(49)]
        row = [
            (at[0] + 1.5 * size * cos(a) / (1 + sin(a) ** 2), at[1] + 1.9 * size * sin(a) * cos(a) / (1 + sin(a) ** 2))
            for a in turns
        ]
        return [Line(row, "paper", 3 * NORMAL), Line(row, colour, 1.2 * NORMAL)]
    return []


def joint_dot(at: Point, joint: object, radius: float = 2.1) -> Disc:
    """Return a revolute joint: a small circle, empty, as on drawings of mechanisms."""
    return Disc(at, radius, "paper", "ink", NORMAL if radius > 1.5 else FINE, (("joint", str(joint)),))
