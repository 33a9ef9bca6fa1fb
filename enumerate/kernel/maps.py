"""Maps: link-joint graphs drawn on the sphere; their faces, canonical codes and symmetries, compiled.

Joint k has two *darts*, 2k and 2k + 1, one at each of its links; the other dart of d is ``d ^ 1``. A map is

    turn : int64[2, D]
        The next dart counter-clockwise, and clockwise, about the same link.
    vertex : int64[D]
        The link of each dart.

A *corner* is the part of a link between a dart d and the next one counter-clockwise; it has the number d and
lies in the face on the left of d. Open edges lie in corners.

A *code* reads a map off breadth-first: from a root dart, link by link in the order in which they are met, the
sides of each in their cyclic order, beginning with the joint by which it was met. Joints are numbered as they
come, so every one occurs twice. A map may be read counter-clockwise or clockwise; the canonical code is the
least over all allowed roots and both senses, and the roots that give it are the symmetries. The text form is in
`graphs.identity.drawings`. Theory: docs/theory/map-codes.md.
"""

from typing import NamedTuple

import numpy as np

from enumerate.kernel._compiled import compiled, doubled
from graphs.types import Bytes, Ints

# Symbols of a code. The least code counts, so their order is part of all codes, as in `graphs.identity.drawings`.
OPEN = 0  # an open edge
END = 1  # the end of a link
JOINT = 2  # joint k is JOINT + k, so it is the greatest


class _Reading(NamedTuple):
    """How a map is read: counter-clockwise (0) or clockwise, from which dart; length of the least code so far."""

    side: int
    root: int
    length: int


@compiled
def faces_of(turn: Ints) -> tuple[Ints, int]:
    """Return the face on the left of each dart, and the number of faces."""
    face = np.full(turn.shape[1], -1, np.int64)
    count = 0
    for first in range(turn.shape[1]):
        d = first
        while face[d] < 0:
            face[d] = count
            d = turn[1, d ^ 1]
        count += face[first] == count
    return face, count


@compiled
def from_turns(after: Ints) -> Ints:
    """Return both rows of ``turn`` from the first."""
    turn = np.empty((2, len(after)), np.int64)
    for d in range(len(after)):
        turn[0, d] = after[d]
        turn[1, after[d]] = d
    return turn


@compiled
def decode_map(code: Bytes) -> tuple[Ints, Ints, Ints]:
    """Return the map of a code without labels, and the number of open edges in each of its corners.

    The root is dart 0, and links are numbered as they come. Returns turn int64[2, D], vertex and open edges
    int64[D].
    """
    highest = np.int64(0)
    for symbol in code:
        highest = max(highest, np.int64(symbol))
    darts = 2 * (highest - JOINT + 1)
    after = np.zeros(darts, np.int64)
    vertex = np.zeros(darts, np.int64)
    open_edges = np.zeros(darts, np.int64)
    known = np.zeros(darts, np.bool_)
    link, first, last = 0, -1, -1
    for symbol in code:
        if symbol == END:
            after[last] = first
            link, first, last = link + 1, -1, -1
        elif symbol == OPEN:
            open_edges[last] += 1
        else:
            d = 2 * (np.int64(symbol) - JOINT)
            d += known[d]
            known[d], vertex[d] = True, link
            if first < 0:
                first = d
            else:
                after[last] = d
            last = d
    return from_turns(after), vertex, open_edges


@compiled
def _read(
    turn: Ints,
    vertex: Ints,
    open_edges: Ints,
    face: Ints,
    labels: Ints,
    reading: _Reading,
    best: Bytes,
    code: Bytes,
    work: Ints,
) -> tuple[int, int]:
    """Write the code of a map from a root; stop where it is seen to be greater than the best.

    Work space is int64[5, >= D]; its last row gets the darts in the order in which they were read. Returns -1, 0
    or 1 for a code less than, equal to or greater than the best, and its length.
    """
    side, root = reading.side, reading.root
    verdict = -1 if reading.length == 0 else 0
    joint, link, start, order = work[0], work[1], work[2], work[4]
    for k in range(work.shape[1]):
        joint[k] = link[k] = -1
    start[0], link[vertex[root]] = root, 0
    joints, links, size, at, reads = 0, 1, 0, 0, 0
    while at < links:
        d = start[at]
        while True:
            if joint[d >> 1] < 0:
                joint[d >> 1] = joints
                joints += 1
            there = vertex[d ^ 1]
            if link[there] < 0:
                link[there] = links
                start[links] = d ^ 1
                links += 1
            order[reads] = d
            reads += 1
            code[size] = JOINT + joint[d >> 1]
            verdict = _judged(verdict, code, best, size)
            size += 1
            for _ in range(open_edges[d if side == 0 else turn[1, d]]):
                code[size] = OPEN
                verdict = _judged(verdict, code, best, size)
                size += 1
            d = turn[side, d]
            if d == start[at]:
                break
        code[size] = END
        verdict = _judged(verdict, code, best, size)
        if verdict > 0:
            return verdict, size
        size += 1
        at += 1
    return _read_labels(turn, face, labels, side, best, code, work, verdict, size)


@compiled
def _judged(verdict: int, code: Bytes, best: Bytes, place: int) -> int:
    """Return how a code compares with the best, once it has a symbol in one place more."""
    if verdict == 0 and code[place] != best[place]:
        return 1 if code[place] > best[place] else -1
    return verdict


@compiled
def _read_labels(
    turn: Ints, face: Ints, labels: Ints, side: int, best: Bytes, code: Bytes, work: Ints, verdict: int, size: int
) -> tuple[int, int]:
    """Write the labels of the faces after a code, in the order in which it met them."""
    if len(labels):
        seen, order = work[3], work[4]
        for f in range(len(labels)):
            seen[f] = 0
        for i in range(len(face)):
            d = order[i]
            f = face[d if side == 0 else turn[1, d]]
            if not seen[f]:
                seen[f] = 1
                code[size] = labels[f]
                verdict = _judged(verdict, code, best, size)
                size += 1
    return verdict, size


@compiled
def canonical_map(
    turn: Ints, vertex: Ints, open_edges: Ints, face: Ints, labels: Ints, key: Ints
) -> tuple[Bytes, Ints, Ints]:
    """Return the canonical code of a map and all readings that give it: their darts in order, and their senses.

    Open edges and face are those of each corner, int64[D]. Labels of the faces, 0 to 255, which a symmetry must
    keep, end the code, in the order in which the faces are met; they are empty where there are none. Of the roots
    of each sense those with the least key, int64[2, D], not below 0 are allowed.
    """
    darts = len(vertex)
    size = len(labels) + 2 * darts
    for d in range(darts):
        size += open_edges[d]
    lowest = -1
    for side in range(2):
        for d in range(darts):
            if key[side, d] >= 0 and (lowest < 0 or key[side, d] < lowest):
                lowest = key[side, d]
    best, code = np.zeros(size, np.uint8), np.zeros(size, np.uint8)
    orders = np.zeros((4, darts), np.int64)
    sides = np.zeros(2 * darts, np.int64)
    work = np.zeros((5, max(darts, len(labels)) + 1), np.int64)
    found = length = 0
    for side in range(2):
        for root in range(darts):
            if key[side, root] != lowest:
                continue
            reading = _Reading(side, root, length)
            verdict, size = _read(turn, vertex, open_edges, face, labels, reading, best, code, work)
            if verdict > 0:
                continue
            if verdict < 0:  # the readings up to now gave a greater code: they are forgotten
                best, code, length, found = code, best, size, 0
            orders = doubled(orders) if found == len(orders) else orders
            for i in range(darts):
                orders[found, i] = work[4, i]
            sides[found] = side
            found += 1
    return best[:length].copy(), orders[:found], sides[:found]


@compiled
def symmetries_of_map(turn: Ints, orders: Ints, sides: Ints) -> tuple[Ints, Ints]:
    """Return the symmetries of a map as permutations of darts and of corners, int64[k, D], the identity first.

    Orders and sides are those of `canonical_map`.
    """
    darts, corners = np.empty_like(orders), np.empty_like(orders)
    for a in range(len(orders)):
        for i in range(orders.shape[1]):
            d, image = orders[0, i], orders[a, i]
            darts[a, d] = image
            # a mirror image has the corner on the other side of the dart
            corners[a, d] = image if sides[a] == sides[0] else turn[1, image]
    return darts, corners
