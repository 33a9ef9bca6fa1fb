"""How precise coordinates are, and whether a sheet lies in one plane to that precision.

The precision is stated, or the digits say it (a program rounds all coordinates alike, to so many decimals,
significant digits, or to single precision), or points that nearly coincide or nearly lie in one plane; the
evidence of the whole geometry (`graphs.mechanism.estimate`) is weighed against that. Theory:
docs/theory/precision.md.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import floor, log, log10

import numpy as np

from graphs.errors import UnsolvableError
from graphs.geometry import across, best_plane, unit
from graphs.input_limits import LEAST, MOST
from graphs.mechanism.estimate import Estimate, estimate_of
from graphs.mechanism.sheet import Frames, Sheet, WrittenPrecision
from graphs.tolerances import DOUBLE, EPSILON, Tolerances
from graphs.types import Floats

_MOST_DECIMALS = 12
_COARSEST = 3e-3
"""A last decimal that is worth more of the extent than this is no rounding: few sizes were chosen on purpose."""
_KINDS = 3
"""Rounded numbers end in many digits; those of a grid of halves or quarters in few."""
_LEAST_SIGNIFICANT, _MOST_SIGNIFICANT = 5, 12
_HALF = 0.5
"""So many of the numbers have all significant digits, at least: zeros at the end are left out."""
_SINGLE = float(np.finfo(np.float32).eps)
_LARGEST = float(np.finfo(np.float32).max)
_UNLIKELY = log(1e6)
"""Numbers are nearly those of single precision by chance as rarely as this."""


@dataclass(frozen=True, slots=True)
class Digits:
    """What digits say: the error of a number, in its own unit, and how it was rounded."""

    error: float
    source: str


def spacing_of(numbers: Floats) -> float:
    """Return the spacing of double precision at the largest of some numbers."""
    return EPSILON * float(np.abs(numbers).max(initial=0.0))


def digits_of(written: Iterable[float] | Floats, extent: float) -> Digits | None:
    """Return how coordinates that reach so far to either side were rounded; None if nothing says so."""
    numbers = np.unique(np.abs(np.asarray(written, dtype=float).ravel()))
    numbers = numbers[numbers > 4.0 * spacing_of(numbers)]
    if not len(numbers) or extent <= 0.0 or not LEAST <= numbers[-1] <= MOST:
        return None
    single = _as_single(numbers, extent)
    if single is not None:
        return single
    fixed, significant = _decimals(numbers), _significant(numbers)
    share = 0.0 if fixed is None else _share(numbers * 10.0**fixed)
    if significant is not None and _all_significant(numbers, significant) > share:
        error = 0.5 * 10.0 ** (floor(log10(float(numbers[-1]))) - significant + 1)
        if 2.0 * error <= _COARSEST * extent:
            return Digits(error, f"{significant} significant digits")
    if fixed and 10.0**-fixed <= _COARSEST * extent and _are_used(numbers * 10.0**fixed):
        return Digits(0.5 * 10.0**-fixed, f"{fixed} decimals")
    return None


def _decimals(numbers: Floats) -> int | None:
    """Return how many decimals write numbers in full, None if none that rounding in double precision leaves."""
    slack = 4.0 * spacing_of(numbers)
    for decimals in range(_MOST_DECIMALS + 1):
        if 10.0**-decimals < 4.0 * slack:
            return None
        if float(np.abs(numbers - numbers.round(decimals)).max()) <= slack:
            return decimals
    return None


def _significant(numbers: Floats) -> int | None:
    """Return how many significant digits write numbers in full."""
    powers = np.floor(np.log10(numbers))
    for digits in range(_LEAST_SIGNIFICANT, _MOST_SIGNIFICANT + 1):
        unit = 10.0 ** (powers - digits + 1)
        if bool((np.abs(numbers / unit - np.rint(numbers / unit)) * unit <= 4.0 * EPSILON * numbers).all()):
            return digits
    return None


def _share(whole: Floats) -> float:
    """Return how many of some whole numbers do not end in zero, as part of all."""
    return float((np.rint(whole) % 10 > 0).mean())


def _all_significant(numbers: Floats, digits: int) -> float:
    """Return how many numbers use all significant digits, as part of all; 0 if too few do, or all end alike."""
    scaled = numbers / 10.0 ** (np.floor(np.log10(numbers)) - digits + 1)
    share = _share(scaled)
    return share if share >= _HALF and _are_used(scaled) else 0.0


def _are_used(whole: Floats) -> bool:
    """Return whether last digits are those of rounded numbers: many, and of many kinds."""
    last = np.rint(whole) % 10
    full = last[last > 0]
    return len(full) >= max(_KINDS, len(whole) // 10) and len(np.unique(full)) >= _KINDS


def _as_single(numbers: Floats, extent: float) -> Digits | None:
    """Return that numbers are of single precision, written in full or to nine digits or so, if they are.

    Text of a number of single precision is the nearest of its length, so that it is off by half of its own last
    digit at most; any other number would be by chance.
    """
    error = _SINGLE / 2.0 * float(numbers[-1])
    if numbers[-1] >= _LARGEST or 2.0 * error > _COARSEST * extent:
        return None
    single = numbers.astype(np.float32)
    off, unit = np.abs(numbers - single.astype(float)), _last_digits(numbers)
    if bool((off > 0.5 * unit + 4.0 * EPSILON * numbers).any()):
        return None
    mantissas = np.frexp(numbers)[0] * 2.0**12  # sums of few powers of two are exact in any precision
    by_chance = np.minimum(1.0, unit / np.spacing(single).astype(float))
    unlikely = -float(np.log(by_chance[mantissas != np.rint(mantissas)]).sum())
    return Digits(error, "single precision") if unlikely > _UNLIKELY else None


def _last_digits(numbers: Floats) -> Floats:
    """Return what the last digit of each number is worth, as it is written."""
    unit = EPSILON * numbers
    powers = np.floor(np.log10(numbers))
    slack = 4.0 * EPSILON * numbers
    for digits in range(_MOST_SIGNIFICANT, 0, -1):
        for last in (10.0 ** (powers - digits + 1), np.full(len(numbers), 10.0**-digits)):
            fits = np.abs(numbers - np.rint(numbers / last) * last) <= slack
            unit = np.where(fits, np.maximum(unit, last), unit)
    return unit


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

    ``size`` is in units of the extent, ``source`` says how it is known: ``stated``, ``2 decimals``, ``single
    precision``, ``estimated``, ... ``evidence`` is the evidence of the geometry, None where that was not examined.
    ``margin`` of an estimate is how many times the largest deviation of what was meant the next larger one is.
    """

    size: float
    source: str
    evidence: str | None = None
    margin: float | None = None

    def __str__(self) -> str:
        evidence = f": {self.evidence}" if self.source == ESTIMATED else ""
        return f"{self.size:.0e} of the extent ({self.source}{evidence})"

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
    """
    if not len(points):
        return 0.0
    extent = float(np.abs(points - points.mean(axis=0)).max(initial=0.0))
    return extent if extent > _ROUNDING * EPSILON * float(np.abs(points).max(initial=0.0)) else 0.0


def precision_of(coordinates: Sequence[Sequence[float]]) -> Precision:
    """Return how precise coordinates are, in any unit of length, by the numbers alone."""
    points = np.asarray(coordinates, dtype=float)
    extent = extent_of(points)
    if extent == 0.0:
        return Precision(DOUBLE.precision, "double precision")
    digits, least = digits_of(points, extent), spacing_of(points)
    if digits is None or digits.error <= least:
        return Precision(least / extent, "double precision")
    return Precision(digits.error / extent, digits.source)


def written_by(ends: Floats) -> WrittenPrecision | None:
    """Return how precise points, float[..., 2 or 3], are as they are written; None if nothing says so."""
    points = np.asarray(ends, dtype=float)
    points = points.reshape(-1, points.shape[-1])
    digits = digits_of(points, extent_of(points))
    return None if digits is None else WrittenPrecision(digits.error, digits.source)


def stated(sheet: Sheet, length: float | None) -> Sheet:
    """Return a sheet whose coordinates are stated to be wrong by no more than a length, in their unit.

    Without a length it is the sheet itself. Raises `InvariantError` if the length is no length.
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
    """Return how precise axes are: the coarser of their points, in any unit of length, and their directions."""
    return max(precision_of(points.tolist()), precision_of(directions.tolist()), key=lambda precision: precision.size)


def precision_of_sheet(sheet: Sheet) -> Precision:
    """Return how precise the coordinates of a sheet are: as stated, else as written, or coarser by the geometry.

    It is found once and kept. Raises `ValueError` if the sheet has no coordinates.
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

    The type of a sheet depends on it; nothing is estimated. Raises `ValueError` if the sheet has no coordinates.
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
    """Return how far points are off one plane at most, in units of their extent."""
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


_WHOLE = 1e15
"""Numbers as large have no decimals to be rounded."""
_PLANES = ("yz", "xz", "xy")


@dataclass(frozen=True)
class Flattened:
    """A sheet in the plane, float[n, 2]: distances and the side that is seen are kept.

    `turned` says what was done to bring the vertices there; it is empty where they lay in a plane z = constant.
    """

    places: Floats
    turned: str


def in_space(coordinates: Sequence[Sequence[float]]) -> Floats:
    """Return points in space, float[n, 3]: z is 0 where the coordinates, in any unit of length, have none."""
    points = np.zeros((len(coordinates), 3))
    if len(coordinates):
        points[:, : len(coordinates[0])] = coordinates
    return points


def lies_flat(sheet: Sheet) -> bool:
    """Return whether a sheet lies in one plane, as far as its coordinates are precise."""
    return flattened(sheet) is not None


def flattened(sheet: Sheet) -> Flattened | None:
    """Return a sheet as it is seen in its plane; None if it does not lie in one, or has no coordinates.

    It is seen from the side on which most faces turn counter-clockwise. A sheet without faces, or in a plane z =
    constant, is seen against the positive axis.
    """
    if sheet.coordinates is None:
        return None
    places = np.asarray(sheet.coordinates, dtype=float)
    if places.size == 0 or places.shape[1] < 3 or len(set(places[:, 2].tolist())) == 1:
        return Flattened(places.reshape(len(places), -1)[:, :2], "")
    size = float(np.abs(places).max())
    scaled = places / size  # products of coordinates stay finite
    normal = _normal_of_sheet(sheet, places, scaled)
    if normal is None:
        return None
    upright = abs(normal) == 1
    if upright[2]:
        return Flattened(places[:, :2], "flattened: points were a little off the xy plane")
    if (facing := float(_area_vector(scaled, sheet.faces) @ normal)) != 0:
        normal = normal * np.sign(facing)
    along = unit(across(np.eye(3)[1 if abs(normal[0]) > 0.9 else 0], normal))
    seen: Floats = places @ np.column_stack([along, np.cross(normal, along)])
    came_from = f"the {_PLANES[int(upright.argmax())]} plane" if upright.any() else "a slanted plane"
    return Flattened(seen + 0.0, f"turned from {came_from} into the xy plane")


def flat_places(sheet: Sheet, what: str) -> list[tuple[float, float]]:
    """Return the coordinates of a sheet as they are seen in its plane, for a format that is flat.

    Raises `UnsolvableError` if the sheet has none, or does not lie in a plane.
    """
    if sheet.coordinates is None:
        raise UnsolvableError(f"{what} needs coordinates, and the sheet has none")
    flat = flattened(sheet)
    if flat is None:
        raise UnsolvableError(f"{what} is planar, and the sheet is not")
    return [(x, y) for x, y in flat.places.tolist()]


def _normal_of_sheet(sheet: Sheet, places: Floats, scaled: Floats) -> Floats | None:
    """Return the normal of the plane that a sheet lies in, None if in none; precision matters off an axis only."""
    still = np.flatnonzero(places.min(axis=0) == places.max(axis=0))
    if len(still):
        upright: Floats = np.eye(3)[still[-1]]
        return upright
    has_decimals = np.abs(places).max() <= _WHOLE
    tolerance = Tolerances.of(precision_as_written(sheet).size).flat if has_decimals else DOUBLE.flat
    return None if off_plane(scaled) > tolerance else _normal(scaled, tolerance)


def _normal(places: Floats, tolerance: float) -> Floats:
    """Return the unit normal whose largest component is positive; an axis where the plane stands on one."""
    for axis in (2, 1, 0):
        if np.ptp(places[:, axis]) <= tolerance * extent_of(places):
            upright: Floats = np.eye(3)[axis]
            return upright
    return best_plane(places).direction


def _area_vector(places: Floats, faces: Sequence[Sequence[int]]) -> Floats:
    """Return the sum of the areas of faces, as vectors."""
    starts = np.array([vertex for face in faces for vertex in face], dtype=np.int64)
    ends = np.array([vertex for face in faces for vertex in (*face[1:], face[0])], dtype=np.int64)
    middle = places.mean(axis=0)
    total: Floats = np.cross(places[starts] - middle, places[ends] - middle).sum(axis=0)
    return total
