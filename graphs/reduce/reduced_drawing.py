"""The drawing of a reduced SCD graph: where links went, their joints become open edges of those that stay.

Faces on the two sides of a joint that went are one. A centred face keeps its centre; if it was explicit, and the
face that joined it has open edges, every corner gets one, and the centre is implicit. Theory:
docs/theory/reduction.md.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import networkx as nx

from graphs.loops.loop import Loop, in_span_of
from graphs.mechanism.drawing import Face, Side, face_cycles, trace_faces
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.types import JointId, LinkId


def drawn_as(original: SCDGraph, reduced: SCGraph) -> SCDGraph:
    """Return a reduced mechanism with the drawing that is left of the original.

    Parameters
    ----------
    original : SCDGraph
    reduced : SCGraph
        With some of its links and joints, and the loops over these.
    """
    rotation: dict[LinkId, list[Side]] = {
        link: [side if side in reduced.joints else None for side in original.rotation[link]] for link in reduced.nodes
    }
    outer = _outer(original, reduced)
    loops, closing = _loops(reduced, rotation, outer)
    for loop in loops:
        _open_every_corner(reduced, rotation, outer, loop)
    return SCDGraph(
        reduced.nodes,
        reduced.joints,
        loops,
        rotation=rotation,
        outer=outer,
        closing=closing,
        ground=reduced.ground,
        special=reduced.special,
    )


def _outer(original: SCDGraph, reduced: SCGraph) -> tuple[JointId, str] | None:
    """Return the outer face: the one that the original's is part of."""
    drawing = original.drawing
    merged = nx.utils.UnionFind(range(len(drawing.faces)))
    for joint in original.joints:
        if joint not in reduced.joints:
            merged.union(*drawing.faces_of_joint(joint))
    for joint in reduced.joints:
        for side, face in zip(("left", "right"), drawing.faces_of_joint(joint), strict=True):
            if merged[face] == merged[drawing.outer_face]:
                return joint, side
    return None


def _loops(
    reduced: SCGraph, rotation: Mapping[LinkId, Sequence[Side]], outer: tuple[JointId, str] | None
) -> tuple[list[Loop], list[Loop]]:
    """Return the faces that have a centre as loops, and the outer one, if it has one too, as the closing loop.

    A face has the centre of a class if its cycle is a sum of loops of the class. Spatial faces keep their loop.
    """
    every = (*reduced.loops, *reduced.closing)
    named = {frozenset(loop.joints): loop for loop in every}
    faces, outside = _faces(reduced, rotation, outer)
    loops: list[Loop] = []
    closing: list[Loop] = []
    for face in faces:
        for cycle in face_cycles(face):
            loop = named.get(frozenset(cycle)) or _of_a_class(cycle, reduced, every)
            if loop is None or (face.index == outside and not (loop.has_centre and reduced.closing)):
                continue
            listed = closing if face.index == outside else loops
            if not any(set(loop.joints) == set(one.joints) for one in (*loops, *closing)):
                listed.append(loop)
    return loops, closing


def _of_a_class(cycle: Sequence[JointId], reduced: SCGraph, every: Sequence[Loop]) -> Loop | None:
    """Return a cycle as a loop about the centre of the class that it is a sum of loops of; None if there is none."""
    for one in reduced.centre_classes():
        members = [every[loop] for loop in one.loops]
        if in_span_of(frozenset(cycle), [set(loop.joints) for loop in members]) is not None:
            return replace(members[0], joints=tuple(cycle), name=None)
    return None


def _open_every_corner(
    reduced: SCGraph, rotation: dict[LinkId, list[Side]], outer: tuple[JointId, str] | None, loop: Loop
) -> None:
    """Add an open edge, in place, in every corner of a centred face that has none while others have one."""
    if not loop.has_centre:
        return
    own = frozenset(loop.joints)
    faces, outside = _faces(reduced, rotation, outer)
    for face in faces:
        if face.index != outside and frozenset(face.joints) == own and 0 < face.open_corners < len(face.corners):
            for corner in face.corners:
                if not corner.open_edges:
                    rotation[corner.link].insert(corner.first_side, None)


def _faces(
    reduced: SCGraph, rotation: Mapping[LinkId, Sequence[Side]], outer: tuple[JointId, str] | None
) -> tuple[tuple[Face, ...], int | None]:
    """Return the faces, and the index of the outer one."""
    faces, left_of = trace_faces(reduced.joints, {link: tuple(sides) for link, sides in rotation.items()})
    if outer is None:
        return faces, None
    joint, side = outer
    return faces, left_of[joint, reduced.joints[joint][0 if side == "left" else 1]]
