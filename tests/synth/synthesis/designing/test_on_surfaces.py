"""Triangulated sheets on a bowl and a hypar: made of flat material, movable, and as near as their samples say."""

import runpy
from dataclasses import replace
from math import pi
from pathlib import Path

import numpy as np
import pytest
from sizes import slow

from synth.synthesis.designing import DesignSearch, WishedConfiguration

BENCHMARK = runpy.run_path(str(Path(__file__).resolve().parents[4] / "benchmarks" / "sheets_on_surfaces.py"))
SLOPE = 0.3
SMALL = {
    "bowl": lambda: BENCHMARK["bowl"](2, 8, 0.6, 0.05, 0.6),
    "hypar": lambda: BENCHMARK["hypar"](4, SLOPE, 0.03, 0.3, pi),
}
MEAN = {"bowl": 0.04, "hypar": 0.012}


@pytest.mark.parametrize("name", ["hypar", slow("bowl")])
def test_small_sheets_fold_to_the_surface(name):
    figures = BENCHMARK["row"](SMALL[name](), 400)
    assert figures["success"], figures["faults"]
    assert figures["distance"] < MEAN[name]
    assert figures["residual_before"] > 0.01  # what the search begins with cannot be made of flat material
    assert max(figures["residual"], figures["flat_to"]) < 1e-12
    assert figures["flat_without_overlaps"]
    assert figures["freedoms"] == (5 if name == "bowl" else 1)
    assert figures["unfolded_to"] < 0.2 * figures["largest_fold_angle"]


@pytest.mark.parametrize("name", [slow(name) for name in BENCHMARK["CASES"]])
def test_sheets_of_the_table(name):
    figures = BENCHMARK["row"](BENCHMARK["CASES"][name]())
    assert figures["success"], figures["faults"]
    assert figures["distance"] < 0.01
    assert figures["flat_without_overlaps"]
    assert figures["unfolded_to"] < 0.2 * figures["largest_fold_angle"]


@pytest.mark.parametrize("name", SMALL)
def test_distances_of_points_of_the_surface_are_zero_and_of_others_known(name, rng):
    case = SMALL[name]()
    points = case.points(100, rng)
    assert len(points) == 100
    np.testing.assert_allclose(case.off(points), 0.0, atol=1e-12)
    normals = (
        points if name == "bowl" else np.column_stack([-SLOPE * points[:, 1], -SLOPE * points[:, 0], np.ones(100)])
    )
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    np.testing.assert_allclose(case.off(points + 0.01 * normals), 0.01, atol=2e-4)


@pytest.mark.slow
def test_any_joint_may_lead_to_a_state_that_gives_all():
    """The flat state names no driven joint, and the first one would have to turn back; another leads there."""
    case = SMALL["hypar"]()
    assert DesignSearch(case.sheet, case.wishes).design(0).success
    (fault,) = DesignSearch(case.sheet, replace(case.wishes, driver="0")).design(0).faults
    assert fault == "on another circuit than pose: flat"


def test_inputs_beside_a_state_name_the_driven_joint():
    case = SMALL["hypar"]()
    state = case.wishes.configurations[0]
    half = WishedConfiguration("half", {"3": 0.2, "5": 0.1})

    def driven(*configurations):
        problem = DesignSearch(case.sheet, replace(case.wishes, configurations=configurations)).problem
        return [str(problem.frame.joints[joint]) for joint in problem.drivers]

    assert driven(state) == list(state.inputs)
    assert driven(state, half) == driven(half, state) == ["3"]
