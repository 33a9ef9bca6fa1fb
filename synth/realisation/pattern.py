"""What is to be drawn of a type: panels, creases and borders in numbers, and which creases point to which centre.

A bounded face without open edges is an inner vertex; one with open edges is a hole; the outer face is the border.
Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from graphs.convert.panels import rings_of
from graphs.errors import UnsolvableError
from graphs.loops.classes import CentreClass
from graphs.loops.loop import Centre
from graphs.mechanism.drawing import FaceKind
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Edge, sides_of_face
from graphs.types import Flags, Floats, Ints, JointId, LinkId

__all__ = ["Pattern", "Pointing", "pattern_of"]


@dataclass(frozen=True, slots=True)
class Pointing:
    """Creases (places in ``Pattern.creases``) that point to a centre which they do not reach.

    They are parallel if it is infinite. `vertex` is the vertex that the centre is, where another loop of its class
    has it explicit; `holes` are the places in ``Pattern.holes`` of the holes that it lies across.
    """

    creases: tuple[int, ...]
    infinite: bool
    vertex: int | None
    holes: tuple[int, ...]


@dataclass(frozen=True)
class Pattern:
    """The panels of a type, without coordinates.

    `panels` are the vertices of each link, `outer` those of the border and `holes` those round each hole, all
    counter-clockwise; `creases` are the two vertices of each joint.
    """

    links: tuple[LinkId, ...]
    joints: tuple[JointId, ...]
    panels: tuple[tuple[int, ...], ...]
    vertices: int
    creases: tuple[Edge, ...]
    outer: tuple[int, ...]
    holes: tuple[tuple[int, ...], ...]
    pointings: tuple[Pointing, ...]

    @cached_property
    def corners(self) -> Ints:
        """int64[K, 3]: the vertices before, at and after each corner of a panel, panel by panel."""
        rows = [(p[i - 1], p[i], p[(i + 1) % len(p)]) for p in self.panels for i in range(len(p))]
        return np.array(rows, np.int64)

    @cached_property
    def panel_of_corner(self) -> Ints:
        """int64[K]: the panel of each corner."""
        return np.repeat(np.arange(len(self.panels)), [len(panel) for panel in self.panels])

    @cached_property
    def bent(self) -> Flags:
        """bool[P]: which panels cannot be convex.

        Two sides of a convex panel at most have lines through a point outside it, or through one of its vertices:
        a link with three axes through a centre is no convex panel.
        """
        links = [self._links_at(one) for one in self.pointings]
        return np.array([any(row.count(panel) > 2 for row in links) for panel in range(len(self.panels))])

    @cached_property
    def widest(self) -> Floats:
        """float[K]: below which angle each corner stays: 180 degrees, or 360 in a panel that cannot be convex."""
        widest: Floats = np.where(self.bent[self.panel_of_corner], 2 * np.pi, np.pi)
        return widest

    def _links_at(self, one: Pointing) -> list[int]:
        """Return the panels of all creases through a centre, once for each crease."""
        ends = [set(self.creases[crease]) for crease in one.creases]
        ends += [set(crease) for crease in self.creases if one.vertex in crease]
        sides = [[set(side) for side in sides_of_face(panel)] for panel in self.panels]
        return [place for end in ends for place, row in enumerate(sides) if end in row]

    @cached_property
    def edges(self) -> Ints:
        """int64[E, 2]: creases, then borders of the sheet and its holes."""
        borders = [side for ring in (self.outer, *self.holes) for side in sides_of_face(ring)]
        return np.array([*self.creases, *borders], np.int64)

    @cached_property
    def aims(self) -> Ints:
        """int64[A, 4]: the ends of each crease that points to a centre, the centre, whether it is infinite.

        Centres that are no vertices are numbered on from these.
        """
        rows, free = [], self.vertices
        for one in self.pointings:
            centre = free if one.vertex is None else one.vertex
            free += one.vertex is None
            rows += [(*self.creases[crease], centre, one.infinite) for crease in one.creases]
        return np.array(rows, np.int64).reshape(-1, 4)

    @cached_property
    def directions(self) -> Ints:
        """int64[D]: the numbers of the infinite centres."""
        return np.unique(self.aims[self.aims[:, 3] == 1, 2])

    @cached_property
    def inner(self) -> Ints:
        """int64[I]: the vertices with panels all round."""
        border = {vertex for ring in (self.outer, *self.holes) for vertex in ring}
        return np.array([v for v in range(self.vertices) if v not in border], np.int64)


def pattern_of(scd: SCDGraph) -> Pattern:
    """Return the pattern of a type.

    Raises `UnsolvableError` if the panels close to a surface without a border.
    """
    rings = _rings(scd)
    outer_vertex = _border_vertex(scd, scd.drawing.outer_face)
    if outer_vertex is None:
        raise UnsolvableError("the panels close to a surface without a border: it cannot lie flat")
    outer = next(ring for ring in rings if outer_vertex in ring)
    holes = tuple(ring for ring in rings if ring is not outer)
    return Pattern(
        tuple(scd.nodes),
        tuple(scd.joints),
        tuple(scd.vertices[link] for link in scd.nodes),
        scd.drawing.vertex_count,
        tuple(scd.drawing.ends_of_joint(joint) for joint in scd.joints),
        outer[::-1],
        holes,
        tuple(_pointings(scd, holes)),
    )


def _rings(scd: SCDGraph) -> list[tuple[int, ...]]:
    """Return the vertices along each face with open edges, the face on the left."""
    after = {}
    for link, sides in scd.rotation.items():
        around = scd.vertices[link]
        after.update({around[i]: around[i - 1] for i, side in enumerate(sides) if side is None})
    return rings_of(after)


def _border_vertex(scd: SCDGraph, face: int) -> int | None:
    """Return a vertex of a face with open edges; None if it has none."""
    for corner in scd.faces[face].corners:
        if corner.open_edges:
            around = scd.vertices[corner.link]
            return around[(corner.first_side - 1) % len(around)]
    return None


def _pointings(scd: SCDGraph, holes: tuple[tuple[int, ...], ...]) -> list[Pointing]:
    """Return the creases of each centre class that do not end in its centre."""
    number = {joint: place for place, joint in enumerate(scd.joints)}
    faces_of: dict[frozenset[JointId], list[int]] = {}
    for face in scd.faces:
        loop = scd.drawing.loop_of_face(face.index)
        if loop is not None:
            faces_of.setdefault(frozenset(loop.joints), []).append(face.index)
    found = []
    for one in scd.centre_classes():
        faces = [face for loop in one.loops for face in faces_of[_joints_of(scd, loop)]]
        implicit = [face for face in faces if scd.drawing.kind_of_face(face) is FaceKind.IMPLICIT]
        vertex = _explicit_vertex(scd, faces)
        ends = {joint: scd.drawing.ends_of_joint(joint) for joint in one.joints}
        creases = tuple(sorted(number[joint] for joint in one.joints if vertex not in ends[joint]))
        if not creases:
            continue
        across = [_border_vertex(scd, face) for face in implicit]
        places = tuple(place for place, ring in enumerate(holes) if any(v in ring for v in across))
        found.append(Pointing(creases, _is_infinite(one), vertex, places))
    return found


def _joints_of(scd: SCDGraph, loop: int) -> frozenset[JointId]:
    return frozenset(scd.drawing.loops[loop].joints)


def _is_infinite(one: CentreClass) -> bool:
    return one.centre is Centre.INFINITE


def _explicit_vertex(scd: SCDGraph, faces: list[int]) -> int | None:
    """Return the vertex that the centre of one of some faces is, if one is explicit."""
    for face in faces:
        if scd.drawing.kind_of_face(face) is FaceKind.EXPLICIT:
            corner = scd.faces[face].corners[0]
            return scd.vertices[corner.link][corner.last_side]
    return None
