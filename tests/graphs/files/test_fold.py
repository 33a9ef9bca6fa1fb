"""FOLD: frames, inheritance, old names, nulls, angles; writing what other programs read."""

import json
import math
from math import radians

import numpy as np
import pytest

from graphs.convert.duality import mechanism_of_sheet
from graphs.errors import FileError, UnsolvableError
from graphs.files.formats import read, write
from graphs.files.patterns import fold
from graphs.files.patterns.fold import fold_text, sheet_from_fold
from graphs.files.text import in_degrees, json_text
from graphs.mechanism import precision
from graphs.mechanism.sheet import Sheet

SQUARE = {
    "vertices_coords": [[0, 0], [1, 0], [1, 1], [0, 1]],
    "edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]],
    "edges_assignment": ["B", "B", "B", "B", "M"],
    "edges_foldAngle": [0, 0, 0, 0, -90],
    "faces_vertices": [[0, 1, 2], [0, 2, 3]],
}


def sheet(document, tmp_path):
    return sheet_from_fold(document, tmp_path / "a.fold")


def test_an_empty_key_frame_gives_way_to_the_first_frame_with_a_pattern(tmp_path):
    found = sheet({"file_spec": 1.1, "file_frames": [{"frame_title": "empty"}, SQUARE]}, tmp_path)
    assert found.repairs == ("the key frame is empty; frame 2 of 2 was read",)
    assert len(found.faces) == 2
    plain, more = sheet(SQUARE, tmp_path), sheet(SQUARE | {"file_frames": [{}]}, tmp_path)
    assert more.repairs == plain.repairs  # a frame is no repair


def test_frames_inherit(tmp_path):
    moved = {"frame_inherit": True, "frame_parent": 2, "vertices_coords": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 1]]}
    frames = [moved, {"frame_inherit": True, "frame_parent": 3}, {**SQUARE, "frame_title": "parent"}]
    found = sheet({"file_frames": frames}, tmp_path)
    assert found.coordinates[3] == (0, 1, 1)
    assert found.title == "parent"
    assert found.assignments == "BBBBM"
    for parents in ((1,), (2, 1)):
        ring = [{"frame_inherit": True, "frame_parent": p} for p in parents]
        with pytest.raises(FileError, match="frames inherit in a circle"):
            sheet({"file_frames": ring}, tmp_path)
    with pytest.raises(FileError, match=r"file_frames\[0\].frame_parent: 7; expected 0 to 1"):
        sheet({"file_frames": [{"frame_inherit": True, "frame_parent": 7}]}, tmp_path)
    with pytest.raises(FileError, match=r"file_frames\[0\]: 5; expected a frame"):
        sheet({"file_frames": [5]}, tmp_path)


def test_old_names_and_nulls_are_read(tmp_path):
    old = {k: v for k, v in SQUARE.items() if k != "edges_foldAngle"} | {"edges_foldAngles": [None, 0, 0, 0, 45]}
    found = sheet(old | {"file_frames": None, "edges_assignment": ["B", None, "B", "B", "M"]}, tmp_path)
    assert found.fold_angles == (None, 0, 0, 0, radians(45))
    assert found.assignments == "BUBBM"
    assert found.repairs == ("old key edges_foldAngles read as edges_foldAngle", "1 null assignment read as unassigned")
    assert len(sheet(SQUARE | {"faces_vertices": None}, tmp_path).faces) == 2
    with pytest.raises(FileError, match=r"edges_foldAngle\[4\]: 'flat'; expected a number"):
        sheet(SQUARE | {"edges_foldAngle": [0, 0, 0, 0, "flat"]}, tmp_path)


def test_what_is_written_has_the_keys_that_simulators_ask_for(tmp_path):
    found = sheet(SQUARE | {"frame_title": "Square <&>"}, tmp_path)
    text = fold_text(found)
    assert sheet_from_fold(json.loads(text), tmp_path) == found
    document = json.loads(text)
    for key in ("vertices_coords", "edges_vertices", "edges_assignment", "edges_foldAngle", "faces_vertices"):
        assert len(document[key]) == len(SQUARE[key])
    assert document["frame_attributes"] == ["2D"]


def test_svg_is_written_in_origami_colours(tmp_path):
    found = sheet(SQUARE | {"frame_title": "Square <script>"}, tmp_path)
    write(found, tmp_path / "a.svg")
    text = (tmp_path / "a.svg").read_text(encoding="utf-8")
    assert "<script>" not in text
    assert text.count("#000000") == 4
    assert 'stroke="#ff0000" stroke-opacity="0.5"' in text
    back = read(tmp_path / "a.svg")
    assert sorted(back.assignments) == sorted(found.assignments)
    assert [x for x in back.fold_angles if x is not None] == [radians(-90)]
    assert len(mechanism_of_sheet(back).sc.joints) == 1


@pytest.mark.parametrize("suffix", [".svg", ".cp"])
def test_flat_formats_refuse_what_is_not_flat(suffix, tmp_path):
    bent = Sheet(
        4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), ((0.0, 0.0, 0.0), (1.0, 0.0, 1.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0))
    )
    with pytest.raises(UnsolvableError, match="is planar, and the sheet is not"):
        write(bent, tmp_path / f"a{suffix}")
    with pytest.raises(UnsolvableError, match="needs coordinates, and the sheet has none"):
        write(Sheet(3, (), "", ((0, 1, 2),)), tmp_path / f"a{suffix}")
    assert not list(tmp_path.iterdir())


def test_an_edge_listed_twice_is_a_crease_if_either_is(tmp_path):
    twice = SQUARE | {
        "edges_vertices": [*SQUARE["edges_vertices"], [2, 0], [0, 1]],
        "edges_assignment": ["B", "B", "B", "B", "F", "V", "B"],
    }
    del twice["edges_foldAngle"]
    mechanism = mechanism_of_sheet(sheet(twice, tmp_path))
    assert len(mechanism.sc.joints) == 1
    assert mechanism.repairs == ("2 edges listed twice: a crease counts before a border or a flat edge",)


def test_a_pattern_that_is_read_is_checked_once(tmp_path, monkeypatch):
    document = {"vertices_coords": [[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]], "faces_vertices": [[0, 1, 2, 3]]}
    (tmp_path / "a.fold").write_text(json.dumps(document), encoding="utf-8")
    checked, measured = [], []
    check, as_written = Sheet.__post_init__, precision.precision_as_written
    monkeypatch.setattr(Sheet, "__post_init__", lambda sheet: checked.append(sheet) or check(sheet))
    monkeypatch.setattr(precision, "precision_as_written", lambda sheet: measured.append(sheet) or as_written(sheet))
    sheet = read(tmp_path / "a.fold")
    assert (sheet.frames.others, len(checked)) == (0, 1)
    assert not measured  # a sheet that stands on an axis is flat, however precise it is


def test_fold_angles_are_written_in_degrees_all_at_once_as_each_is():
    chance = np.random.default_rng(1)
    written = np.radians(np.round(chance.uniform(-180.0, 180.0, 500), 3))
    angles = [*written.tolist(), *chance.uniform(-4.0, 4.0, 500).tolist(), None, 0.0, math.pi, -math.pi, 1e-300]
    assert fold._in_degrees(angles) == [None if angle is None else in_degrees(angle) for angle in angles]


@pytest.mark.parametrize(
    "items",
    [
        [[0.1, -2.0], [3, None]],
        [[], [1.0]],
        [["], ["], ["a"]],
        [[1.0], {"a": [2.0]}],
        [[1.0, [2.0, 3.0]], 4.0],
        [[[1.0], [2.0]]],
        [[1.0], 2.0, [3.0]],
        [[True, False], [1e-300]],
    ],
)
def test_items_of_lists_are_written_one_per_line(items):
    lines = ",\n".join(f"    {json.dumps(item)}" for item in items)
    assert json_text({"key": items}) == f'{{\n  "key": [\n{lines}\n  ]\n}}\n'
    assert json.loads(json_text({"key": items})) == {"key": items}
