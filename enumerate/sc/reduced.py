"""Ride-alongs taken off drawn chains, compiled: the reduced form of every SC graph of a list.

The rule is that of `graphs.reduce.ride_alongs.reduce`: binary links u, v joined to each other, their other
neighbours a and b joined by a joint, and the cycle a-u-v-b a sum of loops of one class. Sets of joints are words
of 64 bits. Theory: docs/theory/reduction.md.
"""

from __future__ import annotations

import numpy as np

from enumerate.kernel.compiled import compiled
from graphs.types import Ints, Words

__all__ = ["reduced_joints"]


@compiled
def reduced_joints(vertex: Ints, around: Words, number: Ints) -> np.uint64:
    """Return the joints that are left when all ride-alongs are taken off, as bits.

    Given are the links of the joints, the joints round each face, and the class of each face, -1 without a centre.
    """
    loops = around.copy()
    owner = number.copy()
    joints = len(vertex) // 2
    alive = ~np.uint64(0) >> np.uint64(64 - joints)
    degree = np.zeros(joints + 1, np.int64)
    for d in range(len(vertex)):
        degree[vertex[d]] += 1
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
            low = rows[i] & (~rows[i] + np.uint64(1))
            if low == 0:
                continue
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
