"""The exact rank of drawn mechanisms, many at a time, compiled.

The same rank as `graphs.rank.exact.exact_mobility` finds, by other code: a random member of the type modulo a
prime of 31 bits, its loops closed face by face. It is done twice, modulo two primes; chance can make a rank too
small, never too large (about once in 10^7 graphs and prime), so the larger one counts. Theory:
docs/theory/exact-mobility.md.
"""

from __future__ import annotations

import numpy as np

from enumerate.kernel.centre_labels import FINITE, OUTER
from enumerate.kernel.compiled import compiled
from graphs.types import Ints, Words

__all__ = ["FREE", "RANK_PRIMES", "class_points", "mobility_of"]

RANK_PRIMES = (2147483647, 2147483629)
"""The two largest primes below 2^31."""

FREE = -1
"""No point that other joints share."""

_P = np.uint64(RANK_PRIMES[0])
_Q = np.uint64(RANK_PRIMES[1])


@compiled
def _mod(value: np.uint64, which: int) -> np.uint64:
    """Return a value modulo the first or second prime; constants divide faster than variables."""
    return value % _P if which == 0 else value % _Q


@compiled
def _minus(value: np.uint64, which: int) -> np.uint64:
    """Return the negative of a value below the prime."""
    prime = _P if which == 0 else _Q
    return prime - value if value else value


@compiled
def _random(state: Words, which: int) -> np.uint64:
    """Return the next number of a sequence that begins anew for each graph (splitmix64)."""
    state[0] += np.uint64(0x9E3779B97F4A7C15)
    z = state[0]
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return _mod((z ^ (z >> np.uint64(31))) >> np.uint64(1), which)


@compiled
def _inverse(value: np.uint64, which: int) -> np.uint64:
    """Return 1 / value, by Fermat."""
    power = (_P if which == 0 else _Q) - np.uint64(2)
    result = np.uint64(1)
    while power:
        if power & np.uint64(1):
            result = _mod(result * value, which)
        value = _mod(value * value, which)
        power >>= np.uint64(1)
    return result


@compiled
def class_points(face: Ints, number: Ints) -> Ints:
    """Return the centres on the axis of each joint, `FREE` where there is no other: int64[J, 2].

    Numbers are the classes of faces, as `classes_of` returns them.
    """
    points = np.full((len(face) // 2, 2), FREE, np.int64)
    for k in range(len(points)):
        left, right = number[face[2 * k]], number[face[2 * k + 1]]
        points[k, 0] = left if left >= 0 else right
        if left >= 0 and right != left:
            points[k, 1] = right
    return points


@compiled
def mobility_of(face: Ints, labels: Ints, points: Ints, at_infinity: Ints, moving: bool) -> int:
    """Return joints minus rank of a mechanism given by its faces: face of each dart, and labels of the faces.

    Points, int64[J, 2], are those that the axis of each joint passes through, `FREE` for any; `at_infinity` is 1
    for those at infinity. With `moving`, -1 where some joint cannot move.
    """
    best = -1
    for which in range(2):
        matrix = _closure(face, labels, points, at_infinity, which)
        rank, moves = _eliminate(matrix, which, moving)
        mobility = len(points) - rank
        if best < 0 or mobility < best:
            best = mobility
        if moving and not moves:
            return -1
    return best


@compiled
def _closure(face: Ints, labels: Ints, points: Ints, at_infinity: Ints, which: int) -> Words:
    """Return the closure equations of a random member: three for a loop with finite centre, six for others."""
    joints = len(points)
    first = np.full(len(labels), -1, np.int64)
    rows = 0
    for f in range(len(labels)):
        if labels[f] != OUTER:
            first[f] = rows
            rows += 3 if labels[f] == FINITE else 6
    lines = _random_lines(points, at_infinity, which)
    matrix = np.zeros((rows, joints), np.uint64)
    for j in range(joints):
        for side in range(2):
            f = face[2 * j + side]
            if first[f] >= 0:
                for k in range(3 if labels[f] == FINITE else 6):
                    matrix[first[f] + k, j] = lines[j, k] if side == 0 else _minus(lines[j, k], which)
    return matrix


@compiled
def _random_lines(points: Ints, at_infinity: Ints, which: int) -> Words:
    """Return random axes through the points given: uint64[J, 6]."""
    state = np.zeros(1, np.uint64)
    place = np.empty((len(at_infinity), 4), np.uint64)
    for p in range(len(at_infinity)):
        for k in range(3):
            place[p, k] = _random(state, which)
        place[p, 3] = 1 - at_infinity[p]
    ends = np.empty((2, 4), np.uint64)
    lines = np.empty((len(points), 6), np.uint64)
    for j in range(len(points)):
        for end in range(2):
            p = points[j, end]
            for k in range(4):
                ends[end, k] = place[p, k] if p >= 0 else _random(state, which) if k < 3 else np.uint64(1)
        _join(ends[0], ends[1], lines[j], which)
    return lines


@compiled
def _join(p: Words, q: Words, line: Words, which: int) -> None:
    """Write the Pluecker line of two points: direction, then moment."""
    for k in range(3):
        line[k] = _mod(_mod(p[3] * q[k], which) + _minus(_mod(q[3] * p[k], which), which), which)
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        line[3 + k] = _mod(_mod(p[i] * q[j], which) + _minus(_mod(p[j] * q[i], which), which), which)


@compiled
def _eliminate(matrix: Words, which: int, moving: bool) -> tuple[int, bool]:
    """Return the rank of a matrix, and whether no joint is held still; the matrix is used up.

    A joint is held still where the reduced form has a row with nothing but its pivot.
    """
    rows, columns = matrix.shape
    rank = 0
    for c in range(columns):
        pivot = rank
        while pivot < rows and matrix[pivot, c] == 0:
            pivot += 1
        if pivot == rows:
            continue
        for k in range(c, columns):
            matrix[pivot, k], matrix[rank, k] = matrix[rank, k], matrix[pivot, k]
        scale = _inverse(matrix[rank, c], which)
        for k in range(c, columns):
            matrix[rank, k] = _mod(matrix[rank, k] * scale, which)
        for r in range(0 if moving else rank + 1, rows):
            if r != rank and matrix[r, c]:
                factor = _minus(matrix[r, c], which)
                for k in range(c, columns):
                    if matrix[rank, k]:
                        matrix[r, k] = _mod(matrix[r, k] + factor * matrix[rank, k], which)
        rank += 1
        if rank == rows:
            break
    return rank, not moving or not _holds_still(matrix, rank)


@compiled
def _holds_still(matrix: Words, rank: int) -> bool:
    """Tell whether some row of a reduced form has nothing but its pivot."""
    for r in range(rank):
        others = 0
        for k in range(matrix.shape[1]):
            others += matrix[r, k] != 0
        if others == 1:
            return True
    return False
