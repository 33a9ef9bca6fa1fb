"""Steps against the normal equations, the pseudoinverse and scipy."""

import numpy as np
import pytest

from graphs.least_squares.steps import (
    bounded_step,
    by_each_unknown,
    by_the_mean,
    damped_step,
    minimum_norm_step,
    normal_step,
)


@pytest.mark.parametrize("shape", [(7, 3), (3, 7), (4, 4)])
@pytest.mark.parametrize("damping", [1e-8, 0.1, 1e4])
def test_damped_steps_solve_the_normal_equations(shape, damping):
    rng = np.random.default_rng(shape)
    jacobian, residual = rng.normal(size=shape), rng.normal(size=shape[0])
    step = damped_step(jacobian, residual, damping)
    gram = jacobian.T @ jacobian + damping * np.eye(shape[1])
    np.testing.assert_allclose(gram @ step, -jacobian.T @ residual, rtol=0, atol=1e-9)
    dual = -jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + damping * np.eye(shape[0]), residual)
    np.testing.assert_allclose(step, dual, rtol=1e-6, atol=1e-9)


def test_a_damped_step_keeps_digits_that_normal_equations_lose():
    """Two columns that differ by 1e-9: the square of that is below rounding."""
    jacobian = np.array([[1.0, 1.0], [1e-9, 0.0], [0.0, 1e-9]])
    residual = -jacobian @ np.array([1.0, 2.0])
    np.testing.assert_allclose(damped_step(jacobian, residual, 0.0), [1.0, 2.0], rtol=0, atol=1e-6)


def test_without_damping_what_is_free_is_an_error():
    with pytest.raises(np.linalg.LinAlgError):
        damped_step(np.array([[1.0, 0.0]]), np.array([1.0]), 0.0)


def test_unknowns_at_a_bound_that_push_against_it_stay_and_the_others_know():
    """Two unknowns share a sum; at its bound the first leaves all of it to the second."""
    bounds = (np.array([-1.0, -9.0]), np.array([1.0, 9.0]))
    jacobian, residual = np.array([[1.0, 1.0]]), np.array([-4.0])
    at_most = bounded_step(np.array([1.0, 0.0]), jacobian, residual, bounds, 1e-18)
    np.testing.assert_allclose(at_most, [1.0, 4.0], rtol=0, atol=1e-12)
    at_least = bounded_step(np.array([-1.0, 0.0]), jacobian, -residual, bounds, 1e-18)
    np.testing.assert_allclose(at_least, [-1.0, -4.0], rtol=0, atol=1e-12)
    away = bounded_step(np.array([1.0, 0.0]), jacobian, -residual, bounds, 1e-18)
    np.testing.assert_allclose(away, [-1.0, -2.0], rtol=0, atol=1e-12)  # from its bound it may go, to the other one
    down = bounded_step(np.array([-1.0, 0.0]), jacobian, residual, bounds, 1e-18)
    np.testing.assert_allclose(down, [1.0, 2.0], rtol=0, atol=1e-12)


def test_where_all_unknowns_are_held_nothing_moves():
    here = np.array([1.0])
    moved = bounded_step(here, np.array([[1.0]]), np.array([-4.0]), (np.zeros(1), np.ones(1)), 1e-9)
    assert moved.tolist() == [1.0]
    assert moved is not here


@pytest.mark.parametrize("rank", [1, 2, 3])
def test_minimum_norm_steps_are_those_of_the_pseudoinverse(rank):
    rng = np.random.default_rng(rank)
    jacobian = rng.normal(size=(4, rank)) @ rng.normal(size=(rank, 6))
    residual = rng.normal(size=4)
    step = minimum_norm_step(jacobian, residual)
    np.testing.assert_allclose(step, -np.linalg.pinv(jacobian, rcond=1e-9) @ residual, rtol=0, atol=1e-12)


def test_singular_values_within_rounding_count_as_zero():
    step = minimum_norm_step(np.diag([1.0, 1e-11]), np.array([-1.0, -1.0]))
    np.testing.assert_allclose(step, [1.0, 0.0], rtol=0, atol=1e-12)


@pytest.mark.parametrize("scaling", [by_the_mean, by_each_unknown])
def test_steps_of_many_problems_are_those_of_each(scaling):
    rng = np.random.default_rng(0)
    jacobian, residual, damping = rng.normal(size=(5, 6, 3)), rng.normal(size=(5, 6)), 10.0 ** rng.uniform(-3, 1, 5)
    steps = normal_step(jacobian, residual, damping, scaling)
    for number in range(5):
        gram = jacobian[number].T @ jacobian[number]
        added = np.trace(gram) / 3 * np.eye(3) if scaling is by_the_mean else np.diag(np.diag(gram))
        expected = -np.linalg.solve(gram + damping[number] * added, jacobian[number].T @ residual[number])
        np.testing.assert_allclose(steps[number], expected, rtol=0, atol=2e-5 * np.abs(expected).max())


def test_scaling_by_each_unknown_does_not_depend_on_its_unit():
    rng = np.random.default_rng(1)
    jacobian, residual, units = rng.normal(size=(1, 6, 3)), rng.normal(size=(1, 6)), np.array([1.0, 4.0, 0.25])
    plain, scaled = (
        normal_step(one, residual, np.array([0.3]), by_each_unknown) for one in (jacobian, jacobian * units)
    )
    np.testing.assert_allclose(scaled * units, plain, rtol=3e-3)
    alike = normal_step(jacobian * units, residual, np.array([0.3]), by_the_mean)
    assert np.abs(alike * units - plain).max() > 0.1 * np.abs(plain).max()


def test_an_unknown_without_effect_takes_no_step():
    jacobian = np.array([[[1.0, 0.0], [2.0, 0.0]]])
    for scaling in (by_the_mean, by_each_unknown):
        step = normal_step(jacobian, np.ones((1, 2)), np.array([1e-3]), scaling)
        assert step[0, 1] == 0.0
        assert step[0, 0] == pytest.approx(-0.6, abs=1e-2)
    assert normal_step(np.zeros((1, 2, 2)), np.ones((1, 2)), np.array([1.0]), by_the_mean).tolist() == [[0.0, 0.0]]


def test_problems_may_stand_in_rows_of_rows():
    rng = np.random.default_rng(2)
    jacobian, residual, damping = (
        rng.normal(size=(2, 4, 6, 3)),
        rng.normal(size=(2, 4, 6)),
        rng.uniform(0.1, 1.0, (2, 4)),
    )
    for scaling in (by_the_mean, by_each_unknown):
        steps = normal_step(jacobian, residual, damping, scaling)
        flat = normal_step(jacobian.reshape(8, 6, 3), residual.reshape(8, 6), damping.reshape(8), scaling)
        np.testing.assert_allclose(steps.reshape(8, 3), flat, rtol=0, atol=1e-12)


def test_what_is_added_to_the_diagonal():
    diagonal, damping = np.array([[4.0, 0.0]]), np.array([0.5])
    np.testing.assert_allclose(by_the_mean(diagonal, damping), [[1.0, 1.0]], rtol=1e-8)
    np.testing.assert_allclose(by_each_unknown(diagonal, damping), [[2.0 + 4e-6, 4e-6]], rtol=1e-12)
    assert by_the_mean(np.zeros((1, 2)), damping).min() > 0.0  # else the matrix would be singular
