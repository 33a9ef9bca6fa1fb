"""The option --precision, of all commands that take files with coordinates."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from synth.cli.lengths import LENGTH_OR_NONE

if TYPE_CHECKING:
    from graphs.convert.table import Mechanism

__all__ = ["PRECISION", "precise", "precise_sheet"]

_KEY = "synth.precision"


def _keep(ctx: click.Context, param: click.Parameter, value: float | None) -> None:
    ctx.meta[_KEY] = value


PRECISION = click.option(
    "--precision",
    type=LENGTH_OR_NONE,
    metavar="LENGTH",
    expose_value=False,
    callback=_keep,
    help="Largest error of a coordinate, in the unit of the file; 0 means exact. By default it "
    "is estimated from the file.",
)
"""The option; what it says is asked of `precise`."""


def _stated_length() -> float | None:
    """Return the length of --precision, None if it was not given."""
    length: float | None = click.get_current_context().meta.get(_KEY)
    return length


def precise(thing: Mechanism) -> Any:
    """Return what was read, precise as --precision states: a crease pattern, or the configuration of another."""
    from synth.moving.made import with_precision

    return with_precision(thing, _stated_length())


def precise_sheet(thing: Any) -> Any:
    """Return a crease pattern with the precision that --precision states; of other things it is refused."""
    from graphs.mechanism.precision import stated
    from graphs.mechanism.sheet import Sheet

    length = _stated_length()
    if length is None:
        return thing
    if not isinstance(thing, Sheet):
        raise click.UsageError("--precision is of the coordinates of a crease pattern")
    return stated(thing, length)
