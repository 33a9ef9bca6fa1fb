"""The library kernel.c: the cost of drawings of a pattern, with its derivatives.

What is here `synth.realisation.drawing` does with numpy too, where there is no library.
"""

import ctypes
from ctypes import c_int, c_void_p
from dataclasses import astuple, dataclass
from pathlib import Path
from weakref import finalize

import numpy as np
import numpy.typing as npt

from graphs.compiled import library
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.realisation.pattern import Pattern

SOURCE = Path(__file__).with_name("kernel.c")
_P = c_void_p


def kernel() -> ctypes.CDLL | None:
    """Return the library with the types of its functions; None where there is none."""
    found = library(SOURCE)
    if found is not None and found.drawing_new.argtypes is None:
        found.drawing_new.restype, found.drawing_new.argtypes = _P, (_P,) * 13
        found.drawing_free.restype, found.drawing_free.argtypes = None, (_P,)
        found.drawing_cost.restype, found.drawing_cost.argtypes = c_int, (_P, _P, _P, c_int, _P, _P, _P)
    return found


@dataclass(frozen=True, slots=True)
class Sizes:
    """Sizes below which corners, turns of the border and seen sides cost more than they should, and that of lengths."""

    sharp: float
    length: float
    border: float
    seen: float


class KernelDrawing:
    """The cost of drawings of a pattern in the library."""

    def __init__(self, library: ctypes.CDLL, pattern: Pattern, points: int, sizes: Sizes) -> None:
        corners, rings = pattern.corners, (pattern.outer, *pattern.holes)
        apex = corners[:, 1]
        numbers = [points, pattern.vertices, len(pattern.panels), len(corners), len(pattern.edges)]
        numbers += [len(pattern.seen_from_hubs), len(rings), len(pattern.inner), len(pattern.hubs)]
        arrays: list[npt.NDArray[np.int32]] = [
            np.ascontiguousarray(values, dtype=np.int32)
            for values in (
                corners,
                pattern.edges,
                pattern.seen_from_hubs,
                pattern.panel_of_corner,
                np.searchsorted(np.sort(apex), np.arange(pattern.vertices + 1)),
                np.argsort(apex, kind="stable"),
                np.cumsum([0, *map(len, rings)]),
                [vertex for ring in rings for vertex in ring],
                pattern.inner,
                [len(panel) for panel in pattern.panels],
            )
        ]
        first, widest = np.array(numbers, np.int64), np.ascontiguousarray(pattern.widest)
        zeros = np.array([*astuple(sizes), DOUBLE.same_point, DOUBLE.same_configuration])
        places = [first.ctypes.data, *(array.ctypes.data for array in arrays), widest.ctypes.data, zeros.ctypes.data]
        self._handle = library.drawing_new(*places)
        if not self._handle:
            raise MemoryError("no memory for a drawing of so many panels")
        finalize(self, library.drawing_free, self._handle)
        rows = 2 * len(corners) + len(pattern.edges) + sum(map(len, rings)) + len(pattern.seen_from_hubs)
        self._library, self._shape = library, (rows, 2 * points)
        self._room = np.empty(7 * len(corners) + len(pattern.panels) + pattern.vertices)

    def cost(self, unknowns: Floats, lengths: Floats, *, convex: bool) -> tuple[Floats, Floats] | None:
        """Return residuals, float[R], and their derivatives; None where it is no drawing. One thread at a time."""
        residuals, derivatives = np.empty(self._shape[0]), np.empty(self._shape)
        unknowns, lengths = np.ascontiguousarray(unknowns), np.ascontiguousarray(lengths)
        arrays = (residuals, derivatives, self._room)
        places = (unknowns.ctypes.data, lengths.ctypes.data, int(convex), *(array.ctypes.data for array in arrays))
        return (residuals, derivatives) if self._library.drawing_cost(self._handle, *places) else None
