"""Stowed sheets that are small beside deployed ones: at equal panels and area, by their motions without collisions."""

import runpy
from pathlib import Path

import pytest
from sizes import slow

from graphs.mechanism.sheet import Sheet
from synth.designing import Goal, JointAngle, SheetArea, WishedConfiguration, Wishes, design

BENCHMARK = runpy.run_path(str(Path(__file__).resolve().parents[3] / "benchmarks" / "stowed_designs.py"))
QUICK = "eight links, number 23"


@pytest.mark.parametrize("name", [name if name == QUICK else slow(name) for name in BENCHMARK["CASES"]])
def test_boxes_are_a_third_smaller(name):
    figures = BENCHMARK["row"](name)
    assert figures["success"], figures["faults"]
    assert figures["improved_percent"] >= 30
    assert figures["area_changed"] < 1e-12
    assert figures["residual"] <= 1e-12
    assert figures["no_collision"]


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
        assert one.defects.traced
        assert one.success is not crossed
        assert (one.faults == ("panels 0 and 2 pass through each other between begun and folded",)) is crossed
