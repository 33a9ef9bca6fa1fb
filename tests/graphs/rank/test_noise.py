"""Freedoms at a pose where coordinates have errors: never a confident wrong number."""

from collections import Counter

import numpy as np
import pytest
import scipy.sparse
from noisy import SIZE, disturbed, exact_freedoms, random_sheet
from sizes import slow

import synth
from graphs.convert.duality import mechanism_of_sheet
from graphs.convert.tracing import Lines, trace_sheet
from graphs.errors import InvariantError
from graphs.mechanism.precision import precision_of, precision_of_sheet
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.rank.dissection import number_below, sparse_spectrum
from graphs.rank.infinitesimal import closure_at_configuration, infinitesimal_mobility
from graphs.rank.singular_values import spectrum
from synth.linkages.conformed.rates import ConformedChain, first_order


@pytest.mark.parametrize("number", [80, slow(6000)])
def test_noise_gives_no_confident_wrong_number(number):
    """Random sheets whose freedoms are known exactly, with noise of 1e-15 to 1e-3 of their size."""
    rng = np.random.default_rng(17)
    certainties = Counter()
    for _ in range(number):
        sheet = random_sheet(rng)
        truth = exact_freedoms(sheet)
        noise = 10 ** rng.uniform(-15, -3)
        try:
            found = infinitesimal_mobility(disturbed(sheet, noise, rng))
        except InvariantError as error:  # rounded until a crease has no length
            assert "no length" in str(error)
            continue
        certainty = found.spectrum.certainty
        certainties[certainty] += 1
        if certainty == "numerical":
            assert found.dof == truth, noise
        elif certainty == "nearly mobile":
            assert found.dof <= truth <= found.dof + found.spectrum.nearly, noise
        else:
            assert found.dof is found.spectrum.rank is None
    assert certainties["numerical"] > 0.8 * number
    assert len(certainties) == 3


@pytest.mark.parametrize("number", [15, slow(40)])
def test_without_noise_the_exact_freedoms_are_found(number):
    rng = np.random.default_rng(3)
    for _ in range(number):
        sheet = random_sheet(rng)
        found = infinitesimal_mobility(sheet)
        assert found.dof == exact_freedoms(sheet)


def pop_up(end):
    """A box that pops up: slits at x = 3 and 7 from y = 3 to 6, creases across them at 3, 4 and 6, and 5 outside."""
    lines = [((0, 5), (3, 5), "V"), ((7, 5), (10, 5), "V"), ((3, 3), (7, 3), "M"), ((3, 4), (7, end), "V"), ((3, 6), (7, 6), "M"),
             ((3, 3), (3, 6), "C"), ((7, 3), (7, 6), "C"), ((0, 0), (10, 0), "B"), ((10, 0), (10, 10), "B"), ((10, 10), (0, 10), "B"),
             ((0, 10), (0, 0), "B")]  # fmt: skip
    return trace_sheet(
        Lines(np.array([line[:2] for line in lines], dtype=float), "".join(c for *_, c in lines)), tolerance=1e-12
    )


@pytest.mark.parametrize("off", [0.0, 1e-8, 1e-5, 1e-3])
def test_a_pop_up_with_one_end_off(off):
    sheet = pop_up(4 + off)
    found = infinitesimal_mobility(sheet)
    if not off:
        assert (found.dof, found.spectrum.certainty) == (2, "numerical")
    else:
        assert found.dof is None or found.dof < 2 <= found.dof + found.spectrum.nearly
        assert found.spectrum.certainty != "numerical"


def test_height_noise_on_a_flat_pattern():
    flat = synth.read("data/patterns/bird-base.fold")
    rng = np.random.default_rng(5)
    for noise in (1e-15, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3):
        heights = rng.normal(size=flat.vertices) * noise
        places = tuple((*place[:2], z) for place, z in zip(flat.coordinates, heights, strict=True))
        found = infinitesimal_mobility(Sheet(flat.vertices, flat.edges, flat.assignments, flat.faces, places))
        if noise < 1e-6:
            assert (found.dof, found.spectrum.certainty) == (10, "numerical")
        else:
            assert found.dof is None or found.dof <= 10 <= found.dof + found.spectrum.nearly


def test_rows_of_noise_are_no_equations():
    matrix = np.array([[1.0, 1.0, 0.0], [1e-9, -1e-9, 1e-9]])
    assert spectrum(matrix, error=1e-9).rank == 1
    assert spectrum(matrix, error=1e-14).rank == 2


def test_a_padded_zero_is_no_evidence():
    found = spectrum(np.diag([1.0, 0.5, 0.25]))
    assert (found.rank, found.gap, found.smallest) == (3, np.inf, 0.25)
    square = Sheet(3, (), "", ((0, 1, 2),), ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)))
    assert synth.mobility(square).infinitesimal.to_json()["gap"] is None


RAISED = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (1.5, 1.0, 0.7))
FAN = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))


def test_a_flat_vertex_of_a_sheet_that_is_not_flat_is_told_of():
    answer = synth.mobility(Sheet(6, (), "", (*FAN, (1, 2, 5)), RAISED))
    assert (answer.infinitesimal.dof, answer.overconstraint, answer.infinitesimal.flat) == (3, 1, False)
    assert answer.infinitesimal.flat_loops == 1
    assert any("1 loop with all axes in one plane" in note for note in answer.warnings)


def test_no_caution_where_nothing_is_gained():
    one = synth.mobility(Sheet(3, (), "", ((0, 1, 2),), ((0, 0), (1, 0), (0, 1))))
    hinge = synth.mobility(Sheet(4, (), "", ((0, 1, 2), (0, 2, 3)), ((0, 0), (1, 0), (1, 1), (0, 1))))
    for answer in (one, hinge):
        assert answer.overconstraint == 0
        assert not any("flat" in note for note in answer.warnings)
        assert "once folded" not in str(answer)


def test_the_precision_of_coordinates():
    rng = np.random.default_rng(0)
    exact = rng.random((40, 3)) * 400
    assert precision_of(exact.tolist()).source == "double precision"
    assert precision_of(exact.astype(np.float32).tolist()).source == "single precision"
    for decimals in (1, 2, 3, 6, 9):
        found = precision_of(exact.round(decimals).tolist())
        assert found.source == f"{decimals} decimals"
        np.testing.assert_allclose(found.size, 0.5 * 10.0**-decimals / np.abs(exact - exact.mean(0)).max(), rtol=0.01)
    for chosen in (rng.integers(0, 400, (40, 2)), rng.integers(0, 64, (40, 2)) / 16, rng.integers(0, 9, (40, 2)) / 10):
        assert precision_of(chosen.tolist()).source == "double precision"
    far = precision_of((exact + 1e9).tolist())
    assert far.size > 1e-10


def test_panels_off_their_planes_show_the_noise():
    rng = np.random.default_rng(1)
    prism = np.array([(x, y, 0.5 * (x % 2)) for y in range(4) for x in range(4)], dtype=float)
    faces = tuple((4 * i + j, 4 * i + j + 1, 4 * i + j + 5, 4 * i + j + 4) for i in range(3) for j in range(3))
    for noise in (1e-10, 1e-7):
        noisy = prism + rng.normal(size=prism.shape) * noise
        sheet = Sheet(16, (), "", faces, tuple(map(tuple, noisy.tolist())))
        precision = precision_of_sheet(sheet)
        assert precision.source in ("estimated", "panels off their planes")
        assert noise / 10 < precision.size < 10 * noise
        assert infinitesimal_mobility(sheet).dof == exact_freedoms(
            Sheet(16, (), "", faces, tuple(map(tuple, (2 * prism).tolist())))
        )


def grid(size, rng=None):
    """A flat grid of quads, or folded along its parallel lines."""
    places = SIZE * np.array([(j, i + 0.3 * (j % 2), 0.0) for i in range(size + 1) for j in range(size + 1)])
    if rng is not None:
        places[:, 2] = np.repeat([rng.permutation(size + 1) * 250.0], size + 1, axis=0).ravel()
    at = np.arange((size + 1) ** 2).reshape(size + 1, size + 1)
    faces = [
        tuple(map(int, (at[i, j], at[i, j + 1], at[i + 1, j + 1], at[i + 1, j])))
        for i in range(size)
        for j in range(size)
    ]
    return Sheet(len(places), (), "", tuple(faces), tuple(map(tuple, places.tolist())))


@pytest.mark.parametrize("folded", [False, True])
@pytest.mark.parametrize("size", [12, pytest.param(24, marks=pytest.mark.slow)])
def test_large_matrices_by_parts(size, folded):
    """Nested dissection, singular values, and ranks modulo a prime: three ways to one rank."""
    sheet = grid(size, np.random.default_rng(2) if folded else None)
    mechanism = mechanism_of_sheet(sheet)
    matrix = closure_at_configuration(sheet, mechanism).toarray()
    places = np.repeat(np.array(sheet.coordinates)[list(mechanism.loop_vertices)], 3, axis=0)
    none = np.zeros(matrix.shape[1])
    parts = sparse_spectrum(scipy.sparse.csr_matrix(matrix), places, none, none)
    assert parts.rank == spectrum(matrix).rank == matrix.shape[1] - exact_freedoms(sheet)
    assert parts.gap > 1e9


@pytest.mark.parametrize("size", [300, slow(600)])
def test_small_singular_values_by_parts(size):
    """What is small of the whole, and not of a part, is found, with its figure."""
    rng = np.random.default_rng(4)
    small = np.array([3e-3, 1e-5, 1e-8, 1e-13])
    diagonals = [rng.uniform(0.5, 1.0, size), rng.uniform(-1.0, -0.5, size)]
    bands = scipy.sparse.diags(diagonals, [0, 3], shape=(size, size + 4)).toarray()
    left, values, right = np.linalg.svd(bands, full_matrices=False)
    values[-4:] = small * values[0]
    matrix = scipy.sparse.csr_matrix(left @ np.diag(values) @ right)
    found = sparse_spectrum(matrix, np.arange(float(size))[:, None], np.full(size + 4, 1e-12), np.full(size + 4, 1e-3))
    assert (found.rank, found.nearly) == (size - 1, 3)
    np.testing.assert_allclose(found.smallest, 1e-8, rtol=0.01)
    assert number_below(matrix, 1e-4 * values[0]) == 4 + 3
    assert number_below(matrix, 1e-4 * values[0], ordered=True) == 4 + 3


@pytest.mark.parametrize("size", [12, slow(18)])
def test_parts_with_noise_in_them(size):
    """A large flat grid with noise of its heights: as flat as the noise is small."""
    flat = grid(size)
    rng = np.random.default_rng(7)
    truth = exact_freedoms(flat)
    for noise in (1e-13, 1e-9, 1e-5):
        places = np.array(flat.coordinates)
        places[:, 2] += rng.normal(size=len(places)) * noise * SIZE * size
        found = infinitesimal_mobility(Sheet(flat.vertices, (), "", flat.faces, tuple(map(tuple, places.tolist()))))
        if noise < 1e-6:
            assert (found.dof, found.spectrum.certainty) == (truth, "numerical")
        else:
            assert found.dof is None or found.dof <= truth <= found.dof + found.spectrum.nearly


def test_a_singular_conformed_position_with_noise():
    """A four-bar on a diameter: two freedoms; azimuths that are a little off are never told with certainty."""
    four_bar = ConformedChain.of(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))
    rng = np.random.default_rng(1)
    noises = np.array([0.0, 1e-15, 1e-13, *10 ** rng.uniform(-13, -4, size=200)])
    places = np.array([0.0, 0.0, np.pi, np.pi]) + rng.normal(size=(len(noises), 4)) * noises[:, None]
    motion = first_order(four_bar, places)
    assert (motion.freedoms[:3] == 2).all()
    certain = (motion.undecided == 0) & (motion.nearly == 0)
    assert (motion.freedoms[certain] == 2).all()
    told = motion.undecided == 0
    assert (motion.freedoms[told] + motion.nearly[told] >= 2).all()
    assert np.isnan(motion.rates[~told]).all()


def test_lines_drawn_apart_show_the_noise():
    """A square of pleats, every line drawn apart by a millionth: noise, as far as ends that were welded tell."""
    rng = np.random.default_rng(2)
    ends = [((i, j), (i + 1, j)) for i in range(4) for j in range(5)] + [
        ((i, j), (i, j + 1)) for i in range(5) for j in range(4)
    ]
    letters = "".join("B" if a[k] == b[k] in (0, 4) else "V" for a, b in ends for k in [int(a[0] == b[0]) ^ 1])
    drawn = np.array(ends, dtype=float) + rng.normal(size=(len(ends), 2, 2)) * 4e-6
    sheet = trace_sheet(Lines(drawn, letters))
    assert precision_of_sheet(sheet).source == "ends that were welded"
    assert 1e-6 < precision_of_sheet(sheet).size < 1e-5
    exact = trace_sheet(Lines(np.array(ends, dtype=float), letters))
    assert infinitesimal_mobility(sheet).dof == infinitesimal_mobility(exact).dof


def test_no_pattern_is_too_large_for_its_freedoms():
    answer = synth.mobility(grid(27), motion=False)
    assert answer.joints > 1400
    assert answer.exact.mobility == 0
    assert (answer.infinitesimal.dof, answer.infinitesimal.spectrum.certainty) == (52, "nearly mobile")


@pytest.mark.parametrize("size", [18, slow(27)])
def test_what_is_nearly_mobile_does_not_depend_on_the_elimination(size):
    """Large and small patterns are judged alike, and vertices may have any numbers."""
    sheet = grid(size)
    mechanism = mechanism_of_sheet(sheet)
    matrix = closure_at_configuration(sheet, mechanism)
    error, nearly = np.full(matrix.shape[1], 1e-12), np.full(matrix.shape[1], 0.02)
    places = np.repeat(np.array(sheet.coordinates)[list(mechanism.loop_vertices)], 3, axis=0)
    of_all = spectrum(matrix.toarray(), error, nearly)
    shuffled = np.random.default_rng(1).permutation(matrix.shape[0])
    for rows in (np.arange(matrix.shape[0]), shuffled):
        for at in (places, places[:, ::-1]):
            by_parts = sparse_spectrum(matrix[rows], at[rows], error, nearly)
            assert (by_parts.rank, by_parts.nearly) == (of_all.rank, of_all.nearly)
    assert of_all.nearly > 0
