"""A pose at which motions to first order are finite ones: where it is told what to lock and what to crease.

At a singular pose, such as a flat sheet, ranks say little of what moves. Advice is given at another then, on the
way to move that is asked for, or that marks of creases choose. Theory: docs/theory/advice.md.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import degrees

import numpy as np

from graphs.arrays import Floats
from graphs.convert.duality import SheetMechanism
from graphs.errors import NumericalError, UnsolvableError
from graphs.mechanism.sheet import Sheet
from synth.folding.prepared import Prepared, prepared
from synth.folding.vertices import vertex_places
from synth.motion.beginning import MOST_JOINTS, Wanted, beginning, search_for
from synth.motion.branches import Branches, branches_of
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage, linkage_of_sheet
from synth.motion.placement import moved
from synth.motion.second_order import rates_at
from synth.verdict.words import flaps_of

__all__ = ["GeneralPose", "general_pose_of_linkage", "general_pose_of_sheet"]


@dataclass(frozen=True, slots=True)
class GeneralPose:
    """A linkage at a pose that is like those beside it.

    Attributes
    ----------
    linkage : PosedLinkage
        Its pose is this one.
    rates : float[J, M]
        Orthonormal columns span the rates of its motions.
    branch : int or None
        The way by which it was reached; None where the pose given is a general one.
    sheet : Sheet or None
        Placed so; None of what is no sheet.
    mechanism : SheetMechanism or None
        Of the sheet.
    mended : tuple of str
        What was done to rounded coordinates before.
    rigid : bool
        Whether it is proved that nothing moves from the pose given, whatever rates there are.
    """

    linkage: PosedLinkage
    rates: Floats
    branch: int | None
    sheet: Sheet | None = None
    mechanism: SheetMechanism | None = None
    mended: tuple[str, ...] = ()
    rigid: bool = False

    @property
    def freedoms(self) -> int:
        """Finite ones, M."""
        return 0 if self.rigid else int(self.rates.shape[1])

    @property
    def flaps(self) -> tuple[int, ...]:
        """Places of the joints in no loop: of flaps, and of what hangs on them."""
        loose = set(flaps_of(self.linkage.graph))
        return tuple(place for place, joint in enumerate(self.linkage.graph.joints) if joint in loose)

    def __repr__(self) -> str:
        return f"<GeneralPose: {self.freedoms} freedoms of {self.linkage!r}>"


def general_pose_of_sheet(sheet: Sheet, branch: int | str | None = None) -> GeneralPose:
    """Return a crease pattern at a general pose.

    Parameters
    ----------
    sheet : Sheet
        With coordinates, flat or folded.
    branch : int or str, optional
        The way to move from a singular pose, by its number or signs; by default that which marks choose.

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates, its panels do not fit, nothing that moves was found though that is not
        proved, or it has too many creases or none.
    NumericalError
        If the pose that was reached is singular too.

    Examples
    --------
    >>> from synth.patterns.creases.tessellations import miura
    >>> general_pose_of_sheet(miura(3, 3, 1.0))
    <GeneralPose: 1 freedoms of <PosedLinkage: 9 links, 12 joints, 4 loops>>
    """
    pattern = prepared(sheet)
    if not pattern.linkage.graph.joints:
        raise UnsolvableError("there is nothing to advise: the sheet has no creases between panels")
    mended = tuple(map(str, pattern.repairs))
    if pattern.branches is not None and pattern.branches.no_motion == "proved":
        rates = rates_at(pattern.closure, pattern.linkage.angles)
        return GeneralPose(pattern.linkage, rates, None, pattern.sheet, pattern.mechanism, mended, rigid=True)
    angles, number = _general_angles(
        pattern.linkage, pattern.branches, Wanted(branch, pattern.wanted, (), np.zeros(0))
    )
    placed = pattern.sheet if number is None else _placed(pattern, angles)
    linkage = linkage_of_sheet(placed, pattern.mechanism)
    rates = _rates(linkage, pattern.branches, number)
    return GeneralPose(linkage, rates, number, placed, pattern.mechanism, mended)


def general_pose_of_linkage(linkage: PosedLinkage, branch: int | str | None = None) -> GeneralPose:
    """Return a linkage at a general pose.

    Parameters
    ----------
    linkage : PosedLinkage
        Closed at its pose.
    branch : int or str, optional
        The way to move from a singular pose.

    Raises
    ------
    UnsolvableError, NumericalError
        As :func:`general_pose_of_sheet`.

    Examples
    --------
    A square four-bar in the plane has two ways to leave the pose; the first is taken:

    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.sc import SCGraph
    >>> from synth.motion.linkage import linkage_of_axes
    >>> square = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3), "infinite")])
    >>> corners = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]
    >>> posed = linkage_of_axes(square, {j: (corners[j], (0, 0, 1)) for j in range(4)})
    >>> general_pose_of_linkage(posed).freedoms
    1
    """
    joints = len(linkage.angles)
    if not joints:
        raise UnsolvableError("there is nothing to advise: the linkage has no joints")
    found = None if joints > MOST_JOINTS else branches_of(linkage, None, search_for(joints, None))
    if found is not None and found.no_motion == "proved":
        return GeneralPose(linkage, rates_at(ClosureEquations(linkage), linkage.angles), None, rigid=True)
    angles, number = _general_angles(linkage, found, Wanted(branch, np.ones(joints), (), np.zeros(0)))
    posed = linkage if number is None else moved(linkage, angles)
    return GeneralPose(posed, _rates(posed, found, number), number)


def _general_angles(linkage: PosedLinkage, found: Branches | None, wanted: Wanted) -> tuple[Floats, int | None]:
    """Return the joint angles of a general pose, and the branch it is on; None for the pose itself."""
    if found is None:
        raise UnsolvableError(
            f"advice needs the ways to move, which of more than {MOST_JOINTS} joints are not looked for"
        )
    number, _ = beginning(ClosureEquations(linkage), linkage, found, wanted)
    return (linkage.angles if number is None else found.branches[number].sample), number


def _rates(linkage: PosedLinkage, found: Branches | None, number: int | None) -> Floats:
    """Return the rates at a pose, if there are as many as freedoms."""
    rates = rates_at(ClosureEquations(linkage), linkage.angles)
    freedoms = None if found is None else found.branches[number or 0].freedoms
    if freedoms != rates.shape[1]:
        told = "freedoms that are not known" if freedoms is None else f"{freedoms} freedom(s) of finite motion"
        raise NumericalError(
            f"no general pose was found: {rates.shape[1]} rates close to first order beside {told}, "
            f"with folds up to {degrees(float(np.abs(linkage.angles).max())):.3g} degrees"
        )
    return rates


def _placed(pattern: Prepared, angles: Floats) -> Sheet:
    places, _ = vertex_places(pattern.sheet, pattern.mechanism, pattern.linkage, angles[None])
    column = {joint: place for place, joint in enumerate(pattern.linkage.graph.joints)}
    turned = tuple(
        degrees(float(angles[column[edge]])) if edge in column else None
        for edge in range(len(pattern.sheet.edges))
    )
    return replace(
        pattern.sheet, coordinates=tuple(map(tuple, places[0].tolist())), fold_angles=turned, frames=None
    )
