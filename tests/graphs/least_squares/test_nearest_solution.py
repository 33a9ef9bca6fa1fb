"""The solution of equations nearest to a start, against closed forms and against scipy with constraints."""

import numpy as np
import pytest
import scipy.optimize

from graphs.least_squares import nearest_solution
from graphs.least_squares.stop_reason import StopReason

FREE = (np.full(4, -np.inf), np.full(4, np.inf))


def sphere(x):
    return np.array([x @ x - 1.0]), 2.0 * x[None]


def test_the_nearest_point_of_a_surface_with_a_limit_and_bounds():
    """The unit sphere in four dimensions, then only where x is no more than 0.3, then y within bounds too."""

    def system(limit):
        def at(x):
            over = max(x[0] - limit, 0.0)
            return np.array([x @ x - 1.0, over]), np.array([2 * x, [float(over > 0), 0, 0, 0]])

        return at

    start, begun = np.array([0.8, 0.9, 0.1, 0.2]), np.array([0.1, 0.1, 0.7, -0.7])
    begun /= np.linalg.norm(begun)
    on_sphere = nearest_solution(system(np.inf), begun, start, FREE)
    assert on_sphere.settled
    np.testing.assert_allclose(on_sphere.unknowns, start / np.linalg.norm(start), atol=1e-9)
    limited = nearest_solution(system(0.3), begun, start, FREE)
    assert limited.settled
    rest = start[1:] * np.sqrt(1 - 0.3**2) / np.linalg.norm(start[1:])
    np.testing.assert_allclose(limited.unknowns, [0.3, *rest], atol=1e-9)
    low, high = FREE[0].copy(), FREE[1].copy()
    high[1] = 0.5
    bounded = nearest_solution(system(0.3), begun, start, (low, high))
    assert bounded.settled
    rest = start[2:] * np.sqrt(1 - 0.3**2 - 0.5**2) / np.linalg.norm(start[2:])
    np.testing.assert_allclose(bounded.unknowns, [0.3, 0.5, *rest], atol=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_the_nearest_point_of_a_curved_space_is_that_of_scipy(seed):
    """Two equations between five unknowns, one of them of third degree; SLSQP is the second method."""
    rng = np.random.default_rng(seed)
    a, b = 0.3 * rng.normal(size=(2, 5))

    def system(x):
        residual = np.array([x @ x - 1.0, b @ x + (a @ x) ** 3])
        return residual, np.stack([2.0 * x, b + 3.0 * (a @ x) ** 2 * a])

    begun = scipy.optimize.least_squares(lambda x: system(x)[0], rng.normal(size=5), xtol=1e-15, gtol=1e-15).x
    start = begun + 0.4 * rng.normal(size=5)
    free = (np.full(5, -np.inf), np.full(5, np.inf))
    found = nearest_solution(system, begun, start, free)
    constraint = {"type": "eq", "fun": lambda x: system(x)[0], "jac": lambda x: system(x)[1]}
    theirs = scipy.optimize.minimize(
        lambda x: (x - start) @ (x - start),
        begun,
        jac=lambda x: 2.0 * (x - start),
        constraints=constraint,
        method="SLSQP",
        options={"ftol": 1e-15, "maxiter": 200},
    )
    assert found.settled
    assert np.abs(system(found.unknowns)[0]).max() < 1e-9
    np.testing.assert_allclose(found.unknowns, theirs.x, rtol=0, atol=1e-6)


def test_equations_that_depend_on_each_other_count_once():
    """The same sphere three times: off it the three seem to differ."""

    def system(x):
        residual, jacobian = sphere(x)
        return np.array([1.0, 2.0, -1.0]) * residual, np.outer([1.0, 2.0, -1.0], jacobian)

    start = np.array([0.8, 0.9, 0.1, 0.2])
    found = nearest_solution(system, np.array([0.5, -0.5, 0.5, 0.5]), start, FREE)
    assert found.settled
    np.testing.assert_allclose(found.unknowns, start / np.linalg.norm(start), atol=1e-9)


def test_without_equations_the_start_is_the_nearest():
    found = nearest_solution(lambda x: (np.zeros(0), np.zeros((0, 4))), np.ones(4), np.arange(4.0), FREE)
    assert found.reason is StopReason.SOLVED
    assert found.unknowns.tolist() == [0.0, 1.0, 2.0, 3.0]


def test_a_solution_without_a_residual_is_not_searched_from():
    found = nearest_solution(lambda x: None, np.ones(4), np.zeros(4), FREE)
    assert (found.reason, found.settled) == (StopReason.UNDEFINED, False)
    assert found.unknowns.tolist() == [1.0, 1.0, 1.0, 1.0]


def test_where_there_is_no_residual_steps_are_halved():
    """Nothing is known beyond x = 0.65, where one of the steps would lead."""
    asked = []

    def system(x):
        asked.append(x[0])
        return None if x[0] > 0.65 else sphere(x)

    start = np.array([0.6, 0.8, 0.0, 0.0])
    found = nearest_solution(system, np.array([0.0, 0.28, 0.96, 0.0]), start, FREE)
    assert max(asked) > 0.65
    assert found.settled
    np.testing.assert_allclose(found.unknowns, start, atol=1e-9)


def test_a_space_too_rough_to_follow_is_given_up():
    """A residual that is nowhere but at the first point leaves no step to take."""
    begun = np.array([1.0, 0.0, 0.0, 0.0])
    found = nearest_solution(lambda x: sphere(x) if (x == begun).all() else None, begun, np.ones(4), FREE)
    assert (found.reason, found.settled) == (StopReason.STALLED, False)
    assert found.unknowns.tolist() == begun.tolist()


def test_steps_are_used_up_on_the_way_round_a_long_spiral():
    """A helix of small pitch, of which the nearest point is many turns away."""

    def helix(x):
        turn = 40.0 * x[2]
        residual = np.array([x[0] - np.cos(turn), x[1] - np.sin(turn)])
        return residual, np.array([[1.0, 0.0, 40.0 * np.sin(turn)], [0.0, 1.0, -40.0 * np.cos(turn)]])

    free = (np.full(3, -np.inf), np.full(3, np.inf))
    found = nearest_solution(helix, np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 3.0]), free)
    assert found.reason in (StopReason.STEPS, StopReason.STALLED)
    assert not found.settled


def test_a_limit_that_is_reached_at_the_solution_lets_go_where_the_start_is_within_it():
    """At x = 0.3 the limit has derivatives, and no residual; the start says that it need not act."""

    def system(x):
        beyond = float(x[0] >= 0.3)
        return np.array([x @ x - 1.0, beyond * (x[0] - 0.3)]), np.array([2.0 * x, [beyond, 0.0, 0.0, 0.0]])

    begun, start = np.array([0.3, np.sqrt(1.0 - 0.09), 0.0, 0.0]), np.array([0.1, 0.9, 0.1, 0.2])
    found = nearest_solution(system, begun, start, FREE)
    assert found.settled
    np.testing.assert_allclose(found.unknowns, start / np.linalg.norm(start), atol=1e-9)


def test_lower_bounds_hold_as_upper_ones_do_and_bound_unknowns_are_known_to_the_others():
    """In the mirror image of a bounded problem all is mirrored, and one linear equation is met in one step."""
    start, begun = np.array([-0.8, -0.9, 0.1, 0.2]), np.array([-0.1, -0.1, 0.7, -0.7])
    low = FREE[0].copy()
    low[1] = -0.5
    found = nearest_solution(sphere, begun / np.linalg.norm(begun), start, (low, FREE[1]))
    assert found.settled
    rest = np.array([-0.8, 0.1, 0.2]) * np.sqrt(1.0 - 0.25) / np.linalg.norm([-0.8, 0.1, 0.2])
    np.testing.assert_allclose(found.unknowns, [rest[0], -0.5, *rest[1:]], atol=1e-9)
    asked = []

    def plane(x):
        asked.append(x)
        return np.array([x.sum() - 1.0]), np.ones((1, 4))

    high = np.array([0.5, 9.0, 9.0, 9.0])
    found = nearest_solution(plane, np.array([0.0, 1.0, 0.0, 0.0]), np.array([3.0, 0.0, 0.0, 0.0]), (FREE[0], high))
    np.testing.assert_allclose(found.unknowns, [0.5, 1 / 6, 1 / 6, 1 / 6], atol=1e-12)
    assert len(asked) == 3  # at the solution and the start, and where the one step leads
