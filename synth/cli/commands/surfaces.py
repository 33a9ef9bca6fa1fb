"""``synth cone`` and ``synth cylinder``: linkages on right cones and circular cylinders."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from functools import cached_property
from math import radians
from typing import TYPE_CHECKING, Any, Literal, TypeVar

import click

from graphs.printing import plain
from synth.cli.options import FORCE, NumberList, in_radians, surface_from_options
from synth.cli.output import about, check_output, check_picture, print_answer, print_json, tell_written

if TYPE_CHECKING:
    from graphs.mechanism.surfaces import Surface, SurfaceLinkage
    from synth.conformed.linkages import OnSurface
    from synth.surfaces.linkages import LinkageMap
    from synth.surfaces.loop_maps import ConeMap, CylinderMap

__all__ = ["cone_group", "cylinder_group"]


Kind = Literal["cone", "cylinder"]
_Command = TypeVar("_Command", bound=Callable[..., Any])


class _Arc(click.ParamType):  # type: ignore[type-arg,unused-ignore]
    """A link and the joint at which its arc begins, ``4=1``."""

    name = "arc"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the names of link and joint."""
        link, sign, joint = str(value).partition("=")
        if not (link and sign and joint):
            self.fail(f"{plain(value)!r} is not LINK=JOINT, such as 4=1", param, ctx)
        return link, joint


@dataclass(frozen=True)
class LinkageOptions:
    """A linkage as options name it: sizes are link angles in degrees, on cones, or lengths, on cylinders."""

    kind: Kind
    file: str | None
    sizes: tuple[float, ...] | None
    steps: tuple[float, ...] | None
    surface: Surface | None
    arcs: Mapping[str, str]

    @classmethod
    def of(cls, kind: Kind, options: Mapping[str, Any]) -> LinkageOptions:
        """Take the values of `linkage_options`, and refuse those that exclude each other."""
        size, sizes = ("lambda", "angles") if kind == "cone" else ("radius", "lengths")
        file, link_sizes, steps = options["file"], options["sizes"], options["steps"]
        if sum(source is not None for source in (file, link_sizes, steps)) != 1:
            raise click.UsageError(f"expected one of --{sizes}, --steps (of one loop) and FILE")
        number = options["surface_size"]
        if number is not None and link_sizes is not None:
            raise click.UsageError(f"--{sizes} determine the {kind}; leave out --{size}")
        surface = surface_from_options(number, None) if kind == "cone" else surface_from_options(None, number)
        return cls(kind, file, link_sizes, steps, surface, dict(options.get("arcs") or ()))

    def about(self) -> AbstractContextManager[None]:
        """Name the file in errors."""
        return nullcontext() if self.file is None else about(self.file)

    @cached_property
    def linkage_sizes(self) -> Sequence[float]:
        """Lengths, or link angles in radians."""
        return in_radians(self.sizes or ()) if self.kind == "cone" else self.sizes or ()

    def linkage(self) -> SurfaceLinkage:
        """Return the linkage of the options, which need not lie on a surface."""
        from graphs.files.formats import read_linkage
        from graphs.mechanism.surfaces import SurfaceLinkage

        if self.file is not None:
            return read_linkage(self.file)
        if self.sizes is not None:
            return SurfaceLinkage.loop(self.linkage_sizes, self.kind)
        return self._of_steps().linkage()

    def _of_steps(self) -> OnSurface:
        from graphs.mechanism.surfaces import as_planar
        from synth.conformed.linkages import loop_of_steps

        loop = loop_of_steps(in_radians(self.steps or ()), self.surface)
        return loop if self.kind == "cone" else replace(loop, chain=as_planar(loop.chain))

    def on_surfaces(self) -> list[OnSurface]:
        """Return the linkage on each of its surfaces."""
        from graphs.files.formats import read_linkage
        from synth.conformed.linkages import linkage_on_surfaces, loop_on_cones, loop_on_cylinders

        if self.file is not None:
            placed = linkage_on_surfaces(read_linkage(self.file), self.surface)
        elif self.sizes is not None:
            placed = (loop_on_cones if self.kind == "cone" else loop_on_cylinders)(self.linkage_sizes)
        else:
            placed = [self._of_steps()]
        return [linkage.curved(self.arcs) for linkage in placed] if self.arcs else placed


def linkage_options(kind: Kind, *, arcs: bool = True) -> Callable[[_Command], _Command]:
    """Return the options that name a linkage on a cone or a cylinder."""
    size = {"type": NumberList(), "metavar": "A,B,..."}
    options = [click.argument("file", required=False, metavar="[FILE]")]
    if kind == "cone":
        options += [
            click.option("--angles", "sizes", help="Link angles in loop order, in degrees.", **size),  # type: ignore[arg-type]
            click.option(
                "--lambda", "surface_size", type=float, metavar="DEGREES", help="Cone angle, with --steps."
            ),
        ]
    else:
        options += [
            click.option("--lengths", "sizes", help="Link lengths in loop order, in any one unit.", **size),  # type: ignore[arg-type]
            click.option(
                "--radius", "surface_size", type=float, metavar="R", help="Cylinder radius, with --steps."
            ),
        ]
    text = "Signed steps round the surface in loop order, in degrees; the last may be left out."
    options.insert(2, click.option("--steps", help=text, **size))  # type: ignore[arg-type]
    if arcs:
        text = (
            "For a link that spans half a turn: the joint at which its arc begins, in the direction of "
            "increasing azimuth. May be repeated."
        )
        options.append(click.option("--arc", "arcs", type=_Arc(), multiple=True, metavar="LINK=JOINT", help=text))

    def decorated(command: _Command) -> _Command:
        for option in reversed(options):
            command = option(command)
        return command

    return decorated


_GROUND = click.option(
    "--ground", metavar="LINK", help="Fixed link. By default the first (1), or the one that FILE names."
)
_JSON = click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")


def map_answer(
    chosen: LinkageOptions,
    *,
    tolerance: float,
    by_sizes: bool,
    output: str | None,
    number: int | None,
    force: bool,
) -> ConeMap | CylinderMap | LinkageMap:
    """Return every surface on which a linkage lies; write or draw the output.

    A picture of a loop by its link sizes shows loop sums, unless the number of a surface is chosen.
    """
    from synth.conformed.linkages import linkage_on_surfaces, surface_of_number
    from synth.surfaces.linkages import by_sizes as with_sizes_only, map_linkage
    from synth.surfaces.loop_maps import map_to_cones, map_to_cylinders

    if output is None and number is not None:
        raise click.UsageError(f"--{chosen.kind} requires -o")
    (check_output if _is_linkage(output) else check_picture)(output, force=force)
    with chosen.about():
        if chosen.sizes is not None:
            mapped = (map_to_cones if chosen.kind == "cone" else map_to_cylinders)(chosen.linkage_sizes)
            if output is not None and number is None and not _is_linkage(output):
                from synth.drawing.sums import draw_loop_sums

                draw_loop_sums(mapped).save(output, force=force)
                return mapped
            if output is None:
                return mapped
        linkage = chosen.linkage()
        linkage = with_sizes_only(linkage) if by_sizes else linkage
        answer = mapped if chosen.sizes is not None else map_linkage(linkage, tolerance)
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


def _write(linkage: SurfaceLinkage | OnSurface, output: str, *, force: bool) -> None:
    """Write a linkage, with or without its surface, or draw it there."""
    from graphs.files.formats import write
    from synth.conformed.linkages import OnSurface

    if isinstance(linkage, OnSurface) and not _is_linkage(output):
        _draw(linkage, output, force=force)
    else:
        write(linkage.linkage() if isinstance(linkage, OnSurface) else linkage, output, force=force)


def _draw(linkage: OnSurface, output: str, ground: Any = None, *, force: bool) -> None:
    from synth.conformed.rates import ConformedChain
    from synth.drawing.conformed import draw_conformed

    chain = ConformedChain.of(linkage.chain, ground)
    scene = draw_conformed(chain, linkage.places, linkage.surface, begins=linkage.begins(chain))
    scene.save(output, force=force)


_MAP = {
    "cone": """Find the right cones on which a linkage lies, with all its joint axes on ruling lines.

    Give the link --angles of one loop (for a four-bar: ground, input, coupler, output), its --steps round a cone
    of angle --lambda, or a FILE of a linkage of several loops, with its link angles or with the steps between its
    joint axes. `synth cone move`, `view`, `draw` and `template` read the .json that -o writes.

    \b
    Examples:
      synth cone map --angles 70,80,120,40
      synth cone map --angles 120,95,45,85 --cone 1 -o four-bar.json
      synth cone map --steps 40,50,50 --lambda 20 -o steps.json
      synth cone map --angles 120,50,120,50 --json
      synth cone map --angles 85,120,95,45 --supplementary
      synth cone map data/surfaces/fig11-stephenson.json
      synth cone map data/surfaces/fig11-stephenson.json --by-angles
    """,
    "cylinder": """Find the cylinders on which a planar linkage lies, with all its joint axes on ruling lines.

    Give the link --lengths of one loop (for a four-bar: ground, input, coupler, output), its --steps round a
    cylinder of --radius, or a FILE of a linkage of several loops. The radius is in the unit of the lengths. `synth
    cylinder move`, `view`, `draw` and `template` read the .json that -o writes.

    \b
    Examples:
      synth cylinder map --lengths 4,3,5,1
      synth cylinder map --lengths 4,3,5,1 --cylinder 1 -o four-bar.json
      synth cylinder map --steps 40,50,50 --radius 25 -o steps.json
      synth cylinder map --lengths 4,3,5,1,2 --json
    """,
}


def map_command(kind: Kind) -> click.Command:
    """Return the command that finds the surfaces of a kind on which a linkage lies."""
    sizes, link_sizes = ("angles", "link angles") if kind == "cone" else ("lengths", "lengths")

    def options_of_kind(command: _Command) -> _Command:
        if kind == "cone":
            text = "For a four-bar: list all 16 linkages on its joint lines."
            command = click.option("--supplementary", is_flag=True, help=text)(command)
        text = (
            f"For --steps or a FILE: find every {kind} on which the {link_sizes} lie, not only that of the steps."
        )
        return click.option(f"--by-{sizes}", "by_sizes", is_flag=True, help=text)(command)

    @click.command("map", help=_MAP[kind], short_help=f"Find every {kind} on which a linkage lies.")
    @linkage_options(kind, arcs=False)
    @click.option(
        "--tolerance", type=click.FloatRange(0, min_open=True), default=1e-5, show_default=True, metavar="DEGREES",
        help="Largest misclosure of the loops of a FILE, in degrees.",
    )  # fmt: skip
    @options_of_kind
    @click.option(
        "-o", "--output", metavar="OUT",
        help=f"Draw the loop sums (.png, .svg, .pdf); for a FILE or with --{kind}, draw the linkage; "
        "or write it (.json).",
    )  # fmt: skip
    @click.option(
        f"--{kind}", "number", type=click.IntRange(min=1), metavar="K",
        help=f"Number of the {kind} to draw, or to write the linkage on. By default the link {sizes} "
        f"are written, without a {kind}.",
    )  # fmt: skip
    @FORCE
    @_JSON
    def command(
        tolerance: float,
        by_sizes: bool,
        output: str | None,
        number: int | None,
        force: bool,
        as_json: bool,
        supplementary: bool = False,
        **options: Any,
    ) -> None:
        chosen = LinkageOptions.of(kind, options)
        if by_sizes and chosen.sizes is not None:
            raise click.UsageError(f"--by-{sizes} requires a FILE or --steps")
        if supplementary:
            if chosen.sizes is None or output is not None:
                raise click.UsageError("--supplementary lists linkages for --angles, and writes none")
            from synth.surfaces.linkages import supplementary_linkages

            answer: Any = supplementary_linkages(chosen.linkage_sizes)
        else:
            answer = map_answer(
                chosen, tolerance=radians(tolerance), by_sizes=by_sizes, output=output, number=number, force=force
            )
        if as_json:
            print_json(answer.to_json())
            return
        print_answer(answer)
        tell_written(output)

    return command


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
    """Return the command that finds in which direction links leave a surface of a kind."""
    text = f"""Find which links can move inward (intramobile), outward (extramobile), or both ways (transmobile).

    The answer is to first order, from the conformed position. It does not depend on the size of the {kind}, and is
    the same on cones and cylinders. Give the links or the steps of one loop, or a FILE of a linkage. A link that
    spans half a turn may curve either way: both arcs are rows, unless --arc, or the sign of its step, chooses one.
    {_BEHAVIOUR[kind]}"""

    @click.command(
        "behaviour", help=text, short_help=f"Find which links leave the {kind} inward, outward, or both ways."
    )
    @linkage_options(kind)
    @_GROUND
    @click.option(
        "-o", "--output", metavar="PICTURE",
        help="Draw the first linkage, as a circle and on its surface (.png, .svg, .pdf).",
    )  # fmt: skip
    @FORCE
    @_JSON
    def command(ground: str | None, output: str | None, force: bool, as_json: bool, **options: Any) -> None:
        from graphs.edit.named import link_named

        chosen = LinkageOptions.of(kind, options)
        check_picture(output, force=force)
        with chosen.about():
            linkages = chosen.on_surfaces()
            behaviours = [
                linkage.behaviour(None if ground is None else link_named(linkage.chain, ground))
                for linkage in linkages
            ]
        if output is not None:
            if not behaviours:
                raise click.UsageError(f"there is no {kind} to draw")
            _draw(linkages[0], output, behaviours[0].chain.links[0], force=force)
        _print_linkages(behaviours, kind, as_json=as_json)
        if not as_json:
            tell_written(output)

    return command


def move_command(kind: Kind) -> click.Command:
    """Return the command that moves a linkage from its surface of a kind."""
    text = f"""Move a linkage with one degree of freedom from its conformed position, all round its circuit.

    The answer has the range of the driving joint, the side of the {kind} on which each link stays, and the
    circuit. With --at it lists the configurations of the circuit at given angles of the driving joint; there,
    --point gives the positions of points of links, and --axes the axis about which two links turn relative to
    each other.
    {_MOVE[kind]}"""

    @click.command(
        "move",
        help=text,
        short_help=f"Find how far a linkage moves from its {kind}, and to which side.",
    )
    @linkage_options(kind)
    @_GROUND
    @click.option("--driver", metavar="JOINT", help="Driving joint. By default the first joint of the fixed link.")
    @click.option(
        "--at", type=NumberList(), metavar="A,B,...",
        help="Angles of the driving joint at which to list configurations, in degrees.",
    )  # fmt: skip
    @click.option(
        "--point", "points", multiple=True, metavar="LINK,AZIMUTH[,ALONG]",
        help="With --at: report the position of this point of a link. AZIMUTH is in degrees, ALONG "
    "a length on the ruling line, 1 by default. May be repeated.",
    )  # fmt: skip
    @click.option(
        "--axes", multiple=True, metavar="LINK,LINK",
        help="With --at: report the instant axis of two links. May be repeated.",
    )  # fmt: skip
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

        chosen = LinkageOptions.of(kind, options)
        if (points or axes) and at is None:
            raise click.UsageError("--point and --axes require --at")
        with chosen.about():
            motions = [
                move_on_surface(
                    linkage,
                    None if ground is None else link_named(linkage.chain, ground),
                    None if driver is None else joint_named(linkage.chain, driver),
                    in_radians(at or ()),
                    points=[_point(linkage, text) for text in points],
                    axes=[_pair(linkage, text) for text in axes],
                )
                for linkage in chosen.on_surfaces()
            ]
        _print_linkages(motions, kind, as_json=as_json)

    return command


def _print_linkages(answers: Sequence[Any], kind: Kind, *, as_json: bool) -> None:
    """Print the answers about a linkage on each of its surfaces."""
    if as_json:
        print_json({"linkages": [answer.to_json() for answer in answers]})
        return
    for answer in answers:
        print_answer(answer)
    if not answers:
        click.echo(f"no {kind}")


def _point(linkage: OnSurface, text: str) -> Any:
    """Return a point of a link, by its azimuth at the conformed position and its length along the ruling line."""
    from math import radians

    from graphs.edit.named import link_named
    from synth.moving.on_surface import LinkPoint

    link, *numbers = text.split(",")
    try:
        azimuth, along = map(float, numbers if len(numbers) == 2 else [*numbers, "1"])
    except ValueError:
        raise click.UsageError(
            f"--point: {plain(text)!r} is not LINK,AZIMUTH or LINK,AZIMUTH,ALONG, such as 2,30"
        ) from None
    return LinkPoint(link_named(linkage.chain, link), radians(azimuth), along)


def _pair(linkage: OnSurface, text: str) -> Any:
    from graphs.edit.named import link_named

    names = text.split(",")
    if len(names) != 2:
        raise click.UsageError(f"--axes: {plain(text)!r} is not LINK,LINK, such as 1,3")
    first, second = (link_named(linkage.chain, name) for name in names)
    return first, second


@click.group("cone", short_help="Map spherical linkages to cones; find which way links move.")
def cone_group() -> None:
    """Map spherical linkages to right cones, and find which way their links move from them.

    \b
    Examples:
      synth cone map --angles 70,80,120,40
      synth cone behaviour --angles 70,80,120,40
    """


@click.group("cylinder", short_help="Map planar linkages to cylinders; find which way links move.")
def cylinder_group() -> None:
    """Map planar linkages to right circular cylinders, and find which way their links move from them.

    \b
    Examples:
      synth cylinder map --lengths 4,3,5,1
      synth cylinder behaviour --lengths 4,3,5,1
    """


for _command in (map_command, behaviour_command, move_command):
    cone_group.add_command(_command("cone"))
    cylinder_group.add_command(_command("cylinder"))
