"""Flat-foldable quadrilaterals in closed form: they fold rigidly whatever the numbers, and curve as wished."""

from dataclasses import replace

import numpy as np
import pytest

from graphs.errors import InvariantError, UnsolvableError
from synth.analysis.folding.motion import fold
from synth.synthesis.designing.quadrilaterals import (
    cell_curvatures,
    curved_sheet,
    folded,
    marched,
    miura_sides,
    sheet_of_sides,
)


def varied(rng, rows=4, columns=6, by=0.05):
    sides = miura_sides(rows, columns, 1.2, 1.0, 1.0, 2.0)
    return sides.at(sides.numbers + by * rng.normal(size=sides.numbers.size))


@pytest.mark.parametrize("tangent", [0.1, 2.0, 40.0])
def test_any_numbers_of_the_sides_fold_rigidly(rng, tangent):
    sides = varied(rng)
    numbers = sides.numbers
    numbers[-1] = tangent
    flat, places = marched(sides)[0], folded(sides.at(numbers))
    for step in (np.s_[1:, :], np.s_[:-1, :]), (np.s_[:, 1:], np.s_[:, :-1]), (np.s_[1:, 1:], np.s_[:-1, :-1]):
        before, after = (np.linalg.norm(at[step[0]] - at[step[1]], axis=2) for at in (flat, places))
        np.testing.assert_allclose(after, before, atol=1e-13)
    other = [np.linalg.norm(at[1:, :-1] - at[:-1, 1:], axis=2) for at in (flat, places)]
    np.testing.assert_allclose(*other, atol=1e-13)  # both diagonals: panels stay planar


def test_the_verdict_says_the_same(rng):
    motion = fold(sheet_of_sides(varied(rng, 3, 4)), frames=3)
    assert motion.freedoms == 1
    assert motion.closure < 1e-12
    assert np.abs(motion.path.angles[-1]).min() > 1e-3


def test_curvatures_have_exact_derivatives(rng):
    sides = varied(rng)
    along = rng.normal(size=sides.numbers.size)

    def curvatures(numbers):
        return np.concatenate([part.ravel() for part in cell_curvatures(folded(sides.at(numbers)))])

    exact = curvatures(sides.numbers + 1e-40j * along).imag / 1e-40
    coarse, fine = (
        (curvatures(sides.numbers + h * along) - curvatures(sides.numbers - h * along)) / (2 * h) for h in (2e-4, 1e-4)
    )
    np.testing.assert_allclose(exact, (4 * fine - coarse) / 3, atol=1e-6 * np.abs(exact).max())


def test_many_sheets_at_once_are_those_one_by_one(rng):
    one, other = varied(rng), varied(rng)
    both = folded(one.at(np.stack([one.numbers, other.numbers], axis=1)))
    np.testing.assert_allclose(both[..., 0], folded(one), atol=1e-13)
    np.testing.assert_allclose(both[..., 1], folded(other), atol=1e-13)
    with pytest.raises(InvariantError, match="one sheet"):
        sheet_of_sides(one.at(np.stack([one.numbers, other.numbers], axis=1)))


def test_cell_curvatures_of_a_sphere():
    x, y = np.meshgrid(*[np.linspace(-0.05, 0.05, 9)] * 2)
    gaussian, mean = cell_curvatures(np.stack([x, y, np.sqrt(4.0 - x**2 - y**2)], axis=2))
    np.testing.assert_allclose(gaussian, 0.25, rtol=1e-2)
    np.testing.assert_allclose(mean, -0.5, rtol=1e-2)


def alternating(turn, growth):
    """A Miura sheet of 8 x 8 panels whose corners change along rows, in turn up and down, and heights along columns."""
    sides = miura_sides(8, 8, 1.2, 1.0, 1.0, 4.0)
    change, first = turn * np.arange(9) / 8, 0.0 * np.arange(9)
    heights = sides.heights.copy()
    heights[1::2] += growth * np.arange(4) / 4
    left, lower = sides.left + np.stack([first, first]), sides.lower + np.stack([change[1:], -change[1:]])
    return replace(sides, left=left, lower=lower, heights=heights)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_sheet_takes_the_curvatures_that_are_wished(sign):
    first = alternating(0.2, 0.4 * sign)
    gaussian, mean = cell_curvatures(folded(first))
    product, half = float(gaussian.mean()), float(mean.mean())
    root = np.sqrt(half**2 - product)
    sheet = curved_sheet(first, (half + root, half - root))
    assert np.abs(sheet.gaussian - product).max() < np.abs(gaussian - product).max() / 5
    assert np.abs(sheet.mean - half).max() < np.abs(mean - half).max() / 2
    assert np.sign(product) == sign
    assert len(sheet_of_sides(sheet.sides).faces) == 64


def test_sides_that_cannot_be_continued_are_refused(rng):
    with pytest.raises(UnsolvableError, match="not convex"):
        sheet_of_sides(varied(rng, by=0.8))
