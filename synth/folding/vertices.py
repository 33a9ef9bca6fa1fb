"""Where the vertices of a crease pattern are at fold angles, and how far its panels disagree on that.

Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from graphs.convert.duality import SheetMechanism
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet
from graphs.types import Floats
from synth.motion.linkage import PosedLinkage
from synth.motion.placement import link_motions

__all__ = ["largest_panel", "vertex_places"]


def vertex_places(
    sheet: Sheet, mechanism: SheetMechanism, linkage: PosedLinkage, angles: Floats
) -> tuple[Floats, Floats]:
    """Return where the vertices of a crease pattern are, and how far panels disagree on that.

    At fold angles float[F, J], radians: places float[F, vertices, 3] in the unit of the coordinates, where
    vertices of no face stay, and the largest distance between two places of one vertex by different panels,
    float[F], in units of the extent.
    """
    assert sheet.coordinates is not None
    local = (in_space(sheet.coordinates) - linkage.middle) / linkage.extent
    motions = link_motions(linkage, angles, largest_panel(mechanism.panels))
    places = np.broadcast_to(local, (len(angles), *local.shape)).copy()
    placed = np.zeros(sheet.vertices, dtype=bool)
    apart = np.zeros(len(angles))
    for link, faces in enumerate(mechanism.panels):
        here = sorted({vertex for face in faces for vertex in sheet.faces[face]})
        rotation, shift = motions[link]
        moved = np.einsum("fij,vj->fvi", rotation, local[here]) + shift[:, None]
        known = placed[here]
        again = moved[:, known] - places[:, np.array(here)[known]]
        apart = np.maximum(apart, np.linalg.norm(again, axis=-1).max(axis=1, initial=0.0))
        places[:, np.array(here)[~known]] = moved[:, ~known]
        placed[here] = True
    return places * linkage.extent + linkage.middle, apart


def largest_panel(panels: Sequence[Sequence[Any]]) -> int:
    """Return the link of most faces: what a sheet is held by.

    >>> largest_panel([[0], [1, 2], [3]])
    1
    """
    return max(range(len(panels)), key=lambda link: len(panels[link]))
