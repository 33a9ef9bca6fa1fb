"""``synth enumerate chains``: kinematic chains."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from synth.cli.output import plain
from synth.cli.runner import LimitsType, RunOptions, run_count, run_rows, runner_options

if TYPE_CHECKING:
    from enumerate.runner.job import Limits

__all__ = ["assortment", "chains", "say_if_odd"]


def assortment(context: click.Context, parameter: click.Parameter, value: str | None) -> tuple[int, ...] | None:
    """Read numbers of binary, ternary, ... links."""
    del context, parameter
    if value is None:
        return None
    parts = value.split(",")
    if not all(part.isascii() and part.isdigit() and len(part) < 6 for part in parts):
        raise click.BadParameter(f"{plain(value)!r} is no list of numbers such as 4,2: binary, ternary, ... links")
    return tuple(map(int, parts))


@click.command(short_help="List or count kinematic chains without rigid sub-chains.")
@click.option("--links", type=click.IntRange(min=4), required=True, metavar="N", help="Number of links.")
@click.option("--dof", type=click.IntRange(min=1), required=True, metavar="M", help="Degrees of freedom.")
@click.option(
    "--fractionated", is_flag=True, help="Include fractionated chains, which one link or one joint cuts in two."
)
@click.option("--inversions", is_flag=True, help="List kinematic inversions: one row per distinct ground link.")
@click.option(
    "--inputs", is_flag=True, help="List one row per distinct choice of a ground link and M input joints."
)
@click.option("--assortment", callback=assortment, metavar="4,2", help="Numbers of binary, ternary, ... links.")
@click.option("--planar/--nonplanar", default=None, help="List only planar, or only nonplanar, chains.")
@click.option(
    "--longest-string",
    type=LimitsType(),
    metavar="K",
    help="Length of the longest row of binary links, as a number or range: 2, 1..2, 2.. or ..3.",
)
@click.option(
    "--symmetry",
    type=LimitsType(),
    metavar="K",
    help="Number of automorphisms, as a number or range: 1, 2.. or 2..8.",
)
@click.option("--count", "only_count", is_flag=True, help="Print only the number, by the fastest method.")
@click.option(
    "--method",
    type=click.Choice(["orbits", "burnside"]),
    help="Counting method for --count; both give the same number.",
)
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
    if method is not None and not only_count:
        raise click.UsageError("--method says how --count counts; add --count")
    from enumerate.chains.jobs import ChainJob, count_job
    from enumerate.chains.query import ChainQuery
    from enumerate.runner.job import ANY_NUMBER, ONE_OR_MORE

    query = ChainQuery(
        links, dof, **rest, longest_string=longest_string or ANY_NUMBER, symmetry=symmetry or ONE_OR_MORE
    )
    say_if_odd(links, dof)
    if only_count:
        run_count(count_job(query, method or "orbits", options.kept_job()), options)
    else:
        graph6 = options.output is not None and options.output.lower().endswith(".g6")
        run_rows(ChainJob(query, bare=graph6 and not (query.inversions or query.inputs)), options)


def say_if_odd(links: int, dof: int, spatial: int = 0) -> None:
    """Say on standard error why there is nothing of a size, where its parity says so."""
    if (links - 1 - dof - 3 * spatial) % 2:
        freedoms = "M + 3 S" if spatial else "M"
        click.echo(
            f"{links} links with M = {dof}: none; N - 1 and {freedoms} must be both even or both odd", err=True
        )
