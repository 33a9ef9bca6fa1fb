"""Ride-along reduction gives the same type of mechanism however its parts are numbered and ordered."""

import random
from collections import Counter
from itertools import permutations

import pytest
from random_addenda import mixed_addenda, relabelled, renamed
from sizes import slow

from graphs.count.report import mobility_report
from graphs.identity.chains import chain_id, class_code
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.reduce.ride_alongs import reduce

TWO_RIDE_ALONGS = [(0, 1), (0, 2), (2, 3), (3, 1), (0, 4), (4, 5), (5, 1)]


def two_on_one_joint(first: Loop, second: Loop, order=range(7)) -> SCGraph:
    """Two four-bars that share a joint, each a ride-along on the other."""
    return SCGraph(6, {joint: TWO_RIDE_ALONGS[joint] for joint in order}, [first, second])


@pytest.mark.parametrize("kinds", [("finite", "infinite"), ("infinite", "finite")])
def test_the_finite_centre_stays_in_every_order_of_the_joints(kinds):
    loops = [Loop((0, 1, 2, 3), kinds[0]), Loop((0, 4, 5, 6), kinds[1])]
    for order in permutations(range(7), 2):  # the others follow as they were
        rest = [joint for joint in range(7) if joint not in order]
        left = reduce(two_on_one_joint(*loops, (*order, *rest))).graph
        assert [loop.centre for loop in left.loops] == [Centre.FINITE]
        assert mobility_report(left).mobility == 1


def test_a_protected_link_keeps_its_loop_whatever_its_centre():
    sc = two_on_one_joint(Loop((0, 1, 2, 3)), Loop((0, 4, 5, 6), "infinite"))
    (planar,) = reduce(sc, keep=[5]).graph.loops
    assert planar.centre is Centre.INFINITE
    assert not reduce(sc, keep=[2, 5]).steps
    grounded = SCGraph(sc.nodes, sc.joints, sc.loops, ground=4)
    assert reduce(grounded).graph.loops[0].centre is Centre.INFINITE


def test_a_centre_of_its_own_stays_before_a_shared_one():
    """A third four-bar hangs on link 0 and has the centre "O"; of two like four-bars the general one stays."""
    joints = [*TWO_RIDE_ALONGS, (0, 6), (6, 7), (7, 8), (8, 0)]
    rest = Loop((7, 8, 9, 10), at="O")
    for shared in range(2):
        ats = ["O" if i == shared else None for i in range(2)]
        loops = [Loop((0, 1, 2, 3), at=ats[0]), Loop((0, 4, 5, 6), at=ats[1]), rest]
        assert len(reduce(SCGraph(9, joints, loops)).graph.centre_classes()) == 2


def three_blocks(order) -> SCGraph:
    """Three blocks about link 0, each of two four-bars that share a joint, about A and B, B and C, C and A.

    A has a third loop in a triangle that stays: A and B differ, though both are finite and shared.
    """
    joints: dict[str, tuple[str, str]] = {}
    loops = []
    for block, (one, other) in zip("xyz", ("AB", "BC", "CA"), strict=True):
        joints[f"{block}0"] = ("0", f"{block}b")
        for name, at in (("p", one), ("q", other)):
            u, v = f"{block}{name}u", f"{block}{name}v"
            ids = [f"{block}{name}{i}" for i in range(3)]
            joints |= dict(zip(ids, (("0", u), (u, v), (v, f"{block}b")), strict=True))
            loops.append(Loop((f"{block}0", *ids), at=at))
    joints |= {"t0": ("0", "t1"), "t1": ("t1", "t2"), "t2": ("t2", "0")}
    loops.append(Loop(("t0", "t1", "t2"), at="A"))
    links = dict.fromkeys(link for ends in joints.values() for link in ends)
    return SCGraph(links, {joint: joints[joint] for joint in order or joints}, loops)


def test_shared_centres_that_are_equal_are_told_apart_by_what_is_left():
    """Which of A, B and C stay where must not hang on the order of the joints."""
    ids = list(three_blocks(None).joints)
    rng = random.Random(5)
    codes = set()
    for _ in range(60):
        sc = relabelled(three_blocks(rng.sample(ids, len(ids))), rng)
        codes.add(class_code(reduce(sc).graph))
    assert len(codes) == 1


def check_one(rng: random.Random, kinds: Counter) -> None:
    """One random mechanism, reduced under two namings: same type; count, protected links and undo as ever."""
    sc = mixed_addenda(rng)
    keep = rng.sample(list(sc.nodes), rng.choice([0, 0, 1, 2]))
    fully = rng.random() < 0.3
    one = reduce(sc, fully=fully, keep=keep)
    assert mobility_report(one.graph).mobility == mobility_report(sc).mobility
    assert {*keep, sc.ground} - {None} <= set(one.graph)
    assert one.undo().is_identical(sc)
    there, names = renamed(sc, rng)
    kept = [names[link] for link in keep]
    two = reduce(there, fully=fully, keep=kept)
    assert class_code(one.graph, keep) == class_code(two.graph, kept)
    assert chain_id(one.graph) == chain_id(two.graph)
    kinds["steps"] += len(one.steps)
    kinds["mixed"] += {Centre.FINITE, Centre.INFINITE} <= {loop.centre for loop in sc.loops}
    kinds["named"] += any(loop.at for loop in sc.loops)


def check(seed: int, number: int) -> None:
    rng, kinds = random.Random(seed), Counter()
    for _ in range(number):
        check_one(rng, kinds)
    assert kinds["steps"] > 2 * number
    assert kinds["mixed"] > number // 2
    assert kinds["named"] > number // 2


@pytest.mark.parametrize("number", [60, slow(200)])
def test_mixed_centres_reduce_to_one_type(number):
    check(1, number)


@pytest.mark.slow
def test_ten_thousand_mixed_mechanisms_reduce_to_one_type():
    check(2, 10_000)
