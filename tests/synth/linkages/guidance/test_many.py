"""Dyads of many sets of five orientations are those of each set; sets without an answer say why."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from graphs.errors import InvariantError, SynthedraError
from synth.linkages.guidance import Orientations, dyad_tables, dyads_of_five, dyads_of_sets, guiding_dyads


def check(matrices):
    table = dyads_of_sets(matrices)
    for number, rows in enumerate(matrices):
        try:
            dyads = dyads_of_five(Orientations.from_matrices(rows)).dyads
        except SynthedraError as error:
            assert (table.count[number], table.why[number]) == (-1, str(error))
            assert np.isnan(table.fixed[number]).all()
            continue
        count = table.count[number]
        assert count == len(dyads)
        for place, dyad in enumerate(dyads):
            np.testing.assert_allclose(table.fixed[number, place], dyad.fixed, atol=1e-9)
            np.testing.assert_allclose(table.moving[number, place], dyad.moving, atol=1e-9)
            assert table.link_angle[number, place] == pytest.approx(dyad.link_angle, abs=1e-9)
            assert table.misfit[number, place] == pytest.approx(dyad.misfit, abs=1e-12)
            assert table.residual[number, place] <= 1e-12
            assert {1: "ccw", -1: "cw", 0: None}[int(table.direction[number, place])] == dyad.direction
        assert np.isnan(table.fixed[number, count:]).all()
    return table


def test_sets_at_random_and_a_motion_with_errors():
    rng = np.random.default_rng(7)
    anyhow = Rotation.random(5 * 30, random_state=7).as_matrix().reshape(30, 5, 3, 3)
    angles = np.array([(0, 0), (40, 10), (70, 60), (120, 100), (200, 170)]) + rng.normal(scale=2.0, size=(20, 5, 2))
    near = Rotation.from_euler("ZX", angles.reshape(-1, 2), degrees=True).as_matrix().reshape(20, 5, 3, 3)
    table = check(np.concatenate([anyhow, near]))
    assert {0, 2, 4, 6} >= set(table.count.tolist())
    assert dyad_tables._solved(anyhow)[3].mean() > 0.9
    assert guiding_dyads(near).count.tolist() == table.count[30:].tolist()
    assert "50 sets of 5 orientations" in str(table)
    told = table.to_json()
    assert [len(rows) for rows in told["fixed"]] == table.count.tolist()


def test_sets_without_an_answer():
    """Turns about one axis have infinitely many dyads, equal orientations are refused, small turns are solved."""
    spins = Rotation.from_rotvec(np.outer([0.0, 0.4, 0.9, 1.7, 2.4], [0, 0, 1.0])).as_matrix()
    some = Rotation.random(5, random_state=1).as_matrix()
    equal = some[[0, 1, 2, 3, 3]]
    small = Rotation.from_rotvec(1e-4 * np.random.default_rng(2).normal(size=(5, 3))).as_matrix()
    table = check(np.array([spins, some, equal, small]))
    assert sorted(table.why) == [0, 2]


def test_what_are_no_rotations_is_refused():
    with pytest.raises(InvariantError, match=r"an array of shape \(5, 3, 3\)"):
        dyads_of_sets(np.zeros((5, 3, 3)))
    with pytest.raises(InvariantError, match="set 1 has a matrix that is no rotation"):
        dyads_of_sets([[np.eye(3)] * 5, [-np.eye(3)] * 5])
    assert len(dyads_of_sets(np.zeros((0, 5, 3, 3)))) == 0
