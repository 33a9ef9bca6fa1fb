"""Assignments changed so that each vertex folds flat by itself, as little as possible."""

import json
from itertools import combinations
from math import pi

import numpy as np
import pytest
from commands import run
from folded_sheets import folded_sheet, vertex_of
from sizes import slow

import synth
from graphs.errors import UnsolvableError
from graphs.files.formats import write
from graphs.mechanism.sheet import Sheet
from synth.analysis.layering import locally_fixed


def with_turned(sheet, places):
    turned = {"M": "V", "V": "M"}
    letters = "".join(turned[x] if k in places else x for k, x in enumerate(sheet.assignments))
    return Sheet(sheet.vertices, sheet.edges, letters, sheet.faces, sheet.coordinates)


@pytest.mark.parametrize("seed", [*range(4), *(slow(seed) for seed in range(4, 60))])
def test_changes_are_enough_and_none_can_be_left_out(seed):
    rng = np.random.default_rng(seed)
    sheet, _ = folded_sheet(rng, 4, 30)
    creases = [place for place, letter in enumerate(sheet.assignments) if letter in "MV"]
    wrong = with_turned(sheet, set(rng.choice(creases, min(2, len(creases)), replace=False).tolist()))
    fixed = locally_fixed(synth.layers(wrong, explain=False))
    assert not synth.layers(fixed.sheet, explain=False).local_faults
    assert len(fixed.changed) <= len(creases)
    for some in range(len(fixed.changed)):
        for kept in combinations(fixed.changed, some) if len(fixed.changed) < 7 else []:
            assert synth.layers(with_turned(wrong, set(kept)), explain=False).local_faults


def test_command(tmp_path):
    write(vertex_of([pi / 2] * 4, "MMVV"), tmp_path / "wrong.fold")
    told = json.loads(run("layers", tmp_path / "wrong.fold", "--fix", "-o", tmp_path / "right.fold", "--json").stdout)
    assert len(told["changed"]) == 1
    assert synth.layers(tmp_path / "right.fold").orders == 1
    assert (
        "leave out the other option" in run("layers", tmp_path / "wrong.fold", "--fix", "--order", "1", code=2).stderr
    )


def test_what_no_assignment_mends():
    with pytest.raises(UnsolvableError, match="no assignment folds vertex 0 flat: 3 creases, an odd number"):
        locally_fixed(synth.layers(vertex_of([2.0, 2.0, 2 * pi - 4.0], "MMV")))
