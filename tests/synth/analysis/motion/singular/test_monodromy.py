"""Irreducible or not: ways to begin that are one branch, and forms that leave two components."""

import numpy as np
import pytest
from folding_patterns import triangulated

from graphs.mechanism.sheet import with_all_edges
from synth.analysis.motion.branches import branches_of
from synth.analysis.motion.linkage import linkage_of_sheet
from synth.analysis.motion.singular.monodromy import is_irreducible
from synth.catalogue.patterns.creases import fan


def test_two_vertices_of_six_creases_have_one_branch(rng):
    """Both up, or one up and one down: two ways to begin one branch of seven degrees of freedom."""
    branches = branches_of(linkage_of_sheet(with_all_edges(triangulated(2, 3, rng))))
    assert len(branches.branches) == 2
    assert (branches.count, dict(branches.kinds), branches.at_least, branches.proved) == (1, {7: 1}, False, False)
    assert len({branch.component for branch in branches.branches}) == 1


@pytest.mark.parametrize(
    ("directions", "kinds"),
    [((0, 70, 140, 200, 290), {2: 1}), ((0, 60, 170, 250), {1: 2}), ((0, 60, 120, 240, 300), {2: 1})],
)
def test_a_vertex_of_five_creases_has_one_branch_and_one_of_four_has_two(directions, kinds):
    branches = branches_of(linkage_of_sheet(fan(np.radians(directions))))
    assert (dict(branches.kinds), branches.at_least, branches.proved) == (kinds, False, True)


def test_general_forms_leave_one_component(rng):
    for count, size in ((2, 4), (2, 6), (3, 6)):
        forms = rng.normal(size=(count, size, size))
        assert is_irreducible(forms + forms.transpose(0, 2, 1))


def test_forms_with_two_components_are_told(rng):
    """Two quadrics through a common plane section: their common points are that conic and another."""
    one, other, third, fourth = rng.normal(size=(4, 4))
    plane = np.outer(one, other) + np.outer(other, one)
    again = np.outer(one, third) + np.outer(third, one)
    assert not is_irreducible(np.array([plane, again]))
    product = np.outer(third, fourth) + np.outer(fourth, third)
    general = rng.normal(size=(4, 4))
    assert not is_irreducible(np.array([product, general + general.T]))


def test_points_are_not_asked_for(rng):
    forms = rng.normal(size=(3, 4, 4))
    assert not is_irreducible(forms + forms.transpose(0, 2, 1))
