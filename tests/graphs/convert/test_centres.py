"""Loops round holes and cuts: planar where axes are parallel, spherical where they meet."""

import numpy as np
import pytest
from sizes import slow

import synth
from graphs.convert.cycles import axes_meet
from graphs.convert.duality import mechanism_of_sheet
from graphs.convert.tracing import Lines, trace_sheet
from graphs.loops.loop import Centre
from graphs.mechanism.sheet import Sheet


def pop_up(turn=0.0, decimals=None):
    """A box that pops up: slits at x = 3 and 7 from y = 3 to 6, creases across them at 3, 4 and 6, 5 outside."""
    lines = [
        ((0, 5), (3, 5), "V"), ((7, 5), (10, 5), "V"), ((3, 3), (7, 3), "M"), ((3, 4), (7, 4), "V"),
        ((3, 6), (7, 6), "M"), ((3, 3), (3, 6), "C"), ((7, 3), (7, 6), "C"), ((0, 0), (10, 0), "B"),
        ((10, 0), (10, 10), "B"), ((10, 10), (0, 10), "B"), ((0, 10), (0, 0), "B"),
    ]  # fmt: skip
    ends = np.array([line[:2] for line in lines], dtype=float) * 40
    c, s = np.cos(turn), np.sin(turn)
    ends = ends @ np.array([[c, s], [-s, c]])
    if decimals is not None:
        ends = ends.round(decimals)
    return trace_sheet(Lines(ends, "".join(letter for *_, letter in lines)))


@pytest.mark.parametrize(("turn", "decimals"), [(0.0, None), slow(0.3, None), (0.3, 4), slow(1.1, 2)])
def test_a_pop_up_is_a_planar_four_bar(turn, decimals):
    answer = synth.mobility(pop_up(turn, decimals))
    assert (answer.links, answer.joints, answer.mobility, answer.exact.mobility) == (4, 4, 1, 1)
    assert answer.counts["spatial_loops"] == 0
    assert "geometry: the axes of 1 loop round holes or cuts are parallel: planar" in answer.warnings
    without = synth.mobility(pop_up(turn, decimals), geometry=False)
    assert (without.mobility, without.counts["spatial_loops"]) == (-2, 1)


def ring(apex, panels=5, tilt=0.0):
    """A ring of quads round a hole whose creases lead to one point."""
    angles = np.linspace(0, 2 * np.pi, panels, endpoint=False) + 0.1 * np.sin(np.arange(panels))
    unit = np.column_stack([np.cos(angles), np.sin(angles), tilt * np.cos(3 * angles)])
    places = np.vstack([unit + apex * (1 - 1.0), 2 * unit + apex * (1 - 2.0)])
    faces = tuple((i, (i + 1) % panels, panels + (i + 1) % panels, panels + i) for i in range(panels))
    return Sheet(2 * panels, (), "", faces, tuple(map(tuple, places.tolist())))


@pytest.mark.parametrize("tilt", [0.0, 0.4])
def test_creases_that_meet_in_a_hole_are_spherical(tilt):
    sc = mechanism_of_sheet(ring(np.array([0.1, -0.2, 0.0]), tilt=tilt)).sc
    assert [loop.centre for loop in sc.loops] == [Centre.FINITE]
    assert synth.mobility(ring(np.zeros(3), tilt=tilt)).mobility == 2


def test_creases_that_meet_nowhere_stay_spatial():
    sheet = ring(np.zeros(3))
    places = [list(place) for place in sheet.coordinates]
    places[7][0] += 0.01
    moved = Sheet(sheet.vertices, (), "", sheet.faces, tuple(map(tuple, places)))
    assert mechanism_of_sheet(moved).sc.spatial_loops == 1


def test_a_tube_of_parallel_creases_is_planar():
    angles = np.linspace(0, 2 * np.pi, 6, endpoint=False)
    places = [(np.cos(a), np.sin(a), float(z)) for z in (0, 1, 2) for a in angles]
    faces = tuple(
        (6 * z + i, 6 * z + (i + 1) % 6, 6 * z + 6 + (i + 1) % 6, 6 * z + 6 + i) for z in (0, 1) for i in range(6)
    )
    merged = [((i, i + 6), "V") for i in range(12)] + [((6 + i, 6 + (i + 1) % 6), "F") for i in range(6)]
    edges, letters = tuple(edge for edge, _ in merged), "".join(letter for _, letter in merged)
    answer = synth.mobility(Sheet(18, edges, letters, faces, tuple(places)))
    assert (answer.links, answer.joints, answer.mobility, answer.infinitesimal.dof) == (6, 6, 3, 3)


def test_lines_that_meet():
    rng = np.random.default_rng(0)
    for _ in range(200):
        number = int(rng.integers(3, 7))
        point, starts = rng.normal(size=3), rng.normal(size=(number, 3))
        meet = np.vstack([starts, starts + (point - starts) * rng.uniform(0.2, 0.8, size=(number, 1))])
        hinges = [(i, number + i) for i in range(number)]
        assert axes_meet(meet, hinges, 1e-6) is Centre.FINITE
        direction = rng.normal(size=3)
        parallel = np.vstack([starts, starts + direction * rng.uniform(0.2, 0.8, size=(number, 1))])
        assert axes_meet(parallel, hinges, 1e-6) is Centre.INFINITE
        for lines in (meet, parallel):
            noisy = lines + rng.normal(size=lines.shape) * 1e-2
            assert axes_meet(noisy, hinges, 1e-6) is Centre.NONE
            slight = lines + rng.normal(size=lines.shape) * 1e-8
            assert axes_meet(slight, hinges, 1e-6) is not Centre.NONE


def test_by_the_command_line(tmp_path):
    import json

    from commands import run

    path = tmp_path / "box.fold"
    synth.write(pop_up(), path)
    told = [
        json.loads(run("mobility", path, "--json", *flags).stdout)[0]
        for flags in ([], ["--no-geometry"], ["--no-pose"])
    ]
    assert [one["mobility"] for one in told] == [1, -2, 1]
    assert [one["pose"] is None for one in told] == [False, False, True]
