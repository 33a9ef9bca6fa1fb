"""Marks and the ways that begin so: against signs of random rates on the same equations."""

from itertools import product

import numpy as np
import pytest
from sizes import slow

from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.motion.assigned_branch import assigned_branch
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import linkage_of_sheet
from synth.analysis.motion.singular.second_order import rates_at
from synth.analysis.verdict._mobility import mobility
from synth.catalogue.patterns.creases import fan, miura


def random_signs(sheet, count):
    """Return the signs of rates at which the creases of one vertex close to second order, found by bisection.

    To second order the sum over i < j of r_i r_j sin(angle from i to j) vanishes; between rates at which it is
    positive and negative there are some at which it is zero.
    """
    linkage = linkage_of_sheet(sheet)
    tangent = rates_at(ClosureEquations(linkage), linkage.angles)
    headings = np.arctan2(linkage.directions[:, 1], linkage.directions[:, 0])

    turned = np.triu(np.sin(headings[None, :] - headings[:, None]), 1)

    def form(x):
        r = x @ tangent.T
        return np.einsum("ni,ij,nj->n", r, turned, r)

    chance = np.random.default_rng(7)
    low, high = chance.normal(size=(2, count, tangent.shape[1]))
    between = form(low) * form(high) < 0.0
    low, high = low[between], high[between]
    for _ in range(50):
        middle = (low + high) / 2.0
        alike = (form(middle) * form(low) > 0.0)[:, None]
        low, high = np.where(alike, middle, low), np.where(alike, high, middle)
    return set(map(tuple, np.sign(low @ tangent.T).astype(int).tolist()))


@pytest.mark.parametrize("headings", [(0, 50, 130, 200, 290), slow((0, 60, 120, 180, 240, 300)), (0, 40, 110, 250)])
def test_the_marks_that_a_vertex_can_begin_with_are_those_of_random_rates(headings):
    sheet = fan(np.radians(headings))
    pattern = configuration_of_sheet(sheet)
    possible = random_signs(sheet, 8000)
    begun = {
        signs
        for signs in product((-1, 1), repeat=len(headings))
        if assigned_branch(pattern.branches, pattern.linkage, np.array(signs, dtype=float)).marked == "has"
    }
    assert begun == possible
    assert 2 <= len(begun) < 2 ** len(headings)


def test_what_no_rates_have_is_proved_not_to_begin():
    """Valleys on one side and mountains on the other: rates along creases do not even add up to nothing."""
    pattern = configuration_of_sheet(fan(np.radians([0, 60, 120, 180, 240, 300])))
    marks = np.array([1.0, 1.0, 1.0, -1.0, -1.0, -1.0])
    assert assigned_branch(pattern.branches, pattern.linkage, marks).marked == "none has"


def test_what_was_not_found_is_not_said_to_be_impossible():
    """All valleys close to first order; to second they do not, which starts do not prove."""
    sheet = fan(np.radians([0, 60, 120, 180, 240, 300]), "VVVVVV")
    assert "but no branch with the given assignment was found" in mobility(sheet, exact=False).verdict.text


def test_of_several_ways_with_all_marks_the_freest_is_chosen():
    """Only the straight lines of a Miura sheet are marked: all ways begin so, one with three freedoms."""
    pattern = configuration_of_sheet(miura(4, 4, 1.0))
    branches = pattern.branches.branches
    three = next(number for number, branch in enumerate(branches) if branch.freedoms == 3)
    marks = np.sign(np.where(np.abs(branches[three].rates) > 1e-7, branches[three].rates, 0.0))
    way = assigned_branch(pattern.branches, pattern.linkage, marks)
    assert way.marked == "has"
    assert way.number == three
