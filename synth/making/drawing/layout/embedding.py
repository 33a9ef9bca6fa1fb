"""Plane graphs by their rotations, the neighbours of each node counter-clockwise; mirrors; what is laid out.

A symmetry of order two can be shown as a mirror if it maps no side of the mirror to itself: take away the nodes
that it fixes, and each piece that is left has an image of its own. One of each two pieces, with the fixed nodes,
is drawn on one side of the mirror, the fixed nodes on it: that is possible if the half is planar with one more
node that is joined to all fixed ones. The other half is its image. Theory: docs/theory/pictures.md.

Drawn as bodies, joints are nodes and a link is the polygon of its joints; a binary link is a side. Drawn as dots,
links are nodes. An edge that would come twice, between two links that share two joints, has a node in its middle.
"""

from collections import Counter
from collections.abc import Collection, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, TypeAlias

import networkx as nx

from graphs.identity.chains import subdivided
from graphs.identity.numbering import symmetries_of
from graphs.types import Joints, LinkId

Node: TypeAlias = tuple[Any, ...]
Neighbours: TypeAlias = dict[Node, tuple[Node, ...]]

_MOST_SYMMETRIES = 64
_MIRROR = ("mirror",)


def embedded(graph: nx.Graph) -> Neighbours | None:
    """Return rotations that draw a simple graph without crossings; None if it is not planar."""
    planar, embedding = nx.check_planarity(graph)
    return {node: tuple(embedding.neighbors_cw_order(node))[::-1] for node in graph} if planar else None


def part_of(graph: nx.Graph, nodes: Collection[Node]) -> nx.Graph:
    """Return the graph of some nodes, in the order of the whole: that of a set differs from run to run."""
    part = nx.Graph()
    part.add_nodes_from(node for node in graph if node in nodes)
    part.add_edges_from((a, b) for a, b in graph.edges if a in nodes and b in nodes)
    return part


def faces_of(around: Mapping[Node, Sequence[Node]]) -> list[tuple[Node, ...]]:
    """Return the faces, each walked round with the face on the left; bounded ones counter-clockwise."""
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
    blocks = enumerate(nx.biconnected_component_edges(graph))
    block_of = {frozenset(edge): number for number, block in blocks for edge in block}
    for node, row in rotations.items():
        if len(row) < 2:
            continue
        for a, b in zip(row, [*row[1:], row[0]], strict=True):
            if a != b and block_of[frozenset((node, a))] != block_of[frozenset((node, b))]:
                return node, a, b
    return None


def same_cycle(first: Sequence[Hashable], second: Sequence[Hashable]) -> bool:
    """Check whether two rows without repetitions are one cycle, begun at any place, and run the same way."""
    if len(first) != len(second) or not first or first[0] not in second:
        return False
    start = second.index(first[0])
    return tuple(first) == (*second[start:], *second[:start])


def swaps_of(links: Sequence[LinkId], joints: Joints) -> Iterator[dict[Node, Node]]:
    """Yield symmetries of order two of a link-joint graph, as moves of ``("link", id)`` and ``("joint", id)``.

    For a large group the first are tried, those that are products of few generators.
    """
    number = {link: i for i, link in enumerate(links)}
    pairs = [(number[a], number[b]) for a, b in joints.values()]
    graph = subdivided(len(links), pairs)
    identity = tuple(range(graph.nodes))
    generators = [tuple(generator) for generator in symmetries_of(graph).generators]
    nodes: list[Node] = [*(("link", link) for link in links), *(("joint", joint) for joint in joints)]
    group, seen = [identity], {identity}
    for element in group:
        for generator in generators:
            product = tuple(generator[i] for i in element)
            if product not in seen and len(group) < _MOST_SYMMETRIES:
                seen.add(product)
                group.append(product)
    for element in group[1:]:
        if all(element[image] == i for i, image in enumerate(element)):
            yield {node: nodes[image] for node, image in zip(nodes, element, strict=False)}


def mirrored(graph: nx.Graph, swap: Mapping[Node, Node]) -> Neighbours | None:
    """Return rotations of a connected graph that a symmetry of order two reverses; None if there are none.

    The symmetry swaps the ends of no edge.
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
    images: set[Node] = set()
    half: list[Node] = []
    rest = part_of(graph, {node for node in graph if swap[node] != node})
    for piece in nx.connected_components(rest):
        if any(swap[node] in piece for node in piece):
            return None
        if not images & piece:
            half += [node for node in graph if node in piece]
            images |= {swap[node] for node in piece}
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
    """Return the far end of an edge: also of an edge on the mirror, whose middle is a node."""
    if isinstance(node, tuple) and node[:1] == ("middle",) and len(node) == 3:
        return node[2] if node[1] == seen_from else node[1]
    return node


@dataclass(frozen=True, slots=True)
class Skeleton:
    """A plane graph to lay out. Nodes are ``("link", id)``, ``("joint", id)``, ``("side", link, {joint, joint})``.

    `around` has the neighbours of each node, and `outlines` the corners of each body (none for dots),
    counter-clockwise; `mirror` is a symmetry that reverses the rotations, of all links and joints too.
    """

    around: Neighbours
    outlines: dict[Node, tuple[Node, ...]]
    mirror: dict[Node, Node] | None


def dots(incidence: Neighbours, mirror: dict[Node, Node] | None = None) -> Skeleton:
    """Return links as nodes, from the rotations of links and joints."""
    pairs = Counter(frozenset(row) for node, row in incidence.items() if node[0] == "joint")
    around: Neighbours = {}
    for node, row in incidence.items():
        if node[0] == "joint":
            if pairs[frozenset(row)] > 1:
                around[node] = row
            continue
        around[node] = tuple(
            joint if pairs[frozenset(pair)] > 1 else pair[1] if pair[0] == node else pair[0]
            for joint, pair in ((joint, incidence[joint]) for joint in row)
        )
    return Skeleton(around, {}, mirror)


def bodies(incidence: Neighbours, mirror: Mapping[Node, Node] | None = None) -> Skeleton:
    """Return joints as nodes and links as rings of sides, from the rotations of links and joints."""
    sides = {
        link: list(pairwise(row if len(row) < 3 else (*row, row[0])))
        for link, row in incidence.items()
        if link[0] == "link"
    }
    often = Counter(frozenset(side) for rows in sides.values() for side in rows)
    towards: dict[Node, dict[Node, list[Node]]] = {node: {} for node in incidence}
    around: Neighbours = {}
    outlines: dict[Node, tuple[Node, ...]] = {}
    for link, pairs in sides.items():
        row = incidence[link]
        if len(row) < 2:
            around[link] = row
            outlines[link] = (link, *row)
            for joint in row:
                towards[joint][link] = [link]
            continue
        corners: list[Node] = []
        for a, b in pairs:
            corners.append(a)
            if often[frozenset((a, b))] > 1:
                middle = ("side", link, frozenset((a, b)))
                around[middle] = (a, b)
                corners.append(middle)
        if len(row) == 2:
            corners.append(row[1])
        outlines[link] = tuple(corners)
        for joint in row:
            i = corners.index(joint)
            both = [corners[(i + 1) % len(corners)], corners[i - 1]]
            if len(row) == 2:  # not closed: the first corner is one end, the last the other
                middle_out = corners if len(corners) == 2 else [corners[1]] * 2
                both = [middle_out[1] if i == 0 else middle_out[0]]
            towards[joint][link] = both
    for joint, row in incidence.items():
        if joint[0] == "joint":
            around[joint] = tuple(node for link in row for node in towards[joint][link])
    return Skeleton(around, outlines, None if mirror is None else {**mirror, **{n: _moved(n, mirror) for n in around}})


def _moved(node: Node, mirror: Mapping[Node, Node]) -> Node:
    if node[0] == "side":
        link, ends = node[1:]
        return "side", mirror[link], frozenset(mirror[end] for end in ends)
    return mirror[node]
