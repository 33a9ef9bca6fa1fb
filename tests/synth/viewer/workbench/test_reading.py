"""Files as they are dropped: shown and judged as the command does, or refused in its words."""

import json
from pathlib import Path

import pytest

import synth
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
