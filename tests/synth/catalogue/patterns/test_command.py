"""``synth generate``: a list, help with units and ranges, files that other commands take."""

import json

import pytest
from commands import run

from synth.catalogue.patterns import GENERATORS


def test_the_list_names_all():
    printed = run("generate", "--list").stdout
    assert all(name in printed for name in GENERATORS)
    listed = json.loads(run("generate", "--json").stdout)
    assert [one["name"] for one in listed] == list(GENERATORS)
    assert listed[0]["parameters"][2] == {
        "name": "sector", "unit": "degrees", "default": 60.0, "least": 20.0, "most": 85.0,
        "meaning": "acute angle of the panels",
    }  # fmt: skip


@pytest.mark.parametrize("name", GENERATORS)
def test_help_has_units_and_ranges(name):
    printed = " ".join(run("generate", name, "--help").stdout.split())
    for one in GENERATORS[name].parameters:
        assert f"--{one.name}" in printed
    assert ("--fold" in printed) == GENERATORS[name].foldable
    assert "Source:" in printed
    assert GENERATORS[name].relations in printed


def test_a_file_for_every_command(tmp_path):
    sheet, ring = tmp_path / "a.fold", tmp_path / "a.json"
    printed = run("generate", "miura", "--rows", 2, "--columns", 2, "--fold", 30, "-o", sheet).stdout
    assert "folded to 30 degrees" in printed
    assert "1 degree of freedom of finite motion, according to the source" in printed
    assert "Rigid-foldable from this configuration: 1 degree of freedom" in run("mobility", sheet).stdout
    told = json.loads(run("generate", "bennett", "--twist", 30, "-o", ring, "--json").stdout)
    assert (told["parameters"]["twist"], told["freedoms"], told["output"]) == (pytest.approx(30), 1, str(ring))
    assert "1 degree of freedom (numerical)" in run("fold", ring, "--drive", "0=3", "--frames", 1).stdout


def test_wrong_words_are_one_line(tmp_path):
    for words in (["--sector", 90], ["--rows", 0], ["--fold", 200]):
        lines = run("generate", "miura", *words, code=2).stderr.strip().splitlines()
        assert len(lines) == 1
        assert "expected" in lines[0]
    assert "no generator 'crane'; expected one of miura, " in run("generate", "crane", code=2).stderr
    assert "Did you mean 'miura'?" in run("generate", "muira", code=2).stderr
    (tmp_path / "a.fold").write_text("")
    assert "a.fold" in run("generate", "miura", "-o", tmp_path / "a.fold", code=2).stderr
