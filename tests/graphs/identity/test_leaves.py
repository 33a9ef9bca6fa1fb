"""The second road to the ids: the plain search for the greatest leaf and bliss, on the same graphs."""

import json
import random
from pathlib import Path

import networkx as nx
import pytest
from sizes import slow

import graphs.identity.chains as chains
from graphs.convert.table import to_sc
from graphs.errors import SynthedraError
from graphs.files.formats import READERS, read
from graphs.identity.chains import chain_from_id, chain_id, class_code, subdivided, symmetries_of
from graphs.identity.leaves import ColouredGraph, greatest_leaf

GOLDEN = Path(__file__).parents[2] / "enumerate" / "chains" / "chain_ids.json"


def form(graph, labels):
    colours = sorted(zip(labels, graph.colours or [0] * graph.nodes, strict=True))
    return colours, sorted(tuple(sorted((labels[a], labels[b]))) for a, b in graph.edges)


def agree(graph):
    """Compare numbers and numbers of symmetries; check the generators."""
    bliss, plain = symmetries_of(graph), greatest_leaf(graph)
    identity = range(graph.nodes)
    assert sorted(plain.labels) == list(identity)
    assert form(graph, plain.labels) == form(graph, bliss.labels), graph
    assert plain.size == pytest.approx(bliss.size)
    assert all(form(graph, generator) == form(graph, identity) for generator in plain.generators)
    return plain


def shuffled(graph, chance):
    """Return a graph with nodes and edges in another order."""
    names = dict(zip(graph, chance.sample(range(len(graph)), len(graph)), strict=True))
    edges = [(names[a], names[b]) for a, b in graph.edges()]
    return len(graph), chance.sample(edges, len(edges))


def random_graphs(number, chance):
    """Yield graphs of chance, regular ones, regular ones side by side or with binary links, and complements."""
    for _ in range(number):
        seed = chance.randrange(10**9)
        yield nx.gnp_random_graph(chance.randint(2, 12), chance.random(), seed=seed)
        cubic = [nx.random_regular_graph(chance.choice([2, 3]), chance.choice([4, 6, 8]), seed=seed) for _ in "abc"]
        yield cubic[0]
        yield nx.disjoint_union_all(cubic[: chance.randint(2, 3)])
        yield nx.complement(cubic[1])
        strings = nx.convert_node_labels_to_integers(cubic[2])
        for a, b in chance.sample(list(strings.edges()), 3):
            nx.add_path(strings, [a, len(strings), b])
            strings.remove_edge(a, b)
        yield strings


@pytest.mark.parametrize(("number", "seed"), [(25, 1), slow(1000, 2)])
def test_random_graphs_get_the_numbers_of_bliss(number, seed):
    chance = random.Random(seed)
    for graph in random_graphs(number, chance):
        nodes, edges = shuffled(graph, chance)
        agree(ColouredGraph(nodes, edges))
        agree(ColouredGraph(nodes, edges, [chance.randrange(2) for _ in range(nodes)]))
        if len(edges) < 2 * nodes:
            agree(subdivided(nodes, edges + [edge for edge in edges if chance.random() < 0.2]))


@pytest.mark.parametrize(
    "graph",
    [
        nx.frucht_graph(),
        nx.petersen_graph(),
        nx.desargues_graph(),
        nx.dodecahedral_graph(),
        nx.hypercube_graph(5),
        nx.complete_graph(14),
        nx.star_graph(20),
        nx.complete_bipartite_graph(6, 6),
        nx.balanced_tree(2, 5),
        nx.grid_2d_graph(8, 9),
        nx.circular_ladder_graph(40),
        nx.line_graph(nx.complete_graph(8)),
        nx.paley_graph(29).to_undirected(),
        nx.disjoint_union_all([nx.frucht_graph(), nx.cycle_graph(3), nx.cycle_graph(4), nx.cycle_graph(3)]),
    ],
)
def test_symmetric_graphs_get_the_numbers_of_bliss(graph):
    agree(ColouredGraph(*shuffled(graph, random.Random(3))))


def test_golden_ids_come_without_bliss(monkeypatch):
    monkeypatch.setattr(chains, "bliss_bind", None)
    chance = random.Random(4)
    ids = [code for codes in json.loads(GOLDEN.read_text()).values() for code in codes]
    assert len(ids) > 400
    for code in ids:
        nodes, edges = shuffled(chain_from_id(code), chance)
        graph = nx.empty_graph(nodes)
        graph.add_edges_from(edges)
        assert chain_id(graph) == code


def test_ids_and_codes_of_the_data_come_without_bliss(data, monkeypatch):
    """Every file of links and joints: the id, the code of its centre classes, its symmetries."""
    mechanisms = []
    for file in sorted(file for file in data.rglob("*") if file.suffix in READERS):
        try:
            mechanisms.append(to_sc(read(file)))
        except SynthedraError:
            continue
    assert len(mechanisms) > 100
    codes = [(chain_id(mechanism), class_code(mechanism)) for mechanism in mechanisms]
    monkeypatch.setattr(chains, "bliss_bind", None)
    for mechanism, code in zip(mechanisms, codes, strict=True):
        assert (chain_id(mechanism), class_code(mechanism)) == code
