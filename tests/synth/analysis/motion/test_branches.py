"""Ways to move from a flat state: known numbers of branches, and of their freedoms."""

from collections import Counter
from dataclasses import replace
from math import radians

import numpy as np
import pytest
from sizes import slow

from graphs.files.formats import read
from synth.analysis.motion.branches import branches_of, first_branch, search_for
from synth.analysis.motion.closure import ClosureEquations, corrected
from synth.analysis.motion.linkage import linkage_of_sheet
from synth.analysis.motion.singular.second_order import quadrics_of, rates_near
from synth.analysis.motion.walk.step import Allowance
from synth.catalogue.patterns.creases import fan, miura


def branches(sheet):
    return branches_of(linkage_of_sheet(sheet))


@pytest.mark.parametrize(
    ("rows", "columns"), [(2, 2), (3, 3), (4, 4), (3, 6), (6, 3), pytest.param(8, 8, marks=pytest.mark.slow)]
)
def test_miura_sheets(rows, columns):
    """One branch folds the straight lines alone, each by itself; the zigzags choose the others."""
    found = branches(miura(rows, columns, np.radians(60)))
    expected = Counter({1: 2 ** (rows - 1) - 1})
    expected[columns - 1] += 1
    assert Counter(branch.freedoms for branch in found.branches) == expected
    assert found.exhaustive
    assert {branch.certainty for branch in found.branches} == {"proved"}
    assert max(branch.error for branch in found.branches) < 1e-12
    assert len({branch.signs for branch in found.branches}) == len(found.branches)


@pytest.mark.parametrize(("size", "patterns"), [(2, 2), (3, 5), (4, 11), pytest.param(5, 23, marks=pytest.mark.slow)])
def test_mountains_and_valleys_of_miura_sheets(size, patterns, rng):
    """Letters that some pose near flat has, up to turning the sheet over: each line its own, where lines fold alone."""
    seen = set()
    for branch in branches(miura(size, size, np.radians(60))).branches:
        for _ in range(80):
            rates = branch.space.basis @ rng.normal(size=branch.freedoms)
            letters = tuple(np.sign(np.where(np.abs(rates) > 1e-9, rates, 0.0)).astype(int))
            seen.add(max(letters, tuple(-letter for letter in letters)))
    assert len(seen) == patterns


@pytest.mark.parametrize("starts", [25, slow(60)])
def test_random_starts_find_no_branch_that_is_not_listed(starts, rng):
    """Closed poses near the flat one, found from random ones, begin as one of the branches says."""
    linkage = linkage_of_sheet(miura(3, 3, np.radians(50)))
    closure = ClosureEquations(linkage)
    spaces = [branch.space.basis for branch in branches_of(linkage, closure).branches]
    seen = set()
    for _ in range(starts):
        pose = corrected(closure, 0.02 * rng.normal(size=closure.joints))
        if not pose.closed or np.abs(pose.angles).max() < 1e-3:
            continue
        rates = np.tan(pose.angles / 2)
        off = [np.linalg.norm(rates - basis @ (basis.T @ rates)) / np.linalg.norm(rates) for basis in spaces]
        assert min(off) < 1e-5 < sorted(off)[1]
        seen.add(int(np.argmin(off)))
    assert len(seen) > 1


def test_the_bird_base(data):
    found = branches(read(data / "patterns" / "bird-base.fold"))
    assert Counter(branch.freedoms for branch in found.branches) == {5: 16}
    assert not found.exhaustive  # eight creases meet in the middle
    assert {branch.certainty for branch in found.branches} == {"numerical"}
    assert max(branch.error for branch in found.branches) < 1e-12
    assert min(branch.followed for branch in found.branches) >= np.radians(10) - 1e-12


@pytest.mark.parametrize("creases", [slow(4), 5, 6, slow(8)])
def test_a_flat_vertex_has_three_freedoms_less_than_creases(creases, rng):
    for _ in range(5):
        while True:
            directions = np.sort(rng.uniform(0, 2 * np.pi, creases))
            sectors = np.diff([*directions, directions[0] + 2 * np.pi])
            if sectors.min() > 0.1 and sectors.max() < np.pi - 0.05:
                break
        found = branches(fan(directions))
        assert {branch.freedoms for branch in found.branches} == {creases - 3}
        assert len(found.branches) == (2 if creases == 4 else 1)


def test_a_sector_of_half_a_turn_folds_along_its_line_only():
    found = branches(fan(np.radians([0, 180, 220, 300])))
    assert [branch.freedoms for branch in found.branches] == [1]
    assert found.branches[0].immobile == (2, 3)


def test_a_sector_of_more_than_half_a_turn_is_rigid():
    assert branches(fan(np.radians([0, 30, 70, 100]))).branches == ()


def test_three_creases_fold_only_in_line():
    assert branches(fan(np.radians([0, 100, 220]))).branches == ()
    found = branches(fan(np.radians([0, 180, 250])))
    assert [(branch.freedoms, branch.immobile) for branch in found.branches] == [(1, (2,))]


def test_rates_near_marks_agree_to_second_order():
    sheet = miura(7, 6, np.radians(70))
    linkage = linkage_of_sheet(sheet)
    closure = ClosureEquations(linkage)
    marks = np.array([{"V": 1.0, "M": -1.0}[sheet.assignments[joint]] for joint in linkage.graph.joints])
    rates = rates_near(closure, linkage.angles, quadrics_of(linkage), marks)
    assert (np.sign(rates) == marks).all()
    halves = 2.0 * np.arctan(rates)
    assert closure.error(halves) < 1e-10  # linear in the tangent of half a fold


def test_the_first_branch_that_will_do_is_one_of_all():
    linkage = linkage_of_sheet(miura(3, 3, np.radians(60)))
    signs = [branch.signs for branch in branches_of(linkage).branches]
    found = first_branch(linkage, lambda rates: bool(np.abs(rates).min() > 1e-7))
    assert found.signs in {row for row in signs if "0" not in row}
    assert first_branch(linkage, lambda rates: False) is None


@pytest.mark.parametrize("steps", [40, slow(400)])
def test_a_search_takes_so_many_steps_and_no_more(steps, data, monkeypatch):
    """The bird base with a corner all but in the middle of a side: panels of next to no breadth."""
    sheet = read(data / "patterns" / "bird-base.fold")
    corners = list(sheet.coordinates)
    corners[3] = (-1.0, 1e-5)
    taken = []
    take = Allowance.take

    def watched(some, work=1):
        took = take(some, work)
        if work == 1:  # a step of a path
            taken.append(took)
        return took

    monkeypatch.setattr(Allowance, "take", watched)
    linkage = linkage_of_sheet(replace(sheet, coordinates=tuple(corners)))
    branches = branches_of(linkage, search=replace(search_for(len(linkage.angles), None), steps=steps))
    assert 16 <= sum(taken) <= steps + 20 * len(branches.branches)
    assert not all(taken)
    assert min(branch.followed for branch in branches.branches) < radians(9)


def test_an_equation_that_is_nothing_but_rounding_proves_nothing(data):
    """Two pairs of panels on each other, each turning about its own line: no cone, and two degrees of freedom."""
    (branch,) = branches(read(data / "linkages" / "wampler-fig1-folded.fold")).branches
    assert (branch.freedoms, branch.certainty) == (2, "numerical")
