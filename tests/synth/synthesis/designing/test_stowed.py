"""Stowed sheets that are small beside deployed ones: at equal panels and area, by their motions without collisions."""

import runpy
from pathlib import Path

import numpy as np
import pytest
from sizes import slow

from graphs.mechanism.sheet import Sheet
from synth.synthesis.designing import Goal, JointAngle, SheetArea, WishedConfiguration, Wishes, design

BENCHMARKS = Path(__file__).resolve().parents[4] / "benchmarks"
BENCHMARK = runpy.run_path(str(BENCHMARKS / "stowed_designs.py"))
FLASHERS = runpy.run_path(str(BENCHMARKS / "flashers.py"))
QUICK = "eight links, number 23"


@pytest.mark.parametrize("name", [name if name == QUICK else slow(name) for name in BENCHMARK["CASES"]])
def test_boxes_are_a_third_smaller(name):
    figures = BENCHMARK["row"](name)
    assert figures["success"], figures["faults"]
    assert figures["improved_percent"] >= 30
    assert figures["area_changed"] < 1e-12
    assert figures["residual"] <= 1e-12
    assert figures["no_collision"]


@pytest.mark.parametrize("sides", [3, 4, 6, 8])
def test_a_flasher_of_the_plane_wraps_its_hub_and_lengths_have_exact_derivatives(sides):
    """On a sphere that is nearly a plane lengths agree but for its curvature, which shrinks with its radius."""
    openings = []
    for radius in (1e3, 1e4):
        flasher = FLASHERS["Flasher"](sides, radius=radius)
        openings.append(float(np.abs(flasher.misses(flasher.start())[0]).max()))
    assert openings[0] < 1e-4
    assert openings[1] == pytest.approx(openings[0] / 100, rel=0.01)
    flasher = FLASHERS["Flasher"](sides)
    numbers, step = flasher.start(), 1e-6
    ends = [[flasher.misses(numbers + sign * step * one)[0] for sign in (1, -1)] for one in np.eye(len(numbers))]
    differences = np.array([(ahead - behind) / (2 * step) for ahead, behind in ends]).T
    assert np.abs(flasher.misses(numbers)[1] - differences).max() < 1e-7


@pytest.mark.parametrize("sides", [3, 4, 6, 8])
def test_flashers_on_a_sphere_close_where_they_are_stowed(sides):
    """Lengths agree; as a second method the deployed sheet closes at the fold angles of the stowed one."""
    figures = FLASHERS["row"](sides, starts=2)
    assert figures["sound"] == 2
    assert max(figures["opening"], figures["closure_stowed"], figures["off_sphere"]) <= 1e-12
    assert not figures["panels_cross_deployed"]
    assert figures["verdict"] == f"Rigid-foldable from this configuration: {2 * sides} degrees of freedom."


def test_panels_that_pass_through_each_other_make_no_design():
    """A strip of three panels, whose long ends cross when both creases fold by 120 degrees."""
    places = ((0.0, 0.0), (3.0, 0.0), (4.0, 0.0), (7.0, 0.0), (7.0, 1.0), (4.0, 1.0), (3.0, 1.0), (0.0, 1.0))
    strip = Sheet(8, ((1, 6), (2, 5)), "VV", ((0, 1, 6, 7), (1, 2, 5, 6), (2, 3, 4, 5)), places)
    area = SheetArea(goal=Goal(equals=7.0))
    for angle, crossed in ((2.0, True), (1.0, False)):
        configurations = (
            WishedConfiguration("begun", {"0": 0.3, "1": 0.3}),
            WishedConfiguration("folded", {"0": angle, "1": angle}),
        )
        wishes = Wishes((JointAngle(at="folded", joint="0", goal=Goal(equals=angle)), area), configurations)
        found = design(strip, wishes, starts=1)
        (one,) = (*found.pareto, *found.failures)
        assert one.freedoms == 2
        assert one.traced
        assert one.success is not crossed
        assert (one.faults == ("panels 0 and 2 pass through each other between begun and folded",)) is crossed
