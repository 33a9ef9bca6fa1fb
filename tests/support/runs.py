"""Runs of the command line in processes of their own: started, watched, killed; and what they stored."""

from __future__ import annotations

import os
import random
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

SYNTH = [sys.executable, "-m", "synth.cli"]


def enumerating(*words: object) -> list[str]:
    """Return the command line of an enumeration."""
    return [*SYNTH, "enumerate", *map(str, words)]


def complaints(errors: str) -> list[str]:
    """Return lines of standard error, but for the one that says that code is compiled."""
    return [line for line in errors.splitlines() if not line.startswith("synth: compiling")]


def wait_for(true: Callable[[], object], seconds: float = 600) -> None:
    """Wait until something is so; a store of millions of rows is looked through for minutes before it grows."""
    deadline = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def children(pid: int) -> list[int]:
    """Return process ids of the worker processes of a run."""
    found = []
    for status in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = status.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[1]) == pid:
            found.append(int(status.parent.name))
    return found


def is_gone(pid: int) -> bool:
    """Return whether a process has ended; init may not have taken notice yet."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


def kill(run: subprocess.Popen[Any], dice: random.Random, longest: float) -> None:
    """Kill a run after a random time; every other time one of its workers before. None of its processes is left."""
    time.sleep(dice.uniform(0, longest))
    workers = children(run.pid)
    if workers and dice.random() < 0.5:
        worker = dice.choice(workers)
        if not is_gone(worker):
            os.kill(worker, signal.SIGKILL)
        time.sleep(dice.uniform(0, longest))
        workers += children(run.pid)
    run.kill()
    run.wait()
    wait_for(lambda: all(map(is_gone, workers)))


def units_in(store: Path) -> int:
    """Return how many units a store holds at this moment."""
    if not store.exists():
        return 0
    with closing(sqlite3.connect(f"{store.resolve().as_uri()}?mode=ro", uri=True)) as connection:
        try:
            return int(connection.execute("SELECT count(*) FROM unit").fetchone()[0])
        except sqlite3.OperationalError:  # it has no tables yet
            return 0


def contents(store: Path) -> tuple[list[tuple[Any, ...]], list[tuple[Any, ...]]]:
    """Return all units of a store, without the seconds they took, and all rows with their numbers."""
    with closing(sqlite3.connect(store)) as connection:
        units = connection.execute("SELECT id, state, first, rows FROM unit ORDER BY id").fetchall()
        return units, connection.execute("SELECT rowid, * FROM type ORDER BY rowid").fetchall()
