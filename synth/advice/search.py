"""The smallest sets of diagonals that bring freedoms: by their columns, and each folded.

A set brings as many rates as it has creases, less the rank of its columns on the self-stresses, and no more
freedoms than that. So only sets of which enough columns depend on others are creased and folded. Theory:
docs/theory/advice.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from graphs.creasing.edits import crease_sheet, lock_crease
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.advice.diagonals import Diagonal
from synth.folding.configuration import configuration_of_sheet
from synth.motion.walk.allowance import Allowance

__all__ = ["Bounds", "Candidates", "Found", "freedoms_when_creased", "freedoms_when_left_out", "smallest_sets"]


MOST_FOLDED = 100
"""Sheets with diagonals that are folded, of one size: a few seconds."""


@dataclass(frozen=True, slots=True)
class Candidates:
    """Diagonals to choose from, what each does to the self-stresses (float[s, D]), and how many may be added."""

    diagonals: Sequence[Diagonal]
    loads: Floats
    allowance: Allowance

    def dependent(self, size: int, wanted: int) -> Iterator[tuple[int, ...]]:
        """Yield the sets of a size, no two crossing, that bring so many rates or more.

        >>> few = [Diagonal(panel, panel, (0, 2), (0, 2)) for panel in range(3)]
        >>> loads = np.array([[1.0, 2.0, 0.0], [0.0, 0.0, 1.0]])
        >>> list(Candidates(few, loads, Allowance(100)).dependent(2, 1))
        [(0, 1)]
        """
        yield from self._grown((), self.loads, size - wanted, size)

    def _grown(self, chosen: tuple[int, ...], loads: Floats, rank: int, size: int) -> Iterator[tuple[int, ...]]:
        """Yield sets that begin with some; loads across theirs are left, and so much rank at most."""
        if len(chosen) == size:
            yield chosen
            return
        for place in range(chosen[-1] + 1 if chosen else 0, len(self.diagonals)):
            if not self.allowance.take():
                return
            if any(self.diagonals[place].crosses(self.diagonals[other]) for other in chosen):
                continue
            load = loads[:, place]
            length = float(np.linalg.norm(load))
            if length <= DOUBLE.zero:
                yield from self._grown((*chosen, place), loads, rank, size)
            elif rank:
                along = load / length
                yield from self._grown((*chosen, place), loads - np.outer(along, along @ loads), rank - 1, size)


class Bounds(NamedTuple):
    """What is searched for: the freedoms and rates there are, the freedoms wanted, the largest size of a set."""

    freedoms: int
    rates: int
    wanted: int
    largest: int


@dataclass(frozen=True, slots=True)
class Found:
    """The smallest sets that have the freedoms when folded, and the largest size that was searched.

    `more`: there may be more sets of that size, since a limit was reached; `refused` counts sets that have the
    rates but, folded, not the freedoms; `used_up`: the search ended because its allowance was used up.
    """

    sets: tuple[tuple[int, ...], ...]
    searched: int
    more: bool
    refused: int
    used_up: bool = False


def smallest_sets(sheet: Sheet, candidates: Candidates, bounds: Bounds, limit: int) -> Found:
    """Return the smallest sets of diagonals, up to a limit, that give a sheet at a general pose its freedoms."""
    refused = 0
    for size in range(bounds.wanted - bounds.freedoms, bounds.largest + 1):
        sets: list[tuple[int, ...]] = []
        more = False
        for folded, places in enumerate(candidates.dependent(size, bounds.wanted - bounds.rates)):
            if len(sets) == limit or folded == MOST_FOLDED:
                more = True
                break
            if freedoms_when_creased(sheet, [candidates.diagonals[place] for place in places]) == bounds.wanted:
                sets.append(places)
            else:
                refused += 1
        used_up = candidates.allowance.left < 0
        if sets or more or used_up:
            return Found(tuple(sets), size, more or used_up, refused, used_up)
    return Found((), bounds.largest, False, refused)


def freedoms_when_creased(sheet: Sheet, diagonals: Sequence[Diagonal]) -> int | None:
    """Return the freedoms of a sheet with creases along diagonals, on its freest way; None if not known.

    The ways are those from the pose of the sheet.
    """
    for diagonal in diagonals:
        sheet = crease_sheet(sheet, *diagonal.ends).sheet
    return _freest(sheet)


def freedoms_when_left_out(sheet: Sheet, joints: Sequence[int]) -> int | None:
    """Return the freedoms of a sheet without some creases, on its freest way from its pose; None if not known.

    >>> corners = ((0, 0), (1, 0), (2, 0), (3, 0), (3, 1), (2, 1), (1, 1), (0, 1))
    >>> strip = Sheet(8, ((1, 6), (2, 5)), "VM", ((0, 1, 6, 7), (1, 2, 5, 6), (2, 3, 4, 5)), corners)
    >>> freedoms_when_left_out(strip, [0])
    1
    """
    for joint in joints:
        sheet = lock_crease(sheet, joint).sheet
    return _freest(sheet)


def _freest(sheet: Sheet) -> int | None:
    pattern = configuration_of_sheet(sheet)
    if not pattern.linkage.graph.joints:
        return 0
    found = pattern.branches
    if found is None:
        return None
    known = [branch.freedoms for branch in found.branches if branch.certainty != "not known"]
    if any(freedoms is None for freedoms in known):
        return None
    return max((freedoms for freedoms in known if freedoms is not None), default=0 if found.exhaustive else None)
