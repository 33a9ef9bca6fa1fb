"""Random loops on circles, and what other methods say of them."""

from __future__ import annotations

import numpy as np

from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from synth.linkages.fourbar.closing import can_close
from synth.linkages.surfaces.circuit import link_angles

FOUR_BAR = SCGraph(4, dict(zip("OABC", [(0, 1), (1, 2), (2, 3), (3, 0)], strict=True)), [Loop(tuple("OABC"))], ground=0)
"""Joints O, A, B, C; the ground link carries C and O."""
WATT = SCGraph(
    6, [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)], [Loop((0, 1, 2, 3)), Loop((3, 4, 5, 6))], ground=0
)
STEPHENSON = SCGraph(
    6, [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (4, 5), (5, 2)], [Loop((0, 1, 2, 3)), Loop((2, 3, 4, 5, 6))], ground=0
)


def wrap(x):
    """Angles in [-pi, pi)."""
    return np.remainder(x + np.pi, 2 * np.pi) - np.pi


def steps_of(places):
    """Steps between successive joints of loops."""
    return wrap(np.roll(places, -1, axis=-1) - places)


def random_linkages(rng, count, links=4):
    """Azimuths, steps, lambda and link angles of loops that lie on a cone."""
    places = rng.uniform(-np.pi, np.pi, (count, links))
    lam = rng.uniform(0.05, 1.4, count)
    steps = steps_of(places)
    return places, steps, lam, link_angles(steps, lam[:, np.newaxis])


def random_link_angles(rng, count, links=4):
    """Link angles of loops that close on the sphere."""
    angles = rng.uniform(0.02, np.pi - 0.02, (4 * count, links))
    return angles[can_close(angles)][:count]


def random_lengths(rng, count, links=4):
    """Lengths of loops that close in the plane."""
    lengths = rng.uniform(0.05, 1.0, (4 * count, links))
    return lengths[2 * lengths.max(axis=1) < lengths.sum(axis=1)][:count]


def crosses(points):
    """Whether two sides of a quadrilateral cross: by the signs of four triangles."""
    p = np.moveaxis(points, -2, 0)

    def area(a, b, c):
        return (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (c[..., 0] - a[..., 0])

    def cut(a, b, c, d):
        return (area(a, b, c) * area(a, b, d) < 0) & (area(c, d, a) * area(c, d, b) < 0)

    return cut(p[0], p[1], p[2], p[3]) | cut(p[1], p[2], p[3], p[0])
