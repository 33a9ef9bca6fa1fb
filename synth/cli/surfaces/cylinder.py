"""``synth cylinder``: planar loops and linkages of several loops on right circular cylinders."""

from __future__ import annotations

from math import radians
from typing import Any

import click

from synth.cli.output import FORCE, print_answer, print_json, tell_written
from synth.cli.surfaces.asked import AskedLinkage, linkage_options
from synth.cli.surfaces.commands import behaviour_command, map_answer, move_command

__all__ = ["cylinder_group"]


@click.group("cylinder", short_help="Map planar linkages to cylinders; find which way links move.")
def cylinder_group() -> None:
    """Map planar linkages to right circular cylinders, and find which way their links move from them.

    \b
    Examples:
      synth cylinder map --lengths 4,3,5,1
      synth cylinder behaviour --lengths 4,3,5,1
    """


@cylinder_group.command("map", short_help="Find every cylinder on which a linkage lies.")
@linkage_options("cylinder", arcs=False)
@click.option(
    "--tolerance", type=click.FloatRange(0, min_open=True), default=1e-5, show_default=True, metavar="DEGREES",
    help="Largest misclosure of the loops of a FILE, in degrees.",
)  # fmt: skip
@click.option(
    "--by-lengths",
    is_flag=True,
    help="For --steps or a FILE: find every cylinder on which the lengths lie, not only that of the steps.",
)
@click.option(
    "-o", "--output", metavar="OUT",
    help="Draw the loop sums (.png, .svg, .pdf); for a FILE or with --cylinder, draw the "
    "linkage; or write it (.json).",
)  # fmt: skip
@click.option(
    "--cylinder", "number", type=click.IntRange(min=1), metavar="K",
    help="Number of the cylinder to draw, or to write the linkage on. By default the link "
    "lengths are written, without a cylinder.",
)  # fmt: skip
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def map_command(
    tolerance: float,
    by_lengths: bool,
    output: str | None,
    number: int | None,
    force: bool,
    as_json: bool,
    **options: Any,
) -> None:
    """Find the cylinders on which a planar linkage lies, with all its joint axes on ruling lines.

    Give the link --lengths of one loop (for a four-bar: ground, input, coupler, output), its --steps round a
    cylinder of --radius, or a FILE of a linkage of several loops. The radius is in the unit of the lengths. `synth
    cylinder move`, `view`, `draw` and `template` read the .json that -o writes.

    \b
    Examples:
      synth cylinder map --lengths 4,3,5,1
      synth cylinder map --lengths 4,3,5,1 --cylinder 1 -o four-bar.json
      synth cylinder map --steps 40,50,50 --radius 25 -o steps.json
      synth cylinder map --lengths 4,3,5,1,2 --json
    """
    asked = AskedLinkage.of("cylinder", options)
    if by_lengths and asked.sizes is not None:
        raise click.UsageError("--by-lengths is for a FILE or --steps")
    answer = map_answer(
        asked, tolerance=radians(tolerance), by_sizes=by_lengths, output=output, number=number, force=force
    )
    if as_json:
        print_json(answer.to_json())
        return
    print_answer(answer)
    tell_written(output)


cylinder_group.add_command(behaviour_command("cylinder"))
cylinder_group.add_command(move_command("cylinder"))
