"""What the subcommands share: printing tables, JSON and safe text."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any

import click

from graphs.printing import UNWRAPPED, console_for, plain, rich_table as table

if TYPE_CHECKING:
    from rich.console import Console

    from graphs.files.formats import Entry
    from graphs.printing import Printed

__all__ = [
    "FORCE",
    "LOSSY",
    "PATIENCE",
    "about",
    "check_output",
    "check_picture",
    "console",
    "entries",
    "plain",
    "print_answer",
    "print_json",
    "shortened",
    "table",
    "tell_lost",
    "tell_written",
]

_FIGURES = 12
"""Of numbers in JSON; rows of enumerations have no more."""

FORCE = click.option(
    "--force", is_flag=True, help="Overwrite an existing file, but never a folder, symbolic link or device."
)
"""The option of every command that writes a file."""

LOSSY = click.option("--lossy", is_flag=True, help="Write even if the output reads back as another type.")
"""The option of every command that writes a mechanism."""

PATIENCE = 2.0
"""Seconds before progress is shown."""


@contextmanager
def about(label: str) -> Iterator[None]:
    """Put the file's name before what is wrong with its mechanism."""
    from graphs.errors import FileError, InvariantError, SynthedraError

    try:
        yield
    except FileError:
        raise
    except InvariantError as error:
        raise FileError(label, "", error.offender, error.expected) from None
    except SynthedraError as error:
        raise FileError(label, "", str(error)) from None


def check_output(path: str | None, *, force: bool) -> None:
    """Refuse an output that is not to be replaced before anything is computed for it; None is no output."""
    from graphs.files.atomic import check_place

    if path is not None:
        check_place(Path(path), force=force)


def check_picture(path: str | None, *, force: bool) -> None:
    """Refuse a picture that cannot be written before anything is computed for it; None is no picture."""
    if path is not None:
        from synth.drawing.scene import writing

        writing.check_picture(path, force=force)


def tell_lost(lost: Sequence[str]) -> None:
    """Print what a format could not hold, if there is anything."""
    if lost:
        click.echo("not stored: " + plain(", ".join(lost), 1000))


def tell_written(*places: str | Path | None) -> None:
    """Print the name of each file that was written; None is no file."""
    for place in places:
        if place is not None:
            click.echo(f"written: {plain(str(place), 4096)}")


def print_answer(answer: Printed) -> None:
    """Print the lines and tables of an answer."""
    out = console()
    for block in answer.blocks():
        out.print(block)


def print_json(value: Any) -> None:
    """Print one JSON document on standard output, numbers with the digits that they are good for."""
    click.echo(json.dumps(shortened(value), indent=2, allow_nan=False))


def shortened(value: Any) -> Any:
    """Return a value of JSON with twelve figures of each number: later ones differ among processors."""
    if isinstance(value, float):
        return float(f"{value:.{_FIGURES}g}")
    if isinstance(value, dict):
        return {key: shortened(one) for key, one in value.items()}
    return [shortened(one) for one in value] if isinstance(value, list | tuple) else value


def console() -> Console:
    """Return the console of standard output, without markup: names of links may hold brackets.

    Lines are wrapped on a terminal only; in a file or a pipe a row stays a line.
    """
    return console_for(None, None if sys.stdout.isatty() else UNWRAPPED)


def entries(files: Sequence[str], failures: list[str], patience: float = PATIENCE) -> Iterator[Entry]:
    """Yield the mechanisms of files; what is wrong with a file that cannot be read is added to the failures.

    Where it takes longer than some seconds, the patience, a terminal shows how far it has come.
    """
    from graphs.errors import FileError
    from graphs.files.formats import read_all
    from synth.cli.reading import stated

    start, shown = monotonic(), False
    for number, file in enumerate(files, start=1):
        try:
            yield from read_all(file, **stated())
        except FileError as error:
            failures.append(str(error))
        if sys.stderr.isatty() and monotonic() - start > patience:
            click.echo(f"\r{number} of {len(files)} files", nl=False, err=True)
            shown = True
    if shown:
        click.echo("\r" + " " * 40 + "\r", nl=False, err=True)
