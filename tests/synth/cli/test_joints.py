"""``synth generate`` and ``synth convert`` of linkages with joints of all kinds."""

import json

from commands import run


def test_a_platform_becomes_creases_and_is_seen_in_them(tmp_path):
    legs, creases, back = tmp_path / "legs.json", tmp_path / "creases.json", tmp_path / "back.graphml"
    assert "freedoms of finite motion 12" in run("generate", "6-sps", "-o", legs).stdout
    run("convert", legs, creases, "--to", "solids")
    assert len(json.loads(creases.read_text())["axes"]) == 42
    run("convert", creases, back, "--to", "joints")
    printed = run("mobility", back).stdout
    assert "mobility M = 12" in printed
    assert "joints: 6 prismatic, 12 spherical; as 42 revolutes" in printed
    assert "6 of the freedoms passive: legs that spin" in printed
    assert "Moves with 12 freedoms from its pose." in run("mobility", legs).stdout
    assert "from its pose" not in printed


def test_a_platform_is_moved_and_drawn(tmp_path):
    legs = tmp_path / "legs.json"
    run("generate", "3-rps", "-o", legs)
    assert "3 freedoms" in run("fold", legs, "--drive", "P0-1=3", "--frames", 1).stdout
    run("draw", legs, "-o", tmp_path / "a.svg")
    assert "hinges orange" in (tmp_path / "a.svg").read_text()
