"""First-order behaviour: table, velocities, ICRL, shadow and true motion say the same; any chain."""

from __future__ import annotations

import numpy as np
import pytest
from conical import FOUR_BAR, STEPHENSON, WATT, random_linkages, steps_of
from four_bar_configurations import configurations_from_conformed
from second_methods import pole_axes, shadow_allows
from sizes import slow

from graphs.errors import InvariantError
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import joint_axes
from synth.linkages.conformed.behaviours import Way, behaviour, icrl, instant_centres, link_arcs, table4, table_row
from synth.linkages.conformed.rates import ConformedChain, first_order

COUNT = 10_000
FIVE = SCGraph(5, [(i, (i + 1) % 5) for i in range(5)])
EIGHT = SCGraph(8, [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0), (5, 6), (6, 7), (7, 2)])


@pytest.mark.parametrize("count", [4_000, slow(COUNT)])
def test_table_4_is_first_order_behaviour(count, rng):
    places, _, _, _ = random_linkages(rng, count)
    found = behaviour(ConformedChain.of(FOUR_BAR), places)
    rows = [table_row(one) for one in places]
    assert [row.intramobile for row in rows] == found.one_way.tolist()
    assert [row.extramobile for row in rows] == found.one_way.tolist()
    assert len({(row.case, row.configuration, row.column) for row in rows}) == 12
    assert (shadow_allows(places) == found.one_way).all()


@pytest.mark.parametrize("chain", [FOUR_BAR, WATT, STEPHENSON, FIVE, EIGHT], ids=["4", "watt", "stephenson", "5", "8"])
def test_rates_close_the_loops_in_space(chain, rng):
    """The closure of the true axes at any lambda has the same rank; angular velocities follow from w."""
    made = ConformedChain.of(chain)
    places = rng.uniform(-np.pi, np.pi, (500, len(made.joints)))
    lam = rng.uniform(0.05, 1.5, 500)
    motion = first_order(made, places)
    axes = joint_axes(places, lam)
    closure = np.einsum("lj,mjc->mlcj", made.loops, axes).reshape(500, -1, len(made.joints))
    rank = np.linalg.matrix_rank(closure, tol=1e-9)
    assert (rank == motion.rank()).all()
    expected = len(made.joints) - 3 * len(made.loops)
    assert (motion.freedoms == expected).all()
    assert motion.gap.min() > 1e3
    if expected != 1:
        assert np.isnan(motion.rates).all()
        assert (behaviour(made, places).ways == Way.UNKNOWN).all()
        return
    assert np.abs(np.einsum("mrj,mj->mr", closure, motion.rates)).max() < 1e-12
    omega = np.einsum("nj,mj,mjc->mnc", made.paths, motion.rates, axes)
    np.testing.assert_allclose(pole_axes(motion.motions, lam), omega, atol=1e-12)
    # a joint moves alike on both its links
    for j, (a, b) in enumerate(chain.joints.values()):
        one, two = (np.cross(omega[:, made.links.index(link)], axes[:, j]) for link in (a, b))
        np.testing.assert_allclose(one, two, atol=1e-12)


def test_ways_are_those_of_points_along_the_links(rng):
    """Outward rates by cross products at 200 points of each link, on a cone of any angle."""
    made = ConformedChain.of(WATT)
    places, lam = rng.uniform(-np.pi, np.pi, (400, 7)), rng.uniform(0.05, 1.4, 400)
    found = behaviour(made, places)
    omega = pole_axes(found.motion.motions, lam)
    arcs = link_arcs(made, places)
    small = 1e-10 * np.abs(found.motion.motions[..., ::2]).max(axis=(1, 2))[:, None]
    ways = []
    for n in range(6):
        t = arcs[:, n, :1] + arcs[:, n, 1:] * np.linspace(0, 1, 200)
        e = joint_axes(t, lam)
        s = np.sin(lam)[:, None]
        normal = np.stack([s * np.sin(t), np.broadcast_to(np.cos(lam)[:, None], t.shape), s * np.cos(t)], -1)
        rate = (np.cross(omega[:, None, n], e) * normal).sum(-1)
        out, into = (rate > small).any(axis=1), (rate < -small).any(axis=1)
        ways.append(np.where(out & into, Way.BOTH, out.astype(int) - into))
    ways = np.stack(ways, axis=1)
    assert (ways == found.ways).all()
    # the first link that moves one way moves outward
    one = np.abs(ways) == 1
    first = np.take_along_axis(ways, one.argmax(axis=1)[:, None], 1)
    assert (first[one.any(axis=1)] == 1).all()
    assert set(np.unique(found.ways)) == {-1, 0, 1, 2}


def test_all_links_have_one_sense(rng):
    """Links that move one way, relative to each other, by joints that two of them share."""
    made = ConformedChain.of(STEPHENSON)
    places = rng.uniform(-np.pi, np.pi, (2000, 7))
    found = behaviour(made, places)
    # a joint between two links that each move one way, away from the ground, moves as both do
    for j, (a, b) in enumerate(STEPHENSON.joints.values()):
        if 0 in (a, b):
            continue
        wa, wb = (found.ways[:, made.links.index(link)] for link in (a, b))
        both = (np.abs(wa) == 1) & (np.abs(wb) == 1) & ~found.tangent[:, j]
        assert both.sum() > 50
        assert (wa == wb)[both].all()
    first = np.abs(found.ways) == 1
    has = first.any(axis=1)
    assert (np.take_along_axis(found.ways, first.argmax(1)[:, None], 1)[has] == 1).all()


def test_ways_are_those_of_small_true_motion(rng):
    """Turn the input by 1e-4 and look on which side of the cone the coupler joints and links are."""
    places, steps, lam, _ = random_linkages(rng, 300)
    found = behaviour(ConformedChain.of(FOUR_BAR), places)
    compared = 0
    for i in range(300):
        pose = configurations_from_conformed(steps[i], lam[i], [1e-5, -1e-5])
        if not np.isfinite(pose.psi).all():
            continue
        lowered = pose.axes[:, 1:3, 1] + np.sin(lam[i])  # outward is along y
        if np.abs(lowered).min() < 1e-8:
            continue
        same = lowered[:, 0] * lowered[:, 1] > 0
        assert same[0] == same[1] == found.one_way[i]
        compared += 1
    assert compared > 200


def test_icrl_parts_inward_from_outward(rng):
    places, _, _, _ = random_linkages(rng, 2000)
    made = ConformedChain.of(FOUR_BAR)
    found = behaviour(made, places)
    line = icrl(found.motion.motions)
    assert np.isnan(line[:, 0]).all()
    for n in (1, 2, 3):
        joints = places[:, list(made.joints_of[n])]
        side = np.sin(joints - line[:, n : n + 1])
        both = (side > 1e-9).any(axis=1) & (side < -1e-9).any(axis=1)
        assert (both == (found.ways[:, n] == Way.BOTH)).all()


def test_instant_centres_are_in_line(rng):
    """Aronhold and Kennedy: the three relative centres of three links, for all triples of a Watt linkage."""
    places = rng.uniform(-np.pi, np.pi, (200, 7))
    w = first_order(ConformedChain.of(WATT), places).motions
    for i in range(6):
        for j in range(i):
            for k in range(j):
                three = np.stack([w[:, i] - w[:, j], w[:, j] - w[:, k], w[:, k] - w[:, i]], 1)
                three /= np.linalg.norm(three, axis=2, keepdims=True)
                assert np.abs(np.linalg.det(three)).max() < 1e-9
    # a joint is the centre of its two links
    made = ConformedChain.of(WATT)
    for joint, (a, b) in WATT.joints.items():
        relative = w[:, made.links.index(a)] - w[:, made.links.index(b)]
        point = instant_centres(relative[:, None])[:, 0]
        t = places[:, joint]
        np.testing.assert_allclose(point, np.stack([np.sin(t), np.cos(t)], -1), atol=1e-6)


def test_special_cases_on_the_centre_line():
    """Instant centre at infinity, at the centre of the circle, and a joint on the ICRL."""
    made = ConformedChain.of(FOUR_BAR)
    trapezium = behaviour(made, np.radians([45, 135, 225, 315]))
    assert not np.isfinite(instant_centres(trapezium.motion.motions[2:3])).all()
    # the side links are diameters: the coupler turns about the axis, and leaves the surface nowhere
    crossed = behaviour(made, np.radians([0, 180, 220, 40]))
    assert crossed.ways[2] == Way.STILL
    assert np.isnan(icrl(crossed.motion.motions)[2])
    assert crossed.tangent.tolist() == [False, True, True, False]
    # one side link is a diameter: A moves along the surface
    tangent = behaviour(made, np.radians([0, 180, 140, 90]))
    assert tangent.tangent.tolist() == [False, True, False, False]
    assert table_row(np.radians([0, 180, 140, 90])).special


def test_an_arc_of_more_than_half_the_circle_moves_both_ways(rng):
    """A ternary link whose joints lie all round."""
    places = rng.uniform(-np.pi, np.pi, (3000, 7))
    made = ConformedChain.of(STEPHENSON, 1)
    found = behaviour(made, places)
    arcs = link_arcs(made, places)
    wide = arcs[..., 1] > np.pi + 1e-6
    assert wide.sum() > 500
    moves = ~np.isnan(icrl(found.motion.motions))
    assert (found.ways[wide & moves] == Way.BOTH).all()


def test_other_arcs_can_be_given():
    made = ConformedChain.of(FOUR_BAR)
    places = np.radians([40, 90, 140, 0])
    arcs = link_arcs(made, places)
    assert behaviour(made, places, arcs).one_way
    arcs[2] = arcs[2, 0] + arcs[2, 1], 2 * np.pi - arcs[2, 1]  # the coupler the long way round
    assert behaviour(made, places, arcs).ways[2] == Way.BOTH


def test_a_loop_of_joints_in_line_has_more_freedoms():
    """Two joints on one ruling line twice: a stacked kite flat on itself turns two ways."""
    found = behaviour(ConformedChain.of(FOUR_BAR), np.radians([0, 60, 0, 60]))
    assert int(found.motion.freedoms) == 2
    assert (found.ways == Way.UNKNOWN).all()
    assert not found.one_way


def test_ground_link_may_be_any(rng):
    places = rng.uniform(-np.pi, np.pi, (100, 7))
    for ground in WATT:
        made = ConformedChain.of(WATT, ground)
        assert made.links[0] == ground
        assert (behaviour(made, places).ways[:, 0] == Way.STILL).all()


def test_a_tree_has_no_closure():
    made = ConformedChain.of(SCGraph(2, [(0, 1)]))
    assert first_order(made, np.zeros((5, 1))).freedoms.tolist() == [1] * 5


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: ConformedChain.of(FOUR_BAR, 9), "ground 9 is no link"),
        (lambda: ConformedChain.of(SCGraph(3, [(0, 1)])), "the chain is in several parts"),
        (lambda: first_order(ConformedChain.of(FOUR_BAR), [0.0, 1.0]), "2 azimuths; expected 4, one per joint"),
        (lambda: table_row([0.0, 1.0]), "2 azimuths; expected four"),
        (lambda: table_row([0.0, 0.0, 1.0, 2.0]), "two joints lie on one ruling line"),
        (lambda: table4(3, "open", "A"), "no entry 3"),
    ],
)
def test_what_cannot_be_asked(call, message):
    with pytest.raises(InvariantError) as error:
        call()
    assert message in str(error.value)


def test_steps_are_those_of_the_joints(rng):
    """The convention of these tests: joint i + 1 less joint i."""
    places, steps, _, _ = random_linkages(rng, 10)
    np.testing.assert_array_equal(steps, steps_of(places))
