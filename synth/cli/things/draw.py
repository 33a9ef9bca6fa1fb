"""``synth draw``: a picture of any mechanism."""

from __future__ import annotations

import click

from synth.cli.output import FORCE, about, check_picture, plain

__all__ = ["draw"]

_KINDS = ("pattern", "folded", "chain", "graph", "model")
_COLOURS = ("letters", "centres", "none")


@click.command(short_help="Draw a crease pattern, a chain, an SC or SCD graph, a model.")
@click.argument("file", metavar="FILE")
@click.option("-o", "--output", required=True, metavar="OUT", help="Picture to write: .svg, .png or .pdf.")
@click.option(
    "--as",
    "kind",
    type=click.Choice(_KINDS),
    help="Kind of picture. Default: what suits the file.",
    metavar="KIND",
)
@click.option(
    "--colour", type=click.Choice(_COLOURS), default="letters", show_default=True,
    help="What colours of creases tell: letters of the file, classes of centres, nothing.",
)  # fmt: skip
@click.option("--graph", is_flag=True, help="Draw the SC graph over a crease pattern.")
@click.option("--numbers/--no-numbers", default=True, show_default=True, help="Numbers of links and joints.")
@click.option("--paper", type=click.Choice(["light", "dark"]), default="light", show_default=True)
@FORCE
def draw(
    file: str, output: str, kind: str | None, colour: str, graph: bool, numbers: bool, paper: str, force: bool
) -> None:
    """Draw the mechanism of a file, or of an id.

    KIND is pattern (a crease pattern in its plane), folded (a folded sheet in space), chain (links as bodies,
    joints as small circles), graph (an SC or SCD graph, with the signs of the centres) or model (vertices and
    rods). Numbers are those that messages and JSON use; in SVG, shapes carry them as data-link and data-joint.

    \b
    Examples:
      synth draw data/patterns/bird-base.fold -o bird-base.svg
      synth draw data/patterns/bird-base.fold --graph --colour centres -o bird-base.pdf
      synth draw data/wiener/fortune-teller.json -o graph.png
      synth draw k1:Cr -o four-bar.svg
    """
    from graphs.files.formats import read
    from synth.drawing.mechanisms import pictures
    from synth.drawing.scene.writing import save_scene

    check_picture(output, force=force)
    thing = read(file)
    with about(file):
        scene = pictures.draw(thing, kind, colour=colour, graph=graph, numbers=numbers)
    save_scene(scene, output, paper=paper, force=force)
    click.echo(f"written: {plain(output, 4096)}")
