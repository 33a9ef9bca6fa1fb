"""Anything that has coordinates as a mechanism at a configuration: made here, and nowhere else.

Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from graphs.answer.mechanisms import precision_of_steps
from graphs.arrays import Floats
from graphs.convert.table import Mechanism, to_sheet
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.geometry import lines_meet
from graphs.joints.as_revolutes import revolutes_of
from graphs.joints.linkage import JointedLinkage
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.conical import ConicalLinkage
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.precision import Precision, precision_of
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.rank.closure import independent_cycles
from graphs.tolerances import DOUBLE
from synth.conformed.linkages import OnCone, linkage_on_cones
from synth.conformed.pose import joint_axes
from synth.folding.configuration import configuration_of_sheet
from synth.guidance.fourbars import GuidedFourBar
from synth.guidance.orientations import Orientations
from synth.motion.closure import ClosureEquations
from synth.motion.configuration import Configuration
from synth.motion.driving import check_closed
from synth.motion.linkage import PosedLinkage, linkage_of_axes
from synth.motion.misfit import EXACT
from synth.moving.rods import linkage_of_rods

__all__ = ["Movable", "configuration_of", "linkage_on_cone", "sheet_of"]

Movable = Configuration | PosedLinkage | Mechanism | GuidedFourBar | OnCone
"""What is at a configuration, or has coordinates that tell it."""

_EXACTLY = Precision(0.0, "exact")

_APEX = (0.0, 0.0, 0.0)


def configuration_of(
    thing: Movable,
    *,
    orientations: Orientations | None = None,
    frame: int | None = None,
    mend: bool = True,
    hinge_flat: bool = False,
) -> Configuration:
    """Return anything that has coordinates as a mechanism at a configuration.

    Parameters
    ----------
    thing : Sheet, PolyhedronModel, HingedSolids, JointedLinkage, ConicalLinkage, OnCone, GuidedFourBar, ...
        A model that knows its links is a sheet of panels, else its rods are links. A conical linkage lies on its
        cone, a guided four-bar takes the first of its orientations. A Configuration is returned as it is.
    orientations : Orientations, optional
        Those of a guided four-bar, whose moving axes are told in the frame of the body.
    frame : int, optional
        Of a sheet that has several; by default as it was read, or if that has no coordinates the first that has.
    mend : bool, optional
        Move vertices of a sheet within the precision of their coordinates if it moves in more ways so.
    hinge_flat : bool, optional
        Make hinges of the flat (F) edges of a sheet too.

    Raises
    ------
    UnsolvableError
        If it has no coordinates, loops are not closed there, it lies on no cone or on several, or has terms that
        are no hinges.
    InvariantError
        If the axes of a loop do not meet in its centre, a hinge has no length, or there is no such frame.

    Examples
    --------
    >>> ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop(range(4), "infinite")])
    >>> corners = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]
    >>> configuration_of(HingedSolids(ring, {joint: (corner, (0, 0, 1)) for joint, corner in enumerate(corners)}))
    <Configuration: <PosedLinkage: 4 links, 4 joints, 1 loops>>
    """
    if isinstance(thing, Configuration):
        return thing
    if isinstance(thing, PosedLinkage):
        check_closed(ClosureEquations(thing), thing)
        return Configuration(thing, _EXACTLY)
    if isinstance(thing, Sheet) or (frame is None and isinstance(thing, PolyhedronModel)):
        sheet = sheet_of(thing)
        if sheet is not None:
            return configuration_of_sheet(sheet, frame=frame, hinge_flat=hinge_flat, mend=mend)
    if frame:
        raise InvariantError("frames", f"{thing!r} has no frames", "a .fold file")
    linkage, precision = _made(thing, orientations)
    return Configuration(
        linkage, precision, precision.size <= EXACT, thing if isinstance(thing, Mechanism) else None
    )


def _made(thing: Movable, orientations: Orientations | None) -> tuple[PosedLinkage, Precision]:
    """Return the linkage that a thing without panels is, and how precise its coordinates are."""
    if isinstance(thing, PolyhedronModel):
        return linkage_of_rods(thing), precision_of(list(thing.coordinates.values()))
    if isinstance(thing, JointedLinkage) and thing.places:
        thing = revolutes_of(thing)
    if isinstance(thing, HingedSolids):
        points, directions = (np.array([axis[part] for axis in thing.axes.values()]) for part in (0, 1))
        both = (precision_of(one.reshape(-1, 3).tolist()) for one in (points, directions))
        return _with_centres(linkage_of_axes(thing.chain, thing.axes)), max(both, key=lambda one: one.size)
    if isinstance(thing, OnCone):
        return linkage_on_cone(thing), _EXACTLY
    if isinstance(thing, ConicalLinkage):
        precision = _EXACTLY if thing.steps is None else precision_of_steps(thing)
        return linkage_on_cone(_the_one(linkage_on_cones(thing))), precision
    if isinstance(thing, GuidedFourBar):
        if orientations is None:
            raise UnsolvableError("a guided four-bar has its moving axes in the body: expected its orientations")
        return _of_guided(thing, orientations.matrices[0]), _EXACTLY
    raise UnsolvableError(f"to move needs coordinates, and {thing!r} has none")


def sheet_of(thing: Mechanism) -> Sheet | None:
    """Return a sheet, or a model that is its panels and no more, as a sheet; None of anything else."""
    if isinstance(thing, Sheet):
        return thing
    if not isinstance(thing, PolyhedronModel) or not thing.links:
        return None
    more = (*thing.centres, *thing.scissors, *thing.on_line, *thing.on_plane)
    return None if more or thing.ground is not None else to_sheet(thing)


def linkage_on_cone(linkage: OnCone) -> PosedLinkage:
    """Return a conical linkage at its conformed position, in the frame of `synth.conformed.pose`.

    All axes pass through the apex, so all loops have their centre there, whatever the chain says.

    Parameters
    ----------
    linkage : OnCone

    Returns
    -------
    PosedLinkage

    Raises
    ------
    UnsolvableError
        If its cone angle is not known.

    Examples
    --------
    >>> from synth.conformed.linkages import loop_on_cones
    >>> first, _ = loop_on_cones(np.radians([120, 95, 45, 85]))
    >>> linkage_on_cone(first)
    <PosedLinkage: 4 links, 4 joints, 1 loops>
    """
    if linkage.cone_angle is None:
        raise UnsolvableError("the linkage lies on any cone: expected a cone angle")
    directions = joint_axes(np.asarray(linkage.places, dtype=float), linkage.cone_angle)
    return _about_a_point(linkage.chain, directions)


def _the_one(on_cones: Sequence[OnCone]) -> OnCone:
    if len(on_cones) != 1:
        told = numbered(len(on_cones), "cone")
        raise UnsolvableError(f"the linkage lies on {told}: expected one (synth cone map --cone K -o one.json)")
    return on_cones[0]


def _of_guided(four_bar: GuidedFourBar, body: Floats) -> PosedLinkage:
    """Return the joints O (driver, fixed), A and B (on the body) and C of a guided four-bar."""
    driver, follower = four_bar.driver, four_bar.follower
    ring = SCGraph(("ground", "driver", "body", "follower"), {
        "O": ("ground", "driver"), "A": ("driver", "body"), "B": ("body", "follower"), "C": ("follower", "ground"),
    }, ground="ground")  # fmt: skip
    moving = (body @ driver.moving, body @ follower.moving)
    return _about_a_point(ring, np.array([driver.fixed, *moving, follower.fixed]))


def _about_a_point(chain: SCGraph, directions: Floats) -> PosedLinkage:
    about_it = chain.with_loops([Loop(loop.joints) for loop in independent_cycles(chain)])
    axes = {joint: (_APEX, one.tolist()) for joint, one in zip(chain.joints, directions, strict=True)}
    return linkage_of_axes(about_it, axes)


def _with_centres(linkage: PosedLinkage) -> PosedLinkage:
    """Refuse loops whose axes do not meet as their centre says: three equations would not close them."""
    for loop in linkage.loops:
        points, axes = linkage.points[list(loop.joints)], linkage.directions[list(loop.joints)]
        if loop.centre is Centre.INFINITE:
            off = float(np.abs(np.cross(axes, axes[0])).max())
        elif loop.centre is Centre.FINITE:
            off = float(lines_meet(points, axes).off.max())
        else:
            continue
        if off > DOUBLE.same_point:
            names = list(linkage.graph.joints)
            ids = shown([names[joint] for joint in loop.joints])
            are = "parallel" if loop.centre is Centre.INFINITE else "through one point"
            raise InvariantError("centre", f"the axes of loop {ids} miss by {off:.1e}", f"axes {are}")
    return linkage
