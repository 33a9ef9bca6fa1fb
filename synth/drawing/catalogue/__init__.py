"""Catalogues: every mechanism of a store, a list or a folder, numbered, on pages."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphs.lazy import offered

if TYPE_CHECKING:
    from synth.drawing.catalogue.entries import CatalogueEntry as CatalogueEntry
    from synth.drawing.catalogue.entries import catalogue_entries as catalogue_entries
    from synth.drawing.catalogue.pages import catalogue_pages as catalogue_pages
    from synth.drawing.catalogue.writing import write_catalogue as write_catalogue
else:
    __getattr__, __dir__, __all__ = offered(
        __name__,
        {
            "entries": "CatalogueEntry catalogue_entries",
            "pages": "catalogue_pages",
            "writing": "write_catalogue",
        },
    )
