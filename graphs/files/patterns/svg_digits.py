"""How precise the coordinates of an SVG drawing are as they are written: digits, units, transforms."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from math import hypot, sqrt
from typing import Any, NamedTuple

import numpy as np

from graphs.mechanism.precision import digits_of
from graphs.mechanism.sheet import WrittenPrecision

__all__ = ["precision_of_shapes"]

_WRITTEN = {
    "path": ("d",),
    "line": ("x1", "y1", "x2", "y2"),
    "polyline": ("points",),
    "polygon": ("points",),
    "rect": ("x", "y", "width", "height"),
    "circle": ("cx", "cy", "r"),
    "ellipse": ("cx", "cy", "rx", "ry"),
}
"""The attributes with coordinates, by element."""
_UNITS = {"px": 1.0, "pt": 4 / 3, "pc": 16.0, "mm": 96 / 25.4, "cm": 96 / 2.54, "in": 96.0}
_NUMBER = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)(px|pt|pc|mm|cm|in)?")
_COMMAND = re.compile(r"([MLHVCSQTAZmlhvcsqtaz])([^MLHVCSQTAZmlhvcsqtaz]*)")
_TO_A_STEP = {"h": 1, "v": 1, "c": 6, "s": 4, "q": 4, "a": 7}
"""Numbers of each step of a relative command; of the others two."""
_FUNCTION = re.compile(r"([a-zA-Z]+)\s*\(([^)]*)\)")
_SHIFT = slice(4, None)
_ROUNDED = 4
"""Entries of a matrix with fewer decimals are taken to be exact."""


class _Shape(NamedTuple):
    """The numbers of a shape, by the factor of their unit; how many errors add up; its transform."""

    numbers: dict[float, list[float]]
    steps: int
    transform: str
    reach: float


class _Digit(NamedTuple):
    """Half of what the last decimal of the file's matrices, and of its shifts, is worth."""

    of_matrices: float
    of_shifts: float


def precision_of_shapes(shapes: Iterable[Any]) -> WrittenPrecision | None:
    """Return how precise shapes of svgelements are as they are written, None if nothing says that.

    The length is in the unit that they are drawn in, after units and transforms.
    """
    read = [_read(shape) for shape in shapes]
    of_unit: defaultdict[float, list[float]] = defaultdict(list)
    for one in read:
        for unit, numbers in one.numbers.items():
            of_unit[unit] += numbers
    digits = {unit: digits_of(numbers, float(np.ptp(numbers)) / 2.0) for unit, numbers in of_unit.items()}
    transforms = {one.transform for one in read}
    digit = _Digit(_last_decimal(transforms, "matrix", slice(4), _ROUNDED), _last_shift(transforms))
    worst, source = 0.0, ""
    for one in read:
        scale = _stretch(one.transform)
        own = [(found.error * unit, found.source) for unit in one.numbers if (found := digits[unit]) is not None]
        length, why = max(own, default=(0.0, ""))
        turned = _error_of_transform(one.transform, one.reach, digit)
        error = length * sqrt(one.steps) * scale + turned
        if error > worst:
            worst, source = error, why or "digits of a transform"
    return WrittenPrecision(worst, source) if worst > 0.0 else None


def _read(shape: Any) -> _Shape:
    values = shape.values
    words = [str(values.get(name) or "") for name in _WRITTEN.get(str(values.get("tag")), ())]
    numbers: defaultdict[float, list[float]] = defaultdict(list)
    reach = 0.0
    for word in words:
        for number, unit in _NUMBER.findall(word):
            factor = _UNITS.get(unit, 1.0)
            numbers[factor].append(float(number))
            reach = max(reach, abs(float(number)) * factor)
    around = str(values.get("viewport_transform") or "")
    transform = str(values.get("transform") or "").removeprefix(around)
    steps = _steps(words[0]) if values.get("tag") == "path" and words else 1
    return _Shape(dict(numbers), steps, transform if _same(around) else f"{_scaled(around)} {transform}", reach)


def _same(around: str) -> bool:
    """Tell whether the view box changes no size: where it is does not matter, since all shapes are moved alike."""
    return "scale" not in around and "matrix" not in around


def _scaled(around: str) -> str:
    """Return the size that a view box is drawn in; its digits are not written, but those of a division."""
    return f"scale({_stretch(around):.3g})"


def _steps(path: str) -> int:
    """Return how many numbers in turn are relative to the last, at most, and so add up their errors."""
    most = steps = 0
    for letter, told in _COMMAND.findall(path):
        if letter in "Zz":
            continue
        many = len(_NUMBER.findall(told))
        steps = steps + many // _TO_A_STEP.get(letter, 2) if letter.islower() else 1
        most = max(most, steps)
    return max(most, 1)


def _functions(transform: str) -> Iterator[tuple[str, list[str], str]]:
    """Yield the functions of a transform, the texts of their numbers, and what is written before each."""
    for found in _FUNCTION.finditer(transform):
        yield found[1].lower(), [number for number, _ in _NUMBER.findall(found[2])], transform[: found.start()]


def _error_of_transform(transform: str, reach: float, digit: _Digit) -> float:
    """Return how far off a shape is drawn for the digits of its transform."""
    error = 0.0
    for name, numbers, before in _functions(transform):
        if name == "matrix" and len(numbers) == 6:
            error += _stretch(before) * (digit.of_matrices * reach + digit.of_shifts)
        elif name == "translate":
            error += _stretch(before) * digit.of_shifts
    return error


def _last_shift(transforms: set[str]) -> float:
    """Return half of what the last decimal of shifts is worth; 0 where all shapes are shifted alike."""
    if len(transforms) < 2:
        return 0.0
    shifts = (
        _last_decimal(transforms, name, part, 1) for name, part in (("matrix", _SHIFT), ("translate", slice(2)))
    )
    return min((one for one in shifts if one), default=0.0)


def _last_decimal(transforms: set[str], function: str, part: slice, least: int) -> float:
    """Return half of what the last decimal of a function is worth; 0 of fewer decimals than the least."""
    numbers = [
        number
        for one in transforms
        for name, told, _ in _functions(one)
        if name == function
        for number in told[part]
    ]
    decimals = max((len(one.partition(".")[2]) for one in numbers if "e" not in one.lower()), default=0)
    return 0.5 * 10.0**-decimals if decimals >= least else 0.0


def _stretch(transform: str) -> float:
    """Return how much longer a transform makes a length, at most."""
    import svgelements

    matrix = svgelements.Matrix(transform)
    a, b, c, d = (float(x) for x in (matrix.a, matrix.b, matrix.c, matrix.d))
    # The larger singular value: half the sums of lengths of what turns and what mirrors.
    return (hypot(a + d, b - c) + hypot(a - d, b + c)) / 2.0
