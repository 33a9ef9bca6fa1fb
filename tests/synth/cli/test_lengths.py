"""Lengths and branches as they are typed: what is out of range is refused in the words of the option."""

import pytest
from commands import run

FOLD = "data/patterns/four-bar-vertex.fold"
CONE = "data/surfaces/fig11-stephenson.json"


@pytest.fixture(autouse=True)
def _at_home(data, monkeypatch):
    monkeypatch.chdir(data.parent)


@pytest.mark.parametrize("value", ["nan", "inf", "0", "-1", "1e160", "1e-300", "wide"])
@pytest.mark.parametrize(
    ("words", "option"),
    [
        (("template", FOLD, "-o", "a.pdf"), "--size"),
        (("template", FOLD, "-o", "a.pdf"), "--scale"),
        (("template", CONE, "-o", "a.pdf"), "--thickness"),
        (("convert", FOLD, "a.stl"), "--size"),
        (("convert", FOLD, "a.stl"), "--scale"),
        (("realise", "k1:Cr"), "--size"),
    ],
)
def test_a_length_out_of_range_is_told_by_its_option(words, option, value):
    told = run(*words, option, value, code=2).output
    assert f"Invalid value for '{option}'" in told
    assert "out of range; expected 1e-50 to 1e+50" in told or "'wide' is not a number" in told


@pytest.mark.parametrize("value", ["nan", "inf", "-1", "1e160", "1e-300", "wide"])
def test_a_thickness_of_solids_out_of_range(value):
    told = run("convert", FOLD, "a.stl", "--thickness", value, code=2).output
    assert "Invalid value for '--thickness'" in told


@pytest.mark.parametrize(
    "words", [("a.stl",), ("a.obj",), ("a.gltf",), ("a.xml", "--as", "mjcf"), ("a.step", "--as", "step")]
)
@pytest.mark.parametrize("source", [FOLD, CONE])
def test_solids_of_no_thickness(words, source):
    """One line that names the file."""
    told = run("convert", source, *words, "--size", 60, "--thickness", 0, code=2).output
    assert len(told.splitlines()) == 1
    assert told.startswith(f"{source}: thickness 0.0; expected a positive number")


def test_a_gap_may_be_0_and_not_less(tmp_path):
    words = ("convert", FOLD, tmp_path / "a.stl", "--size", 60, "--gap")
    assert "expected 0, or 1e-50 to 1e+50" in run(*words, -1, code=2).output
    run(*words, 0)


@pytest.mark.parametrize(
    ("option", "told"), [("--thickness", "at most 1e+06"), ("--size", "try a smaller --scale, or --size")]
)
@pytest.mark.parametrize("source", [FOLD, CONE])
def test_nothing_larger_than_a_kilometre_is_cut_out(source, option, told, tmp_path):
    words = ("convert", source, tmp_path / "a.gltf", "--gap", 0, *(() if option == "--size" else ("--size", 60)))
    refused = run(*words, option, 1e49, code=2).output
    assert told in refused or "at most 1e+06" in refused
    assert len(refused.splitlines()) == 1


def test_a_branch_of_many_digits_is_none():
    digits = "9" * 5_000
    for words in (
        ("fold", FOLD),
        ("advise", FOLD, "--freedoms", 0),
        ("draw", FOLD, "-o", "a.svg", "--colour", "branch"),
    ):
        assert "a number of 5000 digits" in run(*words, "--branch", digits, code=2).output


@pytest.mark.parametrize("rate", ["nan", "inf", "0", "1e308", "1e-200"])
def test_rates_have_a_range(rate):
    assert "expected finite ones, not all zero" in run("fold", FOLD, "--along", f"0={rate}", code=2).output
