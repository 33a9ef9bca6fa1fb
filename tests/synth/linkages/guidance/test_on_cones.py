"""Guided four-bars on cones: rebuilt in space, their joint lines are those of the linkage and rulings of the cone."""

import numpy as np
import pytest
from cranks import lines_apart, random_orientations
from sizes import slow

from synth.linkages.guidance.fourbars import conical_forms, four_bars
from synth.linkages.guidance.orientations import read_orientations
from synth.linkages.guidance.synthesis import dyads_of_five


def rebuilt(cone):
    """Four rulings of a cone about z, the steps of the loop apart: G_2, G_1, W_1, W_2."""
    at = np.concatenate([[0.0], np.cumsum(cone.steps)[:3]])
    flat = np.cos(cone.size)
    return np.stack([flat * np.cos(at), flat * np.sin(at), np.full(4, np.sin(cone.size))], axis=1)


def angle(a, b):
    return np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b)


def check(one):
    links = np.asarray(one.link_angles)
    number = 0
    for form in conical_forms(one):
        made = np.asarray(form.link_angles)
        assert np.minimum(made, np.pi - made) == pytest.approx(np.minimum(links, np.pi - links), abs=1e-9)
        assert np.sum(np.abs(made - links) > 1e-9) % 2 == 0  # an axis turned round changes two links
        for cone in form.cones:
            axes = rebuilt(cone)
            around = [angle(axes[k], axes[(k + 1) % 4]) for k in range(4)]
            assert around == pytest.approx(made, abs=1e-9)
            assert np.remainder(sum(cone.steps) + 1e-9, 2.0 * np.pi) < 1e-6
            number += 1
    return number


@pytest.mark.parametrize("wanted", [2, slow(12)])
def test_cones_rebuilt_have_the_link_angles(wanted):
    rng = np.random.default_rng(71)
    numbers = []
    while len(numbers) < wanted:
        given = random_orientations(5, rng)
        numbers += [check(one) for one in four_bars(given, dyads_of_five(given).dyads)[:2]]
    assert max(numbers) > 0


def test_the_crank_rocker_lies_on_eight_cones(data):
    given = read_orientations(data / "orientations" / "crank-rocker.json")
    best = four_bars(given, dyads_of_five(given).dyads)[0]
    forms = conical_forms(best)
    assert check(best) == 8
    assert [round(float(np.degrees(c.size)), 4) for c in forms[0].cones] == [55.0986, 59.3672]
    assert np.all(np.diff([sum(form.link_angles) for form in forms]) > -1e-9)
    assert lines_apart(best.driver.fixed, (0, 0, 1)) < 1e-9
