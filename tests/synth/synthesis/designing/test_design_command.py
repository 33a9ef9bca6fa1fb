"""``synth design`` and `synth.design`: the same designs, kept in a store, resumed, written."""

import json

import numpy as np
import pytest
from commands import run

import synth
from synth.analysis.members import arcs_of
from synth.catalogue.patterns import generate
from synth.synthesis.designing import design
from synth.synthesis.designing.quadrilaterals import cell_curvatures

WISHES = {
    "format": "synthedra/wishes",
    "version": 1,
    "configurations": [{"name": "open", "inputs": {"0": 40}}],
    "wishes": [{"kind": "angle", "at": "open", "joint": 3, "equals": -50}],
}


@pytest.fixture
def files(tmp_path):
    synth.write(generate("four-bar").mechanism, tmp_path / "bar.json")
    (tmp_path / "wishes.json").write_text(json.dumps(WISHES))
    return tmp_path / "bar.json", tmp_path / "wishes.json"


def test_the_command_gives_what_the_function_gives(files):
    told = json.loads(run("design", *files, "--starts", 2, "--json").stdout)
    answer = design(*map(str, files), starts=2)
    assert [one["start"] for one in told["designs"]] == [one.start for one in answer.pareto]
    assert told["designs"][0]["figures"][0]["met"]
    printed = [line.rstrip() for line in run("design", *files, "--starts", 2).stdout.rstrip().splitlines()]
    assert printed == str(answer).splitlines()


def test_the_best_design_is_written_and_does_what_was_wished(files, tmp_path):
    run("design", *files, "--starts", 1, "-o", tmp_path / "new.json", "--picture", tmp_path / "new.svg")
    motion = synth.move(str(tmp_path / "new.json"), drive={0: 0.6981317007977318}, frames=1)
    assert abs(motion.path.angles[-1][3] + 0.8726646259971648) < 1e-9
    assert arcs_of(str(tmp_path / "new.json")) != arcs_of(str(files[0]))
    assert (tmp_path / "new.svg").stat().st_size > 500


def test_a_store_is_continued_and_gives_the_same_designs(files, tmp_path):
    whole = run("design", *files, "--starts", 3, "--store", tmp_path / "a.sqlite", "--json", "--workers", 1).stdout
    again = run("design", *files, "--starts", 3, "--store", tmp_path / "a.sqlite", "--json", "--resume", "--workers", 1)
    assert json.loads(again.stdout) == json.loads(whole)
    alone = run("design", *files, "--starts", 3, "--json").stdout
    assert json.loads(alone) == json.loads(whole)


TWO = {**WISHES, "wishes": [*WISHES["wishes"], {"kind": "arc", "joints": [0, 1], "equals": 40}]}


def test_a_run_goes_on_with_a_wish_frozen_and_another_weighed(files, tmp_path):
    files[1].write_text(json.dumps(TWO))
    first = run("design", *files, "--starts", 1, "--store", tmp_path / "a.sqlite", "--json", "--workers", 1).stdout
    changed = ("--begin", tmp_path / "a.sqlite", "--freeze", 1, "--weigh", "2=10")
    on = json.loads(run("design", *files, "--starts", 1, *changed, "--json").stdout)["designs"][0]
    before = json.loads(first)["designs"][0]
    assert [figure["met"] for figure in on["figures"]] == [True, True]
    angles = [one["configurations"]["open"] for one in (before, on)]
    assert angles[0] == pytest.approx(angles[1], abs=1e-6)  # it begins with what was met before, and stays there


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--freeze", 2), "there is no wish 2; expected 1 to 1"),
        (("--weigh", "1"), "is not K=WEIGHT"),
        (("--weigh", "x=1"), "expected K=WEIGHT"),
        (("--begin", "none.sqlite"), "no such file"),
    ],
)
def test_changes_of_wishes_that_are_not_there_are_one_line(files, options, message):
    assert message in run("design", *files, *options, code=2).output


def test_what_cannot_be_met_is_said_with_how_near_it_came(files):
    files[1].write_text(json.dumps({**WISHES, "wishes": [{"kind": "arc", "joints": [0, 1], "equals": 30}, *[
        {"kind": "arc", "joints": pair, "equals": angle} for pair, angle in ([[1, 2], 30], [[2, 3], 30], [[3, 0], 170])
    ]]}))  # fmt: skip
    result = run("design", *files, "--starts", 1, code=0)
    assert "largest miss of the first" in result.stdout


def test_options_that_need_a_store_and_files_that_are_not_there(files, tmp_path):
    assert "--store" in run("design", *files, "--resume", code=2).output
    assert "no such file" in run("design", files[0], tmp_path / "none.json", code=2).output
    assert "no such file" in run("design", tmp_path / "none.json", files[1], code=2).output


SADDLE = {
    "format": "synthedra/wishes",
    "version": 1,
    "closed_form": True,
    "parameters": {"rows": 4, "columns": 4, "sector": 1.2},
    "configurations": [{"name": "folded"}],
    "wishes": [{"kind": "curvature", "at": "folded", "principal": [0.1, -0.1]}],
}


def test_a_sheet_of_quadrilaterals_takes_curvatures_with_its_page_and_template(tmp_path):
    place = tmp_path / "saddle.json"
    place.write_text(json.dumps(SADDLE))
    files = ("-o", tmp_path / "saddle.fold", "--page", tmp_path / "page.html", "--template", tmp_path / "cut.svg")
    told = json.loads(run("design", "miura", place, "--starts", 1, *files, "--json").stdout)
    (one,) = told["designs"]
    assert one["figures"][0]["met"]
    assert one["residual"] < 1e-12
    sheet = synth.read(tmp_path / "saddle.fold")
    assert synth.mobility(sheet).verdict.freedoms == 1
    angles = [np.radians(angle) for angle in one["configurations"]["folded"].values()]
    folded = synth.fold(sheet, drive={1: angles[0]}, frames=1).sheets()[-1]
    gaussian, mean = cell_curvatures(np.array(folded.coordinates).reshape(5, 5, 3))
    np.testing.assert_allclose(gaussian, -0.01, atol=1e-9)
    np.testing.assert_allclose(mean, 0.0, atol=1e-9)
    page = (tmp_path / "page.html").read_text()
    assert page.count("<svg") == 2
    assert "curvatures 0.1 and -0.1 at folded" in page
    assert len(told["written"]) == len([path for path in tmp_path.iterdir() if path != place])
    for wrong, message in (
        ({"closed_form": False}, "set closed_form"),
        ({"parameters": {"rows": 3, "columns": 4}}, "a sheet of 3 x 4 panels; expected even numbers, 4 or more"),
    ):
        place.write_text(json.dumps({**SADDLE, **wrong}))
        assert message in run("design", "miura", place, code=2).output


def test_the_page_of_a_design_shows_the_target(tmp_path):
    sheet = tmp_path / "miura.fold"
    synth.write(generate("miura", rows=2, columns=2).mechanism, sheet)
    wish = {"kind": "on", "at": "folded", "target": {"formula": "x**2 + y**2 + (z - 9)**2 - 81"}}
    place = tmp_path / "wishes.json"
    place.write_text(
        json.dumps({**WISHES, "configurations": [{"name": "folded", "inputs": {"1": -30}}], "wishes": [wish]})
    )
    run("design", sheet, place, "--starts", 1, "--page", tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text()
    assert page.count("<figure>") == 2
    assert page.count("<path") + page.count("<polygon") > 8
