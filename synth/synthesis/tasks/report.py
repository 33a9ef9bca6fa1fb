"""The report on a task: a page of HTML that opens offline, with a picture of each ranked design."""

from __future__ import annotations

import re
from collections.abc import Iterator
from html import escape
from pathlib import Path

from graphs.convert.conversions import Mechanism
from graphs.errors import OpenError, SynthedraError, UnsolvableError
from graphs.files.atomic import make_folder, reason_of, write_text
from graphs.files.formats import write
from graphs.mechanism.sheet import Sheet
from graphs.printing import TableBlock, html_of
from synth.making.drawing.mechanisms.pictures import draw
from synth.making.drawing.scene.writing import svg_text
from synth.making.templates.of_mechanism import template
from synth.making.templates.writing import write_template
from synth.making.viewer.pages import html_page, view
from synth.synthesis.designing.designs import FIGURE_HEADS
from synth.synthesis.tasks.ranking import RankedDesign, RankedTypes
from synth.synthesis.tasks.structure import reasons_text

_POLICY = "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'"
_STYLE = (
    "body{font-family:sans-serif;margin:2em;max-width:64em}td,th{text-align:left;padding:.2em .8em}"
    "figure{margin:1em 0}svg{max-width:28em;height:auto}section{border-top:1px solid #bbb}"
)
_MOST = 20
"""Designs with a picture and figures of their own."""


_NUMBERED = re.compile(r"[0-9]+-.+[.](json|fold|html|pdf)$")
"""Names of designs, their pages and templates."""


def report_page(answer: RankedTypes) -> str:
    """Return a page about a task: its answer, and each ranked design with its picture and figures.

    Parameters
    ----------
    answer : RankedTypes

    Returns
    -------
    str
        HTML that needs nothing else.

    Examples
    --------
    >>> from synth.synthesis.tasks._task import task
    >>> page = report_page(task("data/tasks/lid.json", starts=2, rounds=1))
    >>> "four-bar" in page, "<svg" in page
    (True, True)
    """
    title = answer.task.title or "Task"
    lines = "".join(f"<p>{escape(line)}</p>" for line in answer.first_lines())
    table = html_of([answer.ranked_table()]) if answer.ranked else ""
    parts = [_section(answer, place, one) for place, one in enumerate(answer.ranked[:_MOST], 1)]
    others = html_of([answer.missed_table()]) if answer.missed else ""
    left = answer.structure.placements_left_out
    placements = f"<p>placements left out: {escape(reasons_text(left))}</p>" if left else ""
    body = f"<h1>{escape(title)}</h1>{lines}{placements}{table}{''.join(parts)}"
    body += f"<h2>Types that fell out when they were designed</h2>{others}" if others else ""
    return html_page(_POLICY, f"<title>{escape(title)}</title><style>{_STYLE}</style>", body)


def _section(answer: RankedTypes, place: int, one: RankedDesign) -> str:
    """Return the part of a page about one design."""
    design = answer.design(one)
    roles = ", ".join(f"{role}: link {link}" for role, link in zip(answer.task.roles, one.candidate.links, strict=True))
    try:
        picture = f"<figure>{svg_text(draw(design.mechanism, numbers=True, caption=None))}</figure>"
    except SynthedraError as error:
        picture = f"<p>no picture: {escape(str(error))}</p>"
    rows = html_of([TableBlock(FIGURE_HEADS, design.rows(), ())])
    verdict = f"<p>{escape(design.verdict)}</p>"
    return (
        f"<section><h2>{place}. {escape(answer.name(one))}</h2><p>{escape(roles)}</p>{verdict}{picture}{rows}</section>"
    )


def write_report(answer: RankedTypes, path: str | Path, *, force: bool = False) -> Path:
    """Write the report on a task.

    Parameters
    ----------
    answer : RankedTypes
    path : str or Path
        A name that ends in .html.
    force : bool, optional
        Whether to overwrite a file.

    Returns
    -------
    Path

    Raises
    ------
    FileError
        If it cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from synth.synthesis.tasks._task import task
    >>> answer = task("data/tasks/lid.json", starts=2, rounds=1)
    >>> with TemporaryDirectory() as folder:
    ...     write_report(answer, Path(folder, "lid.html")).name
    'lid.html'
    """
    path = Path(path)
    write_text(path, report_page(answer), force=force)
    return path


def write_designs(answer: RankedTypes, folder: str | Path, *, most: int = _MOST, force: bool = False) -> list[Path]:
    """Write the ranked designs as files that every other command reads: ``1-four-bar.json``, ``2-watt.json``, ....

    Parameters
    ----------
    answer : RankedTypes
    folder : str or Path
    most : int, optional
        How many.
    force : bool, optional
        Whether to overwrite files.

    Returns
    -------
    list of Path

    Raises
    ------
    FileError
        If one cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from synth.synthesis.tasks._task import task
    >>> with TemporaryDirectory() as folder:
    ...     [path.name for path in write_designs(task("data/tasks/lid.json", starts=2, rounds=1), folder)]
    ['1-four-bar.json']
    """
    make_folder(Path(folder))
    written = []
    for mechanism, stem in _best(answer, Path(folder), most):
        path = stem.with_suffix(".fold" if isinstance(mechanism, Sheet) else ".json")
        write(mechanism, path, force=force)
        written.append(path)
    return written


def write_pages(
    answer: RankedTypes, folder: str | Path, *, most: int = _MOST, force: bool = False
) -> tuple[list[Path], list[str]]:
    """Write a page that moves and a template of each ranked design: ``1-four-bar.html`` and ``1-four-bar.pdf``, ....

    Parameters
    ----------
    answer : RankedTypes
    folder : str or Path
    most : int, optional
        How many designs.
    force : bool, optional
        Whether to overwrite files.

    Returns
    -------
    list of Path
    list of str
        What could not be shown, with the reason: links whose joint axes are skew have no template.

    Raises
    ------
    FileError
        If a file cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from synth.synthesis.tasks._task import task
    >>> with TemporaryDirectory() as folder:
    ...     written, notes = write_pages(task("data/tasks/lid.json", starts=2, rounds=1), folder)
    >>> [path.name for path in written], notes
    (['1-four-bar.html', '1-four-bar.pdf'], [])
    """
    make_folder(Path(folder))
    written: list[Path] = []
    notes: list[str] = []
    for mechanism, stem in _best(answer, Path(folder), most):
        page, paper = stem.with_suffix(".html"), stem.with_suffix(".pdf")
        try:
            view(mechanism, title=stem.name).save(page, force=force)
            written.append(page)
        except UnsolvableError as error:
            notes.append(f"no page of {stem.name}: {error}")
        try:
            written += write_template(template(mechanism), paper, force=force)
        except UnsolvableError as error:
            notes.append(f"no template of {stem.name}: {error}")
    return written, notes


def check_folder_of_designs(folder: Path, *, force: bool) -> None:
    """Refuse a folder, before a search whose designs it is to hold: one that cannot be, or holds designs already."""
    try:
        begun = min((each for each in folder.iterdir() if _NUMBERED.match(each.name)), default=None)
    except FileNotFoundError:
        return
    except (OSError, ValueError) as error:
        raise OpenError(folder, "", f"cannot be written: {reason_of(error)}", "a folder") from None
    if begun is not None and not force:
        raise OpenError(begun, "", "exists already", "another folder, or --force (in Python force=True)")


def _best(answer: RankedTypes, folder: Path, most: int) -> Iterator[tuple[Mechanism, Path]]:
    """Yield the first designs, and the name of their files without an extension."""
    for place, one in enumerate(answer.ranked[:most], 1):
        name = "".join(letter if letter.isalnum() else "-" for letter in answer.name(one))
        yield answer.design(one).mechanism, folder / f"{place}-{name}"
