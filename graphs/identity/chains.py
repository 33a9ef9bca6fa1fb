"""Canonical ids of link-joint graphs, canonical codes and symmetries of mechanisms with centres.

Two mechanisms have the same id exactly if their links and joints correspond. The id is ``k1:`` and the graph6 of the
canonical form that `graphs.identity.leaves` defines; where links share several joints, its sparse6. A changed form
would be ``k2:``. The search takes simple graphs, so `subdivided` makes every joint that may be parallel a node.

With centres a mechanism becomes a coloured graph of its links, its joints, and its classes of loops with one
centre. Which loops were chosen within a class does not show. Theory: docs/theory/centre-classes.md.
"""

from collections.abc import Collection, Hashable, Iterable, Sequence
from typing import Any

import networkx as nx

from graphs.errors import InvariantError, shown
from graphs.identity.leaves import ColouredGraph
from graphs.identity.numbering import labels_of, symmetries_of
from graphs.mechanism.sc import SCGraph
from graphs.types import JointId, LinkId

# Colours of nodes: cells begin in their order, so it is part of the ids of chains with parallel joints.
_LINK = 0  # links come first: their numbers are read before those of joints
_JOINT = 1
_MARKED = 2  # a link that corresponds to no other, as one that is fixed


def subdivided(links: int, joints: Iterable[Sequence[int]], marked: int | None = None) -> ColouredGraph:
    """Return the graph of links, then joints, each joint beside its two links: joints may be parallel.

    Links are 0 to ``links - 1``; a marked one has a colour of its own.
    """
    pairs = list(joints)
    colours = [_MARKED if link == marked else _LINK for link in range(links)] + [_JOINT] * len(pairs)
    places = range(links, links + len(pairs))
    edges = [(k, end) for k, ends in zip(places, pairs, strict=True) for end in ends]
    return ColouredGraph(len(colours), edges, colours)


_PREFIX = "k1:"


def canonical_numbers(links: int, joints: Iterable[Sequence[int]]) -> list[int]:
    """Return the canonical number of each link, 0 to ``links - 1``, of a simple graph.

    Link i has number ``order[i]``; isomorphic graphs get the same pairs of numbers.

    >>> sorted(canonical_numbers(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))
    [0, 1, 2, 3]
    """
    return labels_of(ColouredGraph(links, joints))


def automorphisms_of(links: int, joints: Iterable[Sequence[int]]) -> tuple[list[int], list[list[int]], int]:
    """Return canonical numbers of the links of a simple graph, generators and number of its automorphisms.

    Parameters
    ----------
    links : int
        Links are 0 to ``links - 1``.
    joints : iterable of (int, int)
        Pairs of links; no pair twice.

    Examples
    --------
    >>> automorphisms_of(4, [(0, 1), (1, 2), (2, 3), (3, 0)])[2]
    8
    """
    order, generators, size = symmetries_of(ColouredGraph(links, joints))
    return order, generators, round(size)


def _order_with_parallel_joints(links: int, joints: Sequence[tuple[int, int]]) -> list[int]:
    """Return canonical numbers of links where joints may be parallel."""
    numbers = labels_of(subdivided(links, joints))[:links]
    rank = {number: i for i, number in enumerate(sorted(numbers))}
    return [rank[number] for number in numbers]


def _canonical_links(graph: nx.Graph) -> dict[Any, int]:
    """Return the canonical number of each link of a link-joint graph.

    Parallel joints are told apart from single ones. Raises `InvariantError` if a joint connects a link with
    itself, or the graph is directed.
    """
    if graph.is_directed():
        raise InvariantError("graph", "a directed graph", "an undirected one: joints have no direction")
    number = {link: i for i, link in enumerate(graph)}
    joints = [(number[a], number[b]) for a, b in graph.edges()]
    for a, b in joints:
        if a == b:
            raise InvariantError("joint", f"a joint of link {list(graph)[a]!r} with itself", "two links")
    distinct = len({(min(a, b), max(a, b)) for a, b in joints})
    find = canonical_numbers if distinct == len(joints) else _order_with_parallel_joints
    return dict(zip(graph, find(len(number), joints), strict=True))


def chain_id(graph: nx.Graph) -> str:
    """Return the canonical id of a link-joint graph, ``k1:...``.

    Parameters
    ----------
    graph : networkx.Graph or networkx.MultiGraph
        Links and joints; loops, centres and names do not count.

    Raises
    ------
    InvariantError
        If a joint connects a link with itself, or the graph is directed.

    Examples
    --------
    >>> chain_id(nx.cycle_graph(4)), chain_id(nx.relabel_nodes(nx.cycle_graph(4), {0: "a", 1: 7, 2: "c"}))
    ('k1:Cr', 'k1:Cr')
    """
    number = _canonical_links(graph)
    named = nx.MultiGraph()
    named.add_nodes_from(range(len(number)))
    named.add_edges_from(sorted(sorted((number[a], number[b])) for a, b in graph.edges()))
    simple = nx.Graph(named)
    several = simple.number_of_edges() < named.number_of_edges()
    line: bytes = nx.to_sparse6_bytes(named, header=False) if several else nx.to_graph6_bytes(simple, header=False)
    return _PREFIX + line.decode("ascii").rstrip("\n")


def chain_from_id(code: str) -> nx.Graph:
    """Return the link-joint graph of an id, a multigraph if links share several joints; its links are 0 to N - 1.

    Parameters
    ----------
    code : str
        ``k1:``, and a graph6 or sparse6.

    Raises
    ------
    InvariantError
        If it is not an id.

    Examples
    --------
    >>> chain_from_id("k1:Cr").number_of_edges()
    4
    """
    text = code.removeprefix(_PREFIX)
    if text == code:
        raise InvariantError("id", f"{shown(code)} is not the id of a chain", f"an id that begins with {_PREFIX}")
    try:
        data = text.encode("ascii")
        return nx.from_sparse6_bytes(data) if text.startswith(":") else nx.from_graph6_bytes(data)
    except (nx.NetworkXError, ValueError, IndexError):
        wrong = f"{shown(code)} is not the id of a chain"
        raise InvariantError("id", wrong, "graph6 or sparse6 after k1:") from None


def class_code(sc: SCGraph, marked: Collection[LinkId] = ()) -> tuple[Any, ...]:
    """Return the same code for two mechanisms exactly if links, joints and centre classes correspond.

    Parameters
    ----------
    sc : SCGraph
    marked : collection of link ids
        Links that must correspond to marked ones, such as those that an edit added.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> class_code(four_bar) == class_code(four_bar.relabel({0: "a"}))
    True
    """
    graph, colours = _coloured(sc, marked)
    labels = labels_of(graph)
    form = sorted(tuple(sorted((labels[a], labels[b]))) for a, b in graph.edges)
    return tuple(sorted(zip(labels, map(repr, colours), strict=True))), tuple(form), sc.spatial_loops


def symmetries_of_links(sc: SCGraph) -> list[dict[LinkId, LinkId]]:
    """Return permutations of the links that generate the symmetries of a mechanism.

    Each maps every link to its image; there are none if there is no symmetry but the identity.

    Parameters
    ----------
    sc : SCGraph or SCDGraph
        The sides of the links of an SCD graph do not count.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> len(symmetries_of_links(four_bar)) > 0
    True
    """
    graph, _ = _coloured(sc, ())
    links = list(sc.nodes)
    return [{link: links[moved[i]] for i, link in enumerate(links)} for moved in symmetries_of(graph).generators]


def _coloured(sc: SCGraph, marked: Collection[LinkId]) -> tuple[ColouredGraph, list[tuple[Any, ...]]]:
    """Return the coloured graph, links first in their order, and what the colours of its nodes stand for."""
    colours: list[tuple[Any, ...]] = []
    edges: list[tuple[int, int]] = []
    number: dict[tuple[str, Hashable], int] = {}

    def node(kind: str, name: LinkId | JointId | int, *colour: object) -> None:
        number[kind, name] = len(colours)
        colours.append((kind, *colour))

    for link in sc.nodes:
        node("link", link, link == sc.ground, link in marked)
    for joint, ends in sc.joints.items():
        node("joint", joint)
        edges += [(number["joint", joint], number["link", end]) for end in ends]
    for k, one in enumerate(sc.centre_classes()):
        closing = sum(loop >= len(sc.loops) for loop in one.loops)
        node("class", k, one.centre.value, len(one.loops), closing)
        edges += [(number["class", k], number["joint", joint]) for joint in one.joints]
    palette = {colour: i for i, colour in enumerate(sorted(set(colours), key=repr))}
    return ColouredGraph(len(colours), edges, [palette[colour] for colour in colours]), colours


def isomorphism(sc: SCGraph, other: SCGraph) -> tuple[dict[LinkId, LinkId], dict[JointId, JointId]]:
    """Return links and joints of another mechanism to which those of one correspond, centre classes too.

    Parameters
    ----------
    sc, other : SCGraph
        Of one `class_code`; else InvariantError.

    Examples
    --------
    >>> isomorphism(SCGraph(2, [(0, 1)]), SCGraph("ab", {"j": ("a", "b")}))[1]
    {0: 'j'}
    """
    numbers = []
    for one in (sc, other):
        graph, colours = _coloured(one, ())
        labels = labels_of(graph)
        form = {frozenset((labels[a], labels[b])) for a, b in graph.edges}
        names = [*one.nodes, *one.joints]
        numbers.append(
            (dict(zip(labels, map(repr, colours), strict=True)), form, dict(zip(labels, names, strict=False)))
        )
    (colours_of, form_of, names_of), (colours_there, form_there, there) = numbers
    if colours_of != colours_there or form_of != form_there:
        raise InvariantError(
            "isomorphism", "two mechanisms that do not correspond", "the same links, joints and centres"
        )
    image = {label: there[label] for label in names_of}
    links = {name: image[label] for label, name in names_of.items() if colours_of[label].startswith("('link'")}
    return links, {name: image[label] for label, name in names_of.items() if colours_of[label].startswith("('joint'")}
