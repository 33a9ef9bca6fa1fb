"""Faces and cycles of sheets: creases on no face, faces that cross themselves, loops round holes."""

import numpy as np
import pytest

from graphs.convert.conversions import graph_of, to_joints, to_solids
from graphs.convert.cycles import HingedFaces, boundary_cycles, loops_with_centres
from graphs.convert.faces import creases_on_no_face, joins_faces, traced_anew, with_simple_faces
from graphs.convert.panels import internal_rods, rings_of, scd_of_placed_panels
from graphs.convert.tracing import crossings
from graphs.edit.named import joint_named, known
from graphs.errors import InvariantError
from graphs.joints.linkage import JointedLinkage, JointKind
from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet

SQUARE = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
RING = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


def test_creases_between_faces_and_on_none():
    halves = ((0, 1, 2), (0, 2, 3))
    assert creases_on_no_face(Sheet(4, ((0, 2), (1, 3)), "MV", halves)) == 1
    assert not joins_faces(Sheet(4, ((0, 2), (1, 3)), "FV", halves))
    whole = traced_anew(Sheet(4, ((0, 2),), "M", ((0, 1, 2, 3),), SQUARE))
    assert (len(whole.faces), whole.assignments.count("M")) == (2, 1)


def test_a_face_that_crosses_itself_is_refused():
    with pytest.raises(InvariantError, match=r"face 0 crosses itself at \(0\.5, 0\.5\)"):
        with_simple_faces(Sheet(4, (), "", ((0, 1, 3, 2),), SQUARE))


def test_a_ring_of_four_panels_has_one_loop_whose_creases_meet():
    outer, inner = [(0, 1), (1, 2), (2, 3), (0, 3)], [(4, 5), (5, 6), (6, 7), (4, 7)]
    sides = {side: [face] for row in (outer, inner) for face, side in enumerate(row)}
    creases = {(1, 5): [0, 1], (2, 6): [1, 2], (3, 7): [2, 3], (0, 4): [3, 0]}
    joints = {edge: joint for joint, edge in enumerate(creases)}
    hinged = HingedFaces(sides | creases, joints, range(4))
    assert boundary_cycles(Sheet(8, (), "", RING), hinged) == [(0, 1, 2, 3)]
    corners = ((-2, -2), (2, -2), (2, 2), (-2, 2), (-1, -1), (1, -1), (1, 1), (-1, 1))
    [loop] = scd_of_placed_panels(Sheet(8, (), "", RING, corners)).loops
    assert loop.centre is Centre.FINITE
    assert rings_of({0: 1, 5: 6, 1: 2, 6: 5, 2: 0}) == [(0, 1, 2), (5, 6)]


def test_parallel_creases_round_a_hole_have_a_centre_at_infinity():
    sheet = Sheet(6, (), "", (), ((0, 0), (1, 0), (0, 1), (2, 1), (0, 3), (1, 3)))
    [loop] = loops_with_centres(sheet, [(7, 8, 9)], {7: (0, 1), 8: (2, 3), 9: (4, 5)})
    assert loop.centre is Centre.INFINITE


def test_lines_cross_away_from_their_ends():
    lines = np.array([[[0, 0], [2, 2]], [[2, 0], [0, 2]], [[0, 0], [2, 0]]], dtype=float)
    assert crossings(lines, 0.01).tolist() == [[1.0, 1.0]]
    assert internal_rods((0, 1, 2, 3)) == [(0, 2), (1, 3)]


def test_sheets_and_joints_become_solids_and_back():
    corners = ((0, 0), (1, 0), (1, 1), (0, 1), (0, -1), (1, -1))
    book = Sheet(6, ((0, 1),), "V", ((0, 1, 2, 3), (1, 0, 4, 5)), corners)
    assert dict(to_solids(book).axes) == {0: ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))}
    assert repr(graph_of(book)) == "<SCGraph: 2 links, 1 joint, 0 centres>"
    ball = JointedLinkage(SCGraph(2, [(0, 1)]), {0: JointKind.SPHERICAL})
    assert len(to_solids(ball).axes) == 3
    assert dict(to_joints(to_solids(ball)).kinds) == {0: JointKind.SPHERICAL}


def test_joints_are_named_by_people():
    two = SCGraph(["A", "B", "C"], {"a": ("A", "B"), "b": ("B", "C")})
    assert [joint_named(two, name) for name in ("b", "1", "C, B")] == ["b", "b", "b"]
    assert known(["crank", "rocker"], "cranck") == "one of 'crank', 'rocker'; the nearest is 'crank'"
