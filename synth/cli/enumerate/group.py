"""``synth enumerate``: all mechanisms of a kind."""

from __future__ import annotations

import click

from synth.cli.enumerate.addenda import addenda
from synth.cli.enumerate.chains import chains
from synth.cli.enumerate.conical import conical
from synth.cli.enumerate.sc import sc
from synth.cli.enumerate.scd import scd
from synth.cli.enumerate.strings import strings

__all__ = ["enumerate_group"]


@click.group("enumerate", short_help="List or count all mechanisms of a kind.")
def enumerate_group() -> None:
    """List or count all mechanisms of a kind.

    \b
    Examples:
      synth enumerate strings --max-dof 6
      synth enumerate chains --links 8 --dof 1
      synth enumerate sc --links 8 --dof 1 --centres 3
      synth enumerate scd --links 4 --dof 1 --max-degree 4
      synth enumerate conical --chain watt
    """


for _command in (strings, chains, sc, scd, addenda, conical):
    enumerate_group.add_command(_command)
