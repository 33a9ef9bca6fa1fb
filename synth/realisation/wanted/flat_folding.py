"""Flat-foldable drawings: reflected in the creases round a vertex or a hole in turn, the sheet closes.

Round a vertex this is Kawasaki's condition: every other sector, added up, is 180 degrees. Round a hole the lines
of the creases need not meet, and the reflections must give neither a turn nor a shift. In which order layers lie
is not asked. Source: T. Kawasaki, On the relation between mountain-creases and valley-creases of a flat origami
(1989). Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

import numpy as np

from graphs.errors import UnsolvableError, shown
from graphs.mechanism.sheet import Edge
from graphs.types import Floats
from synth.realisation.measures import opened_angles
from synth.realisation.pattern import Pattern
from synth.realisation.wanted.conditions import Condition
from synth.realisation.wanted.walking import creases_round

__all__ = ["flat_folding", "off_flat"]


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
