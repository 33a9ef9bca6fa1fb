"""Crease patterns and linkages in space for tests of folding, made from formulas."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np

from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet


def miura(rows: int, columns: int, sector: float) -> Sheet:
    """Return a flat Miura sheet: ``rows`` panels along each straight line, ``columns`` along each zigzag.

    Its folded state has tan(b / 2) = cos(sector) tan(a / 2), a on the zigzag creases, b on the straight ones.
    """
    number = {(i, j): i * (columns + 1) + j for i in range(rows + 1) for j in range(columns + 1)}
    places = [(j * sin(sector), i + j % 2 * cos(sector)) for i, j in number]
    edges, letters = [], ""
    for i in range(rows + 1):
        for j in range(columns):
            edges.append((number[i, j], number[i, j + 1]))
            letters += "B" if i in (0, rows) else "MV"[i % 2]
    for i in range(rows):
        for j in range(columns + 1):
            edges.append((number[i, j], number[i + 1, j]))
            letters += "B" if j in (0, columns) else "VM"[(i + j) % 2]
    faces = [
        (number[i, j], number[i, j + 1], number[i + 1, j + 1], number[i + 1, j])
        for i in range(rows)
        for j in range(columns)
    ]
    return Sheet(len(number), tuple(edges), letters, tuple(faces), tuple(places))


def is_zigzag(sheet: Sheet, joints) -> np.ndarray:
    """Return which creases of a Miura sheet lie on its zigzags: they do not go straight up."""
    return np.array(
        [sheet.coordinates[a][0] != sheet.coordinates[b][0] for a, b in (sheet.edges[j] for j in joints)]
    )


def fan(directions, letters: str = "") -> Sheet:
    """Return a flat vertex with creases in given directions, radians, rising."""
    n = len(directions)
    places = ((0.0, 0.0), *((cos(t), sin(t)) for t in directions))
    faces = tuple((0, i + 1, (i + 1) % n + 1) for i in range(n))
    return Sheet(n + 1, tuple((0, i + 1) for i in range(n)), letters or "U" * n, faces, places)


def turned(angle: float, axis: int) -> np.ndarray:
    """Return a rotation about a coordinate axis, as a 4 x 4 matrix."""
    made = np.eye(4)
    a, b = [(1, 2), (2, 0), (0, 1)][axis]
    made[a, a] = made[b, b] = cos(angle)
    made[a, b], made[b, a] = -sin(angle), sin(angle)
    return made


def denavit_hartenberg(lengths, twists, angles) -> tuple[SCGraph, dict]:
    """Return a closed chain of hinges, each about z, then along and about x, with the axes of its pose."""
    n, frame, axes = len(lengths), np.eye(4), {}
    for joint in range(n):
        axes[joint] = frame[:3, 3].tolist(), frame[:3, 2].tolist()
        along = np.eye(4)
        along[0, 3] = lengths[joint]
        frame = frame @ turned(angles[joint], 2) @ along @ turned(twists[joint], 0)
    assert abs(frame - np.eye(4)).max() < 1e-9, "the chain does not close"
    return SCGraph(n, [((joint - 1) % n, joint) for joint in range(n)]), axes


def bennett(twists: tuple[float, float], first: float) -> tuple[SCGraph, dict]:
    """Return Bennett's linkage at an angle of its first joint."""
    a, b = twists
    second = 2.0 * np.arctan2(sin((b + a) / 2.0), sin((b - a) / 2.0) * np.tan(first / 2.0))
    lengths = [sin(a), sin(b), sin(a), sin(b)]
    return denavit_hartenberg(lengths, [a, b, a, b], [first, second, 2 * pi - first, 2 * pi - second])
