"""Independent loops of a link-joint graph, by blocks: faces of an embedding, or a shortest cycle basis."""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

import networkx as nx

from graphs.errors import InvariantError
from graphs.input_limits import check_work
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.types import JointId, Joints, LinkId


@dataclass(frozen=True, slots=True)
class BlockCycles:
    """The independent cycles of a block (2-connected part), and the face left out; None if it is not planar."""

    inner: tuple[tuple[JointId, ...], ...]
    outer: tuple[JointId, ...] | None


def block_cycles(links: Iterable[LinkId], joints: Joints) -> list[BlockCycles]:
    """Return J - N + c independent cycles of a link-joint graph, by blocks; joints may be parallel."""
    simple, joint_of = _subdivided(links, joints)
    blocks = map(nx.Graph, nx.biconnected_component_edges(simple))
    return [_cycles(block, joint_of) for block in blocks if block.number_of_edges() >= len(block)]


def sc_from_link_joint_graph(graph: nx.Graph, centre: Centre | str = Centre.FINITE, *, closed: bool = False) -> SCGraph:
    """Give a bare link-joint graph loops and centres: its most general spherical system.

    Parameters
    ----------
    graph : nx.Graph or nx.MultiGraph
        Nodes are links and edges joints. Joint ids are the edge keys where these are distinct, else indices.
        InvariantError for a self-joint, or a block that is not planar and beyond the limit ``basis``.
    centre : Centre, optional
        The centre of every loop.
    closed : bool, optional
        Whether the face left out carries a centre too (a closed surface). Needs a planar graph.

    Examples
    --------
    >>> import networkx as nx
    >>> cube = sc_from_link_joint_graph(nx.octahedral_graph(), closed=True)
    >>> len(cube.loops), len(cube.closing)
    (7, 1)
    """
    bare = SCGraph(graph, loops=())
    blocks = block_cycles(bare.nodes, bare.joints)
    loops = [Loop(cycle, Centre(centre)) for block in blocks for cycle in block.inner]
    closing = []
    if closed:
        for block in blocks:
            if block.outer is None:
                raise InvariantError("closed surface", "a block of the graph is not planar", "a planar graph")
            if len(block.inner) > 1:  # a ring has the same loop on both its sides
                closing.append(Loop(block.outer, Centre(centre)))
    return SCGraph(bare, loops=loops, closing=closing, centres_assumed=True)


def _subdivided(links: Iterable[LinkId], joints: Joints) -> tuple[nx.Graph, dict[frozenset[object], JointId]]:
    """Return a simple graph with the same embeddings; parallel joints get a node in the middle.

    networkx' PlanarEmbedding merges parallel edges, which would lose loops. Nodes are numbers: networkx keeps them
    in sets, whose order is another in every process where nodes are text, and so would be that of the loops.
    """
    number = {link: place for place, link in enumerate(links)}
    simple = nx.Graph()
    simple.add_nodes_from(number.values())
    joint_of: dict[frozenset[object], JointId] = {}
    for joint, (a, b) in joints.items():
        ends = number[a], number[b]
        path = ends if not simple.has_edge(*ends) else (ends[0], len(simple), ends[1])
        nx.add_path(simple, path)
        for one, two in pairwise(path):
            joint_of[frozenset((one, two))] = joint
    return simple, joint_of


def _cycles(block: nx.Graph, joint_of: dict[frozenset[object], JointId]) -> BlockCycles:
    planar, embedding = nx.check_planarity(block)
    if not planar:
        check_work("basis", block.number_of_edges(), "joints in a part that is not planar")
        basis = nx.minimum_cycle_basis(block)
        return BlockCycles(tuple(_as_joints(nodes, joint_of) for nodes in basis), None)
    seen: set[tuple[object, object]] = set()
    faces = []
    for half_edge in embedding.edges():
        if half_edge not in seen:
            faces.append(_as_joints(embedding.traverse_face(*half_edge, seen), joint_of))
    faces.sort(key=len)
    return BlockCycles(tuple(faces[:-1]), faces[-1])


def _as_joints(nodes: list[object], joint_of: dict[frozenset[object], JointId]) -> tuple[JointId, ...]:
    """Turn a closed walk over the subdivided graph into the joints it crosses."""
    around = [joint_of[frozenset(pair)] for pair in zip(nodes, nodes[1:] + nodes[:1], strict=True)]
    return tuple(dict.fromkeys(around))
