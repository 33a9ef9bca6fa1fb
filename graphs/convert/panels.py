"""Panels by their vertices, as in a mesh or a crease pattern, to an SCD graph, and that to its polyhedron model.

Two panels that share a side are hinged there; an interior vertex is a finite, explicit centre. Source: Wiener
2016, sections 3.4 and 3.4.4, Fig. 35. Theory: docs/theory/scd-graphs.md, docs/theory/polyhedron-model.md.
"""

from collections import deque
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from graphs.convert.cycles import loops_with_centres
from graphs.errors import InvariantError, shown
from graphs.geometry import area_vector
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.drawing import Face, FaceKind, face_cycles, trace_faces
from graphs.mechanism.polyhedron import PolyhedronModel, RemoteCentre
from graphs.mechanism.precision import in_space
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Edge, Sheet, sides_of_face
from graphs.types import JointId, LinkId

Panel = tuple[Any, ...]

Remote = Callable[[Mapping[JointId, tuple[Any, ...]], Sequence[tuple[JointId, ...]]], Sequence[Loop]]
"""Returns the loops round holes that have a centre."""
Implicit = Callable[[Mapping[frozenset[Any], JointId]], Sequence[Loop]]
"""Returns loops that have a centre which the links leave open."""


def scd_from_panels(
    panels: Mapping[Any, Sequence[Any]] | Sequence[Sequence[Any]],
    *,
    outer: Sequence[Hashable] | None = None,
    remote: Remote | None = None,
    implicit: Implicit | None = None,
) -> SCDGraph:
    """Return the SCD graph of panels, each a row of vertices; joint ids are indices, in the order of the panels.

    Parameters
    ----------
    panels : mapping of link to vertices, or sequence of vertex sequences
        The vertices of each panel in cyclic order, either way round. Links are indices where not named.
    outer : (vertex, vertex) or (vertex,), optional
        A side on the outer boundary, or the interior vertex that is the closing loop. Without it the boundary with
        the most open edges is the outer one; on a closed surface it is the last interior vertex.
    remote : callable, optional
        Called with the ends of the joints and the cycles of joints round holes with an open edge in every corner;
        returns those that have a centre, as loops. Without it loops round holes are spatial.
    implicit : callable, optional
        Called with the joint at each pair of vertices; returns loops known to have a centre, which are not outer.

    Raises
    ------
    InvariantError
        If a side belongs to three panels, the panels cannot be oriented alike, or an SCD rule is broken.

    Examples
    --------
    >>> fan = scd_from_panels([("o", "a", "b"), ("o", "b", "c"), ("o", "c", "d"), ("o", "d", "a")])
    >>> fan.counts.vertices, fan.counts.edges, len(fan.loops)
    (5, 8, 1)
    """
    named = dict(panels) if isinstance(panels, Mapping) else dict(enumerate(panels))
    around = oriented_panels({link: tuple(vertices) for link, vertices in named.items()})
    joint_at: dict[frozenset[Hashable], JointId] = {}
    joints: dict[JointId, tuple[LinkId, LinkId]] = {}
    for side, links in _panels_at_side(around).items():
        if len(links) == 2:
            joint_at[side] = len(joints)
            joints[len(joints)] = (links[0], links[1])
    rotation = {
        link: tuple(joint_at.get(frozenset(side)) for side in sides_of_face(vertices))
        for link, vertices in around.items()
    }
    ends = {joint: tuple(side) for side, joint in joint_at.items()}
    centred = None if remote is None else partial(remote, ends)
    known = [] if implicit is None else list(implicit(joint_at))
    return _with_faces(around, joints, rotation, outer, centred, known)


def oriented_panels(panels: Mapping[Any, Panel]) -> dict[LinkId, Panel]:
    """Turn panels over so that each shared side is passed in opposite directions by its two panels.

    Parameters
    ----------
    panels : mapping of link id to sequence of vertices
        The vertices round each panel, one way or the other. The first panel of each piece stays as it is.
        InvariantError if a side belongs to three panels, or the surface has one side only.

    Examples
    --------
    >>> oriented_panels({0: (1, 2, 3), 1: (2, 3, 4)})
    {0: (1, 2, 3), 1: (4, 3, 2)}
    """
    at_side = _panels_at_side(panels)
    result: dict[LinkId, Panel] = {}
    for start in panels:
        if start in result:
            continue
        result[start] = panels[start]
        queue = deque([start])
        while queue:
            link = queue.popleft()
            for a, b in sides_of_face(result[link]):
                for other in at_side[frozenset((a, b))]:
                    if other == link:
                        continue
                    if other not in result:
                        turned = (b, a) in set(sides_of_face(panels[other]))
                        result[other] = panels[other] if turned else panels[other][::-1]
                        queue.append(other)
                    elif (b, a) not in set(sides_of_face(result[other])):
                        raise InvariantError(
                            "orientable",
                            f"panels {shown(link)} and {shown(other)} cannot be turned the same way round",
                            "a surface with two sides",
                        )
    return {link: result[link] for link in panels}


def _panels_at_side(panels: Mapping[LinkId, Panel]) -> dict[frozenset[Hashable], list[LinkId]]:
    at_side: dict[frozenset[Hashable], list[LinkId]] = {}
    for link, vertices in panels.items():
        if len(set(vertices)) != len(vertices):
            raise InvariantError("panel", f"panel {shown(link)} names a vertex twice", "different vertices")
        if len(vertices) < 3:
            raise InvariantError("panel", f"panel {shown(link)} has {len(vertices)} vertices", "three or more")
        for side in sides_of_face(vertices):
            at_side.setdefault(frozenset(side), []).append(link)
    for edge, links in at_side.items():
        if len(links) > 2:
            raise InvariantError(
                "panel sides", f"side {shown(tuple(edge))} belongs to {len(links)} panels", "two at most"
            )
    return at_side


def _with_faces(
    around: Mapping[LinkId, Panel],
    joints: dict[JointId, tuple[LinkId, LinkId]],
    rotation: dict[LinkId, tuple[JointId | None, ...]],
    outer_at: Sequence[Hashable] | None,
    remote: Callable[[list[tuple[JointId, ...]]], Sequence[Loop]] | None,
    implicit: Sequence[Loop],
) -> SCDGraph:
    """Choose the outer face, not that round a panel without joints, and give every interior vertex its loop."""
    if not joints:
        return SCDGraph(around, joints, (), rotation=rotation)
    faces, left_of = trace_faces(joints, rotation)
    joined = [face for face in faces if face.corners[0].leaving is not None]
    centred = {frozenset(loop.joints) for loop in implicit}
    outer = max(joined, key=lambda face: (frozenset(face.joints) not in centred, face.open_edges)).index
    if (stated := _stated_outer(around, rotation, faces, left_of, outer_at or ())) is not None:
        outer = stated
    elif not faces[outer].open_edges:
        outer = joined[-1].index  # a closed surface
    loops: list[Loop] = list(implicit)
    closing: list[Loop] = []
    holes: list[tuple[JointId, ...]] = []
    for face in faces:
        cycles = face_cycles(face)
        if not face.open_edges and len(cycles) == 1:
            (closing if face.index == outer else loops).append(Loop(cycles[0], Centre.FINITE))
        elif len(cycles) == 1 and face.index != outer and face.open_corners == len(face.corners):
            holes.append(cycles[0])
    if remote is not None and holes:
        loops += remote(holes)
    corner = faces[outer].corners[0]
    assert corner.leaving is not None
    side = "left" if joints[corner.leaving][0] == corner.link else "right"
    return SCDGraph(around, joints, loops, rotation=rotation, outer=(corner.leaving, side), closing=closing)


def _stated_outer(
    around: Mapping[LinkId, Panel],
    rotation: Mapping[LinkId, Sequence[JointId | None]],
    faces: Sequence[Face],
    left_of: Mapping[tuple[JointId, LinkId], int],
    outer_at: Sequence[Hashable],
) -> int | None:
    """Return the face at an open side, or the one that is a vertex; None if there is none at these vertices."""
    stated = set(outer_at)
    if len(stated) == 1:
        for face in faces:
            first = face.corners[0]
            sides = sides_of_face(around[first.link])
            if not face.open_edges and set(sides[first.first_side]) & set(sides[first.last_side]) == stated:
                return face.index
        return None
    for link, vertices in (around if stated else {}).items():
        for i, side in enumerate(sides_of_face(vertices)):
            if set(side) == stated and rotation[link][i] is None and any(one is not None for one in rotation[link]):
                return _face_of_side(rotation, left_of, link, i)
    return None


def _face_of_side(
    rotation: Mapping[LinkId, Sequence[JointId | None]],
    left_of: Mapping[tuple[JointId, LinkId], int],
    link: LinkId,
    index: int,
) -> int:
    """Return the face in which an open edge lies: the one left of the next joint clockwise."""
    sides = rotation[link]
    while sides[index] is None:
        index -= 1
    return left_of[sides[index], link]


def scd_of_placed_panels(sheet: Sheet) -> SCDGraph:
    """Return the SCD graph of a sheet whose faces are its links, with the centres that geometry gives.

    The outer boundary is the one round the largest area. Where the creases of a loop round a hole meet in a point
    or are parallel, within the precision of the coordinates, it has an implicit centre there. Without coordinates
    loops round holes are spatial, and the boundary with the most open edges is the outer.
    """
    panels = oriented_panels(dict(enumerate(sheet.faces)))
    if sheet.coordinates is None:
        return scd_from_panels(panels)
    outer = _outer_side(sheet, panels)

    def remote(ends: Mapping[JointId, Edge], cycles: Sequence[tuple[JointId, ...]]) -> list[Loop]:
        return loops_with_centres(sheet, cycles, ends)  # type: ignore[arg-type]  # joints of panels are numbers

    return scd_from_panels(panels, outer=outer, remote=remote)


def _outer_side(sheet: Sheet, panels: Mapping[LinkId, Sequence[int]]) -> Edge | None:
    """Return a side on the boundary round the largest area; None where there is one boundary or none."""
    sides = {side for panel in panels.values() for side in sides_of_face(panel)}
    after = {b: a for a, b in sides if (b, a) not in sides}
    if len(after) < sum((b, a) not in sides for a, b in sides):
        return None  # boundaries that touch in a vertex are one
    places = in_space(sheet.coordinates or ())
    rings = rings_of(after)
    if len(rings) < 2:
        return None
    widest = max(rings, key=lambda ring: float(np.linalg.norm(area_vector(places[list(ring)]))))
    return widest[0], widest[1]


def rings_of(after: Mapping[int, int]) -> list[tuple[int, ...]]:
    """Return the rings of vertices that follow each other, each from the first in the mapping."""
    rings, seen = [], set[int]()
    for start in after:
        ring, here = [], start
        while here not in seen:
            seen.add(here)
            ring.append(here)
            here = after[here]
        if ring:
            rings.append(tuple(ring))
    return rings


@dataclass(frozen=True, slots=True)
class VertexStep:
    """One vertex of the reconstruction.

    Attributes
    ----------
    vertex : int
    face : int
        The face of the SCD graph in which it lies.
    kind : FaceKind
        The kind of that face; the vertex *is* its centre if that is explicit.
    links : tuple of link ids
        The links that meet in the vertex, in the order of the walk round the face.
    """

    vertex: int
    face: int
    kind: FaceKind
    links: tuple[LinkId, ...]


def vertex_steps(scd: SCDGraph) -> Iterator[VertexStep]:
    """Walk round each face and yield its vertices by their numbers, one for each run of links between open edges.

    Parameters
    ----------
    scd : SCDGraph

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> fan = scd_from_panels([("o", "a", "b"), ("o", "b", "c"), ("o", "c", "a")])
    >>> [step.kind.value for step in vertex_steps(fan)]
    ['outer', 'outer', 'outer', 'explicit']
    """
    meeting: dict[int, dict[LinkId, None]] = {}
    face_of: dict[int, int] = {}
    for face in scd.faces:
        for corner in face.corners:
            row = scd.vertices[corner.link]
            for step in range(corner.open_edges + 1):
                vertex = row[(corner.first_side - 1 - step) % len(row)]
                meeting.setdefault(vertex, {})[corner.link] = None
                face_of[vertex] = face.index
    for vertex in sorted(meeting):
        face_index = face_of[vertex]
        yield VertexStep(vertex, face_index, scd.drawing.kind_of_face(face_index), tuple(meeting[vertex]))


def internal_rods(around: tuple[int, ...]) -> list[tuple[int, int]]:
    """Return the 2n - 6 rods that make a body of n vertices and n sides rigid, in two fans (thesis 2.3.3)."""
    first, second = around[0], around[1]
    return [(first, other) for other in around[2:-1]] + [(second, other) for other in around[3:]]


def polyhedron_of(scd: SCDGraph) -> PolyhedronModel:
    """Build the polyhedron model of an SCD graph, with its vertices and without coordinates.

    Each side of a link is a rod, shared where it is a joint; a link of n >= 4 sides gets 2n - 6 internal rods; a
    loop with an implicit centre is a remote centre S_{+3} of the rods of its joints.

    Parameters
    ----------
    scd : SCDGraph

    Examples
    --------
    >>> model = polyhedron_of(scd_from_panels([("o", "a", "b"), ("o", "b", "c"), ("o", "c", "a")]))
    >>> len(model), model.number_of_edges()
    (4, 6)
    """
    rods: dict[frozenset[int], tuple[int, int]] = {}
    for around in scd.vertices.values():
        sides = [(around[i - 1], around[i]) for i in range(len(around))]
        for a, b in sides + internal_rods(around):
            rods.setdefault(frozenset((a, b)), (a, b))
    return PolyhedronModel(
        scd.counts.vertices,
        rods.values(),
        centres=[
            _remote_centre(scd, face.index)
            for face in scd.faces
            if scd.drawing.kind_of_face(face.index) is FaceKind.IMPLICIT
        ],
        links=dict(scd.vertices),
        outer=_outer_of(scd),
    )


def _outer_of(scd: SCDGraph) -> tuple[int, ...] | None:
    """Return what tells the outer face, if it is not the only one with the most open edges."""
    outer = scd.faces[scd.drawing.outer_face]
    others = [face.open_edges for face in scd.faces if face is not outer]
    if not others or outer.open_edges > max(others):
        return None
    corner = next((corner for corner in outer.corners if corner.open_edges), outer.corners[0])
    around = scd.vertices[corner.link]
    if not corner.open_edges:
        return (around[corner.last_side],)
    # the face is passed clockwise, so its open edges come before the joint by which it enters
    side = (corner.first_side - 1) % len(around)
    return around[side - 1], around[side]


def _remote_centre(scd: SCDGraph, face: int) -> RemoteCentre:
    loop = scd.drawing.loop_of_face(face)
    assert loop is not None
    rods = tuple(scd.drawing.ends_of_joint(joint) for joint in loop.joints)
    return RemoteCentre(3, rods, loop.name, loop.at, loop.centre is Centre.INFINITE)
