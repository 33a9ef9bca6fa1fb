"""Bowen's classes of how centres are arranged: by generated patterns, and the products of graphs that they are."""

import networkx as nx
import pytest

from graphs.convert.conversions import graph_of
from graphs.loops.loop import Loop
from graphs.mechanism.sc import ARRANGEMENTS, SCGraph, _directions, arrangement_of, centre_graph
from synth.catalogue.patterns import generate


@pytest.mark.parametrize(
    ("name", "given", "kind"),
    [
        ("miura", {"rows": 2, "columns": 2}, "single"),
        ("miura", {"rows": 2, "columns": 3}, "coupled"),
        ("miura", {"rows": 2, "columns": 5}, "linear"),
        ("square-twist", {}, "loop"),
        ("hexagon-twist", {}, "loop"),
        ("miura", {"rows": 3, "columns": 4}, "periodic"),
        ("miura", {"rows": 4, "columns": 5}, "doubly periodic"),
        ("huffman-grid", {"rows": 4, "columns": 4}, "doubly periodic"),
        ("map", {"rows": 3, "columns": 6}, "periodic"),
        ("bennett", {}, "none"),
        ("crash-lock", {}, "linear"),
        ("webbed-tray", {}, "loop"),
        ("bird-base", {}, "tree"),
        ("waterbomb", {}, "network"),
    ],
)
def test_generated_patterns(name, given, kind):
    assert arrangement_of(graph_of(generate(name, **given).mechanism)) == kind
    assert kind in ARRANGEMENTS


def test_rows_that_part_are_a_tree_and_what_shares_no_joint_is_separate():
    """A panel with a vertex at each of its corners, its creases outwards; four-bars that share a link only."""
    apart = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (4, 5), (5, 6), (6, 0)]
    two = SCGraph(7, apart, [Loop((0, 1, 2, 3)), Loop((4, 5, 6, 7))])
    assert arrangement_of(two) == "separate"
    star = SCGraph(
        8,
        {"a": (0, 1), "b": (1, 2), "c": (2, 3), "d": (3, 0), "e": (0, 4), "f": (4, 1), "g": (1, 5), "h": (5, 2),
         "i": (2, 6), "j": (6, 3)},
        [Loop("abcd"), Loop("aef"), Loop("bgh"), Loop("cij")],
    )  # fmt: skip
    assert sorted(degree for _, degree in centre_graph(star).degree) == [1, 1, 1, 3]
    assert arrangement_of(star) == "tree"


@pytest.mark.parametrize(
    ("graph", "directions"),
    [
        (nx.grid_2d_graph(3, 3), 2),
        (nx.grid_2d_graph(2, 3), 1),
        (nx.ladder_graph(7), 1),
        (nx.cartesian_product(nx.cycle_graph(5), nx.path_graph(4)), 1),
        (nx.cartesian_product(nx.complete_graph(3), nx.path_graph(3)), 1),
        (nx.cycle_graph(4), 0),
        (nx.petersen_graph(), 0),
        (nx.hexagonal_lattice_graph(2, 2), 0),
        (nx.compose(nx.grid_2d_graph(3, 3), nx.path_graph([(0, 0), "tail"])), 0),
        (nx.cubical_graph(), 0),
    ],
)
def test_repetition_is_a_product_with_a_path(graph, directions):
    for seed in range(3):
        order = list(graph)
        nx.utils.create_py_random_state(seed).shuffle(order)
        place = {node: number for number, node in enumerate(order)}
        assert _directions([{place[other] for other in graph[node]} for node in order]) == directions
