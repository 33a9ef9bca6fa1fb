"""Conditions on flat drawings: flat-foldable, symmetric, straight or parallel creases, agreeing ratios.

TODO
Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import networkx as nx
import numpy as np

from graphs.arrays import Flags, Floats, Ints
from graphs.errors import UnsolvableError, shown
from graphs.geometry import rigid_motion
from graphs.mechanism.sheet import Edge, sides_of_face
from graphs.tolerances import DOUBLE
from synth.realisation.measures import opened_angles
from synth.realisation.pattern import Pattern, Sides, creases_round, sides_of

__all__ = [
    "Condition",
    "Kept",
    "Symmetry",
    "Wishes",
    "agreeing_ratios",
    "bent_line",
    "bundles",
    "flat_folding",
    "off_flat",
    "off_symmetry",
    "panels_between_vertices",
    "parallel_creases",
    "straight_lines",
    "symmetries",
    "together",
    "wishes_for",
]

Condition = Callable[[Floats], tuple[Floats, Floats]]
"""Of unknowns float[n, 2] (vertices, centres across holes, hubs): float[c] to be 0, derivatives float[c, 2 n]."""


def together(conditions: Sequence[Condition]) -> Condition:
    """Return several conditions as one.

    >>> at_rest = together([lambda unknowns: (unknowns.ravel(), np.eye(unknowns.size))] * 2)
    >>> off, by = at_rest(np.zeros((3, 2)))
    >>> off.shape, by.shape
    ((12,), (12, 6))
    """

    def condition(unknowns: Floats) -> tuple[Floats, Floats]:
        parts = [one(unknowns) for one in conditions]
        return np.concatenate([off for off, _ in parts]), np.concatenate([by for _, by in parts])

    return condition


def flat_folding(pattern: Pattern) -> Condition:
    """Return by how much the reflections round each inner vertex and each hole miss to close, with derivatives.

    Raises `UnsolvableError` if an odd number of creases goes round a vertex or a hole: so many reflections turn
    the sheet over.
    """
    rounds = creases_round(pattern)
    _check_even(pattern, rounds)
    inner = len(pattern.inner)
    alternate = _alternating(pattern, rounds[:inner])
    round_holes = [[pattern.creases[crease] for crease in met] for met in rounds[inner:]]

    def condition(unknowns: Floats) -> tuple[Floats, Floats]:
        angles, by_places = opened_angles(pattern, unknowns[: pattern.vertices])
        by = np.zeros((inner, unknowns.size))
        by[:, : by_places.shape[1]] = alternate @ by_places
        parts = [(alternate @ angles, by), *(_round_hole(unknowns, lines) for lines in round_holes)]
        return np.concatenate([off for off, _ in parts]), np.concatenate([rows for _, rows in parts])

    return condition


def off_flat(pattern: Pattern, places: Floats) -> float:
    """Return by how much a drawing misses to be flat-foldable at most.

    In radians, and in units of length round holes.
    """
    off, _ = flat_folding(pattern)(places)
    return float(np.abs(off).max(initial=0.0))


def _check_even(pattern: Pattern, rounds: list[tuple[int, ...]]) -> None:
    inner = len(pattern.inner)
    odd = [met for met in rounds if len(met) % 2]
    if odd:
        where = "a vertex" if rounds.index(odd[0]) < inner else "a hole"
        names = ", ".join(shown(pattern.joints[crease]) for crease in odd[0])
        raise UnsolvableError(
            f"it cannot fold flat: {len(odd[0])} creases, an odd number, about {where} (joints {names})"
        )


def _alternating(pattern: Pattern, rounds: list[tuple[int, ...]]) -> Floats:
    """Return float[I, K]: the corners round each inner vertex, + and - by turns."""
    signs = np.zeros((len(rounds), len(pattern.corners)))
    corner_of = {(int(b), int(c)): number for number, (_, b, c) in enumerate(pattern.corners)}
    for row, (vertex, met) in enumerate(zip(pattern.inner.tolist(), rounds, strict=True)):
        for place, crease in enumerate(met):
            a, b = pattern.creases[crease]
            signs[row, corner_of[vertex, b if a == vertex else a]] = (-1.0) ** place
    return signs


def _round_hole(unknowns: Floats, lines: list[Edge]) -> tuple[Floats, Floats]:
    """Return turn and shift of the reflections in some lines, one after the other, and the derivatives."""
    mirrors = [_reflection(unknowns[a], unknowns[b]) for a, b in lines]
    before = [np.eye(3)]
    for matrix, _ in mirrors:
        before.append(before[-1] @ matrix)
    whole, after = before[-1], np.eye(3)
    by = np.zeros((3, *unknowns.shape))
    for place in reversed(range(len(lines))):
        matrix, derivatives = mirrors[place]
        changes = before[place] @ derivatives @ after
        for end, vertex in enumerate(lines[place]):
            by[:, vertex] += np.stack([_read(whole, change) for change in changes[2 * end : 2 * end + 2]], axis=1)
        after = matrix @ after
    off = np.array([np.arctan2(whole[1, 0], whole[0, 0]), whole[0, 2], whole[1, 2]])
    return off, by.reshape(3, -1)


def _read(whole: Floats, change: Floats) -> Floats:
    """Return how turn and shift of a motion change with its matrix."""
    turn = (change[1, 0] * whole[0, 0] - change[0, 0] * whole[1, 0]) / (whole[0, 0] ** 2 + whole[1, 0] ** 2)
    return np.array([turn, change[0, 2], change[1, 2]])


def _reflection(a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """Return the reflection in the line through two points, 3 x 3, and its derivatives by their coordinates."""
    along = b - a
    square = float(along @ along)
    angle = 2.0 * np.arctan2(along[1], along[0])
    cos, sin = np.cos(angle), np.sin(angle)
    mirror, turned = np.array([[cos, sin], [sin, -cos]]), np.array([[-sin, cos], [cos, sin]])
    matrix = np.eye(3)
    matrix[:2, :2], matrix[:2, 2] = mirror, a - mirror @ a
    by_angle = 2.0 * np.array([along[1], -along[0], -along[1], along[0]]) / square
    derivatives = np.zeros((4, 3, 3))
    for number, rate in enumerate(by_angle):
        derivatives[number, :2, :2] = rate * turned
        derivatives[number, :2, 2] = -rate * turned @ a
    for axis in range(2):
        unit = np.eye(2)[axis]
        derivatives[axis, :2, 2] += unit - mirror @ unit
    return matrix, derivatives


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


@dataclass(frozen=True, slots=True)
class _Map:
    """A map of a pattern to itself: where unknowns and edges go, and the motion of the plane that does it."""

    rows: Ints
    edges: Ints
    matrix: Floats
    directions: Flags


@dataclass(frozen=True, slots=True)
class Symmetry:
    """A group of maps of a pattern to itself, by turns and mirrors of the plane.

    `turns` is the order of the turns, 1 for none; mirrors are none, or as many as turns.
    """

    turns: int
    mirrors: int
    _maps: tuple[_Map, ...]
    _generators: tuple[_Map, ...]

    def __str__(self) -> str:
        told = [f"turns by {360 / self.turns:.6g} degrees"] if self.turns > 1 else []
        told += [f"{self.mirrors} mirror(s)"] if self.mirrors else []
        return ", ".join(told)

    def condition(self, unknowns: Floats) -> tuple[Floats, Floats]:
        """Return by how much unknowns, float[n, 2], miss where the maps take them, and derivatives."""
        parts = [_missed(one, unknowns) for one in self._generators]
        return np.concatenate([off for off, _ in parts]), np.concatenate([by for _, by in parts])

    def upright(self, places: Floats) -> Floats:
        """Return places turned so that the first mirror stands upright, if there is one."""
        if not self.mirrors:
            return places
        matrix = self._generators[-1].matrix
        angle = (np.pi - np.arctan2(matrix[1, 0], matrix[0, 0])) / 2
        cos, sin = np.cos(angle), np.sin(angle)
        turned: Floats = places @ np.array([[cos, sin], [-sin, cos]])
        return turned

    def evened(self, aims: Floats) -> Floats:
        """Return the mean of what edges aim at over those that are mapped to each other: float[E]."""
        evened: Floats = np.mean([aims[one.edges] for one in self._maps], axis=0)
        return evened


def off_symmetry(symmetry: Symmetry, places: Floats) -> float:
    """Return how far a vertex is at most from where a map takes another, in units of the extent.

    Places may lie anyhow in the plane.
    """
    count = len(places)
    centred = places - places.mean(axis=0)
    worst = 0.0
    for one in symmetry._maps:
        image = centred[one.rows[:count]]
        rotation, shift = rigid_motion(centred, image, mirrored=np.linalg.det(one.matrix) < 0.0)
        worst = max(worst, float(np.linalg.norm(centred @ rotation.T + shift - image, axis=1).max()))
    return worst / float(np.ptp(places, axis=0).max())


def symmetries(pattern: Pattern) -> tuple[Symmetry, ...]:
    """Return the groups of symmetries that a drawing may have, the largest first; none if there is none."""
    border = len(pattern.outer)
    turns = dict(_maps(pattern, mirrored=False))
    mirrors = dict(_maps(pattern, mirrored=True))
    found = []
    for step in (step for step in range(1, border + 1) if border % step == 0):
        group = [shift % border for shift in range(0, border, step)]
        if not turns.keys() >= set(group):
            continue
        of_turns = tuple(turns[shift] for shift in group)
        first_turn = of_turns[1:2]
        for first in range(step):
            with_mirrors = list(range(first, border, step))
            if mirrors.keys() >= set(with_mirrors):
                of_mirrors = tuple(mirrors[shift] for shift in with_mirrors)
                generators = (*first_turn, of_mirrors[0])
                found.append(Symmetry(len(group), len(group), (*of_turns, *of_mirrors), generators))
        if len(group) > 1:
            found.append(Symmetry(len(group), 0, of_turns, first_turn))
    return tuple(sorted(found, key=lambda one: -(one.turns + one.mirrors)))


def _maps(pattern: Pattern, *, mirrored: bool) -> Iterator[tuple[int, _Map]]:
    """Yield where the border goes, and the map, for each that takes panels to panels and centres to centres."""
    sides = sides_of(pattern)
    outer = pattern.outer
    for shift in range(len(outer)):
        ends = (outer[shift - 1], outer[shift]) if mirrored else (outer[shift], outer[(shift + 1) % len(outer)])
        image = _image(sides, (outer[0], outer[1]), ends, mirrored=mirrored)
        if image is not None and len(set(image.values())) == pattern.vertices:
            made = _map_of(
                pattern, np.array([image[v] for v in range(pattern.vertices)]), _motion(shift, outer, mirrored)
            )
            if made is not None:
                yield shift, made


def _motion(shift: int, outer: tuple[int, ...], mirrored: bool) -> Floats:
    """Return the turn or the mirror that takes a regular border to itself."""
    angle = 2.0 * np.pi * shift / len(outer)
    cos, sin = np.cos(angle), np.sin(angle)
    return np.array([[cos, sin], [sin, -cos]] if mirrored else [[cos, -sin], [sin, cos]])


def _image(sides: Sides, first: Edge, to: Edge, *, mirrored: bool) -> dict[int, int] | None:
    """Return where the vertices go if a side goes to another; None if the panels do not fit.

    In a mirror the side that follows goes to the one before.
    """
    image = {first: to}
    work = [first]
    for side in work:
        there = image[side]
        if (side in sides.creases) != (there in sides.creases):
            return None
        steps = [(sides.after[side], (sides.before if mirrored else sides.after)[there])]
        if side in sides.creases:
            steps.append((side[::-1], there[::-1]))
        for new, where in steps:
            if new not in image:
                work.append(new)
            if image.setdefault(new, where) != where:
                return None
    vertices: dict[int, int] = {}
    for (a, b), (c, d) in image.items():
        for vertex, goes in ((a, d), (b, c)) if mirrored else ((a, c), (b, d)):
            if vertices.setdefault(vertex, goes) != goes:
                return None
    return vertices


def _map_of(pattern: Pattern, image: Ints, matrix: Floats) -> _Map | None:
    """Return a map of vertices with what it does to all unknowns; None if a centre goes to none, or cannot."""
    number = {frozenset(crease): place for place, crease in enumerate(pattern.creases)}
    free = [one for one in pattern.pointings if one.vertex is None]
    place_of = {(frozenset(one.creases), one.infinite): place for place, one in enumerate(pattern.pointings)}
    rows = list(image.tolist())
    for place, one in enumerate(pattern.pointings):
        creases = frozenset(
            number[frozenset(image[list(pattern.creases[crease])].tolist())] for crease in one.creases
        )
        goes = place_of.get((creases, one.infinite))
        if goes is None:
            return None
        turned = np.linalg.det(matrix) > 0.0 and abs(matrix[1, 0]) > DOUBLE.parallel
        if one.infinite and goes == place and turned:
            return None
        if one.vertex is None:
            rows.append(pattern.vertices + free.index(pattern.pointings[goes]))
    bent = [frozenset(pattern.panels[place]) for place in np.flatnonzero(pattern.bent)]
    first = len(rows)
    rows += [first + bent.index(frozenset(image[list(panel)].tolist())) for panel in map(list, bent)]
    directions = np.zeros(len(rows), dtype=bool)
    directions[pattern.vertices : first] = [one.infinite for one in free]
    ends = {frozenset(edge): place for place, edge in enumerate(pattern.edges.tolist())}
    edges = [ends[frozenset(edge)] for edge in image[pattern.edges].tolist()]
    return _Map(np.array(rows), np.array(edges), matrix, directions)


def _missed(one: _Map, unknowns: Floats) -> tuple[Floats, Floats]:
    """Return by how much a map misses to take each unknown to its image; a direction may be turned about."""
    there = unknowns @ one.matrix.T
    signs = np.where(one.directions & ((unknowns[one.rows] * there).sum(axis=1) < 0.0), -1.0, 1.0)
    count = len(unknowns)
    by = np.zeros((count, 2, count, 2))
    at = np.arange(count)
    by[at, :, at, :] -= signs[:, None, None] * one.matrix
    for axis in range(2):
        by[at, axis, one.rows, axis] += 1.0
    off = unknowns[one.rows] - signs[:, None] * there
    return off.ravel(), by.reshape(2 * count, 2 * count)


@dataclass(frozen=True, slots=True)
class Wishes:
    """What drawings are to be besides: flat-foldable, symmetric under a group, or both.

    Flat-foldable: reflected in the creases round a vertex or a hole in turn, the sheet closes. Other conditions
    may be added.
    """

    flat_foldable: bool = False
    symmetry: Symmetry | None = None
    others: tuple[Condition, ...] = ()

    def conditions(self, pattern: Pattern) -> list[Condition]:
        """Return what drawings meet exactly."""
        flat = [flat_folding(pattern)] if self.flat_foldable else []
        return [*flat, *([self.symmetry.condition] if self.symmetry is not None else []), *self.others]

    def kept(self, pattern: Pattern, places: Floats) -> Kept:
        """Return how well a drawing meets them."""
        return Kept(
            off_flat(pattern, places) if self.flat_foldable else None,
            off_symmetry(self.symmetry, places) if self.symmetry is not None else None,
            "" if self.symmetry is None else str(self.symmetry),
        )


@dataclass(frozen=True, slots=True)
class Kept:
    """How well a drawing meets the wishes; None for what was not among them.

    `off_flat` is by how much reflections in creases miss to close at most, radians, and units of length round
    holes; `off_symmetry` how far a vertex is at most from where it is mapped to, in units of the extent.
    """

    off_flat: float | None = None
    off_symmetry: float | None = None
    symmetry: str = ""

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on, of what was asked for."""
        flat = {} if self.off_flat is None else {"off_flat_folding": self.off_flat}
        if self.off_symmetry is None:
            return flat
        return flat | {"symmetry": self.symmetry, "off_symmetry": self.off_symmetry}

    def lines(self) -> list[str]:
        """Return the lines that are printed."""
        told = []
        if self.off_flat is not None:
            told.append(
                "flat-foldable: alternate sectors sum to 180 degrees, and reflections round holes close, to "
                f"{self.off_flat:.0e}; the order of layers was not looked for"
            )
        if self.off_symmetry is not None:
            told.append(f"symmetric: {self.symmetry}, to {self.off_symmetry:.0e} of the extent")
        return told


def wishes_for(pattern: Pattern, *, flat_foldable: bool, symmetric: bool) -> tuple[Wishes, ...]:
    """Return what to ask of drawings, in the order in which to try: the largest group of symmetries first.

    Raises `UnsolvableError` if it cannot be flat-foldable, or has no symmetry that keeps its border.

    >>> from graphs.convert.panels import scd_from_panels
    >>> from synth.realisation.pattern import pattern_of
    >>> fan = pattern_of(scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)]))
    >>> [str(one.symmetry) for one in wishes_for(fan, flat_foldable=True, symmetric=True)][:1]
    ['turns by 90 degrees, 4 mirror(s)']
    """
    if flat_foldable:
        flat_folding(pattern)  # which says what stands in the way
    if not symmetric:
        return (Wishes(flat_foldable),)
    groups = symmetries(pattern)
    if not groups:
        raise UnsolvableError("the type has no symmetry that a drawing with its border could have")
    return tuple(Wishes(flat_foldable, group) for group in groups)
