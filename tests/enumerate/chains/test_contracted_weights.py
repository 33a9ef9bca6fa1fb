"""Contracted graphs against the sums of their weights 1 / |Aut| in closed form, which looks at no graph."""

import json
from pathlib import Path

import numpy as np
import pytest
from weights_of_graphs import total_weights, weight_of

from enumerate.contracted.graphs import contracted_graphs

RECORDED = Path(__file__).parents[3] / "benchmarks" / "results" / "contracted_weights-9.json"


@pytest.mark.parametrize("loops", [2, 3, 4, 5, 6, pytest.param(8, marks=pytest.mark.slow)])
def test_all_graphs_are_there_once(loops):
    listed = dict(contracted_graphs(loops))
    assert {links: weight_of(codes, links) for links, codes in listed.items()} == total_weights(loops)


def test_a_graph_that_is_missing_or_there_twice_changes_the_sum():
    closed = total_weights(4)
    for links, codes in contracted_graphs(4):
        for row in range(len(codes)):
            assert weight_of(np.delete(codes, row, axis=0), links) != closed[links]
            assert weight_of(np.concatenate([codes, codes[row : row + 1]]), links) != closed[links]


@pytest.mark.slow
def test_what_is_recorded_of_nine_loops_agrees():
    recorded, closed = json.loads(RECORDED.read_text(encoding="utf-8")), total_weights(9)
    assert recorded["equal"] is True
    assert {int(links): size["weight"] for links, size in recorded["by_size"].items()} == {
        links: str(weight) for links, weight in closed.items()
    }
    assert recorded["graphs"] == sum(size["graphs"] for size in recorded["by_size"].values())
