"""Generic mobility a second way: vertices, rods and Wampler's terms, ranked at a random realisation.

M = 3V - rank - 6, the rank that of the velocities' constraints: one for each rod, one for a point on a plane, two
for a point on a line, five for a scissors element. Where the vertices of a link are coplanar its rods alone
misreport, so links of four vertices or more get a virtual apex. Source: Wampler, Larson, Erdman 2007, Eqs. 5 to
10. Theory: docs/theory/exact-mobility.md.
"""

from collections import defaultdict
from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

from graphs.errors import UnsolvableError, shown
from graphs.loops.classes import centre_classes
from graphs.loops.loop import Loop
from graphs.mechanism.bodies import bodies_of
from graphs.mechanism.polyhedron import GROUND, PolyhedronModel, VertexId
from graphs.rank.dissection import rank_modulo
from graphs.rank.exact import ExactMobility, agreed_rank
from graphs.rank.realisation import PRIMES, Field, PrimeField, null_vectors

Place = tuple[Any, Any, Any]
Row = dict[tuple[Hashable, int], Any]

# Orders of placing vertices that are tried, each begun one vertex further; a model that fits in none is refused.
_ATTEMPTS = 24


def exact_mobility_of_model(model: PolyhedronModel, primes: Sequence[int] = PRIMES, *, seed: int = 0) -> ExactMobility:
    """Return the generic mobility of a polyhedron model.

    Parameters
    ----------
    model : PolyhedronModel
        Without a ground link the freedoms of the whole are taken off: six, five if all vertices are in line.
    primes, seed
        As for `graphs.rank.exact.exact_mobility`, as is the `NumericalError`.

    Raises
    ------
    UnsolvableError
        If its vertices could not be placed, a remote centre does not say which rods meet there, lines make one
        point of several vertices, or the bars of a scissors element do not cross.

    Examples
    --------
    >>> rods = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 4), (2, 3), (2, 4), (3, 4)]  # four triangles round a point
    >>> exact_mobility_of_model(PolyhedronModel(5, rods)).mobility
    1
    """
    ranks, freedoms = [], 0
    for prime in primes:
        field = PrimeField(prime, seed)
        places = place_model(model, field)
        rows, columns = velocity_constraints(model, places, field)
        freedoms = 3 * columns - (_of_the_whole(list(places.values()), field) if model.ground is None else 0)
        ranks.append(rank_modulo(*numbered_columns(rows), prime))
    rank = agreed_rank(ranks, primes)
    return ExactMobility(freedoms - rank, freedoms, rank, tuple(primes), forced=True)


def _of_the_whole(places: Sequence[Place], field: Field) -> int:
    """Return the freedoms that points have as one body: 6, 5 if they are in line, 3 if there is one only."""
    ways = [way for way in (_difference(place, places[0]) for place in places) if any(map(field.reduce, way))]
    if not ways:
        return 3 if places else 0
    across = (field.reduce(value) for way in ways for value in _cross(ways[0], way))
    return 5 if all(map(field.is_zero, across)) else 6


def numbered_columns(rows: Sequence[Row]) -> tuple[list[dict[int, Any]], int]:
    """Return the rows with (point, coordinate) numbered in their order, and how many columns there are."""
    column: dict[tuple[Hashable, int], int] = {}
    numbered = [{column.setdefault(key, len(column)): value for key, value in row.items()} for row in rows]
    return numbered, len(column)


def place_model(model: PolyhedronModel, field: Field) -> dict[VertexId, Place]:
    """Place the vertices of a model at random on its lines and planes, so that its remote centres exist.

    Raises `UnsolvableError` if that does not succeed in any of the orders tried, or the bars of a scissors element
    then do not cross.
    """
    spans = _spans(model)
    centres = [point for point in spans if point not in model]
    failure = UnsolvableError(
        "not realised: the vertices could not be placed so that all lines, planes and remote centres exist"
    )
    for strictly in (True, False):
        placing = _Placing(model, spans, field, strictly)
        order = list(model.nodes)
        for _ in range(_ATTEMPTS):
            placed = placing.in_order([*centres, *order])
            if placed is not None:
                try:
                    for number in range(len(model.scissors)):
                        _crossing(number, model, placed, field)
                except UnsolvableError as error:
                    failure = error
                else:
                    return placed
            order = order[1:] + order[:1]
    raise failure


def _spans(model: PolyhedronModel) -> dict[Hashable, list[tuple[Hashable, ...]]]:
    """Return for each vertex and centre the points whose line or plane it must lie on."""
    spans: dict[Hashable, list[tuple[Hashable, ...]]] = defaultdict(list)
    for line in _lines_through_centres(model):
        for point in line:
            spans[point] += combinations([other for other in line if other != point], 2)
    for one in (*model.on_line, *model.on_plane):
        if one.of != GROUND:
            spans[one.vertex].append(tuple(one.of))
    for plane in _planes_of_scissors(model):
        for point in plane:
            spans[point] += combinations([other for other in plane if other != point], 3)
    return spans


def _planes_of_scissors(model: PolyhedronModel) -> list[list[VertexId]]:
    """Return the vertices in the plane of each element; two planes that share three vertices are one."""
    planes = [dict.fromkeys(four) for four in model.scissors]
    apart = False
    while not apart:
        apart = True
        for one, other in combinations(planes, 2):
            if len(one.keys() & other.keys()) >= 3:
                one.update(other)
                planes = [plane for plane in planes if plane is not other]
                apart = False
                break
    return [list(plane) for plane in planes]


def _lines_through_centres(model: PolyhedronModel) -> Iterator[list[Hashable]]:
    """Yield the points on the line of each rod that passes through a centre: its ends, and the centres.

    Two points that two lines share are one (`graphs.loops.classes`): centres, or a centre and a vertex.
    """
    lines = [[frozenset(rod) for rod in centre.rods] for centre in model.centres if centre.rods]
    if len(lines) < len(model.centres):
        if not model.scissors:
            silent = next(i for i, centre in enumerate(model.centres) if not centre.rods)
            raise UnsolvableError(f"remote centre {silent} does not say which rods meet there")
        # Spherical scissors: the pairs at the two ends of every element point to one centre.
        lines.append([frozenset(pair) for a, b, c, d in model.scissors for pair in ((a, b), (c, d))])
    rods = sorted({rod for line in lines for rod in line}, key=lambda rod: sorted(map(str, rod)))
    at_vertex = {v: [rod for rod in rods if v in rod] for v in model.nodes}
    several = [v for v, here in at_vertex.items() if len(here) > 1]
    meeting = [*lines, *(at_vertex[v] for v in several)]
    points = [Loop(tuple(dict.fromkeys(here))) for here in meeting]
    on: dict[frozenset[VertexId], list[Hashable]] = {rod: list(rod) for rod in rods}
    for number, one in enumerate(centre_classes(points)):
        vertices = [several[i - len(lines)] for i in one.loops if i >= len(lines)]
        if len(vertices) > 1:
            raise _one_point(model, vertices)
        name: Hashable = vertices[0] if vertices else ("centre", number)
        for rod in one.joints:
            assert isinstance(rod, frozenset)
            if name not in on[rod]:
                on[rod].append(name)
    yield from on.values()


def _one_point(model: PolyhedronModel, vertices: Sequence[VertexId]) -> UnsolvableError:
    elements = [i for i, four in enumerate(model.scissors) if len(set(four) & set(vertices)) > 1]
    which = f" (scissors {shown(' '.join(map(str, elements)))})" if elements else ""
    names = shown(" ".join(map(str, vertices)))
    return UnsolvableError(f"lines that meet in remote centres make one point of vertices {names}{which}")


@dataclass(frozen=True)
class _Placing:
    """How points are placed: each on what earlier ones span.

    With `strictly` a point lies with span points even where these are dependent, on their line say. Elements of
    scissors that share vertices may need it otherwise: three on a line are in one plane with any fourth.
    """

    model: PolyhedronModel
    spans: Mapping[Hashable, list[tuple[Hashable, ...]]]
    field: Field
    strictly: bool

    def in_order(self, order: Sequence[Hashable]) -> dict[Hashable, Place] | None:
        """Place points one by one; None if one has no place."""
        field = self.field
        placed: dict[Hashable, list[Any]] = {}
        for point in order:
            planes: list[list[Any]] = []
            for span in self.spans.get(point, ()):
                if all(other in placed for other in span):
                    planes += self._planes_through(span, placed)
            choices = null_vectors(planes, field) if planes else [[int(i == j) for j in range(4)] for i in range(4)]
            if not choices:
                return None
            weights = [field.random() for _ in choices]
            place = [field.reduce(sum(w * c[k] for w, c in zip(weights, choices, strict=True))) for k in range(4)]
            if field.is_zero(place[3]):
                return None
            scale = field.inverse(place[3])
            placed[point] = [field.reduce(value * scale) for value in place[:3]] + [1]
        if not self._fits(placed):
            return None
        return {vertex: (p[0], p[1], p[2]) for vertex, p in placed.items() if vertex in self.model}

    def _fits(self, placed: Mapping[Hashable, list[Any]]) -> bool:
        """Return whether every vertex lies in its spans: some were placed before the points that span them."""
        field = self.field
        for vertex, here in self.spans.items():
            for span in here:
                for plane in self._planes_through(span, placed):
                    height = sum(a * b for a, b in zip(plane, placed[vertex], strict=True))
                    if not field.is_zero(field.reduce(height)):
                        return False
        return True

    def _planes_through(self, span: Sequence[Hashable], placed: Mapping[Hashable, list[Any]]) -> list[list[Any]]:
        planes = null_vectors([placed[other] for other in span], self.field)
        return planes if self.strictly or len(planes) == 4 - len(span) else []


def _random_point(field: Field) -> Place:
    return field.random(), field.random(), field.random()


def velocity_constraints(
    model: PolyhedronModel, places: Mapping[VertexId, Place], field: Field
) -> tuple[list[Row], int]:
    """Return the constraints on the velocities of the vertices, and how many points move.

    Rows map (point, coordinate) to a coefficient; points are vertices and apexes, those of the ground link left
    out. Raises `UnsolvableError` if the bars of a scissors element do not cross in one point there.
    """
    fixed = model.ground or frozenset()
    where: dict[Hashable, Place] = dict(places)
    rods = [(a, b) for a, b in model.edges if not {a, b} <= fixed]
    # Rods to a remote centre make four vertices of a link coplanar, where its own rods misreport: so bodies that
    # triangles show get an apex too.
    for number, around in enumerate(bodies_of(model) if model.centres else model.links.values()):
        if len(around) >= 4:
            apex = ("apex", number)
            where[apex] = _random_point(field)
            rods += [(apex, vertex) for vertex in around]
    rows = [_length(a, b, where) for a, b in rods]
    for one in model.on_plane:
        rows += [_flat(one.vertex, tuple(one.of), where)] if one.of != GROUND else [_held(one.vertex, field)]
    lines = _ground_lines(model, field)
    for one in model.on_line:
        if one.of == GROUND:
            rows += _along(one.vertex, lines[one.vertex])
        else:
            rows += _straight(one.vertex, tuple(one.of), where)
    for number in range(len(model.scissors)):
        rows += _scissors(number, model, where, field)
    rows = [{key: field.reduce(value) for key, value in row.items() if key[0] not in fixed} for row in rows]
    return rows, len(where) - len(fixed)


def _difference(p: Place, q: Place) -> list[Any]:
    return [a - b for a, b in zip(p, q, strict=True)]


def _cross(u: Sequence[Any], v: Sequence[Any]) -> list[Any]:
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def _length(a: Hashable, b: Hashable, where: Mapping[Hashable, Place]) -> Row:
    u = _difference(where[a], where[b])
    return {**{(a, k): u[k] for k in range(3)}, **{(b, k): -u[k] for k in range(3)}}


def _flat(v: Hashable, of: tuple[Hashable, ...], where: Mapping[Hashable, Place]) -> Row:
    """The derivative of the volume that four coplanar points span."""
    points = [v, *of]
    row: Row = {}
    for i, moving in enumerate(points):
        a, b, c = (where[points[j]] for j in range(4) if j != i)
        normal = _cross(_difference(b, a), _difference(c, a))
        for k in range(3):
            row[moving, k] = normal[k] * (-1) ** i
    return row


def _straight(v: Hashable, of: tuple[Hashable, ...], where: Mapping[Hashable, Place]) -> list[Row]:
    """The derivative of (v - a) x (b - a): three equations, two of them independent."""
    a, b = of
    u, w = _difference(where[b], where[a]), _difference(where[v], where[a])
    return [
        {(v, i): u[j], (v, j): -u[i], (b, j): w[i], (b, i): -w[j], (a, i): -u[j] + w[j], (a, j): u[i] - w[i]}
        for i, j in ((1, 2), (2, 0), (0, 1))
    ]


def _held(v: Hashable, field: Field) -> Row:
    """A vertex on a random plane of the ground link."""
    return {(v, k): field.random() for k in range(3)}


def _ground_lines(model: PolyhedronModel, field: Field) -> dict[VertexId, Place]:
    """Return the direction of the line of each vertex on a line of ground; vertices of one rod share theirs."""
    on = [one.vertex for one in model.on_line if one.of == GROUND]
    lines: dict[VertexId, Place] = {}
    for vertex in on:
        partner = next((other for other in on if other in lines and model.has_edge(vertex, other)), None)
        lines[vertex] = _random_point(field) if partner is None else lines[partner]
    return lines


def _along(v: Hashable, direction: Place) -> list[Row]:
    return [{(v, i): direction[j], (v, j): -direction[i]} for i, j in ((1, 2), (2, 0), (0, 1))]


def _scissors(number: int, model: PolyhedronModel, where: Mapping[Hashable, Place], field: Field) -> list[Row]:
    """Two bars a-d and b-c of fixed lengths, pivoted where they cross: five constraints."""
    a, b, c, d = model.scissors[number]
    s, t = _crossing(number, model, where, field)
    rows = [_length(a, d, where), _length(b, c, where)]
    rows += [{(a, k): 1 - s, (d, k): s, (b, k): t - 1, (c, k): -t} for k in range(3)]
    return rows


def _crossing(number: int, model: PolyhedronModel, where: Mapping[Hashable, Place], field: Field) -> tuple[Any, Any]:
    """Return s and t where the bars of a scissors element cross: a + s (d - a) = b + t (c - b).

    Where rounded coordinates part the bars a little, s and t are those of the points nearest to each other.
    """
    a, b, c, d = model.scissors[number]
    along_a, along_b = _difference(where[d], where[a]), _difference(where[c], where[b])
    gap = _difference(where[b], where[a])
    squared = field.reduce(_dot(along_a, along_a) * _dot(along_b, along_b))
    normal = [field.reduce(value) for value in _cross(along_a, along_b)]
    size = field.reduce(_dot(normal, normal))
    if not squared:
        raise _no_pivot(number, model, "one of its bars has no length")
    if field.is_zero(field.reduce(size * field.inverse(squared))):
        raise _no_pivot(number, model, "its bars are parallel or on one line")
    scale = field.inverse(size)
    if not field.is_zero(field.reduce(_dot(gap, normal) ** 2 * scale)):
        raise _no_pivot(number, model, "its bars pass each other")
    return tuple(field.reduce(_dot(_cross(gap, along), normal) * scale) for along in (along_b, along_a))


def _no_pivot(number: int, model: PolyhedronModel, why: str) -> UnsolvableError:
    a, b, c, d = model.scissors[number]
    return UnsolvableError(
        f"scissors element {number} has no pivot: {why}; "
        f"expected that bars {shown((a, d))} and {shown((b, c))} cross in one point"
    )


def _dot(u: Sequence[Any], v: Sequence[Any]) -> Any:
    return sum(a * b for a, b in zip(u, v, strict=True))
