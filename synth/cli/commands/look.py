"""``synth look``: a first answer about any file."""

from dataclasses import replace

import click

import synth
from synth.cli import options
from synth.cli.output import about, check_picture, console, plain, print_json, tell_written
from synth.cli.reading import AT, DRAWN, PRECISION, precision, read


@click.command()
@options.FILE
@DRAWN
@AT
@options.output("Picture to write: .svg, .png or .pdf.")
@options.JSON
@PRECISION
@options.FORCE
def look(file: str, output: str | None, as_json: bool, force: bool) -> None:
    """Say in three sentences what a file is, whether and how it moves, and what is wrong with its drawing.

    FILE is a crease pattern, a drawing, a linkage or a type in any format, or an id. Commands that suit it follow.

    \b
    Examples:
      synth look data/patterns/bird-base.fold
      synth look data/patterns/bird-base.fold -o picture.svg
      synth look k1:Cr
    """
    if output is not None:
        check_picture(output, force=force)
    mechanism = read(file, warn=False)
    with about(file):
        answer = replace(synth.look(mechanism, precision=precision()), file=file)
        scene = None if output is None else synth.draw(mechanism)
    if as_json:
        print_json({"file": file, **answer.to_json()})
    else:
        console().print(plain(file, 4096), style="bold")
        for block in answer.blocks():
            console().print(block)
    if scene is not None and output is not None:
        scene.save(output, force=force)
        tell_written(output)
