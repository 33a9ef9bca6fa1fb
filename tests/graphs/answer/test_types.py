"""Lists of mechanisms grouped by type: against networkx, and by ids of the enumerators."""

import json
import random
from itertools import islice
from pathlib import Path

import networkx as nx
import pytest
from commands import run
from sizes import slow

from graphs.answer.identity import types_of
from graphs.errors import FileError
from synth import chains, scd_graphs


def shuffled(graph, dice):
    """The same graph with other names, nodes and edges in another order."""
    names = list(graph)
    dice.shuffle(names)
    renamed = nx.relabel_nodes(graph, dict(zip(graph, names, strict=True)))
    edges = list(renamed.edges(keys=True) if renamed.is_multigraph() else renamed.edges)
    dice.shuffle(edges)
    made = type(graph)() if not renamed.is_multigraph() else nx.MultiGraph()
    nodes = list(renamed)
    dice.shuffle(nodes)
    made.add_nodes_from(nodes)
    made.add_edges_from(edge[:2] for edge in edges)
    return made


@pytest.mark.parametrize("many", [120, slow(1000)])
def test_shuffled_graphs_are_grouped_as_networkx_does(many):
    dice = random.Random(5)
    listed = [nx.Graph(chain) for chain in chains(8, 1)]
    graphs = [shuffled(dice.choice(listed), dice) for _ in range(many // 2)]
    graphs += [nx.gnm_random_graph(7, 9, seed=dice.randrange(40)) for _ in range(many // 4)]
    graphs += [nx.MultiGraph(nx.gnm_random_graph(5, 6, seed=dice.randrange(9)).edges) for _ in range(many // 4)]
    for graph in graphs[-many // 4 :]:
        graph.add_edge(*next(iter(graph.edges())))
    dice.shuffle(graphs)
    found = types_of(graphs)
    assert (found.by, found.without) == ("chain", {})
    places = {member: code for code, members in found.classes.items() for member in members}
    assert len(places) == len(graphs)
    first: dict[str, nx.Graph] = {}
    for place, graph in enumerate(graphs, 1):
        same = first.setdefault(places[str(place)], graph)
        assert nx.is_isomorphic(nx.MultiGraph(same), nx.MultiGraph(graph), edge_match=lambda a, b: len(a) == len(b))
    ones = [nx.MultiGraph(graph) for graph in first.values()]
    assert not any(
        nx.is_isomorphic(one, other, edge_match=lambda a, b: len(a) == len(b))
        for place, one in enumerate(ones)
        for other in ones[:place]
    )
    assert found.repeated == len(graphs) - len(ones)


@pytest.mark.slow
def test_the_command_groups_a_thousand_shuffled_files(tmp_path):
    """Files of three formats, of chains of six, eight and ten links under other names: the classes are the chains."""
    dice = random.Random(7)
    kinds = [nx.Graph(chain) for links in (6, 8) for chain in chains(links, 1)]
    kinds += [nx.Graph(chain) for chain in islice(chains(10, 1), 0, 230, 3)]
    members: dict[int, set[str]] = {}
    for number in range(1000):
        kind = dice.randrange(len(kinds))
        graph = shuffled(kinds[kind], dice)
        path = tmp_path / f"{number}{('.gml', '.edgelist', '.g6')[number % 3]}"
        if path.suffix == ".gml":
            nx.write_gml(graph, path)
        elif path.suffix == ".edgelist":
            nx.write_edgelist(graph, path, data=False)
        else:
            nx.write_graph6(graph, path, header=False)
        members.setdefault(kind, set()).add(path.name)
    answer = json.loads(run("id", *sorted(tmp_path.iterdir()), "--group", "--by", "chain", "--json").output)
    found = {frozenset(Path(member).name for member in one["members"]) for one in answer["classes"]}
    assert found == set(map(frozenset, members.values()))


def test_drawings_are_told_apart_where_their_chains_are_not():
    drawings = list(scd_graphs(6, 1, 4))
    by_drawing, by_chain = types_of(drawings), types_of(drawings, by="chain")
    assert (by_drawing.by, len(by_drawing.classes)) == ("drawing", len(drawings))
    assert len(by_chain.classes) < len(drawings)


def test_files_of_many_and_their_duplicates(tmp_path):
    several = tmp_path / "several.g6"
    several.write_text("Cl\nCr\nEFz_\n")
    result = run("id", several, "k1:Cr", "--group")
    assert "4 mechanisms, 2 types by chain" in result.output
    assert f"{several}:1, {several}:2, k1:Cr" in result.output
    with pytest.raises(FileError, match="no such file"):
        types_of(["missing.g6"])
    assert "--by requires --group" in run("id", "k1:Cr", "--by", "chain", code=2).output
    none = types_of(["k1:Cr"], by="drawing")
    assert none.without == {"k1:Cr": "a link-joint graph has no drawing and no centres"}
