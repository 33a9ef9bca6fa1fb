"""Cores: contradictory by a solver that shares no code, and without any one condition not so."""

from itertools import product

import numpy as np
import pytest
from commands import run
from folded_sheets import folded_sheet, published, unassigned_map
from sizes import slow

import synth
from graphs.files.formats import write
from graphs.mechanism.sheet import Sheet
from synth.making.drawing.mechanisms import fault_scene


def has_order(conditions):
    """Whether any orders of pairs of panels keep conditions: all are tried, with those dropped early that do not."""
    pairs = sorted({tuple(sorted(pair)) for condition in conditions for pair in pairs_of(condition)})
    number = {pair: place for place, pair in enumerate(pairs)}
    checks = [[] for _ in pairs]
    for condition in conditions:
        last = max(number[tuple(sorted(pair))] for pair in pairs_of(condition))
        checks[last].append(condition)
    above = {}

    def over(one, other):
        return above[one, other] if one < other else not above[other, one]

    def kept(condition):
        if condition.kind == "crease":
            return True
        if condition.kind == "taco-tortilla":
            a, b, c = condition.panels
            return over(a, c) == over(b, c)
        if condition.kind == "taco-taco":
            a, b, c, d = condition.panels
            return (over(a, c) + over(a, d) + over(b, c) + over(b, d)) % 2 == 0
        a, b, c = condition.panels
        return not over(a, b) == over(b, c) == over(c, a)

    def below(place):
        if place == len(pairs):
            return True
        for value in fixed.get(pairs[place], (True, False)):
            above[pairs[place]] = value
            if all(kept(condition) for condition in checks[place]) and below(place + 1):
                return True
        return False

    fixed = {tuple(sorted(c.panels)): (ORDERS[c],) for c in conditions if c.kind == "crease"}
    return below(0)


ORDERS = {}
"""Which panel of a crease is on top, by condition, from the sheet alone."""


def pairs_of(condition):
    a, b, *rest = condition.panels
    if condition.kind == "crease":
        return [(a, b)]
    if condition.kind == "taco-tortilla":
        return [(a, rest[0]), (b, rest[0])]
    if condition.kind == "taco-taco":
        return list(product((a, b), rest))
    return [(a, b), (b, rest[0]), (a, rest[0])]


def check(answer):
    core = answer.core
    assert not answer.foldable
    assert core.confirmed
    ORDERS.clear()
    flipped = answer.image.panels.flipped
    for condition in core.conditions:
        if condition.kind == "crease":
            one, _ = condition.panels
            ORDERS[condition] = answer.valleys[condition.joints[0]] == bool(flipped[one])
    assert not has_order(core.conditions)
    for left_out in core.conditions:
        assert has_order([condition for condition in core.conditions if condition != left_out])


def test_the_published_pattern_without_an_order():
    """It passes Kawasaki's and Maekawa's conditions; three panels are enough."""
    answer = synth.layers(published() / "unsatisfiable_008_tachioripa_not_foldable.fold")
    assert all(vertex.kawasaki and vertex.maekawa for vertex in answer.vertices)
    check(answer)
    assert answer.core.panels == (0, 1, 2)
    assert len(answer.core.conditions) == 4


@pytest.mark.slow
@pytest.mark.parametrize("name", ["007_tanakaoripa_fish_base_(old)", "012_imai_Tarantula_(old)"])
def test_larger_published_patterns_without_an_order(name):
    answer = synth.layers(published() / f"unsatisfiable_{name}.fold")
    assert all(vertex.kawasaki and vertex.maekawa for vertex in answer.vertices)
    assert answer.core.confirmed
    check(answer)


@pytest.mark.parametrize("seed", [*range(4), *(slow(seed) for seed in range(4, 60))])
def test_one_crease_turned(seed):
    rng = np.random.default_rng(seed)
    sheet, _ = folded_sheet(rng, int(rng.integers(2, 5)), 24)
    place = int(rng.choice([place for place, letter in enumerate(sheet.assignments) if letter in "MV"]))
    turned = "M" if sheet.assignments[place] == "V" else "V"
    letters = sheet.assignments[:place] + turned + sheet.assignments[place + 1 :]
    answer = synth.layers(Sheet(sheet.vertices, sheet.edges, letters, sheet.faces, sheet.coordinates))
    if answer.foldable:
        assert answer.core is None
    else:
        check(answer)
    assert synth.layers(sheet).core is None


def test_cores_and_faults_are_drawn(tmp_path):
    """Panels and creases of the core; without one rings round the vertices at fault."""
    sheet = unassigned_map(2, 3)
    letters = "".join("M" if letter == "U" else letter for letter in sheet.assignments)
    wrong = Sheet(sheet.vertices, sheet.edges, letters, sheet.faces, sheet.coordinates)
    write(wrong, tmp_path / "wrong.fold")
    told = run("layers", tmp_path / "wrong.fold", "-o", tmp_path / "why.svg", code=1).stdout
    assert "written: " in told
    drawn = (tmp_path / "why.svg").read_text(encoding="utf-8")
    assert drawn.count("<circle") == 2
    layer = next(layer for layer in fault_scene(synth.layers(wrong)).layers if layer.name == "faults")
    core = synth.layers(wrong).core
    assert sum(type(shape).__name__ == "Polygon" for shape in layer.shapes) == len(core.panels)
    run("layers", tmp_path / "wrong.fold", "-o", tmp_path / "none.fold", code=1)
    assert not (tmp_path / "none.fold").exists()
