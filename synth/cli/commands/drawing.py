"""``synth draw``, ``synth view`` and ``synth template``: pictures, pages and templates."""

from __future__ import annotations

import webbrowser
from collections.abc import Iterator
from dataclasses import replace
from importlib.util import find_spec
from math import radians
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

import synth.catalogue.realisation
import synth.linkages.guidance
import synth.making.drawing
import synth.making.templates
import synth.making.viewer
from graphs.errors import InvariantError
from graphs.files.outputs import check_writable, unknown_extension
from synth.cli import options, reading
from synth.cli.output import about, check_output, check_picture, plain, print_json, progress_line, tell_written
from synth.cli.reading import AT, DRAWN, MECHANISM, MODE, PRECISION, NamedMechanism, precise_sheet, read, read_named

if TYPE_CHECKING:
    from enumerate.runner import Limits
    from synth.catalogue.realisation._realise import Kind as RealisedKind
    from synth.making.drawing.list_pages import CatalogueEntry
    from synth.making.templates.hinges import HingeKind

_KINDS = (
    "pattern", "marks", "repairs", "flat-folded", "folded", "chain", "graph", "model", "solids", "cone", "cylinder",
    "circle", "sphere",
)  # fmt: skip
_COLOURS = ("letters", "verdict", "branch", "centres", "none")


def _colouring(ctx: click.Context, _parameter: click.Parameter, words: tuple[str, ...]) -> str:
    """Return the colouring; pairs with a look are kept for the drawing that is read."""
    reading.keep_looks(ctx, "colours", tuple(word for word in words if "=" in word))
    names = [word for word in words if "=" not in word]
    for name in names:
        if name not in _COLOURS:
            ctx.fail(f"--colour: {plain(name)!r} is neither {', '.join(_COLOURS)} nor M=LOOK")
    return names[-1] if names else "letters"


@click.command()
@options.FILE
@options.output("Picture to write: .svg, .png or .pdf.", required=True)
@options.choice("--as kind", _KINDS, "Kind of picture. By default the one that suits the file.", metavar="KIND")
@options.repeated(
    "--colour", "WHAT|" + reading.LOOK,
    "Colouring of a crease pattern: letters (the assignment in the file; the default), verdict (mobile and "
    "immobile creases), branch (initial rates of a branch), centres (classes of centres) or none. With M=..., for "
    "a drawing (.svg, .dxf): assignment of lines by their colour, their dash pattern or both, such as "
    "'V=dashed #000000'; - leaves lines out.", callback=_colouring,
)  # fmt: skip
@reading.LAYER
@options.branch("Branch to show with --colour branch or --as marks, by its number or its signs.")
@options.flag("--graph", "Draw the SC graph on top of a crease pattern.")
@options.flag("--numbers/--no-numbers", "Label links and joints with their numbers.", default=True)
@options.choice("--paper", ("light", "dark"), "Background of the picture.", default="light")
@options.repeated(
    "--where", "COLUMN=VALUE",
    "For a catalogue: draw only rows with this number (2, 2..4, 2..) or text in a column; may be repeated."
)  # fmt: skip
@options.flag(
    "--sheets/--no-sheets", "For a catalogue of SC or SCD graphs: show the realised sheet beside each.", default=True
)
@AT
@options.FORCE
def draw(
    file: str, output: str, kind: str | None, paper: str, where: tuple[str, ...], sheets: bool, force: bool, **look: Any
) -> None:  # fmt: skip
    """Draw the mechanism of a file or an id, or a catalogue of all mechanisms in a store, a list or a folder.

    KIND is pattern (a crease pattern in its plane), marks (a pattern with the creases whose assignment disagrees
    with a branch: the nearest one, or that of --branch), repairs (a pattern with the repairs that reading the
    drawing needed), flat-folded (folded flat, in its first layer order: front, back, light through the layers),
    folded (a folded sheet in space), chain (links as bodies, joints as small circles), graph (an SC or SCD graph,
    with the signs of the centres), model (vertices and rods), solids (hinged at edges, in space),
    cone or cylinder (a linkage round one, on the first of those it fits), circle (the order of its joints round a
    cone) or sphere (which axes keep orientations in their order). Numbers are those that messages and JSON use; in
    SVG, shapes carry them as data-link and data-joint.

    A store (.sqlite), rows (.jsonl, .parquet), a graph6 file or a folder gives a catalogue, 24 pictures per page,
    with id, name, degrees of freedom, centres and symmetry: one .pdf, or one file per page. SC and SCD graphs of up to
    12 links have their realised sheet beside them, or the reason why there is none below.

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
    from synth.making.drawing.list_pages import is_catalogue

    check_picture(output, force=force)
    if is_catalogue(file):
        conditions = dict(map(_condition, where))
        realise = synth.catalogue.realisation.sheet_of_type if sheets else None
        _draw_catalogue(file, output, {"kind": kind, "realise": realise}, conditions, paper, force)
        return
    if where:
        raise click.UsageError("--where requires a catalogue: a store, rows, a graph6 file or a folder")
    from graphs.files.native import holds_orientations

    drawable = synth.linkages.guidance.read_orientations(file) if holds_orientations(file) else read(file)
    with about(file):
        scene = synth.draw(drawable, kind, **look)
    scene.save(output, paper=paper, force=force)
    tell_written(output)


def _draw_catalogue(
    file: str, output: str, look: dict[str, Any], where: dict[str, Limits | str], paper: str, force: bool
) -> None:
    from synth.making.drawing.list_pages import catalogue_entries, catalogue_pages, write_catalogue

    failures: list[str] = []
    entries = _counted(catalogue_entries(file, where, failures))
    written = write_catalogue(catalogue_pages(entries, Path(file).name, **look), output, paper=paper, force=force)
    tell_written(*written)
    if not written:
        click.echo("nothing to draw")
    for failure in failures:
        click.echo(f"left out: {plain(failure, 4096)}", err=True)


def _counted(entries: Iterator[CatalogueEntry]) -> Iterator[CatalogueEntry]:
    """Yield entries; a terminal shows their number."""
    with progress_line() as show:
        for number, entry in enumerate(entries, start=1):
            show(f"{number} drawn")
            yield entry


def _condition(text: str) -> tuple[str, Limits | str]:
    """Return the column and the limits or the text of a word ``COLUMN=VALUE``."""
    column, equals, value = text.partition("=")
    if not equals or not column:
        raise click.BadParameter(f"{plain(text)!r} is not COLUMN=VALUE", param_hint="--where")
    try:
        return column, options.limits_of(value)
    except ValueError:
        return column, value


@click.command()
@click.argument("files", metavar="FILE...", nargs=-1, type=options.FILE_NAME)
@DRAWN
@options.output("Page to write: .html. By default a workbench opens in the browser.")
@options.FORCE
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
    from synth.making.viewer.pages import check_built

    if output is not None:
        if Path(output).suffix.lower() not in (".html", ".htm"):
            raise unknown_extension(output, [".html"])
        check_output(output, force=force)
    elif not all(find_spec(name) is not None for name in ("starlette", "uvicorn")):
        raise click.UsageError(
            "the workbench requires pip install 'synthedra[view]'; a page without it requires -o page.html"
        )
    check_built()
    mechanisms: list[synth.making.viewer.Shown] = []
    for file in files:
        mechanism = read(file)
        with about(file):
            mechanisms.append(synth.making.viewer.shown_of(precise_sheet(mechanism), Path(file).name))
    if output is None:
        _serve(mechanisms, [Path(file).read_bytes() if Path(file).is_file() else None for file in files])
        return
    if not mechanisms:
        raise click.UsageError("a page requires at least one FILE")
    synth.making.viewer.ViewPage(synth.making.viewer.page(mechanisms), tuple(mechanisms)).save(output, force=force)
    tell_written(output)


def _serve(mechanisms: list[synth.making.viewer.Shown], sources: list[bytes | None]) -> None:
    from synth.making.viewer.workbench.app import serve

    def opened(address: str) -> None:
        click.echo(f"workbench: {address}  (Ctrl-C ends it)")
        webbrowser.open(address)

    serve(mechanisms, sources, opened)


_OF_PANELS = {"scale": None, "tabs": 8.0, "slots": False, "hinge_kind": "fold", "hinge_width": None}
_OF_SURFACES = dict.fromkeys(("cone_angle", "number", "radius", "thickness"))
"""Options of a template, by their parameters, for panels and for linkages on surfaces, with their defaults."""
_SPELLED = {"cone_angle": "--lambda", "number": "--cone", "hinge_kind": "--hinges", "hinge_width": "--hinge-width"}


@click.command()
@MECHANISM
@options.output("Template to write: .pdf, .svg or .dxf.", required=True)
@reading.ROW
@MODE
@options.choice(
    "--as kind", ("sheet", "space"), "Kind of realisation, for a type without coordinates.  [default: sheet]"
)
@options.value("--page page", "PAPER", "Paper size: A4, A3, Letter, or WIDTHxHEIGHT in mm.", default="A4")
@options.value(
    "--scale", None, "Millimetres per unit of the coordinates.  [default: the file's unit, or 1]",
    type=options.LENGTH,
)  # fmt: skip
@options.value(
    "--size", "MM", "Longer side of the template; on a cone or cylinder, length of the ruling lines.",
    type=options.LENGTH,
)  # fmt: skip
@options.value("--tabs", "MM", "Depth of the tabs; 0 leaves them out.", default=8.0, type=options.LENGTH_OR_NONE)
@options.flag("--slots", "Join tabs through slots, without glue.")
@options.choice(
    "--hinges hinge_kind", ("fold", "offset", "living", "gap"),
    "Hinges in thick material: offset (two folds per crease), living (rows of cuts) or gap (panels apart). Each "
    "requires --hinge-width.", default="fold",
)  # fmt: skip
@options.value("--hinge-width", "MM", "Width of offset, living or gap hinges.", type=options.LENGTH)
@options.cone_angle("For a linkage on a cone: cone angle.")
@options.NUMBER_OF_SURFACE
@options.value("--radius", "MM", "Radius of the cylinder.  [default: that of the linkage, in mm]", type=options.LENGTH)
@options.value(
    "--thickness", "MM", "For a linkage on a cone or cylinder: thickness of the material.  [default: 0.3]",
    type=options.LENGTH,
)  # fmt: skip
@options.flag(
    "--laser",
    "For a laser cutter: one drawing at full size, without pages; cuts red, folds to score blue, marks to engrave "
    "black, in layers of these names.",
)  # fmt: skip
@options.value(
    "--kerf", "MM", "Width of the cut: outlines move outward, and into holes, by half of it.", default=0.0,
    type=options.LENGTH_OR_NONE,
)  # fmt: skip
@options.flag("--note/--no-note", "Add assembly instructions, with a picture.", default=True)
@AT
@options.FORCE
@options.JSON
@PRECISION
def template(
    file: str, output: str, row: int | None, mode: str | None, page: str, note: bool, force: bool, as_json: bool,
    laser: bool, kerf: float, **look: Any,
) -> None:  # fmt: skip
    """Write a template of panels at true scale, to cut out and fold.

    FILE is a file, an id m1:... or k1:..., an R/- string, or a store, a list or a folder of types, of which --row
    names one. A type without coordinates is realised first. Coordinates are in the unit that the file names; where
    it names none, and for a type, the longer side is 150 mm, unless --scale or --size says otherwise. A template
    larger than a page is divided into tiles, never made smaller: tiles overlap by 10 mm, and crosses with the same
    name are laid on each other. Each page has a gauge of 100 mm; measure it after printing. For .svg each page is a
    file; a .dxf is one drawing at full size.

    A folded surface is unfolded into nets without overlaps, with tabs: edges with the same number are glued, or
    joined by slots. In thick material, folds are strips of a stated width. For a laser cutter, --laser writes one
    drawing in layers (CUT red, SCORE blue, ENGRAVE black) and --kerf allows for the width of the cut.

    Links of a spherical linkage of axes are triangles and pyramids from its centre, to be taped at the joints.

    For a linkage on a cone or cylinder, or a row of conical candidates, the template is the unrolled surface and
    one piece per link, with slots where joints pass from layer to layer.

    \b
    Examples:
      synth template data/patterns/bird-base.fold --size 150 -o bird-base.pdf
      synth template data/patterns/bird-base.fold --size 600 --page A3 -o bird-base.pdf
      synth template m1:a-b.ac-.b-d.cd- --size 200 -o four-bar.dxf
      synth template data/patterns/bird-base.fold --size 300 --hinges living --hinge-width 8 -o bird-base.dxf
      synth template data/patterns/bird-base.fold --size 300 --laser --kerf 0.15 -o bird-base.dxf
      synth template RR-R-RRR --mode D --size 180 -o ups.pdf
      synth template data/surfaces/fig11-stephenson.json --size 120 -o stephenson.pdf
      synth template types.sqlite --row 7 --size 150 -o seventh.svg
    """
    from synth.exporters import EXPORTERS
    from synth.linkages.conformed.orders import OrderOnCircle

    try:
        paper = synth.making.templates.paper_named(page)
    except InvariantError as error:
        raise click.BadParameter(str(error), param_hint="--page") from None
    check_writable(output, EXPORTERS["templates"], force=force)
    bare = laser or output.lower().endswith(".dxf")
    source = read_named(file, row, mode)
    source = replace(source, mechanism=precise_sheet(source.mechanism))
    on_surface = isinstance(source.mechanism, synth.SurfaceLinkage | OrderOnCircle)
    look = _without(look, *((_OF_PANELS, "panels") if on_surface else (_OF_SURFACES, "a linkage on a surface")))
    notes: list[str] = []
    with about(source.name):
        if on_surface:
            pieces = _of_surface(source, **look)
        else:
            pieces, notes = _of_panels(source, picture=note and not bare, **look)
    if not note:
        pieces = replace(pieces, steps=())
    elif bare:
        notes.append("not written: the assembly instructions, with a picture (a .pdf or .svg of pages has them)")
    with about(source.name):
        places = synth.making.templates.write_template(pieces, output, paper=paper, laser=laser, kerf=kerf, force=force)
    if as_json:
        print_json({"file": file, "output": list(map(str, places)), **pieces.to_json()})
    else:
        tell_written(*places)
    for line in notes:
        click.echo(line, err=True)


def _without(look: dict[str, Any], others: dict[str, Any], required: str) -> dict[str, Any]:
    """Return the options of a template without those of another kind of mechanism, which are refused."""
    refused = [name for name, default in others.items() if look[name] != default]
    if refused:
        listed = ", ".join(_SPELLED.get(name, f"--{name}") for name in refused)
        raise click.UsageError(f"{listed}: for {required} only")
    return {name: value for name, value in look.items() if name not in others}


def _of_panels(
    source: NamedMechanism, hinge_kind: HingeKind | Literal["fold"], hinge_width: float | None, **look: Any
) -> tuple[synth.making.templates.Template, list[str]]:
    """Return the template of panels, and notes to print."""
    from synth.making.templates.hinges import Hinges
    from synth.making.templates.of_mechanism import template_of_panels

    hinges = None
    if hinge_kind != "fold" and hinge_width is not None:
        hinges = Hinges(hinge_kind, hinge_width)
    elif hinge_kind != "fold" or hinge_width is not None:
        raise click.UsageError("--hinges offset, living or gap and --hinge-width require each other")
    mechanism: Any = source.mechanism
    return template_of_panels(mechanism, Path(source.name).name, mode=source.mode, hinges=hinges, **look)


def _of_surface(
    source: NamedMechanism, kind: RealisedKind | None, cone_angle: float | None, **look: Any
) -> synth.making.templates.Template:
    """Return the template of a linkage on a cone or a cylinder."""
    from synth.making.templates.of_mechanism import template_of_linkage

    if source.mode is not None or kind is not None:
        raise click.UsageError("--mode and --as are for types without coordinates, not a linkage on a surface")
    mechanism: Any = source.mechanism
    angle = None if cone_angle is None else radians(cone_angle)
    return template_of_linkage(mechanism, Path(source.name).name, cone_angle=angle, **look)
