"""``synth view``: a page on which mechanisms fold."""

from __future__ import annotations

from pathlib import Path

import click

from synth.cli.output import FORCE, about, check_output, plain

__all__ = ["view"]


@click.command(short_help="Make a page on which a mechanism folds, for any browser.")
@click.argument("files", metavar="FILE...", nargs=-1, required=True)
@click.option("-o", "--output", required=True, metavar="OUT", help="The page to write: .html.")
@FORCE
def view(files: tuple[str, ...], output: str, force: bool) -> None:
    """Make a page that shows mechanisms and lets them move, without a network: one file, by double click.

    The drawing is on it, and the model in space: drag a crease or a panel, or move the slider of the driven joint,
    and all others follow, panels rigid, loops closed to 1e-12. Ways to move are found now and chosen there; stiff
    joints and what moves as one are coloured; poses are saved as FOLD, OBJ or PNG. Several files make a list to
    choose from.

    \b
    Examples:
      synth view data/patterns/bird-base.fold -o bird-base.html
      synth view data/linkages/bennett.json data/wiener/miura-4x4.fold -o page.html
    """
    from graphs.errors import FileError
    from graphs.files.atomic import write_text
    from graphs.files.formats import read
    from synth.viewer.pages import check_built, page
    from synth.viewer.shown import shown_of

    if Path(output).suffix.lower() not in (".html", ".htm"):
        raise FileError(output, "", "the extension is not known", ".html")
    check_output(output, force=force)
    check_built()
    shown = []
    for file in files:
        thing = read(file)
        with about(file):
            shown.append(shown_of(thing, Path(file).name))
    write_text(Path(output), page(shown), force=force)
    click.echo(f"written: {plain(output, 4096)}")
