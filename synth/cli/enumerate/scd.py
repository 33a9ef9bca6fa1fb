"""``synth enumerate scd``: SCD graphs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from synth.cli.enumerate.chains import say_if_odd
from synth.cli.output import about
from synth.cli.runner import LimitsType, RunOptions, run_count, run_rows, runner_options

if TYPE_CHECKING:
    from enumerate.runner.job import Limits
    from enumerate.scd.jobs import Mechanisms

__all__ = ["scd"]


@click.command(short_help="List or count SCD graphs: mechanisms with all sides of their links.")
@click.option("--links", type=click.IntRange(min=2), metavar="N", help="Number of links.")
@click.option(
    "--dof", type=click.IntRange(min=1), metavar="M", help="Degrees of freedom; N - 1 gives open chains."
)
@click.option("--of", "file", metavar="FILE", help="File of an SC or SCD graph: list only its SCD graphs.")
@click.option(
    "--max-degree",
    type=click.IntRange(min=3),
    required=True,
    metavar="D",
    help="Largest number of sides of a link.",
)
@click.option(
    "--spatial",
    type=click.IntRange(min=0),
    default=0,
    metavar="S",
    help="Number of spatial loops, 0 by default; with more, the results are hybrids.",
)
@click.option("--infinite", is_flag=True, help="Include centres at infinity (planar loops).")
@click.option("--all-explicit", "sheets", is_flag=True, help="List only single sheets without holes.")
@click.option("--symmetric", is_flag=True, help="List only SCD graphs with a symmetry.")
@click.option(
    "--vertices",
    type=LimitsType(),
    metavar="K",
    help="Number of vertices of the polyhedron model, as a number or range: 8, 6..8 or ..8.",
)
@click.option("--count", "only_count", is_flag=True, help="Print only the number, by the fastest method.")
@click.option(
    "--method",
    type=click.Choice(["burnside", "orbits"]),
    help="Counting method for --count; both give the same number.",
)
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
    if method is not None and not only_count:
        raise click.UsageError("--method says how --count counts; add --count")
    from enumerate.runner.job import ANY_NUMBER
    from enumerate.scd.jobs import SCDJob, scd_count_job

    filters = {**rest, "vertices": vertices or ANY_NUMBER}
    mechanisms: Mechanisms
    if file is not None:
        if links is not None or dof is not None or spatial or infinite:
            raise click.UsageError("give --of, or --links and --dof with --spatial and --infinite")
        mechanisms = _of_file(file, max_degree, filters)
    elif links is None or dof is None:
        raise click.UsageError("give --links and --dof, or --of FILE")
    else:
        from enumerate.scd.jobs import all_mechanisms

        mechanisms = all_mechanisms(links, dof, max_degree, spatial=spatial, infinite=infinite, **filters)
        if not mechanisms.query.tree:
            say_if_odd(links, dof, spatial)
    if only_count:
        run_count(scd_count_job(mechanisms, method), options)
    else:
        run_rows(SCDJob(mechanisms), options)


def _of_file(file: str, max_degree: int, filters: dict[str, Any]) -> Mechanisms:
    from enumerate.scd.jobs import mechanism_of
    from graphs.convert.table import graph_of
    from graphs.files.formats import read

    thing = read(file)
    with about(file):
        return mechanism_of(graph_of(thing), max_degree, **filters)
