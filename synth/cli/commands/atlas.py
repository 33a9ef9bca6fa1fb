"""``synth atlas``: all types up to a size in one file."""

import sys
from collections.abc import Callable
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

import click

import synth.synthesis.atlas
from graphs.errors import UnsolvableError, numbered
from graphs.printing import TableBlock, plain
from synth.cli import options, output as out
from synth.cli.reading import entries
from synth.cli.runner import RunOptions, run_resumable, run_whole, runner_options

_ATLAS = click.argument("atlas", metavar="ATLAS.sqlite", type=options.FILE_NAME)


def _faces(word: str) -> tuple[int, ...]:
    """Return two numbers of faces, such as ``0,3``."""
    numbers = word.split(",")
    if len(numbers) != 2 or not all(number.isascii() and number.isdigit() and len(number) < 10 for number in numbers):
        raise ValueError(f"{plain(word)!r} is not two faces, such as 0,3")
    return tuple(map(int, numbers))


def _own_column(word: str) -> tuple[str, Callable[[Any], Any]]:
    """Return the name and the function of a column, ``NAME=MODULE:FUNCTION``."""
    name, equals, place = word.partition("=")
    module, colon, function = place.partition(":")
    if not (equals and colon and name.isidentifier() and function):
        raise ValueError(f"{plain(word)!r} is not NAME=MODULE:FUNCTION, such as edges=mine:edges")
    if "" not in sys.path:
        sys.path.insert(0, "")
    try:
        found = getattr(import_module(module), function)
    except (ImportError, AttributeError, ValueError) as error:
        raise ValueError(f"{plain(place)!r} cannot be imported: {plain(error, 300)}") from None
    if not callable(found):
        raise ValueError(f"{plain(place)!r} is not a function")
    return name, found


@click.group("atlas")
def atlas_group() -> None:
    """Build an atlas of types, and query it.

    \b
    Examples:
      synth atlas build -o atlas.sqlite --max-links 8
      synth atlas query atlas.sqlite "links = 8 AND dof = 1 AND centres >= 3 AND all_explicit"
      synth atlas show atlas.sqlite "Watt chain"
      synth atlas find atlas.sqlite data/wiener/fortune-teller.json
      synth atlas motions atlas.sqlite --members 1000
      synth atlas like data/orientations/tipparthi.json atlas.sqlite
    """


@atlas_group.command(short_help="Build an atlas in one file.")
@options.value("--max-links", "N", "Largest number of links of SC and SCD graphs.", default=8, type=int)
@options.repeated("--dof dofs", "M", "Degrees of freedom, 1 by default; may be repeated.", default=(1,), type=int)
@options.value("--max-degree", "D", "Largest number of sides of a link.", default=4, type=int)
@options.value("--chain-links", "N", "Largest number of links of chains. By default that of --max-links.", type=int)
@options.value("--creases", "N", "Largest number of creases of R/- strings; 0 leaves strings out.", default=6, type=int)
@options.repeated(
    "--orders-of", "CHAIN",
    "Chain (a name or an id k1:...) whose joints are placed round a cone in every order; none leaves conical "
    "orders out. May be repeated.", default=("watt", "stephenson"), show_default=True)  # fmt: skip
@options.value("--spatial", "S", "Include hybrids of 1 to S spatial loops.", default=0, type=int)
@options.flag("--infinite", "Include centres at infinity.")
@options.flag("--realise/--no-realise realised", "Realise the types, and fold them.", default=True)
@partial(runner_options, counting=True, output=options.output("Atlas to write.", "FILE.sqlite"))
def build(orders_of: tuple[str, ...], running: RunOptions, **types: Any) -> None:
    """Build an atlas of chains, SC and SCD graphs, strings and conical orders, with their properties, in one file.

    Continue a stopped build with --resume. For the columns, see `synth atlas query ATLAS.sqlite --columns help`.
    """
    from synth.synthesis.atlas.building import AtlasJob, AtlasSink

    if running.output is None:
        raise click.UsageError("an atlas requires -o FILE.sqlite")
    orders = tuple(name for name in orders_of if name != "none")
    plan = synth.synthesis.atlas.AtlasPlan(orders_of=orders, **types)
    sink = partial(AtlasSink, running.output, plan.command, resume=running.resume, force=running.force)
    run_resumable(AtlasJob(plan), sink, running)
    summary = synth.synthesis.atlas.open_atlas(str(running.output)).about()
    if running.as_json:
        out.print_json({"output": running.output, **summary})
        return
    for kind, number in summary["types"].items():
        click.echo(f"{number:>9}  {kind}")
    out.tell_written(running.output)


@atlas_group.command()
@_ATLAS
@click.argument("condition", required=False, default="")
@options.value("--sql statement", "SELECT", "SQL statement to use instead of a condition.")
@options.value("--columns", "A,B,...", "Columns to show; `help` lists all of them.")
@options.repeated(
    "--column own", "NAME=MODULE:FUNCTION",
    "Add a column of your own: a Python function of the mechanism of a row; may be repeated. MODULE is found in the "
    "current folder too.", type=options.WordType("column", _own_column),
)  # fmt: skip
@options.value(
    "--sort", "[-]COLUMN", "Sort by a column; a leading - sorts in descending order.",
    default="", show_default=False,
)  # fmt: skip
@options.number("--limit", "N", "Largest number of rows.", default=1000)
@options.value(
    "--seconds", "SECONDS", "Time limit in seconds.", default=30.0, type=click.FloatRange(min=0, min_open=True)
)
@options.output("Write .csv, .json, .jsonl, .parquet, .tex, a picture (.svg, .png, .pdf), or a folder of mechanisms.")
@options.FORCE
@options.JSON
def query(
    atlas: str, condition: str, statement: str | None, columns: str | None, output: str | None, force: bool,
    as_json: bool, sort: str, limit: int, seconds: float, own: tuple[tuple[str, Callable[[Any], Any]], ...],
) -> None:  # fmt: skip
    """List the types that fulfil a condition, an SQL expression on columns.

    Texts stand in single quotes, lists are JSON. As in SQL, a type without a value fulfils only IS NULL.

    \b
    Examples of conditions:
      links = 8 AND dof = 1 AND centres >= 3 AND all_explicit
      kind = 'scd' AND links BETWEEN 4 AND 6 AND fold_deg > 170
      assortment = '[4,2]' OR name LIKE '%watt%'
      5 IN (SELECT value FROM json_each(loop_sizes)) AND NOT symmetry = 1
      kind IN ('sc', 'scd') AND ride_alongs IS NOT NULL

    \b
    A column of your own, written for LaTeX:
      synth atlas query ATLAS.sqlite "kind = 'chain'" --columns id,kind,name --column edges=mine:edges -o chains.tex
    """
    if columns == "help":
        meanings = [
            (name, " ".join(column.kinds), column.says) for name, column in synth.synthesis.atlas.COLUMNS.items()
        ]
        out.console().print(TableBlock(("column", "kinds", "meaning"), meanings))
        return
    if statement is not None and (condition or columns or sort):
        raise click.UsageError("--sql excludes a condition, --columns and --sort")
    if output is not None and as_json:
        raise click.UsageError("-o and --json exclude each other; try one of them")
    out.check_output(output if output is None or Path(output).suffix else None, force=force)
    opened = synth.synthesis.atlas.open_atlas(atlas)
    if statement is not None:
        rows = opened.sql(statement, limit=limit, seconds=seconds)
    else:
        names = [name.strip() for name in columns.split(",")] if columns else []
        rows = opened.query(condition, columns=names, sort=sort, limit=limit, seconds=seconds)
    if own:
        rows = rows.with_columns(dict(own))
    if output is not None:
        from synth.synthesis.atlas.export import write_rows

        out.tell_written(*write_rows(rows, output, force=force))
    elif as_json:
        out.print_json(rows.to_json())
    else:
        out.console().print(rows.blocks()[0])
    if rows.more:
        click.echo(f"more than {numbered(len(rows), 'row')}; try a larger --limit", err=True)


@atlas_group.command()
@_ATLAS
@click.argument("type_id", metavar="ID")
@options.output("Write the realised type to this file.", "FILE.fold")
@options.FORCE
@options.JSON
def show(atlas: str, type_id: str, output: str | None, force: bool, as_json: bool) -> None:
    """Show the properties of a type.

    ID is an id or a name, such as "Watt chain". The types related to it are listed too.
    """
    out.check_output(output, force=force)
    report = synth.synthesis.atlas.open_atlas(atlas).show(type_id)
    if output is not None:
        from graphs.files.atomic import write_text
        from synth.synthesis.atlas.export import sheet_of_type

        text = report.values.get("fold_file")
        if text is None:
            raise UnsolvableError(f"{out.plain(type_id)}: the atlas has no coordinates of this type")
        sheet_of_type(report.values)  # raises an error for a damaged file, which is not written
        write_text(Path(output), text, force=force)
    out.print_result(report, {}, as_json=as_json, written=[output])


@atlas_group.command(short_help="Write a site, with one page per type.")
@_ATLAS
@click.argument("condition", required=False, default="")
@options.output("New folder to write the site to.", "FOLDER", "-o --output folder", required=True)
@options.value("--title", None, "Title of the site.", default="", show_default=False)
@options.WORKERS
@options.flag("--quiet", "Show no progress.")
def page(atlas: str, condition: str, folder: str, title: str, workers: int | None, quiet: bool) -> None:
    """Write a site to search, filter and sort types, with one page per type: its drawing, and a model that folds.

    The site needs no server and no network: open index.html. CONDITION is that of `synth atlas query`.
    """
    from synth.synthesis.atlas.site_pages import SiteSink, site_of

    site, first = site_of(synth.synthesis.atlas.open_atlas(atlas), condition, title)
    run_whole(site, SiteSink(folder, first), RunOptions(folder, workers, quiet=quiet))
    out.tell_written(Path(folder) / "index.html")


@atlas_group.command()
@_ATLAS
@options.FILES
@options.JSON
def find(atlas: str, files: tuple[str, ...], as_json: bool) -> None:
    """Find the types of mechanisms in the atlas.

    The types one edit away are listed too.
    """
    opened = synth.synthesis.atlas.open_atlas(atlas)
    failures: list[str] = []
    answers = []
    for entry in entries(files, failures):
        with out.about(entry.label):
            answer = synth.synthesis.atlas.find_type(opened, entry.mechanism)
        answers.append({"file": entry.label, **answer.to_json()})
        if not as_json:
            click.echo(out.plain(entry.label, 4096))
            out.print_answer(answer)
    if as_json:
        out.print_json(answers)
    for failure in failures:
        click.echo(failure, err=True)
    if failures:
        click.get_current_context().exit(2)


@atlas_group.command(short_help="Add motions of random members, for `synth atlas like`.")
@_ATLAS
@options.number("--members", "N", "Number of random members of each chain.", most=10_000_000, default=1000)
@options.number("--max-links", "N", "Largest number of links of a chain.", 4, default=8)
@options.number("--seed", "N", "Random seed; another seed gives other members.", 0, default=0)
@options.flag("--force", "Replace the motions of another seed or version.")
@options.JSON
def motions(atlas: str, members: int, max_links: int, seed: int, force: bool, as_json: bool) -> None:
    """Add the motions of random members of each chain with 1 degree of freedom to an atlas.

    Each member is a spherical linkage with random axes; its circuit is traced, and 64 numbers are stored for each
    pair of links without a common joint, and for the path of a point of each of them. A run that was stopped goes on
    where it was; a larger --members adds members.

    \b
    Example:
      synth atlas motions atlas.sqlite --members 1000
    """
    from synth.synthesis.atlas.motions import planned_motions

    opened = synth.synthesis.atlas.open_atlas(atlas)
    size = planned_motions(opened, members, max_links=max_links)
    click.echo(f"tracing {size.blocks()[0]} in the file, at most 300 MB of memory", err=True)
    with out.progress_line() as show:
        table = synth.synthesis.atlas.add_motions(
            opened, members=members, max_links=max_links, seed=seed, force=force,
            report=lambda done: show(f"{done} of {size.members} members"),
        )  # fmt: skip
    out.print_result(table, {"atlas": atlas}, as_json=as_json)


@atlas_group.command(short_help="Find the members that move like a motion.")
@click.argument("motion", metavar="MOTION", type=options.FILE_NAME)
@_ATLAS
@options.value(
    "--links", "A,B", "Faces, numbered from 0, whose motion against each other is compared; required for a .fold file.",
    type=options.WordType("faces", _faces), default=(), show_default=False,
)  # fmt: skip
@options.flag(
    "--closed/--open closed",
    "Whether the motion is a whole circuit or an arc. By default it is a circuit if it ends where it begins.",
)
@options.flag(
    "--sparse/--dense sparse",
    "Whether rows are single orientations or points that one circuit is to pass in order, and not frames of a motion. "
    "By default they are if there are fewer than 12, and neither --closed nor --open is stated.",
)
@options.number("--best", "K", "Largest number of members to list.", most=32, default=10)
@options.number(
    "--fit", "K", "Number of members whose axes are changed until they move more like the motion.", 0, 1024, default=0
)
@options.output("Write the nearest member as a linkage about a centre, a start for `synth design`.", "OUT.json")
@options.FORCE
@options.JSON
def like(
    motion: str, atlas: str, links: tuple[int, ...], closed: bool | None, sparse: bool | None, best: int, fit: int,
    output: str | None, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Find the members of an atlas in which two links move most like a motion, or a point most along a path.

    MOTION is a FOLD file with frames, orientations (docs/native-json.md), or a table (.csv) with 3 numbers in a row
    (a point of a sphere), 4 (a quaternion, scalar first: one link in the frame of the other) or 8 (quaternions of
    both links). Frames of reference, direction and speed have no meaning, nor has the order of the links. An arc is
    found in circuits up to three times as long. A few orientations or points say nothing of the motion between them:
    members are compared by how near one circuit of theirs comes to all of them in order. With --fit members come
    nearer by least squares: random ones are some degrees off. The atlas requires a table of motions: `synth atlas
    motions`.

    \b
    Examples:
      synth atlas like data/orientations/tipparthi.json atlas.sqlite
      synth atlas like folded.fold atlas.sqlite --links 0,2 --fit 64 -o start.json
    """
    from synth.synthesis.atlas.motions import stored_motions

    out.check_output(output, force=force)
    opened = synth.synthesis.atlas.open_atlas(atlas)
    size = stored_motions(opened)
    click.echo(f"searching {size.blocks()[0]} in the file, at most 300 MB of memory", err=True)
    answer = synth.synthesis.atlas.like(opened, motion, links=links, closed=closed, sparse=sparse, limit=best, fit=fit)
    if output is not None:
        if not answer.rows:
            raise UnsolvableError("-o requires a member that moves so far, and the atlas has none")
        from graphs.files.formats import write

        write(answer.rows[0].linkage, output, force=force)
    out.print_result(answer, {"file": motion, "output": output}, as_json=as_json, written=[output])
