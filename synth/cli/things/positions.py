"""``synth positions``: all positions of a spherical linkage at given inputs."""

from __future__ import annotations

import sys

import click

from synth.cli.output import about, print_json

__all__ = ["positions"]


@click.command(short_help="Find all positions of a spherical linkage at given inputs.")
@click.argument("file", metavar="FILE")
@click.option(
    "--drive", multiple=True, required=True, metavar="JOINT=DEGREES", help="As many as it has freedoms; repeat it."
)
@click.option("--circuits/--no-circuits", default=True, show_default=True, help="Tell circuits and branches.")
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Of the general member.")
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
def positions(file: str, drive: tuple[str, ...], circuits: bool, seed: int, as_json: bool) -> None:
    """Find all positions of a linkage whose loops have finite centres, its driven joints held at angles.

    Angles of creases count from flat, of other joints from the pose of the file. Positions of one circuit are
    reached from each other, those of one branch without the driven joint turning back. JOINT is an id, or two
    links A,B.

    \b
    Examples:
      synth generate four-bar -o ring.json
      synth positions ring.json --drive 0=10
      synth positions data/patterns/four-bar-vertex.fold --drive 2=90

    Exit status 1: it has no position at these inputs, or not all were found.
    """
    from graphs.files.formats import read
    from synth.assembly.found import positions as found_at
    from synth.cli.things.driven import driven_angles
    from synth.moving.made import configuration_of

    thing = read(file)
    with about(file):
        at = configuration_of(thing)
        found = found_at(at, driven_angles(at.linkage.graph, drive), circuits=circuits, seed=seed)
    if as_json:
        print_json({"file": file, **found.to_json()})
    else:
        click.echo(str(found))
    if not found.positions or not found.exhaustive:
        sys.exit(1)
