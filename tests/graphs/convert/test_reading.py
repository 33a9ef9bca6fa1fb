"""Repairs have places: each is where the drawing was made so, however it is turned and scaled."""

import json
from dataclasses import replace

import numpy as np
import pytest

from graphs.answer.mobility import counts_and_ranks
from graphs.convert.tracing import Lines, trace_sheet
from graphs.files.formats import read

SQUARE = [((0, 0), (10, 0)), ((10, 0), (10, 10)), ((10, 10), (0, 10)), ((0, 10), (0, 0))]


def traced(drawn, turn=0.0, scale=1.0):
    """The places of a drawing that was turned and scaled, turned and scaled back; points of a place in order."""
    letters, ends = zip(*drawn, strict=True)
    rotation = scale * np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    sheet = trace_sheet(Lines(np.array(ends, dtype=float) @ rotation.T, "".join(letters)))
    back = np.linalg.inv(rotation).T
    return sheet, {
        repair.kind: sorted(sorted(map(tuple, (np.array(place) @ back).round(6) + 0.0)) for place in repair.places)
        for repair in sheet.reading.repairs
    }


BORDER = [("B", side) for side in SQUARE]
DRAWINGS = {
    "crossing": (
        [("M", ((0, 0), (10, 10))), ("V", ((0, 10), (10, 0))), ("M", ((0, 2), (10, 2)))],
        {"crossing split": [[(2, 2)], [(5, 5)], [(8, 2)]], "line split at an end": [[(0, 2)], [(10, 2)]]},
    ),
    "twice": (
        [("M", ((0, 0), (10, 10))), ("V", ((10, 10), (0, 0))), ("V", ((10, 0), (10, 10)))],
        {"line drawn twice": [[(0, 0), (10, 10)], [(10, 0), (10, 10)]]},
    ),
    "pruned": (
        [("M", ((0, 0), (10, 10))), ("V", ((0, 4), (2, 4))), ("V", ((12, 3), (11, 3)))],
        {
            "line pruned": [[(0, 4), (2, 4)], [(11, 3), (12, 3)]],
            "line split at an end": [[(0, 4)]],
            "vertex taken out": [[(0, 4)]],
        },
    ),
    "no length": ([("M", ((0, 0), (10, 10))), ("V", ((3, 7), (3, 7)))], {"line of no length": [[(3, 7), (3, 7)]]}),
    "welded": (
        [("M", ((0, 0), (10, 9.99))), ("V", ((0.004, 9.997), (10, 0)))],
        {"crossing split": None, "ends welded": [[(0, 10)], [(10, 10)]]},
    ),
    "hole": (
        [
            *(("B", side) for side in [((4, 4), (6, 4)), ((6, 4), (5, 6)), ((5, 6), (4, 4))]),
            *(("M", line) for line in [((0, 0), (4, 4)), ((10, 0), (6, 4)), ((5, 6), (5, 10))]),
        ],
        {"hole": [[(4, 4), (5, 6), (6, 4)]], "line split at an end": [[(5, 10)]]},
    ),
}


@pytest.mark.parametrize("name", DRAWINGS)
@pytest.mark.parametrize(("turn", "scale"), [(0.0, 1.0), (0.7, 30.0)])
def test_each_repair_is_where_it_was_drawn(name, turn, scale):
    drawn, expected = DRAWINGS[name]
    sheet, places = traced(BORDER + drawn, turn, scale)
    assert set(places) == set(expected)
    for kind, where in expected.items():
        if where is not None:
            np.testing.assert_allclose(np.array(places[kind]), np.array(sorted(map(sorted, where))), atol=1e-4)
    counted = {repair.kind: repair for repair in sheet.reading.repairs if repair.what[0].isdigit()}
    assert all(repair.what.startswith(f"{len(repair.places)} ") for repair in counted.values())
    assert sheet.repairs == tuple(repair.what for repair in sheet.reading.repairs)
    assert sheet == replace(sheet, reading=None)


def test_an_answer_has_the_places_and_first_of_all_what_was_left_out(tmp_path):
    lines = "".join(f'<path d="M0 {y}h10" stroke="red"/>' for y in (1, 2, 3, 4, 5))
    path = tmp_path / "a.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg"><rect width="10" height="10" stroke="black"/>'
        f'{lines}<path d="M2 0v10" stroke="blue"/><path d="M0 0L1 1" stroke="orange"/></svg>'
    )
    answer = counts_and_ranks(read(path))
    told = str(answer).splitlines()
    assert told[0].startswith("1 shape with strokes not understood left out: 1 #ffa500; state what they are by")
    [line] = [row for row in told if "crossings" in row]
    assert line == "repaired: 5 crossings split: at (2, -1), at (2, -2), at (2, -3) and 2 more"
    reading = json.loads(json.dumps(answer.to_json()))["reading"]
    assert reading["left_out"] in told[0]
    [crossed] = [one for one in reading["repairs"] if one["kind"] == "crossing split"]
    assert sorted(crossed["places"]) == [[[2, -y]] for y in (5, 4, 3, 2, 1)]
