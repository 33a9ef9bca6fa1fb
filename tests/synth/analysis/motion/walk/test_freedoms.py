"""Joints that drive a linkage, one for each freedom: they are independent, and say where all others go."""

import numpy as np
import pytest
from sizes import first_quick

from graphs.files.formats import read
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.motion.walk.events import free_rates, independent_joints, number_of_free_rates


@pytest.fixture(scope="module")
def bird_base(data):
    return configuration_of_sheet(read(data / "patterns" / "bird-base.fold"))


@pytest.fixture(scope="module")
def general_configuration(bird_base):
    """A pose of a branch on which all twenty creases fold."""
    return next(branch for branch in bird_base.branches.branches if not branch.immobile).sample


def test_rates_are_those_of_the_dense_matrix(bird_base, general_configuration):
    angles = general_configuration
    basis = free_rates(bird_base.closure, angles)
    jacobian = bird_base.closure.at(angles)[1].toarray()
    assert basis.shape[1] == len(angles) - np.linalg.matrix_rank(jacobian, tol=1e-7)
    assert number_of_free_rates(bird_base.closure, angles) == basis.shape[1]
    assert np.abs(jacobian @ basis).max() < 1e-9
    np.testing.assert_allclose(basis.T @ basis, np.eye(basis.shape[1]), atol=1e-12)


@pytest.mark.parametrize("first", first_quick(3, range(0, 20, 3)))
def test_a_joint_for_each_freedom_the_wanted_one_first(bird_base, general_configuration, first):
    basis = free_rates(bird_base.closure, general_configuration)
    joints = independent_joints(basis, first)
    assert joints[0] == first
    assert len(set(joints)) == len(joints) == basis.shape[1] == 5
    assert np.linalg.svd(basis[joints], compute_uv=False).min() > 0.05


def test_joints_that_cannot_move_drive_nothing():
    basis = np.array([[0.0], [1.0], [0.0]])
    assert independent_joints(basis, 0) == [1]
    assert independent_joints(np.zeros((3, 0)), 0) == []
