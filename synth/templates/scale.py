"""Millimetres for a unit of coordinates."""

from __future__ import annotations

from math import isfinite

import numpy as np

from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.mechanism.sheet import Sheet
from graphs.types import Floats

__all__ = ["GREATEST", "millimetres", "scale_of", "unit_of"]

_UNITS = {"mm": 1.0, "cm": 10.0, "m": 1e3, "um": 1e-3, "nm": 1e-6, "in": 25.4, "pt": 25.4 / 72}
"""Units that FOLD names, in millimetres; its ``unit`` is none of a length."""

_LEAST = 10.0
"""Millimetres: what is smaller than this cannot be folded, its unit was no millimetre."""
GREATEST = 1e6
"""Millimetres: what is larger than a kilometre is not cut out; its curves would be millions of lines."""


def unit_of(sheet: Sheet) -> float | None:
    """Return the millimetres of the unit that the file of a sheet names; None if it names none.

    Raise UnsolvableError if FOLD does not know the unit.
    """
    name = None if sheet.frames is None else sheet.frames.unit
    if name is None or name == "unit":
        return None
    if name not in _UNITS:
        known = ", ".join(_UNITS)
        raise UnsolvableError(f"the file's unit {shown(name)} is none of {known}: expected --scale or --size")
    return _UNITS[name]


def scale_of(sheet: Sheet, scale: float | None, size: float | None) -> float | None:
    """Return the scale that is asked for, or else that of the unit that the file of a sheet names."""
    return unit_of(sheet) if scale is None and size is None else scale


def millimetres(places: Floats, scale: float | None = None, size: float | None = None) -> float:
    """Return millimetres per unit of places float[vertices, 2 or 3]: the scale (1 by default), or that of a size.

    `size` is the longest side of the box round the places, in millimetres. Raise InvariantError if scale or size
    is not positive, or both are given; UnsolvableError if the box would be smaller than 10 mm, which nobody could
    fold, or larger than 1e6 mm.

    >>> millimetres(np.array([[0, 0], [2, 1.0]]), size=100)
    50.0
    """
    if scale is not None and size is not None:
        raise InvariantError("scale", "a scale and a size", "one of them")
    for name, value in (("scale", scale), ("size", size)):
        if value is not None and not (isfinite(value) and value > 0):
            raise InvariantError(name, f"{name} {value!r}", "a positive number")
    extent = np.ptp(places, axis=0)
    longest = float(extent.max())
    factor = size / longest if size is not None and longest > 0 else 1.0 if scale is None else scale
    if not _LEAST <= longest * factor <= GREATEST:
        found = " x ".join(f"{side:.3g}" for side in (extent * factor).tolist())
        way = "larger" if longest * factor < _LEAST else "smaller"
        raise UnsolvableError(f"the thing would be {found} mm: expected a {way} scale or a size (--scale, --size)")
    return factor
