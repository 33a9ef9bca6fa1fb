"""Panels as solids: closed, true, apart at hinges, and moved as the sheet moves."""

import base64
import json
from collections import Counter
from functools import cache
from zipfile import ZipFile

import numpy as np
import pytest
import shapely
from commands import run
from measured import is_watertight, volume_of_mesh

from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read, write
from graphs.mechanism.sheet import Sheet, with_all_edges
from synth.catalogue.patterns._generate import generate
from synth.making.templates.solids import SheetPlates, fitted_size, frames_of, plates_in_space, write_solids

FOLDED = {"miura": 1.0, "box-pop-up": 1.0, "miura-tube": None, "kresling": None, "square-twist": 0.5, "slit-array": 0.4}
QUICK = ("miura", "box-pop-up")
HINGED = Sheet(
    6, (), "", ((0, 1, 2, 3), (1, 4, 5, 2)), ((0, 0, 0), (40, 0, 0), (40, 30, 0), (0, 30, 0), (40, 0, 20), (40, 30, 20))
)


@cache
def folded(name):
    sheet = with_all_edges(generate(name, fold=FOLDED[name]).mechanism)
    return sheet, np.array(sheet.coordinates) * 100


@pytest.fixture
def motion(tmp_path, data):
    run("fold", data / "patterns" / "four-bar-vertex.fold", "--drive", "2=90", "--frames", 4, "-o", tmp_path / "a.fold")
    return tmp_path / "a.fold"


@pytest.mark.parametrize(
    "name", [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in FOLDED]
)
def test_every_panel_is_a_closed_plate_of_its_thickness(name):
    sheet, places = folded(name)
    plates = SheetPlates(sheet, places, thickness=1.5, gap=2)
    assert set(plates.faces) == set(range(len(sheet.faces)))
    for mesh, face in zip(plates_in_space(plates), plates.faces, strict=True):
        assert is_watertight(mesh)
        plane = plates.planes[face]
        heights = (mesh.corners - plane.origin) @ plane.normal
        np.testing.assert_allclose(np.abs(heights), 0.75, atol=1e-9)
        assert 0 < volume_of_mesh(mesh) < 1.5 * shapely.Polygon(plane.flat).area


def test_the_gap_is_open_and_free_sides_are_where_they_were():
    plates = SheetPlates(with_all_edges(HINGED), np.array(HINGED.coordinates), thickness=1, gap=3)
    first, second = plates_in_space(plates)
    assert first.corners[:, 0].max() == pytest.approx(38.5)
    assert second.corners[:, 2].min() == pytest.approx(1.5)
    assert first.corners[:, 0].min() == pytest.approx(0)
    assert (first.corners[:, 1].min(), first.corners[:, 1].max()) == (pytest.approx(0), pytest.approx(30))
    assert volume_of_mesh(first) == pytest.approx(38.5 * 30)
    assert volume_of_mesh(second) == pytest.approx(18.5 * 30)


def test_plates_do_not_touch_at_a_corner_that_points_inwards():
    """An angle bracket and the square in it, which share two hinges and the corner between them."""
    corners = ((0, 0), (40, 0), (40, 20), (20, 20), (20, 40), (0, 40), (40, 40))
    sheet = with_all_edges(Sheet(7, (), "", ((0, 1, 2, 3, 4, 5), (3, 2, 6, 4)), corners))
    places = np.column_stack([corners, np.zeros(7)])
    bracket, _ = plates_in_space(SheetPlates(sheet, places, thickness=1, gap=3))
    assert is_watertight(bracket)
    assert np.abs(bracket.corners[:, :2] - (20, 20)).max(axis=1).min() == pytest.approx(1.5)


def triangles_of_stl(path):
    raw = path.read_bytes()
    count = int.from_bytes(raw[80:84], "little")
    assert len(raw) == 84 + 50 * count
    rows = np.frombuffer(raw[84:], dtype=np.uint8).reshape(count, 50)
    numbers = rows[:, :48].copy().view("<f4").reshape(count, 4, 3)
    return numbers[:, 0], numbers[:, 1:]


def test_stl_is_watertight_as_it_is_read_with_normals_outwards(tmp_path):
    sheet, _ = folded("box-pop-up")
    write_solids(sheet, tmp_path / "a.stl", size=100)
    normals, triangles = triangles_of_stl(tmp_path / "a.stl")
    found = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    np.testing.assert_allclose(normals, found / np.linalg.norm(found, axis=1, keepdims=True), atol=1e-3)
    sides = Counter()
    for one in triangles:
        corners = [corner.tobytes() for corner in one]
        sides.update(zip(corners, corners[1:] + corners[:1], strict=True))
    assert all(number == 1 and sides[b, a] == 1 for (a, b), number in sides.items())


def test_3mf_is_without_warning_and_manifold_to_other_people(tmp_path):
    lib3mf = pytest.importorskip("lib3mf")
    sheet, _ = folded("miura")
    write_solids(sheet, tmp_path / "a.3mf", size=100)
    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(tmp_path / "a.3mf"))
    assert reader.GetWarningCount() == 0
    meshes, count = model.GetMeshObjects(), 0
    while meshes.MoveNext():
        assert meshes.GetCurrentMeshObject().IsManifoldAndOriented()
        count += 1
    assert count == len(sheet.faces)


def test_3mf_holds_a_model_in_millimetres(tmp_path):
    write_solids(HINGED, tmp_path / "a.3mf", gap=3)
    with ZipFile(tmp_path / "a.3mf") as archive:
        assert archive.namelist() == ["[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"]
        text = archive.read("3D/3dmodel.model").decode()
    assert 'unit="millimeter"' in text
    assert text.count("<item ") == text.count("<object ") == 2
    assert 'x="38.5"' in text


def numbers_of(document, accessor):
    """Rows of an accessor, checked as the specification has them."""
    held = document["accessors"][accessor]
    view = document["bufferViews"][held["bufferView"]]
    wide = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[held["type"]]
    kind = {5126: "<f4", 5125: "<u4"}[held["componentType"]]
    raw = base64.b64decode(document["buffers"][0]["uri"].partition(",")[2])
    assert len(raw) == document["buffers"][0]["byteLength"]
    assert view["byteOffset"] % 4 == 0
    assert view["byteOffset"] + view["byteLength"] <= len(raw)
    rows = np.frombuffer(raw, dtype=kind, count=held["count"] * wide, offset=view["byteOffset"]).reshape(-1, wide)
    assert rows.nbytes == view["byteLength"]
    if "min" in held:
        np.testing.assert_array_equal(rows.min(axis=0), np.float32(held["min"]))
        np.testing.assert_array_equal(rows.max(axis=0), np.float32(held["max"]))
    return rows


def turned(quaternion, corners):
    """Corners turned by a quaternion, scalar last, by the cross products of the definition."""
    axis, scalar = quaternion[:3], quaternion[3]
    return corners + 2 * np.cross(axis, np.cross(axis, corners) + scalar * corners)


def test_gltf_moves_every_plate_with_its_panel(motion, tmp_path):
    run("convert", motion, tmp_path / "a.gltf", "--size", 100, "--thickness", 0.8)
    document = json.loads((tmp_path / "a.gltf").read_text(encoding="utf-8"))
    sheet, poses, of_file = frames_of(read(motion))
    assert of_file.left_out == 0
    assert of_file.resting == len(poses) - 1  # the key frame is the last of the motion
    assert len(poses) > 4
    poses = poses * 100 / np.ptp(poses[-1], axis=0).max()
    (animation,) = document["animations"]
    targets = [(one["target"]["node"], one["target"]["path"]) for one in animation["channels"]]
    assert len(set(targets)) == len(targets) == 2 * len(document["meshes"])
    moves = {}
    for channel, target in zip(animation["channels"], targets, strict=True):
        sampler = animation["samplers"][channel["sampler"]]
        times = numbers_of(document, sampler["input"])[:, 0]
        assert times[0] == 0
        assert (np.diff(times) > 0).all()
        moves[target] = numbers_of(document, sampler["output"]).astype(float)
        assert len(moves[target]) == len(poses)
    (above,) = document["scenes"][0]["nodes"]
    assert document["nodes"][above]["scale"] == [0.001] * 3
    assert sorted(document["nodes"][above]["children"]) == list(range(len(document["meshes"])))
    for node, face in enumerate(sheet.faces):
        (primitive,) = document["meshes"][document["nodes"][node]["mesh"]]["primitives"]
        corners = numbers_of(document, primitive["attributes"]["POSITION"]).astype(float)
        assert numbers_of(document, primitive["indices"]).max() == len(corners) - 1
        turns, shifts = moves[node, "rotation"], moves[node, "translation"]
        np.testing.assert_allclose(np.linalg.norm(turns, axis=1), 1, atol=1e-6)
        assert ((turns[1:] * turns[:-1]).sum(axis=1) > 0).all()  # the short way round
        for pose, places in enumerate(poses):
            stands = places[list(face)]
            now = turned(turns[pose], corners) + shifts[pose]
            normal = np.cross(stands[1] - stands[0], stands[2] - stands[0])
            heights = (now - stands[0]) @ normal / np.linalg.norm(normal)
            np.testing.assert_allclose(np.abs(heights), 0.4, atol=1e-3)
            first = turned(turns[0], corners) + shifts[0]
            for vertex in face:  # corners of the plate keep their distances to those of the panel
                apart = [np.linalg.norm(plate - at[vertex], axis=1) for plate, at in ((now, places), (first, poses[0]))]
                np.testing.assert_allclose(*apart, atol=1e-3)


def test_a_pose_has_no_animation_and_equal_things_give_equal_files(tmp_path):
    for suffix in ("stl", "3mf", "gltf", "obj"):
        for name in "ab":
            write_solids(HINGED, tmp_path / f"{name}.{suffix}")
        assert (tmp_path / f"a.{suffix}").read_bytes() == (tmp_path / f"b.{suffix}").read_bytes()
    assert "animations" not in json.loads((tmp_path / "a.gltf").read_text(encoding="utf-8"))
    objects = (tmp_path / "a.obj").read_text(encoding="utf-8").splitlines()
    assert [row for row in objects if row[0] == "o"] == ["o panel_0", "o panel_1"]


def test_the_command_says_what_is_of_solids_only_and_what_is_not_held(motion, tmp_path):
    assert "4 other frames" in run("convert", motion, tmp_path / "a.stl", "--size", 90).stdout
    sheet = run("convert", motion, tmp_path / "a.obj")
    assert "gaps" not in sheet.stdout
    run("convert", motion, tmp_path / "b.obj", "--thickness", 1, "--size", 90)
    assert "o panel_0" in (tmp_path / "b.obj").read_text(encoding="utf-8")
    assert "--gap: for solids only" in run("convert", motion, tmp_path / "a.svg", "--gap", 1, code=2).stderr
    assert "try a larger --scale" in run("convert", motion, tmp_path / "c.stl", "--size", 9, code=2).stderr


def test_panels_without_a_unit_are_made_large_enough(motion, tmp_path):
    """Coordinates of a file without a unit are millimetres, unless nobody could make so small a thing."""
    small = run("convert", motion, tmp_path / "small.stl")
    assert "note: the file names no unit: the longer side is 150 mm; --scale or --size changes it" in small.stdout
    run("convert", motion, tmp_path / "stated.stl", "--size", 150)
    assert (tmp_path / "small.stl").read_bytes() == (tmp_path / "stated.stl").read_bytes()
    assert fitted_size(read(motion)) == 150
    write(HINGED, tmp_path / "large.fold")
    assert fitted_size(HINGED) is None
    assert "the longer side" not in run("convert", tmp_path / "large.fold", tmp_path / "large.stl").stdout


@pytest.mark.parametrize(
    ("options", "error", "told"),
    [
        ({"thickness": 0}, InvariantError, "thickness 0; expected a positive number"),
        ({"gap": -1}, InvariantError, "gap -1; expected a number from 0 to"),
        ({"gap": 90}, UnsolvableError, "panel 0 is narrower than the gap of 90 mm"),
    ],
)
def test_what_cannot_be_made_is_refused(options, error, told, tmp_path):
    with pytest.raises(error, match=told):
        write_solids(HINGED, tmp_path / "a.stl", **options)
    assert list(tmp_path.iterdir()) == []


def test_a_panel_that_changes_its_shape_does_not_move():
    places = np.array(HINGED.coordinates)
    sheet = with_all_edges(HINGED)
    plates = SheetPlates(sheet, places, thickness=1, gap=1)
    with pytest.raises(UnsolvableError, match="panel 0 in pose 1 has another shape"):
        plates.motions(sheet, np.array([places, places * (1, 1.1, 1)]))
