"""``synth explain``: why a mechanism moves although counts say no."""

from __future__ import annotations

import click

from synth.cli.output import about, print_json

__all__ = ["explain"]


@click.command(short_help="Say why a mechanism moves although counts say no.")
@click.argument("file", metavar="FILE")
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
def explain(file: str, as_json: bool) -> None:
    """Say which loops hold equations that follow from others, what geometry does it, how far axes may err.

    At the pose of the file: fold a flat pattern first. Errors are those of one axis at a time, the worst way, at
    which what was idle counts as much as the weakest of the other equations.

    \b
    Examples:
      synth explain data/linkages/bennett.json
      synth generate miura --rows 4 --columns 4 --fold 60 -o miura.fold
      synth explain miura.fold
    """
    from graphs.files.formats import read
    from synth.overconstraint.explained import explain as explained

    thing = read(file)
    with about(file):
        found = explained(thing)
    if as_json:
        print_json({"file": file, **found.to_json()})
    else:
        click.echo(str(found))
