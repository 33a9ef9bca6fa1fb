"""The library loop_sums.c: roots of loop sums; where there is none, numpy finds them in `synth.surfaces.loop_sums`."""

from ctypes import c_int64, c_void_p
from pathlib import Path

import numpy as np
import numpy.typing as npt

from graphs.compiled import library
from graphs.types import Floats, Ints

SOURCE = Path(__file__).with_name("loop_sums.c")
Columns = tuple[Ints, Ints, Ints, Floats, Floats, Ints, Ints]
"""Loop, pattern, turns, size, residual, and 1 where double, of each root; loop, pattern, 1 where exact of families."""
_ROOTS_OF_A_LOOP = 8
"""For so many roots there is room at first."""


def roots_in_library(reaches: Floats, patterns: npt.NDArray[np.int8], first_loop: int, base: int) -> Columns | None:
    """Return the roots and families of loops with reaches float[B, n]; None where there is no library."""
    found = library(SOURCE)
    if found is None:
        return None
    if found.all_roots.argtypes is None:
        found.all_roots.restype = None
        found.all_roots.argtypes = [*[c_int64] * 4, *[c_void_p] * 2, *[c_int64] * 2, *[c_void_p] * 8]
    loops, links = reaches.shape
    reaches, patterns = np.ascontiguousarray(reaches), np.ascontiguousarray(patterns)
    room = _ROOTS_OF_A_LOOP * loops + len(patterns)
    while True:
        columns = _columns(room)
        counts = np.zeros(2, dtype=np.int64)
        sizes = (loops, links, len(patterns), base)
        given = (reaches.ctypes.data, patterns.ctypes.data, first_loop, room)
        found.all_roots(*sizes, *given, *(column.ctypes.data for column in columns), counts.ctypes.data)
        roots, families = counts.tolist()
        if max(roots, families) <= room:
            *of_roots, family = columns
            return (*(column[:roots] for column in of_roots), family[:families])  # type: ignore[return-value]
        room = max(roots, families)


def _columns(room: int) -> Columns:
    loop, pattern, turns, double = (np.empty(room, dtype=np.int64) for _ in range(4))
    return loop, pattern, turns, np.empty(room), np.empty(room), double, np.empty((room, 3), dtype=np.int64)
