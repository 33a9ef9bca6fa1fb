"""Wiener's Eq. 1 and Wampler's count with joints of all kinds: by hand, and against ranks of random members."""

import numpy as np
import pytest
from random_joints import random_jointed
from second_methods import freedoms_by_screws

from graphs.answer.mobility import counts_and_ranks
from graphs.answer.mobility_of_joints import report_of_joints, with_planar_loops
from graphs.errors import InvariantError
from graphs.files.formats import read
from graphs.joints import JointedLinkage, JointKind, JointPlace, placed, points_of
from graphs.joints.rods_and_points import rods_between_balls
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.rank.rods import exact_mobility_of_model
from synth.catalogue.patterns import generate

PLANAR = (Loop(range(4), "infinite"),)


def ring(kinds, loops=(), places=None):
    n = len(kinds)
    chain = SCGraph(n, [(i, (i + 1) % n) for i in range(n)], loops, ground=0)
    return JointedLinkage(chain, dict(enumerate(kinds)), places or {})


def parallel(kinds, number):
    """Legs of one kind between a base and a top."""
    links, joints, of = ["base", "top"], {}, {}
    for leg in range(number):
        row = ["base", *(f"{leg}-{i}" for i in range(1, len(kinds))), "top"]
        links += row[1:-1]
        for i, kind in enumerate(kinds):
            joints[f"{kind}{leg}-{i}"], of[f"{kind}{leg}-{i}"] = (row[i], row[i + 1]), kind
    return JointedLinkage(SCGraph(links, joints, ground="base"), of)


def numbers(linkage):
    """Eq. 1, Wampler's count, and which of his equations that is."""
    report = report_of_joints(linkage)
    (name,) = [name for name in report.equations if name.startswith("wampler")]
    first = report.equations["traditional_cgk"]
    assert first.applies
    assert first.value == report.mobility == linkage.mobility
    return first.value, report.equations[name].value, name


@pytest.mark.parametrize(
    ("linkage", "cgk", "wampler"),
    [
        # 3 (4 - 1) - 4 (3 - 1) = 1; V 12, E 27, P 1, L 2: 36 - 27 - 1 - 4 - 6 = -2, and 3 of the centre
        (ring("RRRP", PLANAR), 1, (1, "wampler_eq7")),
        (ring("RPRP", PLANAR), 1, (1, "wampler_eq7")),
        # 6 (4 - 1) - 4 (6 - 1) = -2
        (ring("RRRP"), -2, (-2, "wampler_eq6")),
        # 6 (4 - 1) - 5 - 5 - 3 - 3 = 2, of which Wampler's rod does not spin
        (ring("RSSR"), 2, (1, "wampler_eq5")),
        # 6 (4 - 1) - (5 + 3 + 4 + 5) = 1: R S C R
        (ring("RSCR"), 1, (1, "wampler_eq6")),
        # 6 (8 - 1) - 3 (4 + 5 + 3) = 6
        (parallel("CRS", 3), 6, (6, "wampler_eq6")),
        # 6 (14 - 1) - 6 (4 + 5 + 3) = 6
        (parallel("UPS", 6), 6, (6, "wampler_eq6")),
        # 6 (5 - 1) - 3 (4 + 3) = 3
        (parallel("CS", 3), 3, (3, "wampler_eq6")),
        # 6 (8 - 1) - 3 (4 + 5 + 5) = 0: the paper's Fig. 16b, which moves in three ways if axes are parallel
        (parallel("CRR", 3), 0, (0, "wampler_eq6")),
        # 6 (2 - 1) - 3 = 3: a planar joint, three points in a plane
        (JointedLinkage(SCGraph(2, [(0, 1)]), {0: JointKind.PLANAR}), 3, (3, "wampler_eq6")),
    ],
)
def test_counts_are_those_by_hand(linkage, cgk, wampler):
    assert numbers(linkage) == (cgk, *wampler)


def test_three_legs_that_end_in_one_point():
    """Wampler's Fig. 16: V 10, E 15, L 6 without the ground make 3."""
    joints = {f"c{leg}": ("base", f"a{leg}") for leg in range(3)} | {
        f"r{leg}": (f"a{leg}", f"b{leg}") for leg in range(3)
    }
    joints |= {"s1": ("b0", "b1"), "s2": ("b1", "b2")}
    kinds = {joint: joint[0].upper() for joint in joints}
    links = ["base", *(f"{side}{leg}" for leg in range(3) for side in "ab")]
    assert numbers(JointedLinkage(SCGraph(links, joints, ground="base"), kinds))[:2] == (3, 3)


def test_a_slider_crank_is_not_said_to_be_of_revolutes():
    answer = counts_and_ranks(ring("RRRP"))
    assert (answer.mobility, answer.links, answer.joints) == (-2, 4, 4)
    assert "if all are planar (centre infinite), Eq. 1 gives 1" in " ".join(answer.warnings)
    planar = counts_and_ranks(ring("RRRP", PLANAR))
    assert (planar.mobility, planar.mechanism_class, planar.counts["general_member"]) == (1, "planar", 1)
    assert not planar.equations["polyhedron"].applies


def test_a_slider_crank_is_found_to_be_planar_by_where_its_joints_are():
    up = ((0.0, 0.0, 1.0),)
    places = {0: ((0, 0, 0), up), 1: ((1, 1, 0), up), 2: ((3, 0, 0.5), up), 3: ((3, 0, 0), ((1.0, 0.0, 0.0),))}
    lying = {joint: JointPlace(*place) for joint, place in places.items()}
    answer = counts_and_ranks(ring("RRRP", places=lying))
    assert (answer.mobility, answer.infinitesimal.dof, answer.overconstraint) == (1, 1, 0)
    assert "1 loop planar at this configuration" in " ".join(answer.warnings)
    leaning = lying | {3: JointPlace((3, 0, 0), ((1.0, 0.0, 0.3),))}
    assert counts_and_ranks(ring("RRRP", places=leaning)).mobility == -2
    assert with_planar_loops(ring("RRRP")).mobility == -2


def test_joints_that_leave_the_plane_are_refused():
    for kind in "SUC":
        with pytest.raises(InvariantError, match=r"which is planar, is .*; expected a revolute, a slide or a planar"):
            ring(f"RRR{kind}", PLANAR)
    with pytest.raises(InvariantError, match="which has a finite centre, is prismatic"):
        ring("RRRP", (Loop(range(4)),))


def test_random_members_of_planar_and_spherical_loops_have_their_centres():
    """Two slider-cranks on one crank, and a spherical four-bar on a planar one."""
    joints = [(0, 1), (1, 2), (2, 3), (3, 0), (1, 4), (4, 5), (5, 0)]
    two = SCGraph(6, joints, [Loop((0, 1, 2, 3), "infinite"), Loop((0, 4, 5, 6), "infinite")], ground=0)
    cranks = JointedLinkage(two, {3: "P", 6: "P"})
    mixed = SCGraph(6, joints, [Loop((0, 1, 2, 3), "infinite"), Loop((0, 4, 5, 6))], ground=0)
    for linkage in (cranks, JointedLinkage(mixed, {3: "P"})):
        assert (linkage.mobility, counts_and_ranks(placed(linkage)).infinitesimal.dof) == (1, 1)


@pytest.mark.parametrize("name", ["stewart", "6-sps", "3-rps", "6-uuu"])
def test_wampler_counts_platforms(name):
    linkage = generate(name).mechanism
    assert numbers(linkage)[:2] == (linkage.mobility, linkage.mobility)


def test_the_model_of_points_has_the_rank_that_joints_have():
    """Random types of joints of all kinds, as vertices and rods modulo primes and as screws; rods do not spin."""
    compared = 0
    for seed in range(40):
        linkage = random_jointed(seed)
        bare = JointedLinkage(SCGraph(linkage.chain.nodes, linkage.chain.joints), linkage.kinds)
        freedoms = freedoms_by_screws(general(bare, seed)) - len(list(rods_between_balls(bare)))
        assert exact_mobility_of_model(points_of(bare)).mobility == freedoms, seed
        compared += bare.chain.independent_loops > 0
    assert compared > 8


def general(linkage, seed):
    """Random places, no axes parallel."""
    random = np.random.default_rng(seed)
    places = {}
    for joint, kind in linkage.kinds.items():
        axes = np.linalg.qr(random.normal(size=(3, 3)))[0][: kind.axes]
        places[joint] = JointPlace(tuple(random.normal(size=3)), tuple(map(tuple, axes)))
    return JointedLinkage(linkage.chain, linkage.kinds, places)


def test_parallel_axes_of_solids_make_planar_loops(data):
    """Roberts' seven-bar: no loop is declared planar; by M = 3 (7 - 1) - 2 * 9 it is rigid, and it moves."""
    linkage = read(data / "joints" / "roberts.json")
    answer = counts_and_ranks(linkage)
    assert (answer.mobility, answer.mechanism_class, answer.infinitesimal.dof) == (0, "planar", 1)
    assert "3 loops whose axes are parallel count as planar" in answer.warnings
    door = HingedSolids(SCGraph(2, [(0, 1)]), {0: ((0, 0, 0), (0, 0, 1))})
    assert not any("planar" in note for note in counts_and_ranks(door).warnings)
