"""Creases that may stay flat: every choice against brute force, and against each choice by the cells."""

import json
from collections import Counter
from itertools import product
from math import pi

import numpy as np
import pytest
from commands import run
from folded_sheets import folded_sheet, unassigned_map, vertex_of
from layers_by_brute_force import map_orders, vertex_orders
from sizes import slow

import synth
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import write
from graphs.mechanism.sheet import Sheet, with_all_edges
from synth.analysis.layering.flat_creases import with_letters
from synth.analysis.layering.sweep import count_by_cells


def numbers(found):
    """How many orders, for each number of creases that stay flat."""
    return Counter({flat: sum(n for f, n in found if f == flat) for flat in {f for f, _ in found}})


@pytest.mark.parametrize(("rows", "columns"), [(1, 1), (1, 2), (1, 3), (1, 4), (1, 5), (2, 2), (2, 3), slow(1, 7)])
def test_maps(rows, columns):
    creases = (columns - 1) * rows + (rows - 1) * columns
    brute = [(creases - len(folded), number) for folded, number in map_orders(rows, columns).items()]
    answer = synth.layers(unassigned_map(rows, columns), may_stay_flat="all")
    assert answer.orders == sum(number for _, number in brute)
    assert numbers([(len(flat), case.orders) for flat, case in answer.cases]) == numbers(brute)


@pytest.mark.parametrize("sectors", [3, 4, 5, 6, slow(8)])
def test_vertices_of_equal_sectors(sectors):
    brute = {tuple(k for k in range(sectors) if k not in folded): n for folded, n in vertex_orders(sectors).items()}
    answer = synth.layers(vertex_of([2.0 * pi / sectors] * sectors, "U" * sectors), may_stay_flat="unassigned")
    assert {flat: case.orders for flat, case in answer.cases} == brute
    assert answer.tried == len(brute)


@pytest.mark.parametrize("seed", [*range(4), *(slow(seed) for seed in range(4, 60))])
def test_each_choice_by_itself(seed):
    """Some creases of a folded sheet may stay flat: each set of them that does, refused or counted by the cells."""
    rng = np.random.default_rng(seed)
    sheet, _ = folded_sheet(rng, 3, 14)
    creases = [place for place, letter in enumerate(sheet.assignments) if letter in "MV"]
    places = sorted(rng.choice(creases, min(5, len(creases)), replace=False).tolist())
    answer = synth.layers(sheet, may_stay_flat=places)
    assert answer.creases == tuple(places)
    found = {flat: case.orders for flat, case in answer.cases}
    for stays in product((False, True), repeat=len(places)):
        flat = tuple(place for place, stay in zip(places, stays, strict=True) if stay)
        letters = dict.fromkeys(places, "U") | dict.fromkeys(flat, "F")
        case = synth.layers(with_letters(sheet, letters), explain=False)
        number = count_by_cells(case.image, case.valleys) if case.image is not None else 0
        if any("inside a panel" in warning for warning in case.mechanism.warnings):  # it is not folded
            number = 0
        assert found.get(flat, 0) == number


def test_orders_by_number_and_refusals():
    answer = synth.layers(unassigned_map(2, 2), may_stay_flat=[0, 3])
    assert answer.orders == 8 + 2  # the two creases of one line are folded, or stay flat
    seen = {(len(case.mechanism.panels), order.stacks) for case, order in map(answer.order, range(10))}
    assert len(seen) == 10
    with pytest.raises(InvariantError, match="order 10; expected a number from 0 to 9"):
        answer.order(10)
    with pytest.raises(InvariantError, match="edge 99; expected one from 0 to 11"):
        synth.layers(unassigned_map(2, 2), may_stay_flat=[99])
    with pytest.raises(InvariantError, match="is a border or a cut; expected a crease"):
        synth.layers(unassigned_map(2, 2), may_stay_flat=[11])
    with pytest.raises(InvariantError, match="expected 'unassigned', 'all', or numbers of creases"):
        synth.layers(unassigned_map(2, 2), may_stay_flat="some")
    with pytest.raises(UnsolvableError, match="has no faces"):
        synth.layers(Sheet(2, ((0, 1),), "B", (), ((0.0, 0.0), (1.0, 0.0))), may_stay_flat="all")


def test_a_pattern_of_which_no_choice_folds():
    """A vertex of three creases, one of which may stay flat."""
    answer = synth.layers(vertex_of([2.0, 2.0, 2.0 * pi - 4.0], "VVV"), may_stay_flat=[0])
    assert not answer.foldable
    assert "Does not fold flat with 1 crease that may stay flat" in str(answer)


def test_a_crease_across_a_ring_does_not_fold_alone():
    """A square ring with four creases."""
    outer = [(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0)]
    inner = [(1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)]
    faces = tuple((k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k) for k in range(4))
    answer = synth.layers(Sheet(8, (), "", faces, tuple(outer + inner)), may_stay_flat="all")
    assert answer.tried == 16
    found = {flat: case.orders for flat, case in answer.cases}
    assert found == {(): 8, (0, 3): 2, (1, 2): 2, (0, 1, 2, 3): 1}  # the two creases of one line, or all


def test_an_odd_number_of_creases_round_a_hole():
    """Three creases of a square ring on two lines through its middle: places close, but one of them is not folded."""
    outer = [(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0)]
    inner = [(1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)]
    faces = tuple((k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k) for k in range(4))
    ring = with_all_edges(Sheet(8, (), "", faces, tuple(outer + inner)))
    for crease in (0, 1):
        answer = synth.layers(with_letters(ring, {crease: "F"}))
        assert "the folded image does not close: an odd number of creases round a hole" in answer.fault


def test_more_choices_than_allowed(monkeypatch):
    monkeypatch.setenv("SYNTHEDRA_MOST", "choices=7")
    with pytest.raises(InvariantError, match="16 choices of creases that stay flat; expected at most 7"):
        synth.layers(unassigned_map(1, 5), may_stay_flat="all")


def test_command(tmp_path):
    path = tmp_path / "map.fold"
    write(unassigned_map(2, 2), path)
    answer = json.loads(run("layers", path, "--may-stay-flat", "all", "--json").stdout)
    assert (answer["orders"], answer["tried"], len(answer["cases"])) == (13, 4, 4)
    assert "Folds flat, in 10 layer orders" in run("layers", path, "--may-stay-flat", "0,3").stdout
    shown = run("layers", path, "--may-stay-flat", "unassigned", "--order", "12", "-o", tmp_path / "flat.svg")
    assert "panels from below" in shown.stdout
    assert (tmp_path / "flat.svg").exists()
    assert "--may-stay-flat goes with" in run("layers", path, "--may-stay-flat", "all", "--fix", code=2).stderr
    assert "is no crease" in run("layers", path, "--may-stay-flat", "x", code=2).stderr
