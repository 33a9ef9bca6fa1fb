"""Table 4 of Hyatt et al. 2021: the behaviour of four-bars by where their joints lie.

P1 to P4 follow each other round the circle. Case 1: the centre is outside their polygon, P4 P1 is the longest
chord. Case 2: the centre is inside; the labels are such that it lies in the sector of side 23 or 41 cut by the
two diagonals. The links are the sides (open), or two opposite sides and the diagonals: crossed 1 has sides 12
and 34, crossed 2 has 23 and 41. Column A or B: which pair of opposite links is ground and coupler. Which picture
the paper calls A or B, 1 or 2 is in its figure only; these names make the printed table true. Theory:
docs/theory/behaviour.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError
from graphs.tolerances import DOUBLE
from graphs.types import Floats

__all__ = ["COLUMNS", "ROWS", "TableRow", "table4", "table_row"]


ROWS: dict[tuple[int, str, str], tuple[str, str]] = {
    (1, "open", "A"): ("Y*", "Y"),
    (1, "open", "B"): ("N", "N"),
    (1, "crossed 1", "A"): ("Y", "Y"),
    (1, "crossed 1", "B"): ("N", "N"),
    (1, "crossed 2", "A"): ("N", "N"),
    (1, "crossed 2", "B"): ("Y*", "Y"),
    (2, "open", "A"): ("N", "N"),
    (2, "open", "B"): ("N", "N"),
    (2, "crossed 1", "A"): ("Y*", "Y"),
    (2, "crossed 1", "B"): ("N", "N"),
    (2, "crossed 2", "A"): ("N", "N*"),
    (2, "crossed 2", "B"): ("N", "N"),
}
"""(case, configuration, column) to intra- and extramobility; *: the other way where a chord is a diameter."""

COLUMNS: dict[tuple[str, str], frozenset[frozenset[int]]] = {
    key: frozenset(map(frozenset, pair))
    for key, pair in {
        ("open", "A"): ((1, 2), (3, 4)),
        ("open", "B"): ((2, 3), (4, 1)),
        ("crossed 1", "A"): ((1, 2), (3, 4)),
        ("crossed 1", "B"): ((1, 3), (2, 4)),
        ("crossed 2", "A"): ((2, 3), (4, 1)),
        ("crossed 2", "B"): ((1, 3), (2, 4)),
    }.items()
}
"""(configuration, column) to ground and coupler, each as the labels of its two joints."""

_SIDES = {
    "open": ((1, 2), (2, 3), (3, 4), (4, 1)),
    "crossed 1": ((1, 2), (2, 4), (4, 3), (3, 1)),
    "crossed 2": ((1, 3), (3, 2), (2, 4), (4, 1)),
}


@dataclass(frozen=True, slots=True)
class TableRow:
    """A four-bar's row of Table 4.

    Attributes
    ----------
    case : {1, 2}
    configuration : {"open", "crossed 1", "crossed 2"}
    column : {"A", "B"}
    labels : tuple of int
        Label (1 to 4) of each joint O, A, B, C.
    intramobile, extramobile : bool
        Whether the linkage can move so that all its links stay inside, or outside.
    special : bool
        Whether a chord is a diameter and the starred entries hold the other way.
    """

    case: int
    configuration: str
    column: str
    labels: tuple[int, ...]
    intramobile: bool
    extramobile: bool
    special: bool


def table4(case: int, configuration: str, column: str, *, diameter: bool = False) -> tuple[bool, bool]:
    """Return an entry of Table 4: intramobility and extramobility.

    Parameters
    ----------
    case : {1, 2}
    configuration : {"open", "crossed 1", "crossed 2"}
    column : {"A", "B"}
    diameter : bool, optional
        Whether P4 P1 (case 1) or a diagonal (case 2) is a diameter. A joint half a turn from the fixed joint of
        its link moves along the surface, and to second order outward: intramobility is lost, or extramobility
        gained.

    Raises
    ------
    InvariantError
        If there is no such entry.

    Examples
    --------
    >>> table4(1, "open", "A"), table4(1, "open", "A", diameter=True)
    ((True, True), (False, True))
    """
    if (case, configuration, column) not in ROWS:
        raise InvariantError("Table 4", f"no entry {case}, {configuration!r}, {column!r}", "one of the twelve")
    intra, extra = (
        entry.startswith("Y") != (diameter and entry.endswith("*")) for entry in ROWS[case, configuration, column]
    )
    return intra, extra


def table_row(places: npt.ArrayLike) -> TableRow:
    """Return a four-bar's row of Table 4.

    Parameters
    ----------
    places : float[4]
        Azimuths of O, A, B, C, radians; the ground link is C O, the coupler A B.

    Raises
    ------
    InvariantError
        Unless there are four different azimuths.

    Examples
    --------
    >>> row = table_row(np.radians([40, 90, 140, 0]))
    >>> row.case, row.configuration, row.column, row.intramobile
    (1, 'open', 'A', True)
    """
    t = np.asarray(places, dtype=float)
    if t.shape != (4,):
        raise InvariantError("azimuths", f"{t.size} azimuths", "four, of O, A, B, C")
    round_ = np.remainder(t, 2 * np.pi)
    order = np.argsort(round_)
    sorted_places = round_[order]
    gaps = np.remainder(np.roll(sorted_places, -1) - sorted_places, 2 * np.pi)
    if gaps.min() <= DOUBLE.parallel:
        raise InvariantError("azimuths", "two joints lie on one ruling line", "four different azimuths")
    widest = int(gaps.argmax())
    case = 1 if gaps[widest] >= np.pi - DOUBLE.parallel else 2
    first = (widest + 1) % 4 if case == 1 else _first_of_case_2(sorted_places)
    rank = np.empty(4, dtype=int)
    rank[order] = (np.arange(4) - first) % 4 + 1
    labels = tuple(rank.tolist())
    o, a, b, c = labels
    sides = frozenset(map(frozenset, ((o, a), (a, b), (b, c), (c, o))))
    configuration = next(name for name, links in _SIDES.items() if frozenset(map(frozenset, links)) == sides)
    pair = frozenset((frozenset((c, o)), frozenset((a, b))))
    column = "A" if COLUMNS[configuration, "A"] == pair else "B"
    if case == 1:
        special = bool(abs(gaps[widest] - np.pi) <= DOUBLE.parallel)
    else:
        across = sorted_places[2:] - sorted_places[:2]
        special = bool((np.abs(across - np.pi) <= DOUBLE.parallel).any())
    intra, extra = table4(case, configuration, column, diameter=special)
    return TableRow(case, configuration, column, labels, intra, extra, special)


def _first_of_case_2(places: Floats) -> int:
    """Return which joint is P1 where the centre is inside: it is in the sector of side 23 or 41 of the diagonals.

    The centre is on the left of the diagonal from i to i + 2 if that one spans less than half a turn. With P1
    first, it is in the sector of 41 or 23 if it is right of one of 13 and 24 and left of the other.
    """
    left_13 = places[2] - places[0] < np.pi
    left_24 = places[3] - places[1] < np.pi
    return 0 if left_13 == left_24 else 1
