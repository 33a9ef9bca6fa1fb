"""R/- strings as strips: they read back to the string, and their bodies have the freedoms that the string says."""

from itertools import pairwise

import numpy as np
import pytest
from read_strings import string_of_chain

from enumerate.strings.panel_strings import ChainString, chain_scd, strings
from graphs.convert.conversions import to_scd
from graphs.files.formats import read, write
from synth.analysis.motion.linkage import linkage_of_sheet
from synth.catalogue.realisation._realise import realise
from synth.catalogue.realisation.measures import crossings
from synth.catalogue.realisation.pattern import pattern_of
from synth.catalogue.realisation.strips import drawn_string, strips


def _freedoms_between_bodies(sheet) -> int:
    """The rank of the twists of all creases, lines in space."""
    points = np.array(sheet.coordinates)
    twists = []
    for (a, b), letter in zip(sheet.edges, sheet.assignments, strict=True):
        if letter != "B":
            along = (points[b] - points[a]) / np.linalg.norm(points[b] - points[a])
            twists.append([*along, *np.cross(points[a], along)])
    return int(np.linalg.matrix_rank(np.array(twists), tol=1e-6))


@pytest.mark.parametrize("creases", [3, *(pytest.param(many, marks=pytest.mark.slow) for many in (1, 2, 4, 5, 6))])
def test_a_strip_reads_back_to_its_string_and_has_its_freedoms(creases, tmp_path):
    for chain in strings(creases):
        flat, folded = (realise(chain, kind=kind) for kind in ("sheet", "space"))
        write(flat.sheet, tmp_path / f"{chain.text}.fold")
        again, _ = string_of_chain(to_scd(read(tmp_path / f"{chain.text}.fold")))
        assert again.canonical == chain.canonical
        assert flat.freedoms == folded.freedoms == flat.mobility == creases
        assert flat.folds
        assert _freedoms_between_bodies(folded.configuration.sheet) == chain.dof


def test_creases_beside_a_dash_are_parallel_and_no_others_are():
    chain = ChainString.parse("RR-R-RRR")
    for kind in ("sheet", "space"):
        sheet = realise(chain, kind=kind, seed=5).sheet
        points = np.array(sheet.coordinates)
        along = [points[b] - points[a] for a, b in sheet.edges[: chain.creases]]
        sines = [np.sqrt(max(0.0, 1 - (u @ v) ** 2 / ((u @ u) * (v @ v)))) for u, v in pairwise(along)]
        assert [sine < 1e-7 for sine in sines] == [False, True, True, False, False]


def test_panels_between_parallel_creases_are_rectangles_in_space():
    found = realise(ChainString.parse("RR-R-RRR"), kind="space", seed=2)
    points = np.array(found.sheet.coordinates)
    for panel in (found.sheet.faces[place] for place in (0, 2, 3, 6)):
        sides = np.roll(points[list(panel)], -1, axis=0) - points[list(panel)]
        assert np.abs((sides * np.roll(sides, 1, axis=0)).sum(axis=1)).max() < 1e-12


@pytest.mark.parametrize("text", ["R", "RRRRRRRRRRRR", "RR-RR-RR-RR-RR-RR", "RRRR-R-RR-RRRR"])
def test_strips_do_not_cross_themselves_however_long_they_are(text):
    pattern = pattern_of(drawn_string(ChainString.parse(text))[0])
    drawn = list(strips(pattern, 1, 4))
    assert len(drawn) == 4
    for one in drawn:
        assert crossings(pattern, one.places) == 0
        assert one.angles.min() > np.radians(5.0)


def test_what_a_string_is_is_told():
    found = realise(ChainString.parse("RRR-RRR"), tries=1)
    assert "joints SS, 5 freedoms" in found.notes[0]
    assert "one side" in found.notes[1]


def test_letters_in_space_are_those_of_the_pose():
    sheet = realise(ChainString.parse("RR-R-RRR"), kind="space").sheet
    turns = linkage_of_sheet(sheet).angles
    assert "".join("V" if turn > 0 else "M" for turn in turns) == sheet.assignments[:6] == "VMVMVM"
    assert np.abs(turns).min() > np.radians(29.0)


@pytest.mark.parametrize("ends", [(3, 3), (4, 5), (6, 3)])
def test_an_open_chain_of_such_panels_is_a_strip(ends):
    scd = chain_scd(ChainString.parse("RR-R-RRR"), ends=ends)
    found = realise(scd, tries=1)
    points = np.array(found.sheet.coordinates)
    for panel in (2, 3):
        corners = points[list(found.sheet.faces[panel])]
        sides = np.roll(corners, -1, axis=0) - corners
        assert np.abs((sides * np.roll(sides, 1, axis=0)).sum(axis=1)).max() < 1e-12
    assert tuple(len(found.sheet.faces[place]) for place in (0, -1)) == ends
    assert found.figures.greatest_angle < np.pi
    assert crossings(pattern_of(scd), points) == 0
