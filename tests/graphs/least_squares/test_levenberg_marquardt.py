"""Damped least squares against scipy on textbook problems, and each reason to stop."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.optimize

from graphs.least_squares import bounded_step
from graphs.least_squares.levenberg_marquardt import (
    LeastSquaresIterate,
    LevenbergMarquardt,
    Trial,
    least_squares,
    minimise,
)
from graphs.least_squares.stop_reason import StopReason

PLAIN = LevenbergMarquardt(
    first=1e-2, raised=4.0, lowered=(8.0,), least=1e-16, most=1e6, most_trials=400, shortest=1e-15
)
CURVED = replace(PLAIN, raised=16.0, lowered=(25.0, 6.25, 2.25), poor=0.25, good=0.5, corrections=2, longest=1.0)
RULES = [PLAIN, CURVED]


def rosenbrock(x):
    return np.array([10.0 * (x[1] - x[0] ** 2), 1.0 - x[0]]), np.array([[-20.0 * x[0], 10.0], [-1.0, 0.0]])


def powell(x):
    """Powell's singular function: the Jacobian has rank 2 at the solution, the origin."""
    a, b, c, d = x
    r5, r10 = np.sqrt(5.0), np.sqrt(10.0)
    residual = np.array([a + 10.0 * b, r5 * (c - d), (b - 2.0 * c) ** 2, r10 * (a - d) ** 2])
    jacobian = np.array(
        [
            [1.0, 10.0, 0.0, 0.0],
            [0.0, 0.0, r5, -r5],
            [0.0, 2.0 * (b - 2.0 * c), -4.0 * (b - 2.0 * c), 0.0],
            [2.0 * r10 * (a - d), 0.0, 0.0, -2.0 * r10 * (a - d)],
        ]
    )
    return residual, jacobian


def freudenstein_roth(x):
    """A minimum that is no solution at (11.41, -0.8968), with the cost 48.98, beside the solution (5, 4)."""
    a, b = x
    residual = np.array([-13.0 + a + ((5.0 - b) * b - 2.0) * b, -29.0 + a + ((b + 1.0) * b - 14.0) * b])
    return residual, np.array([[1.0, 10.0 * b - 3.0 * b * b - 2.0], [1.0, 3.0 * b * b + 2.0 * b - 14.0]])


def helix(x):
    """The helical valley of Fletcher and Powell, with its solution at (1, 0, 0)."""
    a, b, c = x
    radius, turn = np.hypot(a, b), np.arctan2(b, a) / (2.0 * np.pi)
    by_turn = np.array([-b, a]) / (2.0 * np.pi * radius**2)
    residual = np.array([10.0 * (c - 10.0 * turn), 10.0 * (radius - 1.0), c])
    jacobian = np.array([[*(-100.0 * by_turn), 10.0], [10.0 * a / radius, 10.0 * b / radius, 0.0], [0.0, 0.0, 1.0]])
    return residual, jacobian


def circle(x):
    return np.array([x @ x - 1.0]), 2.0 * x[None]


def apart(x):
    """Two values that one unknown cannot both have: the least cost is 2, at 0."""
    return np.array([x[0] - 1.0, x[0] + 1.0]), np.ones((2, 1))


def by_scipy(system, start, bounds=(-np.inf, np.inf)):
    options = {"xtol": 1e-15, "ftol": 1e-15, "gtol": 1e-15, "max_nfev": 2000}
    return scipy.optimize.least_squares(lambda x: system(x)[0], start, lambda x: system(x)[1], bounds, **options)


@pytest.mark.parametrize("rule", RULES, ids=["plain", "corrected"])
@pytest.mark.parametrize(
    ("system", "start", "within"),
    [
        (rosenbrock, [-1.2, 1.0], 1e-12),
        (powell, [3.0, -1.0, 0.0, 1.0], 1e-4),  # the residual is quadratic in two directions: half the digits
        (freudenstein_roth, [6.0, 3.5], 1e-12),
        (helix, [-1.0, 0.5, 0.0], 1e-12),
    ],
)
def test_solutions_are_those_of_scipy(rule, system, start, within):
    found = least_squares(system, np.array(start), rule)
    theirs = by_scipy(system, start)
    assert found.reason is StopReason.SOLVED
    assert found.at.cost <= 2.0 * theirs.cost + 1e-24
    np.testing.assert_allclose(found.at.unknowns, theirs.x, rtol=0, atol=max(within, 3e-4 * (system is powell)))
    np.testing.assert_array_equal(found.at.residual, system(found.at.unknowns)[0])
    np.testing.assert_array_equal(found.at.jacobian, system(found.at.unknowns)[1])


@pytest.mark.parametrize("rule", RULES, ids=["plain", "corrected"])
def test_a_minimum_that_is_no_solution_is_that_of_scipy(rule):
    found = least_squares(freudenstein_roth, np.array([11.0, -1.0]), rule)
    theirs = by_scipy(freudenstein_roth, [11.0, -1.0])
    assert found.reason is StopReason.STALLED
    assert found.reason.converged
    assert found.at.cost == pytest.approx(2.0 * theirs.cost, rel=1e-14)
    assert found.at.cost == pytest.approx(48.98425, abs=1e-5)  # Moré, Garbow and Hillstrom (1981), problem 2
    np.testing.assert_allclose(found.at.unknowns, theirs.x, rtol=0, atol=1e-6)


@pytest.mark.parametrize("rule", RULES, ids=["plain", "corrected"])
def test_bounds_hold_and_the_minimum_on_them_is_that_of_scipy(rule):
    bounds = (np.array([-2.0, -2.0]), np.array([0.5, 2.0]))
    found = least_squares(rosenbrock, np.array([-1.2, 1.0]), rule, bounds)
    theirs = by_scipy(rosenbrock, [-1.2, 1.0], bounds)
    np.testing.assert_allclose(found.at.unknowns, [0.5, 0.25], rtol=0, atol=1e-9)
    np.testing.assert_allclose(found.at.unknowns, theirs.x, rtol=0, atol=1e-6)
    outside = least_squares(rosenbrock, np.array([9.0, 1.0]), rule, bounds)
    np.testing.assert_allclose(outside.at.unknowns, [0.5, 0.25], rtol=0, atol=1e-9)


def test_linear_equations_that_leave_unknowns_free_get_the_solution_nearest_to_the_start():
    rng = np.random.default_rng(1)
    matrix, right, start = rng.normal(size=(3, 7)), rng.normal(size=3), rng.normal(size=7)
    found = least_squares(lambda x: (matrix @ x - right, matrix), start, PLAIN)
    nearest = start - np.linalg.pinv(matrix) @ (matrix @ start - right)
    np.testing.assert_allclose(found.at.unknowns, nearest, rtol=0, atol=1e-12)


def test_steps_have_no_part_along_what_changes_no_residual():
    """Of a circle in the plane of five unknowns two are used: the others, and the direction, stay to the last bit."""
    found = least_squares(
        lambda x: (np.array([x[:2] @ x[:2] - 1.0]), np.append(2.0 * x[:2], np.zeros(3))[None]),
        np.array([3.0, 4.0, 0.1, 0.2, 0.3]),
        CURVED,
    )
    np.testing.assert_allclose(found.at.unknowns[:2], [0.6, 0.8], rtol=0, atol=1e-14)
    assert found.at.unknowns[2:].tolist() == [0.1, 0.2, 0.3]


def test_corrections_take_fewer_trials_in_a_curved_valley():
    """Along a circle that is a thousand times as steep across as along, uncorrected steps are short."""

    def steep_circle(x):
        radius, turn = np.hypot(*x), np.arctan2(x[1], x[0])
        across = np.array([x[0], x[1]]) / radius
        along = np.array([-x[1], x[0]]) / radius**2
        return np.array([1e3 * (radius - 1.0), turn]), np.array([1e3 * across, along])

    start = np.array([np.cos(2.5), np.sin(2.5)])
    with_corrections, without = (
        least_squares(steep_circle, start, replace(CURVED, corrections=number)) for number in (2, 0)
    )
    assert (with_corrections.reason, without.reason) == (StopReason.SOLVED, StopReason.STEPS)
    assert with_corrections.steps <= with_corrections.trials < 0.25 * without.trials


class Countdown:
    """An iterate whose cost falls by a part with each step, as an answer to some damping."""

    def __init__(self, cost, part=0.5, *, accepts=np.inf, predicted=0.0, corrections=0, length=1.0):
        self.cost, self.part, self.accepts = cost, part, accepts
        self.solved = cost <= 1e-3
        self.about = {"predicted": predicted, "corrections": corrections, "length": length}
        self.asked = []

    def trial(self, damping):
        self.asked.append(damping)
        there = Countdown(self.cost * (1.0 - self.part), self.part, accepts=self.accepts, **self.about)
        there.asked = self.asked
        return Trial(there if damping >= self.accepts or self.accepts == np.inf else None, damping, **self.about)


def dampings(start, **changed):
    """The end of a search, and the dampings that were tried."""
    rule = LevenbergMarquardt(**({"first": 1.0, "raised": 4.0, "lowered": (8.0, 2.0), "most_trials": 50} | changed))
    return minimise(start, rule), start.asked


@pytest.mark.parametrize(
    ("start", "changed", "reason", "steps", "trials"),
    [
        (Countdown(1.0), {}, StopReason.SOLVED, 10, 10),
        (Countdown(1e-3), {}, StopReason.SOLVED, 0, 0),
        (Countdown(1.0), {"most_steps": 3}, StopReason.STEPS, 3, 3),
        (Countdown(1.0), {"most_trials": 3}, StopReason.STEPS, 3, 3),
        (Countdown(1.0, accepts=100.0), {"most_trials": 3}, StopReason.STEPS, 0, 3),
        (Countdown(1.0, 0.25), {"least_gain": 0.25}, StopReason.SETTLED, 1, 1),
        (Countdown(1.0, 0.26), {"least_gain": 0.25, "most_steps": 2}, StopReason.STEPS, 2, 2),
        (Countdown(1.0, 0.25), {"required": 0.25, "most": 4.0}, StopReason.STALLED, 0, 2),
        (Countdown(1.0, 0.0), {"most": 16.0}, StopReason.STALLED, 0, 3),
        (Countdown(1.0, 0.0, length=1e-3), {"shortest": 1e-3}, StopReason.STALLED, 0, 1),
        (Countdown(1.0, 0.0, length=2e-3), {"shortest": 1e-3, "most": 2.0}, StopReason.STALLED, 0, 1),
        (Countdown(1.0, 0.0, length=2e-3), {"shortest": 1e-3, "most_trials": 2}, StopReason.STEPS, 0, 2),
        # a step that gains a poor part of what is predicted, or just that, is not the last
        (
            Countdown(1.0, 0.25, predicted=1.0),
            {"least_gain": 0.5, "poor": 0.25, "most_steps": 1},
            StopReason.STEPS,
            1,
            1,
        ),
        (
            Countdown(1.0, 0.1, predicted=9.0),
            {"least_gain": 0.5, "poor": 0.25, "most_steps": 4},
            StopReason.STEPS,
            4,
            4,
        ),
    ],
)
def test_each_reason_to_stop_is_reached(start, changed, reason, steps, trials):
    found, _ = dampings(start, **changed)
    assert (found.reason, found.steps, found.trials) == (reason, steps, trials)
    assert found.reason.converged == (reason is not StopReason.STEPS)
    assert found.at.cost == pytest.approx(start.cost * (1.0 - start.part) ** steps)


def test_an_allowance_ends_the_search_before_the_trial_that_it_refuses():
    left = iter([True, True, False])
    rule = LevenbergMarquardt(first=1.0, raised=4.0, lowered=(8.0,))
    found = minimise(Countdown(1.0), rule, may_try=lambda: next(left))
    assert (found.reason, found.steps, found.trials) == (StopReason.ALLOWANCE, 2, 2)
    assert not found.reason.converged


def test_no_residual_at_the_start_is_no_search():
    assert least_squares(lambda x: None, np.zeros(2), PLAIN) is None


def test_a_step_to_where_there_is_no_residual_is_rejected():
    """The root of the logarithm: an undamped step from 3 leads to where it is not defined."""
    seen = []

    def logarithm(x):
        seen.append(x[0])
        return (np.log(x), 1.0 / x[:, None]) if x[0] > 0.0 else None

    found = least_squares(logarithm, np.array([3.0]), replace(PLAIN, first=1e-9))
    assert min(seen) < 0.0
    assert found.reason is StopReason.SOLVED
    assert found.at.unknowns == pytest.approx([1.0], abs=1e-14)


@pytest.mark.parametrize(
    ("start", "changed", "tried"),
    [
        (Countdown(1.0), {"most_steps": 3}, [1.0, 1 / 8, 1 / 64]),  # each step is good
        (Countdown(1.0, corrections=1), {"most_steps": 3}, [1.0, 1 / 2, 1 / 4]),  # corrected steps lower it less
        (Countdown(1.0), {"most_steps": 4, "least": 0.1}, [1.0, 1 / 8, 0.1, 0.1]),
        (Countdown(1.0), {"most_steps": 3, "least_of_cost": 0.5}, [1.0, 1 / 4, 1 / 8]),  # half the cost, which halves
        (Countdown(8.0), {"most_steps": 1, "least_of_cost": 0.5}, [4.0]),
        (Countdown(1.0, accepts=10.0), {"most_trials": 5}, [1.0, 4.0, 16.0, 2.0, 8.0]),
        (Countdown(1.0, accepts=10.0), {"most_trials": 4, "cautious": 2.0}, [1.0, 4.0, 16.0, 8.0]),
        (Countdown(1.0), {"most_trials": 2, "cautious": 2.0}, [1.0, 1 / 8]),
        # half of what is predicted: neither poor nor good; a fifth: poor; six tenths: good
        (Countdown(1.0, predicted=1.0), {"most_steps": 2, "poor": 0.25, "good": 0.5}, [1.0, 1.0]),
        (Countdown(1.0, 0.25, predicted=1.0), {"most_steps": 2, "poor": 0.25, "good": 0.5}, [1.0, 1.0]),
        (Countdown(1.0, predicted=2.5), {"most_steps": 2, "poor": 0.25, "good": 0.5}, [1.0, 4.0]),
        (Countdown(1.0, predicted=0.8), {"most_steps": 2, "poor": 0.25, "good": 0.5}, [1.0, 1 / 8]),
    ],
)
def test_the_damping_follows_the_reductions(start, changed, tried):
    _, asked = dampings(start, **changed)
    assert asked == pytest.approx(tried)


def test_long_steps_are_damped_until_they_are_short_enough():
    """From far away the first step would lead to the solution; none is longer than 1."""
    places = []

    def straight(x):
        places.append(x.copy())
        return x - 10.0, np.eye(2)

    found = least_squares(straight, np.zeros(2), replace(PLAIN, first=1e-6, longest=1.0, lowered=(1e6,)))
    steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
    assert found.reason is StopReason.SOLVED
    assert steps.max() <= 1.0
    assert steps.max() > 0.2  # the damping is raised by 4 at a time: no shorter than it must be


def test_the_gain_that_ends_a_search_may_depend_on_where_it_is():
    rule = LevenbergMarquardt(first=1.0, raised=4.0, lowered=(8.0,), most_trials=50)
    found = minimise(Countdown(1.0), rule, least_gain=lambda there: 0.6 if there.cost < 0.2 else 0.0)
    assert (found.reason, found.steps) == (StopReason.SETTLED, 3)


def test_what_cannot_be_met_settles_where_scipy_does():
    found = least_squares(apart, np.array([5.0]), replace(PLAIN, least_gain=1e-12))
    assert found.reason is StopReason.SETTLED
    assert found.at.unknowns == pytest.approx(by_scipy(apart, [5.0]).x, abs=1e-6)
    assert found.at.cost == pytest.approx(2.0)


def test_the_defaults_are_what_counts_as_closed():
    found = least_squares(circle, np.array([3.0, 4.0]), PLAIN)
    assert abs(found.at.residual[0]) <= 1e-14
    rough = least_squares(circle, np.array([3.0, 4.0]), replace(PLAIN, solved=1e-2))
    assert 1e-12 < abs(rough.at.residual[0]) <= 1e-2


def test_a_residual_of_zero_is_solved_even_where_no_other_is():
    found = least_squares(lambda x: (x, np.eye(2)), np.zeros(2), replace(PLAIN, solved=0.0))
    assert (found.reason, found.trials) == (StopReason.SOLVED, 0)


FREE = (np.full(2, -np.inf), np.full(2, np.inf))


def bent(x):
    """Two equations with terms of second and third degree."""
    residual = np.array([x[0] + 0.06 * x[1] ** 2 - 1.0, x[1] + 0.04 * x[0] ** 3 + 0.5])
    return residual, np.array([[1.0, 0.12 * x[1]], [0.12 * x[0] ** 2, 1.0]])


def iterate(system, unknowns, rule):
    return LeastSquaresIterate(system, FREE, rule, unknowns, *system(unknowns))


def test_corrections_take_away_what_the_residual_has_besides_its_linear_part():
    """The second method takes the steps one by one, each by the Jacobian of the first."""
    here, damping = np.array([0.6, 0.1]), 1e-3
    residual, jacobian = bent(here)

    def step(missed):
        return bounded_step(here, jacobian, missed, FREE, damping) - here

    first = here + step(residual)
    second = first + step(bent(first)[0] - (residual + jacobian @ (first - here)))
    third = second + step(bent(second)[0])
    for corrections, end in enumerate((first, second, third)):
        rule = replace(CURVED, poor=1e9, corrections=corrections)  # no step is good enough
        trial = iterate(bent, here, rule).trial(damping)
        assert trial.corrections == corrections
        np.testing.assert_allclose(trial.at.unknowns, end, rtol=0, atol=1e-14)
        assert trial.length == pytest.approx(np.abs(end - here).max(), abs=1e-14)
        linear = residual + jacobian @ (first - here)
        assert trial.predicted == pytest.approx(residual @ residual - linear @ linear)
    costs = [(bent(end)[0] ** 2).sum() for end in (first, second, third)]
    assert costs == sorted(costs, reverse=True)


def test_a_step_that_is_good_enough_is_not_corrected():
    asked = []

    def straight(x):
        asked.append(x)
        return x - 1.0, np.eye(2)

    trial = iterate(straight, np.zeros(2), CURVED).trial(1e-3)
    assert (trial.corrections, len(asked)) == (0, 2)  # where it is, and where the step leads


@pytest.mark.parametrize("beyond", [None, (np.full(2, 9.0), np.eye(2))], ids=["undefined", "worse"])
def test_a_correction_that_does_not_help_is_not_taken(beyond):
    asked = []

    def system(x):
        asked.append(x.copy())
        return bent(x) if len(asked) < 3 else beyond

    here = np.array([0.4, 0.3])
    trial = iterate(system, here, replace(CURVED, poor=1e9)).trial(1e-3)
    assert len(asked) == 3
    assert trial.at.unknowns.tolist() == asked[1].tolist()
    assert trial.length == pytest.approx(np.abs(asked[1] - here).max(), abs=1e-15)


def test_the_length_of_a_step_to_where_there_is_no_residual_is_known():
    asked = []

    def system(x):
        asked.append(x.copy())
        return bent(x) if len(asked) < 2 else None

    here = np.array([0.4, 0.3])
    trial = iterate(system, here, CURVED).trial(1e-3)
    assert (trial.at, len(asked)) == (None, 2)
    assert trial.length == pytest.approx(np.abs(asked[1] - here).max(), abs=1e-15)
