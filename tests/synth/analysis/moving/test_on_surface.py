"""Conical linkages moved from the conformed position: closed form, paths, points of links, first order."""

import json
import re
from math import degrees

import numpy as np
import pytest
from commands import run
from four_bar_configurations import configurations_from_conformed
from sizes import first_quick, slow

from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.geometry import rotated
from graphs.mechanism.surfaces import Cone, joint_axes
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import link_motions
from synth.analysis.motion.path import driven_path
from synth.analysis.moving.on_surface import LinkPoint, move_on_surface
from synth.linkages.conformed.behaviours import Way, behaviour
from synth.linkages.conformed.linkage_behaviour import (
    linkage_on_surfaces,
    loop_of_steps,
    loop_on_cones,
    loop_on_cylinders,
)
from synth.linkages.fourbar.position import input_limits_spherical
from synth.linkages.surfaces.circuit import wrapped

CRANK, ROCKER = (40, 90, 80, 100), (120, 95, 45, 85)


@pytest.fixture(scope="module")
def rocker():
    first, _ = loop_on_cones(np.radians(ROCKER))
    return move_on_surface(first, driver="2", at=np.radians([-20, 3]))


def turned(angle):
    return np.remainder(angle + np.pi, 2 * np.pi) - np.pi


def agrees_with_the_closed_form(motion):
    """Input at joint 2 (O), output at joint 1 (C): McCarthy's angles, and where cosines leave [-1, 1]."""
    places = np.array(motion.on_surface.places)
    steps = turned(np.roll(places, -1) - places)
    steps = np.array([steps[1], steps[2], steps[3], steps[0]])  # O A, A B, B C, C O
    closed = configurations_from_conformed(steps, motion.on_surface.cone_angle, [each.at for each in motion.positions])
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
    axes = joint_axes(motion.on_surface.places, motion.on_surface.cone_angle)
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
            motion = move_on_surface(each, driver="2", at=turns)
            if {p.at for p in motion.positions if p.direct} == set(turns):
                agrees_with_the_closed_form(motion)
                seen.append(motion.turns_fully)


def ways_by_points(motion, angles):
    """The way of each link at a pose, by 400 points along it."""
    chain, lam = motion.chain, motion.on_surface.cone_angle
    motions = link_motions(motion.linkage, angles[None], chain.links[0])
    places = np.array(motion.on_surface.places)
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
    for sense, numbers in ((rocker.forward, range(1, 4)), (rocker.backward, range(len(frames) - 10, len(frames) - 2))):
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
    rates = behaviour(rocker.chain, rocker.on_surface.places)
    expected = [Way(int(way)) for way in rates.ways]
    mirrored = [Way(-way) if abs(way) == 1 else way for way in expected]
    begun = [[sense.ways[link][0].way for link in rocker.chain.links] for sense in (rocker.forward, rocker.backward)]
    assert begun in ([expected, mirrored], [mirrored, expected])


@pytest.mark.slow
def test_a_crank_turns_all_round_and_both_ends_meet():
    first, _ = loop_on_cones(np.radians(CRANK))
    motion = move_on_surface(first, driver="2", at=[1.0, 4.0])
    assert motion.turns_fully
    assert motion.turns["2"] == 1
    assert [motion.backward.limit, motion.forward.limit] == pytest.approx([-2 * np.pi, 2 * np.pi])
    agrees_with_the_closed_form(motion)
    assert len(motion.positions) == 2


@pytest.mark.slow
def test_where_links_can_fold_another_circuit_meets():
    """100 + 60 = 70 + 90: at one turn all axes lie in a plane, where two ways lead on."""
    (motion,) = [
        move_on_surface(each) for each in loop_on_cones(np.radians([100, 70, 90, 60])) if each.cone_angle > 1e-3
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
    (on_surface,) = linkage_on_surfaces(read(data / "surfaces" / "fig11-stephenson.json"))
    motion = move_on_surface(on_surface, at=np.radians([0.1]))
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
    with pytest.raises(UnsolvableError, match="2 infinitesimal degrees of freedom at this configuration, expected 1"):
        move_on_surface(loop_of_steps(np.radians([70, 80, 60, 75, 75]), Cone(0.3)))
    with pytest.raises(UnsolvableError, match="any cone or cylinder"):
        move_on_surface(loop_of_steps(np.radians([40, 50, 60])))
    with pytest.raises(InvariantError, match="'9' is no joint"):
        move_on_surface(rocker.on_surface, driver="9")
    with pytest.raises(InvariantError, match="expected a finite angle"):
        move_on_surface(rocker.on_surface, at=[np.nan])


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
    assert "range -105.5° to 4.08°; turns back at both ends" in out
    assert "circuit closed, loop-closure residual " in out
    assert "4 configurations at 2 input angles within the range" in out


def circles_meet(first, second, radii, near):
    """The point that is so far from two others, near a third."""
    across = second - first
    apart = np.linalg.norm(across)
    along = (radii[0] ** 2 - radii[1] ** 2 + apart**2) / (2 * apart)
    high = np.sqrt(radii[0] ** 2 - along**2)
    foot, normal = first + along * across / apart, np.array([-across[1], across[0]]) / apart
    return min((foot + high * normal, foot - high * normal), key=lambda one: np.linalg.norm(one - near))


def turned_about(centre, point, angle):
    """A point turned by an angle from azimuth 0 towards growing azimuths reversed, as positive joints turn."""
    c, s = np.cos(angle), np.sin(angle)
    return centre + np.array([[c, -s], [s, c]]) @ (point - centre)


@pytest.mark.parametrize("which", [0, slow(1)], ids=["open", "crossed"])
def test_a_four_bar_on_its_cylinder_is_the_planar_one(which):
    """Joints by circles that meet, links by points along them; how far the driver goes by the triangle inequality."""
    linkage = loop_on_cylinders([5, 2, 4, 4.5])[which]
    radius, t = linkage.surface.radius, np.array(linkage.places)
    joints = radius * np.stack([np.sin(t), np.cos(t)], axis=1)
    lengths = np.linalg.norm(np.roll(joints, -1, axis=0) - joints, axis=1)
    turns = np.radians([-8.0, 5.0])
    motion = move_on_surface(linkage, driver="2", at=turns)
    assert motion.closed
    checked = 0
    for each in motion.positions:
        if not each.direct:
            continue
        third = min(
            (turned_about(joints[1], joints[2], sign * each.at) for sign in (1, -1)),
            key=lambda one: np.linalg.norm(one - motion_place(motion, 2, t[2], each)),
        )
        fourth = circles_meet(third, joints[0], lengths[[2, 3]], joints[3])
        np.testing.assert_allclose(motion_place(motion, 2, t[2], each), third, atol=1e-11)
        np.testing.assert_allclose(motion_place(motion, 3, t[3], each), fourth, atol=1e-11)
        now = [joints[0], joints[1], third, fourth]
        for number, link in enumerate((2, 3, 4), start=1):
            ends = [number, (number + 1) % 4]
            begin, step = t[ends[0]], turned(t[ends[1]] - t[ends[0]])
            along = radius * np.stack([f(np.linspace(begin, begin + step, 400)) for f in (np.sin, np.cos)], axis=1)
            moved = carried(joints[ends], [now[end] for end in ends], along)
            off = np.hypot(*moved.T) - radius
            out, into = off.max() > 1e-7, off.min() < -1e-7
            assert each.ways[link] == (Way.BOTH if out and into else Way(int(out) - int(into)))
            checked += 1
    assert checked >= 3
    reach = lengths[2] + lengths[3], abs(lengths[2] - lengths[3])
    for sense in (motion.backward, motion.forward):
        if sense.ends == "turns back":
            ends = [turned_about(joints[1], joints[2], sign * sense.limit) - joints[0] for sign in (1, -1)]
            assert min(abs(np.linalg.norm(end) - one) for end in ends for one in reach) < 1e-9


def motion_place(motion, link, azimuth, position):
    """Where a point on the circle is at a position, across the axis."""
    number = motion.positions.index(position)
    return motion.places_of(LinkPoint(link, float(azimuth), 0.0))[number][[0, 2]]


def carried(ends, now, points):
    """Points of a link that has two joints, when these have moved."""
    (a, b), (c, d) = ends, now
    z = complex(*(d - c)) / complex(*(b - a))
    off = (points - a) @ [1, 1j] * z
    return c + np.stack([off.real, off.imag], axis=1)


SAMPLES = ("pos_open_sample", "pos_open_no_centre_sample")


@pytest.fixture(scope="module", params=first_quick(1, SAMPLES))
def sampled(request, data):
    """Hyatt et al. 2020, section 6: a four-bar, gamma fixed (link 4, C O), alpha driven at O (joint 1)."""
    entry = json.loads((data / "golden.json").read_text())["000"][request.param]
    steps = [entry["inputs"]["loop_convention_steps"][name] for name in ("alpha0", "eta0", "beta0", "gamma0")]
    cone = Cone(np.radians(entry["inputs"]["lambda_deg"]))
    turns = np.radians(entry["inputs"]["dtheta"])
    pairs = [(a, b) for a in range(1, 5) for b in range(a + 1, 5)]
    points = [LinkPoint(1, np.radians(steps[0])), LinkPoint(3, np.radians(sum(steps[:2])))]
    motion = move_on_surface(
        loop_of_steps(np.radians(steps), cone), ground=4, driver="1", at=turns, points=points, axes=pairs
    )
    return motion, entry["computed"]["rows"], steps


def direct_rows(motion, rows):
    """Positions reached without turning back, and their rows; -1 where the driver is beyond its range."""
    for number, each in enumerate(motion.positions):
        if each.direct:
            (row,) = [row for row in rows if np.isclose(np.radians(row["dtheta"]), each.at)]
            yield number, row


def test_points_of_links_are_eqs_19_21_and_23(sampled):
    """A and B as computed from the paper; and points at other angles: Eqs. 19, 21, 23 with these in their place."""
    motion, rows, steps = sampled
    by_point = [motion.places_of(one) for one in motion.points]
    o, c = (joint_axes([motion.on_surface.places[joint]], motion.on_surface.cone_angle)[0] for joint in (0, 3))
    seen = 0
    for number, row in direct_rows(motion, rows):
        np.testing.assert_allclose(by_point[0][number], row["A"], atol=1e-10)
        np.testing.assert_allclose(by_point[1][number], row["B"], atol=1e-10)
        for other in np.radians([12.0, -35.0, 140.0]):
            start = joint_axes([other], motion.on_surface.cone_angle)[0]
            for link, about, angle in ((1, o, row["dtheta"]), (3, c, row["dpsi"])):
                expected = 2.5 * rotated(start, about, np.radians(angle))
                place = motion.places_of(LinkPoint(link, float(other), 2.5))[number]
                np.testing.assert_allclose(place, expected, atol=1e-9)
            # of the coupler: with input as if fixed to it, then about A (Eq. 21)
            a = np.array(row["A"])
            by_input = rotated(start, o, np.radians(row["dtheta"]))
            place = motion.places_of(LinkPoint(2, float(other)))[number]
            np.testing.assert_allclose(place, rotated(by_input, a, np.radians(row["dxi"])), atol=1e-9)
        seen += 1
    assert seen >= 4
    assert steps


def test_instant_axes_are_where_planes_meet(sampled):
    """Of opposite links, where the planes of the others meet (section 2.4, Fig. 3), also when they have moved."""
    motion, rows, _ = sampled
    pairs = {pair: motion.instant_axes(*pair) for pair in motion.axes}
    c = joint_axes([motion.on_surface.places[3]], motion.on_surface.cone_angle)[0]
    o = joint_axes([0.0], motion.on_surface.cone_angle)[0]
    for number, row in direct_rows(motion, rows):
        a, b = np.array(row["A"]), np.array(row["B"])
        for pair, planes in (((2, 4), ((o, a), (c, b))), ((1, 3), ((a, b), (o, c)))):
            expected = np.cross(*(np.cross(*plane) for plane in planes))
            direction = pairs[pair][number].direction
            np.testing.assert_allclose(np.cross(direction, expected) / np.linalg.norm(expected), 0.0, atol=1e-8)
        np.testing.assert_allclose(np.cross(pairs[1, 4][number].direction, o), 0.0, atol=1e-12)


def test_instant_centres_are_where_links_meet():
    """On a cylinder: the lines of the side links meet in that of coupler and ground."""
    motion = move_on_surface(loop_on_cylinders([5, 2, 4, 4.5])[0], driver="2", at=np.radians([0, 4]))
    for number, each in enumerate(motion.positions):
        t = motion.on_surface.places
        fixed = [motion.on_surface.surface.place(place, 0.0, 0.0)[[0, 2]] for place in t[:2]]
        moving = [motion_place(motion, 3, t[joint], each) for joint in (3, 2)]
        sides = [end - start for start, end in zip(fixed, moving, strict=True)]
        (share, _) = np.linalg.solve(np.stack([sides[0], -sides[1]], axis=1), fixed[1] - fixed[0])
        point = motion.instant_axes(1, 3)[number].point
        np.testing.assert_allclose(point[[0, 2]], fixed[0] + share * sides[0], atol=1e-8)


@pytest.mark.parametrize("whole", [False, slow(True)])
def test_points_and_axes_at_the_command_line(whole):
    words = ("--steps", "50,110,80", "--ground", "4", "--at", "10", "--point", "1,50", "--point", "2,30,2")
    told = json.loads(run("cone", "move", "--lambda", 20, *words, "--axes", "2,4", "--json").stdout)["linkages"][0]
    (position,) = [one for one in told["positions"] if one["direct"]]
    assert [one["link"] for one in position["points"]] == [1, 2]
    assert np.linalg.norm(position["points"][1]["place"]) == pytest.approx(2.0)
    assert position["instant_axes"][0]["point"] == [0.0, 0.0, 0.0]
    if whole:
        words = ("cylinder", "move", "--radius", 7, *words, "--axes", "2,4")
        told = json.loads(run(*words, "--json").stdout)["linkages"][0]
        assert told["radius"] == 7
        assert told["positions"][0]["points"][1]["place"][1] == -2.0
        out = run(*words).stdout
        assert "points of links" in out
        assert "instant centres" in out
    for bad in (("--point", "1"), ("--point", "1,x"), ("--axes", "1")):
        assert "Usage:" in run("cone", "move", "--steps", "50,110,80", "--lambda", 20, "--at", 1, *bad, code=2).output
    assert "require --at" in run("cone", "move", "--steps", "50,110,80", "--lambda", 20, "--axes", "1,2", code=2).output


def test_an_arc_that_turns_about_its_own_end_changes_at_half_a_turn():
    """Where it lies along the circle beyond the pivot it only touches the circle: heights alone come too late."""
    motion = move_on_surface(loop_on_cylinders([4, 3, 5, 1])[1])
    ends = {round(degrees(one.end), 9) for sense in (motion.forward, motion.backward) for one in sense.ways[4]}
    assert {180.0, -180.0} <= ends
    # as far as a link spans, it comes to lie on the circle again with its other end
    spans = np.degrees(wrapped(np.diff(motion.on_surface.places)))
    assert min(abs(degrees(one.end) - abs(spans[2])) for one in motion.forward.ways[2]) < 1e-8
    parallelogram = move_on_surface(loop_on_cylinders([6, 2, 6, 2], 4.0)[0])
    assert 180.0 in {round(degrees(one.end), 9) for one in parallelogram.forward.ways[4]}


def test_what_is_printed_says_each_thing_once():
    """Ends and limits once, no column twice, zero as 0, and a link that goes both ways in words."""
    first, _ = loop_on_cones(np.radians([120, 95, 45, 85]))
    out = str(move_on_surface(first, at=np.radians([0, 3])))
    assert "range -103.92° to 5.66°; turns back at both ends\n" in out
    assert out.count("103.92") == 1
    assert re.search(r"^ 3 +inward and outward to -33.81°, then inward +inward and outward *$", out, re.MULTILINE)
    assert re.search(r"^ at +joint 2 +joint 3 +joint 4 +without turning back *$", out, re.MULTILINE)
    assert re.search(r"^ +0 +0 +0 +0 +yes *$", out, re.MULTILINE)
