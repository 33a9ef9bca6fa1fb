from itertools import permutations

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, strategies as st

from enumerate.kernel.labelling import canonical_labels


def matrix(graph):
    a = nx.to_numpy_array(graph, dtype=np.uint8)
    np.fill_diagonal(a, 0)
    return a


def form(adjacency):
    order, automorphisms = canonical_labels(adjacency, len(adjacency))
    return adjacency[np.ix_(order, order)], automorphisms


@st.composite
def multigraphs(draw, largest=6):
    n = draw(st.integers(1, largest))
    upper = draw(st.lists(st.integers(0, 3), min_size=n * (n - 1) // 2, max_size=n * (n - 1) // 2))
    a = np.zeros((n, n), np.uint8)
    a[np.triu_indices(n, 1)] = upper
    return a + a.T


@given(multigraphs(), st.randoms())
def test_relabelled_graphs_have_one_form(adjacency, random):
    order = list(range(len(adjacency)))
    random.shuffle(order)
    assert np.array_equal(form(adjacency)[0], form(adjacency[np.ix_(order, order)].copy())[0])


@given(multigraphs())
def test_all_automorphisms_and_no_others(adjacency):
    canonical, automorphisms = form(adjacency)
    n = len(adjacency)
    expected = {p for p in permutations(range(n)) if np.array_equal(canonical[np.ix_(p, p)], canonical)}
    assert {tuple(a) for a in automorphisms.tolist()} == expected
    assert len(automorphisms) == len(expected)
    assert automorphisms[0].tolist() == list(range(n))


@pytest.mark.parametrize(
    ("graph", "size"),
    [
        (nx.petersen_graph(), 120),
        (nx.complete_bipartite_graph(4, 4), 1152),
        (nx.cubical_graph(), 48),
        (nx.dodecahedral_graph(), 120),
        (nx.frucht_graph(), 1),
        (nx.heawood_graph(), 336),
        (nx.moebius_kantor_graph(), 96),
    ],
)
def test_groups_of_named_graphs(graph, size):
    canonical, automorphisms = form(matrix(graph))
    assert len(automorphisms) == size
    shuffled = nx.relabel_nodes(graph, dict(zip(graph, np.random.default_rng(1).permutation(len(graph)), strict=True)))
    assert np.array_equal(form(nx.to_numpy_array(shuffled, range(len(graph)), dtype=np.uint8))[0], canonical)


def test_forms_part_graphs_that_refinement_cannot():
    rook = nx.line_graph(nx.complete_bipartite_graph(4, 4))
    shrikhande = nx.Graph(
        ((i, j), ((i + a) % 4, (j + b) % 4)) for i in range(4) for j in range(4) for a, b in ((0, 1), (1, 0), (1, 1))
    )
    one, two = form(matrix(rook)), form(matrix(shrikhande))
    assert not np.array_equal(one[0], two[0])
    assert len(one[1]), len(two[1]) == (1152, 192)
