"""The SCD graph of a polyhedron model: its links declared, or read from triangles of rods.

A body of the model is a link (`graphs.mechanism.bodies`), a rod of two bodies their joint; a remote centre S_{+3} is
the implicit centre of the joints it names. Of a body of four vertices or more that is not declared the cyclic order
is what its joints allow: if all choices are one SCD graph it is that, else the vertices are ambiguous. Theory:
docs/theory/polyhedron-model.md.
"""

from collections import Counter
from collections.abc import Hashable, Iterator, Mapping, Sequence
from itertools import combinations, islice, permutations, product
from math import prod

import networkx as nx

from graphs.convert.panels import scd_from_panels
from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.identity.drawings import map_id
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.bodies import rigid_sets, undeclared_rods
from graphs.mechanism.polyhedron import PolyhedronModel, RemoteCentre, VertexId
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import sides_of_face
from graphs.types import JointId

_LARGEST = 8  # vertices of a body whose cyclic orders are listed: 2520 of eight, 20 160 of nine
# Choices of cyclic orders of all bodies that are compared, each a drawing that is made and given an id: more would take
# minutes.
_MOST = 4096

Cycle = tuple[VertexId, ...]


def scd_of_model(model: PolyhedronModel) -> SCDGraph:
    """Return the SCD graph of a polyhedron model of panels and implicit centres.

    Parameters
    ----------
    model : PolyhedronModel
        Links that are not declared are the largest rigid sets that triangles of rods show.

    Raises
    ------
    UnsolvableError
        If it has other terms than panels and implicit centres, or its rods leave ambiguous what a link is; the
        vertices are named.

    Examples
    --------
    >>> fan = [(0, 1), (0, 2), (0, 3), (0, 4), (1, 2), (2, 3), (3, 4), (4, 1)]
    >>> print(scd_of_model(PolyhedronModel(5, fan)).counts)  # four triangles round a vertex
    FeatureCounts(vertices=5, implicit_centres=0, external_edges=8, internal_edges=0, open_edges=4, faces=2)
    """
    if any((model.on_line, model.on_plane, model.scissors)) or model.ground is not None:
        raise UnsolvableError("the polyhedron model has more than panels (points on lines or planes, scissors, ground)")
    loose = undeclared_rods(model)
    if not loose:
        if not model.links:
            raise UnsolvableError("the polyhedron model has no rods that show its links")
        return _scd_of_panels(model, model.links)
    bodies = rigid_sets(model)
    _check_rods(model, loose, bodies)
    _check_vertices(model, bodies)
    return _of_bodies(model, bodies)


def _check_rods(model: PolyhedronModel, loose: Sequence[tuple[VertexId, VertexId]], bodies: Sequence[Cycle]) -> None:
    """Refuse rods that lie in no body, or in three."""
    sets = [frozenset(body) for body in (*model.links.values(), *bodies)]
    for a, b in loose:
        number = sum(a in body and b in body for body in sets)
        if number not in (1, 2):  # neither a side of its own nor a joint
            what = "lies in no triangle" if not number else f"lies in {number} bodies"
            raise _ambiguous((a, b), f"the rod between them {what}")


def _check_vertices(model: PolyhedronModel, bodies: Sequence[Cycle]) -> None:
    """Refuse vertices of no body, and those at which bodies meet that no joints there connect: a ball, not a hinge."""
    every = [frozenset(body) for body in (*model.links.values(), *bodies)]
    for vertex in model.nodes:
        here = [body for body in every if vertex in body]
        if not here:
            raise _ambiguous((vertex,), "it is in no triangle of rods")
        joined = nx.utils.UnionFind(here)
        for one, other in combinations(here, 2):
            if len(one & other) > 1:
                joined.union(one, other)
        if len({joined[body] for body in here}) > 1:
            raise _ambiguous((vertex,), "bodies meet there in a point only, with no rod in common")


def _ambiguous(vertices: Sequence[VertexId], why: str) -> UnsolvableError:
    names = ", ".join(map(shown, vertices))
    at = "vertex" if len(vertices) == 1 else "vertices"
    return UnsolvableError(f"the links at {at} {names} are ambiguous: {why}; declare them with 'links'")


def _of_bodies(model: PolyhedronModel, bodies: Sequence[Cycle]) -> SCDGraph:
    """Return the one SCD graph that the cyclic orders of the bodies allow."""
    every = [*map(tuple, model.links.values()), *bodies]
    of_vertex = Counter(vertex for body in every for vertex in body)
    sets = [frozenset(body) for body in every]
    orders = [[body] if len(body) == _TRIANGLE else list(_orders(body, sets, of_vertex)) for body in bodies]
    open_bodies = [body for body, choices in zip(bodies, orders, strict=True) if len(choices) != 1]
    odd = sorted({vertex for body in open_bodies for vertex in body}, key=list(model.nodes).index)
    if prod(len(choices) for choices in orders) > _MOST:
        raise _ambiguous(odd, "too many cyclic orders of the vertices of a link are possible")
    found: dict[str, SCDGraph] = {}
    failure: InvariantError | None = None
    for chosen in product(*orders):
        try:
            scd = _scd_of_panels(model, _named(model, chosen))
        except InvariantError as error:
            failure = failure or error
        else:
            found.setdefault(map_id(scd), scd)
    if not found:
        raise failure or _ambiguous(odd, "no cyclic order of the vertices of each link has all its joints as sides")
    if len(found) > 1:
        raise _ambiguous(odd, f"the cyclic orders of the vertices of each link allow {len(found)} SCD graphs")
    (scd,) = found.values()
    return scd


_TRIANGLE = 3  # three vertices have one cyclic order up to reflection: nothing is to be chosen


def _orders(body: Cycle, sets: Sequence[frozenset[VertexId]], of_vertex: Mapping[VertexId, int]) -> Iterator[Cycle]:
    """Yield the cyclic orders of a body in which its joints are sides, each once up to vertices that only it has."""
    if len(body) > _LARGEST:
        yield from ()
        return
    own = frozenset(body)
    joints = [own & other for other in sets if other != own and len(own & other) == 2]
    first, *rest = body
    seen = set()
    for row in permutations(rest):
        cycle = (first, *row)
        sides = {frozenset(side) for side in sides_of_face(cycle)}
        if not all(joint in sides for joint in joints):
            continue
        key = _turned(tuple(None if of_vertex[vertex] == 1 else str(vertex) for vertex in cycle))
        if key not in seen:
            seen.add(key)
            yield cycle


def _turned(cycle: tuple[str | None, ...]) -> tuple[tuple[bool, str], ...]:
    """Return a cyclic order the same however it was started, and whichever way round."""
    marks = tuple((name is not None, name or "") for name in cycle)
    turns = (way[i:] + way[:i] for way in (marks, marks[::-1]) for i in range(len(marks)))
    return min(turns)


def _named(model: PolyhedronModel, bodies: Sequence[Cycle]) -> dict[Hashable, Cycle]:
    """Return the declared links and then the bodies, named by numbers that no link has."""
    links: dict[Hashable, Cycle] = {link: tuple(around) for link, around in model.links.items()}
    taken = set(map(str, links))
    numbers = (number for number in range(len(links) + len(bodies) + 1) if str(number) not in taken)
    return links | dict(zip(islice(numbers, len(bodies)), bodies, strict=True))


def _scd_of_panels(model: PolyhedronModel, links: Mapping[Hashable, Sequence[VertexId]]) -> SCDGraph:
    """Return the SCD graph of panels, with the implicit centres and the outer face that the model has."""
    return scd_from_panels(links, outer=model.outer, implicit=lambda joint_at: _loops(model.centres, joint_at))


def _loops(centres: Sequence[RemoteCentre], joint_at: Mapping[frozenset[VertexId], JointId]) -> list[Loop]:
    """Return the loops about remote centres; refuse those that are no implicit centre of joints."""
    loops = []
    for number, centre in enumerate(centres):
        sides = [frozenset(rod) for rod in centre.rods]
        if centre.k != 3 or not sides or any(side not in joint_at for side in sides):
            which = shown(number if centre.name is None else centre.name)
            raise UnsolvableError(
                f"remote centre {which} is no implicit centre of an SCD graph; expected k = 3 and the rods of joints"
            )
        kind = Centre.INFINITE if centre.infinite else Centre.FINITE
        loops.append(Loop(tuple(joint_at[side] for side in sides), kind, centre.name, centre.at))
    return loops
