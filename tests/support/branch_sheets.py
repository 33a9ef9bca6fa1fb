"""Crease patterns with many folding branches: sheets side by side that share no crease, triangulated squares."""

from __future__ import annotations

from collections.abc import Sequence

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
