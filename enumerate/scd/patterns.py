"""Open edges in the corners of a drawn mechanism: the rules they obey, and what placements may choose, compiled.

Rules S1 and S2 (`graphs.mechanism.scd`) look at the points that joints and links share: the centres of the
classes, and the vertices in faces without a centre that several joints end in. These depend on one thing only: in
which corners of the faces without a centre there is no open edge. A *pattern* says so for every such corner; it is
valid or not, however many open edges there are elsewhere. With a pattern and a set of explicit faces chosen, links
do not depend on each other: each takes open edges in some of its corners, as many as its degree allows. Theory:
docs/theory/scd-enumeration.md.
"""

import numpy as np

from enumerate.contracted.maps import code_of
from enumerate.kernel._compiled import compiled, doubled
from enumerate.kernel.centres import (
    FINITE,
    FREE,
    INFINITE,
    OUTER,
    SPATIAL,
    centres_at_infinity,
    classes_of,
    joints_of_faces,
    mobility_of,
    points_of_ends,
)
from enumerate.kernel.maps import decode_map, faces_of, symmetries_of_map
from enumerate.kernel.words import has_several
from graphs.types import Bytes, Ints, Words

# What a pattern says of a corner.
CLOSED = 0  # no open edge
OPENED = 1  # one or more
ANY = 2  # either

# Sets of points are bits of a word that has a sign.
_MOST_POINTS = 63


@compiled
def label_faces(turn: Ints, vertex: Ints, face: Ints, labels: Ints) -> Ints:
    """Return the labels of faces by their numbers, given in the order in which the code of the map meets them."""
    found = np.full(len(labels), -1, np.int64)
    start = np.full(len(vertex), -1, np.int64)
    for d in range(len(vertex)):  # a link is met by the joint of the least number
        if start[vertex[d]] < 0:
            start[vertex[d]] = d
    met = 0
    for link in range(len(vertex)):
        d = start[link]
        while d >= 0:
            if found[face[d]] < 0:
                found[face[d]] = labels[met]
                met += 1
            d = turn[0, d]
            if d == start[link]:
                break
    return found


@compiled
def patterns(turn: Ints, vertex: Ints, face: Ints, labels: Ints, number: Ints, most: int) -> Bytes:
    """Return the valid patterns of a mechanism: uint8[p, D].

    They are `CLOSED`, `OPENED` or `ANY` for the corners of faces without a centre, `CLOSED` elsewhere. `number`
    holds the classes of the faces, `most` is the greatest link degree.
    """
    darts = len(vertex)
    found = np.zeros((4, darts), np.uint8)
    free, pattern = undecided_corners(turn, vertex, face, labels, number, most)
    used = 0
    for choice in range(1 << len(free)):
        for i in range(len(free)):
            pattern[free[i]] = (choice >> i) & 1
        if keeps_rules(turn, vertex, face, labels, number, pattern):
            found = doubled(found) if used == len(found) else found
            for d in range(darts):
                found[used, d] = pattern[d]
            used += 1
    return found[:used]


@compiled
def undecided_corners(
    turn: Ints, vertex: Ints, face: Ints, labels: Ints, number: Ints, most: int
) -> tuple[Ints, Bytes]:
    """Return the corners that can have open edges or none, and a pattern with the others decided.

    Without an open edge the two joints of a corner have a vertex in common, so they must not have a centre in
    common. In a tree nothing has to be decided.
    """
    darts = len(vertex)
    if len(labels) == 1:
        return np.zeros(0, np.int64), np.full(darts, ANY, np.uint8)
    degree = np.bincount(vertex)
    pattern = np.zeros(darts, np.uint8)
    free = np.zeros(darts, np.int64)
    unsure = 0
    for d in range(darts):
        if has_centre(labels[face[d]]):
            continue
        one, other = number[face[d ^ 1]], number[face[turn[0, d]]]
        if one >= 0 and one == other:
            pattern[d] = OPENED
        elif degree[vertex[d]] < most:
            free[unsure] = d
            unsure += 1
    return free[:unsure], pattern


@compiled
def keeps_rules(turn: Ints, vertex: Ints, face: Ints, labels: Ints, number: Ints, pattern: Bytes) -> bool:
    """Tell whether a pattern is valid; in a tree no pattern breaks a rule."""
    if len(labels) == 1:
        return True
    return _opens(face, labels, pattern) and _keeps_apart(turn, vertex, face, number, pattern)


@compiled
def has_centre(label: int) -> bool:
    """Tell whether a face with this label has a centre."""
    return label == FINITE or label == INFINITE  # noqa: PLR1714 - numba takes long over a tuple


@compiled
def _opens(face: Ints, labels: Ints, pattern: Bytes) -> bool:
    """Tell whether each face without a centre has open edges in three corners."""
    for f in range(len(labels)):
        if not has_centre(labels[f]):
            corners = 0
            for d in range(len(face)):
                corners += face[d] == f and pattern[d] != CLOSED
            if corners < 3:
                return False
    return True


@compiled
def points_of_pattern(turn: Ints, face: Ints, number: Ints, pattern: Bytes) -> tuple[Ints, int]:
    """Return the points that the axis of each joint shares with others: int64[J, 2], and the number of points.

    Points are the classes, then the vertices in faces without a centre in which several joints end.
    """
    darts = len(face)
    count = np.int64(0)
    end = np.full(darts, FREE, np.int64)  # the point on the left of each dart
    for d in range(darts):
        end[d] = number[face[d]]
        count = max(count, number[face[d]] + 1)
    for d in range(darts):  # a vertex reaches from a corner with open edges to the next one
        if pattern[d] != OPENED or pattern[turn[1, d ^ 1]] != CLOSED or number[face[d]] >= 0:
            continue
        following = d
        end[d] = count
        while pattern[turn[1, following ^ 1]] == CLOSED:
            following = turn[1, following ^ 1]
            end[following] = count
        count += 1
    return points_of_ends(end), int(count)


@compiled
def _keeps_apart(turn: Ints, vertex: Ints, face: Ints, number: Ints, pattern: Bytes) -> bool:
    """Tell whether a pattern keeps rules S1 and S2."""
    points, count = points_of_pattern(turn, face, number, pattern)
    if count > _MOST_POINTS:
        return False
    joints = len(points)
    on_axis = np.zeros(joints, np.uint64)
    at_link = np.zeros(joints + 1, np.uint64)
    for k in range(joints):
        for end in range(2):
            if points[k, end] >= 0:
                on_axis[k] |= np.uint64(1) << np.uint64(points[k, end])
        for i in range(k):
            if has_several(on_axis[k] & on_axis[i]):
                return False
        for side in range(2):
            at_link[vertex[2 * k + side]] |= on_axis[k]
    return _links_apart(vertex, on_axis, at_link)


@compiled
def _links_apart(vertex: Ints, on_axis: Words, at_link: Words) -> bool:
    """Tell whether links keep rule S2: they share one point, or points of the axis of their joint."""
    for u in range(len(at_link)):
        for v in range(u):
            common = at_link[u] & at_link[v]
            if common == 0:
                continue
            joined = fits = False
            for k in range(len(on_axis)):
                a, b = vertex[2 * k], vertex[2 * k + 1]
                if (a == u and b == v) or (a == v and b == u):
                    joined = True
                    fits |= common & ~on_axis[k] == 0
            if (joined and not fits) or (not joined and has_several(common)):
                return False
    return True


TOO_MANY = 1 << 60
"""Numbers of placements from here on are not counted: sums of two of them still fit a word that has a sign."""


@compiled
def drawn(code: Bytes, labels: Ints) -> tuple[Ints, Ints, Ints, Ints, Ints]:
    """Return map, faces, labels and classes of a mechanism; labels come in the order of the code."""
    turn, vertex, _ = decode_map(code)
    face, faces = faces_of(turn)
    kinds = label_faces(turn, vertex, face, labels)
    number, _ = classes_of(joints_of_faces(face, faces), kinds)
    return turn, vertex, face, kinds, number


@compiled
def corner_symmetries(turn: Ints, vertex: Ints, face: Ints, kinds: Ints) -> Ints:
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
    links = vertex.max() + 1
    slots, low, high = np.zeros(links, np.int64), np.full(links, 3), np.full(links, most)
    for d in range(len(vertex)):
        taken = 1 + (states[d] == OPENED)
        slots[vertex[d]] += states[d] != CLOSED
        low[vertex[d]] -= taken
        high[vertex[d]] -= taken
    return slots, np.maximum(low, 0), high


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
    points, count = points_of_pattern(turn, face, number, pattern)
    return mobility_of(face, kinds, points, centres_at_infinity(kinds, number, count), (kinds == SPATIAL).any())


@compiled
def all_explicit(kinds: Ints, explicit: int) -> bool:
    """Tell whether all bounded faces are among the explicit ones."""
    found = True
    for f in range(len(kinds)):
        found &= kinds[f] == OUTER or (explicit >> f) & 1 == 1
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
    return text, vertex.reshape(-1, 2), classes, int(infinite)
