from synth.drawing.catalogue.entries import (
    CatalogueEntry as CatalogueEntry,
    catalogue_entries as catalogue_entries,
)
from synth.drawing.catalogue.pages import catalogue_pages as catalogue_pages
from synth.drawing.catalogue.writing import write_catalogue as write_catalogue
