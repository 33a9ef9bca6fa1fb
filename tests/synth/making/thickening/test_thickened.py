"""Thick sheets: solids that move as the thin sheet does, and input that cannot be thickened."""

import json
from dataclasses import replace

import numpy as np
import pytest
from commands import run
from fans import fan

import synth
from graphs.errors import SynthedraError
from graphs.files.formats import read
from synth.analysis.moving._configuration_of import configuration_of
from synth.making.drawing.space.solids import faces_of_shapes
from synth.making.viewer.page_data import shown_of


@pytest.mark.parametrize(("name", "hinges"), [("miura", "screws"), ("square-twist", "tape"), ("yoshimura", "screws")])
def test_solids_say_to_which_side_they_fold_whatever_joins_them(name, hinges):
    thick = synth.thicken(synth.generate(name).mechanism, thickness=0.05, collisions=False, hinges=hinges)
    assert thick.solids.senses() == {joint: 1 if joint in thick.valleys else -1 for joint in thick.solids.chain.joints}


@pytest.mark.parametrize("name", ["miura", "square-twist"])
def test_solids_fold_flat_by_the_angles_of_the_thin_sheet(name):
    thick = synth.thicken(synth.generate(name).mechanism, thickness=0.05, collisions=False)
    assert thick.keeps_angles
    assert thick.residual < 1e-12
    assert np.degrees(abs(thick.angles).max()) > 178.9
    assert "1 degree of freedom" in str(thick.verdict)
    rotations, shifts = thick.panel_motions()
    # Every hinge, not only those of the tree, keeps its points on both of its panels.
    number = {link: place for place, link in enumerate(thick.solids.chain.nodes)}
    for joint, pair in thick.solids.chain.joints.items():
        point, along = map(np.array, thick.solids.axes[joint])
        for end in (point, point + along):
            first, second = (rotations[:, number[link]] @ end + shifts[:, number[link]] for link in pair)
            assert abs(first - second).max() < 1e-9


def test_each_solid_is_closed_and_lies_between_its_heights():
    thick = synth.thicken(synth.generate("miura").mechanism, thickness=0.05, collisions=False)
    for mesh in thick.plates.meshes:
        sides = np.concatenate([mesh.triangles[:, [a, b]] for a, b in ((0, 1), (1, 2), (2, 0))])
        directed = set(map(tuple, sides.tolist()))
        assert len(directed) == len(sides)
        assert {(b, a) for a, b in directed} == directed
        corners = mesh.corners[mesh.triangles]
        assert np.einsum("ti,ti->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) > 0


def test_what_cannot_be_thickened_is_said_in_a_line():
    miura = synth.generate("miura").mechanism
    bare = replace(miura, assignments=miura.assignments.replace("M", "U"))
    for sheet, thickness, words in (
        (bare, 0.1, "has the assignment U; expected M or V"),
        (miura, 0.0, "thickness 0.0; expected a positive number"),
        (miura, 5.0, "thickness 5 mm: panel 0 allows at most"),
    ):
        with pytest.raises(SynthedraError, match=words):
            synth.thicken(sheet, thickness=thickness)


def volume_of(shape):
    sides = np.array(shape.corners)[np.array(shape.triangles)]
    return np.einsum("ti,ti->", sides[:, 0], np.cross(sides[:, 1], sides[:, 2])) / 6.0


def test_the_command_writes_solids_that_other_commands_take(tmp_path):
    out = tmp_path / "thick.json"
    source = tmp_path / "miura.fold"
    synth.write(synth.generate("miura").mechanism, source)
    answer = json.loads(run("thicken", source, "--thickness", "0.1", "--no-collisions", "-o", out, "--json").stdout)
    assert answer["keeps_angles"]
    assert "1 degree of freedom" in run("mobility", out).stdout
    solids = read(out)
    assert len(solids.axes) == len(answer["heights"])
    assert sum(volume_of(shape) for shape in solids.shapes) == pytest.approx(answer["volume"])
    for suffix in (".stl", ".3mf", ".gltf"):
        assert "not stored" not in run("convert", out, tmp_path / f"converted{suffix}").stderr
    step = tmp_path / "thick.step"
    run("convert", out, step, "--as", "step", "--scale", "1")
    text = step.read_text()
    assert text.count("MANIFOLD_SOLID_BREP") == len(solids.shapes)
    assert text.count("TRIMMED_CURVE") == len(solids.axes)
    points = [
        [float(x) for x in row.split("(")[-1].rstrip(");").split(",")]
        for row in text.splitlines() if "CARTESIAN_POINT" in row
    ]  # fmt: skip
    assert np.ptp(np.array(points)[:, 2]) < 1.0  # millimetres
    bad = json.loads(out.read_text())
    bad["shapes"][0]["triangles"][0] = [0, 1, 9999]
    out.write_text(json.dumps(bad))
    assert "a shape of link 0 has the triangle" in run("mobility", out, code=2).stderr
    for suffix in (".stl", ".3mf", ".gltf"):
        target = tmp_path / f"thick{suffix}"
        assert run("thicken", source, "--thickness", "0.1", "--no-collisions", "-o", target).exit_code == 0
        assert target.stat().st_size > 1000


def test_the_size_of_the_sheet_is_a_scale(tmp_path):
    source = tmp_path / "miura.fold"
    sheet = synth.generate("miura").mechanism
    synth.write(sheet, source)
    extent = float(np.ptp(np.array(sheet.coordinates), axis=0).max())
    words = ("thicken", source, "--thickness", "2", "--no-collisions", "--json")
    sized = json.loads(run(*words, "--size", "300").stdout)
    assert sized["volume"] == pytest.approx(json.loads(run(*words, "--scale", 300 / extent).stdout)["volume"])
    data = json.loads(source.read_text()) | {"frame_unit": "cm"}
    source.write_text(json.dumps(data))
    of_unit = ("thicken", source, "--thickness", "0.5", "--no-collisions", "--json")
    assert json.loads(run(*of_unit).stdout)["volume"] == pytest.approx(
        json.loads(run(*of_unit, "--scale", 10).stdout)["volume"]
    )
    assert "both a scale and a size" in run(*words, "--size", 300, "--scale", 2, code=2).stderr


def test_the_file_moves_as_the_sheet_was_meant_to_with_its_angles_beside_those_of_the_thin_one(tmp_path):
    thick = synth.thicken(synth.generate("miura").mechanism, thickness=0.05, collisions=False)
    thick.write(tmp_path / "thick.json")
    solids = read(tmp_path / "thick.json")
    # Valleys turn in the positive sense, as material below their axes lets them.
    assert solids.senses() == {joint: 1 if int(joint) in thick.valleys else -1 for joint in solids.chain.joints}
    motion = synth.move(solids, frames=3)
    beside, residual = motion.beside_thin()
    assert residual < 1e-12
    assert np.allclose(beside, motion.path.angles, atol=1e-12)
    assert np.degrees(abs(motion.path.angles).max()) == pytest.approx(179.0)
    text = str(motion)
    assert "fold angles: those of the thin sheet" in text
    assert "against the assignment" not in text
    assert motion.to_json()["thin"]["closure"] == residual
    # Corners of what is drawn are where the answer of `thicken` puts panels at the same angles.
    shown = faces_of_shapes(solids, motion.linkage)
    places = shown.places(motion.linkage, motion.path.angles) * motion.linkage.extent + motion.linkage.middle
    rotations, shifts = replace(thick, angles=motion.path.angles).panel_motions()
    for frame in range(len(places)):
        placed = np.concatenate([mesh.corners for mesh in thick.plates.placed(rotations[frame], shifts[frame])])
        assert abs(places[frame] - placed).max() < 1e-9


def test_a_page_shows_the_solids_and_their_hinges():
    thick = synth.thicken(synth.generate("miura").mechanism, thickness=0.05, collisions=False)
    moving = shown_of(thick.solids).moving.to_json()
    assert moving["solver"]["limited"]
    bodies = moving["bodies"]
    count = sum(len(mesh.corners) for mesh in thick.plates.meshes)
    assert len(bodies["vertices"]) == count + 2 * 12
    axes = [edge for edge in bodies["edges"] if edge["joint"] >= 0]
    lengths = [np.linalg.norm(np.subtract(*(bodies["vertices"][end] for end in edge["ends"]))) for edge in axes]
    told = [sum(np.linalg.norm(b - a) for a, b in lines) for lines in thick.hinge_lines.values()]
    assert np.allclose(np.array(lengths) * moving["extent"], told)
    # The volume within the faces is that of the plates.
    corners = np.array(bodies["vertices"])
    volume = sum(
        corners[face["vertices"][0]] @ np.cross(corners[face["vertices"][i]], corners[face["vertices"][i + 1]]) / 6.0
        for face in bodies["faces"] for i in range(1, len(face["vertices"]) - 1)
    )  # fmt: skip
    assert volume * moving["extent"] ** 3 == pytest.approx(thick.plates.volume)


def test_the_thin_sheet_closes_at_the_fold_angles_of_five_thick_creases():
    """Rotations round a vertex do not depend on heights, so the thin sheet closes wherever the solids do."""
    last = np.radians(80.0)
    side = (np.pi - last) / 2
    sheet = fan([side, np.pi / 2, last, np.pi / 2, side], "VMMMM")
    solids = synth.thicken(sheet, thickness=0.01, collisions=False).solids
    motion = synth.move(solids, frames=2)
    beside, residual = motion.beside_thin()
    assert residual < 1e-12
    assert np.allclose(beside, motion.path.angles, atol=1e-12)
    assert abs(configuration_of(sheet).closure.at(motion.path.angles[-1])[0]).max() < 1e-12


def test_commands_draw_the_solids(tmp_path):
    source, target = tmp_path / "thick.json", tmp_path / "thick.svg"
    thick = synth.thicken(synth.generate("miura", rows=2, columns=2).mechanism, thickness=0.05, collisions=False)
    thick.write(source)
    run("draw", source, "-o", target)
    visible = target.read_text().count("data-link=")
    assert visible > 4 * 3
    run("fold", source, "--frames", "2", "-o", tmp_path / "strip.svg")
    run("convert", source, tmp_path / "thick.obj")
    text = (tmp_path / "thick.obj").read_text()
    assert text.count("\no ") == len(thick.plates.meshes)
