"""All types of a size and pop-ups as templates: cut out in software, folded up, glued, moved.

Types are realised in space, so that they have nets with tabs, and as flat sheets, which are one piece.
"""

import numpy as np
import pytest
from cut_and_folded import check_closes, check_cuts, check_tabs
from realised_sets import codes_of, explicit_codes_of

from graphs.errors import SynthedraError
from graphs.identity.drawings import mechanism_from_map_id
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import with_all_edges
from synth.analysis.folding.motion import fold
from synth.catalogue.patterns._generate import generate
from synth.catalogue.realisation._realise import realise
from synth.making.templates.template import template_of
from synth.making.templates.unfolding import Panels

SIZE = 200
SIX_LINKS = ("m1:a-b.ac-.bde.cef.d-g.fg-", "m1:a---b.ac--.bde.cef-.d--g.fg--")
"""Of the types of six links with one freedom."""
POP_UPS = [
    ("box-pop-up", {"fold": 0.6}),
    ("box-pop-up", {"fold": 1.5, "depth": 0.6}),
    ("box-pop-up", {"fold": 1.0, "more": 1.2}),
    ("box-pop-up", {"fold": 1.0, "width": 2.0}),
    ("slit-array", {"fold": 1.0}),
    ("slit-array", {"fold": 1.4, "depth": 0.7}),
    ("slit-array", {"strips": 3, "fold": 1.0}),
    ("crash-lock", {}),
    ("crash-lock", {"opening": 1.0}),
    ("crash-lock", {"width": 1.8}),
]
"""Cards and cartons that pop up; the last have a bottom of panels that are glued."""


def check(sheet, poses=()):
    """Return how many tabs the template of what stands in space has."""
    whole = with_all_edges(sheet)
    places = in_space(whole.coordinates)
    factor = SIZE / np.ptp(places, axis=0).max()
    template = template_of(sheet, size=SIZE)
    for piece in template.pieces:
        check_cuts(piece)
    panels = Panels(whole, places * factor)
    check_closes(panels)
    return check_tabs(panels, template.pieces, [pose * factor for pose in poses])


def moved(sheet):
    """Poses of what stands, with the same vertices."""
    try:
        folding = fold(sheet, frames=2)
    except SynthedraError:
        return []
    return [] if folding.configuration.sheet.vertices != sheet.vertices else list(folding.places)


@pytest.mark.parametrize(
    ("name", "parameters"),
    [one if one in (POP_UPS[0], POP_UPS[7]) else pytest.param(*one, marks=pytest.mark.slow) for one in POP_UPS],
)
def test_pop_ups_close_and_their_tabs_hinge_all_along_their_motion(name, parameters):
    sheet = generate(name, **parameters).mechanism
    tabs = check(sheet, moved(sheet))
    assert (tabs > 0) == (name == "crash-lock")


def check_types(codes):
    tabs = 0
    for code in codes:
        scd = mechanism_from_map_id(code)
        sheet = realise(scd, kind="space").sheet
        tabs += check(sheet, moved(sheet))
    assert tabs > len(codes) / 4


def test_types_of_six_links_close_in_space_and_their_tabs_hinge_all_along_their_motion():
    check_types(SIX_LINKS[1:])


@pytest.mark.slow
def test_every_type_of_six_links_closes_in_space_and_its_tabs_hinge_all_along_its_motion():
    check_types(codes_of(6, 5))


def check_flat(codes):
    for code in codes:
        sheet = realise(mechanism_from_map_id(code), tries=2).sheet
        (piece,) = template_of(sheet, size=SIZE).pieces
        check_cuts(piece)
        assert piece.covered.area == pytest.approx(sum(_areas(sheet)), rel=1e-9)


def _areas(sheet):
    places = np.array(sheet.coordinates)[:, :2]
    places = places * SIZE / np.ptp(places, axis=0).max()
    for face in sheet.faces:
        x, y = places[list(face)].T
        yield abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def test_flat_sheets_of_six_links_are_one_piece():
    check_flat(SIX_LINKS[:1])


@pytest.mark.slow
def test_every_flat_sheet_of_six_links_is_one_piece():
    check_flat(explicit_codes_of(6, 5))
