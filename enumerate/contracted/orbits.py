"""Placements counted up to symmetry, compared with their images only where they may equal some, compiled.

Of each orbit the lexicographically largest placement is meant. Classes of joints are filled orbit after orbit:
when one is full, a symmetry has left it as it is, or made it smaller and says nothing more, or larger, which ends
the branch. So placements for which the same symmetries are left, and sets of links need the same, are one state
(`enumerate.contracted.states`); only inside an orbit are placements made. Inversions are placements with a link
chosen, one of each orbit of links, counted under the symmetries that leave it where it is; a string that is chosen
from is taken off the needs. Nothing is shared with the count by Burnside's lemma. Theory: docs/theory/chains.md.
"""

import numpy as np

from enumerate.contracted.binary_links import Frame, with_symmetries
from enumerate.contracted.states import (
    GROUP,
    GROUPS,
    LEVEL,
    Classes,
    PlacementStates,
    add,
    beginning,
    classes_in_order,
    filled,
    lies_in,
    order_of_classes,
    step,
    strings_of_classes,
    total_at_end,
)
from enumerate.kernel._compiled import compiled
from graphs.types import Bytes, Flags, Ints, Words


@compiled
def count_orbits(frame: Frame, units: int, most: int) -> int:
    """Return the number of placements of so many binary links, at most `most` on a joint, one of each orbit."""
    order = order_of_classes(frame, frame.moved)
    classes = classes_in_order(frame, order, units, most)
    strings = strings_of_classes(classes.size.max(), units, most)
    images = _images(classes, frame.moved)
    groups = np.zeros((2, (len(images) + 63) // 64), np.uint64)  # sets of symmetries: 0 is empty, 1 has all
    for a in range(len(images)):
        groups[1, a // 64] |= np.uint64(1) << np.uint64(a % 64)
    states = beginning(classes, units, int(len(images) > 0))
    ends_of = _ends_of_orbits(classes, images)
    for level in range(len(order)):
        if ends_of[level] == level + 1:  # a class that no symmetry takes to another: its strings have no order
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
    states: PlacementStates, i: int, classes: Classes, images: Ints, groups: Words, end: int, most: int
) -> tuple[PlacementStates, Words]:
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
    # All values of the joints of the orbit are tried: joint v of class c gets its next one, or v goes back.
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
    # A comparison stops at the first joint whose image is not yet filled, and goes on from there later.
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
        if (groups[g] == words[0]).all():
            return groups, g
    return np.concatenate((groups, words)), len(groups)


_NONE = np.uint64(0)


@compiled
def count_with_a_link(frame: Frame, units: int, most: int) -> int:
    """Return the number of placements with a link chosen, one of each orbit. Arguments: `count_orbits`."""
    total = alone = 0
    for v in range(frame.links):
        if frame.automorphisms[:, v].min() == v:  # the first of its orbit
            still = frame.automorphisms[:, v] == v
            if still.sum() == 1:
                alone += 1
            else:
                total += count_orbits(with_symmetries(frame, still), units, most)
    free = np.zeros(len(frame.ends), np.bool_)  # classes that no symmetry leaves as they are
    for e in range(len(free)):
        if frame.first[e] == e and frame.moved[:, e].min() == e:
            still = frame.moved[:, e] == e
            if still.sum() == 1:
                free[e] = True
            else:
                total += _with_a_string(with_symmetries(frame, still), e, units, most)
    placements, chosen = _without_symmetries(frame, free, units, most)
    return total + alone * placements + chosen


@compiled
def _without_symmetries(frame: Frame, chosen_from: Flags, units: int, most: int) -> tuple[int, int]:
    """Return the number of all placements, and of all links that can be chosen in some classes of all of them.

    `chosen_from`, bool[m], is set at the first joint of those classes.
    """
    order = order_of_classes(frame, frame.moved[:1])
    classes = classes_in_order(frame, order, units, most)
    start, ways = strings_of_classes(classes.size.max(), units, most)
    passed_by = ways.copy()
    for way in range(len(ways)):
        passed_by[way, 3] = 0
    states = beginning(classes, units, 0)
    for level in range(len(order)):
        strings = start, ways if chosen_from[order[level]] else passed_by
        states = filled(states, classes, level, strings, most, _NONE)
    return total_at_end(states)


@compiled
def _with_a_string(frame: Frame, e: int, units: int, most: int) -> int:
    """Return the number of placements with a link chosen from a string of one class, one of each orbit.

    Symmetries that exchange the ends of the class turn the string round. Its middle link stays, so it is chosen
    with placements up to all symmetries; of the others one half is exchanged with the other, so those of one half
    are chosen, up to the symmetries that turn nothing. The symmetries of the frame are those that leave the class,
    with first joint e, where it is.
    """
    turning = frame.automorphisms[:, frame.ends[e, 0]] != frame.ends[e, 0]
    turned = turning.any()
    last = e
    while last + 1 < len(frame.ends) and frame.first[last + 1] == e:
        last += 1
    total = 0
    for length in range(1, min(most, units) + 1):
        needs = frame.needs.copy()
        for i in range(len(needs)):
            needs[i] -= min(length, 2) * lies_in(frame.ends, e, frame.sets[i])
        others = _without_joint(frame, last, needs)
        choices = length // 2 if turned else length  # of two links that are exchanged one
        if choices:
            total += choices * count_orbits(with_symmetries(others, ~turning), units - length, most)
        if turned and length % 2:
            total += count_orbits(others, units - length, most)
    return total


@compiled
def _without_joint(frame: Frame, joint: int, needs: Ints) -> Frame:
    """Return a frame without a joint that no symmetry moves, the last of its class, and with other needs."""
    ends, first, moved = frame.ends, frame.first, frame.moved
    m = len(ends)
    others, alike = np.empty((m - 1, 2), np.uint8), np.empty(m - 1, np.int64)
    images = np.empty((len(moved), m - 1), np.uint8)
    for e in range(m - 1):
        old = e + (e >= joint)
        others[e, 0], others[e, 1] = ends[old, 0], ends[old, 1]
        alike[e] = first[old] - (first[old] > joint)
        for a in range(len(moved)):
            images[a, e] = moved[a, old] - (moved[a, old] > joint)
    return Frame(others, alike, images, frame.automorphisms, frame.sets, needs, frame.links)
