"""``synth cone``: spherical loops and linkages of several loops on right cones."""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from math import radians
from typing import TYPE_CHECKING

import click

from synth.cli.output import FORCE, about, check_output, check_picture, print_answer, print_json, tell_written
from synth.cli.surfaces.circles import NumberList, in_radians

if TYPE_CHECKING:
    from graphs.mechanism.conical import ConicalLinkage
    from synth.conformed.linkages import LinkageBehaviour, OnCone
    from synth.moving.conical import ConicalMotion
    from synth.surfaces.cone import ConeMap
    from synth.surfaces.linkages import LinkageMap

__all__ = ["cone_group"]


@click.group("cone", short_help="Map spherical linkages to cones; say which way links go.")
def cone_group() -> None:
    """Map spherical linkages to right cones, and say which way their links move there.

    \b
    Examples:
      synth cone map --angles 70,80,120,40
      synth cone behaviour --angles 70,80,120,40
    """


@cone_group.command("map", short_help="Every cone on which a linkage lies.")
@click.argument("file", required=False, metavar="[FILE]")
@click.option("--angles", type=NumberList(), metavar="A,B,...", help="Link angles in loop order, degrees.")
@click.option(
    "--tolerance", type=click.FloatRange(0, min_open=True), default=1e-5, show_default=True, metavar="DEGREES",
    help="How well the loops of a FILE must close together.",
)  # fmt: skip
@click.option("--by-angles", is_flag=True, help="Of a FILE of steps: every cone on which its link angles lie.")
@click.option(
    "-o", "--output", metavar="OUT",
    help="Draw (.png, .svg, .pdf): loop sums; of a FILE or with --cone, the linkage. Or write it (.json).",
)  # fmt: skip
@click.option(
    "--cone", "number", type=click.IntRange(min=1), metavar="K",
    help="Which of the cones to draw, or to write the linkage on; written without it, it has its link angles.",
)  # fmt: skip
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def map_command(
    file: str | None,
    angles: tuple[float, ...] | None,
    tolerance: float,
    by_angles: bool,
    output: str | None,
    number: int | None,
    force: bool,
    as_json: bool,
) -> None:
    """Say on which right cones a linkage lies, all its joint axes ruling lines.

    Give --angles of one loop of any number of links (a four-bar as ground, input, coupler, output), or a FILE of a
    linkage of several loops: with its link angles, or with the steps between its joint axes. The .json that -o
    writes goes into synth cone move, view, draw and template.

    \b
    Examples:
      synth cone map --angles 70,80,120,40
      synth cone map --angles 120,95,45,85 --cone 1 -o four-bar.json
      synth cone map --angles 120,50,120,50 --json
      synth cone map data/surfaces/fig11-stephenson.json
      synth cone map data/surfaces/fig11-stephenson.json --by-angles
    """
    if by_angles and file is None:
        raise click.UsageError("--by-angles is for a FILE")
    if (file is None) == (angles is None):
        raise click.UsageError("give --angles of one loop, or a FILE")
    from graphs.mechanism.conical import ConicalLinkage
    from synth.conformed.linkages import cone_of_number, linkage_on_cones
    from synth.surfaces.cone import ConeMap, map_to_cones
    from synth.surfaces.linkages import map_linkage

    _check_output(output, number, force=force)
    mapped: ConeMap | LinkageMap
    if angles is not None:
        linkage, mapped = None, map_to_cones(in_radians(angles))
    else:
        linkage = _linkage(str(file), by_angles)
        with about(str(file)):
            mapped = map_linkage(linkage, radians(tolerance))
    if isinstance(mapped, ConeMap) and output is not None and number is None and not _is_linkage(output):
        _write(mapped, output, force=force)
    elif output is not None:
        with _about(file):
            linkage = linkage or ConicalLinkage.loop(in_radians(angles or ()))
            if number is None and _is_linkage(output):
                _write(linkage, output, force=force)
            else:
                cones = linkage_on_cones(linkage, tolerance=radians(tolerance))
                _write(cone_of_number(cones, number or 1), output, force=force)
    if as_json:
        print_json(mapped.to_json())
        return
    print_answer(mapped)
    tell_written(output)


def _linkage(file: str, angles_only: bool) -> ConicalLinkage:
    from graphs.files.formats import read_linkage
    from synth.surfaces.linkages import by_angles

    linkage = read_linkage(file)
    with about(file):
        return by_angles(linkage) if angles_only else linkage


def _check_output(output: str | None, number: int | None, *, force: bool) -> None:
    if output is None and number is not None:
        raise click.UsageError("--cone says what -o draws or writes: expected -o")
    (check_output if _is_linkage(output) else check_picture)(output, force=force)


def _is_linkage(output: str | None) -> bool:
    return output is not None and output.lower().endswith(".json")


def _write(thing: ConicalLinkage | ConeMap | OnCone, output: str, *, force: bool) -> None:
    """Write a linkage as it was given, or as it lies on a cone; draw loop sums, or a linkage on a cone."""
    from synth.conformed.linkages import OnCone
    from synth.conformed.rates import ConformedChain
    from synth.drawing.conformed import draw_conformed
    from synth.drawing.scene.writing import save_scene
    from synth.drawing.sums import draw_loop_sums
    from synth.surfaces.cone import ConeMap

    if isinstance(thing, ConeMap):
        save_scene(draw_loop_sums(thing), output, force=force)
    elif isinstance(thing, OnCone) and not _is_linkage(output):
        chain = ConformedChain.of(thing.chain)
        save_scene(draw_conformed(chain, thing.places, thing.cone_angle), output, force=force)
    else:
        from graphs.files.formats import write

        write(thing.linkage() if isinstance(thing, OnCone) else thing, output, force=force)


@cone_group.command("behaviour", short_help="Which links leave the cone inward, outward, or both ways.")
@click.argument("file", required=False, metavar="[FILE]")
@click.option(
    "--angles", type=NumberList(), metavar="A,B,...", help="Link angles in loop order; on each of their cones."
)
@click.option(
    "--steps", type=NumberList(), metavar="A,B,...",
    help="Signed steps round the cone in loop order; the last may be left out.",
)  # fmt: skip
@click.option("--lambda", "cone_angle", type=float, metavar="DEGREES", help="Cone angle, for the picture.")
@click.option("--ground", metavar="LINK", help="The fixed link: the first (1) by default; of a FILE, its own.")
@click.option("-o", "--output", metavar="PICTURE", help="Draw circle and cone (.png, .svg, .pdf) of the first.")
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def behaviour_command(
    file: str | None,
    angles: tuple[float, ...] | None,
    steps: tuple[float, ...] | None,
    cone_angle: float | None,
    ground: str | None,
    output: str | None,
    force: bool,
    as_json: bool,
) -> None:
    """Say which links can move inward (intramobile), outward (extramobile), or only both ways (transmobile).

    To first order, from the conformed position. It does not depend on the cone angle, and is the same on a
    cylinder. Give --angles or --steps of one loop, or a FILE of a linkage.

    \b
    Examples:
      synth cone behaviour --angles 120,95,45,85
      synth cone behaviour --steps 40,50,50 --ground 2
      synth cone behaviour data/surfaces/fig11-stephenson.json --ground 2
    """
    from synth.surfaces.cone import checked_cone_angle

    if sum(one is not None for one in (file, angles, steps)) != 1:
        raise click.UsageError("give --angles or --steps of one loop, or a FILE")
    check_picture(output, force=force)
    tilt = None if cone_angle is None else float(checked_cone_angle(radians(cone_angle)))
    if tilt is not None and angles is not None:
        raise click.UsageError("--angles tell the cone themselves")
    with _about(file):
        found = _behaviours(_on_cones(file, angles, steps, tilt), ground)
    if output is not None:
        if not found:
            raise click.UsageError("there is no cone to draw")
        from synth.drawing.conformed import draw_conformed
        from synth.drawing.scene.writing import save_scene

        first = found[0]
        save_scene(draw_conformed(first.chain, first.places, first.cone_angle), output, force=force)
    if as_json:
        print_json({"linkages": [linkage.to_json() for linkage in found]})
        return
    for linkage in found:
        print_answer(linkage)
    if not found:
        click.echo("no cone")
    tell_written(output)


def _behaviours(linkages: list[OnCone], ground: str | None) -> list[LinkageBehaviour]:
    from graphs.edit.named import link_named

    return [
        linkage.behaviour(None if ground is None else link_named(linkage.chain, ground)) for linkage in linkages
    ]


@cone_group.command("move", short_help="How far a linkage moves from its cone, and where its links go all along.")
@click.argument("file", required=False, metavar="[FILE]")
@click.option(
    "--angles", type=NumberList(), metavar="A,B,...", help="Link angles in loop order; on each of their cones."
)
@click.option("--steps", type=NumberList(), metavar="A,B,...", help="Signed steps round the cone in loop order.")
@click.option("--lambda", "cone_angle", type=float, metavar="DEGREES", help="Cone angle, with steps.")
@click.option("--ground", metavar="LINK", help="The fixed link: the first (1) by default; of a FILE, its own.")
@click.option("--driver", metavar="JOINT", help="The driving joint: by default the first of the fixed link.")
@click.option("--at", type=NumberList(), metavar="A,B,...", help="Turns of the driver: list positions, degrees.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def move_command(
    file: str | None,
    angles: tuple[float, ...] | None,
    steps: tuple[float, ...] | None,
    cone_angle: float | None,
    ground: str | None,
    driver: str | None,
    at: tuple[float, ...] | None,
    as_json: bool,
) -> None:
    """Move a linkage of one freedom and any number of loops from its conformed position, all round its circuit.

    Says how far the driving joint goes each way, on which side of the cone each link is all along, what the
    circuit is, and, with --at, all positions of the circuit at given turns of the driving joint.

    \b
    Examples:
      synth cone move --angles 120,95,45,85
      synth cone move data/surfaces/fig11-stephenson.json --at 0.1
    """
    from synth.surfaces.cone import checked_cone_angle

    if sum(one is not None for one in (file, angles, steps)) != 1:
        raise click.UsageError("give --angles or --steps of one loop, or a FILE")
    if cone_angle is not None and angles is not None:
        raise click.UsageError("--angles tell the cone themselves")
    tilt = None if cone_angle is None else float(checked_cone_angle(radians(cone_angle)))
    with _about(file):
        found = _motions(_on_cones(file, angles, steps, tilt), ground, driver, in_radians(at or ()))
    if as_json:
        print_json({"linkages": [motion.to_json() for motion in found]})
    else:
        for motion in found:
            print_answer(motion)
        if not found:
            click.echo("no cone")


def _about(file: str | None) -> AbstractContextManager[None]:
    return nullcontext() if file is None else about(file)


def _on_cones(
    file: str | None, angles: tuple[float, ...] | None, steps: tuple[float, ...] | None, tilt: float | None
) -> list[OnCone]:
    from graphs.files.formats import read_linkage
    from synth.conformed.linkages import linkage_on_cones, loop_of_steps, loop_on_cones

    if file is not None:
        return linkage_on_cones(read_linkage(file), tilt)
    if angles is not None:
        return loop_on_cones(in_radians(angles))
    assert steps is not None
    return [loop_of_steps(in_radians(steps), tilt)]


def _motions(
    linkages: list[OnCone], ground: str | None, driver: str | None, at: list[float]
) -> list[ConicalMotion]:
    from graphs.edit.named import joint_named, link_named
    from synth.moving.conical import move_on_cone

    return [
        move_on_cone(
            one,
            None if ground is None else link_named(one.chain, ground),
            None if driver is None else joint_named(one.chain, driver),
            at,
        )
        for one in linkages
    ]
