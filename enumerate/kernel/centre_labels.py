"""Labels of faces, and the classes of loops with one centre that follow from them, compiled.

Two loops that share two joints have one centre, and so have two classes of loops that share two joints between
them (`graphs.loops.classes`). Sets of joints are words of 64 bits. Theory: docs/theory/centre-classes.md.
"""

from __future__ import annotations

import numpy as np

from enumerate.kernel.compiled import compiled, doubled
from graphs.types import Ints, Words

__all__ = ["FINITE", "INFINITE", "MOST_JOINTS", "OUTER", "SPATIAL", "classes_of", "joints_of_faces", "labellings"]

OUTER, FINITE, INFINITE, SPATIAL = 0, 1, 2, 3
"""Labels of faces."""

MOST_JOINTS = 64


@compiled
def joints_of_faces(face: Ints, faces: int) -> Words:
    """Return the joints round each face, as bits."""
    found = np.zeros(faces, np.uint64)
    for d in range(len(face)):
        found[face[d]] |= np.uint64(1) << np.uint64(d >> 1)
    return found


@compiled
def classes_of(around: Words, labels: Ints) -> tuple[Ints, int]:
    """Return the class of each face, -1 for faces without a centre, and the number of classes.

    `around`, uint64[F], is the set of joints round each face.
    """
    faces = len(around)
    owner = np.full(faces, -1, np.int64)
    joints = around.copy()
    for f in range(faces):
        if labels[f] in (FINITE, INFINITE):
            owner[f] = f
    merged = True
    while merged:
        merged = False
        for a in range(faces):
            for b in range(a):
                if owner[a] == a and owner[b] == b and _one_class(joints[a] & joints[b], labels[a], labels[b]):
                    joints[b] |= joints[a]
                    for f in range(faces):
                        if owner[f] == a:
                            owner[f] = b
                    merged = True
    number = np.full(faces, -1, np.int64)
    count = 0
    for f in range(faces):
        if owner[f] == f:
            number[f] = count
            count += 1
    for f in range(faces):
        if owner[f] >= 0 and owner[f] != f:
            number[f] = number[owner[f]]
    return number, count


@compiled
def _one_class(common: np.uint64, label: int, other: int) -> bool:
    """Tell whether two classes with these joints in common must be one."""
    two = common & (common - np.uint64(1)) != 0
    return two or (common != 0 and label == INFINITE and other == INFINITE)


@compiled
def _submask(mask: int, moves: Ints, a: int) -> int:
    """Return where a permutation takes a set of faces."""
    image = 0
    for f in range(moves.shape[1]):
        if (mask >> f) & 1:
            image |= 1 << moves[a, f]
    return image


@compiled
def labellings(around: Words, outer: int, spatial: int, infinite: bool, moves: Ints) -> tuple[Ints, Ints]:
    """Return labels of the faces of an SC graph, int64[k, F], one labelling of each orbit.

    With them comes how many symmetries, of `moves`, int64[s, F], keep each. `spatial` bounded faces have no
    centre; `infinite` allows also classes with a centre at infinity, no two of which share a joint.
    """
    faces = len(around)
    found = np.zeros((8, faces + 1), np.int64)
    used = 0
    labels = np.zeros(faces, np.int64)
    for without in range(1 << faces):
        if (without >> outer) & 1 or _size(without) != spatial:
            continue
        for f in range(faces):
            labels[f] = OUTER if f == outer else SPATIAL if (without >> f) & 1 else FINITE
        number, classes = classes_of(around, labels)
        for chosen in range(1 << classes if infinite else 1):
            planar = 0
            for f in range(faces):
                if number[f] >= 0 and (chosen >> number[f]) & 1:
                    planar |= 1 << f
            if not _apart(around, number, planar):
                continue
            keeping = 0
            for a in range(len(moves)):
                image, other = _submask(without, moves, a), _submask(planar, moves, a)
                if image < without or (image == without and other < planar):
                    keeping = -1
                    break
                keeping += image == without and other == planar
            if keeping > 0:
                found = doubled(found) if used == len(found) else found
                for f in range(faces):
                    found[used, f] = INFINITE if (planar >> f) & 1 else labels[f]
                found[used, faces] = keeping
                used += 1
    return found[:used, :faces].copy(), found[:used, faces].copy()


@compiled
def _size(mask: int) -> int:
    """Return the number of bits set."""
    count = 0
    while mask:
        mask &= mask - 1
        count += 1
    return count


@compiled
def _apart(around: Words, number: Ints, planar: int) -> bool:
    """Tell whether no two infinite classes share a joint."""
    for f in range(len(around)):
        for g in range(f):
            both = (planar >> f) & 1 and (planar >> g) & 1
            if both and number[f] != number[g] and around[f] & around[g]:
                return False
    return True
