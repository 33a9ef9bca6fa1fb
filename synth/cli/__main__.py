"""``python -m synth.cli``: the ``synth`` command, as a process of its own.

Slow imports happen inside the function that handles signals.
"""

from __future__ import annotations

import os
import sys
from threading import Lock, Thread
from time import monotonic, sleep
from typing import TYPE_CHECKING

from enumerate.runner.stopping import interruptible

if TYPE_CHECKING:
    from pathlib import Path


def run() -> None:
    """Run the command; print one line if code has to be compiled, or cannot be: both take longer than most answers.

    Matrices are small, and many: threads of BLAS wait for each other longer than they work. Who sets their number
    keeps it.
    """
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    try:
        with interruptible(ending=True):
            _run_command()
    except KeyboardInterrupt as stop:  # before the command begins, or after its end
        sys.stderr.write("stopped\n")
        sys.exit(getattr(stop, "status", 130))


def _run_command() -> None:
    from enumerate.machine_code.folders import on_compiling
    from synth.cli.main import main
    from synth.cli.output import guard_output

    guard_output()
    on_compiling(_say_compiling, _show_compiling)
    main(prog_name="synth")


def _say_compiling(folder: Path | None, possible: bool) -> None:
    import click

    from enumerate.machine_code.folders import INTERPRETED
    from synth.cli.output import plain

    storage = f"kept in {plain(folder, 200)}" if folder else "not kept; try a folder of yours in SYNTHEDRA_CACHE"
    over = "\r" if sys.stderr.isatty() else ""  # the line of progress is overwritten: it is shorter
    compiling = f"compiling code for the first use, up to a minute ({storage})"
    click.echo(f"{over}synth: {compiling if possible else INTERPRETED}", err=True)


_EVERY = 0.5
"""Seconds between two lines."""
_CLEARED = "\r\x1b[K"
"""What takes a line off a terminal."""


class CompilingLine:
    """A line on a terminal while functions are compiled: how many are done, and for how long; then it is gone.

    A thread writes it, since the compiler calls nobody on the way.
    """

    def __init__(self) -> None:
        self._begin = monotonic()
        self._counts = (0, 0)
        self._shown = False
        self._lock = Lock()
        self._runs = False

    def __call__(self, begun: int, done: int) -> None:
        """Take how many functions are begun, and how many of these are done."""
        with self._lock:
            self._counts = begun, done
            if begun == done and self._shown:
                sys.stderr.write(_CLEARED)
                sys.stderr.flush()
                self._shown = False
            if begun > done and not self._runs:
                self._runs = True
                Thread(target=self._write, daemon=True).start()

    def _write(self) -> None:
        """Write the line again and again while something is compiled."""
        while True:
            sleep(_EVERY)
            with self._lock:
                begun, done = self._counts
                if begun == done:
                    self._runs = False
                    return
                seconds = monotonic() - self._begin
                functions = f"{done} function{'' if done == 1 else 's'}"
                sys.stderr.write(f"{_CLEARED}compiling: {functions} done, {seconds:.0f} s")
                sys.stderr.flush()
                self._shown = True


_line: list[CompilingLine] = []
"""That of this process, once it compiles."""


def _show_compiling(begun: int, done: int) -> None:
    if not sys.stderr.isatty():
        return
    if not _line:
        _line.append(CompilingLine())
    _line[0](begun, done)


if __name__ == "__main__":
    run()
