"""Circuits of loops of any number of links, by the order of their joints round the circle."""

from __future__ import annotations

import numpy as np
import pytest
from conical import random_linkages, wrap
from paper_formulas import table1

from synth.linkages.surfaces.circuit import azimuths, circuits, closing_step, wrapped


@pytest.mark.parametrize("links", [3, 4, 5, 6, 7])
def test_open_loops_visit_their_joints_in_cyclic_order(links, rng):
    places, steps, _, _ = random_linkages(rng, 20_000, links)
    found = circuits(steps)
    order = np.argsort(np.argsort(np.remainder(places, 2 * np.pi), axis=1), axis=1)
    on = (np.roll(order, -1, axis=1) - order) % links
    forward, back = (on == 1).all(axis=1), (on == links - 1).all(axis=1)
    assert (found.open == (forward | back)).all()
    assert found.open.sum() > 5
    # how often the polygon winds: descents of the order, the shorter way round
    winds = (np.roll(order, -1, axis=1) < order).sum(axis=1)
    assert (found.density == np.minimum(winds, links - winds)).all()
    assert np.abs(found.residual).max() < 1e-12
    np.testing.assert_allclose(steps.sum(axis=1), 2 * np.pi * found.turns, atol=1e-12)
    mirrored = circuits(-steps)
    assert (mirrored.open == found.open).all()
    assert (mirrored.turns == -found.turns).all()


def test_table_1_is_the_general_rule_for_four(rng):
    _, steps, _, _ = random_linkages(rng, 10_000)
    assert (table1(steps) == circuits(steps).open).all()


def test_azimuths_leave_the_error_to_the_longest_step(rng):
    _, steps, _, _ = random_linkages(rng, 500, 5)
    places = azimuths(steps + rng.normal(scale=1e-9, size=steps.shape), 0.3)
    again = wrap(np.roll(places, -1, axis=1) - places)
    off = np.abs(again - steps)
    longest = np.abs(steps).argmax(axis=1)
    np.put_along_axis(off, longest[:, None], 0.0, axis=1)
    assert off.max() < 1e-8
    assert (places[:, 0] == 0.3).all()


def test_lambda_and_all_steps_but_one_describe_a_loop(rng):
    _, steps, _, _ = random_linkages(rng, 500, 6)
    np.testing.assert_allclose(closing_step(steps[:, :-1]), wrapped(steps[:, -1]), atol=1e-12)
