"""A site of an atlas, written in this process."""

from __future__ import annotations

from pathlib import Path

from enumerate.runner._run import run
from synth.synthesis.atlas.atlas_file import Atlas
from synth.synthesis.atlas.site_pages import SiteSink, site_of


def write_site(atlas: Atlas, path: Path, title: str = "") -> Path:
    """Write a site into a new folder; return its first page."""
    site, first = site_of(atlas, title=title)
    run(site, SiteSink(path, first))
    return path / "index.html"
