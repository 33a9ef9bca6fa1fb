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


@pytest.mark.parametrize(
    ("words", "told"),
    [((FOUR_BAR, "--size", "nan"), "the size is nan"), (("m1:a.a",), "no drawing"), (("m1:ab",), "joint")],
)
def test_bad_input_is_one_line(words, told):
    output = run("realise", *words, code=2).output
    assert told in output
    assert output.count("\n") == 1
