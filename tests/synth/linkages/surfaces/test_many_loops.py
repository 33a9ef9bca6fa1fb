"""Cones of many loops at once are those of each loop alone; loops that have none say why."""

import numpy as np
import pytest

from graphs.errors import InvariantError, UnsolvableError
from synth.linkages.surfaces import cones_of_loops, map_to_cones

DEGREES = [
    [120, 95, 45, 85], [200, 100, 70, 60], [120, 50, 120, 50], [180, 60, 60, 60], [90, 90, 90, 90], [170, 10, 20, 30],
    [0, 40, 50, 60], [400, 40, 50, 60], [np.nan, 40, 50, 60], [170, 160, 150, 140], [-30, 40, 50, 60],
]  # fmt: skip


def check(angles):
    cones = cones_of_loops(angles)
    assert len(cones) == len(angles) == len(cones.status)
    for loop, links in enumerate(angles):
        rows = np.flatnonzero(cones.loop == loop)
        try:
            wanted = map_to_cones(links)
        except InvariantError as error:
            assert cones.status[loop] == ("cannot close" if error.rule == "closed loop" else "no link angles")
            assert not len(rows)
            continue
        circles = (*wanted.flat, *wanted.cones)
        assert cones.status[loop] == ("cones" if wanted.cones or wanted.families else "no cone")
        assert len(rows) == len(circles)
        assert (cones.family_loop == loop).sum() == len(wanted.families)
        np.testing.assert_allclose(cones.size[rows], [one.size for one in circles], rtol=0, atol=1e-11)
        assert cones.flat[rows].sum() == len(wanted.flat)
        assert cones.signs[rows].tolist() == [list(one.signs) for one in circles]
        assert cones.turns[rows].tolist() == [one.turns for one in circles]
        assert cones.open[rows].tolist() == [one.circuit == "open" for one in circles]
        assert cones.double[rows].tolist() == [one.double for one in circles]
        if circles:
            np.testing.assert_allclose(cones.steps[rows], [one.steps for one in circles], rtol=0, atol=1e-11)
        np.testing.assert_allclose(cones.residual[rows], 0.0, atol=1e-12)
    return cones


def test_loops_of_all_kinds():
    cones = check(np.radians(DEGREES))
    assert set(cones.status) == {"cones", "no cone", "cannot close", "no link angles"}
    assert repr(cones[0]) == "<ConeMap: 4 links, 2 cones>"
    assert "11 loops of 4 links" in str(cones)
    assert cones.to_json()["status"] == cones.status.tolist()


@pytest.mark.parametrize("links", [3, 4, 5, 6])
def test_many_loops_at_random_and_in_whole_degrees(links):
    rng = np.random.default_rng(links)
    check(rng.uniform(0.0, 1.2 * np.pi, (80, links)))
    check(np.radians(15.0 * rng.integers(1, 12, (40, links))))


def test_no_loops_have_no_cones():
    cones = cones_of_loops(np.zeros((0, 4)))
    assert (len(cones), cones.steps.shape) == (0, (0, 4))
    assert "0 loops" in str(cones)


def test_what_are_no_rows_of_links_is_refused():
    with pytest.raises(InvariantError, match=r"an array of shape \(4,\)"):
        cones_of_loops([1.0, 1.0, 1.0, 1.0])
    with pytest.raises(InvariantError, match="n link angles in each row"):
        cones_of_loops([[1.0, 1.0]])
    with pytest.raises(UnsolvableError, match="17 links"):
        cones_of_loops(np.ones((2, 17)))
