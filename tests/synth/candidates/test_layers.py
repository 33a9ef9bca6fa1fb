"""Layers: rows, pictures and their titles agree, and no two links of a layer overlap."""

from __future__ import annotations

import numpy as np
import pytest
from conical import WATT

from enumerate.runner.columns import row_as_dict
from synth.candidates.job import CandidateJob
from synth.candidates.pictures import picture_of_row, title_of_picture
from synth.conformed.layers import layers, links_in_layers
from synth.conformed.rates import ConformedChain

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


@pytest.mark.parametrize(("units", "number"), [(1, 120), pytest.param(None, 360, marks=pytest.mark.slow)])
def test_title_picture_and_row_agree_for_watt_orders(units, number):
    job = CandidateJob(WATT, (WATT_BINARY,))
    chain = ConformedChain.of(WATT, WATT_BINARY)
    rows = rows_of_units(job, units)
    assert len(rows) == number
    for row in rows:
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


def test_the_picture_has_the_layers_of_its_title():
    pytest.importorskip("matplotlib")
    job = CandidateJob(WATT, (WATT_BINARY,))
    for row in rows_of_units(job, 1)[::64]:
        figure = picture_of_row(job, row)
        radii = {
            round(float(np.hypot(*line.get_data())[0]), 6)
            for line in figure.axes[0].lines
            if line.get_label().startswith("link")
        }
        title = figure.get_suptitle()
        assert f"layers {len(radii)}" in title
