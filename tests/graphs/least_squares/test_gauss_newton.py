"""Shortest steps to where equations hold, and each reason to stop."""

from dataclasses import dataclass

import numpy as np
import pytest

from graphs.least_squares.gauss_newton import GaussNewton, find_root
from graphs.least_squares.steps import minimum_norm_step
from graphs.least_squares.stop_reason import StopReason


@dataclass
class Sphere:
    """A point that is to lie on the unit sphere, and on a plane through its middle."""

    x: np.ndarray

    @property
    def _residual(self):
        return np.array([self.x @ self.x - 1.0, self.x.sum()])

    @property
    def error(self):
        return float(np.abs(self._residual).max())

    def onwards(self):
        jacobian = np.stack([2.0 * self.x, np.ones(len(self.x))])
        return Sphere(self.x + minimum_norm_step(jacobian, self._residual))


def test_steps_lead_to_the_nearest_root_of_linear_equations_and_near_it_of_curved_ones():
    start = np.array([1.0, -0.2, 0.3, 0.1])
    found = find_root(Sphere(start), GaussNewton(most_steps=20))
    assert found.reason is StopReason.SOLVED
    assert found.at.error <= 1e-14
    flat = start - start.mean()
    np.testing.assert_allclose(found.at.x, flat / np.linalg.norm(flat), rtol=0, atol=1e-12)  # by symmetry
    assert found.steps <= 6


@dataclass
class Listed:
    """Iterates with the errors of a list."""

    errors: list
    at: int = 0

    @property
    def error(self):
        return self.errors[self.at]

    def onwards(self):
        return Listed(self.errors, self.at + 1) if self.at + 1 < len(self.errors) else None


@pytest.mark.parametrize(
    ("errors", "rule", "reason", "best", "steps"),
    [
        ([1.0, 1e-2, 1e-15], GaussNewton(most_steps=5), StopReason.SOLVED, 2, 2),
        ([1e-14], GaussNewton(most_steps=5), StopReason.SOLVED, 0, 0),
        ([1.0, 1e-2, 1e-15], GaussNewton(most_steps=2), StopReason.SOLVED, 2, 2),
        ([1.0, 1e-2, 1e-15], GaussNewton(most_steps=1), StopReason.STEPS, 1, 1),
        ([1.0, 1e-2, 1e-3], GaussNewton(most_steps=5, solved=1e-2), StopReason.SOLVED, 1, 1),
        ([1.0, 0.5, 0.7], GaussNewton(most_steps=5), StopReason.UNDEFINED, 1, 2),
        ([1.0, 0.5, 0.7, 0.6], GaussNewton(most_steps=3), StopReason.STEPS, 1, 3),
        # slow: more than 0.7 of the least so far; what comes between begins the count anew
        ([1.0, 0.8, 0.75, 0.7], GaussNewton(most_steps=9, slow=0.7, patience=2), StopReason.STALLED, 2, 2),
        (
            [1.0, 0.7, 0.6, 0.2, 0.19, 0.18, 0.0],
            GaussNewton(most_steps=9, slow=0.7, patience=2),
            StopReason.STALLED,
            5,
            5,
        ),
        (
            [1.0, 0.7, 0.6, 0.2, 0.19, 0.18, 0.0],
            GaussNewton(most_steps=9, slow=0.7, patience=3),
            StopReason.SOLVED,
            6,
            6,
        ),
        ([1.0, 1.0, 1.0], GaussNewton(most_steps=9, patience=1), StopReason.UNDEFINED, 0, 2),
        ([1.0, np.nan, 0.5], GaussNewton(most_steps=2), StopReason.STEPS, 2, 2),
    ],
)
def test_each_reason_to_stop_is_reached(errors, rule, reason, best, steps):
    found = find_root(Listed(errors), rule)
    assert (found.reason, found.at.at, found.steps) == (reason, best, steps)


def test_an_allowance_ends_the_search_before_the_step_that_it_refuses():
    left = iter([True, False])
    found = find_root(Listed([1.0, 0.5, 0.2]), GaussNewton(most_steps=9), may_step=lambda: next(left))
    assert (found.reason, found.at.at, found.steps) == (StopReason.ALLOWANCE, 1, 1)
