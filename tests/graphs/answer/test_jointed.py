"""Mobility of linkages with joints of all kinds: counted, by ranks, and passive freedoms told apart."""

import pytest
from random_joints import random_jointed
from second_methods import freedoms_by_screws

from graphs.answer.mobility import counts_and_ranks
from graphs.answer.mobility_of_joints import passive_freedoms
from graphs.joints import JointedLinkage, JointKind, placed
from graphs.joints.linkage import legs
from graphs.mechanism.sc import SCGraph
from synth.catalogue.patterns import generate

PLATFORMS = {
    "stewart": (6, 0), "6-rus": (6, 0), "6-uuu": (6, 0), "6-sps": (12, 6), "3-rps": (3, 0), "3-upu": (3, 0),
    "3-uuu": (6, 0),
}  # fmt: skip


@pytest.mark.parametrize("name", PLATFORMS)
def test_platforms_have_the_freedoms_of_their_sources(name):
    freedoms, passive = PLATFORMS[name]
    answer = counts_and_ranks(generate(name).mechanism)
    assert (answer.mobility, answer.infinitesimal.dof, answer.counts["passive"]) == (freedoms, freedoms, passive)
    assert answer.overconstraint == 0
    assert any("legs that spin" in note for note in answer.warnings) == bool(passive)


def test_a_type_without_places_has_no_pose():
    linkage = generate("6-sps").mechanism
    answer = counts_and_ranks(JointedLinkage(linkage.chain, linkage.kinds))
    assert (answer.mobility, answer.infinitesimal, answer.counts["passive"]) == (12, None, 6)
    assert "for a generic realisation, placed at random, the result is 12 degrees of freedom" in " ".join(
        answer.warnings
    )


def test_an_exact_rank_is_not_passed_over_in_silence():
    linkage = generate("3-rps").mechanism
    assert any("no exact rank" in note for note in counts_and_ranks(linkage, exact=True).warnings)
    assert not any("no exact rank" in note for note in counts_and_ranks(linkage).warnings)


def test_a_slide_alone_is_counted_as_one_joint():
    chain = SCGraph(2, {"p": (0, 1)})
    answer = counts_and_ranks(placed(JointedLinkage(chain, {"p": JointKind.PRISMATIC})))
    assert (answer.mobility, answer.infinitesimal.dof, answer.equations["loop_form"].value) == (1, 1, 1)
    assert (answer.links, answer.joints, answer.counts["revolutes"]) == (2, 1, 6)


@pytest.mark.parametrize(
    ("joints", "row"),
    [
        ({"s": (0, 1), "t": (1, 2)}, ("s", "t")),  # a rod on an arm that is open
        ({"s": (0, 1), "t": (1, 0)}, ("t", "s")),  # two links, two balls
        ({"s": (0, 1), "t": (1, 0), "r": (0, 2)}, ("s", "t")),  # a rod on one link with both ends
    ],
)
def test_a_link_between_two_balls_spins(joints, row):
    kinds = {joint: JointKind.REVOLUTE if joint == "r" else JointKind.SPHERICAL for joint in joints}
    linkage = JointedLinkage(SCGraph(len({end for ends in joints.values() for end in ends}), joints), kinds)
    (passive,) = passive_freedoms(placed(linkage))
    assert (passive.joints, passive.freedoms, passive.spins) == (row, 1, True)
    assert counts_and_ranks(linkage).counts["passive"] == 1


def test_an_open_arm_has_a_spin_for_each_two_balls_in_a_row():
    arm = SCGraph(5, {i: (i, i + 1) for i in range(4)})
    kinds = dict(enumerate("SSRS"))
    assert [one.joints for one in passive_freedoms(placed(JointedLinkage(arm, kinds)))] == [(0, 1), (1, 2, 3)]


def freedoms_of_leg_held(linkage, joints):
    """Of a leg whose ends are one body: a ring, closed by itself."""
    n = len(joints)
    ring = SCGraph(n, {joint: (i, (i + 1) % n) for i, joint in enumerate(joints)})
    kinds = {joint: linkage.kinds[joint] for joint in joints}
    return freedoms_by_screws(JointedLinkage(ring, kinds, {joint: linkage.places[joint] for joint in joints}))


@pytest.mark.parametrize("first", range(4))
@pytest.mark.parametrize("ground", [None, 0])
def test_the_rod_of_a_lone_ring_spins_wherever_the_ring_begins(first, ground):
    chain = SCGraph(4, {f"j{(i + first) % 4}": (i, (i + 1) % 4) for i in range(4)}, ground=ground)
    balls = {"j1": JointKind.SPHERICAL, "j2": JointKind.SPHERICAL}
    rest = {"j0": JointKind.REVOLUTE, "j3": JointKind.REVOLUTE}
    passive = passive_freedoms(placed(JointedLinkage(chain, {**balls, **rest})))
    if ground == 0 and first == 2:  # the rod itself is held: what turns about its line is all else
        assert passive == ()
    else:
        (rod,) = passive
        assert (set(rod.joints), rod.freedoms, rod.spins) == (set(balls), 1, True)


def test_passive_freedoms_are_those_of_legs_whose_ends_are_held():
    told = 0
    for seed in range(20):
        linkage = placed(random_jointed(seed), seed)
        passive = passive_freedoms(linkage)
        told += len(passive)
        for one in passive:
            assert one.freedoms == freedoms_of_leg_held(linkage, one.joints)
        moving = {joint for one in passive for joint in one.joints}
        for leg in legs(linkage.chain):
            if len(leg.joints) > 1 and not moving & set(leg.joints) and leg.links[0] != leg.links[-1]:
                assert freedoms_of_leg_held(linkage, leg.joints) == 0 or is_open(linkage.chain, leg)
    assert told > 2


def is_open(chain, leg):
    return 1 in (chain.degree(leg.links[0]), chain.degree(leg.links[-1]))
