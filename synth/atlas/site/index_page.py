"""The first page of a site of an atlas, and the data it searches.

Scripts are classic ones beside the page: from ``file://`` browsers load neither modules nor data.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

from graphs.printing import plain
from synth.atlas.columns import COLUMNS
from synth.atlas.site.document import document
from synth.viewer.pages import json_in_html

__all__ = ["SEARCHED", "data_script", "index_page"]

SEARCHED = (
    "id", "kind", "name", "links", "joints", "dof", "centres", "symmetry", "ride_alongs", "all_explicit",
    "realised", "fold_deg",
)  # fmt: skip
"""Columns that the first page knows."""

_BODY = """<main id="gallery">
<h1>{title}</h1>
<p class="about">{about}</p>
<noscript>This page searches by a script, and scripts are switched off: see the folder types.</noscript>
</main>
<script src="data.js"></script>
<script src="gallery.js"></script>"""


def index_page(title: str, about: str) -> str:
    """Return the HTML of the first page: its title, and how it was made, both plain text.

    >>> "<h1>a &lt; b</h1>" in index_page("a < b", "")
    True
    """
    body = _BODY.format(title=escape(plain(title, 200)), about=escape(plain(about, 1000)))
    return document(title, ["gallery.css"], body)


def data_script(rows: Sequence[Mapping[str, Any]], title: str, about: str, digits: int) -> str:
    """Return the script with the data of the first page: `AtlasData` of web/src/gallery/types.js.

    Rows have the columns `SEARCHED`; `digits` are those of the numbers in names of files.

    >>> row = dict.fromkeys(SEARCHED) | {"id": "k1:Cr", "fold_deg": 90.0}
    >>> data_script([row], "atlas", "", 1)[:60]
    'window.atlasData = {"title":"atlas","about":"","digits":1,"c'
    """
    data = {
        "title": title,
        "about": about,
        "digits": digits,
        "columns": {name: [row[name] for row in rows] for name in SEARCHED},
        "says": {name: COLUMNS[name].says for name in SEARCHED},
    }
    return f"window.atlasData = {json_in_html(data)};\n"
