"""Templates written to files, whole or not at all: PDF, SVG or DXF, by the extension."""

from __future__ import annotations

from pathlib import Path

from graphs.errors import FileError
from graphs.files.atomic import Beside, check_place
from graphs.printing import plain
from synth.templates.formats.dxf import dxf_of_template
from synth.templates.formats.pdf import check_reportlab, pdf_of_pages
from synth.templates.formats.svg import svg_of_page
from synth.templates.page import Page
from synth.templates.pages import pages_of
from synth.templates.paper import Paper
from synth.templates.template import Template

__all__ = ["check_template", "write_template"]

_KINDS = (".pdf", ".svg", ".dxf")
_LONGEST_TITLE = 200
_A4 = Paper(210.0, 297.0)


def check_template(path: str | Path, *, force: bool = False) -> None:
    """Refuse a path where no template can be written, before one is made.

    Raise FileError if the extension is unknown, or an existing file must not be replaced; UnsolvableError for a
    PDF if reportlab is not installed.

    >>> check_template("a.doc")
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: a.doc: the extension is not known; expected .pdf, .svg, .dxf
    """
    place = Path(path)
    suffix = place.suffix.lower()
    if suffix not in _KINDS:
        raise FileError(place, "", "the extension is not known", ", ".join(_KINDS))
    if suffix == ".pdf":
        check_reportlab()
    check_place(place, force=force)


def write_template(
    template: Template, path: str | Path, *, paper: Paper = _A4, force: bool = False
) -> tuple[Path, ...]:
    """Write a template; equal templates give equal files.

    Parameters
    ----------
    template : Template
    path : str or Path
        ``.pdf``: a file with all pages, that of assembly last. ``.svg``: a file, or one for each page,
        ``t-1.svg``, ``t-2.svg``, ..., and ``t-note.svg``. ``.dxf``: one drawing at full size; no pages, no note.
    paper : Paper, optional
        A4 without it; it is turned where that saves pages.
    force : bool, optional
        Replace files that are there.

    Returns
    -------
    tuple of Path
        What was written.

    Raises
    ------
    FileError
        If the extension is not known, or a file cannot be written or is there already.
    UnsolvableError
        If there would be too many pages, or reportlab is not installed.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.templates.template import template_of
    >>> square = Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), ((0, 0), (1, 0), (1, 1), (0, 1)))
    >>> with TemporaryDirectory() as folder:
    ...     made = write_template(template_of(square, size=50), Path(folder, "square.svg"))
    ...     print([(path.name, path.read_text()[:4]) for path in made])
    [('square.svg', '<svg'), ('square-note.svg', '<svg')]
    """
    place = Path(path)
    check_template(place, force=force)
    suffix = place.suffix.lower()
    if suffix == ".dxf":
        files = {place: dxf_of_template(template).encode("ascii", "replace")}
    elif suffix == ".pdf":
        files = {place: pdf_of_pages(pages_of(template, paper), plain(template.title, _LONGEST_TITLE))}
    else:
        files = _svg_files(pages_of(template, paper), place)
    for one in files:
        check_place(one, force=force)
    for one, data in files.items():
        beside = Beside(one, force=force)
        try:
            beside.write(data)
            beside.commit()
        finally:
            beside.discard()
    return tuple(files)


def _svg_files(pages: list[Page], place: Path) -> dict[Path, bytes]:
    """Return the name and content of each page; that of assembly is a file of its own, of which nothing is cut."""
    lines = [page for page in pages if not page.is_note]
    names = [place]
    if len(lines) > 1:
        names = [place.with_name(f"{place.stem}-{number}{place.suffix}") for number in range(1, len(lines) + 1)]
    files = dict(zip(names, lines, strict=True))
    files |= {place.with_name(f"{place.stem}-note{place.suffix}"): page for page in pages if page.is_note}
    return {name: svg_of_page(page).encode() for name, page in files.items()}
