"""All positions of planar linkages: four-bars, slider-cranks, six-bars, and assemblies of a structure that also moves."""

from math import pi, radians

import numpy as np
import pytest
from spherical import FOUR_BAR, STEPHENSON, WATT, is_among

from graphs.errors import InvariantError, UnsolvableError
from graphs.joints.linkage import JointedLinkage, JointPlace
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from synth.analysis.assembly import positions
from synth.analysis.assembly.ends import solutions
from synth.analysis.assembly.family import family_of
from synth.analysis.assembly.general import general_positions
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import linkage_of_axes
from synth.analysis.moving._configuration_of import configuration_of

slow = pytest.mark.slow
UP = (0.0, 0.0, 1.0)


def planar(graph, points):
    return HingedSolids(graph, {joint: ((*map(float, points[joint]), 0.0), UP) for joint in graph.joints})


def slider_crank(points, heading):
    """Joints 0, 1, 2 turn and joint 3, between the slider and the ground, slides."""
    places = {joint: JointPlace((*map(float, points[joint]), 0.0), (UP,)) for joint in range(3)}
    places[3] = JointPlace((*map(float, points[2]), 0.0), ((np.cos(heading), np.sin(heading), 0.0),))
    return JointedLinkage(FOUR_BAR, {3: "P"}, places)


def circles_meet(one, first, other, second):
    """The points common to two circles in the plane: none or two."""
    along = other - one
    far = np.hypot(*along)
    part = (far**2 + first**2 - second**2) / (2 * far)
    square = first**2 - part**2
    if square < 0:
        return []
    unit = along / far
    across = np.array([-unit[1], unit[0]]) * np.sqrt(square)
    return [one + part * unit + across, one + part * unit - across]


def turned(point, about, angle):
    c, s = np.cos(angle), np.sin(angle)
    return about + np.array([[c, -s], [s, c]]) @ (point - about)


def heading(first, last):
    return np.arctan2(*(last - first)[::-1])


def wrapped(angle):
    return np.remainder(angle + pi, 2 * pi) - pi


def check_four_bars(cases):
    random = np.random.default_rng(cases)
    for _ in range(cases):
        a, b, c, d = points = random.normal(size=(4, 2))
        turn = random.uniform(-pi, pi)
        found = positions(planar(FOUR_BAR, points), drive={0: turn}, circuits=False)
        crank = turned(b, a, turn)
        closed = circles_meet(crank, np.hypot(*(c - b)), d, np.hypot(*(c - d)))
        assert found.exhaustive
        assert (found.general, len(found.positions)) == (2, len(closed))
        # joint 3 turns from the rocker to the ground: the rocker turns by as much the other way
        rockers = sorted(wrapped(heading(d, p) - heading(d, c)) for p in closed)
        np.testing.assert_allclose(sorted(wrapped(-one.angles[3]) for one in found.positions), rockers, atol=1e-7)


def check_slider_cranks(cases):
    random = np.random.default_rng(cases)
    for _ in range(cases):
        a, b, c = points = random.normal(size=(3, 2))
        way, turn = random.uniform(-pi, pi), random.uniform(-pi, pi)
        found = positions(slider_crank(points, way), drive={0: turn}, circuits=False)
        crank = turned(b, a, turn)
        along = np.array([np.cos(way), np.sin(way)])
        # |c + s along - crank| = |c - b|: a quadratic equation for the slide s
        out = c - crank
        half, rest = out @ along, out @ out - (c - b) @ (c - b)
        square = half**2 - rest
        closed = [] if square < 0 else [-half - np.sqrt(square), -half + np.sqrt(square)]
        assert found.exhaustive
        assert (found.general, len(found.positions)) == (2, len(closed))
        slides = sorted(-one.angles[3] for one in found.positions)  # joint 3 is from the slider to the ground
        np.testing.assert_allclose(slides, closed, atol=1e-7)


def by_newton(linkage, driver, turn, random, starts):
    closure = ClosureEquations(linkage)
    free = np.setdiff1d(np.arange(len(linkage.angles)), [driver])
    for _ in range(starts):
        angles = random.uniform(-pi, pi, len(linkage.angles))
        angles[driver] = turn
        for _ in range(60):
            off, matrix = closure.at(angles)
            change = np.linalg.lstsq(matrix.toarray()[:, free], -off, rcond=None)[0]
            angles[free] += change * min(1.0, 1.0 / max(np.abs(change).max(), 1e-300))
            if np.abs(change).max() < 1e-12:
                break
        if closure.error(angles) < 1e-10:
            yield angles


def check_six_bars(graph, driver, number, cases, starts):
    """Each position that Newton's method comes to is among those found, and each found closes."""
    random = np.random.default_rng(cases + driver)
    linkage = configuration_of(planar(graph, random.normal(size=(7, 2)))).linkage
    family, _ = family_of(linkage, [driver])
    general = general_positions(family)
    assert len(general.values) == number
    for case in range(cases):
        linkage = configuration_of(planar(graph, random.normal(size=(7, 2)))).linkage
        _, axes = family_of(linkage, [driver])
        turn = random.uniform(-0.3, 0.3)
        ends = solutions(family, general, family.member(axes, np.array([turn])), seed=case)
        assert (len(ends.values), ends.far, ends.singular, ends.lost) == (number, 0, 0, 0)
        real = ends.values[np.abs(ends.values.imag).max(axis=1) < 1e-7].real
        assert len(real) % 2 == 0
        closure = ClosureEquations(linkage)
        assert all(closure.error(np.insert(one, driver, turn)) < 1e-9 for one in real)
        for angles in by_newton(linkage, driver, turn, random, starts):
            off = np.abs(wrapped(real - np.delete(angles, driver))).max(axis=1)
            assert off.min() < 1e-6


def test_four_bars_by_the_circles_of_their_links():
    check_four_bars(3)


def test_slider_cranks_by_a_quadratic_equation():
    check_slider_cranks(3)


@pytest.mark.parametrize(("graph", "driver", "number"), [(WATT, 0, 4), pytest.param(STEPHENSON, 5, 6, marks=slow)])
def test_six_bars_by_newtons_method(graph, driver, number):
    check_six_bars(graph, driver, number, 1, 10)


@slow
def test_a_thousand_of_each():
    check_four_bars(1000)
    check_slider_cranks(1000)


@slow
@pytest.mark.parametrize(("graph", "driver", "number"), [(WATT, 0, 4), (STEPHENSON, 0, 4), (STEPHENSON, 5, 6)])
def test_a_thousand_six_bars(graph, driver, number):
    check_six_bars(graph, driver, number, 1000, 20)


def test_slides_in_loops_that_are_declared_planar():
    """As without the declaration; a slide that leaves the plane is refused."""
    points = np.array([[0, 0], [1, 1], [3, 0]])
    plain = slider_crank(points, 0.0)
    loop = SCGraph(4, FOUR_BAR.joints, [Loop(range(4), "infinite")])
    declared = JointedLinkage(loop, plain.kinds, plain.places)
    found, due = (positions(one, drive={0: 0.3}, circuits=False) for one in (declared, plain))
    for one, other in zip(found.positions, due.positions, strict=True):
        np.testing.assert_allclose(one.angles, other.angles, atol=1e-9)
    leaning = {**plain.places, 3: JointPlace((3, 0, 0), ((1.0, 0.0, 0.3),))}
    with pytest.raises(InvariantError, match=r"miss by 2\.9e-01"):
        positions(JointedLinkage(loop, plain.kinds, leaning), drive={0: 0.3})


def test_a_driven_slide_and_circuits():
    linkage = slider_crank(np.array([[0, 0], [1, 1], [3, 0]]), 0.0)
    found = positions(linkage, drive={3: -0.5})
    assert [(one.circuit, one.branch) for one in found.positions] == [(0, 0), (0, 1)]
    assert all(one.angles[3] == pytest.approx(-0.5) for one in found.positions)
    document = found.to_json()
    assert (document["driven_deg"], document["driven_lengths"]) == ({}, {"3": -0.5})
    assert set(document["positions"][0]["lengths"]) == {"3"}
    larger = slider_crank(np.array([[0, 0], [10, 10], [30, 0]]), 0.0)
    scaled = positions(larger, drive={3: -5.0})
    for one, other in zip(found.positions, scaled.positions, strict=True):
        np.testing.assert_allclose(one.angles[:3], other.angles[:3], atol=1e-9)


SEVEN_BAR = SCGraph(7, {
    "O1": (0, 1), "A": (1, 2), "B": (2, 3), "O2": (3, 0), "O1'": (0, 4), "A'": (4, 5), "C": (5, 6), "O3": (6, 0),
    "P": (2, 5),
})  # fmt: skip
"""Two four-bars whose couplers share a point P."""


@slow
def test_roberts_seven_bar_moves_and_has_six_rigid_assemblies():
    """Two cognates trace one curve: of the meeting points of coupler curves 6 are left, at its double points.

    In general position there are 18, with a common fixed pivot 16.
    """
    o1, a, b, o2, p = complex(0, 0), complex(0.4, 1.0), complex(1.9, 1.3), complex(2.3, 0.1), complex(1.0, 2.2)
    ratio = (p - a) / (b - a)
    points = {"O1": o1, "A": a, "B": b, "O2": o2, "O1'": o1, "A'": o1 + p - a, "P": p}
    points |= {"C": points["A'"] + ratio * (a - o1), "O3": o1 + ratio * (o2 - o1)}
    found = positions(planar(SEVEN_BAR, {joint: (one.real, one.imag) for joint, one in points.items()}), drive={})
    assert (found.general, found.imaginary + sum(one.regular for one in found.positions)) == (16, 6)
    assert found.singular + sum(not one.regular for one in found.positions) == 10
    assert (found.exhaustive, found.lost) == (False, 0)
    assert "at singular configurations" in str(found)


def test_another_seven_bar_is_rigid_in_eighteen_assemblies():
    points = np.random.default_rng(3).normal(size=(9, 2))
    found = positions(planar(SEVEN_BAR, dict(zip(SEVEN_BAR.joints, points, strict=True))), drive={})
    assert (found.general, found.exhaustive, found.singular) == (18, True, 0)
    assert all(one.regular for one in found.positions)


def test_a_planar_loop_beside_a_spherical_one():
    """A joint is in both: the spherical loop goes on from the angle that the planar one gives it."""
    random = np.random.default_rng(1)
    graph = SCGraph(
        6,
        dict(enumerate([(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)])),
        [Loop((0, 1, 2, 3), "infinite"), Loop((3, 4, 5, 6))],
    )
    axes = {j: ((*random.normal(size=2), 0.0), UP) for j in range(4)}
    point = axes[3][0]
    axes |= {j: (point, tuple(random.normal(size=3))) for j in (4, 5, 6)}
    found = positions(linkage_of_axes(graph, axes), drive={0: radians(4)}, circuits=False)
    assert (found.general, found.exhaustive) == (4, True)
    four = positions(planar(FOUR_BAR, [axes[j][0][:2] for j in range(4)]), drive={0: radians(4)}, circuits=False)
    of_planar = {round(float(one.angles[3]), 8) for one in four.positions}
    assert {round(float(one.angles[3]), 8) for one in found.positions} <= of_planar


def test_loops_are_judged_by_their_axes():
    """Hinged solids without declared loops: axes that are parallel make a planar loop, skew ones are refused."""
    points = np.array([[0, 0], [0.3, 1], [2, 1.5], [2.2, 0]])
    assert len(positions(planar(FOUR_BAR, points), drive={0: 0.3}).positions) == 2
    skew = HingedSolids(FOUR_BAR, {j: ((*points[j].tolist(), 0.0), (0.1 * j * j, 0.3 * j, 1.0)) for j in range(4)})
    with pytest.raises(UnsolvableError, match="neither meet in a point nor are parallel"):
        positions(skew, drive={0: 0.3})


def test_spatial_loops_are_refused_before_freedoms_are_counted():
    """Seven skew axes have one freedom: three equations for each loop, and M = 4, would be wrong."""
    random = np.random.default_rng(7)
    ring = SCGraph(7, [(link, (link + 1) % 7) for link in range(7)])
    skew = HingedSolids(ring, {j: (tuple(random.normal(size=3)), tuple(random.normal(size=3))) for j in ring.joints})
    for drive in ({}, {0: 0.3}, dict.fromkeys(range(4), 0.3)):
        with pytest.raises(UnsolvableError, match="neither meet in a point nor are parallel"):
            positions(skew, drive=drive)


@pytest.mark.parametrize(("across", "number"), [("plane", 6), ("sphere", 8)])
def test_a_platform_of_solids_on_three_legs(across, number):
    """Three legs of three revolutes each, the first of each driven: joints of solids in one plane or sphere."""
    random = np.random.default_rng(3)
    legs = [(0, 1), (1, 2), (2, 7), (0, 3), (3, 4), (4, 7), (0, 5), (5, 6), (6, 7)]
    turn, place = np.linalg.qr(random.normal(size=(3, 3)))[0], random.normal(size=3)
    turn *= np.linalg.det(turn)
    axes = {}
    for joint in range(9):
        x, y, z = random.normal(size=3).tolist()
        point, axis = ((x, y, 0.0), UP) if across == "plane" else ((0.0, 0.0, 0.0), (x, y, z))
        axes[joint] = (tuple((turn @ point + place).tolist()), tuple((turn @ axis).tolist()))
    platform = HingedSolids(SCGraph(8, legs), axes)
    found = positions(platform, drive={0: 0.1, 3: 0.2, 6: -0.1})
    assert (found.general, found.evidence, found.to_json()["exhaustive"]) == (number, "proved", "proved")
    closure = configuration_of(platform).closure
    assert all(closure.error(mode.angles) < 1e-9 for mode in found.positions)


def test_six_bars_in_other_planes():
    """A linkage turned and moved in space has the same positions."""
    random = np.random.default_rng(5)
    flat = planar(WATT, random.normal(size=(7, 2)))
    turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
    turn *= np.linalg.det(turn)
    shift = random.normal(size=3)
    moved = HingedSolids(
        WATT, {j: (tuple(turn @ point + shift), tuple(turn @ axis)) for j, (point, axis) in flat.axes.items()}
    )
    one, other = (positions(thing, drive={0: 0.2}, circuits=False) for thing in (flat, moved))
    assert len(one.positions) == len(other.positions) > 0
    assert all(is_among(position.angles, other.positions) for position in one.positions)
