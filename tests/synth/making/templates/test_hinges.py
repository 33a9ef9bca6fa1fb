"""Thick material: strips in the place of folds, measured; and what holds together when it is cut."""

from collections import Counter

import numpy as np
import pytest
import shapely
from commands import run
from measured import lines_of_svg

from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.mechanism.sheet import Sheet, sides_of_face, with_all_edges
from synth.catalogue.patterns._generate import generate
from synth.making.templates.hinges import Hinges
from synth.making.templates.template import template_of

WIDTH = 4.0
CUBE = Sheet(
    8,
    (),
    "",
    ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)),
    tuple((x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)),
)
SHEETS = {"miura": generate("miura", rows=2, columns=2).mechanism, "huffman": generate("huffman-grid").mechanism}
KINDS = ("offset", "living", "gap")


@pytest.fixture(params=[SHEETS["miura"], pytest.param(SHEETS["huffman"], marks=pytest.mark.slow)], ids=SHEETS)
def sheet(request):
    return with_all_edges(request.param)


def piece_of(sheet, kind, width=WIDTH):
    (piece,) = template_of(sheet, size=250, hinges=Hinges(kind, width)).pieces
    return piece


def cut_apart(piece):
    """What is left when a knife 0.02 mm wide went along every cut, in parts."""
    cuts = [shapely.LineString([s.start, s.end]) for s in piece.strokes if s.kind == "CUT"]
    left = piece.covered.buffer(0.005).difference(shapely.union_all(cuts).buffer(0.01))
    return [part for part in getattr(left, "geoms", [left]) if part.area > 0.5]


def panels_shrunk(sheet, width):
    """Areas of panels without a strip along each side where another hangs: half planes, for convex panels."""
    places = np.array(sheet.coordinates)[:, :2]
    places = places * 250 / np.ptp(places, axis=0).max()
    letters = {frozenset(e): one for e, one in zip(sheet.edges, sheet.assignments, strict=True)}
    areas = []
    for face in sheet.faces:
        panel = shapely.Polygon(places[list(face)])
        for a, b in sides_of_face(face):
            if letters[frozenset((a, b))] in "MVU":
                along = (places[b] - places[a]) / np.linalg.norm(places[b] - places[a])
                line = shapely.LineString([places[a] - 1e3 * along, places[b] + 1e3 * along])
                panel = panel.difference(line.buffer(width / 2, cap_style="flat"))
        areas.append(panel.area)
    return sorted(areas)


def test_a_gap_leaves_each_panel_by_itself_as_much_smaller_as_was_asked_for(sheet):
    piece = piece_of(sheet, "gap")
    left = sorted(part.area for part in getattr(piece.covered, "geoms", [piece.covered]))
    np.testing.assert_allclose(left, panels_shrunk(sheet, WIDTH), rtol=1e-6)
    assert len(cut_apart(piece)) == len(sheet.faces)
    assert {stroke.kind for stroke in piece.strokes} == {"CUT"}
    letters = Counter(text.words for text in piece.texts)
    assert letters == {letter: sheet.assignments.count(letter) for letter in "MV"}


def test_two_folds_stand_for_one_so_far_apart(sheet):
    piece = piece_of(sheet, "offset")
    folds = [stroke for stroke in piece.strokes if stroke.kind != "CUT"]
    hinges = sum(letter in "MVU" for letter in sheet.assignments)
    assert len(folds) == 2 * hinges
    for first, second in zip(folds[::2], folds[1::2], strict=True):
        assert first.kind == second.kind
        lines = [np.array([one.start, one.end]) for one in (first, second)]
        along = lines[0][1] - lines[0][0]
        assert abs(np.cross(np.append(along, 0), np.append(lines[1][0] - lines[0][0], 0))[2]) / np.linalg.norm(
            along
        ) == pytest.approx(WIDTH, abs=1e-6)
        np.testing.assert_allclose(lines[0][0] - lines[1][0], lines[0][1] - lines[1][1], atol=1e-6)
    assert len(cut_apart(piece)) == 1
    lines = shapely.union_all([shapely.LineString([s.start, s.end]) for s in piece.strokes], grid_size=1e-6)
    enclosed = sorted(one.area for one in shapely.polygonize([lines]).geoms if piece.covered.buffer(1e-3).covers(one))
    assert len(enclosed) == len(sheet.faces) + hinges
    for area in panels_shrunk(sheet, WIDTH):
        assert min(abs(area - one) for one in enclosed) < 1e-3


def test_a_living_hinge_holds_together_and_is_cut_across_everywhere(sheet):
    piece = piece_of(sheet, "living")
    assert {stroke.kind for stroke in piece.strokes} == {"CUT"}
    (whole,) = cut_apart(piece)
    assert whole.area > 0.95 * piece.covered.area
    # a line across the sheet at right angles to a hinge meets a cut: nowhere is it stiff
    plain = template_of(sheet, size=250).pieces[0]
    cuts = shapely.union_all([shapely.LineString([s.start, s.end]) for s in piece.strokes])
    for fold in (stroke for stroke in plain.strokes if stroke.kind != "CUT"):
        start, end = np.array(fold.start), np.array(fold.end)
        along = (end - start) / np.linalg.norm(end - start)
        off = np.array([-along[1], along[0]])
        for part in np.linspace(0.2, 0.8, 31):
            at = start + part * (end - start)
            across = shapely.LineString([at - WIDTH / 2 * off, at + WIDTH / 2 * off])
            assert across.intersects(cuts)


def test_no_line_is_cut_twice(sheet):
    for kind in KINDS:
        cuts = [stroke for stroke in piece_of(sheet, kind).strokes if stroke.kind == "CUT"]
        lengths = sum(np.linalg.norm(np.subtract(one.end, one.start)) for one in cuts)
        together = shapely.union_all([shapely.LineString([one.start, one.end]) for one in cuts])
        assert lengths == pytest.approx(together.length, rel=1e-9)


@pytest.mark.parametrize("kind", KINDS)
def test_no_cut_leaves_the_material(kind, data):
    """Sides of the sheet end where its corners are cut off: those of acute panels, whose folds go to corners."""
    piece = piece_of(with_all_edges(read(data / "patterns" / "four-bar-vertex.fold")), kind)
    cuts = [shapely.LineString([stroke.start, stroke.end]) for stroke in piece.strokes if stroke.kind == "CUT"]
    assert shapely.union_all(cuts).difference(piece.covered.buffer(1e-4)).length == 0.0
    if kind == "gap":
        assert sum(cut.length for cut in cuts) == pytest.approx(piece.covered.length)


def test_edges_that_meet_when_it_is_put_together_have_their_half_of_the_gap():
    piece = piece_of(CUBE, "gap")
    assert [round(part.area, 6) for part in piece.covered.geoms] == [(250 - WIDTH) ** 2] * 6


def test_a_net_with_tabs_has_strips_at_their_folds_too():
    (piece,) = template_of(CUBE, size=100, hinges=Hinges("offset", 2.0)).pieces
    folds = [stroke for stroke in piece.strokes if stroke.kind != "CUT"]
    assert len(folds) == 2 * (5 + 7)
    assert len(cut_apart(piece)) == 1


def test_flat_edges_and_slits_stay_as_they_are():
    corners = ((0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (0, 1))
    halves = ((0, 1, 4, 5), (1, 2, 3, 4))
    flat, cut = (Sheet(6, ((1, 4),), letter, halves, corners) for letter in "FC")
    for kind in KINDS:
        assert piece_of(flat, kind).covered.area == pytest.approx(250 * 125)
        assert len(cut_apart(piece_of(flat, kind))) == 1
        assert len(cut_apart(piece_of(cut, kind))) == 2


@pytest.mark.parametrize(
    ("kind", "width", "told"),
    [("gap", 260, "no room for hinges of 260 mm"), ("living", 110, "too short for a hinge|narrower")],
)
def test_what_has_no_room_is_refused(kind, width, told):
    with pytest.raises(UnsolvableError, match=told):
        piece_of(SHEETS["miura"], kind, width)


def test_hinges_are_of_a_kind_and_a_width(data, tmp_path):
    for kind, width in (("glue", 1), ("gap", 0), ("gap", float("nan"))):
        with pytest.raises(InvariantError):
            Hinges(kind, width)
    words = ("template", data / "patterns" / "bird-base.fold", "--size", 150, "-o", tmp_path / "a.svg")
    assert "require each other" in run(*words, "--hinges", "gap", code=2).stderr
    assert "require each other" in run(*words, "--hinge-width", 3, code=2).stderr
    run(*words, "--hinges", "gap", "--hinge-width", 3, "--no-note")
    lines, words_there, _ = lines_of_svg(tmp_path / "a.svg")
    assert lines.keys() == {"CUT", "MARKS"}
    assert {"M", "V"} <= words_there.keys()
