"""Options and arguments that several commands have, how they are written, and the types of their values."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from math import degrees, pi, radians
from typing import TYPE_CHECKING, Any, TypeVar

import click

from graphs.input_limits import LEAST, MOST
from graphs.printing import plain

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

    from enumerate.runner import Limits
    from graphs.mechanism import SCGraph
    from graphs.mechanism.surfaces import Surface
    from graphs.types import JointId, LinkId

_MOST_DIGITS = 9
"""Digits of the number of a branch: nobody lists more, and Python converts no more than some thousands."""

_Command = TypeVar("_Command", bound=Callable[..., Any] | click.Command)


class _FileName(click.ParamType):  # type: ignore[type-arg,unused-ignore]
    """The name of a file, or what stands for one, such as an id: shells complete it as a file."""

    name = "file"

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """Leave it to the shell to complete the name."""
        from click.shell_completion import CompletionItem

        del ctx, param
        return [CompletionItem(incomplete, type="file")]


class WordType(click.ParamType):  # type: ignore[type-arg,unused-ignore]
    """The values that a function reads from words; it raises ValueError with what is wrong with one."""

    def __init__(self, name: str, read: Callable[[str], Any]) -> None:
        self.name, self._read = name, read

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the value of a word; a default is one already."""
        try:
            return self._read(value) if isinstance(value, str) else value
        except ValueError as error:
            self.fail(str(error), param, ctx)


def _length(word: str, *, zero: bool = False) -> float:
    """Return a length, or a factor for lengths, in the range that coordinates have; with `zero` also 0."""
    try:
        length = float(word)
    except ValueError:
        raise ValueError(f"{plain(word, 100)!r} is not a number") from None
    if not (LEAST <= length <= MOST or (zero and length == 0.0)):
        also = "0, or " if zero else ""
        raise ValueError(f"{length:g} is out of range; expected {also}{LEAST:g} to {MOST:g}")
    return length


def _thickness(word: str) -> float:
    """Return a length; 0 too, which is refused where solids are made, in a line that names the file."""
    with suppress(ValueError):
        if float(word) == 0.0:
            return 0.0
    return _length(word)


def _branch(word: str) -> int | str:
    """Return the number of a branch, as `synth fold --branches` lists them, or its signs."""
    if not (word.isascii() and word.isdigit()):
        return word
    if len(word) > _MOST_DIGITS:
        raise ValueError(f"no branch has a number of {len(word)} digits")
    return int(word)


def limits_of(word: str) -> Limits:
    """Return the limits of a number or a range: ``2``, ``2..4``, ``2..``, ``..4``; ValueError for another word."""
    from enumerate.runner import Limits

    low, dots, high = word.partition("..")
    if not dots:
        high = low
    numbers = [part for part in (low, high) if part]
    if not numbers or not all(part.isascii() and part.isdigit() and len(part) < 10 for part in numbers):
        raise ValueError(f"{plain(word)!r} is neither a number nor a range such as 2..4, 2.. or ..4")
    return Limits(int(low or 0), int(high) if high else None)


def _numbers(word: str, *, axis: bool = False) -> tuple[float, ...]:
    """Return numbers parted by commas, such as ``70,80,120,40``; for an axis exactly three."""
    try:
        numbers = tuple(float(part) for part in word.split(","))
    except ValueError:
        numbers = ()
    if not numbers or (axis and len(numbers) != 3):
        expected = "three numbers such as 0,0,1" if axis else "a list of numbers such as 70,80,120,40"
        raise ValueError(f"{plain(word)!r} is not {expected}")
    return numbers


LENGTH = WordType("length", _length)
"""The type of --size, --scale, --thickness and the like."""
LENGTH_OR_NONE = WordType("length", partial(_length, zero=True))
"""The type of lengths that may be 0, such as --gap."""
THICKNESS = WordType("length", _thickness)
NUMBERS = WordType("numbers", _numbers)
AXIS = WordType("numbers", partial(_numbers, axis=True))
BRANCH = WordType("branch", _branch)
"""The type of options for a branch."""
FILE_NAME = _FileName()
"""The type of arguments and options that name files."""


def value(
    names: str, metavar: str | None, text: str, *, default: Any = None, **settings: Any
) -> Callable[[_Command], _Command]:
    """Return an option of click: its names parted by spaces, the parameter of the command last if it is another.

    A default is shown in the help.
    """
    if default is not None:
        settings = {"default": default, "show_default": True, **settings}
    return click.option(*names.split(), metavar=metavar, help=text, **settings)


def repeated(names: str, metavar: str, text: str, **settings: Any) -> Callable[[_Command], _Command]:
    """Return an option that may be given several times."""
    return click.option(*names.split(), metavar=metavar, help=text, multiple=True, **settings)


def flag(names: str, text: str, *, default: bool | None = None) -> Callable[[_Command], _Command]:
    """Return an option without a value; one of two names, ``--this/--that``, has a default."""
    if "/" in names:
        return click.option(*names.split(), default=default, show_default=default is not None, help=text)
    return click.option(*names.split(), is_flag=True, help=text)


def number(
    names: str, metavar: str, text: str, least: int | None = 1, most: int | None = None, **settings: Any
) -> Callable[[_Command], _Command]:
    """Return an option for a whole number in a range."""
    return value(names, metavar, text, type=click.IntRange(least, most), **settings)


def limits(names: str, text: str) -> Callable[[_Command], _Command]:
    """Return an option for a number or a range of numbers."""
    return value(names, "K", text, type=WordType("limits", limits_of))


def choice(names: str, values: Sequence[str], text: str, **settings: Any) -> Callable[[_Command], _Command]:
    """Return an option whose value is one of some words."""
    return value(names, settings.pop("metavar", None), text, type=click.Choice(values), **settings)


def output(
    text: str, metavar: str = "OUT", names: str = "-o --output", *, required: bool = False
) -> Callable[[_Command], _Command]:
    """Return the option for the file to write."""
    return value(names, metavar, text, type=FILE_NAME, required=required)


def branch(text: str, metavar: str = "K") -> Callable[[_Command], _Command]:
    """Return the option --branch."""
    return value("--branch", metavar, text, type=BRANCH)


FILE = click.argument("file", metavar="FILE", type=FILE_NAME)
FILES = click.argument("files", metavar="FILE...", nargs=-1, required=True, type=FILE_NAME)
FORCE = flag("--force", "Overwrite an existing file, but never a folder, symbolic link or device.")
"""The option of every command that writes a file."""
LOSSY = flag("--lossy", "Write even if the output reads back as another type.")
"""The option of every command that writes a mechanism."""
JSON = flag("--json as_json", "Print the answer as JSON.")
WORKERS = number("--workers", "N", "Number of processes. By default one per core.")
NUMBER_OF_SURFACE = number(
    "--cone --cylinder number", "K",
    "For a linkage that lies on several cones or cylinders: number of the cone or cylinder to use, from 1.",
)  # fmt: skip


def seed(text: str) -> Callable[[_Command], _Command]:
    """Return the option --seed."""
    return number("--seed", "N", text, 0, default=0)


def stated_values(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the values of options that were stated: what takes them has defaults for the others."""
    return {name: value for name, value in values.items() if value is not None}


def in_radians(values: Sequence[float]) -> list[float]:
    """Return angles in radians for angles in degrees; a note on stderr says if they look like radians already."""
    if len(values) > 1 and all(0 < abs(value) <= 2 * pi and value != round(value, 1) for value in values):
        first = f"{values[0]:g} looks like radians: {degrees(values[0]):.4g} degrees"
        click.echo(f"note: angles are read in degrees; {first}", err=True)
    return [radians(value) for value in values]


_HALF_ANGLE = "synth.half_angle"
"""Key of ``ctx.meta`` under which --half-angle is kept for --lambda."""


def cone_angle(text: str) -> Callable[[_Command], _Command]:
    """Return the options --lambda, with its help, and --half-angle: 90 degrees less lambda; they exclude each other."""

    def keep(ctx: click.Context, _parameter: click.Parameter, half_angle: float | None) -> None:
        ctx.meta[_HALF_ANGLE] = half_angle

    def read(ctx: click.Context, _parameter: click.Parameter, angle: float | None) -> float | None:
        half_angle = ctx.meta.get(_HALF_ANGLE)
        if angle is not None and half_angle is not None:
            raise click.UsageError("--lambda and --half-angle exclude each other; try one of them")
        return angle if half_angle is None else 90.0 - half_angle

    def both(command: _Command) -> _Command:
        command = value(
            "--half-angle", "DEGREES", "Half angle of the cone: 90 degrees less lambda.", type=float, is_eager=True,
            expose_value=False, callback=keep,
        )(command)  # fmt: skip
        return value("--lambda cone_angle", "DEGREES", text, type=float, callback=read)(command)

    return both


def surface_from_options(cone_angle: float | None, radius: float | None) -> Surface | None:
    """Return the cone of --lambda, in degrees, or the cylinder of --radius; None without either."""
    from graphs.mechanism.surfaces import Cone, Cylinder

    if cone_angle is not None and radius is not None:
        raise click.UsageError("--lambda (a cone) and --radius (a cylinder) exclude each other; try one of them")
    if cone_angle is not None:
        return Cone(radians(cone_angle))
    return None if radius is None else Cylinder(radius)


_ONE_VALUE = re.compile(r"[^=,]+=\s*[-+.\d][^=,]*").fullmatch
"""Whether a word is a name and a number."""


def named_value(text: str, spelling: str, form: str, lengths: Sequence[int] = (1,)) -> tuple[str, list[float]]:
    """Return a name and the numbers behind the last ``=``, parted by commas, of a word such as ``JOINT=DEGREES``.

    Raise click.BadParameter with the form if the number of numbers is not in ``lengths``, or the word is several
    of them.
    """
    if all(map(_ONE_VALUE, text.split(","))) and "," in text:
        raise click.BadParameter(
            f"{plain(text)!r}: one {form} at a time; try {spelling} once for each", param_hint=spelling
        )
    name, equals, numbers = text.rpartition("=")
    try:
        values = [float(number) for number in numbers.split(",")]
    except ValueError:
        values = []
    if not equals or not name or len(values) not in lengths:
        raise click.BadParameter(f"{plain(text)!r} is not {form}", param_hint=spelling)
    return name.strip(), values


def link_of(graph: SCGraph, name: str | None) -> LinkId:
    """Return the link that a word names; None without a word."""
    from graphs.edit.named import link_named

    return None if name is None else link_named(graph, name)


def joint_of(graph: SCGraph, name: str | None) -> JointId:
    """Return the joint that a word names: an id, a number, or two links A,B; None without a word."""
    from graphs.edit.named import joint_named

    return None if name is None else joint_named(graph, name)


def numbers_of_joints(graph: SCGraph, words: tuple[str, ...], spelling: str, form: str) -> dict[JointId, float]:
    """Return the joints and numbers of an option; ``form`` is how they are typed, such as ``JOINT=DEGREES``."""
    pairs = (named_value(word, spelling, form) for word in words)
    return {joint_of(graph, name): value for name, [value] in pairs}


def driven_angles(graph: SCGraph, words: tuple[str, ...], spelling: str = "--drive") -> dict[JointId, float]:
    """Return the angles of joints, radians, of an option that has them in degrees."""
    angles = numbers_of_joints(graph, words, spelling, "JOINT=DEGREES")
    return {joint: radians(angle) for joint, angle in angles.items()}


def weights_of(words: tuple[str, ...]) -> tuple[tuple[int, float], ...]:
    """Return the numbers of wishes, from 0, and their weights, of --weigh."""
    weights = {}
    for word in words:
        name, [weight] = named_value(word, "--weigh", "K=WEIGHT")
        if not name.isascii() or not name.isdigit() or int(name) < 1 or weight < 0.0:
            raise click.UsageError(
                f"--weigh {word}: expected K=WEIGHT, a wish from 1 and a weight that is not negative"
            )
        weights[int(name) - 1] = weight
    return tuple(sorted(weights.items()))
