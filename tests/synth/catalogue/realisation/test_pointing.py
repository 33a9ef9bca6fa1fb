"""How far creases are off their centres: derivatives are those of differences, infinite centres too."""

import numpy as np
import pytest

from graphs.identity.drawings import mechanism_from_map_id
from synth.catalogue.realisation.drawing import barycentric_start, centre_residual, first_unknowns
from synth.catalogue.realisation.pattern import pattern_of

RING = "m1:a--b-.a-c-.b-d-.c-d-"
TWO_RINGS = "m1:a-b-.a-c-.bd-e-.c-e-f.d-g-.f-g-"


@pytest.mark.parametrize("code", [RING, RING + ";i", TWO_RINGS])
def test_derivatives_are_those_of_differences_where_nothing_is_off(code):
    pattern = pattern_of(mechanism_from_map_id(code))
    unknowns = first_unknowns(pattern, *barycentric_start(pattern, np.random.default_rng(1)))
    for _ in range(30):
        off, by = centre_residual(pattern, unknowns)
        unknowns = unknowns - (np.linalg.pinv(by) @ off).reshape(unknowns.shape)
    assert np.abs(centre_residual(pattern, unknowns)[0]).max() < 1e-12
    step = 1e-6 * np.random.default_rng(2).standard_normal(unknowns.shape)
    ahead, behind = (centre_residual(pattern, unknowns + sign * step)[0] for sign in (1, -1))
    _, by = centre_residual(pattern, unknowns)
    assert (ahead - behind) / 2e-6 == pytest.approx(by @ step.ravel() / 1e-6, abs=1e-6)
