"""The options of the runner, progress, and the sinks of rows, for all subcommands that enumerate."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from functools import wraps
from time import monotonic
from typing import TYPE_CHECKING, Any

import click

from graphs.errors import numbered
from graphs.printing import LONGEST_CELL
from synth.cli import options
from synth.cli.output import console, plain, print_json, print_note, table, tell_written

if TYPE_CHECKING:
    from enumerate.runner.job import Column, Job, Progress, Row, Sink

_MOST_IN_TABLE = 1000
_NAME = "name"
"""The column of names of known types (synth/synthesis/atlas/named.json), in tables only: rows in files have ids."""
_ROW = "row"
"""The column of numbers of rows, from 1, in tables only."""
_PATIENCE = 1.0
"""Seconds before progress is shown, and between two lines of it."""


@dataclass(frozen=True)
class RunOptions:
    """The values of the options that `runner_options` adds; `counting`: rows are counted, or kept, not listed."""

    output: str | None = None
    workers: int | None = None
    scheduler: str | None = None
    resume: bool = False
    quiet: bool = False
    as_json: bool = False
    force: bool = False
    counting: bool = False

    def __post_init__(self) -> None:
        if self.resume and self.force:
            raise click.UsageError("--resume and --force exclude each other: continue a store, or replace it")
        if self.resume and self.output is None:
            raise click.UsageError("--resume requires -o FILE.sqlite, the store to continue")
        if self.output is not None and self.counting and not self.output.lower().endswith(".sqlite"):
            raise click.UsageError("--count keeps its counts in a store only; try -o FILE.sqlite, or no -o")
        if self.output is not None and self.as_json and not self.counting:
            raise click.UsageError("-o and --json exclude each other; try one of them")

    def stored_job(self) -> dict[str, Any] | None:
        """Return the key of the job to continue; None if there is none yet."""
        if not self.resume or self.output is None:
            return None
        from enumerate.runner.store import job_in

        return job_in(self.output)


def cores() -> int:
    """Return the number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


_OUTPUT = options.output(
    "Write .jsonl, .csv, .sqlite, .parquet, .tex, .g6 (chains only), or a folder of mechanisms; counts go to .sqlite.",
    "FILE",
)
_OPTIONS = (
    options.WORKERS,
    options.value("--scheduler", "ADDRESS", "Work on a Dask cluster, such as tcp://host:8786."),
    options.flag("--resume", "Continue a stopped run from its .sqlite store."),
    options.FORCE,
    options.flag("--quiet", "Show neither progress nor the names of written files."),
    options.JSON,
)


def runner_options(
    command: Callable[..., None], *, counting: bool = False, output: Callable[..., Any] = _OUTPUT
) -> Callable[..., None]:
    """Add the options of the runner to a subcommand, which takes them as one `RunOptions`, ``running``.

    Its output is a store only if `counting`, or with --count.
    """

    @wraps(command)
    def run_command(**values: Any) -> None:
        names = [field.name for field in fields(RunOptions) if field.name in values]
        settings = {name: values.pop(name) for name in names}
        command(running=RunOptions(**settings, counting=values.get("only_count", counting)), **values)

    for each in reversed((output, *_OPTIONS)):
        run_command = each(run_command)
    return run_command


def check_method(method: str | None, only_count: bool) -> None:
    """Refuse a counting method without --count."""
    if method is not None and not only_count:
        raise click.UsageError("--method requires --count")


def run_count(job: Job, running: RunOptions) -> int:
    """Run a job that counts, print the number, keep the counts in the output, if there is one; return the number."""
    from enumerate.runner.sinks import CountSink

    meter = _Meter.of(running, counting=True)
    store: Any = None if running.output is None else _output_of(running, meter)
    sink = CountSink(store)
    _run(job, sink, running, meter)
    if running.as_json:
        sizes = sink.by("contracted_links")
        print_json({"count": sink.total, **({"by_size": sizes} if sizes else {})})
    else:
        click.echo(sink.total)
    return sink.total


def run_rows(
    job: Job, running: RunOptions, wrapped: Callable[[Sink], Sink] = lambda sink: sink, *, numbered_rows: bool = False
) -> int:
    """Run a job and send its rows to a file, a JSON list or a table, by the running; return their number.

    ``wrapped`` wraps the sink in another that handles the rows before it. Rows of a table have numbers, from 1, as
    ``--row`` of other commands counts them, with `numbered_rows`.
    """
    from enumerate.runner.sinks import RowSink

    meter = _Meter.of(running)
    if running.output is not None:
        progress = _run(job, wrapped(_output_of(running, meter)), running, meter)
        if not running.quiet:
            print_note(numbered(progress.rows, "new row" if running.resume else "row"))
            tell_written(running.output)
        return progress.rows
    if running.as_json:
        objects: list[dict[str, Any]] = []

        def keep(names: tuple[str, ...], rows: list[Row]) -> None:
            objects.extend(dict(zip(names, row, strict=True)) for row in rows)

        _run(job, wrapped(RowSink(keep)), running, meter)
        print_json(objects)
        return len(objects)
    printer = TablePrinter(job.columns, numbered_rows=numbered_rows)
    progress = _run(job, wrapped(RowSink(printer.take)), running, meter)
    printer.finish()
    return progress.rows


def _output_of(running: RunOptions, meter: _Meter) -> Sink:
    from enumerate.runner.sinks import sink_for

    assert running.output is not None
    how: dict[str, Any] = {"tell": meter.tell, "looking": meter.look}
    return sink_for(running.output, resume=running.resume, force=running.force, **how)


def run_resumable(job: Job, sink_of: Callable[..., Sink], running: RunOptions) -> None:
    """Run a job into a sink that keeps finished units: ``sink_of`` takes functions for messages and progress."""
    meter = _Meter.of(running)
    _run(job, sink_of(tell=meter.tell, looking=meter.look), running, meter, stored=True)


def run_whole(job: Job, sink: Sink, running: RunOptions) -> None:
    """Run a job into a sink that is written whole or not at all."""
    _run(job, sink, running, _Meter.of(running))


def _run(job: Job, sink: Sink, running: RunOptions, meter: _Meter, *, stored: bool = False) -> Progress:
    from enumerate.runner._run import run
    from enumerate.runner.stopping import Interrupted

    try:
        if running.output is not None or meter.counting:  # else rows may be printed on the same line
            meter.begin()
        return run(job, sink, workers=running.workers or cores(), scheduler=running.scheduler, report=meter.show)
    except Interrupted as stop:
        meter.clear()
        stored = stored or (running.output is not None and running.output.lower().endswith(".sqlite"))
        click.echo("stopped; go on with --resume" if stored else "stopped; nothing was written", err=True)
        sys.exit(stop.status)
    finally:
        meter.clear()


class _Meter:
    """Progress on a terminal, about once a second, on one line."""

    def __init__(self, silent: bool, *, counting: bool = False) -> None:
        self._silent, self._next, self._width = silent, monotonic() + _PATIENCE, 0
        self.counting = counting
        self._looked: tuple[float, float] | None = None  # time and part when the check of a store began

    @classmethod
    def of(cls, running: RunOptions, *, counting: bool = False) -> _Meter:
        """Return a meter, silent with --quiet or without a terminal."""
        return cls(running.quiet or not sys.stderr.isatty(), counting=counting)

    def begin(self) -> None:
        """Show the line before any progress: large jobs take minutes to list their units."""
        if not self._silent:
            self._write("  0%  listing the units of the job")

    def look(self, part: float) -> None:
        """Show the part of a store that has been checked, and the time left."""
        now = monotonic()
        since, seen = self._looked = self._looked or (now, part)
        if self._is_time():
            left = (now - since) * (1 - part) / (part - seen) if part > seen else float("inf")
            self._write(f"{part:4.0%}  checking the store, {_time(left)} left")

    def tell(self, line: str) -> None:
        """Print a line that stays."""
        self.clear()
        click.echo(line, err=True)

    def show(self, progress: Progress) -> None:
        """Show the part that is done, the speed, and the time left."""
        if not self._is_time():
            return
        part = progress.weight / progress.total_weight if progress.total_weight else 1.0
        done = f"{progress.rows:,} rows, {progress.rate:,.0f} per second"
        if self.counting:
            done = f"{progress.done:,} of {progress.units:,} units counted"
        self._write(f"{part:4.0%}  {done}, {_time(progress.seconds_left)} left")

    def _is_time(self) -> bool:
        if self._silent or monotonic() < self._next:
            return False
        self._next = monotonic() + _PATIENCE
        return True

    def _write(self, text: str) -> None:
        click.echo("\r" + text.ljust(self._width), nl=False, err=True)
        self._width = len(text)

    def clear(self) -> None:
        """Wipe the line."""
        if self._width:
            click.echo("\r" + " " * self._width + "\r", nl=False, err=True)
            self._width = 0


def _time(seconds: float) -> str:
    if seconds == float("inf"):
        return "?"
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min {rest} s" if minutes else f"{rest} s"


class TablePrinter:
    """Prints a table, or lines with tabs if there are too many rows for one; leaves out columns of files."""

    def __init__(self, columns: Mapping[str, Column], *, numbered_rows: bool = False) -> None:
        self._shown = [(i, _text_of(columns[column])) for i, column in enumerate(columns) if column != "mechanism"]
        self._columns = [list(columns)[i] for i, _ in self._shown]
        self._numbers = [column for column in self._columns if columns[column] in (int, float)]
        self._id = next((self._columns.index(column) for column in ("code", "chain") if column in self._columns), None)
        # a column of the job's own with this name is of the chain, the one behind the id of the type
        self._columns = [f"chain {_NAME}" if column == _NAME else column for column in self._columns]
        if self._id is not None:
            self._columns.insert(self._id + 1, _NAME)
        self._numbered = numbered_rows
        if numbered_rows:
            self._columns.insert(0, _ROW)
            self._numbers.append(_ROW)
        self._printed = 0
        self._kept: list[list[str]] = []
        self._streaming = False

    def take(self, columns: tuple[str, ...], rows: list[Row]) -> None:
        """Keep rows for the table, or print them."""
        del columns
        for row in rows:
            self._printed += 1
            cells = self._named([text(row[i]) for i, text in self._shown])
            self._kept.append([str(self._printed), *cells] if self._numbered else cells)
        if len(self._kept) > _MOST_IN_TABLE or self._streaming:
            if not self._streaming:
                click.echo("\t".join(self._columns))
            self._streaming = True
            click.echo("\n".join("\t".join(row) for row in self._kept))
            self._kept = []

    def _named(self, row: list[str]) -> list[str]:
        """Return a row with the name of its type behind the id, or nothing."""
        if self._id is None:
            return row
        from synth.synthesis.atlas.columns import name_of_id

        return [*row[: self._id + 1], name_of_id(row[self._id]) or "", *row[self._id + 1 :]]

    def finish(self) -> None:
        """Print the table, unless lines were printed; columns with one value in all rows go above it."""
        if self._streaming:
            return
        if not self._kept:
            click.echo("none")
            return
        common = [
            i for i in range(1, len(self._columns)) if len(self._kept) > 1 and len({row[i] for row in self._kept}) == 1
        ]
        if common:
            said = [i for i in common if self._kept[0][i] or self._columns[i] != _NAME]
            click.echo("  ".join(f"{self._title(i)} {self._kept[0][i] or '-'}" for i in said))
        nameless = [
            i for i, column in enumerate(self._columns) if column == _NAME and not any(r[i] for r in self._kept)
        ]
        left = [i for i in range(len(self._columns)) if i not in (*common, *nameless)]
        numbers = [self._title(i) for i in left if self._columns[i] in self._numbers]
        shown = table(*map(self._title, left), numbers=numbers)
        for row in self._kept:
            shown.add_row(*(row[i] for i in left))
        console().print(shown)

    def _title(self, column: int) -> str:
        return self._columns[column].replace("_", " ")


def _text_of(column: Column) -> Callable[[Any], str]:
    """Return the function from a value of a column to its text."""
    text = _cell if isinstance(column, type) else column.text
    return lambda value: plain(text(value), LONGEST_CELL)


def _cell(value: object) -> str:
    return {True: "yes", False: "no"}[value] if isinstance(value, bool) else str(value)
