"""``synth template``: a thing with panels as lines to cut and to fold, on paper or for a cutter."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from synth.cli.output import FORCE, about, plain

if TYPE_CHECKING:
    from graphs.convert.table import Mechanism
    from graphs.mechanism.sheet import Sheet

__all__ = ["template"]


@click.command(short_help="Print a crease pattern at true scale, to cut out and fold.")
@click.argument("file", metavar="FILE")
@click.option("-o", "--output", required=True, metavar="OUT", help="Template to write: .pdf, .svg or .dxf.")
@click.option("--page", "page", default="A4", show_default=True, help="A4, A3, Letter, or WIDTHxHEIGHT in mm.")
@click.option("--scale", type=float, help="Millimetres for a unit of the coordinates.  [default: 1]")
@click.option("--size", type=float, metavar="MM", help="Longer side of the thing, instead of a scale.")
@click.option("--tabs", type=float, default=8.0, show_default=True, metavar="MM", help="Depth of tabs; 0: none.")
@FORCE
def template(
    file: str, output: str, page: str, scale: float | None, size: float | None, tabs: float, force: bool
) -> None:
    """Print panels at true scale, to cut out and fold. FILE is a file, or an id m1:... or k1:...

    Coordinates are millimetres unless --scale or --size says otherwise. What is larger than a page comes in tiles,
    never smaller: tiles overlap by 10 mm, and crosses of one name lie over each other. Each page has a gauge of
    100 mm: measure it. A type without coordinates is realised first, as a flat sheet. Of .svg a file is written
    for each page; a .dxf is one drawing at full size.
    Panels that do not lie side by side are laid out in nets, none over another, with tabs: edges of one number are
    glued.

    \b
    Examples:
      synth template data/patterns/bird-base.fold --size 150 -o bird-base.pdf
      synth template data/patterns/bird-base.fold --size 600 --page A3 -o bird-base.pdf
      synth template m1:a-b.ac-.b-d.cd- --size 200 -o four-bar.dxf
    """
    from graphs.errors import InvariantError
    from graphs.files.formats import read
    from synth.templates.paper import paper_named
    from synth.templates.template import template_of
    from synth.templates.writing import check_template, write_template

    try:
        paper = paper_named(page)
    except InvariantError as error:
        raise click.BadParameter(str(error), param_hint="--page") from None
    check_template(output, force=force)
    thing = read(file)
    with about(file):
        sheet = _sheet_of(thing)
        made = template_of(sheet, scale=scale, size=size, tabs=tabs, title=sheet.title or Path(file).name)
    for place in write_template(made, output, paper=paper, force=force):
        click.echo(f"written: {plain(str(place), 4096)}")
    if made.told:
        click.echo(f"not shown: {', '.join(made.told)}", err=True)


def _sheet_of(thing: Mechanism) -> Sheet:
    """Return the panels of a thing; a type gets coordinates."""
    from graphs.errors import UnsolvableError
    from graphs.mechanism.sc import SCGraph
    from graphs.mechanism.scd import SCDGraph
    from synth.moving.linkages import sheet_of
    from synth.realisation.realised import realise

    sheet = sheet_of(thing)
    if sheet is not None:
        return sheet.frames.first_placed() if sheet.frames is not None else sheet
    if isinstance(thing, SCGraph | SCDGraph):
        click.echo("no coordinates: realised as a flat sheet, as `synth realise` does", err=True)
        return realise(thing).sheet
    raise UnsolvableError(f"a template needs panels, and {thing!r} has none")
