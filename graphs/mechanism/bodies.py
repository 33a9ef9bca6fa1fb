"""The bodies of a polyhedron model: its declared links, and the largest rigid sets of the other rods.

Three rods in a triangle are a body. In space two triangles on one rod are two bodies, a hinge; a vertex with three
rods to a body is fixed in it, and bodies that share three vertices are one, as tetrahedra on a common face are.
Source: Wampler, Larson, Erdman 2007, Figs. 2 to 5. Theory: docs/theory/polyhedron-model.md.
"""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from itertools import combinations

from graphs.mechanism.polyhedron import PolyhedronModel, VertexId

_FIXED = 3  # rods fix a vertex in a body by its three coordinates; three common vertices make two bodies one


def undeclared_rods(model: PolyhedronModel) -> list[tuple[VertexId, VertexId]]:
    """Return the rods that do not lie in a declared link."""
    inside = [frozenset(around) for around in model.links.values()]
    at: dict[VertexId, list[int]] = {}
    for number, link in enumerate(inside):
        for vertex in link:
            at.setdefault(vertex, []).append(number)
    return [(a, b) for a, b in model.edges if not any(b in inside[number] for number in at.get(a, ()))]


def rigid_sets(model: PolyhedronModel) -> list[tuple[VertexId, ...]]:
    """Return the largest rigid sets of vertices that triangles of rods make, in the order of the vertices.

    Each has a rod that lies in no declared link.

    Parameters
    ----------
    model : PolyhedronModel

    Examples
    --------
    >>> rigid_sets(PolyhedronModel(4, [(0, 1), (1, 2), (2, 0), (1, 3), (2, 3)]))  # a hinge
    [(0, 1, 2), (1, 2, 3)]
    >>> rigid_sets(PolyhedronModel(4, [(0, 1), (1, 2), (2, 0), (1, 3), (2, 3), (0, 3)]))  # a tetrahedron
    [(0, 1, 2, 3)]
    """
    place = {vertex: i for i, vertex in enumerate(model.nodes)}
    beside: dict[VertexId, set[VertexId]] = {vertex: set() for vertex in model.nodes}
    undeclared = set(map(frozenset, undeclared_rods(model)))
    for a, b in model.edges:
        beside[a].add(b)
        beside[b].add(a)
    grown: list[set[VertexId]] = []
    of_vertex: dict[VertexId, list[int]] = {vertex: [] for vertex in model.nodes}
    for triangle in _triangles(beside, place):
        if any(triangle <= grown[number] for number in of_vertex[next(iter(triangle))]):
            continue
        if not any(frozenset(rod) in undeclared for rod in combinations(triangle, 2)):
            continue
        _grow(triangle, beside)
        _absorb(triangle, grown, of_vertex, beside)
    found = {tuple(sorted(body, key=place.__getitem__)) for body in grown if body}
    return sorted(found, key=lambda body: [place[vertex] for vertex in body])


def _triangles(beside: Mapping[VertexId, set[VertexId]], place: Mapping[VertexId, int]) -> Iterable[set[VertexId]]:
    """Yield the triangles of rods, each once."""
    for a in beside:
        later = sorted((b for b in beside[a] if place[b] > place[a]), key=place.__getitem__)
        for i, b in enumerate(later):
            for c in later[i + 1 :]:
                if c in beside[b]:
                    yield {a, b, c}


def _grow(body: set[VertexId], beside: Mapping[VertexId, set[VertexId]]) -> None:
    """Add to a body, in place, every vertex that three rods fix in it."""
    waiting: list[VertexId] = list(body)
    rods: Counter[VertexId] = Counter()
    while waiting:
        for vertex in beside[waiting.pop()]:
            rods[vertex] += 1
            if rods[vertex] == _FIXED and vertex not in body:
                body.add(vertex)
                waiting.append(vertex)


def _absorb(
    body: set[VertexId],
    grown: list[set[VertexId]],
    of_vertex: Mapping[VertexId, list[int]],
    beside: Mapping[VertexId, set[VertexId]],
) -> None:
    """Make one body of a new one and all that share three vertices with it, and list it."""
    while True:
        common = Counter(number for vertex in body for number in of_vertex[vertex])
        same = [number for number, vertices in common.items() if vertices >= _FIXED]
        if not same:
            break
        for number in same:
            for vertex in grown[number]:
                of_vertex[vertex].remove(number)
            body |= grown[number]
            grown[number] = set()
        _grow(body, beside)
    for vertex in body:
        of_vertex[vertex].append(len(grown))
    grown.append(body)


def bodies_of(model: PolyhedronModel) -> list[Sequence[VertexId]]:
    """Return the vertices of each body: of the declared links, then of the rigid sets of the other rods."""
    return [*model.links.values(), *rigid_sets(model)]
