"""How the spherical centres of a mechanism are arranged: Bowen's classes of origami mechanisms.

Centres are the vertices of a graph, joints that pass two of them its edges. Source: Bowen and others 2013; Wiener
2016, Tables 4 and 5, which show the classes by examples: the rules are those of docs/theory/vertex-edge-graphs.md.
"""

from __future__ import annotations

from itertools import combinations, pairwise
from typing import Literal

import networkx as nx

from graphs.mechanism.sc import SCGraph

__all__ = ["ARRANGEMENTS", "Arrangement", "arrangement_of", "centre_graph"]

Arrangement = Literal[
    "none", "single", "separate", "coupled", "linear", "tree", "loop", "periodic", "doubly periodic", "network"
]

ARRANGEMENTS: dict[Arrangement, str] = {
    "none": "no loop has a centre",
    "single": "one centre",
    "separate": "centres that no joints connect",
    "coupled": "two centres on one joint",
    "linear": "three centres or more in a row",
    "tree": "centres in rows that part, none closed",
    "loop": "rows of centres that close once",
    "periodic": "a part repeated three times or more, each joined to the next: in one direction",
    "doubly periodic": "the same in two directions: a mesh of three by three centres or more",
    "network": "centres in several closed rows that do not repeat so",
}
"""What each class is, in words."""

_REPEATED = 3


def arrangement_of(sc: SCGraph) -> Arrangement:
    """Return the class of the arrangement of a mechanism's centres.

    Parameters
    ----------
    sc : SCGraph or SCDGraph

    Examples
    --------
    Watt's six-bar chain has two centres on one joint:

    >>> from graphs.loops.loop import Loop
    >>> watt = [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)]
    >>> arrangement_of(SCGraph(6, watt, [Loop((0, 1, 2, 3)), Loop((3, 4, 5, 6))]))
    'coupled'
    """
    graph = centre_graph(sc)
    if len(graph) < 2:
        return "single" if len(graph) else "none"
    if not nx.is_connected(graph):
        return "separate"
    cycles = graph.number_of_edges() - len(graph) + 1
    if not cycles:
        if len(graph) == 2:
            return "coupled"
        return "linear" if max(degree for _, degree in graph.degree) == 2 else "tree"
    if cycles == 1:
        return "loop"
    directions = _directions(graph)
    return "doubly periodic" if directions > 1 else "periodic" if directions else "network"


def centre_graph(sc: SCGraph) -> nx.Graph:
    """Return the graph of centres: an edge for each two that joints pass both.

    >>> len(centre_graph(SCGraph(3, [(0, 1), (1, 2), (2, 0)])))
    0
    """
    graph = nx.Graph()
    passing: dict[object, list[int]] = {}
    for number, one in enumerate(sc.centre_classes()):
        graph.add_node(number)
        for joint in one.joints:
            passing.setdefault(joint, []).append(number)
    for centres in passing.values():
        graph.add_edges_from(pairwise(centres))
    return graph


def _directions(graph: nx.Graph) -> int:
    """Return in how many directions a graph is a part repeated: a Cartesian product with a path, or with two.

    Factors of a product are classes of edges: opposite ones in a square are in one class, and so are two at a
    vertex that are in no square together (Feder 1992). A class is a direction of repetition if without its edges
    the graph falls into three parts or more that are a row, each joined to the next vertex by vertex.
    """
    number: dict[tuple[int, int], int] = {}
    for place, (a, b) in enumerate(graph.edges):
        number[a, b] = number[b, a] = place
    near = {vertex: set(graph[vertex]) for vertex in graph}
    together: list[tuple[int, int]] = []
    for vertex, neighbours in near.items():
        for one, other in combinations(graph[vertex], 2):
            first, second = number[vertex, one], number[vertex, other]
            squares = near[one] & near[other] - {vertex}
            if other in near[one] or not squares:
                together.append((first, second))
            else:
                for across in squares - neighbours:
                    together += [(first, number[other, across]), (second, number[one, across])]
    classes = nx.utils.UnionFind(range(graph.number_of_edges()))
    for first, second in set(together):
        classes.union(first, second)
    edges_of: dict[int, list[tuple[int, int]]] = {}
    for a, b in graph.edges:
        edges_of.setdefault(classes[number[a, b]], []).append((a, b))
    return sum(_is_direction(graph, edges) for edges in edges_of.values())


def _is_direction(graph: nx.Graph, edges: list[tuple[int, int]]) -> bool:
    """Tell whether a graph is a row of parts, each joined to the next by some edges, vertex by vertex.

    A part repeated all round is no row: it has no ends.
    """
    left = graph.copy()
    left.remove_edges_from(edges)
    parts = [frozenset(part) for part in nx.connected_components(left)]
    size = len(parts[0])
    if any(len(part) != size for part in parts):
        return False
    part_of = {vertex: part for part in parts for vertex in part}
    row = nx.Graph()
    row.add_nodes_from(parts)
    joined: dict[frozenset[frozenset[int]], dict[int, int]] = {}
    for a, b in edges:
        if part_of[a] == part_of[b]:
            return False
        row.add_edge(part_of[a], part_of[b])
        joined.setdefault(frozenset((part_of[a], part_of[b])), {}).update({a: b, b: a})
    ends = sum(degree == 1 for _, degree in row.degree)
    is_row = len(parts) >= _REPEATED and ends == 2 and row.number_of_edges() == len(parts) - 1
    if not is_row or not nx.is_connected(row):
        return False
    return all(_matches(left, one, other, joined[frozenset((one, other))]) for one, other in row.edges)


def _matches(left: nx.Graph, one: frozenset[int], other: frozenset[int], to: dict[int, int]) -> bool:
    """Tell whether edges between two parts take all of one to the other, edges to edges."""
    if set(to) != one | other:
        return False
    here = {frozenset((to[a], to[b])) for a, b in left.subgraph(one).edges}
    return here == {frozenset(edge) for edge in left.subgraph(other).edges}
