"""Mechanisms in other configurations than their file's: frames, and joints at stated angles."""

import json

import numpy as np
import pytest
from commands import run

import synth
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read, write
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sheet import Sheet
from synth.analysis.moving.motion import configurations_of_file
from synth.making.drawing.space.captions import FoldedStates
from synth.making.drawing.space.motion_files import write_motion


@pytest.fixture(scope="module")
def vertex(data):
    return data / "patterns" / "four-bar-vertex.fold"


@pytest.fixture(scope="module")
def bird(data):
    return data / "patterns" / "bird-base.fold"


@pytest.fixture(scope="module")
def folded(bird, tmp_path_factory):
    place = tmp_path_factory.mktemp("frames") / "folded.fold"
    run("fold", bird, "--drive", "0=60", "--frames", 4, "-o", place)
    return place


def test_angles_are_those_that_folding_reaches(bird):
    there = synth.in_configuration(bird, angles={0: np.radians(60)})
    motion = synth.fold(bird, drive={0: np.radians(60)})
    np.testing.assert_allclose(there.coordinates, motion.places[-1], atol=1e-12)
    assert there.fold_angles[0] == pytest.approx(np.radians(60), abs=1e-12)


def test_a_file_of_a_motion_rests_in_its_last_pose(folded, bird):
    sheet = read(folded)
    last = synth.fold(bird, drive={0: np.radians(60)}, frames=4).places[-1]
    np.testing.assert_allclose(sheet.coordinates, last, atol=1e-12)
    assert sheet.frames.others == 5
    for frame, height in ((0, True), (1, False), ("last", True)):
        coordinates = np.array(synth.in_configuration(sheet, frame).coordinates)
        assert bool(np.ptp(coordinates[:, 2]) > 0.1) is height
    of_file = configurations_of_file(sheet)
    assert (len(of_file.sheets), of_file.resting, of_file.left_out) == (5, 4, 0)


def test_a_motion_that_ends_flat_rests_in_the_pattern(tmp_path):
    corners = ((0, 0), (2, 0), (2, 1), (0, 1), (3, 0), (3, 1))
    flat = Sheet(6, ((1, 2),), "V", ((0, 1, 2, 3), (1, 4, 5, 2)), corners)
    motion = synth.fold(flat, drive={0: np.pi}, frames=3)
    assert motion.path.angles[-1] == pytest.approx([np.pi])
    place = tmp_path / "flat.fold"
    write_motion(motion, place)
    np.testing.assert_allclose(np.array(read(place).coordinates)[:, :2], np.array(flat.coordinates)[:, :2], atol=1e-12)


def test_solids_and_rods_keep_their_shape():
    four_bar = synth.generate("four-bar").mechanism
    there = synth.in_configuration(four_bar, angles={0: 0.3})
    back = synth.in_configuration(there, angles={0: -0.3})
    for joint, (_, direction) in four_bar.axes.items():
        turned = np.array(back.axes[joint][1])
        np.testing.assert_allclose(turned, np.array(direction) / np.linalg.norm(direction), atol=1e-9)
    corners = {0: (0, 0, 0), 1: (1, 0, 0), 2: (1.2, 1, 0.3), 3: (0, 1, 0)}
    rods = PolyhedronModel(4, [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2)], coordinates=corners)
    motion = synth.move(rods, frames=12)
    joint = next(iter(motion.driven))
    angle = motion.path.angles[1, motion.joints.index(joint)]
    moved = synth.in_configuration(rods, angles={joint: angle})
    lengths = [
        [np.linalg.norm(np.subtract(model.coordinates[a], model.coordinates[b])) for a, b in model.edges]
        for model in (rods, moved)
    ]
    np.testing.assert_allclose(*lengths, atol=1e-12)
    distances = [np.linalg.norm(np.subtract(model.coordinates[1], model.coordinates[3])) for model in (rods, moved)]
    assert abs(distances[0] - distances[1]) > 1e-3


def test_what_is_refused(vertex, folded):
    with pytest.raises(InvariantError, match="has no frames"):
        synth.in_configuration(synth.generate("miura").mechanism, 1)
    with pytest.raises(UnsolvableError, match="requires coordinates"):
        synth.in_configuration("k1:Cr", angles={0: 1.0})
    carton = synth.generate("miura", rows=2, columns=2).mechanism
    first, second, *_ = synth.fold(carton, frames=1).joints
    with pytest.raises(UnsolvableError):  # one freedom, and two joints out of proportion
        synth.in_configuration(carton, angles={first: 1.0, second: -0.1})
    for words, said in (
        (("x",), "neither one frame"),
        (("1", "2"), "neither one frame"),
        (("9",), "no frame 9"),
        (("9=3",), "is no joint"),
    ):
        text = run("look", vertex, *(part for word in words for part in ("--at", word)), code=2).output
        assert said in text
    assert "expected a frame from 0 to 5" in run("look", folded, "--at", 77, code=2).output


@pytest.mark.parametrize("words", [("states", "--joint", 3), ("explain",), ("positions", "--drive", "2=40")])
def test_commands_answer_for_the_configuration(words, vertex, tmp_path):
    name, *more = words
    more = [0 if word == 3 else word for word in more]
    direct = run(name, vertex, *more, "--at", "2=45", "--json", code=0).stdout
    write(synth.in_configuration(vertex, angles={2: np.radians(45)}), tmp_path / "there.fold")
    by_file = run(name, tmp_path / "there.fold", *more, "--json").stdout
    one, other = (json.loads(text) for text in (direct, by_file))
    of_file = {"file", "configuration"}  # how the coordinates are written there
    assert {key: one[key] for key in one.keys() - of_file} == {key: other[key] for key in other.keys() - of_file}


def test_files_are_written_in_the_configuration(vertex, bird, folded, tmp_path):
    run("convert", vertex, tmp_path / "there.fold", "--at", "2=45")
    assert read(tmp_path / "there.fold").fold_angles[2] == pytest.approx(np.pi / 4)
    run("edit", vertex, "--at", "2=45", "--lock", 2, "-o", tmp_path / "locked.fold")
    np.testing.assert_allclose(
        read(tmp_path / "locked.fold").coordinates, read(tmp_path / "there.fold").coordinates, atol=1e-12
    )
    run("template", folded, "--at", 1, "-o", tmp_path / "flat.dxf")
    run("template", bird, "-o", tmp_path / "drawn.dxf")
    assert (tmp_path / "flat.dxf").read_text() == (tmp_path / "drawn.dxf").read_text()


def test_pictures_of_frames_say_their_angles(folded, tmp_path):
    labels = [label.text for label in synth.draw(folded).labels()]
    sheet = read(folded)
    states = FoldedStates(configurations_of_file(sheet).sheets)
    crease = list(states.mechanism.hinges)[states.most_folded]
    written = [np.degrees(sheet.frames.frame(frame).fold_angles[crease]) for frame in range(1, 6)]
    assert [text for text in labels if "°" in text] == [f"{k}: {angle:.4g}°" for k, angle in enumerate(written)]
    assert f"fold angles of crease {crease}, which is folded most" in labels
    assert any("seen from the direction (" in text for text in labels)
    single = [label.text for label in synth.draw(synth.in_configuration(folded, 3), "folded").labels()]
    assert f"largest fold angle: {written[2]:.4g}° at crease {crease}" in single
    run("draw", folded, "--at", "last", "-o", tmp_path / "last.svg")
    assert "frames by number" not in (tmp_path / "last.svg").read_text()


def test_pictures_say_where_panels_cross(data):
    bird = data / "patterns" / "bird-base.fold"
    motion = synth.fold(bird, branch=3, frames=8)
    states = FoldedStates(motion.frames())
    assert states.crossing == motion.crossing


def test_springs_of_a_flat_sheet_are_told_the_option(bird):
    text = run("states", bird, "--stiffness", "3=1", code=2).output
    option = text.rsplit("try ", 1)[1].split(",")[0].split()
    assert option[0] == "--at"
    assert "equilibrium of the springs" in run("states", bird, "--stiffness", "3=1", *option).stdout
    assert "try --at" in run("states", bird, "--joint", 3).stdout
