from itertools import combinations, combinations_with_replacement

import networkx as nx
import numpy as np
import pytest

from enumerate.contracted.graphs import contracted_graphs, cubic_graphs, decode
from enumerate.kernel.labelling import canonical_labels
from graphs.errors import InvariantError
from graphs.identity.chains import chain_id


def as_multigraph(adjacency):
    n = len(adjacency)
    joints = [(i, j) for i, j in combinations(range(n), 2) for _ in range(adjacency[i, j])]
    return nx.MultiGraph(joints)


def brute_force(n, loops):
    """All 2-connected multigraphs without self-joints, three joints or more a link."""
    found = set()
    for joints in combinations_with_replacement(list(combinations(range(n), 2)), n + loops - 1):
        graph = nx.MultiGraph(joints)
        if len(graph) == n and min(d for _, d in graph.degree()) >= 3 and nx.is_biconnected(nx.Graph(graph)):
            found.add(chain_id(graph))
    return found


@pytest.mark.parametrize(
    ("n", "loops"),
    [(2, 2), (2, 3), (3, 3), (4, 3), (2, 4), (3, 4), (4, 4), (4, 5), pytest.param(5, 4, marks=pytest.mark.slow)],
)
def test_against_all_multigraphs(n, loops):
    codes = dict(contracted_graphs(loops))[n]
    ids = [chain_id(as_multigraph(decode(code, n))) for code in codes]
    assert len(set(ids)) == len(ids)
    assert set(ids) == brute_force(n, loops)


def test_numbers():
    totals = [sum(len(codes) for _, codes in contracted_graphs(loops)) for loops in range(2, 8)]
    assert totals == [1, 4, 17, 118, 1198, 17133]
    assert [len(cubic_graphs(loops)) for loops in range(2, 8)] == [1, 2, 5, 16, 66, 365]


@pytest.mark.parametrize("loops", [5, 6])
def test_codes_are_canonical_and_what_they_should_be(loops):
    for n, codes in contracted_graphs(loops):
        assert len(np.unique(codes, axis=0)) == len(codes)
        for code in codes:
            adjacency = decode(code, n)
            order, _ = canonical_labels(adjacency, n)
            assert np.array_equal(adjacency[np.ix_(order, order)], adjacency)
            graph = as_multigraph(adjacency)
            assert graph.number_of_edges() - len(graph) + 1 == loops
            assert min(d for _, d in graph.degree()) >= 3
            assert n == 2 or nx.is_biconnected(nx.Graph(graph))


@pytest.mark.slow
def test_numbers_with_eight_loops():
    assert sum(len(codes) for _, codes in contracted_graphs(8)) == 311757


@pytest.mark.parametrize("loops", [1, 12])
def test_numbers_of_loops_out_of_range(loops):
    with pytest.raises(InvariantError, match="2 to 11"):
        cubic_graphs(loops)
