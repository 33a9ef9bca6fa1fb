"""The last line of defence: an exception that nobody foresaw is one line, and an exit status of its own."""

from __future__ import annotations

import os
import sys
import traceback
from contextlib import suppress
from typing import NoReturn

import click

from graphs.printing import plain

__all__ = ["FAULT", "VARIABLE", "end_with_fault"]

FAULT = 70
"""Exit status of a fault of the program (EX_SOFTWARE of sysexits.h): 1 is an answer, 2 a fault of the input."""
VARIABLE = "SYNTHEDRA_DEBUG"
"""Set to 1, it has the same effect as --debug."""
_LONGEST = 300
"""Letters of the exception that are printed."""


def end_with_fault(error: Exception, *, debug: bool) -> NoReturn:
    """Print an exception that is a fault of the program on one line, and end.

    With `debug`, or if `VARIABLE` is 1, the traceback is printed before it.
    """
    with suppress(OSError):  # standard error may be what failed
        if debug or os.environ.get(VARIABLE) == "1":
            traceback.print_exception(error)
        told = plain(f"{type(error).__name__}: {error}", _LONGEST)
        how = "" if debug else "; `synth --debug COMMAND ...` prints where"
        click.echo(
            f"synth: fault of the program, not of the input: {told}; please report it with the command and its "
            f"files to the developers of synthedra (CONTRIBUTING.md, Reporting a fault){how}",
            err=True,
        )
    sys.exit(FAULT)
