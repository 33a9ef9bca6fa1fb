"""A crease pattern made ready to move: opened along its cuts, in its plane, and mended where rounding stopped it.

Theory: docs/theory/folding.md, docs/theory/mending.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice

import numpy as np

from graphs.arrays import Floats
from graphs.convert.duality import SheetMechanism, mechanism_of_sheet
from graphs.mechanism.precision import precision_of_sheet
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.tolerances import DOUBLE, Tolerances
from synth.folding.mending.misfit import least_misfit
from synth.folding.mending.places import VertexPlaces
from synth.folding.mending.repair import (
    EXACT,
    Mended,
    doubt_of,
    flattened,
    mended,
    nearly_agreeing,
    precision_of,
)
from synth.folding.opened import opened
from synth.motion.beginning import MOST_BRANCHES, MOST_JOINTS, search_for
from synth.motion.branches import Branches, branches_of
from synth.motion.closure import ClosureEquations
from synth.motion.driving import check_closed
from synth.motion.linkage import PosedLinkage, linkage_of_sheet
from synth.motion.second_order import rate_spaces, rates_at, rates_near
from synth.motion.singular.quadrics import quadrics_of

__all__ = ["Prepared", "prepared"]

_ALL_WAYS = 120
"""Of linkages of more joints one way to move is enough: there may be twice as many for each two panels more."""

_MOST_FLEXES = 100
"""Where closure equations depend on each other at a pose of more flexes, one way to move is enough."""

_FOLDED = 1e-9
_TURNED_WAYS = 4
"""So many motions are tried of what is rigid."""


@dataclass(frozen=True, slots=True)
class Prepared:
    """A crease pattern and what moves in it.

    Attributes
    ----------
    sheet : Sheet
        With vertices of their own for what cuts part.
    mechanism : SheetMechanism
    linkage : PosedLinkage
    closure : ClosureEquations
    branches : Branches or None
        The ways to move from the pose; None for a linkage that is too large, or where they were not looked for.
    repairs : tuple of Mended
        What was done to the coordinates.
    """

    sheet: Sheet
    mechanism: SheetMechanism
    linkage: PosedLinkage
    closure: ClosureEquations
    branches: Branches | None
    repairs: tuple[Mended, ...]

    @property
    def flat(self) -> bool:
        """Whether all fold angles are zero at the pose."""
        return bool(np.abs(self.linkage.angles).max(initial=0.0) <= _FOLDED)

    @property
    def marks(self) -> Floats:
        """1 for valleys and -1 for mountains, as marked; without marks, as they are folded, or all 0."""
        return marks_of(self.sheet, self.linkage)

    @property
    def wanted(self) -> Floats:
        """Which way joints are to go, 1 or -1: as they are marked, or all alike where nothing is."""
        return _wanted(self.marks)

    @property
    def doubt(self) -> str:
        """What rounded coordinates leave open where nothing moves; empty if they are exact."""
        precision = precision_of_sheet(self.sheet)
        if precision.size <= EXACT or self.branches is None or self.branches.branches:
            return doubt_of(precision)
        wanted, most = self.wanted, _most(self.linkage)
        near = nearly_agreeing(self.linkage, precision, wanted, most)
        misfits = [least_misfit(self.closure, self.linkage.angles, rates) for rates in islice(near, _TURNED_WAYS)]
        return doubt_of(precision, min(misfits, default=None))


def marks_of(sheet: Sheet, linkage: PosedLinkage) -> Floats:
    """Return 1 for joints that are marked as valleys and -1 for mountains; without marks as they are folded."""
    letters = {joint: sheet.assignments[joint] for joint in linkage.graph.joints if joint < len(sheet.edges)}  # type: ignore[operator,index]
    marks = np.array([{"V": 1.0, "M": -1.0}.get(letters.get(joint, "U"), 0.0) for joint in linkage.graph.joints])
    if marks.any():
        return marks
    return np.where(np.abs(linkage.angles) > _FOLDED, np.sign(linkage.angles), 0.0)


def prepared(sheet: Sheet, *, hinge_flat: bool = False, ways: bool = True) -> Prepared:
    """Make a crease pattern ready to move.

    Parameters
    ----------
    sheet : Sheet
        With coordinates.
    hinge_flat : bool, optional
        Make hinges of flat (F) edges too.
    ways : bool, optional
        Look for the ways to move from its pose; there may be hundreds.

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates, or panels do not fit at its pose.
    InvariantError
        If a crease has no length.

    Examples
    --------
    >>> corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    >>> pattern = prepared(Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), corners))
    >>> pattern.linkage, pattern.branches.regular
    (<PosedLinkage: 2 links, 1 joints, 0 loops>, True)
    """
    given = with_all_edges(sheet)
    flat = flattened(given)
    repairs = [] if flat is None else [flat]
    given = given if flat is None else flat.sheet
    mechanism = mechanism_of_sheet(given, hinge_flat=hinge_flat)
    apart = opened(given, mechanism)
    if apart is not given:
        mechanism = mechanism_of_sheet(apart, hinge_flat=hinge_flat)
    linkage = linkage_of_sheet(apart, mechanism)
    closure = ClosureEquations(linkage)
    check_closed(closure, linkage)
    repair = _repair(apart, mechanism, linkage)
    if repair is not None:
        apart, linkage = repair.sheet, linkage_of_sheet(repair.sheet, mechanism)
        closure = ClosureEquations(linkage)
        repairs.append(repair)
    branches = None
    if ways and not _too_large(linkage, closure):
        marks = marks_of(apart, linkage)
        search = search_for(len(marks), _wanted(marks))
        branches = branches_of(linkage, closure, search)
    return Prepared(apart, mechanism, linkage, closure, branches, tuple(repairs))


def _repair(sheet: Sheet, mechanism: SheetMechanism, linkage: PosedLinkage) -> Mended | None:
    """Return the sheet with its vertices moved, if it moves in fewer ways as it is written than it nearly does."""
    places = VertexPlaces(sheet, mechanism, linkage)
    precision = precision_of(places, sheet)
    if precision.size <= EXACT:
        return None
    wanted, most = _wanted(marks_of(sheet, linkage)), _most(linkage)
    nearly_all = () if most is None else _ways(linkage, Tolerances.of(precision.size).zero)

    def moves(linkage: PosedLinkage) -> bool:
        if most is not None:
            return _ways(linkage) >= nearly_all
        return rates_near(ClosureEquations(linkage), linkage.angles, quadrics_of(linkage), wanted) is not None

    if places.bent <= EXACT and moves(linkage):
        return None
    return mended(sheet, places, linkage, wanted, lambda one: moves(linkage_of_sheet(one, mechanism)), most)


def _too_large(linkage: PosedLinkage, closure: ClosureEquations) -> bool:
    """Tell whether all ways to move are too many to look for, or the equations between its rates too large."""
    joints = len(linkage.graph.joints)
    if joints > MOST_JOINTS or joints <= _MOST_FLEXES:
        return joints > MOST_JOINTS
    flexes = rates_at(closure, linkage.angles).shape[1]
    return bool(flexes > _MOST_FLEXES and joints - flexes < closure.rows)


def _wanted(marks: Floats) -> Floats:
    """Return which way joints are to go: as they are marked, or all alike."""
    return marks if marks.any() else np.ones(len(marks))


def _most(linkage: PosedLinkage) -> int | None:
    """Return how many spaces of rates are looked for; None for linkages too large to split their rates."""
    return MOST_BRANCHES if len(linkage.graph.joints) <= _ALL_WAYS else None


def _ways(linkage: PosedLinkage, zero: float = DOUBLE.zero) -> tuple[int, ...]:
    """Return the dimensions of the spaces of rates that agree, the largest first."""
    quadrics = quadrics_of(linkage)
    spaces, _ = rate_spaces(ClosureEquations(linkage), linkage.angles, quadrics, MOST_BRANCHES, zero)
    return tuple(sorted((space.basis.shape[1] for space in spaces), reverse=True))
