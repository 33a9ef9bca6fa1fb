"""Symmetries of a type that a drawing in the plane can have: turns and mirrors of its border.

A drawing with a given outer face is mapped to itself by maps that turn its border or reflect it. Drawn
barycentrically in a regular border it has all of them; conditions keep them while the shape is improved. A centre
at infinity across a hole that is mapped to itself leaves half turns and mirrors only. Theory:
docs/theory/realisation.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from graphs.geometry import rigid_motion
from graphs.mechanism.sheet import Edge
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats, Ints
from synth.realisation.pattern import Pattern
from synth.realisation.wanted.walking import Sides, sides_of

__all__ = ["Symmetry", "off_symmetry", "symmetries"]


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
