"""Members of a type by arrays: against positions and closed forms, the library against numpy, and what does not close."""

import re
from dataclasses import replace

import networkx as nx
import numpy as np
import pytest
from scipy.linalg import expm
from spherical import FOUR_BAR, STEPHENSON, WATT, spherical

from graphs.c_libraries import library
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.joints.linkage import JointedLinkage, JointPlace
from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from synth.analysis.assembly import positions
from synth.analysis.folding.motion import fold
from synth.analysis.members import STATES, arcs_of, member_kernel, sweep
from synth.analysis.members._sweep import linkages_at
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import linkage_of_axes
from synth.analysis.motion.path import driven_path
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.moving.motion import move
from synth.catalogue.patterns import generate
from synth.catalogue.patterns.hinged_rings import spherical_ring
from synth.linkages.fourbar.closing import can_close

CRANK, ROCKER = (30, 80, 70, 75), (40, 60, 70, 100)
TURN = np.linspace(0.0, 2.0 * np.pi, 33)
needs_library = pytest.mark.skipif(
    library(member_kernel.SOURCE) is None, reason="there is no library: no compiler was at hand"
)


def both(monkeypatch, *given, **named):
    """The same sweep by the library and by numpy."""
    fast = sweep(*given, **named)
    monkeypatch.setattr(member_kernel, "library", lambda _: None)
    slow = sweep(*given, **named)
    monkeypatch.undo()
    return fast, slow


def agree(fast, slow):
    np.testing.assert_array_equal(fast.state, slow.state)
    np.testing.assert_allclose(fast.angles, slow.angles, rtol=0, atol=1e-10)
    assert np.nanmax(fast.residuals) <= 1e-12


def slider_crank():
    places = {joint: JointPlace((joint, joint % 2, 0.0), ((0.0, 0.0, 1.0),)) for joint in range(3)}
    slide = JointPlace((2.0, 0.0, 0.0), ((1.0, 0.3, 0.0),))
    return JointedLinkage(FOUR_BAR, {3: "P"}, {**places, 3: slide})


@needs_library
@pytest.mark.parametrize("arcs", [CRANK, ROCKER])
def test_the_library_does_what_numpy_does(arcs, monkeypatch):
    arcs = np.radians(arcs + np.random.default_rng(1).uniform(-8, 8, (60, 4)))
    fast, slow = both(monkeypatch, spherical_ring(arcs.mean(axis=0)), {"arcs": arcs}, drive={0: TURN})
    agree(fast, slow)
    assert fast.closed.any()


@needs_library
@pytest.mark.parametrize(("graph", "joint"), [(WATT, 0), (STEPHENSON, 1), (STEPHENSON, 5)])
def test_six_bars(graph, joint, monkeypatch):
    """Axes at random, and arcs of both loops changed a little; the linkage itself as a walk takes it."""
    random = np.random.default_rng(joint)
    linkage = spherical(graph, random)
    values = np.linspace(0.0, 0.1, 5)
    axes = linkage.directions + 0.1 * random.normal(size=(20, 7, 3))
    agree(*both(monkeypatch, linkage, {"axes": axes}, drive={joint: values}))
    arcs = np.array(list(arcs_of(linkage).values())) + random.uniform(-0.02, 0.02, (20, len(arcs_of(linkage))))
    fast, slow = both(monkeypatch, linkage, {"arcs": arcs}, drive={joint: values})
    agree(fast, slow)
    assert fast.closed.mean() > 0.2
    values = np.linspace(0.0, 0.4, 9)
    moved = sweep(linkage, {"axes": linkage.directions[None]}, drive={joint: values})
    for at, value in enumerate(values.tolist()):
        path = driven_path(ClosureEquations(linkage), linkage.angles, [joint], [[value]])
        assert moved.closed[0, at] == (path.stopped == "")
        if moved.closed[0, at]:
            np.testing.assert_allclose(moved.angles[0, at], path.angles[-1], atol=1e-9)


@needs_library
def test_planar_linkages_and_slides(monkeypatch):
    """Points of a slider-crank: slides are those of the closed form, crank and rod of fixed lengths."""
    mechanism = slider_crank()
    points = np.array([mechanism.places[joint].point for joint in range(4)], dtype=float)
    moved = points + np.random.default_rng(8).normal(scale=0.05, size=(12, 4, 3)) * [1.0, 1.0, 0.0]
    values = np.linspace(0.0, -1.0, 7)
    fast, slow = both(monkeypatch, mechanism, {"points": moved}, drive={0: values})
    agree(fast, slow)
    assert fast.closed.all()
    along = np.array([1.0, 0.3]) / np.hypot(1.0, 0.3)
    for (a, b, c, _), angles in zip(moved[..., :2], fast.angles, strict=True):
        for value, slid in zip(values, np.abs(angles[:, 3]), strict=True):
            turn = np.array([[np.cos(value), -np.sin(value)], [np.sin(value), np.cos(value)]])
            crank = a + turn @ (b - a)
            ends = [np.hypot(*(c + sense * slid * along - crank)) for sense in (-1.0, 1.0)]
            assert np.abs(np.array(ends) - np.hypot(*(c - b))).min() < 1e-9
    with pytest.raises(UnsolvableError, match="axes are directions, which require spherical loops"):
        sweep(mechanism, {"axes": np.ones((1, 4, 3))}, drive={0: [0.1]})
    with pytest.raises(UnsolvableError, match="arcs require spherical loops"):
        sweep(mechanism, {"arcs": np.ones((1, 4))}, drive={0: [0.1]})


@pytest.mark.parametrize("arcs", [CRANK, ROCKER])
def test_each_configuration_is_an_assembly_mode(arcs):
    """Members by arcs are linkages of these arcs, at the interior angles that the driven joint has."""
    random = np.random.default_rng(3)
    base = spherical_ring(np.radians(arcs))
    members = np.radians(arcs + random.uniform(-5, 5, (6, 4)))
    swept = sweep(base, {"arcs": members}, drive={0: TURN[:9]})
    for member in range(6):
        for at in np.flatnonzero(swept.closed[member]):
            axes = placed(base, members[member], swept.angles[member, at])
            np.testing.assert_allclose(arcs_between(axes), members[member], atol=1e-10)


def arcs_between(axes):
    after = np.roll(axes, -1, axis=0)
    return np.arctan2(np.linalg.norm(np.cross(axes, after), axis=1), (axes * after).sum(axis=1))


def placed(base, arcs, angles):
    """Axes of a ring with some arcs, put one after the other with the interior angles of the base turned by angles."""
    linkage = configuration_of(base).linkage
    axes = linkage.directions
    before, after = np.roll(axes, 1, axis=0), np.roll(axes, -1, axis=0)
    first, second = np.cross(before, axes), np.cross(axes, after)
    inner = np.arctan2((np.cross(first, second) * axes).sum(axis=1), (first * second).sum(axis=1))
    frame, found = np.eye(3), []
    for arc, turn in zip(arcs, inner + angles, strict=True):
        c, s = np.cos(turn), np.sin(turn)
        frame = frame @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
        found.append(frame[:, 2])
        c, s = np.cos(arc), np.sin(arc)
        frame = frame @ np.array([[1.0, 0, 0], [0, c, -s], [0, s, c]])
    np.testing.assert_allclose(frame[:, 2], found[0], atol=1e-10)  # it closes
    return np.array(found)


def test_a_member_that_is_the_mechanism_moves_as_it():
    ring = spherical_ring(np.radians(CRANK))
    swept = sweep(ring, {"arcs": {(0, 1): np.radians([30.0])}}, drive={0: TURN})
    assert swept.closed.all()
    for at in (5, 20):
        modes = positions(ring, drive={0: TURN[at]}, circuits=False).positions
        off = [np.abs(np.remainder(swept.angles[0, at] - one.angles + np.pi, 2 * np.pi) - np.pi).max() for one in modes]
        assert min(off) < 1e-9
    assert np.abs(np.remainder(swept.angles[0, -1] + 1.0, 2 * np.pi) - 1.0).max() < 1e-9  # all the way round


@needs_library
def test_several_driven_joints(monkeypatch):
    five = generate("five-bar").mechanism
    arcs = np.array(list(arcs_of(five).values())) + np.random.default_rng(5).uniform(-0.05, 0.05, (10, 5))
    drive = {0: np.linspace(0, 0.3, 4), 1: np.linspace(0, -0.2, 4)}
    fast, slow = both(monkeypatch, five, {"arcs": arcs}, drive=drive)
    agree(fast, slow)
    assert fast.closed.mean() > 0.8
    own = {joint: np.tile(values, (10, 1)) for joint, values in drive.items()}
    np.testing.assert_array_equal(sweep(five, {"arcs": arcs}, drive=own).angles, fast.angles)


def test_what_does_not_close_says_so():
    """A rocker turns back, and says so on both sides, between which all is closed; other links cannot close at all."""
    ring = spherical_ring(np.radians(ROCKER))
    arcs = np.radians([ROCKER, (20, 20, 20, 100), (40, 60, 70, 100)])
    values = np.concatenate([np.linspace(0, np.pi, 40), np.linspace(np.pi, -np.pi, 80)])
    swept = sweep(ring, {"arcs": arcs}, drive={0: values})
    assert not can_close(arcs[1])
    states = np.array(STATES)[swept.state]
    assert set(states[1]) == {"cannot close"}
    assert set(states[0]) == {"closed", "turns back"}
    assert np.isnan(swept.angles[~swept.closed]).all()
    assert np.isfinite(swept.angles[swept.closed]).all()
    np.testing.assert_array_equal(swept.state[0], swept.state[2])
    reached = values[swept.closed[0]]
    assert all(swept.closed[0] == ((values >= reached.min()) & (values <= reached.max())))
    beyond = [values[values < reached.min()].max()]
    for value, closed in [*((value, True) for value in reached[::9]), *((value, False) for value in beyond)]:
        assert closed == bool(positions(ring, drive={0: value}, circuits=False).positions)
    assert sum(swept.counts.values()) == swept.state.size
    assert "cannot close" in str(swept)
    assert swept.to_json()["angles"][1][0] == [None] * 4


def test_coordinates_of_sheets(data):
    """Vertices of patterns that are folded a little: each member moves as `fold` says; one that is none says why."""
    sheet = read(data / "patterns" / "four-bar-vertex.fold")
    at = configuration_of(sheet)
    corners = np.array(at.sheet.coordinates, dtype=float)
    spoiled = corners.copy()
    spoiled[:, 0] = 0.0
    turned = corners @ np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    names = list(at.linkage.graph.joints)
    goal = float(at.linkage.angles[names.index(2)]) * 0.8
    swept = sweep(at, {"coordinates": np.array([corners, spoiled, turned])}, drive={2: [goal]})
    assert [STATES[state] for state in swept.state[:, 0]] == ["closed", "cannot close", "closed"]
    assert list(swept.why) == [1]
    folded = fold(sheet, drive={2: goal}).path.angles[-1]
    np.testing.assert_allclose(swept.angles[[0, 2], 0], [folded, folded], atol=1e-9)


@pytest.mark.parametrize("name", ["miura", "huffman-grid"])
def test_sheets_that_are_not_determined_by_count(name):
    """Flat ones, and ones with redundant loops, are folded as `fold` does it; out of reach, and in no order, is told."""
    sheet = generate(name).mechanism
    at = configuration_of(sheet)
    joint = at.joints[int(np.abs(fold(sheet, frames=2).path.angles[-1]).argmax())]
    sense = np.sign(fold(sheet, frames=2).path.angles[-1][at.joints.index(joint)])
    corners = np.array(at.sheet.coordinates, dtype=float)
    values = sense * np.array([0.4, 0.2, 0.9, 0.0])
    swept = sweep(sheet, {"coordinates": np.array([corners, 2.0 * corners])}, drive={joint: values})
    assert swept.closed.all()
    np.testing.assert_allclose(swept.angles[0], swept.angles[1], atol=1e-8)
    for value, angles in zip(values[:3], swept.angles[0], strict=False):
        np.testing.assert_allclose(angles, fold(sheet, drive={joint: value}).path.angles[-1], atol=1e-8)
    np.testing.assert_allclose(swept.angles[0, 3], 0.0, atol=1e-9)


@pytest.mark.parametrize("name", ["bennett", "four-bar", "kaleidocycle", "miura"])
def test_a_mechanism_alone(name):
    """Without parameters the mechanism itself is moved to each input, also where its loops are spatial."""
    mechanism = generate(name).mechanism
    at = configuration_of(mechanism)
    joint = at.joints[0]
    values = at.linkage.angles[0] + np.array([0.2, 0.1, -0.1])
    swept = sweep(mechanism, {}, drive={joint: values})
    assert len(swept) == 1
    for row, value in enumerate(values.tolist()):
        moved = move(mechanism, drive={joint: value}, frames=1).path
        assert swept.closed[0, row] == (moved.stopped == "")
        if swept.closed[0, row]:
            np.testing.assert_allclose(swept.angles[0, row], moved.angles[-1], atol=1e-8)
    assert swept.closed.any()


def turned(points, directions, angles):
    """The product of the motions of joints one after the other, by matrix exponentials: float[4, 4]."""
    product = np.eye(4)
    for point, (x, y, z), angle in zip(points, directions, angles, strict=True):
        turn = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        twist = np.zeros((4, 4))
        twist[:3, :3], twist[:3, 3] = turn, -turn @ point
        product = product @ expm(angle * twist)
    return product


def test_members_with_a_spatial_loop():
    """Rings of seven joints, of one freedom each, from axes at random; each moves as it does alone, and closes."""
    chance, ring = np.random.default_rng(5), nx.cycle_graph(7).edges
    chain = SCGraph(7, list(ring))
    axes, points = chance.normal(size=(3, 7, 3)), 10.0 * chance.normal(size=(3, 7, 3))
    made = [linkage_of_axes(chain, dict(enumerate(zip(*one, strict=True)))) for one in zip(points, axes, strict=True)]
    joint, inputs = made[0].loops[0].joints[0], [0.01, -0.01, 3.0]
    swept = sweep(made[0], {"axes": axes, "points": points}, drive={joint: inputs})
    assert swept.closed[:, :2].all()
    for own, rows, state in zip(made, swept.angles, swept.state, strict=True):
        order, signs = list(own.loops[0].joints), np.array(own.loops[0].signs)
        unit_axes = own.directions[order]
        for value, angles in zip(inputs[:2], rows, strict=False):
            np.testing.assert_allclose(angles, move(own, drive={joint: value}, frames=1).path.angles[-1], atol=1e-9)
            whole = turned(own.points[order], unit_axes, signs * angles[order])
            np.testing.assert_allclose(whole, np.eye(4), atol=1e-11)
        assert STATES[state[2]] in ("closed", "turns back", "not reached")
    alone = sweep(made[1], {}, drive={joint: inputs})
    np.testing.assert_allclose(alone.angles[0], swept.angles[1], atol=1e-9)
    moved = sweep(made[0], {"points": points[:1]}, drive={joint: inputs})
    np.testing.assert_allclose(moved.angles, swept.angles[:1], atol=1e-12)


@pytest.mark.parametrize(
    ("mechanism", "centre", "told"),
    [
        (spherical_ring(np.radians(CRANK)), Centre.FINITE, "do not meet in a point"),
        (slider_crank(), Centre.INFINITE, "are not parallel"),
    ],
)
def test_members_keep_their_centres(mechanism, centre, told):
    """Beside a spatial loop others stay about a point, or planar."""
    at = configuration_of(mechanism, slides=True)
    [loop] = at.linkage.loops
    at = replace(at, linkage=replace(at.linkage, loops=(replace(loop, centre=centre),)))
    axes, points = at.linkage.directions, at.linkage.points
    tilted = axes + 0.01 * np.random.default_rng(2).normal(size=axes.shape)
    moved = points + 0.01 * np.random.default_rng(3).normal(size=axes.shape)
    same, other = linkages_at(at, np.array([axes, tilted]), np.array([points, moved]))
    np.testing.assert_array_equal(same().linkage.points, points)
    with pytest.raises(UnsolvableError, match=told):
        other()


def test_links_of_three_joints_keep_the_angle_between_their_arcs():
    linkage = spherical(WATT, np.random.default_rng(4))
    arcs = arcs_of(linkage)
    assert len(arcs) == 8
    pair = next(iter(arcs))
    swept = sweep(linkage, {"arcs": {pair: arcs[pair] + np.array([0.0, 0.01])}}, drive={0: [0.0, 0.1]})
    assert swept.closed.all()
    np.testing.assert_allclose(swept.angles[0, 0], 0.0, atol=1e-12)
    assert np.abs(swept.angles[1, 0]).max() > 1e-3


def test_only_some_joints_and_a_report():
    ring, done = spherical_ring(np.radians(CRANK)), []
    arcs = np.radians(np.tile(CRANK, (5000, 1)))
    swept = sweep(ring, {"arcs": arcs}, drive={0: [0.0, 0.1]}, joints=[2], report=done.append)
    assert swept.angles.shape == (5000, 2, 1)
    if library(member_kernel.SOURCE) is not None:
        assert done == [2048, 4096, 5000]
    assert len(sweep(ring, {"arcs": arcs[:0]}, drive={0: [0.0]})) == 0


@pytest.mark.parametrize(
    ("parameters", "drive", "told"),
    [
        ({"sides": [1.0]}, {0: [0.1]}, "parameters 'sides'; expected one of arcs, axes, points, coordinates"),
        ({"arcs": np.ones((2, 3))}, {0: [0.1]}, "an array of shape (2, 3); expected float[N, 4]"),
        ({"arcs": np.ones((2, 4)) * [1, 1, 1, 4]}, {0: [0.1]}, "arc 3 of member 0 is 229.183 degrees"),
        ({"arcs": {(0, 2): [1.0]}}, {0: [0.1]}, "(0, 2) is no arc of the mechanism"),
        ({"axes": np.zeros((1, 4, 3))}, {0: [0.1]}, "axis 0 of member 0 has no direction"),
        ({"axes": np.zeros((1, 4))}, {0: [0.1]}, "an array of shape (1, 4); expected float[N, 4, 3]"),
        ({"arcs": np.ones((2, 4))}, {0: [np.nan]}, "the inputs of joint 0 are not all numbers"),
        ({"arcs": np.ones((2, 4))}, {0: np.ones((3, 5))}, "inputs of shape (3, 5) for joint 0"),
        (
            {"axes": np.ones((1, 4, 3)), "points": np.ones((1, 4, 3))},
            {0: [0.1]},
            "parameters 'axes', 'points'; expected",
        ),
        ({"coordinates": np.ones((2, 4, 3))}, {0: [0.1]}, "coordinates require a crease pattern"),
        ({"arcs": np.ones((2, 4))}, {0: [0.1], 1: [0.1]}, "2 joints driven"),
    ],
)
def test_what_does_not_fit_is_refused(parameters, drive, told):
    with pytest.raises((InvariantError, UnsolvableError), match=re.escape(told)):
        sweep(spherical_ring(np.radians(CRANK)), parameters, drive=drive)
