"""A site of an atlas: static pages to search, filter and fold, which work from a folder without a server.

Scripts are classic ones beside the pages: from ``file://`` browsers load neither modules nor data. A job of types
writes their files into a new folder, which appears when it is complete.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from html import escape
from pathlib import Path
from typing import Any

from enumerate.runner.job import Column, Job, Row, Unit
from enumerate.runner.sinks import FolderSink
from graphs.errors import SynthedraError, UnsolvableError, numbered
from graphs.mechanism.sheet import Sheet
from graphs.printing import plain
from synth.making.drawing.list_pages import drawable_of_type
from synth.making.drawing.mechanisms.pictures import draw
from synth.making.drawing.scene.writing import svg_text
from synth.making.templates.pages import pages_of, paper_named
from synth.making.templates.template import template_of
from synth.making.viewer.building import BUILT
from synth.making.viewer.page_data import shown_of
from synth.making.viewer.pages import check_built, data_in_page, html_page, json_in_html
from synth.synthesis.atlas.atlas_file import Atlas, TypeReport, open_guarded, report_of, value_text
from synth.synthesis.atlas.columns import COLUMNS, damaged
from synth.synthesis.atlas.export import sheet_of_type

_POLICY = (
    "default-src 'none'; script-src 'self' file:; style-src 'self' file: 'unsafe-inline'; "
    "img-src 'self' file: blob: data:; base-uri 'none'; form-action 'none'"
)
"""Own scripts, styles and pictures, and nothing else; no requests to anywhere."""


def document(title: str, styles: Sequence[str], body: str) -> str:
    """Return a page of a site with an HTML body.

    The title is plain text, escaped here; style sheets are paths from the page.
    """
    head = [f"<title>{escape(plain(title, 200))}</title>"]
    head += [f'<link rel="stylesheet" href="{place}">' for place in styles]
    return html_page(_POLICY, "\n".join(head), body)


SEARCHED = (
    "id", "kind", "name", "links", "joints", "dof", "centres", "symmetry", "ride_alongs", "all_explicit",
    "realised", "fold_deg",
)  # fmt: skip
"""Columns that the first page knows."""

_INDEX_BODY = """<main id="gallery">
<h1>{title}</h1>
<p class="about">{about}</p>
<noscript>This page searches by a script, and scripts are switched off: see the folder types.</noscript>
</main>
<script src="data.js"></script>
<script src="gallery.js"></script>"""


def index_page(title: str, about: str) -> str:
    """Return the HTML of the first page: its title, and how it was made, both plain text."""
    body = _INDEX_BODY.format(title=escape(plain(title, 200)), about=escape(plain(about, 1000)))
    return document(title, ["gallery.css"], body)


def data_script(rows: Sequence[Mapping[str, Any]], title: str, about: str, digits: int) -> str:
    """Return the script with the data of the first page: `AtlasData` of web/src/gallery/types.js.

    Rows have the columns `SEARCHED`; `digits` are those of the numbers in names of files.
    """
    data = {
        "title": title,
        "about": about,
        "digits": digits,
        "columns": {name: [row[name] for row in rows] for name in SEARCHED},
        "says": {name: COLUMNS[name].says for name in SEARCHED},
    }
    return f"window.atlasData = {json_in_html(data)};\n"


_BOX = (200.0, 150.0)
"""Largest width and height of a drawing, points."""
_PRINTED = 180.0
"""Longer side of a template, millimetres: it fits a page of A4."""

_TYPE_BODY = """<article class="type">
<p><a href="../index.html">All types</a></p>
<h1>{title}</h1>
{names}
<div class="facts">
<p><img class="drawing" src="../pictures/{file}-graph.svg" alt="drawing of the type">{links}</p>
<table>{facts}</table>
</div>
{neighbours}
</article>
{folding}"""
_FOLDING = """<main id="page"></main>
<script type="application/json" id="data">{data}</script>
<script src="../page.js"></script>"""


def files_of_type(report: TypeReport, file: str, places: Mapping[str, str]) -> dict[str, str]:
    """Return the files of a type, path to text: its page, picture and graph, and those of the realised type.

    `file` is their name without extension; `places` has the names of the files of each type of the site, by id.
    The picture is for the list: of the crease pattern, if there is one.
    """
    values = report.values
    fold, sheet = values.get("fold_file"), sheet_of_type(values)
    template = None if sheet is None else _template(sheet)
    body = _TYPE_BODY.format(
        title=_text(values.get("name") or values["id"]),
        file=file,
        names="".join(f"<p>{_text(name.name)}: {_text(name.source)}</p>" for name in report.named),
        links=_links(file, fold, template),
        facts="".join(_fact(name, value) for name, value in values.items() if name != "fold_file"),
        neighbours=_neighbours(report, places),
        folding="" if sheet is None else _FOLDING.format(data=data_in_page([shown_of(sheet, values["id"])])),
    )
    graph = _picture(drawable_of_type(values["kind"], values["id"]))
    files = {
        f"types/{file}.html": document(values.get("name") or values["id"], ["../page.css", "../gallery.css"], body),
        f"pictures/{file}.svg": graph if sheet is None else _picture(sheet),
        f"pictures/{file}-graph.svg": graph,
        f"types/{file}.fold": fold,
        f"types/{file}-template.svg": template,
    }
    return {path: text for path, text in files.items() if text is not None}


def _picture(drawable: Any) -> str:
    return svg_text(draw(drawable, box=_BOX, caption=None))


def _text(value: Any) -> str:
    return escape(plain(value, 2000))


def _fact(name: str, value: Any) -> str:
    text = ", ".join(map(str, value)) if isinstance(value, tuple) else value_text(value)
    says = f'<td class="says">{_text(COLUMNS[name].says)}</td>'
    return f"<tr><th>{_text(name.replace('_', ' '))}</th><td>{_text(text)}</td>{says}</tr>"


def _links(file: str, fold: str | None, template: str | None) -> str:
    links = [f'<a href="{file}.fold" download>crease pattern (FOLD)</a>'] * (fold is not None)
    links += [f'<a href="{file}-template.svg">template to print, cut out and fold</a>'] * (template is not None)
    return "".join(f"<br>{link}" for link in links)


def _neighbours(report: TypeReport, places: Mapping[str, str]) -> str:
    rows, unlisted = report.first_neighbours()
    if not rows:
        return ""
    lines = [
        f"<tr><th>{_text(relation)}</th><td>{linked}</td><td>{_text(name)}</td></tr>"
        for relation, code, name, _ in rows
        for linked in [f'<a href="{places[code]}.html">{_text(code)}</a>' if code in places else _text(code)]
    ]
    more = report.more + unlisted
    last = f"<p>and {numbered(more, 'more related type')}</p>" if more else ""
    return f"<h2>Related types</h2><table>{''.join(lines)}</table>{last}"


def _template(sheet: Sheet) -> str | None:
    """Return a template on one page of A4; None if the panels need more."""
    try:
        template = replace(template_of(sheet, size=_PRINTED), steps=())  # on one page, with no other beside it
        pages = pages_of(template, paper_named("A4"))
    except SynthedraError:
        return None
    return svg_text(pages[0].scene) if len(pages) == 1 else None


_UNIT, _WEIGHT = 16, 1000
"""Types per unit, and the weight of a type: it takes as long as so many rows of a list."""
_MOST = 100_000
"""Most types of a site: a file system and a page that is searched take no more."""
_SCRIPTS = ("page.js", "page.css", "gallery.js", "gallery.css", "LICENSES.txt")


@dataclass(frozen=True)
class Site:
    """The pages of types of an atlas, by its path and their ids, as a job whose rows are files: name and text."""

    atlas: str
    ids: tuple[str, ...]

    @property
    def columns(self) -> dict[str, Column]:
        """The path of a file in the folder, and its text."""
        return {"name": str, "text": str}

    @property
    def key(self) -> dict[str, Any]:
        """The identity of the job."""
        return {"site": self.atlas, "types": len(self.ids)}

    @property
    def digits(self) -> int:
        """Digits of the numbers in names of files."""
        return len(str(len(self.ids)))

    def units(self) -> list[Unit]:
        """Units of some types each, by their numbers."""
        starts = range(0, len(self.ids), _UNIT)
        return [Unit((start, min(start + _UNIT, len(self.ids))), _UNIT * _WEIGHT) for start in starts]

    def work(self, payload: tuple[int, int]) -> list[Row]:
        """Return the files of a unit."""
        places = {code: self._file(number) for number, code in enumerate(self.ids)}
        rows: list[Row] = []
        with open_guarded(Path(self.atlas)) as connection:
            for number in range(*payload):
                report = report_of(connection, self.ids[number], Path(self.atlas))
                if report is None:  # its id was read a moment ago
                    raise damaged(Path(self.atlas), "the index", self.ids[number], "an id that it finds")
                rows += files_of_type(report, self._file(number), places).items()
        return rows

    def _file(self, number: int) -> str:
        return f"{number + 1:0{self.digits}d}"


class SiteSink(FolderSink):
    """A sink that writes the files of a site into a new folder; `first` are those that belong to no type."""

    def __init__(self, path: str | Path, first: Mapping[str, str]) -> None:
        super().__init__(Path(path))
        self._first = first

    def start(self, job: Job) -> Collection[int]:
        """Make a folder beside its place, with the files that belong to no type.

        Raise FileError if something is at its place, or it cannot be made.
        """
        there = super().start(job)
        for name in ("types", "pictures"):
            (self._begun.path / name).mkdir()
        self.take(0, list(self._first.items()), 0.0)
        return there

    def take(self, number: int, rows: list[Row], seconds: float) -> None:
        """Write the files of a unit: a row is a name and a text."""
        for row in rows:
            self._write(*row)


def site_of(atlas: Atlas, condition: str = "", title: str = "") -> tuple[Site, dict[str, str]]:
    """Return the job of a site, for the types with a condition (by default all), and its other files.

    Raise UnsolvableError if there are no such types, or too many, or the scripts were not built.
    """
    check_built()
    rows = atlas.query(condition, columns=SEARCHED, limit=_MOST)
    if rows.more or not rows.rows:
        what = f"more than {_MOST} types" if rows.more else "no types"
        raise UnsolvableError(f"{what} for a site; try another condition")
    site = Site(str(atlas.path), tuple(row["id"] for row in rows))
    about = atlas.about()
    origin = f"{numbered(len(rows), 'type')}; made by synthedra {about['synthedra']}: {about['command']}"
    name = title or "Atlas of types"
    first = {script: (BUILT / script).read_text(encoding="utf-8") for script in _SCRIPTS}
    first["index.html"] = index_page(name, origin)
    first["data.js"] = data_script(rows.rows, name, origin, site.digits)
    return site, first
