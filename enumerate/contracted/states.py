"""Placements counted without being made: all that matters of one is what sets of links still need, compiled.

A *class* is the joints between one pair of links: its strings of binary links have no order. A set of links needs
a number of binary links on its joints, of which the first two on a joint are counted. The needs of all sets are
counters side by side in machine words, as wide as the largest need asks for, each with a guard bit.

Classes are filled one after another. What can follow depends only on how many binary links are left and on what
each set of links still needs, so placements that agree in that are one *state*, with their number. A need is zero
once the set has enough, or cannot but get it. Theory: docs/theory/chains.md.
"""

from typing import NamedTuple

import numpy as np

from enumerate.contracted.binary_links import Frame
from enumerate.kernel._compiled import compiled, doubled
from enumerate.kernel.words import GOLDEN, hashed, mixed, times
from enumerate.machine_code.kernels import compiled_beside
from graphs.types import Bytes, Ints, Words


class Counters(NamedTuple):
    """How counters lie in a word: one in each, its guard bit, and the largest value of one.

    `last` is how far the guard bit of one is from its first bit.
    """

    ones: np.uint64
    guard: np.uint64
    full: np.uint64
    last: np.uint64


class Classes(NamedTuple):
    """Classes of parallel joints, in the order in which they are filled: the first joint of each, and how many.

    `rest` is the number of joints of the classes from each on. `counters`, uint64[c + 1, 3, k], hold one in the
    counter of each set that a class lies in; what the classes from it on can hold inside each set, two on a joint;
    and what they can hold outside. `needs` is what each set needs.
    """

    joint: Ints
    size: Ints
    rest: Ints
    counters: Words
    needs: Words
    laid: Counters


@compiled
def order_of_classes(frame: Frame, moved: Bytes) -> Ints:
    """Return the first joint of each class, in the order in which classes are filled.

    Those that symmetries, `moved`, take to each other follow each other. Else those come next that begin few sets
    and end many: what a set needs is then looked after for a short while only, and more placements come to one
    state.
    """
    ends, sets = frame.ends, frame.sets
    joint = np.flatnonzero(frame.first == np.arange(len(ends)))
    orbit = joint.copy()
    member = np.zeros((len(joint), len(sets)), np.bool_)
    left = np.zeros(len(sets), np.int64)
    for c in range(len(joint)):
        for a in range(len(moved)):
            orbit[c] = min(orbit[c], moved[a, joint[c]])
        for i in range(len(sets)):
            member[c, i] = lies_in(ends, joint[c], sets[i])
            left[i] += member[c, i]
    size = left.copy()
    order = np.empty(len(joint), np.int64)
    taken = np.zeros(len(joint), np.bool_)
    last = -1
    for k in range(len(order)):
        best, least = -1, 0
        for c in range(len(joint)):
            if taken[c]:
                continue
            cost = -1000 * (orbit[c] == last)
            for i in range(len(sets)):
                if member[c, i]:
                    cost += 2 * (left[i] == size[i]) - (left[i] < size[i]) - 2 * (left[i] == 1)
            if best < 0 or cost < least:
                best, least = c, cost
        order[k], taken[best], last = joint[best], True, orbit[best]
        for i in range(len(sets)):
            left[i] -= member[best, i]
    return order


@compiled
def lies_in(ends: Bytes, joint: int, links: int) -> np.int64:
    """Return 1 if both links of a joint are in a set, else 0."""
    return np.int64((links >> ends[joint, 0]) & (links >> ends[joint, 1]) & 1)


@compiled
def classes_in_order(frame: Frame, order: Ints, units: int, most: int) -> Classes:
    """Return the classes in an order of first joints, with the sets that constrain so many binary links (`units`).

    No joint holds more than `most`.
    """
    ends, first, sets, needs = frame.ends, frame.first, frame.sets, frame.needs
    count, each = len(order), min(most, 2)
    size, rest = np.zeros(count, np.int64), np.zeros(count + 1, np.int64)
    for c in range(count - 1, -1, -1):
        for e in range(order[c], len(first)):
            size[c] += first[e] == order[c]
        rest[c] = rest[c + 1] + size[c]
    asking = np.zeros(len(sets), np.int64)
    used = greatest = 0
    for i in range(len(sets)):
        held = 0
        for c in range(count):
            held += size[c] * lies_in(ends, order[c], sets[i])
        surely = units - each * (rest[0] - held) if most <= 2 else 0  # what does not fit outside
        if needs[i] > max(surely, 0):
            asking[used] = i
            greatest, used = max(greatest, needs[i]), used + 1
    laid = _laid(greatest)
    each_word = 64 // (np.int64(laid.last) + 1)
    words = (used + each_word - 1) // each_word
    counters, wanted = np.zeros((count + 1, 3, words), np.uint64), np.zeros(words, np.uint64)
    for j in range(used):
        word, shift = j // each_word, np.uint64(j % each_word) * (laid.last + np.uint64(1))
        wanted[word] |= np.uint64(needs[asking[j]]) << shift
        inside = outside = 0
        for c in range(count - 1, -1, -1):
            lies = lies_in(ends, order[c], sets[asking[j]])
            inside += each * size[c] * lies
            outside += each * size[c] * (1 - lies)
            counters[c, 0, word] |= np.uint64(lies) << shift
            counters[c, 1, word] |= min(np.uint64(inside), laid.full) << shift
            counters[c, 2, word] |= min(np.uint64(outside), laid.full) << shift
    return Classes(order, size, rest, counters, wanted, laid)


@compiled
def _laid(greatest: int) -> Counters:
    """Return counters that hold values up to some number."""
    last = 1
    while 1 << last <= greatest:
        last += 1
    ones = np.uint64(0)
    for k in range(64 // (last + 1)):
        ones |= np.uint64(1) << np.uint64(k * (last + 1))
    return Counters(ones, ones << np.uint64(last), np.uint64((1 << last) - 1), np.uint64(last))


@compiled
def strings_of_classes(largest: int, units: int, most: int) -> tuple[Ints, Ints]:
    """Return in how many ways parallel joints hold strings of binary links, their order left aside.

    Of p joints with two or more, f units beyond the second are a partition of f into p parts at most, none above
    ``most`` - 2. Links of equal strings are alike, so a way has as many that differ as its lengths, each once, add
    up to. Rows begin at start, int64[largest + 2], for so many joints; ways, int64[r, 4], are units (`units` at
    most), those that are first or second on their joint, the number of ways, and of links that differ in all of
    them.
    """
    start = np.zeros(largest + 2, np.int64)
    ways = np.zeros((64, 4), np.int64)
    partitions = _partitions(largest, units, most - 2)
    used = 0
    for size in range(largest + 1):
        start[size] = used
        for counted in range(min(2 * size, units) + 1):
            for free in range(units - counted + 1):
                number = links = 0
                for twos in range(counted // 2 + 1):
                    ones = counted - 2 * twos
                    if ones + twos <= size and most >= (2 if twos else 1 if ones else 0):
                        number += partitions[twos, free]
                        links += partitions[twos, free] * (ones > 0)
                        for length in range(2, min(most, free + 2) + 1):
                            links += length * partitions[twos - 1, free + 2 - length] if twos else 0
                if number:
                    ways = doubled(ways) if used == len(ways) else ways
                    ways[used, 0], ways[used, 1] = counted + free, counted
                    ways[used, 2], ways[used, 3] = number, links
                    used += 1
    start[largest + 1] = used
    return start, ways


@compiled
def _partitions(parts: int, total: int, longest: int) -> Ints:
    """Return the numbers of partitions: int64[parts + 1, total + 1], of each number into at most so many parts."""
    found = np.zeros((parts + 1, total + 1), np.int64)
    for p in range(parts + 1):
        found[p, 0] = 1
    for part in range(1, min(longest, total) + 1):
        for p in range(1, parts + 1):
            for number in range(part, total + 1):
                found[p, number] += found[p - 1, number - part]  # one such part, and what is left
    return found


LEVEL = np.uint64(48)
"""Where the number of filled classes begins in the first word of a state."""

GROUP = np.uint64(32)
"""Where a number of 16 bits begins there that tells states apart: of symmetries that may still say something."""

GROUPS = np.uint64(0xFFFF << 32)
_UNITS = np.uint64(0xFFFFFFFF)


class PlacementStates(NamedTuple):
    """A table of states, and for each number of filled classes the list of its states.

    `slots`, int64[s], is a hash table of rows. `words`, uint64[r, k + 1], are filled classes and units left of a
    state, then what sets need; `number`, int64[r, 2], its placements, and the links chosen in all of them, which
    mean something only where no symmetries are compared; `following`, int64[r], the next state with as many filled
    classes. `begin`, int64[c + 2], is the first one of each list; last, how many rows are in use.
    """

    slots: Ints
    words: Words
    number: Ints
    following: Ints
    begin: Ints


@compiled
def beginning(classes: Classes, units: int, group: int) -> PlacementStates:
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
    return PlacementStates(slots, words, number, following, begin)


def _slot_of(slots: Ints, words: Words, row: Words) -> np.int64:
    """Do what `_slot` does, with numbers of Python."""
    word, parts = 0, row.tolist()
    for part in parts:
        word = hashed(word, part, 0, 32)
    mask = len(slots) - 1
    slot = (hashed(0, word, 0, 64) >> 34) & mask
    while slots[slot] >= 0 and words[slots[slot]].tolist() != parts:
        slot = (slot + 1) & mask
    return np.int64(slot)


@compiled_beside(_slot_of)
def _slot(slots: Ints, words: Words, row: Words) -> np.int64:
    """Return where a row is in a hash table of rows, or the free slot where it belongs."""
    word = np.uint64(0)
    for part in row:
        word = mixed(word, part, np.uint64(0), np.uint64(32))
    mask = len(slots) - 1
    slot = np.int64(times(word, GOLDEN) >> np.uint64(34)) & mask
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
def add(states: PlacementStates, row: Words, number: int, chosen: int) -> PlacementStates:
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
def _grown(states: PlacementStates) -> PlacementStates:
    """Return a table of twice the size."""
    words, number = doubled(states.words), doubled(states.number)
    following, slots = np.zeros(len(words), np.int64), np.full(4 * len(words), -1, np.int64)
    for i in range(states.begin[-1]):
        following[i] = states.following[i]
        slots[_slot(slots, words, words[i])] = i
    return PlacementStates(slots, words, number, following, states.begin)


def _step(
    counters: Words, rest: Ints, laid: Counters, words: Words, i: int, units: int, counted: int, most: int, new: Words
) -> bool:
    """Do what `step` does, with numbers of Python; the bits above a counter's are cut off where it matters."""
    first, *needs = words[i].tolist()
    level = first >> 48
    left = (first & 0xFFFFFFFF) - int(units)
    if left < 0 or left > most * rest[level + 1]:
        return False
    ones, guard, full, last = map(int, laid)
    state = [first + (1 << 48) - int(units)]
    due = min(left, full) * ones | guard
    taken = min(int(counted), full)
    here, (_, inside, outside) = counters[level, 0].tolist(), counters[level + 1].tolist()
    for before, own, within, beyond in zip(needs, here, inside, outside, strict=True):
        need = (before | guard) - taken * own
        need &= ((need & guard) >> last) * full
        if ((within | guard) - need) & (due - need) & guard != guard:
            return False
        if most <= 2:
            sure = due - beyond
            sure &= ((sure & guard) >> last) * full
            need &= ~(((((sure | guard) - need) & guard) >> last) * full)
        state.append(need)
    new[:] = state
    return True


@compiled_beside(_step)
def step(
    counters: Words, rest: Ints, laid: Counters, words: Words, i: int, units: int, counted: int, most: int, new: Words
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
        # The guard bits keep counters apart: one that is gone says that its counter fell below zero.
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
    states: PlacementStates, classes: Classes, level: int, strings: tuple[Ints, Ints], most: int, passed: np.uint64
) -> PlacementStates:
    """Fill the next class of all states with so many filled classes, in every way; return the table.

    `level` is the number of filled classes, `strings` those of `enumerate.contracted.states.strings_of_classes`;
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
                slots, words, number, following, begin = _grown(PlacementStates(slots, words, number, following, begin))
            for way in range(low, high):
                if step(counters, rest, laid, words, i, ways[way, 0], ways[way, 1], most, new):
                    more = number[i, 0] * ways[way, 2]
                    chosen = number[i, 1] * ways[way, 2] + number[i, 0] * ways[way, 3]
                    _put(slots, words, number, following, begin, new, more, chosen)
        i = following[i]
    return PlacementStates(slots, words, number, following, begin)


@compiled
def total_at_end(states: PlacementStates) -> tuple[int, int]:
    """Return the number of placements with all classes filled, and of links chosen in all of them."""
    total, chosen, i = 0, 0, states.begin[-2]
    while i >= 0:
        total += states.number[i, 0]
        chosen += states.number[i, 1]
        i = states.following[i]
    return total, chosen
