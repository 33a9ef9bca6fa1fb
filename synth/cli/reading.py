"""Options on how a drawing is read, shared by the commands that take one; and reading by them.

They are kept with the context of the command, where `read` finds them: no command hands them on.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

from graphs.printing import plain

if TYPE_CHECKING:
    from graphs.convert.table import Mechanism

__all__ = ["COLOUR", "DRAWN", "LAYER", "LOOK", "keep_looks", "read", "stated"]

_KEY = "synthedra.stated"
_COMMA = re.compile(r",(?=[A-Za-z-]=)")
"""Between two pairs: colours such as rgb(0, 0, 255) have commas of their own."""

LOOK = "M=#c1272d,..."
"""How pairs are shown in the help."""


def _keep(ctx: click.Context, what: str, words: tuple[str, ...]) -> None:
    """Keep pairs LETTER=TEXT for what will be read."""
    kept = ctx.meta.setdefault(_KEY, {}).setdefault(what, {})
    for word in (part for text in words for part in _COMMA.split(text)):
        letter, equals, text = word.partition("=")
        if not equals or not text.strip():
            option = "--colour" if what == "colours" else "--layer"
            raise click.BadParameter(f"{plain(word)!r} is not LETTER=TEXT, such as M=red", param_hint=option)
        kept.setdefault(letter.strip(), []).append(text.strip())


def keep_looks(ctx: click.Context, words: tuple[str, ...]) -> None:
    """Keep pairs of an assignment and a look for what will be read."""
    _keep(ctx, "colours", words)


def _colours(ctx: click.Context, parameter: click.Parameter, words: tuple[str, ...]) -> None:
    del parameter
    keep_looks(ctx, words)


def _layers(ctx: click.Context, parameter: click.Parameter, words: tuple[str, ...]) -> None:
    del parameter
    _keep(ctx, "layers", words)


COLOUR = click.option(
    "--colour",
    multiple=True,
    metavar=LOOK,
    expose_value=False,
    callback=_colours,
    help="For a drawing (.svg, .dxf): assignment of the lines of a colour, a dash pattern or "
    "both ('V=dashed #000000'). M mountain, V valley, B border, C cut, F flat, U "
    "unassigned, - leaves them out.",
)
LAYER = click.option(
    "--layer",
    multiple=True,
    metavar="M=NAME,...",
    expose_value=False,
    callback=_layers,
    help="For a drawing (.svg, .dxf): assignment of the lines of a layer or group, by the same letters.",
)


def DRAWN(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of every command that reads a drawing."""
    return COLOUR(LAYER(command))


def stated() -> dict[str, Any]:
    """Return what was stated of drawings, as keywords of `graphs.files.read`."""
    context = click.get_current_context(silent=True)
    kept = {} if context is None else context.meta.get(_KEY, {})
    return {what: pairs for what, pairs in kept.items() if pairs}


def read(file: str, *, warn: bool = True) -> Mechanism:
    """Read a file as is stated; on standard error, say what was left out of a drawing, unless the answer does."""
    from graphs.files.formats import read as read_file

    thing = read_file(file, **stated())
    reading = getattr(thing, "reading", None)
    if warn and reading is not None and reading.warning:
        click.echo(f"{plain(file, 4096)}: {plain(reading.warning, 1000)}", err=True)
    return thing
