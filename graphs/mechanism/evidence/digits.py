"""How precise numbers are by the digits that they are written with.

A program rounds all coordinates alike: to so many decimals, to so many significant digits, or to single precision.
Which it was is seen by the numbers themselves, whose shortest text is what was written, but for zeros at its end.
Theory: docs/theory/precision.md.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import floor, log, log10

import numpy as np

from graphs.arrays import Floats
from graphs.extent import LEAST, MOST
from graphs.tolerances import EPSILON

__all__ = ["Digits", "digits_of", "spacing_of"]

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
    """Return what double precision tells apart at the largest of some numbers.

    >>> spacing_of(np.array([0.5, -1.0])) == EPSILON
    True
    """
    return EPSILON * float(np.abs(numbers).max(initial=0.0))


def digits_of(written: Iterable[float] | Floats, extent: float) -> Digits | None:
    """Return how numbers were rounded, coordinates that reach so far to either side; None if nothing says so.

    >>> digits_of([0.123, 4.561, 7.042, 9.339], 10.0)
    Digits(error=0.0005, source='3 decimals')
    >>> digits_of([0.5, 0.25, 0.75], 1.0) is None
    True
    """
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
    """Tell whether last digits are those of rounded numbers: many, and of many kinds."""
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
