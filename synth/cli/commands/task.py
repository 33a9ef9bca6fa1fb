"""``synth task``: from a task to types, with dimensions, ranked."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

import synth.synthesis.tasks
from synth.cli import options
from synth.cli.output import about, check_output, print_result, progress_line

if TYPE_CHECKING:
    from synth.synthesis.tasks import RankedTypes


@click.command()
@click.argument("task", metavar="TASK", type=options.FILE_NAME)
@options.flag("--structure-only", "List the types and placements that can do it by structure, and design none.")
@options.number(
    "--starts", "N", "Searches for each type and placement in the first round; each round doubles them.", 1,
    most=100_000, default=2,
)  # fmt: skip
@options.number("--rounds", "N", "Number of rounds; after each, the better half goes on.", 1, most=20, default=4)
@options.seed("Random seed; another seed gives other starts.")
@options.repeated("--weigh", "K=WEIGHT", "Number of a wish, from 1, and its weight in the ranking; may be repeated.")
@options.output("Keep all designs in this folder, from which a stopped run is continued.", "STORE", "--store")
@options.flag("--resume", "Continue a stopped run from the folder of --store, or rank its designs again.")
@options.WORKERS
@options.value("--scheduler", "ADDRESS", "With --store: work on a Dask cluster, such as tcp://host:8786.")
@options.output("Write the ranked designs to this folder: .json, or .fold for sheets.", "FOLDER")
@options.flag("--pages", "With -o: also write a page that moves, and a template, of each design.")
@options.output("Write a report that opens offline: tables, and a picture of each design.", "OUT.html", "--report")
@options.FORCE
@options.JSON
def task(
    task: str, structure_only: bool, starts: int, rounds: int, seed: int, weigh: tuple[str, ...],
    store: str | None, resume: bool, workers: int | None, scheduler: str | None, output: str | None,
    pages: bool, report: str | None, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Find all types that can do a task, with dimensions, ranked.

    TASK is a JSON file (docs/native-json.md; examples in data/tasks): roles of bodies, requirements on the type,
    and wishes about their motion. All types of the sizes are listed, with the families that move although a generic
    realisation is rigid; those that cannot do it are counted by reasons. Roles are placed in all ways up to
    symmetries of the type. Each placement is designed from random members of the type; after each round the better
    half goes on with twice as many starts. A design counts only if it meets its wishes to 1e-6, its loops close,
    the verdict says that it moves, and its driven joint passes the configurations in order without turning back.

    \b
    Examples:
      synth task lid.json --structure-only
      synth task lid.json --store lid --report lid.html -o designs --pages
      synth task lid.json --store lid --resume --weigh 2=0.1

    Exit status 1: no design.
    """
    if structure_only:
        with about(task):
            print_result(synth.synthesis.tasks.task(task, structure_only=True), {"file": task}, as_json=as_json)
        return
    if (resume or scheduler is not None) and store is None:
        raise click.UsageError("--resume and --scheduler require --store STORE")
    if pages and output is None:
        raise click.UsageError("--pages requires -o FOLDER")
    check_output(report, force=force)
    if output is not None:
        from synth.synthesis.tasks.report import check_folder_of_designs

        check_folder_of_designs(Path(output), force=force)
    settings = {"starts": starts, "rounds": rounds, "seed": seed, "weights": dict(options.weights_of(weigh))}
    settings |= {"store": store, "resume": resume, "force": force, "workers": workers, "scheduler": scheduler}
    answer = _answer(task, settings)
    written = [] if output is None else synth.synthesis.tasks.write_designs(answer, output, force=force)
    notes: list[str] = []
    if pages and output is not None:
        shown, notes = synth.synthesis.tasks.write_pages(answer, output, force=force)
        written += shown
    if report is not None:
        written.append(synth.synthesis.tasks.write_report(answer, report, force=force))
    keys = {"file": task, **({"written": list(map(str, written))} if as_json else {})}
    print_result(answer, keys, as_json=as_json, written=written)
    for note in notes:
        click.echo(note, err=True)
    if answer.best is None:
        sys.exit(1)


def _answer(task: str, settings: dict[str, Any]) -> RankedTypes:
    """Return the ranked types; a run that the user stops ends the command, and its store goes on later."""
    from enumerate.runner import Interrupted
    from synth.cli.runner import cores

    settings["workers"] = settings["workers"] or cores()
    try:
        with about(task), progress_line() as show:
            return synth.synthesis.tasks.task(
                task, report=lambda number, done: show(f"round {number + 1}: start {done.done} of {done.units}"),
                **settings,
            )  # fmt: skip
    except Interrupted as stop:
        click.echo(
            "stopped; go on with --resume" if settings["store"] is not None else "stopped; nothing was kept", err=True
        )
        sys.exit(stop.status)
