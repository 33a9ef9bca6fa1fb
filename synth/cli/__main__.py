"""``python -m synth.cli``: the ``synth`` command, as a process of its own.

What takes time to import is imported where signals that stop are heard.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from enumerate.runner.stopping import interruptible

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["run"]


def run() -> None:
    """Run the command; say so once if code has to be compiled, which takes longer than most answers."""
    try:
        with interruptible(ending=True):
            _run_command()
    except KeyboardInterrupt as stop:  # where there is no command yet, or none any more
        sys.stderr.write("stopped\n")
        sys.exit(getattr(stop, "status", 130))


def _run_command() -> None:
    from enumerate.machine_code.folders import on_compiling
    from synth.cli.main import main
    from synth.cli.streams import guard_output

    guard_output()
    on_compiling(_say_compiling)
    main(prog_name="synth")


def _say_compiling(folder: Path | None) -> None:
    import click

    from synth.cli.output import plain

    kept = f"kept in {plain(folder, 200)}" if folder else "kept nowhere: name a folder of yours in SYNTHEDRA_CACHE"
    over = "\r" if sys.stderr.isatty() else ""  # what is shown of progress is on the same line, and shorter
    click.echo(f"{over}synth: compiling code for the first use, up to a minute ({kept})", err=True)


if __name__ == "__main__":
    run()
