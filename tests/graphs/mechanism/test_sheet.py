import json
import sys

import numpy as np
import pytest

from graphs.convert.duality import mechanism_of_sheet
from graphs.count.report import mobility_report
from graphs.errors import InvariantError
from graphs.files.patterns.fold import fold_text, sheet_from_fold
from graphs.mechanism.sheet import Sheet
from graphs.rank.infinitesimal import infinitesimal_mobility

SQUARE = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))


def test_flat_edges_merge_and_may_be_hinged():
    sheet = Sheet(4, ((0, 2),), "F", ((0, 1, 2), (0, 2, 3)), SQUARE)
    assert len(mechanism_of_sheet(sheet).sc) == 1
    assert mechanism_of_sheet(sheet).panels == ((0, 1),)
    assert len(mechanism_of_sheet(sheet, hinge_flat=True).sc.joints) == 1


def test_a_border_between_two_faces_is_a_cut():
    sheet = Sheet(4, ((0, 2),), "B", ((0, 1, 2), (0, 2, 3)), SQUARE)
    mechanism = mechanism_of_sheet(sheet)
    assert (len(mechanism.sc), len(mechanism.sc.joints)) == (2, 0)
    assert any("taken as cuts" in note for note in mechanism.warnings)
    assert "relative motion" in mobility_report(mechanism.sc).warnings[0]


def test_a_crease_that_ends_inside_a_panel_folds_nothing():
    points = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.5, 0.5))
    faces = ((0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))
    sheet = Sheet(5, ((0, 4), (1, 4), (2, 4), (3, 4)), "VFFF", faces, points)
    mechanism = mechanism_of_sheet(sheet)
    assert (len(mechanism.sc), len(mechanism.sc.joints)) == (1, 0)
    assert any("inside a panel" in note for note in mechanism.warnings)


def test_a_split_hinge_is_one_joint_if_its_parts_are_in_line():
    points = ((0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 1.0), (1.0, -1.0))
    faces = ((0, 1, 3), (1, 2, 3), (1, 0, 4), (2, 1, 4))
    edges = ((0, 1), (1, 2), (1, 3), (1, 4))
    straight = mechanism_of_sheet(Sheet(5, edges, "VVFF", faces, points))
    assert (len(straight.sc), len(straight.sc.joints), straight.interior_vertices) == (2, 1, 0)
    assert straight.repairs == ("1 collinear split hinge joined",)
    bent = tuple((x, 0.1 if i == 1 else y) for i, (x, y) in enumerate(points))
    mechanism = mechanism_of_sheet(Sheet(5, edges, "VVFF", faces, bent))
    assert (len(mechanism.sc.joints), mechanism.interior_vertices) == (2, 1)
    report = mobility_report(mechanism.sc)
    assert report.mobility == -1
    assert any("2 degrees of freedom, not 3" in note for note in report.warnings)


def test_a_panel_that_comes_back_to_a_vertex_parts_its_walk():
    """Two opposite sectors of a vertex are one panel by a detour: the fan falls into two loops of two joints."""
    points = ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0), (2.0, 2.0), (-2.0, 3.0))
    faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1), (2, 1, 5), (2, 5, 6), (3, 2, 6), (4, 3, 6, 5, 1))
    edges = ((0, 1), (0, 2), (0, 3), (0, 4), (1, 2), (2, 5), (5, 6), (3, 6), (3, 4), (1, 4), (2, 3), (2, 6), (1, 5))
    letters = "VVVVFFFFFVVVV"
    mechanism = mechanism_of_sheet(Sheet(7, edges, letters, faces, points))
    assert all(len(loop.joints) >= 2 for loop in (*mechanism.sc.loops, *mechanism.sc.closing))
    assert mechanism.sc.independent_loops >= len(mechanism.sc.loops)


def test_three_faces_at_an_edge_are_refused():
    with pytest.raises(InvariantError, match=r"the edge \(0, 1\) belongs to 3 faces; expected two at most"):
        mechanism_of_sheet(Sheet(5, (), "", ((0, 1, 2), (0, 1, 3), (0, 1, 4))))


def test_flatness_is_judged_by_coordinates():
    flat = Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), tuple((x, y, 5.0) for x, y in SQUARE))
    lifted = Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), tuple((x, y, x * y) for x, y in SQUARE))
    skewed = Sheet(3, (), "", ((0, 1, 2),), ((0.0, 0.0, 0.0), (1.0, 0.0, 1.0), (0.0, 1.0, 1.0)))
    assert [infinitesimal_mobility(s).flat for s in (flat, lifted, skewed)] == [True, False, True]


def test_a_closed_surface_has_a_closing_loop():
    octahedron = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1), (5, 2, 1), (5, 3, 2), (5, 4, 3), (5, 1, 4)]
    sc = mechanism_of_sheet(Sheet(6, (), "", tuple(octahedron))).sc
    assert (len(sc.loops), len(sc.closing), mobility_report(sc).mobility) == (5, 1, 0)


def test_fold_text_reads_back(tmp_path):
    for sheet in (
        Sheet(4, ((0, 2), (0, 1)), "VB", ((0, 1, 2), (0, 2, 3)), SQUARE, "Square"),
        Sheet(4, ((0, 2),), "U", ((0, 1, 2), (0, 2, 3))),
    ):
        assert sheet_from_fold(json.loads(fold_text(sheet)), tmp_path) == sheet


def test_rounded_coordinates_are_told_of():
    square = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 1e-6), (0.0, 1.0, 0.0), (0.5, 0.5, 1.0))
    faces = ((0, 1, 2, 3), (0, 1, 4))
    rounded = mechanism_of_sheet(Sheet(5, (), "", faces, square)).warnings
    assert rounded == ("rounded coordinates: a panel is off its plane by 3e-07 of the extent",)
    exact = tuple((x, y, 0.0 if z < 0.1 else z) for x, y, z in square)
    assert mechanism_of_sheet(Sheet(5, (), "", faces, exact)).warnings == ()


def grid(side, height=0.0):
    """A sheet of side x side square panels; its last vertex stands off the plane of the others."""
    corners = [(float(x), float(y), 0.0) for y in range(side + 1) for x in range(side + 1)]
    corners[-1] = (*corners[-1][:2], height)
    starts = [y * (side + 1) + x for y in range(side) for x in range(side)]
    return Sheet(len(corners), (), "", tuple((v, v + 1, v + side + 2, v + side + 1) for v in starts), tuple(corners))


@pytest.mark.parametrize(("height", "lies"), [(0.0, "flat"), (1.0, "in space")])
def test_a_sheet_describes_itself_in_a_few_calls(height, lies, monkeypatch):
    """No factorisation, and no more calls for 10 000 panels than for 4."""

    def refused(*_given, **_options):
        raise AssertionError("a description factorises a matrix")

    for name in ("svd", "eigh", "eig", "qr", "lstsq"):
        monkeypatch.setattr(np.linalg, name, refused)
    called = {}
    for side in (2, 100):
        sheet, calls = grid(side, height), []
        sys.setprofile(lambda _frame, event, _what, calls=calls: calls.append(event))
        try:
            text = repr(sheet)
        finally:
            sys.setprofile(None)
        assert text == f"<Sheet: {side**2} faces, 0 creases, {(side + 1) ** 2} vertices, {lies}>"
        called[side] = len(calls)
    assert called[100] == called[2]
