"""``synth cone`` and ``synth cylinder``: words, keys that scripts rely on, pictures, bad input."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path

import numpy as np
import pytest
from commands import run
from conical import WATT
from sizes import slow

from graphs.files.formats import write
from graphs.mechanism.surfaces import SurfaceLinkage
from synth.linkages.surfaces.circuit import link_angles, link_pairs

ROOT = Path(__file__).resolve().parents[3]
FIG_11 = ROOT / "data" / "surfaces" / "fig11-stephenson.json"
KEYS = {"lambda_deg", "circuit", "signs", "k"}


def told(*words):
    return json.loads(run(*words, "--json").stdout)


def test_cones_of_a_loop():
    found = told("cone", "map", "--angles", "120,95,45,85")
    assert all(one.keys() >= KEYS for one in found["cones"])
    assert [(one["circuit"], one["signs"], one["k"]) for one in found["cones"]] == [
        ("open", [1, 1, 1, 1], 1), ("crossed", [1, -1, 1, -1], 0)
    ]  # fmt: skip
    np.testing.assert_allclose([one["lambda_deg"] for one in found["cones"]], [13.9983566781, 29.0444694333], atol=1e-8)
    assert (found["families"], found["flat"], found["class"], found["grashof"]) == ([], [], "a", "Grashof")
    out = run("cone", "map", "--angles", "120,95,45,85").stdout
    assert re.search(r"13\.99835668 +76\.00164332 +open +\+\+\+\+ +1 ", out)
    assert "class a of Hyatt et al. 2020, Fig. 10" in out


def test_families_and_the_flat_cone():
    found = told("cone", "map", "--angles", "120,50,120,50")
    assert [(one["signs"], one["k"], one["lambda_deg"]) for one in found["families"]] == [
        ([1, 1, -1, -1], 0, [0.0, pytest.approx(30)]), ([1, -1, -1, 1], 0, [0.0, pytest.approx(30)])
    ]  # fmt: skip
    assert "every one of these" in run("cone", "map", "--angles", "120,50,120,50").stdout
    found = told("cone", "map", "--angles", "100,70,90,60")
    assert [one["lambda_deg"] for one in found["flat"]] == [0.0]
    assert all(0 < one["lambda_deg"] < 90 for one in found["cones"])
    assert "flat, no cone" in run("cone", "map", "--angles", "100,70,90,60").stdout


def test_what_rounding_decides_is_said():
    near = "5.989154148123322,5.9891541483655,101.40900325209661,101.40900325185983"
    (crossed, _) = told("cone", "map", "--angles", near)["cones"]
    low, high = crossed["lambda_bounds_deg"]
    assert low < 9.7642 < high
    assert "few digits" in crossed["caution"]
    out = run("cone", "map", "--angles", near).stdout
    assert re.search(r"ill-conditioned, between 9\.\d+ and 10\.\d+", out)
    assert "caution: ill-conditioned: rounding leaves few digits of the size" in out
    found = told("cylinder", "map", "--lengths", "4,3,5,2.0000000000000004")
    assert "T1" in found["type_caution"]
    assert any("stretched out" in caution for caution in found["cautions"])
    assert told("cylinder", "map", "--lengths", "4,3,5,2")["cautions"] == []
    family = told("cylinder", "map", "--lengths", "5,3,5,3.0000000000000004")["families"][0]
    assert "within the rounding" in family["caution"]
    assert (
        "every one of these, ill-conditioned" in run("cylinder", "map", "--lengths", "5,3,5,3.0000000000000004").stdout
    )


def test_a_linkage_without_a_cone_says_why_and_offers_another():
    found = told("cone", "map", "--angles", "170,160,150,145")
    assert found["cones"] == []
    assert found["why"].startswith("T4 < 0")
    assert len(found["supplementary"]["cones"]) == 2
    out = run("cone", "map", "--angles", "170,160,150,145").stdout
    assert "no cone: T4 < 0" in out
    assert "supplementary linkage, on the same joint lines: 10, 20, 30, 35" in out
    assert "a link of 180 degrees" in run("cone", "map", "--angles", "180,60,120,60").stdout


def test_loops_of_other_numbers_of_links():
    assert [one["lambda_deg"] for one in told("cone", "map", "--angles", "60,60,60")["cones"]] == [
        pytest.approx(np.degrees(np.arctan(np.sqrt(2))))
    ]
    found = told("cylinder", "map", "--lengths", "1,1,1,1,1")
    assert {round(one["radius"], 6) for one in found["cylinders"]} == {0.525731, 0.57735, 0.850651}
    assert "grashof" not in found
    assert found["families"] == []


def test_cylinders_of_a_loop():
    found = told("cylinder", "map", "--lengths", "4,3,5,1")
    assert all(one.keys() >= {"radius", "circuit", "signs", "k"} for one in found["cylinders"])
    assert [(one["circuit"], one["signs"], one["k"]) for one in found["cylinders"]] == [
        ("open", [1, 1, 1, 1], 1), ("crossed", [1, 1, -1, -1], 0)
    ]  # fmt: skip
    assert re.search(r"2\.536145625 +open", run("cylinder", "map", "--lengths", "4,3,5,1").stdout)
    family = told("cylinder", "map", "--lengths", "5,3,5,3")["families"][0]
    assert family["radius"] == [2.5, None]
    assert "infinite radius" in run("cylinder", "map", "--lengths", "3,1,1,1").stdout


def test_a_linkage_of_several_loops(tmp_path, rng):
    (cone,) = told("cone", "map", FIG_11)["cones"]
    assert cone.keys() >= KEYS
    assert cone["lambda_deg"] == pytest.approx(20)
    assert (cone["signs"][0], cone["k"], cone["circuit"]) == ([1, 1, 1, -1], [0, 0], ["open", "crossed"])
    assert {frozenset(one[:2]): one[2] for one in cone["link_angles_deg"]}[frozenset("OA")] == pytest.approx(
        37.4944745021
    )
    places = dict(zip(WATT.joints, rng.uniform(-3, 3, 7), strict=True))
    angles = {(a, b): float(link_angles(places[b] - places[a], 0.7)) for a, b in link_pairs(WATT)}
    write(SurfaceLinkage(WATT, angles=angles), tmp_path / "watt.json")
    found = told("cone", "map", tmp_path / "watt.json")
    assert any(one["lambda_deg"] == pytest.approx(np.degrees(0.7)) for one in found["cones"])
    assert "lambda 40.1070" in run("cone", "map", tmp_path / "watt.json").stdout
    first = next(iter(angles))
    write(SurfaceLinkage(WATT, angles={**angles, first: angles[first] + 0.01}), tmp_path / "off.json")
    assert "no cone is common to all loops" in run("cone", "map", tmp_path / "off.json").stdout
    assert told("cone", "map", tmp_path / "off.json")["cones"] == []
    assert told("cone", "map", tmp_path / "off.json", "--tolerance", 5)["cones"]
    steps = {(0, j): places[j] - places[0] for j in range(1, 7)}
    write(SurfaceLinkage(WATT, steps=steps), tmp_path / "any.json")
    assert [one["lambda_deg"] for one in told("cone", "map", tmp_path / "any.json")["families"]] == [[0.0, 90.0]]
    assert "every lambda between 0 and 90 degrees" in run("cone", "map", tmp_path / "any.json").stdout


def test_behaviour_of_a_four_bar():
    out = run("cone", "behaviour", "--steps", "40,50,50").stdout
    assert "any cone or cylinder, link 1 fixed: can be intramobile or extramobile" in out
    assert "Table 4: case 1, open, A" in out
    (one,) = told("cone", "behaviour", "--steps", "40,50,50,-140", "--ground", 2)["linkages"]
    assert (one["intramobile"], one["extramobile"], one["ground"]) == (False, False, 2)
    assert one["table4"] == {"case": 1, "configuration": "open", "column": "B", "diameter": False}
    assert {link["link"]: link["way"] for link in one["links"]} == {
        1: "outward", 2: "still", 3: "inward", 4: "both"
    }  # fmt: skip
    assert (one["freedoms"], one["rank"], one["tangent"]) == (1, 3, [])
    found = told("cone", "behaviour", "--angles", "120,95,45,85")["linkages"]
    assert [round(x["lambda_deg"], 4) for x in found] == [13.9984, 29.0445]
    diameter = told("cone", "behaviour", "--steps", "40,50,90")["linkages"][0]
    assert (diameter["intramobile"], diameter["extramobile"]) == (False, True)
    assert "a chord is a diameter" in run("cone", "behaviour", "--steps", "40,50,90").stdout


def test_behaviour_of_several_loops():
    (one,) = told("cone", "behaviour", FIG_11, "--ground", 2)["linkages"]
    assert (one["freedoms"], one["rank"], one["ground"], len(one["links"])) == (1, 6, 2, 6)
    assert one["table4"] is None
    assert "link 2 fixed: transmobile" in run("cone", "behaviour", FIG_11, "--ground", 2).stdout
    assert "3 infinitesimal degrees of freedom" in run("cone", "behaviour", "--steps", "60,60,60,60,60,60").stdout


@pytest.mark.parametrize("words", [
    ["cone", "map", "--angles", "120,95,45,85"], slow(["cone", "map", "--angles", "120,50,120,50"]),
    slow(["cone", "map", "--angles", "60,70,80,50,90"]), slow(["cone", "map", FIG_11]),
    slow(["cylinder", "map", "--lengths", "4,3,5,1"]), ["cylinder", "map", "--lengths", "5,3,5,3"],
    slow(["cone", "behaviour", "--angles", "120,95,45,85"]), slow(["cone", "behaviour", FIG_11]), ["cone", "behaviour", "--steps", "40,50,50"],
])  # fmt: skip
def test_pictures(words, tmp_path):
    pytest.importorskip("matplotlib")
    for suffix, head in (("png", b"\x89PNG"), ("svg", (b"<?xml", b"<svg"))):
        run(*words, "-o", tmp_path / f"a.{suffix}")
        assert (tmp_path / f"a.{suffix}").read_bytes().startswith(head)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.png", "a.svg"]


@pytest.mark.parametrize("whole", [False, slow(True)])
def test_a_loop_is_written_by_its_angles_or_on_a_cone(whole, tmp_path):
    angles, by_angles = ("--angles", "120,95,45,85"), tmp_path / "angles.json"
    assert run("cone", "map", *angles, "-o", by_angles).stdout.endswith(f"\nwritten: {by_angles}\n")
    both = told("cone", "map", by_angles)["cones"]
    named = told("cone", "map", *angles)["cones"]
    np.testing.assert_allclose([one["lambda_deg"] for one in both], [one["lambda_deg"] for one in named], atol=1e-9)
    moved = told("cone", "move", *angles)["linkages"]
    for number, given in ((2, (by_angles,)), *(((1, angles), (2, angles)) if whole else ())):
        placed = tmp_path / "placed.json"
        run("cone", "map", *given, "--cone", number, "--force", "-o", placed)
        [cone] = told("cone", "map", placed)["cones"]
        assert cone["lambda_deg"] == pytest.approx(named[number - 1]["lambda_deg"], abs=1e-8)
        [motion] = told("cone", "move", placed)["linkages"]
        assert motion["range_deg"] == pytest.approx(moved[number - 1]["range_deg"], abs=1e-6)
    for number, size in ((1, "14°"), (2, "29.04°")):
        run("cone", "map", *angles, "--cone", number, "-o", tmp_path / f"{number}.svg")
        assert f"λ = {size}" in (tmp_path / f"{number}.svg").read_text()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["180,60,120,60"], "link angle 1 is 180 degrees; expected the angle between two axes, between 0 and 180"),
        (["120,95,45,85", "--cone", 3], "the linkage lies on 2 cones: expected --cone of 2 at most, got 3"),
        (["170,160,150,145", "--cone", 1], "the linkage lies on no cone"),
    ],
)
def test_what_lies_on_no_such_cone_is_not_written(words, message, tmp_path):
    assert message in run("cone", "map", "-o", tmp_path / "a.json", "--angles", *words, code=2).stderr
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("words", "number", "size"),
    [
        (["cylinder", "map", "--lengths", "6,2,6,2", "--radius", 4], None, 4.0),  # a parallelogram, Fig. 5
        (["cylinder", "map", "--lengths", "5,5,3,3", "--radius", 4], 2, 4.0),  # a kite, Fig. 6
        (["cylinder", "map", "--lengths", "5,5,3,3", "--radius", 2.5], None, 2.5),  # where its longest link ends
        (["cone", "map", "--angles", "120,50,120,50", "--lambda", 20], None, 20.0),
        (["cone", "map", "--angles", "80,80,50,50", "--half-angle", 70], 2, 20.0),
        *((["cylinder", "map", "--lengths", "6,2,6,2"], row, size) for row, size in ((1, 10**0.5), (2, 6), (3, 6))),
        *((["cone", "map", "--angles", "120,50,120,50"], row, size) for row, size in ((1, 15.4974918042), (3, 15))),
    ],
)
def test_every_row_of_the_table_can_be_written(words, number, size, tmp_path):
    """Also one of a family, on which the links have their lengths, by arithmetic alone."""
    file, kind = tmp_path / "a.json", words[0]
    run(*words, *([] if number is None else [f"--{kind}", number]), "-o", file)
    linkage = json.loads(file.read_text())
    key = "radius" if kind == "cylinder" else "lambda_deg"
    assert linkage[key] == pytest.approx(size, abs=1e-9)
    steps = np.radians([step[2] for step in linkage["steps"]])
    steps = np.append(steps, -steps.sum())
    sizes = [float(word) for word in words[3].split(",")]
    if kind == "cylinder":
        np.testing.assert_allclose(2 * size * np.abs(np.sin(steps / 2)), sizes, atol=1e-9)
    else:
        half = np.cos(np.radians(size)) * np.abs(np.sin(steps / 2))
        np.testing.assert_allclose(np.degrees(2 * np.arcsin(half)), sizes, atol=1e-6)
    assert "circuit closed" in run(kind, "move", file).stdout


def test_a_row_of_a_linkage_in_a_file_can_be_written(tmp_path):
    sizes, placed = tmp_path / "sizes.json", tmp_path / "placed.json"
    run("cylinder", "map", "--lengths", "6,2,6,2", "-o", sizes)
    assert "cylinder 3: every radius from 3 on" in run("cylinder", "map", sizes).stdout
    out = run("cylinder", "map", sizes, "--radius", 4, "-o", placed).stdout
    assert "cylinder 1 of 2: radius 4; --cylinder chooses another" in out
    steps = [step[2] for step in json.loads(placed.read_text())["steps"]]
    run("cylinder", "map", "--lengths", "6,2,6,2", "--radius", 4, "-o", placed, "--force")
    assert [step[2] for step in json.loads(placed.read_text())["steps"]] == pytest.approx(steps)
    message = "does not lie on the cylinder of radius 2.9; try without --radius"
    assert message in run("cylinder", "map", sizes, "--radius", 2.9, "-o", tmp_path / "b.json", code=2).stderr


def test_a_surface_that_was_chosen_and_is_none_says_where_the_links_lie():
    out = run("cylinder", "map", "--lengths", "4,3,5,1", "--radius", 2).stdout
    assert "radius 2 was chosen, and the loop lies on radius 2.536145625, 2.590911136" in out
    assert [
        one["circuit"] for one in told("cylinder", "map", "--lengths", "4,3,5,1", "--radius", 2.536145625)["cylinders"]
    ] == ["open"]


def test_a_link_of_more_than_half_a_turn_is_said(tmp_path):
    note = "link 1: 200 degrees is read as 160"
    assert note in run("cone", "map", "--angles", "200,95,45,85", "-o", tmp_path / "a.json").stdout
    assert json.loads((tmp_path / "a.json").read_text())["angles"][0][2] == 160.0
    assert told("cone", "map", "--angles", "200,95,45,85")["notes"][0].startswith(note)
    assert note in run("cone", "behaviour", "--angles", "200,95,75,85").stderr
    assert note in run("cone", "move", "--angles", "200,95,75,85").stderr


def test_no_minus_before_a_zero():
    assert not re.search(r"-0\b(?!\.)", run("cone", "behaviour", "--angles", "100,80,60,70").stdout)


def test_a_picture_without_matplotlib_names_the_extra(monkeypatch, tmp_path):
    import sys

    monkeypatch.setitem(sys.modules, "matplotlib", None)
    result = run("cylinder", "map", "--lengths", "4,3,5,1", "-o", tmp_path / "a.png", code=2)
    assert result.stderr.strip() == "PNG requires matplotlib; try pip install 'synthedra[draw]'"
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["cone", "map", "--angles", "-10,20,30"], "link angle 1 is -10 degrees; expected between 0 and 360"),
        (["cone", "map", "--angles", "10,370,30"], "link angle 2 is 370 degrees; expected between 0 and 360"),
        (["cone", "map", "--angles", "10,20,50"], "the link angles 10, 20, 50 cannot close"),
        (["cone", "map", "--angles", "nan,20,50"], "not all numbers"),
        (["cone", "map", "--angles", "10,inf,50"], "not all numbers"),
        (["cone", "map", "--angles", ",".join(["20"] * 17)], "a loop of 17 links; expected 3 to 16"),
        (["cylinder", "map", "--lengths", "1,2,30"], "the lengths 1, 2, 30 cannot close"),
        (["cylinder", "map", "--lengths", "1,-2,2"], "length 2 is -2; expected a length above 0"),
        (["cylinder", "map", "--lengths", "3,4,5", "-o", "a.bmp"], "a.bmp: files ending in '.bmp' are not known"),
        (["cone", "map", "missing.json"], "missing.json: no such file"),
        (["cone", "map", ROOT / "data" / "wiener" / "watt.json"], "a linkage on a surface, 'synthedra/conical' or 'synthedra/cylindrical'"),
        (["cone", "behaviour", "--steps", "40,50,50", "--lambda", "90"], "the cone angle is 90 degrees; expected 0 or"),
        (["cone", "behaviour", "--steps", "40,50,50", "--lambda", "-1"], "the cone angle is -1 degrees"),
        (["cone", "behaviour", "--steps", "40,0,50"], "step 2 is 0 degrees"),
        (["cone", "behaviour", "--steps", "40,190,50"], "step 2 is 190 degrees; expected between -180 and 180"),
        (["cone", "behaviour", "--steps", "40"], "2 steps; expected three or more"),
        (["cone", "behaviour", "--steps", "40,50,50", "--ground", "9"], "'9' is no link; expected one of"),
        (["cone", "behaviour", FIG_11, "--ground", "x"], "fig11-stephenson.json: 'x' is no link; expected one of 0, 1"),
    ],
)  # fmt: skip
def test_bad_input_gives_a_line(words, message):
    result = run(*words, code=2)
    assert message in result.stderr
    assert len(result.stderr.splitlines()) == 1


@pytest.mark.parametrize(
    "words",
    [
        ["cone", "map"], ["cone", "map", "a.json", "--angles", "1,2,3"], ["cone", "map", "--angles", "1,x"],
        ["cone", "behaviour"], ["cone", "behaviour", "--steps", "1,2", "--angles", "1,2"], ["cylinder", "map"],
        ["cone", "behaviour", "--angles", "170,160,150,145", "-o", "a.png"],
        ["cone", "map", "--angles", "1,2,3", "--tolerance", "0"], ["cone", "map", "--angles", "1,2,3", "--cone", "1"],
    ],
)  # fmt: skip
def test_usage_errors_keep_clicks_format(words):
    assert "Usage:" in run(*words, code=2).output


@pytest.mark.parametrize("words", [slow("cone map"), "cone behaviour", "cylinder map", "cone", slow("cylinder")])
def test_examples_of_the_help_texts_run(words, monkeypatch, tmp_path):
    (tmp_path / "data").symlink_to(ROOT / "data")
    monkeypatch.chdir(tmp_path)
    out = run(*words.split(), "--help").stdout
    examples = re.findall(r"^ +synth (.*)$", out.partition("Example")[2], re.MULTILINE)
    assert examples
    for example in examples:
        run(*shlex.split(example))


def test_the_inverse_of_a_candidate():
    """Fig. 11 by its link angles alone: the cone they came from, with signs and azimuths; and every other one."""
    steps = json.loads(run("cone", "map", FIG_11, "--json").stdout)["cones"]
    found = json.loads(run("cone", "map", FIG_11, "--by-angles", "--json").stdout)["cones"]
    [same] = [one for one in found if abs(one["lambda_deg"] - 20) < 1e-6 and one["signs"] == steps[0]["signs"]]
    assert same["k"] == steps[0]["k"]
    assert same["circuit"] == steps[0]["circuit"]
    assert {tuple(pair[:2]): pair[2] for pair in same["link_angles_deg"]} == pytest.approx(
        {tuple(pair[:2]): pair[2] for pair in steps[0]["link_angles_deg"]}, abs=1e-6
    )
    assert "--by-angles requires a FILE" in run("cone", "map", "--angles", "60,70,80", "--by-angles", code=2).stderr
