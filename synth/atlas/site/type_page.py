"""The page of a type: what is known of it, its drawing, types it is related to, and the thing that folds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from html import escape
from typing import Any

from graphs.errors import SynthedraError
from graphs.mechanism.sheet import Sheet
from graphs.printing import plain
from synth.atlas.asked.mechanisms import sheet_of_type
from synth.atlas.asked.type_report import TypeReport
from synth.atlas.columns import COLUMNS
from synth.atlas.site.document import document
from synth.drawing.catalogue.atlas_types import drawable_of_type
from synth.drawing.mechanisms.pictures import draw
from synth.drawing.scene.svg import svg_text
from synth.templates.formats.svg import svg_of_page
from synth.templates.pages import pages_of
from synth.templates.paper import paper_named
from synth.templates.template import template_of
from synth.viewer.pages import json_in_html
from synth.viewer.shown import shown_of

__all__ = ["TypeFiles", "files_of_type"]

_BOX = (200.0, 150.0)
"""Points of a drawing, at most."""
_PRINTED = 180.0
"""Millimetres of the longer side of a template: it fits a page of A4."""

_BODY = """<article class="type">
<p><a href="../index.html">All types</a></p>
<h1>{title}</h1>
{names}
<div class="facts">
<p><img class="drawing" src="../pictures/{file}-graph.svg" alt="drawing of the type">{links}</p>
<table>{facts}</table>
</div>
{neighbours}
</article>
{thing}"""
_THING = """<main id="page"></main>
<script type="application/json" id="data">{data}</script>
<script src="../page.js"></script>"""


@dataclass(frozen=True, slots=True)
class TypeFiles:
    """The files of a type: its page (HTML), its picture and its graph (SVG).

    The picture is for the list, of the crease pattern if there is one. `fold` is the realised type (FOLD),
    `template` what is printed, cut out and folded (SVG).
    """

    page: str
    picture: str
    graph: str
    fold: str | None
    template: str | None


def files_of_type(report: TypeReport, file: str, places: Mapping[str, str]) -> TypeFiles:
    """Return the files of a type, with a name without extension.

    `places` has the names of the files of each type of the site, by id.
    """
    values = report.values
    fold, sheet = values.get("fold_file"), sheet_of_type(values)
    template = None if sheet is None else _template(sheet)
    title = values.get("name") or values["id"]
    body = _BODY.format(
        title=_text(title),
        file=file,
        names="".join(f"<p>{_text(one.name)}: {_text(one.source)}</p>" for one in report.named),
        links=_links(file, fold, template),
        facts="".join(_fact(name, value) for name, value in values.items() if name != "fold_file"),
        neighbours=_neighbours(report, places),
        thing="" if sheet is None else _thing(sheet, values["id"]),
    )
    page = document(title, ["../page.css", "../gallery.css"], body)
    graph = _picture(drawable_of_type(values["kind"], values["id"]))
    return TypeFiles(page, graph if sheet is None else _picture(sheet), graph, fold, template)


def _picture(thing: Any) -> str:
    return svg_text(draw(thing, box=_BOX, caption=None))


def _text(value: Any) -> str:
    return escape(plain(value, 2000))


def _fact(name: str, value: Any) -> str:
    told = ", ".join(map(str, value)) if isinstance(value, tuple) else value
    if isinstance(value, bool):
        told = "yes" if value else "no"
    told = _text(f"{told:.6g}" if isinstance(told, float) else told)
    says = f'<td class="says">{_text(COLUMNS[name].says)}</td>'
    return f"<tr><th>{_text(name.replace('_', ' '))}</th><td>{told}</td>{says}</tr>"


def _links(file: str, fold: str | None, template: str | None) -> str:
    links = [f'<a href="{file}.fold" download>crease pattern (FOLD)</a>'] * (fold is not None)
    links += [f'<a href="{file}-template.svg">template to print, cut out and fold</a>'] * (template is not None)
    return "".join(f"<br>{link}" for link in links)


def _neighbours(report: TypeReport, places: Mapping[str, str]) -> str:
    rows, unlisted = report.told_neighbours()
    if not rows:
        return ""
    lines = [
        f"<tr><th>{_text(relation)}</th><td>{_linked(code, places)}</td><td>{_text(name)}</td></tr>"
        for relation, code, name, _ in rows
    ]
    more = report.more + unlisted
    told = f"<p>and {more} more that are related to it</p>" if more else ""
    return f"<h2>Related types</h2><table>{''.join(lines)}</table>{told}"


def _linked(code: str, places: Mapping[str, str]) -> str:
    if code not in places:
        return f"{_text(code)}"
    return f'<a href="{places[code]}.html">{_text(code)}</a>'


def _thing(sheet: Sheet, code: str) -> str:
    data = {"shown": [shown_of(sheet, code).to_json()], "workbench": False}
    return _THING.format(data=json_in_html(data))


def _template(sheet: Sheet) -> str | None:
    """Return a template on one page of A4; None where the panels do not go on one."""
    try:
        template = replace(template_of(sheet, size=_PRINTED), steps=())  # on one page, with no other beside it
        pages = pages_of(template, paper_named("A4"))
    except SynthedraError:
        return None
    return svg_of_page(pages[0]) if len(pages) == 1 else None
