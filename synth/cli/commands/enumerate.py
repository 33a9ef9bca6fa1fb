"""``synth enumerate``: all mechanisms of a kind."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

import graphs.files
import synth
from synth.cli import options
from synth.cli.commands.conical import conical
from synth.cli.output import about, plain, print_json, tell_written
from synth.cli.runner import RunOptions, TablePrinter, check_method, run_count, run_rows, runner_options

if TYPE_CHECKING:
    from enumerate.scd.query import Mechanisms
    from enumerate.strings import ChainString

_COLUMNS: dict[str, type] = {
    "creases": int, "string": str, "joints": str, "distance": str, "dof": int, "modes": int, "mode": str,
    "comment": str,
}  # fmt: skip
"""Columns of the table of R/- strings; ``mode`` with --modes only."""


def _limit(word: str) -> int | None:
    """Read a limit: a number, or ``none``."""
    if word.lower() == "none":
        return None
    if not word.isascii() or not word.isdigit() or len(word) > 6:
        raise ValueError(f"{plain(word)!r} is neither a number nor none")
    return int(word)


_LIMIT = options.WordType("limit", _limit)


@click.command(short_help="List or count R/- strings: chains of panels between two bodies.")
@options.number("--dof", "N", "Number of creases.")
@options.number("--max-dof", "N", "Largest number of creases. By default 6.")
@options.flag("--modes", "List one row per mode: vertices on the same side (S) or on a diagonal (D).")
@options.value("--max-panels", "K", "Largest number of panels; none for no limit.", default="2", type=_LIMIT)
@options.value(
    "--max-cluster", "K", "Largest number of creases that meet in one point; none for no limit.",
    default="3", type=_LIMIT,
)  # fmt: skip
@options.flag("--count only_count", "Print only the number, by generating functions.")
@options.output("Write one JSON object per line.", "FILE.jsonl")
@options.FORCE
@options.flag("--quiet", "Do not show the name of the written file.")
@options.flag("--json as_json", "Print a JSON list.")
def strings(
    dof: int | None, max_dof: int | None, modes: bool, max_panels: int | None, max_cluster: int | None,
    only_count: bool, output: str | None, force: bool, quiet: bool, as_json: bool,
) -> None:  # fmt: skip
    """List or count the R/- strings: open chains of panels, with their joint chains (Wiener, Table 8).

    R is a crease; creases written together meet in one point; - is a rectangular panel. With --modes each string
    is listed once per arrangement of its vertices (Table 7).

    \b
    Examples:
      synth enumerate strings
      synth enumerate strings --dof 6 --modes
      synth enumerate strings --dof 30 --max-panels none --count
    """
    from enumerate import strings as panels

    if dof is not None and max_dof is not None:
        raise click.UsageError("--dof and --max-dof exclude each other; try one of them")
    numbers = [dof] if dof is not None else list(range(1, (max_dof or 6) + 1))
    limits = {"max_panels": max_panels, "max_cluster": max_cluster}
    every = (string for creases in numbers for string in panels.strings(creases, **limits))
    if only_count:
        if modes:
            count = sum(string.count_modes() for string in every)
        else:
            count = sum(panels.count_strings(creases, **limits) for creases in numbers)
        if as_json:
            print_json({"count": count})
        else:
            click.echo(count)
        return
    rows = _rows(every, modes)
    if output is not None:
        from graphs.files.atomic import write_chunks
        from graphs.files.outputs import unknown_extension

        if not output.endswith(".jsonl"):
            raise unknown_extension(output, [".jsonl"])
        write_chunks(Path(output), (json.dumps(row) + "\n" for row in rows), force=force)
        tell_written(None if quiet else output)
    elif as_json:
        print_json(list(rows))
    else:
        columns = {name: kind for name, kind in _COLUMNS.items() if modes or name != "mode"}
        printer = TablePrinter(columns)
        for row in rows:
            printer.take((), [tuple(row[name] for name in columns)])
        printer.finish()


def _rows(every: Iterator[ChainString], modes: bool) -> Iterator[dict[str, Any]]:
    """Yield a row for each string, or for each of its modes."""
    for string in every:
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


def _assortment(word: str) -> tuple[int, ...]:
    """Read numbers of binary, ternary, ... links."""
    parts = word.split(",")
    if not all(part.isascii() and part.isdigit() and len(part) < 6 for part in parts):
        raise ValueError(f"{plain(word)!r} is not a list of numbers such as 4,2 (of binary, ternary, ... links)")
    return tuple(map(int, parts))


_LINKS = options.number("--links", "N", "Number of links.", 4, required=True)
_DOF = options.number("--dof", "M", "Degrees of freedom.", default=1)
_ASSORTMENT = options.value(
    "--assortment", "4,2", "Numbers of binary, ternary, ... links.",
    type=options.WordType("assortment", _assortment),
)  # fmt: skip
_LONGEST_STRING = options.limits(
    "--longest-string", "Length of the longest row of binary links, as a number or range: 2, 1..2, 2.. or ..3."
)
_SPATIAL = options.number(
    "--spatial", "S", "Number of spatial loops; with one or more, the results are hybrids.", 0, default=0
)
_INFINITE = options.flag("--infinite", "Include centres at infinity (planar loops).")
_COUNT = options.flag("--count only_count", "Print only the number, by the fastest method.")


def _counted(*methods: str) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Return what adds the options for counting, and those of the runner."""
    method = options.choice("--method", methods, "Counting method for --count; both give the same number.")
    return lambda command: _COUNT(method(runner_options(command)))


@click.command(short_help="List or count kinematic chains without rigid sub-chains.")
@_LINKS
@_DOF
@options.flag("--fractionated", "Include fractionated chains, which one link or one joint cuts in two.")
@options.flag("--inversions", "List kinematic inversions: one row per distinct ground link.")
@options.flag("--inputs", "List one row per distinct choice of a ground link and M input joints.")
@_ASSORTMENT
@options.flag("--planar/--nonplanar", "List only planar, or only nonplanar, chains.")
@_LONGEST_STRING
@options.limits("--symmetry", "Number of automorphisms, as a number or range: 1, 2.. or 2..8.")
@_counted("orbits", "burnside")
def chains(links: int, dof: int, only_count: bool, method: str | None, running: RunOptions, **properties: Any) -> None:
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
    check_method(method, only_count)
    from enumerate.chains.jobs import ChainJob, count_job
    from enumerate.chains.query import ChainQuery

    query = ChainQuery(links, dof, **options.stated_values(properties))
    _say_if_odd(links, dof)
    if only_count:
        run_count(count_job(query, method or "orbits", running.stored_job()), running)
    else:
        graph6 = running.output is not None and running.output.lower().endswith(".g6")
        run_rows(ChainJob(query, bare=graph6 and not (query.inversions or query.inputs)), running)


def _say_if_odd(links: int, dof: int, spatial: int = 0) -> None:
    """Say on standard error that there are no mechanisms of a size if its parity excludes them."""
    if (links - 1 - dof - 3 * spatial) % 2:
        freedoms = "M + 3 S" if spatial else "M"
        click.echo(f"{links} links with M = {dof}: none; N - 1 and {freedoms} must be both even or both odd", err=True)


@click.command(short_help="List or count SC graphs: planar chains drawn on the sphere, with centres.")
@_LINKS
@_DOF
@options.limits("--centres", "Number of distinct centres, as a number or range: 2, 1..2 or 2..")
@_SPATIAL
@_INFINITE
@options.limits("--symmetry", "Number of symmetries, as a number or range: 1, 2.. or 2..4.")
@_ASSORTMENT
@_LONGEST_STRING
@options.flag("--per-chain", "List one row per chain: its most general form, with the most centres.")
@options.flag("--embeddings", "With --count, count embeddings in the sphere, without a choice of the outer face.")
@_counted("orbits", "burnside")
def sc(
    links: int, dof: int, spatial: int, per_chain: bool, embeddings: bool, only_count: bool, method: str | None,
    running: RunOptions, **properties: Any,
) -> None:  # fmt: skip
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
    if not only_count and (method is not None or embeddings):
        raise click.UsageError("--method and --embeddings require --count")
    from enumerate.sc.jobs import FormJob, SCJob, sc_count_job
    from enumerate.sc.query import SCQuery

    query = SCQuery(links, dof, spatial, **options.stated_values(properties))
    _say_if_odd(links, dof, spatial)
    if only_count and per_chain:
        raise click.UsageError("--count counts SC graphs; try `synth enumerate chains --planar --count`")
    if only_count:
        run_count(sc_count_job(query, method or "orbits", outside=not embeddings), running)
    else:
        run_rows(FormJob(query) if per_chain else SCJob(query), running)


@click.command(short_help="List or count SCD graphs: mechanisms with all sides of their links.")
@options.number("--links", "N", "Number of links.", 2)
@options.number("--dof", "M", "Degrees of freedom, with --links; N - 1 gives open chains.  [default: 1]")
@options.value("--of file", "FILE", "File of an SC or SCD graph: list only its SCD graphs.", type=options.FILE_NAME)
@options.number("--max-degree", "D", "Largest number of sides of a link.", 3, default=4)
@_SPATIAL
@_INFINITE
@options.flag("--all-explicit sheets", "List only single sheets without holes.")
@options.flag("--symmetric", "List only SCD graphs with a symmetry.")
@options.limits("--vertices", "Number of vertices of the polyhedron model, as a number or range: 8, 6..8 or ..8.")
@_counted("burnside", "orbits")
def scd(
    links: int | None, dof: int | None, file: str | None, max_degree: int, spatial: int, infinite: bool,
    only_count: bool, method: str | None, running: RunOptions, **placements: Any,
) -> None:  # fmt: skip
    """List or count all SCD graphs of N links and M degrees of freedom.

    An SCD graph is an SC graph with all sides of its links: joints and open edges (Wiener, 3.4). The list has all
    placements of open edges, with 3 to D sides per link, that obey the rules and have exact mobility M; mirror
    images count once. M = N - 1 gives open chains.

    \b
    Examples:
      synth enumerate scd --links 4
      synth enumerate scd --links 8 --dof 1 --max-degree 5 --count
      synth enumerate scd --links 4 --dof 3 --max-degree 3
      synth enumerate scd --of data/wiener/watt.json --max-degree 4 --all-explicit
      synth enumerate scd --links 10 --dof 1 --max-degree 4 -o scd.sqlite
    """
    check_method(method, only_count)
    from enumerate.scd.jobs import SCDJob, all_mechanisms, mechanism_of, scd_count_job

    filters = options.stated_values(placements)
    mechanisms: Mechanisms
    if file is not None:
        if links is not None or dof is not None or spatial or infinite:
            raise click.UsageError("--of excludes --links, --dof, --spatial and --infinite")
        graph = _graph(file)
        with about(file):
            mechanisms = mechanism_of(graph, max_degree, **filters)
        for note in graph.notes:
            click.echo(f"note: {note}", err=True)
    elif links is None:
        raise click.UsageError("one of --links and --of FILE is required")
    else:
        dof = 1 if dof is None else dof
        mechanisms = all_mechanisms(links, dof, max_degree, spatial=spatial, infinite=infinite, **filters)
        if not mechanisms.tree:
            _say_if_odd(links, dof, spatial)
    if only_count:
        number = run_count(scd_count_job(mechanisms, method), running)
    else:
        number = run_rows(SCDJob(mechanisms), running)
    if file is not None and number == 0 and not running.resume:
        _say_why_none(mechanisms, max_degree)


def _say_why_none(mechanism: Mechanisms, max_degree: int) -> None:
    """Say on standard error for which number of sides a mechanism has SCD graphs, where it has none with so few."""
    from enumerate.scd.jobs import least_max_degree
    from enumerate.scd.query import OneMechanism

    assert isinstance(mechanism, OneMechanism)
    none = f"no SCD graph of it has links of up to {max_degree} sides"
    if not mechanism.placements.counted:  # symmetric ones, and vertices, are counted by making them only
        click.echo(f"{none} and meets the options; try a larger --max-degree", err=True)
        return
    least = least_max_degree(mechanism)
    more = f"--max-degree {least} is the least that has any" if least else "nor has any with more sides"
    click.echo(f"{none}; {more}", err=True)


def _graph(file: str) -> synth.SCGraph:
    from graphs.convert.conversions import graph_of

    mechanism = graphs.files.read(file)
    with about(file):
        return graph_of(mechanism)


@click.command(short_help="List all ways to add a loop to a mechanism.")
@options.value("--of file", "FILE", "File of the mechanism.", required=True, type=options.FILE_NAME)
@options.number("--delta-dof", "K", "Change of mobility.", -2, default=0)
@options.flag("--count only_count", "Print only the number.")
@runner_options
def addenda(file: str, delta_dof: int, only_count: bool, running: RunOptions) -> None:
    """List all ways to add a ride-along, an RR dyad, a spherical or a spatial loop to a mechanism (Wiener, 4.2).

    A chain of K + 2 new links (K + 5 in a spatial loop) is added between two links, so that the mobility changes
    by K and the original mechanism stays generic; the exact rank confirms each. Results that a symmetry of the
    mechanism exchanges are listed once. An output folder gets one file per result.

    \b
    Examples:
      synth enumerate addenda --of data/wiener/watt.json
      synth enumerate addenda --of data/wiener/watt.json --delta-dof 1 -o addenda
    """
    from enumerate.addenda import AddendumJob, addendum_count_job

    graph = _graph(file)
    with about(file):
        job = AddendumJob(graph, delta_dof)
    if only_count:
        run_count(addendum_count_job(job), running)
    else:
        run_rows(job, running)


@click.group("enumerate")
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
