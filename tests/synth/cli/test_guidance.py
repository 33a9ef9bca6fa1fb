"""The command line of orientations: order, dyads, four-bars; keys, exit status, files, wrong words."""

from __future__ import annotations

import json
import re
import shlex
import sys

import numpy as np
import pytest
from commands import run
from cranks import random_orientations
from sizes import slow

from synth.linkages.guidance.orientations import read_orientations, write_orientations

AXIS_1, AXIS_2 = "0.054261,-0.996977,0.055603", "-0.349442,-0.144163,0.925801"


@pytest.fixture
def printed(data):
    return data / "orientations" / "tipparthi-as-printed.json"


@pytest.fixture
def corrected(data):
    return data / "orientations" / "tipparthi.json"


@pytest.fixture
def some(tmp_path):
    def make(n, seed=1):
        path = tmp_path / f"{n}-{seed}.json"
        write_orientations(random_orientations(n, np.random.default_rng(seed)).quaternions, path)
        return path

    return make


def test_order_tells_crossings_and_verdict(printed):
    told = json.loads(run("order", "--orientations", printed, "--axis", AXIS_1, "--json", code=1).stdout)
    assert [c.keys() for c in told["crossings"]] == [{"pair", "angle_deg"}] * 9
    assert told["crossings"][0] == {"pair": [2, 3], "angle_deg": pytest.approx(25.88, abs=0.001)}
    assert told["in_order"] is False
    assert told["breaks_at"] == {"due": [1, 3], "crossed": [2, 5]}
    assert told["checks"] == {"hoop": None, "inequalities": None, "crank_angles": None}
    assert told["dyad"]["misfit_deg"] > 0.1
    told = json.loads(run("order", "--orientations", printed, "--axis", AXIS_2, "--direction", "cw", "--json").stdout)
    assert told["in_order"] is True
    assert told["breaks_at"] is None
    assert set(told["checks"].values()) == {"cw"}


def test_order_in_words(printed, corrected):
    out = run("order", "--orientations", printed, "--axis", AXIS_1, code=1).stdout
    assert re.search(r"S25 +74\.1463 +yes", out)
    assert "needed: S13 => S14 => S15 => S25" in out
    assert "order defect: S25 is crossed where S13 is due" in out
    assert "no dyad about this axis takes all orientations; the best misses by 0.4091 degrees" in out
    out = run("order", "--orientations", corrected, "--axis", AXIS_2, "--direction", "cw").stdout
    assert "order kept, by a margin of 16.824 degrees of the hoop" in out
    assert "kept by: hoop clockwise, inequalities clockwise, crank clockwise" in out
    out = run("order", "--orientations", corrected, "--axis", AXIS_2, code=1).stdout
    assert "; it is kept clockwise" in out


def test_dyads_of_five(corrected, tmp_path):
    told = json.loads(run("dyads", "--orientations", corrected, "--json").stdout)
    assert [dyad.keys() >= {"G", "W", "residual", "in_order"} for dyad in told["dyads"]] == [True] * 6
    assert [dyad["in_order"] for dyad in told["dyads"]].count(True) == 1
    assert told["complex"] == 0
    assert max(dyad["residual"] for dyad in told["dyads"]) < 1e-14
    out = run("dyads", "--orientations", corrected, "-o", tmp_path / "map.svg").stdout
    assert "5 orientations: 6 dyads" in out
    assert "all six solutions found, 0 of them complex" in out
    assert (tmp_path / "map.svg").read_text().startswith("<svg")


def test_dyads_of_three_four_and_more(some, tmp_path):
    told = json.loads(run("dyads", "--orientations", some(3), "--axis", "0,0,1", "--axis", "-1,2,0", "--json").stdout)
    assert [np.round(np.abs(dyad["G"]), 3).tolist() for dyad in told["dyads"]] == [[0, 0, 1], [0.447, 0.894, 0]]
    told = json.loads(
        run("dyads", "--orientations", some(4), "--samples", 50, "--json", "-o", tmp_path / "four.png").stdout
    )
    assert len(told["dyads"]) >= 50
    assert max(dyad["residual"] for dyad in told["dyads"]) < 1e-12
    assert (tmp_path / "four.png").read_bytes().startswith(b"\x89PNG")
    told = json.loads(run("dyads", "--orientations", some(7), "--json").stdout)
    assert told["dyads"][0]["misfit_deg"] > 0.0
    assert "complex" not in told


def test_four_bars_and_their_motion(data, tmp_path):
    given = data / "orientations" / "crank-rocker.json"
    motion = tmp_path / "motion.json"
    told = json.loads(run("fourbar", "--orientations", given, "--motion", motion, "--steps", 7, "--json").stdout)
    best = told["fourbars"][0]
    assert best.keys() >= {"driver", "follower", "link_angles_deg", "grashof", "type", "circuits", "branches",
                           "direction", "defects", "transmission_deg"}  # fmt: skip
    assert best["defects"] == []
    assert told["usable"] >= 1
    assert told["motion"] == {"file": str(motion), "frames": 29}
    moved, asked = read_orientations(motion).quaternions[::7], read_orientations(given).quaternions
    assert np.allclose(np.abs((moved * asked).sum(axis=1)), 1.0)
    out = run("fourbar", "--orientations", given, "--usable", "--best", 3).stdout
    assert re.search(r"12 four-bars, \d without defects", out)
    assert "Grashof crank-rocker" in out
    assert "branch" not in out
    out = run("fourbar", "--orientations", given, "--motion", motion, "--force").stdout
    assert f"written: {motion} (81 orientations)" in out


def test_four_bars_of_three_and_four(some):
    told = json.loads(run("fourbar", "--orientations", some(3), "--axis", "0,0,1", "--axis", "1,0,0", "--json").stdout)
    assert told["found"] == 2
    told = json.loads(run("fourbar", "--orientations", some(4), "--samples", 8, "--best", 5, "--json").stdout)
    assert len(told["fourbars"]) == 5
    ranks = [(len(one["defects"]), -one["transmission_deg"]) for one in told["fourbars"]]
    assert ranks == sorted(ranks)


def test_four_bars_on_cones(data):
    given = data / "orientations" / "crank-rocker.json"
    told = json.loads(run("fourbar", "--orientations", given, "--usable", "--best", 2, "--cones", "--json").stdout)
    for one in told["fourbars"]:
        assert one["families"] == []
        assert one["cones"][0].keys() == {"link_angles_deg", "lambda_deg", "circuit", "signs", "k"}
        assert one["cones"][0]["link_angles_deg"] == pytest.approx(one["link_angles_deg"])
    out = run("fourbar", "--orientations", given, "--usable", "--best", 1, "--cones").stdout
    assert re.search(r"1 +60\.00 +20\.00 +55\.00 +50\.00 +55\.0986 \(34\.9014\) +open", out)


def test_without_a_usable_four_bar_there_is_no_motion(corrected, tmp_path):
    result = run("fourbar", "--orientations", corrected, "--motion", tmp_path / "m.json", code=2)
    assert result.stderr == f"{corrected}: --motion requires a four-bar without defects, and there is none\n"
    assert not (tmp_path / "m.json").exists()


def test_pictures_of_the_hoop(printed, tmp_path):
    for name in ("a.svg", "a.png"):
        out = run("order", "--orientations", printed, "--axis", AXIS_1, "-o", tmp_path / name, code=1).stdout
        assert f"written: {tmp_path / name}" in out
        assert (tmp_path / name).stat().st_size > 10_000
    result = run("order", "--orientations", printed, "--axis", AXIS_1, "-o", tmp_path / "a.gif", code=2)
    assert "a.gif: files ending in '.gif' are not known" in result.stderr


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--axis", "0,0,0"], "the fixed axis is zero; expected a direction"),
        (["--axis", "nan,0,0"], "the fixed axis has not three finite numbers"),
        (["--axis", "0,0"], "'0,0' is not three numbers such as 0,0,1"),
        (["--axis", "a,b,c"], "'a,b,c' is not three numbers"),
        (["--axis", "0,0,1", "--direction", "up"], "'up' is not one of 'ccw', 'cw'"),
        ([], "--orientations requires --axis"),
    ],
)
def test_axes_and_directions_that_are_none(words, message, printed):
    assert message in run("order", "--orientations", printed, *words, code=2).output


def test_an_axis_on_a_relative_axis_is_one_line(printed):
    axis = ",".join(map(str, read_orientations(printed).relative_axis(2, 4)))
    result = run("order", "--orientations", printed, "--axis", axis, code=2)
    assert result.stderr.count("\n") == 1
    assert result.stderr.startswith(f"{printed}: the fixed axis lies on the relative axis S24")


@pytest.mark.parametrize("command", ["order", "dyads", "fourbar"])
def test_bad_files_are_one_line(command, tmp_path, data):
    words = ["--axis", "0,0,1"] if command == "order" else []
    bad = tmp_path / "bad.json"
    bad.write_text('{"format": "synthedra/orientations", "version": 1, "quaternions": [[1,0,0,0],[0,0,0,0],[0,1,0,0]]}')
    for path, message in ((bad, "quaternions[1]: orientation 2 has a quaternion of norm 0"),
                          (tmp_path / "none.json", "no such file"),
                          (data / "wiener" / "watt.json", "unknown key")):  # fmt: skip
        result = run(command, "--orientations", path, *words, code=2)
        assert result.stdout == ""
        assert result.stderr.count("\n") == 1
        assert result.stderr.startswith(f"{path}: ")
        assert message in result.stderr


def test_turns_about_one_axis_are_a_plain_error(tmp_path):
    for n, message in ((4, "every axis is that of a dyad"), (5, "infinitely many dyads, complex ones counted")):
        half = np.linspace(0, 1, n)
        path = tmp_path / f"{n}.json"
        write_orientations(np.stack([np.cos(half), 0 * half, 0 * half, np.sin(half)], axis=1), path)
        for command in ("dyads", "fourbar"):
            assert message in run(command, "--orientations", path, code=2).stderr


def test_axes_are_for_three_orientations(some):
    assert "three orientations require --axis X,Y,Z" in run("dyads", "--orientations", some(3), code=2).output
    assert "--axis requires three orientations, got 5" in run(
        "dyads", "--orientations", some(5), "--axis", "0,0,1", code=2
    ).output  # fmt: skip


def test_without_matplotlib_a_picture_is_one_line(printed, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    result = run("order", "--orientations", printed, "--axis", AXIS_1, "-o", tmp_path / "a.png", code=2)
    assert result.stdout == ""
    assert result.stderr == "PNG requires matplotlib; try pip install 'synthedra[draw]'\n"


@pytest.mark.parametrize("command", ["order", "dyads", slow("fourbar")])
def test_the_examples_of_the_help_texts_run(command, data, monkeypatch, tmp_path):
    (tmp_path / "data").symlink_to(data)
    monkeypatch.chdir(tmp_path)
    text = run(command, "--help").stdout
    examples = re.findall(r"^ +synth (.*)$", text, re.MULTILINE)
    assert examples
    for example in examples:
        run(*shlex.split(example))
