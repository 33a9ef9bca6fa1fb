"""``synth template``: a thing with panels as lines to cut and to fold, on paper or for a cutter."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from synth.cli.lengths import LENGTH, LENGTH_OR_NONE
from synth.cli.output import FORCE, about, plain, print_json, tell_written
from synth.cli.precision import PRECISION, precise_sheet
from synth.cli.reading import DRAWN
from synth.cli.surfaces.circles import surface_asked
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


@click.command(short_help="Write a template at true scale, to cut out and fold.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option("-o", "--output", required=True, metavar="OUT", help="Template to write: .pdf, .svg or .dxf.")
@ROW
@MODE
@click.option(
    "--as",
    "kind",
    type=click.Choice(["sheet", "space"]),
    help="Kind of realisation, for a type without coordinates.  [default: sheet]",
)
@click.option(
    "--page",
    "page",
    metavar="PAPER",
    default="A4",
    show_default=True,
    help="Paper size: A4, A3, Letter, or WIDTHxHEIGHT in mm.",
)
@click.option(
    "--scale", type=LENGTH, help="Millimetres per unit of the coordinates.  [default: the file's unit, or 1]"
)
@click.option(
    "--size",
    type=LENGTH,
    metavar="MM",
    help="Longer side of the template; on a cone or cylinder, length of the ruling lines.",
)
@click.option(
    "--tabs",
    type=LENGTH_OR_NONE,
    default=8.0,
    show_default=True,
    metavar="MM",
    help="Depth of the tabs; 0 leaves them out.",
)
@click.option("--slots", is_flag=True, help="Join tabs through slots, without glue.")
@click.option(
    "--hinges",
    "hinge_kind",
    type=click.Choice(["fold", "offset", "living", "gap"]),
    default="fold",
    show_default=True,
    help="Hinges in thick material: offset (two folds per crease), living (rows of cuts) or "
    "gap (panels apart). Each requires --hinge-width.",
)
@click.option("--hinge-width", type=LENGTH, metavar="MM", help="Width of offset, living or gap hinges.")
@click.option("--lambda", "cone_angle", type=float, metavar="DEGREES", help="For a linkage on a cone: cone angle.")
@click.option(
    "--cone",
    "--cylinder",
    "cone",
    type=click.IntRange(min=1),
    metavar="K",
    help="For a linkage that lies on several cones or cylinders: number of the one to take.",
)
@click.option(
    "--radius", type=LENGTH, metavar="MM", help="Radius of the cylinder.  [default: that of the linkage, in mm]"
)
@click.option(
    "--thickness",
    type=LENGTH,
    metavar="MM",
    help="For a linkage on a cone or cylinder: thickness of the material.  [default: 0.3]",
)
@click.option(
    "--note/--no-note", default=True, show_default=True, help="Add assembly instructions, with a picture."
)
@FORCE
@click.option("--json", "as_json", is_flag=True, help="Print the answer as JSON.")
@PRECISION
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
    """Write a template of panels at true scale, to cut out and fold.

    FILE is a file, an id m1:... or k1:..., an R/- string, or a store, a list or a folder of types, of which --row
    names one. A type without coordinates is realised first, with a longer side of 150 mm. Coordinates are in the
    unit that a .fold file names, or in millimetres, unless --scale or --size says otherwise. A template larger
    than a page is divided into tiles, never made smaller: tiles overlap by 10 mm, and crosses with the same name
    are laid on each other. Each page has a gauge of 100 mm; measure it after printing. For .svg each page is a
    file; a .dxf is one drawing at full size.

    A folded surface is unfolded into nets without overlaps, with tabs: edges with the same number are glued, or
    joined by slots. In thick material, folds are strips of a stated width.

    For a linkage on a cone or cylinder, or a row of conical candidates, the template is the unrolled surface and
    one piece per link, with slots where joints pass from layer to layer.

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
    from graphs.mechanism.surfaces import SurfaceLinkage
    from synth.drawing.mechanisms.orders import OrderOnCircle
    from synth.templates.paper import paper_named
    from synth.templates.writing import check_template, write_template

    try:
        paper = paper_named(page)
    except InvariantError as error:
        raise click.BadParameter(str(error), param_hint="--page") from None
    check_template(output, force=force)
    asked = given(file, row, mode)
    asked = replace(asked, thing=precise_sheet(asked.thing))
    on_surface = isinstance(asked.thing, SurfaceLinkage | OrderOnCircle)
    _refuse(look, _OF_PANELS if on_surface else _OF_SURFACES, "panels" if on_surface else "linkages on surfaces")
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
    from synth.templates.things import linkage_on_a_surface

    if asked.mode is not None or kind is not None:
        raise click.UsageError("--mode and --as: of types that are realised only")
    thing: Any = asked.thing
    cone = surface_asked(look["cone_angle"], None)
    linkage = linkage_on_a_surface(thing, surface=cone, number=look["cone"])
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
