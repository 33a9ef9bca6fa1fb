import random

import networkx as nx
import pytest
from hypothesis import given
from strategies import randoms

from graphs.errors import InvariantError
from graphs.loops.loop import Centre, Loop, cyclic_order, dependent_loop, split_dependent

SQUARE = {"a": (0, 1), "b": (1, 2), "c": (2, 3), "d": (3, 0), "e": (0, 2), "f": (4, 5)}


@pytest.mark.parametrize(
    ("joints", "message"),
    [
        (("a", "z"), "names 'z', which is no joint"),
        (("a", "b", "a"), "passes joint 'a' twice"),
        (("a",), "has 1 joint"),
        ((), "has 0 joint"),
        (("a", "b", "c"), "meets link 0 in 1 joint"),
        (("a", "b", "c", "d", "e"), "meets link 0 in 3 joint"),
    ],
)
def test_what_is_no_cycle_is_refused(joints, message):
    with pytest.raises(InvariantError, match="loop is a cycle") as error:
        cyclic_order(Loop(joints), SQUARE)
    assert message in str(error.value)


def test_two_cycles_are_no_loop():
    two = {0: (0, 1), 1: (1, 2), 2: (2, 0), 3: (3, 4), 4: (4, 5), 5: (5, 3)}
    with pytest.raises(InvariantError, match="falls apart: 3 of 6 joints"):
        cyclic_order(Loop(range(6)), two)


def test_parallel_joints_are_a_cycle():
    assert cyclic_order(Loop(("a", "b")), {"a": (0, 1), "b": (1, 0)}) == ("a", "b")


@given(randoms)
def test_any_order_of_a_cycle_gives_the_same_cyclic_order(rng: random.Random):
    n = rng.randint(3, 9)
    joints = {k: (k, (k + 1) % n) for k in range(n)}
    given_order = rng.sample(range(n), n)
    order = cyclic_order(Loop(given_order), joints)
    assert order[0] == given_order[0]
    assert {(b - a) % n for a, b in zip(order, order[1:], strict=False)} <= {1, n - 1}


def test_unknown_centre_is_named():
    with pytest.raises(InvariantError, match="loop 'A' has the centre 'centre of the earth'"):
        Loop((0, 1), "centre of the earth", "A")


def test_no_centre_has_no_place():
    with pytest.raises(InvariantError, match="has no centre but names one, 'O'"):
        Loop((0, 1), Centre.NONE, at="O")


@given(randoms)
def test_independence_agrees_with_the_rank_over_gf2(rng: random.Random):
    """Against plain elimination of a 0/1 matrix, on random sets of cycles of random graphs."""
    graph = nx.gnm_random_graph(7, rng.randint(7, 15), seed=rng.randint(0, 10**6))
    number = {frozenset(edge): i for i, edge in enumerate(graph.edges)}
    basis = [
        frozenset(number[frozenset(p)] for p in zip(c, [*c[1:], c[0]], strict=True)) for c in nx.cycle_basis(graph)
    ]
    if not basis:
        return
    cycles = []
    for _ in range(rng.randint(1, len(basis) + 1)):
        total: frozenset[int] = frozenset()
        for one in rng.sample(basis, rng.randint(1, len(basis))):
            total ^= one
        cycles.append(total)
    rank = _rank(cycles)
    kept, dependent = split_dependent([tuple(c) for c in cycles])
    assert len(kept) == rank
    assert sorted(kept + dependent) == list(range(len(cycles)))
    assert (dependent_loop([tuple(c) for c in cycles]) is None) == (rank == len(cycles))


def _rank(rows):
    rows, rank = [set(row) for row in rows], 0
    while rows:
        row = rows.pop()
        if row:
            rank += 1
            pivot = min(row)
            rows = [other ^ row if pivot in other else other for other in rows]
    return rank
