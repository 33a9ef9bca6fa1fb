"""Counting chains without listing them, by orbits and by Burnside's lemma, compiled.

Both walk the contracted graphs. *Orbits*: of the placements on a graph, those are counted that no automorphism
makes larger. *Burnside*: the number of orbits is the mean, over the automorphisms, of the number of placements
that an automorphism leaves as they are; these are the placements on the cycles of joints, so no placement is ever
compared with another. Theory: docs/theory/chains.md.
"""

from __future__ import annotations

import numpy as np

from enumerate.contracted.binary_links import (
    EVERY,
    Units,
    Wanted,
    conditions,
    no_prefix,
    permutations,
    place,
    rigid_sets,
    slots,
)
from enumerate.contracted.graphs import decode
from enumerate.kernel.compiled import compiled
from enumerate.kernel.labelling import canonical_labels
from graphs.arrays import Bytes, Ints, Words

__all__ = ["count_by_burnside", "count_by_orbits", "count_fixed", "count_in", "count_of_graph"]


@compiled
def count_by_orbits(codes: Bytes, n: int, links: int, most: int) -> int:
    """Return the number of chains that come from some contracted graphs, by a test of each placement.

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
        total += count_of_graph(codes[c], n, links, most, EVERY, no_prefix())
    return total


@compiled
def count_of_graph(code: Bytes, n: int, links: int, most: int, only: int, prefix: Ints) -> int:
    """Return the number of chains of one contracted graph that begin in one way.

    Parameters
    ----------
    code, n, links, most
        As for `count_by_orbits`.
    only : int
        Placements with this number W of bound units only; `EVERY` for all.
    prefix : int64[p]
        Where the first units lie.
    """
    adjacency = decode(code, n)
    _, automorphisms = canonical_labels(adjacency, n)
    ends, first = slots(adjacency, n)
    sets, needs = rigid_sets(adjacency, n)
    moved = permutations(ends, first, automorphisms)
    return count_in(ends, first, moved, sets, needs, n, Wanted(links, most, only), prefix)


@compiled
def count_in(
    ends: Bytes, first: Ints, moved: Bytes, sets: Ints, needs: Ints, n: int, wanted: Wanted, prefix: Ints
) -> int:
    """Return the number of placements on joints with given symmetries.

    Parameters
    ----------
    ends, first, moved
        Joints, first parallel ones, and permutations of the joints: `enumerate.contracted.binary_links`.
    sets, needs
        As `enumerate.contracted.binary_links.rigid_sets` returns them.
    n, prefix
        As for `count_of_graph`.
    wanted : Wanted
    """
    total, links = 0, wanted.links
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
    total = 0
    for bound in range(max(needs[-1], 0), min(links - n, 2 * len(ends)) + 1):
        room, weight = conditions(ends, sets, needs, bound)
        cost, start, share, _ = _cycles(moved, first, weight)
        same = np.arange(len(cost)).astype(np.uint8).reshape(1, -1)
        nothing, nowhere = np.zeros((0, len(cost)), np.uint8), no_prefix()
        units = Units(bound, links - n - bound, most)
        total += place(room, share, cost, start, units, same, no_prefix(), nothing, nowhere)
    return total


@compiled
def _cycles(moved: Bytes, first: Ints, weight: Words) -> tuple[Ints, Ints, Words, Ints]:
    """Return the cycles of a permutation of joints as slots: cost, first of the group, weight, a joint of each."""
    m, words = weight.shape
    cost = np.zeros(m, np.int64)
    start = np.zeros(m, np.int64)
    total = np.zeros((m, words), np.uint64)
    joint = np.zeros(m, np.int64)
    slot = np.full(m, -1, np.int64)
    k = 0
    for e in range(m):
        if slot[e] >= 0:
            continue
        joint[k] = e
        start[k] = k if first[e] == e else slot[first[e]]
        f = e
        while slot[f] < 0:
            slot[f] = k
            cost[k] += 1
            total[k] += weight[f]
            f = moved[f]
        k += 1
    return cost[:k], start[:k], total[:k], joint[:k]


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
        adjacency = decode(codes[c], n)
        _, automorphisms = canonical_labels(adjacency, n)
        ends, first = slots(adjacency, n)
        sets, needs = rigid_sets(adjacency, n)
        moved = permutations(ends, first, automorphisms)
        fixed, simple = 0, True
        for e in range(len(ends)):
            simple &= first[e] == e
        for bound in range(max(needs[-1], 0), min(links - n, 2 * len(ends)) + 1):
            room, weight = conditions(ends, sets, needs, bound)
            units = Units(bound, links - n - bound, most)
            for a in range(len(moved)):
                cost, start, share, joint = _cycles(moved[a], first, weight)
                nothing, nowhere = np.zeros((0, len(cost)), np.uint8), no_prefix()
                count = place(room, share, cost, start, units, moved[:1], no_prefix(), nothing, nowhere)
                if not inversions:
                    fixed += count
                elif a == 0 and simple:
                    fixed += count * links
                elif count:
                    x, swaps = np.zeros((count, len(cost)), np.uint8), np.zeros(count, np.int64)
                    place(room, share, cost, start, units, moved[:1], no_prefix(), x, swaps)
                    for i in range(count):
                        fixed += _fixed_links(x[i], joint, start, ends, first, moved[a], automorphisms[a])
        total += fixed // len(moved)
    return total


@compiled
def _fixed_links(
    x: Bytes, joint: Ints, start: Ints, ends: Bytes, first: Ints, moved: Bytes, automorphism: Bytes
) -> int:
    """Return how many links an automorphism leaves in place, in the mean over the orders of parallel strings.

    Of equal parallel strings that are permuted among themselves, one stays in the mean; of a string that is turned
    round, the link in the middle.
    """
    fixed = 0
    for v in range(len(automorphism)):
        fixed += automorphism[v] == v
    for k in range(len(joint)):
        e = joint[k]
        if moved[first[e]] != first[e] or (start[k] != k and x[k] == x[k - 1]):
            continue
        fixed += x[k] if automorphism[ends[e, 0]] == ends[e, 0] else x[k] % 2
    return fixed
