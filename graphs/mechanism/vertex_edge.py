"""Vertex-edge graphs: spherical centres as vertices, creases as edges.

It is the dual of the SC graph (Bowen and others; Wiener 2016, Tables 4 and 5): the sectors between creases are the
links. Creases that run to the border of the sheet end free. The cyclic order of the creases round each vertex
makes the graph definite. Theory: docs/theory/vertex-edge-graphs.md.
"""

from collections import deque
from collections.abc import Hashable, Mapping, Sequence
from types import MappingProxyType

import networkx as nx

from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.loops.loop import Centre, Loop, split_dependent
from graphs.mechanism.sc import SCGraph
from graphs.types import JointId, LinkId

Sector = tuple[Hashable, int]


class VertexEdgeGraph:
    """Spherical centres with the creases round each.

    Parameters
    ----------
    vertices : mapping of vertex to sequence of crease ids
        The creases that end in each vertex, counter-clockwise, two or more. A crease named at two vertices joins
        them; one named once runs to the border. `InvariantError` if one is named twice at one vertex or at three
        vertices.

    Examples
    --------
    >>> graph = VertexEdgeGraph({"A": ("a", "b", "c", "d"), "B": ("a", "e", "f", "g")})
    >>> graph.creases["a"], graph.creases["b"]
    (('A', 'B'), ('A',))
    """

    def __init__(self, vertices: Mapping[Hashable, Sequence[JointId]]) -> None:
        self._vertices = {vertex: tuple(creases) for vertex, creases in vertices.items()}
        ends_of: dict[JointId, list[Hashable]] = {}
        for vertex, creases in self._vertices.items():
            if len(creases) < 2 or len(set(creases)) < len(creases):
                raise InvariantError(
                    "vertex-edge graph",
                    f"vertex {shown(vertex)} has the creases {shown(list(creases))}",
                    "two or more, each once",
                )
            for crease in creases:
                ends_of.setdefault(crease, []).append(vertex)
        self._creases: dict[JointId, tuple[Hashable, ...]] = {c: tuple(ends) for c, ends in ends_of.items()}
        for crease, ends in self._creases.items():
            if len(ends) > 2:
                raise InvariantError(
                    "vertex-edge graph", f"crease {shown(crease)} ends in {len(ends)} vertices", "two at most"
                )

    def __repr__(self) -> str:
        vertices = numbered(len(self._vertices), "vertex", "vertices")
        return f"<VertexEdgeGraph: {vertices}, {numbered(len(self._creases), 'crease')}>"

    @property
    def vertices(self) -> Mapping[Hashable, tuple[JointId, ...]]:
        """Vertex to its creases, counter-clockwise (read-only)."""
        return MappingProxyType(self._vertices)

    @property
    def creases(self) -> Mapping[JointId, tuple[Hashable, ...]]:
        """Crease to the one or two vertices it ends in (read-only)."""
        return MappingProxyType(self._creases)

    def to_networkx(self) -> nx.MultiGraph:
        """Return the vertices and the creases between them as a plain multigraph."""
        graph = nx.MultiGraph()
        graph.add_nodes_from(self._vertices)
        graph.add_edges_from((*ends, crease) for crease, ends in self._creases.items() if len(ends) == 2)
        return graph

    def is_identical(self, other: object) -> bool:
        """Return whether two graphs are the same, ids and all; where a cyclic order starts does not matter."""
        if not isinstance(other, VertexEdgeGraph) or set(self.vertices) != set(other.vertices):
            return False
        return all(_same_turn(order, other.vertices[vertex]) for vertex, order in self.vertices.items())


def sc_from_vertex_edge(graph: VertexEdgeGraph) -> SCGraph:
    """Return the SC graph: one link per sector of the sheet, one joint per crease, one finite centre per vertex.

    Parameters
    ----------
    graph : VertexEdgeGraph
        Its creases name the joints, its vertices the loops; `InvariantError` if a crease has one link on both
        sides.

    Examples
    --------
    >>> sc_from_vertex_edge(VertexEdgeGraph({"A": ("a", "b", "c", "d"), "B": ("a", "e", "f", "g")}))
    <SCGraph: 6 links, 7 joints, 2 centres>
    """
    place = {(v, crease): i for v, creases in graph.vertices.items() for i, crease in enumerate(creases)}

    def sector(vertex: Hashable, index: int) -> Sector:
        return vertex, index % len(graph.vertices[vertex])

    sectors = nx.utils.UnionFind((v, i) for v, creases in graph.vertices.items() for i in range(len(creases)))
    for crease, ends in graph.creases.items():
        if len(ends) == 2:  # left of the crease from one end is right of it from the other
            (a, i), (b, k) = ((v, place[v, crease]) for v in ends)
            sectors.union(sector(a, i), sector(b, k - 1))
            sectors.union(sector(a, i - 1), sector(b, k))
    link: dict[Sector, int] = {}
    for vertex, creases in graph.vertices.items():
        for i in range(len(creases)):
            link.setdefault(sectors[vertex, i], len(link))
    joints = {}
    for crease, ends in graph.creases.items():
        i = place[ends[0], crease]
        joints[crease] = (link[sectors[sector(ends[0], i - 1)]], link[sectors[sector(ends[0], i)]])
    loops = [Loop(creases, Centre.FINITE, str(vertex)) for vertex, creases in graph.vertices.items()]
    kept, closing = split_dependent(list(graph.vertices.values()))
    return SCGraph(len(link), joints, [loops[i] for i in kept], closing=[loops[i] for i in closing])


def vertex_edge_from_sc(sc: SCGraph) -> VertexEdgeGraph:
    """Return the vertex-edge graph of an SC graph: a vertex for each loop, the joints round it in order.

    Vertices have the names of the loops, or their numbers; numbers only where two names are equal.

    Parameters
    ----------
    sc : SCGraph
        A sheet of finite centres; `UnsolvableError` if a loop is spatial or planar, or a joint lies in no loop or
        in more than two.

    Examples
    --------
    >>> graph = VertexEdgeGraph({"A": ("a", "b", "c", "d"), "B": ("a", "e", "f", "g")})
    >>> vertex_edge_from_sc(sc_from_vertex_edge(graph)).is_identical(graph)
    True
    """
    loops = (*sc.loops, *sc.closing)
    if sc.spatial_loops or any(loop.centre is not Centre.FINITE for loop in loops):
        raise UnsolvableError("a vertex-edge graph needs a finite centre in every loop")
    through: dict[JointId, list[int]] = {joint: [] for joint in sc.joints}
    for i, loop in enumerate(loops):
        for joint in loop.joints:
            through[joint].append(i)
    for joint, here in through.items():
        if not 1 <= len(here) <= 2:
            raise UnsolvableError(
                f"joint {shown(joint)} lies in {len(here)} loops; on a sheet a crease ends in one vertex or two"
            )
    order = _walked_alike(sc, loops, through)
    names = [loop.name if loop.name is not None else i for i, loop in enumerate(loops)]
    if len(set(map(str, names))) < len(names):
        names = list(range(len(loops)))
    return VertexEdgeGraph({names[i]: order[i] for i in range(len(loops))})


def _walked_alike(
    sc: SCGraph, loops: Sequence[Loop], through: Mapping[JointId, list[int]]
) -> dict[int, tuple[JointId, ...]]:
    """Choose a direction for each loop so that a joint in two loops is passed in opposite directions.

    That can be done: a sheet with one side has a cycle that is no sum of loops, and so a spatial loop.
    """
    walks = [_passages(loop.joints, sc.joints) for loop in loops]
    turned: dict[int, bool] = {}
    for start in range(len(loops)):
        if start in turned:
            continue
        turned[start] = False
        queue = deque([start])
        while queue:
            i = queue.popleft()
            for joint in loops[i].joints:
                for k in through[joint]:
                    if k == i:
                        continue
                    if k not in turned:
                        turned[k] = turned[i] ^ (walks[i][joint] == walks[k][joint])
                        queue.append(k)
    return {i: loop.joints[::-1] if turned[i] else loop.joints for i, loop in enumerate(loops)}


def _passages(around: Sequence[JointId], joints: Mapping[JointId, tuple[LinkId, LinkId]]) -> dict[JointId, LinkId]:
    """Return, for each joint of a cyclic walk, the link from which the walk crosses it."""
    first, second = around[0], around[1]
    here = joints[first][0] if joints[first][1] in joints[second] else joints[first][1]
    crossed: dict[JointId, LinkId] = {}
    for joint in around:
        a, b = joints[joint]
        crossed[joint] = here
        here = b if here == a else a
    return crossed


def _same_turn(one: Sequence[JointId], two: Sequence[JointId]) -> bool:
    if len(one) != len(two) or one[0] not in two:
        return False
    start = list(two).index(one[0])
    return tuple(one) == (*two[start:], *two[:start])
