"""A sheet that lies flat is flat however its plane stands."""

import json

import numpy as np
import pytest

from graphs.answer.mobility import counts_and_ranks
from graphs.files.formats import read, write
from graphs.mechanism.precision import flattened, off_plane
from graphs.mechanism.sheet import Sheet

FAN = {
    "vertices_coords": [[0, 0], [3, 0], [3, 2], [0, 2], [1, 1]],
    "edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]],
    "edges_assignment": list("BBBBMMMV"),
    "faces_vertices": [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
}
TILTS = {
    "xy": (lambda x, y: (x, y, 7.0), ""),
    "a little off xy": (lambda x, y: (x, y, 2e-6 * x * y), "flattened: points were a little off the xy plane"),
    "xz": (lambda x, y: (x, 5.0, y), "turned from the xz plane into the xy plane"),
    "yz": (lambda x, y: (-2.0, x, y), "turned from the yz plane into the xy plane"),
    "slanted": (lambda x, y: (0.6 * x + 1, y, 0.8 * x), "turned from a slanted plane into the xy plane"),
}


def sheet_of(points, faces=()):
    return Sheet(len(points), (), "", tuple(map(tuple, faces)), tuple(points))


def distances(points):
    points = np.array(points)
    return np.linalg.norm(points[:, None] - points[None], axis=-1)


def area(points, face):
    x, y = np.array(points)[list(face)].T
    return x @ np.roll(y, -1) - y @ np.roll(x, -1)


@pytest.mark.parametrize("name", TILTS)
def test_distances_and_the_side_that_is_seen_are_kept(name):
    tilt, told = TILTS[name]
    points = [tilt(*p) for p in FAN["vertices_coords"]]
    flat = flattened(sheet_of(points, FAN["faces_vertices"]))
    assert flat.turned == told
    assert distances(flat.places) == pytest.approx(distances(FAN["vertices_coords"]))
    assert all(area(flat.places, face) > 0 for face in FAN["faces_vertices"])
    if told.startswith("turned"):
        other_side = flattened(sheet_of(points, [face[::-1] for face in FAN["faces_vertices"]]))
        assert all(area(other_side.places, face) < 0 for face in FAN["faces_vertices"])


@pytest.mark.parametrize("name", TILTS)
@pytest.mark.parametrize("suffix", [".svg", ".cp"])
def test_flat_formats_take_sheets_flat_in_any_plane(name, suffix, tmp_path):
    tilt, told = TILTS[name]
    (tmp_path / "a.fold").write_text(json.dumps(FAN | {"vertices_coords": [tilt(*p) for p in FAN["vertices_coords"]]}))
    sheet = read(tmp_path / "a.fold")
    assert counts_and_ranks(sheet).infinitesimal.flat
    lost = write(sheet, tmp_path / f"a{suffix}")
    assert [line for line in lost if "plane" in line] == ([f"the pose in space: {told}"] if told else [])
    again = counts_and_ranks(read(tmp_path / f"a{suffix}"))
    assert (again.links, again.joints, again.mobility) == (4, 4, 1)


@pytest.mark.parametrize("name", TILTS)
def test_faces_are_traced_in_any_plane(name, tmp_path):
    tilt, told = TILTS[name]
    document = {k: v for k, v in FAN.items() if k != "faces_vertices"}
    document["vertices_coords"] = [tilt(*p) for p in FAN["vertices_coords"]]
    (tmp_path / "a.fold").write_text(json.dumps(document))
    sheet = read(tmp_path / "a.fold")
    assert sheet.repairs == (("faces traced", told) if told else ("faces traced",))
    assert (counts_and_ranks(sheet).links, counts_and_ranks(sheet).joints) == (4, 4)


def test_numbers_of_any_size_lie_in_a_plane():
    bent = sheet_of([(0, 0, 0), (1e49, 0, 1e49), (0, 1e49, 0), (1e49, 1e49, 0)])
    assert flattened(bent) is None
    assert repr(bent).endswith("in space>")
    assert flattened(sheet_of([(0, 0, 0), (1e40, 0, 1e40), (0, 1e40, 0)])).turned.startswith("turned")
    assert flattened(Sheet(3, (), "", ((0, 1, 2),))) is None


def test_rounded_coordinates_are_flat_here_as_they_are_to_the_pose(tmp_path):
    """A slanted fan with two decimals is off its plane by a thousandth; one that is folded more is folded."""
    for fold, flat in ((0.0, True), (0.1, False)):
        points = [
            tuple(round(z, 2) for z in (0.61 * x + 1, 0.97 * y, 0.83 * x + 0.23 * y + fold * (x > 2)))
            for x, y in FAN["vertices_coords"]
        ]
        (tmp_path / "a.fold").write_text(json.dumps(FAN | {"vertices_coords": points}))
        sheet = read(tmp_path / "a.fold")
        assert (counts_and_ranks(sheet).infinitesimal.flat, flattened(sheet) is not None) == (flat, flat)


def test_three_points_lie_in_a_plane_and_a_fourth_may_not():
    corners = np.vstack([np.zeros(3), np.eye(3)[:2]])
    assert off_plane(corners) == 0.0
    assert off_plane(np.vstack([corners, [1.0, 1.0, 0.5]])) > 0.1
