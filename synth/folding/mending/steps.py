"""One step of Newton's method in vertices and the joint angles of several configurations.

The derivatives by the angles of a configuration are taken apart, T = U S V'. Then its equations say of each angle
along V alone how far it has to turn for a change u of the vertices, (r + B u) / s along U, where r does not hold
and B are the derivatives by the vertices. The least step is the solution of a least-squares problem in u alone, in
which an equation that no angle takes away (s = 0) weighs most. Theory: docs/theory/mending.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from graphs.rank.singular_values import split
from graphs.tolerances import EPSILON
from graphs.types import Floats

__all__ = ["Block", "least_step"]


class Block(NamedTuple):
    """Equations of one configuration: what does not hold, and the derivatives by vertices and by its angles."""

    off: Floats
    by_vertices: Floats
    by_angles: Floats


def least_step(
    off: Floats, by_vertices: Floats, blocks: Sequence[Block], least: float
) -> tuple[Floats, list[Floats]]:
    """Return the least change of the vertices, float[u], and of the angles of each block, that takes all away.

    Equations between vertices alone do not hold by `off`, float[n], derivatives float[n, u]. Singular values below
    `least` count as that.

    >>> block = Block(np.ones(2), np.eye(2, 1), np.eye(2)[:, 1:])
    >>> step, [turn] = least_step(np.zeros(0), np.zeros((0, 1)), [block], 1e-9)
    >>> step.round(6).tolist(), turn.round(6).tolist()
    ([-1.0], [-1.0])
    """
    rows, given = (
        [by_vertices / least, np.eye(by_vertices.shape[1])],
        [-off / least, np.zeros(by_vertices.shape[1])],
    )
    apart = []
    for block in blocks:
        parts = split(block.by_angles)
        sizes = np.full(len(block.off), least)
        count = len(parts.values)
        sizes[:count] = np.maximum(parts.values, least)
        own, by = parts.left.T @ block.off, parts.left.T @ block.by_vertices
        rows.append(by / sizes[:, None])
        given.append(-own / sizes)
        shares = parts.values / sizes[:count] ** 2  # of values below the least only a part: no angle turns far
        apart.append((parts.right[:count], shares, own[:count], by[:count]))
    change = np.linalg.lstsq(np.concatenate(rows), np.concatenate(given), rcond=EPSILON)[0]
    turns = [-right.T @ (shares * (own + by @ change)) for right, shares, own, by in apart]
    return change, turns
