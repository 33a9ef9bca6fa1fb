"""Drawings of link-joint graphs on the sphere: faces, corners, vertices of the links, which loop is which face.

The *rotation* of a link is the cyclic order, counter-clockwise, of its sides: joints and *open edges* (None). The
faces of the drawing, its corners and the vertices of the links follow (Wiener 2016, sections 3.4 and 3.4.3); one
face is the outer one. Theory: docs/theory/scd-graphs.md.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property
from types import MappingProxyType

from graphs.errors import InvariantError, numbered, shown
from graphs.loops.loop import Loop
from graphs.types import JointId, Joints, LinkId

Side = JointId | None
"""A side of a link: the id of the joint on it, or None for an open edge."""

Rotation = Mapping[LinkId, tuple[Side, ...]]


@dataclass(frozen=True, slots=True)
class Corner:
    """The part of a link between two successive joints of its rotation; it lies in one face.

    A walk round the face enters by the joint ``arriving`` and leaves by ``leaving`` (None on a link without
    joints), ``open_edges`` lie between them. ``first_side`` and ``last_side`` are the indices in the rotation of
    the entering and the leaving joint (of the first open edge, without joints).
    """

    link: LinkId
    arriving: JointId | None
    leaving: JointId | None
    open_edges: int
    first_side: int
    last_side: int


@dataclass(frozen=True, slots=True)
class Face:
    """A face of the drawing, walked round with the face on the left (a bounded face counter-clockwise).

    Attributes
    ----------
    index : int
        Its place in the list of faces.
    corners : tuple of Corner
        In the order of the walk.
    open_edges : int
        Of all its corners.

    Examples
    --------
    >>> Face(0, (Corner("plate", None, None, 3, 0, 0),)).open_edges
    3
    """

    index: int
    corners: tuple[Corner, ...]
    open_edges: int = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "open_edges", sum(corner.open_edges for corner in self.corners))

    @property
    def joints(self) -> tuple[JointId, ...]:
        """The joints crossed, in order; a joint with this face on both its sides occurs twice."""
        return tuple(corner.leaving for corner in self.corners if corner.leaving is not None)

    @property
    def open_corners(self) -> int:
        """Number of corners with an open edge."""
        return sum(corner.open_edges > 0 for corner in self.corners)


def check_rotation(joints: Joints, rotation: Rotation) -> None:
    """Raise `InvariantError` for a rotation that does not hold each joint once at each of its two links."""
    expected: dict[LinkId, list[JointId]] = {link: [] for link in rotation}
    for joint, ends in joints.items():
        for link in ends:
            if link not in expected:
                raise InvariantError("rotation", f"link {shown(link)} has no rotation", "one for each link")
            expected[link].append(joint)
    for link, sides in rotation.items():
        here = [side for side in sides if side is not None]
        if len(set(here)) != len(here) or set(here) != set(expected[link]):
            raise InvariantError(
                "rotation",
                f"the rotation of link {shown(link)} has the joints {shown(here)}",
                f"each of {shown(expected[link])} once",
            )


def check_sides(rotation: Rotation) -> None:
    """Refuse a link of fewer than three sides."""
    for link, sides in rotation.items():
        if len(sides) < 3:
            raise InvariantError(
                "link degree",
                f"link {shown(link)} has {numbered(len(sides), 'side')}",
                "three or more, open edges included",
            )


def trace_faces(joints: Joints, rotation: Rotation) -> tuple[tuple[Face, ...], dict[tuple[JointId, LinkId], int]]:
    """Return the faces, and for each dart (joint, link it leaves) the index of the face on its left.

    A rotation is the sides of each link, counter-clockwise.
    """
    place = {(link, side): i for link, sides in rotation.items() for i, side in enumerate(sides) if side is not None}
    leaving = {
        (link, side): _next_joint(sides, i)
        for link, sides in rotation.items()
        for i, side in enumerate(sides)
        if side is not None
    }
    faces: list[Face] = []
    left_of: dict[tuple[JointId, LinkId], int] = {}
    for joint, ends in joints.items():
        for start in ends:
            if (joint, start) in left_of:
                continue
            corners, dart = [], (joint, start)
            while dart not in left_of:
                left_of[dart] = len(faces)
                arriving, here = dart[0], _other(joints[dart[0]], dart[1])
                departing, gap = leaving[here, arriving]
                corners.append(Corner(here, arriving, departing, gap, place[here, arriving], place[here, departing]))
                dart = (departing, here)
            faces.append(Face(len(faces), tuple(corners)))
    for link, sides in rotation.items():
        if all(side is None for side in sides):  # a link by itself has one face all round
            faces.append(Face(len(faces), (Corner(link, None, None, len(sides), 0, 0),)))
    return tuple(faces), left_of


def link_vertices(faces: Sequence[Face], rotation: Rotation) -> tuple[int, dict[LinkId, tuple[int, ...]]]:
    """Number the vertices: round each face, every run between successive open edges is one vertex.

    They are as many as open edges and faces without any. Item ``i`` of a link lies between its sides ``i``, ``i +
    1``.
    """
    at = {link: [-1] * len(sides) for link, sides in rotation.items()}
    count = 0
    for face in faces:
        vertex, first = count, count
        count += max(face.open_edges, 1)
        for corner in face.corners:
            # The face is on the left, so the corner is passed clockwise: from its last gap to its first.
            gaps = at[corner.link]
            for step in range(corner.open_edges + 1):
                gaps[(corner.first_side - 1 - step) % len(gaps)] = vertex
                if step < corner.open_edges:
                    vertex = first + (vertex - first + 1) % face.open_edges
    return count, {link: tuple(row) for link, row in at.items()}


def face_cycles(face: Face) -> list[tuple[JointId, ...]]:
    """Split the boundary of a face into its cycles, each a tuple of joints in walking order.

    A face of a 2-connected graph has one. There are more where a sub-mechanism hangs inside the face (thesis
    3.4.2) and none on the face of a tree; joints with the face on both their sides belong to no cycle.
    """
    cycles: list[tuple[JointId, ...]] = []
    path: list[tuple[LinkId, JointId]] = []  # links entered and not yet closed off, and the joint crossed
    position: dict[LinkId, int] = {}
    for corner in face.corners:
        if corner.leaving is None:
            break
        if corner.link in position:  # a closed part of the walk ends here
            start = position[corner.link]
            _close(path, start, position, cycles)
        position[corner.link] = len(path)
        path.append((corner.link, corner.leaving))
    if path:
        _close(path, 0, position, cycles)
    return cycles


def _close(
    path: list[tuple[LinkId, JointId]], start: int, position: dict[LinkId, int], cycles: list[tuple[JointId, ...]]
) -> None:
    """Cut the closed part of a walk off its end; keep it unless it goes to and fro over one joint."""
    part = path[start:]
    del path[start:]
    for link, _ in part:
        position.pop(link, None)
    around = tuple(joint for _, joint in part)
    if len(set(around)) > 1:
        first = around.index(min(around, key=str))
        cycles.append(around[first:] + around[:first])


def _other(ends: tuple[LinkId, LinkId], link: LinkId) -> LinkId:
    return ends[1] if ends[0] == link else ends[0]


def _next_joint(sides: Sequence[Side], index: int) -> tuple[JointId, int]:
    """Return the next joint clockwise from a side, and the number of open edges passed."""
    gap = 0
    while sides[index - 1 - gap] is None:
        gap += 1
    return sides[index - 1 - gap], gap


class FaceKind(Enum):
    """What lies in a face of a drawing.

    Attributes
    ----------
    EXPLICIT, IMPLICIT
        A centre that is a vertex of the links themselves; a remote centre, which the links do not reach.
    SPATIAL, OUTER
        No centre; the rest of the sphere, without a centre.

    Examples
    --------
    >>> FaceKind("outer").name
    'OUTER'
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
        out where there is only one face (trees).
    loops, closing : sequence of Loop, optional
        Independent loops, which belong to bounded faces; loops that depend on them, of which one belongs to the
        outer face.

    Attributes
    ----------
    faces : tuple of Face
    outer_face, vertex_count : int
        Index of the outer face; V = open edges + faces without open edges.
    face_loops : tuple of int or None
        For each face the index of its loop in ``loops``, which holds the closing ones too.

    Raises
    ------
    InvariantError
        Rules "rotation", "link degree", "genus 0", "outer face", "loops are faces".

    Examples
    --------
    >>> triangle = {"a": (0, 1), "b": (1, 2), "c": (2, 0)}
    >>> sides = {0: ("a", "c", None), 1: ("b", "a", None), 2: ("c", "b", None)}
    >>> Drawing(triangle, sides, ("a", "right")).vertices[0]
    (0, 2, 1)
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
            raise InvariantError("outer face", f"the outer face is {shown(outer)}", "a joint and 'left' or 'right'")
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
        """Return the loop whose centre lies in a face, if any."""
        index = self.face_loops[face]
        return None if index is None else self.loops[index]

    def kind_of_face(self, face: int) -> FaceKind:
        """Return what lies in a face."""
        loop = self.loop_of_face(face)
        if loop is not None and loop.has_centre:
            return FaceKind.IMPLICIT if self.faces[face].open_edges else FaceKind.EXPLICIT
        return FaceKind.OUTER if face == self.outer_face else FaceKind.SPATIAL
