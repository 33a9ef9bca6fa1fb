"""Walks on a pattern: from side to side of a panel, across creases, round inner vertices and holes.

A side is a pair of vertices, directed so that its panel is on the left.
"""

from __future__ import annotations

from dataclasses import dataclass

from graphs.mechanism.sheet import Edge, sides_of_face
from synth.realisation.pattern import Pattern

__all__ = ["Sides", "creases_round", "sides_of"]


@dataclass(frozen=True, slots=True)
class Sides:
    """Which side follows which along its panel, counter-clockwise (`after`) and clockwise (`before`).

    `creases` gives the crease that a side is, in both directions; sides of the border are not in it.
    """

    after: dict[Edge, Edge]
    before: dict[Edge, Edge]
    creases: dict[Edge, int]


def sides_of(pattern: Pattern) -> Sides:
    """Return which side of a pattern follows which.

    >>> from graphs.convert.panels import scd_from_panels
    >>> from synth.realisation.pattern import pattern_of
    >>> fan = pattern_of(scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)]))
    >>> len(sides_of(fan).after), len(sides_of(fan).creases)
    (12, 8)
    """
    after: dict[Edge, Edge] = {}
    for panel in pattern.panels:
        sides = list(sides_of_face(panel))
        after.update(zip(sides, [*sides[1:], sides[0]], strict=True))
    creases = {side: number for number, (a, b) in enumerate(pattern.creases) for side in ((a, b), (b, a))}
    return Sides(after, {second: first for first, second in after.items()}, creases)


def creases_round(pattern: Pattern) -> list[tuple[int, ...]]:
    """Return the creases in the order in which a walk meets them: round each inner vertex, then round each hole.

    >>> from graphs.convert.panels import scd_from_panels
    >>> from synth.realisation.pattern import pattern_of
    >>> fan = pattern_of(scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)]))
    >>> [len(creases) for creases in creases_round(fan)]
    [4]
    """
    sides = sides_of(pattern)
    starts = [next(side for side in sides.after if side[0] == vertex) for vertex in pattern.inner.tolist()]
    starts += [next(side for side in sides_of_face(ring[::-1]) if side in sides.after) for ring in pattern.holes]
    return [_walk(sides, start) for start in starts]


def _walk(sides: Sides, start: Edge) -> tuple[int, ...]:
    """Return the creases that are crossed by one who keeps an inner vertex, or a hole, on one hand."""
    met = []
    side = start
    while True:
        if side in sides.creases:
            met.append(sides.creases[side])
            side = side[::-1]
        side = sides.after[side]
        if side == start:
            return tuple(met)
