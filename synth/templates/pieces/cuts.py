"""Cuts made once: two panels beside each other with a slit between them have two borders in one place."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from graphs.types import Floats
from synth.templates.lines import Point, Stroke

__all__ = ["common_spans", "cut_once", "spans_on", "uncovered"]

_NEAR = 1e-6
"""Millimetres: borders this close are one line, and what is left of a line is longer."""


def cut_once(strokes: Iterable[Stroke]) -> list[Stroke]:
    """Return strokes; of cuts, only the parts that no cut before them covers.

    A machine that cuts twice burns; knives tear.

    >>> cut_once([Stroke("CUT", (0, 0), (30, 0)), Stroke("CUT", (50, 0), (10, 0)), Stroke("CUT", (30, 0), (0, 0))])
    [Stroke(kind='CUT', start=(0, 0), end=(30, 0)), Stroke(kind='CUT', start=(50.0, 0.0), end=(30.0, 0.0))]
    """
    made: list[Stroke] = []
    ends: list[tuple[Point, Point]] = []
    for stroke in strokes:
        kept = [stroke]
        if stroke.kind == "CUT":
            kept = uncovered(stroke, np.array(ends).reshape(-1, 2, 2))
            ends += [(one.start, one.end) for one in kept]
        made += kept
    return made


def uncovered(stroke: Stroke, ends: Floats) -> list[Stroke]:
    """Return the parts of a stroke, those of some length, that no line covers; the lines are float[lines, 2, 2].

    >>> uncovered(Stroke("CUT", (0, 0), (9, 0)), np.array([[[4, 0], [20, 0.0]]]))
    [Stroke(kind='CUT', start=(0.0, 0.0), end=(4.0, 0.0))]
    """
    start, end = np.array(stroke.start), np.array(stroke.end)
    length = float(np.linalg.norm(end - start))
    if length == 0:
        return []
    along = (end - start) / length
    free = _between(length, spans_on(start, along, ends))
    if free == [(0.0, length)]:
        return [stroke]
    return [Stroke(stroke.kind, _at(start + a * along), _at(start + b * along)) for a, b in free]


def spans_on(start: Floats, along: Floats, ends: Floats) -> list[tuple[float, float]]:
    """Return where lines lie on a line, as spans in millimetres from its start, in order.

    `start` and the unit vector `along` are float[2], the ends of the lines float[lines, 2, 2].
    """
    arms = ends - start
    off = np.abs(arms @ np.array([-along[1], along[0]])).max(axis=1, initial=0.0)
    spans = np.sort((arms @ along)[off <= _NEAR], axis=1)
    return sorted((float(low), float(high)) for low, high in spans)


def common_spans(
    first: Sequence[tuple[float, float]], second: Sequence[tuple[float, float]]
) -> list[tuple[float, float]]:
    """Return the spans that are in both lists, in order.

    >>> common_spans([(0, 5), (8, 12)], [(3, 10)])
    [(3, 5), (8, 10)]
    """
    common = ((max(a, c), min(b, d)) for a, b in first for c, d in second)
    return sorted((low, high) for low, high in common if high - low > _NEAR)


def _between(length: float, covered: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return the parts of a line that spans leave, those of any length."""
    free, reached = [], 0.0
    for low, high in covered:
        if low - reached > _NEAR and reached < length:
            free.append((reached, min(low, length)))
        reached = max(reached, high)
    if length - reached > _NEAR:
        free.append((reached, length))
    return free


def _at(place: Floats) -> Point:
    return float(place[0]), float(place[1])
