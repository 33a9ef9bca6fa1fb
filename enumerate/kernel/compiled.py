"""What compiled code shares: the one decorator, arrays and sets of rows that grow, orbits by Burnside's lemma."""

from collections.abc import Callable, Sequence
from typing import Any, TypeVar, cast

import numba
import numpy as np
import numpy.typing as npt

from enumerate.machine_code.cache import KeptCode, fingerprint
from graphs.types import Bytes, Ints

T = TypeVar("T", bound=np.generic)
F = TypeVar("F", bound=Callable[..., object])


kernels: list[Callable[..., object]] = []
"""All functions compiled or to be compiled, of the modules imported so far."""


def compiled(function: F) -> F:
    """Compile a function of numbers and arrays when it is first called, and keep the machine code on disk.

    The code is kept for this user in ``~/.cache/synthedra``, or where ``SYNTHEDRA_CACHE`` or ``XDG_CACHE_HOME``
    says, and is renewed when the function's module changes or any own module that it imports. Other threads run
    meanwhile.
    """
    kernel: Any = numba.njit(nogil=True)(function)
    if fingerprint(function.__module__) and hasattr(kernel, "enable_caching"):  # without, numba compiles nothing
        kernel._cache = KeptCode(function)
    kernels.append(kernel)
    return cast(F, kernel)


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
        word = (word ^ np.uint64(value)) * np.uint64(0x9E3779B97F4A7C15)
        word ^= word >> np.uint64(32)
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


@compiled
def number_of_bits(members: int) -> int:
    """Return how many bits of a word are set, of its lowest 62: how many there are in a set."""
    members -= (members >> 1) & 0x5555555555555555
    members = (members & 0x3333333333333333) + ((members >> 2) & 0x3333333333333333)
    members = (members + (members >> 4)) & 0x0F0F0F0F0F0F0F0F
    return (members * 0x0101010101010101) >> 56


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
    return fixed // symmetries
