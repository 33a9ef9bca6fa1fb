"""What a file may ask for: how far coordinates reach, and how much work it calls for.

Coordinates beyond 1e50 would overflow in the sixth powers that ranks, areas and normals are made of, so they are
refused when an object is built. A file of a few bytes can call for hours of work, which is refused with the name
of its limit; ``SYNTHEDRA_MOST`` in the environment raises (or lowers) limits, as in ``crossings=1000000``, with
commas between several. The table is in docs/files.md.
"""

import os
import re
from collections.abc import Iterable, Sequence
from itertools import chain
from math import hypot

from graphs.errors import FileError, InvariantError
from graphs.printing import shown

__all__ = [
    "LEAST",
    "LIMITS",
    "MOST",
    "VARIABLE",
    "check_area",
    "check_extent",
    "check_work",
    "how_to_raise",
    "in_reach",
    "most",
]

MOST = 1e50
"""No coordinate is larger: products of six, as of squared volumes, stay below the largest double, 1.8e308."""
LEAST = 1e-50
"""No extent is smaller, the larger of the differences along the axes: squares and cubes of it do not vanish."""
_RANGE = f"an extent of {LEAST:g} to {MOST:g}"
_THIN = 1e-12
"""Points in one line lie this close to it, in units of their extent: rounding puts them farther off by nothing."""


def in_reach(numbers: Iterable[float]) -> bool:
    """Return whether numbers are finite and within the range of coordinates."""
    return all(abs(number) <= MOST for number in numbers)


def check_extent(points: Sequence[Sequence[float]]) -> float:
    """Return the extent of points; refuse coordinates that reach too far or are too close together.

    Points have two or three coordinates; a single place has no extent. The `InvariantError` has the range.
    """
    if len(points) > _MANY:
        import numpy as np  # slow to load

        array = np.array(points, dtype=float)
        if np.abs(array).max() <= MOST and (extent := float(np.ptp(array, axis=0).max())) >= LEAST:
            return extent
    if not in_reach(chain.from_iterable(points)):
        farthest = next(x for x in chain.from_iterable(points) if not in_reach((x,)))
        raise InvariantError("extent", f"a coordinate is {farthest:g}", _RANGE)
    extent = max((max(axis) - min(axis) for axis in zip(*points, strict=True)), default=0.0)
    if 0.0 < extent < LEAST:
        raise InvariantError("extent", f"the extent is {extent:g}", _RANGE)
    return extent


_MANY = 1000  # points up to which a loop is as quick as making an array of them, and reports the first that is wrong


def _has_area(points: Sequence[Sequence[float]]) -> bool:
    """Return whether points are clearly in no line, by twice the tolerance."""
    import numpy as np  # slow to load

    offsets = np.array(points, dtype=float)
    offsets -= offsets[0]
    sizes = np.hypot.reduce(offsets, axis=1)
    length = float(sizes.max())
    if length == 0.0:
        return False
    unit = offsets[int(sizes.argmax())] / length
    beside = offsets - np.outer(offsets @ unit, unit)
    return bool(np.abs(beside).max() > 2.0 * _THIN * length)


def check_area(points: Sequence[Sequence[float]]) -> None:
    """Refuse points that all lie in one line, with `InvariantError`; `check_extent` has accepted them."""
    if not points or (len(points) > _MANY and _has_area(points)):
        return
    first = points[0]
    offsets = [tuple(x - y for x, y in zip(point, first, strict=True)) for point in points]
    along = max(offsets, key=lambda offset: hypot(*offset))
    length = hypot(*along)
    if length == 0.0:
        raise InvariantError("area", "the pattern has no area: all its vertices lie in one place")
    unit = [x / length for x in along]
    for offset in offsets:
        reach = sum(x * y for x, y in zip(offset, unit, strict=True))
        if hypot(*(x - reach * y for x, y in zip(offset, unit, strict=True))) > _THIN * length:
            return
    raise InvariantError("area", "the pattern has no area: all its vertices lie in one line")


VARIABLE = "SYNTHEDRA_MOST"
LIMITS = {
    "megabytes": 100,
    "nodes": 250_000,
    "basis": 250,
    "crossings": 10_000,
    "meetings": 1_000_000,
    "shapes": 30_000,
    "levels": 250,
    "letters": 10_000,
    "pairs": 10_000_000,
    "choices": 100_000,
}
"""Name to the most that is allowed:

- ``megabytes``: of a file;
- ``nodes``: links or vertices that a bare number calls for;
- ``basis``: joints of a part that is not planar, of a bare graph, which needs a shortest cycle basis;
- ``crossings``: points where lines of a pattern cross;
- ``meetings``: pairs of lines that meet, and of ends that are near each other;
- ``shapes``: elements of an SVG file that ``use`` draws beyond those that are written there;
- ``levels``: groups in groups of an SVG file, what ``use`` draws among them;
- ``letters``: of a transform or a style sheet of an SVG file;
- ``pairs``: of panels over the cells of a folded image, some 200 bytes each;
- ``choices``: of creases that stay flat in a folded image.
"""


def most(name: str) -> int:
    """Return a limit by its key in `LIMITS`; raises `FileError` if ``SYNTHEDRA_MOST`` cannot be understood."""
    found = dict(LIMITS)
    for part in filter(None, os.environ.get(VARIABLE, "").split(",")):
        match = re.fullmatch(r" *(\w+) *= *(\d{1,15}) *", part, re.ASCII)
        if match is None or match[1] not in LIMITS:
            raise FileError(VARIABLE, "", shown(part), f"NAME=NUMBER, the name one of {' '.join(LIMITS)}")
        found[match[1]] = int(match[2])
    return found[name]


def how_to_raise(name: str, needed: int | None = None) -> str:
    """Return a limit and how to raise it, for an error message: to what is needed, at least to twice the limit."""
    limit = most(name)
    return f"at most {limit} ({VARIABLE}={name}={max(needed or 0, 2 * limit)} allows more)"


def check_work(name: str, needed: int, what: str) -> None:
    """Refuse more work than a limit allows, with `InvariantError`, which a reader of files makes a `FileError`.

    ``name`` is a key of `LIMITS`, ``what`` the plural noun of what is counted.
    """
    if needed > most(name):
        raise InvariantError("limit", f"{needed} {what}", how_to_raise(name, needed))
