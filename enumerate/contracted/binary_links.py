"""Placing binary links on a contracted graph so that no sub-chain becomes rigid; the chains that result, compiled.

A placement gives each joint e of the contracted graph the number x_e of binary links that take its place. A
sub-chain S (links of the contracted graph, with the joints between them) has more than zero freedoms exactly if

    sum over the joints of S of min(x_e, 2)  >=  need(S) = 2 |E(S)| - 3 |S| + 4.

With w = min(x, 2) and W the sum of all w this says that at most W - need(S) of the W units lie *outside* S: so a
partial placement that breaks a condition is seen at once. Units are placed one after another, every condition is a
counter of eight bits that must not fall below zero, and what is still to be placed must fit, too. Units beyond the
second on a joint are free. One placement of each orbit under the automorphisms is kept: with parallel joints in
falling order, the lexicographically largest. A chain has the links of its contracted graph first, then the binary
links, string after string, each from the end whose number is larger. Theory: docs/theory/chains.md.
"""

from typing import NamedTuple

import numpy as np

from enumerate.contracted.graphs import decode
from enumerate.kernel._compiled import compiled, doubled
from enumerate.kernel.labelling import canonical_labels
from enumerate.kernel.words import minus, plus
from graphs.types import Bytes, Flags, Ints, Words

_GUARD = np.uint64(0x8080808080808080)
_ONES = np.uint64(0x0101010101010101)
_LOW = np.uint64(0x7F7F7F7F7F7F7F7F)
_BYTE = np.uint64(0xFF)


class Frame(NamedTuple):
    """The joints of a contracted graph or map of `links` links, on which binary links are placed.

    `ends`, uint8[m, 2], are the links of each joint; `first`, int64[m], is the first of the joints parallel to it.
    `moved`, uint8[a, m], is what symmetries do to joints, keeping the order of parallel ones, `automorphisms`,
    uint8[a, links], what they do to links; the identity comes first. `sets` are the sets of links that could
    become rigid, as bits, the whole one last, and `needs` what each needs (`rigid_sets`).
    """

    ends: Bytes
    first: Ints
    moved: Bytes
    automorphisms: Bytes
    sets: Ints
    needs: Ints
    links: int


class Units(NamedTuple):
    """The binary links that are left to place, at most `most` on a slot.

    `bound` is W, the first and second units on slots: those that the conditions count; `free` are the others.
    """

    bound: int
    free: int
    most: int


class _Range(NamedTuple):
    """The slots among which the next unit is put: from v on, before stop; depth units are placed already."""

    depth: int
    v: int
    stop: int


class PlacementRange(NamedTuple):
    """Which placements on chains of N links are wanted: strings of at most `most` binary links.

    `only`: placements with this number W of bound units only, or `EVERY`.
    """

    links: int
    most: int
    only: int


EVERY = -1
"""No choice of bound units: placements with any number of them."""


@compiled
def slots(adjacency: Bytes, n: int) -> tuple[Bytes, Ints]:
    """Return the joints in the order in which they are filled, parallel ones together.

    Ends, uint8[m, 2], are links a > b; with them, int64[m], comes the first of the joints parallel to each.
    """
    m = int(adjacency.sum()) // 2
    ends = np.zeros((m, 2), np.uint8)
    first = np.zeros(m, np.int64)
    k = 0
    for a in range(n):
        for b in range(a):
            start = k
            for _ in range(adjacency[a, b]):
                ends[k, 0], ends[k, 1], first[k] = a, b, start
                k += 1
    return ends, first


@compiled
def permutations(ends: Bytes, first: Ints, automorphisms: Bytes) -> Bytes:
    """Return what automorphisms do to the joints, keeping the order of parallel ones: uint8[a, m]."""
    n = automorphisms.shape[1]
    m = len(ends)
    start = np.zeros((n, n), np.int64)
    for e in range(m):
        start[ends[e, 0], ends[e, 1]] = start[ends[e, 1], ends[e, 0]] = first[e]
    moved = np.zeros((len(automorphisms), m), np.uint8)
    for a in range(len(automorphisms)):
        for e in range(m):
            u, v = automorphisms[a, ends[e, 0]], automorphisms[a, ends[e, 1]]
            moved[a, e] = start[u, v] + e - first[e]
    return moved


@compiled
def rigid_sets(adjacency: Bytes, n: int) -> tuple[Ints, Ints]:
    """Return the sets of links that could become rigid, and what each needs; the whole set last.

    Only sets that say something: proper sets that need more than nothing, are 2-connected (the conditions of its
    blocks imply that of any other), and hold no smaller set that needs as much. Bit v of a set is set where link v
    belongs to it; a set S needs 2 |E(S)| - 3 |S| + 4.
    """
    score = np.zeros(1 << n, np.int16)  # 2 |E(S)| - 3 |S|, from that of S without its highest link
    found = np.zeros((64, 2), np.int64)
    ends = np.zeros(n, np.int64)
    count = 0
    whole = (1 << n) - 1
    for top in range(n):  # sets whose highest link is `top`
        below = 0
        for v in range(top):
            if adjacency[top, v]:
                ends[below] = v
                below += 1
        for s in range(1 << top, 2 << top):
            degree = 0
            for k in range(below):
                if (s >> ends[k]) & 1:
                    degree += int(adjacency[top, ends[k]])
            score[s] = score[s - (1 << top)] + 2 * degree - 3
            need = np.int64(score[s]) + 4
            if s == whole or (need > 0 and degree > 1 and _says_more(adjacency, n, s, int(need), found[:count])):
                if count == len(found):
                    found = doubled(found)
                found[count, 0], found[count, 1] = s, need
                count += 1
    return found[:count, 0].copy(), found[:count, 1].copy()


@compiled
def _says_more(adjacency: Bytes, n: int, s: int, need: int, found: Ints) -> bool:
    """Tell whether the condition of a set is not implied by those found before: no subset needs as much."""
    for i in range(len(found)):
        if found[i, 1] >= need and found[i, 0] & s == found[i, 0]:
            return False
    for v in range(n):
        if (s >> v) & 1:
            degree = 0
            for u in range(n):
                if (s >> u) & 1:
                    degree += int(adjacency[u, v])
            if degree < 2 or not _connected(adjacency, n, s & ~(1 << v)):
                return False
    return True


@compiled
def _connected(adjacency: Bytes, n: int, s: int) -> bool:
    """Tell whether a set of links is connected."""
    reached = s & -s
    last = 0
    while reached != last:
        new = reached & ~last
        last = reached
        for v in range(n):
            if (new >> v) & 1:
                for u in range(n):
                    if adjacency[u, v]:
                        reached |= (1 << u) & s
    return reached == s


@compiled
def conditions(ends: Bytes, sets: Ints, needs: Ints, total: int) -> tuple[Words, Words]:
    """Return the conditions on placements of W units as counters, eight a word.

    Room, uint64[k], is how many units may lie outside each set, with the guard bit of each counter set; weight,
    uint64[m, k], is what one unit on a joint takes from the counters.
    """
    m = len(ends)
    room = np.zeros((len(sets) + 7) // 8, np.uint64)
    weight = np.zeros((m, len(room)), np.uint64)
    outside = np.zeros(m, np.bool_)
    k = 0
    for i in range(len(sets) - 1):
        free = 0
        for e in range(m):
            outside[e] = not ((sets[i] >> ends[e, 0]) & 1 and (sets[i] >> ends[e, 1]) & 1)
            free += outside[e]
        if total - needs[i] < min(2 * free, total):
            word, shift = k // 8, np.uint64(8 * (k % 8))
            room[word] |= np.uint64(0x80 + max(total - needs[i], 0)) << shift
            for e in range(m):
                weight[e, word] |= np.uint64(outside[e]) << shift
            k += 1
    words = (k + 7) // 8
    for j in range(k, 8 * words):  # counters that nothing takes from
        room[j // 8] |= np.uint64(0x80 + total) << np.uint64(8 * (j % 8))
    return room[:words], weight[:, :words].copy()


@compiled
def no_prefix() -> Ints:
    """Return the empty prefix of a placement."""
    return np.zeros(0, np.int64)


@compiled
def _inside(weight: Words, cost: Ints, total: int) -> Words:
    """Return for each slot how many units the slots from it on can take inside each set, ``total`` at most."""
    m, words = weight.shape
    # A byte for each set: `total` caps it, and is below 128, so that no sum runs over into the next byte.
    inside = np.zeros((m + 1, words), np.uint64)
    for v in range(m - 1, -1, -1):
        for k in range(words):
            for j in range(8):
                shift = np.uint64(8 * j)
                here = np.uint64(cost[v]) - ((weight[v, k] >> shift) & _BYTE)
                most = ((inside[v + 1, k] >> shift) & _BYTE) + np.uint64(2) * here
                inside[v, k] |= min(most, np.uint64(total)) << shift
    return inside


@compiled
def place(
    room: Words,
    weight: Words,
    cost: Ints,
    first: Ints,
    units: Units,
    symmetries: Bytes,
    prefix: Ints,
    out: Bytes,
    fixing: Ints,
) -> int:
    """Count placements, or list them where `out`, uint8[r, m], has rows; only the first r are written.

    Room and weight (of one unit on each slot) are the `conditions`; the cost is the units that one unit on a slot
    stands for, `first` the first slot of its group, whose values must not rise. Symmetries, uint8[a, m], are
    permutations of the slots, the identity first: a placement is kept if none makes it larger, and `fixing`,
    int64[r], gets how many leave it as it is. The prefix is the slots of the first units.
    """
    m = len(cost)
    # Depth-first: `at` holds the slots of the units placed, never falling, `left[depth]` the counters after them.
    bound, free, most = units.bound, units.free, units.most
    inside = _inside(weight, cost, bound)
    left = np.zeros((bound + free + 2, len(room)), np.uint64)
    for k in range(len(room)):
        left[0, k] = room[k]
    at = np.zeros(bound + free + 2, np.int64)
    x = np.zeros(m, np.int64)
    found = depth = start = 0
    quick = len(out) == 0 and len(symmetries) <= 1 and free == 0
    if bound + free == 0:
        return _note(x, len(symmetries), out, fixing, 0)
    while True:
        v, stop = start, m
        if depth < len(prefix):
            v, stop = max(start, prefix[depth]), prefix[depth] + 1
        elif quick and bound == 1:
            found += _count_last(left[depth], weight, cost, first, x, start, most)
            stop = 0
        v = _next(left, inside, weight, cost, first, x, _Range(depth, v, stop), Units(bound, free, most))
        if v < stop:
            free -= cost[v] * (x[v] >= 2)
            bound -= cost[v] * (x[v] < 2)
            x[v] += 1
            at[depth] = v
            depth += 1
            start = v
            if bound + free > 0:
                continue
            fixed = symmetries_fixing(x, symmetries)
            if fixed and depth >= len(prefix):
                found = _note(x, fixed, out, fixing, found)
        if depth == 0:
            return int(found)
        depth -= 1  # take the last unit back and look for the next place for it
        v = at[depth]
        x[v] -= 1
        free += cost[v] * (x[v] >= 2)
        bound += cost[v] * (x[v] < 2)
        start = v + 1


@compiled
def _next(
    left: Words, inside: Words, weight: Words, cost: Ints, first: Ints, x: Ints, among: _Range, units: Units
) -> int:
    """Return the first slot from v on that can take the next unit, ``stop`` if none can; write what it leaves.

    A counter is broken when its guard bit is gone: more units lie outside its set than may.
    """
    words = left.shape[1]
    depth, v, stop = among.depth, among.v, among.stop
    bound, free, most = units.bound, units.free, units.most
    due = np.uint64(bound) * _ONES
    while v < stop:
        broken = np.uint64(0)
        for k in range(words):
            broken |= ~minus(plus(left[depth, k], inside[v, k]), due)
        if broken & _GUARD:  # what is due does not fit inside some set any more, nor outside
            return stop
        if x[v] < most and (first[v] == v or x[v] < x[v - 1]):
            if x[v] >= 2 and cost[v] <= free:
                for k in range(words):
                    left[depth + 1, k] = left[depth, k]
                return v
            if x[v] < 2 and cost[v] <= bound:
                broken = np.uint64(0)
                for k in range(words):
                    left[depth + 1, k] = left[depth, k] - weight[v, k]
                    broken |= ~left[depth + 1, k]
                if broken & _GUARD == 0:
                    return v
        v += 1
    return stop


@compiled
def _note(x: Ints, fixed: int, out: Bytes, fixing: Ints, found: int) -> int:
    """Write a placement where there is room, and count it."""
    if found < len(out):
        for e in range(len(x)):
            out[found, e] = x[e]
        fixing[found] = fixed
    return found + 1


@compiled
def _count_last(left: Words, weight: Words, cost: Ints, first: Ints, x: Ints, start: int, most: int) -> int:
    """Count the slots from ``start`` on that can take the last unit."""
    tight = np.empty_like(left)  # one in each counter that is at zero: adding 127 to it sets no guard bit
    for k in range(len(left)):
        tight[k] = (~((left[k] & _LOW) + _LOW) & _GUARD) >> np.uint64(7)
    found = 0
    for v in range(start, len(cost)):
        if x[v] < min(most, 2) and cost[v] == 1 and (first[v] == v or x[v] < x[v - 1]):
            blocked = np.uint64(0)
            for k in range(len(left)):
                blocked |= weight[v, k] & tight[k]
            found += blocked == 0
    return found


@compiled
def symmetries_fixing(x: Ints, symmetries: Bytes | Ints) -> int:
    """Return 0 if a permutation makes a placement larger, else how many leave it as it is."""
    m = len(x)
    fixed = 0
    for a in range(len(symmetries)):
        e = 0
        while e < m and x[symmetries[a, e]] == x[e]:
            e += 1
        if e == m:
            fixed += 1
        elif x[symmetries[a, e]] > x[e]:
            return 0
    return fixed


@compiled
def frame_of(code: Bytes, n: int) -> Frame:
    """Return the frame of a contracted graph with n links."""
    adjacency = decode(code, n)
    _, automorphisms = canonical_labels(adjacency, n)
    ends, first = slots(adjacency, n)
    sets, needs = rigid_sets(adjacency, n)
    return Frame(ends, first, permutations(ends, first, automorphisms), automorphisms, sets, needs, n)


@compiled
def with_symmetries(frame: Frame, kept: Flags) -> Frame:
    """Return a frame with some of its symmetries only. Frames of maps have no automorphisms, only what they do."""
    automorphisms = frame.automorphisms[kept[: len(frame.automorphisms)]]
    return Frame(frame.ends, frame.first, frame.moved[kept], automorphisms, frame.sets, frame.needs, frame.links)


@compiled
def list_placements(frame: Frame, wanted: PlacementRange, prefix: Ints) -> tuple[Bytes, Ints]:
    """List placements: binary links on each joint, uint8[r, m], and the number of automorphisms of each chain.

    The prefix is the joints of the first units.
    """
    m = len(frame.ends)
    cost = np.ones(m, np.int64)
    units = wanted.links - frame.links
    x, order = np.zeros((0, m), np.uint8), no_prefix()
    for bound in range(max(frame.needs[-1], 0), min(units, 2 * m) + 1):
        if wanted.only not in (EVERY, bound):
            continue
        room, weight = conditions(frame.ends, frame.sets, frame.needs, bound)
        left = Units(bound, units - bound, wanted.most)
        count = place(room, weight, cost, frame.first, left, frame.moved, prefix, x[:0], order[:0])
        more, fixing = np.zeros((count, m), np.uint8), np.zeros(count, np.int64)
        if count:
            place(room, weight, cost, frame.first, left, frame.moved, prefix, more, fixing)
        x, order = np.concatenate((x, more)), np.concatenate((order, fixing))
    for i in range(len(x)):
        order[i] *= _parallel_swaps(frame.first, x[i])
    return x, order


@compiled
def joints_of_all(frame: Frame, x: Bytes) -> Ints:
    """Return the joints of the chains of placements with equally many binary links: int64[r, J, 2]."""
    rows, m = x.shape
    binary = 0
    for e in range(m):
        binary += int(x[0, e])
    joints = np.empty((rows, m + binary, 2), np.int64)
    for r in range(rows):
        link, k = frame.links, 0
        for e in range(m):
            joints[r, k, 0] = frame.ends[e, 0]
            for _ in range(x[r, e]):
                joints[r, k, 1] = joints[r, k + 1, 0] = link
                link += 1
                k += 1
            joints[r, k, 1] = frame.ends[e, 1]
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
def link_symmetries(frame: Frame, links: int, x: Bytes) -> Ints:
    """Return permutations of the links of a chain that generate its automorphisms: int64[g, links].

    Those of the contracted graph that leave the placement as it is, then the exchanges of two neighbouring
    parallel strings of equal length.
    """
    ends, first, moved, automorphisms = frame.ends, frame.first, frame.moved, frame.automorphisms
    m, n = len(ends), frame.links
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
                found[k, offset[e] + i] = offset[f] + (int(x[e]) - 1 - i if turned else i)
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
def orbits_of_all(frame: Frame, links: int, x: Bytes) -> Ints:
    """Return the orbits of links of the chains of placements, as `orbits_of` gives them: int64[r, links]."""
    orbits = np.empty((len(x), links), np.int64)
    for r in range(len(x)):
        least = orbits_of(link_symmetries(frame, links, x[r]))
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
