"""The second road to the generic mobility: vertices, rods and Wampler's terms, ranked at a random member.

M = 3V - rank - 6, the rank that of the velocities' constraints: one for each rod, one for a point on a plane, two
for a point on a line, five for a scissors element. Vertices are placed so that the rods of a remote centre meet in
a point. There the vertices of a link are coplanar and its rods alone misreport, so links of four vertices or more
get a virtual apex, a random point joined to all their vertices.

Source: Wampler, Larson, Erdman 2007, Eqs. 5 to 10; DESIGN, section 3. Theory: docs/theory/exact-mobility.md.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Iterator, Mapping, Sequence
from typing import Any

from flint import nmod_mat

from graphs.errors import NumericalError, UnsolvableError
from graphs.exact import ExactMobility
from graphs.fields import PRIMES, Field, PrimeField, null_vectors
from graphs.polyhedron import GROUND, PolyhedronModel, VertexId

__all__ = ["exact_mobility_of_model", "place_model", "velocity_constraints"]

Place = tuple[Any, Any, Any]
Row = dict[tuple[Hashable, int], Any]

_ATTEMPTS = 24


def exact_mobility_of_model(
    model: PolyhedronModel, primes: Sequence[int] = PRIMES, *, seed: int = 0
) -> ExactMobility:
    """Return the generic mobility of a polyhedron model.

    Parameters
    ----------
    model : PolyhedronModel
        Without a ground link six freedoms of the whole are taken off.
    primes : sequence of int, optional
    seed : int, optional
        Another seed is another random member.

    Raises
    ------
    UnsolvableError
        If its vertices could not be placed, or a remote centre does not say which rods meet there.
    NumericalError
        If the primes give different ranks, which all but never happens.

    Examples
    --------
    A spherical four-bar of four triangles:

    >>> exact_mobility_of_model(
    ...     PolyhedronModel(5, [(0, 1), (0, 3), (0, 4), (1, 2), (1, 4), (2, 3), (2, 4), (3, 4)])
    ... ).mobility
    1
    """
    ranks, freedoms = [], 0
    for prime in primes:
        field = PrimeField(prime, seed)
        rows, columns = velocity_constraints(model, place_model(model, field), field)
        freedoms = 3 * columns - (6 if model.ground is None else 0)
        ranks.append(_rank(rows, prime))
    if len(set(ranks)) > 1:
        raise NumericalError(
            f"the rank is {ranks} modulo {list(primes)}: an unlucky random member; try another seed"
        )
    return ExactMobility(freedoms - ranks[0], freedoms, ranks[0], tuple(primes), forced=True)


def _rank(rows: Sequence[Row], prime: int) -> int:
    column: dict[tuple[Hashable, int], int] = {}
    for row in rows:
        for key in row:
            column.setdefault(key, len(column))
    matrix = nmod_mat(max(len(rows), 1), max(len(column), 1), prime)
    for i, row in enumerate(rows):
        for key, value in row.items():
            matrix[i, column[key]] = value % prime
    return int(matrix.rank())


def place_model(model: PolyhedronModel, field: Field) -> dict[VertexId, Place]:
    """Place the vertices of a model at random, as its lines, planes and remote centres ask.

    Raises
    ------
    UnsolvableError
        If that does not succeed in any of the orders tried.
    """
    order = list(model.nodes)
    meeting = list(_meeting_pairs(model))
    for _ in range(_ATTEMPTS):
        placed = _place_in_order(model, order, meeting, field)
        if placed is not None:
            return placed
        order = order[1:] + order[:1]
    raise UnsolvableError("not realised: the vertices could not be placed as lines, planes and remote centres ask")


def _meeting_pairs(model: PolyhedronModel) -> Iterator[tuple[Hashable, VertexId, VertexId]]:
    """Yield the pairs of vertices whose lines pass through a centre, with the centre's name."""
    for index, centre in enumerate(model.centres):
        if centre.rods:
            yield from ((("centre", index), a, b) for a, b in centre.rods)
        elif not model.scissors:
            raise UnsolvableError(f"remote centre {index} does not say which rods meet there")
    if model.scissors and any(not centre.rods for centre in model.centres):
        # Spherical scissors: the pairs at the two ends of every element point to one centre.
        ends = {pair for a, b, c, d in model.scissors for pair in ((a, b), (c, d))}
        yield from ((("centre", "scissors"), a, b) for a, b in sorted(ends, key=str))


def _place_in_order(
    model: PolyhedronModel,
    order: Sequence[VertexId],
    meeting: Sequence[tuple[Hashable, VertexId, VertexId]],
    field: Field,
) -> dict[VertexId, Place] | None:
    centres = {name: _random_point(field) for name, _, _ in meeting}
    placed: dict[Hashable, list[Any]] = {name: [*point, 1] for name, point in centres.items()}
    spans: dict[VertexId, list[tuple[Hashable, ...]]] = defaultdict(list)
    for name, a, b in meeting:
        spans[a].append((name, b))
        spans[b].append((name, a))
    for one in (*model.on_line, *model.on_plane):
        if one.of != GROUND:
            spans[one.vertex].append(tuple(one.of))
    for a, b, c, d in model.scissors:
        for vertex, others in ((a, (b, c, d)), (b, (a, c, d)), (c, (a, b, d)), (d, (a, b, c))):
            spans[vertex].append(others)
    for vertex in order:
        planes: list[list[Any]] = []
        for span in spans[vertex]:
            if all(point in placed for point in span):
                planes += null_vectors([placed[point] for point in span], field)
        choices = null_vectors(planes, field) if planes else [[int(i == j) for j in range(4)] for i in range(4)]
        if not choices:
            return None
        weights = [field.random() for _ in choices]
        point = [field.reduce(sum(w * c[k] for w, c in zip(weights, choices, strict=True))) for k in range(4)]
        if field.is_zero(point[3]):
            return None
        scale = field.inverse(point[3])
        placed[vertex] = [field.reduce(value * scale) for value in point[:3]] + [1]
    return (
        {vertex: (p[0], p[1], p[2]) for vertex, p in placed.items() if vertex in model}
        if _fits(placed, spans, field)
        else None
    )


def _fits(
    placed: Mapping[Hashable, list[Any]], spans: Mapping[VertexId, list[tuple[Hashable, ...]]], field: Field
) -> bool:
    """Tell whether every vertex lies in the spans it should: some were placed before what they lie on."""
    for vertex, here in spans.items():
        for span in here:
            planes = null_vectors([placed[point] for point in span], field)
            for plane in planes:
                if not field.is_zero(field.reduce(sum(a * b for a, b in zip(plane, placed[vertex], strict=True)))):
                    return False
    return True


def _random_point(field: Field) -> Place:
    return field.random(), field.random(), field.random()


def velocity_constraints(
    model: PolyhedronModel, places: Mapping[VertexId, Place], field: Field
) -> tuple[list[Row], int]:
    """Return the constraints on the velocities of the vertices, and how many points move.

    Parameters
    ----------
    model : PolyhedronModel
    places : mapping of vertex to (x, y, z)
    field : Field

    Returns
    -------
    rows : list of dict
        (point, coordinate) to coefficient.
    points : int
        Vertices and apexes, those of the ground link left out.
    """
    fixed = model.ground or frozenset()
    where: dict[Hashable, Place] = dict(places)
    rods = [(a, b) for a, b in model.edges if not {a, b} <= fixed]
    for link, around in model.links.items():
        if len(around) >= 4:
            apex = ("apex", link)
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
    for four in model.scissors:
        rows += _scissors(four, where, field)
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
    rows = []
    for i, j in ((1, 2), (2, 0), (0, 1)):
        rows.append(
            {
                (v, i): u[j],
                (v, j): -u[i],
                (b, j): w[i],
                (b, i): -w[j],
                (a, i): -u[j] + w[j],
                (a, j): u[i] - w[i],
            }
        )
    return rows


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


def _scissors(four: Sequence[Hashable], where: Mapping[Hashable, Place], field: Field) -> list[Row]:
    """Two bars a-d and b-c of fixed lengths, pivoted where they cross: five constraints."""
    a, b, c, d = four
    along_a, along_b = _difference(where[d], where[a]), _difference(where[c], where[b])
    gap = _difference(where[b], where[a])
    # where[a] + s along_a = where[b] + t along_b
    [solution] = null_vectors([[along_a[k], -along_b[k], -gap[k]] for k in range(3)], field)
    scale = field.inverse(solution[2])
    s, t = solution[0] * scale, solution[1] * scale
    rows = [_length(a, d, where), _length(b, c, where)]
    rows += [{(a, k): 1 - s, (d, k): s, (b, k): t - 1, (c, k): -t} for k in range(3)]
    return rows
