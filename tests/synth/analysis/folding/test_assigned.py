"""Wrong marks: which creases disagree with the nearest branch, and patterns marked as a branch folds."""

import json
from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from scipy.optimize import linprog
from sizes import slow

import synth
from synth.analysis.folding import assign_branch
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.cli.main import main


def marked(sheet, signs, at):
    """The sheet with signs, 1, -1 or 0, of its joints as letters."""
    whole = at.drawn
    letters = list(whole.assignments)
    for joint, sign in zip(at.joints, signs, strict=True):
        letters[joint] = {1: "V", -1: "M", 0: "U"}[int(sign)]
    return replace(whole, assignments="".join(letters))


def signs_of(branch):
    return np.array([{"+": 1, "-": -1, "0": 0}[sign] for sign in branch.signs])


@pytest.fixture(scope="module")
def miura():
    sheet = synth.generate("miura", rows=3, columns=3).mechanism
    return sheet, configuration_of_sheet(sheet)


def test_the_creases_that_were_turned_over_are_named(miura):
    sheet, at = miura
    (number, signs), *_ = [
        (n, signs_of(one)) for n, one in enumerate(at.branches.branches) if one.freedoms == 1 and "0" not in one.signs
    ]
    for wrong in ([0], [3, 7]):
        turned = signs.copy()
        turned[wrong] *= -1
        answer = synth.mobility(marked(sheet, -turned, at))
        told = answer.to_json()["assignment"]
        assert told["begins"] == "none has"
        assert told["nearest_branch"] == number
        assert told["opposite"] == [str(at.joints[place]) for place in wrong]
        assert told["immobile"] == []
        line = str(answer).splitlines()[1]
        assert line.startswith(f"{len(wrong)} of 12 assigned creases disagree")
        assert f"nearest branch, {number}: " in line


def test_the_nearest_branch_is_that_of_the_least_distance(miura):
    """Branches of one freedom: the distance of signs, counted otherwise."""
    sheet, at = miura
    rng = np.random.default_rng(0)
    for _ in range(4):
        signs = rng.choice([-1, 1], len(at.joints))
        here = configuration_of_sheet(marked(sheet, signs, at))
        least = min(
            min(np.count_nonzero(signs_of(one) != turn * signs) for turn in (1, -1)) for one in here.branches.branches
        )
        assert here.disagreement.size == least


def feasible(basis, signs, kept):
    rows = -signs[kept, None] * basis[kept]
    return linprog(np.zeros(basis.shape[1]), A_ub=rows, b_ub=-np.ones(len(kept)), bounds=(None, None)).status == 0


def test_on_branches_of_several_freedoms_none_can_be_left_out():
    """A map of 2 x 3 panels: every set of creases that could agree is tried."""
    sheet = synth.generate("map", rows=2, columns=3).mechanism
    at = configuration_of_sheet(sheet)
    assert max(one.freedoms for one in at.branches.branches) > 1
    rng = np.random.default_rng(1)
    for _ in range(2):
        signs = rng.choice([-1, 1], len(at.joints))
        here = configuration_of_sheet(marked(sheet, signs, at))
        most = max(
            next(
                size
                for size in range(len(signs), -1, -1)
                if any(feasible(one.space.basis, signs, list(kept)) for kept in combinations(range(len(signs)), size))
            )
            for one in here.branches.branches
        )
        found = here.disagreement
        assert len(signs) - most == found.size
        assert not set(found.opposite) & set(found.immobile)


@pytest.mark.parametrize("name", ["miura", slow("square-twist"), "waterbomb-base"])
def test_a_pattern_marked_as_a_branch_folds_as_it_is_marked(name):
    sheet = synth.generate(name).mechanism
    at = configuration_of_sheet(sheet)
    for number, branch in list(enumerate(at.branches.branches))[:6]:
        edit = assign_branch(at, number)
        again = synth.mobility(edit.sheet)
        told = again.to_json()["assignment"]
        assert told["begins"] == "has"
        assert (told["opposite"], told["immobile"]) == ([], [])
        assert again.verdict.freedoms == branch.freedoms
        immobile = {at.joints[place] for place in branch.immobile}
        assert {joint for joint in at.joints if edit.sheet.assignments[joint] == "F"} <= immobile
        assert edit.sheet.coordinates == at.drawn.coordinates
        assert edit.sheet.edges[: len(at.drawn.edges)] == at.drawn.edges


def test_assigned_as_it_is_marked_it_stays_so(miura):
    sheet, at = miura
    assert assign_branch(sheet, at.chosen).sheet.assignments == at.drawn.assignments


def test_fold_angles_take_the_sign_of_their_crease(miura):
    _, at = miura
    angles = tuple(None if letter == "B" else 2.0 for letter in at.drawn.assignments)
    for number in range(2):
        after = assign_branch(replace(at.drawn, fold_angles=angles), number).sheet
        turned = {"M": -2.0, "V": 2.0, "F": 0.0, "B": None}
        assert after.fold_angles == tuple(turned[letter] for letter in after.assignments)


def test_commands_and_python_agree(miura, tmp_path):
    from click.testing import CliRunner

    sheet, at = miura
    wrong = marked(sheet, np.ones(len(at.joints)), at)
    file, out = tmp_path / "a.fold", tmp_path / "b.fold"
    synth.write(wrong, file)
    run = CliRunner()
    told = [json.loads(run.invoke(main, [word, str(file), "--json"]).stdout) for word in ("mobility", "fold")]
    assert told[0][0]["assignment"] == told[1]["assignment"] == synth.mobility(wrong).to_json()["assignment"]
    number = told[1]["assignment"]["nearest_branch"]
    assert told[1]["branch"] == number
    line = [row for row in run.invoke(main, ["fold", str(file)]).stdout.splitlines() if "disagree" in row]
    assert len(line) == 1
    result = run.invoke(main, ["edit", str(file), "--assign-branch", str(number), "-o", str(out)])
    assert result.exit_code == 0, result.output
    assert f"assign branch {number}" in result.stdout
    assert synth.read(out).assignments == assign_branch(wrong, number).sheet.assignments
    assert synth.mobility(synth.read(out)).to_json()["assignment"]["begins"] == "has"


def test_what_cannot_be_assigned_is_told_of(miura):
    sheet, _ = miura
    with pytest.raises(synth.InvariantError, match="there is no branch 99"):
        assign_branch(sheet, 99)
    with pytest.raises(synth.UnsolvableError, match="this sheet is folded"):
        assign_branch(synth.fold(sheet, frames=2).frames()[1], 0)
