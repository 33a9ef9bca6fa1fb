"""A crease pattern at a configuration: opened along its cuts, in its plane, mended where rounding stopped it.

There it has layer orders, where panels lie on each other. Theory: docs/theory/folding.md, docs/theory/mending.md,
docs/theory/layer-orders.md.
"""

from __future__ import annotations

import pathlib
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from graphs.answer.mobility import sheet_in_frame
from graphs.convert.conversions import without_coordinates
from graphs.convert.duality import SheetMechanism, mechanism_of_sheet, opened
from graphs.errors import check_argument
from graphs.files.mechanism_like import mechanism_for
from graphs.mechanism.precision import in_space, keeping, precision_of_sheet, stated
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId
from synth.analysis.folding.derivatives import vertex_places
from synth.analysis.folding.layers_on_path import layers_on_path
from synth.analysis.folding.mending.near_mechanisms import (
    MendedPattern,
    NearbyPatterns,
    WrittenPattern,
    beyond_precision,
    covers,
    flattened,
    nearby,
    searched_to,
)
from synth.analysis.folding.panel_collisions import Collision, shapes_of_panels
from synth.analysis.layering.counting.propagation import counted
from synth.analysis.layering.space.orders import LayersInSpace, layers_in_space
from synth.analysis.layering.space.planes import FoldedState
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.configuration import EXACT, Configuration, PointPlaces, doubt_of, doubt_of_rigid
from synth.analysis.motion.linkage import Creases, Linkage, creases_of, linkage_of_sheet
from synth.analysis.motion.path import PassedPanels, Path
from synth.analysis.motion.walk.step import PathEvent


@dataclass(frozen=True, eq=False, repr=False)
class SheetConfiguration(Configuration):
    """A crease pattern at a configuration.

    `drawn` is the sheet as it was read, `dual` its mechanism, in its plane if it is meant to lie in one. `sheet`
    has separate vertices where cuts part it, and vertices where they were moved to; `mechanism` is that of this
    sheet, `repairs` what was done to the coordinates. `near` has the mechanisms within the precision, or the
    nearest one beyond, `written` is the configuration as written, where vertices were moved, and `alternatives`
    are other mechanisms within the precision, which have branches that this one has not.
    """

    drawn: Sheet = field(kw_only=True)
    dual: SheetMechanism = field(kw_only=True)
    sheet: Sheet = field(kw_only=True)
    mechanism: SheetMechanism = field(kw_only=True)
    repairs: tuple[MendedPattern, ...] = field(kw_only=True, default=())
    near: NearbyPatterns = field(kw_only=True, default=NearbyPatterns())
    written: SheetConfiguration | None = field(kw_only=True, default=None)
    alternatives: tuple[SheetConfiguration, ...] = field(kw_only=True, default=())

    @cached_property
    def flat(self) -> bool:
        """Whether all fold angles are zero."""
        return bool(np.abs(self.linkage.angles).max(initial=0.0) <= DOUBLE.parallel)

    @property
    def has_panels(self) -> bool:
        """Whether it is of a sheet, whose frames are sheets."""
        return True

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
        """The repairs of rounded coordinates."""
        return tuple(map(str, self.repairs))

    @property
    def misfit(self) -> float:
        """Largest displacement of a vertex, in units of the extent, from where it is written."""
        return sum((repair.moved for repair in self.repairs), 0.0)

    @property
    def as_drawn(self) -> WrittenPattern:
        """The pattern before mending."""
        return WrittenPattern(self.sheet, self.mechanism, self.linkage, self.precision, self.wanted)

    @property
    def nearly(self) -> bool:
        """Whether rates nearly agree that do not agree exactly, by what the coordinates tell apart."""
        return self.near.nearly

    @property
    def unsettled(self) -> bool:
        """Whether it may move within the precision in ways for which no mechanism was found."""
        return self.near.unsettled

    @cached_property
    def nearest(self) -> MendedPattern | None:
        """The nearest mechanism, beyond the precision, to one that does not move; None if none was found."""
        if self.near.within or self.near.beyond or self.near.unsettled:
            return self.near.beyond
        return beyond_precision(self.as_drawn)

    @property
    def searched(self) -> float:
        """How far vertices are displaced in search of the nearest mechanism, in units of the extent."""
        return searched_to(self.precision)

    @cached_property
    def elsewhere(self) -> tuple[tuple[Configuration, int], ...]:
        """Branches that exist within the precision, but on another mechanism than this: that, and their number."""
        known = [] if self.branches is None else [branch.space for branch in self.branches.branches]
        numbered: list[tuple[Configuration, int]] = []
        for other in self.alternatives:
            branches = () if other.branches is None else other.branches.branches
            for number, branch in enumerate(branches):
                if branch.freedoms and not any(covers(space, branch.space) for space in known):
                    numbered.append((other, number))
                    known.append(branch.space)
        return tuple(numbered)

    @property
    def doubt(self) -> str:
        """The caution on the coordinates where nothing moves or a motion ends; empty without any."""
        if self.branches is None or self.branches.branches:
            return doubt_of(self.precision)
        misfit = None if self.nearest is None else self.nearest.moved
        return doubt_of_rigid(self.precision, misfit, self.searched, self.unsettled)

    def placed(self, angles: Floats) -> PointPlaces:
        """Return where vertices are at fold angles float[F, J], radians."""
        return PointPlaces(*vertex_places(self.sheet, self.mechanism, self.linkage, angles))

    def folded_state(self, angles: Floats | None = None, points: Floats | None = None) -> FoldedState:
        """Return the sheet at fold angles float[J], radians, by default its own, for the orders of its layers.

        Its vertices there, float[V, 3], may be handed in.
        The sign of a fold of 180 degrees is known if the crease was open at this configuration, or by the file.
        """
        here = self.linkage.angles
        angles = here if angles is None else angles
        given, letters = self.sheet.fold_angles, self.sheet.assignments
        column = {joint: place for place, joint in enumerate(self.joints)}
        signs = {}
        for joint in self.mechanism.hinges:
            was_open = abs(float(here[column[joint]])) < np.pi - self.tolerances.same_configuration
            if was_open or letters[joint] in "MV" or (given is not None and given[joint]):
                signs[joint] = bool(angles[column[joint]] > 0.0)
        return FoldedState(
            self.sheet, self.mechanism, self._creases, self.precision, self.tolerances,
            self.placed(angles[None]).points[0] if points is None else points, angles, signs,
        )  # fmt: skip

    @cached_property
    def _creases(self) -> Creases:
        return creases_of(self.sheet, self.mechanism)

    def ends_of(self, joints: Sequence[JointId]) -> dict[JointId, tuple[tuple[float, ...], tuple[float, ...]]]:
        """Return the two ends of creases, in the unit of the coordinates."""
        corners = self.sheet.coordinates
        assert corners is not None
        ends = {joint: self.mechanism.hinges[joint] for joint in joints}  # type: ignore[index]
        return {joint: (tuple(corners[a]), tuple(corners[b])) for joint, (a, b) in ends.items()}

    def at(self, angles: Floats, points: Floats | None = None) -> Sheet:
        """Return the sheet at fold angles float[J], radians; its vertices there, float[V, 3], may be handed in."""
        there = self.placed(angles[None]).points[0] if points is None else points
        turned: list[float | None] = [None] * len(self.sheet.edges)
        for edge, angle in zip(self.joints, angles.tolist(), strict=True):
            turned[edge] = angle  # type: ignore[call-overload]  # joints are numbers of edges
        return self.sheet.placed(there, turned)

    def passed(self, path: Path, points: Floats, driver: int) -> PassedPanels:
        """Return where panels pass through each other on a path, and how they lie at its end.

        Panels that lie on each other in no order of their layers pass through each other too.
        """
        crossing: tuple[int, ...] = ()
        if not any(event.kind == "collision" for event in path.events):
            path, crossing = self.collision().among(self.closure, path, points, driver)
        layers = layers_on_path(self.folded_state, self.closure, path.angles, points)
        if layers.wrong and not any(event.kind == "collision" for event in path.events):
            first = layers.wrong[0]
            event = PathEvent("collision", first, driver, (driver,), path.angles[first], panels=layers.panels)
            path = replace(path, events=tuple(sorted((*path.events, event), key=lambda event: event.frame)))
        return PassedPanels(path, tuple(sorted({*crossing, *layers.wrong})), layers.resting)

    def collision(self) -> Collision:
        """Return what ends a walk before panels pass through each other."""

        def places(angles: Floats) -> Floats:
            return self.placed(angles).points

        assert self.sheet.coordinates is not None
        here = in_space(self.sheet.coordinates)
        return Collision(shapes_of_panels(self.sheet, self.mechanism, here, self.tolerances), places)


def _marks_of(sheet: Sheet, linkage: Linkage) -> Floats:
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

    Options and errors are those of `synth.analysis.moving._configuration_of.configuration_of`.
    """
    sheet = stated(sheet_in_frame(sheet, frame), precision)
    if sheet.coordinates is None:
        raise without_coordinates(sheet)
    read = precision_of_sheet(sheet)
    whole = keeping(with_all_edges(sheet), read)
    flat = flattened(whole, read) if mend else None
    whole = whole if flat is None else keeping(flat.sheet, read)
    dual = mechanism_of_sheet(whole, hinge_flat=hinge_flat)
    apart = opened(whole, dual)
    if apart is not whole:
        apart = keeping(apart, read)
    mechanism = dual if apart is whole else mechanism_of_sheet(apart, hinge_flat=hinge_flat)
    linkage = linkage_of_sheet(apart, mechanism)
    ClosureEquations(linkage).check_closed(linkage.angles)
    at = SheetConfiguration(
        linkage, read, read.size <= EXACT, sheet, drawn=sheet, dual=dual, sheet=apart, mechanism=mechanism
    )
    at = at if flat is None else replace(at, repairs=(flat,))
    return _mended(at) if mend else at


def _mended(written: SheetConfiguration) -> SheetConfiguration:
    """Return the configuration on the nearest mechanism with the assignment or the most branches."""
    near = nearby(written.as_drawn)
    others = [_on(written, mended) for mended in near.within]
    if not others or near.written_first:
        return replace(written, near=near, alternatives=tuple(others))
    kept = [written] if near.written_too else []
    return replace(others[0], near=near, written=written, alternatives=(*others[1:], *kept))


def _on(written: SheetConfiguration, mended: MendedPattern) -> SheetConfiguration:
    """Return a configuration with its vertices moved."""
    linkage = linkage_of_sheet(mended.sheet, written.mechanism)
    repairs = (*written.repairs, mended)
    sheet = keeping(mended.sheet, written.precision)
    return replace(written, linkage=linkage, exact=True, sheet=sheet, repairs=repairs)


def layers_at(
    mechanism: Sheet | SheetConfiguration | str | pathlib.Path,
    *,
    frame: int | None = None,
    precision: float | None = None,
) -> LayersInSpace:
    """Return the layer orders of a crease pattern at the configuration of its coordinates.

    Where panels lie on each other, a layer order says which one is on top; elsewhere there is nothing to order. Seen
    along a segment, the paper goes from one plane to another without passing through itself.

    Parameters
    ----------
    mechanism : Sheet, SheetConfiguration, or the path of a file
    frame : int, optional
        The frame of the file; 0 is the key frame.
    precision : float, optional
        The error of a coordinate, in its unit, as for `synth.mobility`.

    Returns
    -------
    LayersInSpace
        `orders` is their number: 1 where no panels lie on each other, 0 where every order has the paper pass through
        itself.

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates, or its loops are not closed.

    Examples
    --------
    A strip of three squares, both creases folded by 180 degrees as valleys: the outer squares are in one place.

    >>> from math import pi
    >>> corners = ((0, 0, 0), (1, 0, 0), (0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0), (0, 1, 0), (1, 1, 0))
    >>> faces = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6))
    >>> strip = Sheet(8, ((1, 5), (2, 6)), "VV", faces, corners, fold_angles=(pi, pi))
    >>> layers_at(strip).orders
    2
    """
    check_argument("layers_at", mechanism, Sheet | SheetConfiguration | str | pathlib.Path)
    if isinstance(mechanism, SheetConfiguration):
        at = mechanism
    else:
        sheet = mechanism_for("layers_at", mechanism, Sheet)
        assert isinstance(sheet, Sheet)
        at = configuration_of_sheet(sheet, frame=frame, precision=precision, mend=False)
    return layers_in_space(at.folded_state(), lambda problems: list(map(counted, problems)))
