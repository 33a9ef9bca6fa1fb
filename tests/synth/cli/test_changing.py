"""`synth convert`, `reduce`, `edit` and `reconstruct`: one mechanism made of another."""

from __future__ import annotations

import json
import re
from pathlib import Path

import jsonschema
import pytest
from commands import run

from graphs.files.formats import read, write
from graphs.identity.chains import chain_id
from graphs.loops.loop import Loop
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet


def test_convert_round_trip(data, tmp_path):
    scd = tmp_path / "scd.json"
    run("convert", data / "patterns" / "bird-base.fold", scd, "--to", "scd")
    assert isinstance(read(scd), SCDGraph)
    run("convert", scd, tmp_path / "back.fold")
    run("convert", tmp_path / "back.fold", tmp_path / "sc.json")
    sc = read(tmp_path / "sc.json")
    assert (len(sc), len(sc.joints), len(sc.loops)) == (16, 20, 5)
    run("convert", data / "wiener" / "miura-3x3.fold", tmp_path / "model.json", "--to", "polyhedron")
    model = read(tmp_path / "model.json")
    assert isinstance(model, PolyhedronModel)
    assert len(model.coordinates) == 16
    run("convert", data / "wiener" / "nine-bar-mesh.json", tmp_path / "ve.json", "--to", "vertex-edge")
    run("convert", tmp_path / "ve.json", tmp_path / "sc2.json", "--to", "sc")
    assert len(read(tmp_path / "sc2.json")) == 9


def test_convert_tells_what_is_lost(data, tmp_path):
    watt = data / "wiener" / "watt.json"
    assert "not stored: 2 loops and their centres" in run("convert", watt, tmp_path / "watt.graphml").stdout
    told = json.loads(run("convert", watt, tmp_path / "watt.g6", "--json").stdout)
    assert told["lost"] == ["2 loops and their centres"]
    assert told["kind"] == "SCGraph"
    result = run("convert", watt, tmp_path / "watt.fold", code=2)
    assert result.stderr.splitlines() == [
        f"{watt}: the order of the sides of the links is not known; `synth enumerate scd --of FILE --max-degree D` "
        "lists the SCD graphs with up to D sides per link, `synth convert --max-degree D` takes the one if there is "
        "only one"
    ]
    assert not (tmp_path / "watt.fold").exists()


@pytest.mark.parametrize(("form", "centres"), [("planar", 1), ("spherical", 1), ("general", 2)])
def test_convert_changes_the_centres(form, centres, data, tmp_path):
    out = tmp_path / "out.json"
    run("convert", data / "wiener" / "watt.json", out, "--form", form)
    (report,) = json.loads(run("mobility", "--json", out).stdout)
    assert (report["centres"], report["mobility"]) == (centres, 1)


def test_reduce_shows_chains_and_writes_what_is_left(data, tmp_path):
    out = run("reduce", data / "wiener" / "fortune-teller.json", "-o", tmp_path / "eight.json").stdout
    assert "before  links 16, joints 20, mobility 5" in out
    assert "after   links 8, joints 8, mobility 5" in out
    assert "4 steps in 4 adjunct addenda" in out
    assert len(read(tmp_path / "eight.json")) == 8
    told = json.loads(run("reduce", "--json", data / "wiener" / "fortune-teller.json").stdout)
    assert told["before"] == {"links": 16, "joints": 20, "mobility": 5}
    assert told["after"] == {"links": 8, "joints": 8, "mobility": 5}
    assert [step["sits_on"] for step in told["steps"]] == [None] * 4
    assert "nothing to take off" in run("reduce", data / "wiener" / "watt.json", "--keep", "1", "--keep", "4").stdout
    assert (
        "after   links 2, joints 1, mobility 1" in run("reduce", "--fully", data / "wampler" / "fig12-scd.json").stdout
    )
    result = run("reduce", data / "wiener" / "watt.json", "--keep", "sky", code=2)
    assert "'sky' is no link; expected one of 0, 1, 2, 3, 4, 5" in result.stderr
    stephenson = data / "wiener" / "stephenson.json"
    assert "requires --ground LINK, and an --input JOINT" in run("reduce", "--rule", "assur", stephenson, code=2).stderr
    words = ("reduce", stephenson, "--rule", "assur", "--ground", 0, "--input", 0)
    out = run(*words).stdout
    assert re.search(r"group 1: links 1, joints 0, input 0\n", out)
    assert out.count("(removed)") == 2
    told = json.loads(run(*words, "--json").stdout)
    assert (told["before"]["mobility"], told["after"]["mobility"], told["after"]["links"]) == (1, 1, 2)
    assert "require --rule assur" in run("reduce", stephenson, "--input", 0, code=2).stderr
    assert "need one centre" in run("reduce", data / "wiener" / "watt.json", *words[2:], code=2).stderr


def test_edit_tells_predicted_and_counted_change(data, tmp_path):
    six = data / "wiener" / "six-bar.json"
    out = run("edit", six, "--add-ride-along", "0,1", "--lock", "0", "-o", tmp_path / "out.json").stdout
    assert re.search(r"ride-along on \d and \d +Eq. 7 +0 +0 +1", out)
    assert re.search(r"lock joint 0 +Eq. 7 +-1 +-1 +0", out)
    assert isinstance(read(tmp_path / "out.json"), SCDGraph)
    told = json.loads(run("edit", "--json", data / "wiener" / "watt.json", "--add-loop", "0,1,3", "--add-spatial-loop",
                          "0,1,4", "--add-crease", "2:1").stdout)["edits"]  # fmt: skip
    assert [(one["predicted"], one["counted"], one["equation"]) for one in told] == [
        (1, 1, "Eq. 6"), (1, 1, "Eq. 6"), (-1, -1, "Eq. 5")
    ]  # fmt: skip
    fan = tmp_path / "fan.json"
    run("convert", data / "patterns" / "four-bar-vertex.fold", fan, "--to", "scd")
    moved = json.loads(run("edit", "--json", fan, "--implicit", "0", "-o", tmp_path / "away.json").stdout)["edits"]
    assert [one["predicted"] for one in moved] == [0]
    run("edit", tmp_path / "away.json", "--explicit", "0", "-o", tmp_path / "back.json")
    assert read(tmp_path / "back.json").is_identical(read(fan))
    mesh = data / "wiener" / "nine-bar-mesh.json"
    a, _, b, _ = read(mesh).vertices[4]
    assert re.search(r"crease in 4 +Eq. 7 +1 +1 +1", run("edit", mesh, "--add-crease", f"4:{a},{b}").stdout)


def test_an_edited_pattern_is_a_pattern(data, tmp_path):
    bird, out = data / "patterns" / "bird-base.fold", tmp_path / "x.fold"
    words = ["--lock", "3", "--add-crease", "-1,0.3:1,0.3", "--remove-crease", "0", "--lock", "8,10"]
    told = json.loads(run("edit", bird, *words, "-o", out, "--json").stdout)
    assert [one["what"].split(" ")[0] for one in told["edits"]] == ["lock", "lock", "crease", "remove"]
    assert told["lost"] == []
    edited = read(out)
    assert isinstance(edited, Sheet)
    [report] = json.loads(run("mobility", out, "--json").stdout)
    assert report["mobility"] == told["edits"][-1]["mobility"]
    before, after = (sum(letter == "F" for letter in sheet.assignments) for sheet in (read(bird), edited))
    assert after >= before + 2
    ridden = tmp_path / "ridden.json"
    run("edit", bird, "--add-ride-along", "0,1", "-o", ridden)
    assert isinstance(read(ridden), SCGraph)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--lock", "99"], "'99' is no edge; expected one of 0, 1, 2, 3, 5, 6, "),
        (["--add-crease", "0"], "'0' is not A:B, two vertices or points X,Y of the pattern"),
        (["--add-crease", "0:sky"], "'sky' is neither a vertex nor a point X,Y"),
        (["--add-crease", "0.3,0.1:2"], "the nearest are vertex 9 (0.585786, 0) and edge 0 (V) from vertex 0 (0, 0)"),
        (["--remove-crease", "0", "--add-ride-along", "0,1"], "--remove-crease requires a crease pattern"),
    ],
)
def test_edits_of_patterns_that_cannot_be(words, message, data):
    assert message in run("edit", data / "patterns" / "bird-base.fold", *words, code=2).stderr


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--lock", "99"], "'99' is no joint; expected one of 0, 1, 2, 3, 4, 5, 6"),
        (["--implicit", "0"], "--implicit requires an SCD graph"),
        (["--add-ride-along", "0"], "'0' has 1 part; expected 2"),
        (["--add-ride-along", "0,sky"], "'sky' is no link"),
        (["--add-loop", "0,1,x"], "'x' is not a number"),
        ([], "no edit; try"),
    ],
)
def test_edits_that_cannot_be(words, message, data):
    assert message in run("edit", data / "wiener" / "watt.json", *words, code=2).stderr


def test_a_loop_between_links_that_are_not_adjacent_goes_through_named_joints(data, tmp_path):
    """Wiener 4.2.5.2: four links between two links of a spherical six-bar make the ten-bar of 4.1.4.6, M 3 to 2."""
    ring, ten = tmp_path / "ring.json", tmp_path / "ten.json"
    write(SCGraph(6, [(i, (i + 1) % 6) for i in range(6)], [Loop(range(6))]), ring)
    (told,) = json.loads(run("edit", "--json", ring, "--add-spatial-loop", "0,2,4:0,1", "-o", ten).stdout)["edits"]
    assert (told["predicted"], told["counted"], told["mobility"], told["equation"]) == (-1, -1, 2, "Eq. 5")
    made, known = read(ten), read(data / "wiener" / "hybrid-ten-bar.json")
    assert chain_id(made) == chain_id(known)
    assert (len(made.centred_loops), made.spatial_loops) == (len(known.centred_loops), known.spatial_loops) == (1, 1)
    (told,) = json.loads(run("edit", "--json", ring, "--add-loop", "0,3,2:0,1,2").stdout)["edits"]
    assert (told["predicted"], told["counted"], told["mobility"], told["equation"]) == (0, 0, 3, "Eq. 6")
    refused = run("edit", ring, "--add-spatial-loop", "0,2,4", code=2).stderr
    assert "say which joints the new loop goes through" in refused
    assert "is no joint" in run("edit", ring, "--add-loop", "0,2,4:0,9", code=2).stderr
    assert "meets link" in run("edit", ring, "--add-loop", "0,2,4:3,4", code=2).stderr


def test_reconstruct_writes_the_model(data, tmp_path):
    out = run("reconstruct", data / "wiener" / "table3-row3.json", "-o", tmp_path / "model.json").stdout
    assert "V = 9, C = 1, E = 15 external + 8 internal, M = 1" in out
    assert "explicit centre" in out
    told = json.loads(run("reconstruct", data / "wiener" / "table3-row3.json", "--json").stdout)
    assert [v["vertex"] for v in told["vertices"]] == list(range(9))
    (report,) = json.loads(run("mobility", "--json", tmp_path / "model.json").stdout)
    assert (report["mobility"], report["centres"], report["counts"]["edges"]) == (1, 1, 23)
    schema = Path(__file__).resolve().parents[3] / "graphs" / "schema" / "polyhedron.schema.json"
    jsonschema.validate(json.loads((tmp_path / "model.json").read_text()), json.loads(schema.read_text()))


def test_reconstruct_needs_the_sides_of_the_links(data):
    result = run("reconstruct", data / "wiener" / "watt.json", code=2)
    assert "the order of the sides of the links is not known" in result.stderr
