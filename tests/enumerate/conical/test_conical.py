"""Placements of joints round a circle: by generation, by Burnside's lemma, by brute force; layers."""

from __future__ import annotations

from itertools import permutations, product

import networkx as nx
import numpy as np
import pytest
from conical_rows import canonical_row
from sizes import slow

from enumerate.chains.jobs import chains
from enumerate.chains.names import chain_named
from enumerate.conical.query import ConicalQuery, conical_orders, count_conical_orders, joint_symmetries, links_apart
from enumerate.conical.rounds import (
    Rounds,
    count_rounds_by_burnside,
    count_rounds_by_orbits,
    fewest_layers,
    placements,
    prefixes,
)
from graphs.errors import InvariantError, UnsolvableError
from graphs.identity.chains import chain_from_id

COUNTS = {
    "four-bar": (2, {(2, 2): 3}),
    "five-bar": (4, {(2, 2): 8}),
    "watt": (102, {(3, 2): 192, (2, 2): 360}),
    "stephenson": (102, {(3, 3): 180, (2, 1): 192, (2, 2): 180}),
}
"""Cyclic orders, and those with a ground link: (joints of the link, links of the string it is in) to number."""


def joints_of(graph):
    return dict(enumerate(graph.edges()))


def described(graph, link):
    """Joints of a link, and how many binary links are in its string; of ternary links, how many touch one."""
    if graph.degree(link) == 3:
        return 3, sum(1 for other in graph if graph.degree(other) == 2 and graph.has_edge(link, other))
    binary = graph.subgraph(one for one in graph if graph.degree(one) == 2)
    ring = len(binary) == len(graph)
    return 2, 2 if ring else len(nx.node_connected_component(binary, link))


@pytest.mark.parametrize("method", ["orbits", "burnside"])
@pytest.mark.parametrize("name", COUNTS)
def test_cyclic_orders(name, method):
    graph = chain_from_id(chain_named(name))
    chain = tuple(joints_of(graph).items())
    free, grounded = COUNTS[name]
    assert count_conical_orders(ConicalQuery(chain), method) == free
    found = {
        described(graph, link): count_conical_orders(ConicalQuery(chain, (link,)), method)
        for link in links_apart(dict(chain))
    }
    assert found == grounded
    every = ConicalQuery(chain, tuple(links_apart(dict(chain))))
    assert count_conical_orders(every, method) == sum(grounded.values())


def test_cyclic_orders_of_the_eight_link_chains():
    """By generation and by Burnside's lemma, chain by chain."""
    found = []
    for graph in chains(8, 1):
        query = ConicalQuery(tuple(joints_of(graph).items()))
        found.append([count_conical_orders(query, method) for method in ("orbits", "burnside")])
    assert all(one == other for one, other in found)
    assert len(found) == 16
    assert sum(one for one, _ in found) == 1_118_136


def orbits_by_brute_force(graph, rounds, ground=None):
    """Number of orbits: all placements, all images, by networkx' isomorphisms and no canonical form."""
    joints = [frozenset(ends) for ends in graph.edges()]
    moves = [
        [joints.index(frozenset(turned[link] for link in ends)) for ends in joints]
        for turned in nx.isomorphism.GraphMatcher(graph, graph).isomorphisms_iter()
        if ground is None or turned[ground] == ground
    ]
    every = {
        row
        for row in permutations(range(rounds.slots), rounds.joints)
        if len({slot % rounds.classes for slot in row}) == rounds.joints
    }
    orbits = 0
    while every:
        orbits += 1
        row = every.pop()
        for move, turn, mirror in product(moves, range(rounds.slots), (1, -1)):
            every.discard(tuple((mirror * row[i] + turn) % rounds.slots for i in move))
    return orbits


@pytest.mark.parametrize(
    ("name", "rounds"),
    [
        ("four-bar", Rounds(4, 4, 4)),
        ("four-bar", Rounds(4, 2 * 4, 4)),
        ("four-bar", Rounds(4, 7, 7)),
        ("four-bar", Rounds(4, 8, 8)),
        ("five-bar", Rounds(5, 5, 5)),
        ("five-bar", Rounds(5, 2 * 5, 5)),
        ("watt", Rounds(7, 7, 7)),
        ("stephenson", Rounds(7, 7, 7)),
    ],
)
def test_orbits_by_brute_force(name, rounds):
    graph = chain_from_id(chain_named(name))
    for ground in (None, *links_apart(joints_of(graph))):
        symmetries = joint_symmetries(joints_of(graph), ground)
        wanted = orbits_by_brute_force(graph, rounds, ground)
        rows, order = placements(rounds, symmetries)
        assert (
            len(rows)
            == wanted
            == count_rounds_by_burnside(rounds, symmetries)
            == count_rounds_by_orbits(rounds, symmetries)
        )
        # orbits and stabilisers: all placements that have joint 0 on slot 0
        assert sum(2 * len(symmetries) // int(one) for one in order) == rounds.completions(1)
        for row, one in zip(rows, order.tolist(), strict=True):
            assert canonical_row(row, symmetries, rounds.slots) == tuple(row.tolist())
            images = [
                tuple(((mirror * (row[move] - row[move[0]])) % rounds.slots).tolist())
                for move in symmetries
                for mirror in (1, -1)
            ]
            assert images.count(tuple(row.tolist())) == one


@pytest.mark.parametrize("name", [slow("watt"), "stephenson"])
def test_portions_hold_every_placement_once(name):
    graph = chain_from_id(chain_named(name))
    for rounds in (Rounds(7, 7, 7), Rounds(7, 2 * 7, 7), Rounds(7, 9, 9)):
        symmetries = joint_symmetries(joints_of(graph))
        whole = placements(rounds, symmetries)[0].tolist()
        for most in (1, 30, 1000):
            parts = [
                row for prefix in prefixes(rounds, most) for row in placements(rounds, symmetries, prefix)[0].tolist()
            ]
            assert parts == whole


def test_images_come_from_one_row(rng):
    graph = chain_from_id(chain_named("stephenson"))
    symmetries = joint_symmetries(joints_of(graph))
    listed = {row for _, row in conical_orders(ConicalQuery(tuple(joints_of(graph).items())))}
    for _ in range(200):
        row = rng.permutation(7)
        assert canonical_row(row, symmetries, 7) in listed
        moved = (row[symmetries[rng.integers(4)]] * rng.choice([1, -1]) + rng.integers(7)) % 7
        assert canonical_row(moved, symmetries, 7) == canonical_row(row, symmetries, 7)


def test_twelve_slots():
    """Numbers by both methods, and by orbits of the whole group at another number of slots."""
    graph = chain_from_id(chain_named("watt"))
    chain = tuple(joints_of(graph).items())
    grounds = tuple(links_apart(dict(chain)))
    found = [count_conical_orders(ConicalQuery(chain, grounds, 12), method) for method in ("orbits", "burnside")]
    assert found == [249_600, 249_600]


def test_parallel_joints_may_change_places():
    joints = {"a": (0, 1), "b": (0, 1), "c": (1, 2), "d": (2, 0)}
    assert len(joint_symmetries(joints)) == 4
    assert count_conical_orders(ConicalQuery(tuple(joints.items()))) == 2


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda chain: ConicalQuery(chain, slots=3), "3 slots for 4 joints"),
        (lambda chain: ConicalQuery(chain[:2]), "2 joints"),
        (lambda chain: ConicalQuery(chain, slots=9, opposites=True), "slots and opposites"),
        (lambda chain: count_conical_orders(ConicalQuery(chain, ("x",))), "the ground link 'x'"),
    ],
)
def test_queries_that_make_no_sense(make, message):
    with pytest.raises(InvariantError, match=message):
        make(tuple(joints_of(nx.cycle_graph(4)).items()))


def test_too_many_to_list():
    query = ConicalQuery(tuple(joints_of(nx.cycle_graph(20)).items()))
    with pytest.raises(UnsolvableError, match="can only be counted"):
        count_conical_orders(query, "orbits")
    assert count_conical_orders(query) > 10**15 // 40


def test_too_many_symmetries():
    with pytest.raises(UnsolvableError, match="symmetries"):
        joint_symmetries(dict.fromkeys(range(12), (0, 1)))


def layers_by_brute_force(options):
    """Fewest layers: all choices of arcs, all assignments; layers have no names, so the first link's is 0."""
    links = len(options)
    best = links
    for arcs in product(*[[mask for mask in one if mask] for one in options]):
        for layers in product([0], *[range(links)] * (links - 1)):
            fits = all(layers[i] != layers[j] or not arcs[i] & arcs[j] for i in range(links) for j in range(i))
            if fits:
                best = min(best, len(set(layers)))
    return best


@pytest.mark.parametrize("number", [15, slow(60)])
def test_layers(number, rng):
    for links, choices in ((4, 2), (5, 1), (4, 3), (5, 2)):
        options = rng.integers(1, 2**6, (number, links, choices))
        options[..., 1:] *= rng.integers(0, 2, (number, links, choices - 1))
        assert fewest_layers(options).tolist() == [layers_by_brute_force(one.tolist()) for one in options]
    assert fewest_layers(np.zeros((0, 4, 1), np.int64)).tolist() == []
