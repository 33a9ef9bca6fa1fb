"""Pictures of poses: which panels are painted last, which side is seen, how many poses there are."""

from dataclasses import replace

import numpy as np
import pytest
from commands import run
from PIL import Image

from graphs.errors import FileError
from graphs.files.formats import write
from graphs.mechanism.sheet import Sheet
from synth.making.drawing.scene.shapes import Polygon
from synth.making.drawing.space.motion_files import frame_scenes, save_moving_frames, strip_of_frames
from synth.making.drawing.space.panels import same_side_up

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
ABOVE = SQUARE + np.array([0, 0, 0.2])
PAIR = Sheet(8, (), "", ((4, 5, 6, 7), (0, 1, 2, 3)))
ONE = Sheet(4, (), "", ((0, 1, 2, 3),))
STRIP = Sheet(6, ((1, 4),), "V", ((0, 1, 4, 3), (2, 1, 4, 5)))
FLAT = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0.0]])


def panels(scene):
    """The panels of a picture from behind to before, without shadows."""
    return [shape for shape in scene.layers[0].shapes if isinstance(shape, Polygon) and shape.opacity == 1]


def test_the_panel_in_front_is_painted_last():
    low_first, high_first = (
        next(frame_scenes(PAIR, np.concatenate(pair)[None])) for pair in ([SQUARE, ABOVE], [ABOVE, SQUARE])
    )
    heights = [[min(y for _, y in shape.points) for shape in panels(one)] for one in (low_first, high_first)]
    assert heights[0][0] > heights[0][1]  # higher up on the paper, where y is less
    assert heights[1] == pytest.approx(heights[0])


def test_of_a_flat_sheet_one_side_is_seen_and_of_a_turned_one_the_other():
    """Though the file goes round its two panels in opposite senses."""
    for faces in (STRIP.faces, tuple(face[::-1] for face in STRIP.faces)):
        scenes = frame_scenes(replace(STRIP, faces=faces), np.stack([FLAT, FLAT * [1, -1, -1]]))
        assert [{shape.fill for shape in panels(scene)} for scene in scenes] == [{"front"}, {"back"}]


def test_faces_of_several_pieces_are_each_turned_as_their_first():
    assert same_side_up([(0, 1, 2), (7, 8, 9), (0, 1, 3), (7, 8, 5)]) == [(0, 1, 2), (7, 8, 9), (3, 1, 0), (5, 8, 7)]


def test_a_panel_edge_on_to_the_light_is_darker():
    lying = SQUARE @ np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    standing = SQUARE @ np.array([[1, 0, 0], [0, 0, 1], [0, 1, 0.0]])
    shades = [
        next(shape.opacity for shape in scene.layers[0].shapes if getattr(shape, "fill", "") == "shadow")
        for scene in frame_scenes(ONE, np.stack([lying, standing]))
    ]
    assert 0 < shades[0] < shades[1] < 1


def test_a_strip_has_twelve_poses_at_most():
    poses = np.stack([SQUARE + np.array([0, 0, k]) for k in range(40)])
    numbers = [label.text for label in strip_of_frames(ONE, poses).layers[-2].shapes]
    assert len(numbers) == 12
    assert (numbers[0], numbers[-1]) == ("0", "39")


def test_the_command_writes_a_strip_without_matplotlib(tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "matplotlib", None)
    corners = ((0, 0), (1, 0), (0.5, 1), (-1, 0), (0.5, -1))
    faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    write(Sheet(5, ((0, 1), (0, 2), (0, 3), (0, 4)), "MVVV", faces, corners), tmp_path / "a.fold")
    run("fold", tmp_path / "a.fold", "--drive", "1=90", "--frames", 3, "-o", tmp_path / "a.svg")
    text = (tmp_path / "a.svg").read_text()
    assert text.count('<g class="panels">') == 4
    assert 'data-joint="0"' in text


def test_a_moving_picture_goes_there_and_back(tmp_path):
    poses = np.stack([SQUARE * [1, 1 - k / 8, 1] for k in range(3)])
    place = tmp_path / "square.gif"
    save_moving_frames(ONE, poses, place)
    with Image.open(place) as picture:
        assert picture.n_frames == 4
        shown = []
        for frame in range(4):
            picture.seek(frame)
            shown.append(np.asarray(picture.convert("RGB")).astype(int))
    areas = [(np.abs(image - image[0, 0]).sum(axis=2) > 15).sum() for image in shown]
    assert areas[0] > areas[1] > areas[2]
    assert areas[3] == areas[1]
    with pytest.raises(FileError, match="exists already"):
        save_moving_frames(ONE, poses, place)
