"""``synth view``: a page on which mechanisms fold."""

from __future__ import annotations

import webbrowser
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import click

from synth.cli.output import FORCE, about, check_output, tell_written
from synth.cli.precision import PRECISION, precise_sheet
from synth.cli.reading import DRAWN, read

if TYPE_CHECKING:
    from synth.viewer.shown import Shown

__all__ = ["view"]


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
        raise click.UsageError("the workbench needs pip install 'synthedra[view]'; a page needs -o page.html")
    check_built()
    shown = [_shown(file) for file in files]
    if output is None:
        _serve(shown, [Path(file).read_bytes() if Path(file).is_file() else None for file in files])
        return
    if not shown:
        raise click.UsageError("a page shows something: expected FILE")
    from graphs.files.atomic import write_text
    from synth.viewer.pages import page

    write_text(Path(output), page(shown), force=force)
    tell_written(output)


def _check_page(output: str, *, force: bool) -> None:
    from graphs.errors import FileError

    if Path(output).suffix.lower() not in (".html", ".htm"):
        raise FileError(output, "", "the extension is not known", ".html")
    check_output(output, force=force)


def _shown(file: str) -> Shown:
    from synth.viewer.shown import shown_of

    thing = read(file)
    with about(file):
        thing = precise_sheet(thing)
        return shown_of(thing, Path(file).name)


def _can_serve() -> bool:
    return all(find_spec(name) is not None for name in ("starlette", "uvicorn"))


def _serve(shown: list[Shown], sources: list[bytes | None]) -> None:
    from synth.viewer.workbench.app import serve

    def opened(address: str) -> None:
        click.echo(f"workbench: {address}  (Ctrl-C ends it)")
        webbrowser.open(address)

    serve(shown, sources, opened)
