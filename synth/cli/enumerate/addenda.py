"""``synth enumerate addenda``: what can be added to a mechanism."""

from __future__ import annotations

from typing import Any

import click

from synth.cli.output import about
from synth.cli.runner import RunOptions, run_count, run_rows, runner_options

__all__ = ["addenda"]


@click.command(short_help="List all ways to add a loop to a mechanism.")
@click.option("--of", "file", required=True, metavar="FILE", help="File of the mechanism.")
@click.option(
    "--delta-dof",
    type=click.IntRange(min=-2),
    default=0,
    show_default=True,
    metavar="K",
    help="Change of mobility.",
)
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

    thing = read(file)
    with about(file):
        job = AddendumJob(graph_of(thing), delta_dof)
    if only_count:
        run_count(addendum_count_job(job), options)
    else:
        run_rows(job, options)
