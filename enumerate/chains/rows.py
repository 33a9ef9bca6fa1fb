"""Rows of chains: ids and attributes of the chains of contracted graphs.

What is the same for all chains of a contracted graph is worked out once for the graph; the rest is compiled. bliss
itself is asked for the canonical numbers of the few chains that `enumerate.kernel.bliss_order` leaves.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import repeat

import networkx as nx
import numpy as np

from enumerate.chains.inputs import input_choices
from enumerate.chains.query import ChainQuery, is_planar
from enumerate.contracted.graphs import decode
from enumerate.contracted.listing import (
    frame_of,
    graph6_rows,
    joints_of_all,
    orbits_of,
    orbits_of_all,
    placements_of,
    symmetries_of,
)
from enumerate.kernel.bliss_order import MOST_NODES, bliss_orders
from enumerate.runner.columns import Column, ListColumn
from enumerate.runner.job import Row
from graphs.identity.chains import automorphisms_of, canonical_numbers
from graphs.types import Bytes, Ints

__all__ = [
    "COLUMNS",
    "GROUND_COLUMNS",
    "INPUT_COLUMNS",
    "GraphChains",
    "assortment_of",
    "chain_ids",
    "columns_of",
    "rows_of_graph",
    "rows_of_joints",
]

COLUMNS: dict[str, Column] = {
    "code": str,
    "links": int,
    "joints": int,
    "dof": int,
    "loops": int,
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
    """The chains of one contracted graph that a query asks for.

    Rows of x, uint8[r, m], are the binary links on each joint, `order` counts the automorphisms of each chain.
    """

    code: Bytes
    n: int
    x: Bytes
    order: Ints

    @classmethod
    def of(cls, query: ChainQuery, code: Bytes, n: int, only: int, prefix: Ints) -> GraphChains:
        """List them, or those that begin in one way (`enumerate.chains.counting.count_of_graph`)."""
        x, order = placements_of(code, n, query.links, query.most, only, prefix)
        kept = query.symmetry.admitted(order)
        if query.longest_string.least > 0:  # the greatest length was seen to when they were placed
            kept &= x.max(axis=1, initial=0) >= query.longest_string.least
        return cls(code, n, x[kept], order[kept])

    def inversions(self, links: int) -> Ints:
        """Return the orbits of links of each chain: int64[r, links], the least link of the orbit of each."""
        ends, first, moved, automorphisms = frame_of(self.code, self.n)
        return orbits_of_all(ends, first, moved, automorphisms, links, self.x)


def rows_of_graph(query: ChainQuery, chains: GraphChains, bare: bool) -> list[Row]:
    """Return the rows of the chains of a contracted graph."""
    if not len(chains.x):
        return []
    ends, first, moved, automorphisms = frame_of(chains.code, chains.n)
    joints = joints_of_all(ends, chains.n, chains.x)
    codes, labels = chain_ids(query.links, joints, chains.order)
    if bare:
        return list(zip(codes, strict=True))
    orbits = chains.inversions(query.links)
    degrees = Counter(decode(chains.code, chains.n).sum(axis=1).tolist())
    assortment = assortment_of({**degrees, 2: query.links - chains.n})
    planar = is_planar(decode(chains.code, chains.n))
    counts = (orbits == np.arange(query.links)).sum(axis=1)
    common = map(repeat, (query.links, query.joints, query.dof, query.loops, assortment))
    own = (values.tolist() for values in (chains.x.max(axis=1), chains.order, counts))
    rows: list[Row] = list(zip(codes, *common, *own, repeat(planar), repeat(False), strict=False))
    if not (query.inversions or query.inputs):
        return rows
    found: list[Row] = []
    for i, row in enumerate(rows):
        generators = symmetries_of(ends, first, moved, automorphisms, query.links, chains.x[i])
        order = labels[i].tolist()
        renamed = np.empty_like(generators)
        renamed[:, order] = labels[i][generators]
        pairs = [(order[a], order[b]) for a, b in joints[i].tolist()]
        found += [(*row, *choice) for choice in _choices(query, pairs, renamed)]
    return found


def chain_ids(links: int, joints: Ints, automorphisms: Ints | None = None) -> tuple[list[str], Ints]:
    """Return the ids of simple chains of N links, and the canonical numbers of their links, int64[r, N].

    `automorphisms` says how many each chain has, where that is known: without, chains with symmetries take longer.
    """
    if not len(joints):
        return [], np.zeros((0, links), np.int64)
    if links <= MOST_NODES:
        known = np.ones(len(joints), np.int64) if automorphisms is None else automorphisms
        labels, left = bliss_orders(links, joints, known)
    else:
        labels, left = np.empty((len(joints), links), np.int64), np.arange(len(joints))
    for row in left.tolist():
        labels[row] = canonical_numbers(links, joints[row].tolist())
    text = graph6_rows(joints, labels).tobytes().decode("ascii")
    width = len(text) // len(labels)
    return [f"k1:{text[i : i + width]}" for i in range(0, len(text), width)], labels


def _choices(query: ChainQuery, joints: list[tuple[int, int]], generators: Ints) -> Iterator[Row]:
    """Yield the ground links of a chain, with input joints where asked for, one of each orbit.

    The generators, int64[g, links], are permutations of links that generate the automorphisms.
    """
    if query.inputs:
        for ground, inputs in input_choices(query.links, joints, generators.tolist(), query.dof):
            yield ground, tuple(inputs)
    else:
        yield from ((int(link),) for link in np.flatnonzero(orbits_of(generators) == np.arange(query.links)))


def rows_of_joints(query: ChainQuery, joints: Sequence[tuple[int, int]], bare: bool) -> list[Row]:
    """Return the rows of a chain given by its joints; none if the query does not ask for such a chain.

    The general way, for rings and for chains that are not 2-connected; links are 0 to N - 1.
    """
    graph = nx.Graph(joints)
    order, generators, symmetry = automorphisms_of(query.links, joints)
    degrees = Counter(degree for _, degree in graph.degree())
    longest = _longest_string(graph)
    planar: bool = nx.check_planarity(graph)[0]
    if not (
        query.admits_assortment(degrees)
        and query.admits(longest, symmetry)
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


def _longest_string(graph: nx.Graph) -> int:
    """Return the number of links of the longest row of binary links."""
    binary = graph.subgraph(link for link, degree in graph.degree() if degree == 2)
    return max(map(len, nx.connected_components(binary)), default=0)
