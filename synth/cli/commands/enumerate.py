"""``synth enumerate``: all mechanisms of a kind."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from itertools import chain, islice
from typing import TYPE_CHECKING, Any

import click

from synth.cli.commands.conical import conical
from synth.cli.options import FORCE, LimitsType
from synth.cli.output import about, console, plain, print_json, table, tell_written
from synth.cli.runner import RunOptions, check_method, run_count, run_rows, runner_options

if TYPE_CHECKING:
    from enumerate.runner.job import Limits
    from enumerate.scd.query import Mechanisms

__all__ = ["enumerate_group"]


_MOST_IN_TABLE = 1000


def _limit(_context: click.Context, _parameter: click.Parameter, value: str) -> int | None:
    """Read a limit: a number, or ``none``."""
    if value.lower() == "none":
        return None
    if not value.isascii() or not value.isdigit() or len(value) > 6:
        raise click.BadParameter(f"{plain(value)!r} is neither a number nor none")
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
    "--max-panels", default="2", callback=_limit, metavar="K", show_default=True,
    help="Largest number of panels; none for no limit.",
)  # fmt: skip
@click.option(
    "--max-cluster", default="3", callback=_limit, metavar="K", show_default=True,
    help="Largest number of creases that meet in one point; none for no limit.",
)  # fmt: skip
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
        raise click.UsageError("--dof and --max-dof exclude each other; try one of them")
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

    from graphs.files.atomic import write_chunks
    from graphs.files.outputs import unknown_extension

    if not output.endswith(".jsonl"):
        raise unknown_extension(output, [".jsonl"])
    write_chunks(Path(output), (json.dumps(row) + "\n" for row in rows), force=force)


def _print(rows: Iterator[dict[str, Any]], modes: bool) -> None:
    """Print a table, or lines with tabs if there are too many rows for one."""
    columns = ["creases", "string", "joints", "distance", "dof", "modes", *(["mode"] if modes else []), "comment"]
    first = list(islice(rows, _MOST_IN_TABLE + 1))
    if len(first) > _MOST_IN_TABLE:
        click.echo("\t".join(columns))
        for row in chain(first, rows):
            click.echo("\t".join(str(row[column]) for column in columns))
        return
    shown = table(*columns, numbers=["creases", "dof", "modes"])
    for row in first:
        shown.add_row(*(plain(row[column], 200) if row[column] != "" else "" for column in columns))
    console().print(shown)


def _assortment(_context: click.Context, _parameter: click.Parameter, value: str | None) -> tuple[int, ...] | None:
    """Read numbers of binary, ternary, ... links."""
    if value is None:
        return None
    parts = value.split(",")
    if not all(part.isascii() and part.isdigit() and len(part) < 6 for part in parts):
        raise click.BadParameter(
            f"{plain(value)!r} is not a list of numbers such as 4,2 (of binary, ternary, ... links)"
        )
    return tuple(map(int, parts))


_LINKS = click.option("--links", type=click.IntRange(min=4), required=True, metavar="N", help="Number of links.")
_DOF = click.option("--dof", type=click.IntRange(min=1), required=True, metavar="M", help="Degrees of freedom.")
_ASSORTMENT = click.option(
    "--assortment", callback=_assortment, metavar="4,2", help="Numbers of binary, ternary, ... links."
)
_LONGEST_STRING = click.option(
    "--longest-string", type=LimitsType(), metavar="K",
    help="Length of the longest row of binary links, as a number or range: 2, 1..2, 2.. or ..3.",
)  # fmt: skip
_SPATIAL = click.option(
    "--spatial", type=click.IntRange(min=0), default=0, metavar="S",
    help="Number of spatial loops, 0 by default; with more, the results are hybrids.",
)  # fmt: skip
_INFINITE = click.option("--infinite", is_flag=True, help="Include centres at infinity (planar loops).")
_COUNT = click.option("--count", "only_count", is_flag=True, help="Print only the number, by the fastest method.")


def _method_option(*methods: str) -> Callable[..., Any]:
    """Return the option that chooses a counting method; the first is the default."""
    return click.option(
        "--method", type=click.Choice(methods), help="Counting method for --count; both give the same number."
    )


@click.command(short_help="List or count kinematic chains without rigid sub-chains.")
@_LINKS
@_DOF
@click.option(
    "--fractionated", is_flag=True, help="Include fractionated chains, which one link or one joint cuts in two."
)
@click.option("--inversions", is_flag=True, help="List kinematic inversions: one row per distinct ground link.")
@click.option(
    "--inputs", is_flag=True, help="List one row per distinct choice of a ground link and M input joints."
)
@_ASSORTMENT
@click.option("--planar/--nonplanar", default=None, help="List only planar, or only nonplanar, chains.")
@_LONGEST_STRING
@click.option(
    "--symmetry", type=LimitsType(), metavar="K",
    help="Number of automorphisms, as a number or range: 1, 2.. or 2..8.",
)  # fmt: skip
@_COUNT
@_method_option("orbits", "burnside")
@runner_options
def chains(
    links: int,
    dof: int,
    only_count: bool,
    method: str | None,
    longest_string: Limits | None,
    symmetry: Limits | None,
    **rest: Any,
) -> None:
    """List or count all kinematic chains of N links and M degrees of freedom.

    Chains are link-joint graphs with single joints in which no part is rigid; isomorphic chains are listed once.
    The id of a chain depends on nothing but the chain.

    \b
    Examples:
      synth enumerate chains --links 8 --dof 1
      synth enumerate chains --links 14 --dof 1 --count
      synth enumerate chains --links 10 --dof 1 --planar --symmetry 2.. -o symmetric.jsonl
      synth enumerate chains --links 16 --dof 1 -o chains.sqlite
      synth enumerate chains --links 16 --dof 1 -o chains.sqlite --resume
      synth enumerate chains --links 18 --dof 1 --count -o counted.sqlite --resume
    """
    options = RunOptions.taken_from(rest, counting=only_count)
    check_method(method, only_count)
    from enumerate.chains.jobs import ChainJob, count_job
    from enumerate.chains.query import ChainQuery
    from enumerate.runner.job import ANY_NUMBER, ONE_OR_MORE

    query = ChainQuery(
        links, dof, **rest, longest_string=longest_string or ANY_NUMBER, symmetry=symmetry or ONE_OR_MORE
    )
    _say_if_odd(links, dof)
    if only_count:
        run_count(count_job(query, method or "orbits", options.kept_job()), options)
    else:
        graph6 = options.output is not None and options.output.lower().endswith(".g6")
        run_rows(ChainJob(query, bare=graph6 and not (query.inversions or query.inputs)), options)


def _say_if_odd(links: int, dof: int, spatial: int = 0) -> None:
    """Say on standard error that there are no mechanisms of a size if its parity excludes them."""
    if (links - 1 - dof - 3 * spatial) % 2:
        freedoms = "M + 3 S" if spatial else "M"
        click.echo(
            f"{links} links with M = {dof}: none; N - 1 and {freedoms} must be both even or both odd", err=True
        )


@click.command(short_help="List or count SC graphs: planar chains drawn on the sphere, with centres.")
@_LINKS
@_DOF
@click.option(
    "--centres", type=LimitsType(), metavar="K",
    help="Number of distinct centres, as a number or range: 2, 1..2 or 2..",
)  # fmt: skip
@_SPATIAL
@_INFINITE
@click.option(
    "--symmetry", type=LimitsType(), metavar="K",
    help="Number of symmetries, as a number or range: 1, 2.. or 2..4.",
)  # fmt: skip
@_ASSORTMENT
@_LONGEST_STRING
@click.option(
    "--per-chain", is_flag=True, help="List one row per chain: its most general form, with the most centres."
)
@click.option(
    "--embeddings", is_flag=True,
    help="With --count, count embeddings in the sphere, without a choice of the outer face.",
)  # fmt: skip
@_COUNT
@_method_option("orbits", "burnside")
@runner_options
def sc(
    links: int,
    dof: int,
    only_count: bool,
    per_chain: bool,
    embeddings: bool,
    method: str | None,
    centres: Limits | None,
    symmetry: Limits | None,
    longest_string: Limits | None,
    **rest: Any,
) -> None:
    """List or count all SC graphs of N links and M degrees of freedom.

    An SC graph is a planar kinematic chain drawn on the sphere, with one outer face; each other face is a loop
    with a centre, shared with another loop only if their joints force it (Wiener, 3.3). Mirror images count once.
    With --spatial, some loops have no centre: hybrids that by their exact rank are mechanisms in which every joint
    moves.

    \b
    Examples:
      synth enumerate sc --links 6 --dof 1
      synth enumerate sc --links 8 --dof 1 --centres 3 --json
      synth enumerate sc --links 6 --dof 1 --per-chain
      synth enumerate sc --links 12 --dof 1 --count
      synth enumerate sc --links 9 --dof 1 --spatial 1 -o hybrids
      synth enumerate sc --links 12 --dof 1 -o sc.sqlite
    """
    options = RunOptions.taken_from(rest, counting=only_count)
    if not only_count and (method is not None or embeddings):
        raise click.UsageError("--method and --embeddings require --count")
    from enumerate.runner.job import ANY_NUMBER, ONE_OR_MORE
    from enumerate.sc.jobs import FormJob, SCJob, sc_count_job
    from enumerate.sc.query import SCQuery

    query = SCQuery(
        links,
        dof,
        **rest,
        centres=centres or ANY_NUMBER,
        symmetry=symmetry or ONE_OR_MORE,
        longest_string=longest_string or ANY_NUMBER,
    )
    _say_if_odd(links, dof, query.spatial)
    if only_count and per_chain:
        raise click.UsageError("--count counts SC graphs; try `synth enumerate chains --planar --count`")
    if only_count:
        run_count(sc_count_job(query, method or "orbits", outside=not embeddings), options)
    else:
        run_rows(FormJob(query) if per_chain else SCJob(query), options)


@click.command(short_help="List or count SCD graphs: mechanisms with all sides of their links.")
@click.option("--links", type=click.IntRange(min=2), metavar="N", help="Number of links.")
@click.option(
    "--dof", type=click.IntRange(min=1), metavar="M", help="Degrees of freedom; N - 1 gives open chains."
)
@click.option("--of", "file", metavar="FILE", help="File of an SC or SCD graph: list only its SCD graphs.")
@click.option(
    "--max-degree", type=click.IntRange(min=3), required=True, metavar="D",
    help="Largest number of sides of a link.",
)  # fmt: skip
@_SPATIAL
@_INFINITE
@click.option("--all-explicit", "sheets", is_flag=True, help="List only single sheets without holes.")
@click.option("--symmetric", is_flag=True, help="List only SCD graphs with a symmetry.")
@click.option(
    "--vertices", type=LimitsType(), metavar="K",
    help="Number of vertices of the polyhedron model, as a number or range: 8, 6..8 or ..8.",
)  # fmt: skip
@_COUNT
@_method_option("burnside", "orbits")
@runner_options
def scd(
    links: int | None,
    dof: int | None,
    file: str | None,
    max_degree: int,
    spatial: int,
    infinite: bool,
    vertices: Limits | None,
    only_count: bool,
    method: str | None,
    **rest: Any,
) -> None:
    """List or count all SCD graphs of N links and M degrees of freedom.

    An SCD graph is an SC graph with all sides of its links: joints and open edges (Wiener, 3.4). The list has all
    placements of open edges, with 3 to D sides per link, that obey the rules and have exact mobility M; mirror
    images count once. M = N - 1 gives open chains.

    \b
    Examples:
      synth enumerate scd --links 4 --dof 1 --max-degree 4
      synth enumerate scd --links 8 --dof 1 --max-degree 5 --count
      synth enumerate scd --links 4 --dof 3 --max-degree 3
      synth enumerate scd --of data/wiener/watt.json --max-degree 4 --all-explicit
      synth enumerate scd --links 10 --dof 1 --max-degree 4 -o scd.sqlite
    """
    options = RunOptions.taken_from(rest, counting=only_count)
    check_method(method, only_count)
    from enumerate.runner.job import ANY_NUMBER
    from enumerate.scd.jobs import SCDJob, scd_count_job

    filters = {**rest, "vertices": vertices or ANY_NUMBER}
    mechanisms: Mechanisms
    if file is not None:
        if links is not None or dof is not None or spatial or infinite:
            raise click.UsageError("--of excludes --links, --dof, --spatial and --infinite")
        mechanisms = _of_file(file, max_degree, filters)
    elif links is None or dof is None:
        raise click.UsageError("expected --links and --dof, or --of FILE")
    else:
        from enumerate.scd.jobs import all_mechanisms

        mechanisms = all_mechanisms(links, dof, max_degree, spatial=spatial, infinite=infinite, **filters)
        if not mechanisms.tree:
            _say_if_odd(links, dof, spatial)
    if only_count:
        run_count(scd_count_job(mechanisms, method), options)
    else:
        run_rows(SCDJob(mechanisms), options)


def _of_file(file: str, max_degree: int, filters: dict[str, Any]) -> Mechanisms:
    from enumerate.scd.jobs import mechanism_of
    from graphs.convert.table import graph_of
    from graphs.files.formats import read

    mechanism = read(file)
    with about(file):
        return mechanism_of(graph_of(mechanism), max_degree, **filters)


@click.command(short_help="List all ways to add a loop to a mechanism.")
@click.option("--of", "file", required=True, metavar="FILE", help="File of the mechanism.")
@click.option(
    "--delta-dof", type=click.IntRange(min=-2), default=0, show_default=True, metavar="K",
    help="Change of mobility.",
)  # fmt: skip
@click.option("--count", "only_count", is_flag=True, help="Print only the number.")
@runner_options
def addenda(file: str, delta_dof: int, only_count: bool, **rest: Any) -> None:
    """List all ways to add a ride-along, an RR dyad, a spherical or a spatial loop to a mechanism (Wiener, 4.2).

    A chain of K + 2 new links (K + 5 in a spatial loop) is added between two links, so that the mobility changes
    by K and the original mechanism stays generic; the exact rank confirms each. Results that a symmetry of the
    mechanism exchanges are listed once. An output folder gets one file per result.

    \b
    Examples:
      synth enumerate addenda --of data/wiener/watt.json
      synth enumerate addenda --of data/wiener/watt.json --delta-dof 1 -o addenda
    """
    options = RunOptions.taken_from(rest, counting=only_count)
    from enumerate.addenda import AddendumJob, addendum_count_job
    from graphs.convert.table import graph_of
    from graphs.files.formats import read

    mechanism = read(file)
    with about(file):
        job = AddendumJob(graph_of(mechanism), delta_dof)
    if only_count:
        run_count(addendum_count_job(job), options)
    else:
        run_rows(job, options)


@click.group("enumerate", short_help="List or count all mechanisms of a kind.")
def enumerate_group() -> None:
    """List or count all mechanisms of a kind.

    \b
    Examples:
      synth enumerate strings --max-dof 6
      synth enumerate chains --links 8 --dof 1
      synth enumerate sc --links 8 --dof 1 --centres 3
      synth enumerate scd --links 4 --dof 1 --max-degree 4
      synth enumerate conical --chain watt
    """


for _command in (strings, chains, sc, scd, addenda, conical):
    enumerate_group.add_command(_command)
