"""Reading the files that commands take, by the options on drawings and on the precision of coordinates.

The values of these options are kept with the context of the command, where `read` and `precise` find them: no
command hands them on.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from graphs.errors import FileError
from graphs.printing import plain
from synth.cli import options
from synth.cli.output import PATIENCE, about, progress_line

if TYPE_CHECKING:
    from enumerate.strings import ChainString
    from graphs.convert import Mechanism
    from graphs.files.formats import Entry
    from synth.linkages.conformed.orders import OrderOnCircle

_LOOKS, _PRECISION, _AT = "synthedra.stated", "synth.precision", "synthedra.at"
"""Keys under which the values of options are kept with the context."""
_MOST_DIGITS = 9
"""Digits of the number of a frame that are read: no file has more frames."""
_COMMA = re.compile(r",(?=[A-Za-z-]=)")
"""Between two pairs: colours such as rgb(0, 0, 255) have commas of their own."""

LOOK = "M=#c1272d,..."
"""How pairs are shown in the help."""


def keep_looks(ctx: click.Context, what: str, words: tuple[str, ...]) -> None:
    """Keep pairs LETTER=TEXT for the drawings that will be read."""
    looks = ctx.meta.setdefault(_LOOKS, {}).setdefault(what, {})
    for word in (part for text in words for part in _COMMA.split(text)):
        letter, equals, text = word.partition("=")
        if not equals or not text.strip():
            option = "--colour" if what == "colours" else "--layer"
            raise click.BadParameter(f"{plain(word)!r} is not LETTER=TEXT, such as M=red", param_hint=option)
        looks.setdefault(letter.strip(), []).append(text.strip())


COLOUR = options.repeated(
    "--colour", LOOK,
    "For a drawing (.svg, .dxf): assignment of lines by their colour, their dash pattern or both, such as "
    "'V=dashed #000000'. M mountain, V valley, B border, C cut, F flat, U unassigned; - leaves lines out.",
    expose_value=False, callback=lambda ctx, _parameter, words: keep_looks(ctx, "colours", words),
)  # fmt: skip
LAYER = options.repeated(
    "--layer", "M=NAME,...",
    "For a drawing (.svg, .dxf): assignment of lines by their layer or group, with the same letters.",
    expose_value=False, callback=lambda ctx, _parameter, words: keep_looks(ctx, "layers", words),
)  # fmt: skip


def DRAWN(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of every command that reads a drawing."""
    return COLOUR(LAYER(command))


def MECHANISM(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the argument FILE of a mechanism, and the options on drawings."""
    return options.FILE(DRAWN(command))


PRECISION = options.value(
    "--precision", "LENGTH",
    "Largest error of a coordinate, in the unit of the file; 0 means exact. By default it is estimated from the "
    "file.", type=options.LENGTH_OR_NONE, expose_value=False,
    callback=lambda ctx, _parameter, length: ctx.meta.update({_PRECISION: length}),
)  # fmt: skip
"""The option of commands that take files with coordinates; `precise` applies it."""

AT = options.repeated(
    "--at", "FRAME|JOINT=DEGREES",
    "Take another configuration than that of the file: a frame of a .fold file by its number (0 is the key frame) or "
    "`last`, or the angle of a joint, which may be repeated; the other joints follow as in `synth fold`.",
    expose_value=False, callback=lambda ctx, _parameter, words: ctx.meta.update({_AT: words}),
)  # fmt: skip
"""The option of commands that answer for a configuration; `read` applies it."""

ROW = options.number("--row", "N", "For a store, a list or a folder: number of the row to take, counted from 1.")
"""The option of commands that take one mechanism of many."""

MODE = options.value("--mode", "SD...", "For an R/- string: its mode, as `synth enumerate strings --modes` lists it.")
"""The option of commands that take R/- strings."""


def stated() -> dict[str, Any]:
    """Return the values of --colour and --layer, as keywords of `graphs.files.read`."""
    context = click.get_current_context(silent=True)
    looks = {} if context is None else context.meta.get(_LOOKS, {})
    return {what: pairs for what, pairs in looks.items() if pairs}


def read(file: str, *, warn: bool = True) -> Mechanism:
    """Read a file by the options on drawings and --at; with `warn`, warn on stderr of lines that are left out."""
    from graphs.files.formats import read as read_file

    mechanism = read_file(file, **stated())
    reading = getattr(mechanism, "reading", None)
    if warn and reading is not None and reading.warning:
        click.echo(f"{plain(file, 4096)}: {plain(reading.warning, 1000)}", err=True)
    return _in_configuration(mechanism, file)


def _in_configuration(mechanism: Mechanism, file: str) -> Mechanism:
    """Return a mechanism in the configuration of --at, if it is there."""
    context = click.get_current_context(silent=True)
    words = () if context is None else context.meta.get(_AT, ())
    if not words:
        return mechanism
    from synth.analysis.moving import configuration_of, in_configuration

    frames = [word for word in words if "=" not in word]
    if len(frames) > 1 or not all(word == "last" or (word.isascii() and word.isdigit()) for word in frames):
        wrong = f"{plain(' '.join(frames))!r} is neither one frame (a number, or last) nor JOINT=DEGREES"
        raise click.BadParameter(wrong, param_hint="--at")
    turns = tuple(word for word in words if "=" in word)
    with about(file):
        for word in frames:
            mechanism = in_configuration(mechanism, "last" if word == "last" else int(word[:_MOST_DIGITS]))
        if turns:
            graph = configuration_of(mechanism, precision=precision()).linkage.graph
            angles = options.driven_angles(graph, turns, "--at")
            mechanism = in_configuration(mechanism, angles=angles, precision=precision())
    return mechanism


def precision() -> float | None:
    """Return the length of --precision, if it is there."""
    length: float | None = click.get_current_context().meta.get(_PRECISION)
    return length


def precise(mechanism: Mechanism) -> Any:
    """Return a mechanism with the precision of --precision: a crease pattern, or the configuration of another."""
    from synth.analysis.moving._configuration_of import with_precision

    return with_precision(mechanism, precision())


def precise_sheet(mechanism: Any) -> Any:
    """Return a crease pattern with the precision of --precision, which is refused for any other mechanism."""
    from graphs.mechanism.precision import stated as with_stated_precision
    from graphs.mechanism.sheet import Sheet

    length = precision()
    if length is None:
        return mechanism
    if not isinstance(mechanism, Sheet):
        raise click.UsageError("--precision applies to the coordinates of a crease pattern only")
    return with_stated_precision(mechanism, length)


@dataclass(frozen=True, slots=True)
class NamedMechanism:
    """The mechanism of an argument, its name there (a file, an id, a string), and the mode of an R/- string."""

    mechanism: Mechanism | ChainString | OrderOnCircle
    name: str
    mode: str | None = None


def read_named(argument: str, row: int | None = None, mode: str | None = None) -> NamedMechanism:
    """Return the mechanism that an argument names: a file, an id ``k1:...`` or ``m1:...``, an R/- string.

    With a row, from 1, it is one of a store, a list or a folder; a row of a list of modes has its own mode. Raise
    click.UsageError if a row is required and missing, or the other way round.
    """
    from synth.making.drawing.list_pages import entry_numbered, is_catalogue

    if is_catalogue(argument):
        if row is None:
            raise click.UsageError("a store, a list or a folder requires --row N, the number of one of its rows")
        entry = entry_numbered(argument, row)
        mechanism: Any = entry.mechanism
        return NamedMechanism(_in_configuration(mechanism, entry.name), entry.name, mode or entry.mode)
    if row is not None:
        raise click.UsageError("--row requires a store, a list or a folder")
    if argument and set(argument) <= set("R-"):  # a file so named has no extension, and would not be read
        from enumerate.strings import ChainString

        name = f"{argument} {mode}" if mode else argument
        return NamedMechanism(ChainString.parse(argument), name, mode)
    return NamedMechanism(read(argument), argument, mode)


def entries(files: Sequence[str], failures: list[str], patience: float = PATIENCE) -> Iterator[Entry]:
    """Yield the mechanisms of files, with progress; the error of a file that cannot be read joins the failures."""
    from graphs.files.formats import read_all

    with progress_line(patience) as show:
        for number, file in enumerate(files, start=1):
            try:
                yield from read_all(file, **stated())
            except FileError as error:
                failures.append(str(error))
            show(f"{number} of {len(files)} files")
