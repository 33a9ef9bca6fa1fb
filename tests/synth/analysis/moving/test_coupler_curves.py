"""Coupler curves: points of links in each frame, against the circles of a planar four-bar."""

import json

import numpy as np
import pytest
from commands import run

import synth
from graphs.errors import InvariantError
from graphs.files.formats import write
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids

CORNERS = np.array([[0.0, 0.0], [0.3, 1.0], [2.0, 1.5], [2.2, 0.0]])
POINT = np.array([1.0, 2.0])


def four_bar():
    ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    return HingedSolids(ring, {j: ((*corner.tolist(), 0.0), (0.0, 0.0, 1.0)) for j, corner in enumerate(CORNERS)})


def by_circles(turn):
    """Where the coupler point is: the coupler's ends are on circles about the crank's and the rocker's joints."""
    _, b, c, d = CORNERS
    co, si = np.cos(turn), np.sin(turn)
    crank = np.array([[co, -si], [si, co]]) @ b
    along = d - crank
    far, first, second = np.hypot(*along), np.hypot(*(c - b)), np.hypot(*(c - d))
    part = (far**2 + first**2 - second**2) / (2 * far)
    across = np.array([-along[1], along[0]]) / far
    end = crank + part * along / far + np.sqrt(first**2 - part**2) * across
    before, after = (complex(*(c - b)), complex(*(end - crank)))
    place = complex(*crank) + complex(*(POINT - b)) * after / before
    return [place.real, place.imag, 0.0]


def test_a_coupler_curve_of_a_four_bar():
    motion = synth.move(four_bar(), drive={0: np.radians(60)}, frames=6)
    path = motion.path_of(2, POINT)
    wanted = [by_circles(turn) for turn in motion.path.angles[:, 0]]
    np.testing.assert_allclose(path, wanted, atol=1e-12)


def test_the_command_prints_the_same(tmp_path):
    write(four_bar(), tmp_path / "four.json")
    words = ("fold", tmp_path / "four.json", "--drive", "0=60", "--frames", 3, "--point", "2=1,2")
    document = json.loads(run(*words, "--json").stdout)
    [path] = document["points"].values()
    np.testing.assert_allclose(path, [by_circles(np.radians(turn)) for turn in (0, 20, 40, 60)], atol=1e-10)
    assert "point 2=1,2" in run(*words).stdout
    assert "--point" in run("fold", tmp_path / "four.json", "--point", "2", code=2).stderr


def test_what_is_no_point_of_a_link():
    motion = synth.move(four_bar(), frames=2)
    with pytest.raises(InvariantError, match="9 is no link"):
        motion.path_of(9, POINT)
    with pytest.raises(InvariantError, match="4 coordinates"):
        motion.path_of(2, [1, 2, 3, 4])
