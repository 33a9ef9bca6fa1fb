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


def bent_sheet(rng: np.random.Generator, folds: int, panels: int, angle: float) -> tuple[Sheet, Sheet, list[int]]:
    """Return a square folded flat along random lines and then bent along another by an angle, all layers together.

    The sheet in space, with its fold angles; the crease pattern before it was bent; and the panels of the sheet in
    space from the lowest up, seen from the side to which it was bent.
    """
    flat, stack = folded_sheet(rng, folds, panels)
    image, up = _images(flat)
    points = np.concatenate(list(image))
    through = points.min(axis=0) + rng.uniform(0.3, 0.7, 2) * np.ptp(points, axis=0)
    turn = rng.uniform(0, pi)
    normal = np.array([cos(turn), sin(turn)])
    offset = float(through @ normal)
    corners: list[tuple[float, ...]] = []
    number: dict[tuple[int, int], int] = {}
    faces: list[tuple[int, ...]] = []
    order: list[int] = []
    bent: list[tuple[frozenset[int], float]] = []
    for panel in stack:
        pattern = np.array([flat.coordinates[v] for v in flat.faces[panel]])
        before = len(faces)
        for polygon in _cut_both(image[panel], pattern, normal, offset):
            face = []
            for p, q in polygon:
                key = round(q[0] * 1e7), round(q[1] * 1e7)
                if key not in number:
                    number[key] = len(corners)
                    height = max(float(p @ normal) - offset, 0.0)
                    low = p - height * normal + height * cos(angle) * normal
                    corners.append((float(low[0]), float(low[1]), height * sin(angle)))
                face.append(number[key])
            order.append(len(faces))
            faces.append(tuple(face))
        pieces = [set(face) for face in faces[before:]]
        if len(pieces) == 2 and len(pieces[0] & pieces[1]) == 2:
            bent.append((frozenset(pieces[0] & pieces[1]), angle if up[panel] else -angle))
    whole = with_all_edges(Sheet(len(corners), (), "", tuple(faces), tuple(corners)))
    letter_of = _letters_by_middle(flat)
    pattern_of = {v: np.array(key) / 1e7 for key, v in number.items()}
    angles, letters = [], ""
    bends = dict(bent)
    for edge in whole.edges:
        key = frozenset(edge)
        if key in bends:
            angles.append(bends[key])
            letters += "V" if bends[key] > 0 else "M"
            continue
        letter = letter_of((pattern_of[edge[0]] + pattern_of[edge[1]]) / 2.0)
        letters += letter
        angles.append({"V": pi, "M": -pi}.get(letter, 0.0))
    sheet = Sheet(len(corners), whole.edges, letters, tuple(faces), tuple(corners), fold_angles=tuple(angles))
    return sheet, flat, order


def _images(flat: Sheet):
    """Return where each panel of a folded sheet lies, and whether it is face up, panel 0 being so."""
    from synth.analysis.layering.image import folded
    from synth.analysis.layering.orders import flat_pattern

    pattern = flat_pattern(flat)
    panels = folded(pattern.sheet, pattern.mechanism, pattern.points)
    return [panels.places[list(face)] for face in flat.faces], [not flipped for flipped in panels.flipped]


def _letters_by_middle(flat: Sheet):
    """Return the function from a point of a crease pattern to the letter of the edge on which it lies."""
    ends = np.array([[flat.coordinates[v] for v in edge] for edge in flat.edges])

    def letter(point):
        along = ends[:, 1] - ends[:, 0]
        part = np.clip(((point - ends[:, 0]) * along).sum(axis=1) / (along**2).sum(axis=1), 0.0, 1.0)
        far = np.linalg.norm(ends[:, 0] + part[:, None] * along - point, axis=1)
        return flat.assignments[int(np.argmin(far))]

    return letter


def _cut_both(image, pattern, normal, offset):
    """Yield the parts of a polygon on both sides of a line of its image, as corners in image and pattern."""
    heights = image @ normal - offset
    ring = list(zip([*image, image[0]], [*pattern, pattern[0]], [*heights, heights[0]], strict=True))
    for sign in (-1.0, 1.0):
        part = []
        for (p, a, h), (q, b, k) in pairwise(ring):
            if sign * h >= 0:
                part.append((p, a))
            if h * k < 0:
                part.append((p + (q - p) * h / (h - k), a + (b - a) * h / (h - k)))
        if len(part) > 2:
            yield part


def vertex_of(sectors, letters: str) -> Sheet:
    """Return a vertex with these sectors, in radians, and creases of length 1."""
    angles = np.concatenate([[0.0], np.cumsum(sectors)[:-1]])
    corners = [(0.0, 0.0), *((float(cos(a)), float(sin(a))) for a in angles)]
    count = len(angles)
    faces = tuple((0, k + 1, (k + 1) % count + 1) for k in range(count))
    edges = tuple((0, k + 1) for k in range(count)) + tuple((k + 1, (k + 1) % count + 1) for k in range(count))
    return Sheet(count + 1, edges, letters + "B" * count, faces, tuple(corners))
