"""A crease pattern at a configuration: opened along its cuts, in its plane, mended where rounding stopped it.

Theory: docs/theory/folding.md, docs/theory/mending.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import degrees

import numpy as np

from graphs.answer.mechanisms import sheet_in_frame
from graphs.convert.duality import SheetMechanism, mechanism_of_sheet
from graphs.errors import UnsolvableError
from graphs.mechanism.precision import keeping, precision_of_sheet, stated
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId
from synth.folding.collisions import Collision, Panels
from synth.folding.mending.near import covers
from synth.folding.mending.nearest import Nearby, Written, beyond_precision, nearby
from synth.folding.mending.repair import Mended, flattened
from synth.folding.opened import opened
from synth.folding.vertices import vertex_places
from synth.motion.closure import ClosureEquations
from synth.motion.configuration import Configuration, Placed
from synth.motion.driving import check_closed
from synth.motion.linkage import PosedLinkage, linkage_of_sheet
from synth.motion.misfit import EXACT, doubt_of, doubt_of_rigid
from synth.motion.path import Path
from synth.motion.walk.event import PathEvent

__all__ = ["SheetConfiguration", "configuration_of_sheet"]


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
    near : Nearby
        What mending found: the mechanisms within the precision, or the nearest one beyond.
    written : SheetConfiguration or None
        As the coordinates are written, where vertices were moved.
    alternatives : tuple of SheetConfiguration
        Other mechanisms within the precision, which have branches that this one has not.
    """

    drawn: Sheet = field(kw_only=True)
    dual: SheetMechanism = field(kw_only=True)
    sheet: Sheet = field(kw_only=True)
    mechanism: SheetMechanism = field(kw_only=True)
    repairs: tuple[Mended, ...] = field(kw_only=True, default=())
    near: Nearby = field(kw_only=True, default=Nearby())
    written: SheetConfiguration | None = field(kw_only=True, default=None)
    alternatives: tuple[SheetConfiguration, ...] = field(kw_only=True, default=())

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

    @property
    def misfit(self) -> float:
        """Largest displacement of a vertex, in units of the extent, from where it is written."""
        return sum((repair.moved for repair in self.repairs), 0.0)

    @property
    def as_drawn(self) -> Written:
        """What mending begins with."""
        return Written(self.sheet, self.mechanism, self.linkage, self.precision, self.wanted)

    @property
    def nearly(self) -> bool:
        """Whether rates nearly agree that do not agree exactly, by what the coordinates tell apart."""
        return self.near.nearly

    @property
    def unsettled(self) -> bool:
        """Whether it may move within the precision in ways for which no mechanism was found."""
        return self.near.unsettled

    @cached_property
    def nearest(self) -> Mended | None:
        """The nearest mechanism that was found, of what does not move: beyond the precision; None if none was."""
        if self.near.within or self.near.beyond or self.near.unsettled:
            return self.near.beyond
        return beyond_precision(self.as_drawn)

    @cached_property
    def elsewhere(self) -> tuple[tuple[Configuration, int], ...]:
        """Branches that exist within the precision, but on another mechanism than this: that, and their number."""
        known = [] if self.branches is None else [branch.space for branch in self.branches.branches]
        found: list[tuple[Configuration, int]] = []
        for other in self.alternatives:
            branches = () if other.branches is None else other.branches.branches
            for number, branch in enumerate(branches):
                if branch.freedoms and not any(covers(space, branch.space) for space in known):
                    found.append((other, number))
                    known.append(branch.space)
        return tuple(found)

    @property
    def doubt(self) -> str:
        """What is to be said of the coordinates where nothing moves or a motion ends; empty if nothing is."""
        if self.branches is None or self.branches.branches:
            return doubt_of(self.precision)
        return doubt_of_rigid(self.precision, None if self.nearest is None else self.nearest.moved, self.unsettled)

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

    def passed(self, path: Path, points: Floats, driver: int) -> tuple[Path, tuple[int, ...]]:
        """Return a path with the event that panels pass through each other, and the frames in which they do."""
        crossed = self.collision().among(self.closure, path.angles, points)
        if crossed is None:
            return path, ()
        event = PathEvent("collision", crossed.frame, driver, (driver,), crossed.angles, panels=crossed.panels)
        events = sorted((*path.events, event), key=lambda one: one.frame)
        return replace(path, events=tuple(events)), crossed.frames

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
    sheet: Sheet,
    *,
    frame: int | None = None,
    hinge_flat: bool = False,
    mend: bool = True,
    precision: float | None = None,
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
    precision : float, optional
        The error that a coordinate may have, in their unit; by default as the sheet has it.

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
    sheet = stated(sheet_in_frame(sheet, frame), precision)
    if sheet.coordinates is None:
        raise UnsolvableError(f"to move needs coordinates, and {sheet!r} has none")
    found = precision_of_sheet(sheet)
    whole = keeping(with_all_edges(sheet), found)
    flat = flattened(whole, found) if mend else None
    whole = whole if flat is None else keeping(flat.sheet, found)
    dual = mechanism_of_sheet(whole, hinge_flat=hinge_flat)
    apart = opened(whole, dual)
    if apart is not whole:
        apart = keeping(apart, found)
    mechanism = dual if apart is whole else mechanism_of_sheet(apart, hinge_flat=hinge_flat)
    linkage = linkage_of_sheet(apart, mechanism)
    check_closed(ClosureEquations(linkage), linkage)
    at = SheetConfiguration(
        linkage,
        found,
        found.size <= EXACT,
        sheet,
        drawn=sheet,
        dual=dual,
        sheet=apart,
        mechanism=mechanism,
        repairs=() if flat is None else (flat,),
    )
    return _mended(at) if mend else at


def _mended(written: SheetConfiguration) -> SheetConfiguration:
    """Return the configuration on the nearest mechanism with the assignment or the most branches."""
    near = nearby(written.as_drawn)
    others = [_on(written, one) for one in near.within]
    if not others or near.written_first:
        return replace(written, near=near, alternatives=tuple(others))
    kept = [written] if near.written_too else []
    return replace(others[0], near=near, written=written, alternatives=(*others[1:], *kept))


def _on(written: SheetConfiguration, mended: Mended) -> SheetConfiguration:
    """Return a configuration with its vertices moved."""
    linkage = linkage_of_sheet(mended.sheet, written.mechanism)
    repairs = (*written.repairs, mended)
    sheet = keeping(mended.sheet, written.precision)
    return replace(written, linkage=linkage, exact=True, sheet=sheet, repairs=repairs)
