"""How the site is made: Sphinx with MyST and numpydoc. ``make docs`` builds it, without a network."""

from __future__ import annotations

import sys
from importlib.metadata import version as version_of
from pathlib import Path
from typing import TYPE_CHECKING

HERE = Path(__file__).resolve().parent
if TYPE_CHECKING:
    from sphinx.application import Sphinx

sys.path.insert(0, str(HERE))

from cross_links import CrossLinks  # noqa: E402
from gallery import add_links, add_pages  # noqa: E402
from reference_pages import write_reference  # noqa: E402

project = "synthedra"
release = version_of("synthedra")
extensions = ["myst_parser", "numpydoc", "sphinx.ext.autodoc", "sphinx.ext.autosummary"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["_build"]
html_theme = "furo"
html_title = f"synthedra {release}"
html_show_sourcelink = False
html_copy_source = False
myst_heading_anchors = 3
autosummary_generate = False
numpydoc_show_class_members = False
autodoc_typehints = "none"
default_role = "py:obj"
suppress_warnings = ["myst.xref_missing"]  # links to files of the project that are no pages: a test follows them

_links = CrossLinks(write_reference(HERE / "reference"))


def setup(app: Sphinx) -> None:
    """Have reference and theory linked to each other, and pages and templates beside the gallery."""
    _links.connect(app)
    app.connect("source-read", add_links)
    app.connect("build-finished", add_pages)
