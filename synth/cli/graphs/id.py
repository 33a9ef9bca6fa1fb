"""``synth id``: the canonical ids of a mechanism."""

from __future__ import annotations

import click

from synth.cli.output import about, print_answer, print_json

__all__ = ["id_command"]


@click.command("id", short_help="The canonical ids of a mechanism.")
@click.argument("file", metavar="FILE")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def id_command(file: str, as_json: bool) -> None:
    """Say which type a mechanism is: ids that are equal for mechanisms of one type, and for no others.

    k1:... is the link-joint graph, a chain without centres. m1:... is the mechanism drawn on the sphere, with its
    centres and the sides of its links where they are known. Wherever a command takes a FILE it takes an id too; a
    file so named is written ./k1:...

    \b
    Examples:
      synth id data/wiener/six-bar.json
      synth id k1:Cr
    """
    from graphs.answer.identity import identify
    from graphs.files.formats import read

    mechanism = read(file)
    with about(file):
        identity = identify(mechanism)
    if as_json:
        print_json(identity.to_json())
        return
    print_answer(identity)
