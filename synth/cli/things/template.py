"""``synth template``: a thing with panels as lines to cut and to fold, on paper or for a cutter."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from synth.cli.output import FORCE, about, plain
from synth.cli.things.given import MODE, ROW, given

if TYPE_CHECKING:
    from graphs.mechanism.sheet import Sheet
    from synth.templates.template import Template

__all__ = ["template"]


@click.command(short_help="Print a crease pattern at true scale, to cut out and fold.")
@click.argument("file", metavar="FILE")
@click.option("-o", "--output", required=True, metavar="OUT", help="Template to write: .pdf, .svg or .dxf.")
@ROW
@MODE
@click.option("--as", "kind", type=click.Choice(["sheet", "space"]), help="Realise a type so.  [default: sheet]")
@click.option("--page", "page", default="A4", show_default=True, help="A4, A3, Letter, or WIDTHxHEIGHT in mm.")
@click.option("--scale", type=float, help="Millimetres for a unit of the coordinates.  [default: 1]")
@click.option("--size", type=float, metavar="MM", help="Longer side of the thing, instead of a scale.")
@click.option("--tabs", type=float, default=8.0, show_default=True, metavar="MM", help="Depth of tabs; 0: none.")
@click.option("--slots", is_flag=True, help="Tabs go through slots, without glue.")
@click.option(
    "--hinges",
    "hinge_kind",
    type=click.Choice(["fold", "offset", "living", "gap"]),
    default="fold",
    show_default=True,
    help="Thick material: two folds for one, rows of cuts, or panels apart; --hinge-width says how wide.",
)
@click.option("--hinge-width", type=float, metavar="MM", help="Of offset, living or gap.")
@click.option("--note/--no-note", default=True, show_default=True, help="How it is put together, with a picture.")
@FORCE
def template(
    file: str,
    output: str,
    row: int | None,
    mode: str | None,
    kind: Any,
    page: str,
    hinge_kind: Any,
    hinge_width: float | None,
    note: bool,
    force: bool,
    **look: Any,
) -> None:
    """Print panels at true scale, to cut out and fold.

    FILE is a file, an id m1:... or k1:..., an R/- string, or a store, a list or a folder of many, of which --row
    names one. A type without coordinates is realised first. Coordinates are millimetres unless --scale or --size
    says otherwise. What is larger than a page comes in tiles, never smaller: tiles overlap by 10 mm, and crosses
    of one name lie over each other. Each page has a gauge of 100 mm: measure it. Of .svg a file is written for
    each page; a .dxf is one drawing at full size.

    Panels that do not lie side by side are laid out in nets, none over another, with tabs: edges of one number are
    glued, or put together with slots. In thick material folds are strips of a stated width.

    \b
    Examples:
      synth template data/patterns/bird-base.fold --size 150 -o bird-base.pdf
      synth template data/patterns/bird-base.fold --size 600 --page A3 -o bird-base.pdf
      synth template m1:a-b.ac-.b-d.cd- --size 200 -o four-bar.dxf
      synth template data/patterns/bird-base.fold --size 300 --hinges living --hinge-width 8 -o bird-base.dxf
      synth template RR-R-RRR --mode D --size 180 -o ups.pdf
      synth template types.sqlite --row 7 --size 150 -o seventh.svg
    """
    from graphs.errors import InvariantError
    from synth.templates.paper import paper_named
    from synth.templates.pieces.hinges import Hinges
    from synth.templates.template import template_of
    from synth.templates.things import panels_of_thing
    from synth.templates.writing import check_template, write_template

    try:
        paper = paper_named(page)
    except InvariantError as error:
        raise click.BadParameter(str(error), param_hint="--page") from None
    if (hinge_kind == "fold") != (hinge_width is None):
        raise click.UsageError("--hinges offset, living or gap and --hinge-width go together")
    check_template(output, force=force)
    hinges = None if hinge_width is None else Hinges(hinge_kind, hinge_width)
    asked = given(file, row, mode)
    with about(asked.name):
        thing: Any = asked.thing
        sheet, done = panels_of_thing(thing, kind=kind, mode=asked.mode)
        made = template_of(sheet, title=sheet.title or Path(asked.name).name, hinges=hinges, **look)
        made, unseen = _noted(made, sheet, note, output)
    for place in write_template(made, output, paper=paper, force=force):
        click.echo(f"written: {plain(str(place), 4096)}")
    if done:
        click.echo(f"{done}, as `synth realise` does", err=True)
    if made.told:
        click.echo(f"not shown: {', '.join(made.told)}", err=True)
    if unseen:
        click.echo(unseen, err=True)


def _noted(made: Template, sheet: Sheet, note: bool, output: str) -> tuple[Template, str]:
    """Return a template with a picture of the thing, or without a note; and what of the note is not written."""
    from dataclasses import replace

    from synth.templates.template import pictured

    if not note:
        return replace(made, steps=()), ""
    if output.lower().endswith(".dxf"):
        return made, "not written: how it is put together, with a picture (a .pdf or .svg has them)"
    made, why = pictured(made, sheet)
    return made, f"no picture of it folded: {plain(why, 1000)}" if why else ""
