"""Rounded coordinates of a crease pattern moved, within their precision, to ones that fold.

Sheets of quadrilaterals fold because their geometry is special, and rounding takes that away: as it is written
such a pattern is rigid. Where rates would agree but for what the coordinates cannot tell, vertices are moved to
where they do. Theory: docs/theory/mending.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np

from graphs.arrays import Floats
from graphs.canonical import MARGIN
from graphs.geometry import across, best_plane
from graphs.mechanism.precision import Precision, off_plane, precision_of_sheet
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import Tolerances
from synth.folding.mending.angles import MeantAngles
from synth.folding.mending.fitting import Fitting
from synth.folding.mending.places import VertexPlaces
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage
from synth.motion.misfit import EXACT
from synth.motion.second_order import rate_spaces, rates_near
from synth.motion.singular.quadrics import quadrics_of

__all__ = [
    "Mended",
    "flattened",
    "mended",
    "nearly_agreeing",
    "precision_of",
]

_FARTHEST = 4.0
"""Vertices are moved by this times the precision at most."""

_TRIES = 4
"""So many motions are tried, those first that agree best with the marks."""


@dataclass(frozen=True, slots=True)
class Mended:
    """A crease pattern whose vertices were moved.

    Attributes
    ----------
    sheet : Sheet
    moved : float
        Largest change of a coordinate, in units of the extent.
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
        precise = f"precise to {self.precision.size:.1g} ({self.precision.source})"
        return f"vertices moved by up to {self.moved:.1g} of the extent, {precise}: {self.why}"


def flattened(sheet: Sheet) -> Mended | None:
    """Return a sheet that is meant to be flat with its vertices in one plane; None if it is not, or is there.

    Examples
    --------
    >>> places = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 1e-7), (0.0, 1.0, 0.0))
    >>> book = Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), places)
    >>> print(flattened(book).why)
    they lie in one plane
    """
    if sheet.coordinates is None or len(sheet.coordinates[0]) < 3:
        return None
    points, precision = np.asarray(sheet.coordinates, dtype=float), precision_of_sheet(sheet)
    off = off_plane(points)
    if not EXACT / 1e3 < off <= _FARTHEST * precision.size:
        return None
    plane = best_plane(points)
    flat = plane.middle + across(points - plane.middle, plane.direction)
    return Mended(_placed(sheet, flat), off, precision, "they lie in one plane")


def precision_of(places: VertexPlaces, sheet: Sheet) -> Precision:
    """Return how precise coordinates are: if by their digits they are exact, as creases of several pieces show."""
    precision = precision_of_sheet(sheet)
    if precision.size <= EXACT < places.bent:
        return Precision(places.bent, "creases of several pieces")
    return precision


def mended(
    sheet: Sheet,
    places: VertexPlaces,
    linkage: PosedLinkage,
    wanted: Floats,
    moves: Callable[[Sheet], bool],
    most: int | None,
) -> Mended | None:
    """Move the vertices of a sheet that ought to move, within their precision, so that it does.

    Parameters
    ----------
    sheet : Sheet
        With coordinates, closed at its pose.
    places : VertexPlaces
        Of the sheet.
    linkage : PosedLinkage
        Of the sheet too.
    wanted : float[J]
        Rates, or signs of them, that are to be a motion above others.
    moves : callable
        Tells whether a sheet does.
    most : int or None
        So many spaces of rates are tried; None for a linkage that is too large to split its rates into spaces.

    Returns
    -------
    Mended or None
        None if no rates nearly agree, or vertices had to be moved too far.
    """
    precision = precision_of(places, sheet)
    if precision.size <= EXACT:
        return None
    farthest = max(_FARTHEST * precision.size, places.bent)  # pieces of one crease were taken to be in line
    meant = MeantAngles(places, precision.size)
    for angles in (meant, MeantAngles(places, 0.0)) if len(meant) else (meant,):
        fitting = Fitting(places, angles, linkage.angles)
        if not fitting.at_the_pose() or fitting.moved > farthest:
            continue
        now = _placed(sheet, fitting.corners * linkage.extent + linkage.middle)
        if moves(now):
            why = "angles that nearly agree are equal" if len(angles) else "creases are straight and panels plane"
            return Mended(now, fitting.moved, precision, why)
        for rates in islice(nearly_agreeing(linkage, precision, wanted, most), _TRIES):
            if not fitting.along(rates, farthest):
                continue
            now = _placed(sheet, fitting.corners * linkage.extent + linkage.middle)
            if moves(now):
                return Mended(now, fitting.moved, precision, "loops close along a motion")
    return None


def nearly_agreeing(
    linkage: PosedLinkage, precision: Precision, wanted: Floats, most: int | None
) -> Iterator[Floats]:
    """Yield rates that agree but for what the coordinates cannot tell, those nearest to wanted ones first."""
    closure, quadrics = ClosureEquations(linkage), quadrics_of(linkage)
    zero = Tolerances.of(precision.size).zero
    if most is None:
        near = rates_near(closure, linkage.angles, quadrics, wanted, zero)
        if near is not None:
            yield near
        return
    spaces, _ = rate_spaces(closure, linkage.angles, quadrics, most, zero)
    found = []
    for space in spaces:
        rates = space.basis @ (space.basis.T @ wanted)
        if not rates.any():
            rates = space.basis.sum(axis=1)
        scaled = rates / np.abs(rates).max()
        found.append(np.where(np.abs(scaled) > MARGIN, scaled, 0.0))
    yield from sorted(found, key=lambda rates: -float(np.sign(rates) @ wanted))


def _placed(sheet: Sheet, corners: Floats) -> Sheet:
    """Return a sheet with its vertices at float[V, 3]."""
    assert sheet.coordinates is not None
    size = len(sheet.coordinates[0])
    return replace(sheet, coordinates=tuple(map(tuple, corners[:, :size].tolist())))
