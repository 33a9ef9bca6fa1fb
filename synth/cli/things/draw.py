"""``synth draw``: a picture of any mechanism, a catalogue of many."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any

import click

from synth.cli.lengths import BRANCH
from synth.cli.output import FORCE, about, check_picture, plain, tell_written
from synth.cli.reading import LAYER, LOOK, keep_looks, read
from synth.cli.runner import LimitsType

if TYPE_CHECKING:
    from enumerate.runner.job import Limits
    from synth.drawing.catalogue.entries import CatalogueEntry
    from synth.drawing.mechanisms.pictures import Drawable

__all__ = ["draw"]

_KINDS = (
    "pattern", "marks", "repairs", "folded", "chain", "graph", "model", "solids", "cone", "cylinder", "circle",
    "sphere",
)  # fmt: skip
_PATIENCE = 2.0
"""Seconds between two words on how far a catalogue has come."""
_COLOURS = ("letters", "verdict", "branch", "centres", "none")


def _colouring(ctx: click.Context, parameter: click.Parameter, words: tuple[str, ...]) -> str:
    """Return what colours tell; pairs with a look are kept for the drawing that is read."""
    keep_looks(ctx, tuple(word for word in words if "=" in word))
    names = [word for word in words if "=" not in word]
    for name in names:
        if name not in _COLOURS:
            ctx.fail(f"--colour: {plain(name)!r} is none of {', '.join(_COLOURS)}, and no M=LOOK")
    del parameter
    return names[-1] if names else "letters"


@click.command(short_help="Draw a crease pattern, a chain, an SC or SCD graph, or a polyhedron model.")
@click.argument("file", metavar="FILE")
@click.option("-o", "--output", required=True, metavar="OUT", help="Picture to write: .svg, .png or .pdf.")
@click.option(
    "--as",
    "kind",
    type=click.Choice(_KINDS),
    help="Kind of picture. By default the one that suits the file.",
    metavar="KIND",
)
@click.option(
    "--colour", multiple=True, metavar="WHAT|" + LOOK, callback=_colouring,
    help="Colouring of a crease pattern: letters (the assignment in the file; the default), verdict (mobile and "
    "immobile creases), branch (initial rates of a branch), centres (classes of centres) or none. With M=..., for "
    "a drawing (.svg, .dxf): assignment of the lines of a colour, a dash pattern or both "
    "('V=dashed #000000'); - leaves them out.",
)  # fmt: skip
@LAYER
@click.option(
    "--branch",
    type=BRANCH,
    metavar="K",
    help="Branch to show with --colour branch or --as marks, by its number or its signs.",
)
@click.option("--graph", is_flag=True, help="Draw the SC graph on top of a crease pattern.")
@click.option(
    "--numbers/--no-numbers", default=True, show_default=True, help="Label links and joints with their numbers."
)
@click.option(
    "--paper",
    type=click.Choice(["light", "dark"]),
    default="light",
    show_default=True,
    help="Background of the picture.",
)
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
    from synth.drawing.catalogue.entries import is_catalogue

    check_picture(output, force=force)
    if is_catalogue(file):
        _catalogue(file, output, kind, dict(map(_asked, where)), paper, force)
        return
    if where:
        raise click.UsageError("--where is for catalogues: a store, rows, a graph6 file or a folder")
    from synth.drawing.mechanisms import pictures
    from synth.drawing.scene.writing import save_scene

    thing = _read(file)
    with about(file):
        scene = pictures.draw(thing, kind, **look)
    save_scene(scene, output, paper=paper, force=force)
    tell_written(output)


def _read(file: str) -> Drawable:
    """Return what a file holds: a mechanism, or orientations."""
    from graphs.files.native.orientations import holds_orientations

    if not holds_orientations(file):
        return read(file)
    from synth.guidance.orientations import read_orientations

    return read_orientations(file)


def _catalogue(
    file: str, output: str, kind: str | None, where: dict[str, Limits | str], paper: str, force: bool
) -> None:
    from synth.drawing.catalogue.entries import catalogue_entries
    from synth.drawing.catalogue.pages import catalogue_pages
    from synth.drawing.catalogue.writing import write_catalogue

    failures: list[str] = []
    shown = _counted(catalogue_entries(file, where, failures))
    written = write_catalogue(catalogue_pages(shown, Path(file).name, kind), output, paper=paper, force=force)
    tell_written(*written)
    if not written:
        click.echo("nothing to draw")
    for failure in failures:
        click.echo(f"left out: {plain(failure, 4096)}", err=True)


def _counted(entries: Iterator[CatalogueEntry]) -> Iterator[CatalogueEntry]:
    """Yield entries; a terminal shows now and then how many there were."""
    number, told = 0, monotonic()
    for number, entry in enumerate(entries, start=1):
        if sys.stderr.isatty() and monotonic() - told > _PATIENCE:
            click.echo(f"\r{number} drawn", nl=False, err=True)
            told = monotonic()
        yield entry
    if sys.stderr.isatty():
        click.echo(f"\r{number} drawn", err=True)


def _asked(text: str) -> tuple[str, Limits | str]:
    column, equals, value = text.partition("=")
    if not equals or not column:
        raise click.BadParameter(f"{plain(text)!r} is not COLUMN=VALUE", param_hint="--where")
    try:
        limits: Limits = LimitsType().convert(value, None, None)
    except click.BadParameter:
        return column, value
    return column, limits
