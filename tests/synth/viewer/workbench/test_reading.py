"""Files as they are dropped: shown and judged as the command does, or refused in its words."""

import json
import os
from pathlib import Path

import pytest
from real_patterns import names_of_patterns

import synth
from graphs.creasing.edits import lock_crease, remove_crease
from graphs.errors import SynthedraError
from graphs.files.formats import read
from synth.viewer.workbench.reading import answered
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
        answered(place.name, content, ["lock:0", "remove:2"])["shown"]["verdict"]
        == synth.mobility(twice).verdict.text
    )


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
