"""What ``synth cone``, ``synth cylinder`` and others share: lists of numbers, and surfaces."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees, pi, radians
from typing import TYPE_CHECKING, Any

import click

from synth.cli.output import plain

if TYPE_CHECKING:
    from graphs.mechanism.surfaces import Surface

__all__ = ["NumberList", "in_radians", "surface_asked"]


class NumberList(click.ParamType):  # type: ignore[type-arg,unused-ignore]
    """Numbers parted by commas, ``70,80,120,40``."""

    name = "numbers"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return a tuple of numbers."""
        if isinstance(value, tuple):
            return value
        try:
            return tuple(float(part) for part in str(value).split(","))
        except ValueError:
            self.fail(f"{plain(value)!r} is no list of numbers such as 70,80,120,40", param, ctx)


def in_radians(values: Sequence[float]) -> list[float]:
    """Return angles given in degrees; where they look like radians, that is said on stderr."""
    if len(values) > 1 and all(0 < abs(value) <= 2 * pi and value != round(value, 1) for value in values):
        first = f"{values[0]:g} looks like radians: {degrees(values[0]):.4g} degrees"
        click.echo(f"note: angles are taken in degrees; {first}", err=True)
    return [radians(value) for value in values]


def surface_asked(cone_angle: float | None, radius: float | None) -> Surface | None:
    """Return the cone of --lambda, in degrees, or the cylinder of --radius."""
    from graphs.mechanism.surfaces import Cone, Cylinder

    if cone_angle is not None and radius is not None:
        raise click.UsageError("--lambda is of a cone, --radius of a cylinder: one of them")
    if cone_angle is not None:
        return Cone(radians(cone_angle))
    return None if radius is None else Cylinder(radius)
