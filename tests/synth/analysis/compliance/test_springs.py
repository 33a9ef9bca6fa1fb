"""Springs: equilibria, load paths and frequencies against closed forms of a planar four-bar and of pendulums."""

import json
import re
from dataclasses import replace
from math import pi, radians

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

import synth
from graphs.errors import InvariantError, UnsolvableError
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from synth.analysis.compliance import DrivenJoint, Mass, Masses, SpringArrays, Springs, sheet_masses, states
from synth.analysis.compliance.springs import ElasticLinkage, equilibrium, load_path, mass_matrix, small_motions
from synth.analysis.motion.linkage import linkage_of_axes
from synth.analysis.moving._configuration_of import configuration_of
from synth.catalogue.patterns import generate

GROUND, CRANK, COUPLER, ROCKER = 4.0, 1.5, 3.5, 3.0
STIFFNESS = {0: 0.4, 1: 1.0, 2: 0.7, 3: 0.2}
REST = {0: 0.3, 1: -0.9, 2: 0.5, 3: 0.1}
START = 1.1


def corners(crank):
    """Where the joints are at a crank angle, by the crossing of two circles: float[..., 4, 2]."""
    crank = np.asarray(crank)
    a = CRANK * np.stack([np.cos(crank), np.sin(crank)], axis=-1)
    d = np.array([GROUND, 0.0])
    between = d - a
    length = np.linalg.norm(between, axis=-1, keepdims=True)
    along = (COUPLER**2 - ROCKER**2 + length**2) / (2.0 * length)
    across = np.sqrt(COUPLER**2 - along**2)
    unit = between / length
    b = a + along * unit + across * np.stack([-unit[..., 1], unit[..., 0]], axis=-1)
    zero = np.zeros_like(a)
    return np.stack([zero, a, b, zero + d], axis=-2)


def turned(crank):
    """Joint angles from the start: each the turn of its second link less that of its first."""

    def ways(at):
        o, a, b, d = np.moveaxis(corners(at), -2, 0)
        return [np.arctan2(v[..., 1], v[..., 0]) for v in (a - o, b - a, d - b)]

    now, then = ways(crank), ways(START)
    crank_turn, coupler_turn, rocker_turn = (np.angle(np.exp(1j * (n - t))) for n, t in zip(now, then, strict=True))
    return np.stack([crank_turn, coupler_turn - crank_turn, rocker_turn - coupler_turn, -rocker_turn], axis=-1)


def energy(crank, stiffness=None, rest=None):
    stiff = np.array([(stiffness or STIFFNESS).get(joint, 0.0) for joint in range(4)])
    free = np.array([(rest or REST).get(joint, 0.0) for joint in range(4)])
    return 0.5 * (stiff * (turned(crank) - free) ** 2).sum(axis=-1)


def four_bar():
    """Links 0 ground, 1 crank, 2 coupler, 3 rocker; joint k between links k and k + 1."""
    ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop(range(4), "infinite")])
    points = [(x, y, 0.0) for x, y in corners(START).tolist()]
    return HingedSolids(ring, {joint: (points[joint], (0.0, 0.0, 1.0)) for joint in range(4)})


def elastic(stiffness=None, rest=None, moments=None):
    return ElasticLinkage(
        configuration_of(four_bar()).linkage, Springs(stiffness or STIFFNESS, rest or REST, moments or {})
    )


def test_equilibrium_is_the_minimum_of_the_closed_form():
    best = minimize_scalar(energy, bounds=(START - 0.7, START + 0.7), method="bounded", options={"xatol": 1e-12})
    found = equilibrium(elastic())
    assert found.energy == pytest.approx(best.fun, abs=1e-12)
    assert found.angles == pytest.approx(turned(best.x), abs=1e-6)  # of a minimum the place is known to half the digits
    assert found.stable
    assert found.error < 1e-12
    slope = (energy(START + found.angles[0] + 1e-5) - energy(START + found.angles[0] - 1e-5)) / 2e-5
    assert slope == pytest.approx(0.0, abs=1e-9)


def test_a_moment_moves_it_to_where_the_slope_is_that_moment():
    found = equilibrium(elastic(moments={0: 0.15}))
    at = START + found.angles[0]
    assert (energy(at + 1e-5) - energy(at - 1e-5)) / 2e-5 == pytest.approx(0.15, abs=1e-9)


def test_moments_of_a_load_path_are_the_slopes_of_the_energy_and_work_is_what_it_stores():
    bending = elastic()
    goals = np.linspace(0.0, 0.6, 11)[1:]
    path = load_path(bending, bending.linkage.angles, 0, goals)
    driven, ends = np.array([(pose.angles[0], pose.held[0]) for pose in path.equilibria]).T
    cranks = START + driven
    assert not path.stopped
    assert driven[1:] == pytest.approx(goals, abs=1e-12)
    assert ends == pytest.approx((energy(cranks + 1e-5) - energy(cranks - 1e-5)) / 2e-5, abs=1e-8)
    step = goals[1] - goals[0]
    simpson = step / 3.0 * (ends[0] + ends[-1] + 4.0 * ends[1:-1:2].sum() + 2.0 * ends[2:-1:2].sum())
    assert simpson == pytest.approx(path.equilibria[-1].energy - path.equilibria[0].energy, abs=1e-6)
    assert [pose.energy for pose in path.equilibria] == pytest.approx(energy(cranks).tolist(), abs=1e-10)


def test_a_joint_that_is_not_the_crank_is_driven_as_well():
    """Work at the coupler's joint: the moment is dE / d(angle of that joint), both by the crank."""
    bending = elastic()
    path = load_path(bending, bending.linkage.angles, 1, [-0.1, -0.2, -0.3])
    for pose in path.equilibria:
        crank = START + pose.angles[0]
        by_crank = (energy(crank + 1e-5) - energy(crank - 1e-5)) / 2e-5
        turns = (turned(crank + 1e-5) - turned(crank - 1e-5))[1] / 2e-5
        assert pose.held[0] == pytest.approx(by_crank / turns, abs=1e-7)


def test_a_joint_at_rest_in_two_poses_makes_it_rigid_in_both():
    """The angle between coupler and rocker is that of the distance from A to D: the same at opposite crank angles."""
    asked = DrivenJoint(0, -2.0 * START, 3)  # an odd number: the crank does not stop half-way, where it is a dead point
    found = synth.states(four_bar(), springs=Springs({2: 1.0}), drive=asked).elastic
    kinds = [one.state.kind for one in found.path]
    assert kinds == ["rigid immobile", *2 * ["compliant mobile"], "rigid immobile"]
    assert [(one.joint, one.driven) for one in found.passed] == [(2, pytest.approx(-2.0 * START))]
    beyond = synth.states(four_bar(), springs=Springs({2: 1.0}), drive=DrivenJoint(0, -2.05 * START, 2)).elastic
    assert [one.driven for one in beyond.passed] == [pytest.approx(-2.0 * START, abs=1e-5)]
    assert beyond.path[-1].state.kind == "compliant mobile"


def frequency_by_crank(masses, at):
    """Of the closed form: curvature over inertia, a mass at the middle of the coupler and one at its far end."""

    def places(crank):
        _, a, b, _ = np.moveaxis(corners(crank), -2, 0)
        return (a + b) / 2.0, b

    bend = (energy(at + 1e-4) - 2.0 * energy(at) + energy(at - 1e-4)) / 1e-8
    inertia = sum(
        mass * (((ahead - back) / 2e-5) ** 2).sum()
        for mass, ahead, back in zip(masses, places(at + 1e-5), places(at - 1e-5), strict=True)
    )
    return np.sqrt(bend / inertia) / (2.0 * pi)


def test_the_frequency_of_a_four_bar_is_that_of_its_closed_form():
    """Springs are strained at the equilibrium, so second derivatives of the closure count."""
    found = equilibrium(elastic())
    _, a, b, _ = corners(START)
    middle = ((a + b) / 2.0).tolist()
    points = Masses((Mass(2, 2.0, (*middle, 0.3)), Mass(2, 0.5, (*b.tolist(), 0.0))))
    told = synth.states(four_bar(), springs=Springs(STIFFNESS, REST), masses=points).elastic.modes
    assert len(told) == 1
    assert told[0].frequency == pytest.approx(frequency_by_crank((2.0, 0.5), START + found.angles[0]), rel=1e-6)
    assert told[0].growth is None


def test_two_pendulums_in_a_row():
    """Joints at 0 and 1, masses at 1 and 2 along x, springs of 1: squares of the rates are 3 -+ 2 sqrt(2), over 1."""
    chain = SCGraph(3, [(0, 1), (1, 2)])
    bars = linkage_of_axes(chain, {0: ((0, 0, 0), (0, 0, 1)), 1: ((1, 0, 0), (0, 0, 1))})
    masses = Masses((Mass(1, 1.0, (1.0, 0.0, 0.0)), Mass(2, 1.0, (2.0, 0.0, 0.0))))
    inertia = mass_matrix(bars, bars.angles, masses)
    assert inertia == pytest.approx(np.array([[5.0, 2.0], [2.0, 1.0]]), abs=1e-12)
    modes = synth.states(bars, springs=Springs({0: 1.0, 1: 1.0}), masses=masses).elastic.modes
    squares = [(2.0 * pi * mode.frequency) ** 2 for mode in modes]
    assert squares == pytest.approx([3.0 - 2.0 * 2.0**0.5, 3.0 + 2.0 * 2.0**0.5], rel=1e-9)


def test_the_ground_is_what_stays():
    chain = SCGraph(2, [(0, 1)])
    door = linkage_of_axes(chain, {0: ((0, 0, 0), (0, 0, 1))})
    points = (Mass(0, 1.0, (1.0, 0.0, 0.0)), Mass(1, 1.0, (3.0, 0.0, 0.0)))
    assert mass_matrix(door, door.angles, Masses(points)).item() == pytest.approx(9.0)
    assert mass_matrix(door, door.angles, Masses(points, ground=1)).item() == pytest.approx(1.0)
    with pytest.raises(UnsolvableError, match="moves no mass"):
        synth.states(door, springs=Springs({0: 1.0}), masses=Masses(points[:1]))


def test_an_unstable_equilibrium_grows():
    """Half-way between two crank angles with the spring at rest the energy falls both ways."""
    bending = elastic({2: 1.0}, {2: 0.0})
    path = load_path(bending, bending.linkage.angles, 0, [-START])
    assert path.equilibria[-1].held[0] == pytest.approx(0.0, abs=1e-9)
    assert path.equilibria[-1].energy == pytest.approx(energy(0.0, {2: 1.0}, {2: 0.0}))
    top = equilibrium(bending, path.equilibria[-1].angles)
    assert not top.stable
    b = corners(START)[2]
    [mode] = small_motions(bending, top, Masses((Mass(2, 1.0, (*b.tolist(), 0.0)),)))
    ends = (corners(way)[2] for way in (1e-5, -1e-5))
    inertia = (((next(ends) - next(ends)) / 2e-5) ** 2).sum()
    bend = np.array([energy(way, {2: 1.0}, {2: 0.0}) for way in (1e-3, 0.0, -1e-3)]) @ [1.0, -2.0, 1.0] / 1e-6
    assert mode.frequency is None
    assert mode.growth == pytest.approx(np.sqrt(-bend / inertia), rel=1e-4)


def test_panels_have_the_inertia_of_plates():
    """About a side of length 2, a square of density 3 has m a^2 / 3; a concave panel is its triangle less another."""
    book = Sheet(
        6, ((0, 1),), "V", ((0, 1, 2, 3), (1, 0, 4, 5)),
        ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2)),
    )  # fmt: skip
    linkage = configuration_of(book).linkage
    masses = Masses(sheet_masses(book, 3.0))
    assert mass_matrix(linkage, linkage.angles, masses).item() == pytest.approx(12.0 * 4.0 / 3.0)
    bent = Sheet(4, (), "", ((0, 1, 2, 3),), ((0, 0), (2, 0), (0.5, 0.5), (0, 2)))
    assert sum(one.mass for one in sheet_masses(bent, 1.0)) == pytest.approx(1.0)


def test_a_folded_sheet_with_stiff_creases_unfolds_towards_its_rest():
    """One freedom, overconstrained: the minimum over poses that folding alone gives."""
    folded = generate("miura", rows=3, columns=3, fold=radians(50)).mechanism
    linkage = configuration_of(folded).linkage
    joints = list(linkage.graph.joints)
    springs = Springs(dict.fromkeys(joints, 1.0), dict.fromkeys(joints, 0.0), {joints[0]: 2.0})
    bending = ElasticLinkage(linkage, springs)
    found = equilibrium(bending)
    goals = [found.angles[0] + way for way in (-1e-3, 1e-3)]
    beside = [synth.move(linkage, drive={joints[0]: goal}, frames=2).path.angles[-1] for goal in goals]
    assert found.stable
    assert found.energy < min(map(bending.energy, beside)) < found.energy + 1e-4


def test_what_springs_refuse():
    linkage = configuration_of(four_bar()).linkage
    with pytest.raises(InvariantError, match="0 or more"):
        ElasticLinkage(linkage, Springs({0: -1.0}))
    with pytest.raises(InvariantError, match="has no spring"):
        ElasticLinkage(linkage, Springs({0: 1.0}, {1: 1.0}))
    flat = configuration_of(generate("miura", rows=2, columns=2).mechanism).linkage
    with pytest.raises(UnsolvableError, match="fold it a little first"):
        ElasticLinkage(flat, Springs({next(iter(flat.graph.joints)): 1.0}))
    with pytest.raises(UnsolvableError, match="require springs"):
        synth.states(four_bar(), joints=[0], drive=DrivenJoint(0, 1.0))
    rigid = replace(linkage, directions=np.array([[0.0, 0, 1], [0, 1, 0], [1, 0, 0], [0, 0.6, 0.8]]))
    with pytest.raises(UnsolvableError, match="nothing to move"):
        ElasticLinkage(rigid, Springs({0: 1.0}))
    with pytest.raises(InvariantError, match="more than 0"):
        synth.states(four_bar(), springs=Springs({0: 1.0}), masses=Masses((Mass(1, -1.0, (0.0, 0.0, 0.0)),)))


def test_springs_of_many_copies_are_those_of_each():
    """Arrays of stiffness, rest and moments; a copy without a spring at a joint, and a driven joint."""
    mechanism, chance = generate("five-bar").mechanism, np.random.default_rng(3)
    stiffness, rest = chance.uniform(0.5, 2.0, (3, 4)), chance.uniform(-0.4, 0.4, (2, 4))
    stiffness[2, 1] = 0.0
    copies = SpringArrays(
        dict(enumerate(stiffness)), rest={0: rest[0], 2: rest[1]}, moments={3: chance.uniform(-0.2, 0.2, 4), 4: 0.1}
    )
    masses = Masses([Mass(link, 1.0, (0.3 * link, 1.0, 0.2)) for link in range(5)])
    drive = DrivenJoint(0, 0.3, frames=3)
    table = states(mechanism, springs=copies, drive=drive, masses=masses)
    assert (len(table), table.path.shape, table.why) == (4, (4, 4, 5), {})
    for copy in range(4):
        one = states(mechanism, springs=copies[copy], drive=drive, masses=masses)
        pose = one.elastic.balance
        np.testing.assert_array_equal(table.angles[copy], pose.angles)
        assert (table.energy[copy], table.least[copy], table.stable[copy]) == (pose.energy, pose.least, pose.stable)
        np.testing.assert_array_equal(table.path[copy], [point.balance.angles for point in one.elastic.path])
        np.testing.assert_array_equal(table.moments[copy], [point.balance.held[0] for point in one.elastic.path])
        np.testing.assert_array_equal(table.frequencies[copy], [mode.frequency for mode in one.elastic.modes])
        now = table.now[copy]
        assert (set(now.active.joints), now.freedoms) == (set(one.now.active.joints), one.now.freedoms)
    assert (table.balanced.all(), table.residuals.max() < 1e-12) == (True, True)
    assert json.loads(json.dumps(table.to_json()))["energy"] == table.energy.tolist()
    assert "an equilibrium for 4 of them" in str(table)


def test_a_copy_whose_load_path_ends_says_so():
    table = states(
        generate("four-bar").mechanism,
        springs=SpringArrays({0: [1.0, 2.0]}, rest={0: [0.0, 0.2]}),
        drive=DrivenJoint(1, 3.0, frames=6),
    )
    one = states(generate("four-bar").mechanism, springs=Springs({0: 1.0}, rest={0: 0.0}), drive=DrivenJoint(1, 3.0, 6))
    reached = len(one.elastic.path)
    assert table.why[0] == one.elastic.stopped != ""
    assert (~np.isnan(table.moments[0])).sum() == reached < 7
    assert f"copy 0: {table.why[0]}" in str(table)


@pytest.mark.parametrize(
    ("springs", "told"),
    [
        (lambda: SpringArrays({0: [1.0, 2.0], 1: [1.0]}), "arrays of shapes (1,), (2,)"),
        (lambda: SpringArrays({0: [1.0, -2.0]})[1], "joint 0 has -2.0"),
    ],
)
def test_arrays_that_do_not_fit_are_refused(springs, told):
    with pytest.raises(InvariantError, match=re.escape(told)):
        springs()
