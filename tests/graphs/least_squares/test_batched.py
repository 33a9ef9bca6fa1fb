"""Many problems at once: each as it would be by itself, and each reason to stop."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.optimize

from graphs.least_squares.batched import BatchedSearch
from graphs.least_squares.levenberg_marquardt import LevenbergMarquardt
from graphs.least_squares.steps import by_each_unknown, by_the_mean
from graphs.least_squares.stop_reason import StopReason

RULE = LevenbergMarquardt(first=1e-2, raised=8.0, lowered=(8.0,), most=1e8, least_gain=1e-9)


class Valleys:
    """Rosenbrock's function with a steepness for each problem; undefined where the first unknown is more than its most."""

    def __init__(self, steep, most=np.inf):
        self.steep, self.asked = np.array(steep), []
        self.most = np.broadcast_to(most, len(steep))

    def residual(self, which, unknowns):
        x, y = unknowns.T
        residual = np.stack([self.steep[which] * (y - x * x), 1.0 - x], axis=1)
        residual[x > self.most[which]] = np.inf
        return residual, x

    def jacobian(self, which, unknowns, residual, data):
        self.asked.append(which.tolist())
        jacobian = np.zeros((len(which), 2, 2))
        jacobian[:, 0, 0], jacobian[:, 0, 1], jacobian[:, 1, 0] = -2 * self.steep[which] * data, self.steep[which], -1.0
        return jacobian

    def moved(self, which, unknowns, step):
        return unknowns + step


def begun(count, seed=0):
    return np.random.default_rng(seed).uniform(-2.0, 2.0, (count, 2))


@pytest.mark.parametrize("scaling", [by_the_mean, by_each_unknown])
def test_all_problems_are_solved_as_by_scipy(scaling):
    system, starts = Valleys([1.0, 3.0, 10.0, 30.0]), begun(4)
    search = BatchedSearch(system, starts, RULE, scaling)
    search.run(300, np.arange(4))
    for number, steep in enumerate(system.steep):
        theirs = scipy.optimize.least_squares(
            lambda x, steep=steep: [steep * (x[1] - x[0] ** 2), 1.0 - x[0]], starts[number], xtol=1e-15, gtol=1e-15
        )
        np.testing.assert_allclose(search.unknowns[number], theirs.x, rtol=0, atol=1e-6)
    np.testing.assert_allclose(search.costs, (search.residual**2).sum(axis=1), rtol=0, atol=1e-30)


def test_each_problem_goes_as_it_would_alone():
    steep, starts = [1.0, 3.0, 10.0], begun(3)
    together = BatchedSearch(Valleys(steep), starts, RULE, by_the_mean)
    together.run(12, np.arange(3))
    for number in range(3):
        alone = BatchedSearch(Valleys(steep[number : number + 1]), starts[number : number + 1], RULE, by_the_mean)
        alone.run(12, np.arange(1))
        np.testing.assert_allclose(together.unknowns[number], alone.unknowns[0], rtol=0, atol=1e-12)
        assert together.damping[number] == alone.damping[0]


def test_only_those_asked_for_move_and_starts_stay_as_they_were():
    starts = begun(4)
    kept = starts.copy()
    search = BatchedSearch(Valleys([1.0] * 4), starts, RULE, by_the_mean)
    search.run(3, np.array([1, 3]))
    assert (starts == kept).all()
    assert (search.unknowns != starts).any(axis=1).tolist() == [False, True, False, True]
    assert (search.damping == RULE.first).tolist() == [True, False, True, False]


def test_jacobians_are_found_anew_only_where_a_problem_moved():
    system = Valleys([1.0, 3.0], most=[0.5, np.inf])
    search = BatchedSearch(system, np.array([[0.4, 0.0], [-1.0, 0.0]]), RULE, by_the_mean)
    moved = [[0, 1]]
    for _ in range(5):
        before = search.unknowns.copy()
        search.step(np.arange(2))
        moved.append(np.flatnonzero((search.unknowns != before).any(axis=1)).tolist())
    assert [one for one in ([], [1], [0]) if one in moved] == [[], [1], [0]]  # by itself each, and neither
    assert system.asked == [one for one in moved[:-1] if one]


def test_known_residuals_are_not_asked_for():
    system, starts = Valleys([1.0, 2.0]), begun(2)
    known = system.residual(np.arange(2), starts)
    system.residual = None
    search = BatchedSearch(system, starts, RULE, by_the_mean, known)
    np.testing.assert_array_equal(search.residual, known[0])


def test_each_reason_to_stop_is_reached():
    starts = np.array([[0.9, 0.0], [-1.0, 1.0], [1.0, 1.0], [-1.0, 1.0]])
    system = Valleys([1.0] * 4, most=0.95)
    search = BatchedSearch(system, starts, RULE, by_the_mean)
    assert search.reasons == [None, None, StopReason.UNDEFINED, None]  # the third is beyond 0.95
    assert search.running.tolist() == [True, True, False, True]
    search.run(200, np.array([0, 1, 2]))
    assert search.reasons[:3] == [StopReason.STALLED, StopReason.STALLED, StopReason.UNDEFINED]
    assert search.reasons[3] is None
    assert (search.damping[:2] > RULE.most).all()
    assert (search.unknowns[:2, 0] <= 0.95).all()
    slow = BatchedSearch(Valleys([1.0]), starts[1:2], replace(RULE, least_gain=0.9999), by_the_mean)
    slow.run(50, np.arange(1))
    assert slow.reasons == [StopReason.SETTLED]
    assert not slow.running[0]


@pytest.mark.parametrize(("required", "accepted"), [(0.0, True), (0.5, True), (0.999, False)])
def test_a_required_gain_that_is_not_reached_is_a_rejected_step(required, accepted):
    start = np.array([[0.9, 0.0]])
    search = BatchedSearch(Valleys([1.0]), start, replace(RULE, first=1.0, required=required), by_the_mean)
    search.step(np.arange(1))
    assert (search.unknowns != start).any() == accepted
    assert search.damping[0] == (1.0 / 8.0 if accepted else 8.0)


def test_a_step_that_changes_nothing_is_rejected_until_the_damping_is_above_its_most():
    """Two values that one unknown cannot both have: begun at the least cost no step gains."""

    class Apart:
        def residual(self, which, unknowns):
            return np.concatenate([unknowns - 1.0, unknowns + 1.0], axis=1), unknowns

        def jacobian(self, which, unknowns, residual, data):
            return np.ones((len(which), 2, 1))

        def moved(self, which, unknowns, step):
            return unknowns + step

    rule = LevenbergMarquardt(first=1.0, raised=8.0, lowered=(8.0,), most=8.0)
    search = BatchedSearch(Apart(), np.zeros((1, 1)), rule, by_the_mean)
    search.step(np.arange(1))
    assert (search.damping[0], search.running[0]) == (8.0, True)  # its most is not above it
    search.step(np.arange(1))
    assert (search.damping[0], search.reasons) == (64.0, [StopReason.STALLED])


def test_no_problems_are_no_work():
    search = BatchedSearch(Valleys([]), np.zeros((0, 2)), RULE, by_the_mean)
    search.run(5, np.arange(0))
    assert len(search.jacobian(np.arange(0))) == 0
