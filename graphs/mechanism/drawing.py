"""The drawing of a link-joint graph on the sphere: faces, vertices of the links, which loop is which face.

Links are drawn by their rotations (`graphs.mechanism.rotation`); one face is the outer one. Source: Wiener 2016,
section 3.4. Theory: docs/theory/scd-graphs.md.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from enum import Enum
from functools import cached_property
from types import MappingProxyType

from graphs.errors import InvariantError, shown
from graphs.ids import JointId, Joints, LinkId
from graphs.loops.loop import Loop
from graphs.mechanism.rotation import (
    Face,
    Rotation,
    Side,
    check_rotation,
    check_sides,
    face_cycles,
    link_vertices,
    trace_faces,
)

__all__ = ["Drawing", "FaceKind"]


class FaceKind(Enum):
    """What lies in a face of a drawing.

    Attributes
    ----------
    EXPLICIT
        A centre that is a vertex of the links themselves.
    IMPLICIT
        A remote centre: the axes meet there, the links do not reach it.
    SPATIAL
        No centre.
    OUTER
        The rest of the sphere; without a centre.

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> fan = scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 1)])
    >>> sorted(fan.drawing.kind_of_face(face.index).name for face in fan.faces)
    ['EXPLICIT', 'OUTER']
    """

    EXPLICIT = "explicit"
    IMPLICIT = "implicit"
    SPATIAL = "spatial"
    OUTER = "outer"


class Drawing:
    """A connected link-joint graph on the sphere, with an outer face.

    Parameters
    ----------
    joints : mapping of joint id to (link, link)
    rotation : mapping of link to its sides
        Counter-clockwise: joint ids, and None for an open edge.
    outer : (joint, "left" or "right"), optional
        The outer face: the one on that side of the joint, looking from its first link to its second. May be left
        out where there is one face only (trees).
    loops : sequence of Loop, optional
        Independent loops; they belong to bounded faces.
    closing : sequence of Loop, optional
        Loops that depend on them; one belongs to the outer face.

    Attributes
    ----------
    faces : tuple of Face
    vertex_count : int
        V = open edges + faces without open edges.
    outer : (joint, side) or None
        As given.
    outer_face : int
        Index of the outer face.
    loops : tuple of Loop
        Independent ones, then closing ones.
    face_loops : tuple of int or None
        For each face the index of its loop in ``loops``.

    Raises
    ------
    InvariantError
        Rules "rotation", "link degree", "genus 0", "outer face", "loops are faces".

    Examples
    --------
    >>> triangle = {"a": (0, 1), "b": (1, 2), "c": (2, 0)}
    >>> sides = {0: ("a", "c", None), 1: ("b", "a", None), 2: ("c", "b", None)}
    >>> drawing = Drawing(triangle, sides, ("a", "right"))
    >>> drawing.vertices[0], drawing.ends_of_joint("a"), drawing.kind_of_face(drawing.outer_face)
    ((0, 2, 1), (1, 0), <FaceKind.OUTER: 'outer'>)
    """

    def __init__(
        self,
        joints: Joints,
        rotation: Rotation,
        outer: tuple[JointId, str] | None = None,
        loops: Sequence[Loop] = (),
        closing: Sequence[Loop] = (),
    ) -> None:
        check_rotation(joints, rotation)
        check_sides(rotation)
        self.joints = joints
        self._rotation = dict(rotation)
        self.faces, self._left_of = trace_faces(joints, rotation)
        surplus = 2 - (len(rotation) - len(joints) + len(self.faces))
        if surplus:
            raise InvariantError(
                "genus 0", f"the rotations draw the graph on a surface of genus {surplus // 2}", "a sphere"
            )
        self.vertex_count, self._vertices = link_vertices(self.faces, rotation)
        self.outer = outer
        self.outer_face = self._face_named(outer)
        self.loops = (*loops, *closing)
        self.face_loops = self._match_loops(len(loops))

    def _face_named(self, outer: tuple[JointId, str] | None) -> int:
        if outer is None:
            if len(self.faces) > 1:
                raise InvariantError("outer face", f"there are {len(self.faces)} faces and none is the outer one")
            return 0
        joint, side = outer
        if joint not in self.joints or side not in ("left", "right"):
            raise InvariantError(
                "outer face", f"the outer face is given as {shown(outer)}", "a joint and 'left' or 'right'"
            )
        return self.face_at(joint, side)

    def _match_loops(self, independent: int) -> tuple[int | None, ...]:
        """Find the loop of each face; the first so many loops are independent."""
        bounded: dict[frozenset[JointId], int] = {}
        outer: dict[frozenset[JointId], int] = {}
        for index, loop in enumerate(self.loops):
            (bounded if index < independent else outer)[frozenset(loop.joints)] = index
        matched = tuple(
            (outer if face.index == self.outer_face else bounded).get(frozenset(self._own_cycle(face)))
            for face in self.faces
        )
        for index in sorted(set(range(len(self.loops))) - set(matched)):
            which = "a bounded face" if index < independent else "the outer face"
            raise InvariantError("loops are faces", f"{self.loops[index].label} is not the outer cycle of {which}")
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
        return None if index is None else self.loops[index]

    def kind_of_face(self, face: int) -> FaceKind:
        """Tell what lies in a face."""
        loop = self.loop_of_face(face)
        if loop is not None and loop.has_centre:
            return FaceKind.IMPLICIT if self.faces[face].open_edges else FaceKind.EXPLICIT
        return FaceKind.OUTER if face == self.outer_face else FaceKind.SPATIAL
