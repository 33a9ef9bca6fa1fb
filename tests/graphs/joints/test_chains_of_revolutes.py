"""Joints of all kinds as chains of revolutes, and back: by types, by ids, by screws that know nothing of chains."""

import numpy as np
import pytest
from random_joints import random_jointed
from second_methods import freedoms_by_screws

from graphs.answer.conversion import convert
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.joints import JointedLinkage, JointKind, JointPlace, kind_named, placed, recognised, revolutes_of
from graphs.joints.linkage import legs
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.rank.infinitesimal import infinitesimal_mobility_of_axes

MANY = [*range(20), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(20, 1000))]
R, P, U, S, C, E = JointKind


def row(*kinds, ring=False):
    """A chain of links joined one to the next."""
    n = len(kinds) + (not ring)
    chain = SCGraph(n, {f"j{i}": (i, (i + 1) % n) for i in range(len(kinds))})
    return JointedLinkage(chain, dict(zip(chain.joints, kinds, strict=True)))


def ends(linkage):
    return {joint: frozenset(pair) for joint, pair in linkage.chain.joints.items()}


@pytest.mark.parametrize("seed", MANY)
def test_types_of_joints_there_and_back(seed):
    linkage = random_jointed(seed)
    back = recognised(revolutes_of(linkage, seed))
    assert dict(back.kinds) == dict(linkage.kinds)
    assert ends(back) == ends(linkage)
    assert set(back.chain.nodes) == set(linkage.chain.nodes)
    assert back.chain.ground == linkage.chain.ground


@pytest.mark.parametrize("seed", range(8))
def test_revolutes_have_the_freedoms_of_the_joints(seed):
    """By the rank of the axes of revolutes, and of the screws of slides and balls themselves."""
    linkage = placed(random_jointed(seed), seed)
    solids = revolutes_of(linkage)
    assert infinitesimal_mobility_of_axes(solids.chain, solids.axes).dof == freedoms_by_screws(linkage)


@pytest.mark.parametrize(
    ("kinds", "number"),
    [((R,), 1), ((U,), 2), ((S,), 3), ((E,), 3), ((P,), 6), ((C,), 7), ((U, P, S), 6), ((R, P, R), 3), ((S, P, S), 7),
     ((R, P, P, R), 14), ((R, P, R, P, R), 10), ((P, S, P), 15)],
)  # fmt: skip
def test_how_many_revolutes_stand_for_joints(kinds, number):
    """A slide between joints that turn is a knee, R; alone it is the linkage of Sarrus."""
    assert len(revolutes_of(row(*kinds)).axes) == number


def test_the_axes_of_a_leg_are_shared():
    """UPS = RR-R-RRR: the second axis of U, the knee and the first axis of S are parallel."""
    solids = revolutes_of(row(U, P, S))
    along = np.array([direction for _, direction in solids.axes.values()])
    sines = np.linalg.norm(np.cross(along, along[2]), axis=1)
    np.testing.assert_allclose(sines[[1, 2, 3]], 0.0, atol=1e-12)
    assert sines[[0, 4, 5]].min() > 0.1


def test_a_slide_that_is_not_across_its_neighbours_is_sarrus():
    places = {
        "j0": JointPlace((0, 0, 0), ((1, 0, 0),)),
        "j1": JointPlace((0, 0, 1), ((1, 0, 1),)),
        "j2": JointPlace((0, 0, 2), ((1, 0, 0),)),
    }
    linkage = JointedLinkage(row(R, P, R).chain, {"j1": P}, places)
    solids = revolutes_of(linkage)
    assert len(solids.axes) == 8
    back = recognised(solids)
    np.testing.assert_allclose(np.abs(back.places["j1"].axes[0]), np.array([1, 0, 1]) / 2**0.5, atol=1e-12)


def test_rings_and_grounds_are_not_cut_in_two():
    """Whichever link is called first; the ground does not go into a joint."""
    for first in range(4):
        ring = row(S, R, U, E, ring=True).chain.relabel({i: (i + first) % 4 for i in range(4)})
        linkage = JointedLinkage(ring, {"j0": S, "j2": U, "j3": E})
        assert dict(recognised(revolutes_of(linkage)).kinds) == dict(linkage.kinds)
    solids = revolutes_of(row(S))
    held = HingedSolids(SCGraph(solids.chain.nodes, solids.chain.joints, ground="j0:1"), solids.axes)
    assert set(recognised(held).kinds.values()) == {R, U}


def spherical_ring():
    """A ring of S, R, U and E as revolutes, and its links in their order."""
    solids = revolutes_of(row(S, R, U, E, ring=True))
    return solids, list(solids.chain.nodes)


@pytest.mark.parametrize("shift", range(9))
def test_a_ring_begins_between_two_joints_whichever_link_is_listed_first(shift):
    solids, links = spherical_ring()
    turned = SCGraph(links[shift:] + links[:shift], solids.chain.joints)
    kinds = recognised(HingedSolids(turned, solids.axes)).kinds
    assert dict(kinds) == {"j0": S, "j1": R, "j2": U, "j3": E}


@pytest.mark.parametrize("inner", ["j0:1", "j0:2"])
def test_a_link_inside_a_joint_that_is_held_or_has_another_joint_stays(inner):
    """The ball is three revolutes then; the other joints of the ring are seen."""
    solids, links = spherical_ring()
    held = SCGraph(dict.fromkeys([inner, *links]), solids.chain.joints, ground=inner)
    joints = {**solids.chain.joints, "flap": (inner, "tail")}
    tailed = SCGraph(dict.fromkeys([inner, *links, "tail"]), joints)
    axes = {**solids.axes, "flap": ((9.0, 8.0, 7.0), (0.36, 0.48, 0.8))}
    for mechanism in (HingedSolids(held, solids.axes), HingedSolids(tailed, axes)):
        seen = recognised(mechanism)
        assert inner in seen.chain
        assert S not in seen.kinds.values()
        assert seen.kinds["j3"] is E


def test_panels_of_sarrus_are_a_slide(data):
    seen = convert(read(data / "linkages" / "sarrus-panels.fold"), "joints")
    assert [kind.value for kind in seen.kinds.values()] == ["P"]
    along = np.array(next(iter(seen.places.values())).axes[0])
    np.testing.assert_allclose(np.abs(along), [0, 0, 1], atol=1e-9)


def test_vertices_of_paper_stay_revolutes(data):
    seen = convert(read(data / "patterns" / "bird-base.fold"), "joints")
    assert set(seen.kinds.values()) == {R}


def test_legs_are_rows_of_binary_links():
    found = legs(SCGraph(5, [(0, 1), (1, 2), (0, 3), (3, 2), (0, 2), (2, 4)], ground=0))
    assert sorted(leg.links for leg in found) == [(0, 1, 2), (0, 2), (0, 3, 2), (2, 4)]


def test_what_is_no_linkage_is_refused():
    chain = SCGraph(2, [(0, 1)])
    with pytest.raises(InvariantError, match="the joint type 'helical'; expected one of R"):
        kind_named("helical")
    with pytest.raises(InvariantError, match="7 is no joint"):
        JointedLinkage(chain, {7: S})
    with pytest.raises(InvariantError, match="universal joint 0 has 1 axis; expected 2"):
        JointedLinkage(chain, {0: U}, {0: JointPlace((0, 0, 0), ((1, 0, 0),))})
    with pytest.raises(InvariantError, match=r"cosine of 7\.1e-01; expected a right angle"):
        JointedLinkage(chain, {0: U}, {0: JointPlace((0, 0, 0), ((1, 0, 0), (1, 1, 0)))})
    with pytest.raises(InvariantError, match="an axis of joint 0"):
        JointedLinkage(chain, {}, {0: JointPlace((0, 0, 0), ((0, 0, 0),))})
    pair = SCGraph(2, [(0, 1), (0, 1)])
    with pytest.raises(InvariantError, match="joint 1 has no place"):
        JointedLinkage(pair, {}, {0: JointPlace((0, 0, 0), ((1, 0, 0),))})
    ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop(range(4))])
    with pytest.raises(
        InvariantError, match=r"joint 2 of .*, which has a finite centre, is prismatic; expected a revolute"
    ):
        JointedLinkage(ring, {2: P})
    with pytest.raises(UnsolvableError, match="need the axes"):
        convert(ring, "joints")
