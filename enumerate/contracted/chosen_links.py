"""Placements with a link chosen, counted up to symmetry without being made, compiled: inversions by orbits.

A link is one of the contracted graph, or one of a string. Of links that symmetries take to each other one is
looked at, and then only the symmetries count that leave it where it is, or its class of parallel joints. Where
there are none but the identity, a link of the graph is chosen with every placement, and those of strings are
added up while placements are (`enumerate.contracted.states`). Where there are some, a link of the graph leaves
placements with fewer symmetries (`enumerate.contracted.orbits`), and a string that is chosen from leaves them on
the other joints: what it holds is taken off the needs. Nothing is shared with the count of inversions by
Burnside's lemma. Theory: docs/theory/chains.md.
"""

from __future__ import annotations

import numpy as np

from enumerate.contracted.classes import classes_in_order, lies_in, order_of_classes, strings_of_classes
from enumerate.contracted.orbits import count_orbits
from enumerate.contracted.states import beginning, filled, total_at_end
from enumerate.kernel.compiled import compiled
from graphs.types import Bytes, Flags, Ints

__all__ = ["count_with_a_link"]

_NONE = np.uint64(0)


@compiled
def count_with_a_link(
    ends: Bytes, first: Ints, moved: Bytes, automorphisms: Bytes, sets: Ints, needs: Ints, units: int, most: int
) -> int:
    """Return the number of placements of binary links (`units`) with a link chosen, one of each orbit.

    Joints, first parallel ones, and what automorphisms do to joints and to links are those of
    `enumerate.contracted.listing.frame_of`, sets and needs those of
    `enumerate.contracted.binary_links.rigid_sets`. No joint holds more than `most`.
    """
    total = alone = 0
    for v in range(automorphisms.shape[1]):
        if automorphisms[:, v].min() == v:  # the first of its orbit
            still = automorphisms[:, v] == v
            if still.sum() == 1:
                alone += 1
            else:
                total += count_orbits(ends, first, _those(moved, still), sets, needs, units, most)
    free = np.zeros(len(ends), np.bool_)  # classes that no symmetry leaves as they are
    for e in range(len(ends)):
        if first[e] == e and moved[:, e].min() == e:
            still = moved[:, e] == e
            if still.sum() == 1:
                free[e] = True
            else:
                of_class = _those(moved, still), _those(automorphisms, still)
                total += _with_a_string(ends, first, *of_class, e, sets, needs, units, most)
    placements, chosen = _without_symmetries(ends, first, free, sets, needs, units, most)
    return total + alone * placements + chosen


@compiled
def _those(rows: Bytes, kept: Flags) -> Bytes:
    """Return some of the rows."""
    found = np.empty((kept.sum(), rows.shape[1]), np.uint8)
    used = 0
    for a in range(len(rows)):
        if kept[a]:
            for k in range(rows.shape[1]):
                found[used, k] = rows[a, k]
            used += 1
    return found


@compiled
def _without_symmetries(
    ends: Bytes, first: Ints, chosen_from: Flags, sets: Ints, needs: Ints, units: int, most: int
) -> tuple[int, int]:
    """Return the number of all placements, and of all links that can be chosen in some classes of all of them.

    `chosen_from`, bool[m], is set at the first joint of those classes.
    """
    identity = np.arange(len(ends)).astype(np.uint8).reshape(1, -1)
    order = order_of_classes(ends, first, identity, sets)
    classes = classes_in_order(ends, first, order, sets, needs, units, most)
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
def _with_a_string(
    ends: Bytes,
    first: Ints,
    moved: Bytes,
    automorphisms: Bytes,
    e: int,
    sets: Ints,
    needs: Ints,
    units: int,
    most: int,
) -> int:
    """Return the number of placements with a link chosen from a string of one class, one of each orbit.

    Symmetries that exchange the ends of the class turn the string round. Its middle link stays, so it is chosen
    with placements up to all symmetries; of the others one half is exchanged with the other, so those of one half
    are chosen, up to the symmetries that turn nothing. Permutations `moved` and `automorphisms` are those of the
    symmetries that leave the class, with first joint e, where it is.
    """
    turning = automorphisms[:, ends[e, 0]] != ends[e, 0]
    turned = turning.any()
    last = e
    while last + 1 < len(ends) and first[last + 1] == e:
        last += 1
    others, alike, images = _without_joint(ends, first, moved, last)
    straight = _those(images, ~turning)
    total = 0
    for length in range(1, min(most, units) + 1):
        left = needs.copy()
        for i in range(len(sets)):
            left[i] -= min(length, 2) * lies_in(ends, e, sets[i])
        choices = length // 2 if turned else length  # of two links that are exchanged one
        if choices:
            total += choices * count_orbits(others, alike, straight, sets, left, units - length, most)
        if turned and length % 2:
            total += count_orbits(others, alike, images, sets, left, units - length, most)
    return total


@compiled
def _without_joint(ends: Bytes, first: Ints, moved: Bytes, joint: int) -> tuple[Bytes, Ints, Bytes]:
    """Return ends, first parallel joints and permutations of the other joints; none moves this one.

    The joint is the last of its class.
    """
    m = len(ends)
    others, alike = np.empty((m - 1, 2), np.uint8), np.empty(m - 1, np.int64)
    images = np.empty((len(moved), m - 1), np.uint8)
    for e in range(m - 1):
        old = e + (e >= joint)
        others[e, 0], others[e, 1] = ends[old, 0], ends[old, 1]
        alike[e] = first[old] - (first[old] > joint)
        for a in range(len(moved)):
            images[a, e] = moved[a, old] - (moved[a, old] > joint)
    return others, alike, images
