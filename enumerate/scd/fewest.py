"""The placement with the fewest open edges on a drawn mechanism, found without making the others.

With a pattern and explicit faces chosen (`enumerate.scd.patterns`) every link takes as few open edges as it can, so
their number follows from counts. Choices are tried in the order of this number, equal ones in the order of
`enumerate.scd.listing`; rules and rank are checked when it is a choice's turn, and the first placement that represents
its orbit is the one. Theory: docs/theory/scd-enumeration.md.
"""

from math import prod

import numpy as np
import numpy.typing as npt

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

_MOST_UNDECIDED = 22
"""Corners that may have open edges or not: of more than so many the choices take too much room."""
_IMPOSSIBLE = (1 << 15) - 1
_FIRST, _GROWTH = 16, 4
"""Placements of a choice that are made at first, and how many more each time that none represents its orbit."""


def fewest_open_edges(code: Bytes, labels: Ints, most: int, dof: int) -> tuple[Bytes, Ints, Ints]:
    """Return the first of the placements with the fewest open edges of `enumerate.scd.listing.list_placements_of`.

    The arguments are those of that function; so are the arrays that are returned, of one row, or none if there is no
    placement. Raises `UnsolvableError` if too many corners are undecided.
    """
    turn, vertex, face, kinds, number = drawn(code, labels)
    symmetries = corner_symmetries(turn, vertex, face, kinds)
    sets = explicit_sets(kinds, number)
    free, pattern = undecided_corners(turn, vertex, face, kinds, number, most)
    if len(free) > _MOST_UNDECIDED:
        limit = f"at most {_MOST_UNDECIDED} that may have open edges or none; try an SCD graph of it"
        raise UnsolvableError(f"the faces without a centre have {numbered(len(free), 'corner')}, expected {limit}")
    fewest = _fewest_of_choices(vertex, face, kinds, free, pattern, sets, most)
    least = fewest.min(axis=1)
    found: int | None = None
    for place in np.argsort(least, kind="stable").tolist():
        if least[place] == _IMPOSSIBLE or (found is not None and least[place] > found):
            break
        pattern[free] = (place >> np.arange(len(free))) & 1
        if not keeps_rules(turn, vertex, face, kinds, number, pattern):
            continue
        if forced_mobility(turn, face, kinds, number, pattern) != dof:
            continue
        found = int(least[place])
        for explicit in sets[fewest[place] == found].tolist():
            states = corner_states(face, kinds, pattern, explicit)
            choice = Choice(turn, vertex, face, kinds, states, symmetries, most, True)
            placement = _first_placement(choice)
            if placement is not None:
                codes, lengths, facts = placement
                facts[:, SCD_FACTS.index("exact_dof")] = dof
                return codes, lengths, facts
    assert found is None, "an orbit has a largest placement"
    return np.zeros((0, 1), np.uint8), np.zeros(0, np.int64), np.zeros((0, len(SCD_FACTS)), np.int64)


def _fewest_of_choices(
    vertex: Ints, face: Ints, kinds: Ints, free: Ints, pattern: Bytes, sets: Ints, most: int
) -> npt.NDArray[np.int16]:
    """Return the fewest open edges of all choices: int16[patterns, explicit sets], `_IMPOSSIBLE` where they have none.

    Bit ``i`` of the number of a pattern says whether the undecided corner ``free[i]`` is opened.
    """
    links = int(vertex.max()) + 1
    degree = np.bincount(vertex, minlength=links).astype(np.int8)
    numbers = np.arange(1 << len(free))
    opened = np.zeros((len(numbers), links), np.int8)
    for i, corner in enumerate(free.tolist()):
        opened[:, vertex[corner]] += ((numbers >> i) & 1).astype(np.int8)
    fewest = np.full((len(numbers), len(sets)), _IMPOSSIBLE, np.int16)
    pattern[free] = CLOSED
    for column, explicit in enumerate(sets.tolist()):
        states = corner_states(face, kinds, pattern, explicit)
        taken, slots = (
            opened + np.bincount(vertex[held], minlength=links).astype(np.int8)
            for held in (states == OPENED, states != CLOSED)
        )
        fits = (degree + taken <= most) & ((slots > 0) | (degree >= 3))
        total = np.maximum(taken, 3 - degree).sum(axis=1)
        fewest[:, column] = np.where(fits.all(axis=1), total, _IMPOSSIBLE)
    fewest[~_open_faces(face, kinds, free, pattern, numbers)] = _IMPOSSIBLE
    return fewest


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
