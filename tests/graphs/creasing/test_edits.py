"""A pattern edited is a pattern: creases locked, added, removed; what is said of names that are none."""

import pytest

from graphs.convert.duality import mechanism_of_sheet
from graphs.count.report import mobility_report
from graphs.creasing.edits import crease_sheet, joint_of_sheet_named, lock_crease, remove_crease
from graphs.edit.named import joint_named, link_named
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet

SQUARE = Sheet(4, (), "", ((0, 1, 2, 3),), ((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)))
FAN = Sheet(
    5,
    ((0, 4), (1, 4), (2, 4), (3, 4)),
    "MVVV",
    ((0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
    (*SQUARE.coordinates, (1.0, 1.0)),
)
GRID = crease_sheet(crease_sheet(SQUARE, (1, 0), (1, 2)).sheet, (0, 1), (2, 1)).sheet
"""Two creases across each other: the second one split where it crosses the first."""


def mobility(sheet):
    return mobility_report(mechanism_of_sheet(sheet).sc).mobility


def area(sheet):
    def of(face):
        at = [sheet.coordinates[v] for v in face]
        return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(at, at[1:] + at[:1], strict=True))) / 2

    return sum(map(of, sheet.faces))


def test_a_crease_across_another_makes_a_vertex_of_four():
    sc = mechanism_of_sheet(GRID).sc
    assert (GRID.vertices, len(sc), len(sc.joints), len(sc.centred_loops), mobility(GRID)) == (9, 4, 4, 1, 1)
    assert sorted(map(len, GRID.faces)) == [4, 4, 4, 4]
    assert area(GRID) == pytest.approx(4)


def test_a_line_through_many_panels_creases_each(data):
    sheet = read(data / "patterns" / "bird-base.fold")
    edit = crease_sheet(sheet, (-1, 0.3), (1, 0.3), "M")
    before, after = (mechanism_of_sheet(one).sc for one in (sheet, edit.sheet))
    parted, new = len(after) - len(before), len(after.joints) - len(before.joints)
    assert parted > 2
    assert new == 2 * parted - 1  # as many creases as panels, and a second part of each crease that is crossed
    assert edit.predicted == edit.counted == 3 * parted - 2 * new
    assert area(edit.sheet) == pytest.approx(area(sheet))
    assert after.spatial_loops == before.spatial_loops == 0


def test_edges_and_vertices_keep_their_numbers():
    edit = crease_sheet(FAN, (1, 0), 4)
    assert edit.sheet.edges[:4] == FAN.edges
    assert edit.sheet.coordinates[:5] == FAN.coordinates
    assert edit.sheet.coordinates[5] == (1, 0)
    assert (edit.predicted, edit.counted, mobility(edit.sheet)) == (1, 1, 2)
    back = remove_crease(edit.sheet, len(edit.sheet.edges) - 1)
    assert (back.counted, mobility(back.sheet), len(back.sheet.faces)) == (-1, 1, 4)
    assert area(back.sheet) == pytest.approx(4)


def test_a_locked_crease_is_flat_and_creasing_it_undoes_that():
    locked = lock_crease(FAN, 2)
    assert locked.sheet.assignments[:4] == "MVFV"
    assert locked.sheet.faces == FAN.faces
    assert (locked.predicted, locked.counted, mobility(locked.sheet)) == (-1, -1, 0)
    again = crease_sheet(locked.sheet, 2, 4, "V")
    assert again.sheet.assignments[:4] == "MVVV"
    assert (again.sheet.faces, again.counted) == (FAN.faces, 1)


def test_all_pieces_of_a_joint_go_together():
    split = Sheet(
        6,
        ((4, 5), (0, 4), (5, 2)),
        "VVV",
        ((0, 1, 2, 5, 4), (0, 4, 5, 2, 3)),
        (*SQUARE.coordinates, (0.5, 0.5), (1.5, 1.5)),
    )
    assert [joint_of_sheet_named(split, str(edge)) for edge in range(3)] == [0, 0, 0]
    assert lock_crease(split, 0).sheet.assignments[:3] == "FFF"
    assert [set(face) for face in remove_crease(split, 0).sheet.faces] == [{0, 1, 2, 3}]


def test_a_bent_face_is_creased_inside_only():
    bent = Sheet(6, (), "", ((0, 1, 2, 3, 4, 5),), ((0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (0, 1)))
    assert len(crease_sheet(bent, 1, 4).sheet.faces) == 2
    with pytest.raises(UnsolvableError, match=r"between vertex 3 \(2, 3\) and vertex 5 \(0, 1\) the crease lies in no"):
        crease_sheet(bent, 3, 5)


def test_creases_that_cannot_be():
    with pytest.raises(UnsolvableError, match=r"all the way from vertex 0 \(0, 0\) to vertex 4 \(1, 1\)"):
        crease_sheet(FAN, 0, 4)
    with pytest.raises(
        InvariantError, match=r"9 is no vertex; expected a vertex from 0 to 4; the last is vertex 4 \(1, 1\)"
    ):
        crease_sheet(FAN, 0, 9)
    with pytest.raises(InvariantError, match=r"\(0.1, 0.4\) is on no edge; .* vertex 0 \(0, 0\) and edge 7 \(B\) from"):
        crease_sheet(FAN, (0.1, 0.4), 1)
    with pytest.raises(InvariantError, match="starts and ends at vertex 0"):
        crease_sheet(FAN, 0, (0, 0))
    with pytest.raises(InvariantError, match="the assignment 'B'; expected one of M V U"):
        crease_sheet(FAN, 0, 2, "B")
    with pytest.raises(UnsolvableError, match="the sheet has none: name vertices"):
        crease_sheet(Sheet(4, (), "", ((0, 1, 2, 3),)), (0, 0), 2)
    for edit in (lock_crease, remove_crease):
        with pytest.raises(InvariantError, match="7 is no joint of the sheet"):
            edit(FAN, 7)


def test_a_panel_that_would_surround_creases_is_refused():
    two = Sheet(5, (), "", ((0, 1, 4), (1, 2, 3, 0, 4)), FAN.coordinates)
    with pytest.raises(UnsolvableError, match="the faces beside it meet in other edges too"):
        remove_crease(two, 0)


def test_joints_are_named_by_id_number_or_links():
    sc = SCGraph(["crank", "rod", "slide"], {"in": ("crank", "rod"), "a": ("rod", "slide"), "b": ("rod", "slide")})
    assert [joint_named(sc, name) for name in ("in", "0", "rod,crank", "2")] == ["in", "in", "in", "b"]
    with pytest.raises(InvariantError, match="2 joints join 'rod' and 'slide'; expected one of 'a', 'b'"):
        joint_named(sc, "rod,slide")
    with pytest.raises(
        InvariantError, match="no joint joins 'crank' and 'slide'; expected a link beside 'crank': 'rod'"
    ):
        joint_named(sc, "crank,slide")
    with pytest.raises(InvariantError, match=r"'slid' is no link; expected one of .*; the nearest is 'slide'"):
        link_named(sc, "slid")
    assert joint_of_sheet_named(FAN, "1,2") == 2
    with pytest.raises(InvariantError, match=r"edge 4 \(B\) from vertex 0 \(0, 0\) to vertex 1 \(2, 0\) is no joint"):
        joint_of_sheet_named(FAN, "4")
