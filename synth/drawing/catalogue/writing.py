"""Catalogues written: a PDF of many pages, or a picture a page."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import chain
from pathlib import Path

from graphs.files.atomic import Beside
from synth.drawing.scene.shapes import Scene
from synth.drawing.scene.writing import check_picture, save_scene

__all__ = ["write_catalogue"]


def write_catalogue(
    pages: Iterable[Scene], path: str | Path, *, paper: str = "light", force: bool = False
) -> list[Path]:
    """Write pages: one PDF file, or a file for each page, ``name-1.svg``, ...; of one page, the file named.

    Parameters
    ----------
    pages : iterable of Scene
        Taken one by one.
    path : str or Path
        Ends in .pdf, .svg or .png.
    paper : {"light", "dark"}, optional
    force : bool, optional
        Replace files that are there.

    Returns
    -------
    list of Path
        The files, in order; none where there are no pages.

    Raises
    ------
    FileError
        If the extension is another, or a file cannot be written, or is there already.
    UnsolvableError
        If what writes PNG (matplotlib) or PDF (reportlab) is not installed.

    Examples
    --------
    >>> write_catalogue([], "a.bmp")
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: a.bmp: the extension is not known; expected .png, .svg, .pdf
    """
    check_picture(path, force=force)
    place, rest = Path(path), iter(pages)
    first = next(rest, None)
    if first is None:
        return []
    if place.suffix.lower() == ".pdf":
        _write_pdf(chain([first], rest), place, paper, force)
        return [place]
    return list(_each_page(first, rest, place, paper, force))


def _write_pdf(pages: Iterable[Scene], place: Path, paper: str, force: bool) -> None:
    from synth.drawing.scene.pdf import write_pdf

    beside = Beside(place, force=force)
    try:
        write_pdf(pages, beside.stream, paper=paper)
        beside.commit()
    finally:
        beside.discard()


def _each_page(first: Scene, pages: Iterator[Scene], place: Path, paper: str, force: bool) -> Iterator[Path]:
    second = next(pages, None)
    if second is None:
        save_scene(first, place, paper=paper, force=force)
        yield place
        return
    for number, page in enumerate(chain((first, second), pages), start=1):
        there = place.with_name(f"{place.stem}-{number}{place.suffix}")
        save_scene(page, there, paper=paper, force=force)
        yield there
