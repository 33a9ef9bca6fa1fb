"""Reference and theory linked to each other, by the pages that files cite; `conf.py` uses it."""

from __future__ import annotations

import ast
import re
from collections import defaultdict
from collections.abc import Iterable
from functools import cache
from inspect import getmodule
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphinx.application import Sphinx

__all__ = ["CrossLinks", "files_of", "with_links"]

ROOT = Path(__file__).resolve().parent.parent
_SOURCES = ("graphs/**/*.py", "enumerate/**/*.py", "synth/**/*.py", "synth/**/*.c")
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
        """Add to a theory page the names of what is documented in the reference, and the files that cite it."""
        del app
        folder, _, page = name.partition("/")
        if folder != "theory":
            return
        listed = [f"- {{py:obj}}`{one}`" for one in sorted(self.names.get(page, ()))]
        source[0] += "\n\n".join(["\n\n## In the reference", "\n".join(listed)]) + "\n" if listed else ""
        files = [f"- `{file}`" + (f": {what}" if what else "") for file, what in files_of(page)]
        source[0] += "\n\n".join(["\n\n## In the code", "\n".join(files)]) + "\n" if files else ""


def files_of(page: str) -> list[tuple[str, str]]:
    """Return the files that cite a theory page, or whose room does, by their paths; each with what it is about.

    Examples
    --------
    >>> [file.rpartition("/")[2] for file, _ in files_of("members")]  # doctest: +NORMALIZE_WHITESPACE
    ['_sweep.py', 'circuits.py', 'member_dimensions.py', 'member_kernel.c', 'member_kernel.py']
    """
    cited = {file for file, (pages, _) in _sources().items() if page in pages}
    rooms = {file.parent for file in cited if file.name == "__init__.py"}
    files = sorted(file for file in _sources() if file in cited or file.parent in rooms)
    return [(str(file), _sources()[file][1]) for file in files if file.name != "__init__.py"]


@cache
def _sources() -> dict[Path, tuple[set[str], str]]:
    """Return the files of the packages: which theory pages each cites, and the first line of its docstring."""
    sources = {}
    for file in (file for pattern in _SOURCES for file in ROOT.glob(pattern)):
        text = file.read_text(encoding="utf-8")
        told = ast.get_docstring(ast.parse(text)) or "" if file.suffix == ".py" else ""
        sources[file.relative_to(ROOT)] = (
            set(_CITED.findall(text)),
            told.partition("\n")[0].partition(" Theory: docs/")[0],
        )
    return sources


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
