"""Pages: one self-contained HTML file of data and a script, which loads nothing and may load nothing.

The policy of the page allows its own script and style, by their digests, and pictures that it makes itself. Data
are JSON in which no letter can end their element. Theory: docs/theory/viewer.md.
"""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Sequence
from hashlib import sha256
from html import escape
from pathlib import Path
from typing import Any

from graphs.errors import UnsolvableError
from graphs.printing import plain
from synth.viewer.building import BUILT
from synth.viewer.shown import Shown

__all__ = ["check_built", "json_in_html", "page"]

_SCRIPT, _STYLE = "page.js", "page.css"
_MISSING = (
    "the script of the page was not built when synthedra was installed: install node and npm, then install it "
    "again (in a clone: make page)"
)
_PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="referrer" content="no-referrer">
<title>{title}</title>
<style>{style}</style>
</head>
<body>
<noscript>This page folds by a script, and scripts are switched off.</noscript>
<main id="page"></main>
<script type="application/json" id="data">{data}</script>
<script>{script}</script>
</body>
</html>
"""


def page(shown: Sequence[Shown], title: str = "", *, workbench: bool = False, built: Path = BUILT) -> str:
    """Return a page that shows mechanisms and lets them move.

    Parameters
    ----------
    shown : sequence of Shown
        The mechanisms to choose from.
    title : str, optional
        By default the name of the first mechanism.
    workbench : bool, optional
        Whether the page has a workbench behind it, to which it sends files.
    built : Path, optional
        The folder of the built script and its style.

    Returns
    -------
    str
        HTML that needs no other file and no network.

    Raises
    ------
    UnsolvableError
        If the script of the page was not built.

    Examples
    --------
    Without a built script, as before an installation:

    >>> page([], built=Path("nowhere"))
    Traceback (most recent call last):
    ...
    graphs.errors.UnsolvableError: the script of the page was not built when synthedra was installed: ...
    """
    script, style = _text(built / _SCRIPT), _text(built / _STYLE)
    policy = (
        f"default-src 'none'; script-src {_digest(script)}; style-src {_digest(style)}; "
        "img-src blob: data:; base-uri 'none'; form-action 'none'"
    )
    if workbench:
        policy += "; connect-src 'self'"
    name = title or (shown[0].name if shown else "")
    return _PAGE.format(
        policy=policy,
        title=escape(plain(name or "synthedra")),
        style=style,
        data=json_in_html({"shown": [mechanism.to_json() for mechanism in shown], "workbench": workbench}),
        script=script,
    )


def json_in_html(value: Any) -> str:
    r"""Return JSON in which nothing can end a script element or begin a comment."""
    text = json.dumps(value, allow_nan=False, separators=(",", ":"))  # other letters than ASCII are escaped
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def check_built(built: Path = BUILT) -> None:
    """Raise UnsolvableError, before a page is computed, if the script of pages was not built."""
    _text(built / _SCRIPT)


def _text(place: Path) -> str:
    if not place.is_file():
        raise UnsolvableError(_MISSING)
    return place.read_text(encoding="utf-8")


def _digest(text: str) -> str:
    return f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"
