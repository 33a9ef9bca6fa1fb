"""``synth positions``: all positions of a spherical or planar linkage at given inputs."""

from __future__ import annotations

import sys
from math import radians

import click

from synth.cli.output import about, print_json
from synth.cli.precision import PRECISION, precise
from synth.cli.reading import DRAWN, read

__all__ = ["positions"]


@click.command(short_help="Find all assembly modes of a spherical or planar linkage at given inputs.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option(
    "--drive",
    multiple=True,
    metavar="JOINT=DEGREES",
    help="Angle of a driven joint in degrees, or length of a prismatic one; once for each degree of freedom.",
)
@click.option(
    "--circuits/--no-circuits",
    default=True,
    show_default=True,
    help="Sort the assembly modes by circuit and branch of the circuit.",
)
@click.option("--seed", type=click.IntRange(0), metavar="N", default=0, show_default=True, help="Random seed.")
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
@PRECISION
def positions(file: str, drive: tuple[str, ...], circuits: bool, seed: int, as_json: bool) -> None:
    """Find all assembly modes of a linkage of spherical and planar loops at given inputs.

    Crease angles are measured from flat, other joint angles from the configuration of the file, in degrees; a
    prismatic joint takes a length in the unit of the file. Configurations of one circuit can be reached from each
    other; on one branch of the circuit, without the driven joint turning back. A linkage of mobility 0 needs no
    driven joint; its assembly modes are found. JOINT is an id, or two links A,B.

    \b
    Examples:
      synth generate four-bar -o ring.json
      synth positions ring.json --drive 0=10
      synth positions data/patterns/four-bar-vertex.fold --drive 2=90

    Exit status 1: the linkage has no assembly mode at these inputs, or not all were found.
    """
    from synth.assembly.modes import positions as found_at
    from synth.cli.things.driven import numbers_of_joints
    from synth.moving.made import configuration_of

    thing = read(file)
    with about(file):
        at = configuration_of(precise(thing), slides=True)
        slides = {joint for place, joint in enumerate(at.joints) if place in at.linkage.slides}
        values = numbers_of_joints(at.linkage.graph, drive, "--drive", "JOINT=DEGREES")
        inputs = {joint: value if joint in slides else radians(value) for joint, value in values.items()}
        found = found_at(at, inputs, circuits=circuits, seed=seed)
    if as_json:
        print_json({"file": file, **found.to_json()})
    else:
        click.echo(str(found))
    if not found.positions or not found.exhaustive:
        sys.exit(1)
