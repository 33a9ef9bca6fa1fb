"""SC graphs of a contracted map, listed, counted, described and reduced, compiled.

Ride-alongs are taken off by the rule of `graphs.reduce.ride_alongs.reduce`: binary links u, v joined to each
other, their other neighbours a and b joined by a joint, and the cycle a-u-v-b a sum of loops of one class. Sets
of joints are words of 64 bits. Theory: docs/theory/sc-enumeration.md, docs/theory/reduction.md.
"""

from typing import NamedTuple

import numpy as np

from enumerate.chains.counting import count_fixed, count_in
from enumerate.contracted.binary_links import EVERY, PlacementRange, list_placements, no_prefix, with_symmetries
from enumerate.contracted.maps import code_of, expanded, outer_frame, ring
from enumerate.kernel._compiled import compiled, doubled, number_of_orbits
from enumerate.kernel.centres import (
    FINITE,
    OUTER,
    centres_at_infinity,
    class_points,
    classes_of,
    joints_of_faces,
    labellings,
    mobility_of,
)
from graphs.types import Bytes, Ints, Words


class Centres(NamedTuple):
    """Which centres the loops of a mechanism may have.

    `spatial` loops have none, others at infinity only if `infinite`. The rank of a mechanism with spatial loops
    must give `dof`, and every joint of it must move.
    """

    dof: int
    spatial: int
    infinite: bool


@compiled
def count_on_map(code: Bytes, n: int, outer: int, links: int, most: int, only: int, prefix: Ints) -> int:
    """Return the number of drawn chains of a contracted map with one outer face that begin in one way.

    The map has n links; the outer face is -1 for embeddings in the sphere without one. The other arguments are
    those of `enumerate.chains.counting.count_of_graph`.
    """
    frame, _ = outer_frame(code, n, outer)
    return count_in(frame, PlacementRange(links, most, only), prefix)


@compiled
def count_drawn(codes: Bytes, n: int, links: int, most: int, outside: bool) -> int:
    """Return the number of drawn chains of some maps, by a test of each placement.

    With `outside` an outer face is chosen; else embeddings in the sphere are counted.
    """
    total = 0
    wanted, nowhere = PlacementRange(links, most, EVERY), no_prefix()
    for c in range(len(codes)):
        frame, faces = outer_frame(codes[c], n, -1)
        if not outside:
            total += count_in(frame, wanted, nowhere)
            continue
        for f in range(faces.shape[1]):
            if faces[:, f].min() == f:  # the first of its orbit
                total += count_in(with_symmetries(frame, faces[:, f] == f), wanted, nowhere)
    return int(total)


@compiled
def count_drawn_by_burnside(codes: Bytes, n: int, links: int, most: int, outside: bool) -> int:
    """Return what `count_drawn` returns, by Burnside's lemma: no placement is compared with another."""
    total = 0
    for c in range(len(codes)):
        frame, faces = outer_frame(codes[c], n, -1)
        fixed = 0
        for a in range(len(faces)):
            kept = 0
            for f in range(faces.shape[1]):
                kept += faces[a, f] == f
            if kept or not outside:
                fixed += count_fixed(frame, frame.moved[a], links, most) * (kept if outside else 1)
        total += number_of_orbits(fixed, len(faces))
    return int(total)


@compiled
def _drawing(code: Bytes, n: int, x: Bytes, links: int) -> tuple[Ints, Ints, Ints]:
    """Return the map of a chain; an empty code stands for a ring."""
    return expanded(code, n, x) if len(code) else ring(links)


@compiled
def list_drawn(
    code: Bytes, n: int, outer: int, wanted: PlacementRange, prefix: Ints, centres: Centres
) -> tuple[Bytes, Ints, Ints]:
    """List the SC graphs of a contracted map with one outer face: binary links, labels of faces, and symmetries.

    The arguments are those of `count_on_map`; an empty code is a ring. Binary links on each joint of the map are
    uint8[r, m], labels int64[r, F], and numbers of symmetries int64[r].
    """
    if len(code):
        frame, faces = outer_frame(code, n, outer)
        moved = frame.moved
        x, order = list_placements(frame, wanted, prefix)
    else:
        links = wanted.links
        x, order = np.zeros((1, 0), np.uint8), np.full(1, 2 * links)
        moved = np.zeros((2 * links, 0), np.uint8)
        faces = np.zeros((2 * links, 2), np.int64)
        for a in range(2 * links):
            faces[a, 1] = 1
    count = faces.shape[1]
    if centres.spatial == 0 and not centres.infinite:
        labels = np.full((len(x), count), FINITE, np.int64)
        for r in range(len(x)):
            labels[r, outer] = OUTER
        return x, labels, order
    return _labelled(code, n, outer, wanted.links, x, moved, faces, centres)


@compiled
def _labelled(
    code: Bytes, n: int, outer: int, links: int, x: Bytes, moved: Bytes, faces: Ints, centres: Centres
) -> tuple[Bytes, Ints, Ints]:
    """Return drawn chains with all labels of their faces that make mechanisms."""
    count, used = faces.shape[1], 0
    more_x, facts = np.zeros((64, x.shape[1]), np.uint8), np.zeros((64, count + 1), np.int64)  # labels, then order
    for r in range(len(x)):
        _, _, face = _drawing(code, n, x[r], links)
        around = joints_of_faces(face, count)
        kept = np.zeros(len(faces), np.bool_)
        for a in range(len(faces)):
            kept[a] = True
            for e in range(x.shape[1]):
                kept[a] &= x[r, moved[a, e]] == x[r, e]
        labels, order = labellings(around, outer, centres.spatial, centres.infinite, faces[kept])
        for k in range(len(labels)):
            if not is_mechanism(face, labels[k], around, centres.dof):
                continue
            if used == len(more_x):
                more_x, facts = doubled(more_x), doubled(facts)
            for e in range(x.shape[1]):
                more_x[used, e] = x[r, e]
            for f in range(count):
                facts[used, f] = labels[k, f]
            facts[used, count] = order[k]
            used += 1
    return more_x[:used], facts[:used, :count].copy(), facts[:used, count].copy()


@compiled
def is_mechanism(face: Ints, labels: Ints, around: Words, dof: int) -> bool:
    """Tell whether the exact rank gives so many freedoms and every joint moves."""
    number, classes = classes_of(around, labels)
    points = class_points(face, number)
    return mobility_of(face, labels, points, centres_at_infinity(labels, number, classes), True) == dof


@compiled
def centres_of_all(code: Bytes, n: int, links: int, x: Bytes, labels: Ints) -> Ints:
    """Return the number of classes of each SC graph of a list: int64[r]."""
    found = np.zeros(len(x), np.int64)
    for r in range(len(x)):
        _, _, face = _drawing(code, n, x[r], links)
        found[r] = classes_of(joints_of_faces(face, labels.shape[1]), labels[r])[1]
    return found


@compiled
def describe(
    code: Bytes, n: int, links: int, outer: int, x: Bytes, labels: Ints, labelled: bool
) -> tuple[Bytes, Ints, Ints, Ints, Words]:
    """Return codes and attributes of the SC graphs of a list, which `list_drawn` returns.

    Returns codes uint8[r, length], with the labels if `labelled`; joints int64[r, J, 2]; sizes int64[r, F], the
    number of joints of the outer face, then of the others; facts int64[r, 3], numbers of classes and of classes at
    infinity, and mobility by rank; and the joints of the reduced form, as bits.
    """
    rows, count = labels.shape
    darts = len(_drawing(code, n, x[0], links)[1]) if rows else 2
    nothing = np.zeros(darts, np.int64)
    codes = np.zeros((rows, darts + links + (count if labelled else 0)), np.uint8)
    joints = np.zeros((rows, darts // 2, 2), np.int64)
    sizes = np.zeros((rows, count), np.int64)
    facts = np.zeros((rows, 3), np.int64)
    left = np.zeros(rows, np.uint64)
    for r in range(rows):
        turn, vertex, face = _drawing(code, n, x[r], links)
        around = joints_of_faces(face, count)
        number, classes = classes_of(around, labels[r])
        infinite = centres_at_infinity(labels[r], number, classes)
        points = class_points(face, number)
        facts[r, 0], facts[r, 2] = classes, mobility_of(face, labels[r], points, infinite, False)
        for c in range(classes):
            facts[r, 1] += infinite[c]
        text, _, _ = code_of(turn, vertex, nothing, face, labels[r] if labelled else nothing[:0], outer)
        for k in range(len(text)):
            codes[r, k] = text[k]
        for k in range(darts // 2):
            joints[r, k, 0], joints[r, k, 1] = vertex[2 * k], vertex[2 * k + 1]
        for d in range(darts):  # the outer face first
            f = face[d]
            sizes[r, 0 if f == outer else f + (f < outer)] += 1
        left[r] = reduced_joints(vertex, around, number)
    return codes, joints, sizes, facts, left


@compiled
def codes_of_all(code: Bytes, n: int, links: int, outer: int, x: Bytes, labels: Ints) -> tuple[Bytes, Ints]:
    """Return the codes of the SC graphs of a list, and their labels in the order in which codes meet faces.

    They are uint8[r, D + N] and int64[r, F]; arguments are what `list_drawn` takes and returns.
    """
    rows, count = labels.shape
    darts = len(_drawing(code, n, x[0], links)[1]) if rows else 2
    nothing = np.zeros(darts, np.int64)
    codes, met = np.zeros((rows, darts + links), np.uint8), np.zeros((rows, count), np.int64)
    for r in range(rows):
        turn, vertex, face = _drawing(code, n, x[r], links)
        text, _, _ = code_of(turn, vertex, nothing, face, labels[r], outer)
        for k in range(darts + links):
            codes[r, k] = text[k]
        for f in range(count):
            met[r, f] = text[darts + links + f]
    return codes, met


@compiled
def reduced_joints(vertex: Ints, around: Words, number: Ints) -> np.uint64:
    """Return the joints that are left when all ride-alongs are taken off, as bits.

    Given are the links of the joints, the joints round each face, and the class of each face, -1 without a centre.
    """
    loops = around.copy()
    owner = number.copy()
    joints = len(vertex) // 2
    alive = ~np.uint64(0) >> np.uint64(64 - joints)
    degree = np.bincount(vertex)
    left = joints
    again = True
    while again and left > 4:
        again = False
        for j in range(joints):
            first, last, between = _addendum(vertex, degree, alive, j)
            if between < 0:
                continue
            string = _bit(first) | _bit(j) | _bit(last)
            dropped = _in_sum(loops, owner, string | _bit(between))
            if dropped < 0:
                continue
            for f in range(len(loops)):
                if loops[f] & string:
                    loops[f] ^= string | _bit(between)
            owner[dropped], loops[dropped] = -1, 0
            alive &= ~string
            for d in (2 * first, 2 * first + 1, 2 * last, 2 * last + 1):
                degree[vertex[d]] -= 1
            left -= 3
            again = True
            break
    return alive


@compiled
def _bit(joint: int) -> np.uint64:
    return np.uint64(1) << np.uint64(joint)


@compiled
def _other_joint(vertex: Ints, alive: np.uint64, link: int, joint: int) -> int:
    """Return the other joint of a binary link."""
    for d in range(len(vertex)):
        if vertex[d] == link and d >> 1 != joint and alive & _bit(d >> 1):
            return d >> 1
    return -1


@compiled
def _addendum(vertex: Ints, degree: Ints, alive: np.uint64, j: int) -> tuple[int, int, int]:
    """Return joints a-u, v-b and a-b where joint j is u-v of such an addendum; -1 for the last where it is not."""
    u, v = vertex[2 * j], vertex[2 * j + 1]
    if not alive & _bit(j) or degree[u] != 2 or degree[v] != 2:
        return -1, -1, -1
    first, last = _other_joint(vertex, alive, u, j), _other_joint(vertex, alive, v, j)
    a = vertex[2 * first] + vertex[2 * first + 1] - u
    b = vertex[2 * last] + vertex[2 * last + 1] - v
    if a != b:
        for k in range(len(vertex) // 2):
            p, q = vertex[2 * k], vertex[2 * k + 1]
            if alive & _bit(k) and ((p == a and q == b) or (p == b and q == a)):
                return first, last, k
    return -1, -1, -1


@compiled
def _in_sum(loops: Words, owner: Ints, cycle: np.uint64) -> int:
    """Return a loop of the sum of loops of one class that is a cycle; -1 if it is no such sum."""
    faces = len(loops)
    for c in range(faces):
        rows = np.zeros(faces, np.uint64)
        parts = np.zeros(faces, np.int64)
        used = 0
        for f in range(faces):
            if owner[f] == c:
                rows[used], parts[used] = loops[f], 1 << f
                used += 1
        if used == 0:
            continue
        target, mask = cycle, 0
        for i in range(used):  # each row clears its lowest joint from the later ones and from the cycle
            if rows[i] == 0:
                continue
            low = rows[i] & ~(rows[i] - np.uint64(1))
            for k in range(i + 1, used):
                if rows[k] & low:
                    rows[k] ^= rows[i]
                    parts[k] ^= parts[i]
            if target & low:
                target ^= rows[i]
                mask ^= parts[i]
        if target == 0:
            for f in range(faces):
                if (mask >> f) & 1:
                    return f
    return -1
