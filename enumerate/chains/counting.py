"""Counting chains without listing them, by orbits and by Burnside's lemma, compiled.

Both walk the contracted graphs. *Orbits*: of the placements on a graph, those are counted that no automorphism
makes larger (`enumerate.contracted.orbits`). *Burnside*: the number of orbits is the mean, over the automorphisms,
of the number of placements that an automorphism leaves as they are; these are the placements on the cycles of
joints, so no placement is ever compared with another (`enumerate.contracted.left_in_place`). Theory:
docs/theory/chains.md.
"""

from __future__ import annotations

import numpy as np

from enumerate.contracted.binary_links import (
    EVERY,
    PlacementRange,
    Units,
    conditions,
    frame_of,
    no_prefix,
    place,
    rigid_sets,
)
from enumerate.contracted.graphs import decode
from enumerate.contracted.left_in_place import Cycles, count_left_in_place, cycles_of
from enumerate.contracted.orbits import count_orbits, count_with_a_link
from enumerate.contracted.states import order_of_classes
from enumerate.kernel.compiled import compiled, number_of_orbits
from graphs.types import Bytes, Ints

__all__ = [
    "count_by_burnside",
    "count_by_orbits",
    "count_fixed",
    "count_in",
    "count_inversions_by_orbits",
    "count_of_graph",
]


@compiled
def count_by_orbits(codes: Bytes, n: int, links: int, most: int) -> int:
    """Return the number of chains that come from some contracted graphs, one of each orbit of placements.

    Parameters
    ----------
    codes : uint8[k, m]
        Contracted graphs.
    n : int
        Their number of links.
    links : int
        Number of links N of the chains.
    most : int
        The longest string of binary links to allow.
    """
    total = 0
    for c in range(len(codes)):
        ends, first, moved, _ = frame_of(codes[c], n)
        sets, needs = rigid_sets(decode(codes[c], n), n)
        total += count_orbits(ends, first, moved, sets, needs, links - n, most)
    return total


@compiled
def count_inversions_by_orbits(codes: Bytes, n: int, links: int, most: int) -> int:
    """Return the number of pairs of a chain and a link of it, up to isomorphism. Parameters: `count_by_orbits`."""
    total = 0
    for c in range(len(codes)):
        ends, first, moved, automorphisms = frame_of(codes[c], n)
        sets, needs = rigid_sets(decode(codes[c], n), n)
        total += count_with_a_link(ends, first, moved, automorphisms, sets, needs, links - n, most)
    return total


@compiled
def count_of_graph(code: Bytes, n: int, links: int, most: int, only: int, prefix: Ints) -> int:
    """Return the number of chains of one contracted graph that begin in one way.

    `only`: placements with this number W of bound units only, or `EVERY`; `prefix`: where the first units lie.
    """
    ends, first, moved, _ = frame_of(code, n)
    sets, needs = rigid_sets(decode(code, n), n)
    return count_in(ends, first, moved, sets, needs, n, PlacementRange(links, most, only), prefix)


@compiled
def count_in(
    ends: Bytes, first: Ints, moved: Bytes, sets: Ints, needs: Ints, n: int, wanted: PlacementRange, prefix: Ints
) -> int:
    """Return the number of placements on joints with given symmetries.

    Joints, first parallel ones, and permutations of the joints are those of `enumerate.contracted.binary_links`,
    sets and needs those that its `rigid_sets` returns.
    """
    total, links = 0, wanted.links
    if wanted.only == EVERY and len(prefix) == 0:
        return count_orbits(ends, first, moved, sets, needs, links - n, wanted.most)
    nothing, nowhere = np.zeros((0, len(ends)), np.uint8), no_prefix()
    cost = np.ones(len(ends), np.int64)
    for bound in range(max(needs[-1], 0), min(links - n, 2 * len(ends)) + 1):
        if wanted.only in (EVERY, bound):
            room, weight = conditions(ends, sets, needs, bound)
            units = Units(bound, links - n - bound, wanted.most)
            total += place(room, weight, cost, first, units, moved, prefix, nothing, nowhere)
    return total


@compiled
def count_fixed(
    moved: Bytes, ends: Bytes, first: Ints, sets: Ints, needs: Ints, n: int, links: int, most: int
) -> int:
    """Return the number of placements that a permutation of the joints leaves as they are."""
    order = order_of_classes(ends, first, moved.reshape(1, -1), sets)
    cycles = cycles_of(moved, np.arange(n).astype(np.uint8), ends, first, order, sets)
    return _in_place(cycles, needs, links - n, most)[0]


@compiled
def _in_place(cycles: Cycles, needs: Ints, units: int, most: int) -> tuple[int, int]:
    """Return the number of placements of so many binary links on cycles of joints, and of links that stay."""
    total = still = 0
    for bound in range(max(needs[-1], 0), min(units, 2 * cycles.cost.sum()) + 1):
        placements, links = count_left_in_place(cycles, needs, bound, units - bound, most)
        total += placements
        still += links
    return total, still


@compiled
def count_by_burnside(codes: Bytes, n: int, links: int, most: int, inversions: bool) -> int:
    """Return the number of chains, or of inversions, that come from some contracted graphs, by Burnside's lemma.

    Parameters
    ----------
    codes, n, links, most
        As for `count_by_orbits`.
    inversions : bool
        Count pairs of a chain and a link of it, up to isomorphism.
    """
    total = 0
    for c in range(len(codes)):
        ends, first, moved, automorphisms = frame_of(codes[c], n)
        sets, needs = rigid_sets(decode(codes[c], n), n)
        order = order_of_classes(ends, first, moved[:1], sets)
        fixed = 0
        for a in range(len(moved)):
            cycles = cycles_of(moved[a], automorphisms[a], ends, first, order, sets)
            placements, still = _in_place(cycles, needs, links - n, most)
            fixed += placements
            if inversions:
                fixed += still - placements
                for v in range(n):
                    fixed += placements * (automorphisms[a, v] == v)
        total += number_of_orbits(fixed, len(moved))
    return total
