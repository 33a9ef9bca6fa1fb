"""Anything that has coordinates as a mechanism at a configuration: made here, and nowhere else.

Theory: docs/theory/moving.md.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from itertools import combinations, pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import networkx as nx
import numpy as np

from graphs.answer.mobility import precision_of_steps
from graphs.convert.conversions import Mechanism, to_sheet, without_coordinates
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.files.formats import read
from graphs.files.mechanism_like import MechanismLike
from graphs.geometry import frame_about, lines_meet, unit
from graphs.joints.centres import centred_by_axes
from graphs.joints.linkage import JointedLinkage, JointKind
from graphs.joints.revolutes import revolutes_of
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.closed_form import ClosedFormLinkage
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.precision import Precision, precision_of, stated
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet, WrittenPrecision
from graphs.mechanism.solids import Axis, HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage
from graphs.rank.exact import independent_cycles
from graphs.tolerances import DOUBLE, Tolerances, leading
from graphs.types import Floats, JointId
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.configuration import EXACT, Configuration
from synth.analysis.motion.linkage import Linkage, linkage_of_axes

if TYPE_CHECKING:
    from synth.linkages.guidance.orientations import Orientations


def linkage_of_rods(model: PolyhedronModel) -> Linkage:
    """Return the linkage of hinges that moves as the rods of a polyhedron model do.

    A rod may turn about itself, which says nothing of the model. So the rods are joined along a tree, and there
    each has just the hinges that its direction needs: two where it meets the rod before it, across it and each
    other, one where that is the first of all, whose own turning is that of the whole. Where rods meet beside the
    tree, three hinges stand for the ball between them. So the freedoms are those of the model: 3 V - 6 less the
    redundant ones. Links are the rods, by their place in the list of rods, and bodies between hinges.

    Parameters
    ----------
    model : PolyhedronModel
        With coordinates; rods only.

    Raises
    ------
    UnsolvableError
        If it has no coordinates, more than rods, or several parts.
    InvariantError
        If a rod has no length.

    Examples
    --------
    A square of four rods, in the plane: a hinge of it folds out of the plane.

    >>> corners = {0: (0, 0, 0), 1: (1, 0, 0), 2: (1, 1, 0), 3: (0, 1, 0)}
    >>> linkage = linkage_of_rods(PolyhedronModel(4, [(0, 1), (1, 2), (2, 3), (3, 0)], coordinates=corners))
    >>> closure = ClosureEquations(linkage)
    >>> closure.joints - closure.rows  # one freedom in the plane, one out of it
    2
    """
    _check_only_rods(model)
    rods = list(model.edges)
    directions = _directions(rods, np.array([[model.coordinates[v] for v in rod] for rod in rods], dtype=float))
    tolerances = Tolerances.of(precision_of(list(model.coordinates.values())).size)
    links: list[Hashable] = list(range(len(rods)))
    joints: dict[Hashable, tuple[Hashable, Hashable]] = {}
    axes: dict[Hashable, tuple[list[float], list[float]]] = {}

    def join(first: int, second: int, vertex: Hashable, directions: Floats) -> None:
        """Join two rods at a vertex, by hinges one after the other; small bodies lie between these."""
        name = f"{first}-{second}"
        between: list[Hashable] = [f"{name}.{number}" for number in range(1, len(directions))]
        links.extend(between)
        ends = pairwise([first, *between, second])
        for letter, direction, pair in zip("abc", directions, ends, strict=False):
            joint = f"{name}.{letter}" if between else name
            joints[joint] = pair
            axes[joint] = (list(model.coordinates[vertex]), direction.tolist())

    meetings: dict[Hashable, list[int]] = {vertex: [] for vertex in model.nodes}
    for number, rod in enumerate(rods):
        for vertex in rod:
            meetings[vertex].append(number)
    tree = _tree(meetings, directions, tolerances.parallel)
    for first, second, vertex in tree:
        across = _across(directions[first], directions[second], tolerances.parallel)
        join(first, second, vertex, across if joints else across[:1])
    for first, second, vertex in _others(meetings, tree):
        join(first, second, vertex, np.eye(3))
    return linkage_of_axes(SCGraph(links, joints), axes)


def _check_only_rods(model: PolyhedronModel) -> None:
    if not model.coordinates:
        raise without_coordinates(model)
    more = {
        "remote centres": model.centres,
        "points on lines": model.on_line,
        "points on planes": model.on_plane,
        "scissors": model.scissors,
        "a ground link": model.ground,
    }
    others = [name for name, terms in more.items() if terms]
    if others:
        raise UnsolvableError(f"the polyhedron model has {' and '.join(others)}; expected rods only")
    if len(model) > 1 and not nx.is_connected(model):
        raise UnsolvableError("the polyhedron model has several parts; expected 1")
    if not model.number_of_edges():
        raise UnsolvableError("the polyhedron model has no rods")


def _directions(rods: list[tuple[Any, Any]], ends: Floats) -> Floats:
    """Return the unit vectors along rods: float[rods, 3]."""
    along = ends[:, 1] - ends[:, 0]
    sizes = np.abs(along).max(axis=1)
    for rod in np.flatnonzero(sizes == 0.0):
        raise InvariantError("rod", f"the rod between vertices {shown(rods[rod])} has no length")
    return unit(along / sizes[:, None])


_Meeting = tuple[int, int, Hashable]
"""Two rods, and the vertex at which they meet."""


def _tree(meetings: Mapping[Hashable, list[int]], directions: Floats, parallel: float) -> list[_Meeting]:
    """Return a tree of the rods, (rod, next rod, vertex) from the first; the first two are not in line."""
    touching = nx.Graph()
    touching.add_nodes_from(range(len(directions)))
    for vertex, here in meetings.items():
        touching.add_edges_from(combinations(here, 2), vertex=vertex)
    root, turn = _beginning(touching, directions, parallel)
    order = [(root, turn), *nx.bfs_edges(touching, root)] if turn is not None else []
    seen, tree = {root}, []
    for first, second in order:
        if second not in seen:
            seen.add(second)
            tree.append((first, second, touching[first][second]["vertex"]))
    return tree


def _beginning(touching: nx.Graph, directions: Floats, parallel: float) -> tuple[int, int | None]:
    """Return two rods that meet at the largest angle; None for the second if there is only one rod."""
    if len(directions) == 1:
        return 0, None
    pairs = list(touching.edges)
    ends = np.array(pairs).T
    sines = np.linalg.norm(np.cross(directions[ends[0]], directions[ends[1]]), axis=1)
    best = leading(sines)
    if sines[best] <= parallel:
        raise UnsolvableError("all rods are in line, so their plane is not known")
    first, second = pairs[best]
    return int(first), int(second)


def _others(meetings: Mapping[Hashable, list[int]], tree: list[_Meeting]) -> list[_Meeting]:
    """Return the meetings that the tree leaves out: at each vertex all rods are joined, without circles."""
    left = []
    for vertex, here in meetings.items():
        joined = nx.Graph([(a, b) for a, b, at in tree if at == vertex])
        joined.add_nodes_from(here)
        parts = [min(part) for part in nx.connected_components(joined)]
        left += [(parts[0], other, vertex) for other in parts[1:]]
    return left


def _across(first: Floats, second: Floats, parallel: float) -> Floats:
    """Return two directions across a rod: that across the rod before it too, if they are not in line, first."""
    normal = np.cross(first, second)
    if np.linalg.norm(normal) <= parallel:
        return frame_about(second)[:2]
    return np.stack([unit(normal), np.cross(second, unit(normal))])


Movable: TypeAlias = Configuration | Linkage | MechanismLike | ClosedFormLinkage
"""A configuration, or a mechanism with coordinates, or its file."""

_EXACTLY = Precision(0.0, "exact")

_OF_ONE_FREEDOM = {JointKind.REVOLUTE, JointKind.PRISMATIC}


def configuration_of(
    mechanism: Movable,
    *,
    orientations: Orientations | None = None,
    frame: int | None = None,
    mend: bool = True,
    hinge_flat: bool = False,
    precision: float | None = None,
    slides: bool = False,
) -> Configuration:
    """Return any mechanism that has coordinates at a configuration.

    Parameters
    ----------
    mechanism : Mechanism, str, Path, Configuration, Linkage, OnSurface or GuidedFourBar
        A model that knows its links is a sheet of panels, else its rods are links. A linkage on a surface lies
        there, a guided four-bar takes the first of its orientations. A Configuration is returned as it is.
    orientations : Orientations, optional
        Those of a guided four-bar, whose moving axes are in the frame of the body.
    frame : int, optional
        For a sheet that has several; by default as it was read, or if that has no coordinates the first that has.
    mend : bool, optional
        Move vertices of a sheet within the precision of their coordinates if it has more motion branches so.
    hinge_flat : bool, optional
        Make hinges of the flat (F) edges of a sheet too.
    precision : float, optional
        The error that a coordinate may have, in the unit of the coordinates; by default as they are written, or as
        the geometry of a sheet shows. A Configuration has its own.
    slides : bool, optional
        Keep the prismatic joints of a linkage of revolute and prismatic joints, in place of equivalent revolutes.

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
    <Configuration: <Linkage: 4 links, 4 joints, 1 loops>>
    """
    if isinstance(mechanism, str | Path | nx.Graph):
        mechanism = read(mechanism)
    if isinstance(mechanism, Configuration):
        return mechanism
    if isinstance(mechanism, Linkage):
        ClosureEquations(mechanism).check_closed(mechanism.angles)
        return Configuration(mechanism, _EXACTLY)
    if isinstance(mechanism, Sheet) or (frame is None and isinstance(mechanism, PolyhedronModel)):
        sheet, options = sheet_of(mechanism), {"hinge_flat": hinge_flat, "mend": mend}
        if sheet is not None:
            return configuration_of_sheet(sheet, frame=frame, precision=precision, **options)
    if frame:
        raise InvariantError("frames", f"{mechanism!r} has no frames", "a .fold file")
    if slides and isinstance(mechanism, JointedLinkage) and set(mechanism.kinds.values()) <= _OF_ONE_FREEDOM:
        linkage, written = _with_slides(mechanism, precision)
    else:
        linkage, written = _made(mechanism, orientations, precision)
    if precision is not None:
        written = Precision(WrittenPrecision(precision, "stated").length / linkage.extent, "stated")
    given = mechanism if isinstance(mechanism, Mechanism) else None
    return Configuration(linkage, written, written.size <= EXACT, given)


def _made(mechanism: Movable, orientations: Orientations | None, length: float | None) -> tuple[Linkage, Precision]:
    """Return the linkage that a mechanism without panels is, and how precise its coordinates are."""
    if isinstance(mechanism, PolyhedronModel):
        return linkage_of_rods(mechanism), precision_of(list(mechanism.coordinates.values()))
    if isinstance(mechanism, JointedLinkage) and mechanism.places:
        mechanism = revolutes_of(mechanism)
    if isinstance(mechanism, HingedSolids):
        return _of_axes(mechanism.chain, mechanism.axes, length)
    if isinstance(mechanism, ClosedFormLinkage):
        body = None if orientations is None else orientations.matrices[0]
        return linkage_of_closed_form(mechanism, body), _EXACTLY
    if isinstance(mechanism, SurfaceLinkage):
        precision = _EXACTLY if mechanism.steps is None else precision_of_steps(mechanism)
        return linkage_of_closed_form(_on_its_surface(mechanism)), precision
    raise without_coordinates(mechanism)


def with_precision(mechanism: Mechanism, precision: float | None) -> Mechanism | Configuration:
    """Return a mechanism whose coordinates are stated to be wrong by no more than a length, in their unit.

    A sheet keeps its precision, any other mechanism has one at its configuration.
    """
    if precision is None:
        return mechanism
    sheet = sheet_of(mechanism)
    return configuration_of(mechanism, precision=precision) if sheet is None else stated(sheet, precision)


def _precision_of_axes(axes: Mapping[JointId, Axis]) -> Precision:
    """Return how precise axes are: the coarser of their points and their directions."""
    points, directions = (np.array([axis[part] for axis in axes.values()]) for part in (0, 1))
    both = (precision_of(vectors.reshape(-1, 3).tolist()) for vectors in (points, directions))
    return max(both, key=lambda precision: precision.size)


def _with_slides(mechanism: JointedLinkage, length: float | None) -> tuple[Linkage, Precision]:
    """Return a linkage of revolute and prismatic joints, and how precise its coordinates are."""
    axes = {joint: (place.point, place.axes[0]) for joint, place in mechanism.places.items()}
    if not axes:
        raise without_coordinates(mechanism)
    slides = [joint for joint, kind in mechanism.kinds.items() if kind is JointKind.PRISMATIC]
    return _of_axes(mechanism.chain, axes, length, slides)


def _of_axes(
    chain: SCGraph, axes: Mapping[JointId, Axis], length: float | None, slides: Sequence[JointId] = ()
) -> tuple[Linkage, Precision]:
    """Return a linkage by its axes, its loops spherical or planar where these say so within their precision."""
    written = _precision_of_axes(axes)
    given = linkage_of_axes(chain, axes, slides=slides)
    size = written.size if length is None else length / given.extent
    centred = centred_by_axes(chain, axes, size, slides)
    linkage = given if centred is chain else linkage_of_axes(centred, axes, slides=slides)
    return _with_centres(linkage, len(chain.centred_loops) if linkage is not given else len(linkage.loops)), written


def sheet_of(mechanism: Mechanism) -> Sheet | None:
    """Return a sheet, or a model that is its panels and no more, as a sheet; else None."""
    if isinstance(mechanism, Sheet):
        return mechanism
    if not isinstance(mechanism, PolyhedronModel) or not mechanism.links:
        return None
    more = (*mechanism.centres, *mechanism.scissors, *mechanism.on_line, *mechanism.on_plane)
    return None if more or mechanism.ground is not None else to_sheet(mechanism)


def linkage_of_closed_form(linkage: ClosedFormLinkage, body: Floats | None = None) -> Linkage:
    """Return a linkage of closed form where it lies: on a surface, in the frame of `graphs.mechanism.surfaces`.

    All axes of a cone pass through its apex, so all loops have their centre there, whatever the chain says; those
    of a cylinder are parallel.

    Parameters
    ----------
    linkage : ClosedFormLinkage
        An OnSurface or a GuidedFourBar, say.
    body : float[3, 3], optional
        The orientation of a guided body.

    Raises
    ------
    UnsolvableError
        If its surface is not known, or the orientation of the body that it guides.

    Examples
    --------
    >>> from synth.linkages.conformed.linkage_behaviour import loop_on_cones
    >>> first, _ = loop_on_cones(np.radians([120, 95, 45, 85]))
    >>> linkage_of_closed_form(first)
    <Linkage: 4 links, 4 joints, 1 loops>
    """
    chain, points, directions, centre = linkage.placed_chain(body)
    about_it = chain.with_loops([Loop(loop.joints, centre) for loop in independent_cycles(chain)])
    lines = zip(chain.joints, zip(points.tolist(), directions.tolist(), strict=True), strict=True)
    return linkage_of_axes(about_it, dict(lines))


def _on_its_surface(linkage: SurfaceLinkage) -> ClosedFormLinkage:
    # Surfaces are looked for here alone: a question about a sheet does not load the linkages of closed form.
    from synth.linkages.conformed.linkage_behaviour import linkage_on_surfaces

    on_surfaces, kind = linkage_on_surfaces(linkage), linkage.kind
    if len(on_surfaces) != 1:
        surfaces, command = numbered(len(on_surfaces), kind), f"synth {kind} map --{kind} K -o one.json"
        raise UnsolvableError(f"the linkage lies on {surfaces}; expected 1; try {command}")
    return on_surfaces[0]


def _with_centres(linkage: Linkage, declared: int) -> Linkage:
    """Refuse declared loops whose axes do not meet as their centre says: three equations would not close them."""
    for loop in linkage.loops[:declared]:
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
    turning_off = np.abs(np.cross(axes[~sliding], normal)).max()
    return float(max(turning_off, np.abs(axes[sliding] @ normal).max(initial=0)))
