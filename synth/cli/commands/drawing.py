"""``synth draw``, ``synth view`` and ``synth template``: pictures, pages and templates."""

from __future__ import annotations

import sys
import webbrowser
from collections.abc import Iterator, Mapping
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any

import click

from synth.cli.options import BRANCH, FORCE, LENGTH, LENGTH_OR_NONE, LimitsType, surface_from_options
from synth.cli.output import about, check_output, check_picture, plain, print_json, tell_written
from synth.cli.reading import (
    DRAWN,
    LAYER,
    LOOK,
    MODE,
    PRECISION,
    ROW,
    NamedMechanism,
    keep_looks,
    precise_sheet,
    read,
    read_named,
)

if TYPE_CHECKING:
    from enumerate.runner.job import Limits
    from synth.drawing.catalogue import CatalogueEntry
    from synth.drawing.mechanisms.pictures import Drawable
    from synth.templates.template import Template
    from synth.viewer.shown import Shown

__all__ = ["draw", "template", "view"]


_KINDS = (
    "pattern", "marks", "repairs", "folded", "chain", "graph", "model", "solids", "cone", "cylinder", "circle",
    "sphere",
)  # fmt: skip
_PATIENCE = 2.0
"""Seconds between two reports of the progress of a catalogue."""
_COLOURS = ("letters", "verdict", "branch", "centres", "none")


def _colouring(ctx: click.Context, _parameter: click.Parameter, words: tuple[str, ...]) -> str:
    """Return the colouring; pairs with a look are kept for the drawing that is read."""
    keep_looks(ctx, tuple(word for word in words if "=" in word))
    names = [word for word in words if "=" not in word]
    for name in names:
        if name not in _COLOURS:
            ctx.fail(f"--colour: {plain(name)!r} is neither {', '.join(_COLOURS)} nor M=LOOK")
    return names[-1] if names else "letters"


@click.command(short_help="Draw a crease pattern, a chain, an SC or SCD graph, or a polyhedron model.")
@click.argument("file", metavar="FILE")
@click.option("-o", "--output", required=True, metavar="OUT", help="Picture to write: .svg, .png or .pdf.")
@click.option(
    "--as", "kind", type=click.Choice(_KINDS), metavar="KIND",
    help="Kind of picture. By default the one that suits the file.",
)  # fmt: skip
@click.option(
    "--colour", multiple=True, metavar="WHAT|" + LOOK, callback=_colouring,
    help="Colouring of a crease pattern: letters (the assignment in the file; the default), verdict (mobile and "
    "immobile creases), branch (initial rates of a branch), centres (classes of centres) or none. With M=..., for "
    "a drawing (.svg, .dxf): assignment of the lines of a colour, a dash pattern or both "
    "('V=dashed #000000'); - leaves them out.",
)  # fmt: skip
@LAYER
@click.option(
    "--branch", type=BRANCH, metavar="K",
    help="Branch to show with --colour branch or --as marks, by its number or its signs.",
)  # fmt: skip
@click.option("--graph", is_flag=True, help="Draw the SC graph on top of a crease pattern.")
@click.option(
    "--numbers/--no-numbers", default=True, show_default=True, help="Label links and joints with their numbers."
)
@click.option(
    "--paper", type=click.Choice(["light", "dark"]), default="light", show_default=True,
    help="Background of the picture.",
)  # fmt: skip
@click.option(
    "--where", multiple=True, metavar="COLUMN=VALUE",
    help="For a catalogue: draw only rows with this number (2, 2..4, 2..) or text in a column; "
    "may be repeated.",
)  # fmt: skip
@FORCE
def draw(
    file: str, output: str, kind: str | None, paper: str, where: tuple[str, ...], force: bool, **look: Any
) -> None:
    """Draw the mechanism of a file or an id, or a catalogue of all mechanisms in a store, a list or a folder.

    KIND is pattern (a crease pattern in its plane), marks (a pattern with the creases whose assignment disagrees
    with a branch: the nearest one, or that of --branch), repairs (a pattern with the repairs that reading the
    drawing needed), folded (a folded sheet in space), chain (links as bodies, joints as small circles), graph (an
    SC or SCD graph, with the signs of the centres), model (vertices and rods), solids (hinged at edges, in space),
    cone (a linkage round a cone, on the first of its cones), circle (the order of its joints round a cone) or
    sphere (which axes keep orientations in their order). Numbers are those that messages and JSON use; in SVG,
    shapes carry them as data-link and data-joint.

    A store (.sqlite), rows (.jsonl, .parquet), a graph6 file or a folder gives a catalogue, 24 pictures per page,
    with id, name, degrees of freedom, centres and symmetry: one .pdf, or one file per page.

    \b
    Examples:
      synth draw data/patterns/bird-base.fold -o bird-base.svg
      synth draw data/patterns/bird-base.fold --graph --colour centres -o bird-base.pdf
      synth draw data/patterns/bird-base.fold --colour branch --branch 1 -o bird-base.svg
      synth draw drawing.svg --as repairs -o repairs.svg
      synth draw data/wiener/fortune-teller.json -o graph.png
      synth draw k1:Cr -o four-bar.svg
      synth draw chains.sqlite -o catalogue.pdf --where symmetry=2.. --where planar=1
    """
    from synth.drawing.catalogue import is_catalogue

    check_picture(output, force=force)
    if is_catalogue(file):
        _draw_catalogue(file, output, kind, dict(map(_condition, where)), paper, force)
        return
    if where:
        raise click.UsageError("--where requires a catalogue: a store, rows, a graph6 file or a folder")
    from synth.drawing.mechanisms import pictures

    drawable = _read(file)
    with about(file):
        scene = pictures.draw(drawable, kind, **look)
    scene.save(output, paper=paper, force=force)
    tell_written(output)


def _read(file: str) -> Drawable:
    """Return the mechanism or the orientations of a file."""
    from graphs.files.native import holds_orientations

    if not holds_orientations(file):
        return read(file)
    from synth.guidance.orientations import read_orientations

    return read_orientations(file)


def _draw_catalogue(
    file: str, output: str, kind: str | None, where: dict[str, Limits | str], paper: str, force: bool
) -> None:
    from synth.drawing.catalogue import catalogue_entries, catalogue_pages, write_catalogue

    failures: list[str] = []
    entries = _counted(catalogue_entries(file, where, failures))
    written = write_catalogue(catalogue_pages(entries, Path(file).name, kind), output, paper=paper, force=force)
    tell_written(*written)
    if not written:
        click.echo("nothing to draw")
    for failure in failures:
        click.echo(f"left out: {plain(failure, 4096)}", err=True)


def _counted(entries: Iterator[CatalogueEntry]) -> Iterator[CatalogueEntry]:
    """Yield entries; a terminal shows their number every few seconds."""
    number, shown = 0, monotonic()
    for number, entry in enumerate(entries, start=1):
        if sys.stderr.isatty() and monotonic() - shown > _PATIENCE:
            click.echo(f"\r{number} drawn", nl=False, err=True)
            shown = monotonic()
        yield entry
    if sys.stderr.isatty():
        click.echo(f"\r{number} drawn", err=True)


def _condition(text: str) -> tuple[str, Limits | str]:
    """Return the column and the limits or the text of a word ``COLUMN=VALUE``."""
    column, equals, value = text.partition("=")
    if not equals or not column:
        raise click.BadParameter(f"{plain(text)!r} is not COLUMN=VALUE", param_hint="--where")
    try:
        limits: Limits = LimitsType().convert(value, None, None)
    except click.BadParameter:
        return column, value
    return column, limits


@click.command(short_help="Make an interactive page of a mechanism for any browser, or open the workbench.")
@click.argument("files", metavar="FILE...", nargs=-1)
@DRAWN
@click.option(
    "-o", "--output", metavar="OUT", help="Page to write: .html. By default a workbench opens in the browser."
)
@FORCE
@PRECISION
def view(files: tuple[str, ...], output: str | None, force: bool) -> None:
    """Make an interactive page of mechanisms: one file that opens in any browser, without a network.

    The page shows the crease pattern and the model in space. Drag a crease or a panel, or move a slider, one for
    each degree of freedom: all other joints follow, with rigid panels and a loop-closure residual below 1e-12. A
    slider along the path passes turning points. The motion branches are found when the page is made, and chosen on
    it. It shows immobile joints, panels that move as one body, panels that pass through each other, and spherical
    centres; it saves configurations as FOLD, OBJ or PNG. Several files give a list to choose from.

    Without -o a workbench opens in the browser: drop files on it, lock, remove and add creases, remove
    ride-alongs, download templates. It ends with Ctrl-C, or 10 seconds after its last page was closed. The
    workbench requires an extra: pip install 'synthedra[view]'.

    \b
    Examples:
      synth view data/patterns/bird-base.fold -o bird-base.html
      synth view
      synth view data/linkages/bennett.json data/wiener/miura-4x4.fold -o page.html
    """
    from synth.viewer.pages import check_built

    if output is not None:
        _check_page(output, force=force)
    elif not _can_serve():
        raise click.UsageError(
            "the workbench requires pip install 'synthedra[view]'; a page without it requires -o page.html"
        )
    check_built()
    mechanisms = [_shown(file) for file in files]
    if output is None:
        _serve(mechanisms, [Path(file).read_bytes() if Path(file).is_file() else None for file in files])
        return
    if not mechanisms:
        raise click.UsageError("a page requires at least one FILE")
    from graphs.files.atomic import write_text
    from synth.viewer.pages import page

    write_text(Path(output), page(mechanisms), force=force)
    tell_written(output)


def _check_page(output: str, *, force: bool) -> None:
    from graphs.files.outputs import unknown_extension

    if Path(output).suffix.lower() not in (".html", ".htm"):
        raise unknown_extension(output, [".html"])
    check_output(output, force=force)


def _shown(file: str) -> Shown:
    from synth.viewer.shown import shown_of

    mechanism = read(file)
    with about(file):
        return shown_of(precise_sheet(mechanism), Path(file).name)


def _can_serve() -> bool:
    return all(find_spec(name) is not None for name in ("starlette", "uvicorn"))


def _serve(mechanisms: list[Shown], sources: list[bytes | None]) -> None:
    from synth.viewer.workbench.app import serve

    def opened(address: str) -> None:
        click.echo(f"workbench: {address}  (Ctrl-C ends it)")
        webbrowser.open(address)

    serve(mechanisms, sources, opened)


_OF_PANELS = {"scale": None, "tabs": 8.0, "slots": False, "hinge_kind": "fold", "hinge_width": None}
_OF_SURFACES = {"cone_angle": None, "cone": None, "radius": None, "thickness": None}
"""Options of one kind of mechanism, with their defaults."""
_REALISED = 150.0
"""Millimetres of the longer side of a type that is realised: its coordinates have no size of their own."""
_SPELT = {"cone_angle": "--lambda", "hinge_kind": "--hinges", "hinge_width": "--hinge-width"}


@click.command(short_help="Write a template at true scale, to cut out and fold.")
@click.argument("file", metavar="FILE")
@DRAWN
@click.option("-o", "--output", required=True, metavar="OUT", help="Template to write: .pdf, .svg or .dxf.")
@ROW
@MODE
@click.option(
    "--as", "kind", type=click.Choice(["sheet", "space"]),
    help="Kind of realisation, for a type without coordinates.  [default: sheet]",
)  # fmt: skip
@click.option(
    "--page", "page", metavar="PAPER", default="A4", show_default=True,
    help="Paper size: A4, A3, Letter, or WIDTHxHEIGHT in mm.",
)  # fmt: skip
@click.option(
    "--scale", type=LENGTH, help="Millimetres per unit of the coordinates.  [default: the file's unit, or 1]"
)
@click.option(
    "--size", type=LENGTH, metavar="MM",
    help="Longer side of the template; on a cone or cylinder, length of the ruling lines.",
)  # fmt: skip
@click.option(
    "--tabs", type=LENGTH_OR_NONE, default=8.0, show_default=True, metavar="MM",
    help="Depth of the tabs; 0 leaves them out.",
)  # fmt: skip
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
    "--cone", "--cylinder", "cone", type=click.IntRange(min=1), metavar="K",
    help="For a linkage that lies on several cones or cylinders: number of the one to take.",
)  # fmt: skip
@click.option(
    "--radius", type=LENGTH, metavar="MM", help="Radius of the cylinder.  [default: that of the linkage, in mm]"
)
@click.option(
    "--thickness", type=LENGTH, metavar="MM",
    help="For a linkage on a cone or cylinder: thickness of the material.  [default: 0.3]",
)  # fmt: skip
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
    from graphs.files.outputs import check_writable
    from graphs.mechanism.surfaces import SurfaceLinkage
    from synth.drawing.mechanisms.chains import OrderOnCircle
    from synth.templates.pages import paper_named
    from synth.templates.writing import TEMPLATES, write_template

    try:
        paper = paper_named(page)
    except InvariantError as error:
        raise click.BadParameter(str(error), param_hint="--page") from None
    check_writable(output, TEMPLATES, force=force)
    source = read_named(file, row, mode)
    source = replace(source, mechanism=precise_sheet(source.mechanism))
    on_surface = isinstance(source.mechanism, SurfaceLinkage | OrderOnCircle)
    _refuse(look, _OF_PANELS if on_surface else _OF_SURFACES, "panels" if on_surface else "a linkage on a surface")
    notes: list[str] = []
    with about(source.name):
        if on_surface:
            pieces = _of_surface(source, kind, look)
        else:
            pieces, notes = _of_panels(source, kind, look, note=note and not _is_dxf(output))
    if not note:
        pieces = replace(pieces, steps=())
    elif _is_dxf(output):
        notes.append("not written: the assembly instructions, with a picture (a .pdf or .svg has them)")
    places = write_template(pieces, output, paper=paper, force=force)
    if as_json:
        print_json({"file": file, "output": list(map(str, places)), **pieces.to_json()})
    else:
        tell_written(*places)
    for line in notes:
        click.echo(line, err=True)


def _refuse(look: Mapping[str, Any], defaults: Mapping[str, Any], required: str) -> None:
    """Refuse options that belong to another kind of mechanism."""
    refused = [_SPELT.get(name, f"--{name}") for name, default in defaults.items() if look[name] != default]
    if refused:
        raise click.UsageError(f"{', '.join(refused)}: for {required} only")


def _of_panels(
    source: NamedMechanism, kind: Any, look: Mapping[str, Any], *, note: bool
) -> tuple[Template, list[str]]:
    """Return the template of panels, and notes to print."""
    from synth.templates.hinges import Hinges
    from synth.templates.template import panels_of_mechanism, pictured, template_of, unit_of

    if (look["hinge_kind"] == "fold") != (look["hinge_width"] is None):
        raise click.UsageError("--hinges offset, living or gap and --hinge-width require each other")
    hinges = None if look["hinge_width"] is None else Hinges(look["hinge_kind"], look["hinge_width"])
    mechanism: Any = source.mechanism
    sheet, realised = panels_of_mechanism(mechanism, kind=kind, mode=source.mode)
    options = {name: look[name] for name in ("scale", "size", "tabs", "slots")}
    notes = [f"{realised}, as by `synth realise`"] if realised else []
    if look["scale"] is None and look["size"] is None and realised:
        options["size"] = _REALISED
        notes.append(f"a type has no size: its longer side is {_REALISED:g} mm; --size changes it")
    elif look["scale"] is None and look["size"] is None and unit_of(sheet) is None:
        notes.append("the file names no unit: a unit of the coordinates is 1 mm")
    pieces = template_of(sheet, title=sheet.title or Path(source.name).name, hinges=hinges, **options)
    notes += [f"not shown: {', '.join(pieces.not_shown)}"] if pieces.not_shown else []
    if note:
        pieces, reason = pictured(pieces, sheet)
        notes += [f"no picture of the folded sheet: {plain(reason, 1000)}"] if reason else []
    return pieces, notes


def _of_surface(source: NamedMechanism, kind: Any, look: Mapping[str, Any]) -> Template:
    """Return the template of a linkage on a cone or a cylinder."""
    from synth.templates.on_surface import Dimensions, surface_of, template_on_surface
    from synth.templates.template import linkage_on_a_surface

    if source.mode is not None or kind is not None:
        raise click.UsageError("--mode and --as are for types without coordinates, not a linkage on a surface")
    mechanism: Any = source.mechanism
    cone = surface_from_options(look["cone_angle"], None)
    linkage = linkage_on_a_surface(mechanism, surface=cone, number=look["cone"])
    sizes = {name: look[name] for name in ("size", "thickness") if look[name] is not None}
    surface = surface_of(linkage, look["radius"])
    return template_on_surface(linkage, surface, Dimensions(**sizes), Path(source.name).name)


def _is_dxf(output: str) -> bool:
    return output.lower().endswith(".dxf")
