"""Panels keep their shape in every frame, and loops close: patterns of other people, the project's own, bad input."""

import numpy as np
import pytest
from commands import run
from real_patterns import folder_of_patterns, names_of_patterns

from graphs.errors import SynthedraError
from graphs.files.formats import read
from graphs.mechanism.sheet import Sheet
from synth.analysis.folding.motion import fold
from synth.analysis.motion.closure import ClosureEquations

MOST_EDGES = 700
SEARCHES = {"oe_glitch.cp", "ossvg_flappingBird.svg"}
"""Patterns whose branches take more than a minute to look for."""


def bent(folded):
    """By how much distances of corners of one face change, at most, in units of the size of the sheet."""
    size = np.ptp(folded.places[0], axis=0).max()
    worst = 0.0
    for face in folded.configuration.sheet.faces:
        corners = folded.places[:, list(face)]
        apart = np.linalg.norm(corners[:, :, None] - corners[:, None], axis=-1)
        worst = max(worst, float(np.abs(apart - apart[0]).max()))
    return worst / size


def check(folded):
    assert bent(folded) < 1e-12
    assert folded.apart <= 1e-10
    closure = ClosureEquations(folded.linkage)
    assert max(closure.error(angles) for angles in folded.path.angles) == folded.closure <= 1e-12


@pytest.mark.parametrize("name", ["four-bar-vertex.fold", pytest.param("bird-base.fold", marks=pytest.mark.slow)])
def test_panels_of_our_own_patterns_are_rigid(data, name):
    folded = fold(read(data / "patterns" / name), frames=3)
    check(folded)
    assert len(folded.path.angles) == 4


@pytest.mark.slow
@pytest.mark.parametrize("name", names_of_patterns())
def test_panels_are_rigid_in_every_pattern_that_closes(name):
    """Or there is one line that says why it does not fold."""
    try:
        thing = read(folder_of_patterns() / name)
    except SynthedraError:
        pytest.skip("cannot be read")
    if not isinstance(thing, Sheet):
        pytest.skip("no crease pattern")
    sheet = thing.frames.first_placed() if thing.frames is not None else thing
    if len(sheet.edges) > MOST_EDGES or name in SEARCHES:
        pytest.skip("takes long")
    try:
        folded = fold(sheet, frames=4)
    except SynthedraError as error:
        assert str(error)
        assert "\n" not in str(error)
        return
    check(folded)
    assert len(folded.path.angles) >= 5 or folded.path.stopped


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--drive", "11=10"], "'11' is no joint; expected one of"),
        (["--drive", "1=20"], "'1' is no joint; expected one of 0, 2, 4, 6"),
        (["--drive", "2=190"], "is driven to 190°; expected between -180 and 180"),
        (["--drive", "2=nan"], "expected between -180 and 180"),
        (["--drive", "=3"], "is not JOINT=DEGREES"),
        (["--drive", "2=30,5=40"], "one JOINT=DEGREES at a time; try --drive once for each"),
        (["--branch", "+++++"], "no branch has the signs '+++++'"),
        (["--branch", "99"], "there is no branch 99; expected one from 0 to 0"),
        (["-o", "out.bmp"], "files ending in '.bmp' are not known; expected one of .fold .obj .gif .png .svg"),
    ],
)
def test_bad_input_is_told_in_one_line(data, words, told):
    result = run("fold", data / "patterns" / "four-bar-vertex.fold", *words, code=2)
    assert told in result.stderr
    assert "Traceback" not in result.stderr


def test_a_sheet_without_coordinates_does_not_fold(tmp_path):
    place = tmp_path / "bare.fold"
    place.write_text('{"faces_vertices": [[0, 1, 2], [2, 1, 3]], "edges_vertices": [[1, 2]]}', encoding="utf-8")
    assert "requires coordinates" in run("fold", place, code=2).stderr
