"""The patterns whose guises are compared: generated ones, those of the project, crease patterns by other people."""

from __future__ import annotations

import os
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np

from graphs.errors import SynthedraError
from graphs.files.formats import READERS, read
from graphs.mechanism.sheet import Sheet
from tests.agreement.specimens import Specimen, is_placed, specimens
from tests.support.folding_patterns import frog_base, pleated_hypar, triangulated
from tests.support.real_patterns import folder_of_patterns

__all__ = ["MOST_PANELS", "folder_of_layers", "patterns"]

MOST_PANELS = 120
"""Larger patterns are left out, so that the comparison ends."""


def folder_of_layers() -> Path:
    """Return the folder of flat-foldable patterns by other people, which may not be there."""
    return Path(os.environ.get("SYNTHEDRA_LAYERS", folder_of_patterns().parent / "layers"))


def patterns(part: str = "") -> Iterator[tuple[str, Sheet]]:
    """Yield the names and sheets of all patterns with up to `MOST_PANELS` panels whose names contain a text."""
    for specimen in _all(part):
        if part not in specimen.name:
            continue
        try:
            sheet = specimen.load()
        except SynthedraError:
            continue
        if isinstance(sheet, Sheet) and is_placed(sheet):
            placed = sheet if sheet.frames is None else sheet.frames.first_placed()
            if 1 < len(placed.faces) <= MOST_PANELS:
                yield specimen.name, placed


def _all(part: str) -> Iterator[Specimen]:
    for rings in (1, 2, 3):
        for creased in (False, True):
            name = f"made/hypar-{rings}{'-creased' * creased}"
            yield Specimen(name, partial(pleated_hypar, rings, middle_creased=creased))
    yield Specimen("made/frog-base", frog_base)
    for seed in (1, 2):
        yield Specimen(f"made/triangulated-{seed}", partial(_triangulated, seed))
    yield from specimens(part)
    if folder_of_layers().is_dir():
        for file in sorted(folder_of_layers().iterdir()):
            if file.suffix in READERS:
                yield Specimen(f"layers/{file.name}", partial(read, file), file)


def _triangulated(seed: int) -> Sheet:
    return triangulated(3, 3, np.random.default_rng(seed))
