"""All solutions of the second-order equations: certified points, eliminated points, joints that are immobile."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from branch_sheets import branches_by_brute_force, free_vertices, triangulated_square

from graphs.files.formats import read
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.motion.branches import branches_of, search_for
from synth.analysis.motion.linkage import linkage_of_sheet
from synth.analysis.motion.singular.certificate import FormBalls, all_distinct
from synth.analysis.motion.singular.complete import has_points_only
from synth.analysis.motion.singular.elimination import real_points
from synth.analysis.motion.singular.homotopy import path_ends
from synth.analysis.motion.singular.immobile import immobile_joints
from synth.analysis.motion.singular.second_order import RateSpace
from synth.analysis.verdict._mobility import mobility

CASES = Path(__file__).resolve().parents[4] / "support" / "branches"


def branches_from_flat(sheet):
    linkage = linkage_of_sheet(sheet)
    joints = len(linkage.angles)
    return branches_of(linkage, search=search_for(joints, np.ones(joints)))


def squares(inner, seeds):
    for seed in seeds:
        rng = np.random.default_rng((inner, seed))
        yield triangulated_square(inner, rng, flips=3 * inner if seed % 3 == 0 else None), rng


@pytest.mark.parametrize("inner", [1, 2, 3, 4, 5])
def test_triangulated_squares_have_two_branches_for_each_vertex_that_is_free(inner):
    for sheet, rng in squares(inner, range(5)):
        branches, free = branches_from_flat(sheet), len(free_vertices(sheet))
        assert (branches.count, branches.at_least, branches.proved) == (2**free, False, True)
        assert set(branches.kinds) == {1}
        assert branches_by_brute_force(sheet, rng, 40 * 2**free) == 2**free


@pytest.mark.slow
@pytest.mark.parametrize("inner", range(6, 11))
def test_large_triangulated_squares(inner):
    for sheet, _ in squares(inner, range(20)):
        branches, free = branches_from_flat(sheet), len(free_vertices(sheet))
        assert (branches.count, branches.proved) == (2**free, True)


def test_branches_that_begin_nearly_alike_in_two_spaces_of_rates_are_two():
    """Three of 200 squares have such; these rates differ by less than what tells points of multiplicity apart."""
    [(sheet, _)] = squares(7, [11])
    branches = branches_from_flat(sheet)
    assert (branches.count, branches.proved) == (2 ** len(free_vertices(sheet)), True)


@pytest.mark.parametrize(
    ("name", "count"), [("triangles-4-a.fold", 16), ("triangles-4-b.fold", 16), ("triangles-5.fold", 32)]
)
def test_squares_of_which_half_the_branches_were_missing(name, count):
    verdict = mobility(read(CASES / name), exact=False).verdict
    assert (verdict.count.count, verdict.count.at_least, verdict.count.proved) == (count, False, True)
    assert verdict.text == f"Rigid-foldable from the flat state: 1 degree of freedom. {count} folding branches."
    signs = {branch.signs for branch in verdict.branches}
    assert len(signs) == count
    assert {branch.freedoms for branch in verdict.branches} == {1}


def test_more_contains_what_is_found_without():
    at = configuration_of_sheet(read(CASES / "triangles-4-a.fold"))
    some, more = (replace(at, more=more).branches for more in (False, True))
    assert {branch.signs for branch in some.branches} == {branch.signs for branch in more.branches}
    assert more.proved


def test_a_branch_for_each_point_folds(rng):
    sheet = triangulated_square(4, np.random.default_rng((4, 4)))
    branches = branches_from_flat(sheet)
    every = [branch for branch in branches.branches if branch.followed]
    assert len(every) == branches.count
    assert max(branch.error for branch in every) < 1e-12
    assert min(branch.followed for branch in every) > np.radians(1)


def test_the_search_of_a_star_in_a_grid_says_at_least():
    verdict = mobility(read(CASES / "grid-star.cp"), exact=False).verdict
    assert verdict.count.at_least
    assert verdict.count.count >= 17
    assert (verdict.freedoms, verdict.certainty) == (1, "numerical")
    assert "At least" in verdict.text


def known_forms(points, rng):
    """Three forms in four variables that vanish at some points: the rest of the eight are wherever they are."""
    size = points.shape[1]
    pairs = [(i, j) for i in range(size) for j in range(i, size)]
    rows = np.array([[p[i] * p[j] * (1 if i == j else 2) for i, j in pairs] for p in points])
    kernel = np.linalg.svd(rows)[2][len(points) :]
    forms = np.zeros((3, size, size))
    for form, coefficients in zip(forms, rng.normal(size=(3, len(kernel))) @ kernel, strict=True):
        for (i, j), value in zip(pairs, coefficients, strict=True):
            form[i, j] = form[j, i] = value
    return forms


def test_known_points_are_among_all_paths_and_are_certified(rng):
    points = rng.normal(size=(5, 4))
    forms = known_forms(points, rng)
    ends = path_ends(forms)
    assert ends.arrived.all()
    balls = FormBalls(forms)
    certified = [balls.certified(end) for end in ends.points]
    assert len(certified) == 8
    assert all_distinct(certified)
    units = points / np.linalg.norm(points, axis=1)[:, None]
    real = np.array([one.middle.real / np.linalg.norm(one.middle) for one in certified if one.real])
    assert np.abs(np.abs(units @ real.T).max(axis=1) - 1.0).max() < 1e-9
    assert len(real) % 2 == 0  # others are pairs of conjugates
    by_elimination = np.array(real_points(forms))
    assert len(by_elimination) == len(real)
    assert np.abs(np.abs(by_elimination @ real.T).max(axis=1) - 1.0).max() < 1e-9


def test_a_point_of_multiplicity_is_not_certified():
    """x^2 = w^2 and (x - w)(y + w) = 0: the plane x = w is in both, and (-1, -1) is alone."""
    square = np.diag([-1.0, 1.0, 0.0])
    double = np.array([[1.0, -1.0, 0.0], [-1.0, 1.0, 0.0], [0.0, 0.0, 0.0]])
    line = np.diag([-1.0, 0.0, 1.0])
    assert FormBalls(np.array([double, line])).certified(np.array([1.0, 1.0, 1.0], dtype=complex)) is None
    assert FormBalls(np.array([square, line])).certified(np.array([1.0, 1.0, 1.0], dtype=complex)) is not None
    space = RateSpace(np.eye(3), ())
    assert not has_points_only(space)
    found = real_points(np.array([double, line]))  # x = w twice, y = w or -w
    assert sorted(tuple(np.round(point / point[0], 3)) for point in found) == [(1.0, 1.0, -1.0), (1.0, 1.0, 1.0)]


def test_curves_are_no_points():
    assert real_points(np.array([np.diag([1.0, -1.0, 0.0, 0.0]), np.diag([0.0, 0.0, 1.0, -1.0])])) is None
    assert real_points(np.array([np.eye(3), np.diag([1.0, 2.0, 3.0])])) == []


def test_what_is_inside_triangles_is_immobile():
    for sheet, _ in squares(6, (0, 3)):
        linkage = linkage_of_sheet(sheet)
        held = set(immobile_joints(linkage))
        free = set(free_vertices(sheet))
        edges = [set(sheet.edges[joint]) for joint in linkage.graph.joints]
        for place, ends in enumerate(edges):
            inner = {vertex for vertex in ends if vertex > 3}
            if inner and not inner & free:
                assert place in held
            if inner and inner <= free:
                assert place not in held
        branches = branches_from_flat(sheet)
        assert set(branches.branch(0).immobile) >= held


def test_more_equations_than_unknowns_leave_the_common_points(rng):
    points = rng.normal(size=(2, 4))
    forms = np.concatenate([known_forms(points, rng) for _ in range(2)])
    found = np.array(real_points(forms))
    units = points / np.linalg.norm(points, axis=1)[:, None]
    assert len(found) == 2
    assert np.abs(np.abs(units @ found.T).max(axis=1) - 1.0).max() < 1e-9
