"""Crease patterns with many folding branches: sheets side by side that share no crease, triangulated squares."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from graphs.mechanism.sheet import Sheet, with_all_edges


def side_by_side(sheets: Sequence[Sheet]) -> Sheet:
    """Return one sheet of several parts, each a little to the right of the one before; letters are kept."""
    corners: list[tuple[float, ...]] = []
    faces: list[tuple[int, ...]] = []
    edges: list[tuple[int, int]] = []
    letters = ""
    right = 0.0
    for sheet in map(with_all_edges, sheets):
        own = np.array(sheet.coordinates, dtype=float)[:, :2]
        first = len(corners)
        corners += map(tuple, (own + np.array([right - own[:, 0].min(), 0.0])).tolist())
        faces += [tuple(first + corner for corner in face) for face in sheet.faces]
        edges += [(first + a, first + b) for a, b in sheet.edges]
        letters += sheet.assignments
        right = max(corner[0] for corner in corners) + 0.3
    return Sheet(len(corners), tuple(edges), letters, tuple(faces), tuple(corners))


def triangulated_square(inner: int, rng: np.random.Generator, *, flips: int | None = None) -> Sheet:
    """Return a square cut into triangles in general position: four boundary vertices and some inner ones.

    Points are put into random triangles, then random diagonals of convex quadrilaterals are exchanged; with few
    exchanges many vertices lie inside triangles of creases.
    """
    corners = [(0.0, 0.0), (1.0, 0.05), (1.03, 1.0), (-0.02, 0.97)]
    triangles = [(0, 1, 2), (0, 2, 3)]
    while len(corners) < 4 + inner:
        place = int(rng.integers(len(triangles)))
        shares = rng.dirichlet([4.0, 4.0, 4.0])
        a, b, c = triangles.pop(place)
        corners.append(tuple((shares @ np.array([corners[a], corners[b], corners[c]])).tolist()))
        new = len(corners) - 1
        triangles += [(a, b, new), (b, c, new), (c, a, new)]
    for _ in range(100 * inner if flips is None else flips):
        triangles = _flipped(triangles, np.array(corners), rng)
    used = {tuple(sorted(triangle)) for triangle in triangles}
    assert len(used) == 2 * inner + 2
    sheet = Sheet(len(corners), (), "", tuple(triangles), tuple(corners))
    return with_all_edges(sheet)


def _flipped(
    triangles: list[tuple[int, int, int]], corners: np.ndarray, rng: np.random.Generator
) -> list[tuple[int, int, int]]:
    """Return triangles with one diagonal exchanged, if that leaves triangles that are not too thin."""
    one, other = rng.choice(len(triangles), 2, replace=False).tolist()
    shared = set(triangles[one]) & set(triangles[other])
    if len(shared) != 2:
        return triangles
    a, b = shared
    [c], [d] = set(triangles[one]) - shared, set(triangles[other]) - shared
    fresh = [(c, d, a), (d, c, b)]
    areas = [_area(corners[list(triangle)]) for triangle in fresh]
    if areas[0] * areas[1] <= 0.0 or min(map(abs, areas)) < 2e-3:
        return triangles
    if any({c, d} <= set(triangle) for triangle in triangles):
        return triangles
    rest = [triangle for place, triangle in enumerate(triangles) if place not in (one, other)]
    return [*rest, *((t if _area(corners[list(t)]) > 0.0 else t[::-1]) for t in fresh)]


def _area(points: np.ndarray) -> float:
    (ax, ay), (bx, by), (cx, cy) = points
    return float((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))


def free_vertices(sheet: Sheet) -> list[int]:
    """Return the inner vertices of a triangulated square that lie inside no triangle of creases or edges."""
    corners = np.array(sheet.coordinates, dtype=float)[:, :2]
    joined = {frozenset(edge) for edge in sheet.edges}
    cycles = [
        triple
        for triple in combinations(range(len(corners)), 3)
        if all(frozenset(pair) in joined for pair in combinations(triple, 2))
    ]
    return [
        vertex
        for vertex in range(4, len(corners))
        if not any(vertex not in cycle and _inside(corners[vertex], corners[list(cycle)]) for cycle in cycles)
    ]


def _inside(point: np.ndarray, triangle: np.ndarray) -> bool:
    turns = [_area(np.array([triangle[k], triangle[(k + 1) % 3], point])) for k in range(3)]
    return min(turns) > 0.0 or max(turns) < 0.0


def height_forms(sheet: Sheet) -> np.ndarray:
    """Return the equations of a triangulated sheet by heights of vertices: float[inner, V, V], one for each vertex.

    A sheet that begins to fold is the graph of heights over its triangles; the angles round an inner vertex add up to a
    full turn to second order. The angle of a triangle with heights is less than in the plane by
    -(p . q) + (|p|^2 + |q|^2) / 2 cos t ... over sin t, p and q the slopes along its two sides there.
    """
    corners = np.array(sheet.coordinates, dtype=float)[:, :2]
    count = len(corners)
    forms = np.zeros((count, count, count))
    for face in sheet.faces:
        for k in range(3):
            at, one, two = face[k], face[(k + 1) % 3], face[(k + 2) % 3]
            u, v = corners[one] - corners[at], corners[two] - corners[at]
            lengths = np.linalg.norm(u), np.linalg.norm(v)
            p, q = np.zeros(count), np.zeros(count)
            p[one], p[at], q[two], q[at] = 1 / lengths[0], -1 / lengths[0], 1 / lengths[1], -1 / lengths[1]
            cosine = u @ v / lengths[0] / lengths[1]
            sine = np.sqrt(1.0 - cosine**2)
            both = (np.outer(p, q) + np.outer(q, p)) / 2.0
            # cos(t + dt) = (cos t + p q) / sqrt((1 + p^2)(1 + q^2)), so dt = -(p q - cos t (p^2 + q^2) / 2) / sin t
            forms[at] += -(both - cosine * (np.outer(p, p) + np.outer(q, q)) / 2.0) / sine
    return forms[4:]


def branches_by_brute_force(sheet: Sheet, rng: np.random.Generator, starts: int) -> int:
    """Return how many branches Newton's method finds from random heights: a second method.

    The first triangle stays in the plane; heights are counted up to their factor.
    """
    forms = height_forms(sheet)
    free = [vertex for vertex in range(sheet.vertices) if vertex not in sheet.faces[0]]
    forms = forms[:, free][:, :, free]
    found = np.zeros((0, len(free)))
    for _ in range(starts):
        x = rng.normal(size=len(free))
        for _ in range(40):
            x = x / np.linalg.norm(x)
            slopes = forms @ x
            off = slopes @ x
            if np.abs(off).max() < 1e-13:
                break
            x = x - np.linalg.lstsq(2.0 * slopes, off, rcond=1e-12)[0]
        else:
            continue
        if not (np.abs(np.abs(found @ x) - 1.0) < 1e-6).any():
            found = np.concatenate([found, x[None]])
    return len(found)
