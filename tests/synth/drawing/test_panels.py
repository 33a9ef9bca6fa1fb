"""Pictures of panels: which are painted last, which side is seen, how many poses there are."""

import numpy as np
import pytest
from PIL import Image

from graphs.errors import FileError
from synth.drawing.panels import draw_poses, save_moving_poses

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
ABOVE = SQUARE + np.array([0, 0, 0.2])
FACES = [(4, 5, 6, 7), (0, 3, 2, 1)]


def painted(figure, pose=0):
    return figure.axes[pose].collections[0]


def test_the_panel_in_front_is_painted_last():
    low_first = painted(draw_poses(FACES, np.concatenate([SQUARE, ABOVE])[None]))
    high_first = painted(draw_poses(FACES, np.concatenate([ABOVE, SQUARE])[None]))
    heights = [[path.vertices[:, 1].mean() for path in one.get_paths()] for one in (low_first, high_first)]
    assert heights[0][0] < heights[0][1]  # higher up on the paper
    assert heights[1] == pytest.approx(heights[0])


def test_of_a_flat_sheet_one_side_is_seen_and_of_a_turned_one_the_other():
    flat = np.concatenate([SQUARE, SQUARE + np.array([1, 0, 0])])
    turned = flat * [1, -1, -1]
    figure = draw_poses(FACES, np.stack([flat, turned]))
    colours = [painted(figure, pose).get_facecolor() for pose in range(2)]
    for pose in colours:
        np.testing.assert_allclose(pose[0], pose[1])
    assert colours[0][0][2] > colours[0][0][0]  # blue
    assert colours[1][0][2] < colours[1][0][0]


def test_a_strip_has_twelve_poses_at_most():
    poses = np.stack([SQUARE + np.array([0, 0, k]) for k in range(40)])
    titles = [axes.get_title() for axes in draw_poses([(0, 1, 2, 3)], poses).axes]
    assert len(titles) == 12
    assert (titles[0], titles[-1]) == ("0", "39")


def test_a_moving_picture_goes_there_and_back(tmp_path):
    poses = np.stack([SQUARE * [1, 1 - k / 8, 1] for k in range(3)])
    place = tmp_path / "square.gif"
    save_moving_poses([(0, 1, 2, 3)], poses, place)
    with Image.open(place) as picture:
        assert picture.n_frames == 4
        shown = []
        for frame in range(4):
            picture.seek(frame)
            shown.append(np.asarray(picture.convert("RGB")).astype(int))
    areas = [(np.abs(image - image[0, 0]).sum(axis=2) > 30).sum() for image in shown]
    assert areas[0] > areas[1] > areas[2]
    assert areas[3] == areas[1]
    with pytest.raises(FileError, match="exists already"):
        save_moving_poses([(0, 1, 2, 3)], poses, place)
