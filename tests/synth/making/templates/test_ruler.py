"""A ruler laid on what was written: edges, gauge, margins, and where pages meet, within a hundredth of a millimetre."""

import re

import numpy as np
import pytest
import shapely
from commands import run
from measured import lengths, lines_of_dxf, lines_of_pdf, lines_of_svg
from sizes import slow

from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.mechanism.sheet import Sheet
from synth.catalogue.patterns._generate import generate
from synth.making.templates.pages import Paper, pages_of, paper_named
from synth.making.templates.template import template_of

NEAR = 0.01
KINDS = {"B": "CUT", "M": "MOUNTAIN", "V": "VALLEY", "U": "CREASE"}
MARGIN = 10.0


@pytest.fixture
def bird(data):
    return data / "patterns" / "bird-base.fold"


def edges_of(path, factor):
    """Kind to ends in millimetres, from the file itself."""
    sheet = read(path)
    places = np.array(sheet.coordinates)[:, :2] * factor
    found = {kind: [] for kind in KINDS.values()}
    for edge, letter in zip(sheet.edges, sheet.assignments, strict=True):
        if letter in KINDS:
            found[KINDS[letter]].append(places[list(edge)])
    return {kind: np.array(ends) for kind, ends in found.items()}


def measure(lines, asked):
    assert set(lines) == {*asked, "MARKS"}
    for kind, ends in asked.items():
        np.testing.assert_allclose(lengths(lines[kind]), lengths(ends), rtol=0, atol=NEAR)
    assert lengths(lines["MARKS"])[-1] == pytest.approx(100, abs=NEAR)


def same_lines(first, second):
    """The same lines, but for where the drawing lies."""
    for kind in first.keys() & second.keys() - {"MARKS"}:
        shifts = (first[kind] - second[kind]).reshape(-1, 2)
        np.testing.assert_allclose(shifts, np.tile(shifts[0], (len(shifts), 1)), atol=NEAR)


def test_every_edge_and_the_gauge_are_true_in_every_format(bird, tmp_path):
    for suffix in ("svg", "pdf", "dxf"):
        run("template", bird, "--size", 150, "--no-note", "-o", tmp_path / f"a.{suffix}")
    asked = edges_of(bird, 75)
    svg, _, size = lines_of_svg(tmp_path / "a.svg")
    assert size == (210, 297)
    (pdf,), ((wide, high),) = lines_of_pdf((tmp_path / "a.pdf").read_bytes())
    assert (wide, high) == (pytest.approx(210, abs=NEAR), pytest.approx(297, abs=NEAR))
    dxf = lines_of_dxf((tmp_path / "a.dxf").read_text(encoding="ascii"))
    for lines in (svg, pdf, dxf):
        measure(lines, asked)
        same_lines(lines, svg)
    for lines in (svg, pdf):
        everything = np.concatenate(list(lines.values())).reshape(-1, 2)
        assert everything.min() >= MARGIN - NEAR
        assert (everything.max(axis=0) <= np.array(size) - MARGIN + NEAR).all()
        assert lines["MARKS"][..., 0].min() == pytest.approx(MARGIN, abs=NEAR)


def test_a_template_is_read_back_as_the_pattern_that_it_is_of(bird, tmp_path):
    run("template", bird, "--size", 150, "-o", tmp_path / "a.svg")
    given, again = read(bird), read(tmp_path / "a.svg")
    assert sorted(again.assignments) == sorted(given.assignments)
    assert len(again.faces) == len(given.faces)


@pytest.mark.parametrize(
    ("words", "pages"),
    [
        (["--page", "A4"], 6),
        pytest.param(["--page", "A3"], 4, marks=pytest.mark.slow),
        pytest.param(["--page", "400x300"], 4, marks=pytest.mark.slow),
    ],
)
def test_tiles_meet_at_their_crosses_and_hold_every_line(words, pages, bird, tmp_path):
    run("template", bird, "--size", 500, *words, "--no-note", "-o", tmp_path / "a.svg")
    tiles = [lines_of_svg(path) for path in sorted(tmp_path.glob("a-*.svg"))]
    assert len(tiles) == pages
    shifts = {0: np.zeros(2)}
    crosses = [
        {word: np.array(at) for word, at in words.items() if re.fullmatch(r"[A-Z]+", word)} for _, words, _ in tiles
    ]
    for _ in tiles:
        for one in range(len(tiles)):
            for other in set(range(len(tiles))) - set(shifts):
                common = crosses[one].keys() & crosses[other].keys()
                if one in shifts and common:
                    apart = [crosses[one][name] - crosses[other][name] for name in sorted(common)]
                    assert len(apart) >= 2
                    np.testing.assert_allclose(apart, [apart[0]] * len(apart), atol=NEAR)
                    shifts[other] = shifts[one] + apart[0]
    assert len(shifts) == pages
    margins, foot, overlap = 20, 20, 10
    steps = np.array(tiles[0][2]) - (margins + overlap, margins + foot + overlap)
    for shift in shifts.values():
        np.testing.assert_allclose(shift, np.round(shift / steps) * steps, atol=NEAR)
    whole = {kind: [] for kind in KINDS.values()}
    for number, (lines, _, size) in enumerate(tiles):
        assert lines["MARKS"].reshape(-1, 2).min() >= MARGIN - NEAR
        for kind, ends in lines.items():
            assert (ends.reshape(-1, 2).max(axis=0) <= np.array(size) - MARGIN + NEAR).all()
            if kind in whole:
                whole[kind] += (ends + shifts[number]).tolist()
    asked = edges_of(bird, 250)
    corner = np.array(whole["CUT"]).reshape(-1, 2).min(axis=0) - asked["CUT"].reshape(-1, 2).min(axis=0)
    for kind, ends in asked.items():
        drawn, wanted = shapely.MultiLineString(whole[kind]), shapely.MultiLineString(list(ends + corner))
        assert wanted.difference(drawn.buffer(NEAR)).is_empty
        assert drawn.difference(wanted.buffer(NEAR)).is_empty


@pytest.mark.parametrize("pattern", ["four-bar-vertex", slow("bird-base")])
def test_equal_things_give_equal_files(pattern, data, tmp_path):
    for suffix in ("svg", "pdf", "dxf"):
        for name in "ab":
            file = data / "patterns" / f"{pattern}.fold"
            run("template", file, "--size", 150, "-o", tmp_path / f"{name}.{suffix}")
        assert (tmp_path / f"a.{suffix}").read_bytes() == (tmp_path / f"b.{suffix}").read_bytes()


def test_dxf_is_without_fault_to_other_people(bird, tmp_path):
    ezdxf = pytest.importorskip("ezdxf")
    run("template", bird, "--size", 150, "-o", tmp_path / "a.dxf")
    drawing = ezdxf.readfile(tmp_path / "a.dxf")
    auditor = drawing.audit()
    assert not auditor.errors
    assert not auditor.fixes
    assert {drawing.layers.get(kind).dxf.linetype for kind in KINDS.values()} == {"CONTINUOUS"}
    assert len(drawing.modelspace().query("LINE[layer=='CUT']")) == read(bird).assignments.count("B")


@pytest.mark.parametrize("wide", [True, False])
def test_paper_of_a_stated_size_has_place_for_the_gauge(wide):
    sides = (129, 300) if wide else (300, 129)
    with pytest.raises(InvariantError, match="sides from 130 to 5000 mm"):
        Paper(*sides)


def test_what_cannot_be_printed_is_refused_in_a_line(bird, tmp_path, data):
    assert "2 x 2 mm" in run("template", bird, "--scale", 1, "-o", tmp_path / "a.pdf", code=2).stderr
    assert "at most 500" in run("template", bird, "--size", 9000, "-o", tmp_path / "a.pdf", code=2).stderr
    assert "Letter" in run("template", bird, "--page", "B7", "-o", tmp_path / "a.pdf", code=2).stderr
    assert (
        "-1 is out of range; expected 1e-50 to 1e+50"
        in run("template", bird, "--size", -1, "-o", tmp_path / "a.pdf", code=2).stderr
    )
    assert ".dxf" in run("template", bird, "-o", tmp_path / "a.doc", code=2).stderr
    assert list(tmp_path.iterdir()) == []
    bennett = data / "linkages" / "bennett.json"
    assert "requires panels" in run("template", bennett, "-o", tmp_path / "a.pdf", code=2).stderr


def test_cuts_are_what_has_one_panel_and_flat_edges_are_told():
    square = ((0, 0), (1, 0), (1, 1), (0, 1))
    flat = template_of(Sheet(4, ((0, 2), (0, 1)), "FM", ((0, 1, 2), (0, 2, 3)), square), size=50)
    assert [stroke.kind for stroke in flat.pieces[0].strokes] == ["CUT"] * 4
    assert flat.not_shown == ("1 flat edge",)
    with pytest.raises(UnsolvableError, match="a template requires panels"):
        template_of(Sheet(2, (), "", (), ((0, 0), (1, 0))))
    with pytest.raises(InvariantError, match="a scale and a size"):
        template_of(Sheet(3, (), "", ((0, 1, 2),), square[:3]), scale=1, size=1)


def test_paper_is_turned_where_that_saves_pages():
    wide = template_of(generate("miura", rows=2, columns=6).mechanism, size=270)
    assert [page.paper for page in pages_of(wide, paper_named("A4"))] == [Paper(297, 210), Paper(210, 297)]
