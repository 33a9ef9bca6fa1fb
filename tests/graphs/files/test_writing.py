"""What formats cannot hold is told, types are kept, and what is there is not replaced."""

import json
import os
from dataclasses import replace
from math import pi, radians

import pytest

from graphs.convert.duality import mechanism_of_sheet
from graphs.errors import FileError, InvariantError, UnsolvableError
from graphs.files.atomic import FolderBeside, check_new_folder, check_place
from graphs.files.formats import READERS, WRITERS, mechanism_of_id, read, write
from graphs.files.losses import change_of_type
from graphs.files.text import in_degrees
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet, with_all_edges

RING = [(0, 1), (1, 2), (2, 3), (3, 0)]
PLACES = ((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (1.0, 1.0))
FAN = ((0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))
REMOTE = "m1:a-b-.a-c-.b-d-.c-d-"
"""A ring of four links whose axes meet in a point that none of them reaches."""


def test_a_remote_centre_is_no_vertex_of_a_pattern(tmp_path):
    remote = mechanism_of_id(REMOTE)
    with pytest.raises(UnsolvableError, match=r"M = 1 spherical becomes M = -2 spatial; it cannot hold 1 implicit"):
        write(remote, tmp_path / "a.fold")
    assert not list(tmp_path.iterdir())
    assert write(remote, tmp_path / "a.fold", lossy=True) == ("1 implicit centre",)
    assert len(read(tmp_path / "a.fold").faces) == 4


@pytest.mark.parametrize("suffix", [".g6", ".s6", ".graphml", ".edges", ".txt"])
def test_a_bare_graph_gives_every_face_a_finite_centre(suffix, tmp_path):
    planar = SCGraph(4, RING, [Loop(range(4), "infinite")])
    with pytest.raises(UnsolvableError, match="M = 1 planar becomes M = 1 spherical"):
        write(planar, tmp_path / f"a{suffix}")
    assert "1 loop and its centre" in write(planar, tmp_path / f"a{suffix}", lossy=True)
    write(SCGraph(4, RING, [Loop(range(4))]), tmp_path / f"b{suffix}")


def test_types_differ_by_their_centres_though_all_numbers_agree():
    ladder = [(0, 1), (1, 2), (2, 3), (3, 0), (2, 4), (4, 5), (5, 3), (4, 6), (6, 7), (7, 8), (8, 5)]
    squares = [(0, 1, 2, 3), (2, 4, 5, 6), (5, 7, 8, 9, 10)]
    first, second = (
        SCGraph(9, ladder, [Loop(around, at="P" if i in shared else None) for i, around in enumerate(squares)])
        for shared in ((0, 1), (1, 2))
    )
    assert len(first.centre_classes()) == len(second.centre_classes()) == 2
    assert "other loops share a centre" in change_of_type(first, second)
    assert change_of_type(first, first.relabel({0: "a"})) is None


def test_a_sheet_tells_what_each_format_loses(tmp_path):
    edges = ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4))
    sheet = Sheet(5, edges, "BBBBCJUM", FAN, PLACES, "Fan", fold_angles=(*(None,) * 7, pi / 2))
    bounds = "which lines bound which of 4 faces"
    assert write(sheet, tmp_path / "a.fold") == ()
    assert write(sheet, tmp_path / "a.obj") == ("the title",)
    assert write(sheet, tmp_path / "a.svg") == ("1 join: as flat edges", "1 fold angle", bounds)
    assert write(sheet, tmp_path / "a.cp") == (
        *("1 cut: as borders", "1 join: as auxiliary lines", "1 unassigned crease: as valleys", "1 fold angle"),
        *("the title", bounds),
    )
    assert write(sheet, tmp_path / "a.json") == (
        *("the title", "coordinates of 5 vertices", "the shapes of 4 faces", "mountain or valley of 1 crease"),
        *("1 cut", "1 flat edge", "1 fold angle"),
    )
    for suffix in (".obj", ".svg", ".cp"):
        assert change_of_type(sheet, read(tmp_path / f"a{suffix}")) is None


@pytest.mark.parametrize("suffix", [".svg", ".cp", ".obj", ".fold"])
def test_faces_without_a_list_of_edges_are_written_whole(suffix, tmp_path):
    sheet = Sheet(5, (), "", FAN, PLACES)
    write(sheet, tmp_path / f"a{suffix}")
    again = read(tmp_path / f"a{suffix}")
    assert (len(again.faces), len(mechanism_of_sheet(again).sc.joints)) == (4, 4)


def test_edges_that_are_added_have_the_ids_of_their_joints():
    sheet = Sheet(5, ((4, 2), (0, 1)), "MB", FAN, PLACES, fold_angles=(0.5, None))
    whole = with_all_edges(sheet)
    hinges = mechanism_of_sheet(sheet).hinges
    assert {joint: frozenset(whole.edges[joint]) for joint in hinges} == {
        joint: frozenset(ends) for joint, ends in hinges.items()
    }
    assert (whole.assignments, len(whole.fold_angles)) == ("MBUUUBBB", 8)
    assert with_all_edges(whole) is whole


@pytest.mark.parametrize("suffix", [".svg", ".cp"])
def test_a_picture_of_nothing_is_refused(suffix, tmp_path):
    with pytest.raises(UnsolvableError, match="needs lines, and the sheet has none"):
        write(Sheet(1, (), "", (), ((0.0, 0.0),)), tmp_path / f"a{suffix}", lossy=True)
    assert not list(tmp_path.iterdir())


def test_what_could_not_be_read_again_is_not_written(tmp_path):
    folded_over = Sheet(4, (), "", ((0, 1, 2), (0, 2, 3)), ((0, 0), (1, 0), (1, 1), (2, 1)))
    for lossy in (False, True):
        with pytest.raises(UnsolvableError, match=r"a \.svg file could not be read again: none of 1 crease line"):
            write(folded_over, tmp_path / "a.svg", lossy=lossy)
    assert not list(tmp_path.iterdir())


def test_a_file_is_replaced_by_force_only(tmp_path):
    path = tmp_path / "a.json"
    write(SCGraph(4, RING), path)
    with pytest.raises(FileError, match=r"exists already; expected another name, or --force \(in Python force=True\)"):
        write(SCGraph(2, [(0, 1)]), path)
    assert len(read(path)) == 4
    write(SCGraph(2, [(0, 1)]), path, force=True)
    assert len(read(path)) == 2


@pytest.mark.parametrize("force", [False, True])
def test_links_and_special_files_are_never_written_to(force, tmp_path):
    target = tmp_path / "target.json"
    target.write_text("old", encoding="utf-8")
    (tmp_path / "link.json").symlink_to(target)
    (tmp_path / "dangling.json").symlink_to(tmp_path / "nowhere.json")
    os.mkfifo(tmp_path / "pipe.json")
    before = sorted(tmp_path.iterdir())
    for name, what in (("link", "a symbolic link"), ("dangling", "a symbolic link"), ("pipe", "a special file")):
        with pytest.raises(FileError, match=what):
            write(SCGraph(2, [(0, 1)]), tmp_path / f"{name}.json", force=force)
    assert sorted(tmp_path.iterdir()) == before
    assert target.read_text(encoding="utf-8") == "old"
    assert (tmp_path / "link.json").is_symlink()
    with pytest.raises(FileError, match="exists already"):
        FolderBeside(tmp_path / "dangling.json")


def test_what_is_written_can_be_read():
    assert set(WRITERS) <= set(READERS)


def test_a_sheet_that_is_no_mechanism_has_no_type_to_keep(tmp_path):
    book = Sheet(5, (), "", ((0, 1, 2), (0, 1, 3), (0, 1, 4)), PLACES)
    with pytest.raises(InvariantError, match="belongs to 3 faces"):
        mechanism_of_sheet(book)
    assert write(book, tmp_path / "a.obj") == ()


def test_fold_keeps_the_precision_of_a_traced_pattern(tmp_path):
    traced = replace(Sheet(5, (), "", FAN, PLACES), spread=0.001)
    assert write(traced, tmp_path / "a.fold") == ()
    assert read(tmp_path / "a.fold").spread == 0.001
    assert write(traced, tmp_path / "a.obj") == ("the distances of welded points",)


@pytest.mark.parametrize("angle", [1e-05, -12345.678, 2.5e-300, 1e22, -180.0, 0.1 + 0.2])
def test_fold_angles_of_any_size_survive_in_obj(angle, tmp_path):
    sheet = Sheet(5, ((0, 4), (1, 4)), "MV", FAN, PLACES, fold_angles=(radians(angle), None))
    assert write(sheet, tmp_path / "a.obj") == ()
    again = read(tmp_path / "a.obj")
    assert (again.assignments, again.fold_angles) == ("MV", (radians(angle), None))
    assert f"#e 1 5 M {angle!r}" in (tmp_path / "a.obj").read_text(encoding="utf-8")


@pytest.mark.parametrize("suffix", [".fold", ".obj"])
def test_degrees_of_files_are_written_again_as_they_were(suffix, tmp_path):
    listed = [*range(-360, 361), *(k / 100 for k in range(-1817, 1817, 3)), 179.99999999999997, 123.456789012345]
    ends = tuple((0, k + 1) for k in range(len(listed)))
    places = tuple((float(k), float(k * k)) for k in range(len(listed) + 1))
    angles = tuple(map(radians, listed))
    sheet = Sheet(len(places), ends, "B" * len(listed), ((0, 1, 2),), places, fold_angles=angles)
    write(sheet, tmp_path / f"a{suffix}")
    assert [in_degrees(angle) for angle in angles] == listed
    again = read(tmp_path / f"a{suffix}")
    assert (
        dict(zip(again.edges, again.fold_angles, strict=True)).items() >= dict(zip(ends, angles, strict=True)).items()
    )
    write(again, tmp_path / f"b{suffix}")
    assert (tmp_path / f"a{suffix}").read_bytes() == (tmp_path / f"b{suffix}").read_bytes()


def test_a_fold_angle_that_is_not_finite_is_refused_in_obj(tmp_path):
    rows = ["v 0 0 0", "v 1 0 0", "v 0 1 0", "#e 1 2 M 1e999", "f 1 2 3"]
    (tmp_path / "a.obj").write_text("\n".join(rows), encoding="utf-8")
    with pytest.raises(FileError, match="line 4: '#e 1 2 M 1e999'; expected a fold angle in degrees"):
        read(tmp_path / "a.obj")


@pytest.mark.parametrize("angle", [1e-05, 45.123456789, 179.99999999])
def test_fold_angles_keep_their_digits_in_svg(angle, tmp_path):
    letters = "BBBBMVMV"
    edges = ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4))
    angles = (*(None,) * 4, -radians(angle), radians(angle), -pi, pi)
    sheet = Sheet(5, edges, letters, FAN, PLACES, fold_angles=angles)
    assert not any("fold angle" in line for line in write(sheet, tmp_path / "a.svg"))
    again = read(tmp_path / "a.svg")
    assert sorted(filter(None, again.fold_angles)) == sorted(angles[4:])


def pattern(**more):
    return {
        "vertices_coords": PLACES,
        "faces_vertices": FAN,
        "edges_vertices": [[0, 4]],
        "edges_assignment": ["M"],
        **more,
    }


@pytest.mark.parametrize("suffix", [".fold", ".svg", ".cp", ".obj", ".json", ".s6", ".graphml"])
def test_keys_of_fold_that_a_sheet_does_not_hold_are_told_by_name(suffix, tmp_path):
    more = {
        "file_author": "A",
        "faceOrders": [],
        "edges_length": [1],
        "vendor:x\n": 1,
        "frame_unit": None,
        "edges_faces": [],
    }
    (tmp_path / "a.fold").write_text(json.dumps(pattern(**more)), encoding="utf-8")
    lost = write(read(tmp_path / "a.fold"), tmp_path / f"b{suffix}")
    assert [line for line in lost if "FOLD" in line] == [
        r"the FOLD keys file_author, faceOrders, edges_length, vendor:x\n"
    ]


def test_what_another_frame_or_title_holds_is_told_too(tmp_path):
    frame = pattern(frame_title="one", frame_classes=["foldedForm"])
    document = {"file_title": "all", "file_author": "A", "file_frames": [frame], **{f"x:{i}": 1 for i in range(20)}}
    (tmp_path / "a.fold").write_text(json.dumps(document), encoding="utf-8")
    sheet = read(tmp_path / "a.fold")
    assert (sheet.title, write(sheet, tmp_path / "b.fold")) == (
        "one",
        ("1 other frame", "the FOLD keys file_title, file_author, frame_classes"),
    )
    (tmp_path / "c.fold").write_text(json.dumps(pattern(**{f"x:{i}": 1 for i in range(20)})), encoding="utf-8")
    assert write(read(tmp_path / "c.fold"), tmp_path / "d.fold")[0].endswith("x:10, x:11 and 8 more")


def test_a_pattern_that_is_held_whole_loses_nothing(tmp_path):
    write(Sheet(5, ((0, 4),), "M", FAN, PLACES, "Fan", fold_angles=(0.5,), spread=1e-6), tmp_path / "a.fold")
    assert write(read(tmp_path / "a.fold"), tmp_path / "b.fold") == ()
    assert (tmp_path / "a.fold").read_bytes() == (tmp_path / "b.fold").read_bytes()


@pytest.mark.parametrize("force", [False, True])
def test_a_missing_folder_is_told_before_anything_is_written(tmp_path, force):
    for check in (
        lambda: check_place(tmp_path / "no" / "a.fold", force=force),
        lambda: check_new_folder(tmp_path / "no" / "a"),
    ):
        with pytest.raises(FileError, match=r"a(\.fold)?: there is no folder '.*no'; expected a folder that exists"):
            check()
    assert list(tmp_path.iterdir()) == []
