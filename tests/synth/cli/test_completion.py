"""Completion by the shell, which click offers: commands, options, and the names of files."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import click
import pytest

from synth.cli.main import main

SYNTH = Path(sys.executable).parent / "synth"
FILES = {"FILE", "FILE...", "[FILE]", "FILE.jsonl", "FILE.fold", "IN", "OUT", "OUT.json", "PICTURE", "ATLAS.sqlite"}


def parameters(command, context):
    yield from command.params
    if isinstance(command, click.Group):
        for name in command.list_commands(context):
            yield from parameters(command.get_command(context, name), context)


def test_arguments_and_options_that_name_files_are_completed_as_files():
    context = click.Context(main)
    named = [parameter for parameter in parameters(main, context) if parameter.metavar in FILES]
    assert len(named) > 60
    for parameter in named:
        assert [item.type for item in parameter.shell_complete(context, "da")] == ["file"], parameter


@pytest.mark.skipif(not shutil.which("bash") or not SYNTH.exists(), reason="bash, and synth as a program, are needed")
def test_bash_completes_options():
    lines = [
        'eval "$(_SYNTH_COMPLETE=bash_source synth)"',
        "COMP_WORDS=(synth enumerate chains --do) COMP_CWORD=3",
        "_synth_completion synth",
        'echo "${COMPREPLY[@]}"',
    ]
    path = f"{SYNTH.parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-c", "\n".join(lines)], capture_output=True, text=True, env={**os.environ, "PATH": path}, check=True
    )
    assert done.stdout.split() == ["--dof"]
