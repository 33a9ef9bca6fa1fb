"""``python -m synth.cli``: the ``synth`` command, as a process of its own.

Slow imports happen inside the function that handles signals.
"""

from __future__ import annotations

import os
import sys
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
    on_compiling(_say_compiling)
    main(prog_name="synth")


def _say_compiling(folder: Path | None, possible: bool) -> None:
    import click

    from enumerate.machine_code.folders import INTERPRETED
    from synth.cli.output import plain

    storage = f"kept in {plain(folder, 200)}" if folder else "not kept; try a folder of yours in SYNTHEDRA_CACHE"
    over = "\r" if sys.stderr.isatty() else ""  # the line of progress is overwritten: it is shorter
    compiling = f"compiling code for the first use, up to a minute ({storage})"
    click.echo(f"{over}synth: {compiling if possible else INTERPRETED}", err=True)


if __name__ == "__main__":
    run()
