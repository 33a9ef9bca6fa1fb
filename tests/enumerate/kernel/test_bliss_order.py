import networkx as nx
import numpy as np
import pytest
from hypothesis import given, strategies as st

from enumerate.chains.jobs import chain_rows
from enumerate.kernel.bliss_order import MOST_NODES, bliss_orders
from graphs.identity.chains import automorphisms_of, canonical_numbers, chain_from_id


def form(joints, order):
    return sorted(tuple(sorted((int(order[a]), int(order[b])))) for a, b in joints)


def compared(n, joints, automorphisms):
    """Compare with bliss the graphs that are not left to it; return how many are left."""
    orders, left = bliss_orders(n, np.array(joints, np.int64), np.array(automorphisms, np.int64))
    for i in set(range(len(joints))) - set(left.tolist()):
        assert sorted(orders[i].tolist()) == list(range(n))
        assert form(joints[i], orders[i]) == form(joints[i], canonical_numbers(n, joints[i])), joints[i]
    return len(left)


def renamed_chains(links, dof, seed=1):
    """Return joints, with links named by chance, and numbers of automorphisms of all chains."""
    random = np.random.default_rng(seed)
    rows = list(chain_rows(links, dof))
    names = [random.permutation(links) for _ in rows]
    joints = [
        name[np.array(chain_from_id(row["code"]).edges())].tolist() for name, row in zip(names, rows, strict=True)
    ]
    return joints, [row["symmetry"] for row in rows]


@pytest.mark.parametrize(
    ("links", "dof"), [(8, 1), (10, 1), (11, 2), (10, 3), pytest.param(12, 1, marks=pytest.mark.slow)]
)
def test_numbers_of_chains_are_those_of_bliss(links, dof):
    joints, automorphisms = renamed_chains(links, dof)
    left = compared(links, joints, automorphisms)
    assert left <= 1 + len(joints) / 500


def test_without_numbers_of_automorphisms_those_without_symmetries_are_numbered():
    joints, automorphisms = renamed_chains(10, 1)
    left = compared(10, joints, np.ones(len(joints)))
    assert sum(size > 1 for size in automorphisms) <= left < len(joints) / 1.5


@given(st.integers(2, 9), st.data())
def test_what_is_said_of_any_graph_is_what_bliss_says(n, data):
    pairs = [(a, b) for a in range(n) for b in range(a)]
    joints = data.draw(st.lists(st.sampled_from(pairs), min_size=1, unique=True))
    compared(n, [joints], [automorphisms_of(n, joints)[2]])


@pytest.mark.parametrize(
    ("graph", "answered"),
    [
        (nx.cycle_graph(MOST_NODES), True),
        (nx.complete_graph(20), True),
        (nx.petersen_graph(), True),
        (nx.hypercube_graph(4), True),
        (nx.complete_bipartite_graph(6, 6), True),
        (nx.disjoint_union(nx.cycle_graph(6), nx.star_graph(5)), True),
        (nx.frucht_graph(), False),
        (nx.disjoint_union(nx.cycle_graph(3), nx.cycle_graph(4)), False),
    ],
)
def test_graphs_with_many_symmetries_or_fewer_than_their_degrees_show(graph, answered):
    graph = nx.convert_node_labels_to_integers(graph)
    joints = list(graph.edges())
    left = compared(len(graph), [joints], [automorphisms_of(len(graph), joints)[2]])
    assert left == (not answered)


def test_a_wrong_number_of_automorphisms_gives_no_numbers():
    joints = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]]
    for size in (1, 2, 3, 5, 8):
        assert compared(4, [joints], [size]) == 1
    assert compared(4, [joints], [4]) == 0
