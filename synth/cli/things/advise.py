"""``synth advise``: what to lock, or which panels to crease, for a number of freedoms."""

from __future__ import annotations

import sys

import click

from synth.cli.lengths import BRANCH
from synth.cli.output import about, plain, print_json
from synth.cli.precision import PRECISION, precise
from synth.cli.reading import DRAWN, read

__all__ = ["advise"]


@click.command(short_help="Find joints to lock, or panels to crease, for a number of degrees of freedom.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option(
    "--freedoms", type=click.IntRange(0), required=True, metavar="K", help="Number of degrees of freedom to reach."
)
@click.option(
    "--branch",
    type=BRANCH,
    metavar="B",
    help="Folding branch from a flat state, by its number or its signs; `synth fold --branches` lists them.",
)
@click.option(
    "--weight", multiple=True, metavar="JOINT=W", help="Cost of locking a joint, 1 by default; may be repeated."
)
@click.option(
    "--protect-joint", multiple=True, metavar="JOINT", help="Joint that must not be locked; may be repeated."
)
@click.option(
    "--protect-link",
    multiple=True,
    metavar="LINK",
    help="Link whose joints must not be locked, and which must not be creased; may be repeated.",
)
@click.option(
    "--flaps/--no-flaps",
    default=True,
    show_default=True,
    help="Lock the joints of flaps too, and allow diagonals that cut off a corner as a flap.",
)
@click.option(
    "--limit",
    type=click.IntRange(1, 10_000),
    metavar="N",
    default=20,
    show_default=True,
    help="Largest number of sets to list.",
)
@click.option(
    "--size",
    type=click.IntRange(1),
    metavar="N",
    help="Largest number of diagonals in a set. By default K - M + 1.",
)
@click.option(
    "--leave-out",
    is_flag=True,
    help="For a flat sheet: also report its degrees of freedom without the locked creases.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
@PRECISION
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
    """Find joints to lock, or panels to crease along diagonals, so that K degrees of freedom are left.

    To lower M degrees of freedom to K, M - K joints have to be locked: all such sets are listed, cheapest first.
    To raise M to K, at least K - M diagonals have to be creased: the smallest sets are listed, each tested by
    folding. From a flat state, the folding branch is the one of the mountain-valley assignment, or that of
    --branch. Play is the largest factor by which play in the locked joints is amplified in the others. JOINT is an
    id, or two links A,B.

    \b
    Examples:
      synth advise data/patterns/bird-base.fold --freedoms 0
      synth generate miura --rows 4 --columns 4 --fold 60 -o miura.fold
      synth advise miura.fold --freedoms 2

    Exit status 1: no set of diagonals was found.
    """
    from graphs.convert.duality import mechanism_of_sheet
    from graphs.edit.named import joint_named, link_named
    from synth.advice.advice import advise as advised
    from synth.moving.made import configuration_of, sheet_of

    thing = read(file)
    with about(file):
        thing = precise(thing)
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
