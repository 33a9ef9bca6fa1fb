"""Orientations: representations, relative axes, and what is refused."""

import numpy as np
import pytest
from cranks import lines_apart, random_orientations
from hypothesis import given, strategies as st
from scipy.spatial.transform import Rotation

from graphs.errors import InvariantError, UnsolvableError
from synth.linkages.guidance.orientations import Orientations, read_orientations, unit_vector, write_orientations

seeds = st.integers(0, 2**32 - 1)


@given(seeds)
def test_representations_agree_with_scipy(seed):
    given_ = random_orientations(5, np.random.default_rng(seed))
    rotation = given_.to_rotation()
    assert np.allclose(given_.matrices, rotation.as_matrix(), atol=1e-14)
    axes, angles = given_.axis_angles()
    assert (angles >= 0).all()
    assert (angles <= np.pi).all()
    for again in (
        Orientations.from_matrices(given_.matrices),
        Orientations.from_axis_angles(7.0 * axes, angles),
        Orientations.from_rotation(rotation),
    ):
        same = np.abs((again.quaternions * given_.quaternions).sum(axis=1))
        assert np.allclose(same, 1.0, atol=1e-12)


@given(seeds)
def test_a_relative_axis_stays_where_it_is(seed):
    """M_j M_i^-1 leaves S_ij, and the body's line that lies on it is the same at both orientations."""
    given_ = random_orientations(4, np.random.default_rng(seed))
    m = given_.matrices
    every = given_.relative_axes()
    assert list(every) == given_.pairs()
    for (i, j), axis in every.items():
        assert np.allclose(m[j - 1] @ m[i - 1].T @ axis, axis, atol=1e-7)
        assert np.allclose(m[j - 1].T @ axis, m[i - 1].T @ axis, atol=1e-7)
        assert lines_apart(axis, given_.relative_axis(i, j)) < 1e-12
    assert lines_apart(given_.subset([2, 4, 1]).relative_axis(1, 2), every[2, 4]) < 1e-12


def test_no_rotation_has_an_axis_all_the_same():
    axes, angles = Orientations.from_axis_angles(np.eye(3), [0.0, 1.0, 2.0]).axis_angles()
    assert axes[0].tolist() == [0.0, 0.0, 1.0]
    assert np.allclose(angles, [0.0, 1.0, 2.0])


GOOD = np.array([[1.0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]])


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Orientations(GOOD[:2]), "2 orientations; expected 3 or more"),
        (lambda: Orientations(np.zeros((0, 4))), "0 orientations; expected 3 or more"),
        (lambda: Orientations(GOOD * [[1], [0], [1]]), "orientation 2 has a quaternion of norm 0; expected 1 to within"),
        (lambda: Orientations(GOOD * 1.01), "orientation 1 has a quaternion of norm 1.01"),
        (lambda: Orientations(GOOD * np.nan), "expected finite numbers, n by 4"),
        (lambda: Orientations(np.eye(3)), "an array of shape (3, 3)"),
        (lambda: Orientations(np.concatenate([GOOD, -GOOD[1:2]])), "orientations 2 and 4 are equal"),
        (lambda: Orientations.from_matrices([np.eye(3)] * 2), "2 orientations"),
        (lambda: Orientations.from_matrices([np.eye(3), -np.eye(3), np.eye(3)]), "orientation 2 has a matrix that is no"),
        (lambda: Orientations.from_matrices(np.zeros((3, 3, 3))), "orientation 1 has a matrix that is no rotation"),
        (lambda: Orientations.from_matrices(np.eye(3)), "an array of shape (3, 3); expected finite numbers, n by 3 by 3"),
        (lambda: Orientations.from_axis_angles(np.zeros((3, 3)), [1, 2, 3]), "the axis is zero; expected a direction"),
        (lambda: unit_vector([1, 2]), "the axis has not three finite numbers"),
        (lambda: unit_vector([1, 2, np.inf]), "the axis has not three finite numbers"),
    ],
)  # fmt: skip
def test_what_is_no_orientation_is_refused(make, message):
    with pytest.raises(InvariantError) as error:
        make()
    assert message in str(error.value)


def test_norms_are_mended_when_they_are_nearly_one():
    made = Orientations(GOOD * 1.0009)
    assert np.allclose(np.linalg.norm(made.quaternions, axis=1), 1.0)
    with pytest.raises(ValueError, match="read-only"):
        made.quaternions[0, 0] = 2.0


def test_unit_vectors_of_extreme_length():
    assert np.allclose(unit_vector([3e200, 0, 4e200]), [0.6, 0, 0.8])
    assert np.allclose(unit_vector([3e-300, 0, 4e-300]), [0.6, 0, 0.8])


def test_a_file_survives(tmp_path):
    given_ = random_orientations(7, np.random.default_rng(5))
    write_orientations(given_.quaternions, tmp_path / "a.json")
    assert np.array_equal(read_orientations(tmp_path / "a.json").quaternions, given_.quaternions)
    assert [p.name for p in tmp_path.iterdir()] == ["a.json"]


def test_thousands_of_orientations_are_read_and_their_pairs_refused():
    many = Orientations.from_rotation(Rotation.from_rotvec(np.linspace(0, 1, 2001)[:, None] * [1.0, 0.2, 0.3]))
    with pytest.raises(UnsolvableError, match="2001 orientations have too many pairs; expected 2000 at most"):
        many.relative_axes()
