"""The commands run one after the other in one process, in an empty folder beside the data; what they answer."""

from __future__ import annotations

import json
import os
import shlex
import subprocess
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from click.testing import CliRunner

from synth.cli.main import main as synth
from tests.machines.commands import COMMANDS, QUICK
from tests.machines.comparison import Answer
from tests.machines.factors import ROOT, Factor, environment_for

__all__ = ["read_transcript", "transcript_under"]

_SETS = {"quick": QUICK, "all": COMMANDS}


def transcript_under(factor: Factor | None, which: str, place: Path) -> subprocess.Popen[bytes]:
    """Start a child process that writes a transcript under a factor to a file."""
    words = [sys.executable, "-m", "tests.machines.transcript", which, str(place)]
    return subprocess.Popen(words, env=environment_for(factor), cwd=ROOT)


def read_transcript(place: Path) -> list[Answer]:
    """Return what a child process has written."""
    rows = map(json.loads, place.read_text(encoding="utf-8").splitlines())
    return [Answer(command, status, tuple(lines)) for command, status, lines in rows]


def answers(commands: Iterable[str]) -> Iterator[Answer]:
    """Run commands in the current folder, one after the other; later ones read what earlier ones wrote."""
    ages: dict[Path, int] = {}
    for command in commands:
        result = CliRunner().invoke(synth, shlex.split(command))
        unforeseen = result.exception is not None and not isinstance(result.exception, SystemExit)
        lines = [repr(result.exception)] if unforeseen else []
        lines += [line.rstrip() for line in result.output.splitlines() if line.strip()]
        yield Answer(command, result.exit_code, (*lines, *_new_files(ages)))


def _new_files(ages: dict[Path, int]) -> Iterator[str]:
    """Yield the lines of files written since the last call."""
    for place in sorted(Path().glob("*.*")):
        age = place.stat().st_mtime_ns
        if ages.get(place) != age:
            ages[place] = age
            yield f"-> {place}"
            yield from place.read_text(encoding="utf-8").splitlines()


def main(which: str, place: str) -> None:
    """Write the transcript of a set of commands to a file."""
    out = Path(place).resolve()
    with TemporaryDirectory() as folder, out.open("w", encoding="utf-8") as stream:
        os.chdir(folder)
        Path("data").symlink_to(ROOT / "data")
        for answer in answers(_SETS[which]):
            print(json.dumps([answer.command, answer.status, answer.lines]), file=stream)
        os.chdir(ROOT)


if __name__ == "__main__":
    main(*sys.argv[1:])
