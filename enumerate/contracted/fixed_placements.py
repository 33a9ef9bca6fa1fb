"""Placements that a permutation of the joints leaves as they are, counted without being made, compiled.

Such a placement has one value on each cycle of joints. Cycles are filled one after another, and what a placement
leaves behind is how many binary links there still are, and how many may still lie *outside* each set of links: the
conditions of `enumerate.contracted.binary_links`, for a number W of first and second units on joints. Placements
that agree in that go on together. Nothing is shared with the count by orbits but these conditions. Theory:
docs/theory/chains.md.
"""

from typing import NamedTuple

import numpy as np

from enumerate.contracted.binary_links import Frame
from enumerate.kernel._compiled import compiled, doubled, slot_of
from graphs.types import Bytes, Ints

_ENOUGH = 1 << 40
"""Room outside a set that cannot be used up any more: above any number of units, and no sum of it runs over."""

_FIRST = 3
"""Units left, those beyond the second on a joint, and the last value come before the rooms in a row."""


class Cycles(NamedTuple):
    """The cycles of a permutation of joints, in the order in which they are filled, with their numbers of joints.

    `start` is the first of the cycles that run through parallel joints side by side; their values do not rise.
    `outside`, int64[s, k], is how many joints lie outside each set; `still` says of a string on a cycle which
    links stay where they are: 0 for none, 1 for all, 2 for the middle one.
    """

    cost: Ints
    start: Ints
    outside: Ints
    still: Ints


@compiled
def cycles_of(frame: Frame, moved: Bytes, automorphism: Bytes, order: Ints) -> Cycles:
    """Return the cycles of a permutation `moved` of joints, which keeps the order of parallel joints.

    `automorphism` is what it does to the links. The order is that of first joints of classes of parallel ones, as
    they are filled.
    """
    ends, first, sets = frame.ends, frame.first, frame.sets
    m = len(ends)
    cost, start, still = np.zeros(m, np.int64), np.zeros(m, np.int64), np.zeros(m, np.int64)
    outside = np.zeros((m, len(sets) - 1), np.int64)
    cycle = np.full(m, -1, np.int64)
    used = 0
    for begin in order:
        e = begin
        while e < m and first[e] == begin:
            f = np.int64(e)
            while cycle[f] < 0:
                cycle[f] = used
                start[used] = cycle[begin]
                cost[used] += 1
                for i in range(len(sets) - 1):
                    outside[used, i] += not ((sets[i] >> ends[f, 0]) & (sets[i] >> ends[f, 1]) & 1)
                f = np.int64(moved[f])
            if cycle[e] == used:
                if moved[begin] == begin:
                    still[used] = 1 if automorphism[ends[e, 0]] == ends[e, 0] else 2
                used += 1
            e += 1
    return Cycles(cost[:used], start[:used], outside[:used], still[:used])


@compiled
def count_left_in_place(cycles: Cycles, needs: Ints, bound: int, free: int, most: int) -> tuple[int, int]:
    """Return the number of placements, and of links of their strings that stay where they are, in all of them.

    Of equal parallel strings that are permuted among themselves, one stays in the mean; of a string that is turned
    round, the link in the middle. Needs are those of the sets, of the whole set last; bound units are the first
    and second on joints, free ones those beyond, and no joint holds more than `most`.
    """
    inside, beyond = _capacities(cycles)
    rows = np.zeros((1, _FIRST + beyond.shape[1]), np.int64)
    rows[0, 0], rows[0, 1] = bound, free
    for i in range(beyond.shape[1]):
        rows[0, _FIRST + i] = _room(bound - needs[i], bound, inside[0, i], beyond[0, i])
        if rows[0, _FIRST + i] < 0:
            return 0, 0
    number = np.ones((1, 2), np.int64)
    number[0, 1] = 0
    for v in range(len(cycles.cost)):
        rows, number = _filled(cycles, v, rows, number, inside, beyond, most)
    total = still = 0
    for i in range(len(rows)):
        total += number[i, 0]
        still += number[i, 1]
    return total, still


@compiled
def _capacities(cycles: Cycles) -> tuple[Ints, Ints]:
    """Return how many first and second units cycles from each on can hold inside each set, and outside.

    The last column is of the set of all links.
    """
    count, sets = cycles.outside.shape
    inside, beyond = np.zeros((count + 1, sets + 1), np.int64), np.zeros((count + 1, sets), np.int64)
    for v in range(count - 1, -1, -1):
        for i in range(sets):
            inside[v, i] = inside[v + 1, i] + 2 * (cycles.cost[v] - cycles.outside[v, i])
            beyond[v, i] = beyond[v + 1, i] + 2 * cycles.outside[v, i]
        inside[v, sets] = inside[v + 1, sets] + 2 * cycles.cost[v]
    return inside, beyond


@compiled
def _room(room: int, due: int, inside: int, beyond: int) -> int:
    """Return the room outside a set; -1 if what is due does not fit, `_ENOUGH` if it does whatever comes."""
    if room < 0 or due - inside > room:
        return -1
    return _ENOUGH if room >= min(due, beyond) else room


@compiled
def _filled(
    cycles: Cycles, v: int, rows: Ints, number: Ints, inside: Ints, beyond: Ints, most: int
) -> tuple[Ints, Ints]:
    """Give a cycle each value that it can have after each row; return the rows that come of it, with numbers."""
    width, parallel = rows.shape[1], v + 1 < len(cycles.cost) and cycles.start[v + 1] != v + 1
    cost, still, outside = cycles.cost[v], cycles.still[v], cycles.outside[v]
    after, numbers = np.zeros((2 * len(rows) + 8, width), np.int64), np.zeros((2 * len(rows) + 8, 2), np.int64)
    table = np.full(_table_size(len(after)), -1, np.int64)
    row = np.zeros(width, np.int64)
    most_counted = inside[v + 1, width - _FIRST]
    most_free = max(most - 2, 0) * most_counted // 2
    used = 0
    for i in range(len(rows)):
        first = cycles.start[v] == v
        for x in range((most if first else min(most, rows[i, 2])) + 1):
            counted = min(x, 2)
            row[0], row[1] = rows[i, 0] - cost * counted, rows[i, 1] - cost * (x - counted)
            row[2] = x if parallel else 0
            if row[0] < 0 or row[1] < 0:
                break
            if (
                row[0] > most_counted
                or row[1] > most_free
                or not _has_room(rows[i], counted, outside, row, inside[v + 1], beyond[v + 1])
            ):
                continue
            if used == len(after):
                after, numbers = doubled(after), doubled(numbers)
                table = np.full(_table_size(len(after)), -1, np.int64)
                for j in range(used):
                    table[slot_of(table, after, after[j])] = j
            slot = slot_of(table, after, row)
            if table[slot] < 0:
                table[slot] = used
                for k in range(width):
                    after[used, k] = row[k]
                numbers[used, 0] = numbers[used, 1] = 0
                used += 1
            # of parallel strings of equal length one is counted: the first of them
            stays = x * (still == 1) + x % 2 * (still == 2) if first or x != rows[i, 2] else 0
            numbers[table[slot], 0] += number[i, 0]
            numbers[table[slot], 1] += number[i, 1] + number[i, 0] * stays
    return after[:used], numbers[:used]


@compiled
def _has_room(before: Ints, counted: int, outside: Ints, row: Ints, inside: Ints, beyond: Ints) -> bool:
    """Write the rooms of a row in which a cycle holds so many counted units; tell whether there is room."""
    for k in range(_FIRST, len(row)):
        room = before[k] - counted * outside[k - _FIRST] * (before[k] < _ENOUGH)
        row[k] = _room(room, row[0], inside[k - _FIRST], beyond[k - _FIRST])
        if row[k] < 0:
            return False
    return True


@compiled
def _table_size(rows: int) -> int:
    size = 16
    while size < 4 * rows:
        size *= 2
    return size
