"""Layers: rows, pictures and their titles agree, and no two links of a layer overlap."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from conical import WATT
from sizes import slow

from enumerate.runner.job import row_as_dict
from synth.linkages.conformed.rates import ConformedChain
from synth.linkages.conformed.rates_over_angles import layers, links_in_layers
from synth.synthesis.candidates.job import CandidateJob
from synth.synthesis.candidates.pictures import picture_of_row, title_of_picture

WATT_BINARY = 1


def overlap(one, other):
    """Tell whether arcs share more than ends."""
    apart = (other[0] - one[0]) % (2 * np.pi)
    return apart < one[1] - 1e-9 or 2 * np.pi - apart < other[1] - 1e-9


def check_laid(chain, places):
    """Check that arcs end at joints of their links and lie apart in each layer; return how many layers."""
    laid = links_in_layers(chain, places)
    for joints, (start, length) in zip(chain.joints_of, laid.arcs, strict=True):
        along = np.remainder(places[list(joints)] - start + 1e-9, 2 * np.pi) - 1e-9
        assert along.min() == pytest.approx(0, abs=1e-9)
        assert along.max() == pytest.approx(length, abs=1e-9)
        assert length < np.pi + 1e-9 or len(joints) > 2
    together = [(i, j) for i in range(len(laid.layers)) for j in range(i) if laid.layers[i] == laid.layers[j]]
    assert not any(overlap(laid.arcs[i], laid.arcs[j]) for i, j in together)
    assert set(laid.layers.tolist()) == set(range(laid.layers.max() + 1))
    return int(laid.layers.max()) + 1


def rows_of_units(job, most):
    """The rows of the first units of a job: all of them without a limit."""
    return [row_as_dict(job.columns, row) for unit in job.units()[:most] for row in job.work(unit.payload)]


@cache
def watt_rows(units):
    """The rows of the orders of Watt's chain, listed once."""
    return rows_of_units(CandidateJob(WATT, (WATT_BINARY,)), units)


@pytest.mark.parametrize(("units", "number", "every"), [(1, 120, 4), slow(None, 360, 1)])
def test_title_picture_and_row_agree_for_watt_orders(units, number, every):
    job = CandidateJob(WATT, (WATT_BINARY,))
    chain = ConformedChain.of(WATT, WATT_BINARY)
    rows = watt_rows(units)
    assert len(rows) == number
    for row in rows[::every]:
        places = job.places(row)
        drawn = check_laid(chain, places)
        assert drawn == int(layers(chain, places[np.newaxis])[0])
        assert row["layers"] <= drawn <= row["most_layers"]
        assert f"layers {drawn}" in title_of_picture(row, drawn)


def test_rows_at_angles_and_with_opposites_are_drawn_in_as_many_layers_as_they_say():
    for job in (CandidateJob(WATT, (WATT_BINARY,), samples=1), CandidateJob(WATT, (0,), slots=7)):
        chain = ConformedChain.of(WATT, job.grounds[0])
        for row in job.rows():
            assert check_laid(chain, job.places(row)) == row["layers"]
            assert title_of_picture(row, row["layers"]).endswith(f"layers {row['layers']}")


@pytest.mark.parametrize("every", [60, slow(16)])
def test_the_layers_of_the_picture_are_those_of_its_title(every):
    """Arcs of links at as many radii as are told, and those at one radius apart; on the cone the same layers."""
    job = CandidateJob(WATT, (WATT_BINARY,))
    for row in watt_rows(1)[::every]:
        scene = picture_of_row(job, row)
        circle, cone = scene.layers[:2]
        arcs = {}
        for shape in circle.shapes:
            if "layer" in dict(shape.data):
                x, y = np.array(shape.points).T - 120
                arcs.setdefault(dict(shape.data)["layer"], []).append((np.hypot(x, y), np.arctan2(y, x)))
        radii = {round(float(far), 4) for links in arcs.values() for radius, _ in links for far in radius}
        told = " ".join(label.text for label in scene.layers[-1].shapes)
        assert f"layers {len(radii)}" in told
        assert f"links in {len(radii)} layer" in told
        for links in arcs.values():
            gaps = [
                np.abs(np.angle(np.exp(1j * (one[:, None] - other)))).min()
                for i, (_, one) in enumerate(links)
                for _, other in links[:i]
            ]
            assert min(gaps, default=1.0) > 0.02
        on_cone = {
            dict(shape.data)["link"]: dict(shape.data)["layer"] for shape in cone.shapes if "layer" in dict(shape.data)
        }
        on_circle = {
            dict(shape.data)["link"]: dict(shape.data)["layer"]
            for shape in circle.shapes
            if "layer" in dict(shape.data)
        }
        assert on_cone == on_circle
