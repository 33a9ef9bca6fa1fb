"""The page of assembly: what is to be done, and a picture of the thing folded."""

import re
from dataclasses import replace

import numpy as np
import pytest
from commands import run
from measured import lines_of_svg
from sizes import slow

from graphs.files.formats import read
from graphs.mechanism.precision import lies_flat
from graphs.mechanism.sheet import Sheet
from synth.analysis.folding.motion import fold
from synth.catalogue.patterns._generate import generate
from synth.making.drawing.scene.shapes import Polygon
from synth.making.templates.pages import Paper, pages_of
from synth.making.templates.template import folded_sheet, pictured, template_of

A4 = Paper(210, 297)


@pytest.fixture
def vertex(data):
    return data / "patterns" / "four-bar-vertex.fold"


def test_the_last_page_of_a_pdf_and_a_file_beside_an_svg_say_what_to_do(vertex, tmp_path):
    pytest.importorskip("reportlab")
    for suffix in ("pdf", "svg"):
        assert run("template", vertex, "--size", 150, "-o", tmp_path / f"a.{suffix}").stderr == ""
    assert len(re.findall(rb"/Type /Page\b", (tmp_path / "a.pdf").read_bytes())) == 2
    assert {path.name for path in tmp_path.iterdir()} == {"a.pdf", "a.svg", "a-note.svg"}
    note = (tmp_path / "a-note.svg").read_text(encoding="utf-8")
    assert "Print at 100 %" in note
    assert "3 mountains (" in note
    assert "Lay the pages" not in note  # it fits on a page
    assert note.count("data-link") >= 4  # every panel is in the picture
    lines, _, _ = lines_of_svg(tmp_path / "a-note.svg")
    assert lines == {}  # nothing of it is cut
    run("template", vertex, "--size", 150, "-o", tmp_path / "again.svg")
    assert (tmp_path / "again-note.svg").read_text(encoding="utf-8") == note


def test_what_a_drawing_for_machines_does_not_hold_is_told(vertex, tmp_path):
    assert "with a picture" in run("template", vertex, "--size", 150, "-o", tmp_path / "a.dxf").stderr
    assert run("template", vertex, "--size", 150, "--no-note", "-o", tmp_path / "b.dxf").stderr == ""


@pytest.mark.parametrize(("wide", "high"), [(210, 297), slow(297, 210), slow(130, 130)])
def test_the_picture_lies_on_the_page_below_the_steps(wide, high):
    sheet = generate("box-pop-up").mechanism
    template, why = pictured(template_of(sheet, size=400), sheet)
    assert why == ""
    page = pages_of(template, Paper(wide, high))[-1]
    assert page.is_note
    assert any("crosses of one name" in text.words for text in page.texts)
    size = np.array([page.paper.width, page.paper.height])
    corners = np.concatenate([shape.points for shape in page.picture.shapes if isinstance(shape, Polygon)])
    assert (corners.min(axis=0) >= (10, size[1] - min(text.at[1] for text in page.texts))).all()
    assert (corners.max(axis=0) <= size - 10 + 1e-9).all()


def test_the_pose_is_the_one_that_stands_or_a_frame_or_the_sheet_folded_as_its_letters_say(tmp_path):
    flat = generate("miura").mechanism
    standing = generate("miura", fold=1.0).mechanism
    assert folded_sheet(standing) == (standing, "as it stands")
    pose, seen = folded_sheet(flat)
    assert seen == "folded half way"
    assert not lies_flat(pose)
    turned = [angle for angle in pose.fold_angles if angle]
    letters = [letter for letter, angle in zip(pose.assignments, pose.fold_angles, strict=True) if angle]
    assert ["V" if angle > 0 else "M" for angle in turned] == letters
    run("generate", "miura", "-o", tmp_path / "miura.fold")
    run("fold", tmp_path / "miura.fold", "--frames", 3, "-o", tmp_path / "frames.fold")
    framed = read(tmp_path / "frames.fold")
    pose, seen = folded_sheet(framed)
    assert seen == "as it stands"  # it rests folded
    assert pose.coordinates in [frame.coordinates for frame in fold(flat, frames=3).frames()]


def test_where_it_is_not_folded_the_reason_is_told(tmp_path):
    many = generate("miura", rows=8, columns=8).mechanism
    template, why = pictured(template_of(many, size=150), many)
    assert template.picture is None
    assert why == "64 panels: more than 60 are not folded for a picture"
    square = Sheet(4, (), "", ((0, 1, 2, 3),), ((0, 0), (1, 0), (1, 1), (0, 1)))
    template, why = pictured(template_of(square, size=100), square)
    assert "rigid: the sheet has no creases" in why
    assert [page.picture for page in pages_of(template, A4)] == [None, None]


def test_steps_speak_of_tabs_and_of_edges_without():
    cube = Sheet(
        8,
        (),
        "",
        ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)),
        tuple((x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)),
    )
    assert any("Glue 7 tabs" in step for step in template_of(cube, size=50).steps)
    without = template_of(cube, size=50, tabs=0)
    assert any("Tape 7 pairs" in step for step in without.steps)
    assert pages_of(replace(without, steps=()), A4)[-1].is_note is False
