"""Whole sets of types: each is realised, reads back from its file, has a shape, and moves as the type does."""

import numpy as np
import pytest
from realised_sets import TURN, codes_of, explicit_codes_of, moved

from graphs.answer.identity import identify
from graphs.errors import UnsolvableError
from graphs.files.formats import read, write
from graphs.identity.drawings import mechanism_from_map_id
from synth.analysis.motion.branches import first_branch
from synth.analysis.motion.linkage import linkage_of_sheet
from synth.catalogue.realisation._realise import realise
from synth.catalogue.realisation.measures import crossings
from synth.catalogue.realisation.pattern import pattern_of

SETS = {4: (4, 6), 6: (6, 5), 8: (8, 4), 10: (10, 4, 1000)}
SIZES = {4: 286, 6: 873, 8: 260, 10: 1000}


def _found(codes, kind):
    """Return what is realised of a set, and of the others why they are not."""
    found, missed = {}, {}
    for code in codes:
        try:
            found[code] = realise(mechanism_from_map_id(code), kind=kind)
        except UnsolvableError as error:
            missed[code] = str(error)
    return found, missed


def _share_of_good_shape(found):
    return sum(one.figures.quality >= 1.0 for one in found.values()) / len(found)


def _check_read_back(one, code, folder):
    place = folder / "found.fold"
    write(one.sheet, place, force=True)
    assert identify(read(place)).drawing == code


def _check_in_space(codes, folder):
    found, missed = _found(codes, "space")
    assert not missed
    for code, one in found.items():
        _check_read_back(one, code, folder)
        assert one.figures.planarity < 1e-12, code
        assert one.freedoms == one.mobility == 1, code
    assert _share_of_good_shape(found) >= 0.95


def _check_moves(codes):
    found, missed = _found(codes, "space")
    assert not missed
    for code, one in found.items():
        motion = moved(one.sheet)
        assert motion.turned >= TURN * 0.999 or motion.limit, code
        assert motion.freedoms == {one.mobility}, code
        assert motion.closure < 1e-12, code


def _check_flat(codes, folder):
    found, missed = _found(codes, "sheet")
    assert not missed
    for code, one in found.items():
        _check_read_back(one, code, folder)
        assert one.figures.greatest_angle < np.pi, code
        assert crossings(pattern_of(one.scd), np.array(one.sheet.coordinates)) == 0, code
        assert one.freedoms == len(one.scd.joints) - 2 * len(one.scd.loops), code
        way = first_branch(linkage_of_sheet(one.sheet), lambda rates: bool(np.abs(rates).min() > 1e-7))
        assert one.folds == (way is not None), code
        if way is None:
            assert "none folds on every crease" in str(one), code
        else:
            assert way.freedoms == one.mobility, code
            assert way.error < 1e-12, code
    assert _share_of_good_shape(found) >= 0.95


def test_some_types_in_space(tmp_path):
    codes = codes_of(4, 6)
    assert len(codes) == SIZES[4]
    _check_in_space(codes[40::120], tmp_path)


def test_some_types_move_from_their_pose_in_space():
    _check_moves(codes_of(4, 5)[-1:])


def test_some_types_as_flat_sheets(tmp_path):
    _check_flat(explicit_codes_of(4, 4)[:2], tmp_path)


@pytest.mark.parametrize("code", ["m1:a-b-.a--cd.b-e-.c--ef.dg-.f-g", "m1:a--b-.a-c-.b-de-.c-fd-.eg---.f---g"])
def test_shape_is_found_in_the_first_drawing(code):
    assert realise(mechanism_from_map_id(code), kind="space", tries=1).figures.quality >= 1.0


@pytest.mark.slow
@pytest.mark.parametrize("links", SETS)
def test_all_types_in_space(links, tmp_path):
    codes = codes_of(*SETS[links])
    assert len(codes) == SIZES[links]
    _check_in_space(codes, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("links", SETS)
def test_all_types_move_from_their_pose_in_space(links):
    _check_moves(codes_of(*SETS[links]))


@pytest.mark.slow
@pytest.mark.parametrize("links", SETS)
def test_all_explicit_types_as_flat_sheets(links, tmp_path):
    _check_flat(explicit_codes_of(*SETS[links]), tmp_path)
