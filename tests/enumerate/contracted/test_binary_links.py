from itertools import combinations, product

import networkx as nx
import numpy as np
import pytest
from sizes import slow

from enumerate.chains.counting import count_by_burnside, count_by_orbits, count_of_graph
from enumerate.contracted.binary_links import PlacementRange, frame_of, list_placements, no_prefix, orbits_of_all
from enumerate.contracted.graphs import contracted_graphs
from graphs.identity.chains import automorphisms_of, chain_id


def chain(ends, n, x):
    """The chain of a placement; None if a joint would be double."""
    graph = nx.MultiGraph()
    for e, (a, b) in zip(range(len(ends)), ends.tolist(), strict=True):
        nx.add_path(graph, [a, *((e, i) for i in range(x[e])), b])
    return graph


def can_all_move(graph):
    links = list(graph)
    number = {link: i for i, link in zip(range(len(links)), links, strict=True)}
    ends = [1 << number[a] | 1 << number[b] for a, b in graph.edges()]
    for size in range(2, len(links) + 1):
        for chosen in combinations(range(len(links)), size):
            s = sum(1 << v for v in chosen)
            if 3 * (size - 1) - 2 * sum(end & s == end for end in ends) < 1:
                return False
    return True


@pytest.mark.parametrize(
    ("loops", "dof"), [(2, 1), (2, 2), (2, 4), (3, 1), slow(3, 2), pytest.param(3, 3, marks=pytest.mark.slow)]
)
def test_against_all_placements(loops, dof):
    """Every way to place the links, the chains built and looked at one by one, and told apart by bliss."""
    links = dof + 2 * loops + 1
    for n, codes in contracted_graphs(loops):
        for code in codes:
            compare(code, n, links, dof)


def compare(code, n, links, dof):
    frame = frame_of(code, n)
    ends = frame.ends
    expected = set()
    for x in product(range(dof + 2), repeat=len(ends)):
        if sum(x) == links - n:
            made = chain(ends, n, x)
            if can_all_move(made):
                expected.add(chain_id(made))
    x, order = list_placements(frame, PlacementRange(links, dof + 1, -1), no_prefix())
    made = [chain(ends, n, row) for row in x.tolist()]
    ids = [chain_id(graph) for graph in made]
    assert len(set(ids)) == len(ids)
    assert set(ids) == expected
    assert len(ids) == count_by_orbits(code[None], n, links, dof + 1, False)
    assert len(ids) == count_by_burnside(code[None], n, links, dof + 1, False)
    orbits = orbits_of_all(frame, links, x)
    for graph, size, orbit in zip(made, order.tolist(), orbits, strict=True):
        number = {link: i for i, link in zip(range(links), graph, strict=True)}
        _, generators, true_size = automorphisms_of(links, [(number[a], number[b]) for a, b in graph.edges()])
        assert size == true_size
        shifted = nx.utils.UnionFind(range(links))
        for generator in generators:
            for v in range(links):
                shifted.union(v, generator[v])
        assert len(list(shifted.to_sets())) == len(set(orbit.tolist()))
    inversions = count_by_burnside(code[None], n, links, dof + 1, True)
    assert inversions == sum(len(set(orbit.tolist())) for orbit in orbits)


@pytest.mark.parametrize("most", [0, 1, 2])
def test_limits_and_parts_add_up(most):
    links = 12
    for n, codes in contracted_graphs(5):
        for code in codes[:5]:
            whole = count_of_graph(code, n, links, most, -1, np.zeros(0, np.int64))
            x, _ = list_placements(frame_of(code, n), PlacementRange(links, most, -1), no_prefix())
            assert len(x) == whole
            assert x.max(initial=0) <= most
            parts = 0
            for only in range(links - n + 1):
                here = count_of_graph(code, n, links, most, only, np.zeros(0, np.int64))
                begun = [count_of_graph(code, n, links, most, only, np.array([e])) for e in range(len(code))]
                assert here == sum(begun) or links == n
                parts += here
            assert parts == whole
