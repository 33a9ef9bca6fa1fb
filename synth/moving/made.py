"""Anything that has coordinates as a mechanism at a configuration: made here, and nowhere else.

Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from graphs.answer.mechanisms import precision_of_steps
from graphs.convert.table import Mechanism, to_sheet
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.geometry import lines_meet
from graphs.joints.as_revolutes import revolutes_of
from graphs.joints.kinds import JointKind
from graphs.joints.linkage import JointedLinkage
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.precision import Precision, precision_of, stated
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet, WrittenPrecision
from graphs.mechanism.solids import Axis, HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage
from graphs.rank.exact import independent_cycles
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId
from synth.conformed.linkages import OnSurface, linkage_on_surfaces
from synth.folding.configuration import configuration_of_sheet
from synth.guidance.fourbars import GuidedFourBar
from synth.guidance.orientations import Orientations
from synth.motion.closure import ClosureEquations
from synth.motion.configuration import Configuration
from synth.motion.driving import check_closed
from synth.motion.linkage import PosedLinkage, linkage_of_axes
from synth.motion.misfit import EXACT
from synth.moving.rods import linkage_of_rods

__all__ = ["Movable", "configuration_of", "posed_on_surface", "sheet_of", "with_precision"]

Movable = Configuration | PosedLinkage | Mechanism | GuidedFourBar | OnSurface
"""What is at a configuration, or has coordinates that tell it."""

_EXACTLY = Precision(0.0, "exact")

_OF_ONE_FREEDOM = {JointKind.REVOLUTE, JointKind.PRISMATIC}


def configuration_of(
    thing: Movable,
    *,
    orientations: Orientations | None = None,
    frame: int | None = None,
    mend: bool = True,
    hinge_flat: bool = False,
    precision: float | None = None,
    slides: bool = False,
) -> Configuration:
    """Return anything that has coordinates as a mechanism at a configuration.

    Parameters
    ----------
    thing : Sheet, PolyhedronModel, HingedSolids, JointedLinkage, SurfaceLinkage, OnSurface, GuidedFourBar, ...
        A model that knows its links is a sheet of panels, else its rods are links. A linkage on a surface lies
        there, a guided four-bar takes the first of its orientations. A Configuration is returned as it is.
    orientations : Orientations, optional
        Those of a guided four-bar, whose moving axes are told in the frame of the body.
    frame : int, optional
        Of a sheet that has several; by default as it was read, or if that has no coordinates the first that has.
    mend : bool, optional
        Move vertices of a sheet within the precision of their coordinates if it moves in more ways so.
    hinge_flat : bool, optional
        Make hinges of the flat (F) edges of a sheet too.
    precision : float, optional
        The error that a coordinate may have, in the unit of the coordinates; by default as they are written, or as
        the geometry of a sheet shows. A Configuration has its own.
    slides : bool, optional
        Keep the prismatic joints of a linkage of revolute and prismatic joints, in place of revolutes that do the
        same.

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
            return configuration_of_sheet(
                sheet, frame=frame, hinge_flat=hinge_flat, mend=mend, precision=precision
            )
    if frame:
        raise InvariantError("frames", f"{thing!r} has no frames", "a .fold file")
    if slides and isinstance(thing, JointedLinkage) and set(thing.kinds.values()) <= _OF_ONE_FREEDOM:
        linkage, found = _with_slides(thing)
    else:
        linkage, found = _made(thing, orientations)
    if precision is not None:
        found = Precision(WrittenPrecision(precision, "stated").length / linkage.extent, "stated")
    return Configuration(linkage, found, found.size <= EXACT, thing if isinstance(thing, Mechanism) else None)


def _made(thing: Movable, orientations: Orientations | None) -> tuple[PosedLinkage, Precision]:
    """Return the linkage that a thing without panels is, and how precise its coordinates are."""
    if isinstance(thing, PolyhedronModel):
        return linkage_of_rods(thing), precision_of(list(thing.coordinates.values()))
    if isinstance(thing, JointedLinkage) and thing.places:
        thing = revolutes_of(thing)
    if isinstance(thing, HingedSolids):
        return _with_centres(linkage_of_axes(thing.chain, thing.axes)), _precision_of_axes(thing.axes)
    if isinstance(thing, OnSurface):
        return posed_on_surface(thing), _EXACTLY
    if isinstance(thing, SurfaceLinkage):
        precision = _EXACTLY if thing.steps is None else precision_of_steps(thing)
        return posed_on_surface(_the_one(linkage_on_surfaces(thing), thing.kind)), precision
    if isinstance(thing, GuidedFourBar):
        if orientations is None:
            raise UnsolvableError("a guided four-bar has its moving axes in the body: expected its orientations")
        return _of_guided(thing, orientations.matrices[0]), _EXACTLY
    raise UnsolvableError(f"to move needs coordinates, and {thing!r} has none")


def with_precision(thing: Mechanism, precision: float | None) -> Mechanism | Configuration:
    """Return a thing whose coordinates are stated to be wrong by no more than a length, in their unit.

    Parameters
    ----------
    thing : Sheet, PolyhedronModel, HingedSolids, ...
    precision : float or None
        None returns the thing as it is.

    Returns
    -------
    Sheet or Configuration
        A sheet keeps its precision; anything else has one where it is.

    Raises
    ------
    InvariantError
        If it is no length.
    UnsolvableError
        If the thing has no coordinates.

    Examples
    --------
    >>> from synth.patterns import generate
    >>> with_precision(generate("bennett").mechanism, 0.01).precision.source
    'stated'
    """
    if precision is None:
        return thing
    sheet = sheet_of(thing)
    return configuration_of(thing, precision=precision) if sheet is None else stated(sheet, precision)


def _precision_of_axes(axes: Mapping[JointId, Axis]) -> Precision:
    """Return how precise axes are: the coarser of their points and their directions."""
    points, directions = (np.array([axis[part] for axis in axes.values()]) for part in (0, 1))
    both = (precision_of(one.reshape(-1, 3).tolist()) for one in (points, directions))
    return max(both, key=lambda one: one.size)


def _with_slides(thing: JointedLinkage) -> tuple[PosedLinkage, Precision]:
    """Return a linkage of revolute and prismatic joints, and how precise its coordinates are."""
    axes = {joint: (place.point, place.axes[0]) for joint, place in thing.places.items()}
    if not axes:
        raise UnsolvableError(f"to move needs coordinates, and {thing!r} has none")
    slides = [joint for joint, kind in thing.kinds.items() if kind is JointKind.PRISMATIC]
    return _with_centres(linkage_of_axes(thing.chain, axes, slides)), _precision_of_axes(axes)


def sheet_of(thing: Mechanism) -> Sheet | None:
    """Return a sheet, or a model that is its panels and no more, as a sheet; None of anything else."""
    if isinstance(thing, Sheet):
        return thing
    if not isinstance(thing, PolyhedronModel) or not thing.links:
        return None
    more = (*thing.centres, *thing.scissors, *thing.on_line, *thing.on_plane)
    return None if more or thing.ground is not None else to_sheet(thing)


def posed_on_surface(linkage: OnSurface) -> PosedLinkage:
    """Return a linkage on a surface at its conformed position, in the frame of `graphs.mechanism.surfaces`.

    All axes of a cone pass through its apex, so all loops have their centre there, whatever the chain says; those
    of a cylinder are parallel.

    Parameters
    ----------
    linkage : OnSurface

    Returns
    -------
    PosedLinkage

    Raises
    ------
    UnsolvableError
        If its surface is not known.

    Examples
    --------
    >>> from synth.conformed.linkages import loop_on_cones
    >>> first, _ = loop_on_cones(np.radians([120, 95, 45, 85]))
    >>> posed_on_surface(first)
    <PosedLinkage: 4 links, 4 joints, 1 loops>
    """
    if linkage.surface is None:
        raise UnsolvableError("the linkage lies on any cone or cylinder: expected a cone angle or a radius")
    points, directions = linkage.surface.axes(linkage.places)
    return _with_one_centre(linkage.chain, points, directions, linkage.surface.centre)


def _the_one(on_surfaces: Sequence[OnSurface], kind: str) -> OnSurface:
    if len(on_surfaces) != 1:
        told = numbered(len(on_surfaces), kind)
        raise UnsolvableError(
            f"the linkage lies on {told}: expected one (synth {kind} map --{kind} K -o one.json)"
        )
    return on_surfaces[0]


def _of_guided(four_bar: GuidedFourBar, body: Floats) -> PosedLinkage:
    """Return the joints O (driver, fixed), A and B (on the body) and C of a guided four-bar."""
    driver, follower = four_bar.driver, four_bar.follower
    ring = SCGraph(("ground", "driver", "body", "follower"), {
        "O": ("ground", "driver"), "A": ("driver", "body"), "B": ("body", "follower"), "C": ("follower", "ground"),
    }, ground="ground")  # fmt: skip
    moving = (body @ driver.moving, body @ follower.moving)
    directions = np.array([driver.fixed, *moving, follower.fixed])
    return _with_one_centre(ring, np.zeros_like(directions), directions, Centre.FINITE)


def _with_one_centre(chain: SCGraph, points: Floats, directions: Floats, centre: Centre) -> PosedLinkage:
    """Return a linkage whose axes all meet in a point, or are all parallel."""
    about_it = chain.with_loops([Loop(loop.joints, centre) for loop in independent_cycles(chain)])
    lines = zip(chain.joints, zip(points.tolist(), directions.tolist(), strict=True), strict=True)
    return linkage_of_axes(about_it, dict(lines))


def _with_centres(linkage: PosedLinkage) -> PosedLinkage:
    """Refuse loops whose axes do not meet as their centre says: three equations would not close them."""
    for loop in linkage.loops:
        points, axes = linkage.points[list(loop.joints)], linkage.directions[list(loop.joints)]
        if loop.centre is Centre.INFINITE:
            off = _off_plane(axes, [joint in linkage.slides for joint in loop.joints])
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


def _off_plane(axes: Floats, slides: Sequence[bool]) -> float:
    """Return by how much axes are not parallel, those of slides not across them."""
    sliding = np.array(slides)
    if sliding.all():
        return 0.0
    normal = axes[~sliding][0]
    return float(
        max(np.abs(np.cross(axes[~sliding], normal)).max(), np.abs(axes[sliding] @ normal).max(initial=0))
    )
