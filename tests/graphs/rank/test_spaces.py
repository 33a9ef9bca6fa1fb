"""Rank, kernel and cokernel of real matrices: one decision, canonical bases."""

import numpy as np
import pytest
import scipy.linalg

from graphs.rank.singular_values import (
    inertia,
    judged_at,
    null_space,
    rank_of,
    row_space,
    singular_values,
    spectra,
    split,
)
from graphs.tolerances import DOUBLE

RANDOM = np.random.default_rng(0)


def of_rank(rows, columns, rank, scale=1.0):
    return scale * RANDOM.normal(size=(rows, rank)) @ RANDOM.normal(size=(rank, columns))


@pytest.mark.parametrize("shape", [(3, 7), (7, 3), (5, 5), (0, 4), (4, 0)])
@pytest.mark.parametrize("scale", [1.0, 1e40, 1e-40])
def test_the_parts_of_a_matrix(shape, scale):
    rank = min(2, *shape)
    matrix = of_rank(*shape, rank, scale)
    parts = split(matrix)
    assert parts.rank == rank_of(matrix) == rank
    assert parts.evidence.rank == rank
    assert parts.kernel.shape == (shape[1], shape[1] - rank)
    assert parts.cokernel.shape == (shape[0], shape[0] - rank)
    assert matrix @ parts.kernel == pytest.approx(0.0, abs=1e-13 * scale)
    assert parts.cokernel.T @ matrix == pytest.approx(0.0, abs=1e-13 * scale)
    assert null_space(matrix) == pytest.approx(parts.kernel)
    both = np.hstack([row_space(matrix), parts.kernel])
    assert both.T @ both == pytest.approx(np.eye(shape[1]))


def test_a_kernel_depends_on_its_space_alone():
    matrix = of_rank(4, 9, 3)
    mixed = scipy.linalg.qr(RANDOM.normal(size=(4, 4)))[0] @ matrix
    assert null_space(mixed) == pytest.approx(null_space(matrix), abs=1e-12)
    assert row_space(mixed) == pytest.approx(row_space(matrix), abs=1e-12)


@pytest.mark.parametrize("zero", [DOUBLE.zero, 1e-6, 3e-3])
def test_values_about_zero_are_counted_as_scipy_counts_them(zero):
    for part in (0.5 * zero, 1.5 * zero, 100.0 * zero):
        matrix = np.diag([2.0, 1.0, 2.0 * part])
        expected = scipy.linalg.null_space(matrix, rcond=zero).shape[1]
        assert null_space(matrix, zero).shape[1] == expected == 3 - split(matrix, zero).rank


def test_what_is_not_told_from_zero_is_counted_and_said():
    parts = split(np.diag([1.0, 2e-9]))
    assert parts.rank == 2
    assert parts.evidence.rank is None
    assert parts.evidence.certainty == "indeterminate"


def test_zeros_have_no_rank():
    parts = split(np.zeros((2, 3)))
    assert (parts.rank, parts.evidence.rank) == (0, 0)
    assert parts.kernel.tolist() == np.eye(3).tolist()


def test_inertia_of_many_forms():
    turn = scipy.linalg.qr(RANDOM.normal(size=(4, 4)))[0]
    forms = np.stack([turn @ np.diag(values) @ turn.T for values in ([1, -2, 0, 3], [0, 0, 0, 0], [1, 1e-12, 2, 1])])
    found = inertia(forms)
    assert found.positive.tolist() == [2, 0, 3]
    assert found.negative.tolist() == [1, 0, 0]
    assert inertia(forms * 1e-40).signs[0].tolist() == [-1, 0, 1, 1]


def test_singular_values_of_a_stack():
    stack = RANDOM.normal(size=(3, 2, 4))
    assert singular_values(stack)[1] == pytest.approx(scipy.linalg.svdvals(stack[1]))


def test_values_a_little_above_zero_are_undecided():
    assert [judged_at(np.array(values), 1e-9).rank for values in ([2.0, 1.0, 1e-10], [1.0, 2e-9])] == [2, None]
    matrices = np.array([[[2.0, 0.0], [2.0, 1e-17]]])
    assert spectra(matrices, 1e-12, 1e-3).verdict.noise.tolist() == [[False, True]]
