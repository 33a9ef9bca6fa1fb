import random
from itertools import combinations

import pytest
from hypothesis import given
from strategies import sc_graphs

from graphs.errors import InvariantError
from graphs.loops.classes import centre_classes, class_of_loop
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
    assert class_of_loop(centre_classes([Loop((0, 1, 2), "none"), Loop((2, 3, 4))])) == {1: 0}


@given(sc_graphs)
def test_classes_are_the_finest_closed_partition(sc):
    """Merging by pairs until nothing changes, in the plainest way, gives the same classes."""
    loops = (*sc.loops, *sc.closing)
    parts = [({i}, set(loop.joints), loop.centre) for i, loop in enumerate(loops) if loop.has_centre]
    while True:
        for one, two in combinations(parts, 2):
            enough = 1 if one[2] is two[2] is Centre.INFINITE else 2
            if len(one[1] & two[1]) >= enough:
                parts = [p for p in parts if p is not one and p is not two]
                parts.append((one[0] | two[0], one[1] | two[1], one[2]))
                break
        else:
            break
    assert {frozenset(p[0]) for p in parts} == {frozenset(one.loops) for one in sc.centre_classes()}


@given(sc_graphs)
def test_order_of_loops_does_not_matter(sc):
    shuffled = list(sc.loops)
    random.Random(1).shuffle(shuffled)

    def joints(loops):
        return {one.joints for one in centre_classes(loops)}

    assert joints(sc.loops) == joints(shuffled)
