"""Reading the files that commands take, by the options on drawings and on the precision of coordinates.

The values of these options are kept with the context of the command, where `read` and `precise` find them: no
command hands them on.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from graphs.printing import plain
from synth.cli import options

if TYPE_CHECKING:
    from enumerate.strings import ChainString
    from graphs.convert import Mechanism
    from synth.drawing.mechanisms.chains import OrderOnCircle

_LOOKS, _PRECISION = "synthedra.stated", "synth.precision"
"""Keys under which the values of options are kept with the context."""
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
    """Read a file by the options on drawings; with `warn`, warn on stderr of lines that are left out."""
    from graphs.files.formats import read as read_file

    mechanism = read_file(file, **stated())
    reading = getattr(mechanism, "reading", None)
    if warn and reading is not None and reading.warning:
        click.echo(f"{plain(file, 4096)}: {plain(reading.warning, 1000)}", err=True)
    return mechanism


def precision() -> float | None:
    """Return the length of --precision, if it is there."""
    length: float | None = click.get_current_context().meta.get(_PRECISION)
    return length


def precise(mechanism: Mechanism) -> Any:
    """Return a mechanism with the precision of --precision: a crease pattern, or the configuration of another."""
    from synth.moving.made import with_precision

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
    from synth.drawing.catalogue import entry_numbered, is_catalogue

    if is_catalogue(argument):
        if row is None:
            raise click.UsageError("a store, a list or a folder requires --row N, the number of one of its rows")
        entry = entry_numbered(argument, row)
        return NamedMechanism(entry.mechanism, entry.name, mode or entry.mode)
    if row is not None:
        raise click.UsageError("--row requires a store, a list or a folder")
    if argument and set(argument) <= set("R-"):  # a file so named has no extension, and would not be read
        from enumerate.strings import ChainString

        name = f"{argument} {mode}" if mode else argument
        return NamedMechanism(ChainString.parse(argument), name, mode)
    return NamedMechanism(read(argument), argument, mode)
