"""Conical linkages moved from the conformed position: closed form, paths, points of links, first order."""

import json

import numpy as np
import pytest
from commands import run

from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from synth.conformed.behaviours import Way, behaviour
from synth.conformed.four_bar_poses import poses_from_conformed
from synth.conformed.linkages import linkage_on_cones, loop_of_steps, loop_on_cones
from synth.conformed.pose import joint_axes
from synth.fourbar.position import input_limits_spherical
from synth.motion.closure import ClosureEquations
from synth.motion.path import driven_path
from synth.motion.placement import link_motions
from synth.moving.conical import move_on_cone

CRANK, ROCKER = (40, 90, 80, 100), (120, 95, 45, 85)


@pytest.fixture(scope="module")
def rocker():
    first, _ = loop_on_cones(np.radians(ROCKER))
    return move_on_cone(first, driver="2", at=np.radians([-20, 3]))


def turned(angle):
    return np.remainder(angle + np.pi, 2 * np.pi) - np.pi


def agrees_with_the_closed_form(motion):
    """Input at joint 2 (O), output at joint 1 (C): McCarthy's angles, and where cosines leave [-1, 1]."""
    places = np.array(motion.on_cone.places)
    steps = turned(np.roll(places, -1) - places)
    steps = np.array([steps[1], steps[2], steps[3], steps[0]])  # O A, A B, B C, C O
    closed = poses_from_conformed(steps, motion.on_cone.cone_angle, [each.at for each in motion.positions])
    assert {each.at for each in motion.positions}
    for at in {each.at for each in motion.positions}:
        (number,) = [i for i, each in enumerate(motion.positions) if each.at == at and each.direct]
        psi = closed.psi[number] - closed.conformed[1]
        assert turned(psi + motion.positions[number].angles[0]) == pytest.approx(0.0, abs=1e-11)
    links = [np.arccos(a @ b) for a, b in _neighbours(motion)]  # C O, O A, A B, B C
    ends = input_limits_spherical(links)
    for sense in (motion.backward, motion.forward):
        if sense.ends == "turns all round":
            assert np.isnan(ends).all()
            assert abs(sense.limit) == pytest.approx(2 * np.pi, abs=1e-11)
        else:
            there = abs(turned(closed.conformed[0] + sense.limit))
            assert np.nanmin(abs(ends - there)) < 1e-11


def _neighbours(motion):
    axes = joint_axes(motion.on_cone.places, motion.on_cone.cone_angle)
    return list(zip(axes, np.roll(axes, -1, axis=0), strict=True))


def test_a_rocker_is_the_closed_form(rocker):
    agrees_with_the_closed_form(rocker)
    assert rocker.closed
    assert not rocker.turns_fully
    assert rocker.closure < 1e-12
    assert rocker.meets == []


@pytest.mark.slow
def test_four_bars_are_the_closed_form(rng):
    """Those whose driver comes three degrees far at least both ways."""
    turns, seen = np.radians([-3, 2]), []
    while len(seen) < 20 or len(set(seen)) < 2:
        angles = rng.uniform(0.4, 2.2, 4)
        for each in loop_on_cones(angles) if 2 * angles.max() < angles.sum() < 2 * np.pi else []:
            motion = move_on_cone(each, driver="2", at=turns)
            if {p.at for p in motion.positions if p.direct} == set(turns):
                agrees_with_the_closed_form(motion)
                seen.append(motion.turns_fully)


def ways_by_points(motion, angles):
    """The way of each link at a pose, by 400 points along it."""
    chain, lam = motion.chain, motion.on_cone.cone_angle
    motions = link_motions(motion.linkage, angles[None], chain.links[0])
    places = np.array(motion.on_cone.places)
    found = {}
    for link, joints in zip(chain.links, chain.joints_of, strict=True):
        first, *others = places[list(joints)]
        assert len(others) == 1
        points = joint_axes(np.linspace(first, first + turned(others[0] - first), 400), lam)
        off = (points @ motions[link][0][0].T)[:, 1] + np.sin(lam)
        out, into = off.max() > 1e-9, off.min() < -1e-9
        found[link] = Way.BOTH if out and into else Way(int(out) - int(into))
    return found


def test_ways_all_along_are_those_of_points(rocker):
    for each in rocker.positions:
        assert each.ways == ways_by_points(rocker, each.angles)
    frames = rocker.path.angles
    for sense, numbers in (
        (rocker.forward, range(1, 4)),
        (rocker.backward, range(len(frames) - 10, len(frames) - 2)),
    ):
        checked = 0
        for angles in frames[numbers] - (frames[-1] - frames[0]) * (sense.limit < 0):
            at = angles[1]
            if not 0 < at / sense.limit < 1:
                continue
            expected = ways_by_points(rocker, angles)
            for link, stretches in sense.ways.items():
                stretch = next(one for one in stretches if abs(at) <= abs(one.end))
                assert stretch.way == expected[link]
                checked += 1
        assert checked >= 8


def test_the_beginning_is_first_order(rocker):
    """One sense of the motion begins as the rates say, the other the other way."""
    rates = behaviour(rocker.chain, rocker.on_cone.places)
    expected = [Way(int(way)) for way in rates.ways]
    mirrored = [Way(-way) if abs(way) == 1 else way for way in expected]
    begun = [
        [sense.ways[link][0].way for link in rocker.chain.links] for sense in (rocker.forward, rocker.backward)
    ]
    assert begun in ([expected, mirrored], [mirrored, expected])


@pytest.mark.slow
def test_a_crank_turns_all_round_and_both_ends_meet():
    first, _ = loop_on_cones(np.radians(CRANK))
    motion = move_on_cone(first, driver="2", at=[1.0, 4.0])
    assert motion.turns_fully
    assert motion.turns["2"] == 1
    assert [motion.backward.limit, motion.forward.limit] == pytest.approx([-2 * np.pi, 2 * np.pi])
    agrees_with_the_closed_form(motion)
    assert len(motion.positions) == 2


@pytest.mark.slow
def test_where_links_can_fold_another_circuit_meets():
    """100 + 60 = 70 + 90: at one turn all axes lie in a plane, where two ways lead on."""
    (motion,) = [
        move_on_cone(each) for each in loop_on_cones(np.radians([100, 70, 90, 60])) if each.cone_angle > 1e-3
    ]
    assert motion.closed
    assert motion.meets
    for pose in motion.path.meets:
        axes = np.array([_axis(motion, pose, joint) for joint in range(4)])
        assert np.linalg.svd(axes)[1][2] < 1e-5


def _axis(motion, pose, joint):
    link = list(motion.linkage.graph.joints.values())[joint][0]
    rotation, _ = link_motions(motion.linkage, pose[None])[link]
    return rotation[0] @ motion.linkage.directions[joint]


@pytest.mark.slow
def test_several_loops_go_as_far_as_a_driven_path_does(data):
    """Fig. 11 of Hyatt et al. 2020, a chain of two loops: the driver hardly moves, near a dead point."""
    (on_cone,) = linkage_on_cones(read(data / "surfaces" / "fig11-stephenson.json"))
    motion = move_on_cone(on_cone, at=np.radians([0.1]))
    assert motion.closed
    assert len(motion.positions) == 4
    closure = ClosureEquations(motion.linkage)
    for each in motion.positions:
        assert closure.error(each.angles) < 1e-12
        assert each.angles[0] == np.radians(0.1)
    (direct,) = [each for each in motion.positions if each.direct]
    limit = motion.forward.limit
    path = driven_path(closure, motion.linkage.angles, [0], [np.radians(0.1), 0.999 * limit])
    assert path.stopped == ""
    np.testing.assert_allclose(path.angles[1], direct.angles, atol=1e-11)
    beyond = driven_path(closure, motion.linkage.angles, [0], [1.01 * limit])
    top, *_ = [event for event in beyond.events if event.kind == "turning point"]
    assert top.angles[0] == pytest.approx(limit, rel=1e-6)  # it goes back from there, and on round the circuit


def test_what_is_no_motion_of_one_freedom_is_refused(rocker):
    with pytest.raises(UnsolvableError, match="2 infinitesimal freedoms at the pose, expected one"):
        move_on_cone(loop_of_steps(np.radians([70, 80, 60, 75, 75]), 0.3))
    with pytest.raises(UnsolvableError, match="any cone"):
        move_on_cone(loop_of_steps(np.radians([40, 50, 60])))
    with pytest.raises(InvariantError, match="'9' is no joint"):
        move_on_cone(rocker.on_cone, driver="9")
    with pytest.raises(InvariantError, match="expected a finite angle"):
        move_on_cone(rocker.on_cone, at=[np.nan])


def test_the_command_tells_up_to_which_turn_one_way_is_kept(data):
    """An open four-bar on less than half the cone, a link beside the longest fixed: all leave one way."""
    words = ("cone", "move", "--steps", "50,50,40", "--lambda", 30, "--at", "3", "--json")
    (told,) = json.loads(run(*words).stdout)["linkages"]
    assert {told[sense]["one_way"]["way"] for sense in ("forward", "backward")} == {"inward", "outward"}
    for sense in (told["forward"], told["backward"]):
        assert 0 < sense["one_way"]["to_deg"] / sense["limit_deg"] <= 1
    assert told["closed"]
    assert set(told["forward"]["links"]) == {"1", "2", "3", "4"}
    assert told["positions"][0]["joint_angles_deg"]["1"] == pytest.approx(3.0, abs=1e-12)
    assert "Usage:" in run("cone", "move", code=2).output
    assert "any cone" in run("cone", "move", "--steps", "40,50,60", code=2).stderr
    file = data / "surfaces" / "fig11-stephenson.json"
    assert "'Q' is no joint" in run("cone", "move", file, "--driver", "Q", code=2).stderr


def test_what_is_printed(rocker):
    out = str(rocker)
    assert "link 1 fixed, joint 2 driven" in out
    assert "range to -105.5000757 degrees (turns back), to 4.078014059 degrees (turns back)" in out
    assert "circuit closed, loops to" in out
    assert "4 positions at 2 turns that are reached" in out
