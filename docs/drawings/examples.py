"""What is drawn: files of data/ and generated patterns and linkages, each as the kind that a drawing asks for."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import synth
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.types import Floats

__all__ = ["DATA", "generated_sheet", "generated_solids", "graph_of_file", "sheet_of_file", "with_places"]

DATA = Path(__file__).resolve().parent.parent.parent / "data"


def sheet_of_file(name: str) -> Sheet:
    """Return the sheet of a file, named as in ``data/index.json``."""
    sheet = synth.read(DATA / name)
    assert isinstance(sheet, Sheet)
    return sheet


def graph_of_file(name: str) -> SCGraph:
    """Return the SC or SCD graph of a file."""
    graph = synth.read(DATA / name)
    assert isinstance(graph, SCGraph)
    return graph


def generated_sheet(name: str, *, fold: float | None = None, **parameters: float) -> Sheet:
    """Return a sheet by its generator."""
    sheet = synth.generate(name, fold=fold, **parameters).mechanism
    assert isinstance(sheet, Sheet)
    return sheet


def with_places(sheet: Sheet, places: Floats) -> Sheet:
    """Return a sheet with its vertices elsewhere: float[vertices, 2] or float[vertices, 3]."""
    return replace(sheet, coordinates=tuple(map(tuple, places.tolist())))


def generated_solids(name: str, **parameters: float) -> HingedSolids:
    """Return a linkage of hinged solids by its generator."""
    solids = synth.generate(name, **parameters).mechanism
    assert isinstance(solids, HingedSolids)
    return solids
