"""``synth cylinder``: planar loops on right circular cylinders."""

from __future__ import annotations

import click

from synth.cli.output import FORCE, check_picture, print_answer, print_json, tell_written
from synth.cli.surfaces.circles import NumberList

__all__ = ["cylinder_group"]


@click.group("cylinder", short_help="Map planar loops to cylinders.")
def cylinder_group() -> None:
    """Map planar loops to right circular cylinders.

    \b
    Example:
      synth cylinder map --lengths 4,3,5,1
    """


@cylinder_group.command("map", short_help="Every cylinder on which a planar loop lies.")
@click.option(
    "--lengths", type=NumberList(), required=True, metavar="A,B,...", help="Lengths of the links in loop order."
)
@click.option("-o", "--output", metavar="PICTURE", help="Draw the loop sums (.png, .svg, .pdf).")
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def map_command(lengths: tuple[float, ...], output: str | None, force: bool, as_json: bool) -> None:
    """Say on which cylinders a planar loop of any number of links lies, all its joint axes ruling lines.

    A four-bar is given as ground, input, coupler, output. The radius is in the unit of the lengths.

    \b
    Examples:
      synth cylinder map --lengths 4,3,5,1
      synth cylinder map --lengths 4,3,5,1,2 --json
    """
    from synth.surfaces.cylinder import map_to_cylinders

    check_picture(output, force=force)
    found = map_to_cylinders(lengths)
    if output is not None:
        from synth.drawing.scene.writing import save_scene
        from synth.drawing.sums import draw_loop_sums

        save_scene(draw_loop_sums(found), output, force=force)
    if as_json:
        print_json(found.to_json())
        return
    print_answer(found)
    tell_written(output)
