"""Which panels to crease, against sheets that are creased."""

from itertools import combinations
from math import radians

import numpy as np
import pytest
from sizes import slow

from graphs.creasing.edits import crease_sheet
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.mechanism.sheet import Sheet
from graphs.rank.infinitesimal import infinitesimal_mobility
from synth.analysis.advice.advice import advise
from synth.analysis.advice.diagonals import diagonals_of, freedoms_when_creased, loads_on_stresses
from synth.analysis.advice.locks import general_configuration
from synth.analysis.moving._configuration_of import configuration_of
from synth.catalogue.patterns._generate import generate


def folded_miura(size):
    return generate("miura", rows=size, columns=size, fold=radians(60)).mechanism


def creased(sheet, diagonals):
    for one in diagonals:
        sheet = crease_sheet(sheet, *one.ends).sheet
    return sheet


@pytest.mark.parametrize("sheet", [folded_miura(3), slow(generate("box-pop-up").mechanism)], ids=["miura", "pop-up"])
def test_columns_say_what_the_creased_sheet_does(sheet):
    """Rates by columns on the self-stresses, and by the closure equations of the sheet with the creases."""
    pose = general_configuration(configuration_of(sheet))
    diagonals = diagonals_of(pose)
    loads, flaps = loads_on_stresses(pose, diagonals)
    assert any(flaps)
    rng = np.random.default_rng(0)
    pairs = [
        pair for pair in combinations(range(len(diagonals)), 2) if not diagonals[pair[0]].crosses(diagonals[pair[1]])
    ]
    for places in [*((k,) for k in range(len(diagonals))), *rng.permutation(pairs)[:20].tolist()]:
        gained = len(places) - np.linalg.matrix_rank(loads[:, list(places)], tol=1e-8)
        made = creased(pose.sheet, [diagonals[place] for place in places])
        assert infinitesimal_mobility(made).dof == pose.freedoms + gained


def test_a_miura_sheet_gets_its_freedom_in_corner_panels_only():
    advice = advise(folded_miura(4), 2)
    assert (advice.freedoms, advice.branch, advice.more) == (1, None, False)
    assert sorted(made.diagonals[0].panel for made in advice.creases) == [0, 3, 12, 15]
    assert all(len(made.diagonals) == made.flaps == 1 for made in advice.creases)
    assert advice.refused == 4  # through the inner vertex of a corner panel: three creases in its plane


@pytest.mark.slow
def test_no_other_diagonal_of_a_miura_sheet_is_a_freedom():
    pose = general_configuration(configuration_of(folded_miura(4)))
    gained = [one.panel for one in diagonals_of(pose) if freedoms_when_creased(pose.sheet, [one]) == 2]
    assert sorted(gained) == [0, 3, 12, 15]


def test_protected_panels_are_not_creased():
    advice = advise(folded_miura(3), 2, links=[0, 2])
    assert sorted(made.diagonals[0].panel for made in advice.creases) == [6, 8]


@pytest.mark.slow
def test_without_flaps_more_diagonals_are_needed():
    advice = advise(folded_miura(3), 2, flaps=False, limit=1)
    assert [(len(made.diagonals), made.flaps) for made in advice.creases] == [(2, 0)]


def test_diagonals_are_inside_panels_and_keep_clear_of_corners():
    corners = ((0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2), (3, 0), (3, 1))
    angle = Sheet(8, ((1, 2),), "V", ((0, 1, 2, 3, 4, 5), (1, 6, 7, 2)), corners)
    ends = {one.ends for one in diagonals_of(general_configuration(configuration_of(angle))) if one.panel == 0}
    assert ends == {(0, 2), (0, 3), (0, 4), (1, 3), (3, 5)}  # 1-4, 1-5 and 2-5 pass or touch corner 3; 2-4 is outside


def test_where_nothing_is_idle_each_diagonal_is_a_freedom():
    """A vertex of four creases, its panels squares: each of the eight diagonals."""
    at = [(-1, 1), (0, 1.1), (1, 1), (-1.2, 0), (0, 0), (1, 0), (-1, -1), (0.1, -1), (1, -1)]
    faces = ((0, 3, 4, 1), (1, 4, 5, 2), (3, 6, 7, 4), (4, 7, 8, 5))
    sheet = Sheet(9, ((4, 1), (4, 3), (4, 5), (4, 7)), "VVVM", faces, tuple(at))
    advice = advise(sheet, 2, limit=2)
    assert (advice.freedoms, advice.refused, advice.more) == (1, 0, True)
    assert [made.flaps for made in advice.creases] == [0, 1]


@pytest.mark.parametrize("height", [0.0, pytest.param(0.5, marks=pytest.mark.slow)])
def test_what_is_rigid_gets_its_first_freedom(height):
    """Three creases in a point, of panels with four corners: flat, with rates that go nowhere, and folded."""
    around = [(np.cos(k * np.pi / 3 + 0.02 * k * k), np.sin(k * np.pi / 3 + 0.02 * k * k), 0.0) for k in range(6)]
    at = np.array([(0.0, 0.0, height), *around])
    if height:  # the outer corner of a panel is in its plane
        at[[2, 4, 6]] = 0.6 * (at[[1, 3, 5]] + at[[3, 5, 1]]) - 0.2 * at[0]
    faces = ((0, 1, 2, 3), (0, 3, 4, 5), (0, 5, 6, 1))
    sheet = Sheet(7, ((0, 1), (0, 3), (0, 5)), "VVV", faces, tuple(map(tuple, at.tolist())))
    advice = advise(sheet, 1, flaps=False)
    assert (advice.freedoms, advice.branch) == (0, None)
    assert {made.diagonals[0].ends for made in advice.creases} == {(0, 2), (0, 4), (0, 6)}


def test_what_has_no_panels_is_not_creased(data):
    with pytest.raises(UnsolvableError, match="only panels of a sheet"):
        advise(read(data / "linkages" / "sarrus.json"), 2)


def test_a_size_that_is_too_small_is_refused():
    with pytest.raises(InvariantError, match="size: 1; expected 2 or more"):
        advise(folded_miura(3), 3, size=1)
