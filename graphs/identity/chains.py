"""Canonical ids of link-joint graphs.

Two mechanisms have the same id exactly if their links and joints correspond. The id is ``k1:`` and the graph6 of
the canonical form that bliss finds; where links share several joints, its sparse6. A changed form would be
``k2:``.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from io import BytesIO
from typing import Any

import networkx as nx

from graphs.errors import InvariantError, shown
from graphs.identity.bliss import ColouredGraph, labels_of, subdivided, symmetries_of

__all__ = ["automorphisms_of", "canonical_order", "chain_from_id", "chain_id"]

_PREFIX = "k1:"


def canonical_order(links: int, joints: Iterable[Sequence[int]]) -> list[int]:
    """Return the canonical number of each link, 0 to ``links - 1``, of a simple graph.

    Link i has number ``order[i]``; isomorphic graphs get the same pairs of numbers.

    >>> sorted(canonical_order(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))
    [0, 1, 2, 3]
    """
    return labels_of(ColouredGraph(links, joints))


def automorphisms_of(links: int, joints: Iterable[Sequence[int]]) -> tuple[list[int], list[list[int]], int]:
    """Return canonical numbers of the links of a simple graph, and its automorphisms.

    Parameters
    ----------
    links : int
        Links are 0 to ``links - 1``.
    joints : iterable of (int, int)
        Pairs of links; no pair twice.

    Returns
    -------
    order : list of int
        As `canonical_order` gives it.
    generators : list of list of int
        Permutations of the links that generate the group.
    size : int
        Number of automorphisms.

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
    find = canonical_order if distinct == len(joints) else _order_with_parallel_joints
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
    >>> chain_id(nx.cycle_graph(4)) == chain_id(nx.relabel_nodes(nx.cycle_graph(4), {0: "a", 1: 7, 2: "c"}))
    True
    >>> chain_id(nx.cycle_graph(4))
    'k1:Cr'
    """
    number = _canonical_links(graph)
    named = nx.MultiGraph()
    named.add_nodes_from(range(len(number)))
    named.add_edges_from(sorted(sorted((number[a], number[b])) for a, b in graph.edges()))
    simple = nx.Graph(named)
    if simple.number_of_edges() == named.number_of_edges():
        line: bytes = nx.to_graph6_bytes(simple, header=False)
        return _PREFIX + line.decode("ascii").rstrip("\n")
    text = BytesIO()
    nx.write_sparse6(named, text, header=False)
    return _PREFIX + text.getvalue().decode("ascii").rstrip("\n")


def chain_from_id(code: str) -> nx.Graph:
    """Return the link-joint graph of an id; its links are 0 to N - 1.

    Parameters
    ----------
    code : str
        ``k1:``, and a graph6 or sparse6.

    Returns
    -------
    networkx.Graph
        A multigraph, if links share several joints.

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
        raise InvariantError("id", f"the id {code!r}", f"one that begins with {_PREFIX}")
    try:
        data = text.encode("ascii")
        return nx.from_sparse6_bytes(data) if text.startswith(":") else nx.from_graph6_bytes(data)
    except (nx.NetworkXError, ValueError, IndexError):
        raise InvariantError("id", f"the id {shown(code)}", "graph6 or sparse6 after k1:") from None
