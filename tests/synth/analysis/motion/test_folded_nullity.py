"""Degrees of freedom of the verdict are the nullity of the closure equations at folded configurations of the branch."""

import numpy as np
import pytest
from folded_nullity import FOLDS, folded_nullity
from real_patterns import folder_of_patterns, names_of_patterns

from graphs.errors import SynthedraError
from graphs.files.formats import read
from graphs.mechanism.sheet import Sheet, with_all_edges
from synth.analysis.verdict._mobility import mobility
from synth.catalogue.patterns import generate
from synth.catalogue.patterns.creases import fan, map_sheet, miura

MOST_JOINTS = 700
"""Of more joints the spectrum of a full matrix takes minutes."""
LEAST_GAP = 6.0
"""Powers of ten between the least value that is counted and the largest that is zero."""
SHEETS = {
    "miura": lambda: miura(3, 4, 1.1),
    "map": lambda: map_sheet(3, 3),
    "fan": lambda: fan(np.radians((0, 50, 110, 180, 250, 300))),
    "square-twist": lambda: generate("square-twist").mechanism,
}


def assert_as_many(sheet, verdict):
    folded = folded_nullity(sheet)
    assert folded.freedoms in (None, verdict.freedoms)
    assert set(folded.nullities) <= {verdict.freedoms}
    assert folded.gap > LEAST_GAP
    return len(folded.nullities)


@pytest.mark.parametrize("name", SHEETS)
def test_freedoms_of_generated_sheets(name):
    sheet = SHEETS[name]()
    assert assert_as_many(sheet, mobility(sheet).verdict) == FOLDS


def test_creases_in_no_loop_count_on_branches_that_are_not_listed():
    """A flap on a Miura sheet of more branches than are listed adds its freedom to all of them."""
    sheet = miura(10, 6, 1.0)
    first = sheet.faces[0]
    rim = next(
        (a, b)
        for a, b in zip(first, (*first[1:], first[0]), strict=True)
        if sum({a, b} <= set(face) for face in sheet.faces) == 1
    )
    (a, b), inside = rim, next(vertex for vertex in first if vertex not in rim)
    places = sheet.coordinates
    beyond = tuple(places[a][k] + places[b][k] - places[inside][k] for k in range(2))
    faces = (*sheet.faces, (b, a, sheet.vertices))
    with_flap = with_all_edges(Sheet(sheet.vertices + 1, (), "", faces, (*places, beyond)))
    kinds = mobility(sheet, exact=False).verdict.count.kinds
    verdict = mobility(with_flap, exact=False).verdict
    assert verdict.count.kinds == {freedoms + 1: number for freedoms, number in kinds.items()}
    assert verdict.freedoms in verdict.count.kinds


@pytest.mark.slow
@pytest.mark.parametrize("name", names_of_patterns())
def test_freedoms_of_patterns_by_other_people(name):
    try:
        mechanism = read(folder_of_patterns() / name)
        sheet = getattr(mechanism, "mechanism", mechanism)
        verdict = mobility(sheet).verdict
    except SynthedraError as error:
        pytest.skip(str(error))
    if not verdict.freedoms or len(verdict.branches[0].signs) > MOST_JOINTS:
        pytest.skip("rigid, unknown or large")
    assert_as_many(sheet, verdict)
