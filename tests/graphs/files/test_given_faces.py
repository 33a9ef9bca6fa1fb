"""FOLD and OBJ with faces: creases that lie on none, faces that cross themselves."""

import json
from math import degrees

import pytest

from graphs.convert.duality import mechanism_of_sheet
from graphs.errors import FileError
from graphs.files.formats import read
from graphs.mechanism.sheet import Sheet

PAPER = {
    "vertices_coords": [[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.5]],
    "edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]],
    "edges_assignment": list("BBBBMMMV"),
    "edges_foldAngle": [0, 0, 0, 0, -90, -90, -90, 90],
    "faces_vertices": [[0, 1, 2, 3]],
}


def fold(path, document):
    path = path / "a.fold"
    path.write_text(json.dumps(document), encoding="utf-8")
    return path


def size(sheet):
    sc = mechanism_of_sheet(sheet).sc
    return len(sc), len(sc.joints)


def test_creases_on_no_face_are_traced(tmp_path):
    sheet = read(fold(tmp_path, PAPER))
    assert size(sheet) == (4, 4)
    assert sheet.repairs[0] == "4 crease lines on no face: faces traced anew"
    assert sorted(map(degrees, sheet.fold_angles)) == [-90, -90, -90, 0, 0, 0, 0, 90]


def test_sides_that_no_edge_lists_are_kept_when_faces_are_traced(tmp_path):
    """Two faces whose common side is listed by halves, and no border listed."""
    halves = {
        "vertices_coords": [[0, 0], [1, 0], [1, 1], [0, 1], [0, 0.5], [1, 0.5], [0.5, 0.5]],
        "edges_vertices": [[4, 6], [6, 5]],
        "edges_assignment": ["M", "M"],
        "faces_vertices": [[0, 1, 5, 4], [4, 5, 2, 3]],
    }
    sheet = read(fold(tmp_path, halves))
    assert size(sheet) == (2, 1)
    assert sorted(sheet.assignments) == list("BBBBBBM")


def test_creases_on_no_face_are_told_of_where_faces_cannot_be_traced(tmp_path):
    folded = PAPER | {
        "vertices_coords": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.5], [0.5, 0.5, 0]],
        "faces_vertices": [[0, 1, 4], [0, 4, 3]],
    }
    mechanism = mechanism_of_sheet(read(fold(tmp_path, folded)))
    assert (len(mechanism.sc), len(mechanism.sc.joints)) == (2, 1)
    assert "1 crease line on no face dropped" in mechanism.warnings
    with pytest.raises(FileError, match=r"faces_vertices: 4 crease lines on no face, and none between two faces"):
        read(fold(tmp_path, folded | {"faces_vertices": [[0, 1, 2]], "edges_assignment": list("BBBBMMMV")}))


def test_faces_folded_over_each_other_are_not_traced(tmp_path):
    """The lower half folded up over the upper one: lines of both halves cross, and are not joined."""
    flat_folded = {
        "vertices_coords": [[0, 1], [1, 1], [1, 0], [0, 0], [0, 1], [1, 1]],
        "edges_vertices": [[3, 2], [0, 2], [3, 5]],
        "edges_assignment": list("VMM"),
        "faces_vertices": [[3, 2, 1, 0], [2, 3, 4, 5]],
    }
    sheet = read(fold(tmp_path, flat_folded))
    assert (len(sheet.faces), size(sheet)) == (2, (2, 1))
    assert "2 crease lines on no face dropped" in mechanism_of_sheet(sheet).warnings


def test_a_sheet_made_in_python_tells_of_creases_on_no_face():
    sheet = Sheet(4, ((0, 2), (1, 3)), "MV", ((0, 1, 2), (0, 2, 3)))
    assert "1 crease line on no face dropped" in mechanism_of_sheet(sheet).warnings


SQUARE = [[0, 0], [2, 0], [2, 2], [0, 2], [4, 0], [4, 2]]
PENTAGON = [[0, 3], [2.9, 0.9], [1.8, -2.4], [-1.8, -2.4], [-2.9, 0.9], [9, 9]]


@pytest.mark.parametrize("tilt", [lambda x, y: (x, y), lambda x, y: (x, 0, y), lambda x, y: (x, y, x + y)])
def test_a_face_that_crosses_itself_is_refused(tilt, tmp_path):
    for points, face in ((SQUARE, [1, 4, 2, 5]), (PENTAGON, [0, 2, 4, 1, 3])):
        document = {"vertices_coords": [tilt(*p) for p in points], "faces_vertices": [[0, 1, 2], face]}
        with pytest.raises(FileError, match=r"faces_vertices\[1\]: face 1 crosses itself at \("):
            read(fold(tmp_path, document))
    rows = [f"v {x} {y} 0" for x, y in SQUARE]
    (tmp_path / "a.obj").write_text("\n".join([*rows, "f 1 2 3 4", "f 2 5 3 6"]), encoding="utf-8")
    with pytest.raises(FileError, match=r"line 8: face 1 crosses itself at \(3, 1\)"):
        read(tmp_path / "a.obj")


def test_faces_that_do_not_cross_themselves_pass(tmp_path):
    """Not convex, with a corner on a side but for rounding, with three corners in line, clockwise."""
    arrow = [[0, 0], [2, 0], [2, 2], [1, 1e-9], [0, 2], [1, 0]]
    for face in ([0, 1, 2, 3, 4], [4, 3, 2, 1, 0], [0, 5, 1, 2, 4], [0, 5, 1, 2]):
        assert read(fold(tmp_path, {"vertices_coords": arrow, "faces_vertices": [face]})).faces == (tuple(face),)
