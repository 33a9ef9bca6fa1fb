"""The SCD graph: an SC graph with the cyclic order of the sides of every link.

The order of joints and open edges round each link draws the graph on the sphere and so fixes the polyhedron
model: which vertices there are and which link has which. Source: Wiener 2016, section 3.4.
Theory: docs/theory/scd-graphs.md.

A valid SCD graph obeys rules for its drawing and its centre classes. *Points* are the vertices of the links and
the centres of the classes, identified where they coincide: an explicit centre is its vertex. In the order in which
they are checked:

===================  ====================================================================================
rule                 what must hold
===================  ====================================================================================
link degree          every link has three sides or more
explicit centre      the centre of a face without open edges is finite
implicit centre      a face with a centre and open edges has one in every corner between joints of its loop
spatial face         a bounded face without a centre has at least three open edges, in at least three corners
outer face           so has the outer face (trees need only the three open edges)
one explicit centre  a class of loops has at most one explicit centre
joint ends           the two ends of a joint are different vertices
link corners         the corners of a link are different vertices
S1                   two joints share at most one point
S2                   two links without a joint between them share at most one point; two joined links share
                     only points of that joint's axis
===================  ====================================================================================

Rule S3 (the rank under the forced geometry equals the count) is not a matter of counting and is not checked
here.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from typing import Any, TypeVar

import networkx as nx

from graphs.errors import InvariantError, numbered, shown
from graphs.loops.classes import CentreClass
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.attributes import parts_of
from graphs.mechanism.drawing import Drawing, Face, FaceKind, Side
from graphs.mechanism.sc import SCGraph, SpecialGeometry
from graphs.types import JointId, LinkId

K = TypeVar("K", bound=Hashable)


def check_rules(drawing: Drawing, classes: Sequence[CentreClass]) -> None:
    """Refuse a drawing that breaks a rule of the table above; link degree is checked when it is made.

    The classes are those of the loops of the drawing. ``rule`` of the `InvariantError` is the first column.
    """
    for face in drawing.faces:
        _check_face(drawing, face)
    centres = _centre_points(drawing, classes)
    _check_own_vertices(drawing)
    joints = _with_centres({j: drawing.ends_of_joint(j) for j in drawing.joints}, classes, centres)
    _check_s1(joints)
    _check_s2(drawing, joints, points_of_links(drawing, classes))


def points_of_joints(drawing: Drawing, classes: Sequence[CentreClass]) -> dict[JointId, frozenset[int]]:
    """Return the points on the axis of each joint: its two ends and the centres of the classes it passes through.

    Points below ``drawing.vertex_count`` are vertices, from there on the centres that are no vertices. Raises
    `InvariantError` if a class has two explicit centres.
    """
    ends = {joint: drawing.ends_of_joint(joint) for joint in drawing.joints}
    return _with_centres(ends, classes, _centre_points(drawing, classes))


def points_of_links(drawing: Drawing, classes: Sequence[CentreClass]) -> dict[LinkId, frozenset[int]]:
    """Return the points of each link: its vertices and the centres on the axes of its joints."""
    points = {link: set(here) for link, here in drawing.vertices.items()}
    for one, point in zip(classes, _centre_points(drawing, classes), strict=True):
        for joint in one.joints:
            for link in drawing.joints[joint]:
                points[link].add(point)
    return {link: frozenset(here) for link, here in points.items()}


def _with_centres(
    ends: Mapping[JointId, tuple[int, int]], classes: Sequence[CentreClass], centres: Sequence[int]
) -> dict[JointId, frozenset[int]]:
    points = {joint: set(here) for joint, here in ends.items()}
    for one, point in zip(classes, centres, strict=True):
        for joint in one.joints:
            points[joint].add(point)
    return {joint: frozenset(here) for joint, here in points.items()}


def _check_face(drawing: Drawing, face: Face) -> None:
    loop = drawing.loop_of_face(face.index)
    if loop is not None and loop.has_centre:
        _check_centre(face, loop)
        return
    outer = face.index == drawing.outer_face
    rule = "outer face" if outer else "spatial face"
    tree = len(drawing.faces) == 1
    if face.open_edges < 3 or (face.open_corners < 3 and not tree):
        name = "the outer face" if outer else f"the face {_around(face)}"
        corners = "" if tree else f" in {numbered(face.open_corners, 'corner')}"
        raise InvariantError(
            rule,
            f"{name} has no centre and {numbered(face.open_edges, 'open edge')}{corners}",
            "three open edges" if tree else "three, in three corners",
        )


def _check_centre(face: Face, loop: Loop) -> None:
    if not face.open_edges:
        if loop.centre is not Centre.FINITE:
            raise InvariantError(
                "explicit centre",
                f"{loop.label} has an infinite centre but no open edge, so that its links would reach it",
                "open edges in every corner",
            )
        return
    own = set(loop.joints)
    start = next(i for i, corner in enumerate(face.corners) if corner.leaving in own)
    gap, last = 0, face.corners[start].leaving
    for corner in face.corners[start + 1 :] + face.corners[: start + 1]:
        gap += corner.open_edges
        if corner.leaving in own:
            if not gap:
                raise InvariantError(
                    "implicit centre",
                    f"{loop.label} has open edges, but none between joints {shown(last)} and {shown(corner.leaving)}",
                    "one in every corner, or none at all",
                )
            gap, last = 0, corner.leaving


def _centre_points(drawing: Drawing, classes: Sequence[CentreClass]) -> tuple[int, ...]:
    """Return the point of each class of loops: the vertex of its explicit centre, or a new point."""
    face_of_loop = {loop: face for face, loop in enumerate(drawing.face_loops) if loop is not None}
    points = []
    for index, one in enumerate(classes):
        explicit = [face for loop in one.loops if not drawing.faces[face := face_of_loop[loop]].open_edges]
        if len(explicit) > 1:
            a, b = (drawing.loop_of_face(face) for face in explicit[:2])
            assert a is not None
            assert b is not None
            raise InvariantError(
                "one explicit centre",
                f"{a.label} and {b.label} have one centre, but two vertices for it",
                "an open edge in every corner of all but one of them",
            )
        if explicit:
            corner = drawing.faces[explicit[0]].corners[0]
            points.append(drawing.vertices[corner.link][corner.last_side])
        else:
            points.append(drawing.vertex_count + index)
    return tuple(points)


def _check_own_vertices(drawing: Drawing) -> None:
    for joint in drawing.joints:
        a, b = drawing.ends_of_joint(joint)
        if a == b:
            raise InvariantError(
                "joint ends", f"both ends of joint {shown(joint)} are vertex {a}", "two different vertices"
            )
    for link, vertices in drawing.vertices.items():
        if len(set(vertices)) < len(vertices):
            raise InvariantError(
                "link corners", f"two corners of link {shown(link)} are one vertex", "different vertices"
            )


def _check_s1(points: Mapping[JointId, frozenset[int]]) -> None:
    for a, b in _sharing_two(points):
        raise InvariantError(
            "S1", f"joints {shown(a)} and {shown(b)} share two points, so they are one axis", "one point at most"
        )


def _check_s2(
    drawing: Drawing, of_joint: Mapping[JointId, frozenset[int]], of_link: Mapping[LinkId, frozenset[int]]
) -> None:
    between: dict[frozenset[LinkId], list[JointId]] = {}
    for joint, ends in drawing.joints.items():
        between.setdefault(frozenset(ends), []).append(joint)
    for a, b in _sharing_two(of_link):
        common = of_link[a] & of_link[b]
        if frozenset((a, b)) not in between:
            raise InvariantError(
                "S2", f"links {shown(a)} and {shown(b)} share {len(common)} points and no joint", "one at most"
            )
        if not any(common <= of_joint[joint] for joint in between[frozenset((a, b))]):
            raise InvariantError(
                "S2",
                f"links {shown(a)} and {shown(b)} share points off the axis of their joint",
                "only points of that axis",
            )


def _sharing_two(points: Mapping[K, frozenset[int]]) -> Iterator[tuple[K, K]]:
    """Yield the pairs of joints or links that share two points or more, each once."""
    holders: dict[tuple[int, int], list[K]] = {}
    for name, here in points.items():
        for pair in combinations(sorted(here), 2):
            holders.setdefault(pair, []).append(name)
    seen: set[frozenset[K]] = set()
    for names in holders.values():
        for a, b in combinations(names, 2):
            if frozenset((a, b)) not in seen:
                seen.add(frozenset((a, b)))
                yield a, b


def _around(face: Face) -> str:
    return shown(" ".join(str(joint) for joint in face.joints[:12]))


@dataclass(frozen=True, slots=True)
class FeatureCounts:
    """Counts of the features of an SCD graph (thesis 3.4.3).

    Attributes
    ----------
    vertices, implicit_centres : int
        V = open edges + faces without open edges; C, loops (not classes) with an implicit centre.
    external_edges, internal_edges : int
        E_ext = joints + open edges; E_int, the sum of 2n - 6 over the links of n >= 4 sides.
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
    links, joints, loops, closing, ground, special
        As in :class:`graphs.mechanism.sc.SCGraph`. The graph is connected. A graph of networkx in the place of the
        links has the rotations and the outer face in attributes of its nodes, ``sides`` and ``outer``.
    rotation : mapping of link to sequence of sides
        The sides of each link counter-clockwise: joint ids, and None for an open edge.
    outer : (joint, "left" or "right"), optional
        The outer face: the one on that side of the joint, looking from its first link to its second. May be left
        out where there is one face only (trees).

    Attributes
    ----------
    drawing : Drawing
        Its faces and vertices.

    Raises
    ------
    InvariantError
        Naming the rule that is broken; the rules are listed in :mod:`graphs.mechanism.scd`.

    Examples
    --------
    Three triangles round one explicit centre:

    >>> sides = {0: (0, 2, None), 1: (1, 0, None), 2: (2, 1, None)}
    >>> fan = SCDGraph(3, [(0, 1), (1, 2), (2, 0)], [Loop((0, 1, 2))], rotation=sides, outer=(0, "right"))
    >>> fan.counts.vertices, fan.counts.edges
    (4, 6)
    """

    drawing: Drawing
    outer: tuple[JointId, str] | None

    def __init__(
        self,
        links: int | Iterable[LinkId] | nx.Graph,
        joints: Mapping[Any, tuple[LinkId, LinkId]] | Iterable[tuple[LinkId, ...]] = (),
        loops: Iterable[Loop | Sequence[LinkId]] | None = None,
        *,
        rotation: Mapping[Any, Sequence[Side]] | None = None,
        outer: tuple[JointId, str] | None = None,
        closing: Iterable[Loop] | None = None,
        ground: LinkId | None = None,
        special: SpecialGeometry | None = None,
    ) -> None:
        """Build the graph of an SC graph's parts and the sides of each link; parameters: see the class."""
        super().__init__(links, joints, loops, closing=closing, ground=ground, special=special)
        if isinstance(links, nx.Graph) and rotation is None:
            parts = parts_of(links)
            rotation, outer = parts.rotation, parts.outer
        sides = _of_each_link(self.nodes, rotation or {})
        if self.components != 1:
            raise InvariantError("connected", f"the graph has {self.components} parts", "one")
        self.drawing = Drawing(self._joints, sides, outer, self.loops, self.closing)
        self.outer = self.drawing.outer
        check_rules(self.drawing, self.centre_classes())
        for link, here in sides.items():
            self._node[link]["sides"] = here
        if self.outer is not None:
            joint, side = self.outer
            self._node[self._joints[joint][side != "left"]]["outer"] = joint

    # ---- what it is ---------------------------------------------------------------------------------

    @property
    def rotation(self) -> Mapping[LinkId, tuple[Side, ...]]:
        """Link to its sides, counter-clockwise (read-only)."""
        return self.drawing.rotation

    @property
    def faces(self) -> tuple[Face, ...]:
        """The faces of the drawing."""
        return self.drawing.faces

    @property
    def vertices(self) -> Mapping[LinkId, tuple[int, ...]]:
        """Link to its vertices, counter-clockwise; item ``i`` lies between side ``i`` and side ``i + 1``."""
        return self.drawing.vertices

    def _features(self) -> list[str]:
        return [*super()._features(), numbered(self.drawing.vertex_count, "vertex", "vertices")]

    @cached_property
    def counts(self) -> FeatureCounts:
        """V, C, E_ext and E_int, by the counting rules of Wiener 3.4.3."""
        degrees = [len(sides) for sides in self.rotation.values()]
        open_edges = sum(degrees) - 2 * len(self.joints)
        kinds = [self.drawing.kind_of_face(face.index) for face in self.faces]
        return FeatureCounts(
            vertices=self.drawing.vertex_count,
            implicit_centres=kinds.count(FaceKind.IMPLICIT),
            external_edges=len(self.joints) + open_edges,
            internal_edges=sum(2 * n - 6 for n in degrees if n >= 4),
            open_edges=open_edges,
            faces=len(self.faces),
        )

    # ---- new graphs from this one -------------------------------------------------------------------

    def sc_graph(self) -> SCGraph:
        """Return the SC graph, without the rotations."""
        return super().marked(self.special)

    def _drawn_alike(self, bare: SCGraph) -> SCDGraph:
        """Return an SC graph of the same links and joints with this drawing."""
        return SCDGraph(
            bare.nodes,
            bare.joints,
            bare.loops,
            rotation=self.rotation,
            outer=self.outer,
            closing=bare.closing,
            ground=bare.ground,
            special=bare.special,
        )

    def marked(self, special: SpecialGeometry | None) -> SCDGraph:
        """Return the same mechanism with a mark of special geometry, or without one."""
        return self._drawn_alike(super().marked(special))

    def with_loops(self, loops: Iterable[Loop], closing: Iterable[Loop] = ()) -> SCDGraph:
        """Return the SCD graph with the same drawing and other loops."""
        return self._drawn_alike(super().with_loops(loops, closing))

    def relabel(
        self, links: Mapping[Any, LinkId] | None = None, joints: Mapping[Any, JointId] | None = None
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
                for link, sides in self.rotation.items()
            },
            outer=None if self.outer is None else (of_joint.get(self.outer[0], self.outer[0]), self.outer[1]),
            closing=bare.closing,
            ground=bare.ground,
            special=bare.special,
        )

    def _identity(self) -> tuple[Any, ...]:
        around = {link: _least_turn(sides) for link, sides in self.rotation.items()}
        boundary = frozenset(self.faces[self.drawing.outer_face].joints)
        return (*super()._identity(), around, boundary)


def _of_each_link(links: Iterable[LinkId], rotation: Mapping[Any, Sequence[Side]]) -> dict[LinkId, tuple[Side, ...]]:
    """Return the rotations in the order of the links; refuse one for what is no link, and a link without one."""
    known = set(links)
    for link in rotation:
        if link not in known:
            raise InvariantError("rotation", f"there is a rotation for {shown(link)}, which is no link")
    for link in links:
        if link not in rotation:
            raise InvariantError("rotation", f"link {shown(link)} has no rotation", "one for each link")
    return {link: tuple(rotation[link]) for link in links}


def _least_turn(sides: Sequence[Side]) -> tuple[str, ...]:
    """Return a cyclic sequence as text, turned so that it compares equal however it was started."""
    texts = [repr(side) for side in sides]
    return min(tuple(texts[i:] + texts[:i]) for i in range(len(texts)))
