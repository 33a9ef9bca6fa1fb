"""An SCD graph reduced is an SCD graph, with the chains of its SC graph's reduction."""

import random
from collections import Counter

import pytest
from commands import run
from seeded import seed_file
from sizes import slow
from strategies import random_scd

from graphs.edit.edits import ride_along
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.identity.chains import class_code
from graphs.identity.drawings import map_id
from graphs.mechanism.scd import SCDGraph
from graphs.reduce import reduce


def _with_addenda(seed: int) -> SCDGraph:
    """Return a random SCD graph with ride-alongs on it and on each other."""
    rng = random.Random(seed)
    scd = random_scd(rng, refused=Counter(), most=7)
    for _ in range(rng.randint(1, 6) if scd.joints else 0):
        try:
            scd = ride_along(scd, rng.choice(list(scd.joints)), (rng.randint(3, 5), rng.randint(3, 5))).graph
        except (UnsolvableError, InvariantError):
            continue  # no room there
    return scd


@pytest.mark.parametrize("number", [40, slow(400)])
def test_reductions_of_scd_graphs_are_those_of_their_sc_graphs(number):
    stepped = 0
    for seed in range(number):
        scd = _with_addenda(seed)
        for fully in (False, True):
            bare, drawn = reduce(scd.sc_graph(), fully=fully), reduce(scd, fully=fully)
            assert isinstance(drawn.graph, SCDGraph)
            assert drawn.steps == bare.steps
            assert [set(chain.edges) for chain in drawn.chains()] == [set(chain.edges) for chain in bare.chains()]
            assert class_code(drawn.graph) == class_code(bare.graph)
            for steps in range(len(drawn.steps)):
                assert isinstance(drawn.undo(steps), SCDGraph)
            assert drawn.undo().is_identical(scd)
            stepped += bool(drawn.steps)
    assert stepped > number // 2


def test_links_that_go_leave_open_edges(tmp_path):
    out = tmp_path / "reduced.json"
    run("reduce", seed_file("fortune-scd"), "-o", out)
    left = read(out)
    assert isinstance(left, SCDGraph)
    assert (len(left), left.counts.open_edges, len(left.centred_loops)) == (8, 8, 1)
    assert map_id(left) == map_id(reduce(read(seed_file("fortune-scd"))).graph)
    assert left.rotation["t0"] == (0, None, 2)
