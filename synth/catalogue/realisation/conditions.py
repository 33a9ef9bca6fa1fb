"""Conditions on flat drawings: flat-foldable, symmetric, straight or parallel creases, agreeing ratios.

A condition gives numbers that are to be 0, and their derivatives. About a vertex of four creases opposite creases
follow each other along a *line*; lines that enter a panel of four sides at opposite sides run side by side, and
form a *bundle*. A Miura sheet has one bundle of straight lines and one of zigzags, and parallel opposite creases.

Sources: T. Kawasaki, On the relation between mountain-creases and valley-creases of a flat origami (1989); T.
Tachi, Generalization of rigid-foldable quadrilateral-mesh origami (2009); T. A. Evans, R. J. Lang, S. P. Magleby,
L. L. Howell, Rigidly foldable origami gadgets and tessellations (2015). Theory: docs/theory/realisation.md.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import networkx as nx
import numpy as np

from graphs.errors import UnsolvableError, numbered, shown
from graphs.geometry import rigid_motion
from graphs.mechanism.sheet import Edge, sides_of_face
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats, Ints
from synth.catalogue.realisation.measures import opened_angles
from synth.catalogue.realisation.pattern import Pattern, Sides

Condition = Callable[[Floats], tuple[Floats, Floats]]
"""Of unknowns float[n, 2] (vertices, centres across holes, hubs): float[c] to be 0, derivatives float[c, 2 n]."""


def together(*conditions: Condition) -> Condition:
    """Return several conditions as one."""
    if len(conditions) == 1:
        return conditions[0]

    def condition(unknowns: Floats) -> tuple[Floats, Floats]:
        residuals, jacobians = zip(*(part(unknowns) for part in conditions), strict=True)
        return np.concatenate(residuals), np.concatenate(jacobians)

    return condition


def flat_folding(pattern: Pattern) -> Condition:
    """Return by how much the reflections in the creases round each inner vertex and each hole miss to close.

    Round a vertex this is Kawasaki's condition: every other sector, added up, is 180 degrees. Round a hole the
    lines of the creases need not meet, and the reflections must give neither a rotation nor a translation. Raises
    `UnsolvableError` for an odd number of creases: so many reflections turn the sheet over.
    """
    inner = pattern.inner.tolist()
    for place, met in enumerate(pattern.rounds):
        if len(met) % 2:
            where = "a vertex" if place < len(inner) else "a hole"
            names = ", ".join(shown(pattern.joints[crease]) for crease in met)
            number = numbered(len(met), "crease")
            raise UnsolvableError(f"the type cannot fold flat: {number}, an odd number, about {where} (joints {names})")
    alternate = np.zeros((len(inner), len(pattern.corners)))  # the corners round each vertex, + and - by turns
    for row, (vertex, met) in enumerate(zip(inner, pattern.rounds, strict=False)):
        for place, crease in enumerate(met):
            alternate[row, pattern.corner_before(vertex, crease)] = (-1.0) ** place
    round_holes = [[pattern.creases[crease] for crease in met] for met in pattern.rounds[len(inner) :]]

    def round_vertices(unknowns: Floats) -> tuple[Floats, Floats]:
        angles, by_places = opened_angles(pattern, unknowns[: pattern.vertices])
        by = np.zeros((len(inner), unknowns.size))
        by[:, : by_places.shape[1]] = alternate @ by_places
        return alternate @ angles, by

    return together(round_vertices, *(partial(_round_hole, lines) for lines in round_holes))


def _round_hole(lines: list[Edge], unknowns: Floats) -> tuple[Floats, Floats]:
    """Return rotation and translation of the reflections in some lines, in turn, and the derivatives."""
    mirrors = [_reflection(unknowns[a], unknowns[b]) for a, b in lines]
    before = [np.eye(3)]
    for matrix, _ in mirrors:
        before.append(before[-1] @ matrix)
    whole, after = before[-1], np.eye(3)
    by = np.zeros((3, *unknowns.shape))
    square = whole[0, 0] ** 2 + whole[1, 0] ** 2
    for place in reversed(range(len(lines))):
        matrix, derivatives = mirrors[place]
        changes = before[place] @ derivatives @ after
        turns = (changes[:, 1, 0] * whole[0, 0] - changes[:, 0, 0] * whole[1, 0]) / square
        for end, vertex in enumerate(lines[place]):
            here = slice(2 * end, 2 * end + 2)
            by[:, vertex] += np.stack([turns[here], changes[here, 0, 2], changes[here, 1, 2]])
        after = matrix @ after
    off = np.array([np.arctan2(whole[1, 0], whole[0, 0]), whole[0, 2], whole[1, 2]])
    return off, by.reshape(3, -1)


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
    """Return that the lines of a bundle, creases by their numbers, are straight."""
    on_lines = set(bundle)
    return _parallel(
        [
            ((vertex, pattern.far_end(vertex, crease)), (vertex, pattern.far_end(vertex, other)))
            for vertex, crease, other in _opposite(pattern)
            if crease in on_lines
        ]
    )


def bent_line(pattern: Pattern, angle: float) -> Condition | None:
    """Return that a line is bent by an angle, radians, at the first vertex of four creases; None without one."""
    opposite = _opposite(pattern)
    if not opposite:
        return None
    (vertex, first, _), (_, second, _) = opposite[:2]  # both pairs of creases of the first vertex
    corners = [pattern.corner_before(vertex, crease) for crease in (first, second)]

    def condition(unknowns: Floats) -> tuple[Floats, Floats]:
        angles, by_places = opened_angles(pattern, unknowns[: pattern.vertices])
        by = np.zeros((1, unknowns.size))
        by[0, : by_places.shape[1]] = by_places[corners].sum(axis=0)
        return np.array([angles[corners].sum() - np.pi + angle]), by

    return condition


def parallel_creases(pattern: Pattern) -> Condition | None:
    """Return that opposite creases of panels with four sides are parallel; None if no panel has such."""
    pairs = [(pattern.creases[crease], pattern.creases[other]) for crease, other in _across(pattern)]
    return _parallel(pairs) if pairs else None


def bundles(pattern: Pattern) -> list[tuple[int, ...]]:
    """Return the creases of each bundle of lines that go through a vertex of four creases."""
    graph = nx.Graph()
    graph.add_edges_from((crease, other) for _, crease, other in _opposite(pattern))
    on_lines = set(graph)
    graph.add_edges_from(pair for pair in _across(pattern) if on_lines.issuperset(pair))
    return sorted(tuple(sorted(creases)) for creases in nx.connected_components(graph))


def _opposite(pattern: Pattern) -> list[tuple[int, int, int]]:
    """Return vertices of four creases with each pair of opposite creases."""
    rounds = zip(pattern.inner.tolist(), pattern.rounds, strict=False)
    return [(vertex, met[k], met[k + 2]) for vertex, met in rounds if len(met) == 4 for k in (0, 1)]


def _across(pattern: Pattern) -> list[tuple[int, int]]:
    """Return the pairs of opposite creases of panels with four sides."""
    creases = pattern.sides.creases
    four = [sides_of_face(panel) for panel in pattern.panels if len(panel) == 4]
    opposite = ((sides[k], sides[k + 2]) for sides in four for k in (0, 1))
    return [(creases[side], creases[other]) for side, other in opposite if side in creases and other in creases]


def _parallel(pairs: list[tuple[Edge, Edge]]) -> Condition:
    """Return that the two lines of each pair are parallel: their cross product, in the unit of the drawing."""
    ends = np.array(pairs, dtype=np.int64).reshape(-1, 2, 2)
    rows = np.arange(len(ends))

    def condition(unknowns: Floats) -> tuple[Floats, Floats]:
        along = unknowns[ends[:, 0, 1]] - unknowns[ends[:, 0, 0]]
        other = unknowns[ends[:, 1, 1]] - unknowns[ends[:, 1, 0]]
        by = np.zeros((len(ends), *unknowns.shape))
        by_along = np.stack([other[:, 1], -other[:, 0]], axis=1)
        by_other = np.stack([-along[:, 1], along[:, 0]], axis=1)
        for line, slope in ((0, by_along), (1, by_other)):
            np.add.at(by, (rows, ends[:, line, 1]), slope)
            np.add.at(by, (rows, ends[:, line, 0]), -slope)
        return along[:, 0] * other[:, 1] - along[:, 1] * other[:, 0], by.reshape(len(ends), -1)

    return condition


def panels_between_vertices(pattern: Pattern) -> list[tuple[int, ...]]:
    """Return the panels all of whose corners are inner vertices of four creases."""
    four = {vertex for vertex, _, _ in _opposite(pattern)}
    return [panel for panel in pattern.panels if four.issuperset(panel)]


def agreeing_ratios(pattern: Pattern, modes: Sequence[bool]) -> Condition:
    """Return that the product of ratios round each panel between vertices of four creases is 1: its logarithm.

    At a flat-foldable vertex of four creases, sectors a and b on both sides of a crease, the half-angle tangent of
    that crease is cos((a + b) / 2) / cos((a - b) / 2) times those of its neighbours in one mode, sin((a + b) / 2)
    / sin((a - b) / 2) times them in the other, but for signs; the ratios stay while the vertex folds, and agree
    round a panel if their product is 1. Modes are those of the inner vertices, in their order: True for sines.
    """
    mode_of = dict(zip(pattern.inner.tolist(), modes, strict=True))
    number_of = {(int(at), int(before)): number for number, (before, at, _) in enumerate(pattern.corners)}
    rows: list[list[tuple[int, int, bool]]] = []
    for panel in panels_between_vertices(pattern):
        rows.append([])
        for before, at in sides_of_face(panel):
            after = pattern.sides.after[before, at][1]
            rows[-1].append((number_of[at, before], number_of[at, after], mode_of[at]))

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


def _logarithm(sector: float, other: float, sines: bool) -> tuple[float, tuple[float, float]]:
    """Return the logarithm of the ratio between two sectors, and its derivatives by both."""
    half, apart = (sector + other) / 2.0, (sector - other) / 2.0
    if sines:
        ratio, first, second = np.sin(half) / np.sin(apart), 0.5 / np.tan(half), 0.5 / np.tan(apart)
    else:
        ratio, first, second = np.cos(half) / np.cos(apart), -0.5 * np.tan(half), -0.5 * np.tan(apart)
    return float(np.log(np.abs(ratio))), (first - second, first + second)


@dataclass(frozen=True, slots=True)
class _Map:
    """A map of a pattern to itself: where unknowns and edges go, and the motion of the plane that does it."""

    rows: Ints
    edges: Ints
    matrix: Floats
    directions: Flags

    def missed(self, unknowns: Floats) -> tuple[Floats, Floats]:
        """Return by how much it misses to take each unknown to its image; a direction may be reversed."""
        there = unknowns @ self.matrix.T
        signs = np.where(self.directions & ((unknowns[self.rows] * there).sum(axis=1) < 0.0), -1.0, 1.0)
        count = len(unknowns)
        by = np.zeros((count, 2, count, 2))
        at = np.arange(count)
        by[at, :, at, :] -= signs[:, None, None] * self.matrix
        for axis in range(2):
            by[at, axis, self.rows, axis] += 1.0
        off = unknowns[self.rows] - signs[:, None] * there
        return off.ravel(), by.reshape(2 * count, 2 * count)


@dataclass(frozen=True, slots=True)
class SymmetryGroup:
    """A group of maps of a pattern to itself, by rotations and mirrors of the plane that keep its border.

    `turns` is the order of the rotations, 1 for none; mirrors are none, or as many as turns. A barycentric drawing
    in a regular border has all of them; as conditions they are kept while the shape is improved.
    """

    turns: int
    mirrors: int
    _maps: tuple[_Map, ...]
    _generators: tuple[_Map, ...]

    def __str__(self) -> str:
        parts = [f"turns by {360 / self.turns:.6g} degrees"] if self.turns > 1 else []
        parts += [numbered(self.mirrors, "mirror")] if self.mirrors else []
        return ", ".join(parts)

    def condition(self, unknowns: Floats) -> tuple[Floats, Floats]:
        """Return by how much unknowns, float[n, 2], miss their images, and derivatives."""
        return together(*(generator.missed for generator in self._generators))(unknowns)

    def upright(self, places: Floats) -> Floats:
        """Return places rotated so that the first mirror is upright, if there is one."""
        if not self.mirrors:
            return places
        matrix = self._generators[-1].matrix
        angle = (np.pi - np.arctan2(matrix[1, 0], matrix[0, 0])) / 2
        cos, sin = np.cos(angle), np.sin(angle)
        return np.asarray(places @ np.array([[cos, sin], [-sin, cos]]))

    def evened(self, aims: Floats) -> Floats:
        """Return the mean of the aims of edges that are mapped to each other: float[E]."""
        return np.asarray(np.mean([aims[map_.edges] for map_ in self._maps], axis=0))

    def error(self, places: Floats) -> float:
        """Return the largest distance of a vertex from the image of another, in units of the extent.

        The places may be rotated and translated in the plane.
        """
        centred = places - places.mean(axis=0)
        worst = 0.0
        for map_ in self._maps:
            image = centred[map_.rows[: len(places)]]
            rotation, shift = rigid_motion(centred, image, mirrored=np.linalg.det(map_.matrix) < 0.0)
            worst = max(worst, float(np.linalg.norm(centred @ rotation.T + shift - image, axis=1).max()))
        return worst / float(np.ptp(places, axis=0).max())


def symmetries(pattern: Pattern) -> tuple[SymmetryGroup, ...]:
    """Return the groups of symmetries that a drawing may have, the largest first; none if there is none."""
    border = len(pattern.outer)
    turns = dict(_maps(pattern, mirrored=False))
    mirrors = dict(_maps(pattern, mirrored=True))
    groups = []
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
                groups.append(SymmetryGroup(len(group), len(group), (*of_turns, *of_mirrors), generators))
        if len(group) > 1:
            groups.append(SymmetryGroup(len(group), 0, of_turns, first_turn))
    return tuple(sorted(groups, key=lambda symmetry: -(symmetry.turns + symmetry.mirrors)))


def _maps(pattern: Pattern, *, mirrored: bool) -> Iterator[tuple[int, _Map]]:
    """Yield where the border goes, and the map, for each that takes panels to panels and centres to centres."""
    outer = pattern.outer
    for shift in range(len(outer)):
        ends = (outer[shift - 1], outer[shift]) if mirrored else (outer[shift], outer[(shift + 1) % len(outer)])
        image = _image(pattern.sides, (outer[0], outer[1]), ends, mirrored=mirrored)
        if image is not None and len(set(image.values())) == pattern.vertices:
            angle = 2.0 * np.pi * shift / len(outer)
            cos, sin = np.cos(angle), np.sin(angle)
            matrix = np.array([[cos, sin], [sin, -cos]] if mirrored else [[cos, -sin], [sin, cos]])
            map_ = _map_of(pattern, np.array([image[v] for v in range(pattern.vertices)]), matrix)
            if map_ is not None:
                yield shift, map_


def _image(sides: Sides, first: Edge, to: Edge, *, mirrored: bool) -> dict[int, int] | None:
    """Return the images of the vertices if a side goes to another; None if the panels do not fit."""
    image = {first: to}
    work = [first]
    for side in work:  # from one side to all: to the next of its panel, and across creases
        there = image[side]
        if (side in sides.creases) != (there in sides.creases):
            return None
        # a mirror takes the side that follows to the one before
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
    """Return a map of vertices with its effect on all unknowns; None if a centre has none, or a wrong one."""
    number = {frozenset(crease): place for place, crease in enumerate(pattern.creases)}
    free = pattern.free_centres
    place_of = {(frozenset(p.creases), p.infinite): place for place, p in enumerate(pattern.pointings)}
    rows = list(image.tolist())
    for place, pointing in enumerate(pattern.pointings):
        creases = frozenset(
            number[frozenset(image[list(pattern.creases[crease])].tolist())] for crease in pointing.creases
        )
        goes = place_of.get((creases, pointing.infinite))
        if goes is None:
            return None
        turned = np.linalg.det(matrix) > 0.0 and abs(matrix[1, 0]) > DOUBLE.parallel
        if pointing.infinite and goes == place and turned:  # a direction that only half turns and mirrors keep
            return None
        if pointing.vertex is None:
            rows.append(pattern.vertices + free.index(pattern.pointings[goes]))
    bent = [frozenset(pattern.panels[place]) for place in np.flatnonzero(pattern.bent)]
    first = len(rows)
    rows += [first + bent.index(frozenset(image[list(panel)].tolist())) for panel in map(list, bent)]
    directions = np.zeros(len(rows), dtype=bool)
    directions[pattern.vertices : first] = [pointing.infinite for pointing in free]
    ends = {frozenset(edge): place for place, edge in enumerate(pattern.edges.tolist())}
    edges = [ends[frozenset(edge)] for edge in image[pattern.edges].tolist()]
    return _Map(np.array(rows), np.array(edges), matrix, directions)


@dataclass(frozen=True, slots=True)
class ConditionErrors:
    """How well a drawing meets its conditions; None for what is not among them.

    `off_flat` is the largest error of flat-foldability, radians, and units of length round holes; `off_symmetry`
    the largest distance of a vertex from its image, in units of the extent.
    """

    off_flat: float | None = None
    off_symmetry: float | None = None
    symmetry: str = ""

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on, for the conditions only."""
        flat = {} if self.off_flat is None else {"off_flat_folding": self.off_flat}
        if self.off_symmetry is None:
            return flat
        return flat | {"symmetry": self.symmetry, "off_symmetry": self.off_symmetry}

    def lines(self) -> list[str]:
        """Return the lines that are printed."""
        lines = []
        if self.off_flat is not None:
            lines.append(
                "flat-foldable: alternate sectors sum to 180 degrees, and reflections round holes close, to "
                f"{self.off_flat:.0e}; the order of layers was not searched for"
            )
        if self.off_symmetry is not None:
            lines.append(f"symmetric: {self.symmetry}, to {self.off_symmetry:.0e} of the extent")
        return lines


@dataclass(frozen=True, slots=True)
class DrawingConditions:
    """Further conditions on drawings: flat-foldable, symmetric under a group, or both, and others."""

    flat_foldable: bool = False
    symmetry: SymmetryGroup | None = None
    others: tuple[Condition, ...] = ()

    def conditions(self, pattern: Pattern) -> list[Condition]:
        """Return the conditions that drawings meet exactly."""
        flat = [flat_folding(pattern)] if self.flat_foldable else []
        return [*flat, *([self.symmetry.condition] if self.symmetry is not None else []), *self.others]

    def errors(self, pattern: Pattern, places: Floats) -> ConditionErrors:
        """Return how well a drawing meets them."""
        off = None
        if self.flat_foldable:
            off = float(np.abs(flat_folding(pattern)(places)[0]).max(initial=0.0))
        if self.symmetry is None:
            return ConditionErrors(off)
        return ConditionErrors(off, self.symmetry.error(places), str(self.symmetry))


def choices_of_conditions(pattern: Pattern, *, flat_foldable: bool, symmetric: bool) -> tuple[DrawingConditions, ...]:
    """Return the conditions to try one after the other, the largest group of symmetries first.

    Raises `UnsolvableError` if it cannot be flat-foldable, or has no symmetry that keeps its border.
    """
    if flat_foldable:
        flat_folding(pattern)  # raises where an odd number of creases prevents it
    if not symmetric:
        return (DrawingConditions(flat_foldable),)
    groups = symmetries(pattern)
    if not groups:
        raise UnsolvableError("the type has no symmetry that a drawing with its border could have")
    return tuple(DrawingConditions(flat_foldable, group) for group in groups)
