import random
from itertools import combinations

import pytest
from hypothesis import given
from strategies import sc_graphs

from graphs.errors import InvariantError
from graphs.loops.classes import centre_classes
from graphs.loops.loop import Centre, Loop


def test_watt_has_two_classes_and_stephenson_one():
    assert len(centre_classes([Loop((0, 1, 2, 3)), Loop((3, 4, 5, 6))])) == 2
    assert len(centre_classes([Loop((0, 1, 2, 3)), Loop((2, 3, 4, 5, 6))])) == 1


def test_closure_goes_over_classes_not_only_loops():
    """Loops 0 and 1 share two joints; loop 2 shares one with each of them, and so two with their class."""
    loops = [Loop(("a", "b", "c")), Loop(("a", "b", "d")), Loop(("c", "d", "e"))]
    assert len(centre_classes(loops)) == 1
    assert len(centre_classes(loops[1:])) == 2


def test_planar_loops_that_share_one_joint_are_one_class():
    loops = [Loop((0, 1, 2, 3), "infinite"), Loop((3, 4, 5, 6), "infinite")]
    assert [one.loops for one in centre_classes(loops)] == [(0, 1)]


def test_finite_and_infinite_may_share_one_joint():
    assert len(centre_classes([Loop((0, 1, 2, 3), "infinite"), Loop((3, 4, 5, 6))])) == 2


def test_finite_and_infinite_may_not_share_two():
    with pytest.raises(InvariantError, match="share joints '2 3'; expected one kind of centre"):
        centre_classes([Loop((0, 1, 2, 3)), Loop((2, 3, 4, 5), "infinite")])


def test_centres_of_one_name_are_one():
    loops = [Loop((0, 1, 2), at="O"), Loop((3, 4, 5), at="O"), Loop((6, 7, 8))]
    assert [one.loops for one in centre_classes(loops)] == [(0, 1), (2,)]
    with pytest.raises(InvariantError, match="name centre 'O'"):
        centre_classes([Loop((0, 1, 2), at="O"), Loop((3, 4, 5), "infinite", at="O")])


def test_spatial_loops_are_in_no_class():
    assert [one.loops for one in centre_classes([Loop((0, 1, 2), "none"), Loop((2, 3, 4))])] == [(1,)]


@given(sc_graphs)
def test_classes_are_the_finest_closed_partition(sc):
    """Merging by pairs until nothing changes, in the plainest way, gives the same classes."""
    loops = (*sc.loops, *sc.closing)
    assert merged_pair_by_pair(loops) == {frozenset(one.loops) for one in sc.centre_classes()}


@given(sc_graphs)
def test_order_of_loops_does_not_matter(sc):
    shuffled = list(sc.loops)
    random.Random(1).shuffle(shuffled)

    def joints(loops):
        return {one.joints for one in centre_classes(loops)}

    assert joints(sc.loops) == joints(shuffled)


def merged_pair_by_pair(loops):
    """The partition by the rule itself: any two classes that share enough joints merge, until none do."""
    parts = [({i}, set(loop.joints), loop.centre) for i, loop in enumerate(loops) if loop.has_centre]
    while True:
        for one, two in combinations(parts, 2):
            enough = 1 if one[2] is two[2] is Centre.INFINITE else 2
            if len(one[1] & two[1]) >= enough:
                parts = [p for p in parts if p is not one and p is not two]
                parts.append((one[0] | two[0], one[1] | two[1], one[2]))
                break
        else:
            return {frozenset(p[0]) for p in parts}


def test_crowded_joints_give_the_same_classes():
    """Dozens of loops on one joint or two, chains of forced coincidences among them."""
    rng = random.Random(16)
    merged = 0
    for _ in range(60):
        joints = rng.randint(30, 120)
        loops = [
            Loop((*rng.choice([("a",), ("a",), ("a", "b"), ("b",)]), *rng.sample(range(joints), rng.randint(1, 2))))
            for _ in range(rng.randint(20, 60))
        ]
        classes = centre_classes(loops)
        assert {frozenset(one.loops) for one in classes} == merged_pair_by_pair(loops)
        assert all(one.joints == {j for i in one.loops for j in loops[i].joints} for one in classes)
        merged += sum(len(one.loops) > 1 for one in classes)
        merged -= len(classes) == 1
    assert merged > 60


def test_ten_thousand_loops_on_one_joint():
    """No pair of them is looked at: fifty million would take minutes and gigabytes."""
    loops = [Loop(("base", 3 * k, 3 * k + 1, 3 * k + 2)) for k in range(10_000)]
    assert len(centre_classes(loops)) == 10_000
    sharing = [Loop((*loop.joints, "second")) for loop in loops]
    assert len(centre_classes(sharing)) == 1
    assert len(centre_classes([*loops, Loop((0, 1, 3, 4))])) == 10_000 - 1
