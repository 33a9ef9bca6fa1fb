"""Placements counted without being made: all that matters of one is what sets of links still need, compiled.

Classes of parallel joints are filled one after another. What can follow depends only on how many binary links are
left and on what each set of links still needs, so placements that agree in that are one *state*, with their
number. A need is zero once the set has enough, or cannot but get it. Theory: docs/theory/chains.md.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from enumerate.contracted.classes import Classes, Counters
from enumerate.kernel.compiled import compiled
from graphs.types import Ints, Words

__all__ = ["GROUP", "GROUPS", "LEVEL", "States", "add", "beginning", "filled", "step", "total_at_end"]

LEVEL = np.uint64(48)
"""Where the number of filled classes begins in the first word of a state."""

GROUP = np.uint64(32)
"""Where a number of 16 bits begins there that tells states apart: of symmetries that may still say something."""

GROUPS = np.uint64(0xFFFF << 32)
_UNITS = np.uint64(0xFFFFFFFF)
_MIX = np.uint64(0x9E3779B97F4A7C15)


class States(NamedTuple):
    """A table of states, and for each number of filled classes the list of its states.

    Attributes
    ----------
    slots : int64[s]
        Hash table of rows.
    words : uint64[r, k + 1]
        Of a state, filled classes and units left, then what sets need.
    number : int64[r, 2]
        Number of placements of each, and of links chosen in all of them; the second means something only where no
        symmetries are compared.
    following : int64[r]
        The next state with as many filled classes.
    begin : int64[c + 2]
        The first one of each list; last, how many rows are in use.
    """

    slots: Ints
    words: Words
    number: Ints
    following: Ints
    begin: Ints


@compiled
def beginning(classes: Classes, units: int, group: int) -> States:
    """Return a table with one state: nothing is filled, for one placement.

    `units` binary links are to be placed; the group distinguishes the state.
    """
    begin = np.full(len(classes.size) + 2, -1, np.int64)
    begin[-1] = 0
    words = np.zeros((128, len(classes.needs) + 1), np.uint64)
    slots, number, following = np.full(512, -1, np.int64), np.zeros((128, 2), np.int64), np.zeros(128, np.int64)
    row = np.zeros(len(classes.needs) + 1, np.uint64)
    row[0] = np.uint64(units) | np.uint64(group) << GROUP
    for k in range(len(classes.needs)):
        row[k + 1] = classes.needs[k]
    _put(slots, words, number, following, begin, row, 1, 0)
    return States(slots, words, number, following, begin)


@compiled
def _slot(slots: Ints, words: Words, row: Words) -> np.int64:
    """Return where a row is in a hash table of rows, or the free slot where it belongs."""
    word = np.uint64(0)
    for part in row:
        word = (word ^ part) * _MIX
        word ^= word >> np.uint64(32)
    mask = len(slots) - 1
    slot = np.int64((word * _MIX) >> np.uint64(34)) & mask
    while slots[slot] >= 0:
        other = slots[slot]
        k = 0
        while k < len(row) and words[other, k] == row[k]:
            k += 1
        if k == len(row):
            return slot
        slot = (slot + 1) & mask
    return slot


@compiled
def add(states: States, row: Words, number: int, chosen: int) -> States:
    """Add placements to a state, and links chosen in them; return the table, which may have grown."""
    if states.begin[-1] == len(states.words):
        states = _grown(states)
    _put(states.slots, states.words, states.number, states.following, states.begin, row, number, chosen)
    return states


@compiled
def _put(
    slots: Ints, words: Words, numbers: Ints, following: Ints, begin: Ints, row: Words, number: int, chosen: int
) -> None:
    """Add placements to a state of a table with a free row, whose arrays come apart: that is much faster."""
    slot = _slot(slots, words, row)
    if slots[slot] >= 0:
        numbers[slots[slot], 0] += number
        numbers[slots[slot], 1] += chosen
        return
    used, level = begin[-1], np.int64(row[0] >> LEVEL)
    slots[slot] = used
    for k in range(len(row)):
        words[used, k] = row[k]
    numbers[used, 0], numbers[used, 1] = number, chosen
    following[used] = begin[level]
    begin[level] = used
    begin[-1] = used + 1


@compiled
def _grown(states: States) -> States:
    """Return a table of twice the size."""
    rows, used = len(states.words), states.begin[-1]
    words = np.zeros((2 * rows, states.words.shape[1]), np.uint64)
    number, following = np.zeros((2 * rows, 2), np.int64), np.zeros(2 * rows, np.int64)
    slots = np.full(8 * rows, -1, np.int64)
    for i in range(used):
        for k in range(words.shape[1]):
            words[i, k] = states.words[i, k]
        number[i, 0], number[i, 1] = states.number[i, 0], states.number[i, 1]
        following[i] = states.following[i]
        slots[_slot(slots, words, words[i])] = i
    return States(slots, words, number, following, states.begin)


@compiled
def step(
    counters: Words,
    rest: Ints,
    laid: Counters,
    words: Words,
    i: int,
    units: int,
    counted: int,
    most: int,
    new: Words,
) -> bool:
    """Fill one more class with so many units, of which so many are counted; return whether the rest can be placed.

    Counters and rest are those of the classes; i is the state before, of the states `words`, uint64[r, k + 1];
    `new` gets the state after. Counted are the units that are first or second on their joint; no joint holds more
    than `most`.
    """
    level = np.int64(words[i, 0] >> LEVEL)
    left = np.int64(words[i, 0] & _UNITS) - units
    if left < 0 or left > most * rest[level + 1]:
        return False
    ones, guard, full, last = laid
    new[0] = words[i, 0] + (np.uint64(1) << LEVEL) - np.uint64(units)
    due = min(np.uint64(left), full) * ones | guard
    taken = min(np.uint64(counted), full)
    for k in range(counters.shape[2]):
        need = (words[i, k + 1] | guard) - taken * counters[level, 0, k]
        need &= ((need & guard) >> last) * full  # below zero is enough
        if ((counters[level + 1, 1, k] | guard) - need) & (due - need) & guard != guard:
            return False
        if most <= 2:  # what is left and does not fit outside
            sure = due - counters[level + 1, 2, k]
            sure &= ((sure & guard) >> last) * full
            enough = ((sure | guard) - need) & guard
            need &= ~((enough >> last) * full)
        new[k + 1] = need
    return True


@compiled
def filled(
    states: States, classes: Classes, level: int, strings: tuple[Ints, Ints], most: int, passed: np.uint64
) -> States:
    """Fill the next class of all states with so many filled classes, in every way; return the table.

    `level` is the number of filled classes, `strings` those of `enumerate.contracted.classes.strings_of_classes`;
    no joint holds more than `most`. States that have one of the bits `passed` in their first word are passed over.
    """
    start, ways = strings
    low, high = start[classes.size[level]], start[classes.size[level] + 1]
    counters, rest, laid = classes.counters, classes.rest, classes.laid
    slots, words, number, following, begin = states
    new = np.empty(words.shape[1], np.uint64)
    i = begin[level]
    while i >= 0:
        if words[i, 0] & passed == 0:
            while begin[-1] + high - low > len(words):
                slots, words, number, following, begin = _grown(States(slots, words, number, following, begin))
            for way in range(low, high):
                if step(counters, rest, laid, words, i, ways[way, 0], ways[way, 1], most, new):
                    more = number[i, 0] * ways[way, 2]
                    chosen = number[i, 1] * ways[way, 2] + number[i, 0] * ways[way, 3]
                    _put(slots, words, number, following, begin, new, more, chosen)
        i = following[i]
    return States(slots, words, number, following, begin)


@compiled
def total_at_end(states: States) -> tuple[int, int]:
    """Return the number of placements with all classes filled, and of links chosen in all of them."""
    total, chosen, i = 0, 0, states.begin[-2]
    while i >= 0:
        total += states.number[i, 0]
        chosen += states.number[i, 1]
        i = states.following[i]
    return total, chosen
