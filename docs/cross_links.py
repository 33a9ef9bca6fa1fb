"""Reference and theory linked to each other, by the pages that modules cite; `conf.py` uses it."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable
from inspect import getmodule
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphinx.application import Sphinx

__all__ = ["CrossLinks", "with_links"]

_CITED = re.compile(r"docs/theory/([\w-]+)\.md")
_PAGE = re.compile(r"(?<![\w/])`{0,2}docs/((?:theory/|guides/)?[\w-]+)\.md`{0,2}")


class CrossLinks:
    """Which functions belong to which theory page.

    Parameters
    ----------
    offered : iterable of (str, object)
        Names under which functions and classes are documented, and these.
    """

    def __init__(self, offered: Iterable[tuple[str, object]]) -> None:
        self.names: dict[str, list[str]] = defaultdict(list)
        for name, thing in offered:
            for page in _pages_of(thing):
                self.names[page].append(name)

    def connect(self, app: Sphinx) -> None:
        """Have links made while the site is built."""
        app.connect("source-read", self.add_names)
        app.connect("autodoc-process-docstring", add_pages, priority=900)  # numpydoc comes before

    def add_names(self, app: Sphinx, name: str, source: list[str]) -> None:
        """Add to a theory page the names of what is documented in the reference."""
        del app
        names = self.names.get(name.removeprefix("theory/"), ()) if name.startswith("theory/") else ()
        if names:
            listed = "\n".join(f"- {{py:obj}}`{one}`" for one in sorted(names))
            source[0] += f"\n\n## In the reference\n\n{listed}\n"


def add_pages(app: Sphinx, what: str, name: str, thing: object, options: Any, lines: list[str]) -> None:
    """Make links of the pages that a docstring names, and add the theory pages of its module."""
    del app, name, options
    lines[:] = with_links("\n".join(lines)).split("\n")
    told = "\n".join(lines)
    pages = [page for page in _pages_of(thing) if f"/theory/{page}" not in told]
    if pages and what in ("function", "class"):
        lines += ["", "Theory: " + ", ".join(f":doc:`/theory/{page}`" for page in pages) + ".", ""]


def with_links(docstring: str) -> str:
    """Return a docstring whose pages of the documentation are links.

    Examples
    --------
    >>> with_links("Theory: docs/theory/pose.md.")
    'Theory: :doc:`/theory/pose`.'
    """
    return _PAGE.sub(r":doc:`/\1`", docstring)


def _pages_of(thing: object) -> list[str]:
    """Return the theory pages that the module of a thing cites."""
    module = getmodule(thing)
    return sorted(set(_CITED.findall(module.__doc__ or ""))) if module else []
