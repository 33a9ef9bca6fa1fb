"""The search for the greatest leaf: forms of relabelled copies, groups, and graphs that look alike to refinement."""

import math
import random
import re
from pathlib import Path
from time import process_time

import networkx as nx
import pytest
from sizes import slow
from symmetric_graphs import (
    cai_furer_immerman,
    cyclic_square,
    different_cubic_graphs,
    integers,
    klein_square,
    net_of,
    plane_of,
    rook,
    shrikhande,
    side_by_side,
    switched_square,
)

import graphs.identity.leaves as leaves
from graphs.identity.chains import subdivided
from graphs.identity.leaves import ColouredGraph, greatest_leaf
from graphs.identity.numbering import SOURCE, by_library, labels_by_bliss

SEARCHES = [greatest_leaf, by_library]


def form(graph, labels):
    colours = sorted(zip(labels, graph.colours or [0] * graph.nodes, strict=True))
    return colours, sorted(tuple(sorted((labels[a], labels[b]))) for a, b in graph.edges)


def shuffled(graph, chance, colours=()):
    """A coloured graph with nodes and edges in another order."""
    names = dict(zip(graph, chance.sample(range(len(graph)), len(graph)), strict=True))
    edges = [(names[a], names[b]) for a, b in graph.edges()]
    back = {new: old for old, new in names.items()}
    renamed = [colours[back[new]] for new in range(len(graph))] if colours else ()
    return ColouredGraph(len(graph), chance.sample(edges, len(edges)), renamed)


def agree(graph, bliss=True):
    """Compare the library with Python, number for number, and with the form of bliss; check the generators."""
    plain = greatest_leaf(graph)
    identity = form(graph, range(graph.nodes))
    assert sorted(plain.labels) == list(range(graph.nodes))
    assert all(form(graph, generator) == identity for generator in plain.generators)
    assert by_library(graph) in (plain, None)
    labels = labels_by_bliss(graph) if bliss else None
    assert labels is None or form(graph, labels) == form(graph, plain.labels), graph
    return plain


def random_graphs(number, chance):
    """Yield graphs of chance, trees, regular ones, regular ones side by side or with binary links, complements."""
    for _ in range(number):
        seed = chance.randrange(10**9)
        yield nx.gnp_random_graph(chance.randint(2, 12), chance.random(), seed=seed)
        yield nx.random_labeled_tree(chance.randint(2, 30), seed=seed)
        cubic = [nx.random_regular_graph(chance.choice([2, 3]), chance.choice([4, 6, 8]), seed=seed) for _ in "abc"]
        yield cubic[0]
        yield side_by_side(cubic[: chance.randint(2, 3)])
        yield nx.complement(cubic[1])
        yield nx.random_regular_graph(chance.choice([3, 4]), chance.choice([14, 20, 26]), seed=seed)
        strings = integers(cubic[2])
        for a, b in chance.sample(list(strings.edges()), 3):
            nx.add_path(strings, [a, len(strings), b])
            strings.remove_edge(a, b)
        yield strings


@pytest.mark.parametrize(("number", "seed"), [(20, 1), slow(1000, 2)])
def test_random_graphs_get_the_same_numbers_on_all_roads(number, seed):
    chance = random.Random(seed)
    for graph in random_graphs(number, chance):
        one, other = shuffled(graph, chance), shuffled(graph, chance)
        assert form(one, agree(one).labels) == form(other, agree(other).labels)
        agree(one._replace(colours=[chance.randrange(-9, 9) for _ in graph]), bliss=False)  # bliss takes none below 0
        agree(one._replace(colours=[chance.randrange(2) for _ in graph]))
        if len(one.edges) < 2 * len(graph):
            agree(subdivided(len(graph), one.edges + [edge for edge in one.edges if chance.random() < 0.2]))


FAMILIES = {
    "Frucht": (nx.frucht_graph(), 1),
    "Petersen": (nx.petersen_graph(), 120),
    "Desargues": (nx.desargues_graph(), 240),
    "dodecahedron": (nx.dodecahedral_graph(), 120),
    "cube of 5": (nx.hypercube_graph(5), 3840),
    "complete": (nx.complete_graph(14), math.factorial(14)),
    "empty": (nx.empty_graph(9), math.factorial(9)),
    "star": (nx.star_graph(20), math.factorial(20)),
    "bipartite": (nx.complete_bipartite_graph(6, 6), 2 * math.factorial(6) ** 2),
    "pairs": (side_by_side([nx.path_graph(2)] * 8), 2**8 * math.factorial(8)),
    "binary tree": (nx.balanced_tree(2, 5), 2**31),
    "grid": (nx.grid_2d_graph(8, 9), 4),
    "torus": (nx.grid_2d_graph(6, 6, periodic=True), 288),
    "ladder": (nx.circular_ladder_graph(40), 160),
    "triangular": (nx.line_graph(nx.complete_graph(8)), math.factorial(8)),
    "Paley": (nx.paley_graph(29).to_undirected(), 29 * 14),
    "rook of 4": (rook(4), 1152),
    "rook of 6": (rook(6), 2 * math.factorial(6) ** 2),
    "Shrikhande": (shrikhande(), 192),
    "net of the cyclic group of 4": (net_of(cyclic_square(4)), 192),
    "net of Klein's group": (net_of(klein_square()), 1152),
    "plane of order 3": (plane_of(3), 2 * 5616),
    "straight": (cai_furer_immerman(nx.complete_graph(4), False), 192),
    "twisted": (cai_furer_immerman(nx.complete_graph(4), True), 192),
    "rings": (side_by_side([nx.frucht_graph(), nx.cycle_graph(3), nx.cycle_graph(4), nx.cycle_graph(3)]), 576),
}


@pytest.mark.parametrize(("graph", "size"), FAMILIES.values(), ids=FAMILIES)
def test_symmetric_graphs(graph, size):
    chance = random.Random(3)
    one, other = shuffled(graph, chance), shuffled(graph, chance)
    plain = agree(one)
    assert plain.size == pytest.approx(size, rel=1e-14)
    assert form(one, plain.labels) == form(other, agree(other).labels)


def test_graphs_that_refinement_cannot_tell_apart_get_different_forms():
    """Pairs that are known not to be isomorphic."""
    chance = random.Random(5)
    for graphs in (
        (rook(4), shrikhande()),
        (net_of(cyclic_square(4)), net_of(klein_square())),
        tuple(cai_furer_immerman(nx.complete_graph(4), twist) for twist in (False, True)),
        tuple(cai_furer_immerman(nx.petersen_graph(), twist) for twist in (False, True)),
    ):
        one, other = (shuffled(graph, chance) for graph in graphs)
        assert form(one, agree(one).labels) != form(other, agree(other).labels)


def test_nets_of_latin_squares_keep_their_forms():
    chance = random.Random(11)
    for size in (5, 6, 7):
        net = net_of(switched_square(size, chance))
        one, other = shuffled(net, chance), shuffled(net, chance)
        assert form(one, agree(one).labels) == form(other, agree(other).labels)


@pytest.mark.parametrize(("number", "seed"), [(12, 6), slow(300, 7)])
def test_groups_are_as_large_as_by_networkx(number, seed):
    chance = random.Random(seed)
    for _ in range(number):
        graph = nx.gnp_random_graph(chance.randint(1, 7), chance.random(), seed=chance.randrange(10**9))
        colours = [chance.randrange(2) for _ in graph]
        nx.set_node_attributes(graph, dict(enumerate(colours)), "colour")
        same = nx.isomorphism.categorical_node_match("colour", None)
        counted = sum(1 for _ in nx.isomorphism.GraphMatcher(graph, graph, same).isomorphisms_iter())
        assert agree(shuffled(graph, chance, colours)).size == counted


def test_groups_are_as_large_as_by_nauty():
    pynauty = pytest.importorskip("pynauty")
    for graph in map(integers, random_graphs(30, random.Random(8))):
        adjacency = {v: list(graph[v]) for v in graph}
        _, mantissa, exponent, *_ = pynauty.autgrp(pynauty.Graph(len(graph), adjacency_dict=adjacency))
        size = greatest_leaf(ColouredGraph(len(graph), list(graph.edges()))).size
        assert size == pytest.approx(mantissa * 10**exponent, rel=1e-9)


@pytest.mark.parametrize("search", SEARCHES)
def test_cubic_graphs_of_300_vertices_and_their_copies(search):
    chance = random.Random(9)
    graph = nx.random_regular_graph(3, 300, seed=1)
    copies = [shuffled(graph, chance) for _ in range(2)]
    began = process_time()
    found = [search(copy) for copy in copies]
    assert process_time() - began < 2.0  # 0.12 s in Python, 1 ms in C
    if None not in found:
        one, other = (form(copy, each.labels) for copy, each in zip(copies, found, strict=True))
        assert one == other


def test_different_graphs_side_by_side_are_searched_one_by_one():
    """No vertex of one cell can be told from another; without a look at all of them this takes for ever."""
    chance = random.Random(10)
    graph = different_cubic_graphs(8, 16)
    one, other = shuffled(graph, chance), shuffled(graph, chance)
    assert form(one, agree(one, bliss=False).labels) == form(other, agree(other, bliss=False).labels)


@pytest.mark.parametrize("search", SEARCHES)
@pytest.mark.parametrize("graph", [nx.empty_graph(600), nx.star_graph(600), nx.path_graph(1500), nx.empty_graph(0)])
def test_deep_searches_need_no_deep_calls(search, graph):
    found = search(ColouredGraph(len(graph), list(graph.edges())))
    assert found is None or sorted(found.labels) == sorted(graph)


def test_the_library_looks_on_as_far_as_python():
    text = SOURCE.read_text(encoding="utf-8")
    assert int(re.search(r"LOOKED_AT = (\d+)", text).group(1)) == leaves._LOOKED_AT
    assert Path(leaves.__file__).parent == SOURCE.parent
