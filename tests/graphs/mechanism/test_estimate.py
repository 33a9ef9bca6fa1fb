"""Precision estimated from the geometry: patterns of the generators with known noise, and sheets that show nothing."""

import zlib
from dataclasses import replace
from time import process_time

import numpy as np
import pytest
from scipy.spatial import Delaunay
from sizes import slow

from graphs.mechanism.estimate import estimate_of
from graphs.mechanism.precision import BY_DIGITS, extent_of, precision_as_written, precision_of_sheet, stated
from graphs.mechanism.sheet import Sheet
from synth.catalogue.patterns import generate

PATTERNS = {
    "miura": {"rows": 5, "columns": 5},
    "map": {"rows": 4, "columns": 4},
    "square-twist": {},
    "hexagon-twist": {},
    "waterbomb": {},
    "waterbomb-base": {},
    "preliminary-base": {},
    "bird-base": {},
    "yoshimura": {},
    "resch": {},
    "chickenwire": {},
    "kresling": {},
    "deployable-cylinder": {},
    "miura-tube": {},
    "crash-lock": {},
}
SIZES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
SINGLE = 2.0**-25
"""Half the spacing of single precision, in the mean of the numbers of a binade."""


def pattern(name):
    thing = generate(name, **PATTERNS[name]).mechanism
    return thing if isinstance(thing, Sheet) else thing.sheet


def with_places(sheet, places):
    return replace(sheet, coordinates=tuple(map(tuple, np.asarray(places).tolist())), precision=None)


def turned(places, rng):
    """Rotated anyhow: in the plane, or in space."""
    width = places.shape[1]
    rotation, _ = np.linalg.qr(rng.normal(size=(width, width)))
    return places @ rotation


def noisy(sheet, size, rng, *, single=False):
    places = np.array(sheet.coordinates, dtype=float)
    places = places + rng.uniform(-size, size, places.shape) * extent_of(places)
    places = turned(places, rng) * 10.0 ** rng.uniform(-3, 3)
    if single:
        places = places.astype(np.float32).astype(float) * rng.uniform(1.0, 30.0)
    return with_places(sheet, places)


def estimates(names, copies):
    """Estimated over real precision of noisy copies; nought where nothing was estimated."""
    for name in names:
        sheet = pattern(name)
        for size in SIZES:
            for copy in range(copies):
                rng = np.random.default_rng(zlib.crc32(f"{name} {size} {copy}".encode()))
                found = estimate_of(noisy(sheet, size, rng, single=bool(copy % 2)))
                real = max(size, SINGLE) if copy % 2 else size
                yield name, size, 0.0 if found is None else found.size / real


def within_three(names, copies):
    ratios = np.array([ratio for _, _, ratio in estimates(names, copies)])
    return float(((ratios >= 1 / 3) & (ratios <= 3)).mean())


def test_noise_is_estimated_within_a_factor_of_three():
    assert within_three(PATTERNS, 2) >= 0.9


@pytest.mark.slow
def test_noise_of_a_thousand_copies_is_estimated_within_a_factor_of_three():
    assert within_three(PATTERNS, 12) >= 0.9


@pytest.mark.parametrize("name", PATTERNS)
def test_exact_patterns_are_not_taken_for_coarse(name):
    rng = np.random.default_rng(5)
    sheet = pattern(name)
    places = turned(np.array(sheet.coordinates), rng)
    for one in (sheet, with_places(sheet, places * 25.4)):
        assert estimate_of(one).size < 1e-13
    assert precision_of_sheet(with_places(sheet, places * 25.4)).size < 1e-13


def random_map(number):
    rng = np.random.default_rng(number)
    points = rng.random((int(rng.integers(6, 80)), 2))
    corners = points[Delaunay(points).simplices]
    areas = np.linalg.det(np.stack([corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]], axis=1))
    faces = [
        (a, b, c) if area > 0 else (a, c, b)
        for (a, b, c), area in zip(Delaunay(points).simplices.tolist(), areas, strict=True)
    ]
    return Sheet(len(points), (), "", tuple(faces), tuple(map(tuple, points.tolist())))


@pytest.mark.parametrize("cases", [15, slow(60)])
def test_of_sheets_in_general_position_nothing_is_estimated(cases):
    for number in range(cases):
        sheet = random_map(number)
        assert estimate_of(sheet) is None
        assert precision_of_sheet(sheet).evidence == BY_DIGITS


@pytest.mark.parametrize("name", ["miura", "square-twist", "deployable-cylinder"])
def test_estimates_do_not_hang_on_how_the_sheet_lies(name):
    sheet = pattern(name)
    rng = np.random.default_rng(3)
    rounded = noisy(sheet, 1e-5, rng)
    places = np.array(rounded.coordinates)
    first = estimate_of(rounded).size * extent_of(places)
    for scale, moved in (
        (1.0, turned(places, rng)),
        (1e-4, 1e-4 * places),
        (25.4, 25.4 * places),
        (1.0, places + 3.0 * np.abs(places).max()),
    ):
        found = estimate_of(with_places(rounded, moved)).size * extent_of(moved)
        assert found == pytest.approx(scale * first, rel=0.03)


def test_a_shift_costs_the_digits_that_it_costs():
    sheet = pattern("square-twist")
    places = np.array(sheet.coordinates)
    extent = extent_of(places)
    for factor in (1e3, 1e6):
        far = precision_of_sheet(with_places(sheet, places + factor * extent))
        assert 2.0**-54 * factor < far.size < 2.0**-48 * factor
    steps = with_places(pattern("map"), np.array(pattern("map").coordinates) + 4e6)
    assert precision_of_sheet(steps).size < 1e-8  # whole numbers fit in single precision, and are exact


def test_one_vertex_that_is_off_does_not_make_a_drawing_imprecise():
    sheet = pattern("map")
    places = np.array(sheet.coordinates)
    places[0] += (1e-5, 2e-5)
    assert precision_of_sheet(with_places(sheet, places)).size < 1e-13


def test_curves_of_short_pieces_are_not_imprecise_lines():
    angles = np.linspace(0.0, np.pi / 2, 200)
    rings = [(r * np.cos(a), r * np.sin(a)) for a in angles for r in (1.0, 1.37, 2.11)]
    faces = tuple(
        (3 * k + j, 3 * k + j + 1, 3 * k + j + 4, 3 * k + j + 3) for k in range(len(angles) - 1) for j in range(2)
    )
    found = precision_of_sheet(Sheet(len(rings), (), "", faces, tuple(rings)))
    assert found.size < 1e-13


def test_what_is_stated_holds_and_types_hang_on_no_estimate():
    rounded = noisy(pattern("miura"), 1e-4, np.random.default_rng(1))
    extent = extent_of(np.array(rounded.coordinates))
    assert precision_of_sheet(rounded).source == "estimated"
    assert precision_as_written(rounded).source == "double precision"
    for length in (0.0, 1e-2 * extent):
        found = precision_of_sheet(stated(rounded, length))
        assert found.source == "stated"
        assert found.size == pytest.approx(max(length / extent, found.size if not length else 0.0))
        assert found.size < 1e-14 or length
    assert stated(rounded, 0.1) == rounded


def test_estimates_are_quick():
    sheet = pattern("miura")
    at = [(j + 0.3 * (i % 2), i * 1.1) for i in range(33) for j in range(33)]
    faces = [(33 * i + j, 33 * i + j + 1, 33 * i + j + 34, 33 * i + j + 33) for i in range(32) for j in range(32)]
    large = Sheet(33 * 33, (), "", tuple(faces), tuple(at))
    estimate_of(sheet)
    start = process_time()
    assert estimate_of(large).size < 1e-12
    assert process_time() - start < 1.0  # about 0.05 s on a processor of its own
