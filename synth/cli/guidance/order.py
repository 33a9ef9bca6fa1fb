"""``synth order``: whether a dyad about a fixed axis takes orientations in their order."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import click

from synth.cli.output import FORCE, about, check_picture, console, plain, print_json, table, tell_written

if TYPE_CHECKING:
    from synth.guidance.hoop_method import Direction
    from synth.guidance.order import OrderAnalysis
    from synth.guidance.orientations import Orientations

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
    help="Three or more orientations (docs/native-json.md).",
)


@click.command(short_help="Say whether a crank about an axis takes orientations in their order.")
@ORIENTATIONS
@click.option("--axis", required=True, type=AXIS, metavar="X,Y,Z", help="Fixed axis G of the dyad, any length.")
@click.option(
    "--direction",
    type=click.Choice(["ccw", "cw"]),
    default="ccw",
    show_default=True,
    help="How the crank turns, seen from the tip of the axis.",
)
@click.option("-o", "--picture", metavar="OUT", help="Draw the sphere and the hoop here (.svg, .png or .pdf).")
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
    """Say whether a crank about a fixed axis takes orientations in their order (Tipparthi and Larochelle 2011).

    The hoop, half a great circle through the ends of the axis, turns from S12 by 180 degrees; its crossings of the
    relative axes Sij tell. Inequalities and the crank angles of the dyad that fits best check it. Exit status 1:
    the order is not kept.

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
        _print(orientations, found, axis, picture)
    if not found.in_order:
        sys.exit(1)


_FITS = 1e-4
"""Degrees; axes are printed to six digits or so."""


def _print(
    orientations: Orientations, found: OrderAnalysis, axis: tuple[float, float, float], picture: str | None
) -> None:
    from math import degrees

    from synth.guidance.hoop_method import direction_words, pair_name

    out, hoop = console(), found.hoop
    needed = set(hoop.required)
    rows = table("crossed", "angle", "decides", numbers=["angle"])
    rows.add_row("S12", f"{0:.4f}", "starts here")
    for crossing in hoop.crossings:
        rows.add_row(
            pair_name(crossing.pair), f"{degrees(crossing.angle):.4f}", "yes" if crossing.pair in needed else ""
        )
    out.print(
        f"{len(orientations)} orientations, crank about ({', '.join(f'{x:g}' for x in axis)}) turning "
        f"{direction_words(hoop.direction)}"
    )
    out.print(rows)
    out.print("needed: " + " => ".join(map(pair_name, hoop.required)))
    if hoop.breaks_at is None:
        out.print(f"order kept, by a margin of {degrees(hoop.margin):.3f} degrees of the hoop")
    else:
        due, crossed = map(pair_name, hoop.breaks_at)
        other = f"; it is kept {direction_words(found.kept)}" if found.kept is not None else ""
        out.print(f"order defect: {crossed} is crossed where {due} is due{other}")
    verdicts = (("hoop", found.kept), ("inequalities", found.by_inequalities), ("crank", found.by_crank_angles))
    told = ", ".join(f"{name} {direction_words(kept)}" for name, kept in verdicts)
    out.print(f"kept by: {told}{'' if found.agree else '   (they do not agree)'}")
    out.print("crank angles: " + ", ".join(f"{degrees(angle):.3f}" for angle in found.crank_angles))
    if degrees(found.misfit) > _FITS:
        misses = f"the best misses by {degrees(found.misfit):.4f} degrees"
        out.print(f"note: no dyad about this axis takes all orientations; {misses}")
    tell_written(picture)
