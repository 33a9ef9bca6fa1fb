"""Crease patterns that fold flat by construction, for tests of layers: sheets folded along random lines, grids, fans."""

from __future__ import annotations

import csv
import os
from itertools import pairwise
from math import cos, pi, sin
from pathlib import Path

import numpy as np
import pytest

from graphs.mechanism.sheet import Sheet, with_all_edges

_ROOT = Path(__file__).resolve().parents[2]


def published() -> Path:
    """Return the folder of patterns with published numbers of states; skip the test where it is not at hand."""
    folder = Path(os.environ.get("SYNTHEDRA_LAYERS", _ROOT.parent / "shared" / "layers"))
    if not (folder / "INDEX.tsv").exists():
        pytest.skip("Flat-Folder's patterns are not at hand: set SYNTHEDRA_LAYERS to a folder with INDEX.tsv")
    return folder


def published_states() -> dict[str, dict[str, str]]:
    """Return the rows of the index by the names of files."""
    with (published() / "INDEX.tsv").open(encoding="utf-8") as file:
        return {row["name"]: row for row in csv.DictReader(file, delimiter="\t")}


def unassigned_map(rows: int, columns: int) -> Sheet:
    """Return a map: a grid of unit squares with unassigned creases."""
    corners = [(float(x), float(y)) for y in range(rows + 1) for x in range(columns + 1)]
    at = [[y * (columns + 1) + x for x in range(columns + 1)] for y in range(rows + 1)]
    faces = tuple((at[y][x], at[y][x + 1], at[y + 1][x + 1], at[y + 1][x]) for y in range(rows) for x in range(columns))
    return with_all_edges(Sheet(len(corners), (), "", faces, tuple(corners)))


def _cut(polygon, normal, offset):
    """Return the parts of a convex polygon, float[n, 2], where normal . x is at most, and at least, the offset."""
    heights = polygon @ normal - offset
    sides = []
    for sign in (-1.0, 1.0):
        part = []
        ring = list(zip([*polygon, polygon[0]], [*heights, heights[0]], strict=True))
        for (p, h), (q, k) in pairwise(ring):
            if sign * h >= 0:
                part.append(p)
            if h * k < 0:
                part.append(p + (q - p) * h / (h - k))
        sides.append(np.array(part) if len(part) > 2 else None)
    return sides


def folded_sheet(rng: np.random.Generator, folds: int, panels: int) -> tuple[Sheet, list[int]]:
    """Return a square folded along random lines, all its layers each time, and its panels from the lowest up.

    Folding stops before there are more panels than asked for.
    """
    square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    stack = [(square, np.eye(2), np.zeros(2))]  # polygon in the image, and x = linear @ pattern + shift
    for _ in range(folds):
        points = np.concatenate([polygon for polygon, *_ in stack])
        through = points.min(axis=0) + rng.uniform(0.25, 0.75, 2) * np.ptp(points, axis=0)
        turn = rng.uniform(0, pi)
        normal = np.array([cos(turn), sin(turn)])
        mirror = np.eye(2) - 2 * np.outer(normal, normal)
        offset = float(through @ normal)
        kept, turned = [], []
        for polygon, linear, shift in stack:
            low, high = _cut(polygon, normal, offset)
            if low is not None:
                kept.append((low, linear, shift))
            if high is not None:
                image = high @ mirror + 2 * offset * normal
                turned.append((image, mirror @ linear, mirror @ shift + 2 * offset * normal))
        if len(kept) + len(turned) > panels:
            break
        stack = [*kept, *reversed(turned)]
    number: dict[tuple[int, int], int] = {}
    corners: list[tuple[float, float]] = []
    faces = []
    for polygon, linear, shift in stack:
        flat = (polygon - shift) @ linear  # the linear part is its own transposed inverse
        flat = flat if np.linalg.det(linear) > 0 else flat[::-1]
        face = []
        for x, y in flat.tolist():
            key = round(x * 1e7), round(y * 1e7)
            if key not in number:
                number[key] = len(corners)
                corners.append((x, y))
            face.append(number[key])
        faces.append(tuple(face))
    sheet = with_all_edges(Sheet(len(corners), (), "", tuple(faces), tuple(corners)))
    up = [np.linalg.det(linear) > 0 for _, linear, _ in stack]
    beside: dict[frozenset[int], list[int]] = {}
    for place, face in enumerate(faces):
        for a, b in zip(face, (*face[1:], face[0]), strict=True):
            beside.setdefault(frozenset((a, b)), []).append(place)
    letters = ""
    for edge in sheet.edges:
        around = beside[frozenset(edge)]
        if len(around) == 1:
            letters += "B"
        else:
            low, _ = sorted(around)
            letters += "V" if up[low] else "M"  # the upper panel lies on the front of the lower, or on its back
    order = list(range(len(faces)))
    folded_up = order if up[0] else order[::-1]  # seen with panel 0 face up
    return Sheet(len(corners), sheet.edges, letters, tuple(faces), tuple(corners)), folded_up


def vertex_of(sectors, letters: str) -> Sheet:
    """Return a vertex with these sectors, in radians, and creases of length 1."""
    angles = np.concatenate([[0.0], np.cumsum(sectors)[:-1]])
    corners = [(0.0, 0.0), *((float(cos(a)), float(sin(a))) for a in angles)]
    count = len(angles)
    faces = tuple((0, k + 1, (k + 1) % count + 1) for k in range(count))
    edges = tuple((0, k + 1) for k in range(count)) + tuple((k + 1, (k + 1) % count + 1) for k in range(count))
    return Sheet(count + 1, edges, letters + "B" * count, faces, tuple(corners))
