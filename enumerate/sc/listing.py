"""SC graphs of a contracted map, listed, counted and described, compiled.

Theory: docs/theory/sc-enumeration.md.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from enumerate.chains.counting import count_fixed, count_in
from enumerate.contracted.binary_links import EVERY, Wanted
from enumerate.contracted.embedded import code_of, expanded, outer_faces, outer_frame, ring, sets_of
from enumerate.contracted.listing import list_placements
from enumerate.kernel.burnside import number_of_orbits
from enumerate.kernel.centre_labels import FINITE, INFINITE, OUTER, classes_of, joints_of_faces, labellings
from enumerate.kernel.compiled import compiled
from enumerate.kernel.ranks import class_points, mobility_of
from enumerate.sc.reduced import reduced_joints
from graphs.types import Bytes, Ints, Words

__all__ = [
    "centres_of_all",
    "codes_of_all",
    "count_drawn",
    "count_drawn_by_burnside",
    "describe",
    "list_drawn",
    "weight_of",
]


class Centres(NamedTuple):
    """Which centres the loops of a mechanism may have.

    `spatial` loops have none, others at infinity only if `infinite`. The rank of a mechanism with spatial loops
    must give `dof`, and every joint of it must move.
    """

    dof: int
    spatial: int
    infinite: bool


@compiled
def weight_of(code: Bytes, n: int, outer: int, links: int, most: int, only: int, prefix: Ints) -> int:
    """Return the number of drawn chains of a contracted map with one outer face that begin in one way.

    The map has n links; the outer face is -1 for embeddings in the sphere without one. The other arguments are
    those of `enumerate.chains.counting.count_of_graph`.
    """
    ends, moved, _ = outer_frame(code, outer)
    sets, needs = sets_of(code, n)
    return count_in(ends, np.arange(len(ends)), moved, sets, needs, n, Wanted(links, most, only), prefix)


@compiled
def count_drawn(codes: Bytes, n: int, links: int, most: int, outside: bool) -> int:
    """Return the number of drawn chains of some maps, by a test of each placement.

    With `outside` an outer face is chosen; else embeddings in the sphere are counted.
    """
    total = 0
    nowhere = np.zeros(0, np.int64)
    for c in range(len(codes)):
        sets, needs = sets_of(codes[c], n)
        faces = outer_faces(codes[c]) if outside else np.full(1, -1)
        for k in range(len(faces)):
            ends, moved, _ = outer_frame(codes[c], faces[k])
            first = np.arange(len(ends))
            total += count_in(ends, first, moved, sets, needs, n, Wanted(links, most, EVERY), nowhere)
    return total


@compiled
def count_drawn_by_burnside(codes: Bytes, n: int, links: int, most: int, outside: bool) -> int:
    """Return what `count_drawn` returns, by Burnside's lemma: no placement is compared with another."""
    total = 0
    for c in range(len(codes)):
        sets, needs = sets_of(codes[c], n)
        ends, moved, faces = outer_frame(codes[c], -1)
        first = np.arange(len(ends))
        fixed = 0
        for a in range(len(moved)):
            kept = 0
            for f in range(faces.shape[1]):
                kept += faces[a, f] == f
            if kept or not outside:
                same = count_fixed(moved[a], ends, first, sets, needs, n, links, most)
                fixed += same * (kept if outside else 1)
        total += number_of_orbits(fixed, len(moved))
    return total


@compiled
def _drawing(code: Bytes, n: int, x: Bytes, links: int) -> tuple[Ints, Ints, Ints]:
    """Return the map of a chain; an empty code stands for a ring."""
    return expanded(code, n, x) if len(code) else ring(links)


@compiled
def list_drawn(
    code: Bytes, n: int, outer: int, wanted: Wanted, prefix: Ints, centres: Centres
) -> tuple[Bytes, Ints, Ints]:
    """List the SC graphs of a contracted map with one outer face: binary links, labels of faces, and symmetries.

    The arguments are those of `weight_of`; an empty code is a ring. Binary links on each joint of the map are
    uint8[r, m], labels int64[r, F], and numbers of symmetries int64[r].
    """
    if len(code):
        ends, moved, faces = outer_frame(code, outer)
        sets, needs = sets_of(code, n)
        x, order = list_placements(ends, np.arange(len(ends)), moved, sets, needs, n, wanted, prefix)
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
    count = faces.shape[1]
    size = used = 0
    more_x, more_labels, more_order = (
        np.zeros((64, x.shape[1]), np.uint8),
        np.zeros((64, count), np.int64),
        np.zeros(64, np.int64),
    )
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
            size = len(more_x)
            if used == size:
                grown_x, grown_labels, grown_order = (
                    np.zeros((2 * size, x.shape[1]), np.uint8),
                    np.zeros((2 * size, count), np.int64),
                    np.zeros(2 * size, np.int64),
                )
                for i in range(size):
                    for e in range(x.shape[1]):
                        grown_x[i, e] = more_x[i, e]
                    for f in range(count):
                        grown_labels[i, f] = more_labels[i, f]
                    grown_order[i] = more_order[i]
                more_x, more_labels, more_order = grown_x, grown_labels, grown_order
            for e in range(x.shape[1]):
                more_x[used, e] = x[r, e]
            for f in range(count):
                more_labels[used, f] = labels[k, f]
            more_order[used] = order[k]
            used += 1
    return more_x[:used], more_labels[:used], more_order[:used]


@compiled
def _at_infinity(labels: Ints, number: Ints, classes: int) -> Ints:
    """Return 1 for each class with a centre at infinity, else 0."""
    found = np.zeros(classes, np.int64)
    for f in range(len(labels)):
        if labels[f] == INFINITE:
            found[number[f]] = 1
    return found


@compiled
def is_mechanism(face: Ints, labels: Ints, around: Words, dof: int) -> bool:
    """Tell whether the exact rank gives so many freedoms and every joint moves."""
    number, classes = classes_of(around, labels)
    points = class_points(face, number)
    return mobility_of(face, labels, points, _at_infinity(labels, number, classes), True) == dof


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
        infinite = _at_infinity(labels[r], number, classes)
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
