"""Orders by the assignment of unassigned creases, against each assignment by itself."""

import json
from itertools import product

import numpy as np
import pytest
from commands import run
from folded_sheets import folded_sheet, unassigned_map
from sizes import slow

import synth
from graphs.errors import InvariantError
from graphs.files.formats import write
from graphs.mechanism.sheet import Sheet
from synth.analysis.layering import orders_by_assignment


def with_letters(sheet, places, letters):
    all_letters = list(sheet.assignments)
    for place, letter in zip(places, letters, strict=True):
        all_letters[place] = letter
    return Sheet(sheet.vertices, sheet.edges, "".join(all_letters), sheet.faces, sheet.coordinates)


@pytest.mark.parametrize("seed", [*range(3), *(slow(seed) for seed in range(3, 30))])
def test_each_assignment_by_itself(seed):
    rng = np.random.default_rng(seed)
    sheet, _ = folded_sheet(rng, 3, 16)
    creases = [place for place, letter in enumerate(sheet.assignments) if letter in "MV"]
    places = sorted(rng.choice(creases, min(4, len(creases)), replace=False).tolist())
    free = with_letters(sheet, places, "U" * len(places))
    answer = synth.layers(free)
    found = orders_by_assignment(answer)
    assert found.creases == tuple(places)
    assert sum(found.orders.values()) == answer.orders
    for letters in map("".join, product("MV", repeat=len(places))):
        assert synth.layers(with_letters(sheet, places, letters), explain=False).orders == found.orders.get(letters, 0)


def test_command_and_limit(tmp_path):
    write(unassigned_map(2, 2), tmp_path / "map.fold")
    told = json.loads(run("layers", tmp_path / "map.fold", "--assignments", "--json").stdout)["assignments"]
    assert told["orders"] == dict.fromkeys(("MMMV", "MMVM", "MVMM", "MVVV", "VMMM", "VMVV", "VVMV", "VVVM"), 1)
    assert "8 of 16 assignments of 4 unassigned creases fold flat, in 8 layer orders" in (
        run("layers", tmp_path / "map.fold", "--assignments").stdout
    )
    with pytest.raises(InvariantError, match="more than 3 assignments fold flat; expected at most 3"):
        orders_by_assignment(synth.layers(unassigned_map(2, 2)), most=3)
