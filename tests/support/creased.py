"""What tests of folding ask of Miura sheets, whose generator is in `synth.catalogue.patterns`."""

from __future__ import annotations

import numpy as np

from graphs.mechanism.sheet import Sheet


def is_zigzag(sheet: Sheet, joints) -> np.ndarray:
    """Return which creases of a Miura sheet lie on its zigzags: they do not go straight up."""
    return np.array([sheet.coordinates[a][0] != sheet.coordinates[b][0] for a, b in (sheet.edges[j] for j in joints)])
