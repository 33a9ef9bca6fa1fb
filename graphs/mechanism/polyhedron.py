"""The polyhedron model: vertices and rods, with the terms of Wampler, Larson and Erdman.

A body is a polyhedron of V vertices and 3V - 6 rods; joints are shared vertices. Source: Wampler, Larson,
Erdman 2007, Eqs. 5 to 10; Wiener 2016, section 2.3.3. Theory: docs/theory/polyhedron-model.md.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite
from types import MappingProxyType
from typing import Any

import networkx as nx

from graphs.errors import InvariantError, numbered, shown
from graphs.limits import check_extent

VertexId = Hashable
Rod = tuple[VertexId, VertexId]

GROUND = "ground"
"""Stands for the ground link where a line or a plane is fixed in it."""


@dataclass(frozen=True, slots=True)
class RemoteCentre:
    """A remote centre S_{+k}: closing the loop costs k fewer freedoms than its rods count (Wampler Eqs. 7, 8).

    Parameters
    ----------
    k : int
        3 for a loop of revolute joints, 4 for a loop of scissors, 1 where two centres are aligned; any k >= 0.
    rods : tuple of (vertex, vertex), optional
        The rods whose lines pass through the centre.
    name : str, optional
        Of the loop.
    at : str, optional
        Of the centre, where loops share it although nothing forces them to.
    infinite : bool, optional
        Whether the centre is at infinity: the lines are parallel.

    Examples
    --------
    >>> PolyhedronModel(4, [(0, 1), (2, 3)], centres=[RemoteCentre(3)])
    <PolyhedronModel: 4 vertices, 2 rods, 1 remote centre>
    """

    k: int
    rods: tuple[Rod, ...] = ()
    name: str | None = None
    at: str | None = None
    infinite: bool = False


@dataclass(frozen=True, slots=True)
class PointConstraint:
    """A vertex on a line (two vertices) or in a plane (three vertices) of the model, or of the ground link.

    Parameters
    ----------
    vertex : vertex id
    of : tuple of vertex ids, or "ground"
        The vertices that span the line or plane.

    Examples
    --------
    >>> PolyhedronModel(4, [(0, 1), (2, 3)], on_line=[PointConstraint(0, (2, 3))]).on_line
    (PointConstraint(vertex=0, of=(2, 3)),)
    """

    vertex: VertexId
    of: tuple[VertexId, ...] | str


class PolyhedronModel(nx.Graph):
    """Vertices and rods of a mechanism, with remote centres, point constraints, scissors and a ground link.

    Nodes are vertices, edges are rods. The graph is frozen once built.

    Parameters
    ----------
    vertices : int or iterable of vertex ids, optional
    rods : iterable of (vertex, vertex), optional
    coordinates : mapping of vertex to (x, y, z), optional
        For all vertices or for none; any length unit.
    centres : iterable of RemoteCentre, optional
        Wampler's S_{+k}.
    on_line, on_plane : iterable of PointConstraint, optional
        Wampler's L and P.
    scissors : iterable of 4-tuples of vertices, optional
        Wampler's X: the exposed vertices of each scissors element.
    ground : iterable of vertex ids, optional
        The vertices of the ground link, which is left out of the count, even if it has none (Eq. 10); if None, all
        bodies are free and six freedoms are taken off (Eq. 9).
    links : mapping of link to its vertices in cyclic order, optional
        Which vertices make up which link, where that is known.
    outer : tuple of vertex ids, optional
        The outer face of the SCD graph, where its open edges do not show it: the ends of one of them, or the vertex
        that it is.

    Raises
    ------
    InvariantError
        With the invariant and what breaks it.

    Examples
    --------
    >>> PolyhedronModel(4, [(0, 1), (1, 2), (2, 0), (1, 3), (2, 3)])  # two triangles hinged along a rod
    <PolyhedronModel: 4 vertices, 5 rods>
    """

    centres: tuple[RemoteCentre, ...]
    on_line: tuple[PointConstraint, ...]
    on_plane: tuple[PointConstraint, ...]
    scissors: tuple[tuple[VertexId, ...], ...]
    ground: frozenset[VertexId] | None
    outer: tuple[VertexId, ...] | None

    def __init__(
        self,
        vertices: int | Iterable[VertexId] | None = None,
        rods: Iterable[Rod] = (),
        *,
        coordinates: Mapping[Any, Sequence[float]] | None = None,
        centres: Iterable[RemoteCentre] = (),
        on_line: Iterable[PointConstraint] = (),
        on_plane: Iterable[PointConstraint] = (),
        scissors: Iterable[Sequence[VertexId]] = (),
        ground: Iterable[VertexId] | None = None,
        links: Mapping[Any, Sequence[VertexId]] | None = None,
        outer: Sequence[VertexId] | None = None,
    ) -> None:
        super().__init__()
        self.centres, self.on_line, self.on_plane, self.scissors, self.ground = (), (), (), (), None
        self.outer = None
        self._coordinates: dict[VertexId, tuple[float, float, float]] = {}
        self._links: dict[Hashable, tuple[VertexId, ...]] = {}
        if vertices is None:
            return  # networkx makes an empty instance of the class before it fills a view
        self._add_vertices(range(vertices) if isinstance(vertices, int) else vertices)
        self._add_rods(rods)
        self._set_coordinates(coordinates or {})
        self.ground = None if ground is None else frozenset(self._known(ground, "ground"))
        self.centres = tuple(self._checked_centre(centre) for centre in centres)
        self.on_line = tuple(self._checked_constraint(c, 2, "on_line") for c in on_line)
        self.on_plane = tuple(self._checked_constraint(c, 3, "on_plane") for c in on_plane)
        self.scissors = tuple(self._checked_scissors(four) for four in scissors)
        for link, around in (links or {}).items():
            self._links[link] = self._checked_link(link, around)
        self.outer = None if outer is None else self._checked_outer(outer)
        nx.freeze(self)

    def __repr__(self) -> str:
        parts = [numbered(len(self), "vertex", "vertices"), numbered(self.number_of_edges(), "rod")]
        parts += [numbered(len(self.centres), "remote centre")] * bool(self.centres)
        return f"<PolyhedronModel: {', '.join(parts)}>"

    # ---- construction -------------------------------------------------------------------------------

    def _add_vertices(self, vertices: Iterable[VertexId]) -> None:
        texts: set[str] = set()
        for vertex in vertices:
            if vertex is None or str(vertex) in texts or vertex == GROUND:
                raise InvariantError(
                    "distinct vertices", f"vertex {shown(vertex)} occurs twice, has no name or is called {GROUND!r}"
                )
            texts.add(str(vertex))
            self.add_node(vertex)

    def _add_rods(self, rods: Iterable[Rod]) -> None:
        for a, b in rods:
            self._known((a, b), f"rod {shown((a, b))}")
            if a == b:
                raise InvariantError("no self-rod", f"a rod joins vertex {shown(a)} to itself", "two vertices")
            if self.has_edge(a, b):
                raise InvariantError("distinct rods", f"rod {shown((a, b))} occurs twice", "once")
            self.add_edge(a, b)

    def _set_coordinates(self, coordinates: Mapping[Any, Sequence[float]]) -> None:
        if coordinates and set(coordinates) != set(self.nodes):
            odd = next(iter(set(coordinates) ^ set(self.nodes)))
            wrong = f"vertex {shown(odd)} has none" if odd in self else f"{shown(odd)} is no vertex"
            raise InvariantError("coordinates", f"coordinates: {wrong}", "coordinates for all vertices")
        for vertex, place in coordinates.items():
            if len(place) != 3 or not all(isfinite(x) for x in place):
                raise InvariantError(
                    "coordinates", f"vertex {shown(vertex)} is at {shown(place)}", "three finite numbers"
                )
            self._coordinates[vertex] = (float(place[0]), float(place[1]), float(place[2]))
        check_extent([*self._coordinates.values()])

    def _known(self, vertices: Iterable[VertexId], who: str) -> tuple[VertexId, ...]:
        listed = tuple(vertices)
        for vertex in listed:
            if vertex not in self:
                raise InvariantError("known vertices", f"{who} names {shown(vertex)}, which is no vertex")
        return listed

    def _checked_centre(self, centre: RemoteCentre) -> RemoteCentre:
        if isinstance(centre.k, bool) or not isinstance(centre.k, int) or centre.k < 0:
            raise InvariantError("remote centre", f"a centre has k = {shown(centre.k)}", "an integer k >= 0")
        for a, b in centre.rods:
            if not self.has_edge(a, b):
                raise InvariantError("remote centre", f"a centre names {shown((a, b))}, which is no rod")
        return centre

    def _checked_constraint(self, one: PointConstraint, size: int, who: str) -> PointConstraint:
        self._known((one.vertex,), who)
        if one.of == GROUND:
            if self.ground is None:
                raise InvariantError(
                    "point constraint", f"{who} of vertex {shown(one.vertex)} needs the ground link", "'ground'"
                )
            return one
        spanning = self._known(one.of, who)
        if len(set(spanning)) != size or one.vertex in spanning:
            raise InvariantError(
                "point constraint",
                f"{who} of vertex {shown(one.vertex)} is spanned by {shown(list(spanning))}",
                f"{size} other vertices",
            )
        return one

    def _checked_scissors(self, four: Sequence[VertexId]) -> tuple[VertexId, ...]:
        vertices = self._known(four, "scissors")
        if len(set(vertices)) != 4 or len(vertices) != 4:
            raise InvariantError("scissors", f"a scissors element has {len(set(vertices))} exposed vertices", "four")
        return vertices

    def _checked_link(self, link: Hashable, around: Sequence[VertexId]) -> tuple[VertexId, ...]:
        vertices = self._known(around, f"link {shown(link)}")
        if len(set(vertices)) != len(vertices):
            raise InvariantError("links", f"link {shown(link)} names a vertex twice", "once")
        return vertices

    def _checked_outer(self, outer: Sequence[VertexId]) -> tuple[VertexId, ...]:
        vertices = self._known(outer, "the outer face")
        if not 1 <= len(set(vertices)) == len(vertices) <= 2:
            raise InvariantError(
                "outer face", f"the outer face is {shown(list(vertices))}", "the ends of an open edge, or a vertex"
            )
        return vertices

    # ---- what networkx asks for ---------------------------------------------------------------------

    def copy(self, as_view: bool = False) -> nx.Graph:
        """Return a plain, mutable ``nx.Graph`` with the same vertices and rods, or with ``as_view`` a view."""
        return super().copy(as_view=True) if as_view else nx.Graph(self)

    def to_undirected_class(self) -> Any:
        """Return the class of undirected copies: a plain graph."""
        return nx.Graph

    def to_directed_class(self) -> Any:
        """Return the class of directed copies."""
        return nx.DiGraph

    # ---- what it is ---------------------------------------------------------------------------------

    @property
    def coordinates(self) -> Mapping[VertexId, tuple[float, float, float]]:
        """Vertex to its place, or empty where the model has none (read-only)."""
        return MappingProxyType(self._coordinates)

    @property
    def links(self) -> Mapping[Hashable, tuple[VertexId, ...]]:
        """Link to its vertices in cyclic order, or empty where that is not known (read-only)."""
        return MappingProxyType(self._links)

    @property
    def free_vertices(self) -> int:
        """V: vertices that are counted, all of them or all but those of the ground link."""
        return len(self) - len(self.ground or ())

    @property
    def counted_rods(self) -> int:
        """E: rods that are counted, all of them or all but those within the ground link."""
        ground = self.ground or frozenset()
        return sum(not (a in ground and b in ground) for a, b in self.edges)

    def relabel(self, vertices: Mapping[VertexId, VertexId]) -> PolyhedronModel:
        """Return the same model with other vertex names; what the mapping leaves out keeps its name."""

        def named(vertex: VertexId) -> VertexId:
            return vertices.get(vertex, vertex)

        def moved(one: PointConstraint) -> PointConstraint:
            of = one.of if isinstance(one.of, str) else tuple(map(named, one.of))
            return PointConstraint(named(one.vertex), of)

        return PolyhedronModel(
            map(named, self.nodes),
            [(named(a), named(b)) for a, b in self.edges],
            coordinates={named(v): place for v, place in self._coordinates.items()},
            centres=[replace(c, rods=tuple((named(a), named(b)) for a, b in c.rods)) for c in self.centres],
            on_line=map(moved, self.on_line),
            on_plane=map(moved, self.on_plane),
            scissors=[tuple(map(named, four)) for four in self.scissors],
            ground=None if self.ground is None else map(named, self.ground),
            links={link: tuple(map(named, around)) for link, around in self._links.items()},
            outer=None if self.outer is None else tuple(map(named, self.outer)),
        )

    def is_identical(self, other: object) -> bool:
        """Return whether two models are the same, ids and all (this is not isomorphism)."""
        return isinstance(other, PolyhedronModel) and self._identity() == other._identity()

    def _identity(self) -> tuple[Any, ...]:
        rods = {frozenset(rod) for rod in self.edges}
        centres = sorted(
            (c.k, str(c.name), str(c.at), c.infinite, sorted(sorted(map(str, rod)) for rod in c.rods))
            for c in self.centres
        )
        constraints = (set(self.on_line), set(self.on_plane), set(self.scissors))
        outer = None if self.outer is None else frozenset(self.outer)
        return set(self.nodes), rods, centres, constraints, self.ground, self._coordinates, self._links, outer

    def __str__(self) -> str:
        return f"PolyhedronModel with {len(self)} vertices and {self.number_of_edges()} rods"
