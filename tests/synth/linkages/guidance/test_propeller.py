"""Order of positions in the plane: a propeller about a pivot against cranks that are built."""

import numpy as np
import pytest
from commands import run
from cranks import order_of
from sizes import slow

from graphs.errors import InvariantError, UnsolvableError
from synth.linkages.guidance.order import DIRECTIONS
from synth.linkages.guidance.propeller import PlanarPositions, analyse_planar_order

WAYS = {None: 0, "ccw": 1, "cw": -1}


def guided(turned, rng, *, translated=False):
    """Positions of a body on a crank of these angles about a pivot, and the pivot; turned at random, or not at all."""
    pivot, moving = rng.normal(size=2), rng.normal(size=2)
    body = np.zeros(len(turned)) if translated else rng.uniform(-np.pi, np.pi, len(turned))
    c, s = np.cos(body), np.sin(body)
    crank = rng.uniform(0.5, 2.0) * np.stack([np.cos(turned), np.sin(turned)], 1)
    carried = np.stack([c * moving[0] - s * moving[1], s * moving[0] + c * moving[1]], 1)
    return PlanarPositions(np.column_stack([pivot + crank - carried, body])), pivot


@pytest.mark.parametrize("cases", [150, slow(5000)])
def test_three_checks_agree_with_the_crank(cases):
    rng, truths = np.random.default_rng(66), []
    for case in range(cases):
        n = int(rng.integers(3, 8))
        turned = np.append(0.0, rng.uniform(0, 2 * np.pi, n - 1))
        if case % 3:
            turned[1:] = np.sort(turned[1:])[:: 1 if case % 3 == 1 else -1]
        positions, pivot = guided(turned, rng, translated=case % 10 == 0)
        truth = order_of(turned)
        found = analyse_planar_order(positions, pivot)
        assert (found.kept, found.by_inequalities, found.by_crank_angles) == (truth,) * 3, case
        assert found.misfit < 1e-6
        for way in DIRECTIONS:
            assert analyse_planar_order(positions, pivot, way).in_order is (truth == way)
        truths.append(truth)
    assert {"ccw", "cw", None} <= set(truths)


def test_a_desired_order_is_that_of_the_crank():
    rng = np.random.default_rng(7)
    turned = np.array([0.0, 2.0, 0.7, 4.0, 5.5])
    positions, pivot = guided(turned, rng)
    assert not analyse_planar_order(positions, pivot).in_order
    found = analyse_planar_order(positions, pivot, desired=[3, 2, 4, 5, 1])  # from another one on, the same way round
    assert found.in_order
    assert found.hoop.start == (2, 3)
    assert found.crank_angles == pytest.approx(np.mod(turned[[2, 1, 3, 4, 0]] - 0.7, 2 * np.pi))


def test_the_plane_is_the_limit_of_a_large_sphere():
    """Seen from far off, rotations about axes near one are turns in the plane: the hoop passes lines as it does."""
    from synth.linkages.guidance.order import analyse_order
    from synth.linkages.guidance.orientations import Orientations

    rng, radius = np.random.default_rng(3), 1e5
    positions, pivot = guided(np.sort(rng.uniform(0, 6, 5)), rng)

    def axis(point):
        return np.array([*(point / radius), 1.0])

    # the rotation about z by the angle, then that which takes the pole to the place of the origin
    matrices = []
    for x, y, turn in positions.rows:
        c, s = np.cos(turn), np.sin(turn)
        tilt = np.array([[1, 0, x / radius], [0, 1, y / radius], [-x / radius, -y / radius, 1]])
        matrices.append(tilt @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]))
    on_sphere = analyse_order(Orientations.from_matrices(np.array(matrices)), axis(pivot))
    in_plane = analyse_planar_order(positions, pivot)
    angles = {one.pair: one.angle for one in on_sphere.hoop.crossings}
    for one in in_plane.hoop.crossings:
        assert abs(np.remainder(angles[one.pair] - one.angle + 1.5, np.pi) - 1.5) < 1e-3


def test_what_has_no_order_says_why():
    rows = [(0, 0, 0), (1, 0, np.pi / 2), (0, 1, np.pi)]
    with pytest.raises(UnsolvableError, match="the fixed pivot lies on the pole P12"):
        analyse_planar_order(PlanarPositions(rows), (0.5, 0.5))
    with pytest.raises(InvariantError, match="positions 1 and 3 are equal"):
        PlanarPositions([(0, 0, 0), (1, 0, 0), (0, 0, 2 * np.pi)])
    with pytest.raises(InvariantError, match="position 4 is in the desired order, of 3 positions"):
        analyse_planar_order(PlanarPositions(rows), (2, 3), desired=[1, 2, 4])
    with pytest.raises(UnsolvableError, match="at infinity"):
        analyse_planar_order(PlanarPositions([(0, 0, 0), (1, 0, 0), (3, 0, 0)]), (0.5, 1.0))


def test_positions_on_the_command_line():
    where = ["--position", "2,0,0", "--position", "0,2,20", "--position", "-1,-1.7320508,70", "--pivot", "0,0"]
    out = run("order", *where).stdout
    assert "3 positions, crank about (0, 0) turning counter-clockwise" in out
    assert "needed: P13 => P23" in out
    assert "kept by: propeller counter-clockwise, inequalities counter-clockwise, crank counter-clockwise" in out
    assert "crank angles: 0.000, 90.000, 240.000" in out
    run("order", *where, "--desired", "1,3,2", code=1)
    assert "--position requires --pivot" in run("order", *where[:6], code=2).stderr
