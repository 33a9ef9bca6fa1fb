"""``synth layers``: whether a crease pattern folds flat, and in how many layer orders."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

import synth.analysis.folding
import synth.analysis.layering
import synth.making.drawing.mechanisms
from graphs.errors import InvariantError
from synth.cli import options
from synth.cli.output import about, check_output, plain, print_answer, print_json, print_result, tell_written
from synth.cli.reading import MECHANISM, PRECISION, precise_sheet, read
from synth.cli.runner import RunOptions, run_resumable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from enumerate.runner.job import Row
    from graphs.mechanism import Sheet
    from synth.analysis.layering import FlatFolding, LayerOrder
    from synth.analysis.layering.counting.problem import LayerProblem


_MOST_WRITTEN = 1000
"""Orders of a component that are written, each to a file."""


def _pair(word: str) -> tuple[int, int]:
    """Return the panels of a word ``UPPER,LOWER``."""
    parts = word.split(",")
    if len(parts) != 2 or not all(part.isascii() and part.isdigit() and len(part) < 10 for part in parts):
        raise ValueError(f"{plain(word)!r} is not two numbers of panels such as 3,7")
    return int(parts[0]), int(parts[1])


def _creases(word: str) -> str | list[int]:
    """Return the creases of a word: unassigned, all, or numbers with commas."""
    if word in ("unassigned", "all"):
        return word
    parts = word.split(",")
    if not all(part.isascii() and part.isdigit() and len(part) < 10 for part in parts):
        raise ValueError(f"{plain(word)!r} is no crease; expected unassigned, all, or numbers such as 3,7")
    return list(map(int, parts))


@click.command()
@MECHANISM
@options.number(
    "--frame", "N",
    "Frame of a FOLD file; 0 is the key frame. In a frame that is folded, panels that lie on each other are ordered.", 0
)  # fmt: skip
@options.number("--order", "N", "Show this layer order, counted from 0.", 0)
@options.number("--sample", "SEED", "Show a layer order drawn at random, each as likely as any other.", 0)
@options.repeated(
    "--wish wishes", "UPPER,LOWER",
    "Show the layer order that meets most wishes: panel UPPER is to lie above panel LOWER. May be repeated.",
    type=options.WordType("panels", _pair),
)  # fmt: skip
@options.flag("--face-orders", "Show the layer order nearest to the faceOrders of a FOLD file.")
@options.number("--component", "K", "With -o: write one file per order of this component, NAME-0, NAME-1, ...", 0)
@options.flag("--assignments", "Count the layer orders for each assignment of unassigned creases.")
@options.value(
    "--may-stay-flat",
    "CREASES",
    "Count the orders of all choices of creases that stay flat: unassigned, all, or numbers of creases such as 3,7.",
    type=options.WordType("creases", _creases),
)
@options.flag(
    "--fix",
    "Find creases that have to change for the local conditions to hold, none of which can be left out; -o writes the "
    "pattern with them changed.",
)
@options.flag(
    "--explain/--no-explain",
    "If there is no layer order, find panels and conditions that contradict each other, none of which can go.",
    default=True,
)
@options.output(
    "Keep the counts in this .sqlite store, from which a stopped run is continued with --resume.", "STORE", "--counts"
)
@options.flag("--resume", "Continue a stopped run from the store of --counts.")
@options.number("--workers", "N", "Number of processes that count. By default one; with --counts one per core.")
@options.value("--scheduler", "ADDRESS", "Count on a Dask cluster, such as tcp://host:8786.")
@options.output(
    "Write the layer order, by default order 0: .fold with faceOrders, or a picture (.svg, .png, .pdf). If there is "
    "none, a picture shows why on the pattern."
)
@options.FORCE
@options.JSON
@PRECISION
def layers(
    file: str, frame: int | None, explain: bool, component: int | None, output: str | None, force: bool,
    as_json: bool, assignments: bool, fix: bool, counts: str | None, resume: bool, workers: int | None,
    scheduler: str | None, may_stay_flat: str | list[int] | None, **which: Any,
) -> None:  # fmt: skip
    """Check whether a crease pattern folds flat, and count its layer orders exactly.

    Every mountain, valley and unassigned crease is folded by 180 degrees. Vertices are checked first (Kawasaki,
    Maekawa, crimps), then whether the folded image closes; then the orders of the panels in which the paper passes
    nowhere through itself are counted, component by component. A layer order that is shown lists the panels over
    each cell from below, and is checked by geometry alone. If there is none, the answer names panels and conditions
    on them that contradict each other. In a frame that is folded, in space too, the orders are those of panels that
    lie on each other there, above being the side that the normal of their plane points to.

    \b
    Examples:
      synth layers data/patterns/bird-base.fold
      synth layers data/patterns/bird-base.fold --order 0
      synth layers data/patterns/bird-base.fold --wish 3,7 -o layered.fold

    Exit status 1: the pattern does not fold flat.
    """
    _check_options(component, output, counts, fix=fix, resume=resume, force=force, **which)
    if may_stay_flat is not None and (
        fix or assignments or counts or workers or scheduler or component is not None or which["wishes"]
        or which["face_orders"] or which["sample"] is not None
    ):  # fmt: skip
        raise click.UsageError("--may-stay-flat goes with --frame, --order, -o, --json and --precision only")
    from graphs.answer.mobility import sheet_in_frame
    from graphs.files.mechanism_like import mechanism_for
    from graphs.mechanism import Sheet

    running = RunOptions(counts, workers, scheduler, resume, quiet=as_json, force=force and not resume, counting=True)
    mechanism = read(file)
    with about(file):
        sheet = sheet_in_frame(precise_sheet(mechanism_for("layers", mechanism, Sheet)), frame)
        if may_stay_flat is not None:
            _print_staying(sheet, may_stay_flat, which["order"], output, file, force=force, as_json=as_json)
            return
        if synth.analysis.layering.is_folded(sheet):
            if fix or assignments or counts or workers or scheduler or component is not None:
                raise click.UsageError(
                    "--fix, --assignments, --counts and --component take a pattern, not a folded frame"
                )
            _print_folded(sheet, output, file, frame, force=force, as_json=as_json, **which)
            return
        answer = synth.analysis.layering.flat_folding(
            sheet, lambda problems: _count(problems, running), explain=explain and not fix
        )
        if fix:
            _print_fixed(answer, file, output, force=force, as_json=as_json)
            return
        shown, unmet = _shown(answer, file, **which) if answer.foldable else (None, ())
        by = synth.analysis.layering.orders_by_assignment(answer) if assignments else None
        written = _write(answer, shown, component, output, force=force) if output else []
    if as_json:
        order = None if shown is None else shown.to_json()
        told = {"order": order, "unmet": [list(pair) for pair in unmet]}
        print_json({"file": file, **answer.to_json(), **told, "assignments": None if by is None else by.to_json()})
    else:
        print_answer(answer)
        if by is not None:
            print_answer(by)
        if shown is not None:
            print_answer(shown)
        for upper, lower in unmet:
            click.echo(f"wish not met: panel {upper} above panel {lower}")
        tell_written(*written)
    if not answer.foldable:
        sys.exit(1)


def _check_options(
    component: int | None, output: str | None, counts: str | None, *, fix: bool, resume: bool, force: bool, **which: Any
) -> None:
    """Refuse options that exclude each other, and an output that cannot be written."""
    if sum((which["order"] is not None, which["sample"] is not None, bool(which["wishes"]), which["face_orders"])) > 1:
        raise click.UsageError("--order, --sample, --wish and --face-orders exclude each other")
    if fix and (component is not None or any(which.values())):
        raise click.UsageError("--fix changes the assignment, and shows no layer order; leave out the other option")
    if component is not None and output is None:
        raise click.UsageError("--component requires -o")
    if fix:
        check_output(output, force=force)
    elif output is not None and component is None:
        synth.making.drawing.mechanisms.check_order_path(output, force=force)
    if resume and counts is None:
        raise click.UsageError("--resume requires --counts STORE, the store to continue")


def _print_staying(
    sheet: Sheet, may: str | list[int], number: int | None, output: str | None, file: str, *, force: bool, as_json: bool
) -> None:
    """Print the orders of all choices of creases that stay flat, and one of them, and write it."""
    answer = synth.analysis.layering.staying_flat(
        sheet, may, lambda problems: list(map(synth.analysis.layering.counted, problems))
    )
    shown = answer.order(number or 0) if answer.foldable and (number is not None or output) else None
    if shown is not None and output:
        synth.making.drawing.mechanisms.write_order(*shown, output, force=force)
    order = shown[1] if shown is not None and number is not None else None
    if as_json:
        print_json({"file": file, **answer.to_json(), "order": None if order is None else order.to_json()})
    else:
        print_answer(answer)
        if order is not None:
            print_answer(order)
        if shown is not None:
            tell_written(output)
    if not answer.foldable:
        sys.exit(1)


def _print_folded(
    sheet: Sheet, output: str | None, file: str, frame: int | None, *, force: bool, as_json: bool, **which: Any
) -> None:
    """Print the layer orders at a configuration, and the one that the options name, and write it."""
    from graphs.files.atomic import write_text

    if output is not None and Path(output).suffix.lower() != ".fold":
        raise click.UsageError("-o writes the layer order of a folded frame as .fold")
    answer = synth.analysis.folding.layers_at(sheet)
    shown, unmet = (
        _shown(answer, file, frame=frame, **which) if answer.image is not None and answer.foldable else (None, ())
    )
    if output is not None and answer.image is not None and answer.foldable:
        text = synth.analysis.layering.fold_text_of_layers(answer, shown or answer.order())
        write_text(Path(output), text, force=force)
    else:
        output = None
    if as_json:
        order = None if shown is None else shown.to_json()
        print_json({"file": file, **answer.to_json(), "order": order, "unmet": [list(pair) for pair in unmet]})
    else:
        print_answer(answer)
        if shown is not None:
            print_answer(shown)
        for upper, lower in unmet:
            click.echo(f"wish not met: panel {upper} above panel {lower}")
        if output is not None:
            tell_written(output)
    if not answer.foldable:
        sys.exit(1)


def _print_fixed(answer: FlatFolding, file: str, output: str | None, *, force: bool, as_json: bool) -> None:
    """Print which creases have to change for the local conditions to hold, and write the changed pattern."""
    from graphs.files.formats import write

    fixed = synth.analysis.layering.locally_fixed(answer)
    if output is not None:
        write(fixed.sheet, output, force=force)
    print_result(fixed, {"file": file, "output": output}, as_json=as_json, written=[output])


def _count(problems: Sequence[LayerProblem], running: RunOptions) -> list[int]:
    """Count problems, in the store of --counts if there is one."""
    if running.output is None and running.workers is None and running.scheduler is None:
        return list(map(synth.analysis.layering.counted, problems))
    from enumerate.runner.sinks import RowSink
    from enumerate.runner.store import SqliteSink, read_rows

    job = synth.analysis.layering.LayerCountJob(tuple(problems))
    if running.output is None:
        rows: list[Row] = []
        run_resumable(job, lambda **_: RowSink(lambda _columns, more: rows.extend(more)), running)
        return synth.analysis.layering.numbers_of(job, rows)
    path, resume, force = running.output, running.resume, running.force
    run_resumable(job, lambda **how: SqliteSink(path, resume=resume, force=force, **how), running)
    return synth.analysis.layering.numbers_of(job, read_rows(path))


def _shown(
    answer: FlatFolding,
    file: str,
    order: int | None,
    sample: int | None,
    wishes: Sequence[tuple[int, int]],
    face_orders: bool,
    frame: int | None = None,
) -> tuple[LayerOrder | None, Sequence[tuple[int, int]]]:
    """Return the layer order that the options name, if any, and the wishes that it does not meet."""
    if order is not None:
        return answer.order(order), ()
    if sample is not None:
        return answer.sample(sample), ()
    if face_orders:
        wishes = synth.analysis.layering.wishes_of(answer, synth.analysis.layering.read_face_orders(file, frame))
    return answer.nearest(wishes) if wishes else (None, ())


def _write(
    answer: FlatFolding, shown: LayerOrder | None, component: int | None, output: str, *, force: bool
) -> list[Path]:
    """Write a layer order, or all of a component, or why there is none; return the files."""
    if not answer.foldable:
        if Path(output).suffix.lower() == ".fold":
            return []
        synth.making.drawing.mechanisms.fault_scene(answer).save(output, force=force)
        return [Path(output)]
    if component is None:
        synth.making.drawing.mechanisms.write_order(answer, shown or answer.order(), output, force=force)
        return [Path(output)]
    if component >= len(answer.components):
        numbers = f"a number from 0 to {len(answer.components) - 1}" if answer.components else "no --component"
        raise InvariantError("component", f"component {component}", numbers)
    orders = answer.components[component].orders
    if orders > _MOST_WRITTEN:
        raise InvariantError("component", f"{orders} orders", f"at most {_MOST_WRITTEN} files")
    place = Path(output)
    files = [place.with_stem(f"{place.stem}-{number}") for number in range(orders)]
    for path in files:
        synth.making.drawing.mechanisms.check_order_path(path, force=force)
    for path, order in zip(files, answer.orders_of(component), strict=True):
        synth.making.drawing.mechanisms.write_order(answer, order, path, force=force)
    return files
