"""Rows of chains: ids and attributes of the chains of contracted graphs, their ground links and input joints.

What is the same for all chains of a contracted graph is worked out once for the graph; the rest is compiled.

M joints are inputs of a chain of M freedoms if nothing moves once they are locked. In a chain a joint leaves one
of three freedoms, so it is two bars between its links, and a locked one three; a generic chain of N links is
rigid, and no bar is redundant, exactly if any k links hold at most 3 (k - 1) of the bars (Tay 1984). The pebble
game decides that. Of choices that symmetries of the chain exchange, one is listed.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, repeat

import networkx as nx
import numpy as np

from enumerate.chains.query import ChainQuery, is_planar
from enumerate.contracted.binary_links import (
    Frame,
    PlacementRange,
    frame_of,
    graph6_rows,
    joints_of_all,
    link_symmetries,
    list_placements,
    orbits_of,
    orbits_of_all,
)
from enumerate.contracted.graphs import decode
from enumerate.runner.job import Column, ListColumn, Row
from graphs.identity.chains import automorphisms_of
from graphs.identity.numbering import numbers_of_rows
from graphs.types import Bytes, Ints

SIZE_COLUMNS: dict[str, Column] = dict.fromkeys(("links", "joints", "dof", "loops"), int)
COLUMNS: dict[str, Column] = {
    "code": str,
    **SIZE_COLUMNS,
    "assortment": ListColumn(","),
    "longest_string": int,
    "symmetry": int,
    "inversions": int,
    "planar": bool,
    "fractionated": bool,
}
GROUND_COLUMNS: dict[str, Column] = {"ground": int}
INPUT_COLUMNS: dict[str, Column] = {"inputs": ListColumn(" ", "-")}


def columns_of(query: ChainQuery, bare: bool) -> dict[str, Column]:
    """Return names and types of the values of a row; ``bare`` rows have the id alone."""
    if bare:
        return {"code": str}
    ground = GROUND_COLUMNS if query.inversions or query.inputs else {}
    return {**COLUMNS, **ground, **(INPUT_COLUMNS if query.inputs else {})}


@dataclass(frozen=True, slots=True)
class GraphChains:
    """The chains of one contracted graph that a query admits.

    Rows of x, uint8[r, m], are the binary links on each joint, `order` counts the automorphisms of each chain.
    """

    code: Bytes
    frame: Frame
    x: Bytes
    order: Ints

    @classmethod
    def of(cls, query: ChainQuery, code: Bytes, n: int, only: int, prefix: Ints) -> GraphChains:
        """List them, or those that begin in one way (`enumerate.chains.counting.count_of_graph`)."""
        frame = frame_of(code, n)
        x, order = list_placements(frame, PlacementRange(query.links, query.most, only), prefix)
        admitted = query.symmetry.admitted(order)
        if query.longest_string.least > 0:  # the greatest length was seen to when they were placed
            admitted &= x.max(axis=1, initial=0) >= query.longest_string.least
        return cls(code, frame, x[admitted], order[admitted])

    def inversions(self, links: int) -> Ints:
        """Return the orbits of links of each chain: int64[r, links], the least link of the orbit of each."""
        return orbits_of_all(self.frame, links, self.x)


def rows_of_graph(query: ChainQuery, chains: GraphChains, bare: bool) -> list[Row]:
    """Return the rows of the chains of a contracted graph."""
    if not len(chains.x):
        return []
    joints = joints_of_all(chains.frame, chains.x)
    codes, labels = chain_ids(query.links, joints, chains.order)
    if bare:
        return list(zip(codes, strict=True))
    orbits = chains.inversions(query.links)
    adjacency = decode(chains.code, chains.frame.links)
    degrees = Counter(adjacency.sum(axis=1).tolist())
    assortment = assortment_of({**degrees, 2: query.links - len(adjacency)})
    planar = is_planar(adjacency)
    counts = (orbits == np.arange(query.links)).sum(axis=1)
    common = map(repeat, (query.links, query.joints, query.dof, query.loops, assortment))
    own = (values.tolist() for values in (chains.x.max(axis=1), chains.order, counts))
    rows: list[Row] = list(zip(codes, *common, *own, repeat(planar), repeat(False), strict=False))
    if not (query.inversions or query.inputs):
        return rows
    choices: list[Row] = []
    for i, row in enumerate(rows):
        generators = link_symmetries(chains.frame, query.links, chains.x[i])
        order = labels[i].tolist()
        renamed = np.empty_like(generators)
        renamed[:, order] = labels[i][generators]
        pairs = [(order[a], order[b]) for a, b in joints[i].tolist()]
        choices += [(*row, *choice) for choice in _choices(query, pairs, renamed)]
    return choices


def chain_ids(links: int, joints: Ints, automorphisms: Ints | None = None) -> tuple[list[str], Ints]:
    """Return the ids of simple chains of N links, and the canonical numbers of their links, int64[r, N].

    `automorphisms` says how many each chain has, where that is known: without, chains with symmetries take longer.
    """
    if not len(joints):
        return [], np.zeros((0, links), np.int64)
    labels = numbers_of_rows(links, joints, automorphisms)
    text = graph6_rows(joints, labels).tobytes().decode("ascii")
    width = len(text) // len(labels)
    return [f"k1:{text[i : i + width]}" for i in range(0, len(text), width)], labels


def _choices(query: ChainQuery, joints: list[tuple[int, int]], generators: Ints) -> Iterator[Row]:
    """Yield the ground links of a chain, with input joints if the query has them, one of each orbit.

    The generators, int64[g, links], are permutations of links that generate the automorphisms.
    """
    if query.inputs:
        for ground, inputs in input_choices(query.links, joints, generators.tolist(), query.dof):
            yield ground, tuple(inputs)
    else:
        yield from ((int(link),) for link in np.flatnonzero(orbits_of(generators) == np.arange(query.links)))


def rows_of_joints(query: ChainQuery, joints: Sequence[tuple[int, int]], bare: bool) -> list[Row]:
    """Return the rows of a chain, by its joints; none if the query does not admit it.

    The general way, for rings and for chains that are not 2-connected; links are 0 to N - 1.
    """
    graph = nx.Graph(joints)
    order, generators, symmetry = automorphisms_of(query.links, joints)
    degrees = Counter(degree for _, degree in graph.degree())
    binary = graph.subgraph(link for link, degree in graph.degree() if degree == 2)
    longest = max(map(len, nx.connected_components(binary)), default=0)
    planar: bool = nx.check_planarity(graph)[0]
    if not (
        query.admits_assortment(degrees)
        and longest in query.longest_string
        and symmetry in query.symmetry
        and (query.planar is None or planar == query.planar)
    ):
        return []
    pairs = [(order[a], order[b]) for a, b in joints]
    line = graph6_rows(np.array([joints], np.int64), np.array([order], np.int64)).tobytes().decode("ascii")
    if bare:
        return [(f"k1:{line}",)]
    moves = np.array([range(query.links), *generators], np.int64)
    renamed = np.empty_like(moves)
    renamed[:, order] = np.array(order)[moves]
    row = (
        f"k1:{line}",
        query.links,
        query.joints,
        query.dof,
        query.loops,
        assortment_of(degrees),
        longest,
        symmetry,
        int((orbits_of(renamed) == np.arange(query.links)).sum()),
        planar,
        not nx.is_biconnected(graph),
    )
    if not (query.inversions or query.inputs):
        return [row]
    return [(*row, *choice) for choice in _choices(query, pairs, renamed)]


def assortment_of(degrees: Mapping[int, int]) -> tuple[int, ...]:
    """Return the numbers of binary, ternary, ... links."""
    return tuple(degrees.get(degree, 0) for degree in range(2, max(degrees) + 1))


Joint = tuple[int, int]


def are_inputs(links: int, joints: Sequence[Joint], locked: Sequence[int]) -> bool:
    """Return whether locking some joints of a chain, by their indices, takes one freedom each.

    The chain has no rigid sub-chains.
    """
    bars = [ends for index, ends in enumerate(joints) for _ in range(2 + (index in locked))]
    return _is_sparse(links, bars)


def _is_sparse(nodes: int, bars: Sequence[Joint]) -> bool:
    """Tell whether any k nodes hold at most 3 (k - 1) bars: the (3, 3) pebble game.

    Every node has three pebbles; a bar takes one of an end's. It may lie if four pebbles can be brought to its
    ends, moving pebbles against the bars that took them.
    """
    pebbles = [3] * nodes
    out: list[list[int]] = [[] for _ in range(nodes)]
    for a, b in bars:
        while pebbles[a] + pebbles[b] < 4:
            if not (_fetch(a, b, pebbles, out) or _fetch(b, a, pebbles, out)):
                return False
        taker, other = (a, b) if pebbles[a] else (b, a)
        pebbles[taker] -= 1
        out[taker].append(other)
    return True


def _fetch(node: int, keep: int, pebbles: list[int], out: list[list[int]]) -> bool:
    """Bring one more pebble to a node, not from the node ``keep``; return whether there was one."""
    came_from = {node: node, keep: keep}
    stack = [node]
    while stack:
        here = stack.pop()
        for there in out[here]:
            if there in came_from:
                continue
            came_from[there] = here
            if pebbles[there]:
                pebbles[there] -= 1
                pebbles[node] += 1
                while there != node:
                    before = came_from[there]
                    out[before].remove(there)
                    out[there].append(before)
                    there = before  # noqa: PLW2901 - walk back along the path
                return True
            stack.append(there)
    return False


def input_choices(
    links: int, joints: Sequence[Joint], generators: Sequence[Sequence[int]], dof: int
) -> Iterator[tuple[int, list[Joint]]]:
    """Yield choices of a ground link and `dof` input joints of a chain, one of each orbit, the least one.

    The generators are permutations of the links that generate the automorphisms.

    >>> ring = [(0, 1), (1, 2), (2, 3), (3, 0)]
    >>> list(input_choices(4, ring, [[1, 2, 3, 0], [0, 3, 2, 1]], 1))
    [(0, [(0, 1)]), (0, [(1, 2)])]
    """
    ordered = sorted((min(joint), max(joint)) for joint in joints)
    number = {joint: i for i, joint in enumerate(ordered)}
    moves = [(move, [number[min(move[a], move[b]), max(move[a], move[b])] for a, b in ordered]) for move in generators]
    chosen = [c for c in combinations(range(len(ordered)), dof) if dof == 1 or are_inputs(links, ordered, c)]
    seen: set[tuple[int, tuple[int, ...]]] = set()
    for ground in range(links):
        for inputs in chosen:
            if (ground, inputs) in seen:
                continue
            yield ground, [ordered[i] for i in inputs]
            seen.add((ground, inputs))
            stack = [(ground, inputs)]
            while stack:
                link, chosen_joints = stack.pop()
                for move, joint_move in moves:
                    image = move[link], tuple(sorted(joint_move[i] for i in chosen_joints))
                    if image not in seen:
                        seen.add(image)
                        stack.append(image)
