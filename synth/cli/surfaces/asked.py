"""The linkage that ``synth cone`` and ``synth cylinder`` take: a loop by its links or steps, or a file."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, TypeVar

import click

from synth.cli.output import about
from synth.cli.surfaces.circles import NumberList, in_radians, surface_asked

if TYPE_CHECKING:
    from graphs.mechanism.surfaces import Surface, SurfaceLinkage
    from synth.conformed.linkages import OnSurface

__all__ = ["AskedLinkage", "Kind", "linkage_options"]

Kind = Literal["cone", "cylinder"]
_Command = TypeVar("_Command", bound=Callable[..., Any])


class _Arc(click.ParamType):  # type: ignore[type-arg,unused-ignore]
    """A link and the joint at which its arc begins, ``4=1``."""

    name = "arc"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the names of link and joint."""
        link, sign, joint = str(value).partition("=")
        if not (link and sign and joint):
            self.fail("expected LINK=JOINT, as 4=1", param, ctx)
        return link, joint


@dataclass(frozen=True)
class AskedLinkage:
    """A linkage as options name it: sizes are link angles in degrees, on cones, or lengths, on cylinders."""

    kind: Kind
    file: str | None
    sizes: tuple[float, ...] | None
    steps: tuple[float, ...] | None
    surface: Surface | None
    arcs: Mapping[str, str]

    @classmethod
    def of(cls, kind: Kind, options: Mapping[str, Any]) -> AskedLinkage:
        """Take what `linkage_options` read, and refuse what does not go together."""
        size, sizes = ("lambda", "angles") if kind == "cone" else ("radius", "lengths")
        file, given, steps = options["file"], options["sizes"], options["steps"]
        if sum(one is not None for one in (file, given, steps)) != 1:
            raise click.UsageError(f"give --{sizes} or --steps of one loop, or a FILE")
        number = options["surface_size"]
        if number is not None and given is not None:
            raise click.UsageError(f"--{sizes} tell the {kind} themselves: leave --{size} out")
        surface = surface_asked(number, None) if kind == "cone" else surface_asked(None, number)
        return cls(kind, file, given, steps, surface, dict(options.get("arcs") or ()))

    def about(self) -> AbstractContextManager[None]:
        """Name the file in errors."""
        return nullcontext() if self.file is None else about(self.file)

    @cached_property
    def linkage_sizes(self) -> Sequence[float]:
        """Lengths, or link angles in radians."""
        return in_radians(self.sizes or ()) if self.kind == "cone" else self.sizes or ()

    def linkage(self) -> SurfaceLinkage:
        """Return the linkage as it is given."""
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

        found = loop_of_steps(in_radians(self.steps or ()), self.surface)
        return found if self.kind == "cone" else replace(found, chain=as_planar(found.chain))

    def on_surfaces(self) -> list[OnSurface]:
        """Return the linkage on each of its surfaces."""
        from graphs.files.formats import read_linkage
        from synth.conformed.linkages import linkage_on_surfaces, loop_on_cones, loop_on_cylinders

        if self.file is not None:
            found = linkage_on_surfaces(read_linkage(self.file), self.surface)
        elif self.sizes is not None:
            found = (loop_on_cones if self.kind == "cone" else loop_on_cylinders)(self.linkage_sizes)
        else:
            found = [self._of_steps()]
        return [one.curved(self.arcs) for one in found] if self.arcs else found


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
