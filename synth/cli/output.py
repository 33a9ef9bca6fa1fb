"""What the subcommands share: printing tables, JSON and safe text."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from time import monotonic
from typing import TYPE_CHECKING, Any, Literal

import click

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from graphs.files.formats import Entry

__all__ = ["about", "console", "entries", "plain", "print_json", "table"]

_WIDEST = 60
_UNWRAPPED = 10_000
_PATIENCE = 2.0
"""Seconds before progress is shown."""


def plain(value: object, widest: int = _WIDEST) -> str:
    r"""Return text that is safe to print: one line, no control characters, not too long.

    Examples
    --------
    >>> plain("\x1b[31mred")
    '\\x1b[31mred'
    >>> plain(None)
    '-'
    """
    text = "-" if value is None else str(value)
    text = "".join(c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in text)
    return text if len(text) <= widest else text[: widest - 3] + "..."


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


def print_json(value: Any) -> None:
    """Print one JSON document on standard output."""
    click.echo(json.dumps(value, indent=2, allow_nan=False))


def console() -> Console:
    """Return the console of standard output, without markup: names of links may hold brackets.

    Lines are wrapped on a terminal only; in a file or a pipe a row stays a line.
    """
    from rich.console import Console

    width = None if sys.stdout.isatty() else _UNWRAPPED
    return Console(markup=False, highlight=False, emoji=False, soft_wrap=False, width=width)


def table(*columns: str, numbers: Iterable[str] = (), title: str | None = None) -> Table:
    """Return an empty table; columns named in ``numbers`` are set flush right."""
    from rich.box import SIMPLE_HEAD
    from rich.table import Table
    from rich.text import Text

    made = Table(
        box=SIMPLE_HEAD, title=None if title is None else Text(title), title_justify="left", pad_edge=False
    )
    flush = set(numbers)
    for column in columns:
        justify: Literal["left", "right"] = "right" if column in flush else "left"
        made.add_column(Text(column), justify=justify, overflow="fold")
    return made


def entries(files: Sequence[str], failures: list[str], patience: float = _PATIENCE) -> Iterator[Entry]:
    """Yield the mechanisms of files; what is wrong with a file that cannot be read is added to the failures.

    Where it takes longer than some seconds, the patience, a terminal shows how far it has come.
    """
    from graphs.errors import FileError
    from graphs.files.formats import read_all

    start, shown = monotonic(), False
    for number, file in enumerate(files, start=1):
        try:
            yield from read_all(file)
        except FileError as error:
            failures.append(str(error))
        if sys.stderr.isatty() and monotonic() - start > patience:
            click.echo(f"\r{number} of {len(files)} files", nl=False, err=True)
            shown = True
    if shown:
        click.echo("\r" + " " * 40 + "\r", nl=False, err=True)
