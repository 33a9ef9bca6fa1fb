"""Placements of open edges counted up to symmetry without making them: Burnside's lemma, compiled.

The second method beside `enumerate.scd.listing`: a placement that a symmetry leaves as it is, is constant on the
cycles of corners, and a cycle of links is as free as one of its links. Theory: docs/theory/scd-enumeration.md.
"""

from __future__ import annotations

import numpy as np

from enumerate.kernel.burnside import number_of_orbits
from enumerate.kernel.compiled import compiled
from enumerate.scd.choices import (
    TOO_MANY,
    all_explicit,
    corner_states,
    drawn,
    explicit_sets,
    forced_mobility,
    room_of,
    symmetries_of,
)
from enumerate.scd.patterns import CLOSED, patterns
from graphs.types import Bytes, Flags, Ints

__all__ = ["count_placements"]


@compiled
def count_placements(code: Bytes, labels: Ints, most: int, dof: int, sheets: bool) -> int:
    """Return the number of placements up to symmetry, -1 if it is past counting.

    The arguments are those of `enumerate.scd.listing.list_placements_of`.
    """
    turn, vertex, face, kinds, number = drawn(code, labels)
    symmetries = symmetries_of(turn, vertex, face, kinds)
    sets = explicit_sets(kinds, number)
    allowed = patterns(turn, vertex, face, kinds, number, most)
    fixed = 0
    for p in range(len(allowed)):
        if forced_mobility(turn, face, kinds, number, allowed[p]) != dof:
            continue
        for explicit in sets:
            if sheets and not all_explicit(kinds, explicit):
                continue
            states = corner_states(face, kinds, allowed[p], explicit)
            for a in range(len(symmetries)):
                count = _fixed_by(vertex, states, symmetries[a], most)
                if count < 0 or fixed > TOO_MANY:
                    return -1
                fixed += count
    return number_of_orbits(fixed, len(symmetries))


@compiled
def _fixed_by(vertex: Ints, states: Bytes, symmetry: Ints, most: int) -> int:
    """Return the number of placements of one choice that a symmetry leaves as they are; -1 if past counting."""
    for d in range(len(vertex)):
        if states[symmetry[d]] != states[d]:
            return 0
    slots, low, high = room_of(vertex, states, most)
    done = np.zeros(len(slots), np.bool_)
    product = 1
    for v in range(len(slots)):
        if done[v]:
            continue
        total = _ways_in_cycles(vertex, states, symmetry, v, low[v], high[v], done)
        if total == 0:
            return 0
        if product > TOO_MANY // total:
            return -1
        product *= total
    return product


@compiled
def _ways_in_cycles(
    vertex: Ints, states: Bytes, symmetry: Ints, link: int, low: int, high: int, done: Flags
) -> int:
    """Return in how many ways a link takes low to high open edges that a symmetry leaves as they are.

    The links in its cycle are noted in ``done``.
    """
    ways = np.zeros(max(high, 0) + 1, np.int64)  # with so many open edges
    ways[0] = 1
    seen = np.zeros(len(vertex), np.bool_)
    for d in range(len(vertex)):
        if vertex[d] != link or seen[d]:
            continue
        weight, e = 0, d
        while not seen[e]:
            seen[e] = done[vertex[e]] = True
            weight += vertex[e] == link
            e = symmetry[e]
        if states[d] != CLOSED:
            for k in range(weight, len(ways)):
                ways[k] += ways[k - weight]
    total = 0
    for k in range(low, high + 1):
        total += ways[k]
    return total
