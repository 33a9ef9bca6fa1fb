"""What follows from orders that are known, and how many there are: by kernel.c, or in Python where it was not built.

What follows does so by transitivity in all cells and by creases that do not interleave: each newly known order of two
panels over a cell is compared with those of both to every third panel there. Numbers in Python:
`synth.analysis.layering.counting.problem`.
"""

import ctypes
from collections.abc import Sequence
from ctypes import c_int, c_int64, c_void_p
from pathlib import Path
from threading import Event, Thread
from typing import Any

import numpy as np

from graphs.c_libraries import library
from graphs.types import Ints, Signs
from synth.analysis.layering.constraints import PairTable
from synth.analysis.layering.counting.problem import UNKNOWN, LayerProblem, count_in_python, probe_in_python

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

        The library works in a thread of its own, so that an interrupt stops it. Nobody waits for it then, and it ends
        soon: so the thread itself holds what the library writes to.
        """
        given = np.array(literals, dtype=np.int64)
        stop, halves, nodes = np.zeros(1, dtype=np.int32), np.zeros(2, dtype=np.uint64), np.zeros(1, dtype=np.int64)
        state, done = [_STOPPED], Event()

        def run() -> None:
            places = [array.ctypes.data for array in (stop, halves, nodes)]  # addresses alone would not hold them
            try:
                state[0] = self._library.counted(*self._arguments, len(given), given.ctypes.data, MOST_BYTES, *places)
            finally:
                done.set()

        try:
            Thread(target=run).start()
            while not done.wait(_LOOK):  # Thread.join, once interrupted, takes a running thread for one that ended
                pass
        finally:
            stop[0] = 1
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


def settled(table: PairTable, rows: Ints, classes: int, parities: Ints) -> Signs | None:
    """Return the values of classes that follow from that of class 0, which is true; None if they contradict.

    `rows` has the literal of each row of the table. -1 stands for what is left open.
    """
    values = np.full(classes, UNKNOWN, dtype=np.int8)
    values[0] = 1
    found = kernel()
    if found is not None:
        good, _ = settled_in_library(found, table.sizes, table.first, rows, parities, values)
    else:
        good = _settled(table, rows, parities, values)
    return values if good else None


def contradicting(table: PairTable, rows: Ints, known: Ints, classes: int, parities: Ints) -> Ints | None:
    """Return classes whose values contradict each other where some literals are true; None where it is not known."""
    values = np.full(classes, UNKNOWN, dtype=np.int8)
    values[known >> 1] = 1 - (known & 1)
    wrong = np.flatnonzero(_truths(values, known) == 0)
    if len(wrong):
        return known[wrong[:1]] >> 1
    found = kernel()
    if found is None:
        return None
    good, why = settled_in_library(found, table.sizes, table.first, rows, parities, values)
    if good:
        return None
    classes_met: set[int] = set()
    left = set(why[-1].tolist()) - {-1}
    while left:
        number = left.pop()
        classes_met.add(number)
        left |= set(why[number].tolist()) - {-1} - classes_met
    return np.array(sorted(classes_met), dtype=np.int64)


def _truths(values: Signs, literals: Ints) -> Signs:
    here = values[literals >> 1]
    found: Signs = np.where(here < 0, here, here ^ (literals & 1).astype(np.int8))
    return found


def _settled(table: PairTable, rows: Ints, parities: Ints, values: Signs) -> bool:
    """Extend values by what follows, one level after the other."""
    cell_of = np.repeat(np.arange(len(table.sizes)), np.diff(table.first))
    pairs = [np.triu_indices(size, 1) for size in table.sizes.tolist()]
    one = np.concatenate([pair[0] for pair in pairs]) if pairs else np.empty(0, dtype=np.int64)
    other = np.concatenate([pair[1] for pair in pairs]) if pairs else np.empty(0, dtype=np.int64)
    order = np.argsort(rows >> 1, kind="stable")
    begin = np.searchsorted(rows[order] >> 1, np.arange(len(values) + 1))
    new = np.flatnonzero(values >= 0)
    while len(new):
        implied = [_implied_by_parities(parities, values)]
        for row in np.concatenate([order[begin[v] : begin[v + 1]] for v in new]).tolist():
            implied.append(_implied_in_cell(table, rows, values, int(cell_of[row]), int(one[row]), int(other[row])))
        literals = np.unique(np.concatenate(implied))
        if (literals[:-1] ^ 1 == literals[1:])[literals[:-1] % 2 == 0].any() or (_truths(values, literals) == 0).any():
            return False
        literals = literals[_truths(values, literals) == UNKNOWN]
        new = literals >> 1
        values[new] = 1 - (literals & 1)
    return True


def _implied_in_cell(table: PairTable, rows: Ints, values: Signs, cell: int, one: int, other: int) -> Ints:
    """Return literals that the known order of two panels implies by transitivity."""
    size = int(table.sizes[cell])
    thirds = np.array([k for k in range(size) if k not in (one, other)], dtype=np.int64)

    def over(i: Ints, j: Ints) -> Ints:
        found: Ints = rows[table.rows(cell, np.minimum(i, j), np.maximum(i, j))] ^ (i > j)
        return found

    first = int(_truths(values, over(np.array([one]), np.array([other])))[0])
    after, back = over(np.full_like(thirds, other), thirds), over(thirds, np.full_like(thirds, one))
    return np.concatenate([back[_truths(values, after) == first], after[_truths(values, back) == first]]) ^ first


def _implied_by_parities(parities: Ints, values: Signs) -> Ints:
    implied = []
    for row in parities.tolist():
        odd, left = 0, set[int]()
        for literal in row:
            if literal < 0:
                continue
            truth = int(values[literal >> 1])
            odd ^= literal & 1
            if truth == UNKNOWN:
                left ^= {literal & ~1}
            else:
                odd ^= truth
        if len(left) == 1:
            implied.append(left.pop() ^ 1 - odd)
        elif not left and odd:
            implied += [0, 1]  # a contradiction
    return np.array(implied, dtype=np.int64)


def probed(problem: LayerProblem) -> Signs:
    """Return for each literal whether it leads to a contradiction by itself, int8[2 n]."""
    found = kernel()
    return probe_in_python(problem) if found is None else ProblemInLibrary(found, problem).probed()


def counted(problem: LayerProblem, literals: tuple[int, ...] = ()) -> int:
    """Return in how many ways the variables of a problem can be set where some literals are true.

    Parameters
    ----------
    problem : LayerProblem
    literals : tuple of int, optional

    Examples
    --------
    >>> none = np.empty((0, 2), dtype=np.int64), np.empty((0, 4), dtype=np.int64)
    >>> problem = LayerProblem(3, np.array([[0, 2, 4]]), *none)
    >>> counted(problem), counted(problem, (0, 2))
    (6, 1)
    """
    found = kernel()
    number = None if found is None else ProblemInLibrary(found, problem).count(literals)
    return count_in_python(problem, literals) if number is None else number
