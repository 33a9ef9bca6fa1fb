"""Rounded coordinates of a crease pattern moved, within their precision, to ones that fold.

Sheets of quadrilaterals fold because their geometry is special, and rounding takes that away: as it is written
such a pattern is rigid. Where rates would agree but for what the coordinates cannot tell, vertices are moved to
where they do. Theory: docs/theory/mending.md.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from graphs.geometry import across, best_plane
from graphs.mechanism.precision import Precision, off_plane
from graphs.mechanism.sheet import Sheet
from graphs.types import Floats
from synth.folding.mending.places import VertexPlaces
from synth.motion.misfit import EXACT

__all__ = ["FARTHEST", "Mended", "flattened", "precision_with_pieces", "with_vertices"]

FARTHEST = 4.0
"""Vertices are moved by this times the precision at most."""


@dataclass(frozen=True, slots=True)
class Mended:
    """A crease pattern whose vertices were moved.

    Attributes
    ----------
    sheet : Sheet
    moved : float
        Largest displacement of a vertex, in units of the extent.
    precision : Precision
        Of the coordinates as they were.
    why : str
        What holds now and did not.
    """

    sheet: Sheet
    moved: float
    precision: Precision
    why: str

    def __str__(self) -> str:
        precise = f"coordinates precise to {self.precision.size:.1g}: {self.precision.source}"
        return f"vertices moved by up to {self.moved:.1g} of the extent so that {self.why} ({precise})"


def flattened(sheet: Sheet, precision: Precision) -> Mended | None:
    """Return a sheet that is meant to be flat with its vertices in one plane; None if it is not, or is there.

    Examples
    --------
    >>> places = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 1e-7), (0.0, 1.0, 0.0))
    >>> book = Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), places)
    >>> print(flattened(book, Precision(1e-7, "7 decimals")).why)
    they lie in one plane
    """
    if sheet.coordinates is None or len(sheet.coordinates[0]) < 3:
        return None
    points = np.asarray(sheet.coordinates, dtype=float)
    off = off_plane(points)
    if not EXACT / 1e3 < off <= FARTHEST * precision.size:
        return None
    plane = best_plane(points)
    flat = plane.middle + across(points - plane.middle, plane.direction)
    return Mended(with_vertices(sheet, flat), off, precision, "they lie in one plane")


def precision_with_pieces(places: VertexPlaces, precision: Precision) -> Precision:
    """Return how precise coordinates are: if by their digits they are exact, as creases of several pieces show."""
    if precision.size <= EXACT < places.bent:
        return Precision(places.bent, "creases of several pieces")
    return precision


def with_vertices(sheet: Sheet, corners: Floats) -> Sheet:
    """Return a sheet with its vertices at float[V, 3]."""
    assert sheet.coordinates is not None
    size = len(sheet.coordinates[0])
    return replace(sheet, coordinates=tuple(map(tuple, corners[:, :size].tolist())))
