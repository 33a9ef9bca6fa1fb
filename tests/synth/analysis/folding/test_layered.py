"""Layer orders at configurations in space: by construction, by drawing strands, and by bending folded sheets."""

from itertools import product
from math import pi

import numpy as np
import pytest
from crossing_strands import Strands
from folded_sheets import bent_sheet, folded_sheet
from posed_sheets import box_with_flaps, folded_strip, half_folded_map
from sizes import slow

import synth
from graphs.mechanism.sheet import Sheet
from synth.analysis.folding.configuration import layers_at
from synth.analysis.layering.checking import fault_of

RIGHT = pi / 2
STAMPS = (1, 2, 6, 16, 50, 144)
"""OEIS A000136."""


def by_strands(answer):
    return 1 if answer.stacked is None else Strands(answer, answer.valleys).orders()


@pytest.mark.parametrize(
    ("turns", "orders"),
    [
        ((2, 2), 2),
        ((2, -2), 1),
        ((2, 1, 2), 1),
        ((1, 2, 1), 0),  # the strip would pass through itself where it is closed
        ((1, -2, 1), 1),
        ((1, 1, 1), 1),  # a tube, nothing lies on anything
        ((1, 1, 1, 1), 2),  # the last square inside the tube or outside
        ((1, 1, 1, 1, 1), 2),
        ((1, 1, 1, 2, 1), 0),
        ((1, 2, -1, -2, -1, -2), 0),
    ],
    ids=str,
)
def test_strips(turns, orders):
    answer = layers_at(folded_strip([RIGHT * turn for turn in turns]))
    assert answer.orders == orders == by_strands(answer)
    assert answer.foldable == (orders > 0)
    for number in range(orders if answer.stacked else 0):
        answer.order(number)  # checked by geometry


@pytest.mark.parametrize("seed", [*range(25), *(slow(seed) for seed in range(25, 600))])
def test_random_strips(seed):
    """By trying all permutations with strands drawn."""
    rng = np.random.default_rng(seed)
    turns = rng.choice([-2, -1, 1, 2, 2, -2], int(rng.integers(3, 7)))
    answer = layers_at(folded_strip((RIGHT * turns).tolist()))
    if answer.stacked is not None and answer.image.depth < 6:
        assert answer.orders == by_strands(answer)


@pytest.mark.parametrize("seed", [*range(12), *(slow(seed) for seed in range(12, 400))])
def test_bent_sheets(seed):
    """A sheet folded flat and bent along a line, all layers together, has as many orders as before it was bent."""
    rng = np.random.default_rng(seed)
    angle = float(rng.choice([RIGHT, 1.0, 2.5, -1.2]))
    sheet, flat, order = bent_sheet(rng, int(rng.integers(1, 5)), 30, angle)
    answer = layers_at(sheet)
    assert answer.orders == synth.layers(flat).orders
    stacks = [[panel for panel in order if panel in set(above.tolist())] for above in answer.image.above]
    of = answer.stacked.plane_of_cell
    seen = (
        [stack[:: sides[of[cell]]] for cell, stack in enumerate(stacks)]
        for sides in product((1, -1), repeat=len(answer.stacked.planes))
    )
    assert any(fault_of(answer.image, stack, answer.valleys) == "" for stack in seen)
    answer.sample(seed)


@pytest.mark.parametrize("seed", [*range(6), *(slow(seed) for seed in range(6, 200))])
def test_folded_flat_is_a_configuration_too(seed):
    """A sheet whose coordinates are those of its folded image."""
    rng = np.random.default_rng(seed)
    flat, _ = folded_sheet(rng, int(rng.integers(1, 5)), 40)
    answer = synth.layers(flat)
    places = tuple((x, y, 0.0) for x, y in answer.image.panels.places.tolist())
    angles = tuple({"V": pi, "M": -pi}.get(letter, 0.0) for letter in flat.assignments)
    there = layers_at(Sheet(flat.vertices, flat.edges, flat.assignments, flat.faces, places, fold_angles=angles))
    assert there.orders == answer.orders
    assert there.valleys == answer.valleys
    sorted_orders = [sorted(component.orders for component in one.components) for one in (there, answer)]
    assert sorted_orders[0] == sorted_orders[1]


@pytest.mark.parametrize("columns", [2, 3, 4])
@pytest.mark.parametrize("angles", [[RIGHT], [1.0], [RIGHT, -0.5], [RIGHT, RIGHT, RIGHT]], ids=str)
def test_maps_folded_half(columns, angles):
    """A map with its columns folded onto each other, then bent: as many orders as a strip of stamps."""
    answer = layers_at(half_folded_map(columns, angles))
    assert answer.orders == STAMPS[columns - 1]
    if columns == 2:
        assert by_strands(answer) == 2


def test_a_tube_of_two_layers():
    """The last row comes to where the first is: below it, above it, around it or within it; for each order of both."""
    answer = layers_at(half_folded_map(2, [RIGHT] * 4))
    assert answer.orders == 8 == by_strands(answer)


def test_a_map_whose_rows_are_closed_differently():
    """2 x 2: one line at 90 degrees, the other closed: as a valley on one side and a mountain on the other it cannot."""
    for letters, orders in (("VV", 1), ("MM", 1), ("VM", 0), ("MV", 0)):
        answer = layers_at(half_folded_map(2, [RIGHT], letters))
        assert answer.orders == orders == by_strands(answer)
    assert "Panels pass through each other at this configuration" in str(answer)


@pytest.mark.parametrize(
    ("depths", "orders"),
    [
        ((0.45, 0.45, 0.45, 0.45), 16),  # each two neighbours in either order, a pinwheel too
        ((0.7, 0.7, 0.7, 0.7), 24),
        ((1.0, 1.0, 1.0, 1.0), 24),
        ((1.2, 0.3, 0.4, 0.3), 3 * 3),  # the long flap lies on the one opposite, whose hinge it crosses
        ((1.2, 0.3, 1.2, 0.3), 0),
    ],
    ids=str,
)
def test_boxes_with_flaps(depths, orders):
    answer = layers_at(box_with_flaps(depths))
    assert answer.orders == orders
    if max(len(above) for above in answer.image.above) < 4 and len(answer.image.cells) < 9:
        assert by_strands(answer) == orders
    assert layers_at(box_with_flaps(depths, closed=0.5)).stacked is None


def test_an_island_in_a_plane():
    """A small panel above the middle of a large one, which no edge joins to its outline."""
    corners = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (4, 0, 1), (4, 4, 1), (1, 0, 1), (1, 4, 1)]
    faces = [(0, 1, 2, 3), (1, 4, 5, 2), (4, 6, 7, 5)]  # bottom, side, top
    corners += [(1, 1, 0), (1, 2, 0), (2, 1, 0), (2, 2, 0), (1, 1, 1), (1, 2, 1)]
    faces += [(12, 8, 9, 13), (8, 10, 11, 9)]  # a leg down from a tab of the top, and a foot on the bottom
    faces[2] = (4, 6, 12, 13, 7, 5)
    sheet = Sheet(14, (), "", tuple(faces), tuple(tuple(map(float, p)) for p in corners))
    answer = layers_at(sheet)
    assert [plane.plates for plane in answer.stacked.planes] == [(0, 4)]
    assert answer.orders == 1 == by_strands(answer)  # the leg comes from above
    up = answer.stacked.planes[0].frame[2][2] > 0.0
    stacks = [stack for stack in answer.order().stacks if len(stack) == 2]
    assert set(stacks) == {(0, 4) if up else (4, 0)}
