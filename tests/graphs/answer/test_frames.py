"""``--pose``: all numbers of an answer are those of one frame."""

import json

import pytest

from graphs.answer.mobility import counts_and_ranks
from graphs.files.formats import read

FAN = {
    "vertices_coords": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]],
    "edges_vertices": [[0, 1], [0, 2], [0, 3], [0, 4]],
    "edges_assignment": ["M", "V", "V", "V"],
    "faces_vertices": [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]],
}
LESS = {  # the same sheet with a crease unfolded, folded at the others
    "frame_inherit": True,
    "frame_parent": 0,
    "vertices_coords": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0.3], [0, -1, 0.4]],
    "edges_assignment": ["M", "F", "V", "V"],
}


@pytest.fixture
def sheet(tmp_path):
    (tmp_path / "a.fold").write_text(json.dumps(FAN | {"file_frames": [LESS]}), encoding="utf-8")
    return read(tmp_path / "a.fold")


def test_counts_and_ranks_are_those_of_the_frame(sheet):
    key, other = counts_and_ranks(sheet, frame=0), counts_and_ranks(sheet, frame=1)
    assert (key.links, key.joints, key.exact.mobility) == (4, 4, 1)
    assert (other.links, other.joints, other.exact.mobility) == (3, 3, 0)
    alone = counts_and_ranks(sheet.frames.frame(1))
    assert (other.counts, other.equations, other.infinitesimal.dof) == (
        alone.counts,
        alone.equations,
        alone.infinitesimal.dof,
    )
    assert other.overconstraint == other.infinitesimal.dof - other.mobility


def test_it_is_said_whose_numbers_they_are(sheet):
    note = "all numbers are those of frame 1"
    assert note in counts_and_ranks(sheet, frame=1).warnings
    assert note not in counts_and_ranks(sheet).warnings
    assert any("with flat edges hinged: links 4" in line for line in counts_and_ranks(sheet, frame=1).warnings)
