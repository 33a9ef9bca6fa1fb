"""The solver of the page against the one in Python: the same residuals, and the same poses from the same starts."""

import re
from dataclasses import asdict, replace

import numpy as np
import pytest
from noisy import random_sheet
from page_solver import WEB, answers, asked_of

from graphs.files.formats import read
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.tolerances import EPSILON, Tolerances
from synth.analysis.folding.panel_collisions import PanelShapes
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.path import driven_path
from synth.catalogue.patterns.creases import miura
from synth.making.viewer.page_data import MovingLinkage, shown_of

SAME_RESIDUAL, SAME_POSE, SAME_PATH = 1e-12, 1e-9, 1e-9
"""Paths of several freedoms depend on the steps: both solvers take the same ones."""


def compare(things: list[MovingLinkage], *, panels: bool = True) -> int:
    """Compare both solvers on everything that moves; return how many paths were compared to their ends."""
    asked = [asked_of(moving, np.random.default_rng(number), panels=panels) for number, moving in enumerate(things)]
    whole = 0
    for one, answer in zip(asked, answers([one.question for one in asked]), strict=True):
        np.testing.assert_allclose(answer["residual"], one.residual, rtol=0, atol=SAME_RESIDUAL)
        np.testing.assert_allclose(answer["gathered"], one.gathered, rtol=0, atol=10 * SAME_RESIDUAL)
        np.testing.assert_allclose(answer["corrected"]["angles"], one.near, rtol=0, atol=SAME_POSE)
        assert max(frame["error"] for frame in answer["frames"]) <= SAME_RESIDUAL
        if one.stopped:
            assert answer["frames"][-1]["stopped"], one.stopped
            continue
        poses = [frame["angles"] for frame in answer["frames"]]
        np.testing.assert_allclose(poses, one.frames[1:], rtol=0, atol=SAME_PATH)
        for frame, places in zip(answer["frames"], one.places[:, 1:].swapaxes(0, 1), strict=True):
            np.testing.assert_allclose(np.reshape(frame["places"], (-1, 3)), places, rtol=0, atol=SAME_PATH)
        for frame, crossing in zip(answer["frames"], one.crossing[1:], strict=True):
            assert bool(frame["crossings"]) == (crossing is not None)
            assert crossing is None or list(crossing) in frame["crossings"]
        whole += 1
    return whole


def test_both_solvers_take_the_same_path(data):
    """A flat sheet, one that is folded, rounded coordinates, a linkage: with one freedom and with several.

    The solver needs node alone, and no package: so this is tested wherever node is.
    """
    flat = miura(3, 3, np.radians(60.0))
    rounded = replace(flat, coordinates=tuple(map(tuple, np.round(flat.coordinates, 4).tolist())))
    files = ("patterns/bird-base.fold", "linkages/sarrus-panels.fold", "linkages/bennett.json")
    things = [flat, rounded, *(read(data / file) for file in files)]
    assert compare([moving_of(thing) for thing in things], panels=False) == len(things)


def test_the_page_takes_what_is_zero_from_python(data):
    """With a coarser tolerance its loops count as closed sooner; the names that it reads are those of the table."""
    moving = moving_of(read(data / "linkages" / "bennett.json"))
    question = asked_of(moving, np.random.default_rng(1), panels=False).question
    linkage = question["linkage"]
    assert linkage["tolerances"] == asdict(Tolerances.of(EPSILON, len(linkage["angles"])))
    coarse = {**linkage, "tolerances": {**linkage["tolerances"], "closed": 1e-2}}
    fine, early = answers([question, {**question, "linkage": coarse}])
    assert fine["corrected"]["error"] <= linkage["tolerances"]["closed"] < early["corrected"]["error"] <= 1e-4
    told = (WEB / "src" / "solver" / "types.js").read_text(encoding="utf-8")
    typed = told.split("@typedef {object} Tolerances")[1].split("@typedef")[0]
    names = re.findall(r"@property \{number\} (\w+)", typed)
    assert names
    assert set(names) <= set(linkage["tolerances"])


@pytest.mark.web
def test_joints_that_are_held():
    """A ring of eight skew axes has two freedoms: one is driven, the other held, as both are driven in Python."""
    chance = np.random.default_rng(3)
    axes = {joint: (chance.normal(size=3).tolist(), chance.normal(size=3).tolist()) for joint in range(8)}
    moving = moving_of(HingedSolids(SCGraph(8, [(k, (k + 1) % 8) for k in range(8)]), axes))
    first, second = moving.ways.all[0].drivers
    closure = ClosureEquations(moving.linkage)
    goals = np.stack([np.linspace(0.1, 0.3, 3), np.zeros(3)], axis=1)
    path = driven_path(closure, moving.linkage.angles, [first, second], goals)
    assert not path.stopped
    question = {**asked_of(moving, chance).question, "driver": first, "held": [second], "goals": goals[:, 0].tolist()}
    (answer,) = answers([question])
    np.testing.assert_allclose([one["angles"] for one in answer["frames"]], path.angles[1:], rtol=0, atol=SAME_POSE)
    assert [one["angles"][second] for one in answer["frames"]] == [0.0, 0.0, 0.0]


@pytest.mark.web
def test_panels_that_cross():
    """Two flaps on a strip, longer than it is wide: one stands inwards already, the other is folded through it."""
    turned = np.radians(120.0)
    low, high = -1.5 * np.cos(turned), 1.5 * np.sin(turned)
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (low, 0, high), (low, 1, high), (2.5, 0, 0), (2.5, 1, 0))
    faces = ((0, 1, 2, 3), (4, 0, 3, 5), (1, 6, 7, 2))
    moving = moving_of(Sheet(8, ((0, 3), (1, 2)), "VV", faces, corners))
    one = asked_of(moving, np.random.default_rng(1))
    driver = int(np.flatnonzero(np.abs(moving.linkage.angles) < 0.1)[0])
    goals = np.radians([30.0, 60.0, 90.0, 120.0, 150.0])
    question = {**one.question, "driver": driver, "held": [1 - driver], "direction": None, "goals": goals.tolist()}
    (answer,) = answers([question])
    panels = PanelShapes(faces, range(3), moving.bodies.vertices)
    expected = [panels.crossing(np.reshape(frame["places"], (-1, 3))) for frame in answer["frames"]]
    assert [frame["crossings"] for frame in answer["frames"]] == [[list(pair)] if pair else [] for pair in expected]
    assert expected[0] is None
    assert (1, 2) in expected


def moving_of(thing) -> MovingLinkage | None:
    moving = shown_of(thing).moving
    return moving if moving is not None and moving.ways is not None else None


@pytest.mark.web
def test_patterns_and_linkages_of_the_project(data):
    places = [*data.rglob("*.fold"), *(data / "linkages").glob("*.json")]
    things = [moving for place in sorted(places) if (moving := moving_of(read(place)))]
    assert len(things) >= 20  # all but the locked cube
    assert compare(things) >= 17  # where the driver of others turns back, the page stops


@pytest.mark.web
@pytest.mark.parametrize("count", [6, pytest.param(50, marks=pytest.mark.slow)])
def test_random_sheets(count):
    sheets = [random_sheet(np.random.default_rng(seed)) for seed in range(count)]
    things = [moving for sheet in sheets if (moving := moving_of(sheet))]
    assert len(things) > count / 2
    assert compare(things) > count / 3


@pytest.mark.web
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
