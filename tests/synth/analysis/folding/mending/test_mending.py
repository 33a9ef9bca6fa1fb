"""Rounded coordinates moved within their precision: sheets that fold again, and such as are left as they are."""

from dataclasses import replace

import numpy as np
import pytest
from sizes import slow

from graphs.convert.duality import mechanism_of_sheet
from graphs.files.formats import read
from graphs.mechanism.precision import precision_of_sheet
from graphs.mechanism.sheet import Sheet
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.folding.mending.fitting import MeantAngles, VertexPlaces
from synth.analysis.folding.mending.near_mechanisms import flattened
from synth.analysis.folding.motion import fold
from synth.analysis.motion.branches import branches_of
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import linkage_of_sheet
from synth.catalogue.patterns.creases import fan, miura


def disturbed(sheet, noise, seed=0):
    """A sheet with noise on its coordinates, written to so many decimals as the noise is."""
    points = np.array(sheet.coordinates)
    points = points + np.random.default_rng(seed).uniform(-noise, noise, points.shape)
    decimals = round(-np.log10(noise))
    return replace(sheet, coordinates=tuple(map(tuple, points.round(decimals).tolist())), fold_angles=None)


def farthest(one, other):
    return np.abs(np.array(one.coordinates) - np.array(other.coordinates)).max()


@pytest.mark.parametrize(("size", "noise"), [(3, 1e-5), slow(4, 1e-6), slow(5, 1e-4)])
def test_a_noisy_miura_sheet_gets_all_its_branches_back(size, noise):
    noisy = disturbed(miura(size, size, 1.0), noise)
    as_written = branches_of(linkage_of_sheet(noisy)).branches  # squares of a noise of 1e-5 are hardly told from zero
    assert len(as_written) < 2 ** (size - 1)
    assert all(branch.certainty != "proved" for branch in as_written)
    pattern = configuration_of_sheet(noisy)
    assert [branch.certainty for branch in pattern.branches.branches] == ["proved"] * 2 ** (size - 1)
    assert sorted(branch.freedoms for branch in pattern.branches.branches) == [1] * (2 ** (size - 1) - 1) + [size - 1]
    assert 0.0 < farthest(pattern.sheet, noisy) < 4 * noise
    assert "so that angles that nearly agree are equal (coordinates precise to " in str(pattern.repairs[0])


def test_a_noisy_sheet_folds_and_says_what_was_moved():
    noisy = disturbed(miura(3, 3, 1.0), 1e-5)
    folded = fold(noisy, frames=3)
    assert folded.path.stopped == ""
    assert folded.closure < 1e-12
    assert folded.apart < 1e-12
    assert folded.to_json()["mended"] == [str(folded.configuration.repairs[0])]
    assert "\nrepaired: vertices moved by up to" in str(folded)


def test_a_folded_sheet_is_moved_along_its_motion():
    """No angles in its plane help: loops have to close at several poses, and panels to be plane."""
    crease = next(iter(mechanism_of_sheet(miura(3, 3, 1.0)).sc.joints))
    folded = fold(miura(3, 3, 1.0), drive={crease: 1.0}, frames=2).frames()[-1]
    noisy = disturbed(folded, 1e-6)
    linkage = linkage_of_sheet(noisy)
    assert not branches_of(linkage).branches
    pattern = configuration_of_sheet(noisy)
    assert [branch.freedoms for branch in pattern.branches.branches] == [1]
    assert farthest(pattern.sheet, noisy) < 4e-6


@pytest.mark.parametrize("sheet", [miura(3, 3, 1.0), disturbed(fan([0.1, 1.3, 2.9, 4.2, 5.1]), 1e-6)])
def test_what_moves_as_it_is_written_is_left(sheet):
    """Exact coordinates, and rounded ones of a vertex whose five creases agree anyway."""
    pattern = configuration_of_sheet(sheet)
    assert pattern.repairs == ()
    assert farthest(pattern.sheet, sheet) == 0.0


def test_what_is_rigid_stays_so():
    """Three creases that are far from a line do not fold by any small change."""
    rigid = disturbed(fan([0.1, 2.0, 4.4]), 1e-4)
    pattern = configuration_of_sheet(rigid)
    assert pattern.repairs == ()
    assert pattern.branches.no_motion == "proved"


def test_a_sheet_is_put_into_its_plane():
    sheet = fan(np.radians([0, 60, 180, 300]))
    lifted = [(x, y, z) for (x, y), z in zip(sheet.coordinates, [3e-7, 0, -2e-7, 1e-7, 0], strict=True)]
    lifted = replace(sheet, coordinates=tuple(lifted))
    mended = flattened(lifted, precision_of_sheet(lifted))
    assert 1e-7 < mended.moved < 4e-7
    assert precision_of_sheet(mended.sheet).size < 1e-12
    assert len(configuration_of_sheet(lifted).branches.branches) == 2
    tent = replace(sheet, coordinates=tuple((x, y, 0.3 - 0.3 * (x * x + y * y)) for x, y in sheet.coordinates))
    assert flattened(tent, precision_of_sheet(tent)) is None


def test_a_crease_of_two_pieces_is_made_straight():
    """Two squares joined along an edge with a vertex in the middle, turned so that rounding puts it off."""
    places = np.array([(0, 0), (0.7, 0), (2, 0), (2, 1), (0, 1), (2, -1), (0, -1)]) @ [[0.96, 0.28], [-0.28, 0.96]]
    sheet = Sheet(7, ((0, 1), (1, 2)), "VV", ((0, 1, 2, 3, 4), (2, 1, 0, 6, 5)), tuple(map(tuple, places.tolist())))
    bent = disturbed(sheet, 1e-5)
    folded = fold(bent, frames=2)
    assert folded.configuration.repairs
    assert folded.path.stopped == ""
    assert folded.apart < 1e-12


def test_derivatives_by_vertices_are_those_of_differences():
    sheet = fold(miura(2, 3, 1.0), branch=1, frames=3).frames()[2]
    mechanism = mechanism_of_sheet(sheet)
    linkage = linkage_of_sheet(sheet, mechanism)
    places = VertexPlaces(sheet, mechanism, linkage)
    angles = corrected_angles(linkage)
    step = np.random.default_rng(1).normal(size=places.unknowns) * 1e-6

    def residual(corners):
        return ClosureEquations(places.linkage(corners)).at(angles)[0]

    by = ClosureEquations(places.linkage(places.given)).by_axes(angles) @ places.motions_of_axes(places.given)
    change = residual(places.moved(step)) - residual(places.given)
    assert np.abs(change).max() > 1e-7
    assert np.abs(change - by @ step).max() < 1e-4 * np.abs(change).max()
    off, across = places.plane_residual(places.given)
    after, _ = places.plane_residual(places.moved(step))
    assert np.abs(np.abs(after - off) - np.abs(across @ step)).max() < 1e-4 * np.abs(after).max()


def corrected_angles(linkage):
    """A closed pose a little beside that of the linkage."""
    found = branches_of(linkage).branches[0]
    return found.sample


def test_meant_angles_hold_at_exact_coordinates():
    sheet = miura(4, 3, 1.1)
    mechanism = mechanism_of_sheet(sheet)
    linkage = linkage_of_sheet(sheet, mechanism)
    places = VertexPlaces(sheet, mechanism, linkage)
    meant = MeantAngles(places, 1e-6)
    assert len(meant) > 20
    assert np.abs(meant.residual(places.given)).max() < 1e-14


@pytest.mark.parametrize(
    ("name", "branches"),
    [
        ("ossvg_singlesquaretwist.svg", 6),
        ("ossvg_pinwheelBase.svg", 6),
        slow("osbo_birdBase.fold", 16),
        pytest.param("ossvg_flappingBird.svg", 20, marks=pytest.mark.slow),
    ],
)
def test_patterns_of_others_with_rounded_coordinates_fold(fold_folder, name, branches):
    pattern = configuration_of_sheet(read(fold_folder / name))
    assert len(pattern.branches.branches) == branches
    assert pattern.repairs
    precision = pattern.repairs[0].precision.size
    assert pattern.repairs[0].moved <= 4 * precision
    assert all(branch.freedoms for branch in pattern.branches.branches)
