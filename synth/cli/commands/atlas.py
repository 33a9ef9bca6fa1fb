"""``synth atlas``: all types up to a size in one file."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from graphs.errors import numbered
from synth.cli.options import FORCE
from synth.cli.output import about, check_output, console, entries, plain, print_answer, print_json, tell_written
from synth.cli.runner import RunOptions, run_resumable, run_whole, runner_options

if TYPE_CHECKING:
    from synth.atlas.opened import AtlasRows

__all__ = ["atlas_group"]


_JSON = click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")
_ATLAS = click.argument("atlas", metavar="ATLAS.sqlite")


@click.group("atlas", short_help="Build, query, show and find all types up to a size, in one file.")
def atlas_group() -> None:
    """Build an atlas of types, and query it.

    \b
    Examples:
      synth atlas build -o atlas.sqlite --max-links 8
      synth atlas query atlas.sqlite "links = 8 and dof = 1 and centres >= 3 and all_explicit"
      synth atlas show atlas.sqlite "Watt chain"
      synth atlas find atlas.sqlite data/wiener/fortune-teller.json
    """


@atlas_group.command()
@click.option(
    "--max-links", type=int, default=8, show_default=True, metavar="N",
    help="Largest number of links of SC and SCD graphs.",
)  # fmt: skip
@click.option(
    "--dof", "dofs", type=int, multiple=True, default=(1,), metavar="M",
    help="Degrees of freedom, 1 by default; may be repeated.",
)  # fmt: skip
@click.option(
    "--max-degree", type=int, default=4, show_default=True, metavar="D", help="Largest number of sides of a link."
)
@click.option(
    "--chain-links", type=int, metavar="N",
    help="Largest number of links of chains. By default that of --max-links.",
)  # fmt: skip
@click.option(
    "--creases", type=int, default=6, show_default=True, metavar="N",
    help="Largest number of creases of R/- strings; 0 leaves strings out.",
)  # fmt: skip
@click.option(
    "--orders-of", multiple=True, default=("watt", "stephenson"), show_default=True, metavar="CHAIN",
    help="Chain (a name or an id k1:...) whose joints are placed round a cone in every order; "
    "none leaves conical orders out. May be repeated.",
)  # fmt: skip
@click.option(
    "--spatial", type=int, default=0, show_default=True, metavar="S",
    help="Include hybrids of 1 to S spatial loops.",
)  # fmt: skip
@click.option("--infinite", is_flag=True, help="Include centres at infinity.")
@click.option(
    "--realise/--no-realise", "realised", default=True, show_default=True, help="Realise the types, and fold them."
)
@runner_options
def build(**options: Any) -> None:
    """Build an atlas of chains, SC and SCD graphs, strings and conical orders, with their properties, in one file.

    Continue a stopped build with --resume. For the columns, see `synth atlas query ATLAS.sqlite --columns help`.
    """
    from synth.atlas.building import AtlasJob, AtlasPlan, AtlasSink
    from synth.atlas.opened import open_atlas

    running = RunOptions.taken_from(options, counting=True)
    if running.output is None:
        raise click.UsageError("an atlas requires -o FILE.sqlite")
    orders = tuple(name for name in options.pop("orders_of") if name != "none")
    plan = AtlasPlan(orders_of=orders, **options)
    sink = partial(AtlasSink, running.output, plan.command, resume=running.resume, force=running.force)
    run_resumable(AtlasJob(plan), sink, running)
    summary = open_atlas(str(running.output)).about()
    if running.as_json:
        print_json({"output": running.output, **summary})
        return
    for kind, number in summary["types"].items():
        click.echo(f"{number:>9}  {kind}")
    tell_written(running.output)


@atlas_group.command()
@_ATLAS
@click.argument("condition", required=False, default="")
@click.option("--sql", "statement", metavar="SELECT", help="SQL statement to use instead of a condition.")
@click.option("--columns", metavar="A,B,...", help="Columns to show; `help` lists all of them.")
@click.option(
    "--sort", default="", metavar="[-]COLUMN", help="Sort by a column; a leading - sorts in descending order."
)
@click.option(
    "--limit", type=click.IntRange(min=1), default=1000, show_default=True, metavar="N",
    help="Largest number of rows.",
)  # fmt: skip
@click.option(
    "--seconds", type=click.FloatRange(min=0, min_open=True), metavar="SECONDS", default=30.0, show_default=True,
    help="Time limit in seconds.",
)  # fmt: skip
@click.option(
    "-o", "--output", metavar="OUT",
    help="Write .csv, .json, .jsonl, .parquet, a picture (.svg, .png, .pdf), or a folder of mechanisms.",
)  # fmt: skip
@FORCE
@_JSON
def query(
    atlas: str,
    condition: str,
    statement: str | None,
    columns: str | None,
    output: str | None,
    force: bool,
    as_json: bool,
    **search: Any,
) -> None:
    """List the types that fulfil a condition.

    \b
    Examples of conditions:
      links = 8 and dof = 1 and centres >= 3 and all_explicit
      kind = scd and 4 <= links <= 6 and fold_deg > 170
      assortment = (4, 2) or name like '%watt%'
      loop_sizes contains 5 and not (symmetry = 1)
      kind in ('sc', 'scd') and ride_alongs is known
    """
    from synth.atlas.opened import open_atlas

    if columns == "help":
        _print_columns()
        return
    if statement is not None and (condition or columns or search["sort"]):
        raise click.UsageError("--sql excludes a condition, --columns and --sort")
    if output is not None and as_json:
        raise click.UsageError("-o and --json exclude each other; try one of them")
    check_output(output if output is None or Path(output).suffix else None, force=force)
    opened = open_atlas(atlas)
    if statement is not None:
        rows = opened.sql(statement, limit=search["limit"], seconds=search["seconds"])
    else:
        names = [name.strip() for name in columns.split(",")] if columns else []
        rows = opened.query(condition, columns=names, **search)
    if output is not None:
        _write(rows, output, force)
    elif as_json:
        print_json(rows.to_json())
    else:
        _print(rows)
    if rows.more:
        click.echo(f"more than {numbered(len(rows), 'row')}; try a larger --limit", err=True)


def _print(rows: AtlasRows) -> None:
    out = console()
    for block in rows.blocks()[:1]:
        out.print(block)


def _print_columns() -> None:
    from graphs.printing import TableBlock
    from synth.atlas.columns import COLUMNS

    rows = [(name, " ".join(column.kinds), column.says) for name, column in COLUMNS.items()]
    console().print(TableBlock(("column", "kinds", "meaning"), rows))


def _write(rows: AtlasRows, output: str, force: bool) -> None:
    from synth.atlas.written import write_rows

    tell_written(*write_rows(rows, output, force=force))


@atlas_group.command()
@_ATLAS
@click.argument("type_id", metavar="ID")
@click.option("-o", "--output", metavar="FILE.fold", help="Write the realised type to this file.")
@FORCE
@_JSON
def show(atlas: str, type_id: str, output: str | None, force: bool, as_json: bool) -> None:
    """Show the properties of a type, given its id or its name, and the types related to it."""
    from synth.atlas.opened import open_atlas

    check_output(output, force=force)
    report = open_atlas(atlas).show(type_id)
    if output is not None:
        from graphs.errors import UnsolvableError
        from graphs.files.atomic import write_text
        from synth.atlas.written import sheet_of_type

        text = report.values.get("fold_file")
        if text is None:
            raise UnsolvableError(f"{plain(type_id)}: the atlas has no coordinates of this type")
        sheet_of_type(report.values)  # raises an error for a damaged file, which is not written
        write_text(Path(output), text, force=force)
    if as_json:
        print_json(report.to_json())
        return
    print_answer(report)
    tell_written(output)


@atlas_group.command()
@_ATLAS
@click.argument("condition", required=False, default="")
@click.option("-o", "--output", "folder", required=True, metavar="FOLDER", help="New folder to write the site to.")
@click.option("--title", default="", help="Title of the site.")
@click.option(
    "--workers", type=click.IntRange(min=1), metavar="N", help="Number of processes. By default one per core."
)
@click.option("--quiet", is_flag=True, help="Show no progress.")
def page(atlas: str, condition: str, folder: str, title: str, workers: int | None, quiet: bool) -> None:
    """Write a site to search, filter and sort types, with one page per type: its drawing, and a model that folds.

    The site needs no server and no network: open index.html. CONDITION is that of `synth atlas query`.
    """
    from synth.atlas.opened import open_atlas
    from synth.atlas.site_pages import SiteSink, site_of

    site, first = site_of(open_atlas(atlas), condition, title)
    running = RunOptions(folder, workers, None, False, quiet, False)
    run_whole(site, SiteSink(folder, first), running)
    tell_written(Path(folder) / "index.html")


@atlas_group.command()
@_ATLAS
@click.argument("files", metavar="FILE...", nargs=-1, required=True)
@_JSON
def find(atlas: str, files: tuple[str, ...], as_json: bool) -> None:
    """Find the types of mechanisms in the atlas, and the types one edit away."""
    from synth.atlas.finding import find_type
    from synth.atlas.opened import open_atlas

    opened = open_atlas(atlas)
    failures: list[str] = []
    answers = []
    for entry in entries(files, failures):
        with about(entry.label):
            answer = find_type(opened, entry.mechanism)
        answers.append({"file": entry.label, **answer.to_json()})
        if not as_json:
            click.echo(plain(entry.label, 4096))
            print_answer(answer)
    if as_json:
        print_json(answers)
    for failure in failures:
        click.echo(failure, err=True)
    if failures:
        click.get_current_context().exit(2)
