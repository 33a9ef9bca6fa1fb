"""Steps of least squares have no part along freedoms: rounding leads no path with several freedoms astray."""

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse

from synth.analysis.motion.tangent import TangentSpace


def with_freedoms(rows, joints, rank, weakest, chance):
    """A matrix of given rank whose least singular value is weak, and an exact basis of its kernel."""
    left = np.linalg.qr(chance.normal(size=(rows, rank)))[0]
    right = np.linalg.qr(chance.normal(size=(joints, rank)))[0]
    matrix = (left * np.geomspace(1.0, weakest, rank)) @ right.T
    return matrix, scipy.linalg.null_space(right.T)


@pytest.mark.parametrize(("rows", "joints", "rank"), [(6, 9, 5), (30, 24, 20), (90, 75, 60)])
@pytest.mark.parametrize("weakest", [1.0, 1e-2])
def test_steps_have_no_part_along_freedoms(rows, joints, rank, weakest):
    chance = np.random.default_rng((rows, joints))
    matrix, kernel = with_freedoms(rows, joints, rank, weakest, chance)
    space = TangentSpace(scipy.sparse.csr_matrix(matrix))
    wanted = matrix @ chance.normal(size=joints)
    step = space.step(-wanted)
    assert np.abs(kernel.T @ step).max() < 1e-14 * np.abs(step).max()
    by_svd = np.linalg.pinv(matrix, rcond=1e-6) @ wanted
    assert np.abs(step - by_svd).max() < 20e-9 / weakest**2 * np.abs(by_svd).max()


def test_projected_rates_keep_their_part_along_freedoms():
    chance = np.random.default_rng(1)
    matrix, kernel = with_freedoms(40, 50, 30, 0.05, chance)
    space = TangentSpace(scipy.sparse.csr_matrix(matrix))
    for _ in range(10):
        rates = chance.normal(size=50)
        assert np.abs(kernel.T @ (space.projected(rates) - rates)).max() < 1e-13
        assert np.abs(space.projected(rates) - kernel @ (kernel.T @ rates)).max() < 1e-10
