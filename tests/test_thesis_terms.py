"""docs/thesis-terms.md: every command in it runs, every function is found, and no command lacks one."""

import math
import re
import shlex
import subprocess
import sys
from pathlib import Path

import click
import pytest
from commands import run

from synth.cli.main import main

ROOT = Path(__file__).resolve().parents[1]
PAGE = (ROOT / "docs" / "thesis-terms.md").read_text(encoding="utf-8")
TERMS, COMMANDS = PAGE.split("## Every command and its function")


def commands_of(group, before=()):
    """Yield the names of all commands; generators are parameters of one."""
    context = click.Context(group)
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        if isinstance(command, click.Group) and name != "generate":
            yield from commands_of(command, (*before, name))
        else:
            yield " ".join((*before, name))


def test_every_command_has_its_function():
    listed = re.findall(r"^\| `synth ([a-z ]+)` \| `synth\.", COMMANDS, re.MULTILINE)
    assert listed == list(commands_of(main))


def test_every_function_is_found():
    """After ``import synth`` alone, in a Python of its own."""
    names = sorted(set(re.findall(r"`((?:synth|graphs)\.[A-Za-z_.]+)`", PAGE)))
    assert len(names) > 50
    program = "import graphs, synth\nfor name in input().split(): assert callable(eval(name)), name"
    words = [sys.executable, "-c", program]
    assert subprocess.run(words, input=" ".join(names), capture_output=True, text=True, check=False).stderr == ""


@pytest.mark.parametrize("command", re.findall(r"\| `synth ([^`]*)` \|", TERMS))
def test_a_command_of_the_page_runs(command, tmp_path, monkeypatch):
    """Each in a folder with the project's data; the last takes what the one before it writes."""
    (tmp_path / "data").symlink_to(ROOT / "data")
    monkeypatch.chdir(tmp_path)
    if "conical.jsonl --row" in command:
        run(*shlex.split(next(re.finditer(r"`synth (.*-o conical.jsonl)`", TERMS))[1]))
    run(*shlex.split(command))


def test_calls_of_the_page_connect(monkeypatch):
    """In order, in one Python, with numbers that their commands agree with."""
    import synth

    monkeypatch.chdir(ROOT)
    calls = re.findall(r"\| `((?:row = )?(?:next\()?synth\.[^`]*\))` \|", TERMS)
    assert len(calls) == 5
    space = {"synth": synth, "math": math}
    results = [exec(call, space) if "row =" in call else eval(call, space) for call in calls]
    counted = run("enumerate", "scd", "--of", "data/wiener/watt.json", "--count").stdout
    assert len(list(results[0])) == int(counted)
    kinds = [type(result).__name__ for result in results[1:]]
    assert kinds == ["ConeRealisation", "NoneType", "SurfaceMotion", "SurfaceMotion"]


def lines_of(text):
    return [line.rstrip() for line in text.splitlines() if line.strip()]


def test_functions_of_surfaces_answer_as_their_commands(monkeypatch):
    import numpy as np

    import synth

    monkeypatch.chdir(ROOT)
    linkage = synth.SurfaceLinkage.loop(np.radians([120, 95, 45, 85]))
    printed = run("cone", "behaviour", "--angles", "120,95,45,85").stdout
    assert lines_of("\n".join(map(str, synth.surface_behaviours(linkage)))) == lines_of(printed)
    file = "data/patterns/bird-base.fold"
    assert lines_of(run("limits", file).stdout) == lines_of(str(synth.limits(file)))
