"""Completion by the shell: the script is printed, or written where the shell looks; bash completes with it."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.commands import run

SYNTH = Path(sys.executable).parent / "synth"


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_the_script_is_printed_and_installed(shell, tmp_path, monkeypatch):
    for name in ("XDG_DATA_HOME", "XDG_CONFIG_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("HOME", str(tmp_path))
    script = run("completion", shell).stdout
    assert "_SYNTH_COMPLETE" in script
    told = run("completion", shell, "--install").stdout.splitlines()[0]
    place = Path(told.removeprefix("written: "))
    assert place.is_relative_to(tmp_path)
    assert place.read_text(encoding="utf-8").strip() == script.strip()
    assert "exists already" in run("completion", shell, "--install", code=2).output
    run("completion", shell, "--install", "--force")


@pytest.mark.skipif(
    not shutil.which("bash") or not SYNTH.exists(), reason="bash, and synth as a program, are needed"
)
def test_bash_completes_options(tmp_path):
    (tmp_path / "synth.bash").write_text(run("completion", "bash").stdout, encoding="utf-8")
    lines = [
        f"source {tmp_path / 'synth.bash'}",
        "COMP_WORDS=(synth enumerate chains --do) COMP_CWORD=3",
        "_synth_completion synth",
        'echo "${COMPREPLY[@]}"',
    ]
    path = f"{SYNTH.parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-c", "\n".join(lines)],
        capture_output=True,
        text=True,
        env={**os.environ, "PATH": path},
        check=True,
    )
    assert done.stdout.split() == ["--dof"]
