"""``synth enumerate strings``: R/- strings."""

from __future__ import annotations

import json
from collections.abc import Iterator
from itertools import chain, islice
from typing import Any

import click

from synth.cli.output import FORCE, console, plain, print_json, table, tell_written

__all__ = ["strings"]

_MOST_IN_TABLE = 1000


def _limit(context: click.Context, parameter: click.Parameter, value: str) -> int | None:
    """Read a limit: a number, or ``none``."""
    del context, parameter
    if value.lower() == "none":
        return None
    if not value.isascii() or not value.isdigit() or len(value) > 6:
        raise click.BadParameter(f"{plain(value)!r} is neither a number nor 'none'")
    return int(value)


@click.command(short_help="List or count R/- strings: chains of panels between two bodies.")
@click.option("--dof", type=click.IntRange(min=1), metavar="N", help="Number of creases.")
@click.option(
    "--max-dof", type=click.IntRange(min=1), metavar="N", help="Largest number of creases. By default 6."
)
@click.option(
    "--modes", is_flag=True, help="List one row per mode: vertices on the same side (S) or on a diagonal (D)."
)
@click.option(
    "--max-panels",
    default="2",
    callback=_limit,
    metavar="K",
    show_default=True,
    help="Largest number of panels; none for no limit.",
)
@click.option(
    "--max-cluster",
    default="3",
    callback=_limit,
    metavar="K",
    show_default=True,
    help="Largest number of creases that meet in one point; none for no limit.",
)
@click.option("--count", "only_count", is_flag=True, help="Print only the number, by generating functions.")
@click.option("-o", "--output", metavar="FILE.jsonl", help="Write one JSON object per line.")
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print a JSON list.")
def strings(
    dof: int | None,
    max_dof: int | None,
    modes: bool,
    max_panels: int | None,
    max_cluster: int | None,
    only_count: bool,
    output: str | None,
    force: bool,
    as_json: bool,
) -> None:
    """List or count the R/- strings: open chains of panels, with their joint chains (Wiener, Table 8).

    R is a crease; creases written together meet in one point; - is a rectangular panel. With --modes each string
    is listed once per arrangement of its vertices (Table 7).

    \b
    Examples:
      synth enumerate strings
      synth enumerate strings --dof 6 --modes
      synth enumerate strings --dof 30 --max-panels none --count
    """
    from enumerate.strings.panel_strings import count_strings

    if dof is not None and max_dof is not None:
        raise click.UsageError("give --dof or --max-dof, not both")
    numbers = [dof] if dof is not None else list(range(1, (max_dof or 6) + 1))
    limits = {"max_panels": max_panels, "max_cluster": max_cluster}
    if only_count:
        number = _count_modes(numbers, limits) if modes else sum(count_strings(n, **limits) for n in numbers)
        if as_json:
            print_json({"count": number})
        else:
            click.echo(number)
        return
    rows = _rows(numbers, limits, modes)
    if output is not None:
        _write(output, rows, force)
        tell_written(output)
    elif as_json:
        print_json(list(rows))
    else:
        _print(rows, modes)


def _count_modes(numbers: list[int], limits: dict[str, int | None]) -> int:
    from enumerate.strings.panel_strings import strings as listed

    return sum(string.count_modes() for n in numbers for string in listed(n, **limits))


def _rows(numbers: list[int], limits: dict[str, int | None], modes: bool) -> Iterator[dict[str, Any]]:
    from enumerate.strings.panel_strings import strings as listed

    for n in numbers:
        for string in listed(n, **limits):
            row = {
                "creases": string.creases,
                "string": string.text,
                "joints": string.mechanism,
                "distance": string.distance,
                "dof": string.dof,
                "modes": string.count_modes(),
                "comment": string.comment,
            }
            yield from ({**row, "mode": mode} for mode in string.modes()) if modes else [row]


def _write(output: str, rows: Iterator[dict[str, Any]], force: bool) -> None:
    from pathlib import Path

    from graphs.errors import FileError
    from graphs.files.atomic import write_chunks

    if not output.endswith(".jsonl"):
        raise FileError(output, "", "the extension is not known", ".jsonl")
    write_chunks(Path(output), (json.dumps(row) + "\n" for row in rows), force=force)


def _print(rows: Iterator[dict[str, Any]], modes: bool) -> None:
    """Print a table, or lines parted by tabs where there are too many rows for one."""
    columns = ["creases", "string", "joints", "distance", "dof", "modes", *(["mode"] if modes else []), "comment"]
    first = list(islice(rows, _MOST_IN_TABLE + 1))
    if len(first) > _MOST_IN_TABLE:
        click.echo("\t".join(columns))
        for row in chain(first, rows):
            click.echo("\t".join(str(row[column]) for column in columns))
        return
    made = table(*columns, numbers=["creases", "dof", "modes"])
    for row in first:
        made.add_row(*(plain(row[column], 200) if row[column] != "" else "" for column in columns))
    console().print(made)
