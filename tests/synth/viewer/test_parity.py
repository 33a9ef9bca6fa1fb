"""The solver of the page against the one in Python: the same residuals, and the same poses from the same starts."""

import numpy as np
import pytest
from noisy import random_sheet
from page_solver import answers, asked_of

from graphs.files.formats import read
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from synth.viewer.shown import Moving, shown_of

pytestmark = pytest.mark.web

SAME_RESIDUAL, SAME_POSE = 1e-12, 1e-9
DRIFT = 1e-6
"""With several freedoms rounding moves poses along them; the factors multiply it by up to 1e9."""


def compare(things: list[Moving]) -> int:
    """Compare both solvers on everything that moves; return how many paths were compared to their ends."""
    asked = [asked_of(moving, np.random.default_rng(number)) for number, moving in enumerate(things)]
    whole = 0
    for one, answer in zip(asked, answers([one.question for one in asked]), strict=True):
        np.testing.assert_allclose(answer["residual"], one.residual, rtol=0, atol=SAME_RESIDUAL)
        np.testing.assert_allclose(answer["gathered"], one.gathered, rtol=0, atol=10 * SAME_RESIDUAL)
        np.testing.assert_allclose(answer["corrected"]["angles"], one.near, rtol=0, atol=SAME_POSE)
        assert max(frame["error"] for frame in answer["frames"]) <= SAME_RESIDUAL
        if one.stopped:
            assert answer["frames"][-1]["stopped"], one.stopped
            continue
        tolerance = SAME_POSE if one.freedoms == 1 else DRIFT
        poses = [frame["angles"] for frame in answer["frames"]]
        np.testing.assert_allclose(poses, one.frames[1:], rtol=0, atol=tolerance)
        for frame, places in zip(answer["frames"], one.places[:, 1:].swapaxes(0, 1), strict=True):
            np.testing.assert_allclose(np.reshape(frame["places"], (-1, 3)), places, rtol=0, atol=tolerance)
        whole += 1
    return whole


def moving_of(thing) -> Moving | None:
    moving = shown_of(thing).moving
    return moving if moving is not None and moving.ways is not None else None


def test_patterns_and_linkages_of_the_project(data):
    places = [*data.rglob("*.fold"), *(data / "linkages").glob("*.json")]
    things = [moving for place in sorted(places) if (moving := moving_of(read(place)))]
    assert len(things) >= 20  # all but the locked cube
    assert compare(things) >= 17  # where the driver of others turns back, the page stops


@pytest.mark.parametrize("count", [6, pytest.param(50, marks=pytest.mark.slow)])
def test_random_sheets(count):
    sheets = [random_sheet(np.random.default_rng(seed)) for seed in range(count)]
    things = [moving for sheet in sheets if (moving := moving_of(sheet))]
    assert len(things) > count / 2
    assert compare(things) > count / 3


@pytest.mark.parametrize("centre", ["finite", "infinite"])
def test_rings_about_a_centre(centre, rng):
    """Planar loops have frames; of the crease patterns none has one."""
    directions, points = rng.normal(size=(6, 3)), rng.normal(size=(6, 3))
    if centre == "finite":
        points = 2.0 + directions * rng.normal(size=(6, 1))
    else:
        directions = np.outer(rng.choice([-1.0, 1.0], 6), directions[0])
    chain = SCGraph(6, [(k, (k + 1) % 6) for k in range(6)], [Loop(range(6), centre)])
    axes = dict(enumerate(zip(points.tolist(), directions.tolist(), strict=True)))
    assert compare([moving_of(HingedSolids(chain, axes))]) == 1
