"""Centres at infinity in space: axes round a hole are parallel, and the type reads back from its file."""

import numpy as np
import pytest

from enumerate.scd.jobs import scd_graphs
from graphs.answer.identity import identify
from graphs.files.formats import read, write
from graphs.identity.drawings import map_id, mechanism_from_map_id
from synth.analysis.motion.linkage import linkage_of_sheet
from synth.catalogue.realisation._realise import NotFoundError, realise
from synth.catalogue.realisation.pattern import pattern_of

RINGS = ["m1:a--b-.a--c-.b-d-.c-d-;i", "m1:a-b--.a--c-.bde-.c-ef.d-g.fg-;if"]


def _check(code, folder, tries):
    found = realise(mechanism_from_map_id(code), kind="space", tries=tries)
    place = folder / "found.fold"
    write(found.sheet, place, force=True)
    assert identify(read(place)).drawing == code
    assert found.figures.planarity < 1e-12
    assert found.freedoms == found.mobility
    return found


@pytest.mark.parametrize("code", RINGS)
def test_axes_through_a_centre_at_infinity_are_parallel(code, tmp_path):
    found = _check(code, tmp_path, 2)
    places = np.array(found.sheet.coordinates)
    for one in pattern_of(found.scd).pointings:
        ends = places[[found.sheet.edges[crease] for crease in one.creases]]
        along = ends[:, 1] - ends[:, 0]
        along /= np.linalg.norm(along, axis=1)[:, None]
        assert one.infinite == (np.linalg.svd(along)[1][1] < 1e-12)


def test_letters_are_those_of_the_pose():
    sheet = realise(mechanism_from_map_id(RINGS[1]), kind="space", tries=1).sheet
    turns = linkage_of_sheet(sheet).angles
    assert sheet.assignments.startswith("".join("V" if turn > 0 else "M" for turn in turns))


@pytest.mark.slow
@pytest.mark.parametrize(("links", "most", "types"), [(4, 6, 231), (6, 5, 423)])
def test_all_types_with_a_centre_at_infinity(links, most, types, tmp_path):
    scds = list(scd_graphs(links, 1, most, infinite=True))
    codes = [map_id(scd) for scd in scds if any(one.infinite for one in pattern_of(scd).pointings)]
    assert len(codes) == types
    found = []
    for code in codes:
        try:
            found.append(_check(code, tmp_path, 12))
        except NotFoundError:
            continue
    assert len(found) >= 0.99 * types
    assert sum(one.figures.quality >= 1.0 for one in found) >= 0.9 * types
