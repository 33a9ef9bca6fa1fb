"""Turning points that are passed, limits and rank drops that are named: closed forms and planar linkages."""

from dataclasses import replace

import numpy as np
import pytest
from creased import is_zigzag

from graphs.convert.duality import mechanism_of_sheet
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from synth.analysis.folding.motion import fold
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import linkage_of_axes
from synth.analysis.motion.path import driven_path
from synth.analysis.motion.walk import step
from synth.catalogue.patterns.creases import fan, miura


def planar(links, joints, loops, places):
    graph = SCGraph(links, joints, [Loop(loop, "infinite") for loop in loops])
    return linkage_of_axes(graph, {joint: ((*at, 0), (0, 0, 1)) for joint, at in enumerate(places)})


def four_bar(*places):
    return planar(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [range(4)], places)


def six_bar():
    """A crank and rocker; an arm of the rocker moves a second one through the pose in which that turns back."""
    joints = [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)]
    arm = (4 + 0.8 * np.cos(np.radians(200)), 0.8 * np.sin(np.radians(200)))
    places = [(0, 0), (0, 1), (3, 2.5), (4, 0), arm, (7.5, 2.5), (8, 0)]
    return planar(6, joints, [range(4), range(3, 7)], places)


def kinds(path):
    return [event.kind for event in path.events]


def test_turning_points_of_the_driver_are_passed():
    linkage = six_bar()
    closure = ClosureEquations(linkage)
    valley = driven_path(closure, linkage.angles, [0], np.radians([80])).angles[-1]
    goal = np.radians(0.8)
    path = driven_path(closure, valley, [6], [goal])
    assert path.stopped == ""
    assert path.angles[-1][6] == goal
    assert kinds(path) == ["turning point"] * 2
    hill, bottom = path.angles[1:3]
    assert hill[6] < goal > bottom[6] < valley[6] < hill[6]
    assert [event.frame for event in path.events] == [1, 2]
    assert path.errors.max() < 1e-12
    by_crank = driven_path(closure, linkage.angles, [0], np.append(np.radians([80, 150, 220]), path.angles[-1][0]))
    np.testing.assert_allclose(by_crank.angles[-1], path.angles[-1], atol=1e-9)
    for top in path.events:  # the crank a little before and after: the driver is less far at both
        near = [driven_path(closure, top.angles, [0], [top.angles[0] + aside]).angles[-1][6] for aside in (-0.01, 0.01)]
        assert len(set(np.sign(np.array(near) - top.angles[6]))) == 1


def test_what_is_out_of_reach_is_told_with_how_far_it_came():
    linkage = six_bar()
    closure = ClosureEquations(linkage)
    valley = driven_path(closure, linkage.angles, [0], np.radians([80])).angles[-1]
    path = driven_path(closure, valley, [6], np.radians([2.0]))
    assert kinds(path) == ["turning point"] * 3
    assert path.angles[-1][6] == path.angles[:, 6].max()
    round_the_top = driven_path(closure, path.angles[-1], [0], path.angles[-1][0] + np.radians([-0.2, -0.1, 0.1, 0.2]))
    assert (round_the_top.angles[1:, 6] < path.angles[-1][6]).all()
    assert "turns back at 1.03816°" in path.stopped
    assert "before 2°; past that, the path comes round to there" in path.stopped


def test_a_rocker_turns_back_where_crank_and_coupler_are_in_line():
    linkage = four_bar((0, 0), (0, 1), (3.0, 2.5), (4, 0))
    crank, coupler, rocker, ground = 1.0, np.hypot(3.0, 1.5), np.hypot(1.0, 2.5), 4.0
    path = driven_path(ClosureEquations(linkage), linkage.angles, [3], np.radians([5, 60]))
    reach = coupler - crank
    inner = np.pi - np.arccos((ground**2 + rocker**2 - reach**2) / (2 * ground * rocker))
    outer = np.pi - np.arccos((ground**2 + rocker**2 - (coupler + crank) ** 2) / (2 * ground * rocker))
    start = np.arctan2(2.5, -1.0)  # the joint's second link is the ground
    assert path.angles[-1][3] == pytest.approx(start - min(inner, outer), abs=1e-12)
    assert [kinds(path), path.events[0].frame] == [["turning point"], 2]
    assert "turns back" in path.stopped


@pytest.mark.parametrize("whole", [400, 0])
@pytest.mark.parametrize("angles", [(80, 200), pytest.param((90, 200), marks=pytest.mark.slow), (45, 90, 100, 200)])
def test_a_parallelogram_stays_one_past_its_flat_position(angles, whole, monkeypatch):
    """By all singular values, and as of linkages of many joints by the one that is followed."""
    monkeypatch.setattr(step, "_WHOLE", whole)
    linkage = four_bar((0, 0), (2, 0), (2, 1), (0, 1))
    path = driven_path(ClosureEquations(linkage), linkage.angles, [0], np.radians(angles))
    assert path.stopped == ""
    assert kinds(path) == ["rank drop"]
    (event,) = path.events
    assert np.degrees(event.angles) == pytest.approx([90, -90, 90, -90], abs=1e-4)
    assert (event.drop, event.other_ways) == (1, 1)
    assert event.line("abcd").startswith(
        "singular configuration at joint 'a' = 90°: rank of the closure equations 1 lower"
    )
    np.testing.assert_allclose(path.angles[-1], np.radians([200, -200, 200, -200]), atol=1e-9)


def test_regular_paths_meet_nothing():
    linkage = four_bar((0, 0), (0, 1), (3.0, 2.5), (4, 0))
    path = driven_path(ClosureEquations(linkage), linkage.angles, [0], np.radians([90, 180, 270, 360]))
    assert (path.stopped, path.events, path.watched) == ("", (), True)
    folded = fold(miura(2, 2, 1.0), frames=2)
    assert (folded.path.stopped, folded.path.events) == ("", ())


@pytest.mark.parametrize("driven", [0, *(pytest.param(joint, marks=pytest.mark.slow) for joint in (1, 2, 3))])
def test_a_vertex_that_folds_flat_does_so_exactly(driven):
    folded = fold(fan(np.radians([0, 60, 180, 300]), "MVVV"), drive={driven: np.pi}, frames=6)
    assert folded.path.stopped == ""
    assert np.abs(folded.path.angles[-1]).tolist() == [np.pi] * 4
    assert kinds(folded.path) == ["rank drop", "limit"]
    assert folded.path.events[1].joints == (0, 1, 2, 3)


@pytest.mark.parametrize(
    "size", [(2, 2), *(pytest.param(size, marks=pytest.mark.slow) for size in ((3, 3), (6, 6), (15, 15), (40, 40)))]
)
def test_a_miura_sheet_folds_flat(size):
    sheet = miura(*size, np.radians(60))
    joints = tuple(mechanism_of_sheet(sheet).sc.joints)
    driven = joints[int(np.flatnonzero(is_zigzag(sheet, joints))[0])]
    folded = fold(sheet, drive={driven: np.pi if sheet.assignments[driven] == "V" else -np.pi}, frames=3)
    assert folded.path.stopped == ""
    assert np.abs(folded.path.angles[-1]).tolist() == [np.pi] * len(joints)
    assert kinds(folded.path) == ["rank drop", "limit"]
    assert folded.path.events[0].drop == sum(size) - 3  # one freedom before, and all lines when flat
    assert folded.closure < 1e-12


def test_a_limit_names_joints_by_their_ids():
    """Edges of the rim come first, so that ids are not places."""
    bare = fan(np.radians([0, 70, 170, 290]), "MVVV")
    rim = tuple((k, k % 4 + 1) for k in range(1, 5))
    folded = fold(replace(bare, edges=rim + bare.edges, assignments="BBBB" + bare.assignments), drive={4: np.pi})
    assert "panels lie on each other at joint 7, with the driven joint 4 at 123.1" in folded.path.stopped
    (event,) = folded.to_json()["events"]
    assert (event["kind"], event["joints"], event["driver"]) == ("limit", [7], 4)
    assert abs(folded.path.angles[-1][3]) == pytest.approx(np.pi, abs=1e-8)
    assert ": panels lie on each other at joint 7" in str(folded)
