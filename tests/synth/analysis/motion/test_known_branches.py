"""Known crease patterns and strips: how many branches, of how many freedoms, from flat and from folded."""

from collections import Counter
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from folding_patterns import frog_base, pleated_hypar, triangulated
from scipy.optimize import least_squares

from graphs.convert.duality import mechanism_of_sheet, opened
from graphs.files.formats import read
from graphs.mechanism.sheet import with_all_edges
from synth.analysis.folding.motion import fold
from synth.analysis.motion.branches import Search, branches_of
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import linkage_of_sheet, moved
from synth.analysis.motion.singular.sampling import followed, general_rates, same_part
from synth.analysis.motion.singular.second_order import all_quadrics, largest_only, local_forms, rates_at, spaces_within
from synth.catalogue.patterns.cartons import box_pop_up
from synth.catalogue.patterns.creases import fan, kresling, map_sheet, miura, miura_tube


def linkage(sheet):
    sheet = with_all_edges(sheet)
    return linkage_of_sheet(opened(sheet, mechanism_of_sheet(sheet)))


def freedoms(found):
    return sorted(branch.freedoms for branch in found.branches)


@pytest.mark.parametrize(("rows", "columns"), [(2, 3), (3, 4), pytest.param(7, 5, marks=pytest.mark.slow)])
def test_a_map_folds_along_its_rows_or_its_columns(rows, columns):
    found = branches_of(linkage(map_sheet(rows, columns)))
    assert freedoms(found) == sorted([rows - 1, columns - 1])
    assert found.exhaustive
    assert found.method == "all modes"
    across = [set(branch.immobile) for branch in found.branches]
    assert not across[0] & across[1]  # each crease folds on one of them


def test_concentric_squares_fold_along_one_diagonal():
    creased = linkage(pleated_hypar(3, middle_creased=True))
    found = branches_of(creased)
    assert freedoms(found) == [1, 1]
    assert found.exhaustive
    assert [len(creased.angles) - len(branch.immobile) for branch in found.branches] == [8, 8]
    whole = branches_of(linkage(pleated_hypar(3, middle_creased=False)))
    assert (whole.branches, whole.exhaustive, whole.no_motion) == ((), True, "proved")


@pytest.mark.parametrize(("directions", "expected"), [((0, 45, 135, 180, 225, 315), 3), (range(0, 360, 45), 5)])
def test_waterbomb_and_preliminary_base(directions, expected):
    start = linkage(fan(np.radians(directions)))
    found = branches_of(start)
    assert freedoms(found) == [expected]
    assert (found.exhaustive, found.method) == (True, "second order")
    folded = branches_of(moved(start, found.branches[0].sample))
    assert (freedoms(folded), folded.method) == ([expected], "regular pose")
    assert folded.branches[0].certainty == "proved"


def test_a_frog_base_has_five_freedoms_each_way():
    """Its idle creases lie in planes while others fold: their closure equations are squares."""
    found = branches_of(linkage(frog_base()), search=Search(most=3))
    assert freedoms(found) == [5, 5, 5]
    assert not found.complete
    assert max(branch.error for branch in found.branches) < 1e-12
    assert min(branch.followed for branch in found.branches) > np.radians(9.99)


@pytest.mark.slow
def test_a_frog_base_has_625_ways():
    """Each of four petals is immobile (one way) or folds with its two ears in either mode of each (four ways)."""
    start = linkage(frog_base())
    closure = ClosureEquations(start)
    tangent = rates_at(closure, start.angles)
    spaces = largest_only(list(spaces_within(tangent, all_quadrics(start, tangent))))
    assert Counter((space.basis.shape[1], len(space.left)) for space in spaces) == {(6, 1): 5**4}
    for space in spaces[::25]:
        [rates], _ = general_rates(space, 1)
        immobile = np.flatnonzero(np.abs(space.basis).max(axis=1) < 1e-7)
        came = followed(start, closure, rates / np.abs(rates).max(), tuple(immobile.tolist()))
        assert (came.freedoms, came.error < 1e-12) == (5, True)


def test_a_box_pops_up_in_two_ways():
    found = branches_of(linkage(box_pop_up()))
    assert freedoms(found) == [1, 1]
    assert {branch.certainty for branch in found.branches} == {"proved"}


@pytest.mark.parametrize("sides", [3, 4, 6, pytest.param(12, marks=pytest.mark.slow)])
def test_one_storey_of_kresling(sides):
    """A strip of 2 n triangles closes with six equations; a polygon that is a panel makes it rigid."""
    found = branches_of(linkage(kresling(sides, ends=0)))
    assert freedoms(found) == ([2 * sides - 6] if sides > 3 else [])
    assert sides == 3 or found.branches[0].certainty == "proved"
    for ends in (1, 2):
        closed = branches_of(linkage(kresling(sides, ends=ends)))
        assert (closed.branches, closed.no_motion, closed.rigidity.proof) == ((), "proved", "no rates")


def test_the_square_twist_folds_with_two_vertices_in_either_mode(data):
    """Modes are found here from the plane: in one the first crease and the third fold alike, the others not."""
    twist = linkage(read(data / "wiener" / "square-twist.fold"))
    found = branches_of(twist)
    expected = 0
    for choice in product((0, 1), repeat=len(twist.loops)):
        equations = []
        for loop, alike in zip(twist.loops, choice, strict=True):
            joints = list(loop.joints)
            across = np.zeros((2, len(twist.angles)))
            across[0, joints[alike]], across[0, joints[alike + 2]] = 1, -1
            across[1, joints[1 - alike]], across[1, joints[3 - alike]] = 1, 1
            closing = np.zeros((3, len(twist.angles)))
            closing[:, joints] = twist.directions[joints].T * loop.signs
            equations += [across, closing]
        values, right = np.linalg.svd(np.concatenate(equations))[1:]
        folds = values[-1] < 1e-9 and np.abs(right[-1]).min() > 1e-6
        expected += folds
        pairs = tuple(tuple(sorted(loop.joints[a::2])) for loop, a in zip(twist.loops, choice, strict=True))
        assert folds == (pairs in {branch.modes for branch in found.branches})
    assert len(found.branches) == expected == 6
    assert freedoms(found) == [1] * 6
    assert found.exhaustive


def solved(forms, start):
    """Return a unit vector at which quadratic forms vanish, near a start, by least squares; None if there is none."""
    found = least_squares(
        lambda x: [*(forms @ x @ x), x @ x - 1.0],
        start / np.linalg.norm(start),
        lambda x: np.concatenate([2.0 * forms @ x, 2.0 * x[None]]),
        xtol=1e-15,
        ftol=1e-15,
        gtol=1e-15,
    )
    return found.x if np.abs(found.fun).max() < 1e-10 else None


@pytest.mark.parametrize(
    "sheet",
    [miura(4, 4, np.radians(55)), map_sheet(3, 3), "bird-base.fold", pytest.param(frog_base(), marks=pytest.mark.slow)],
)
def test_random_rates_that_agree_to_second_order_are_on_the_spaces(sheet, data, rng):
    """Newton's method from random rates, without a choice of modes, comes to no rates that the choices miss."""
    start = linkage(read(data / "patterns" / sheet) if isinstance(sheet, str) else sheet)
    closure = ClosureEquations(start)
    tangent = rates_at(closure, start.angles)
    quadrics = all_quadrics(start, tangent)
    spaces = largest_only(list(spaces_within(tangent, quadrics)))
    forms = local_forms(tangent, quadrics)
    seen = set()
    for _ in range(8):
        x = solved(forms, rng.normal(size=tangent.shape[1]))
        if x is None:
            continue
        off = [np.linalg.norm(x - space @ (space.T @ x)) for space in (tangent.T @ one.basis for one in spaces)]
        assert min(off) < 1e-4  # where two spaces meet Newton's method is slow
        seen.add(int(np.argmin(off)))
    assert len(seen) > 1


def test_sheets_with_more_branches_than_are_told_fold_as_they_are_marked():
    """The branch that the marks begin is told although the search ends before it comes to it."""
    start = linkage(miura(5, 3, np.radians(60)))
    every = branches_of(start).branches
    assert len(every) == 16
    unseen = {one.signs for one in every} - {one.signs for one in branches_of(start, search=Search(most=2)).branches}
    for wanted in [one for one in every if one.signs in unseen][-3:]:
        found = branches_of(start, search=Search(most=2, towards=wanted.rates))
        assert (len(found.branches), found.complete, found.exhaustive) == (3, False, False)
        [near] = [one for one in found.branches if one.signs == wanted.signs]
        assert (near.freedoms, near.certainty) == (wanted.freedoms, "proved")


def test_vertices_pop_up_or_down_each(rng):
    """Of two vertices with six creases: alike or not. The part near to what is wanted is among them in any case."""
    sheet = triangulated(2, 3, rng)
    start = linkage(sheet)
    found = branches_of(start)
    assert freedoms(found) == [7, 7]  # 13 creases, two vertices
    assert (found.method, found.exhaustive, found.complete) == ("random starts", False, True)
    assert not same_part(found.branches[0].space, *(branch.rates for branch in found.branches))
    for wanted in found.branches:
        first = branches_of(start, search=Search(most=1, towards=wanted.rates))
        assert any(same_part(wanted.space, one.rates, wanted.rates) for one in first.branches)
        assert not first.complete
        given = with_all_edges(sheet)
        joint = dict(enumerate(start.graph.joints))
        marks = {joint[place]: "MV"[int(rate > 0)] for place, rate in enumerate(wanted.rates)}
        letters = "".join(marks.get(edge, letter) for edge, letter in enumerate(given.assignments))
        taken = fold(replace(given, assignments=letters), frames=1)
        assert same_part(wanted.space, taken.branches.branches[taken.branch].rates, wanted.rates)


@pytest.mark.parametrize("columns", [1, 3])
def test_tubes_of_miura_strips_have_one_freedom(columns):
    """A closed strip has more equations than joints, and moves all the same."""
    found = branches_of(linkage(miura_tube(columns, 1.1, 0.6)))
    assert freedoms(found) == [1]
    assert found.branches[0].immobile == ()
    assert found.branches[0].error < 1e-12


def test_a_search_that_uses_up_its_work_says_so():
    found = branches_of(linkage(miura(5, 5, np.radians(60))), search=Search(work=0.0))
    assert not found.complete
    assert not found.exhaustive
    assert found.no_motion == "not known"


@pytest.mark.parametrize("size", [5, pytest.param(12, marks=pytest.mark.slow)])
def test_large_miura_sheets_have_one_freedom_as_they_are_marked(size):
    sheet = miura(size, size, np.radians(60))
    folded = fold(sheet, frames=1)
    assert folded.freedoms == 1
    assert folded.branches.branches[folded.branch].certainty == "proved"
    midway = branches_of(moved(folded.linkage, folded.path.angles[-1]))
    assert freedoms(midway) == [1]


def test_equations_are_parts_of_their_size():
    start = linkage(miura(2, 2, np.radians(60)))
    tangent = rates_at(ClosureEquations(start), start.angles)
    forms = local_forms(tangent, all_quadrics(start, tangent))
    assert forms.shape == (1, 2, 2)
    values = np.linalg.eigvalsh(forms[0])
    assert values[0] < 0 < values[1]
