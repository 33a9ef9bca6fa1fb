"""Spaces of rates near to wanted ones, of linkages too large for all of them: against all of them."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest
from folding_patterns import spoked_cube
from sizes import slow

from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE, Tolerances
from synth.analysis.motion import branches as branches_module, configuration as configurations
from synth.analysis.motion.branches import MOST_JOINTS, all_branches_of_many, branches_of
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import linkage_of_axes, linkage_of_sheet
from synth.analysis.motion.singular import joint_order, motion_near_rates, second_order
from synth.analysis.motion.singular.motion_near_rates import begun_near, spaces_near
from synth.analysis.motion.singular.second_order import (
    _quadrics_of_loop,
    largest_only,
    quadrics_of,
    rates_at,
    rates_near,
    spaces_within,
)
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.verdict._mobility import mobility
from synth.analysis.verdict.verdict import AsWritten
from synth.catalogue.patterns import generate
from synth.catalogue.patterns.creases import fan, map_sheet, miura


def posed(sheet):
    linkage = linkage_of_sheet(sheet)
    return linkage, ClosureEquations(linkage), quadrics_of(linkage)


def projectors(spaces):
    return [space.basis @ space.basis.T for space in spaces]


def bent(sheet, by=0.05):
    """A sheet whose vertices are somewhere near, written in full: no geometry of it is special."""
    places = np.array(sheet.coordinates) + np.random.default_rng(1).uniform(-by, by, (sheet.vertices, 2))
    return replace(sheet, coordinates=tuple(map(tuple, places.tolist())))


@pytest.mark.parametrize("sheet", [miura(4, 4, 1.0), map_sheet(4, 3), fan(np.radians([0, 60, 180, 300]))])
def test_all_spaces_are_those_of_the_search_of_all(sheet):
    linkage, closure, quadrics = posed(sheet)
    tangent = rates_at(closure, linkage.angles)
    every = projectors(largest_only(list(spaces_within(tangent, quadrics))))
    wanted = np.random.default_rng(3).normal(size=closure.joints)
    near = projectors(largest_only([space for space in spaces_near(tangent, quadrics, wanted) if space is not None]))
    assert len(near) == len(every)
    for one in near:
        assert min(np.abs(one - other).max() for other in every) < 1e-9


def test_the_space_that_holds_the_wanted_rates_comes_first():
    linkage, closure, quadrics = posed(miura(4, 4, 1.0))
    tangent = rates_at(closure, linkage.angles)
    for space in largest_only(list(spaces_within(tangent, quadrics))):
        wanted = space.basis.sum(axis=1)
        first = next(iter(spaces_near(tangent, quadrics, wanted)))
        assert np.abs(wanted - first.basis @ (first.basis.T @ wanted)).max() < 1e-9


def test_where_newtons_method_finds_nothing_the_nearest_space_is_taken(monkeypatch):
    """A map folds along its lines of one direction; across them all joints are immobile."""
    linkage, closure, _ = posed(map_sheet(7, 5))
    wanted = np.random.default_rng(0).choice([-1.0, 1.0], closure.joints)
    monkeypatch.setattr(motion_near_rates, "rates_near", lambda *_: None)
    begun = begun_near(closure, linkage, wanted)
    assert np.abs(closure.at(linkage.angles)[1] @ begun.rates).max() < 1e-9
    headings = np.abs(linkage.directions[np.abs(begun.rates) > 1e-7])
    assert np.ptp(headings, axis=0).max() < 1e-9
    assert not begun.rigid


@pytest.mark.parametrize("sheet", [fan(np.radians([0, 30, 70, 100])), bent(miura(4, 4, 1.0))])
def test_where_all_choices_leave_nothing_it_is_rigid(sheet):
    linkage, closure, quadrics = posed(sheet)
    assert not list(spaces_within(rates_at(closure, linkage.angles), quadrics))
    begun = begun_near(closure, linkage, np.ones(closure.joints))
    assert (begun.rates, begun.rigid) == (None, True)


@pytest.mark.parametrize(("rows", "columns", "rigid_rows"), [(5, 4, 4), slow(7, 5, 5)])
def test_large_sheets_are_judged_so(rows, columns, rigid_rows, monkeypatch):
    monkeypatch.setattr(configurations, "MOST_JOINTS", 20)
    monkeypatch.setattr(configurations, "all_branches_of_many", lambda *_: None)
    sheet = map_sheet(rows, columns)
    unmarked = "".join(letter if letter == "B" else "U" for letter in sheet.assignments)
    verdict = mobility(replace(sheet, assignments=unmarked), exact=False).verdict
    assert (verdict.freedoms, verdict.certainty) == (rows - 1, "numerical")
    assert not verdict.exhaustive
    most = rows + columns - 2
    two = f"At least 2 folding branches: 1 with {rows - 1} DOF, 1 with {columns - 1} DOF."
    assert f"{two} The freest folding branch has at least {rows - 1} and at most {most}" in verdict.text
    rigid = mobility(bent(map_sheet(rigid_rows, rigid_rows)), exact=False).verdict
    assert (rigid.freedoms, rigid.certainty, rigid.as_written) == (0, "numerical", AsWritten(0, "proved"))
    monkeypatch.undo()
    small = mobility(bent(map_sheet(rigid_rows, rigid_rows)), exact=False).verdict
    assert (small.freedoms, small.certainty) == (0, "numerical")
    assert small.text.startswith("Rigid; the nearest rigid-foldable pattern has vertices moved by up to ")


def test_a_large_sheet_begins_as_it_is_assigned(monkeypatch):
    sheet = miura(4, 4, 1.0)
    asked = "".join({"V": "+", "M": "-"}.get(letter, "") for letter in sheet.assignments)
    monkeypatch.setattr(configurations, "MOST_JOINTS", 20)
    monkeypatch.setattr(configurations, "all_branches_of_many", lambda *_: None)
    [way] = mobility(sheet, exact=False).verdict.branches
    assert way.signs == asked


def test_rates_of_rounded_coordinates_are_found_with_their_tolerance():
    """All creases of a disturbed sheet fold together only to what its coordinates can tell."""
    sheet = bent(miura(4, 4, 1.0), 5e-5)
    linkage, closure, quadrics = posed(sheet)
    marks = np.array([{"V": 1.0, "M": -1.0}[letter] for letter in sheet.assignments if letter in "VM"])
    exactly = rates_near(closure, linkage.angles, quadrics, marks)
    assert exactly is None or np.abs(exactly).min() < 1e-3
    found = rates_near(closure, linkage.angles, quadrics, marks, Tolerances.of(5e-5).zero)
    assert (found * marks > 0.1).all()


def test_newtons_method_ends_at_no_rates_where_lines_cross():
    """Of two lines at right angles one folds, or the other; a flap beside them is free."""
    corners = ((0, 0), (1, 0), (0, 1), (-1, 0), (0, -1), (2, 1))
    faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1), (1, 5, 2))
    linkage, closure, quadrics = posed(Sheet(6, (), "", faces, corners))
    together = np.ones(closure.joints)
    assert rates_near(closure, linkage.angles, quadrics, together) is None
    assert (np.abs(begun_near(closure, linkage, together).rates) > 1e-7).sum() == 3


@pytest.mark.slow
def test_a_map_of_four_hundred_panels_folds_along_its_lines():
    verdict = mobility(map_sheet(20, 20), exact=False).verdict
    assert (verdict.freedoms, verdict.certainty) == (19, "numerical")


@pytest.mark.parametrize(
    "sheet",
    [
        miura(3, 4, 1.0),
        map_sheet(3, 3),
        fan(np.radians([0, 60, 180, 300])),
        fan(np.radians([0, 50, 130, 180, 200, 290])),
    ],
)
def test_equations_of_all_loops_together_are_those_of_each(sheet):
    linkage = linkage_of_sheet(sheet)
    alone = [quadric for loop in linkage.loops for quadric in _quadrics_of_loop(linkage, loop, DOUBLE.zero)]
    together = quadrics_of(linkage)
    assert [one.joints for one in together] == [one.joints for one in alone]
    for one, other in zip(together, alone, strict=True):
        np.testing.assert_allclose(one.form, other.form, atol=1e-15)


def as_if_large(monkeypatch):
    """Have sparse factors do what full matrices do for linkages of few joints."""
    monkeypatch.setattr(second_order, "MANY", 0)
    monkeypatch.setattr(second_order, "MOST_ROWS", 0)
    monkeypatch.setattr(joint_order, "_MOST_PAIRS", 0)
    monkeypatch.setattr(branches_module, "_MOST_FOLLOWED", 100)


def linkage_of(name, **values):
    return configuration_of(generate(name, **values).mechanism).linkage


def rank_on(quadrics, basis):
    forms = second_order.local_forms(basis, quadrics)
    return np.linalg.matrix_rank(forms.reshape(len(quadrics), -1), tol=1e-8) if forms.size else 0


@pytest.mark.parametrize(
    "linkage",
    [
        linkage_of("miura", rows=3, columns=4), linkage_of("map", rows=3, columns=3), linkage_of("bennett"),
        linkage_of("miura", rows=4, columns=5, fold=radians(40)), linkage_of("3-crr"), linkage_of("goldberg"),
        linkage_of_axes(*spoked_cube()), linkage_of_sheet(bent(miura(4, 4, 1.0))),
        slow(linkage_of("miura", rows=5, columns=5)), slow(linkage_of_sheet(bent(miura(7, 7, 1.0)))),
        slow(linkage_of("kaleidocycle")), slow(linkage_of("miura", rows=9, columns=9, fold=radians(40))),
    ],
)  # fmt: skip
def test_sparse_factors_find_what_full_matrices_do(linkage, monkeypatch):
    closure = ClosureEquations(linkage)
    whole = second_order.rates_at(closure, linkage.angles)
    quadrics, branches = second_order.all_quadrics(linkage, whole), branches_of(linkage)
    as_if_large(monkeypatch)
    rates = second_order.rates_at(closure, linkage.angles)
    assert rates.shape == whole.shape
    assert np.abs(rates - whole).max(initial=0.0) < 1e-12
    sparse = second_order.all_quadrics(linkage, rates)
    assert rank_on(quadrics, whole) == rank_on(sparse, whole) == rank_on([*quadrics, *sparse], whole)
    found = all_branches_of_many(linkage, closure, np.ones(closure.joints))
    assert (found.exhaustive, found.regular, found.no_motion) == (
        branches.exhaustive, branches.regular, branches.no_motion,
    )  # fmt: skip
    assert len(found.branches) == len(branches.branches)
    for one, projector in zip(found.branches, projectors([one.space for one in found.branches]), strict=True):
        same = [
            other
            for other, its in zip(branches.branches, projectors([one.space for one in branches.branches]), strict=True)
            if np.abs(projector - its).max() < 1e-9
        ]
        assert [(other.freedoms, other.certainty, other.immobile) for other in same] == [
            (one.freedoms, one.certainty, one.immobile)
        ]


def test_the_order_of_many_joints_is_that_of_the_mechanism(monkeypatch, rng):
    """Of an irregular sheet no two joints are alike, so joints in another order are put into the same one."""
    monkeypatch.setattr(joint_order, "_MOST_PAIRS", 0)
    linkage = linkage_of_sheet(bent(miura(5, 6, 1.0), 0.02))
    shuffled = rng.permutation(len(linkage.angles))
    other = joint_order.in_order(linkage, shuffled)
    assert (shuffled[joint_order.joint_order(other)] == joint_order.joint_order(linkage)).all()


@pytest.mark.parametrize("size", [18, slow(60)])
def test_the_branch_of_a_large_folded_sheet_is_listed(size):
    at = configuration_of(generate("miura", rows=size, columns=size, fold=radians(50)).mechanism)
    assert len(at.joints) > MOST_JOINTS
    [branch] = at.branches.branches
    assert (branch.freedoms, branch.certainty, at.branches.regular, at.branches.exhaustive) == (
        1,
        "numerical",
        True,
        True,
    )
    jacobian = at.closure.at(at.linkage.angles)[1]
    assert np.abs(jacobian @ branch.rates).max() < 1e-10
    if size < 20:
        values = np.linalg.svd(jacobian.toarray(), compute_uv=False)
        assert (values < 1e-9 * values[0]).sum() == 1


@pytest.mark.slow
def test_a_large_general_sheet_is_proved_rigid():
    """All cases of its flat state leave no rates, as is so of small ones; the folded image of no vertex closes."""
    at = configuration_of(bent(miura(19, 19, 1.0), 0.02))
    assert len(at.joints) > MOST_JOINTS
    assert (at.branches.no_motion, at.branches.rigidity.proof) == ("proved", "cases")
