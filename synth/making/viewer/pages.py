"""Pages: one self-contained HTML file of data and a script, which loads nothing and may load nothing.

The policy of the page allows its own script and style, by their digests, and pictures that it makes itself. Data
are JSON in which no letter can end their element. Theory: docs/theory/viewer.md.
"""

import json
from base64 import b64encode
from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import sha256
from html import escape
from pathlib import Path
from typing import Any

from graphs.errors import FileError, UnsolvableError
from graphs.files.atomic import write_text
from graphs.files.mechanism_like import MechanismLike, mechanism_for, with_stated_precision
from graphs.files.outputs import check_installed
from graphs.printing import plain
from synth.making.viewer.building import BUILT
from synth.making.viewer.page_data import Shown, shown_of

_SUFFIXES = (".html", ".htm")

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
{head}
</head>
<body>
{body}
</body>
</html>
"""
_HEAD = """<meta name="referrer" content="no-referrer">
<title>{title}</title>
<style>{style}</style>"""
_BODY = """<noscript>This page folds by a script, and scripts are switched off.</noscript>
<main id="page"></main>
<script type="application/json" id="data">{data}</script>
<script>{script}</script>"""


def html_page(policy: str, head: str, body: str) -> str:
    """Return a page with a policy on what it may load; head and body are HTML."""
    return _PAGE.format(policy=policy, head=head, body=body)


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
    head = _HEAD.format(title=escape(plain(name or "synthedra")), style=style)
    return html_page(policy, head, _BODY.format(data=data_in_page(shown, workbench=workbench), script=script))


@dataclass(frozen=True, repr=False)
class ViewPage:
    """An interactive page of mechanisms, which opens in any browser, without a network.

    Attributes
    ----------
    html : str
        The page; a notebook shows it in a frame.
    mechanisms : tuple of Shown
        What it shows.

    Methods
    -------
    save(path, force=False)
        Write the page.
    widget(height=600)
        Return the page as a widget of a notebook.

    Examples
    --------
    >>> ViewPage("<!DOCTYPE html>", ()).save("page.pdf")
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: page.pdf: the extension is not known; expected .html
    """

    html: str
    mechanisms: tuple[Shown, ...]

    def save(self, path: str | Path, *, force: bool = False) -> None:
        """Write the page to an .html file; FileError if it exists, or the extension is another."""
        if Path(path).suffix.lower() not in _SUFFIXES:
            raise FileError(path, "", "the extension is not known", _SUFFIXES[0])
        write_text(Path(path), self.html, force=force)

    def to_json(self) -> dict[str, object]:
        """Return the data of the page."""
        return {"shown": [mechanism.to_json() for mechanism in self.mechanisms]}

    def __repr__(self) -> str:
        return f"<ViewPage: {', '.join(mechanism.name or 'mechanism' for mechanism in self.mechanisms)}>"

    def widget(self, height: int = 600) -> Any:
        """Return the page as a widget of a notebook, `height` pixels high; UnsolvableError without anywidget."""
        check_installed("anywidget", "a widget")
        from synth.making.viewer.widget import PageWidget

        return PageWidget(html=self.html, height=height)

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, object]:
        """Return the page in a frame, and a still picture for readers that show no frames."""
        del include, exclude
        bundle: dict[str, object] = {"text/plain": repr(self), "text/html": self._repr_html_()}
        picture = next((shown.pictures["light"] for shown in self.mechanisms if shown.pictures), None)
        return bundle if picture is None else {**bundle, "image/svg+xml": picture}

    def _repr_html_(self) -> str:
        return f'<iframe srcdoc="{escape(self.html)}" width="100%" height="600"></iframe>'


def view(
    mechanism: MechanismLike,
    *others: MechanismLike,
    title: str = "",
    motion: bool | None = None,
    precision: float | None = None,
) -> ViewPage:
    """Make an interactive page of mechanisms, which fold on it with rigid panels.

    Parameters
    ----------
    mechanism, *others : Mechanism, str or Path
        One, or several to choose from on the page.
    title : str, optional
        By default the name of the first file.
    motion : bool, optional
        Look for the motion of a crease pattern; by default unless it is too large.
    precision : float, optional
        The error that a coordinate of crease patterns may have, in their unit.

    Returns
    -------
    ViewPage

    Raises
    ------
    UnsolvableError
        If the script of pages was not built when synthedra was installed.
    FileError
        If a file cannot be read.

    Examples
    --------
    ``view("miura.fold").save("miura.html")`` writes the page of a file.

    >>> view("no such file.fold")
    Traceback (most recent call last):
    ...
    graphs.errors.OpenError: no such file.fold: no such file; expected a file
    """
    shown = []
    for each in (mechanism, *others):
        source = mechanism_for("view", each)
        name = Path(each).name if isinstance(each, str | Path) else getattr(source, "title", "")
        shown.append(shown_of(with_stated_precision(source, precision), name, motion=motion))
    return ViewPage(page(shown, title), tuple(shown))


def data_in_page(shown: Sequence[Shown], *, workbench: bool = False) -> str:
    """Return the data of the script of a page: `PageData` of web/src/page/types.js."""
    return json_in_html({"shown": [mechanism.to_json() for mechanism in shown], "workbench": workbench})


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
