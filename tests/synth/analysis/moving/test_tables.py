"""Axes and vertices as tables: read again, they are those of the thing in each frame."""

import csv

import numpy as np
import pytest
from commands import run

from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.mechanism.precision import in_space
from synth.analysis.folding.motion import fold
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.moving.motion import table_text
from synth.catalogue.patterns._generate import generate


def rows_of(path):
    with path.open(newline="") as lines:
        return list(csv.DictReader(lines))


@pytest.fixture
def framed(tmp_path):
    run("generate", "miura", "--rows", 2, "--columns", 2, "-o", tmp_path / "miura.fold")
    run("fold", tmp_path / "miura.fold", "--frames", 3, "-o", tmp_path / "frames.fold")
    return tmp_path / "frames.fold"


def test_vertices_and_axes_of_every_frame_are_those_of_the_folding(framed, tmp_path):
    folding = fold(generate("miura", rows=2, columns=2).mechanism, frames=3)
    for table in ("vertices", "axes"):
        told = run("convert", framed, tmp_path / f"{table}.csv", "--table", table).output
        assert "not stored: all but" in told
    places = np.array([[float(row[key]) for key in "xyz"] for row in rows_of(tmp_path / "vertices.csv")])
    assert {row["frame"] for row in rows_of(tmp_path / "vertices.csv")} == set("0123")
    np.testing.assert_allclose(places.reshape(4, -1, 3), folding.places, atol=1e-12)
    rows = rows_of(tmp_path / "axes.csv")
    joints = len(folding.joints)
    assert len(rows) == 4 * joints
    for frame, (sheet, angles) in enumerate(zip(folding.frames(), folding.path.angles, strict=True)):
        points = in_space(sheet.coordinates)
        for row, joint, angle in zip(rows[joints * frame : joints * (frame + 1)], folding.joints, angles, strict=True):
            start, end = points[list(sheet.edges[joint])]
            point, axis = (np.array([float(row[key]) for key in keys]) for keys in ("xyz", ("dx", "dy", "dz")))
            assert row["joint"] == str(joint)
            assert np.linalg.norm(np.cross(point - start, end - start)) < 1e-9  # on the crease
            assert np.linalg.norm(np.cross(axis, end - start)) < 1e-9
            assert np.linalg.norm(axis) == pytest.approx(1)
            assert float(row["angle_deg"]) == pytest.approx(np.degrees(angle), abs=1e-6)


def test_axes_of_what_has_no_panels(data, tmp_path):
    bennett = data / "linkages" / "bennett.json"
    run("convert", bennett, tmp_path / "axes.csv", "--table", "axes")
    rows, linkage = rows_of(tmp_path / "axes.csv"), configuration_of(read(bennett)).linkage
    assert [(row["first_link"], row["second_link"]) for row in rows] == [
        tuple(map(str, pair)) for pair in linkage.graph.joints.values()
    ]
    with pytest.raises(UnsolvableError, match="needs panels with coordinates"):
        table_text(read(bennett), "vertices")
    with pytest.raises(InvariantError, match="axes, vertices"):
        table_text(read(bennett), "loops")


def test_frames_with_other_panels_are_told(framed, tmp_path):
    text = framed.read_text(encoding="utf-8")
    framed.write_text(
        text.replace('"file_frames": [', '"file_frames": [{"vertices_coords": [[0,0],[1,0],[0,1]],'
        ' "edges_vertices": [[0,1],[1,2],[2,0]], "edges_assignment": ["B","B","B"],'
        ' "faces_vertices": [[0,1,2]]},', 1),
        encoding="utf-8",
    )  # fmt: skip
    assert "1 other frame" in run("convert", framed, tmp_path / "a.csv", "--table", "vertices").output


def test_a_table_and_a_csv_go_together(framed, tmp_path):
    for words in (["a.csv"], ["a.stl", "--table", "axes"]):
        words[0] = tmp_path / words[0]
        assert "require each other" in run("convert", framed, *words, code=2).stderr
    assert not (tmp_path / "a.csv").exists()
