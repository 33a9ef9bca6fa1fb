"""Vertices by themselves: crimps against all layer orders of the vertex, and vertices moved to where images close."""

from itertools import product
from math import pi

import numpy as np
import pytest
from folded_sheets import folded_sheet, vertex_of
from sizes import slow

import synth
from graphs.mechanism.sheet import Sheet
from synth.analysis.layering.image import folded, image_of
from synth.analysis.layering.orders import flat_pattern, valleys_of
from synth.analysis.layering.sweep import count_by_cells


def sectors_of(rng, count):
    """Sectors, every other of which add up to 180 degrees; some are equal."""
    parts = rng.integers(1, 5, count).astype(float) if rng.random() < 0.6 else rng.uniform(0.3, 2.0, count)
    parts[::2] *= pi / parts[::2].sum()
    parts[1::2] *= pi / parts[1::2].sum()
    return parts


def image_of_pattern(pattern):
    return image_of(folded(pattern.sheet, pattern.mechanism, pattern.points), 1e-9)


@pytest.mark.parametrize("seed", [*range(3), *(slow(seed) for seed in range(3, 100))])
def test_crimps_agree_with_layer_orders(seed):
    rng = np.random.default_rng(seed)
    count = int(rng.choice([4, 4, 6]))
    sectors = sectors_of(rng, count)
    image = image_of_pattern(flat_pattern(vertex_of(sectors, "U" * count)))
    for letters in map("".join, product("MV", repeat=count - 1)):
        pattern = flat_pattern(vertex_of(sectors, f"M{letters}"))
        orders = count_by_cells(image, valleys_of(pattern.sheet, pattern.mechanism))
        [vertex] = pattern.vertices
        assert vertex.kawasaki
        assert vertex.crimps == (orders > 0), letters
        assert vertex.maekawa or not orders
    assert synth.layers(pattern.sheet).orders == orders
    free = vertex_of(sectors, "U" * count)
    assert flat_pattern(free).vertices[0].crimps


def test_faults_in_words():
    odd = synth.layers(vertex_of([2.0, 2.0, 2 * pi - 4.0], "MMV"))
    assert odd.fault == "vertex 0 at (0, 0): 3 creases, an odd number"
    unequal = synth.layers(vertex_of([1.0, 1.0, 1.5, 2 * pi - 3.5], "MMMV"))
    assert "every other sector adds up to" in unequal.fault
    alike = synth.layers(vertex_of([pi / 2] * 4, "MMVV"))
    assert alike.fault == "vertex 0 at (0, 0): 2 mountains and 2 valleys"


@pytest.mark.parametrize("seed", [*range(3), *(slow(seed) for seed in range(3, 30))])
def test_rounded_patterns_close_again(seed):
    """Five decimals of a sheet that folds flat: vertices are moved by the precision at most, and the orders stay."""
    rng = np.random.default_rng(seed)
    sheet, _ = folded_sheet(rng, 4, 25)
    rounded = tuple((round(x, 5), round(y, 5)) for x, y in sheet.coordinates)
    exact = synth.layers(sheet)
    answer = synth.layers(Sheet(sheet.vertices, sheet.edges, sheet.assignments, sheet.faces, rounded))
    assert answer.orders == exact.orders
    assert several(answer) == several(exact)
    assert answer.moved <= 4 * answer.precision.size


def several(answer):
    return sorted(component.orders for component in answer.components)
