"""What the order of joints decides over all angles: formulas, signs, refutations, samples."""

from __future__ import annotations

import numpy as np
import pytest
from conical import FOUR_BAR, STEPHENSON, WATT
from sizes import slow

from enumerate.chains.jobs import chains
from enumerate.conical.query import links_apart
from enumerate.conical.rounds import Rounds, placements
from graphs.convert.link_joint import sc_from_link_joint_graph
from synth.linkages.conformed.behaviours import link_arcs
from synth.linkages.conformed.outward_rate import arc_sets, joint_rates, outward_rates, sign_of_sum
from synth.linkages.conformed.rates import ConformedChain, first_order, loops_of_chain, signed_cycles
from synth.linkages.conformed.rates_over_angles import (
    Allowed,
    layers,
    never_singular,
    orders_with_opposites,
    over_angles,
    sampled,
)
from synth.synthesis.candidates.job import CandidateJob
from synth.synthesis.candidates.rows import loop_circuits

CHAINS = {"four-bar": FOUR_BAR, "watt": WATT, "stephenson": STEPHENSON}


def eight_bars():
    return [sc_from_link_joint_graph(graph) for graph in chains(8, 1)]


def measured_rates(chain, places):
    """Outward rates of joints by velocities."""
    motion = first_order(chain, places)
    found = []
    for joint in range(len(chain.joints)):
        link = next(n for n, joints in enumerate(chain.joints_of) if joint in joints)
        w = motion.motions[:, link]
        found.append(w[:, 2] * np.sin(places[:, joint]) - w[:, 0] * np.cos(places[:, joint]))
    return np.stack(found, axis=-1), motion


@pytest.mark.parametrize("every", [70, slow(1)])
def test_outward_rates_are_those_of_velocities(every, rng):
    """Every formula, of every choice of loops and path, with one common scale for all joints."""
    for sc in [*CHAINS.values(), *eight_bars()[::every]]:
        chain = ConformedChain.of(sc, rng.choice(list(sc)))
        places = rng.uniform(0, 2 * np.pi, (50, len(chain.joints)))
        wanted, motion = measured_rates(chain, places)
        rates, formulas = joint_rates(chain), outward_rates(chain)
        q = np.stack([one[0].values(places) for one in rates], axis=-1)
        scale = (q * motion.rates).sum(axis=1)
        np.testing.assert_allclose(q, scale[:, None] * motion.rates, atol=1e-9 * np.abs(q).max())
        for joint, (of_rate, of_joint) in enumerate(zip(rates, formulas, strict=True)):
            for one in of_rate:
                np.testing.assert_allclose(one.values(places), q[:, joint], atol=1e-9 * np.abs(q).max())
            for one in of_joint:
                np.testing.assert_allclose(
                    one.values(places), scale * wanted[:, joint], atol=1e-9 * np.abs(scale).max()
                )
            assert bool(of_joint) == (joint not in chain.joints_of[0])


def test_sums_of_products_of_chords_have_the_sign_that_is_told(rng):
    """Random arcs of random orders, signs of their sums by numbers."""
    told = 0
    for joints in (4, 7):
        slots = np.array([[0, *(k + joints * rng.integers(2) for k in rng.permutation(range(1, joints)))]] * 1)
        places = sampled(slots, 200)[0]
        arcs = arc_sets(slots)[0]
        for _ in range(400):
            terms, factors = rng.integers(2, 5), rng.integers(1, 4)
            first, second = rng.integers(joints, size=(2, terms, factors))
            second = np.where(first == second, (first + 1) % joints, second)
            signs = rng.choice([1, -1], terms).astype(np.int8)
            chords = np.abs(np.sin((places[:, first] - places[:, second]) / 2))
            assert (chords > 0).all()
            [sign] = sign_of_sum(signs[None], arcs[first, second][None])
            told += bool(sign)
            assert (sign * (chords.prod(axis=-1) * signs).sum(axis=-1) >= -1e-12).all()
    assert told > 100


@pytest.mark.parametrize("name", CHAINS)
def test_orders_with_opposites_are_those_that_are_enumerated(name):
    """2^(J - 1) of each cyclic order: together all placements on 2 J slots, one of each two opposite ones."""
    joints = len(CHAINS[name].joints)
    identity = np.arange(joints)[None]
    orders = placements(Rounds(joints, joints, joints), identity)[0]
    found = orders_with_opposites(orders).reshape(-1, joints)
    listed = placements(Rounds(joints, 2 * joints, joints), identity)[0]
    both = np.concatenate([found, np.remainder(-found, 2 * joints)])
    assert len(found) == len(orders) * 2 ** (joints - 1) == len(listed)
    assert set(map(tuple, listed.tolist())) <= set(map(tuple, both.tolist()))


@pytest.mark.parametrize(("sc", "unknown"), [(FOUR_BAR, 0.0), (WATT, 0.01), slow(STEPHENSON, 0.03)], ids=list(CHAINS))
def test_what_holds_for_all_angles_holds_for_random_ones(sc, unknown, rng):
    """Against velocities at angles of their own; both examples exist where it is by angles."""
    joints = len(sc.joints)
    for ground in links_apart(sc.joints):
        chain = ConformedChain.of(sc, ground)
        orders = np.array([[0, *rng.permutation(np.arange(1, joints))] for _ in range(6)])
        sets = orders_with_opposites(orders).reshape(-1, joints)
        found = over_angles(chain, sets)
        places = sampled(sets, 24, seed=7)
        wanted, motion = measured_rates(chain, places.reshape(-1, joints))
        assert (motion.freedoms == 1).all()
        wanted = wanted.reshape(places.shape)
        clear = np.abs(wanted) > 1e-7 * np.abs(wanted).max(axis=-1, keepdims=True)
        certain = found.signs[:, None] * np.sign(wanted) * clear
        assert ((certain >= 0).all(axis=-1) | (certain <= 0).all(axis=-1)).all()
        full = never_singular(chain, sets * (np.pi / joints))
        assert full.all()
        arcs = link_arcs(chain, places)
        moving = [[j for j in mine if j not in chain.joints_of[0]] for mine in chain.joints_of]
        for number, mine in list(enumerate(chain.joints_of))[1:]:
            del mine
            own = wanted[..., moving[number]]
            sure = clear[..., moving[number]].all(axis=-1)
            one = ((own > 0).all(axis=-1) | (own < 0).all(axis=-1)) & (arcs[..., number, 1] < np.pi)
            allowed = found.links[:, number]
            assert (one | ~sure)[allowed == Allowed.ONE].all()
            assert (~one | ~sure)[allowed == Allowed.BOTH].all()
        assert (found.links == Allowed.UNKNOWN).mean() <= unknown


def test_watt_with_a_ternary_ground_is_decided_by_the_order_with_opposites():
    rows = CandidateJob(WATT, (0,)).rows()
    assert len(rows) == 192
    assert {row["by_angles"] + row["not_known"] for row in rows} == {0}
    assert all(row["one_way"] + row["both_ways"] == 64 and row["full_rank"] for row in rows)


def test_circuits_follow_from_the_order_alone(rng):
    for sc in CHAINS.values():
        joints = len(sc.joints)
        number = {joint: i for i, joint in enumerate(sc.joints)}
        loops = [[number[joint] for joint in loop] for loop in loops_of_chain(sc)]
        order = rng.permutation(joints)
        even = loop_circuits(loops, order * (2 * np.pi / joints))
        uneven = np.sort(rng.uniform(0, 2 * np.pi, (500, joints)), axis=1)[:, order]
        for one, other in zip(even, loop_circuits(loops, uneven), strict=True):
            assert (other.density == one.density).all()
            assert (other.open == one.open).all()
        rows = CandidateJob(sc).rows()
        assert all(row["circuits"].count("open") == row["open_loops"] for row in rows)


def test_turns_and_layers_over_all_angles_are_reached_and_not_left(rng):
    job = CandidateJob(STEPHENSON)
    rows = job.rows()
    chain = ConformedChain.of(STEPHENSON)
    for row in rows[::17]:
        slots = np.array(row["slots"])
        places = sampled(orders_with_opposites(slots), 3, seed=int(rng.integers(1000))).reshape(-1, 7)
        deep = layers(chain, places)
        assert (deep.min(), deep.max()) == (row["layers"], row["most_layers"])
        joints = list(STEPHENSON.joints)
        loops = [[joints.index(joint) for joint in loop] for loop in loops_of_chain(STEPHENSON)]
        for one, told in zip(loop_circuits(loops, places), row["turns"], strict=True):
            turns = np.abs(one.turns)
            assert (turns.min(), turns.max()) == tuple(told)


def test_signed_cycles_close(rng):
    for sc in [*CHAINS.values(), *eight_bars()]:
        chain = ConformedChain.of(sc)
        cycles = signed_cycles(chain)
        assert np.linalg.matrix_rank(cycles) == np.linalg.matrix_rank(np.vstack([cycles, chain.loops]))
        assert len({tuple(np.abs(row)) for row in cycles}) == len(cycles) >= 2 ** len(chain.loops) - 2
    del rng
