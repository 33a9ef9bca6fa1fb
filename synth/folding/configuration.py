"""A crease pattern at a configuration: opened along its cuts, in its plane, mended where rounding stopped it.

Theory: docs/theory/folding.md, docs/theory/mending.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import islice
from math import degrees

import numpy as np

from graphs.answer.mechanisms import lying
from graphs.arrays import Floats
from graphs.convert.duality import SheetMechanism, mechanism_of_sheet
from graphs.errors import UnsolvableError
from graphs.ids import JointId
from graphs.mechanism.precision import precision_of_sheet
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.tolerances import DOUBLE, Tolerances
from synth.folding.collisions import Collision, Panels
from synth.folding.mending.places import VertexPlaces
from synth.folding.mending.repair import Mended, flattened, mended, nearly_agreeing, precision_of
from synth.folding.opened import opened
from synth.folding.vertices import vertex_places
from synth.motion.branches import MOST_BRANCHES
from synth.motion.closure import ClosureEquations
from synth.motion.configuration import Configuration, Placed
from synth.motion.driving import check_closed
from synth.motion.linkage import PosedLinkage, linkage_of_sheet
from synth.motion.misfit import EXACT, doubt_of, least_misfit
from synth.motion.second_order import rate_spaces, rates_near
from synth.motion.singular.quadrics import quadrics_of

__all__ = ["SheetConfiguration", "configuration_of_sheet"]

_ALL_WAYS = 120
"""Of linkages of more joints one way to move is enough: there may be twice as many for each two panels more."""

_TURNED_WAYS = 4
"""So many motions are tried of what is rigid."""


@dataclass(frozen=True, eq=False, repr=False)
class SheetConfiguration(Configuration):
    """A crease pattern at a configuration.

    Attributes
    ----------
    drawn : Sheet
        As it was given.
    dual : SheetMechanism
        Of that sheet, in its plane if it is meant to lie in one.
    sheet : Sheet
        With vertices of their own for what cuts part, and vertices where they were moved to.
    mechanism : SheetMechanism
        Of this sheet.
    repairs : tuple of Mended
        What was done to the coordinates.
    """

    drawn: Sheet = field(kw_only=True)
    dual: SheetMechanism = field(kw_only=True)
    sheet: Sheet = field(kw_only=True)
    mechanism: SheetMechanism = field(kw_only=True)
    repairs: tuple[Mended, ...] = field(kw_only=True, default=())

    @property
    def verb(self) -> str:
        """What it does."""
        return "Folds"

    @cached_property
    def flat(self) -> bool:
        """Whether all fold angles are zero."""
        return bool(np.abs(self.linkage.angles).max(initial=0.0) <= DOUBLE.parallel)

    @property
    def limited(self) -> bool:
        """Whether joints end at 180 degrees."""
        return True

    @cached_property
    def marks(self) -> Floats:
        """1 for valleys and -1 for mountains, as assigned; without an assignment, as they are folded, or all 0."""
        return _marks_of(self.sheet, self.linkage)

    @property
    def mended(self) -> tuple[str, ...]:
        """What was done to rounded coordinates."""
        return tuple(map(str, self.repairs))

    @cached_property
    def doubt(self) -> str:
        """What rounded coordinates leave open where nothing moves; empty if they are exact."""
        precision = precision_of_sheet(self.sheet)
        if precision.size <= EXACT or self.branches is None or self.branches.branches:
            return doubt_of(precision)
        wanted, most = self.wanted, _most(self.linkage)
        near = nearly_agreeing(self.linkage, precision, wanted, most)
        misfits = [least_misfit(self.closure, self.linkage.angles, rates) for rates in islice(near, _TURNED_WAYS)]
        return doubt_of(precision, min(misfits, default=None))

    def placed(self, angles: Floats) -> Placed:
        """Return where vertices are at fold angles float[F, J], radians."""
        return Placed(*vertex_places(self.sheet, self.mechanism, self.linkage, angles))

    def ends_of(self, joints: Sequence[JointId]) -> dict[JointId, tuple[tuple[float, ...], tuple[float, ...]]]:
        """Return the two ends of creases, in the unit of the coordinates."""
        corners = self.sheet.coordinates
        assert corners is not None
        ends = {joint: self.mechanism.hinges[joint] for joint in joints}  # type: ignore[index]
        return {joint: (tuple(corners[a]), tuple(corners[b])) for joint, (a, b) in ends.items()}

    def at(self, angles: Floats, points: Floats | None = None) -> Sheet:
        """Return the sheet at fold angles float[J], radians.

        Parameters
        ----------
        angles : float[J]
        points : float[vertices, 3], optional
            Where its vertices are then, if that is known.
        """
        there = self.placed(angles[None]).points[0] if points is None else points
        column = {joint: place for place, joint in enumerate(self.joints)}
        turned = tuple(
            degrees(float(angles[column[edge]])) if edge in column else None
            for edge in range(len(self.sheet.edges))
        )
        return replace(self.sheet, coordinates=tuple(map(tuple, there.tolist())), fold_angles=turned, frames=None)

    def collision(self) -> Collision:
        """Return what ends a walk before panels pass through each other."""
        panel_of = {face: panel for panel, faces in enumerate(self.mechanism.panels) for face in faces}
        numbers = [panel_of[face] for face in range(len(self.sheet.faces))]

        def places(angles: Floats) -> Floats:
            return self.placed(angles).points

        here = places(self.linkage.angles[None])[0]
        return Collision(Panels(self.sheet.faces, numbers, here, self.tolerances), places)


def _marks_of(sheet: Sheet, linkage: PosedLinkage) -> Floats:
    """Return 1 for joints that are marked as valleys and -1 for mountains; without marks as they are folded."""
    letters = {joint: sheet.assignments[joint] for joint in linkage.graph.joints if joint < len(sheet.edges)}  # type: ignore[operator,index]
    marks = np.array([{"V": 1.0, "M": -1.0}.get(letters.get(joint, "U"), 0.0) for joint in linkage.graph.joints])
    if marks.any():
        return marks
    return np.where(np.abs(linkage.angles) > DOUBLE.parallel, np.sign(linkage.angles), 0.0)


def configuration_of_sheet(
    sheet: Sheet, *, frame: int | None = None, hinge_flat: bool = False, mend: bool = True
) -> SheetConfiguration:
    """Return a crease pattern at the configuration of its coordinates, opened along cuts and mended.

    Parameters
    ----------
    sheet : Sheet
        With coordinates.
    frame : int, optional
        Of a sheet that has several; by default as it was read, or if that has no coordinates the first that has.
    hinge_flat : bool, optional
        Make hinges of flat (F) edges too.
    mend : bool, optional
        Move vertices within the precision of their coordinates if the sheet moves in more ways so.

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates, or panels do not fit.
    InvariantError
        If a crease has no length, or there is no such frame.

    Examples
    --------
    >>> corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    >>> at = configuration_of_sheet(Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3)), corners))
    >>> at, at.branches.regular
    (<SheetConfiguration: <PosedLinkage: 2 links, 1 joints, 0 loops>>, True)
    """
    sheet = lying(sheet, frame)
    if sheet.coordinates is None:
        raise UnsolvableError(f"to move needs coordinates, and {sheet!r} has none")
    precision = precision_of_sheet(sheet)
    whole = with_all_edges(sheet)
    flat = flattened(whole) if mend else None
    repairs = [] if flat is None else [flat]
    whole = whole if flat is None else flat.sheet
    dual = mechanism_of_sheet(whole, hinge_flat=hinge_flat)
    apart = opened(whole, dual)
    mechanism = dual if apart is whole else mechanism_of_sheet(apart, hinge_flat=hinge_flat)
    linkage = linkage_of_sheet(apart, mechanism)
    closure = ClosureEquations(linkage)
    check_closed(closure, linkage)
    repair = _repair(apart, mechanism, linkage) if mend else None
    if repair is not None:
        apart, linkage = repair.sheet, linkage_of_sheet(repair.sheet, mechanism)
        repairs.append(repair)
    return SheetConfiguration(
        linkage,
        precision,
        precision.size <= EXACT or repair is not None,
        sheet,
        drawn=sheet,
        dual=dual,
        sheet=apart,
        mechanism=mechanism,
        repairs=tuple(repairs),
    )


def _repair(sheet: Sheet, mechanism: SheetMechanism, linkage: PosedLinkage) -> Mended | None:
    """Return the sheet with its vertices moved, if it moves in fewer ways as it is written than it nearly does."""
    places = VertexPlaces(sheet, mechanism, linkage)
    precision = precision_of(places, sheet)
    if precision.size <= EXACT:
        return None
    wanted, most = _wanted(_marks_of(sheet, linkage)), _most(linkage)
    nearly_all = () if most is None else _ways(linkage, Tolerances.of(precision.size).zero)

    def moves(linkage: PosedLinkage) -> bool:
        if most is not None:
            return _ways(linkage) >= nearly_all
        return rates_near(ClosureEquations(linkage), linkage.angles, quadrics_of(linkage), wanted) is not None

    if places.bent <= EXACT and moves(linkage):
        return None
    return mended(sheet, places, linkage, wanted, lambda one: moves(linkage_of_sheet(one, mechanism)), most)


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
