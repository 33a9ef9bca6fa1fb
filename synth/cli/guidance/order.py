"""``synth order``: whether a dyad about a fixed axis takes orientations in their order."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import click

from synth.cli.output import (
    FORCE,
    about,
    check_picture,
    plain,
    print_answer,
    print_json,
    tell_written,
)

if TYPE_CHECKING:
    from synth.guidance.order import Direction

__all__ = ["AXIS", "ORIENTATIONS", "order"]


class _AxisType(click.ParamType):  # type: ignore[type-arg, unused-ignore]
    """Three numbers parted by commas."""

    name = "x,y,z"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if isinstance(value, tuple):
            return value
        try:
            numbers = tuple(float(part) for part in value.split(","))
        except ValueError:
            numbers = ()
        if len(numbers) != 3:
            self.fail(f"{plain(value)!r} is not three numbers such as 0,0,1", param, ctx)
        return numbers


AXIS = _AxisType()

ORIENTATIONS = click.option(
    "--orientations",
    "file",
    required=True,
    metavar="FILE",
    help="File of three or more orientations (docs/native-json.md).",
)


@click.command(short_help="Check whether a crank about a fixed axis guides a body through orientations in order.")
@ORIENTATIONS
@click.option(
    "--axis",
    required=True,
    type=AXIS,
    metavar="X,Y,Z",
    help="Direction of the fixed axis G of the dyad, of any length.",
)
@click.option(
    "--direction",
    type=click.Choice(["ccw", "cw"]),
    default="ccw",
    show_default=True,
    help="Direction in which the crank turns, seen from the tip of the axis.",
)
@click.option(
    "-o", "--picture", metavar="OUT", help="Draw the sphere and the hoop to this file (.svg, .png or .pdf)."
)
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print a JSON object.")
def order(
    file: str,
    axis: tuple[float, float, float],
    direction: Direction,
    picture: str | None,
    force: bool,
    as_json: bool,
) -> None:
    """Check whether a crank guides a body through orientations in order (Tipparthi and Larochelle 2011).

    The hoop, half a great circle through the ends of the axis, turns from S12 by 180 degrees; the order in which
    it crosses the relative axes Sij decides. Inequalities and the crank angles of the best-fitting dyad check the
    result. Exit status 1: the order is not kept.

    \b
    Example:
      synth order --orientations data/orientations/tipparthi.json --axis -0.349,-0.144,0.926 --direction cw
    """
    from synth.guidance.order import analyse_order
    from synth.guidance.orientations import read_orientations

    check_picture(picture, force=force)
    orientations = read_orientations(file)
    with about(file):
        found = analyse_order(orientations, axis, direction)
    if picture is not None:
        from synth.drawing.scene.writing import save_scene
        from synth.drawing.sphere import draw_hoop

        save_scene(draw_hoop(orientations, axis, found.hoop), picture, force=force)
    if as_json:
        print_json({"file": file, "axis": list(axis), **found.to_json()})
    else:
        print_answer(found)
        tell_written(picture)
    if not found.in_order:
        sys.exit(1)
