"""Ctrl-C at some moment of a command in a process of its own: signals to the whole group, as terminals send them."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from runs import SYNTH, complaints

ENUMERATIONS = {
    "chains": "enumerate chains --links 16 --dof 1 -o OUT.g6 --workers W",
    "chains counted": "enumerate chains --links 18 --dof 1 --count --workers W",
    "sc": "enumerate sc --links 14 --dof 1 -o OUT.jsonl --workers W",
    "scd": "enumerate scd --links 8 --dof 1 --max-degree 6 -o OUT.jsonl --workers W",
    "conical": "enumerate conical --chain stephenson --ground all --slots 18 -o OUT.sqlite --workers W",
    "strings": "enumerate strings --dof 30 --max-panels none --modes -o OUT.jsonl",
    "addenda": "enumerate addenda --of SHEET -o OUT.jsonl --workers W",
    "atlas": "atlas build --max-links 8 -o OUT.sqlite --workers W",
}
"""Commands that run for longer than a test waits; OUT is written, SHEET is a file of 100 panels, W the number of processes."""

STARTED = 0.2
"""Seconds after which the interpreter has come to the command, where that cannot be asked: before, Python hears the signal."""


@dataclass(frozen=True)
class Stopped:
    """How a command ended that was pressed: exit status, lines of standard error, seconds, files it left."""

    status: int
    lines: list[str]
    seconds: float
    left: list[str]


def wait_until_it_listens(process: subprocess.Popen[str]) -> None:
    """Wait until a process has set its own handler of SIGTERM; Python sets one of SIGINT alone."""
    status = Path(f"/proc/{process.pid}/status")
    if not status.exists():
        time.sleep(STARTED)
        return
    while process.poll() is None:
        caught = re.search(r"^SigCgt:\s*([0-9a-f]+)", status.read_text(), re.MULTILINE)
        if caught is None or int(caught[1], 16) >> (signal.SIGTERM - 1) & 1:
            return
        time.sleep(0.005)


def pressed(name: str, workers: int, moment: float, sheet: object = "", number: int = signal.SIGINT) -> Stopped:
    """Return how an enumeration ends that gets a signal some seconds after it listens to signals."""
    with tempfile.TemporaryDirectory() as folder:
        named = {"OUT": f"{folder}/out", "SHEET": str(sheet), "W": str(workers)}
        line = re.sub(r"\b(OUT|SHEET|W)\b", lambda word: named[word[0]], ENUMERATIONS[name])
        process = subprocess.Popen(
            [*SYNTH, *line.split()],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        wait_until_it_listens(process)
        time.sleep(moment)
        begin = time.monotonic()
        os.killpg(process.pid, number)
        _, errors = process.communicate(timeout=60)
        left = sorted(path.name for path in Path(folder).iterdir())
        return Stopped(process.returncode, complaints(errors), time.monotonic() - begin, left)
