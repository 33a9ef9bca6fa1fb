"""``synth enumerate sc``: SC graphs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from synth.cli.enumerate.chains import assortment, say_if_odd
from synth.cli.runner import LimitsType, RunOptions, run_count, run_rows, runner_options

if TYPE_CHECKING:
    from enumerate.runner.job import Limits

__all__ = ["sc"]


@click.command(short_help="List or count SC graphs: planar chains drawn on the sphere, with centres.")
@click.option("--links", type=click.IntRange(min=4), required=True, metavar="N", help="Number of links.")
@click.option("--dof", type=click.IntRange(min=1), required=True, metavar="M", help="Degrees of freedom.")
@click.option(
    "--centres",
    type=LimitsType(),
    metavar="K",
    help="Number of distinct centres, as a number or range: 2, 1..2 or 2..",
)
@click.option(
    "--spatial",
    type=click.IntRange(min=0),
    default=0,
    metavar="S",
    help="Number of spatial loops, 0 by default; with more, the results are hybrids.",
)
@click.option("--infinite", is_flag=True, help="Include centres at infinity (planar loops).")
@click.option(
    "--symmetry",
    type=LimitsType(),
    metavar="K",
    help="Number of symmetries, as a number or range: 1, 2.. or 2..4.",
)
@click.option("--assortment", callback=assortment, metavar="4,2", help="Numbers of binary, ternary, ... links.")
@click.option(
    "--longest-string",
    type=LimitsType(),
    metavar="K",
    help="Length of the longest row of binary links, as a number or range: 2, 1..2, 2.. or ..3.",
)
@click.option(
    "--per-chain", is_flag=True, help="List one row per chain: its most general form, with the most centres."
)
@click.option(
    "--embeddings",
    is_flag=True,
    help="With --count, count embeddings in the sphere, without a choice of the outer face.",
)
@click.option("--count", "only_count", is_flag=True, help="Print only the number, by the fastest method.")
@click.option(
    "--method",
    type=click.Choice(["orbits", "burnside"]),
    help="Counting method for --count; both give the same number.",
)
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
        raise click.UsageError("--method and --embeddings say how --count counts; add --count")
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
    say_if_odd(links, dof, query.spatial)
    if only_count and per_chain:
        raise click.UsageError("--count counts SC graphs; for chains: synth enumerate chains --planar --count")
    if only_count:
        run_count(sc_count_job(query, method or "orbits", outside=not embeddings), options)
    else:
        run_rows(FormJob(query) if per_chain else SCJob(query), options)
