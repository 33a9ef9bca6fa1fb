"""The SCD graph: an SC graph with the cyclic order of the sides of every link.

The order of joints and open edges round each link draws the graph on the sphere and so fixes the polyhedron
model: which vertices there are and which link has which. Source: Wiener 2016, section 3.4.
Theory: docs/theory/scd-graphs.md. The rules a valid SCD graph obeys are in :mod:`graphs.mechanism.rules`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from graphs.errors import InvariantError, numbered, shown
from graphs.ids import JointId, LinkId
from graphs.loops.loop import Loop
from graphs.mechanism.drawing import Drawing, FaceKind
from graphs.mechanism.rotation import Face, Side
from graphs.mechanism.rules import check_rules
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.special import SpecialGeometry

__all__ = ["FeatureCounts", "SCDGraph"]


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

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> counts = scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 1)]).counts
    >>> counts.vertices, counts.external_edges, counts.internal_edges
    (4, 6, 0)
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
        As in :class:`graphs.mechanism.sc.SCGraph`. The graph is connected.
    rotation : mapping of link to sequence of sides
        The sides of each link counter-clockwise: joint ids, and None for an open edge.
    outer : (joint, "left" or "right"), optional
        The outer face: the one on that side of the joint, looking from its first link to its second. May be
        left out where there is one face only (trees).

    Attributes
    ----------
    drawing : Drawing
        Its faces and vertices.

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

    drawing: Drawing
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
        special: SpecialGeometry | None = None,
    ) -> None:
        super().__init__(links, joints, loops, closing=closing, ground=ground, special=special)
        self.outer = None
        if links is None:
            return
        sides = _of_each_link(self.nodes, rotation or {})
        if self.components != 1:
            raise InvariantError("connected", f"the graph has {self.components} parts", "one")
        self.drawing = Drawing(self._joints, sides, outer, self.loops, self.closing)
        self.outer = self.drawing.outer
        check_rules(self.drawing, self.centre_classes())

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
        """V, C, E_ext and E_int, by the counting rules of thesis 3.4.3."""
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
        """Forget the rotations."""
        return super().marked(self.special)

    def marked(self, special: SpecialGeometry | None) -> SCDGraph:
        """Return the same mechanism with a mark of special geometry, or without one."""
        return SCDGraph(
            self.nodes,
            self.joints,
            self.loops,
            rotation=self.rotation,
            outer=self.outer,
            closing=self.closing,
            ground=self.ground,
            special=special,
        )

    def with_loops(self, loops: Iterable[Loop], closing: Iterable[Loop] = ()) -> SCDGraph:
        """Return the SCD graph with the same drawing and other loops."""
        return SCDGraph(
            self.nodes,
            self.joints,
            loops,
            rotation=self.rotation,
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


def _of_each_link(
    links: Iterable[LinkId], rotation: Mapping[Any, Sequence[Side]]
) -> dict[LinkId, tuple[Side, ...]]:
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
