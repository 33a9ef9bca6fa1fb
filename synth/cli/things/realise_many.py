"""``synth realise`` of a store, a list or a folder: every type in it, on all cores."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from synth.cli.output import plain, print_json, tell_written
from synth.cli.runner import RunOptions, run_resumable

if TYPE_CHECKING:
    from collections.abc import Callable

    from enumerate.runner.job import Sink

__all__ = ["realise_many"]


def realise_many(source: str, running: RunOptions, options: dict[str, Any], *, as_json: bool) -> None:
    """Realise the types of a store, a list or a folder, and print the results.

    The output of `running` is a folder, or a store (.sqlite), which holds the files in its rows; the options are
    those of `synth.realisation.realise`.
    """
    from enumerate.runner.job import row_as_dict
    from enumerate.runner.store import read_rows
    from graphs.errors import numbered
    from synth.realisation.many.job import COLUMNS, RealisationJob, summary_of

    job = RealisationJob(source, tuple(sorted(options.items())))
    made, store = _sink_of(running)
    run_resumable(job, made, running)
    summary = summary_of(row_as_dict(COLUMNS, row) for row in read_rows(store))
    if as_json:
        print_json({"file": source, "output": running.output, "left_out": job.failures, **summary})
        return
    for one in summary["types"]:
        if one["outcome"] != "realised":
            click.echo(f"{one['number']}  {plain(one['name'])}: {plain(one['reason'], 4096)}")
    for failure in job.failures:
        click.echo(f"left out: {plain(failure, 4096)}", err=True)
    counts = "{realised} realised, {not_found} not found, {refused} refused".format(**summary)
    click.echo(f"{numbered(len(summary['types']), 'type')}: {counts}")
    tell_written(*dict.fromkeys((str(running.output), str(store))))


def _sink_of(running: RunOptions) -> tuple[Callable[..., Sink], Path]:
    """Return what makes the sink, and where the store is."""
    from enumerate.runner.store import SqliteSink
    from synth.realisation.many.folder import FolderOfThings, store_beside

    if running.output is None:
        raise click.UsageError("many types need a place: -o FOLDER, or -o FILE.sqlite")
    place = Path(running.output)
    if place.suffix.lower() == ".sqlite":
        return partial(SqliteSink, place, resume=running.resume, force=running.force), place
    if place.suffix:
        raise click.UsageError("many types go to a folder or a store: -o FOLDER, or -o FILE.sqlite")
    if running.force:
        raise click.UsageError("--force replaces no folder: remove it, go on with --resume, or name another")
    return partial(FolderOfThings, place, resume=running.resume), store_beside(place)
