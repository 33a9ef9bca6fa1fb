"""``synth template``: a thing with panels as lines to cut and to fold, on paper or for a cutter."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import radians
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from synth.cli.lengths import LENGTH, LENGTH_OR_NONE
from synth.cli.output import FORCE, about, plain, print_json, tell_written
from synth.cli.things.given import MODE, ROW, Given, given

if TYPE_CHECKING:
    from synth.templates.template import Template

__all__ = ["template"]

_OF_PANELS = {"scale": None, "tabs": 8.0, "slots": False, "hinge_kind": "fold", "hinge_width": None}
_OF_SURFACES = {"cone_angle": None, "cone": None, "radius": None, "thickness": None}
"""Options of one kind of thing, and what they are where nothing was asked for."""
_REALISED = 150.0
"""Millimetres of the longer side of a type, which has coordinates, but no size, from being realised."""
_SPELT = {"cone_angle": "--lambda", "hinge_kind": "--hinges", "hinge_width": "--hinge-width"}


@click.command(short_help="Print a crease pattern at true scale, to cut out and fold.")
@click.argument("file", metavar="FILE")
@click.option("-o", "--output", required=True, metavar="OUT", help="Template to write: .pdf, .svg or .dxf.")
@ROW
@MODE
@click.option("--as", "kind", type=click.Choice(["sheet", "space"]), help="Realise a type so.  [default: sheet]")
@click.option("--page", "page", default="A4", show_default=True, help="A4, A3, Letter, or WIDTHxHEIGHT in mm.")
@click.option("--scale", type=LENGTH, help="Millimetres for a unit.  [default: the file's unit, or 1]")
@click.option("--size", type=LENGTH, metavar="MM", help="Longer side of the thing; on a cone, of ruling lines.")
@click.option(
    "--tabs", type=LENGTH_OR_NONE, default=8.0, show_default=True, metavar="MM", help="Depth of tabs; 0: none."
)
@click.option("--slots", is_flag=True, help="Tabs go through slots, without glue.")
@click.option(
    "--hinges",
    "hinge_kind",
    type=click.Choice(["fold", "offset", "living", "gap"]),
    default="fold",
    show_default=True,
    help="Thick material: two folds for one, rows of cuts, or panels apart; --hinge-width says how wide.",
)
@click.option("--hinge-width", type=LENGTH, metavar="MM", help="Of offset, living or gap.")
@click.option("--lambda", "cone_angle", type=float, metavar="DEGREES", help="Of a linkage on a cone: its angle.")
@click.option("--cone", type=click.IntRange(min=1), metavar="K", help="Of one that lies on several: which.")
@click.option("--radius", type=LENGTH, metavar="MM", help="On a cylinder instead of a cone.")
@click.option("--thickness", type=LENGTH, metavar="MM", help="On a cone: of the material.  [default: 0.3]")
@click.option("--note/--no-note", default=True, show_default=True, help="How it is put together, with a picture.")
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
def template(
    file: str,
    output: str,
    row: int | None,
    mode: str | None,
    kind: Any,
    page: str,
    note: bool,
    force: bool,
    as_json: bool,
    **look: Any,
) -> None:
    """Print panels at true scale, to cut out and fold.

    FILE is a file, an id m1:... or k1:..., an R/- string, or a store, a list or a folder of many, of which
    --row names one. A type without coordinates is realised first, 150 mm wide or high. Coordinates are in the
    unit that a .fold file names, or millimetres, unless --scale or --size says otherwise. What is larger than a
    page comes in tiles, never smaller: tiles overlap by 10 mm, and crosses of one name lie over each other.
    Each page has a gauge of 100 mm: measure it. Of .svg a file is written for each page; a .dxf is one drawing
    at full size.

    Panels that do not lie side by side are laid out in nets, none over another, with tabs: edges of one number are
    glued, or put together with slots. In thick material folds are strips of a stated width.

    A linkage on a cone, or a row of conical candidates, is cut out as the cone unrolled and a piece for each link,
    with slots where joints pass from layer to layer.

    \b
    Examples:
      synth template data/patterns/bird-base.fold --size 150 -o bird-base.pdf
      synth template data/patterns/bird-base.fold --size 600 --page A3 -o bird-base.pdf
      synth template m1:a-b.ac-.b-d.cd- --size 200 -o four-bar.dxf
      synth template data/patterns/bird-base.fold --size 300 --hinges living --hinge-width 8 -o bird-base.dxf
      synth template RR-R-RRR --mode D --size 180 -o ups.pdf
      synth template data/surfaces/fig11-stephenson.json --size 120 -o stephenson.pdf
      synth template types.sqlite --row 7 --size 150 -o seventh.svg
    """
    from graphs.errors import InvariantError
    from graphs.mechanism.conical import ConicalLinkage
    from synth.drawing.mechanisms.orders import OrderOnCircle
    from synth.templates.paper import paper_named
    from synth.templates.writing import check_template, write_template

    try:
        paper = paper_named(page)
    except InvariantError as error:
        raise click.BadParameter(str(error), param_hint="--page") from None
    check_template(output, force=force)
    asked = given(file, row, mode)
    on_surface = isinstance(asked.thing, ConicalLinkage | OrderOnCircle)
    _refuse(look, _OF_PANELS if on_surface else _OF_SURFACES, "panels" if on_surface else "linkages on cones")
    told: list[str] = []
    with about(asked.name):
        if on_surface:
            made = _of_surface(asked, kind, look)
        else:
            made, told = _of_panels(asked, kind, look, note=note and not _is_dxf(output))
    made, more = _with_note(made, output, note=note)
    places = write_template(made, output, paper=paper, force=force)
    if as_json:
        print_json({"file": file, "output": list(map(str, places)), **made.to_json()})
    else:
        tell_written(*places)
    for line in (*told, *more):
        click.echo(line, err=True)


def _refuse(look: Mapping[str, Any], options: Mapping[str, Any], whose: str) -> None:
    """Refuse what is asked of another kind of thing."""
    asked = [_SPELT.get(name, f"--{name}") for name, nothing in options.items() if look[name] != nothing]
    if asked:
        raise click.UsageError(f"{', '.join(asked)}: of {whose} only")


def _of_panels(asked: Given, kind: Any, look: Mapping[str, Any], *, note: bool) -> tuple[Template, list[str]]:
    """Return the template of panels, and what is to be told of it."""
    from synth.templates.pieces.hinges import Hinges
    from synth.templates.scale import unit_of
    from synth.templates.template import pictured, template_of
    from synth.templates.things import panels_of_thing

    if (look["hinge_kind"] == "fold") != (look["hinge_width"] is None):
        raise click.UsageError("--hinges offset, living or gap and --hinge-width go together")
    hinges = None if look["hinge_width"] is None else Hinges(look["hinge_kind"], look["hinge_width"])
    thing: Any = asked.thing
    sheet, done = panels_of_thing(thing, kind=kind, mode=asked.mode)
    how = {name: look[name] for name in ("scale", "size", "tabs", "slots")}
    told = [f"{done}, as `synth realise` does"] if done else []
    if look["scale"] is None and look["size"] is None and done:
        how["size"] = _REALISED
        told.append(f"a type has no size: its longer side is {_REALISED:g} mm; --size says another")
    elif look["scale"] is None and look["size"] is None and unit_of(sheet) is None:
        told.append("no unit is given: a unit of the coordinates is 1 mm")
    made = template_of(sheet, title=sheet.title or Path(asked.name).name, hinges=hinges, **how)
    told += [f"not shown: {', '.join(made.told)}"] if made.told else []
    if note:
        made, why = pictured(made, sheet)
        told += [f"no picture of it folded: {plain(why, 1000)}"] if why else []
    return made, told


def _of_surface(asked: Given, kind: Any, look: Mapping[str, Any]) -> Template:
    """Return the template of a linkage on a cone or a cylinder."""
    from synth.templates.developed.layered import Dimensions
    from synth.templates.developed.template import surface_of, template_on_surface
    from synth.templates.things import linkage_on_a_cone

    if asked.mode is not None or kind is not None:
        raise click.UsageError("--mode and --as: of types that are realised only")
    thing: Any = asked.thing
    angle = None if look["cone_angle"] is None else radians(look["cone_angle"])
    linkage = linkage_on_a_cone(thing, cone_angle=angle, number=look["cone"])
    sizes = {name: look[name] for name in ("size", "thickness") if look[name] is not None}
    surface = surface_of(linkage, look["radius"])
    return template_on_surface(linkage, surface, Dimensions(**sizes), Path(asked.name).name)


def _with_note(made: Template, output: str, *, note: bool) -> tuple[Template, list[str]]:
    """Return a template without a note where none is asked for, and what of it is not written."""
    if note and _is_dxf(output):
        return made, ["not written: how it is put together, with a picture (a .pdf or .svg has them)"]
    return (made if note else replace(made, steps=())), []


def _is_dxf(output: str) -> bool:
    return output.lower().endswith(".dxf")
