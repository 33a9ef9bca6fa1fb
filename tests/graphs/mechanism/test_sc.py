import pickle
import re

import networkx as nx
import pytest
from hypothesis import given
from oracle import numeric_mobility
from strategies import randoms, sc_graphs

from graphs.convert.link_joint import block_cycles, sc_from_link_joint_graph
from graphs.count.report import mobility_report
from graphs.edit.analogues import generalised_form, planar_analogue, spherical_analogue
from graphs.errors import InvariantError, UnsolvableError
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph

WATT = [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)]
WATT_LOOPS = [Loop((0, 1, 2, 3)), Loop((3, 4, 5, 6))]
OUTER = Loop((0, 1, 2, 4, 5, 6))


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        ((["A", "A"],), {}, "link 'A' occurs twice, or has no name; expected distinct names [distinct links]"),
        (([1, "1"],), {}, "link '1' occurs twice"),
        (([None],), {}, "link None occurs twice, or has no name"),
        ((2, [(0, 2)]), {}, "joint 0 ends at 2; expected a link; links count from 0 to 1 [joint ends are links]"),
        ((2, {"a": (1, 1)}), {}, "joint 'a' joins link 1 to itself; expected two links [no self-joint]"),
        ((2, {1: (0, 1), "1": (0, 1)}), {}, "joint '1' occurs twice, or has no id"),
        ((6, WATT, [Loop((0, 1, 9))]), {}, "names 9, which is no joint [loop is a cycle]"),
        ((6, WATT, [*WATT_LOOPS, OUTER]), {}, "loop '0 1 2 4 5 6' is the sum of others"),
        ((6, WATT, WATT_LOOPS), {"ground": 6}, "ground 6 is no link; expected one of the links"),
        ((6, WATT, WATT_LOOPS[:1]), {"closing": [OUTER]}, "does not depend on the loops; expected a sum"),
        ((6, WATT, WATT_LOOPS), {"closing": WATT_LOOPS[:1]}, "is among the loops already"),
        ((6, WATT, WATT_LOOPS), {"closing": [Loop(OUTER.joints, "none")]}, "has no centre; expected one"),
        ((6, WATT, WATT_LOOPS), {"closing": [OUTER, OUTER]}, "is a sum of other closing loops"),
        ((6, WATT, [Loop((0, 1, 2, 3)), Loop(OUTER.joints, "infinite")]), {}, "expected one kind of centre"),
    ],
)
def test_each_invariant_is_checked(arguments, options, message):
    with pytest.raises(InvariantError, match=re.escape(message)):
        SCGraph(*arguments, **options)


def test_networkx_accepts_it():
    sc = SCGraph(6, WATT, WATT_LOOPS)
    assert nx.is_frozen(sc)
    assert nx.is_connected(sc)
    assert nx.diameter(sc) == 3
    assert sc.to_undirected_class() is nx.MultiGraph
    assert type(sc.copy()) is nx.MultiGraph
    assert not nx.is_frozen(sc.copy())
    assert type(nx.relabel_nodes(nx.MultiGraph(sc), {0: "A"})) is nx.MultiGraph
    assert sorted(sc.subgraph([0, 1, 2]).edges(keys=True)) == [(0, 1, 0), (1, 2, 1)]
    assert type(sc.to_undirected()) is nx.MultiGraph
    assert sc.to_directed().number_of_edges() == 14
    assert len(SCGraph()) == 0


def test_it_is_frozen():
    with pytest.raises(nx.NetworkXError, match="Frozen"):
        SCGraph(6, WATT, WATT_LOOPS).add_edge(0, 4)


def test_it_survives_pickling():
    sc = SCGraph(6, WATT, WATT_LOOPS, ground=2)
    assert pickle.loads(pickle.dumps(sc)).is_identical(sc)


def test_parallel_joints_are_first_class():
    sc = SCGraph(2, {"a": (0, 1), "b": (1, 0)}, [Loop(("a", "b"))])
    assert sc.parallel_joints() == (("a", "b"),)
    assert sc.independent_loops == 1
    assert any("join the same two links" in note for note in mobility_report(sc).warnings)


@given(sc_graphs)
def test_relabelling_changes_nothing_that_counts(sc):
    there = {link: f"({i})" for i, link in enumerate(sc.nodes)}
    other = sc.relabel(there, {joint: f"j{joint}" for joint in sc.joints})
    before, after = (mobility_report(g).to_json() for g in (sc, other))
    assert len(before.pop("warnings")) == len(after.pop("warnings"))
    assert after == before
    back = other.relabel({new: old for old, new in there.items()}, {f"j{joint}": joint for joint in sc.joints})
    assert back.is_identical(sc)


@given(randoms)
def test_loops_of_a_bare_graph_are_a_basis(rng):
    graph = nx.MultiGraph(nx.gnm_random_graph(rng.randint(1, 9), rng.randint(0, 16), seed=rng.randint(0, 9**9)))
    for a, b in list(graph.edges())[: rng.randint(0, 2)]:
        graph.add_edge(a, b)
    sc = sc_from_link_joint_graph(graph)
    assert len(sc.loops) == sc.independent_loops
    blocks = block_cycles(sc.nodes, sc.joints)
    planar = nx.check_planarity(nx.Graph(graph))[0]
    assert planar == all(block.outer is not None for block in blocks)
    if planar:
        closed = sc_from_link_joint_graph(graph, closed=True)
        assert len(closed.closing) == sum(len(block.inner) > 1 for block in blocks)


def test_a_closed_surface_needs_a_sphere():
    with pytest.raises(InvariantError, match="a block of the graph is not planar"):
        sc_from_link_joint_graph(nx.complete_graph(5), closed=True)


def test_analogues_change_centres_only():
    watt = SCGraph(6, WATT, WATT_LOOPS)
    planar, spherical = planar_analogue(watt), spherical_analogue(watt)
    assert [len(g.centre_classes()) for g in (watt, planar, spherical)] == [2, 1, 1]
    assert {numeric_mobility(g) for g in (watt, planar, spherical)} == {1}
    assert generalised_form(planar).is_identical(watt)
    assert generalised_form(spherical).is_identical(watt)
    with pytest.raises(UnsolvableError, match=r"a mechanism with 1 spatial loop has no planar analogue"):
        planar_analogue(SCGraph(6, WATT, WATT_LOOPS[:1]))
