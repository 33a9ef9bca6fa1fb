"""Choices that depend on spaces and numbers alone, whatever basis or order they come in."""

import numpy as np
import pytest

from graphs.tolerances import canonical_basis, canonical_order, leading, pivots, signed, trailing


def any_basis(space, chance):
    """Another orthonormal basis of the space of some columns, with rounding of its own."""
    turn = np.linalg.qr(chance.normal(size=(space.shape[1],) * 2))[0]
    return space @ turn


@pytest.mark.parametrize(("length", "size"), [(4, 1), (6, 3), (40, 17), (200, 60)])
def test_a_canonical_basis_depends_on_the_space_alone(length, size):
    chance = np.random.default_rng((length, size))
    space = np.linalg.qr(chance.normal(size=(length, size)))[0]
    first = canonical_basis(space)
    for _ in range(5):
        other = any_basis(space, chance)
        assert np.abs(canonical_basis(other) - first).max() < 1e-12
        assert pivots(other) == pivots(space)
    assert np.abs(first.T @ first - np.eye(size)).max() < 1e-14
    assert np.abs(first @ (first.T @ space) - space).max() < 1e-13


def test_ties_of_symmetric_spaces_go_to_the_first_rows():
    """Eight joints round a ring that all move alike in pairs: noise of 1e-13 changes no pivot."""
    chance = np.random.default_rng(3)
    ring = np.kron(np.ones((2, 1)), np.eye(4)) / np.sqrt(2.0)
    for _ in range(50):
        noisy = np.linalg.qr(any_basis(ring, chance) + 1e-13 * chance.normal(size=ring.shape))[0]
        assert pivots(noisy) == [0, 1, 2, 3]
        assert np.abs(canonical_basis(noisy) - ring).max() < 1e-11


def test_of_equals_the_first_is_taken():
    chance = np.random.default_rng(4)
    for _ in range(100):
        noise = 1e-13 * chance.normal(size=4)
        assert leading(np.array([0.3, -1.0, 1.0, 0.2]) + noise) == 1
        assert trailing(np.array([0.3, -1.0, 1.0, -1.0]) + noise) == 1
        assert signed(np.array([0.0, -1.0, 1.0, -1.0]) + noise)[1] > 0.0


def test_an_order_of_vectors_does_not_see_noise():
    chance = np.random.default_rng(5)
    vectors = [np.array(row, dtype=float) for row in ([1, 0, 2], [0, 3, 1], [1, 0, 1], [0, 3, 1])]
    for _ in range(50):
        assert canonical_order([one + 1e-13 * chance.normal(size=3) for one in vectors]) == [1, 3, 2, 0]
