import pickle
import re
from collections import Counter

import pytest
from hypothesis import given
from sizes import slow
from strategies import random_scd, randoms, scd_graphs

from graphs.count.equations import loop_form, polyhedron_equation
from graphs.count.report import mobility_report
from graphs.errors import InvariantError
from graphs.loops.loop import Loop
from graphs.mechanism.drawing import FaceKind, link_vertices, trace_faces
from graphs.mechanism.scd import SCDGraph, points_of_joints, points_of_links

FOUR = [(0, 1), (1, 2), (2, 3), (3, 0)]
RING = [Loop((0, 1, 2, 3))]
TRIANGLES = {0: (0, 3, None), 1: (1, 0, None), 2: (2, 1, None), 3: (3, 2, None)}
QUADS = {k: (k, None, (k - 1) % 4, None) for k in range(4)}


def four_bar(rotation=TRIANGLES, loops=RING, outer=(0, "right"), **options):
    return SCDGraph(4, FOUR, loops, rotation=rotation, outer=outer, **options)


def test_four_bar_of_triangles():
    scd = four_bar()
    assert (scd.counts.vertices, scd.counts.external_edges, scd.counts.internal_edges) == (5, 8, 0)
    assert [scd.drawing.kind_of_face(face.index) for face in scd.faces] == [FaceKind.EXPLICIT, FaceKind.OUTER]
    centre = set.intersection(*(set(around) for around in scd.vertices.values()))
    assert len(centre) == 1


def hanging_inside(joints, rotation):
    """A ring with an explicit centre, and a second ring with an implicit one hanging inside it."""
    loops = [*RING, Loop((4, 5, 6, 7))]
    return lambda: SCDGraph(max(map(max, joints)) + 1, joints, loops, rotation=rotation, outer=(0, "right"))


LADDER = [(0, 1), (1, 2), (2, 3), (4, 5), (5, 6), (6, 7), (0, 4), (1, 5), (2, 6), (3, 7)]
LADDER_ROTATION = {0: (0, None, 6), 1: (1, None, 0, 7), 2: (2, None, 1, 8), 3: (None, 2, 9),
                   4: (3, 6, None), 5: (4, 7, 3, None), 6: (5, 8, 4, None), 7: (9, 5, None)}  # fmt: skip


def watt(first, rotation, at=None, outer=(0, "right")):
    """Watt's chain with the rotations of the links of its first loop as given, the others triangles."""
    joints = [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)]
    loops = [Loop(first, at=at), Loop((3, 4, 5, 6), at=at)]
    rotation = {4: (4, None, 5), 5: (5, None, 6)} | rotation
    return SCDGraph(6, joints, loops, rotation=rotation, outer=outer)


INNER_RING = {5: (5, None, 4), 6: (6, None, 5), 7: (7, None, 6)}

BROKEN = {
    "no rotation": (lambda: four_bar({0: (0, 3, None)}), "link 1 has no rotation; expected one for each link"),
    "rotation of nothing": (lambda: four_bar(TRIANGLES | {9: ()}), "a rotation for 9, which is no link"),
    "wrong joints": (lambda: four_bar(TRIANGLES | {0: (0, 1, None)}), "the rotation of link 0 has the joints [0, 1]"),
    "connected": (
        lambda: SCDGraph(2, [], rotation={0: (None,) * 3, 1: (None,) * 3}),
        "the graph has 2 parts; expected one [connected]",
    ),
    "genus": (
        lambda: SCDGraph(4, [*FOUR, (0, 2), (1, 3)], [],
                         rotation={0: (0, 4, 3), 1: (1, 5, 0), 2: (2, 4, 1), 3: (3, 5, 2)}, outer=(0, "left")),
        "the rotations draw the graph on a surface of genus 1; expected a sphere [genus 0]",
    ),
    "no outer face": (lambda: four_bar(outer=None), "there are 2 faces and none is the outer one [outer face]"),
    "odd outer face": (lambda: four_bar(outer=(0, "up")), "expected a joint and 'left' or 'right' [outer face]"),
    "loop is no face": (
        lambda: SCDGraph(8, LADDER, [Loop((0, 1, 8, 4, 3, 6))], rotation=LADDER_ROTATION, outer=(0, "left")),
        "loop '0 1 8 4 3 6' is not the outer cycle of a bounded face [loops are faces]",
    ),
    "loop of the outer face": (
        lambda: watt([0, 1, 2, 3], {0: (6, None, 0, 3), 1: (0, None, 1), 2: (1, None, 2), 3: (3, 2, None, 4)},
                     outer=(0, "left")),
        "loop '0 1 2 3' is not the outer cycle of a bounded face",
    ),
    "link degree": (lambda: four_bar(TRIANGLES | {0: (0, 3)}), "link 0 has 2 sides; expected three or more"),
    "explicit centre": (
        lambda: four_bar(loops=[Loop((0, 1, 2, 3), "infinite")]),
        "has an infinite centre but no open edge, so that its links would reach it; expected open edges",
    ),
    "implicit centre": (
        lambda: four_bar(QUADS | {0: (0, 3, None)}),
        "has open edges, but none between joints 3 and 0; expected one in every corner",
    ),
    "spatial face": (lambda: four_bar(loops=[]), "has no centre and 0 open edges in 0 corners; expected three"),
    "outer face": (lambda: four_bar(outer=(0, "left")), "the outer face has no centre and 0 open edges"),
    "one explicit centre": (
        lambda: watt([0, 1, 2, 3], {0: (6, None, 0, 3), 1: (0, None, 1), 2: (1, None, 2), 3: (3, 2, None, 4)}, "O"),
        "loop '0 1 2 3' and loop '3 4 5 6' have one centre, but two vertices for it",
    ),
    "joint ends": (
        hanging_inside([*FOUR, (4, 5), (5, 6), (6, 7), (7, 4), (0, 4)],
                       TRIANGLES | INNER_RING | {0: (0, 8, 3, None), 4: (4, None, 7, 8)}),
        "both ends of joint 8 are vertex",
    ),
    "link corners": (
        hanging_inside([*FOUR, (0, 4), (4, 5), (5, 6), (6, 0)],
                       TRIANGLES | {0: (0, 4, None, 7, 3, None), 4: (4, 5, None), 5: (5, 6, None), 6: (6, 7, None)}),
        "two corners of link 0 are one vertex; expected different vertices",
    ),
    "S1": (
        lambda: watt([0, 1, 2, 3], {0: (6, 0, None, 3), 1: (0, 1, None), 2: (1, None, 2, None), 3: (3, None, 2, 4)}),
        "joints 0 and 1 share two points, so they are one axis; expected one point at most [S1]",
    ),
    "S2, joined": (
        lambda: SCDGraph(3, [(0, 1), (0, 2), (0, 1)], [Loop((0, 2))], outer=(1, "left"),
                         rotation={0: (None, None, 0, 2, 1), 1: (0, None, 2), 2: (1, None, None, None)}),
        "links 0 and 1 share points off the axis of their joint; expected only points of that axis [S2]",
    ),
    "S2, not joined": (
        lambda: SCDGraph(4, [(0, 1), (0, 2), (1, 3), (3, 1)], [Loop((2, 3))], outer=(2, "left"),
                         rotation={0: (None, 0, 1, None), 1: (0, 3, 2), 2: (1, None, None), 3: (2, 3, None, None)}),
        "links 0 and 3 share 2 points and no joint; expected one at most [S2]",
    ),
}  # fmt: skip


@pytest.mark.parametrize("rule", BROKEN)
def test_each_rule_is_checked(rule):
    make, message = BROKEN[rule]
    with pytest.raises(InvariantError, match=re.escape(message)):
        make()


@pytest.mark.parametrize("number", [200, slow(600)])
def test_random_drawings_meet_most_rules(number):
    """The generator of the property tests reaches valid graphs and is refused for many reasons."""
    import random

    refused: Counter[str] = Counter()
    kinds = Counter(
        mobility_report(random_scd(random.Random(seed), refused=refused)).mechanism_class for seed in range(number)
    )
    assert {"spatial", "spherical", "spherical system", "hybrid"} <= set(kinds)
    assert {"S1", "S2", "implicit centre", "spatial face", "outer face", "joint ends", "link corners"} <= set(refused)


@given(scd_graphs)
def test_corners_hold_every_open_edge_once(scd):
    assert sum(face.open_edges for face in scd.faces) == scd.counts.open_edges
    assert sum(len(face.corners) for face in scd.faces) == max(2 * len(scd.joints), 1)
    assert len(scd) - len(scd.joints) + len(scd.faces) == 2


@given(scd_graphs)
def test_polyhedron_equation_is_the_loop_form(scd):
    c = scd.counts
    assert polyhedron_equation(c.vertices, c.implicit_centres, c.edges) == loop_form(
        len(scd.joints), len(scd.centred_loops), scd.spatial_loops
    )


@given(scd_graphs)
def test_the_two_ends_of_a_joint_are_seen_alike_from_both_links(scd):
    for joint, links in scd.joints.items():
        for link in links:
            i = scd.rotation[link].index(joint)
            around = scd.vertices[link]
            assert {around[i - 1], around[i]} == set(scd.drawing.ends_of_joint(joint))


@given(scd_graphs)
def test_rules_s1_and_s2_by_comparing_every_pair(scd):
    of_joint, of_link = (
        points_of_joints(scd.drawing, scd.centre_classes()),
        points_of_links(scd.drawing, scd.centre_classes()),
    )
    for a in of_joint:
        assert all(a == b or len(of_joint[a] & of_joint[b]) <= 1 for b in of_joint)
    for a in of_link:
        for b in of_link:
            common = of_link[a] & of_link[b]
            if a != b and not scd.has_edge(a, b):
                assert len(common) <= 1
            elif a != b:
                assert any(common <= of_joint[joint] for joint in scd[a][b])


@given(scd_graphs, randoms)
def test_relabelling_changes_nothing(scd, rng):
    names = rng.sample(range(100, 200), len(scd))
    there = dict(zip(scd.nodes, map(str, names), strict=True))
    other = scd.relabel(there, {joint: f"j{joint}" for joint in scd.joints})
    assert other.counts == scd.counts
    assert mobility_report(other).mobility == mobility_report(scd).mobility
    back = other.relabel({new: old for old, new in there.items()}, {f"j{joint}": joint for joint in scd.joints})
    assert back.is_identical(scd)


@given(scd_graphs)
def test_it_forgets_to_an_sc_graph_and_survives_pickling(scd):
    sc = scd.sc_graph()
    assert not hasattr(sc, "rotation")
    assert (sc.loops, sc.joints) == (scd.loops, scd.joints)
    assert pickle.loads(pickle.dumps(scd)).is_identical(scd)


def test_a_sub_mechanism_may_hang_inside_a_face():
    """Thesis 3.4.2: a ring hangs by a bridge inside a spatial ring; the loops belong to the outer cycles."""
    outer_ring = {k: (k, None, (k - 1) % 6, None) for k in range(6)}
    inner_ring = {6: (6, 9, None, 10, None), 7: (7, 6, None), 8: (8, 7, None), 9: (9, 8, None)}
    joints = [*((k, (k + 1) % 6) for k in range(6)), (6, 7), (7, 8), (8, 9), (9, 6), (0, 6)]
    scd = SCDGraph(
        10,
        joints,
        [Loop((6, 7, 8, 9)), Loop(range(6), "none")],
        rotation=outer_ring | inner_ring | {0: (0, None, 10, None, 5, None)},
        outer=(0, "right"),
    )
    report = mobility_report(scd)
    assert (report.mechanism_class, report.mobility) == ("hybrid", 11 - 3 - 6)
    assert report.equations["polyhedron"].value == 2
    kinds = sorted(scd.drawing.kind_of_face(face.index).value for face in scd.faces)
    assert kinds == ["explicit", "outer", "spatial"]


def test_the_centre_of_a_face_belongs_to_its_outer_cycle():
    """The same with a remote centre in the big ring: the small ring hangs inside the face of that loop."""
    outer_ring = {k: (k, None, (k - 1) % 4, None) for k in range(4)}
    inner_ring = {4: (4, 7, None, 8, None), 5: (5, 4, None), 6: (6, 5, None), 7: (7, 6, None)}
    joints = [*FOUR, (4, 5), (5, 6), (6, 7), (7, 4), (0, 4)]
    scd = SCDGraph(
        8,
        joints,
        [*RING, Loop((4, 5, 6, 7))],
        rotation=outer_ring | inner_ring | {0: (0, None, 8, None, 3, None)},
        outer=(0, "right"),
    )
    assert scd.counts.implicit_centres == 1
    assert mobility_report(scd).mobility == 9 - 3 - 3 == mobility_report(scd).equations["polyhedron"].value


def test_a_panel_by_itself_has_a_vertex_between_each_two_open_edges():
    panel = {"panel": (None, None, None)}
    faces, _ = trace_faces({}, panel)
    assert link_vertices(faces, panel) == (3, {"panel": (2, 1, 0)})
