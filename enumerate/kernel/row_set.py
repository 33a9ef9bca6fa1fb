"""Sets of rows of bytes that keep the order in which rows came, compiled."""

from __future__ import annotations

import numpy as np

from enumerate.kernel.compiled import compiled, doubled
from graphs.types import Bytes, Ints

__all__ = ["empty_set", "insert", "slot_of"]


@compiled
def empty_set(width: int) -> tuple[Ints, Bytes, int]:
    """Return the table, the rows (none of them in use) and the number of rows of a new set."""
    return np.full(256, -1, np.int64), np.empty((64, width), np.uint8), 0


@compiled
def slot_of(table: Ints, rows: Bytes | Ints, row: Bytes | Ints) -> np.int64:
    """Return where a row is in a hash table of rows, or the free slot where it belongs."""
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
