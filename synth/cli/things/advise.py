"""``synth advise``: what to lock, or which panels to crease, for a number of freedoms."""

from __future__ import annotations

import sys

import click

from synth.cli.lengths import BRANCH
from synth.cli.output import about, plain, print_json

__all__ = ["advise"]


@click.command(short_help="Say what to lock, or which panels to crease, for a number of freedoms.")
@click.argument("file", metavar="FILE")
@click.option("--freedoms", type=click.IntRange(0), required=True, metavar="K", help="Freedoms that are wanted.")
@click.option(
    "--branch", type=BRANCH, metavar="B", help="Of this way from a flat state: its number, or its signs."
)
@click.option(
    "--weight", multiple=True, metavar="JOINT=W", help="What locking a joint costs (1); may be repeated."
)
@click.option("--protect-joint", multiple=True, metavar="JOINT", help="Do not lock it; may be repeated.")
@click.option("--protect-link", multiple=True, metavar="LINK", help="Do not lock its joints, nor crease it.")
@click.option(
    "--flaps/--no-flaps", default=True, show_default=True, help="Lock flaps too; cut corners off as flaps."
)
@click.option("--limit", type=click.IntRange(1, 10_000), default=20, show_default=True, help="Sets to list.")
@click.option("--size", type=click.IntRange(1), metavar="N", help="Largest set of diagonals; K - M + 1.")
@click.option("--leave-out", is_flag=True, help="Of a flat sheet: tell what it has without these creases, too.")
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
def advise(
    file: str,
    freedoms: int,
    branch: int | str | None,
    weight: tuple[str, ...],
    protect_joint: tuple[str, ...],
    protect_link: tuple[str, ...],
    flaps: bool,
    limit: int,
    size: int | None,
    leave_out: bool,
    as_json: bool,
) -> None:
    """Say which joints to lock, or which panels to crease along diagonals, so that K freedoms are left.

    Of M freedoms M - K joints have to be locked: all such sets, cheapest first. Or K - M diagonals and more to be
    creased: the smallest sets, each folded. From a flat state on the way that the marks choose, or --branch.
    Play is how much larger than that of the locked joints the play of the rest may be. JOINT is an id, or two
    links A,B.

    \b
    Examples:
      synth advise data/patterns/bird-base.fold --freedoms 0
      synth generate miura --rows 4 --columns 4 --fold 60 -o miura.fold
      synth advise miura.fold --freedoms 2

    Exit status 1: no set of diagonals was found.
    """
    from graphs.convert.duality import mechanism_of_sheet
    from graphs.edit.named import joint_named, link_named
    from graphs.files.formats import read
    from synth.advice.advised import advise as advised
    from synth.moving.made import configuration_of, sheet_of

    thing = read(file)
    with about(file):
        sheet = sheet_of(thing)
        graph = configuration_of(thing).linkage.graph if sheet is None else mechanism_of_sheet(sheet).sc
        found = advised(
            thing,
            freedoms,
            branch=branch,
            weights={joint_named(graph, name): value for name, value in _weights(weight)},
            joints=[joint_named(graph, name) for name in protect_joint],
            links=[link_named(graph, name) for name in protect_link],
            flaps=flaps,
            limit=limit,
            size=size,
            leave_out=leave_out,
        )
    if as_json:
        print_json({"file": file, **found.to_json()})
    else:
        click.echo(str(found))
    if found.wanted > found.freedoms and not found.creases:
        sys.exit(1)


def _weights(words: tuple[str, ...]) -> list[tuple[str, float]]:
    """Return names of joints and their weights, as they were typed."""
    made = []
    for word in words:
        name, equals, number = word.rpartition("=")
        try:
            if not equals or not name:
                raise ValueError
            made.append((name.strip(), float(number)))
        except ValueError:
            raise click.BadParameter(f"{plain(word)!r} is not JOINT=W", param_hint="--weight") from None
    return made
