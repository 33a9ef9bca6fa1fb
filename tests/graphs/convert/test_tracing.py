"""Tracing of planar patterns, against GEOS where it applies."""

import random
from collections import Counter

import numpy as np
import pytest
import shapely
from hypothesis import given, settings, strategies as st

from graphs.convert import tracing
from graphs.convert.duality import mechanism_of_sheet
from graphs.convert.tracing import TOLERANCES, Lines, networks_of, trace_sheet
from graphs.errors import InvariantError
from graphs.files.formats import read, write
from graphs.files.patterns.lines import cp_text, sheet_from_cp

SQUARE = [((0, 0), (1, 0)), ((1, 0), (1, 1)), ((1, 1), (0, 1)), ((0, 1), (0, 0))]


def traced(lines, letters):
    return trace_sheet(Lines(np.array(lines, dtype=float).reshape(-1, 2, 2), letters))


def areas(sheet):
    points = np.array(sheet.coordinates)
    found = []
    for face in sheet.faces:
        x, y = points[list(face)].T
        found.append((x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2)
    return found


@given(st.integers(0, 10**9))
def test_random_lines_in_a_square_as_geos_sees_them(seed):
    rng = random.Random(seed)  # lines in general position: not the denormal numbers of a shrinking search
    lines = list(SQUARE)
    for _ in range(rng.randint(1, 12)):
        lines.append(((rng.random(), rng.random()), (rng.random(), rng.random())))
    letters = "BBBB" + "V" * (len(lines) - 4)
    sheet = trace_sheet(Lines(np.array(lines, dtype=float), letters), tolerance=1e-9)
    noded = shapely.unary_union(shapely.linestrings(np.array(lines, dtype=float)))
    polygons = shapely.get_parts(shapely.polygonize(shapely.get_parts(noded)))
    without_holes = [polygon for polygon in polygons if not polygon.interiors]
    if len(without_holes) < len(polygons):
        return  # an island inside a face; its outline is no side of the face here
    assert len(sheet.faces) == len(polygons)
    assert sorted(areas(sheet)) == pytest.approx(sorted(polygon.area for polygon in polygons), abs=1e-5)
    assert sum(areas(sheet)) == pytest.approx(1, abs=1e-9)


@given(st.integers(0, 10**9))
def test_small_errors_are_welded(seed):
    """A grid whose every line is drawn apart, each end off by up to a ten-thousandth."""
    rng = random.Random(seed)
    n = rng.randint(2, 5)
    lines, letters = [], ""
    for i in range(n + 1):
        for j in range(n):
            border = i in (0, n)
            lines += [((j, i), (j + 1, i)), ((i, j), (i, j + 1))]
            letters += ("B" if border else "M") + ("B" if border else "V")
    noisy = np.array(lines, dtype=float) / n
    noisy += [[[rng.uniform(-5e-5, 5e-5) for _ in range(2)] for _ in range(2)] for _ in lines]
    sheet = trace_sheet(Lines(noisy, letters))
    mechanism = mechanism_of_sheet(sheet)
    assert (len(sheet.faces), len(mechanism.sc.joints)) == (n * n, 2 * n * (n - 1))
    assert mechanism.interior_vertices == (n - 1) ** 2


def test_a_line_drawn_twice_counts_once_and_a_crease_wins_over_a_border():
    sheet = traced([*SQUARE, ((0, 0), (1, 1)), ((1, 1), (0, 0)), ((0, 0), (1, 0))], "BBBBMBV")
    assert Counter(sheet.assignments) == {"B": 3, "M": 1, "V": 1}
    assert any(note.endswith("lines drawn twice") and note.startswith("2 ") for note in sheet.repairs)


def test_ends_on_lines_split_them_and_loose_ends_are_pruned():
    sheet = traced([*SQUARE, ((0.5, 0), (0.5, 1)), ((0.5, 0.5), (0.8, 0.5)), ((2, 2), (3, 3))], "BBBBMVV")
    assert (len(sheet.faces), sheet.assignments.count("M")) == (2, 1)
    assert any("that end nowhere pruned" in note for note in sheet.repairs)
    assert any("in the middle of a line removed" in note for note in sheet.repairs)


def test_a_hole_is_no_face():
    hole = [((a + 1) / 3, (b + 1) / 3) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
    lines = [
        *SQUARE,
        *((hole[i - 1], hole[i]) for i in range(4)),
        *zip([(0, 0), (1, 0), (1, 1), (0, 1)], hole, strict=True),
    ]
    sheet = traced(lines, "BBBB" + "BBBB" + "VVVV")
    assert len(sheet.faces) == 4
    sc = mechanism_of_sheet(sheet, geometry=False).sc
    assert (len(sc), len(sc.joints), sc.spatial_loops) == (4, 4, 1)
    assert mechanism_of_sheet(sheet).sc.spatial_loops == 0  # its creases meet in the middle of the hole
    assert any("taken as holes" in note for note in sheet.repairs)


def test_no_lines_no_sheet():
    for lines in ([], [((1, 1), (1, 1))]):
        with pytest.raises(InvariantError, match="no line of any length"):
            traced(lines, "V" * len(lines))
    with pytest.raises(InvariantError, match="1 letters for ends of shape"):
        Lines(np.zeros((2, 2, 2)), "V")


@pytest.mark.parametrize("name", ["bird-base.fold", "four-bar-vertex.fold"])
def test_cp_and_obj_round_trips(name, data, tmp_path):
    sheet = read(data / "patterns" / name)
    joints = len(mechanism_of_sheet(sheet).sc.joints)
    assert write(sheet, tmp_path / "a.obj") == ("the title",)
    again = read(tmp_path / "a.obj")
    assert (again.edges, again.assignments, again.faces) == (sheet.edges, sheet.assignments, sheet.faces)
    bare = [line for line in (tmp_path / "a.obj").read_text().splitlines() if not line.startswith("#e")]
    (tmp_path / "bare.obj").write_text("\n".join(bare), encoding="utf-8")
    assert len(mechanism_of_sheet(read(tmp_path / "bare.obj")).sc.joints) == joints
    if name.startswith("bird"):
        unassigned = sheet.assignments.count("U")
        assert f"{unassigned} unassigned creases: as valleys" in write(sheet, tmp_path / "a.cp")
        again = sheet_from_cp(tmp_path / "a.cp")
        assert len(mechanism_of_sheet(again).sc.joints) == joints
        assert Counter(again.assignments) == Counter(sheet.assignments.replace("U", "V"))
        assert cp_text(again).count("\n") == len(sheet.edges)


def test_svg_shapes_transforms_and_colours(tmp_path):
    path = tmp_path / "a.svg"
    path.write_text(
        """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">
        <rect x="0" y="0" width="10" height="10" fill="none" stroke="black"/>
        <g transform="translate(5 0)" style="stroke:#f00"><line x1="0" y1="0" x2="0" y2="10"/></g>
        <polyline points="0,5 5,5 10,5" stroke="rgb(0,0,250)" fill="none"/>
        <path d="M0 0 C 1 3 3 1 4 4" stroke="gray" fill="none"/>
        </svg>""",
        encoding="utf-8",
    )
    sheet = read(path)
    assert (len(sheet.faces), Counter(sheet.assignments)) == (4, {"B": 8, "M": 2, "V": 2})
    assert "1 shape with strokes not understood left out: 1 #808080" in sheet.repairs
    mechanism = mechanism_of_sheet(sheet)
    assert (mechanism.interior_vertices, len(mechanism.sc)) == (1, 4)


@settings(max_examples=12)
@given(st.integers(0, 10**9))
def test_vertices_split_by_a_short_edge_are_mended(seed):
    """Ten by ten panels, five vertices where the creases from both sides meet a third a little apart.

    Every line ends on another, and edges less vertices are as without the splits, so only the short edges tell.
    """
    rng = random.Random(seed)
    n = 10
    split = rng.sample([(i, j) for i in range(1, n) for j in range(1, n)], 5)
    lines, letters = list(SQUARE), "BBBB"
    for i in range(1, n):
        lines.append(((0, i / n), (1, i / n)))
        letters += "M"
    for i in range(1, n):
        for j in range(n):
            off = rng.choice([-1, 1]) * rng.uniform(1.5e-4, 5e-4) if (i, j) in split else 0
            lines.append(((i / n + off, j / n), (i / n, (j + 1) / n)))
            letters += "V"
    sheet = traced(lines, letters)
    assert (sheet.vertices, len(sheet.faces)) == ((n + 1) ** 2, n * n)
    mechanism = mechanism_of_sheet(sheet)
    assert (mechanism.interior_vertices, len(mechanism.sc.joints)) == ((n - 1) ** 2, 2 * n * (n - 1))
    assert any("welded within" in note and "of the size" in note for note in sheet.repairs)


def test_a_tolerance_with_simple_faces_is_preferred():
    """A triangle hangs on a crease by one corner; another misses the border by more than a crease misses it."""
    low, middle, high = (0.5, 8e-4), (0.5, 0.5), (0.5, 1)
    free, near = (0.8, 0.4), (1 - 1.5e-3, 0.6)
    lines = [*SQUARE, (low, middle), (middle, high), (middle, free), (free, near), (near, middle)]
    sheet = traced(lines, "BBBB" + "V" * 5)
    assert sorted(areas(sheet)) == pytest.approx([0.04, 0.225, 0.235, 0.5], abs=2e-3)
    assert "ends welded within 2e-03 of the size" in sheet.repairs
    without_gap = [
        *SQUARE,
        ((0.5, 0), middle),
        (middle, high),
        (middle, free),
        (free, (0.7, 0.6)),
        ((0.7, 0.6), middle),
    ]
    with pytest.raises(InvariantError, match="three or more, each once"):
        traced(without_gap, "BBBB" + "V" * 5)


def test_finer_tolerances_that_lose_lines_are_no_way_to_simple_faces():
    """The triangle hangs by one corner for good; where its ends do not meet it would vanish."""
    middle, one, two = (0.5, 0.5), (0.8, 0.4), (0.8, 0.6)
    lines = [*SQUARE, ((0.5, 0), middle), (middle, (0.5, 1)), (middle, one), (one, two), ((0.80003, 0.6), middle)]
    with pytest.raises(InvariantError, match="three or more, each once"):
        traced(lines, "BBBB" + "V" * 5)


def test_a_fine_pattern_keeps_its_panels():
    """Pleats no wider than the coarser tolerances: short edges are no sign of splits where faces would go."""
    n = 20
    lines, letters = [*SQUARE], "BBBB"
    for i in range(1, n):
        lines.append(((0.4 + i * 9e-4, 0), (0.4 + i * 9e-4, 1)))
        letters += "MV"[i % 2]
    sheet = traced(lines, letters)
    assert len(sheet.faces) == n
    assert not any("welded" in note for note in sheet.repairs)


def noisy_lines(rng):
    """Lines whose ends and crossings are apart by anything from nothing to far beyond all tolerances."""
    corners = rng.integers(0, 4, size=(int(rng.integers(3, 14)), 2, 2)).astype(float)
    noise = 4 * 10.0 ** rng.uniform(-7, -1.5, size=corners.shape) * rng.choice([-1, 0, 1], size=corners.shape)
    return Lines(corners + noise, "".join(rng.choice(list("MVB"), size=len(corners))))


def same(one, other):
    assert np.array_equal(one.points, other.points)
    assert (list(one.edges.items()), one.angles, one.tolerance) == (
        list(other.edges.items()),
        other.angles,
        other.tolerance,
    )
    one_repairs, other_repairs = ({kind: len(row) for kind, row in each.repairs.items()} for each in (one, other))
    assert (one_repairs, one.dangling, one.spread) == (other_repairs, other.dangling, other.spread)


@pytest.mark.parametrize("number", [20, pytest.param(3000, marks=pytest.mark.slow)])
def test_tolerances_that_weld_alike_give_what_each_gives_by_itself(number, rng, monkeypatch):
    welded, weldings = tracing._welded_network, []
    monkeypatch.setattr(tracing, "_welded_network", lambda *given: weldings.append(given) or welded(*given))
    for _ in range(number):
        lines = noisy_lines(rng)
        tried = [t * lines.size for t in TOLERANCES]
        for one, tolerance in zip(networks_of(lines, tried), tried, strict=True):
            same(one, networks_of(lines, [tolerance])[0])
    assert number * 8 < len(weldings) < number * 13  # 7 one by one; together from 1 to 6, and both occur


@pytest.mark.filterwarnings("error")
def test_a_line_of_next_to_no_length_is_dropped():
    square = [((0, 0), (9, 0)), ((9, 0), (9, 8)), ((9, 8), (0, 8)), ((0, 8), (0, 0)), ((0, 0), (9, 8))]
    sheet = traced([*square, ((0, 0), (1e-320, 0)), ((4, 4), (4, 4))], "BBBBVMM")
    assert (len(sheet.faces), sheet.assignments.count("V")) == (2, 1)


def grid(n):
    """A drawing of n by n squares, each side a line of its own."""
    steps = [(i, j) for i in range(n + 1) for j in range(n)]
    lines = [((j, i), (j + 1, i)) for i, j in steps] + [((i, j), (i, j + 1)) for i, j in steps]
    return traced(lines, "".join("B" if i in (0, n) else "M" for i, _ in steps) * 2)


@pytest.mark.parametrize("n", [12, pytest.param(150, marks=pytest.mark.slow)])
def test_a_clean_drawing_is_welded_once_for_all_tolerances(n, monkeypatch):
    welded, weldings = tracing._welded, []
    monkeypatch.setattr(tracing, "_welded", lambda *given: weldings.append(given) or welded(*given))
    sheet = grid(n)
    assert (len(sheet.faces), sheet.repairs) == (n * n, ())
    assert len(weldings) == 1
