"""Flat-foldable vertices of four creases whose ratios of half-angle tangents agree round panels.

At such a vertex, sectors a and b on both sides of a crease, the half-angle tangent of that crease is
cos((a + b) / 2) / cos((a - b) / 2) times those of its neighbours in one mode, sin((a + b) / 2) / sin((a - b) / 2)
times them in the other, but for signs; the ratios stay as they are while the vertex folds. A panel between such
vertices can be passed round if their product is 1. Sources: T. Tachi, Generalization of rigid-foldable
quadrilateral-mesh origami (2009); T. A. Evans, R. J. Lang, S. P. Magleby, L. L. Howell, Rigidly foldable origami
gadgets and tessellations (2015). Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from graphs.mechanism.sheet import sides_of_face
from graphs.types import Floats
from synth.realisation.measures import opened_angles
from synth.realisation.pattern import Pattern
from synth.realisation.wanted.conditions import Condition
from synth.realisation.wanted.walking import creases_round

__all__ = ["agreeing_ratios", "panels_between_vertices"]


def panels_between_vertices(pattern: Pattern) -> list[tuple[int, ...]]:
    """Return the panels all of whose corners are inner vertices of four creases.

    >>> from graphs.convert.panels import scd_from_panels
    >>> from synth.realisation.pattern import pattern_of
    >>> fan = pattern_of(scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)]))
    >>> panels_between_vertices(fan)
    []
    """
    rounds = zip(pattern.inner.tolist(), creases_round(pattern), strict=False)
    four = {vertex for vertex, met in rounds if len(met) == 4}
    return [panel for panel in pattern.panels if four.issuperset(panel)]


def agreeing_ratios(pattern: Pattern, modes: Sequence[bool]) -> Condition:
    """Return that the product of ratios round each panel between vertices of four creases is 1: its logarithm.

    The mode is that of each inner vertex, in their order: True for the one with sines.
    """
    mode_of = dict(zip(pattern.inner.tolist(), modes, strict=True))
    number_of = {(int(at), int(before)): number for number, (before, at, _) in enumerate(pattern.corners)}
    rows: list[list[tuple[int, int, bool]]] = []
    for panel in panels_between_vertices(pattern):
        sides = list(sides_of_face(panel))
        pairs = zip(sides, [*sides[1:], sides[0]], strict=True)
        rows.append(
            [(number_of[at, before], number_of[at, after], mode_of[at]) for (before, at), (_, after) in pairs]
        )

    def condition(unknowns: Floats) -> tuple[Floats, Floats]:
        angles, by_places = opened_angles(pattern, unknowns[: pattern.vertices])
        off, by = np.zeros(len(rows)), np.zeros((len(rows), unknowns.size))
        for row, corners in enumerate(rows):
            for here, beyond, sines in corners:
                value, slopes = _logarithm(float(angles[here]), float(angles[beyond]), sines)
                off[row] += value
                by[row, : by_places.shape[1]] += slopes[0] * by_places[here] + slopes[1] * by_places[beyond]
        return off, by

    return condition


def _logarithm(one: float, other: float, sines: bool) -> tuple[float, tuple[float, float]]:
    """Return the logarithm of the ratio between two sectors, and its derivatives by both."""
    half, apart = (one + other) / 2.0, (one - other) / 2.0
    if sines:
        first, second = 0.5 / np.tan(half), 0.5 / np.tan(apart)
        return float(np.log(np.abs(np.sin(half) / np.sin(apart)))), (first - second, first + second)
    first, second = -0.5 * np.tan(half), -0.5 * np.tan(apart)
    return float(np.log(np.abs(np.cos(half) / np.cos(apart)))), (first - second, first + second)
