"""Contracted graphs that come from one parent each, against those that are looked up among all."""

from collections import defaultdict

import numpy as np
import pytest

from enumerate.contracted.graphs import contracted_graphs, cubic_graphs, descendants
from graphs.errors import InvariantError


def gathered(batches):
    """Codes by numbers of links, each as often as it came."""
    found = defaultdict(list)
    for n, codes in batches:
        found[n] += [code.tobytes() for code in codes]
    return {n: sorted(codes) for n, codes in found.items()}


LOOPS = [2, 3, 4, 5, 6, pytest.param(7, marks=pytest.mark.slow), pytest.param(8, marks=pytest.mark.slow)]


@pytest.mark.parametrize("loops", LOOPS)
def test_every_graph_once(loops):
    cubic, links = cubic_graphs(loops), 2 * (loops - 1)
    streamed = (batch for i in range(0, len(cubic), 32) for batch in descendants(cubic[i : i + 32], links))
    assert gathered(streamed) == gathered(contracted_graphs(loops))


def test_graphs_come_from_one_ancestor():
    """However the cubic graphs are dealt out, what comes of them is told apart."""
    cubic = cubic_graphs(6)
    dealt = np.random.default_rng(1).permutation(len(cubic))
    apart = [batch for i in dealt for batch in descendants(cubic[i : i + 1], 10)]
    assert gathered(apart) == gathered(contracted_graphs(6))


@pytest.mark.parametrize("loops", [1, 12])
def test_numbers_of_loops_out_of_range(loops):
    with pytest.raises(InvariantError, match="2 to 11"):
        cubic_graphs(loops)
