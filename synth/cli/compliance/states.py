"""``synth states``: compliance states of a mechanism, and what springs at its joints do."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from synth.cli.lengths import LENGTH
from synth.cli.output import about, plain, print_json
from synth.cli.precision import PRECISION, precise
from synth.cli.reading import DRAWN, read
from synth.cli.things.driven import driven_angles, numbers_of_joints

if TYPE_CHECKING:
    from graphs.convert.table import Mechanism
    from graphs.mechanism.sc import SCGraph
    from synth.compliance.compliance_states import DrivenJoint
    from synth.compliance.springs import Mass, Masses

__all__ = ["states"]

_PLACE = 3
"""Coordinates of a mass."""


@click.command(short_help="Analyse compliant members: mobility in each compliance state, springs, frequencies.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option("--joint", "joints", multiple=True, metavar="JOINT", help="Compliant joint; may be repeated.")
@click.option("--link", "links", multiple=True, metavar="LINK", help="Compliant link; may be repeated.")
@click.option(
    "--stiffness",
    multiple=True,
    metavar="JOINT=K",
    help="Stiffness of a torsion spring at a joint, as moment per radian; the joint is "
    "compliant. May be repeated.",
)
@click.option(
    "--rest",
    multiple=True,
    metavar="JOINT=DEGREES",
    help="Rest angle of a spring. By default the angle in the file. May be repeated.",
)
@click.option("--moment", multiple=True, metavar="JOINT=M", help="Constant moment at a joint; may be repeated.")
@click.option("--drive", metavar="JOINT=DEGREES", help="Joint and final angle of the load path.")
@click.option(
    "--frames",
    type=click.IntRange(1, 10_000),
    metavar="N",
    default=20,
    show_default=True,
    help="Number of configurations on the path after the first.",
)
@click.option("--mass", multiple=True, metavar="LINK=M@X,Y,Z", help="Point mass on a link; may be repeated.")
@click.option("--density", type=LENGTH, metavar="D", help="For a sheet: mass per unit area of its panels.")
@click.option("--ground", metavar="LINK", help="Fixed link, for frequencies.")
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
@PRECISION
def states(
    file: str,
    joints: tuple[str, ...],
    links: tuple[str, ...],
    stiffness: tuple[str, ...],
    rest: tuple[str, ...],
    moment: tuple[str, ...],
    drive: str | None,
    frames: int,
    mass: tuple[str, ...],
    density: float | None,
    ground: str | None,
    as_json: bool,
) -> None:
    """Check whether a mechanism moves with its compliant members at rest, and with some of them active.

    A member at rest is rigid, an active one is released. With springs, the answer has their equilibrium, the
    moments along the path of a driven joint, and the modes and frequencies of small motions. Use units of one
    system, such as N, mm and tonnes. JOINT is an id, or two links A,B; angles are those of `synth fold`, in
    degrees.

    \b
    Examples:
      synth generate four-bar -o four-bar.json
      synth states four-bar.json --joint 0 --joint 2
      synth states four-bar.json --stiffness 1=2 --drive 0=40 --frames 8
    """
    from graphs.edit.named import joint_named, link_named
    from synth.compliance.compliance_states import states as stated
    from synth.compliance.springs import Springs
    from synth.moving.made import configuration_of

    thing = read(file)
    with about(file):
        thing = precise(thing)
        graph = configuration_of(thing).linkage.graph
        springs = Springs(
            numbers_of_joints(graph, stiffness, "--stiffness", "JOINT=K"),
            driven_angles(graph, rest, "--rest"),
            numbers_of_joints(graph, moment, "--moment", "JOINT=M"),
        )
        found = stated(
            thing,
            [joint_named(graph, name) for name in joints],
            [link_named(graph, name) for name in links],
            springs=springs if stiffness or rest or moment else None,
            drive=_drive(graph, drive, frames),
            masses=_masses(thing, graph, (mass, density, ground)),
        )
    if as_json:
        print_json({"file": file, **found.to_json()})
    else:
        click.echo(str(found))


def _drive(graph: SCGraph, word: str | None, frames: int) -> DrivenJoint | None:
    from synth.compliance.compliance_states import DrivenJoint

    if word is None:
        return None
    [(joint, angle)] = driven_angles(graph, (word,)).items()
    return DrivenJoint(joint, angle, frames)


def _masses(
    thing: Mechanism, graph: SCGraph, asked: tuple[tuple[str, ...], float | None, str | None]
) -> Masses | None:
    """Return the masses of the options --mass, --density and --ground."""
    from graphs.edit.named import link_named
    from graphs.errors import UnsolvableError
    from synth.compliance.springs import Masses, sheet_masses
    from synth.moving.made import sheet_of

    words, density, ground = asked
    if not words and density is None:
        if ground is not None:
            raise click.UsageError("--ground is for frequencies: expected --mass or --density too")
        return None
    points = [_mass(graph, word) for word in words]
    if density is not None:
        sheet = sheet_of(thing)
        if sheet is None:
            raise UnsolvableError("--density is for panels, and this has none: expected --mass")
        points += sheet_masses(sheet, density)
    return Masses(tuple(points), None if ground is None else link_named(graph, ground))


def _mass(graph: SCGraph, word: str) -> Mass:
    from graphs.edit.named import link_named
    from synth.compliance.springs import Mass

    link, _, rest = word.rpartition("=")
    value, _, place = rest.partition("@")
    try:
        numbers = [float(one) for one in place.split(",")]
        if not link or len(numbers) != _PLACE:
            raise ValueError
        weight = float(value)
    except ValueError:
        raise click.BadParameter(f"{plain(word)!r} is not LINK=M@X,Y,Z", param_hint="--mass") from None
    return Mass(link_named(graph, link.strip()), weight, (numbers[0], numbers[1], numbers[2]))
