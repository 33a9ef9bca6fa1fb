"""Sheets of one vertex."""

import numpy as np

from graphs.mechanism.sheet import Sheet


def fan(sectors, letters):
    """A vertex 0 with creases at the sums of sectors."""
    at = np.cumsum([0.0, *sectors[:-1]])
    corners = [(0.0, 0.0), *zip(np.cos(at).tolist(), np.sin(at).tolist(), strict=True)]
    n = len(sectors)
    edges = tuple((0, i) for i in range(1, n + 1))
    return Sheet(n + 1, edges, letters, tuple((0, i, i % n + 1) for i in range(1, n + 1)), tuple(corners))
