"""Rounded crease patterns fold flat as the exact ones do, or are refused with the precision that would do."""

from dataclasses import replace

import numpy as np
import pytest
from folded_sheets import folded_sheet
from sizes import slow_but

import synth
from graphs.mechanism.precision import extent_of
from synth.analysis.layering.local import FlatVertex
from synth.analysis.layering.needed_precision import rounded_up

HUNDRED = 100.0
"""The extent of the patterns."""


def placed(sheet, places):
    return replace(sheet, coordinates=tuple(map(tuple, places.tolist())))


def pattern(seed):
    sheet, _ = folded_sheet(np.random.default_rng(seed), 4, 14)
    places = np.array(sheet.coordinates)[:, :2]
    return placed(sheet, places * HUNDRED / extent_of(places))


def turned(places, angle):
    c, s = np.cos(angle), np.sin(angle)
    return places @ np.array([[c, s], [-s, c]])


@pytest.mark.parametrize("seed", slow_but({0, 1, 22}, range(75)))
def test_rounded_and_turned_back(seed):
    """Where no inner vertex says anything of the error nothing is estimated, and a copy may be refused: a known gap."""
    sheet, rng = pattern(seed), np.random.default_rng(seed)
    exact = synth.layers(sheet, explain=False)
    if not exact.vertices:
        pytest.xfail("no inner vertex says anything of the error: nothing is estimated")
    for decimals in (3, 4, 5, 6):
        angle = rng.uniform(0.0, 2.0 * np.pi)
        places = turned(turned(np.array(sheet.coordinates), angle).round(decimals), -angle)
        answer = synth.layers(placed(sheet, places), explain=False)
        told = answer.orders if answer.needed is None else answer.needed.orders
        assert told == exact.orders
        if answer.needed is not None:
            assert not answer.foldable
            assert synth.layers(placed(sheet, places), precision=answer.needed.precision).orders == exact.orders


@pytest.mark.parametrize("seed", slow_but({0, 1, 2}, range(100)))
def test_a_real_fault_is_refused(seed):
    sheet, rng = pattern(seed), np.random.default_rng(seed)
    vertices = synth.layers(sheet, explain=False).vertices
    if not vertices:
        pytest.skip("no vertex inside")
    moved, way = vertices[int(rng.integers(len(vertices)))].vertex, turned(np.array([1.0, 0.0]), rng.uniform(0.0, 6.0))
    for step in np.linspace(0.02, 3.0, 60):
        places = np.array(sheet.coordinates)
        places[moved] += step * way
        answer = synth.layers(placed(sheet, places), explain=False)
        if max(np.degrees(vertex.off) for vertex in answer.vertices) >= 0.05:
            break
    else:
        pytest.skip("its creases are in line with the step")
    assert not answer.foldable
    assert "every other sector" in answer.fault


@pytest.mark.parametrize("off", [1e-9, 1e-6, 6e-5, 0.5])
def test_sums_have_digits_enough_to_differ(off):
    vertex = FlatVertex(0, (0.0, 0.0), (0, 1, 2, 3), (1, 2, 3, 4), "MMMV", (1.5,) * 4, off, 0.0)
    more, less = (float(word) for word in vertex.fault.split() if word[0].isdigit())
    assert more - less == pytest.approx(2.0 * np.degrees(off), rel=0.1)


def test_rounding_up_to_one_digit():
    assert [rounded_up(number) for number in (1.2e-4, 2e-5, 9.9e-7, 1.0)] == [2e-4, 2e-5, 1e-6, 1.0]
