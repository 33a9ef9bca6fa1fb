"""Panels taken off sheets: what is left is a sheet, its vertices as they were."""

import numpy as np
import pytest

import synth
from graphs.creasing.edits import take_off_panels
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.reduce.ride_alongs import reduce
from synth.catalogue.patterns.creases import miura


def test_creases_beside_them_are_borders_and_the_rest_stays():
    sheet = miura(3, 3, np.radians(60.0))
    after = take_off_panels(sheet, {0}).sheet
    assert len(after.faces) == len(sheet.faces) - 1
    assert after.coordinates == sheet.coordinates
    letters = {frozenset(edge): letter for edge, letter in zip(after.edges, after.assignments, strict=True)}
    shared = [edge for edge in map(frozenset, sheet.edges) if edge <= set(sheet.faces[0])]
    beside = [edge for edge in shared if sum(edge <= set(face) for face in sheet.faces) == 2]
    assert len(beside) == 2
    assert all(letters[edge] == "B" for edge in beside)
    assert not [edge for edge in shared if edge not in beside and edge in letters]


_SLOW = ["patterns/bird-base.fold", "realised/adjunct-chain.fold"]


@pytest.mark.parametrize(
    "name", ["wiener/miura-2x3.fold", *(pytest.param(one, marks=pytest.mark.slow) for one in _SLOW)]
)
def test_without_ride_alongs_it_moves_with_as_many_freedoms(data, name):
    sheet = read(data / name)
    reduction = reduce(sheet)
    links = {link for step in reduction.steps for link in step.removed}
    edit = take_off_panels(sheet, links)
    assert edit.counted == 0
    assert len(edit.sheet.faces) == len(reduction.graph) < len(sheet.faces)
    assert synth.mobility(edit.sheet).verdict.freedoms == synth.mobility(sheet).verdict.freedoms


def test_what_is_no_panel_and_what_would_leave_none_is_refused():
    sheet = miura(2, 2, np.radians(60.0))
    with pytest.raises(InvariantError, match="4 is no panel of the sheet; expected a number from 0 to 3"):
        take_off_panels(sheet, {1, 4})
    with pytest.raises(UnsolvableError, match="no panel would be left"):
        take_off_panels(sheet, range(4))
