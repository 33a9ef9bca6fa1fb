"""Layer orders: published numbers, folded sheets, by two methods; witnesses; refusals. Maps: tests/test_sequences.py."""

from collections import Counter
from math import prod

import numpy as np
import pytest
from folded_sheets import folded_sheet, published, published_states, unassigned_map
from sizes import slow

import synth
from graphs.errors import InvariantError, UnsolvableError
from graphs.mechanism.sheet import Sheet
from synth.analysis.layering.checking import fault_of
from synth.analysis.layering.constraints import layer_constraints
from synth.analysis.layering.counting.propagation import counted
from synth.analysis.layering.image import folded, image_of
from synth.analysis.layering.orders import flat_pattern
from synth.analysis.layering.reduction import reduced
from synth.analysis.layering.sweep import count_by_cells


def both(answer):
    """The number by the cells, which has to be that of the answer."""
    return count_by_cells(answer.image, answer.valleys)


@pytest.mark.parametrize(("rows", "columns"), [(3, 4), slow(5, 5)])
def test_square_maps_by_their_cyclic_shifts(rows, columns):
    """Layers of a map can be shifted cyclically, so each panel is on top of equally many orders (A001415, A001418)."""
    pattern = flat_pattern(unassigned_map(rows, columns))
    image = image_of(folded(pattern.sheet, pattern.mechanism, pattern.points), 1e-9)
    constraints = layer_constraints(image)
    panels = rows * columns
    on_top = constraints.table.literals(0, np.zeros(panels - 1, dtype=np.int64), np.arange(1, panels))
    number = prod(counted(problem) for problem, _ in reduced(constraints, on_top).parts)
    assert panels * number == {12: 15552, 25: 186086600}[panels]


NAMES = [
    "grids_002_brown_2x2_D1",
    "grids_018_brown_3x3_D1",
    "grids_318_brown_4x4_D58",
    "instagram_004_traditional_Crane",
    "instagram_003_ku_Triangle_Bird",
    "instagram_196_komatsu_Giraffe",
    slow("instagram_011_ku_Bull"),
    slow("instagram_173_imai_Canabn"),
    slow("instagram_330_ku_F16"),
    slow("instagram_012_ku_4x4_Grid_Unassigned"),
]
EXACT = {"instagram_196_komatsu_Giraffe": [3, 28680], "instagram_012_ku_4x4_Grid_Unassigned": [300608]}
"""What our methods find where the published numbers stopped at ten thousand."""


def several(answer):
    return sorted(component.orders for component in answer.components)


@pytest.mark.parametrize("name", NAMES)
def test_published_states(name):
    row = published_states()[f"{name}.fold"]
    answer = synth.layers(published() / f"{name}.fold")
    listed = sorted(int(part) for part in row["component_states"].split("|") if part and int(part) > 1)
    assert several(answer) == EXACT.get(name, listed)
    assert answer.orders == prod(EXACT.get(name, listed))
    assert both(answer) == answer.orders


@pytest.mark.slow
def test_all_published_states():
    """All files of the index; where the published number has no limit, the variables are as many too."""
    checked = 0
    for name, row in published_states().items():
        answer = synth.layers(published() / name)
        if row["states"] == "0":
            assert not answer.foldable, name
            continue
        listed = sorted(int(part) for part in row["component_states"].split("|") if part and int(part) > 1)
        assert several(answer) == EXACT.get(name.removesuffix(".fold"), listed), name
        if row["limited"] == "no limit":
            checked += 1
            assert answer.orders == int(row["states"]), name
        answer.sample(1)  # checked by geometry
    assert checked == 21


def blocks(quick, number):
    """Return ranges of seeds: the first ones by themselves, the others, by hundreds, in slow cases."""
    first = [range(seed, seed + 1) for seed in range(quick)]
    return [*first, *(slow(range(max(begin, quick), begin + 100)) for begin in range(0, number, 100))]


@pytest.mark.parametrize("seeds", blocks(16, 9600), ids=str)
def test_folded_sheets(seeds):
    """Both methods agree, and the folding that made a sheet is among its orders."""
    for seed in seeds:
        rng = np.random.default_rng(seed)
        sheet, stack = folded_sheet(rng, int(rng.integers(1, 6)), 60)
        answer = synth.layers(sheet)
        stacks = [[panel for panel in stack if panel in set(panels.tolist())] for panels in answer.image.above]
        assert fault_of(answer.image, stacks, answer.valleys) == "", seed
        assert answer.orders >= 1, seed
        assert both(answer) == answer.orders, seed
        assert len(answer.sample(seed).stacks) == len(answer.image.cells), seed


@pytest.mark.parametrize("seeds", blocks(8, 1000), ids=str)
def test_one_crease_turned(seeds):
    """What one crease folded the other way leaves is the same by both methods, mostly nothing."""
    for seed in seeds:
        rng = np.random.default_rng(seed)
        sheet, _ = folded_sheet(rng, int(rng.integers(2, 5)), 40)
        creases = [place for place, letter in enumerate(sheet.assignments) if letter in "MV"]
        place = int(rng.choice(creases))
        turned = "M" if sheet.assignments[place] == "V" else "V"
        letters = sheet.assignments[:place] + turned + sheet.assignments[place + 1 :]
        answer = synth.layers(Sheet(sheet.vertices, sheet.edges, letters, sheet.faces, sheet.coordinates))
        assert both(answer) == answer.orders, seed


@pytest.mark.parametrize("seeds", blocks(6, 400), ids=str)
def test_tessellations_of_degree_four(seeds):
    """Miura sheets of random angles, some creases unassigned, by both methods; with their assignment they fold flat."""
    for seed in seeds:
        rng = np.random.default_rng(seed)
        rows, columns = (int(number) for number in rng.integers(2, 5, 2))
        sector = float(rng.uniform(0.7, 1.4))
        sheet = synth.generate("miura", rows=rows, columns=columns, sector=sector).mechanism
        assert synth.layers(sheet).foldable, seed
        letters = "".join("U" if letter in "MV" and rng.random() < 0.5 else letter for letter in sheet.assignments)
        answer = synth.layers(Sheet(sheet.vertices, sheet.edges, letters, sheet.faces, sheet.coordinates))
        assert answer.orders >= 1, seed
        assert both(answer) == answer.orders, seed
        answer.sample(seed)


def test_every_order_of_a_component_is_another(data):
    answer = synth.layers(unassigned_map(2, 3))
    orders = {order.stacks for order in answer.orders_of(0)}
    assert len(orders) == answer.orders == 60
    assert {answer.order(number).stacks for number in range(60)} == orders
    with pytest.raises(InvariantError, match="order 60; expected a number from 0 to 59"):
        answer.order(60)


def test_samples_are_uniform():
    """600 draws of 6 orders: each between 70 and 130 times, four and a half standard deviations off."""
    answer = synth.layers(unassigned_map(1, 3))
    drawn = Counter(answer.sample(seed).stacks for seed in range(600))
    assert len(drawn) == 6
    assert all(70 <= number <= 130 for number in drawn.values())


def test_without_faces_or_in_space_or_in_parts():
    with pytest.raises(UnsolvableError, match="layers need panels, and the pattern has no faces"):
        synth.layers(Sheet(2, ((0, 1),), "B", (), ((0.0, 0.0), (1.0, 0.0))))
    bent = Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 1)))
    with pytest.raises(UnsolvableError, match="a crease pattern that is folded flat is planar, and the sheet is not"):
        synth.layers(bent)
    apart = tuple((float(x), float(y)) for x, y in ((0, 0), (1, 0), (0, 1), (5, 0), (6, 0), (5, 1)))
    with pytest.raises(UnsolvableError, match="the pattern has 2 parts that no crease joins; expected one sheet"):
        synth.layers(Sheet(6, (), "", ((0, 1, 2), (3, 4, 5)), apart))


def test_a_pattern_that_is_folded_already_is_refused():
    """A square folded along its diagonal, both triangles in one place."""
    places = ((0.0, 0.0), (1.0, 0.0), (0.0, 0.0), (0.0, 1.0))
    with pytest.raises(UnsolvableError, match="faces 0 and 1 lie on one side of the edge that they share"):
        synth.layers(Sheet(4, (), "", ((0, 1, 3), (1, 2, 3)), places))


def test_narrow_panels_are_not_welded_away():
    """A pleat far narrower than its neighbours, which both run across its creases: two orders."""
    xs = [0.0, 1.0, 1.002, 2.0]
    corners = tuple((x, float(y)) for y in (0, 1) for x in xs)
    faces = tuple((k, k + 1, k + 5, k + 4) for k in range(3))
    answer = synth.layers(Sheet(8, (), "", faces, corners))
    assert answer.orders == both(answer) == 2
    assert set(np.concatenate(answer.image.above).tolist()) == {0, 1, 2}


def test_more_pairs_than_allowed_are_refused(monkeypatch):
    monkeypatch.setenv("SYNTHEDRA_MOST", "pairs=5")
    with pytest.raises(InvariantError, match="6 pairs of panels over cells; expected at most 5"):
        synth.layers(unassigned_map(2, 2))


def test_an_image_that_does_not_close():
    """A square ring folded along four lines that are no rectangle: its hole does not close."""
    outer = [(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0)]
    inner = [(1.0, 1.0), (2.0, 1.1), (2.0, 2.0), (1.0, 2.0)]
    faces = tuple((k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k) for k in range(4))
    answer = synth.layers(Sheet(8, (), "", faces, tuple(outer + inner)))
    assert not answer.foldable
    assert "the folded image does not close: panels part by" in answer.fault
