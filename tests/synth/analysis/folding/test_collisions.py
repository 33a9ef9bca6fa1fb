"""Panels that pass through each other: closed forms of strips and open vertices, edges that pierce triangles."""

import json
from dataclasses import replace

import numpy as np
import pytest
from commands import run
from sizes import slow

from graphs.files.formats import write
from graphs.mechanism.sheet import Sheet
from synth.analysis.folding import panel_collisions
from synth.analysis.folding.motion import fold
from synth.analysis.folding.panel_collisions import PanelShapes
from synth.catalogue.patterns.creases import miura

TRIANGLES = [(0, 1, 2), (3, 4, 5)]


def strip(*lengths, across=1.0):
    """Rectangles in a row, hinged; joints 0, 1, ..."""
    at = np.concatenate([[0.0], np.cumsum(lengths)])
    n = len(at)
    faces = tuple((k, k + 1, n + k + 1, n + k) for k in range(n - 1))
    edges = tuple((k, n + k) for k in range(1, n - 1))
    return Sheet(2 * n, edges, "V" * len(edges), faces, tuple((x, y) for y in (0.0, across) for x in at))


def open_vertex(*sectors):
    """Panels about a vertex that is cut open."""
    directions = np.concatenate([[0.0], np.cumsum(np.radians(sectors))])
    places = ((0.0, 0.0), *((np.cos(t), np.sin(t)) for t in directions))
    faces = tuple((0, k, k + 1) for k in range(1, len(directions)))
    edges = tuple((0, k) for k in range(2, len(directions)))
    return Sheet(len(places), edges, "V" * len(edges), faces, places)


@pytest.mark.parametrize(
    ("sheet", "meet"),
    [
        (strip(1.0, 1.0, 0.8), np.pi - np.arccos(1 / 1.6)),
        slow(strip(1.0, 1.0, 0.6, across=3.0), np.pi - np.arccos(1 / 1.2)),
        (open_vertex(70, 60, 50), np.pi - np.arccos(np.tan(np.radians(30)) / np.tan(np.radians(50)))),
        slow(open_vertex(80, 40, 65), np.pi - np.arccos(np.tan(np.radians(20)) / np.tan(np.radians(65)))),
    ],
    ids=["strip", "wide strip", "vertex", "other vertex"],
)
def test_the_third_panel_meets_the_first_by_its_formula(sheet, meet):
    """Both creases turn alike: an isosceles triangle, plane or on the sphere."""
    asked = {0: np.radians(170), 1: np.radians(170)}
    assert len(fold(sheet, drive=asked, frames=17).path.angles) == 18
    folded = fold(sheet, drive=asked, frames=17, collisions=True)
    (event,) = folded.path.events
    assert (event.kind, event.panels, event.frame) == ("collision", (0, 2), int(np.degrees(meet) / 10))
    assert event.angles == pytest.approx([meet, meet], abs=2e-6)
    assert folded.path.angles[-1] == pytest.approx(np.radians([10 * event.frame] * 2))
    assert len(folded.places) == event.frame + 1
    assert folded.path.stopped.startswith("collision at joint 0 = ")


def test_what_turns_away_or_only_touches_goes_on():
    for sheet, asked in [
        (strip(1.0, 1.0, 0.8), {0: 3.0, 1: -3.0}),
        (strip(1.0, 1.0, 1.0, 1.0), dict.fromkeys(range(3), np.pi / 2)),  # a box: the last edge meets the first
        (strip(1.0, 1.0), {0: np.pi}),
    ]:
        folded = fold(sheet, drive=asked, frames=5, collisions=True)
        assert (folded.path.stopped, len(folded.path.angles)) == ("", 6)


def test_a_miura_sheet_never_meets_itself():
    folded = fold(miura(2, 2, np.radians(60)), frames=4, collisions=True)
    assert (folded.path.stopped, len(folded.path.angles)) == ("", 5)


@pytest.mark.slow
def test_a_large_miura_sheet_never_meets_itself():
    folded = fold(miura(15, 20, np.radians(60)), collisions=True)
    assert (folded.path.stopped, len(folded.path.angles)) == ("", 21)


def pierced(triangle, a, b):
    """Tell whether an edge passes through a triangle: three tetrahedra have one sign, the ends two."""

    def volume(p, q, r, s):
        return np.linalg.det([q - p, r - p, s - p])

    p, q, r = triangle
    if volume(p, q, r, a) * volume(p, q, r, b) >= 0:
        return False
    return len({np.sign(volume(a, b, p, q)), np.sign(volume(a, b, q, r)), np.sign(volume(a, b, r, p))}) == 1


@pytest.mark.parametrize("shared", [0, 1])
def test_triangles_cross_where_an_edge_passes_through_one(rng, shared):
    """With a vertex in common too, but for edges from there."""
    seen = set()
    for _ in range(150):
        places = rng.normal(size=(6, 3))
        if shared:
            places[3] = places[0]
        one, other = places[:3], places[3:]
        expected = any(
            pierced(first, second[k], second[(k + 1) % 3])
            for first, second in ((one, other), (other, one))
            for k in range(3)
        )
        assert (PanelShapes(TRIANGLES, [0, 1], places).crossing(places) is not None) == expected
        seen.add(expected)
    assert seen == {True, False}


def test_a_notch_is_not_part_of_its_panel():
    """An L of paper: a needle through its notch meets nothing, one through its arm does."""
    corner = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (1, 2, 0), (0, 2, 0)]
    for (x, y), meets in {(1.5, 1.5): False, (0.4, 1.6): True, (1.6, 0.4): True, (0.3, 0.4): True}.items():
        needle = [(x, y, -1), (x + 0.1, y, 1), (x, y + 0.1, 1)]
        places = np.array(corner + needle, dtype=float)
        assert (PanelShapes([range(6), (6, 7, 8)], [0, 1], places).crossing(places) is not None) == meets


def test_panels_that_cross_at_the_pose_of_the_file():
    flat = fold(strip(1.0, 1.0, 0.8), drive=dict.fromkeys(range(2), np.radians(150)), frames=1).frames()[-1]
    folded = fold(replace(flat, fold_angles=None), drive={0: np.radians(160), 1: np.radians(150)}, collisions=True)
    assert len(folded.path.angles) == 1
    assert "panels pass through each other at the start: collision at joint " in folded.path.stopped


def test_the_command_line_ends_before_a_collision(tmp_path):
    place = tmp_path / "strip.fold"
    write(strip(1.0, 1.0, 0.8), place)
    words = ("fold", place, "--drive", "0=170", "--drive", "1=170", "--frames", 17, "--json")
    assert json.loads(run(*words).stdout)["stopped"] is None
    told = json.loads(run(*words, "--collisions").stdout)
    assert told["frames"] == 13
    assert (told["events"][0]["kind"], told["events"][0]["panels"]) == ("collision", [0, 2])


@pytest.mark.parametrize("largest", [0.05, 2.0])
def test_pairs_whose_boxes_meet_are_those_of_all_pairs(largest, monkeypatch):
    """More pieces than are compared at a time, some of a panel of two, boxes of all sizes; every pair by itself."""
    monkeypatch.setattr(panel_collisions, "_PAIRS", 100)
    rng = np.random.default_rng(int(100 * largest))
    count = 300
    corners = rng.uniform(0.0, 1.0, (count, 1, 3)) + rng.uniform(0.0, largest, (count, 1, 1)) * rng.uniform(
        size=(count, 3, 3)
    )
    panel_of = np.arange(count) // 2
    shapes = PanelShapes(np.arange(3 * count).reshape(-1, 3).tolist(), panel_of.tolist(), corners.reshape(-1, 3))
    low, high = corners.min(axis=1), corners.max(axis=1)
    expected = {
        (i, j)
        for i in range(count)
        for j in range(i + 1, count)
        if panel_of[i] != panel_of[j] and (low[i] <= high[j]).all() and (low[j] <= high[i]).all()
    }
    found = [
        pair for first, second in shapes._near(corners) for pair in zip(first.tolist(), second.tolist(), strict=True)
    ]
    assert len(found) == len(set(found)) > 0
    assert set(found) == expected
