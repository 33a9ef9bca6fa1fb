"""`synth realise`."""

import json

import pytest

from graphs.files.formats import read
from tests.support.commands import run

FOUR_BAR = "m1:a-b.ac-.b-d.cd-"


def test_a_type_is_written_and_read_back(tmp_path):
    place = tmp_path / "four-bar.fold"
    told = run("realise", FOUR_BAR, "--tries", "1", "-o", place).output
    assert "a flat sheet" in told
    assert "written: " in told
    assert len(read(place).faces) == 4
    assert FOUR_BAR in run("id", place).output


def test_json_in_space():
    found = json.loads(run("realise", FOUR_BAR, "--as", "space", "--tries", "1", "--json").output)
    assert found["drawing"] == FOUR_BAR
    assert found["freedoms"] == found["mobility"] == 1


def test_a_list_is_realised_into_a_folder(tmp_path):
    source = tmp_path / "types.jsonl"
    source.write_text(json.dumps({"code": FOUR_BAR}) + "\n")
    words = ("realise", source, "--as", "space", "--tries", "1", "-o", tmp_path / "things")
    assert "1 type: 1 realised, 0 not found, 0 refused" in run(*words).output
    assert FOUR_BAR in run("id", tmp_path / "things" / "0000001.fold").output
    assert "folders are not replaced" in run(*words, code=2).output
    found = json.loads(run(*words, "--resume", "--json").output)
    assert (found["realised"], found["types"][0]["code"]) == (1, FOUR_BAR)


@pytest.mark.parametrize(("words", "told"), [((), "need a place"), (("-o", "things.fold"), "a folder or a store")])
def test_many_types_need_a_folder_or_a_store(words, told, tmp_path):
    assert told in run("realise", tmp_path, *words, code=2).output


@pytest.mark.parametrize(
    ("words", "told"),
    [((FOUR_BAR, "--size", "nan"), "the size is nan"), (("m1:a.a",), "no drawing"), (("m1:ab",), "joint")],
)
def test_bad_input_is_one_line(words, told):
    output = run("realise", *words, code=2).output
    assert told in output
    assert output.count("\n") == 1
