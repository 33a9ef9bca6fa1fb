"""What commands print as JSON is told on a page: each command, and each key."""

import json
import re
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from synth.cli.main import main

ROOT = Path(__file__).resolve().parent.parent
PAGE = (ROOT / "docs" / "command-json.md").read_text(encoding="utf-8")
NAMED = set(re.findall(r"`\"?([A-Za-z]\w*)\"?`", PAGE))
BY_NAME = {"parameters", "equations", "counts", "driven", "driven_deg", "angles_deg", "joint_angles_deg", "azimuths_deg",
           "turns", "by_size", "sensitivity", "configurations",
           "left_out", "placements_left_out"}  # fmt: skip
"""Keys of objects whose own keys are names: of parameters, equations, joints."""

MOTIONS = "atlas motions small.sqlite --members 10"
COMMANDS = [
    "mobility data/patterns/bird-base.fold",
    "mobility data/wampler/fig7.json --exact",
    "reduce data/wiener/fortune-teller.json",
    "edit data/wiener/watt.json --add-ride-along 0,1",
    "enumerate chains --links 6 --dof 1",
    "enumerate chains --links 8 --dof 1 --count",
    "enumerate sc --links 4 --dof 1",
    "enumerate scd --links 4 --dof 1 --max-degree 3",
    "enumerate strings --dof 2",
    "enumerate conical --chain four-bar --ground 0",
    "enumerate conical --chain four-bar --slots 6 --ground 0",
    "enumerate addenda --of data/wiener/watt.json",
    "cone map --angles 120,95,45,85",
    "cone behaviour data/surfaces/fig11-stephenson.json",
    "cylinder map --lengths 4,3,5,1",
    "reconstruct data/wiener/three-link-chain.json",
    "look k1:Cr",
    "id data/wiener/watt.json",
    "generate miura -o made.fold",
    "generate",
    "realise k1:Cr -o made-too.fold",
    "realise data/linkages/sarrus.json --freedoms 1 --geometry triples",
    "template data/patterns/four-bar-vertex.fold --size 150 -o template.dxf",
    "fold data/patterns/four-bar-vertex.fold --frames 3 -o folded.fold",
    "fold data/linkages/bennett.json --frames 3",
    "positions data/surfaces/fig11-stephenson.json --drive O=30",
    "explain data/linkages/bennett.json",
    "advise data/patterns/four-bar-vertex.fold --freedoms 0",
    "layers data/patterns/bird-base.fold --order 1",
    "thicken data/realised/chain-RR.fold --thickness 0.01 --no-collisions",
    "dyads --orientations data/orientations/tipparthi.json",
    "fourbar --orientations data/orientations/crank-rocker.json --best 1",
    "sixbar --orientations data/orientations/tipparthi.json",
    "cone move data/surfaces/fig11-stephenson.json",
    "order --orientations data/orientations/tipparthi.json --axis 1,2,3",
    "convert data/wiener/watt.json made.graphml --lossy",
    "convert data/linkages/stewart.json stewart.xml --as mjcf",
    "convert data/linkages/bennett.json bennett.csv --as table --drive 0=60",
    "design four-bar data/wishes/crank-and-follower.json --starts 1",
    "task data/tasks/lid.json --structure-only",
    "task data/tasks/lid.json --starts 2 --rounds 1 --workers 1",
    MOTIONS,
    "atlas like data/orientations/tipparthi.json small.sqlite",
]


def with_json(command, words=()):
    """Names of the commands below one that print JSON."""
    if isinstance(command, click.Group):
        context = click.Context(command)
        for name in command.list_commands(context):
            yield from with_json(command.get_command(context, name), (*words, name))
    elif any("--json" in option.opts for option in command.params):
        yield " ".join(words[:1] if words[0] in ("generate", "atlas", "enumerate") else words)


def keys_of(value):
    """The keys of a document that are words of the format, not names of what it tells of."""
    if isinstance(value, list):
        for item in value:
            yield from keys_of(item)
    elif isinstance(value, dict):
        for key, below in value.items():
            yield key
            by_name = key in BY_NAME and isinstance(below, dict)
            yield from keys_of(list(below.values()) if by_name else below)


def test_every_command_that_prints_json_is_told():
    for name in set(with_json(main)):
        assert f"`synth {name}" in PAGE, name


ATLAS = "atlas build --max-links 4 --creases 0 --no-realise -o small.sqlite"
"""What lines of an atlas begin with, and motions those that look for some."""


@pytest.mark.parametrize("line", COMMANDS)
def test_every_key_is_told(line, tmp_path, monkeypatch):
    (tmp_path / "data").symlink_to(ROOT / "data")
    monkeypatch.chdir(tmp_path)
    before = [ATLAS] * line.startswith("atlas") + [MOTIONS] * line.startswith("atlas like")
    for each in before:
        assert CliRunner().invoke(main, each.split()).exit_code == 0
    result = CliRunner().invoke(main, [*line.split(), "--json"])
    assert result.exit_code in (0, 1), result.output
    told = {key for key in keys_of(json.loads(result.stdout)) if re.fullmatch(r"[a-zA-Z]\w*", key)}
    assert not told - NAMED
