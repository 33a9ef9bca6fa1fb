"""The placement with the fewest open edges on a drawn mechanism, found without making the others.

With a pattern and explicit faces chosen (`enumerate.scd.patterns`) every link takes as few open edges as it can, so
their number follows from counts. Choices are tried in the order of this number, equal ones in the order of
`enumerate.scd.listing`; rules and rank are checked when it is a choice's turn, and the first placement that represents
its orbit is the one. Theory: docs/theory/scd-enumeration.md.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from heapq import heappop, heappush
from math import prod
from typing import Any

import numpy as np
import numpy.typing as npt

from enumerate.kernel.centres import SPATIAL
from enumerate.scd.listing import SCD_FACTS, Choice, list_choice
from enumerate.scd.patterns import (
    CLOSED,
    OPENED,
    corner_states,
    corner_symmetries,
    drawn,
    explicit_sets,
    forced_mobility,
    has_centre,
    keeps_rules,
    room_of,
    undecided_corners,
    ways_to_lay,
)
from graphs.errors import UnsolvableError, numbered
from graphs.types import Bytes, Flags, Ints

Numbers = npt.NDArray[np.signedinteger[Any]]

_MOST_UNDECIDED = 22
"""Corners that may have open edges or not: of more than so many the choices take too much room."""
# The greatest number of 16 bits, which hold totals of open edges: so it is above each of them.
_IMPOSSIBLE = (1 << 15) - 1
# Placements of a choice that are made at first: a choice has few symmetries, so among the first few there nearly
# always is one that represents its orbit.
_FIRST = 16
# How many times as many are made each time that there is none: few rounds, and at most four times as many as needed.
_GROWTH = 4


def fewest_open_edges(code: Bytes, labels: Ints, most: int, dof: int) -> tuple[Bytes, Ints, Ints]:
    """Return the first of the placements with the fewest open edges of `enumerate.scd.listing.list_placements_of`.

    The arguments are those of that function; so are the arrays that are returned, of one row, or none if there is no
    placement. Raises `UnsolvableError` if too many corners are undecided.
    """
    none = np.zeros((0, 1), np.uint8), np.zeros(0, np.int64), np.zeros((0, len(SCD_FACTS)), np.int64)
    turn, vertex, face, kinds, number = drawn(code, labels)
    if dof < 0 and not (kinds == SPATIAL).any():  # joints are no fewer than the rank
        return none
    symmetries = corner_symmetries(turn, vertex, face, kinds)
    sets = explicit_sets(kinds, number)
    free, pattern = undecided_corners(turn, vertex, face, kinds, number, most)
    if len(free) > _MOST_UNDECIDED:
        limit = f"at most {_MOST_UNDECIDED} that may have open edges or none; try an SCD graph of it"
        raise UnsolvableError(f"the faces without a centre have {numbered(len(free), 'corner')}, expected {limit}")
    choices = _Choices.of(vertex, face, kinds, free, pattern, sets, most)
    found: int | None = None
    for total, place in choices.by_merit():
        if found is not None and total > found:
            break
        pattern[free] = (place >> np.arange(len(free))) & 1
        if not keeps_rules(turn, vertex, face, kinds, number, pattern):
            continue
        if forced_mobility(turn, face, kinds, number, pattern) != dof:
            continue
        found = total
        for explicit in sets[choices.fewest(place) == found].tolist():
            states = corner_states(face, kinds, pattern, explicit)
            choice = Choice(turn, vertex, face, kinds, states, symmetries, most, True)
            placement = _first_placement(choice)
            if placement is not None:
                codes, lengths, facts = placement
                facts[:, SCD_FACTS.index("exact_dof")] = dof
                return codes, lengths, facts
    assert found is None, "an orbit has a largest placement"
    return none


@dataclass(frozen=True)
class _Choices:
    """Patterns and sets of explicit faces, with what links take of open edges.

    A pattern opens some of the corners that are undecided, `opened` at each link: int8[patterns, links]. With a set
    the corners of other faces are opened too, `beside` and `slots` at each link, of which the second may stay
    closed: int8[sets, links].
    """

    degree: Numbers
    opened: Numbers
    enough: Flags
    beside: Numbers
    slots: Numbers
    most: int

    @classmethod
    def of(cls, vertex: Ints, face: Ints, kinds: Ints, free: Ints, pattern: Bytes, sets: Ints, most: int) -> "_Choices":
        """Return the choices of a mechanism: bit ``i`` of a pattern says whether the corner ``free[i]`` is opened."""
        links = int(vertex.max()) + 1

        def at_links(corners: Flags) -> Numbers:
            return np.bincount(vertex[corners], minlength=links).astype(np.int8)

        numbers = np.arange(1 << len(free))
        opened = np.zeros((len(numbers), links), np.int8)
        for i, corner in enumerate(free.tolist()):
            opened[:, vertex[corner]] += ((numbers >> i) & 1).astype(np.int8)
        pattern[free] = CLOSED
        states = [corner_states(face, kinds, pattern, explicit) for explicit in sets.tolist()]
        beside = np.array([at_links(state == OPENED) for state in states])
        slots = np.array([at_links(state != CLOSED) for state in states])
        enough = _open_faces(face, kinds, free, pattern, numbers)
        return cls(at_links(np.ones(len(vertex), dtype=bool)), opened, enough, beside, slots, most)

    def fewest(self, place: int) -> Numbers:
        """Return the fewest open edges of a pattern with each set of explicit faces, `_IMPOSSIBLE` where none fit."""
        return self._totals(self.opened[place] + self.beside, self.opened[place] + self.slots)

    def by_merit(self) -> Iterator[tuple[int, int]]:
        """Yield the fewest open edges of each pattern that has any, with its number, in order."""
        lower = self._totals(self.opened + self.beside.min(axis=0), self.opened + self.slots.max(axis=0))
        lower[~self.enough] = _IMPOSSIBLE
        waiting: list[tuple[int, int]] = []
        for place in np.argsort(lower, kind="stable").tolist():
            if lower[place] == _IMPOSSIBLE:
                break
            while waiting and waiting[0][0] < lower[place]:
                yield heappop(waiting)
            total = int(self.fewest(place).min())
            if total < _IMPOSSIBLE:
                heappush(waiting, (total, place))
        while waiting:
            yield heappop(waiting)

    def _totals(self, taken: Numbers, slots: Numbers) -> Numbers:
        fits = ((self.degree + taken <= self.most) & ((slots > 0) | (self.degree >= 3))).all(axis=1)
        total = np.maximum(taken, 3 - self.degree).sum(axis=1, dtype=np.int16)
        return np.where(fits, total, np.int16(_IMPOSSIBLE))


def _open_faces(face: Ints, kinds: Ints, free: Ints, pattern: Bytes, numbers: Ints) -> Flags:
    """Return which patterns open three corners of each face without a centre: bool[patterns]."""
    enough = np.ones(len(numbers), dtype=bool)
    for f in np.unique(face):
        if not has_centre(kinds[f]) and len(kinds) > 1:
            corners = np.full(len(numbers), (pattern[face == f] != CLOSED).sum(), np.int8)
            for i in np.flatnonzero(face[free] == f).tolist():
                corners += ((numbers >> i) & 1).astype(np.int8)
            enough &= corners >= 3
    return enough


def _first_placement(choice: Choice) -> tuple[Bytes, Ints, Ints] | None:
    """Return code, length and facts of the first placement of a choice that represents its orbit, if one does."""
    vertex, states, most = choice.vertex, choice.states, choice.most
    slots, low, _ = room_of(vertex, states, most)
    size = prod(int(ways_to_lay(*link)) for link in zip(slots.tolist(), low.tolist(), low.tolist(), strict=True))
    links = len(slots)
    begin, end = 0, min(_FIRST, size)
    while begin < end:
        codes = np.zeros((_FIRST, len(vertex) + links + len(choice.kinds) + links * most), np.uint8)
        facts = np.zeros((_FIRST, len(SCD_FACTS) + 1), np.int64)
        codes, facts, used = list_choice(choice, begin, end, False, codes, facts, 0)
        if used:
            return codes[:1], facts[:1, -1].copy(), facts[:1, :-1].copy()
        begin, end = end, min(_GROWTH * end, size)
    return None
