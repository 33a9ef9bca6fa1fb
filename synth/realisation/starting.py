"""The first drawing of a pattern: barycentric, with a convex border.

Tutte's theorem: in a convex border, with every other vertex in a weighted mean of its neighbours, the panels of a
3-connected pattern are strictly convex and none overlap. Rules S1 and S2 of SCD graphs say that patterns are, with
a *hub* in each hole joined to all vertices round it; the hub is where the centre across the hole begins. A panel
that cannot be convex gets a hub too, and is a star round it.

Source: W. T. Tutte, How to draw a graph, Proc. London Math. Soc. 13 (1963). Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

import numpy as np

from graphs.types import Floats
from synth.realisation.pattern import Pattern

__all__ = ["barycentric_start"]

_SPREAD = 0.5


def barycentric_start(
    pattern: Pattern, random: np.random.Generator | None = None
) -> tuple[Floats, Floats, Floats]:
    """Return places of the vertices, hubs of holes, and hubs of panels that cannot be convex.

    Edges are about 1 long. The generator gives every edge a weight; without it all weigh alike.
    """
    rings = [*pattern.holes, *(panel for place, panel in enumerate(pattern.panels) if pattern.bent[place])]
    spokes = [(v, pattern.vertices + hub) for hub, ring in enumerate(rings) for v in ring]
    pairs = np.concatenate([pattern.edges, np.array(spokes, np.int64).reshape(-1, 2)])
    weights = np.ones(len(pairs)) if random is None else np.exp(_SPREAD * random.standard_normal(len(pairs)))
    count = pattern.vertices + len(rings)
    matrix = np.zeros((count, count))
    for (a, b), weight in zip(pairs.tolist(), weights.tolist(), strict=True):
        matrix[[a, b], [a, b]] += weight
        matrix[[a, b], [b, a]] -= weight
    around = np.array(pattern.outer)
    angles = 2 * np.pi * np.arange(len(around)) / len(around)
    places = np.zeros((count, 2))
    places[around] = np.column_stack([np.cos(angles), np.sin(angles)])
    inner = np.setdiff1d(np.arange(count), around)
    if len(inner):
        right = -matrix[np.ix_(inner, around)] @ places[around]
        places[inner] = np.linalg.solve(matrix[np.ix_(inner, inner)], right)
    ends = places[pattern.edges]
    places /= np.exp(np.log(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)).mean())
    in_panels = pattern.vertices + len(pattern.holes)
    return places[: pattern.vertices], places[pattern.vertices : in_panels], places[in_panels:]
