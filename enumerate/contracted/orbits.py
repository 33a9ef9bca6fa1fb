"""Placements counted up to symmetry, compared with their images only where they may equal some, compiled.

Of each orbit the lexicographically largest placement is meant. Classes of joints are filled orbit after orbit:
when one is full, a symmetry has left it as it is, or made it smaller and says nothing more, or larger, which ends
the branch. So all that matters of the past is which symmetries have left it as it is, beside what the sets of
links still need: placements that agree in both are one state (`enumerate.contracted.states`). Only inside an orbit
are placements made, and of a graph without symmetries none is. Theory: docs/theory/chains.md.
"""

from __future__ import annotations

import numpy as np

from enumerate.contracted.classes import Classes, classes_in_order, order_of_classes, strings_of_classes
from enumerate.contracted.states import GROUP, GROUPS, LEVEL, States, add, beginning, filled, step, total_at_end
from enumerate.kernel.compiled import compiled
from graphs.types import Bytes, Ints, Words

__all__ = ["count_orbits"]

_NONE = np.uint64(0)


@compiled
def count_orbits(ends: Bytes, first: Ints, moved: Bytes, sets: Ints, needs: Ints, units: int, most: int) -> int:
    """Return the number of placements of binary links on joints with given symmetries, one of each orbit.

    Joints, first parallel ones, and permutations of the joints, which keep the order of parallel ones, are those
    of `enumerate.contracted.binary_links`, sets and needs those of its `rigid_sets`. There are `units` binary
    links, no more than `most` on a joint.
    """
    order = order_of_classes(ends, first, moved, sets)
    classes = classes_in_order(ends, first, order, sets, needs, units, most)
    strings = strings_of_classes(classes.size.max(), units, most)
    images = _images(classes, moved)
    groups = np.zeros((2, (len(images) + 63) // 64), np.uint64)
    for a in range(len(images)):
        groups[1, a // 64] |= np.uint64(1) << np.uint64(a % 64)
    states = beginning(classes, units, int(len(images) > 0))
    ends_of = _ends_of_orbits(classes, images)
    for level in range(len(order)):
        if ends_of[level] == level + 1:
            states = filled(states, classes, level, strings, most, _NONE)
            continue
        i = states.begin[level]
        while i >= 0:
            if states.words[i, 0] & GROUPS:
                states, groups = _compared(states, i, classes, images, groups, ends_of[level], most)
            i = states.following[i]
        states = filled(states, classes, level, strings, most, GROUPS)
    return total_at_end(states)[0]


@compiled
def _images(classes: Classes, moved: Bytes) -> Ints:
    """Return what symmetries do to the joints numbered as they are filled; those that move none are left out."""
    m = moved.shape[1]
    place, joint = np.zeros(m, np.int64), np.zeros(m, np.int64)
    for c in range(len(classes.size)):
        for i in range(classes.size[c]):
            k = m - classes.rest[c] + i
            place[classes.joint[c] + i] = k
            joint[k] = classes.joint[c] + i
    images = np.zeros((len(moved), m), np.int64)
    used = 0
    for a in range(len(moved)):
        moves = False
        for k in range(m):
            images[used, k] = place[moved[a, joint[k]]]
            moves |= images[used, k] != k
        used += moves
    return images[:used].copy()


@compiled
def _ends_of_orbits(classes: Classes, images: Ints) -> Ints:
    """Return for each class how many classes there are up to the end of its orbit; orbits do not overlap."""
    m, count = images.shape[1], len(classes.size)
    of = np.zeros(m, np.int64)  # class of each joint
    for c in range(count):
        for k in range(m - classes.rest[c], m - classes.rest[c + 1]):
            of[k] = c
    end = np.zeros(count, np.int64)
    for c in range(count - 1, -1, -1):
        end[c] = c + 1
        for a in range(len(images)):
            last = of[images[a, m - classes.rest[c]]]
            if last > c:
                end[c] = max(end[c], end[last])
    for c in range(1, count):
        if end[c - 1] > c:
            end[c] = end[c - 1]
    return end


@compiled
def _compared(
    states: States, i: int, classes: Classes, images: Ints, groups: Words, end: int, most: int
) -> tuple[States, Words]:
    """Fill an orbit that symmetries may leave as it is, or make larger, which is not kept.

    The table is `states`, i the state before; images are those of `_images`; `groups`, uint64[g, w], says which
    symmetries a number of a state stands for; `end` is the number of classes up to the end of the orbit.
    """
    m, number = images.shape[1], states.number[i, 0]
    begin = np.int64(states.words[i, 0] >> LEVEL)
    rows = np.zeros((end - begin + 1, states.words.shape[1]), np.uint64)
    for k in range(rows.shape[1]):
        rows[0, k] = states.words[i, k]
    group = np.int64((rows[0, 0] & GROUPS) >> GROUP)
    rows[0, 0] &= ~GROUPS
    counters, rest, laid = classes.counters, classes.rest, classes.laid
    start = m - rest[begin]
    ties = np.zeros(end - begin + 1, np.int64)
    tied = np.zeros((end - begin + 1, len(images), 2), np.int64)
    for a in range(len(images)):
        if (groups[group, a // 64] >> np.uint64(a % 64)) & np.uint64(1):
            tied[0, ties[0], 0], tied[0, ties[0], 1] = a, start
            ties[0] += 1
    x = np.full(m, -1, np.int64)
    c, v = begin, start
    while v >= start:
        c -= v < m - rest[c]
        first, after, k = m - rest[c], m - rest[c + 1], c - begin
        x[v] += 1
        if x[v] > (most if v == first else min(most, x[v - 1])):
            x[v] = -1
            v -= 1
            continue
        if v + 1 < after:
            v += 1
            continue
        units = counted = 0
        for e in range(first, after):
            units += x[e]
            counted += min(x[e], 2)
        if not step(counters, rest, laid, rows, k, units, counted, most, rows[k + 1]):
            continue
        if not _compare(x, images, tied[k], ties[k], tied[k + 1], ties[k + 1 :], after):
            continue
        if ties[k + 1] and c + 1 < end:
            v += 1
            c += 1
            continue
        if ties[k + 1]:
            groups, still = _group_of(tied[k + 1], ties[k + 1], groups)
            rows[k + 1, 0] |= np.uint64(still) << GROUP
        states = add(states, rows[k + 1], number, 0)
    return states, groups


@compiled
def _compare(x: Ints, images: Ints, before: Ints, ties: int, tied: Ints, left: Ints, full: int) -> bool:
    """Go on comparing a placement with images that were equal so far; return whether none is larger.

    The first `full` joints of the placement x, int64[m], are filled. `before` holds so many symmetries (`ties`)
    and up to where they were compared; those that are still equal are written to `tied`, their number to `left`.
    """
    used = 0
    for i in range(ties):
        a, e = before[i, 0], before[i, 1]
        while e < full and images[a, e] < full and x[images[a, e]] == x[e]:
            e += 1
        if e == full or images[a, e] >= full:
            tied[used, 0], tied[used, 1] = a, e
            used += 1
        elif x[images[a, e]] > x[e]:
            return False
    left[0] = used
    return True


@compiled
def _group_of(tied: Ints, ties: int, groups: Words) -> tuple[Words, int]:
    """Return the number of some symmetries in a list, from 1, with the list, to which they may be added."""
    words = np.zeros((1, groups.shape[1]), np.uint64)
    for i in range(ties):
        words[0, tied[i, 0] // 64] |= np.uint64(1) << np.uint64(tied[i, 0] % 64)
    for g in range(1, len(groups)):
        same = True
        for k in range(groups.shape[1]):
            same &= groups[g, k] == words[0, k]
        if same:
            return groups, g
    return np.concatenate((groups, words)), len(groups)
