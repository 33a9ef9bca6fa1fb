"""Coordinates that reach too far, lie too close together or in one line; and all sizes between, which agree."""

import json

import numpy as np
import pytest
from sizes import slow

import synth
from graphs.errors import FileError, InvariantError
from graphs.input_limits import LEAST, MOST, check_area, check_extent
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids

SQUARE = ((0, 0), (1, 0), (1, 1), (0, 1))
FACES = ((0, 1, 2), (0, 2, 3))


def sized(data, size, name="bird-base"):
    document = json.loads((data / "patterns" / f"{name}.fold").read_text(encoding="utf-8"))
    return document | {"vertices_coords": [[size * x for x in place] for place in document["vertices_coords"]]}


def square(*places):
    return Sheet(4, (), "", FACES, places)


@pytest.mark.parametrize(
    ("size", "told"),
    [
        (1e160, "a coordinate is 1e+160; expected an extent of 1e-50 to 1e+50"),
        (1e-300, "the extent is 2e-300; expected an extent of 1e-50 to 1e+50"),
        (0.0, "the pattern has no area: all its vertices lie in one place"),
    ],
)
def test_a_pattern_of_no_size_is_one_line(size, told, data, tmp_path):
    (tmp_path / "a.fold").write_text(json.dumps(sized(data, size)))
    with pytest.raises(FileError) as refused:
        synth.read(tmp_path / "a.fold")
    assert str(refused.value) == f"{tmp_path / 'a.fold'}: {told}"


def test_a_pattern_in_one_line_has_no_area():
    with pytest.raises(InvariantError, match="no area: all its vertices lie in one line"):
        square((0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (3.0, 3.0))


@pytest.mark.parametrize("factor", [0.3 * MOST, 3 * LEAST])
@pytest.mark.parametrize("name", ["four-bar-vertex", slow("bird-base")])
def test_answers_do_not_depend_on_the_size(name, factor, data, tmp_path):
    answers = []
    for size in (1.0, factor):
        (tmp_path / "a.fold").write_text(json.dumps(sized(data, size, name)))
        sheet = synth.read(tmp_path / "a.fold")
        verdict, explained = synth.mobility(sheet), synth.explain(sheet)
        folded = synth.fold(sheet, frames=2)
        answers.append([str(one).splitlines()[0] for one in (verdict, explained, folded)])
    assert answers[0] == answers[1]


@pytest.mark.parametrize(
    "make",
    [
        lambda: square((0, 0), (1, 0), (1, 1), (0, 1e51)),
        lambda: square((0, 0), (1, 0), (1, 1), (0, float("nan"))),
        lambda: square(*((1e-60 * x, 1e-60 * y) for x, y in SQUARE)),
        lambda: square((0, 0), (1, 1), (2, 2), (3, 3 + 1e-13)),
        lambda: PolyhedronModel(2, [(0, 1)], coordinates={0: (0, 0, 0), 1: (0, 0, 1e160)}),
        lambda: HingedSolids(synth.SCGraph(2, [(0, 1)]), {0: ((0, 0, 1e60), (0, 0, 1))}),
    ],
)
def test_no_object_is_out_of_range(make):
    with pytest.raises(InvariantError, match=r"extent|area|none beyond"):
        make()


def test_what_is_narrow_or_without_faces_is_not_refused():
    assert square((0, 0), (1e9, 0), (1e9, 1), (0, 1)).coordinates is not None
    assert Sheet(2, ((0, 1),), "B", (), ((0, 0), (1, 0))).faces == ()


def test_many_points_are_checked_as_few_are():
    """An array of them decides only what is clear."""
    chance = np.random.default_rng(0)
    plane = chance.uniform(-3.0, 5.0, (2000, 2))
    for points in (plane, plane * 1e40, plane * 1e-40, np.hstack([plane, plane[:, :1]])):
        rows = list(map(tuple, points.tolist()))
        assert check_extent(rows) == pytest.approx(np.ptp(points, axis=0).max(), rel=1e-15)
        check_area(rows)
    line = list(map(tuple, (plane[:, :1] * [1.0, 2.0]).tolist()))
    with pytest.raises(InvariantError, match="all its vertices lie in one line"):
        check_area(line)
    with pytest.raises(InvariantError, match="all its vertices lie in one place"):
        check_area([(1.0, 1.0)] * 2000)
    for wrong in (1e60, float("inf"), float("nan")):
        with pytest.raises(InvariantError, match="a coordinate is"):
            check_extent([*line, (wrong, 0.0)])
    with pytest.raises(InvariantError, match="the extent is"):
        check_extent(list(map(tuple, (plane * 1e-60).tolist())))
