"""Drawings that show a symmetry of order two as a mirror.

A symmetry can be shown so if it maps no side of the mirror to itself: take away the nodes that it fixes, and each
piece that is left has an image of its own. One of each two pieces, with the fixed nodes, is drawn on one side of
the mirror, the fixed nodes on it: that can be done if the half is planar with one more node that is joined to all
fixed ones. The other half is its image. Theory: docs/theory/pictures.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import networkx as nx

from graphs.identity.chains import subdivided, symmetries_of
from graphs.types import Joints, LinkId
from synth.drawing.layout.embedding import Neighbours, Node, embedded, faces_of, part_of

__all__ = ["mirrored", "swaps_of"]

_MOST_SYMMETRIES = 64
_MIRROR = ("mirror",)


def swaps_of(links: Sequence[LinkId], joints: Joints) -> Iterator[dict[Node, Node]]:
    """Yield symmetries of order two of a link-joint graph, as moves of ``("link", id)`` and ``("joint", id)``.

    For a large group the first are tried, those that are products of few generators.

    >>> len(list(swaps_of([0, 1, 2, 3], {0: (0, 1), 1: (1, 2), 2: (2, 3), 3: (3, 0)})))
    5
    """
    number = {link: i for i, link in enumerate(links)}
    pairs = [(number[a], number[b]) for a, b in joints.values()]
    graph = subdivided(len(links), pairs)
    identity = tuple(range(graph.nodes))
    generators = [tuple(one) for one in symmetries_of(graph).generators]
    nodes: list[Node] = [*(("link", link) for link in links), *(("joint", joint) for joint in joints)]
    group, seen = [identity], {identity}
    for element in group:
        for one in generators:
            product = tuple(one[i] for i in element)
            if product not in seen and len(group) < _MOST_SYMMETRIES:
                seen.add(product)
                group.append(product)
    for element in group[1:]:
        if all(element[image] == i for i, image in enumerate(element)):
            yield {node: nodes[image] for node, image in zip(nodes, element, strict=False)}


def mirrored(graph: nx.Graph, swap: Mapping[Node, Node]) -> Neighbours | None:
    """Return rotations of a connected graph that a symmetry of order two reverses; None if there are none.

    The symmetry swaps the ends of no edge. A square mirrored in a diagonal, and rotated by half a turn, which is
    no mirror:

    >>> square = nx.cycle_graph(4)
    >>> mirrored(square, {0: 0, 1: 3, 2: 2, 3: 1}) is None, mirrored(square, {0: 2, 1: 3, 2: 0, 3: 1}) is None
    (False, True)
    """
    fixed = [node for node in graph if swap[node] == node]
    half = _one_side(graph, fixed, swap)
    if half is None:
        return None
    around = embedded(_closed(graph, fixed, half))
    if around is None:
        return None
    rotations: Neighbours = {}
    for node in half:
        row = tuple(_far_end(other, node) for other in around[node])
        rotations[node] = row
        rotations[swap[node]] = tuple(swap[other] for other in reversed(row))
    for node in fixed:
        row = around[node]
        cut = row.index(_MIRROR)
        beyond = [_far_end(other, node) for other in row[cut + 1 :] + row[:cut]]
        # an edge along the mirror comes first or last in the half, and is in the whole once
        rotations[node] = (*beyond, *(swap[other] for other in reversed(beyond) if swap[other] != other))
    plane = len(graph) - graph.number_of_edges() + len(faces_of(rotations)) == 2
    return rotations if plane else None


def _one_side(graph: nx.Graph, fixed: Sequence[Node], swap: Mapping[Node, Node]) -> list[Node] | None:
    """Return one of each two pieces that the fixed nodes leave; None if a piece is its own image."""
    if not fixed or len(fixed) == len(graph):
        return None
    taken: set[Node] = set()
    half: list[Node] = []
    rest = part_of(graph, {node for node in graph if swap[node] != node})
    for piece in nx.connected_components(rest):
        if any(swap[node] in piece for node in piece):
            return None
        if not taken & piece:
            half += [node for node in graph if node in piece]
            taken |= {swap[node] for node in piece}
    return half


def _closed(graph: nx.Graph, fixed: Sequence[Node], half: Sequence[Node]) -> nx.Graph:
    """Return a half with a node joined to all fixed ones, and to the middles of edges between them."""
    side = part_of(graph, {*half, *fixed})
    closed = nx.Graph()
    closed.add_nodes_from([*half, *fixed])
    on_axis = set(fixed)
    for a, b in side.edges:
        if a in on_axis and b in on_axis:
            middle = ("middle", a, b)
            closed.add_edges_from([(a, middle), (middle, b), (middle, _MIRROR)])
        else:
            closed.add_edge(a, b)
    closed.add_edges_from((_MIRROR, node) for node in fixed)
    return closed


def _far_end(node: Node, seen_from: Node) -> Any:
    """Return what an edge leads to: the other end of an edge on the mirror, whose middle is a node."""
    if isinstance(node, tuple) and node[:1] == ("middle",) and len(node) == 3:
        return node[2] if node[1] == seen_from else node[1]
    return node
