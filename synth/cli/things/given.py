"""What a command about things is given: a file, an id, an R/- string, or one of many by its number."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import click

from synth.cli.reading import read

if TYPE_CHECKING:
    from enumerate.strings.panel_strings import ChainString
    from graphs.convert.table import Mechanism
    from synth.drawing.mechanisms.chains import OrderOnCircle

__all__ = ["MODE", "ROW", "Given", "given"]

ROW = click.option(
    "--row",
    type=click.IntRange(min=1),
    metavar="N",
    help="For a store, a list or a folder: number of the row to take, counted from 1.",
)
"""The option of commands that take one mechanism of many."""

MODE = click.option(
    "--mode", metavar="SD...", help="For an R/- string: its mode, as `synth enumerate strings --modes` lists it."
)
"""The option of commands that take R/- strings."""


@dataclass(frozen=True, slots=True)
class Given:
    """The mechanism of an argument, with its name there: a file, an id, a string.

    `mode` is that of an R/- string.
    """

    thing: Mechanism | ChainString | OrderOnCircle
    name: str
    mode: str | None = None


def given(argument: str, row: int | None = None, mode: str | None = None) -> Given:
    """Return what an argument names: a file, an id ``k1:...`` or ``m1:...``, an R/- string.

    With a row, from 1, it is one of a store, a list or a folder. The mode is that of an R/- string; a row of a
    list of modes has its own. Raise click.UsageError if a row is required and missing, or the other way round;
    FileError if the file cannot be read, or has no such row.

    >>> given("RR-R-RRR").thing
    ChainString(clusters=(2, 1, 3))
    """
    from synth.drawing.catalogue import entry_numbered, is_catalogue

    if is_catalogue(argument):
        if row is None:
            raise click.UsageError("--row N says which one of a store, a list or a folder")
        entry = entry_numbered(argument, row)
        return Given(entry.mechanism, entry.name, mode or entry.mode)
    if row is not None:
        raise click.UsageError("--row is of many: a store, a list or a folder")
    if _is_string(argument):
        from enumerate.strings.panel_strings import ChainString

        return Given(ChainString.parse(argument), f"{argument} {mode}" if mode else argument, mode)
    return Given(read(argument), argument, mode)


def _is_string(argument: str) -> bool:
    """Tell whether what is given is an R/- string; a file so named has no extension, and would not be read."""
    return bool(argument) and set(argument) <= set("R-")
