"""Cuts made once: two panels beside each other with a slit between them have two borders in one place."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from graphs.arrays import Floats
from synth.templates.lines import Stroke

__all__ = ["cut_once"]

_NEAR = 1e-6
"""Millimetres: borders this close are one line, and what is left of a line is longer."""


def cut_once(strokes: Iterable[Stroke]) -> list[Stroke]:
    """Return strokes, of cuts only what no cut before them covers.

    A machine that cuts twice burns; knives tear.

    Examples
    --------
    >>> cut_once([Stroke("CUT", (0, 0), (30, 0)), Stroke("CUT", (50, 0), (10, 0)), Stroke("CUT", (30, 0), (0, 0))])
    [Stroke(kind='CUT', start=(0, 0), end=(30, 0)), Stroke(kind='CUT', start=(50.0, 0.0), end=(30.0, 0.0))]
    """
    made: list[Stroke] = []
    ends: list[tuple[tuple[float, float], tuple[float, float]]] = []
    for stroke in strokes:
        if stroke.kind != "CUT":
            made.append(stroke)
            continue
        start, end = np.array(stroke.start), np.array(stroke.end)
        length = float(np.linalg.norm(end - start))
        covered = _covered(start, (end - start) / length, np.array(ends).reshape(-1, 2, 2)) if length else []
        free = _uncovered(length, covered)
        if free == [(0.0, length)]:
            kept = [stroke]
        else:
            along = (end - start) / length if length else end
            kept = [Stroke("CUT", _at(start + a * along), _at(start + b * along)) for a, b in free]
        made += kept
        ends += [(one.start, one.end) for one in kept]
    return made


def _covered(start: Floats, along: Floats, ends: Floats) -> list[tuple[float, float]]:
    """Return from where to where lines lie over a line, in millimetres from its start, in order."""
    arms = ends - start
    off = np.abs(arms @ np.array([-along[1], along[0]])).max(axis=1, initial=0.0)
    spans = np.sort((arms @ along)[off <= _NEAR], axis=1)
    return sorted((float(low), float(high)) for low, high in spans)


def _uncovered(length: float, covered: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return the parts of a line that spans leave, those of any length."""
    free, reached = [], 0.0
    for low, high in covered:
        if low - reached > _NEAR and reached < length:
            free.append((reached, min(low, length)))
        reached = max(reached, high)
    if length - reached > _NEAR:
        free.append((reached, length))
    return free


def _at(place: Floats) -> tuple[float, float]:
    return float(place[0]), float(place[1])
