"""``synth positions``: what is printed, as JSON, and refused in one line."""

import json

from commands import run


def test_positions_of_a_vertex(data):
    vertex = data / "patterns" / "four-bar-vertex.fold"
    printed = run("positions", vertex, "--drive", "2=90", "--no-circuits").stdout
    assert printed.startswith("2 assembly modes with joint 2 at 90°")
    assert "all assembly modes, proved: a generic realisation has 2" in printed
    told = json.loads(run("positions", vertex, "--drive", "2=90", "--no-circuits", "--json").stdout)
    assert [one["circuit"] for one in told["positions"]] == [None, None]
    assert sorted(round(one["angles_deg"]["0"], 4) for one in told["positions"]) == [-137.7883, -16.0831]


def test_out_of_reach_and_bad_words(data, tmp_path):
    ring = tmp_path / "ring.json"
    run("generate", "four-bar", "--arc1", 100, "--arc2", 40, "--arc3", 40, "--arc4", 40, "-o", ring)
    assert run("positions", ring, "--drive", "0=150", code=1).stdout.startswith("0 assembly modes")
    assert "'3' is not JOINT=DEGREES" in run("positions", ring, "--drive", "3", code=2).stderr
    lines = run("positions", data / "linkages" / "bennett.json", "--drive", "0=3", code=2).stderr.splitlines()
    assert len(lines) == 1
    assert "neither meet in a point nor are parallel" in lines[0]
