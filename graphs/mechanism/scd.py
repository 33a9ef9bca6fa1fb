"""The SCD graph: an SC graph with the cyclic order of the sides of every link.

The order of joints and open edges round each link draws the graph on the sphere and so fixes the polyhedron
model: which vertices there are and which link has which. Source: Wiener 2016, section 3.4.
Theory: docs/theory/scd-graphs.md. The rules a valid SCD graph obeys are in :mod:`graphs.mechanism.rules`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from types import MappingProxyType
from typing import Any

from graphs.errors import InvariantError, shown
from graphs.ids import JointId, LinkId
from graphs.loops.loop import Loop
from graphs.mechanism.drawing import Face, Side, check_rotation, face_cycles, link_vertices, trace_faces
from graphs.mechanism.rules import check_rules, check_sides
from graphs.mechanism.sc import SCGraph

__all__ = ["FaceKind", "FeatureCounts", "SCDGraph"]


class FaceKind(Enum):
    """What lies in a face of an SCD graph."""

    EXPLICIT = "explicit"
    """A centre that is a vertex of the links themselves."""
    IMPLICIT = "implicit"
    """A remote centre: the axes meet there, the links do not reach it."""
    SPATIAL = "spatial"
    """No centre."""
    OUTER = "outer"
    """The rest of the sphere; without a centre."""


@dataclass(frozen=True, slots=True)
class FeatureCounts:
    """Counts of the features of an SCD graph (thesis 3.4.3).

    Attributes
    ----------
    vertices : int
        V = open edges + faces without open edges.
    implicit_centres : int
        C, loops (not classes) with an implicit centre.
    external_edges : int
        E_ext = joints + open edges.
    internal_edges : int
        E_int, the sum of 2n - 6 over the links of n >= 4 sides.
    open_edges, faces : int
    """

    vertices: int
    implicit_centres: int
    external_edges: int
    internal_edges: int
    open_edges: int
    faces: int

    @property
    def edges(self) -> int:
        """E = E_ext + E_int."""
        return self.external_edges + self.internal_edges


class SCDGraph(SCGraph):
    """An SC graph with the rotation of every link: the type of a polyhedron model.

    Parameters
    ----------
    links, joints, loops, closing, ground
        As in :class:`graphs.mechanism.sc.SCGraph`. The graph is connected.
    rotation : mapping of link to sequence of sides
        The sides of each link counter-clockwise: joint ids, and None for an open edge.
    outer : (joint, "left" or "right"), optional
        The outer face: the one on that side of the joint, looking from its first link to its second. May be
        left out where there is one face only (trees).

    Raises
    ------
    InvariantError
        Naming the rule that is broken; the rules are listed in :mod:`graphs.mechanism.rules`.

    Examples
    --------
    A spherical four-bar of four triangles round one explicit centre:

    >>> from graphs.loops.loop import Loop
    >>> fourbar = SCDGraph(
    ...     4,
    ...     [(0, 1), (1, 2), (2, 3), (3, 0)],
    ...     [Loop((0, 1, 2, 3))],
    ...     rotation={0: (0, 3, None), 1: (1, 0, None), 2: (2, 1, None), 3: (3, 2, None)},
    ...     outer=(0, "right"),
    ... )
    >>> fourbar.counts.vertices, fourbar.counts.edges
    (5, 8)
    """

    outer: tuple[JointId, str] | None

    def __init__(
        self,
        links: int | Iterable[LinkId] | None = None,
        joints: Mapping[Any, tuple[LinkId, LinkId]] | Iterable[tuple[LinkId, LinkId]] = (),
        loops: Iterable[Loop] = (),
        *,
        rotation: Mapping[Any, Sequence[Side]] | None = None,
        outer: tuple[JointId, str] | None = None,
        closing: Iterable[Loop] = (),
        ground: LinkId | None = None,
    ) -> None:
        super().__init__(links, joints, loops, closing=closing, ground=ground)
        self._rotation: dict[LinkId, tuple[Side, ...]] = {}
        self.outer = None
        if links is None:
            return
        self._set_rotation(rotation or {})
        self._set_outer(outer)
        self.face_loops = self._match_loops()
        check_rules(self)

    # ---- construction -------------------------------------------------------------------------------

    def _set_rotation(self, rotation: Mapping[Any, Sequence[Side]]) -> None:
        for link in rotation:
            if link not in self:
                raise InvariantError("rotation", f"there is a rotation for {shown(link)}, which is no link")
        for link in self.nodes:
            if link not in rotation:
                raise InvariantError("rotation", f"link {shown(link)} has no rotation", "one for each link")
            self._rotation[link] = tuple(rotation[link])
        check_rotation(self.joints, self._rotation)
        if self.components != 1:
            raise InvariantError("connected", f"the graph has {self.components} parts", "one")
        check_sides(self._rotation)
        self.faces, self._left_of = trace_faces(self.joints, self._rotation)
        surplus = 2 - (len(self) - len(self.joints) + len(self.faces))
        if surplus:
            raise InvariantError(
                "genus 0", f"the rotations draw the graph on a surface of genus {surplus // 2}", "a sphere"
            )
        self._vertex_count, self._vertices = link_vertices(self.faces, self._rotation)

    def _set_outer(self, outer: tuple[JointId, str] | None) -> None:
        if outer is None:
            if len(self.faces) > 1:
                raise InvariantError("outer face", f"there are {len(self.faces)} faces and none is the outer one")
            self.outer_face = 0
            return
        joint, side = outer
        if joint not in self.joints or side not in ("left", "right"):
            raise InvariantError(
                "outer face", f"the outer face is given as {shown(outer)}", "a joint and 'left' or 'right'"
            )
        self.outer = (joint, side)
        self.outer_face = self.face_at(joint, side)

    def _match_loops(self) -> tuple[int | None, ...]:
        """Find the loop of each face: loops belong to bounded faces, a closing loop to the outer one."""
        every = (*self.loops, *self.closing)
        bounded = {frozenset(loop.joints): i for i, loop in enumerate(self.loops)}
        outer = {frozenset(loop.joints): i for i, loop in enumerate(self.closing, start=len(self.loops))}
        matched = tuple(
            (outer if face.index == self.outer_face else bounded).get(frozenset(self._own_cycle(face)))
            for face in self.faces
        )
        for index in sorted(set(range(len(every))) - set(matched)):
            which = "a bounded face" if index < len(self.loops) else "the outer face"
            raise InvariantError("loops are faces", f"{every[index].label} is not the outer cycle of {which}")
        return matched

    def _own_cycle(self, face: Face) -> tuple[JointId, ...]:
        """Return the cycle that a face's centre belongs to: the one that parts it from the outer face."""
        cycles = face_cycles(face)
        if len(cycles) > 1 and face.index != self.outer_face:
            cycles = [cycle for cycle in cycles if self._encloses(cycle, face)]
        return cycles[0] if len(cycles) == 1 else ()

    def _encloses(self, cycle: tuple[JointId, ...], face: Face) -> bool:
        """Whether the outer face lies on the far side of a cycle on the boundary of a face."""
        barrier = set(cycle)
        across = [f for joint in cycle for f in self.faces_of_joint(joint) if f != face.index]
        neighbours = self._face_neighbours
        seen = set(across)
        while across:
            here = across.pop()
            if here == self.outer_face:
                return True
            for joint, there in neighbours[here]:
                if joint not in barrier and there not in seen:
                    seen.add(there)
                    across.append(there)
        return False

    @cached_property
    def _face_neighbours(self) -> dict[int, list[tuple[JointId, int]]]:
        around: dict[int, list[tuple[JointId, int]]] = {face.index: [] for face in self.faces}
        for joint in self.joints:
            left, right = self.faces_of_joint(joint)
            around[left].append((joint, right))
            around[right].append((joint, left))
        return around

    # ---- what it is ---------------------------------------------------------------------------------

    @property
    def rotation(self) -> Mapping[LinkId, tuple[Side, ...]]:
        """Link to its sides, counter-clockwise (read-only)."""
        return MappingProxyType(self._rotation)

    @property
    def vertices(self) -> Mapping[LinkId, tuple[int, ...]]:
        """Link to its vertices, counter-clockwise; item ``i`` lies between side ``i`` and side ``i + 1``."""
        return MappingProxyType(self._vertices)

    def face_at(self, joint: JointId, side: str) -> int:
        """Return the index of the face on the ``"left"`` or ``"right"`` of a joint, first link to second."""
        first, second = self.joints[joint]
        return self._left_of[joint, first if side == "left" else second]

    def faces_of_joint(self, joint: JointId) -> tuple[int, int]:
        """Return the faces on the left and on the right of a joint, looking from its first link."""
        return self.face_at(joint, "left"), self.face_at(joint, "right")

    def ends_of_joint(self, joint: JointId) -> tuple[int, int]:
        """Return the vertices at the two ends of a joint."""
        link = self.joints[joint][0]
        side = self._rotation[link].index(joint)
        return self._vertices[link][side - 1], self._vertices[link][side]

    def loop_of_face(self, face: int) -> Loop | None:
        """Return the loop that carries the centre of a face, if one was given for it."""
        index = self.face_loops[face]
        return None if index is None else (*self.loops, *self.closing)[index]

    def kind_of_face(self, face: int) -> FaceKind:
        """Tell what lies in a face."""
        loop = self.loop_of_face(face)
        if loop is not None and loop.has_centre:
            return FaceKind.IMPLICIT if self.faces[face].open_edges else FaceKind.EXPLICIT
        return FaceKind.OUTER if face == self.outer_face else FaceKind.SPATIAL

    @cached_property
    def counts(self) -> FeatureCounts:
        """V, C, E_ext and E_int, by the counting rules of thesis 3.4.3."""
        degrees = [len(sides) for sides in self._rotation.values()]
        open_edges = sum(degrees) - 2 * len(self.joints)
        kinds = [self.kind_of_face(face.index) for face in self.faces]
        return FeatureCounts(
            vertices=self._vertex_count,
            implicit_centres=kinds.count(FaceKind.IMPLICIT),
            external_edges=len(self.joints) + open_edges,
            internal_edges=sum(2 * n - 6 for n in degrees if n >= 4),
            open_edges=open_edges,
            faces=len(self.faces),
        )

    # ---- new graphs from this one -------------------------------------------------------------------

    def sc_graph(self) -> SCGraph:
        """Forget the rotations."""
        return SCGraph(self.nodes, self.joints, self.loops, closing=self.closing, ground=self.ground)

    def with_loops(self, loops: Iterable[Loop], closing: Iterable[Loop] = ()) -> SCDGraph:
        """Return the SCD graph with the same drawing and other loops."""
        return SCDGraph(
            self.nodes,
            self.joints,
            loops,
            rotation=self._rotation,
            outer=self.outer,
            closing=closing,
            ground=self.ground,
        )

    def relabel(
        self,
        links: Mapping[Any, LinkId] | None = None,
        joints: Mapping[Any, JointId] | None = None,
    ) -> SCDGraph:
        """Return the same mechanism under other names; what a mapping leaves out keeps its name."""
        bare = super().relabel(links, joints)
        of_link, of_joint = dict(links or {}), dict(joints or {})
        return SCDGraph(
            bare.nodes,
            bare.joints,
            bare.loops,
            rotation={
                of_link.get(link, link): [None if s is None else of_joint.get(s, s) for s in sides]
                for link, sides in self._rotation.items()
            },
            outer=None if self.outer is None else (of_joint.get(self.outer[0], self.outer[0]), self.outer[1]),
            closing=bare.closing,
            ground=bare.ground,
        )

    def _identity(self) -> tuple[Any, ...]:
        around = {link: _least_turn(sides) for link, sides in self._rotation.items()}
        boundary = frozenset(self.faces[self.outer_face].joints)
        return (*super()._identity(), around, boundary)


def _least_turn(sides: Sequence[Side]) -> tuple[str, ...]:
    """Return a cyclic sequence as text, turned so that it compares equal however it was started."""
    texts = [repr(side) for side in sides]
    return min(tuple(texts[i:] + texts[:i]) for i in range(len(texts)))
