"""Classes of parallel joints, what sets of links need of them, and the strings that they can hold, compiled.

A class is the joints between one pair of links: its strings of binary links have no order. A set of links needs a
number of binary links on its joints, of which the first two on a joint are counted. The needs of all sets are
counters side by side in machine words, as wide as the largest need asks for, each with a guard bit.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from enumerate.kernel.compiled import compiled, doubled
from graphs.types import Bytes, Ints, Words

__all__ = ["Classes", "Counters", "classes_in_order", "order_of_classes", "strings_of_classes"]


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
def order_of_classes(ends: Bytes, first: Ints, moved: Bytes, sets: Ints) -> Ints:
    """Return the first joint of each class, in the order in which classes are filled.

    Those that symmetries take to each other follow each other. Else those come next that begin few sets and end
    many: what a set needs is then looked after for a short while only, and more placements come to one state.
    """
    joint = np.flatnonzero(first == np.arange(len(first)))
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
def classes_in_order(
    ends: Bytes, first: Ints, order: Ints, sets: Ints, needs: Ints, units: int, most: int
) -> Classes:
    """Return the classes in an order of first joints, with the sets that constrain so many binary links (`units`).

    Ends and first joints are those of `enumerate.contracted.binary_links.slots`, sets and needs those of its
    `rigid_sets`; no joint holds more than `most`.
    """
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
