"""``synth generate`` and ``synth convert`` of linkages with joints of all kinds."""

import json

from commands import run


def test_a_platform_becomes_creases_and_is_seen_in_them(tmp_path):
    legs, creases, back = tmp_path / "legs.json", tmp_path / "creases.json", tmp_path / "back.graphml"
    assert "12 degrees of freedom of finite motion" in run("generate", "6-sps", "-o", legs).stdout
    run("convert", legs, creases, "--to", "solids")
    assert len(json.loads(creases.read_text())["axes"]) == 42
    run("convert", creases, back, "--to", "joints")
    printed = run("mobility", back).stdout
    assert "mobility M = 12" in printed
    assert "joints: 6 prismatic, 12 spherical" in printed
    assert "equivalent revolute joints 42" in " ".join(printed.split())
    assert "6 passive degrees of freedom: legs that spin" in printed
    assert "Mobile from this configuration: 12 degrees of freedom." in run("mobility", legs).stdout
    assert "from this configuration" not in printed


def test_a_platform_is_moved_and_drawn(tmp_path):
    legs = tmp_path / "legs.json"
    run("generate", "3-rps", "-o", legs)
    assert "3 degrees of freedom" in run("fold", legs, "--drive", "P0-1=3", "--frames", 1).stdout
    run("draw", legs, "-o", tmp_path / "a.svg")
    assert "hinges orange" in (tmp_path / "a.svg").read_text()
