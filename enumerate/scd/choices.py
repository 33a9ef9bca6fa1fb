"""Choices that the placements of open edges on a drawn mechanism begin with, compiled.

With a pattern (`enumerate.scd.patterns`) and a set of explicit faces chosen, links do not depend on each other:
each takes open edges in some of its corners, as many as its degree allows. Theory: docs/theory/scd-enumeration.md.
"""

from __future__ import annotations

import numpy as np

from enumerate.contracted.embedded import code_of
from enumerate.kernel.centre_labels import FINITE, INFINITE, OUTER, SPATIAL, classes_of, joints_of_faces
from enumerate.kernel.compiled import compiled
from enumerate.kernel.maps import decode_map, faces_of, symmetries_of_map
from enumerate.kernel.ranks import mobility_of
from enumerate.scd.patterns import CLOSED, OPENED, has_centre, label_faces, patterns, points_of_pattern
from graphs.types import Bytes, Ints

__all__ = [
    "TOO_MANY",
    "all_explicit",
    "corner_states",
    "drawn",
    "explicit_sets",
    "forced_mobility",
    "number_of_placements",
    "numbers_of_placements",
    "outline",
    "placements_of_choice",
    "room_of",
    "symmetries_of",
    "ways_to_lay",
]

TOO_MANY = 1 << 60
"""Numbers of placements from here on are not counted."""


@compiled
def drawn(code: Bytes, labels: Ints) -> tuple[Ints, Ints, Ints, Ints, Ints]:
    """Return map, faces, labels and classes of a mechanism; labels come in the order of the code."""
    turn, vertex, _ = decode_map(code)
    face, faces = faces_of(turn)
    kinds = label_faces(turn, vertex, face, labels)
    number, _ = classes_of(joints_of_faces(face, faces), kinds)
    return turn, vertex, face, kinds, number


@compiled
def symmetries_of(turn: Ints, vertex: Ints, face: Ints, kinds: Ints) -> Ints:
    """Return the symmetries of a mechanism as permutations of its corners."""
    none = np.zeros(len(vertex), np.int64)
    _, orders, sides = code_of(turn, vertex, none, face, kinds, face[0])
    return symmetries_of_map(turn, orders, sides)[1]


@compiled
def explicit_sets(kinds: Ints, number: Ints) -> Ints:
    """Return all sets of faces with finite centres, no two of a class, as bits."""
    found = np.zeros(1 << min(len(kinds), 20), np.int64)
    used = 1
    for f in range(len(kinds)):
        if kinds[f] == FINITE:
            before = used
            for i in range(before):
                clash = False
                for g in range(f):
                    clash |= (found[i] >> g) & 1 == 1 and number[g] == number[f]
                if not clash:
                    found[used] = found[i] | (1 << f)
                    used += 1
    return found[:used].copy()


@compiled
def corner_states(face: Ints, kinds: Ints, pattern: Bytes, explicit: int) -> Bytes:
    """Return for each corner `CLOSED`, `OPENED` or `ANY`, with a choice of explicit faces made."""
    states = np.empty(len(face), np.uint8)
    for d in range(len(face)):
        f = face[d]
        if has_centre(kinds[f]):
            states[d] = CLOSED if (explicit >> f) & 1 else OPENED
        else:
            states[d] = pattern[d]
    return states


@compiled
def room_of(vertex: Ints, states: Bytes, most: int) -> tuple[Ints, Ints, Ints]:
    """Return for each link the number of corners that take open edges, and limits of how many more they take."""
    links = 0
    for d in range(len(vertex)):
        links = max(links, vertex[d] + 1)
    slots, low, high = np.zeros(links, np.int64), np.full(links, 3), np.full(links, most)
    for d in range(len(vertex)):
        taken = 1 + (states[d] == OPENED)
        slots[vertex[d]] += states[d] != CLOSED
        low[vertex[d]] -= taken
        high[vertex[d]] -= taken
    for v in range(links):
        low[v] = max(low[v], 0)
    return slots, low, high


@compiled
def ways_to_lay(slots: int, low: int, high: int) -> int:
    """Return in how many ways low to high things lie in some slots."""
    if slots == 0:
        return 1 if low == 0 and high >= 0 else 0
    total = 0
    for things in range(low, high + 1):
        binomial = 1
        for k in range(slots - 1):
            binomial = binomial * (things + k + 1) // (k + 1)
        total += binomial
    return total


@compiled
def placements_of_choice(vertex: Ints, states: Bytes, most: int) -> int:
    """Return the number of placements of one choice of pattern and explicit faces; -1 if it is past counting."""
    slots, low, high = room_of(vertex, states, most)
    product = 1
    for v in range(len(slots)):
        ways = ways_to_lay(slots[v], low[v], high[v])
        if ways == 0:
            return 0
        if product > TOO_MANY // ways:
            return -1
        product *= ways
    return product


@compiled
def number_of_placements(code: Bytes, labels: Ints, most: int) -> int:
    """Return the number of placements on a mechanism, symmetric ones counted apart; -1 if it is past counting.

    The code has no labels; these are in the order in which it meets the faces, the outer one first. No link has a
    degree above `most`.
    """
    turn, vertex, face, kinds, number = drawn(code, labels)
    sets = explicit_sets(kinds, number)
    allowed = patterns(turn, vertex, face, kinds, number, most)
    total = 0
    for explicit in sets:
        for p in range(len(allowed)):
            count = placements_of_choice(vertex, corner_states(face, kinds, allowed[p], explicit), most)
            if count < 0 or total > TOO_MANY:
                return -1
            total += count
    return total


@compiled
def forced_mobility(turn: Ints, face: Ints, kinds: Ints, number: Ints, pattern: Bytes) -> int:
    """Return joints minus rank with the shared vertices of a pattern placed too (rule S3).

    Where there are spatial loops and some joint cannot move: -1.
    """
    moving = False
    for f in range(len(kinds)):
        moving |= kinds[f] == SPATIAL
    points, count = points_of_pattern(turn, face, number, pattern)
    at_infinity = np.zeros(count, np.int64)
    for f in range(len(kinds)):
        if kinds[f] == INFINITE:
            at_infinity[number[f]] = 1
    return mobility_of(face, kinds, points, at_infinity, moving)


@compiled
def all_explicit(kinds: Ints, explicit: int) -> bool:
    """Tell whether all bounded faces are among the explicit ones."""
    found = True
    for f in range(len(kinds)):
        found &= kinds[f] == OUTER or (explicit >> f) & 1 == 1
    return found


@compiled
def numbers_of_placements(codes: Bytes, labels: Ints, most: int) -> Ints:
    """Return `number_of_placements` of each of some mechanisms: int64[r]."""
    found = np.zeros(len(codes), np.int64)
    for r in range(len(codes)):
        found[r] = number_of_placements(codes[r], labels[r], most)
    return found


@compiled
def outline(code: Bytes, labels: Ints) -> tuple[Bytes, Ints, int, int]:
    """Return of a mechanism its canonical code with labels, its joints, and numbers of classes.

    The numbers are of all classes, and of those with a centre at infinity; arguments are those of
    `number_of_placements`.
    """
    turn, vertex, face, kinds, number = drawn(code, labels)
    none = np.zeros(len(vertex), np.int64)
    text, _, _ = code_of(turn, vertex, none, face, kinds, face[0])
    classes = infinite = 0
    for f in range(len(number)):
        if number[f] == classes:  # classes are numbered as they come
            classes += 1
            infinite += kinds[f] == INFINITE
    return text, vertex.reshape(-1, 2), classes, infinite
