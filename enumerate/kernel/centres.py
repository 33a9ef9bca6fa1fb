"""Centres of drawn mechanisms: labels of faces, classes of loops with one centre, and the exact rank, compiled.

Two loops that share two joints have one centre, and so have two classes of loops that share two joints between
them (`graphs.loops.classes`). Sets of joints are words of 64 bits. Theory: docs/theory/centre-classes.md.

The rank is that of `graphs.rank.exact.exact_mobility`, found by other code: a random member of the type modulo a
prime of 31 bits, its loops closed face by face. It is done twice, modulo two primes; chance can make a rank too
small, never too large (about once in 10^7 graphs and prime), so the larger one counts. Theory:
docs/theory/exact-mobility.md.
"""

import numpy as np

from enumerate.kernel._compiled import compiled, doubled
from enumerate.kernel.words import GOLDEN, has_several, number_in, plus, times
from graphs.types import Ints, Words

# Labels of faces: places in the letters from which codes are written (`LABEL_LETTERS`), so stores hold this order.
OUTER = 0
FINITE = 1
INFINITE = 2
SPATIAL = 3

MOST_JOINTS = 64
"""Sets of joints are bits of one word."""


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
    owner = np.full(faces, -1, np.int64)  # the least face of the class of each; its word holds the joints of all
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
    return has_several(common) or (common != 0 and label == INFINITE and other == INFINITE)


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
    # A labelling is a set of spatial faces, then one of infinite ones; the least pair of an orbit is kept.
    for without in range(1 << faces):
        if (without >> outer) & 1 or number_in(without) != spatial:
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
def _apart(around: Words, number: Ints, planar: int) -> bool:
    """Tell whether no two infinite classes share a joint."""
    for f in range(len(around)):
        for g in range(f):
            both = (planar >> f) & 1 and (planar >> g) & 1
            if both and number[f] != number[g] and around[f] & around[g]:
                return False
    return True


RANK_PRIMES = (2147483647, 2147483629)
"""The two largest primes below 2^31: products of two residues fit a word of 64 bits. A rank may fall modulo one of them
by chance, hence two."""

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
    state[0] = plus(state[0], GOLDEN)
    z = state[0]
    z = times(z ^ (z >> np.uint64(30)), np.uint64(0xBF58476D1CE4E5B9))
    z = times(z ^ (z >> np.uint64(27)), np.uint64(0x94D049BB133111EB))
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
    """Return the centres on the axis of each joint; numbers are the classes of faces (`classes_of`)."""
    return points_of_ends(number[face])


@compiled
def points_of_ends(end: Ints) -> Ints:
    """Return the points on the axis of each joint, int64[J, 2], `FREE` where there is no other.

    The point on the left of each dart is ``end``, int64[D], negative for none.
    """
    points = np.full((len(end) // 2, 2), FREE, np.int64)
    for k in range(len(points)):
        left, right = end[2 * k], end[2 * k + 1]
        points[k, 0] = left if left >= 0 else right
        if left >= 0 and right != left:
            points[k, 1] = right
    return points


@compiled
def centres_at_infinity(labels: Ints, number: Ints, points: int) -> Ints:
    """Return 1 for each of so many points, the classes first, that is a centre at infinity, else 0."""
    found = np.zeros(points, np.int64)
    for f in range(len(labels)):
        if labels[f] == INFINITE:
            found[number[f]] = 1
    return found


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
    held = False
    for r in range(rank if moving else 0):
        held |= np.count_nonzero(matrix[r]) == 1
    return rank, not held
