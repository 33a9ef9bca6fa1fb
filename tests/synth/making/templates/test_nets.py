"""Panels in space as nets with tabs: true, beside each other, closed again when they are folded."""

from collections import Counter
from functools import cache

import numpy as np
import pytest
import shapely
from commands import run
from cut_and_folded import check_cuts, check_tabs, folded_up
from measured import lengths, lines_of_svg

from graphs.errors import UnsolvableError
from graphs.files.formats import read
from graphs.identity.drawings import mechanism_from_map_id
from graphs.mechanism.sheet import Sheet, with_all_edges
from synth.catalogue.patterns._generate import generate
from synth.catalogue.patterns.generators import GENERATORS
from synth.catalogue.realisation._realise import realise
from synth.making.templates.nets import tab_at
from synth.making.templates.pieces import put_together, united
from synth.making.templates.template import template_of
from synth.making.templates.unfolding import Panels, nets_of

CUBE = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
CORNERS = tuple((x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1))
OCTAHEDRON = Sheet(
    6,
    (),
    "",
    tuple((a, b, c) if (a + b + c) % 2 == 0 else (a, c, b) for a in (0, 1) for b in (2, 3) for c in (4, 5)),
    ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)),
)
CASES = {
    "cube": Sheet(8, (), "", CUBE, CORNERS),
    "cube, one face the other way round": Sheet(8, (), "", (*CUBE[:5], CUBE[5][::-1]), CORNERS),
    "octahedron": OCTAHEDRON,
    "tube": "miura-tube",
    "storey": "kresling",
    "pop-up": "box-pop-up",
}


@cache
def sheet_of(case):
    return generate(case, fold=1.0 if GENERATORS[case].foldable else None).mechanism if isinstance(case, str) else case


def area(corners):
    arms = corners - corners[0]
    return np.linalg.norm(np.cross(arms, np.roll(arms, -1, axis=0)).sum(axis=0)) / 2


@pytest.fixture(params=CASES.values(), ids=CASES.keys())
def thing(request):
    sheet = with_all_edges(sheet_of(request.param))
    return sheet, np.array(sheet.coordinates, dtype=float) * 100


def cuts(piece):
    return shapely.union_all([shapely.LineString([s.start, s.end]) for s in piece.strokes if s.kind == "CUT"])


def test_cuts_are_the_outline_and_the_panels_are_all_there_with_tabs_beside_them(thing):
    """What the lines enclose, found by shapely: the areas of the panels, as they are in space, and tabs."""
    sheet, places = thing
    made = template_of(sheet, scale=100)
    found = []
    for piece in made.pieces:
        assert piece.covered.geom_type == "Polygon"  # tabs and panels hang together
        assert piece.covered.boundary.difference(cuts(piece).buffer(1e-5)).is_empty
        assert piece.covered.buffer(1e-5).contains(cuts(piece))
        lengths_of_cuts = [np.subtract(one.end, one.start) for one in piece.strokes if one.kind == "CUT"]
        assert np.linalg.norm(lengths_of_cuts, axis=1).sum() == pytest.approx(cuts(piece).length)  # none is cut twice
        lines = shapely.union_all([shapely.LineString([s.start, s.end]) for s in piece.strokes], grid_size=1e-7)
        enclosed = list(shapely.polygonize([lines]).geoms)
        assert sum(one.area for one in enclosed) == pytest.approx(piece.covered.area, rel=1e-6)
        found += [one.area for one in enclosed]
    wanted = [area(places[list(face)]) for face in sheet.faces]
    for one in wanted:
        nearest = min(found, key=lambda other: abs(one - other))
        assert nearest == pytest.approx(one, rel=1e-5)
        found.remove(nearest)
    numbers = Counter(text.words for piece in made.pieces for text in piece.texts)
    assert set(numbers.values()) <= {2}
    without = sum(int(told.split()[2]) for told in made.not_shown)
    assert len(found) == len(numbers) - without


def test_every_panel_is_laid_as_it_stands_and_edges_that_are_glued_come_together(thing):
    """Panels go from the net to space without being stretched; turned ones are mirrored, so all are seen from one side."""
    sheet, places = thing
    panels = Panels(sheet, places)
    laid = 0
    for net in nets_of(panels):
        for face, corners in net.corners.items():
            stands = places[list(sheet.faces[face])]
            for points in (corners, stands):
                assert len(points) == len(sheet.faces[face])
            apart = [np.linalg.norm(points[:, None] - points[None], axis=-1) for points in (corners, stands)]
            np.testing.assert_allclose(*apart, atol=1e-9)
            x, y = corners.T
            turns = np.sign((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())
            assert (turns < 0) == net.turned[face]
            laid += 1
        polygons = net.polygons()
        assert united(polygons).area == pytest.approx(sum(one.area for one in polygons), rel=1e-7)
    assert laid == len(sheet.faces)


def test_corners_that_rounding_puts_apart_leave_no_slit():
    """A row of triangles turned by any angle: its panels have corners that differ in their last digits."""
    turns = np.exp(1j * np.linspace(0.1, 3, 40))
    row = np.array([k + (k % 2) * 4.2j for k in range(14)])
    for turn in turns:
        corners = [row[k : k + 3] * turn for k in range(12)]
        shifted = [(one + 1 / 3) * (1 + 1e-15 * k) for k, one in enumerate(corners)]
        whole = put_together([shapely.Polygon(np.column_stack([one.real, one.imag])) for one in shifted])
        assert whole.geom_type == "Polygon"
        assert not whole.interiors
        assert whole.area == pytest.approx(12 * 4.2)


def test_a_closed_surface_has_one_net_of_mountains_seen_from_outside():
    made = template_of(CASES["cube"], size=50)
    (piece,) = made.pieces
    kinds = Counter(stroke.kind for stroke in piece.strokes)
    inward = (
        area(np.array(CORNERS)[list(CUBE[0])]) > 0
        and np.cross(*(np.subtract(CORNERS[CUBE[0][k]], CORNERS[CUBE[0][0]]) for k in (1, 2)))[0] > 0
    )
    assert kinds == {("VALLEY" if inward else "MOUNTAIN"): 12, "CUT": 7 + 3 * 7}
    assert made.not_shown == ()


@pytest.mark.parametrize("other_way", range(6))
def test_folds_are_those_seen_from_the_first_panel_whichever_way_others_go_round(other_way):
    faces = tuple(face[::-1] if number == other_way else face for number, face in enumerate(CUBE))
    first, turned = (
        {stroke.kind for stroke in template_of(Sheet(8, (), "", one, CORNERS), size=50).pieces[0].strokes} - {"CUT"}
        for one in (CUBE, faces)
    )
    assert len(first) == len(turned) == 1
    assert (first == turned) == (other_way != 0)


def test_letters_of_the_file_say_how_to_fold_and_are_changed_where_a_panel_is_turned():
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0.5), (2, 1, 0.5))
    for faces, kind in ((((0, 1, 2, 3), (1, 4, 5, 2)), "VALLEY"), (((3, 2, 1, 0), (2, 5, 4, 1)), "MOUNTAIN")):
        strokes = template_of(Sheet(6, (), "", faces, corners), size=100).pieces[0].strokes
        assert [stroke.kind for stroke in strokes if stroke.kind != "CUT"] == [kind]
    against = template_of(Sheet(6, ((1, 2),), "M", ((0, 1, 2, 3), (1, 4, 5, 2)), corners), size=100)
    assert "MOUNTAIN" in {stroke.kind for stroke in against.pieces[0].strokes}


def test_a_tab_lies_in_the_panel_that_it_is_glued_on_and_off_all_else():
    start, end = np.array([0.0, 0.0]), np.array([0.0, 40.0])
    panel = shapely.box(-30, 0, 0, 40)
    narrow = shapely.Polygon([(0, 0), (0, 40), (9, 20)])
    shape = tab_at(start, end, 8, [panel], narrow)
    assert shape is not None
    assert narrow.buffer(1e-6).contains(shapely.Polygon(shape))
    np.testing.assert_array_equal(shape[:2], [start, end])
    assert tab_at(start, end, 8, [panel, shapely.box(0.5, 0, 30, 40)], shapely.box(0, 0, 30, 40)) is None
    assert tab_at(start, end, 8, [panel], shapely.box(0, 0, 1.9, 40)) is None


def test_a_tab_that_juts_out_of_its_panel_is_seen_where_their_edges_coincide_but_for_rounding():
    """The tab has its fold along a side of the panel; an overlay of the two found no part of it outside."""
    sheet = realise(mechanism_from_map_id("m1:a---b.ac--.b-d-e.cf-g-.d-g--.e---f"), kind="space").sheet
    whole = with_all_edges(sheet)
    places = np.array(whole.coordinates)
    panels = Panels(whole, places * 200 / np.ptp(places, axis=0).max())
    assert check_tabs(panels, template_of(sheet, size=200).pieces, []) > 0


@pytest.mark.parametrize("code", ["m1:a---b.ac--.bd--e.ce--f.d-g-.f-g-", "m1:a---b.ac--d.b-e.ce-f-.d--g-.f-g-"])
def test_pieces_are_one_area_and_tabs_stay_clear_of_what_is_near(code):
    sheet = realise(mechanism_from_map_id(code), kind="space", tries=1).sheet
    for piece in template_of(sheet, size=200).pieces:
        check_cuts(piece)
        assert not piece.covered.interiors


def test_without_tabs_edges_are_numbered_all_the_same(tmp_path, data):
    path = data / "linkages" / "sarrus-panels.fold"
    run("template", path, "--size", 80, "--tabs", 0, "-o", tmp_path / "a.svg")
    lines, words, _ = lines_of_svg(tmp_path / "a.svg")
    assert "1" in words
    sheet = with_all_edges(read(path))
    places = np.array(sheet.coordinates) * 80 / np.ptp(sheet.coordinates, axis=0).max()
    ends = np.array([places[list(edge)] for edge in sheet.edges])
    drawn = np.concatenate([lengths(rows) for kind, rows in lines.items() if kind != "MARKS"])
    assert set(np.round(drawn, 2)) == set(np.round(lengths(ends), 2))


@pytest.mark.parametrize(
    ("faces", "told"),
    [
        (((0, 1, 3, 6),), "panel 0 is not planar"),
        (((0, 1, 3), (0, 1, 4), (0, 1, 7)), "3 panels meet in the edge from vertex 0 to 1"),
    ],
)
def test_what_no_sheet_can_be_cut_of_is_refused(faces, told):
    with pytest.raises(UnsolvableError, match=told):
        template_of(Sheet(8, (), "", faces, CORNERS), size=100)


@pytest.mark.parametrize("case", ["cube", "octahedron", "storey", "pop-up"])
def test_a_net_that_is_folded_along_its_creases_closes(case):
    sheet = with_all_edges(sheet_of(CASES[case]))
    places = np.array(sheet.coordinates, dtype=float) * 100
    panels = Panels(sheet, places)
    (net,) = nets_of(panels)
    stands = folded_up(panels, net)
    assert set(stands) == set(range(len(sheet.faces)))
    for face, other in panels.joins.values():
        for vertex in set(sheet.faces[face]) & set(sheet.faces[other]):
            first, second = (stands[one][sheet.faces[one].index(vertex)] for one in (face, other))
            np.testing.assert_allclose(first, second, atol=1e-9)
    everything = np.concatenate([stands[face] for face in range(len(sheet.faces))])
    wanted = np.concatenate([places[list(around)] for around in sheet.faces])
    volumes = [np.linalg.det(points[[1, 2, -1]] - points[0]) for points in (everything, wanted)]
    assert volumes[0] == pytest.approx(volumes[1], abs=1e-3)  # not its mirror image
