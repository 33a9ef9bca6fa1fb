"""How precise coordinates are: what a file of them can tell apart.

It is stated, or the digits say it, or points that ought to coincide, or to lie in one plane, and nearly do; and
what the whole geometry shows is weighed against that. Theory: docs/theory/precision.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from graphs.arrays import Floats
from graphs.geometry import best_plane
from graphs.mechanism.evidence.digits import digits_of, spacing_of
from graphs.mechanism.evidence.estimate import Estimate, estimate_of
from graphs.mechanism.reading import WrittenPrecision
from graphs.mechanism.sheet import Frames, Sheet
from graphs.tolerances import DOUBLE, EPSILON

__all__ = [
    "BY_DIGITS",
    "ESTIMATED",
    "Precision",
    "extent_of",
    "keeping",
    "off_panel_planes",
    "off_plane",
    "precision_as_written",
    "precision_of",
    "precision_of_axes",
    "precision_of_sheet",
    "stated",
    "written_by",
]

_ROUNDING = 8.0
"""Rounding units by which points that are one may differ."""
BY_DIGITS = "the digits alone: the geometry shows nothing of it"
"""The evidence where nothing can be estimated."""
ESTIMATED = "estimated"
"""The source where the geometry shows a coarser precision than the digits."""
_COARSER = 3.0
"""An estimate within this factor of what the digits say says the same."""
_KEPT = "_precision"
"""Where a sheet keeps its precision once that is found: it is frozen, so it has one."""


@dataclass(frozen=True, slots=True)
class Precision:
    """The error that a coordinate may have.

    Attributes
    ----------
    size : float
        In units of the extent.
    source : str
        How it is known: ``stated``, ``2 decimals``, ``single precision``, ``estimated``, ...
    evidence : str or None
        What the geometry says of it; None where it was not asked.
    margin : float or None
        Of an estimate: how many times the largest deviation of what was meant the next larger one is.

    Examples
    --------
    >>> print(Precision(3e-6, "2 decimals"))
    3e-06 of the extent (2 decimals)
    """

    size: float
    source: str
    evidence: str | None = None
    margin: float | None = None

    def __str__(self) -> str:
        told = f": {self.evidence}" if self.source == ESTIMATED else ""
        return f"{self.size:.0e} of the extent ({self.source}{told})"

    def to_json(self) -> dict[str, float | str | None]:
        """Return the keys of the key ``configuration`` (docs/command-json.md)."""
        return {
            "precision": self.size,
            "precision_source": self.source,
            "precision_evidence": self.evidence,
            "precision_margin": self.margin,
        }


def extent_of(points: Floats) -> float:
    """Return the largest distance of a coordinate from the middle of all: half the size, about.

    Points that differ by rounding only, as those of axes through one point, have none.

    >>> extent_of(np.array([[0.0, 0.0], [4.0, 2.0]])), extent_of(np.array([[0.1, 0.3], [0.1, 0.3 + 1e-16]]))
    (2.0, 0.0)
    """
    if not len(points):
        return 0.0
    extent = float(np.abs(points - points.mean(axis=0)).max(initial=0.0))
    return extent if extent > _ROUNDING * EPSILON * float(np.abs(points).max(initial=0.0)) else 0.0


def precision_of(coordinates: Sequence[Sequence[float]]) -> Precision:
    """Return how precise coordinates are, in any unit of length, by the numbers alone.

    >>> precision_of([(0.0, 0.0), (1.0, 0.0), (0.5, 0.25)]).source
    'double precision'
    """
    points = np.asarray(coordinates, dtype=float)
    extent = extent_of(points)
    if extent == 0.0:
        return Precision(DOUBLE.precision, "double precision")
    digits, least = digits_of(points, extent), spacing_of(points)
    if digits is None or digits.error <= least:
        return Precision(least / extent, "double precision")
    return Precision(digits.error / extent, digits.source)


def written_by(ends: Floats) -> WrittenPrecision | None:
    """Return how precise points, float[..., 2 or 3], are as they are written; None if nothing says so.

    >>> written_by(np.array([[0.12, 3.41], [7.33, 2.05], [9.99, 0.5]]))
    WrittenPrecision(length=0.005, source='2 decimals', stated=False)
    """
    points = np.asarray(ends, dtype=float)
    points = points.reshape(-1, points.shape[-1])
    digits = digits_of(points, extent_of(points))
    return None if digits is None else WrittenPrecision(digits.error, digits.source)


def stated(sheet: Sheet, length: float | None) -> Sheet:
    """Return a sheet whose coordinates are stated to be wrong by no more than a length, in their unit.

    Without a length it is the sheet as it is. Raises `InvariantError` if the length is no length.

    >>> triangle = Sheet(3, (), "", ((0, 1, 2),), ((0.0, 0.0), (2.0, 0.0), (1.0, 1.5)))
    >>> precision_of_sheet(stated(triangle, 0.01)).source
    'stated'
    """
    if length is None:
        return sheet
    frames = None if sheet.frames is None else _StatedFrames(sheet.frames, length)
    return replace(sheet, precision=WrittenPrecision(length, "stated", stated=True), frames=frames)


@dataclass(frozen=True, slots=True)
class _StatedFrames:
    """The frames of a file, each with the precision that is stated of all."""

    frames: Frames
    length: float

    @property
    def others(self) -> int:
        """How many there are besides the key frame."""
        return self.frames.others

    @property
    def unit(self) -> str | None:
        """The name that the file gives its unit of length."""
        return self.frames.unit

    @property
    def left_out(self) -> tuple[str, ...]:
        """What else the file says of the sheet."""
        return self.frames.left_out

    def frame(self, number: int) -> Sheet:
        """Return the sheet of one frame."""
        return stated(self.frames.frame(number), self.length)

    def first_placed(self) -> Sheet:
        """Return the first sheet that has coordinates."""
        return stated(self.frames.first_placed(), self.length)


def keeping(sheet: Sheet, precision: Precision) -> Sheet:
    """Return a sheet that was made of another with the precision of that: it is not estimated anew."""
    made = replace(sheet)
    vars(made)[_KEPT] = precision
    return made


def precision_of_axes(points: Floats, directions: Floats) -> Precision:
    """Return how precise axes are: the coarser of their points, in any unit of length, and their directions.

    >>> ups = np.tile([0.0, 0.0, 1.0], (9, 1))
    >>> precision_of_axes(np.random.default_rng(0).random((9, 3)).round(5), ups).source
    '5 decimals'
    """
    return max(
        precision_of(points.tolist()), precision_of(directions.tolist()), key=lambda precision: precision.size
    )


def precision_of_sheet(sheet: Sheet) -> Precision:
    """Return how precise the coordinates of a sheet are: as stated, else as written, or coarser by the geometry.

    It is found once and kept. Raises `ValueError` if the sheet has no coordinates.

    >>> places = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 1e-7), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    >>> precision_of_sheet(Sheet(5, (), "", ((0, 1, 2, 3), (0, 1, 4)), places)).source
    'panels off their planes'
    """
    kept = vars(sheet).get(_KEPT)
    if isinstance(kept, Precision):
        return kept
    found = precision_as_written(sheet)
    if sheet.precision is None or not sheet.precision.stated:
        found = _weighed(found, estimate_of(sheet))
    vars(sheet)[_KEPT] = found
    return found


def _weighed(written: Precision, estimate: Estimate | None) -> Precision:
    """Return what is written, or if that is clearly coarser, what the geometry shows."""
    if estimate is None:
        return replace(written, evidence=BY_DIGITS)
    if estimate.size > max(_COARSER * written.size, DOUBLE.closed):
        return Precision(estimate.size, ESTIMATED, str(estimate), estimate.margin)
    return replace(written, evidence=str(estimate), margin=estimate.margin)


def precision_as_written(sheet: Sheet) -> Precision:
    """Return how precise the coordinates of a sheet are as stated, else by numbers, welded ends and planar panels.

    What the type of a sheet hangs on; nothing is estimated. Raises `ValueError` if the sheet has no coordinates.

    >>> precision_as_written(Sheet(3, (), "", ((0, 1, 2),), ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)))).source
    'double precision'
    """
    if sheet.coordinates is None:
        raise ValueError("the sheet has no coordinates")
    points = np.asarray(sheet.coordinates, dtype=float)
    extent = extent_of(points) or 1.0
    least = spacing_of(points) / extent
    if sheet.precision is not None and sheet.precision.stated:
        return Precision(max(sheet.precision.length / extent, least), sheet.precision.source)
    if sheet.precision is None:
        written = precision_of(sheet.coordinates)
    else:
        written = Precision(max(sheet.precision.length / extent, least), sheet.precision.source)
    welded = Precision(sheet.spread / extent, "ends that were welded")
    seen = [
        Precision(off_panel_planes(sheet), "panels off their planes"),
        Precision(off_plane(points), "vertices off one plane"),
    ]
    meant = [one for one in seen if one.size <= DOUBLE.flat]
    return max([written, welded, *meant], key=lambda precision: precision.size)


def off_plane(points: Floats) -> float:
    """Return how far points are off one plane at most, in units of their extent.

    >>> off_plane(np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]))
    0.0
    """
    extent = extent_of(points)
    if extent == 0.0 or len(points) < 4 or points.shape[1] < 3:
        return 0.0
    return float(best_plane(points).off) / extent


def off_panel_planes(sheet: Sheet) -> float:
    """Return how far vertices are off the planes of their panels at most, in units of the sheet's extent.

    The plane of a panel is the best one through its vertices.
    """
    if sheet.coordinates is None or not sheet.coordinates or len(sheet.coordinates[0]) < 3:
        return 0.0
    points = np.asarray(sheet.coordinates, dtype=float)
    extent = extent_of(points)
    by_size: dict[int, list[tuple[int, ...]]] = {}
    for face in sheet.faces:
        if len(face) > 3:
            by_size.setdefault(len(face), []).append(face)
    farthest = [float(best_plane(points[np.array(faces)]).off.max()) for faces in by_size.values()]
    return max(farthest, default=0.0) / extent if extent else 0.0
