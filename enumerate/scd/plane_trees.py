"""Plane trees: open chains drawn in the plane, each once up to mirror images, as codes of `enumerate.kernel.maps`.

A tree comes from one with a link less by a leaf in one of its corners.
"""

from __future__ import annotations

import numpy as np

from enumerate.contracted.embedded import code_of
from enumerate.kernel.compiled import compiled
from enumerate.kernel.maps import END, JOINT, decode_map, from_turns
from enumerate.kernel.row_set import empty_set, insert
from graphs.types import Bytes, Ints

__all__ = ["plane_trees"]


def plane_trees(links: int, most: int) -> Bytes:
    """Return the codes of all plane trees with N >= 2 links, none with more joints than a limit."""
    codes = np.array([[JOINT, END, JOINT, END]], np.uint8)
    for size in range(2, links):
        codes = _with_leaves(codes, size, most)
    return codes


@compiled
def _with_leaves(parents: Bytes, links: int, most: int) -> Bytes:
    """Return the codes of the trees with one leaf more."""
    table, rows, used = empty_set(parents.shape[1] + 3)
    for parent in range(len(parents)):
        turn, vertex, _ = decode_map(parents[parent])
        degree = np.zeros(links, np.int64)
        for d in range(len(vertex)):
            degree[vertex[d]] += 1
        for d in range(len(vertex)):
            if degree[vertex[d]] < most:
                after, ends = _with_leaf(turn, vertex, links, d)
                none = np.zeros(len(ends), np.int64)
                code, _, _ = code_of(from_turns(after), ends, none, none, none[:0], 0)
                table, rows, used = insert(table, rows, used, code)
    return rows[:used].copy()


@compiled
def _with_leaf(turn: Ints, vertex: Ints, links: int, corner: int) -> tuple[Ints, Ints]:
    """Return ``turn[0]`` and ``vertex`` with a leaf in a corner."""
    darts = len(vertex)
    after, ends = np.empty(darts + 2, np.int64), np.empty(darts + 2, np.int64)
    for d in range(darts):
        after[d], ends[d] = turn[0, d], vertex[d]
    after[darts], after[corner], after[darts + 1] = turn[0, corner], darts, darts + 1
    ends[darts], ends[darts + 1] = vertex[corner], links
    return after, ends
