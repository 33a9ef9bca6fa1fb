"""From placements to chains: joints, symmetries, orbits of links and graph6, compiled.

A chain has the links of its contracted graph first, then the binary links, string after string; the links of a
string are counted from the end whose number is larger. Theory: docs/theory/chains.md.
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
from graphs.types import Bytes, Ints

__all__ = [
    "frame_of",
    "graph6_rows",
    "joints_of_all",
    "list_placements",
    "orbits_of",
    "orbits_of_all",
    "placements_of",
    "symmetries_of",
]


@compiled
def frame_of(code: Bytes, n: int) -> tuple[Bytes, Ints, Bytes, Bytes]:
    """Return of a contracted graph its joints, first parallel joints, their permutations and automorphisms."""
    adjacency = decode(code, n)
    _, automorphisms = canonical_labels(adjacency, n)
    ends, first = slots(adjacency, n)
    return ends, first, permutations(ends, first, automorphisms), automorphisms


@compiled
def placements_of(code: Bytes, n: int, links: int, most: int, only: int, prefix: Ints) -> tuple[Bytes, Ints]:
    """List the placements of binary links on a contracted graph: binary links on each joint, uint8[r, m].

    With them comes the number of automorphisms of each chain. Arguments are those of
    `enumerate.chains.counting.count_of_graph`.
    """
    ends, first, moved, _ = frame_of(code, n)
    sets, needs = rigid_sets(decode(code, n), n)
    return list_placements(ends, first, moved, sets, needs, n, Wanted(links, most, only), prefix)


@compiled
def list_placements(
    ends: Bytes, first: Ints, moved: Bytes, sets: Ints, needs: Ints, n: int, wanted: Wanted, prefix: Ints
) -> tuple[Bytes, Ints]:
    """List the placements on joints with given symmetries, as `placements_of` does for a graph."""
    m = len(ends)
    cost = np.ones(m, np.int64)
    links = wanted.links
    least, last = max(needs[-1], 0), min(links - n, 2 * m)
    x, order = np.zeros((0, m), np.uint8), no_prefix()
    used = 0
    for bound in range(least, last + 1):
        if wanted.only not in (EVERY, bound):
            continue
        room, weight = conditions(ends, sets, needs, bound)
        units = Units(bound, links - n - bound, wanted.most)
        count = place(room, weight, cost, first, units, moved, prefix, x[:0], order[:0])
        more, fixing = np.zeros((used + count, m), np.uint8), np.zeros(used + count, np.int64)
        for i in range(used):
            fixing[i] = order[i]
            for e in range(m):
                more[i, e] = x[i, e]
        if count:
            place(room, weight, cost, first, units, moved, prefix, more[used:], fixing[used:])
        x, order, used = more, fixing, used + count
    for i in range(used):
        order[i] *= _parallel_swaps(first, x[i])
    return x, order


@compiled
def joints_of_all(ends: Bytes, n: int, x: Bytes) -> Ints:
    """Return the joints of the chains of placements with equally many binary links: int64[r, J, 2]."""
    rows, m = x.shape
    binary = 0
    for e in range(m):
        binary += x[0, e]
    joints = np.empty((rows, m + binary, 2), np.int64)
    for r in range(rows):
        link, k = n, 0
        for e in range(m):
            joints[r, k, 0] = ends[e, 0]
            for _ in range(x[r, e]):
                joints[r, k, 1] = joints[r, k + 1, 0] = link
                link += 1
                k += 1
            joints[r, k, 1] = ends[e, 1]
            k += 1
    return joints


@compiled
def _parallel_swaps(first: Ints, x: Bytes) -> int:
    """Return the number of ways to permute parallel strings of equal length."""
    product = run = 1
    for e in range(1, len(first)):
        run = run + 1 if first[e] != e and x[e] == x[e - 1] else 1
        product *= run
    return product


@compiled
def symmetries_of(ends: Bytes, first: Ints, moved: Bytes, automorphisms: Bytes, links: int, x: Bytes) -> Ints:
    """Return permutations of the links of a chain that generate its automorphisms: int64[g, links].

    Those of the contracted graph that leave the placement as it is, then the exchanges of two neighbouring
    parallel strings of equal length.
    """
    m, n = len(ends), automorphisms.shape[1]
    offset = np.empty(m, np.int64)
    offset[0] = n
    for e in range(1, m):
        offset[e] = offset[e - 1] + x[e - 1]
    found = np.empty((len(automorphisms) + m, links), np.int64)
    k = 0
    for a in range(len(automorphisms)):
        e = 0
        while e < m and x[moved[a, e]] == x[e]:
            e += 1
        if e < m:
            continue
        for v in range(n):
            found[k, v] = automorphisms[a, v]
        for e in range(m):
            f = moved[a, e]
            turned = automorphisms[a, ends[e, 0]] != ends[f, 0]
            for i in range(x[e]):
                found[k, offset[e] + i] = offset[f] + (x[e] - 1 - i if turned else i)
        k += 1
    for e in range(1, m):
        if first[e] != e and x[e] == x[e - 1]:
            for v in range(links):
                found[k, v] = v
            for i in range(x[e]):
                found[k, offset[e] + i] = offset[e - 1] + i
                found[k, offset[e - 1] + i] = offset[e] + i
            k += 1
    return found[:k]


@compiled
def orbits_of(generators: Ints) -> Ints:
    """Return for each of n things the least one of its orbit under permutations int64[g, n]."""
    n = generators.shape[1]
    least = np.arange(n)
    changed = True
    while changed:
        changed = False
        for g in range(len(generators)):
            for v in range(n):
                a, b = least[v], least[generators[g, v]]
                if a != b:
                    least[v] = least[generators[g, v]] = min(a, b)
                    changed = True
    return least


@compiled
def orbits_of_all(ends: Bytes, first: Ints, moved: Bytes, automorphisms: Bytes, links: int, x: Bytes) -> Ints:
    """Return the orbits of links of the chains of placements, as `orbits_of` gives them: int64[r, links]."""
    orbits = np.empty((len(x), links), np.int64)
    for r in range(len(x)):
        least = orbits_of(symmetries_of(ends, first, moved, automorphisms, links, x[r]))
        for v in range(links):
            orbits[r, v] = least[v]
    return orbits


@compiled
def graph6_rows(joints: Ints, labels: Ints) -> Bytes:
    """Return graph6 lines of simple graphs whose nodes are renamed: uint8[r, length].

    Labels, int64[r, N], are the new names of the nodes, 0 to N - 1.
    """
    rows, n = labels.shape
    head = 1 if n <= 62 else 4
    size = (n * (n - 1) // 2 + 5) // 6
    text = np.full((rows, head + size), 63, np.uint8)
    for r in range(rows):
        if head == 1:
            text[r, 0] += n
        else:
            text[r, 0] = 126
            for k in range(3):
                text[r, 1 + k] += (n >> (6 * (2 - k))) & 63
        for k in range(joints.shape[1]):
            u, v = labels[r, joints[r, k, 0]], labels[r, joints[r, k, 1]]
            if u < v:
                u, v = v, u
            place = u * (u - 1) // 2 + v
            text[r, head + place // 6] += 32 >> (place % 6)
    return text
