"""Parts of a linkage that share no joint: their branches multiply, their degrees of freedom add."""

import json
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from branch_sheets import side_by_side
from commands import run

from graphs.files.formats import write
from graphs.mechanism.sheet import Sheet
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.folding.motion import fold
from synth.analysis.motion.branches import branches_of
from synth.analysis.motion.linkage import parts_of
from synth.analysis.verdict._mobility import mobility
from synth.catalogue.patterns import generate
from synth.catalogue.patterns.creases import fan, map_sheet, miura
from synth.making.viewer.page_data import ways_of


@pytest.fixture(scope="module")
def twist():
    return generate("square-twist").mechanism


@pytest.mark.parametrize("number", [3, 9])
def test_square_twists_side_by_side_choose_each_their_branch(twist, number):
    sheet = side_by_side([twist] * number)
    verdict = mobility(sheet, exact=False).verdict
    assert (verdict.freedoms, verdict.certainty, verdict.immobile_joints) == (number, "proved", ())
    assert (verdict.count.count, verdict.count.at_least, verdict.count.proved) == (6**number, False, True)
    assert f"{6**number} folding branches" in verdict.text
    assert {(branch.freedoms, branch.immobile_joints) for branch in verdict.branches} == {(number, ())}


def sheets_of_parts(twist):
    """Sheets of separate parts, by names of the parts: one and the same name is one and the same sheet."""
    own = {
        "twist": twist,
        "miura": miura(3, 3, np.radians(60)),
        "map": map_sheet(2, 3),
        "five": fan(np.radians((0, 70, 140, 200, 290))),
        "rigid": fan(np.radians((0, 30, 60, 120))),
        "book": map_sheet(1, 2),
    }
    names = ["twist miura", "miura map", "map map map", "five map", "five five", "rigid miura", "book map twist"]
    names += ["book book", "rigid five", "miura miura twist"]
    return [[own[name] for name in each.split()] for each in names]


def test_branches_multiply_and_freedoms_add(twist):
    for sheets in sheets_of_parts(twist):
        each = [configuration_of_sheet(sheet).branches for sheet in sheets]
        whole = configuration_of_sheet(side_by_side(sheets)).branches
        kinds = [branches.kinds or {0: 1} for branches in each]
        expected = {}
        for choice in product(*(kind.items() for kind in kinds)):
            freedoms = sum(freedoms for freedoms, _ in choice)
            expected[freedoms] = expected.get(freedoms, 0) + int(np.prod([number for _, number in choice]))
        assert dict(whole.kinds) == expected
        assert whole.at_least == any(branches.at_least for branches in each)
        assert whole.exhaustive == all(branches.exhaustive for branches in each)


def test_a_panel_in_common_is_no_joint_in_common():
    """Two vertices of four creases whose only common panel is between them."""
    joined = configuration_of_sheet(map_sheet(2, 2)).linkage
    assert len(parts_of(joined)) == 1
    corners = np.array([(0, 0), (4, 0), (4, 2), (0, 2), (1, 0), (1, 2), (3, 0), (3, 2), (0, 1), (4, 1), (1, 1), (3, 1)])
    left, right = (0, 4, 10, 8), (6, 1, 9, 11)
    top_left, top_right, middle = (8, 10, 5, 3), (11, 9, 2, 7), (4, 6, 11, 7, 5, 10)
    sheet = Sheet(12, (), "", (left, right, top_left, top_right, middle), tuple(map(tuple, corners.tolist())))
    linkage = configuration_of_sheet(sheet).linkage
    assert len(parts_of(linkage)) == 2
    branches = branches_of(linkage)
    assert branches.numbered == branches.count == len(branches.branches)


def test_every_number_and_its_signs_choose_a_branch(twist, tmp_path):
    sheet = side_by_side([twist] * 3)
    branches = configuration_of_sheet(sheet).branches
    assert len(branches.branches) == branches.numbered == 216
    seen = {branches.branch(number).signs for number in range(216)}
    assert len(seen) == 216
    for number in (0, 100, 215):
        assert branches.number_of(branches.branch(number).signs) == number
        assert branches.choice(branches.number_of_choice(branches.choice(number))) == branches.choice(number)
    nine = side_by_side([twist] * 9)
    taken = fold(nine, branch=6**9 - 2, frames=2)
    assert (taken.branch, taken.freedoms) == (6**9 - 2, 9)
    assert taken.branches.number_of(taken.taken.signs) == 6**9 - 2
    file = tmp_path / "three.fold"
    write(sheet, file)
    [said] = json.loads(run("mobility", "--json", file).stdout)
    assert (said["verdict"]["count"], said["verdict"]["at_least"], said["verdict"]["proved"]) == (216, False, True)
    folded = json.loads(run("fold", file, "--branch", "215", "--frames", "2", "--json").stdout)
    assert (folded["branch"], folded["count"], folded["freedoms"]) == (215, 216, 3)


def test_each_part_begins_as_assigned_though_another_turns_over(twist):
    """Parts turn over without each other: letters of one part may all be exchanged."""
    alone = fold(twist, branch=2, frames=1)
    signs = alone.taken.signs
    for turned in (signs, signs.translate(str.maketrans("+-", "-+"))):
        sheet = side_by_side([twist, twist])
        at = configuration_of_sheet(sheet)
        lettered = dict(zip(at.joints, signs + turned, strict=True))
        letters = "".join(
            {"+": "V", "-": "M", "0": "F"}[lettered[edge]] if edge in lettered else letter
            for edge, letter in enumerate(sheet.assignments)
        )
        marked = configuration_of_sheet(replace(sheet, assignments=letters))
        assert marked.marked.marked == "has"
        assert marked.branches.choice(marked.chosen) == (2, 2)
        assert (marked.marked.rates * marked.marks).min() > 0.0


def test_a_page_lists_the_chosen_branch_beyond_the_others(twist):
    ways = ways_of(configuration_of_sheet(side_by_side([twist] * 4)))
    assert len(ways.all) <= 257
    assert ways.all[ways.taken].freedoms == 4
