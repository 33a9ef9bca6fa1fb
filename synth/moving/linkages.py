"""The linkage at a pose that any thing with coordinates is: what moves, before anything is said of how.

Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from graphs.arrays import Floats
from graphs.convert.duality import mechanism_of_sheet
from graphs.convert.table import Mechanism, to_sheet
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.joints.as_revolutes import revolutes_of
from graphs.joints.linkage import JointedLinkage
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.conical import ConicalLinkage
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.mechanism.solids import HingedSolids
from graphs.rank.closure import independent_cycles
from synth.conformed.linkages import OnCone, linkage_on_cones
from synth.conformed.pose import joint_axes
from synth.folding.opened import opened
from synth.guidance.fourbars import GuidedFourBar
from synth.guidance.orientations import Orientations
from synth.motion.linkage import PosedLinkage, linkage_of_axes, linkage_of_sheet
from synth.moving.rods import linkage_of_rods

__all__ = ["linkage_of", "linkage_on_cone", "off_one_point", "sheet_of"]

_MEETS = 1e-9
"""Axes that pass a centre at this part of the extent, or are this far from parallel, meet there."""
_APEX = (0.0, 0.0, 0.0)


def linkage_of(
    thing: Mechanism | GuidedFourBar | OnCone, orientations: Orientations | None = None
) -> PosedLinkage:
    """Return the links, joint axes and loops of anything that has coordinates.

    Parameters
    ----------
    thing : Sheet, PolyhedronModel, HingedSolids, JointedLinkage, ConicalLinkage, OnCone or GuidedFourBar
        Of a sheet that has several frames, that which is to move. A model that knows its links is a sheet of
        panels, else its rods are links. A conical linkage lies on its cone, a guided four-bar
        takes the first of its orientations.
    orientations : Orientations, optional
        Those of a guided four-bar, whose moving axes are told in the frame of the body.

    Raises
    ------
    UnsolvableError
        If it has no coordinates, lies on no cone or on several, or has terms that are no hinges.
    InvariantError
        If the axes of a loop do not meet in its centre, or a hinge has no length.

    Examples
    --------
    >>> ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop(range(4), "infinite")])
    >>> corners = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]
    >>> linkage_of(HingedSolids(ring, {joint: (corner, (0, 0, 1)) for joint, corner in enumerate(corners)}))
    <PosedLinkage: 4 links, 4 joints, 1 loops>
    """
    if isinstance(thing, Sheet):
        return _of_sheet(thing)
    if isinstance(thing, PolyhedronModel):
        sheet = sheet_of(thing)
        return linkage_of_rods(thing) if sheet is None else _of_sheet(sheet)
    if isinstance(thing, JointedLinkage) and thing.places:
        thing = revolutes_of(thing)
    if isinstance(thing, HingedSolids):
        return _with_centres(linkage_of_axes(thing.chain, thing.axes))
    if isinstance(thing, OnCone):
        return linkage_on_cone(thing)
    if isinstance(thing, ConicalLinkage):
        return linkage_on_cone(_the_one(linkage_on_cones(thing)))
    if isinstance(thing, GuidedFourBar):
        if orientations is None:
            raise UnsolvableError("a guided four-bar has its moving axes in the body: expected its orientations")
        return _of_guided(thing, orientations.matrices[0])
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


def _of_sheet(sheet: Sheet) -> PosedLinkage:
    if sheet.coordinates is None:
        raise UnsolvableError(f"to move needs coordinates, and {sheet!r} has none")
    whole = with_all_edges(sheet)
    return linkage_of_sheet(opened(whole, mechanism_of_sheet(whole)))


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
            off = off_one_point(points, axes)
        else:
            continue
        if off > _MEETS:
            names = list(linkage.graph.joints)
            ids = shown([names[joint] for joint in loop.joints])
            are = "parallel" if loop.centre is Centre.INFINITE else "through one point"
            raise InvariantError("centre", f"the axes of loop {ids} miss by {off:.1e}", f"axes {are}")
    return linkage


def off_one_point(points: Floats, axes: Floats) -> float:
    """Return how far axes pass, at most, from the point nearest to all, in the unit of the points.

    Parameters
    ----------
    points, axes : float[k, 3]
        On the axes, and their unit vectors.

    Examples
    --------
    >>> points, axes = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 2.0]]), np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    >>> round(off_one_point(points, axes), 12)
    1.0
    """
    across = np.eye(3) - axes[:, :, None] * axes[:, None, :]
    sums = (across @ points[..., None])[..., 0]
    nearest = np.linalg.lstsq(across.reshape(-1, 3), sums.ravel(), rcond=None)[0]
    return float(np.linalg.norm((across @ (nearest - points)[..., None])[..., 0], axis=1).max())
