"""``synth id``: the canonical ids of a mechanism."""

from __future__ import annotations

import click

from synth.cli.output import about, print_answer, print_json
from synth.cli.reading import DRAWN, read

__all__ = ["id_command"]


@click.command("id", short_help="Print the canonical ids of a mechanism.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def id_command(file: str, as_json: bool) -> None:
    """Print the canonical ids of a mechanism: equal for mechanisms of one type, different for all others.

    k1:... is the id of the link-joint graph, a chain without centres. m1:... is the id of the mechanism drawn on
    the sphere, with its centres, and with the sides of its links where they are known. Every command that takes a
    FILE takes an id too; write ./k1:... for a file of that name.

    \b
    Examples:
      synth id data/wiener/six-bar.json
      synth id k1:Cr
    """
    from graphs.answer.identity import identify

    mechanism = read(file)
    with about(file):
        identity = identify(mechanism)
    if as_json:
        print_json(identity.to_json())
        return
    print_answer(identity)
