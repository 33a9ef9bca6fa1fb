"""What starts of a task begin with: the pose is followed too, planes hold the wishes, one problem serves all starts."""

import json
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from four_bar_routes import takes_in_order
from scipy.spatial.transform import Rotation
from sizes import slow

import synth
from graphs.geometry import common_direction
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import link_motions
from synth.analysis.moving._configuration_of import configuration_of
from synth.synthesis.designing.defects import DefectKind
from synth.synthesis.designing.designs import DesignSearch
from synth.synthesis.designing.placement import DesignPoint
from synth.synthesis.designing.problem import DesignProblem
from synth.synthesis.designing.wish_files import wishes_of_document
from synth.synthesis.designing.wishes import LinkDirection, LinkOrientation, PointPlace
from synth.synthesis.tasks import candidates_of, structure_of
from synth.synthesis.tasks.dimensioning import CandidateSearch, HalvingRound, halved
from synth.synthesis.tasks.planes import planar_parts, turned_to_wishes
from synth.synthesis.tasks.task_files import task_of_document

THREE = [
    [0.9659258262890683, 0.07304294305891701, 0.24347647686305673, 0.04869529537261135],
    [0.8870108331782217, 0.24336288737447948, 0.3893806197991672, -0.0486725774748959],
]
"""Two orientations; with that of the pose three."""
TURNED = [[0.981627183447664, 0.0, 0.0, 0.1908089953765448], [0.9135454576426009, 0.0, 0.0, 0.4067366430758002]]
"""Two orientations about the axis z."""


def orientations(quaternions, link="output"):
    names = [f"p{number}" for number in range(2, 2 + len(quaternions))]
    wishes = [
        {"kind": "orientation", "at": name, "link": link, "quaternion": one}
        for name, one in zip(names, quaternions, strict=True)
    ]
    return {"configurations": [{"name": name} for name in names], "wishes": wishes}


def task_of(system, quaternions, **keys):
    distance = [{"roles": ["base", "output"], "number": [2, None]}]
    head = {"format": "synthedra/task", "version": 1, "links": 4, "types": ["sc", "chains"], "system": system}
    return task_of_document({**head, "distance": distance, "wishes": orientations(quaternions), **keys}, Path("task"))


@pytest.fixture(scope="module")
def three():
    return task_of("spherical", THREE)


@pytest.fixture(scope="module")
def planar():
    return task_of("planar", TURNED, types=["sc"], centres_at_infinity=True)


def closed_form(design, links):
    """Whether a four-bar passes the pose and its configurations in order, driven at either joint of the base."""
    base, output = links
    linkage = configuration_of(design.mechanism).linkage
    rows = np.array([np.zeros(4), *(list(angles.values()) for angles in design.angles.values())])
    motions = link_motions(linkage, rows, base)
    axis = {frozenset(pair): linkage.directions[place] for place, pair in enumerate(linkage.graph.joints.values())}
    arms = [link for link in linkage.graph if link not in links]
    of_arm = {arm: (axis[frozenset((base, arm))], axis[frozenset((arm, output))]) for arm in arms}
    return any(
        takes_in_order(of_arm[crank], of_arm[other], [motions[arm][0] for arm in (crank, other)])
        for crank, other in (arms, arms[::-1])
    )


@pytest.mark.parametrize(("seed", "starts"), [(0, 4), slow(1, 12), slow(2, 12), slow(3, 12)])
def test_starts_succeed_where_the_closed_form_passes_the_pose_too(seed, starts, three):
    """The second method shares nothing with the walk: signs of a determinant and limits of an arc."""
    [candidate] = candidates_of(structure_of(three))
    search = CandidateSearch(three, candidate, seed)
    kinds = Counter()
    for start in range(starts):
        design = search.design(start)
        assert design.miss < 1e-9
        assert design.success == closed_form(design, candidate.links)
        kinds.update(defect.kind for defect in design.defects)
    assert seed == 2 or {DefectKind.CIRCUIT, DefectKind.BRANCH} <= set(kinds)
    assert sum(kinds.values()) < starts


def test_ranked_designs_begin_at_the_pose(three):
    answer = synth.task(three, starts=1, rounds=1)
    assert [closed_form(answer.design(one), one.candidate.links) for one in answer.ranked] == [True]
    assert answer.design(answer.best).inputs[0] == 0.0
    assert len(answer.design(answer.best).inputs) == 3


def test_a_design_begins_at_the_pose_only_if_a_wish_says_so(three):
    """`synth design` follows the configurations that are named, as before."""
    [candidate] = candidates_of(structure_of(three))
    search = CandidateSearch(three, candidate, 0).search(0)
    assert search.problem.wishes.from_start
    assert not wishes_of_document(
        {"format": "synthedra/wishes", "version": 1, **orientations(THREE)}, Path()
    ).from_start


def test_planar_four_bars_turn_their_coupler(planar):
    """Three orientations in one plane: any planar four-bar can, about the axis of the wishes."""
    answer = synth.task(planar, starts=3, rounds=1)
    [one] = answer.ranked
    design = answer.design(one)
    assert "missed" not in answer.to_json()["ranked"][0]["outcomes"]
    directions = np.array([axis[1] for axis in design.mechanism.axes.values()])
    np.testing.assert_allclose(np.abs(directions), np.tile([0.0, 0.0, 1.0], (4, 1)), atol=1e-12)
    linkage, (base, output) = configuration_of(design.mechanism).linkage, one.candidate.links
    for angles, quaternion in zip(design.angles.values(), TURNED, strict=True):
        turn = link_motions(linkage, np.array(list(angles.values()))[None], base)[output][0][0]
        np.testing.assert_allclose(turn, Rotation.from_quat(quaternion, scalar_first=True).as_matrix(), atol=1e-9)


@pytest.mark.parametrize("starts", [2, slow(8)])
def test_a_given_planar_four_bar_turns_its_coupler_at_every_start(starts):
    chain = SCGraph(4, [(3, 0), (0, 1), (1, 2), (2, 3)], [Loop((0, 1, 2, 3), "infinite")], ground=3)
    points = [(0.0, 0.0, 0.0), (0.3, 0.9, 0.0), (2.4, 1.9, 0.0), (3.0, 0.0, 0.0)]
    four_bar = HingedSolids(chain, {joint: (point, (0.0, 0.0, 1.0)) for joint, point in enumerate(points)})
    document = {"format": "synthedra/wishes", "version": 1, "driver": "0", **orientations(TURNED, link="1")}
    found = synth.design(four_bar, wishes_of_document(document, Path("wishes")), starts=starts)
    assert len(found.pareto) + len(found.others) == starts


def planar_member(seed):
    """A random planar four-bar, and its normal."""
    rng = np.random.default_rng(seed)
    normal = rng.normal(size=3)
    chain = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3), "infinite")])
    axes = {joint: (tuple(rng.normal(size=3)), tuple(normal / np.linalg.norm(normal))) for joint in range(4)}
    return HingedSolids(chain, axes), normal / np.linalg.norm(normal)


def normal_of(member):
    return common_direction(np.array([axis[1] for axis in member.axes.values()]))


def rotated_wishes(kind, normal, rng):
    """Wishes about link 2 that lie in the plane with that normal, rounded to ten digits."""
    turns = Rotation.from_rotvec(np.outer([0.7, -1.2], normal))
    if kind == "orientation":
        return [
            LinkOrientation(at=str(k), link="2", quaternion=tuple(one.round(10)))
            for k, one in enumerate(turns.as_quat(scalar_first=True))
        ]
    vector = rng.normal(size=3)
    there = turns.apply(vector)
    if kind == "direction":
        return [
            LinkDirection(at=str(k), link="2", vector=tuple(vector), equals=tuple(one.round(10)))
            for k, one in enumerate(there)
        ]
    there = there + np.cross(normal, rng.normal(size=(2, 3)))
    return [
        PointPlace(at=str(k), point=DesignPoint("2", tuple(vector)), equals=tuple(one.round(10)))
        for k, one in enumerate(there)
    ]


@pytest.mark.parametrize("kind", ["orientation", "direction", "place"])
@pytest.mark.parametrize("seed", range(3))
def test_planes_hold_the_wishes(kind, seed):
    member, _ = planar_member(seed)
    rng = np.random.default_rng(seed + 100)
    normal = rng.normal(size=3)
    normal /= np.linalg.norm(normal)
    wishes = rotated_wishes(kind, normal, rng)
    turned = turned_to_wishes(member, wishes)
    assert abs(abs(normal_of(turned) @ normal) - 1.0) < 1e-15
    apart = [np.array([axis[0] for axis in one.axes.values()]) for one in (member, turned)]
    lengths = [np.linalg.norm(points[:, None] - points[None], axis=-1) for points in apart]
    np.testing.assert_allclose(*lengths, atol=1e-12)


def test_planes_are_free_where_wishes_leave_them(planar):
    """One direction and its image leave a pencil of planes: the nearest is taken, so members differ."""
    member, normal = planar_member(5)
    wish = LinkDirection(at="p2", link="2", vector=(1.0, 0.0, 0.0), equals=(0.0, 1.0, 0.0))
    change = np.array([-1.0, 1.0, 0.0]) / np.sqrt(2.0)
    expected = normal - (normal @ change) * change
    turned = normal_of(turned_to_wishes(member, [wish]))
    assert abs(abs(turned @ expected) / np.linalg.norm(expected) - 1.0) < 1e-12


def test_a_plane_across_that_of_the_wishes_is_turned_too():
    """No normal is nearer than others."""
    square = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)]
    chain = planar_member(0)[0].chain
    member = HingedSolids(chain, {joint: (point, (0.0, 0.0, 1.0)) for joint, point in enumerate(square)})
    wish = LinkOrientation(at="p2", link="2", quaternion=(0.9, 0.1, 0.0, 0.0))
    np.testing.assert_allclose(np.abs(normal_of(turned_to_wishes(member, [wish]))), [1.0, 0.0, 0.0], atol=1e-15)


def test_members_stay_where_wishes_say_nothing_of_their_plane():
    member, _ = planar_member(6)
    about_x, about_y = (
        LinkOrientation(at="p2", link="2", quaternion=quaternion) for quaternion in [(0.9, 0.1, 0, 0), (0.9, 0, 0.1, 0)]
    )
    nothing = [
        [],
        [replace(about_x, at="pose")],
        [replace(about_x, quaternion=(1.0, 0.0, 0.0, 0.0))],
        [replace(about_x, link="0")],
        [about_x, about_y, replace(about_x, quaternion=(0.9, 0.1, 0.1, 0.1))],
        [PointPlace(at="p2", point=DesignPoint("2", (0.0, 0.0, 0.0)), equals=(None, 1.0, 0.0))],
    ]
    for wishes in nothing:
        assert turned_to_wishes(member, wishes) is member


def test_links_that_parallel_joints_carry():
    """Two planar loops that share a link, the ground on one: the other says nothing of motion against it."""
    pairs = [(0, 1), (1, 2), (2, 3), (3, 0), (2, 4), (4, 5), (5, 6), (6, 2)]
    loops = [Loop((0, 1, 2, 3), "infinite"), Loop((4, 5, 6, 7), "infinite")]
    chain = SCGraph(7, pairs, loops, ground=0)
    [(joints, links)] = planar_parts(chain)
    assert list(joints) == [0, 1, 2, 3]
    assert links == {"1", "2", "3"}
    assert planar_parts(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])) == []


def counted(monkeypatch, *classes):
    """Count how many objects of classes are made from now on."""
    numbers = Counter()
    for one in classes:
        plain = one.__init__

        def counting(self, *given, plain=plain, name=one.__name__, **named):
            numbers[name] += 1
            plain(self, *given, **named)

        monkeypatch.setattr(one, "__init__", counting)
    return numbers


def test_one_problem_serves_all_starts_of_a_candidate(three, monkeypatch):
    """Closure equations are taken apart once for one configuration and once for two; the rest are two of each verdict.

    Before, two starts made 92.
    """
    numbers = counted(monkeypatch, DesignProblem, ClosureEquations)
    halved(structure_of(three), starts=2, rounds=1)
    assert numbers == {"DesignProblem": 1, "ClosureEquations": 2 + 2 * 2}


def test_a_start_gives_the_same_design_whichever_came_before(three):
    """So a run that was killed, and one on several workers, comes to the same rows."""
    job = HalvingRound(three, candidates_of(structure_of(three)), 0, 3)
    [[first], [second]] = [job.work((0, start)) for start in (0, 1)]
    again = HalvingRound(three, job.candidates, 0, 3)
    assert [again.work((0, start))[0] for start in (1, 0)] == [second, first]
    state = json.dumps(sorted(again.__getstate__()))
    assert "_search_of" not in state


def test_a_design_comes_back_from_its_record(three):
    [candidate] = candidates_of(structure_of(three))
    search = CandidateSearch(three, candidate, 0)
    for start in range(2):
        design = search.design(start)
        again = CandidateSearch(three, candidate, 0).of_record(start, json.loads(json.dumps(design.record())))
        assert again.to_json() == design.to_json()
        assert again.mechanism.axes == design.mechanism.axes
        assert (again.defects, again.inputs, again.traced) == (design.defects, design.inputs, design.traced)


def test_cones_share_a_problem_too(data):
    task = synth.synthesis.tasks.read_task(data / "tasks" / "on-a-cone.json")
    candidate = candidates_of(structure_of(task))[0]
    search = CandidateSearch(task, candidate, 0)
    one, other = search.search(0), search.search(1)
    assert isinstance(search.member(0), SurfaceLinkage)
    assert one.problem.frame is other.problem.frame
    assert not np.allclose(one.family.start, other.family.start)
    alone = DesignSearch(search.member(1), search.wishes, ground=search.base, freedoms=1)
    np.testing.assert_array_equal(other.family.start, alone.family.start)
    step, same = (each.problem.evaluated(each.problem.start) for each in (other, alone))
    np.testing.assert_allclose(step.residual(1.0), same.residual(1.0), atol=1e-14)
    np.testing.assert_allclose(step.jacobian(1.0), same.jacobian(1.0), atol=1e-13)
