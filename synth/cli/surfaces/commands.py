"""``map``, ``behaviour`` and ``move`` of ``synth cone`` and ``synth cylinder``: one and the same for both."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from synth.cli.output import FORCE, check_output, check_picture, print_answer, print_json, tell_written
from synth.cli.surfaces.asked import AskedLinkage, Kind, linkage_options
from synth.cli.surfaces.circles import NumberList, in_radians

if TYPE_CHECKING:
    from graphs.mechanism.on_surface import SurfaceLinkage
    from synth.conformed.linkages import OnSurface
    from synth.surfaces.linkages import LinkageMap
    from synth.surfaces.loop_maps import ConeMap, CylinderMap

__all__ = ["behaviour_command", "map_answer", "move_command"]

_GROUND = click.option(
    "--ground", metavar="LINK", help="Fixed link. By default the first (1), or the one that FILE names."
)
_JSON = click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")


def map_answer(
    asked: AskedLinkage, *, tolerance: float, by_sizes: bool, output: str | None, number: int | None, force: bool
) -> ConeMap | CylinderMap | LinkageMap:
    """Return every surface on which a linkage lies, and write or draw what is asked for.

    A picture of a loop that is given by its links shows loop sums, unless the number of a surface is given.
    """
    from synth.conformed.linkages import linkage_on_surfaces, surface_of_number
    from synth.surfaces.linkages import by_sizes as given_by_sizes, map_linkage
    from synth.surfaces.loop_maps import map_to_cones, map_to_cylinders

    if output is None and number is not None:
        raise click.UsageError(f"--{asked.kind} says what -o draws or writes: expected -o")
    (check_output if _is_linkage(output) else check_picture)(output, force=force)
    with asked.about():
        if asked.sizes is not None:
            mapped = (map_to_cones if asked.kind == "cone" else map_to_cylinders)(asked.linkage_sizes)
            if output is not None and number is None and not _is_linkage(output):
                from synth.drawing.scene.writing import save_scene
                from synth.drawing.sums import draw_loop_sums

                save_scene(draw_loop_sums(mapped), output, force=force)
                return mapped
            if output is None:
                return mapped
        linkage = asked.linkage()
        linkage = given_by_sizes(linkage) if by_sizes else linkage
        answer = mapped if asked.sizes is not None else map_linkage(linkage, tolerance)
        if output is not None and number is None and _is_linkage(output):
            _write(linkage, output, force=force)
        elif output is not None:
            _write(
                surface_of_number(linkage_on_surfaces(linkage, tolerance=tolerance), number, linkage.kind),
                output,
                force=force,
            )
    return answer


def _is_linkage(output: str | None) -> bool:
    return output is not None and output.lower().endswith(".json")


def _write(thing: SurfaceLinkage | OnSurface, output: str, *, force: bool) -> None:
    """Write a linkage as it was given, or as it lies on a surface; or draw it there."""
    from graphs.files.formats import write
    from synth.conformed.linkages import OnSurface

    if isinstance(thing, OnSurface) and not _is_linkage(output):
        _draw(thing, output, force=force)
    else:
        write(thing.linkage() if isinstance(thing, OnSurface) else thing, output, force=force)


def _draw(linkage: OnSurface, output: str, ground: Any = None, *, force: bool) -> None:
    from synth.conformed.rates import ConformedChain
    from synth.drawing.conformed import draw_conformed
    from synth.drawing.scene.writing import save_scene

    chain = ConformedChain.of(linkage.chain, ground)
    scene = draw_conformed(chain, linkage.places, linkage.surface, begins=linkage.begins(chain))
    save_scene(scene, output, force=force)


_BEHAVIOUR = {
    "cone": """
    \b
    Examples:
      synth cone behaviour --angles 120,95,45,85
      synth cone behaviour --steps 40,50,50 --ground 2
      synth cone behaviour --steps 40,50,90 --arc 4=1
      synth cone behaviour data/surfaces/fig11-stephenson.json --ground 2
    """,
    "cylinder": """
    \b
    Examples:
      synth cylinder behaviour --lengths 4,3,5,1
      synth cylinder behaviour --steps 40,50,50 --radius 25 --ground 2
      synth cylinder behaviour --steps 40,50,90 --arc 4=1
      synth cylinder behaviour data/surfaces/fig10-four-bar.json --ground 2
    """,
}
_MOVE = {
    "cone": """
    \b
    Examples:
      synth cone move --angles 120,95,45,85
      synth cone move data/surfaces/fig11-stephenson.json --at 0.1
      synth cone move --steps 50,110,80 --lambda 20 --at 0,10,20 --point 2,30 --axes 1,3
    """,
    "cylinder": """
    \b
    Examples:
      synth cylinder move data/surfaces/fig10-four-bar.json
      synth cylinder move --steps 50,110,80 --radius 25 --at 0,10 --point 3,90 --axes 1,3
    """,
}


def behaviour_command(kind: Kind) -> click.Command:
    """Return the command that says which way links go, of cones or of cylinders."""
    told = f"""Find which links can move inward (intramobile), outward (extramobile), or both ways (transmobile).

    The answer is to first order, from the conformed position. It does not depend on the size of the {kind}, and is
    the same on cones and cylinders. Give the links or the steps of one loop, or a FILE of a linkage. A link that
    spans half a turn may curve either way: both arcs are rows, unless --arc, or the sign of its step, chooses one.
    {_BEHAVIOUR[kind]}"""

    @click.command(
        "behaviour", help=told, short_help=f"Find which links leave the {kind} inward, outward, or both ways."
    )
    @linkage_options(kind)
    @_GROUND
    @click.option(
        "-o",
        "--output",
        metavar="PICTURE",
        help="Draw the first linkage, as a circle and on its surface (.png, .svg, .pdf).",
    )
    @FORCE
    @_JSON
    def command(ground: str | None, output: str | None, force: bool, as_json: bool, **options: Any) -> None:
        from graphs.edit.named import link_named

        asked = AskedLinkage.of(kind, options)
        check_picture(output, force=force)
        with asked.about():
            linkages = asked.on_surfaces()
            found = [one.behaviour(None if ground is None else link_named(one.chain, ground)) for one in linkages]
        if output is not None:
            if not found:
                raise click.UsageError(f"there is no {kind} to draw")
            _draw(linkages[0], output, found[0].chain.links[0], force=force)
        if as_json:
            print_json({"linkages": [linkage.to_json() for linkage in found]})
            return
        for linkage in found:
            print_answer(linkage)
        if not found:
            click.echo(f"no {kind}")
        tell_written(output)

    return command


def move_command(kind: Kind) -> click.Command:
    """Return the command that moves a linkage from its surface, a cone or a cylinder."""
    told = f"""Move a linkage with one degree of freedom from its conformed position, all round its circuit.

    The answer has the range of the driving joint, the side of the {kind} on which each link stays, and the
    circuit. With --at it lists the configurations of the circuit at given angles of the driving joint; there,
    --point gives the positions of points of links, and --axes the axis about which two links turn relative to
    each other.
    {_MOVE[kind]}"""

    @click.command(
        "move",
        help=told,
        short_help=f"Find how far a linkage moves from its {kind}, and to which side.",
    )
    @linkage_options(kind)
    @_GROUND
    @click.option("--driver", metavar="JOINT", help="Driving joint. By default the first joint of the fixed link.")
    @click.option(
        "--at",
        type=NumberList(),
        metavar="A,B,...",
        help="Angles of the driving joint at which to list configurations, in degrees.",
    )
    @click.option(
        "--point", "points", multiple=True, metavar="LINK,AZIMUTH[,ALONG]",
        help="With --at: report the position of this point of a link. AZIMUTH is in degrees, ALONG "
    "a length on the ruling line, 1 by default. May be repeated.",
    )  # fmt: skip
    @click.option(
        "--axes",
        multiple=True,
        metavar="LINK,LINK",
        help="With --at: report the instant axis of two links. May be repeated.",
    )
    @_JSON
    def command(
        ground: str | None,
        driver: str | None,
        at: tuple[float, ...] | None,
        points: tuple[str, ...],
        axes: tuple[str, ...],
        as_json: bool,
        **options: Any,
    ) -> None:
        from graphs.edit.named import joint_named, link_named
        from synth.moving.on_surface import move_on_surface

        asked = AskedLinkage.of(kind, options)
        if (points or axes) and at is None:
            raise click.UsageError("--point and --axes are of positions: expected --at")
        with asked.about():
            found = [
                move_on_surface(
                    one,
                    None if ground is None else link_named(one.chain, ground),
                    None if driver is None else joint_named(one.chain, driver),
                    in_radians(at or ()),
                    points=[_point(one, text) for text in points],
                    axes=[_pair(one, text) for text in axes],
                )
                for one in asked.on_surfaces()
            ]
        if as_json:
            print_json({"linkages": [motion.to_json() for motion in found]})
            return
        for motion in found:
            print_answer(motion)
        if not found:
            click.echo(f"no {kind}")

    return command


def _point(linkage: OnSurface, text: str) -> Any:
    """Return a point of a link: its azimuth at the conformed position, and the length along the ruling line."""
    from math import radians

    from graphs.edit.named import link_named
    from synth.moving.on_surface import LinkPoint

    link, *numbers = text.split(",")
    try:
        azimuth, along = map(float, numbers if len(numbers) == 2 else [*numbers, "1"])
    except ValueError:
        raise click.UsageError("--point: expected LINK,AZIMUTH or LINK,AZIMUTH,ALONG, as 2,30") from None
    return LinkPoint(link_named(linkage.chain, link), radians(azimuth), along)


def _pair(linkage: OnSurface, text: str) -> Any:
    from graphs.edit.named import link_named

    names = text.split(",")
    if len(names) != 2:
        raise click.UsageError("--axes: expected LINK,LINK, as 1,3")
    first, second = (link_named(linkage.chain, name) for name in names)
    return first, second
