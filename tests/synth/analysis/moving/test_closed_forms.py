"""Closed loops of six hinges and more against what geometry says of them, to 1e-11."""

from math import atan2

import numpy as np
import pytest

from graphs.files.formats import read
from graphs.geometry import rotations
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import link_motions
from synth.analysis.motion.singular.second_order import rates_at
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.moving.motion import move

CLOSE = 1e-11


def linkage(data, name):
    return configuration_of(read(data / "linkages" / f"{name}.json")).linkage


def moved(data, name, goal, frames=3):
    """Joint angles float[F, J] of a linkage whose first joint is driven."""
    motion = move(linkage(data, name), drive={0: goal}, frames=frames)
    assert motion.path.stopped == ""
    assert motion.closure < 1e-12
    assert np.abs(np.diff(motion.path.angles[:, 0])).min() > 1e-3
    return motion.path.angles


def screw(point, direction, angle):
    """The motion of space that a joint makes, float[4, 4]."""
    made = np.eye(4)
    made[:3, :3] = rotations(direction, np.array(angle))
    made[:3, 3] = point - made[:3, :3] @ point
    return made


def sides_of(points):
    return np.roll(points, -1, axis=0) - points


def signed_angle(first, second, axis):
    return atan2(np.cross(first, second) @ axis, first @ second)


def angles_at_pose(here):
    """Angles of a ring without offsets, at each joint from the side before it to the side after it."""
    sides = sides_of(here.points)
    return np.array([signed_angle(sides[i - 1], sides[i], here.directions[i]) for i in range(len(sides))])


def test_bennett(data):
    """tan(t0 / 2) tan(t1 / 2) = sin((b + a) / 2) / sin((b - a) / 2), opposite angles making a whole turn."""
    a, b = 0.7, 1.2
    law = np.sin((b + a) / 2) / np.sin((b - a) / 2)
    angles = moved(data, "bennett", 2.5)
    second = 2 * np.arctan(law / np.tan(0.5))
    products = np.tan((1.0 + angles[:, 0]) / 2) * np.tan((second + angles[:, 1]) / 2)
    np.testing.assert_allclose(products, law, rtol=CLOSE)
    np.testing.assert_allclose(angles[:, 2:], -angles[:, :2], atol=CLOSE)


def test_bricards_line_symmetric_linkage(data):
    """Half a turn K about the line of symmetry takes one half of the ring to the other.

    So opposite angles are alike, and with S the motion that three joints make after each other, S K S K is the
    identity: S K is half a turn itself. That is, the trace of its rotation is -1, and it does not shift along its
    axis: two equations between three angles.
    """
    here = linkage(data, "bricard-line-symmetric")
    angles = moved(data, "bricard-line-symmetric", 1.2)
    np.testing.assert_allclose(angles[:, 3:], angles[:, :3], atol=CLOSE)
    half = screw(-here.middle / here.extent, np.array([0.0, 0.0, 1.0]), np.pi)
    for frame in angles:
        step = np.eye(4)
        for point, direction, angle in zip(here.points[:3], here.directions[:3], frame[:3], strict=True):
            step = step @ screw(point, direction, angle)
        step = step @ half
        assert np.trace(step[:3, :3]) == pytest.approx(-1.0, abs=CLOSE)
        axis = np.linalg.eigh(step[:3, :3] + step[:3, :3].T)[1][:, -1]
        assert axis @ step[:3, 3] == pytest.approx(0.0, abs=CLOSE)


def test_bricards_plane_symmetric_linkage(data):
    """Axes 0 and 3 stay in the plane of symmetry: they keep on meeting.

    As solid 0 sees it, joints 1 and 2 carry axis 3, and its moment about axis 0 vanishes: A cos t2 + B sin t2 + C
    = 0, where A, B and C are of t1 alone. Joints 4 and 5 turn as 2 and 1 do.
    """
    here = linkage(data, "bricard-plane-symmetric")
    angles = moved(data, "bricard-plane-symmetric", 0.8)
    np.testing.assert_allclose(angles[:, [4, 5]], angles[:, [2, 1]], atol=CLOSE)

    def moment(first, second):
        carried = screw(here.points[1], here.directions[1], first) @ screw(here.points[2], here.directions[2], second)
        axis, point = carried[:3, :3] @ here.directions[3], carried[:3, :3] @ here.points[3] + carried[:3, 3]
        return np.cross(point - here.points[0], axis) @ here.directions[0]

    for first, second in angles[:, 1:3]:
        at, quarter, half = (moment(first, angle) for angle in (0.0, np.pi / 2, np.pi))
        a, c = (at - half) / 2, (at + half) / 2
        b = quarter - c
        solutions = np.arctan2(b, a) + np.array([1.0, -1.0]) * np.arccos(-c / np.hypot(a, b))
        assert np.abs(np.exp(1j * (solutions - second)) - 1.0).min() < CLOSE


def test_bricards_trihedral_linkage(data):
    """Right twists, no offsets, and a0^2 + a2^2 + a4^2 = a1^2 + a3^2 + a5^2.

    Axes 0, 2 and 4 have the directions of the corners of a spherical triangle whose sides are half a turn more
    than the angles at 1, 3 and 5, and whose angles are those at 2, 4 and 0: the law of cosines. Lengths are along
    the sides of its polar triangle, and sum to zero.
    """
    here = linkage(data, "bricard-trihedral")
    squares = (sides_of(here.points) ** 2).sum(axis=1)
    assert squares[::2].sum() == pytest.approx(squares[1::2].sum(), rel=1e-12)
    across = np.cross(here.directions, np.roll(here.directions, -1, axis=0))
    lengths = (sides_of(here.points) * across).sum(axis=1)
    begin = np.array([signed_angle(across[i - 1], across[i], here.directions[i]) for i in range(6)])
    for angles in begin + moved(data, "bricard-trihedral", 0.2, frames=4):
        c, s = np.cos(angles), np.sin(angles)
        for one, between, other, far in ((1, 2, 3, 5), (3, 4, 5, 1), (5, 0, 1, 3)):
            assert -c[far] == pytest.approx(c[one] * c[other] + s[one] * s[other] * c[between], abs=CLOSE)
        corner = np.array([1.0, 0.0, 0.0])
        second = np.array([-c[1], -s[1], 0.0])
        y = (c[3] + c[5] * c[1]) / s[1]
        third = np.array([-c[5], y, np.sqrt(1.0 - c[5] ** 2 - y**2)])
        gaps = []
        for triangle in ((corner, second, third), (corner, second, third * [1, 1, -1])):
            arcs = (-s[1], -s[3], -s[5])
            poles = [np.cross(triangle[i], triangle[(i + 1) % 3]) / arcs[i] for i in range(3)]
            around = [each for pair in zip(triangle, poles, strict=True) for each in pair]
            gaps.append(sum(lengths[i] * np.cross(around[i], around[(i + 1) % 6]) for i in range(6)))
        assert min(np.linalg.norm(gap) for gap in gaps) < CLOSE


def test_the_kaleidocycle_of_six(data):
    """cos s + cos t + cos s cos t = 0 of alternate angles (Chen, You and Tarnai 2005, right twists)."""
    here = linkage(data, "kaleidocycle-6")
    angles = angles_at_pose(here) + moved(data, "kaleidocycle-6", 0.4)
    np.testing.assert_allclose(angles[:, [2, 4]] - angles[:, [0, 0]], 0.0, atol=CLOSE)
    np.testing.assert_allclose(angles[:, [3, 5]] - angles[:, [1, 1]], 0.0, atol=CLOSE)
    s, t = np.cos(angles[:, 0]), np.cos(angles[:, 1])
    np.testing.assert_allclose(s + t + s * t, 0.0, atol=CLOSE)


@pytest.mark.parametrize(("solids", "freedoms"), [(6, 1), (7, 1), (8, 2)])
def test_freedoms_of_kaleidocycles(data, solids, freedoms):
    """n - 6 at a general pose, but that of six is overconstrained: 1."""
    here = linkage(data, f"kaleidocycle-{solids}")
    motion = move(here, drive={0: 0.06}, frames=1)
    end = motion.path.angles[-1]
    assert motion.path.stopped == ""
    assert rates_at(ClosureEquations(here), end).shape[1] == freedoms
    assert motion.taken.freedoms == freedoms


def test_sarrus_by_its_axes(data):
    """Three parallel joints keep the plates parallel: s, -2 s, s; both sides rise by twice arm times sine."""
    angles = moved(data, "sarrus", -0.5)
    for triple in (angles[:, :3], angles[:, 3:]):
        np.testing.assert_allclose(triple, triple[:, :1] * [1, -2, 1], atol=CLOSE)
    (first, slope), (second, other) = ((np.hypot(out, 0.8), np.arctan2(0.8, out)) for out in (0.6, 0.9))
    rises = [
        {arm * np.sin(begin + way * turn) for way in (1, -1)}
        for arm, begin, turn in ((first, slope, angles[-1, 0]), (second, other, angles[-1, 3]))
    ]
    assert min(abs(one - two) for one in rises[0] for two in rises[1]) < CLOSE


def test_sarrus_of_panels_goes_straight_up(data):
    here = configuration_of(read(data / "linkages" / "sarrus-panels.fold")).linkage
    assert rates_at(ClosureEquations(here), here.angles).shape[1] == 1
    joint = next(iter(here.graph.joints))
    motion = move(here, drive={joint: here.angles[0] + 0.4}, frames=4)
    assert motion.path.stopped == ""
    rotations, shifts = link_motions(here, motion.path.angles, 0)[1]  # the upper plate against the lower
    np.testing.assert_allclose(rotations, np.broadcast_to(np.eye(3), rotations.shape), atol=CLOSE)
    np.testing.assert_allclose(shifts[:, :2], 0.0, atol=CLOSE)
    assert abs(shifts[-1, 2]) > 0.05


@pytest.mark.parametrize(("pose", "freedoms"), [("open", 1), ("folded", 2), ("coplanar", 3)])
def test_wamplers_fig_1(data, pose, freedoms):
    """One freedom; two where the rectangles lie on each other; three to first order where all is in one plane."""
    here = configuration_of(read(data / "linkages" / f"wampler-fig1-{pose}.fold")).linkage
    assert rates_at(ClosureEquations(here), here.angles).shape[1] == freedoms


def test_wamplers_fig_1_as_a_model_moves_as_the_sheet_does(data):
    from graphs.convert.conversions import to_polyhedron

    sheet = read(data / "linkages" / "wampler-fig1-open.fold")
    one, other = configuration_of(sheet).linkage, configuration_of(to_polyhedron(sheet)).linkage
    assert (len(other.graph), len(other.graph.joints)) == (6, 7)
    np.testing.assert_allclose(np.sort(np.abs(other.angles)), np.sort(np.abs(one.angles)), atol=1e-12)
    assert rates_at(ClosureEquations(other), other.angles).shape[1] == 1


def test_wamplers_cube_flexes_to_first_order_only(data):
    """Two rates; the one self-stress has a definite form on them, so that no motion begins (second order)."""
    here = linkage(data, "wampler-cube-locked")
    closure = ClosureEquations(here)
    rates = rates_at(closure, here.angles)
    assert rates.shape[1] == 2
    left, values, _ = np.linalg.svd(closure.at(here.angles)[1].toarray())
    assert values[-2] > 1e-3 > 1e-12 > values[-1]
    stress, step = left[:, -1], 1e-4

    def bent(rate):  # the second derivative along rates
        ahead, behind = (closure.at(here.angles + way * step * rate)[0] for way in (1, -1))
        return stress @ (ahead + behind) / step**2

    x, y = rates.T
    mixed = (bent(x + y) - bent(x - y)) / 4
    form = np.linalg.eigvalsh([[bent(x), mixed], [mixed, bent(y)]])
    assert form[0] * form[1] > 0.0
    assert np.abs(form).min() > 1e-2


def test_a_cube_of_rods_moves_as_rods_do():
    """Without spokes the 12 rods of a cube have 3 * 8 - 6 - 12 freedoms; of a tetrahedron none."""
    from itertools import combinations, product

    from graphs.mechanism.polyhedron import PolyhedronModel

    corners = list(product((0.0, 1.0), repeat=3))
    rods = [(a, b) for a, b in combinations(range(8), 2) if np.abs(np.subtract(corners[a], corners[b])).sum() == 1]
    for vertices, edges, freedoms in (
        (corners, rods, 6),
        (corners[:1] + corners[1:3] + corners[4:5], list(combinations(range(4), 2)), 0),
    ):
        model = PolyhedronModel(len(vertices), edges, coordinates=dict(enumerate(vertices)))
        here = configuration_of(model).linkage
        assert rates_at(ClosureEquations(here), here.angles).shape[1] == freedoms


@pytest.mark.parametrize("row", range(6))
def test_two_equal_links_as_in_the_appendix(golden, row):
    """Wiener 2016, Appendix A: B over A and A', which are 2 phi apart: alpha = arccos(cos theta / cos phi).

    A rhombus with links theta, so that A and A' stay in a plane and B in another; it begins at phi = 15 degrees.
    """
    wanted = golden["003"]["appendixA"]["computed"][row]
    theta, phi = np.radians([wanted["theta"], wanted["phi"]])
    begin = np.radians(15.0)
    rise = np.arccos(np.cos(theta) / np.cos(begin))
    axes = {
        "A": (np.cos(begin), np.sin(begin), 0.0), "B": (np.cos(rise), 0.0, np.sin(rise)),
        "A'": (np.cos(begin), -np.sin(begin), 0.0), "C": (np.cos(rise), 0.0, -np.sin(rise)),
    }  # fmt: skip
    ring = SCGraph(4, {name: ((i - 1) % 4, i) for i, name in enumerate(axes)}, [Loop(tuple(axes))])
    rhombus = HingedSolids(ring, {name: ((0.0, 0.0, 0.0), axis) for name, axis in axes.items()})
    opening = [2 * np.arcsin(np.sin(half) / np.sin(theta)) for half in (begin, phi)]  # between the links at B
    for sign in (1.0, -1.0):
        motion = move(rhombus, drive={"B": sign * (opening[1] - opening[0])}, frames=1)
        places = _directions(motion.linkage, motion.path.angles[-1])
        apart = np.arccos(places[0] @ places[2]) / 2
        if abs(apart - phi) < 1e-6:
            break
    assert motion.path.stopped == ""
    assert apart == pytest.approx(phi, abs=CLOSE)
    alpha = np.arccos(places[1] @ places[3]) / 2
    assert np.degrees(alpha) == pytest.approx(wanted["alpha"], abs=1e-9)
    assert places[0] @ places[1] == pytest.approx(np.cos(theta), abs=CLOSE)


def _directions(here, angles):
    """Directions of all axes at joint angles."""
    motions = link_motions(here, angles[None])
    ends = here.graph.joints.values()
    return [motions[first][0][0] @ axis for (first, _), axis in zip(ends, here.directions, strict=True)]
