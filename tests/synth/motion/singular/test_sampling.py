"""Freedoms at a configuration to second order."""

import pytest
from sizes import slow

import synth
from synth.motion.singular.sampling import freedoms_at, most_freedoms
from synth.moving.made import configuration_of
from synth.patterns import generate
from tests.invariance.patterns import folder_of_layers


@pytest.mark.parametrize(
    ("name", "rows", "columns", "freedoms"), [("miura", 2, 2, 1), ("map", 2, 2, 1), ("map", 2, 3, None)]
)
def test_where_branches_meet_their_freedoms_are_known_if_they_are_equal(name, rows, columns, freedoms):
    """A map of 2 x 3 panels folds along one line, or along two that are parallel."""
    at = configuration_of(generate(name, rows=rows, columns=columns).mechanism)
    assert freedoms_at(at.linkage, at.closure, at.linkage.angles) == freedoms


@pytest.mark.parametrize("name", ["grids_312_brown_4x4_D52", slow("instagram_196_komatsu_Giraffe")])
def test_no_branch_has_more_freedoms_than_rates_beside_its_own(name):
    """Traced, such a branch comes to where another one meets it, with more freedoms."""
    file = folder_of_layers() / f"{name}.fold"
    if not file.is_file():
        pytest.skip(f"no crease pattern at {file}; name their folder in SYNTHEDRA_LAYERS")
    branches = configuration_of(synth.read(file)).branches.branches
    assert any(branch.freedoms is None for branch in branches)
    assert any(branch.freedoms for branch in branches)
    assert all(branch.freedoms <= most_freedoms(branch.space, branch.rates) for branch in branches if branch.freedoms)
