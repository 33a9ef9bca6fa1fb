"""What the subcommands share: printing tables, JSON and safe text."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from graphs.files.formats import Entry

__all__ = ["console", "entries", "plain", "print_json", "table"]

_WIDEST = 60


def plain(value: object) -> str:
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
    return text if len(text) <= _WIDEST else text[: _WIDEST - 3] + "..."


def print_json(value: Any) -> None:
    """Print one JSON document on standard output."""
    click.echo(json.dumps(value, indent=2, allow_nan=False))


def console() -> Console:
    """Return the console of standard output, without markup: names of links may hold brackets."""
    from rich.console import Console

    return Console(markup=False, highlight=False, emoji=False, soft_wrap=False)


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
        made.add_column(Text(column), justify="right" if column in flush else "left")
    return made


def entries(files: Iterable[str], failures: list[str]) -> Iterator[Entry]:
    """Yield the mechanisms of files; a file that cannot be read is told on standard error and listed."""
    from graphs.errors import FileError
    from graphs.files.formats import read_all

    for file in files:
        try:
            yield from read_all(file)
        except FileError as error:
            click.echo(str(error), err=True)
            failures.append(file)
