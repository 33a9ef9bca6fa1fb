"""Freedoms at a configuration to second order."""

import pytest

import synth
from synth.analysis.motion.singular.sampling import freedoms_at, most_freedoms
from synth.analysis.moving._configuration_of import configuration_of
from synth.catalogue.patterns import generate
from tests.invariance.patterns import folder_of_layers


@pytest.mark.parametrize(
    ("name", "rows", "columns", "freedoms"), [("miura", 2, 2, 1), ("map", 2, 2, 1), ("map", 2, 3, None)]
)
def test_where_branches_meet_their_freedoms_are_known_if_they_are_equal(name, rows, columns, freedoms):
    """A map of 2 x 3 panels folds along one line, or along two that are parallel."""
    at = configuration_of(generate(name, rows=rows, columns=columns).mechanism)
    assert freedoms_at(at.linkage, at.closure, at.linkage.angles) == freedoms


@pytest.mark.slow
def test_a_branch_has_no_more_freedoms_than_there_are_rates_beside_its_own():
    """Traced, it comes to where it meets branches with more; all spaces of rates are known here."""
    file = folder_of_layers() / "grids_124_brown_4x4_A102.fold"
    if not file.is_file():
        pytest.skip(f"no crease pattern at {file}; name their folder in SYNTHEDRA_LAYERS")
    at = configuration_of(synth.read(file))
    for branch in at.branches.branches:
        assert freedoms_at(at.linkage, at.closure, branch.sample) > most_freedoms(branch.space, branch.rates)
        assert branch.freedoms is None
