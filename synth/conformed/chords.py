"""Which of two products of chords is larger, whatever the angles, if the order with opposites says so.

The J joints and the points opposite to them cut the circle into 2 J fine gaps, opposite ones equal; an arc shorter
than half the circle is a set of the J sizes. Half its chord is sin(arc / 2), and grows with the arc; so does a
product of chords if each arc lies, as a set of sizes, within one of another product. sin(x) is 2 sin(x / 2)
sin((pi - x) / 2), and pi - x is the other sizes: every term of an outward rate (`synth.conformed.outward`) is a
product of chords. A sum has the sign of its positive terms if each negative term has a larger positive one of its
own.

Theory: docs/theory/conical-candidates.md.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from enumerate.kernel.compiled import compiled
from graphs.types import Ints, Signs

__all__ = ["arc_sets", "sign_of_sum"]


@compiled
def _matched(fits: npt.NDArray[np.bool_], rows: int, columns: int) -> bool:
    """Tell whether every row can have a column of its own that fits (augmenting paths)."""
    owner = np.full(columns, -1, np.int64)
    came = np.empty(columns, np.int64)
    queue = np.empty(rows + 1, np.int64)
    for start in range(rows):
        seen = np.zeros(columns, np.bool_)
        head, tail = 0, 1
        queue[0] = start
        free = -1
        while head < tail and free < 0:
            row = queue[head]
            head += 1
            for column in range(columns):
                if fits[row, column] and not seen[column]:
                    seen[column] = True
                    came[column] = row
                    if owner[column] < 0:
                        free = column
                        break
                    queue[tail] = owner[column]
                    tail += 1
        if free < 0:
            return False
        column = free
        while True:
            row = came[column]
            before = -1
            for other in range(columns):
                if owner[other] == row:
                    before = other
            owner[column] = row
            if row == start:
                break
            column = before
    return True


@compiled
def _all_dominated(signs: Signs, sets: Ints, less: int) -> bool:
    """Tell whether each term of sign ``less`` has a larger term of the other sign of its own."""
    terms, factors = sets.shape
    fits = np.zeros((terms, terms), np.bool_)
    within = np.zeros((factors, factors), np.bool_)
    rows = 0
    for a in range(terms):
        if signs[a] != less:
            continue
        columns = 0
        for b in range(terms):
            if signs[b] == less:
                continue
            for i in range(factors):
                for j in range(factors):
                    within[i, j] = sets[a, i] & ~sets[b, j] == 0
            fits[rows, columns] = _matched(within, factors, factors)
            columns += 1
        rows += 1
    return _matched(fits, rows, terms - rows)


@compiled
def _signs(signs: Signs, sets: Ints) -> Signs:
    of_sums = np.zeros(len(signs), np.int8)
    for i in range(len(signs)):
        if _all_dominated(signs[i], sets[i], -1):
            of_sums[i] = 1
        elif _all_dominated(signs[i], sets[i], 1):
            of_sums[i] = -1
    return of_sums


def arc_sets(slots: Ints) -> Ints:
    """Return the sizes of fine gaps that the shorter arc between two joints covers, as masks int64[r, J, J].

    Orders with opposites are given on 2 J slots; bit g is the gap after a slot that is g modulo J.

    >>> arc_sets(np.array([[0, 2, 4]]))[0].tolist()
    [[0, 3, 6], [3, 0, 5], [6, 5, 0]]
    """
    joints = slots.shape[-1]
    first, second = slots[:, :, np.newaxis], slots[:, np.newaxis, :]
    ahead = np.remainder(second - first, 2 * joints)
    start = np.where(ahead < joints, first, second) % joints
    length = np.minimum(ahead, 2 * joints - ahead)
    run = ((1 << length) - 1) << start
    return np.asarray((run | run >> joints) & ((1 << joints) - 1))


def sign_of_sum(signs: Signs, sets: Ints) -> Signs:
    """Return the signs of sums of products of chords, 0 where this does not decide.

    Signs, int8[r, T], are those of the terms, sets, int64[r, T, F], the arcs of each term's chords. In the
    example, a chord less a shorter one within its arc, and less one elsewhere.

    >>> sets = np.array([[[0b011], [0b001]], [[0b011], [0b100]]])
    >>> sign_of_sum(np.array([[1, -1], [1, -1]], np.int8), sets).tolist()
    [1, 0]
    """
    return np.asarray(_signs(np.ascontiguousarray(signs), np.ascontiguousarray(sets)))
