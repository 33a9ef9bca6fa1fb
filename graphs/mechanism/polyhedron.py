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
from graphs.input_limits import check_extent
from graphs.mechanism.attributes import BuiltWhole

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


class PolyhedronModel(BuiltWhole, nx.Graph):
    """Vertices and rods of a mechanism, with remote centres, point constraints, scissors and a ground link.

    Nodes are vertices, edges are rods. The graph is frozen once built. Its terms stand in attributes, where they
    survive what networkx makes of the graph: of nodes ``number`` and ``coordinates``, of the graph ``polyhedron``,
    which refers to vertices by their numbers. So a renamed graph or a copy, which are a plain ``nx.Graph``,
    is read back right by ``PolyhedronModel(graph)`` and by every function that takes a mechanism.

    Parameters
    ----------
    vertices : int, iterable of vertex ids, or networkx.Graph
        A graph of networkx has the rods, and the terms in its attributes if it was made of a model.
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
        vertices: int | Iterable[VertexId] | nx.Graph,
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
        if isinstance(vertices, nx.Graph):
            if tuple(rods) or any((coordinates, centres, on_line, on_plane, scissors, ground, links, outer)):
                raise InvariantError("polyhedron", "terms beside a graph that has its own", "a graph alone")
            self.__init__(**_read(vertices))  # type: ignore[misc]
            return
        super().__init__()
        self._coordinates: dict[VertexId, tuple[float, float, float]] = {}
        self._links: dict[Hashable, tuple[VertexId, ...]] = {}
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
        self._write_attributes()
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

    def _write_attributes(self) -> None:
        """Write the terms where networkx keeps them, with the numbers of vertices in the place of their names."""
        number = {vertex: place for place, vertex in enumerate(self.nodes)}

        def numbers(vertices: Iterable[VertexId]) -> tuple[int, ...]:
            return tuple(number[vertex] for vertex in vertices)

        def constraints(listed: Iterable[PointConstraint]) -> tuple[tuple[int, object], ...]:
            return tuple((number[one.vertex], one.of if isinstance(one.of, str) else numbers(one.of)) for one in listed)

        for vertex, place in number.items():
            self.nodes[vertex]["number"] = place
            if self._coordinates:
                self.nodes[vertex]["coordinates"] = self._coordinates[vertex]
        self.graph["polyhedron"] = {
            "vertices": len(self),
            "rods": self.number_of_edges(),
            "centres": tuple(
                (one.k, tuple(map(numbers, one.rods)), one.name, one.at, one.infinite) for one in self.centres
            ),
            "on_line": constraints(self.on_line),
            "on_plane": constraints(self.on_plane),
            "scissors": tuple(map(numbers, self.scissors)),
            "ground": None if self.ground is None else tuple(sorted(numbers(self.ground))),
            "links": tuple((link, numbers(around)) for link, around in self._links.items()),
            "outer": None if self.outer is None else numbers(self.outer),
        }

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


def _read(graph: nx.Graph) -> dict[str, Any]:
    """Return the arguments of the model that a graph of networkx carries; without terms its vertices and rods."""
    if graph.is_multigraph() and graph.number_of_edges() > nx.Graph(graph).number_of_edges():
        raise InvariantError("distinct rods", "the graph has parallel edges", "a rod between two vertices")
    terms = graph.graph.get("polyhedron", {})
    nodes = list(graph.nodes(data=True))
    sizes = len(nodes), nx.Graph(graph).number_of_edges()
    vertex = {data.get("number"): node for node, data in nodes}
    if terms and ((terms["vertices"], terms["rods"]) != sizes or set(vertex) != set(range(len(nodes)))):
        raise InvariantError(
            "polyhedron",
            f"the graph has {sizes[0]} vertices and {sizes[1]} rods, and terms of a model with "
            f"{terms['vertices']} and {terms['rods']}",
            "all of the model; for a part of it try PolyhedronModel(graph.nodes, graph.edges)",
        )

    def named(numbers: Iterable[int]) -> tuple[VertexId, ...]:
        return tuple(vertex[number] for number in numbers)

    def constraints(listed: Iterable[tuple[int, Any]]) -> list[PointConstraint]:
        return [PointConstraint(vertex[one], of if isinstance(of, str) else named(of)) for one, of in listed]

    def centre(k: int, rods: Iterable[tuple[int, int]], *rest: Any) -> RemoteCentre:
        return RemoteCentre(k, tuple((vertex[a], vertex[b]) for a, b in rods), *rest)

    order = named(range(len(nodes))) if terms else tuple(graph.nodes)
    places = {node: data["coordinates"] for node, data in nodes if "coordinates" in data}
    ground, outer = terms.get("ground"), terms.get("outer")
    return {
        "vertices": order,
        "rods": [(a, b) for a, b in nx.Graph(graph).edges],
        "coordinates": places,
        "centres": [centre(*one) for one in terms.get("centres", ())],
        "on_line": constraints(terms.get("on_line", ())),
        "on_plane": constraints(terms.get("on_plane", ())),
        "scissors": map(named, terms.get("scissors", ())),
        "ground": None if ground is None else named(ground),
        "links": {link: named(around) for link, around in terms.get("links", ())},
        "outer": None if outer is None else named(outer),
    }
