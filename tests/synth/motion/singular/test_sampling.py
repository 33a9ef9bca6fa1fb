"""Freedoms at a configuration to second order."""

import pytest

from synth.motion.singular.sampling import freedoms_at
from synth.moving.made import configuration_of
from synth.patterns import generate


@pytest.mark.parametrize(
    ("name", "rows", "columns", "freedoms"), [("miura", 2, 2, 1), ("map", 2, 2, 1), ("map", 2, 3, None)]
)
def test_where_branches_meet_their_freedoms_are_known_if_they_are_equal(name, rows, columns, freedoms):
    """A map of 2 x 3 panels folds along one line, or along two that are parallel."""
    at = configuration_of(generate(name, rows=rows, columns=columns).mechanism)
    assert freedoms_at(at.linkage, at.closure, at.linkage.angles) == freedoms
