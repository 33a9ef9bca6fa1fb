import numpy as np
import pytest
from sizes import slow

from enumerate.kernel.centres import FINITE, OUTER
from enumerate.runner._run import rows_of
from enumerate.sc.jobs import sc_graphs
from enumerate.scd.fewest import fewest_open_edges
from enumerate.scd.jobs import SCDJob, mechanism_of, scd_graphs, simplest_scd_graph
from enumerate.scd.patterns import number_of_placements
from graphs.errors import UnsolvableError
from graphs.identity.drawings import map_id
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph


def first_of_all(mechanism, most):
    """The first row with the fewest open edges of the list of all placements."""
    return min(rows_of(SCDJob(mechanism_of(mechanism, most))), key=lambda row: row["open_edges"], default=None)


@pytest.mark.parametrize(
    ("links", "dof", "most", "options"),
    [
        (4, 1, (3, 4, 5, 6), {}),
        (6, 1, (3, 4, 5), {}),
        slow(8, 1, (3, 4, 5), {}),
        (7, 2, (3, 4), {}),
        (6, 1, (4, 5), {"infinite": True}),
        (9, 1, (3,), {"spatial": 1}),
    ],
    ids=str,
)
def test_the_first_of_all_placements(links, dof, most, options):
    found = 0
    for mechanism in sc_graphs(links, dof, **options):
        for sides in most:
            if sides < max(dict(mechanism.degree).values()):
                continue
            expected, scd = first_of_all(mechanism, sides), simplest_scd_graph(mechanism, sides)
            assert (expected is None) == (scd is None)
            if scd is not None:
                assert {name: scd.graph[name] for name in expected} == expected
                assert map_id(scd) == expected["code"]
                found += 1
    assert found


def test_of_open_chains():
    for tree in scd_graphs(5, 4, 3):
        for most in (4, 5):
            assert simplest_scd_graph(tree, most).graph["code"] == first_of_all(tree, most)["code"]


def test_a_mechanism_of_many_placements():
    """One of more than 10^15 is made."""
    ring = SCGraph(12, [(i, (i + 1) % 12) for i in range(12)], [Loop(range(12))])
    code, labels = next(mechanism_of(ring, 9).source.each())
    assert number_of_placements(code, labels, 9) > 10**15
    assert simplest_scd_graph(ring, 9).graph["open_edges"] == 12


def test_spatial_rings_and_their_limit():
    for links in (7, 9):
        ring = SCGraph(links, [(i, (i + 1) % links) for i in range(links)], [Loop(range(links), Centre.NONE)])
        scd = simplest_scd_graph(ring, 3)
        assert scd.counts.open_edges == links
    wide = SCGraph(12, [(i, (i + 1) % 12) for i in range(12)], [Loop(range(12), Centre.NONE)])
    with pytest.raises(UnsolvableError, match="24 corners"):
        simplest_scd_graph(wide, 3)


def test_none_has_the_rank():
    code, labels = next(mechanism_of(next(sc_graphs(4, 1)), 4).source.each())
    assert labels.tolist() == [OUTER, FINITE]
    assert [len(part) for part in fewest_open_edges(code, labels, 4, 2)] == [0, 0, 0]
    codes, lengths, facts = fewest_open_edges(code, labels, 4, 1)
    assert codes.dtype == np.uint8
    assert len(codes) == len(lengths) == len(facts) == 1
