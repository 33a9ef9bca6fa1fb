"""Small parts of the room, each by an example."""

from math import pi

import networkx as nx

from graphs.files.formats import mechanism_of_id
from synth.linkages.conformed.orders import order_of_row
from synth.making.drawing.layout.embedding import faces_of, made_biconnected, mirrored, same_cycle, swaps_of
from synth.making.drawing.list_pages import is_catalogue
from synth.making.drawing.scene.frame import framed, round_steps
from synth.making.drawing.space.panels import same_side_up


def test_example_of_order_of_row():
    row = {"order": ["0", "1'", "3", "2"], "slots": [0, 5, 3, 2], "loops": [["0", "1", "3", "2"]]}
    order = order_of_row(row, mechanism_of_id("k1:Cr"))
    assert (order.names, [round(azimuth / pi, 3) for azimuth in order.azimuths], order.pairs) == (
        ["0", "1", "2", "3"],
        [0.0, 1.25, 0.75, 0.5],
        [(0, 1), (0, 2), (1, 3), (2, 3)],
    )


def test_example_of_is_catalogue():
    assert (is_catalogue("chains.sqlite"), is_catalogue("watt.json")) == (True, False)


def test_example_of_faces_of():
    assert faces_of({0: (1, 2), 1: (2, 0), 2: (0, 1)}) == [(0, 1, 2), (0, 2, 1)]


def test_example_of_made_biconnected():
    path = {0: (1,), 1: (0, 2), 2: (1,)}
    assert made_biconnected(path)[("fill", 0)] == (0, 2)


def test_example_of_same_cycle():
    assert (same_cycle((0, 1, 2, 3), (2, 3, 0, 1)), same_cycle((0, 1, 2, 3), (2, 1, 0, 3))) == (True, False)


def test_example_of_swaps_of():
    assert len(list(swaps_of([0, 1, 2, 3], {0: (0, 1), 1: (1, 2), 2: (2, 3), 3: (3, 0)}))) == 5


def test_example_of_mirrored():
    square = nx.cycle_graph(4)
    assert (mirrored(square, {0: 0, 1: 3, 2: 2, 3: 1}) is None, mirrored(square, {0: 2, 1: 3, 2: 0, 3: 1}) is None) == (
        False,
        True,
    )


def test_example_of_framed():
    assert framed([(0, 0), (2, 1)], 30, margin=10).at((0, 1)) == (10, 10)


def test_example_of_round_steps():
    assert (round_steps(0, 30.2), round_steps(2.51, 3.74)) == (
        [0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0],
        [2.6, 2.8, 3.0, 3.2, 3.4, 3.6],
    )


def test_example_of_same_side_up():
    assert same_side_up([(0, 1, 2), (0, 1, 3)]) == [(0, 1, 2), (3, 1, 0)]
