"""The unit that a file names is that of the template, and of the solids."""

import json

import numpy as np
import pytest
from commands import run
from measured import lengths, lines_of_svg

SQUARE = {
    "file_spec": 1.2,
    "vertices_coords": [[0, 0], [6, 0], [6, 6], [0, 6]],
    "edges_vertices": [[0, 2]],
    "edges_assignment": ["V"],
    "faces_vertices": [[0, 1, 2], [0, 2, 3]],
}


@pytest.fixture
def square(tmp_path):
    def made(unit, frames=()):
        given = {} if unit is None else {"frame_unit": unit}
        (tmp_path / "a.fold").write_text(json.dumps({**SQUARE, **given, "file_frames": list(frames)}))
        return tmp_path / "a.fold"

    return made


@pytest.mark.parametrize(("unit", "side"), [("cm", 60), ("in", 152.4), ("mm", 6), ("pt", 6 * 25.4 / 72), ("m", 6000)])
def test_edges_are_as_long_as_the_unit_of_the_file_says(unit, side, square, tmp_path):
    words = ("template", square(unit), "--page", "200x200", "--no-note", "-o", tmp_path / "a.svg")
    if side < 10:
        assert "mm; try a larger --scale" in run(*words, code=2).stderr
    elif side > 1000:
        assert "at most 500" in run(*words, code=2).stderr
    else:
        assert run(*words).stderr == ""
        assert lengths(lines_of_svg(tmp_path / "a.svg")[0]["CUT"]) == pytest.approx([side] * 4, abs=0.01)


def test_what_is_asked_for_goes_before_the_unit_of_the_file(square, tmp_path):
    for number, words in enumerate((("--scale", 20), ("--size", 120))):
        place = tmp_path / f"{number}.svg"
        run("template", square("in"), *words, "--no-note", "-o", place)
        assert lengths(lines_of_svg(place)[0]["CUT"]) == pytest.approx([120] * 4, abs=0.01)


@pytest.mark.parametrize("unit", [None, "unit"])
def test_without_a_unit_the_longer_side_is_150_mm_and_the_scale_is_printed(unit, square, tmp_path):
    told = run("template", square(unit), "--no-note", "-o", tmp_path / "a.svg").stderr
    of_unit = "the longer side is 150 mm, 25 mm per unit"
    assert told == f"the file names no unit: {of_unit}; --scale or --size changes it\n"
    assert lengths(lines_of_svg(tmp_path / "a.svg")[0]["CUT"]) == pytest.approx([150] * 4, abs=0.01)


def test_a_unit_that_nobody_knows_asks_for_a_size(square, tmp_path):
    words = ("template", square("cubit"), "--no-note", "-o", tmp_path / "a.svg")
    assert "unit is 'cubit'; expected mm" in run(*words, code=2).stderr
    run(*words, "--size", 60)
    assert "the name of a unit" in run("template", square(3), "-o", tmp_path / "b.svg", code=2).stderr


def test_solids_take_the_unit_of_the_file_too(square, tmp_path):
    run("convert", square("cm"), tmp_path / "a.obj", "--thickness", 1)
    corners = np.array([
        row.split()[1:] for row in (tmp_path / "a.obj").read_text().splitlines() if row.startswith("v ")
    ]).astype(float)  # fmt: skip
    assert np.ptp(corners, axis=0) == pytest.approx([60, 60, 1], abs=1e-6)
