"""Plane graphs by their rotations, the neighbours of each node counter-clockwise; their faces and blocks."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any, TypeAlias

import networkx as nx

__all__ = ["Neighbours", "Node", "embedded", "faces_of", "made_biconnected", "part_of", "same_cycle"]

Node: TypeAlias = tuple[Any, ...]
Neighbours: TypeAlias = dict[Node, tuple[Node, ...]]


def embedded(graph: nx.Graph) -> Neighbours | None:
    """Return some rotations that draw a simple graph without crossings; None if there are none.

    >>> embedded(nx.complete_graph(5)) is None
    True
    >>> len(faces_of(embedded(nx.complete_graph(4))))
    4
    """
    planar, found = nx.check_planarity(graph)
    if not planar:
        return None
    return {node: tuple(found.neighbors_cw_order(node))[::-1] for node in graph}


def part_of(graph: nx.Graph, nodes: Collection[Node]) -> nx.Graph:
    """Return the graph of some nodes, in the order of the whole: that of a set differs from run to run.

    >>> list(part_of(nx.path_graph(4), {3, 1, 2}).edges)
    [(1, 2), (2, 3)]
    """
    part = nx.Graph()
    part.add_nodes_from(node for node in graph if node in nodes)
    part.add_edges_from((a, b) for a, b in graph.edges if a in nodes and b in nodes)
    return part


def faces_of(around: Mapping[Node, Sequence[Node]]) -> list[tuple[Node, ...]]:
    """Return the faces, each walked round with the face on the left; bounded ones counter-clockwise.

    >>> faces_of({0: (1, 2), 1: (2, 0), 2: (0, 1)})
    [(0, 1, 2), (0, 2, 1)]
    """
    before = {
        (node, next_): previous
        for node, row in around.items()
        for previous, next_ in zip([*row[-1:], *row[:-1]], row, strict=True)
    }
    seen: set[tuple[Node, Node]] = set()
    faces = []
    for start, row in around.items():
        for first in row:
            dart, face = (start, first), []
            while dart not in seen:
                seen.add(dart)
                face.append(dart[0])
                dart = (dart[1], before[dart[1], dart[0]])
            if face:
                faces.append(tuple(face))
    return faces


def made_biconnected(around: Mapping[Node, Sequence[Node]]) -> Neighbours:
    """Return rotations with further nodes, ``("fill", i)``, so that no node cuts the connected graph in two.

    Where two neighbours that follow each other round a node are in different blocks, a node is put between them
    and joined to both.

    >>> path = {0: (1,), 1: (0, 2), 2: (1,)}
    >>> made_biconnected(path)[("fill", 0)]
    (0, 2)
    """
    rotations = {node: list(row) for node, row in around.items()}
    fills = 0
    graph = nx.Graph([(a, b) for a, row in rotations.items() for b in row])
    while (bad := _parted(rotations, graph)) is not None:
        node, a, b = bad
        fill = ("fill", fills)
        fills += 1
        # counter-clockwise: a, then b round the node; so the fill lies before the node at a, after it at b
        rotations[a].insert(rotations[a].index(node), fill)
        rotations[b].insert(rotations[b].index(node) + 1, fill)
        rotations[fill] = [a, b]
        graph.add_edges_from([(fill, a), (fill, b)])
    return {node: tuple(row) for node, row in rotations.items()}


def _parted(rotations: Mapping[Node, Sequence[Node]], graph: nx.Graph) -> tuple[Node, Node, Node] | None:
    """Return a node that cuts the graph in two, and two of its neighbours in a row that it parts."""
    block_of: dict[frozenset[Node], int] = {}
    for number, block in enumerate(nx.biconnected_component_edges(graph)):
        block_of.update((frozenset(edge), number) for edge in block)
    for node, row in rotations.items():
        if len(row) < 2:
            continue
        for a, b in zip(row, [*row[1:], row[0]], strict=True):
            if a != b and block_of[frozenset((node, a))] != block_of[frozenset((node, b))]:
                return node, a, b
    return None


def same_cycle(one: Sequence[Node], other: Sequence[Node]) -> bool:
    """Say whether two rows are one cycle, begun at any place, in either direction.

    >>> same_cycle((0, 1, 2, 3), (2, 1, 0, 3)), same_cycle((0, 1, 2, 3), (0, 2, 1, 3))
    (True, False)
    """
    if len(one) != len(other) or one[0] not in other:
        return False
    turned = [tuple(row[(i := list(row).index(one[0])) :]) + tuple(row[:i]) for row in (other, other[::-1])]
    return tuple(one) in turned
