"""From an SCD graph to its polyhedron model, vertex by vertex.

Source: Wiener 2016, section 3.4.4 and Fig. 35. Theory: docs/theory/polyhedron-model.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from graphs.mechanism.drawing import FaceKind
from graphs.mechanism.polyhedron import PolyhedronModel, RemoteCentre
from graphs.mechanism.scd import SCDGraph
from graphs.types import LinkId

__all__ = ["VertexStep", "internal_rods", "polyhedron_of", "vertex_steps"]


@dataclass(frozen=True, slots=True)
class VertexStep:
    """One vertex of the reconstruction.

    Attributes
    ----------
    vertex : int
    face : int
        The face of the SCD graph in which it lies.
    kind : FaceKind
        What lies in that face; the vertex *is* the centre where it is explicit.
    links : tuple of link ids
        The links that meet in the vertex, in the order of the walk round the face.

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> steps = vertex_steps(scd_from_panels([("o", "a", "b"), ("o", "b", "c"), ("o", "c", "a")]))
    >>> [sorted(step.links) for step in steps if step.kind is FaceKind.EXPLICIT]
    [[0, 1, 2]]
    """

    vertex: int
    face: int
    kind: FaceKind
    links: tuple[LinkId, ...]


def vertex_steps(scd: SCDGraph) -> Iterator[VertexStep]:
    """Walk round each face and yield its vertices: one for each run of links between open edges.

    Parameters
    ----------
    scd : SCDGraph

    Yields
    ------
    VertexStep
        In the order of the numbers of the vertices.

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
    """Return the 2n - 6 rods that make a body of n vertices rigid, given its n sides.

    Two fans of n - 3 diagonals, from two neighbouring vertices, are with the n sides a triangulated sphere, which
    is rigid in general position (thesis 2.3.3).

    >>> internal_rods((0, 1, 2, 3))
    [(0, 2), (1, 3)]
    """
    first, second = around[0], around[1]
    from_first = [(first, other) for other in around[2:-1]]
    from_second = [(second, other) for other in around[3:]]
    return from_first + from_second


def polyhedron_of(scd: SCDGraph) -> PolyhedronModel:
    """Build the polyhedron model of an SCD graph.

    Each side of a link is a rod, shared where it is a joint; a link of n >= 4 sides gets 2n - 6 internal
    rods; a loop with an implicit centre is a remote centre S_{+3} of the rods of its joints.

    Parameters
    ----------
    scd : SCDGraph

    Returns
    -------
    PolyhedronModel
        Vertices 0 .. V - 1 as in ``scd.vertices``; no coordinates.

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
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
        centres=[_remote_centre(scd, face.index) for face in scd.faces if _is_implicit(scd, face.index)],
        links=dict(scd.vertices),
    )


def _is_implicit(scd: SCDGraph, face: int) -> bool:
    return scd.drawing.kind_of_face(face) is FaceKind.IMPLICIT


def _remote_centre(scd: SCDGraph, face: int) -> RemoteCentre:
    loop = scd.drawing.loop_of_face(face)
    assert loop is not None
    return RemoteCentre(3, tuple(scd.drawing.ends_of_joint(joint) for joint in loop.joints), loop.name)
