"""Placements of open edges on a drawn mechanism, listed, and counted by Burnside's lemma, compiled.

A placement is a *pattern* (`enumerate.scd.patterns`), a set of *explicit* faces whose corners have no open edge,
at most one of a class, and a number of open edges in each corner that may have some. With pattern and explicit
faces chosen, links do not depend on each other, so the placements of a mechanism are numbered: those of each
choice follow each other, and count through the ways of the links like the digits of a number. Any range of
numbers can be listed. Of each orbit under the symmetries the largest placement is kept.

The count makes no placement: one that a symmetry leaves as it is, is constant on the cycles of corners, and a
cycle of links is as free as one of its links. Theory: docs/theory/scd-enumeration.md.
"""

from typing import NamedTuple

import numpy as np

from enumerate.contracted.binary_links import symmetries_fixing
from enumerate.contracted.maps import code_of
from enumerate.kernel._compiled import compiled, doubled, number_of_orbits
from enumerate.kernel.maps import END
from enumerate.scd.patterns import (
    CLOSED,
    OPENED,
    TOO_MANY,
    all_explicit,
    corner_states,
    corner_symmetries,
    drawn,
    explicit_sets,
    forced_mobility,
    has_centre,
    patterns,
    placements_of_choice,
    room_of,
    ways_to_lay,
)
from graphs.types import Bytes, Flags, Ints

SCD_FACTS = ("open_edges", "vertices", "explicit", "implicit", "symmetry", "exact_dof")
"""Columns of the facts of `list_placements_of`."""


class Choice(NamedTuple):
    """A drawn mechanism with a pattern and explicit faces chosen: what its corners may hold.

    With `fewest` every link takes as few open edges as it can.
    """

    turn: Ints
    vertex: Ints
    face: Ints
    kinds: Ints
    states: Bytes
    symmetries: Ints
    most: int
    fewest: bool


@compiled
def list_placements_of(
    code: Bytes, labels: Ints, most: int, dof: int, first: int, last: int, sheets: bool, symmetric: bool
) -> tuple[Bytes, Ints, Ints]:
    """List placements of open edges on a mechanism, one of each orbit, those of a range of numbers.

    Code, labels and the greatest link degree are those of `enumerate.scd.patterns.number_of_placements`; the last
    number is excluded, and the rank must give `dof`. `sheets`: only those with an explicit centre in every bounded
    face; `symmetric`: only those with a symmetry. Returns codes, uint8[r, width], with the labels at their end,
    then nothing; their lengths; and `SCD_FACTS`, int64[r, 6].
    """
    turn, vertex, face, kinds, number = drawn(code, labels)
    symmetries = corner_symmetries(turn, vertex, face, kinds)
    sets = explicit_sets(kinds, number)
    allowed = patterns(turn, vertex, face, kinds, number, most)
    links = len(code) - len(vertex)
    codes = np.zeros((64, len(vertex) + links + len(labels) + links * most), np.uint8)
    facts = np.zeros((64, len(SCD_FACTS) + 1), np.int64)
    used = start = 0
    for p in range(len(allowed)):
        mobility = -2  # not yet known
        for explicit in sets:
            if sheets and not all_explicit(kinds, explicit):
                continue
            states = corner_states(face, kinds, allowed[p], explicit)
            size = placements_of_choice(vertex, states, most)
            begin, end = max(first - start, 0), min(last - start, size)
            start += size
            if begin >= end:
                continue
            if mobility == -2:
                mobility = forced_mobility(turn, face, kinds, number, allowed[p])
            if mobility == dof:
                choice = Choice(turn, vertex, face, kinds, states, symmetries, most, False)
                codes, facts, used = list_choice(choice, begin, end, symmetric, codes, facts, used)
    for r in range(used):
        facts[r, 5] = dof
    return codes[:used], facts[:used, 6].copy(), facts[:used, :6].copy()


@compiled
def list_choice(
    choice: Choice, begin: int, end: int, symmetric: bool, codes: Bytes, facts: Ints, used: int
) -> tuple[Bytes, Ints, int]:
    """Write the placements of one choice with numbers from begin to end, the facts and length of each in one row."""
    turn, vertex, face, kinds, states, symmetries, most, fewest = choice
    rows, offset = _tables(vertex, states, most, fewest)
    digit = _digits(offset, begin)
    place = _places(vertex, states, len(digit))
    explicit, implicit, unopened = _face_facts(face, kinds, states)
    placement = np.zeros(len(vertex), np.int64)
    for _ in range(begin, end):
        total = 0
        for d in range(len(vertex)):
            if states[d] != CLOSED:
                things = int(rows[offset[vertex[d]] + digit[vertex[d]], place[d]])
                placement[d] = (states[d] == OPENED) + things
                total += placement[d]
        fixed = symmetries_fixing(placement, symmetries)
        if fixed > symmetric:
            if used == len(codes):
                codes, facts = doubled(codes), doubled(facts)
            text, _, _ = code_of(turn, vertex, placement, face, kinds, face[0])
            for k in range(len(text)):
                codes[used, k] = text[k]
            facts[used, 0], facts[used, 1], facts[used, 2] = total, total + unopened, explicit
            facts[used, 3], facts[used, 4], facts[used, 6] = implicit, fixed, len(text)
            used += 1
        _count_on(digit, offset)
    return codes, facts, used


@compiled
def _tables(vertex: Ints, states: Bytes, most: int, fewest: bool) -> tuple[Bytes, Ints]:
    """Return the ways of all links to take open edges, one a row, and where those of each link begin."""
    slots, low, high = room_of(vertex, states, most)
    if fewest:
        high = low
    offset = np.zeros(len(slots) + 1, np.int64)
    for v in range(len(slots)):
        offset[v + 1] = offset[v] + ways_to_lay(slots[v], low[v], high[v])
    rows = np.zeros((offset[-1], most), np.uint8)
    for v in range(len(slots)):
        here = _compositions(slots[v], low[v], high[v])
        for i in range(len(here)):
            for k in range(slots[v]):
                rows[offset[v] + i, k] = here[i, k]
    return rows, offset


@compiled
def _digits(offset: Ints, number: int) -> Ints:
    """Return the way of each link in the placement of a number."""
    digit = np.zeros(len(offset) - 1, np.int64)
    for v in range(len(digit) - 1, -1, -1):
        ways = offset[v + 1] - offset[v]
        digit[v] = number % ways
        number //= ways
    return digit


@compiled
def _count_on(digit: Ints, offset: Ints) -> None:
    """Go on to the next placement."""
    v = len(digit) - 1
    while v >= 0:
        digit[v] += 1
        if digit[v] < offset[v + 1] - offset[v]:
            return
        digit[v] = 0
        v -= 1


@compiled
def _places(vertex: Ints, states: Bytes, links: int) -> Ints:
    """Return the place of each corner among those of its link that take open edges."""
    place = np.zeros(len(vertex), np.int64)
    seen = np.zeros(links, np.int64)
    for d in range(len(vertex)):
        if states[d] != CLOSED:
            place[d] = seen[vertex[d]]
            seen[vertex[d]] += 1
    return place


@compiled
def _face_facts(face: Ints, kinds: Ints, states: Bytes) -> tuple[int, int, int]:
    """Return the numbers of explicit and implicit centres, and of faces without open edges."""
    closed = np.ones(len(kinds), np.bool_)
    for d in range(len(face)):
        closed[face[d]] &= states[d] == CLOSED
    explicit = centres = 0
    for f in range(len(kinds)):
        if has_centre(kinds[f]):
            centres += 1
            explicit += closed[f]
    return explicit, centres - explicit, closed.sum()


@compiled
def _compositions(slots: int, low: int, high: int) -> Bytes:
    """Return all ways to lay low to high things into slots, one a row."""
    found = np.zeros((ways_to_lay(slots, low, high), max(slots, 1)), np.uint8)
    if slots == 0:
        return found
    used = 0
    things = np.zeros(slots, np.int64)
    for total in range(low, high + 1):
        for k in range(slots):
            things[k] = 0
        things[0] = total
        while True:
            for k in range(slots):
                found[used, k] = things[k]
            used += 1
            k = 0
            while k < slots and things[k] == 0:
                k += 1
            if k >= slots - 1:
                break
            held = things[k]
            things[k] = 0
            things[0] = held - 1
            things[k + 1] += 1
    return found


@compiled
def sides_of_all(codes: Bytes, lengths: Ints, labels: int, most: int) -> Ints:
    """Return how many links have each number of sides: int64[r, most + 1].

    Codes, of which `labels` end each, and lengths are those of `list_placements_of`; `most` is the greatest link
    degree.
    """
    found = np.zeros((len(codes), most + 1), np.int64)
    for r in range(len(codes)):
        sides = 0
        for k in range(lengths[r] - labels):
            if codes[r, k] == END:
                found[r, sides] += 1
                sides = 0
            else:
                sides += 1
    return found


@compiled
def count_placements(code: Bytes, labels: Ints, most: int, dof: int, sheets: bool) -> int:
    """Return the number of placements up to symmetry, -1 if it is past counting.

    The arguments are those of `enumerate.scd.listing.list_placements_of`.
    """
    turn, vertex, face, kinds, number = drawn(code, labels)
    symmetries = corner_symmetries(turn, vertex, face, kinds)
    sets = explicit_sets(kinds, number)
    allowed = patterns(turn, vertex, face, kinds, number, most)
    fixed = 0
    for p in range(len(allowed)):
        if forced_mobility(turn, face, kinds, number, allowed[p]) != dof:
            continue
        for explicit in sets:
            if sheets and not all_explicit(kinds, explicit):
                continue
            states = corner_states(face, kinds, allowed[p], explicit)
            for a in range(len(symmetries)):
                count = _fixed_by(vertex, states, symmetries[a], most)
                if count < 0 or fixed > TOO_MANY:
                    return -1
                fixed += count
    return number_of_orbits(fixed, len(symmetries))


@compiled
def _fixed_by(vertex: Ints, states: Bytes, symmetry: Ints, most: int) -> int:
    """Return the number of placements of one choice that a symmetry leaves as they are; -1 if past counting."""
    for d in range(len(vertex)):
        if states[symmetry[d]] != states[d]:
            return 0
    slots, low, high = room_of(vertex, states, most)
    done = np.zeros(len(slots), np.bool_)
    product = 1
    for v in range(len(slots)):
        if done[v]:
            continue
        total = _ways_in_cycles(vertex, states, symmetry, v, low[v], high[v], done)
        if total == 0:
            return 0
        if product > TOO_MANY // total:
            return -1
        product *= total
    return product


@compiled
def _ways_in_cycles(vertex: Ints, states: Bytes, symmetry: Ints, link: int, low: int, high: int, done: Flags) -> int:
    """Return in how many ways a link takes low to high open edges that a symmetry leaves as they are.

    The links in its cycle are noted in ``done``.
    """
    ways = np.zeros(max(high, 0) + 1, np.int64)  # with so many open edges
    ways[0] = 1
    seen = np.zeros(len(vertex), np.bool_)
    for d in range(len(vertex)):
        if vertex[d] != link or seen[d]:
            continue
        weight, e = 0, d
        while not seen[e]:
            seen[e] = done[vertex[e]] = True
            weight += vertex[e] == link
            e = symmetry[e]
        if states[d] != CLOSED:
            for k in range(weight, len(ways)):
                ways[k] += ways[k - weight]
    total = 0
    for k in range(low, high + 1):
        total += ways[k]
    return total
