"""Options that several commands have, types of options, and joints with numbers as they are typed."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees, pi, radians
from typing import TYPE_CHECKING, Any

import click

from graphs.limits import LEAST, MOST
from graphs.printing import plain

if TYPE_CHECKING:
    from graphs.mechanism.sc import SCGraph
    from graphs.mechanism.surfaces import Surface
    from graphs.types import JointId

__all__ = [
    "BRANCH",
    "FORCE",
    "LENGTH",
    "LENGTH_OR_NONE",
    "LOSSY",
    "LimitsType",
    "NumberList",
    "driven_angles",
    "in_radians",
    "named_value",
    "numbers_of_joints",
    "surface_from_options",
]

FORCE = click.option(
    "--force", is_flag=True, help="Overwrite an existing file, but never a folder, symbolic link or device."
)
"""The option of every command that writes a file."""

LOSSY = click.option("--lossy", is_flag=True, help="Write even if the output reads back as another type.")
"""The option of every command that writes a mechanism."""

_MOST_DIGITS = 9
"""Digits of the number of a branch: nobody lists more, and Python converts no more than some thousands."""


class _LengthType(click.ParamType):  # type: ignore[type-arg,unused-ignore]
    """A length, or a factor for lengths, in the range that coordinates have; with ``zero`` also 0."""

    name = "length"

    def __init__(self, *, zero: bool = False) -> None:
        self._zero = zero

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return the number."""
        try:
            number = float(value)
        except ValueError:
            self.fail(f"{plain(str(value), 100)!r} is not a number", param, ctx)
        if not (LEAST <= number <= MOST or (self._zero and number == 0.0)):
            also = "0, or " if self._zero else ""
            self.fail(f"{number:g} is out of range; expected {also}{LEAST:g} to {MOST:g}", param, ctx)
        return number


class _BranchType(click.ParamType):  # type: ignore[type-arg,unused-ignore]
    """A branch, as `synth fold --branches` lists them: its number, or its signs as text."""

    name = "branch"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int | str:
        """Return the number, or the signs."""
        if isinstance(value, int) or not (value.isascii() and value.isdigit()):
            return value  # type: ignore[no-any-return]
        if len(value) > _MOST_DIGITS:
            self.fail(f"no branch has a number of {len(value)} digits", param, ctx)
        return int(value)


class LimitsType(click.ParamType):  # type: ignore[type-arg,unused-ignore]
    """A number or a range: ``2``, ``2..4``, ``2..``, ``..4``."""

    name = "limits"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return limits."""
        from enumerate.runner.job import Limits

        if isinstance(value, Limits):
            return value
        low, dots, high = str(value).partition("..")
        if not dots:
            high = low
        numbers = [part for part in (low, high) if part]
        if not numbers or not all(part.isascii() and part.isdigit() and len(part) < 10 for part in numbers):
            self.fail(f"{plain(value)!r} is neither a number nor a range such as 2..4, 2.. or ..4", param, ctx)
        return Limits(int(low or 0), int(high) if high else None)


class NumberList(click.ParamType):  # type: ignore[type-arg,unused-ignore]
    """Numbers parted by commas, such as ``70,80,120,40``; for an axis exactly three."""

    name = "numbers"

    def __init__(self, *, axis: bool = False) -> None:
        self._axis = axis

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return a tuple of numbers."""
        if isinstance(value, tuple):
            return value
        try:
            numbers = tuple(float(part) for part in str(value).split(","))
        except ValueError:
            numbers = ()
        if not numbers or (self._axis and len(numbers) != 3):
            expected = "three numbers such as 0,0,1" if self._axis else "a list of numbers such as 70,80,120,40"
            self.fail(f"{plain(value)!r} is not {expected}", param, ctx)
        return numbers


LENGTH = _LengthType()
"""The type of --size, --scale, --thickness and the like."""
LENGTH_OR_NONE = _LengthType(zero=True)
"""The type of lengths that may be 0, such as --gap."""
BRANCH = _BranchType()
"""The type of --branch."""


def in_radians(values: Sequence[float]) -> list[float]:
    """Return angles in radians for angles in degrees; a note on stderr says if they look like radians already."""
    if len(values) > 1 and all(0 < abs(value) <= 2 * pi and value != round(value, 1) for value in values):
        first = f"{values[0]:g} looks like radians: {degrees(values[0]):.4g} degrees"
        click.echo(f"note: angles are read in degrees; {first}", err=True)
    return [radians(value) for value in values]


def surface_from_options(cone_angle: float | None, radius: float | None) -> Surface | None:
    """Return the cone of --lambda, in degrees, or the cylinder of --radius; None without either."""
    from graphs.mechanism.surfaces import Cone, Cylinder

    if cone_angle is not None and radius is not None:
        raise click.UsageError("--lambda (a cone) and --radius (a cylinder) exclude each other; try one of them")
    if cone_angle is not None:
        return Cone(radians(cone_angle))
    return None if radius is None else Cylinder(radius)


def named_value(text: str, option: str, form: str, lengths: Sequence[int] = (1,)) -> tuple[str, list[float]]:
    """Return a name and the numbers behind the last ``=``, parted by commas, of a word such as ``JOINT=DEGREES``.

    Raise click.BadParameter with the form if the number of numbers is not in ``lengths``.
    """
    name, equals, numbers = text.rpartition("=")
    try:
        values = [float(number) for number in numbers.split(",")]
    except ValueError:
        values = []
    if not equals or not name or len(values) not in lengths:
        raise click.BadParameter(f"{plain(text)!r} is not {form}", param_hint=option)
    return name.strip(), values


def numbers_of_joints(graph: SCGraph, words: tuple[str, ...], option: str, form: str) -> dict[JointId, float]:
    """Return the joints and numbers of an option; ``form`` is how they are typed, such as ``JOINT=DEGREES``."""
    from graphs.edit.named import joint_named

    pairs = (named_value(word, option, form) for word in words)
    return {joint_named(graph, name): number for name, [number] in pairs}


def driven_angles(graph: SCGraph, words: tuple[str, ...], option: str = "--drive") -> dict[JointId, float]:
    """Return the angles of joints, radians, of an option that has them in degrees."""
    angles = numbers_of_joints(graph, words, option, "JOINT=DEGREES")
    return {joint: radians(angle) for joint, angle in angles.items()}
