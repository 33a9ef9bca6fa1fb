"""Places of the nodes of a plane graph: barycentric, with weights that even out the lengths.

Tutte's theorem: if the outer face is a convex polygon and every other node lies in a weighted mean of its
neighbours, weights positive, then a plane graph whose inner faces are triangles is drawn without crossings. Here
every inner face has a *hub*, a node joined to all its corners. Then nodes move under forces; no move may turn a
triangle over, so that none makes a crossing. Both steps treat mirror images alike. Theory:
docs/theory/pictures.md.

Source: W. T. Tutte, How to draw a graph, Proc. London Math. Soc. 13 (1963).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from graphs.types import Floats, Ints
from synth.drawing.layout.embedding import Node, faces_of

__all__ = ["PlaneGraph", "barycentric", "plane_graph"]

_ROUNDS = 12
_HUB_WEIGHT = 0.25


@dataclass(frozen=True, slots=True)
class PlaneGraph:
    """A plane graph in numbers, with hubs in its inner faces.

    `nodes` has the `own` nodes of the graph first, then a hub for each inner face of more than three corners;
    `hub_of` is that of each inner face. `edges`, int64[m, 2], leave out hubs; `spokes`, int64[s, 2], go from
    corners to hubs. `triangles`, int64[t, 3], and the outer face, int64[k], are counter-clockwise.
    """

    nodes: list[Node]
    own: int
    edges: Ints
    spokes: Ints
    triangles: Ints
    outer: Ints
    faces: list[tuple[int, ...]]
    hub_of: list[int | None]


def plane_graph(around: Mapping[Node, Sequence[Node]], outer: Sequence[Node]) -> PlaneGraph:
    """Return a biconnected plane graph with hubs, from the neighbours of each node, counter-clockwise.

    `outer` is one of the faces, as `faces_of` returns it: clockwise if it is drawn outside.

    >>> square = {0: (1, 3), 1: (2, 0), 2: (3, 1), 3: (0, 2)}
    >>> graph = plane_graph(square, faces_of(square)[1])
    >>> len(graph.triangles), graph.outer.tolist()
    (4, [1, 2, 3, 0])
    """
    number = {node: i for i, node in enumerate(around)}
    faces = [tuple(number[node] for node in face) for face in faces_of(around)]
    outside = tuple(number[node] for node in outer)
    faces.remove(outside)
    edges = [(number[a], number[b]) for a, row in around.items() for b in row if number[a] < number[b]]
    nodes: list[Node] = list(around)
    spokes, triangles = [], []
    hub_of: list[int | None] = []
    for face in faces:
        if len(face) == 3:
            triangles.append(face)
            hub_of.append(None)
            continue
        hub = len(nodes)
        nodes.append(("hub", hub))
        hub_of.append(hub)
        spokes += [(corner, hub) for corner in face]
        triangles += [(a, b, hub) for a, b in zip(face, (*face[1:], face[0]), strict=True)]
    return PlaneGraph(
        nodes,
        len(number),
        np.array(edges, np.int64).reshape(-1, 2),
        np.array(spokes, np.int64).reshape(-1, 2),
        np.array(triangles, np.int64).reshape(-1, 3),
        np.array(outside[::-1], np.int64),
        faces,
        hub_of,
    )


def barycentric(graph: PlaneGraph, mirror: Mapping[Node, Node] | None = None) -> Floats:
    """Return places, float[n, 2], with the outer face a regular polygon, and weights that make lengths more even.

    `mirror` is a symmetry that reverses the graph and its outer face; its mirror line is upright.

    >>> square = {0: (1, 3), 1: (2, 0), 2: (3, 1), 3: (0, 2)}
    >>> places = barycentric(plane_graph(square, faces_of(square)[1]))
    >>> bool(abs(places[4]).max() < 1e-9)
    True
    """
    corners = len(graph.outer)
    start = _start(graph, mirror)
    angles = np.pi / 2 + 2 * np.pi * (np.arange(corners) - start) / corners
    places = np.zeros((len(graph.nodes), 2))
    places[graph.outer] = np.column_stack([np.cos(angles), np.sin(angles)])
    inner = np.setdiff1d(np.arange(len(places)), graph.outer)
    if not len(inner):
        return places
    pairs = np.concatenate([graph.edges, graph.spokes])
    weights: Floats = np.concatenate([np.ones(len(graph.edges)), np.full(len(graph.spokes), _HUB_WEIGHT)])
    for _ in range(_ROUNDS):
        places[inner] = _balanced(pairs, weights, places, inner, graph.outer)
        lengths = np.linalg.norm(places[pairs[:, 0]] - places[pairs[:, 1]], axis=1)
        own = lengths[: len(graph.edges)]
        weights[: len(own)] *= np.clip(own / own.mean(), 0.2, 3.0)
        weights = weights.clip(1e-3, 1e3)
    return places


def _start(graph: PlaneGraph, mirror: Mapping[Node, Node] | None) -> float:
    """Return the place in the outer face that is put on top: the mirror is upright; may lie between two."""
    if mirror is None:
        return 0.0
    row = [graph.nodes[i] for i in graph.outer.tolist()]
    return row.index(mirror[row[0]]) / 2


def _balanced(pairs: Ints, weights: Floats, places: Floats, inner: Ints, outer: Ints) -> Floats:
    """Return the places of the inner nodes where each is the weighted mean of its neighbours."""
    size = len(places)
    laplacian = np.zeros((size, size))
    np.add.at(laplacian, (pairs[:, 0], pairs[:, 1]), -weights)
    np.add.at(laplacian, (pairs[:, 1], pairs[:, 0]), -weights)
    np.fill_diagonal(laplacian, -laplacian.sum(axis=1))
    pulled: Floats = -laplacian[np.ix_(inner, outer)] @ places[outer]
    return np.asarray(np.linalg.solve(laplacian[np.ix_(inner, inner)], pulled), dtype=np.float64)
