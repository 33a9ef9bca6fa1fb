import random
from pathlib import Path

import networkx as nx
import pytest
from hypothesis import given
from oracle import numeric_mobility
from random_addenda import random_addenda, relabelled
from sizes import slow
from strategies import randoms, scd_graphs

from graphs.convert.panels import scd_from_panels
from graphs.count.report import mobility_report
from graphs.edit.edits import add_ride_along
from graphs.errors import InvariantError
from graphs.files.formats import read
from graphs.identity.chains import class_code
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.reduce.ride_alongs import reduce
from graphs.reduce.working_graph import RULES

DATA = Path(__file__).resolve().parents[3] / "data"


def mobility(sc):
    return mobility_report(sc).mobility


def strip(rows, columns=2):
    """A mesh of quadrilaterals."""
    wide = columns + 1
    return scd_from_panels(
        [
            (i * wide + j, i * wide + j + 1, (i + 1) * wide + j + 1, (i + 1) * wide + j)
            for i in range(rows)
            for j in range(columns)
        ]
    ).sc_graph()


def check_one(rng: random.Random, *, fully: bool) -> int:
    """Confluence, count, protection and undo on one random mechanism; return how many steps were taken."""
    sc = random_addenda(rng)
    keep = rng.sample(list(sc.nodes), rng.randint(0, 2))
    kept = {link: f"keep {i}" for i, link in enumerate(keep)}
    sc = sc.relabel(kept)
    there = relabelled(sc, rng) if not keep else sc
    one = reduce(sc, fully=fully, keep=kept.values())
    assert mobility(one.graph) == mobility(sc)
    assert set(kept.values()) <= set(one.graph.nodes)
    assert sc.ground is None or one.graph.ground == sc.ground
    assert one.undo().is_identical(sc)
    assert len(one.steps) * 2 == len(sc) - len(one.graph)
    if not keep:
        two = reduce(there, fully=fully)
        assert class_code(one.graph) == class_code(two.graph)
    return len(one.steps)


@pytest.mark.parametrize("number", [250, slow(1000)])
def test_confluence_count_protection_and_undo(number):
    rng = random.Random(2016)
    steps = sum(check_one(rng, fully=bool(i % 2)) for i in range(number))
    assert steps > 2 * number


@pytest.mark.slow
def test_confluence_on_ten_thousand_mechanisms():
    rng = random.Random(7)
    steps = sum(check_one(rng, fully=bool(i % 2)) for i in range(10_000))
    assert steps > 20_000


@pytest.mark.parametrize("number", [40, slow(150)])
def test_reduction_keeps_the_rank(number):
    """The numerical rank, not only the count, on mechanisms whose collinear centres can be placed in turn."""
    rng = random.Random(11)
    ranked = 0
    for i in range(number):
        sc = random_addenda(rng, size=7)
        before = numeric_mobility(sc)
        if before is None:
            continue
        ranked += 1
        assert numeric_mobility(reduce(sc, fully=bool(i % 2)).graph) == before
    assert ranked > 2 * number // 3


def test_undo_goes_step_by_step():
    reduction = reduce(strip(6))
    for number in range(len(reduction.steps) + 1):
        back = reduction.undo(number)
        assert len(back) == len(reduction.graph) + 2 * number
        assert mobility(back) == 1
        assert len(reduce(back).steps) == number
    assert reduction.undo().is_identical(strip(6))
    with pytest.raises(ValueError, match="cannot undo 9 of"):
        reduction.undo(9)


def test_a_strip_is_one_chain():
    reduction = reduce(strip(8))
    assert [step.sits_on for step in reduction.steps] == [*range(1, len(reduction.steps)), None]
    (chain,) = reduction.chains()
    assert nx.is_arborescence(chain)
    assert nx.dag_longest_path_length(chain) == len(reduction.steps) - 1


def test_an_addendum_is_printed_in_the_order_of_its_steps():
    sc = SCGraph(4, [(i, (i + 1) % 4) for i in range(4)], [Loop(range(4))])
    for a, b in ((0, 1), (4, 5), (0, 4), (6, 7), (6, 4)):
        sc = add_ride_along(sc, a, b).graph
    assert str(reduce(sc, keep=range(4))).splitlines()[2:] == [
        "5 steps in 1 adjunct addendum",
        "step 1: links 8, 9 on 0, 4 (sits on step 5)",
        "step 2: links 10, 11 on 6, 7 (sits on step 4)",
        "step 3: links 12, 13 on 6, 4 (sits on step 4)",
        "step 4: links 6, 7 on 4, 5 (sits on step 5)",
        "step 5: links 4, 5 on 0, 1",
        "left: one spherical loop of 4 links, k1:Cr",
    ]


def test_what_is_left_is_said_with_its_loops(data):
    files = [data / "wiener" / f"{name}.json" for name in ("fortune-teller", "watt-planar")]
    lines = [str(reduce(file)).splitlines()[-1] for file in files]
    assert lines == ["left: one spherical loop of 8 links, k1:GqGOOK", "left: one planar loop of 4 links, k1:Cr"]


def test_blocks_keep_a_loop_unless_fully():
    four_bar = strip(2)
    assert not reduce(four_bar).steps
    whole = reduce(four_bar, fully=True)
    assert (len(whole.graph), len(whole.graph.joints), mobility(whole.graph)) == (2, 1, 1)
    assert whole.undo().is_identical(four_bar)


def test_ground_and_kept_links_stay():
    sc = strip(4)
    grounded = SCGraph(sc.nodes, sc.joints, sc.loops, ground=0)
    assert 0 in reduce(grounded).graph
    assert not reduce(sc, keep=[0, 7]).steps
    with pytest.raises(InvariantError, match="99 is to be kept and is no link"):
        reduce(sc, keep=[99])
    with pytest.raises(ValueError, match="the rule 'assur'; expected one of ride-along, dyad"):
        reduce(sc, rule="assur")


def test_a_four_bar_of_two_centres_is_no_ride_along():
    """The cycle a-u-v-b must have a centre: a spatial one stays."""
    sc = strip(3).with_loops([Loop(loop.joints, "none" if i else "finite") for i, loop in enumerate(strip(3).loops)])
    assert len(reduce(sc).steps) == 1
    spatial = strip(3).with_loops([Loop(loop.joints, "none") for loop in strip(3).loops])
    assert not reduce(spatial).steps


def test_a_loop_not_given_but_a_sum_counts():
    """A four-bar with a ride-along, written as the four-bar and the outer six-bar of one class."""
    joints = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (4, 5), (5, 1)]
    outer = Loop((1, 2, 3, 4, 5, 6))
    sc = SCGraph(6, joints, [Loop((0, 1, 2, 3)), outer])
    assert len(sc.centre_classes()) == 1
    reduction = reduce(sc)
    assert len(reduction.steps) == 1
    assert mobility(reduction.graph) == mobility(sc) == 1
    assert len(reduce(sc.with_loops([Loop((0, 1, 2, 3)), Loop(outer.joints, "none")])).steps) == 1


def test_classes_are_kept_though_their_joints_go():
    """Two loops over the same ride-along are one class; without it their joints no longer say so."""
    joints = {"ab": (0, 1), "au": (0, 2), "uv": (2, 3), "vb": (3, 1), "ac": (0, 4), "cb": (4, 1), "ad": (0, 5),
              "db": (5, 1)}  # fmt: skip
    path = ("au", "uv", "vb")
    loops = [Loop((*path, "ab")), Loop((*path, "cb", "ac")), Loop((*path, "db", "ad"))]
    sc = SCGraph(6, joints, loops)
    assert len(sc.centre_classes()) == 1
    reduced = reduce(sc).graph
    assert len(reduced.centre_classes()) == 1
    assert len({loop.at for loop in reduced.loops}) == 1
    assert reduced.loops[0].at is not None
    assert reduce(sc).undo().is_identical(sc)


def test_a_closed_surface_stays_closed():
    """A ride-along on a tetrahedron of four panels: the closing loop changes, the count does not."""
    from graphs.convert.link_joint import sc_from_link_joint_graph

    graph = nx.MultiGraph(nx.complete_graph(4))
    nx.add_path(graph, [0, 4, 5, 1])
    for start in range(2):
        sc = sc_from_link_joint_graph(nx.relabel_nodes(graph, {k: (k + 3 * start) % 6 for k in range(6)}), closed=True)
        assert sc.is_closed
        loops = [*sc.loops, *sc.closing]
        for last in range(len(loops)):  # whichever face is the dependent one
            turned = sc.with_loops([x for i, x in enumerate(loops) if i != last], [loops[last]])
            reduction = reduce(turned)
            assert len(reduction.graph) == 4
            assert reduction.graph.is_closed
            assert mobility(reduction.graph) == mobility(turned)
            assert reduction.undo().is_identical(turned)


def test_a_closing_loop_goes_with_the_last_cycle_of_its_block():
    """Two four-bars on one joint and the loop around both: fully reduced, one joint and no loop is left."""
    joints = [(0, 1), (0, 2), (2, 3), (3, 1), (0, 4), (4, 5), (5, 1)]
    around = Loop((1, 2, 3, 4, 5, 6))
    sc = SCGraph(6, joints, [Loop((0, 1, 2, 3)), Loop((0, 4, 5, 6))], closing=[around])
    whole = reduce(sc, fully=True)
    assert (len(whole.graph), whole.graph.loops, whole.graph.closing) == (2, (), ())
    assert whole.undo().is_identical(sc)
    assert len(reduce(sc).graph.loops) == 1


@pytest.mark.parametrize("rule", RULES)
def test_an_scd_graph_may_be_reduced(rule):
    reduction = reduce(read(DATA / "wiener" / "fortune-teller.json"), rule=rule)
    assert mobility(reduction.graph) == 5


def test_dyads_need_no_joint_between_their_bases():
    """A chain u-v between two opposite links of a six-bar: no ride-along, but a dyad."""
    joints = [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (5, 0), (0, 6), (6, 7), (7, 3)]
    sc = SCGraph(8, joints, [Loop((0, 1, 2, 8, 7, 6)), Loop((3, 4, 5, 6, 7, 8))])
    assert len(sc.centre_classes()) == 1
    assert not reduce(sc).steps
    dyads = reduce(sc, rule="dyad")
    assert len(dyads.steps) >= 1
    assert dyads.steps[0].joint is None
    assert mobility(dyads.graph) == mobility(sc)
    assert dyads.undo().is_identical(sc)


@given(randoms)
def test_dyad_reduction_keeps_the_count_and_can_be_undone(rng):
    sc = random_addenda(rng)
    for fully in (False, True):
        reduction = reduce(sc, rule="dyad", fully=fully)
        assert mobility(reduction.graph) == mobility(sc)
        assert reduction.undo().is_identical(sc)
        assert len(reduction.steps) >= len(reduce(sc, fully=fully).steps) or not fully


@given(scd_graphs)
def test_random_scd_graphs_keep_their_count(scd):
    for rule in RULES:
        reduction = reduce(scd, rule=rule)
        assert mobility(reduction.graph) == mobility(scd)
        assert reduction.undo().is_identical(scd)
