"""``synth explain``: why a mechanism moves although counts say no."""

from __future__ import annotations

import click

from synth.cli.output import about, print_json
from synth.cli.precision import PRECISION, precise
from synth.cli.reading import DRAWN, read

__all__ = ["explain"]


@click.command(short_help="Explain why a mechanism moves although counts say that it is rigid.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
@PRECISION
def explain(file: str, as_json: bool) -> None:
    """Find the redundant closure equations, the geometry that causes them, and the axis errors they tolerate.

    The analysis is at the configuration of the file; fold a flat pattern first. Axis errors are for one axis at a
    time, in the worst direction: the size at which a redundant equation constrains as much as the weakest
    independent one.

    \b
    Examples:
      synth explain data/linkages/bennett.json
      synth generate miura --rows 4 --columns 4 --fold 60 -o miura.fold
      synth explain miura.fold
    """
    from synth.overconstraint.explanation import explain as explained

    thing = read(file)
    with about(file):
        thing = precise(thing)
        found = explained(thing)
    if as_json:
        print_json({"file": file, **found.to_json()})
    else:
        click.echo(str(found))
