"""The hoop, the inequalities and the crank angles against what is true by construction."""

import numpy as np
import pytest
from cranks import direction, lines_apart, order_of, problem, random_orientations
from second_methods import hoop_sequence
from sizes import slow, slow_but

from graphs.errors import InvariantError, UnsolvableError
from synth.linkages.guidance.order import (
    DIRECTIONS,
    analyse_order,
    crank_angles,
    hoop,
    nearest_moving_axis,
    order_by_crank_angles,
    order_by_inequalities,
    order_verdicts,
    required_sequence,
)
from synth.linkages.guidance.orientations import Orientations

ORDERS = ("any", "ccw", "cw")


def check(case, seed):
    rng = np.random.default_rng([seed, case])
    n = int(rng.integers(3, 9))
    made = problem(n, rng, ORDERS[case % 3])
    truth = order_of(made.turned)
    found = analyse_order(made.orientations, made.fixed)
    assert (found.kept, found.by_inequalities, found.by_crank_angles) == (truth,) * 3, (seed, case)
    assert found.agree
    assert found.in_order is (truth == "ccw")
    assert found.misfit < 1e-6
    return truth


@pytest.mark.parametrize("cases", [120, slow(600)])
def test_three_checks_agree_with_the_truth(cases):
    truths = [check(case, 1) for case in range(cases)]
    assert all(truths.count(kept) > cases // 8 for kept in ("ccw", "cw", None))


@pytest.mark.slow
def test_three_checks_agree_with_the_truth_in_a_hundred_thousand_cases():
    truths = [check(case, 2) for case in range(100_000)]
    assert all(truths.count(kept) > 20_000 for kept in ("ccw", "cw", None))


@pytest.mark.parametrize("n", slow_but([3, 5], range(3, 10)))
def test_hoop_angles_are_half_sums_of_crank_angles(n):
    """The hoop meets S_ij half way between W_i and W_j: (b_i + b_j - b_2) / 2 from S_12, modulo 180 degrees."""
    rng = np.random.default_rng(n)
    for _ in range(100):
        made = problem(n, rng)
        for way, sign in zip(DIRECTIONS, (1.0, -1.0), strict=True):
            for crossing in hoop(made.orientations, made.fixed, way).crossings:
                i, j = crossing.pair
                due = sign * (made.turned[i - 1] + made.turned[j - 1] - made.turned[1]) / 2.0
                assert abs(np.sin(crossing.angle - due)) < 1e-6


@pytest.mark.parametrize("cases", [20, slow(300)])
def test_geometric_and_analytic_form_cross_alike(cases):
    rng = np.random.default_rng(11)
    for _ in range(cases):
        given, axis = random_orientations(int(rng.integers(3, 8)), rng), direction(rng)
        for way in DIRECTIONS:
            turned = hoop(given, axis, way)
            assert turned.sequence == hoop_sequence(given, axis, way)
            assert len(turned.crossings) == len(given.pairs()) - 1
            assert np.all(np.diff([c.angle for c in turned.crossings]) > 0.0)
            needed = [pair for pair in turned.sequence if pair in turned.required]
            assert turned.in_order is (tuple(needed) == turned.required)
            assert (turned.breaks_at is None) is turned.in_order
            assert 0.0 <= turned.margin < np.pi
        # the two directions are mirror images, and so are the two ends of the axis
        assert hoop(given, axis, "cw").sequence == hoop(given, axis, "ccw").sequence[::-1]
        assert hoop(given, -axis, "cw").sequence == hoop(given, axis, "ccw").sequence


@pytest.mark.parametrize("number", [20, slow(80)])
def test_many_axes_at_once_are_the_single_ones(number):
    rng = np.random.default_rng(12)
    for n in range(3, 8):
        given = random_orientations(n, rng)
        axes = rng.normal(size=(number, 3))
        words = {1: "ccw", -1: "cw", 0: None}
        verdicts = order_verdicts(given, axes)
        assert [words[v] for v in verdicts] == [order_by_inequalities(given, axis) for axis in axes]
        for axis, verdict in zip(axes, verdicts, strict=True):
            kept = next((way for way in DIRECTIONS if hoop(given, axis, way).in_order), None)
            assert words[verdict] == kept
        assert np.array_equal(order_verdicts(given, -axes), -verdicts)


def test_three_orientations_are_always_in_order_one_way():
    rng = np.random.default_rng(13)
    assert set(order_verdicts(random_orientations(3, rng), rng.normal(size=(1000, 3)))) == {1, -1}


def test_where_the_order_breaks():
    """Orientations 3 and 4 of a counter-clockwise crank changed round."""
    rng = np.random.default_rng(14)
    made = problem(6, rng, "ccw")
    changed = made.orientations.subset([1, 2, 4, 3, 5, 6])
    turned = hoop(changed, made.fixed)
    assert turned.breaks_at == ((1, 3), (1, 4))
    assert required_sequence(6) == ((1, 3), (1, 4), (1, 5), (1, 6), (2, 6))


def test_the_moving_axis_is_found_again():
    rng = np.random.default_rng(15)
    for n in range(3, 8):
        made = problem(n, rng)
        assert lines_apart(nearest_moving_axis(made.orientations, made.fixed), made.moving) < 1e-6
        assert np.allclose(crank_angles(made.orientations, made.fixed, made.moving), made.turned, atol=1e-9)


def test_equal_crank_angles_are_no_order():
    assert order_by_crank_angles([0.0, 1.0, 1.0]) is None
    assert order_by_crank_angles([0.0, 0.0, 1.0]) is None
    assert order_by_crank_angles([2.0, 3.0, 1.0]) == "ccw"


def test_an_axis_on_a_relative_axis_is_refused():
    given = random_orientations(4, np.random.default_rng(16))
    for (i, j), axis in given.relative_axes().items():
        for ask in (hoop, analyse_order):
            with pytest.raises(UnsolvableError, match=f"lies on the relative axis S{i}{j}"):
                ask(given, -3.0 * axis)
    assert order_verdicts(given, [given.relative_axis(1, 2)]).tolist() == [0]


def test_axes_that_are_none():
    given = Orientations.from_axis_angles(np.eye(3), [1, 2, 3])
    for ask in (hoop, analyse_order, order_by_inequalities):
        with pytest.raises(InvariantError, match="the fixed axis is zero; expected a direction"):
            ask(given, (0, 0, 0))
    with pytest.raises(InvariantError, match="expected m by 3"):
        order_verdicts(given, [1, 2, 3])
    for bad in (0.0, np.nan, np.inf):
        axes = np.ones((40_000, 3))
        axes[39_998] = bad
        with pytest.raises(InvariantError, match="axis 39999 has no direction"):
            order_verdicts(given, axes)


def test_the_length_of_an_axis_does_not_matter():
    rng = np.random.default_rng(17)
    given = random_orientations(5, rng)
    axes = rng.normal(size=(500, 3))
    for size in (1e-100, 1e100):
        assert np.array_equal(order_verdicts(given, size * axes), order_verdicts(given, axes))


def test_the_signs_are_the_rows_of_the_inequalities():
    """Eq. 2 as n rows, 0 < d_13 < ... < d_1n < d_2n < 180, by angles of lines across G, for either direction."""
    random = np.random.default_rng(7)
    seen = set()
    for _ in range(300):
        n = int(random.integers(3, 7))
        orientations = random_orientations(n, random)
        g = random.normal(size=3)
        g /= np.linalg.norm(g)
        lines = [orientations.relative_axis(*pair) for pair in ((1, 2), *required_sequence(n))]
        u = np.cross(g, lines[0])
        u /= np.linalg.norm(u)
        v = np.cross(g, u)
        turns = np.degrees([np.arctan2(line @ v, line @ u) for line in lines])
        rows = {}
        for name, way in zip(DIRECTIONS, (1.0, -1.0), strict=True):
            d = (way * (turns[1:] - turns[0])) % 180.0
            row = [d[0] > 0.0, *(d[1:] > d[:-1]), d[-1] < 180.0]
            assert len(row) == n
            rows[name] = all(row)
        kept = order_by_inequalities(orientations, g)
        assert rows == {name: name == kept for name in DIRECTIONS}
        seen.add(kept)
    assert len(seen) == 3


@pytest.mark.parametrize("n", [3, 5, 7])
def test_a_desired_order_is_that_of_orientations_in_that_order(n):
    """As if the file were permuted, with the numbers that the orientations have in it."""
    rng = np.random.default_rng(n)
    for _ in range(40):
        made = problem(n, rng)
        desired = (1 + rng.permutation(n)[: int(rng.integers(3, n + 1))]).tolist()
        found = analyse_order(made.orientations, made.fixed, "cw", desired)
        permuted = analyse_order(made.orientations.subset(desired), made.fixed, "cw")
        assert (found.in_order, found.kept, found.by_inequalities) == (
            permuted.in_order, permuted.kept, permuted.by_inequalities,
        )  # fmt: skip
        assert found.agree
        turned = made.turned[np.array(desired) - 1]
        assert found.kept == order_of(np.mod(turned - turned[0], 2 * np.pi))
        np.testing.assert_allclose(found.crank_angles, permuted.crank_angles, atol=1e-9)
        named = [tuple(sorted(desired[place - 1] for place in one.pair)) for one in permuted.hoop.crossings]
        assert [one.pair for one in found.hoop.crossings] == named
        assert found.hoop.start == tuple(sorted(desired[:2]))


def test_a_desired_order_is_checked():
    made = problem(4, np.random.default_rng(1))
    for desired, message in (
        ([1, 2, 2], "occurs twice"),
        ([1, 2, 5], "orientation 5 is in"),
        ([1, 2], "2 orientations in"),
    ):
        with pytest.raises(InvariantError, match=message):
            analyse_order(made.orientations, made.fixed, desired=desired)
