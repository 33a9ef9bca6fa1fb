"""The one place that asks bliss: canonical labels and automorphisms of coloured graphs.

bliss drops parallel edges: `subdivided` makes every joint a node of its own. Ids depend on the splitting
heuristic.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import bliss_bind

__all__ = ["ColouredGraph", "Symmetries", "labels_of", "subdivided", "symmetries_of"]

_HEURISTIC = bliss_bind.Graph.SplittingHeuristic.shs_fm
_LINK, _JOINT, _MARKED = 0, 1, 2


class ColouredGraph(NamedTuple):
    """A simple graph whose nodes 0, 1, ... may have colours; edges are pairs of nodes, no pair twice.

    Labels and automorphisms keep the colours, one for each node; if there are none, all nodes are alike.
    """

    nodes: int
    edges: Iterable[Sequence[int]]
    colours: Sequence[int] = ()


class Symmetries(NamedTuple):
    """What bliss finds out about a graph.

    The canonical number of each node, permutations of the nodes that generate the automorphisms, and the number of
    these.
    """

    labels: list[int]
    generators: list[list[int]]
    size: float


def subdivided(links: int, joints: Iterable[Sequence[int]], marked: int | None = None) -> ColouredGraph:
    """Return the graph of links, then joints, each joint beside its two links: joints may be parallel.

    Links are 0 to ``links - 1``; a marked one has a colour of its own.
    """
    pairs = list(joints)
    colours = [_MARKED if link == marked else _LINK for link in range(links)] + [_JOINT] * len(pairs)
    places = range(links, links + len(pairs))
    edges = [(k, end) for k, ends in zip(places, pairs, strict=True) for end in ends]
    return ColouredGraph(len(colours), edges, colours)


def labels_of(graph: ColouredGraph) -> list[int]:
    """Return the canonical number of each node.

    >>> sorted(labels_of(ColouredGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])))
    [0, 1, 2, 3]
    """
    labels: list[int] = _built(graph).canonical_form()[0]
    return labels


def symmetries_of(graph: ColouredGraph) -> Symmetries:
    """Return canonical numbers and automorphisms.

    >>> symmetries_of(subdivided(4, [(0, 1), (1, 2), (2, 3), (3, 0)], marked=0)).size
    2.0
    """
    generators: list[list[int]] = []
    labels, statistics = _built(graph).canonical_form(lambda moved: generators.append(list(moved)))
    return Symmetries(labels, generators, float(statistics.get_group_size_approx()))


def _built(graph: ColouredGraph) -> bliss_bind.Graph:
    """Return bliss's own graph; chains are made by the million, so nodes that are alike are made at once."""
    built = bliss_bind.Graph(0 if graph.colours else graph.nodes)
    for colour in graph.colours:
        built.add_vertex(colour)
    built.set_splitting_heuristic(_HEURISTIC)
    add = built.add_edge
    for a, b in graph.edges:
        add(a, b)
    return built
