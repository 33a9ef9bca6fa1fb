"""Which hinges between two panels lie on one line: sheets as files have them, rounded, turned, and truly bent."""

from collections import defaultdict
from math import cos, pi, radians, sin

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from graphs.convert.duality import mechanism_of_sheet
from graphs.convert.hinges import lines_of_hinges
from graphs.mechanism.sheet import COLLINEAR, Sheet

ROUNDINGS = {
    "not at all": lambda places: places,
    "float32": lambda places: places.astype(np.float32).astype(float),
    "two decimals": lambda places: np.round(places, 2),
    "four decimals": lambda places: np.round(places, 4),
}


def grid(size, panel, *, cell=20.0, angle=0.3, rounded="not at all"):
    """A sheet of size x size cells, turned, moved and rounded, and how many joints it has.

    Cells with the same ``panel(i, j)`` are one panel. The joints are counted on the grid itself: hinges between
    the same two panels with the same abscissa, or the same ordinate, are one.
    """

    def at(i, j):
        return i * (size + 1) + j

    faces = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for i in range(size) for j in range(size)]
    edges, letters, lines = [], "", set()
    for i in range(size + 1):
        for j in range(size + 1):
            for edge, one, two, line in (
                ((at(i, j), at(i, j + 1)), (i - 1, j), (i, j), ("x", i)),
                ((at(i, j), at(i + 1, j)), (i, j - 1), (i, j), ("y", j)),
            ):
                if not all(0 <= place < size for place in (*one, *two)):
                    continue
                edges.append(edge)
                between = frozenset((panel(*one), panel(*two)))
                letters += "F" if len(between) == 1 else "M"
                if len(between) == 2:
                    lines.add((between, line))
    places = np.array([(i, j) for i in range(size + 1) for j in range(size + 1)], dtype=float) * cell
    places = places @ np.array([[cos(angle), sin(angle)], [-sin(angle), cos(angle)]]) + 4000
    coordinates = tuple(map(tuple, ROUNDINGS[rounded](places).tolist()))
    return Sheet(len(places), tuple(edges), letters, tuple(faces), coordinates), len(lines)


PATTERNS = {
    "box pleats": lambda i, j: i,
    "checkerboard": lambda i, j: min(i + j % 2, 9) // 2,
    "pop-up": lambda i, j: i if 3 < j < 8 and i % 3 == 1 else i < 6,
}


def check(sheet, joints, rounded):
    mechanism = mechanism_of_sheet(sheet)
    assert len(mechanism.sc.joints) == joints
    told = [note for note in mechanism.repairs if note.startswith("hinges within")]
    assert not told or rounded != "not at all"
    assert told or rounded != "two decimals"
    assert not any("may or may not" in note for note in mechanism.warnings)


@pytest.mark.parametrize("rounded", ROUNDINGS)
@pytest.mark.parametrize("pattern", PATTERNS)
def test_rounding_splits_no_joint(pattern, rounded):
    check(*grid(10, PATTERNS[pattern], rounded=rounded), rounded)


@pytest.mark.slow
@pytest.mark.parametrize("rounded", ROUNDINGS)
@pytest.mark.parametrize("angle", [0.1, 0.3, 0.7])
def test_rounding_splits_no_joint_of_large_sheets(angle, rounded):
    check(*grid(49, lambda i, j: i, angle=angle, rounded=rounded), rounded)
    check(*grid(26, lambda i, j: min(i + j % 2, 25) // 2, angle=angle, rounded=rounded), rounded)


def row(rng, angles, lengths):
    """The ends of hinges one after the other, each turned against the last by an angle."""
    directions = np.cumsum([rng.uniform(0, 2 * pi), *angles])
    steps = np.array(lengths)[:, None] * np.stack([np.cos(directions), np.sin(directions)], axis=1)
    return np.vstack([[0.0, 0.0], np.cumsum(steps, axis=0)]) + rng.uniform(-100, 100, 2)


@settings(max_examples=25)
@given(st.integers(0, 10**9), st.sampled_from(["float32", 2, 3, 4, 5, 6]))
def test_bends_stay_and_rounding_goes(seed, digits):
    """Twenty rows of hinges: straight runs, bent against each other by at least five degrees."""
    rng = np.random.default_rng(seed)
    places, bundles, expected = [], [], []
    for _ in range(20):
        count = int(rng.integers(2, 7))
        bent = rng.random(count - 1) < 0.4
        angles = np.where(bent, rng.uniform(radians(5), radians(90), count - 1), 0.0)
        start = sum(map(len, places))
        places.append(row(rng, angles, rng.uniform(20, 100, count)))
        bundles.append([(start + i, start + i + 1) for i in range(count)])
        expected.append(int(bent.sum()) + 1)
    exact = np.vstack(places)
    written = exact.astype(np.float32).astype(float) if digits == "float32" else np.round(exact, digits)
    lines = lines_of_hinges(written, bundles)
    assert [len(groups) for groups in lines.groups] == expected
    assert lines.unclear == 0
    off = np.abs(written - exact).max() / np.ptp(exact, axis=0).max()
    assert lines_of_hinges(written, bundles, rounding=off).groups == lines.groups


def test_short_hinges_need_to_know_the_rounding():
    """Cells of one unit, written with two decimals: ends are off by up to a hundredth of a cell."""
    sheet, joints = grid(10, lambda i, j: i, cell=1.0, rounded="two decimals")
    faces_at = defaultdict(list)
    for i in range(1, 10):
        for j in range(10):
            faces_at[i].append((i * 11 + j, i * 11 + j + 1))
    blind = lines_of_hinges(sheet.coordinates, list(faces_at.values()))
    assert sum(map(len, blind.groups)) > joints
    assert blind.warnings == ("90 hinges may or may not be on one line: kept apart",)
    extent = np.ptp(np.array(sheet.coordinates), axis=0).max()
    knowing = lines_of_hinges(sheet.coordinates, list(faces_at.values()), rounding=0.005 / extent)
    assert sum(map(len, knowing.groups)) == joints
    assert knowing.warnings == ()
    assert knowing.repairs[0].endswith(f"of a line joined: {90 - joints}")


@pytest.mark.parametrize("pieces", [5, 40, 300])
def test_curves_stay_curves(pieces):
    """An arc of a radian in equal pieces; a piece turns by a fifth of a degree when there are 300."""
    points = [(cos(i / pieces), sin(i / pieces)) for i in range(pieces + 1)]
    lines = lines_of_hinges(points, [[(i, i + 1) for i in range(pieces)]])
    assert len(lines.groups[0]) == pieces
    assert lines.repairs == ()
    close = lines_of_hinges(points, [[(i, i + 1) for i in range(pieces)]], rounding=1e-4)
    assert len(close.groups[0]) == pieces
    assert bool(close.unclear) == (pieces > 40)


def test_short_hinges_side_by_side_are_apart_however_far_along():
    points = [(0, 0), (1, 0), (30, 1), (31, 1), (0, 5), (1, 5), (30, 5), (31, 5.0)]
    assert lines_of_hinges(points, [[(0, 1), (2, 3)], [(4, 5), (6, 7)]]).groups == (((0,), (1,)), ((0, 1),))


def test_without_a_plateau_it_is_told():
    """Bends of all sizes, each three times the last: none is rounding rather than the next."""
    points, bundles = [], []
    for i in range(9):
        start = len(points)
        points += [(0, 10 * i), (1, 10 * i), (2, 10 * i + 3e-6 * 3**i)]
        bundles.append([(start, start + 1), (start + 1, start + 2)])
    lines = lines_of_hinges(points, bundles)
    assert sum(map(len, lines.groups)) == 18
    assert lines.repairs == ()
    assert lines.warnings == ("18 hinges may or may not be on one line: kept apart",)


def test_a_sliver_that_only_rounding_straightens_is_told():
    points = [(0.0, 0.0), (100.0, 0.0), (100.02, 0.01)]
    bundles = [[(0, 1), (1, 2)]]
    assert lines_of_hinges(points, bundles).warnings == ()
    rounded = lines_of_hinges(points, bundles, rounding=5e-5)
    assert rounded.groups == (((0,), (1,)),)
    assert rounded.warnings == ("2 hinges may or may not be on one line: kept apart",)


def test_without_coordinates_or_partners_every_hinge_is_its_own():
    assert lines_of_hinges(None, [[(0, 1), (1, 2)]]).groups == (((0,), (1,)),)
    assert lines_of_hinges([(0, 0), (1, 0)], [[(0, 1)]]).groups == (((0,),),)
    assert lines_of_hinges([(0, 0), (1, 0)], []).groups == ()


def test_lines_in_space_and_far_from_the_origin():
    direction = np.array([1.0, 2.0, -2.0])
    points = np.outer([0, 1, 2, 5, 9], direction) + 1e4
    points[4] += (0, 0, 1)
    lines = lines_of_hinges(points, [[(0, 1), (1, 2), (2, 3), (3, 4)]])
    assert lines.groups == (((0, 1, 2), (3,)),)
    assert lines.within <= COLLINEAR
