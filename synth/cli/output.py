"""What commands print: answers, tables, JSON, progress; standard output that cannot be written."""

from __future__ import annotations

import io
import json
import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any, Protocol

import click

from graphs.errors import FileError, InvariantError, SynthedraError
from graphs.printing import UNWRAPPED, console_for, plain, rich_table as table

if TYPE_CHECKING:
    from rich.console import Console

    from graphs.printing import Block, Printed

__all__ = [
    "OutputError", "ReaderGoneError", "about", "check_output", "check_picture", "console", "guard_output", "plain",
    "print_answer", "print_json", "print_result", "progress_line", "shortened", "table", "tell_lost", "tell_written",
]  # fmt: skip

_FIGURES = 12
"""Significant figures of numbers in JSON; rows of enumerations have no more."""
PATIENCE = 2.0
"""Seconds before progress is shown."""


class _Answer(Protocol):
    """An answer that is printed, with keys for JSON."""

    def blocks(self) -> list[Block]:
        """Return the lines and tables that are printed."""

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on."""


@contextmanager
def about(label: str) -> Iterator[None]:
    """Put the name of a file before the errors of its mechanism."""
    try:
        yield
    except FileError:
        raise
    except InvariantError as error:
        raise FileError(label, "", error.offender, error.expected) from None
    except SynthedraError as error:
        raise FileError(label, "", str(error)) from None


def check_output(path: str | None, *, force: bool) -> None:
    """Refuse an output that must not be replaced, before anything is computed for it; None is no output."""
    from graphs.files.atomic import check_place

    if path is not None:
        check_place(Path(path), force=force)


def check_picture(path: str | None, *, force: bool) -> None:
    """Refuse a picture that cannot be written, before anything is computed for it; None is no picture."""
    if path is not None:
        from graphs.files.outputs import check_writable
        from synth.exporters import EXPORTERS

        check_writable(path, EXPORTERS["pictures"], force=force)


def tell_lost(lost: Sequence[str]) -> None:
    """Print what a format could not hold, if there is anything."""
    if lost:
        click.echo("not stored: " + plain(", ".join(lost), 1000))


def tell_written(*places: str | Path | None) -> None:
    """Print the name of each file that was written; None is no file."""
    for place in places:
        if place is not None:
            print_note(f"written: {plain(str(place), 4096)}")


def print_note(line: str) -> None:
    """Print a line about files that were written; where standard output is closed nobody waits for it."""
    raw = getattr(getattr(sys.stdout, "buffer", None), "raw", None)
    if not (isinstance(raw, _Guarded) and raw.missing):
        click.echo(line)


def print_answer(answer: Printed | _Answer) -> None:
    """Print the lines and tables of an answer."""
    out = console()
    for block in answer.blocks():
        out.print(block)


def print_result(
    answer: _Answer,
    keys: Mapping[str, Any],
    *,
    as_json: bool,
    written: Sequence[str | Path | None] = (),
    lost: Sequence[str] = (),
) -> None:
    """Print an answer, files that were written, and what they could not hold; or JSON, `keys` before its own."""
    if as_json:
        print_json({**keys, **answer.to_json()})
        return
    print_answer(answer)
    tell_written(*written)
    tell_lost(lost)


def print_json(value: Any) -> None:
    """Print one JSON document on standard output, numbers with the digits that they are good for."""
    click.echo(json.dumps(shortened(value), indent=2, allow_nan=False))


def shortened(value: Any) -> Any:
    """Return a value of JSON with twelve figures of each number: later ones differ among processors."""
    if isinstance(value, float):
        return float(f"{value:.{_FIGURES}g}")
    if isinstance(value, dict):
        return {key: shortened(item) for key, item in value.items()}
    return [shortened(item) for item in value] if isinstance(value, list | tuple) else value


def console() -> Console:
    """Return the console of standard output, without markup: names of links may hold brackets.

    Lines are wrapped on a terminal only; in a file or a pipe a row stays a line.
    """
    return console_for(None, None if sys.stdout.isatty() else UNWRAPPED)


@contextmanager
def progress_line(patience: float = PATIENCE) -> Iterator[Callable[[str], None]]:
    """Yield a function that shows progress on one line of a terminal, after some seconds; the line is wiped."""
    start, shown = monotonic(), False

    def show(progress: str) -> None:
        nonlocal shown
        if sys.stderr.isatty() and monotonic() - start > patience:
            click.echo(f"\r{progress}", nl=False, err=True)
            shown = True

    try:
        yield show
    finally:
        if shown:
            click.echo("\r" + " " * 40 + "\r", nl=False, err=True)


class OutputError(SynthedraError):
    """Standard output cannot be written."""


class ReaderGoneError(OutputError):
    """Who should read standard output has stopped reading, as ``head`` does: no reason to complain."""

    status = 128 + 13
    """The exit status of what the signal SIGPIPE stops."""


class _Guarded(io.FileIO):
    """The bytes of standard output; its failures are reported once, as errors of their own, not of files.

    If it is `missing`, closed before we began, every write fails.
    """

    def __init__(self, descriptor: int, *, missing: bool) -> None:
        super().__init__(descriptor, "w", closefd=False)
        self.missing, self._failed = missing, False

    def write(self, data: Any) -> int:
        """Write; what is left after a failure is dropped.

        Raise OutputError at the first failure, ReaderGoneError if there is no reader any more.
        """
        if self._failed:
            return len(data)
        try:
            if self.missing:
                raise OSError(0, "it is closed")
            return os.write(self.fileno(), data)
        except OSError as error:
            self._failed = True
            if isinstance(error, BrokenPipeError):
                raise ReaderGoneError("standard output: nobody reads it any more") from None
            raise OutputError(f"standard output: cannot be written: {error.strerror}") from None


def guard_output() -> None:
    """Let standard output raise `OutputError` where it cannot be written; consoles of Windows stay as they are."""
    if sys.platform == "win32":
        return
    if sys.stdout is None:  # closed before we began: no file may get its descriptor
        while (low := os.open(os.devnull, os.O_RDWR)) <= 2:
            pass
        os.close(low)
        raw, encoding, errors = _Guarded(1, missing=True), "utf-8", "strict"
    else:
        raw = _Guarded(sys.stdout.fileno(), missing=False)
        encoding, errors = sys.stdout.encoding, sys.stdout.errors or "strict"
    sys.stdout = io.TextIOWrapper(io.BufferedWriter(raw), encoding, errors, line_buffering=raw.isatty())
