"""Creases that go straight on through vertices, and opposite creases of panels that are parallel.

About a vertex of four creases two and two are opposite, and opposite ones follow each other along a *line*. Lines
that enter a panel of four sides at opposite sides run side by side; those form *bundles*. A Miura sheet has one
bundle of straight lines and one of zigzags, and parallel opposite creases. Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Iterable

import networkx as nx
import numpy as np

from graphs.mechanism.sheet import Edge
from graphs.types import Floats
from synth.realisation.measures import opened_angles
from synth.realisation.pattern import Pattern
from synth.realisation.wanted.conditions import Condition
from synth.realisation.wanted.walking import creases_round, sides_of

__all__ = ["bent_line", "bundles", "parallel_creases", "straight_lines"]


def straight_lines(pattern: Pattern, bundle: Iterable[int]) -> Condition:
    """Return that the lines of a bundle, creases by their numbers, are straight.

    >>> from graphs.convert.panels import scd_from_panels
    >>> from synth.realisation.pattern import pattern_of
    >>> fan = pattern_of(scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)]))
    >>> off, by = straight_lines(fan, bundles(fan)[0])(np.random.default_rng(0).normal(size=(5, 2)))
    >>> off.shape, by.shape
    ((1,), (1, 10))
    """
    on = set(bundle)
    pairs = []
    for vertex, one, other in _opposite(pattern):
        if one in on:
            pairs.append(((vertex, _far(pattern, one, vertex)), (vertex, _far(pattern, other, vertex))))
    return _parallel(pairs)


def bent_line(pattern: Pattern, angle: float) -> Condition | None:
    """Return that a line is bent by an angle at the first vertex of four creases; None if there is no such vertex.

    Radians. Where a sheet is symmetric, lines are bent alike at all vertices to which that one is taken.
    """
    found = _opposite(pattern)
    if not found:
        return None
    vertex, first, _ = found[0]
    _, second, _ = found[1]
    corner_of = {(int(b), int(c)): number for number, (_, b, c) in enumerate(pattern.corners)}
    corners = [corner_of[vertex, _far(pattern, crease, vertex)] for crease in (first, second)]

    def condition(unknowns: Floats) -> tuple[Floats, Floats]:
        angles, by_places = opened_angles(pattern, unknowns[: pattern.vertices])
        by = np.zeros((1, unknowns.size))
        by[0, : by_places.shape[1]] = by_places[corners].sum(axis=0)
        return np.array([angles[corners].sum() - np.pi + angle]), by

    return condition


def parallel_creases(pattern: Pattern) -> Condition | None:
    """Return that opposite creases of panels with four sides are parallel; None if no panel has such."""
    pairs = [(pattern.creases[one], pattern.creases[other]) for one, other in _across(pattern)]
    return _parallel(pairs) if pairs else None


def bundles(pattern: Pattern) -> list[tuple[int, ...]]:
    """Return the creases of each bundle of lines that go through a vertex of four creases.

    >>> from graphs.convert.panels import scd_from_panels
    >>> from synth.realisation.pattern import pattern_of
    >>> fan = pattern_of(scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)]))
    >>> [len(creases) for creases in bundles(fan)]
    [2, 2]
    """
    through = [(one, other) for _, one, other in _opposite(pattern)]
    graph = nx.Graph()
    graph.add_edges_from(through)
    lines = set(graph)
    graph.add_edges_from((one, other) for one, other in _across(pattern) if {one, other} <= lines)
    found = (tuple(sorted(creases)) for creases in nx.connected_components(graph))
    return sorted(creases for creases in found if lines & set(creases))


def _opposite(pattern: Pattern) -> list[tuple[int, int, int]]:
    """Return vertices of four creases with each pair of opposite creases."""
    rounds = zip(pattern.inner.tolist(), creases_round(pattern), strict=False)
    return [(vertex, met[k], met[k + 2]) for vertex, met in rounds if len(met) == 4 for k in (0, 1)]


def _across(pattern: Pattern) -> list[tuple[int, int]]:
    """Return the pairs of opposite creases of panels with four sides."""
    creases = sides_of(pattern).creases
    found = []
    for panel in pattern.panels:
        if len(panel) == 4:
            sides = [creases.get((panel[k], panel[(k + 1) % 4])) for k in range(4)]
            for one, other in ((sides[0], sides[2]), (sides[1], sides[3])):
                if one is not None and other is not None:
                    found.append((one, other))
    return found


def _far(pattern: Pattern, crease: int, vertex: int) -> int:
    a, b = pattern.creases[crease]
    return b if a == vertex else a


def _parallel(pairs: list[tuple[Edge, Edge]]) -> Condition:
    """Return that the two lines of each pair are parallel: their cross product, in the unit of the drawing."""
    ends = np.array(pairs, dtype=np.int64).reshape(-1, 2, 2)
    rows = np.arange(len(ends))

    def condition(unknowns: Floats) -> tuple[Floats, Floats]:
        one = unknowns[ends[:, 0, 1]] - unknowns[ends[:, 0, 0]]
        other = unknowns[ends[:, 1, 1]] - unknowns[ends[:, 1, 0]]
        by = np.zeros((len(ends), *unknowns.shape))
        by_one = np.stack([other[:, 1], -other[:, 0]], axis=1)
        by_other = np.stack([-one[:, 1], one[:, 0]], axis=1)
        for line, slope in ((0, by_one), (1, by_other)):
            np.add.at(by, (rows, ends[:, line, 1]), slope)
            np.add.at(by, (rows, ends[:, line, 0]), -slope)
        return one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0], by.reshape(len(ends), -1)

    return condition
