"""What kernels share: the one decorator, arrays and sets of rows that grow, orbits by Burnside's lemma."""

from collections.abc import Sequence
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from enumerate.kernel.words import mixed
from enumerate.machine_code.kernels import compiled as compiled  # noqa: PLC0414 - others take it from here
from graphs.types import Bytes, Ints

T = TypeVar("T", bound=np.generic)


@compiled
def doubled(rows: npt.NDArray[T]) -> npt.NDArray[T]:
    """Return an array of twice as many rows that begins with these.

    Written out, here and in other compiled functions: numba takes a second or more to compile one assignment to a
    slice, for the text of an error that cannot happen.
    """
    more = np.empty((2 * len(rows), rows.shape[1]), rows.dtype)
    for i in range(len(rows)):
        for j in range(rows.shape[1]):
            more[i, j] = rows[i, j]
    return more


@compiled
def empty_set(width: int) -> tuple[Ints, Bytes, int]:
    """Return a new set of rows of bytes, which keeps the order in which rows came.

    It is a hash table, the rows (none of them in use yet), and the number of rows.
    """
    return np.full(256, -1, np.int64), np.empty((64, width), np.uint8), 0


@compiled
def slot_of(table: Ints, rows: Bytes | Ints, row: Bytes | Ints) -> np.int64:
    """Return where a row is in a hash table of rows, or the free slot where it belongs.

    Slots hold places in `rows`, -1 where free; their number is a power of two, and they are tried in turn.
    """
    word = np.uint64(0)
    for value in row:
        word = mixed(word, np.uint64(value), np.uint64(0), np.uint64(32))
    slot = np.int64(word & np.uint64(len(table) - 1))
    while table[slot] >= 0:
        other = rows[table[slot]]
        k = 0
        while k < len(row) and other[k] == row[k]:
            k += 1
        if k == len(row):
            return slot
        slot = (slot + 1) & np.int64(len(table) - 1)
    return slot


@compiled
def insert(table: Ints, rows: Bytes, used: int, row: Bytes) -> tuple[Ints, Bytes, int]:
    """Add a row to a set of rows, which may grow; return table, rows and their number."""
    slot = slot_of(table, rows, row)
    if table[slot] >= 0:
        return table, rows, used
    table[slot] = used
    for k in range(len(row)):
        rows[used, k] = row[k]
    used += 1
    if used == len(rows):
        rows = doubled(rows)
        table = np.full(8 * used, -1, np.int64)
        for i in range(used):
            table[slot_of(table, rows, rows[i])] = i
    return table, rows, used


def cycles(permutation: Sequence[int]) -> list[list[int]]:
    """Return the cycles of a permutation of 0 to n - 1."""
    seen = [False] * len(permutation)
    found = []
    for start in range(len(permutation)):
        cycle, here = [], start
        while not seen[here]:
            seen[here] = True
            cycle.append(here)
            here = permutation[here]
        if cycle:
            found.append(cycle)
    return found


@compiled
def number_of_orbits(fixed: int, symmetries: int) -> int:
    """Return the number of orbits by Burnside's lemma: the mean number of objects that a symmetry fixes.

    `fixed` is the sum over all symmetries. Raises `ArithmeticError` if the mean is no whole number: the symmetries
    are no group, or something was counted wrongly. That is a fault of the program.
    """
    if fixed % symmetries:
        raise ArithmeticError("Burnside's lemma gives no whole number of orbits")
    return int(fixed // symmetries)
