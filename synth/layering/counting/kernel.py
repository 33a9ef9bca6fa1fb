"""The library kernel.c: what follows from known orders, and how many orders there are.

Whatever is here `synth.layering.counting.problem` and `synth.layering.counting.settling` do in Python too, where there
is no library.
"""

import ctypes
from collections.abc import Sequence
from ctypes import c_int, c_int64, c_void_p
from pathlib import Path
from threading import Thread
from typing import Any

import numpy as np

from graphs.compiled import library
from graphs.types import Ints, Signs
from synth.layering.counting.problem import LayerProblem

SOURCE = Path(__file__).with_name("kernel.c")
MOST_BYTES = 1 << 28
"""Bytes of the keys of a cache; when they are used up it is emptied."""
_P = c_void_p
_FUNCTIONS: dict[str, tuple[Any, tuple[Any, ...]]] = {
    "settled": (c_int, (c_int64, _P, _P, _P, c_int64, c_int64, _P, _P, _P)),
    "probed": (c_int, (c_int64, c_int64, _P, c_int64, _P, c_int64, _P, _P)),
    "counted": (c_int, (c_int64, c_int64, _P, c_int64, _P, c_int64, _P, c_int64, _P, c_int64, _P, _P, _P)),
}
_STOPPED, _TOO_LARGE, _NO_MEMORY = 1, 2, 3
_LOOK = 0.1
"""Seconds after which a running count looks whether it was interrupted."""


def kernel() -> ctypes.CDLL | None:
    """Return the library with the types of its functions; None where there is none."""
    found = library(SOURCE)
    if found is not None and found.counted.argtypes is None:
        for name, (result, arguments) in _FUNCTIONS.items():
            function = getattr(found, name)
            function.restype, function.argtypes = result, arguments
    return found


class ProblemInLibrary:
    """The arrays of a problem, as the library takes them."""

    def __init__(self, found: ctypes.CDLL, problem: LayerProblem) -> None:
        self._library, self._variables = found, problem.variables
        rows = (problem.triples, problem.clauses, problem.parities)
        self._arrays = [np.ascontiguousarray(array, dtype=np.int64) for array in rows]
        self._arguments = [problem.variables]
        for array in self._arrays:
            self._arguments += [len(array), array.ctypes.data]

    def probed(self) -> Signs:
        """Return for each literal whether it leads to a contradiction by itself, int8[2 n]."""
        fails = np.zeros(2 * self._variables, dtype=np.int8)
        if not self._library.probed(*self._arguments, fails.ctypes.data):
            raise MemoryError("no memory for so many conditions on layers")
        return fails

    def count(self, literals: Sequence[int]) -> int | None:
        """Return in how many ways the variables can be set; None if 128 bits do not hold the number.

        The library works in a thread of its own, so that an interrupt stops it.
        """
        given = np.array(literals, dtype=np.int64)
        stop, halves, nodes = np.zeros(1, dtype=np.int32), np.zeros(2, dtype=np.uint64), np.zeros(1, dtype=np.int64)
        places = (stop.ctypes.data, halves.ctypes.data, nodes.ctypes.data)
        state = [_STOPPED]

        def run() -> None:
            state[0] = self._library.counted(*self._arguments, len(given), given.ctypes.data, MOST_BYTES, *places)

        thread = Thread(target=run)
        thread.start()
        try:
            while thread.is_alive():
                thread.join(_LOOK)
        finally:
            stop[0] = 1
            thread.join()
        if state[0] == _NO_MEMORY:
            raise MemoryError("no memory for so many conditions on layers")
        return None if state[0] == _TOO_LARGE else int(halves[0]) + (int(halves[1]) << 64)


def settled_in_library(
    found: ctypes.CDLL, sizes: Ints, first: Ints, rows: Ints, parities: Ints, values: Signs
) -> tuple[bool, Ints]:
    """Extend the values of classes, int8[n], by what follows from them; return whether that is consistent, and why.

    The reasons, int[n + 1, 4], are classes from which each follows, -1 fills up; the last row is the contradiction.
    """
    arrays = [np.ascontiguousarray(array, dtype=np.int64) for array in (sizes, first, rows, parities)]
    places = [array.ctypes.data for array in arrays]
    why = np.full((len(values) + 1, 4), -1, dtype=np.int64)
    written = (values.ctypes.data, why.ctypes.data)
    state = found.settled(len(sizes), *places[:3], len(values), len(parities), places[3], *written)
    if state < 0:
        raise MemoryError("no memory for so many pairs of panels")
    return bool(state), why
