"""``synth cone``: spherical loops and linkages of several loops on right cones."""

from __future__ import annotations

from math import radians
from typing import Any

import click

from synth.cli.output import FORCE, print_answer, print_json, tell_written
from synth.cli.surfaces.asked import AskedLinkage, linkage_options
from synth.cli.surfaces.commands import behaviour_command, map_answer, move_command

__all__ = ["cone_group"]


@click.group("cone", short_help="Map spherical linkages to cones; find which way links move.")
def cone_group() -> None:
    """Map spherical linkages to right cones, and find which way their links move from them.

    \b
    Examples:
      synth cone map --angles 70,80,120,40
      synth cone behaviour --angles 70,80,120,40
    """


@cone_group.command("map", short_help="Find every cone on which a linkage lies.")
@linkage_options("cone", arcs=False)
@click.option(
    "--tolerance", type=click.FloatRange(0, min_open=True), default=1e-5, show_default=True, metavar="DEGREES",
    help="Largest misclosure of the loops of a FILE, in degrees.",
)  # fmt: skip
@click.option(
    "--by-angles",
    is_flag=True,
    help="For --steps or a FILE: find every cone on which the link angles lie, not only that of the steps.",
)
@click.option("--supplementary", is_flag=True, help="For a four-bar: list all 16 linkages on its joint lines.")
@click.option(
    "-o", "--output", metavar="OUT",
    help="Draw the loop sums (.png, .svg, .pdf); for a FILE or with --cone, draw the linkage; "
    "or write it (.json).",
)  # fmt: skip
@click.option(
    "--cone", "number", type=click.IntRange(min=1), metavar="K",
    help="Number of the cone to draw, or to write the linkage on. By default the link angles "
    "are written, without a cone.",
)  # fmt: skip
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def map_command(
    tolerance: float,
    by_angles: bool,
    supplementary: bool,
    output: str | None,
    number: int | None,
    force: bool,
    as_json: bool,
    **options: Any,
) -> None:
    """Find the right cones on which a linkage lies, with all its joint axes on ruling lines.

    Give the link --angles of one loop (for a four-bar: ground, input, coupler, output), its --steps round a cone
    of angle --lambda, or a FILE of a linkage of several loops, with its link angles or with the steps between its
    joint axes. `synth cone move`, `view`, `draw` and `template` read the .json that -o writes.

    \b
    Examples:
      synth cone map --angles 70,80,120,40
      synth cone map --angles 120,95,45,85 --cone 1 -o four-bar.json
      synth cone map --steps 40,50,50 --lambda 20 -o steps.json
      synth cone map --angles 120,50,120,50 --json
      synth cone map --angles 85,120,95,45 --supplementary
      synth cone map data/surfaces/fig11-stephenson.json
      synth cone map data/surfaces/fig11-stephenson.json --by-angles
    """
    asked = AskedLinkage.of("cone", options)
    if by_angles and asked.sizes is not None:
        raise click.UsageError("--by-angles is for a FILE or --steps")
    if supplementary:
        if asked.sizes is None or output is not None:
            raise click.UsageError("--supplementary lists linkages for --angles, and writes none")
        from synth.surfaces.linkages import supplementary_linkages

        answer: Any = supplementary_linkages(asked.linkage_sizes)
    else:
        answer = map_answer(
            asked, tolerance=radians(tolerance), by_sizes=by_angles, output=output, number=number, force=force
        )
    if as_json:
        print_json(answer.to_json())
        return
    print_answer(answer)
    tell_written(output)


cone_group.add_command(behaviour_command("cone"))
cone_group.add_command(move_command("cone"))
