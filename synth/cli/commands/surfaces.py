"""``synth cone`` and ``synth cylinder``: linkages on right cones and circular cylinders."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from functools import cached_property, wraps
from math import radians
from typing import TYPE_CHECKING, Any, Literal

import click

import synth.analysis.moving
import synth.linkages.conformed
import synth.linkages.surfaces
import synth.making.drawing
from graphs.errors import UnsolvableError, numbered
from graphs.printing import plain
from synth.cli import options, output as out

if TYPE_CHECKING:
    from graphs.mechanism.surfaces import Surface
    from graphs.types import LinkId

Kind = Literal["cone", "cylinder"]
_Command = Callable[..., None]


def _arc(word: str) -> tuple[str, str]:
    """Return the names of a link and of the joint at which its arc begins, ``4=1``."""
    link, _, joint = word.partition("=")
    if not (link and joint):
        raise ValueError(f"{plain(word)!r} is not LINK=JOINT, such as 4=1")
    return link, joint


@dataclass(frozen=True)
class LinkageOptions:
    """The values of `linkage_options`: sizes are link angles in degrees, on cones, or lengths, on cylinders."""

    kind: Kind
    file: str | None
    sizes: tuple[float, ...] | None
    steps: tuple[float, ...] | None
    surface_size: float | None
    row: int | None = None
    arcs: Sequence[tuple[str, str]] | None = None

    def __post_init__(self) -> None:
        sizes = "angles" if self.kind == "cone" else "lengths"
        if sum(source is not None for source in (self.file, self.sizes, self.steps)) != 1:
            raise click.UsageError(f"one of --{sizes}, --steps and FILE is required")
        if self.row is not None and self.file is None:
            raise click.UsageError("--row requires a FILE of conical candidates")

    @property
    def surface(self) -> Surface | None:
        """The cone of --lambda, or the cylinder of --radius."""
        cone_angle, radius = (self.surface_size, None) if self.kind == "cone" else (None, self.surface_size)
        return options.surface_from_options(cone_angle, radius)

    def about(self) -> AbstractContextManager[None]:
        """Name the file in errors."""
        return nullcontext() if self.file is None else out.about(self.file)

    @cached_property
    def linkage_sizes(self) -> Sequence[float]:
        """Lengths, or link angles in radians."""
        return options.in_radians(self.sizes or ()) if self.kind == "cone" else self.sizes or ()

    def linkage(self) -> synth.SurfaceLinkage:
        """Return the linkage of the options, which need not lie on a surface."""
        if self.file is not None:
            linkage = self._of_file(self.file)
            of_steps = linkage.steps is not None and self.surface is not None
            return replace(linkage, surface=self.surface) if of_steps else linkage
        if self.sizes is not None:
            mapped = self.loop_map
            sizes = mapped.angles if isinstance(mapped, synth.linkages.surfaces.ConeMap) else mapped.lengths
            return synth.SurfaceLinkage.loop(sizes, self.kind)
        return self._of_steps().linkage()

    @cached_property
    def loop_map(self) -> synth.linkages.surfaces.ConeMap | synth.linkages.surfaces.CylinderMap:
        """Every surface of a loop by its link sizes; with --lambda or --radius, that one."""
        surface = self.surface
        if self.kind == "cone":
            return synth.map_to_cones(self.linkage_sizes, None if surface is None else radians(self.surface_size or 0))
        return synth.map_to_cylinders(self.linkage_sizes, self.surface_size)

    def _of_file(self, file: str) -> synth.SurfaceLinkage:
        """Return the linkage of a file, or of a row of conical candidates, which lies on any cone or cylinder."""
        from graphs.files.formats import read_linkage
        from synth.cli.reading import read_named
        from synth.linkages.conformed.orders import OrderOnCircle
        from synth.making.drawing.list_pages import is_catalogue

        if self.row is None and not is_catalogue(file):
            return read_linkage(file)
        order = read_named(file, self.row).mechanism
        if not isinstance(order, OrderOnCircle):
            raise UnsolvableError(f"row {self.row} is no conical candidate; try `synth realise --as cone`")
        return synth.SurfaceLinkage.placed(order.chain, order.azimuths, self.surface)

    def note_readings(self) -> None:
        """Print, beside the answer, which link angles are read the other way round."""
        if self.sizes is not None and self.kind == "cone":
            for note in synth.map_to_cones(self.linkage_sizes).notes:
                click.echo(f"note: {note}", err=True)

    def _of_steps(self) -> synth.linkages.conformed.OnSurface:
        from graphs.mechanism.surfaces import as_planar

        loop = synth.linkages.conformed.loop_of_steps(options.in_radians(self.steps or ()), self.surface)
        return loop if self.kind == "cone" else replace(loop, chain=as_planar(loop.chain))

    def on_surfaces(self, *, families: bool = False) -> list[synth.linkages.conformed.OnSurface]:
        """Return the linkage on each of its surfaces; after these one of each family, if they are listed too."""
        if self.file is not None:
            linkage = self._of_file(self.file)
            placed = synth.linkages.conformed.linkage_on_surfaces(linkage, self.surface, families=families)
        elif self.sizes is not None and self.kind == "cone":
            angle = None if self.surface_size is None else radians(self.surface_size)
            placed = synth.linkages.conformed.loop_on_cones(self.linkage_sizes, angle, families=families)
        elif self.sizes is not None:
            placed = synth.linkages.conformed.loop_on_cylinders(
                self.linkage_sizes, self.surface_size, families=families
            )
        else:
            placed = [self._of_steps()]
        return [linkage.curved(dict(self.arcs)) for linkage in placed] if self.arcs else placed


def linkage_options(kind: Kind, *, arcs: bool = True) -> Callable[[_Command], _Command]:
    """Return what adds the options for a linkage on a cone or a cylinder; the command takes them as ``chosen``."""
    sizes, size = ("--angles", "--lambda") if kind == "cone" else ("--lengths", "--radius")
    what = (
        "Link angles in loop order, in degrees." if kind == "cone" else "Link lengths in loop order, in any one unit."
    )
    steps = "Signed steps round the surface in loop order, in degrees; the last may be left out."
    metavar, measure = ("DEGREES", "angle") if kind == "cone" else ("R", "radius")
    of_it = f"that of the steps; or, with {sizes}, the one that is chosen where several, or all of an interval, fit."
    every = [
        click.argument("file", required=False, metavar="[FILE]", type=options.FILE_NAME),
        options.value(f"{sizes} sizes", "A,B,...", what, type=options.NUMBERS),
        options.value("--steps", "A,B,...", steps, type=options.NUMBERS),
        options.value(f"{size} surface_size", metavar, f"{kind.title()} {measure}: {of_it}", type=float),
    ]
    if kind == "cone":
        text = "Half angle of the cone, in place of --lambda: 90 degrees less lambda."
        every.append(options.value("--half-angle", metavar, text, type=float))
    text = f"Row of conical candidates, from 1, of FILE (`synth enumerate conical -o FILE`); on the {kind} of {size}."
    every.append(options.number("--row", "K", text))
    if arcs:
        text = (
            "For a link that spans half a turn: the joint at which its arc begins, in the direction of "
            "increasing azimuth. May be repeated."
        )
        every.append(options.repeated("--arc arcs", "LINK=JOINT", text, type=options.WordType("arc", _arc)))

    def decorated(command: _Command) -> _Command:
        @wraps(command)
        def run_command(**values: Any) -> None:
            half_angle = values.pop("half_angle", None)
            if half_angle is not None:
                if values["surface_size"] is not None:
                    raise click.UsageError("--lambda and --half-angle exclude each other; try one of them")
                values["surface_size"] = 90.0 - half_angle
            names = ("file", "sizes", "steps", "surface_size", "row", "arcs")
            chosen = LinkageOptions(kind, *(values.pop(name, None) for name in names))
            command(chosen=chosen, **values)

        for option in reversed(every):
            run_command = option(run_command)
        return run_command

    return decorated


_GROUND = options.value(
    "--ground",
    "LINK",
    "Fixed link. By default the ground link or the first link of FILE; links of a loop by sizes or steps are 1, 2, ...",
)


@dataclass(frozen=True)
class MapOutput:
    """Where `synth cone map` and `synth cylinder map` write or draw a linkage, and on which surface."""

    path: str | None
    number: int | None
    force: bool

    def check(self, kind: Kind) -> None:
        """Refuse what cannot be written, before anything is computed for it."""
        if self.path is None and self.number is not None:
            raise click.UsageError(f"--{kind} requires -o")
        (out.check_output if _is_linkage(self.path) else out.check_picture)(self.path, force=self.force)

    def write(self, mapping: Mapping) -> str:
        """Write or draw, and return a sentence on the surface that was taken, if it was one of several.

        Without the number or the size of a surface the linkage is written without one, and a loop by its link
        sizes is drawn as its loop sums.
        """
        if self.path is None:
            return ""
        chosen, linkage = mapping.chosen, mapping.linkage
        if self.number is None and not mapping.chooses:
            if _is_linkage(self.path):
                _write(linkage, self.path, force=self.force)
                return ""
            if chosen.sizes is not None:
                synth.making.drawing.draw_loop_sums(chosen.loop_map).save(self.path, force=self.force)
                return ""
        every = mapping.placed()
        one = mapping.of_number(every, self.number)
        _write(one, self.path, force=self.force)
        place = every.index(one) + 1
        if mapping.chooses and len(every) > 1:
            return f"{chosen.kind} {place} of {len(every)}: {one.surface}; --{chosen.kind} chooses another"
        if linkage.steps is None and place > len(every) - len(mapping.answer().families):
            option = "--lambda" if chosen.kind == "cone" else "--radius"
            return f"{chosen.kind} {place}: {one.surface}, one of an interval; {option} chooses another"
        return ""


@dataclass(frozen=True)
class Mapping:
    """A linkage of the options, and the surfaces on which it lies."""

    chosen: LinkageOptions
    tolerance: float
    by_sizes: bool

    @cached_property
    def linkage(self) -> synth.SurfaceLinkage:
        """The linkage that is mapped: for --by-angles and --by-lengths without its steps."""
        linkage = self.chosen.linkage()
        return synth.linkages.surfaces.by_sizes(linkage) if self.by_sizes else linkage

    @property
    def chooses(self) -> bool:
        """Whether --lambda or --radius chooses one of the surfaces on which the sizes of links lie."""
        of_sizes = self.chosen.steps is None and not self.by_sizes and self.linkage.steps is None
        return of_sizes and self.chosen.surface is not None

    def answer(
        self,
    ) -> synth.linkages.surfaces.ConeMap | synth.linkages.surfaces.CylinderMap | synth.linkages.surfaces.LinkageMap:
        """Return every surface, or the chosen one."""
        if self.chosen.sizes is not None:
            return self.chosen.loop_map
        surface = self.chosen.surface if self.chooses else None
        return synth.map_linkage(self.linkage, radians(self.tolerance), surface)

    def placed(self) -> list[synth.linkages.conformed.OnSurface]:
        """Return the linkage on the surface of each numbered row."""
        if self.chosen.sizes is not None:
            return self.chosen.on_surfaces(families=True)
        surface = self.chosen.surface if self.chooses else None
        return synth.linkages.conformed.linkage_on_surfaces(
            self.linkage, surface, tolerance=radians(self.tolerance), families=True
        )

    def of_number(
        self, every: Sequence[synth.linkages.conformed.OnSurface], number: int | None
    ) -> synth.linkages.conformed.OnSurface:
        """Return the linkage on the surface of a number, of a chosen one by default the first."""
        from synth.linkages.conformed.linkage_behaviour import surface_of_number

        kind = self.chosen.kind
        if self.chooses and not every:
            size = "--lambda" if kind == "cone" else "--radius"
            raise UnsolvableError(
                f"the linkage does not lie on the {kind} of {self.chosen.surface}; try without {size}"
            )
        return surface_of_number(every, number or (1 if self.chooses else None), self.linkage.kind)


def _is_linkage(output: str | None) -> bool:
    return output is not None and output.lower().endswith(".json")


def _write(linkage: synth.SurfaceLinkage | synth.linkages.conformed.OnSurface, output: str, *, force: bool) -> None:
    """Write a linkage, with or without its surface, or draw it there."""
    if not isinstance(linkage, synth.linkages.conformed.OnSurface):
        synth.write(linkage, output, force=force)
    elif _is_linkage(output):
        synth.write(linkage.linkage(), output, force=force)
    else:
        _draw(linkage, output, force=force)


def _draw(linkage: synth.linkages.conformed.OnSurface, output: str, ground: Any = None, *, force: bool) -> None:
    chain = synth.linkages.conformed.ConformedChain.of(linkage.chain, ground)
    scene = synth.making.drawing.draw_conformed(chain, linkage.places, linkage.surface, begins=linkage.begins(chain))
    scene.save(output, force=force)


_MAP = {
    "cone": """Find the right cones on which a linkage lies, with all its joint axes on ruling lines.

    Give the link --angles of one loop (for a four-bar: ground, input, coupler, output), its --steps round a cone
    of angle --lambda, or a FILE of a linkage of several loops, with its link angles or with the steps between its
    joint axes. Parallelograms and kites lie on every cone of an interval: --lambda chooses one. `synth cone move`,
    `view`, `draw` and `template` read the .json that -o writes.

    \b
    Examples:
      synth cone map --angles 70,80,120,40
      synth cone map --angles 120,95,45,85 --cone 1 -o four-bar.json
      synth cone map --steps 40,50,50 --lambda 20 -o steps.json
      synth cone map --angles 120,50,120,50 --lambda 20 -o parallelogram.json
      synth cone map --angles 85,120,95,45 --supplementary
      synth cone map data/surfaces/fig11-stephenson.json
      synth cone map data/surfaces/fig11-stephenson.json --by-angles
    """,
    "cylinder": """Find the cylinders on which a planar linkage lies, with all its joint axes on ruling lines.

    Give the link --lengths of one loop (for a four-bar: ground, input, coupler, output), its --steps round a
    cylinder of --radius, or a FILE of a linkage of several loops. The radius is in the unit of the lengths.
    Parallelograms and kites lie on every cylinder from one radius on: --radius chooses one. `synth cylinder move`,
    `view`, `draw` and `template` read the .json that -o writes.

    \b
    Examples:
      synth cylinder map --lengths 4,3,5,1
      synth cylinder map --lengths 4,3,5,1 --cylinder 1 -o four-bar.json
      synth cylinder map --lengths 6,2,6,2 --radius 4 -o parallelogram.json
      synth cylinder map --steps 40,50,50 --radius 25 -o steps.json
      synth cylinder map --lengths 4,3,5,1,2 --json
    """,
}


def map_command(kind: Kind) -> click.Command:
    """Return the command that finds the surfaces of a kind on which a linkage lies."""
    sizes, link_sizes = ("angles", "link angles") if kind == "cone" else ("lengths", "lengths")

    by_text = f"For --steps or a FILE: find every {kind} on which the {link_sizes} lie, not only that of the steps."

    def options_of_kind(command: _Command) -> _Command:
        if kind == "cone":
            sixteen = "For a four-bar: list all 16 linkages on its joint lines."
            command = options.flag("--supplementary", sixteen)(command)
        return options.flag(f"--by-{sizes} by_sizes", by_text)(command)

    @click.command("map", help=_MAP[kind], short_help=f"Find every {kind} on which a linkage lies.")
    @linkage_options(kind, arcs=False)
    @options.value(
        "--tolerance", "DEGREES", "Largest misclosure of the loops of a FILE, in degrees.", default=1e-5,
        type=click.FloatRange(0, min_open=True),
    )  # fmt: skip
    @options_of_kind
    @options.output(
        f"Draw the loop sums, or the linkage for a FILE or with --{kind} (.png, .svg, .pdf); "
        "or write the linkage (.json).",
    )  # fmt: skip
    @options.number(
        f"--{kind} number", "K",
        f"Number of the {kind} in the table, to draw the linkage on it or to write it. By default the link {sizes} "
        f"are written, without a {kind}.",
    )  # fmt: skip
    @options.FORCE
    @options.JSON
    def command(
        chosen: LinkageOptions, by_sizes: bool, tolerance: float, as_json: bool, supplementary: bool = False,
        **where: Any,
    ) -> None:  # fmt: skip
        target = MapOutput(where["output"], where["number"], where["force"])
        if by_sizes and chosen.sizes is not None:
            raise click.UsageError(f"--by-{sizes} requires a FILE or --steps")
        taken = ""
        if supplementary:
            if chosen.sizes is None or target.path is not None:
                raise click.UsageError("--supplementary lists linkages for --angles, and writes none")
            answer: Any = synth.linkages.surfaces.supplementary_linkages(chosen.linkage_sizes)
        else:
            target.check(kind)
            with chosen.about():
                mapping = Mapping(chosen, tolerance, by_sizes)
                answer, taken = mapping.answer(), target.write(mapping)
        out.print_result(answer, {}, as_json=as_json, written=[target.path])
        if taken and not as_json:
            click.echo(taken)

    return command


_EXAMPLE = {
    "cone": ("--angles 120,95,45,85", "--lambda 20", "data/surfaces/fig11-stephenson.json"),
    "cylinder": ("--lengths 4,3,5,1", "--radius 25", "data/surfaces/fig10-four-bar.json"),
}
"""A loop by its sizes, the size of a surface, and a file, in the examples of the help."""


def behaviour_command(kind: Kind) -> click.Command:
    """Return the command that finds in which direction links leave a surface of a kind."""
    sizes, size, file = _EXAMPLE[kind]
    text = f"""Find which links can move inward (intramobile), outward (extramobile), or both ways (transmobile).

    The answer is to first order, from the conformed position. It does not depend on the size of the {kind}, and is
    the same on cones and cylinders. Give the links or the steps of one loop, or a FILE of a linkage. A link that
    spans half a turn may curve either way: both arcs are rows, unless --arc, or the sign of its step, chooses one.

    \b
    Examples:
      synth {kind} behaviour {sizes}
      synth {kind} behaviour --steps 40,50,50 {size} --ground 2
      synth {kind} behaviour --steps 40,50,90 --arc 4=1
      synth {kind} behaviour {file} --ground 2
    """

    @click.command(
        "behaviour", help=text, short_help=f"Find which links leave the {kind} inward, outward, or both ways."
    )
    @linkage_options(kind)
    @_GROUND
    @options.output("Draw the first linkage, as a circle and on its surface (.png, .svg, .pdf).", "PICTURE")
    @options.FORCE
    @options.JSON
    def command(chosen: LinkageOptions, ground: str | None, output: str | None, force: bool, as_json: bool) -> None:
        out.check_picture(output, force=force)
        with chosen.about():
            chosen.note_readings()
            linkages = chosen.on_surfaces()
            behaviours = [linkage.behaviour(options.link_of(linkage.chain, ground)) for linkage in linkages]
        if output is not None:
            if not behaviours:
                raise click.UsageError(f"there is no {kind} to draw")
            _draw(linkages[0], output, behaviours[0].chain.links[0], force=force)
        _print_linkages(behaviours, kind, as_json=as_json)
        if not as_json:
            out.tell_written(output)

    return command


def move_command(kind: Kind) -> click.Command:
    """Return the command that moves a linkage from its surface of a kind."""
    sizes, size, file = _EXAMPLE[kind]
    text = f"""Move a linkage with one degree of freedom from its conformed position, all round its circuit.

    The answer has the range of the driving joint, the side of the {kind} on which each link stays, and the
    circuit. With --at it lists the configurations of the circuit at given angles of the driving joint; there,
    --point gives the positions of points of links, and --axes the axis about which two links turn relative to
    each other.

    \b
    Examples:
      synth {kind} move {sizes}
      synth {kind} move {file} --at 0.1
      synth {kind} move --steps 50,110,80 {size} --at 0,10,20 --point 2,30 --axes 1,3
    """

    @click.command("move", help=text, short_help=f"Find how far a linkage moves from its {kind}, inward and outward.")
    @linkage_options(kind)
    @_GROUND
    @options.value("--driver", "JOINT", "Driving joint. By default the first joint of the fixed link.")
    @options.value(
        "--at", "A,B,...", "Angles of the driving joint at which to list configurations, in degrees.",
        type=options.NUMBERS,
    )  # fmt: skip
    @options.repeated(
        "--point points", "LINK,AZIMUTH[,ALONG]",
        "With --at: report the position of this point of a link. AZIMUTH is in degrees, ALONG a length on the "
        "ruling line, 1 by default. May be repeated."
    )  # fmt: skip
    @options.repeated("--axes", "LINK,LINK", "With --at: report the instant axis of two links. May be repeated.")
    @options.JSON
    def command(
        chosen: LinkageOptions, ground: str | None, driver: str | None, at: tuple[float, ...] | None,
        points: tuple[str, ...], axes: tuple[str, ...], as_json: bool,
    ) -> None:  # fmt: skip
        if (points or axes) and at is None:
            raise click.UsageError("--point and --axes require --at")
        with chosen.about():
            chosen.note_readings()
            motions = [
                synth.analysis.moving.move_on_surface(
                    linkage,
                    options.link_of(linkage.chain, ground),
                    options.joint_of(linkage.chain, driver),
                    options.in_radians(at or ()),
                    points=[_point(linkage, text) for text in points],
                    axes=[_pair(linkage, text) for text in axes],
                )
                for linkage in chosen.on_surfaces()
            ]
        _print_linkages(motions, kind, as_json=as_json)

    return command


def _turn(word: str) -> float:
    """Return an angle in degrees, which may name its unit."""
    number = word.removesuffix("deg").removesuffix("°").strip()
    try:
        return float(number)
    except ValueError:
        raise ValueError(f"{plain(word)!r} is not an angle in degrees, such as 60 or 60deg") from None


_TURN = options.WordType("angle", _turn)


@click.command("design", short_help="Find linkages on a cone that stay outside, or inside, for a turn.")
@options.value(
    "--half-angle", "DEGREES", "Half angle of the cone, between its axis and a ruling line.", type=_TURN, required=True
)
@options.value("--outside", "DEGREES", "Links stay outside the cone for this turn of the driving joint.", type=_TURN)
@options.value("--inside", "DEGREES", "Links stay inside the cone for this turn of the driving joint.", type=_TURN)
@options.value("--size", "MM", "Length of the ruling lines.", type=options.LENGTH, default=120.0)
@options.choice("--links", ("4", "6"), "Number of links, the fixed one too.", default="4", show_default=True)
@options.repeated(
    "--link keeping", "LINK",
    "Link that has to stay on that side; may be repeated. By default all links that move."
)  # fmt: skip
@options.value("--range least_range", "DEGREES", "Least range of the driving joint in all.", type=_TURN)
@options.number("--count", "N", "Largest number of linkages to list.", most=1000, default=8)
@options.number("--tries", "N", "Largest number of linkages to move.", most=10_000, default=60)
@options.seed("Random seed, for linkages of six links.")
@options.output("Write a linkage (.json), or draw it (.png, .svg, .pdf).")
@options.number("--row", "K", "With -o: number of the linkage in the table, from 1.", default=1)
@options.FORCE
@options.JSON
def design_command(
    half_angle: float, outside: float | None, inside: float | None, links: str, least_range: float | None,
    output: str | None, row: int, force: bool, as_json: bool, **how: Any,
) -> None:  # fmt: skip
    """Find linkages on a cone of a half angle whose links stay outside, or inside, for a turn of a joint.

    The table has the azimuths of joints, how far each link goes round the rim in millimetres, the turn that is
    reached, and margins: what it has to spare, how near two joints are at the rim, and which error of the azimuths
    leaves the behaviour as it is, to first order. The driving joint turns from the conformed position; links have
    no thickness. `synth cone move`, `view` and `template` read the .json that -o writes.

    \b
    Examples:
      synth cone design --half-angle 25 --outside 60deg
      synth cone design --half-angle 25 --size 120 --links 6 --outside 60 --row 2 -o six-bar.json
      synth cone design --half-angle 40 --inside 30 --range 90
      synth cone design --half-angle 25 --outside 120 --link 3

    Exit status 1: none was found.
    """
    if (outside is None) == (inside is None):
        raise click.UsageError("one of --outside and --inside is required")
    (out.check_output if _is_linkage(output) else out.check_picture)(output, force=force)
    turn = outside if outside is not None else inside
    assert turn is not None, "one of them is there"
    answer = synth.design_on_cone(
        radians(half_angle), radians(turn), links=6 if links == "6" else 4,
        side="outside" if inside is None else "inside", least_range=radians(least_range or 0.0), **how,
    )  # fmt: skip
    if output is not None and answer.designs:
        if row > len(answer.designs):
            raise click.UsageError(f"--row {row}: the table has {numbered(len(answer.designs), 'linkage')}")
        _write(answer.designs[row - 1].linkage, output, force=force)
    out.print_result(answer, {}, as_json=as_json, written=[output] if answer.designs else [])
    if not answer.designs:
        sys.exit(1)


def _print_linkages(answers: Sequence[Any], kind: Kind, *, as_json: bool) -> None:
    """Print the answers about a linkage on each of its surfaces."""
    if as_json:
        out.print_json({"linkages": [answer.to_json() for answer in answers]})
        return
    for answer in answers:
        out.print_answer(answer)
    if not answers:
        click.echo(f"no {kind}")


def _point(linkage: synth.linkages.conformed.OnSurface, text: str) -> synth.analysis.moving.LinkPoint:
    """Return a point of a link, by its azimuth at the conformed position and its length along the ruling line."""
    link, *numbers = text.split(",")
    try:
        azimuth, along = map(float, numbers if len(numbers) == 2 else [*numbers, "1"])
    except ValueError:
        raise click.UsageError(
            f"--point: {plain(text)!r} is not LINK,AZIMUTH or LINK,AZIMUTH,ALONG, such as 2,30"
        ) from None
    return synth.analysis.moving.LinkPoint(options.link_of(linkage.chain, link), radians(azimuth), along)


def _pair(linkage: synth.linkages.conformed.OnSurface, text: str) -> tuple[LinkId, LinkId]:
    names = text.split(",")
    if len(names) != 2:
        raise click.UsageError(f"--axes: {plain(text)!r} is not LINK,LINK, such as 1,3")
    first, second = (options.link_of(linkage.chain, name) for name in names)
    return first, second


def _group(kind: Kind) -> click.Group:
    linkages = "spherical" if kind == "cone" else "planar"
    sizes, *_ = _EXAMPLE[kind]
    text = f"""Map {linkages} linkages to right circular {kind}s, and find which links move inward or outward.

    \b
    Examples:
      synth {kind} map {sizes}
      synth {kind} behaviour {sizes}
      synth {kind} move {sizes}
    """
    group = click.Group(kind, help=text)
    for command in (map_command, behaviour_command, move_command):
        group.add_command(command(kind))
    if kind == "cone":
        group.add_command(design_command)
    return group


cone_group, cylinder_group = _group("cone"), _group("cylinder")
