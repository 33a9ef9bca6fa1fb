"""Files as they are dropped: shown and judged as the command does, or refused in its words."""

import json
import os
from pathlib import Path

import numpy as np
import pytest
from real_patterns import names_of_patterns

import synth
from graphs.creasing.edits import lock_crease, remove_crease
from graphs.errors import SynthedraError, UnsolvableError
from graphs.files.formats import read
from synth.catalogue.patterns.creases import miura
from synth.making.viewer.page_data import shown_of
from synth.making.viewer.workbench.reading import answered, printed
from tests.support.commands import run


@pytest.mark.parametrize("name", ["patterns/four-bar-vertex.fold", "linkages/bennett.json", "wiener/six-bar.json"])
def test_it_is_judged_as_the_command_does(data, name):
    place = data / name
    before = Path.cwd()
    told = json.loads(json.dumps(answered(place.name, place.read_bytes())))
    assert Path.cwd() == before
    assert told["shown"]["verdict"] == synth.mobility(read(place)).verdict.text
    assert told["shown"]["name"] == place.name


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.fold", b""), ("a.fold", b"{"), ("a.fold", b"[1]"), ("a.svg", b"<svg><!DOCTYPE x ["), ("a.json", b"\xff\xfe"),
        ("a.xyz", b"1"), ("a.sqlite", b"SQLite format 3"), ("a.fold", b'{"vertices_coords": [[0]]}'),
    ],
)  # fmt: skip
def test_it_is_refused_in_the_same_words(tmp_path, monkeypatch, name, content):
    (tmp_path / name).write_bytes(content)
    monkeypatch.chdir(tmp_path)
    said = run("view", name, "-o", "page.html", code=2).output.strip()
    if "was not built" in said:
        pytest.skip(said)
    assert answered(name, content) == {"error": said}


def test_creases_are_locked_and_removed_one_after_the_other(data):
    place = data / "patterns" / "four-bar-vertex.fold"
    sheet, content = read(place), place.read_bytes()
    told = answered(place.name, content, ["lock:0"])["shown"]
    assert told["verdict"] == synth.mobility(lock_crease(sheet, 0).sheet).verdict.text
    assert len(told["moving"]["joints"]) == 3
    twice = remove_crease(lock_crease(sheet, 0).sheet, 2).sheet
    assert (
        answered(place.name, content, ["lock:0", "remove:2"])["shown"]["verdict"] == synth.mobility(twice).verdict.text
    )


def test_it_is_told_how_far_it_is(data):
    place, told = data / "patterns" / "four-bar-vertex.fold", []
    answered(place.name, place.read_bytes(), report=lambda what, step, of: told.append((what, step, of)))
    assert [step for _, step, _ in told] == [0, 1, 2, 3]
    assert {of for _, _, of in told} == {4}
    assert told[1][0] == "finding motion branches"


@pytest.mark.slow
def test_what_is_large_is_judged_on_request():
    sheet = miura(30, 41, np.radians(60.0))
    shown = shown_of(sheet)
    assert shown.on_request
    assert "the motion of 1230 panels is analysed on request" in shown.verdict
    assert len(shown.moving.bodies.faces) == 1230
    assert shown.moving.ways is None
    shown = shown_of(sheet, motion=True)
    assert not shown.on_request
    assert "Rigid-foldable from" in shown.verdict
    assert len(shown.moving.ways.all[0].drivers) == 1


def test_numbers_of_the_answer_keep_all_their_digits(data):
    place = data / "patterns" / "four-bar-vertex.fold"
    told = answered(place.name, place.read_bytes())["shown"]
    assert json.loads(told["answer"])["exact"]["primes"] == list(synth.mobility(read(place)).exact.primes)


@pytest.mark.parametrize(
    ("kind", "size", "begins"), [("svg", 150.0, b"<svg"), ("svg", 600.0, b"PK"), ("dxf", 150.0, b"999")]
)
def test_templates_are_printed(data, kind, size, begins):
    place = data / "patterns" / "bird-base.fold"
    made, content = printed(place.name, place.read_bytes(), size, kind, ["lock:0"])
    assert made == ("zip" if begins == b"PK" else kind)
    assert content.startswith(begins)


def test_what_has_no_panels_has_no_template(data):
    place = data / "wiener" / "six-bar.json"
    with pytest.raises(UnsolvableError, match="a template requires panels"):
        printed(place.name, place.read_bytes(), 150.0, "svg")


def test_what_cannot_be_edited_is_said(data):
    pattern, graph = data / "patterns" / "four-bar-vertex.fold", data / "wiener" / "six-bar.json"
    assert "99 is no joint" in answered(pattern.name, pattern.read_bytes(), ["lock:99"])["error"]
    assert "only crease patterns" in answered(graph.name, graph.read_bytes(), ["lock:0"])["error"]


@pytest.mark.slow
@pytest.mark.parametrize("name", names_of_patterns(most_bytes=15_000))
def test_patterns_by_other_people_are_judged_as_the_command_does(fold_folder, name):
    place = fold_folder / name
    told = answered(place.name, place.read_bytes())
    try:
        verdict = synth.mobility(read(place)).verdict.text
    except SynthedraError as error:
        assert str(error).removeprefix(f"{fold_folder}{os.sep}") in told["error"]
    else:
        assert told["shown"]["verdict"] == verdict
