"""How precise coordinates are: what a file of them can tell apart.

A file says it in the digits that it writes, in numbers that fit in single precision, in points that ought to
coincide, and in points that ought to lie in one plane and nearly do. Theory: docs/theory/pose.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphs.arrays import Floats
from graphs.geometry import best_plane
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE, EPSILON

__all__ = [
    "Precision",
    "extent_of",
    "off_panel_planes",
    "off_plane",
    "precision_of",
    "precision_of_axes",
    "precision_of_sheet",
]

_MOST_DECIMALS = 12
_COARSEST = 3e-3
"""A last decimal that is worth more of the extent than this is no rounding: few sizes were chosen on purpose."""
_DIGITS = 3
"""Rounded numbers end in many digits; those of a grid of halves or quarters in few."""


@dataclass(frozen=True, slots=True)
class Precision:
    """The error that a coordinate may have, in units of the extent, and its source.

    Sources are the digits written, single precision, or points that ought to lie in a plane.
    """

    size: float
    source: str


def extent_of(points: Floats) -> float:
    """Return the largest distance of a coordinate from the middle of all: half the size, about.

    >>> extent_of(np.array([[0.0, 0.0], [4.0, 2.0]]))
    2.0
    """
    return float(np.abs(points - points.mean(axis=0)).max(initial=0.0)) if len(points) else 0.0


def precision_of(coordinates: Sequence[Sequence[float]]) -> Precision:
    """Return how precise coordinates are, in any unit of length, by the numbers alone.

    >>> precision_of([(0.0, 0.0), (1.0, 0.0), (0.5, 0.25)]).source
    'double precision'
    """
    points = np.asarray(coordinates, dtype=float)
    extent = extent_of(points)
    if extent == 0.0:
        return Precision(EPSILON, "double precision")
    largest = float(np.abs(points).max())
    decimals = _decimals(points, extent, largest)
    if decimals is not None:
        return Precision(0.5 * 10.0**-decimals / extent, f"{decimals} decimals")
    if _is_single(points):
        return Precision(float(np.finfo(np.float32).eps) / 2 * largest / extent, "single precision")
    return Precision(EPSILON * largest / extent, "double precision")


def _decimals(points: Floats, extent: float, largest: float) -> int | None:
    """Return to how many decimals numbers were rounded, or None where nothing says that they were."""
    numbers = np.unique(np.abs(points))
    slack = 4 * EPSILON * largest
    for decimals in range(_MOST_DECIMALS + 1):
        if np.abs(numbers - numbers.round(decimals)).max() > slack:
            continue
        last = np.rint(numbers * 10.0**decimals) % 10
        full = last[last > 0]
        many = len(full) >= max(_DIGITS, len(numbers) // 10) and len(np.unique(full)) >= _DIGITS
        return decimals if decimals and many and 10.0**-decimals <= _COARSEST * extent else None
    return None


def _is_single(points: Floats) -> bool:
    """Tell whether numbers fit in single precision and use it: sums of few powers of two are exact in any."""
    with np.errstate(over="ignore"):
        single = points.astype(np.float32)
    if not bool((single == points).all()):
        return False
    mantissas = np.frexp(points)[0] * 2.0**12
    return bool((mantissas != np.rint(mantissas)).any())


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
    """Return how precise the coordinates of a sheet are: by the numbers, and by panels that ought to be planar.

    Raises `ValueError` if the sheet has no coordinates.

    >>> places = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 1e-7), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    >>> precision_of_sheet(Sheet(5, (), "", ((0, 1, 2, 3), (0, 1, 4)), places)).source
    'panels off their planes'
    """
    if sheet.coordinates is None:
        raise ValueError("the sheet has no coordinates")
    points = np.asarray(sheet.coordinates, dtype=float)
    written = precision_of(sheet.coordinates)
    welded = Precision(sheet.spread / (extent_of(points) or 1.0), "ends that were welded")
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
