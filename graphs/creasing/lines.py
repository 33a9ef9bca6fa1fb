"""A sheet creased along a line: vertices where it starts, ends and crosses edges, faces split between them."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from math import dist

import numpy as np

from graphs.errors import InvariantError, UnsolvableError
from graphs.mechanism.sheet import COLLINEAR, FLAT, Sheet, sides_of_face


def creased_along(
    sheet: Sheet, start: int | Sequence[float], end: int | Sequence[float], letter: str
) -> tuple[Sheet, tuple[int, int]]:
    """Return a sheet that lists all its edges with one more crease, and the vertices at its ends."""
    before = sheet
    ends = []
    for place in (start, end):
        sheet, vertex = _with_vertex(sheet, place)
        ends.append(vertex)
    a, b = ends
    if a == b:
        wrong = f"the crease starts and ends at {vertex_in_words(sheet, a)}"
        raise InvariantError("crease", wrong, "two vertices")
    path = [a, b]
    if _is_flat(sheet):
        sheet, path = _crossing_edges(sheet, a, b)
    for p, q in pairwise(path):
        sheet = _creased_between(sheet, p, q, letter)
    if sheet == before:
        between = f"from {vertex_in_words(sheet, a)} to {vertex_in_words(sheet, b)}"
        raise UnsolvableError(f"there are creases or borders all the way {between}")
    return sheet, (a, b)


def vertex_in_words(sheet: Sheet, vertex: int) -> str:
    """Return the number of a vertex with its coordinates."""
    if sheet.coordinates is None:
        return f"vertex {vertex}"
    return f"vertex {vertex} ({', '.join(f'{x:g}' for x in sheet.coordinates[vertex])})"


def edge_in_words(sheet: Sheet, edge: int) -> str:
    """Return the number of an edge with its assignment and its ends."""
    a, b = (vertex_in_words(sheet, vertex) for vertex in sheet.edges[edge])
    return f"edge {edge} ({sheet.assignments[edge]}) from {a} to {b}"


def _is_flat(sheet: Sheet) -> bool:
    return sheet.coordinates is not None and len({place[2:] for place in sheet.coordinates}) <= 1


def _near(sheet: Sheet) -> float:
    """Return the distance within which points are equal."""
    assert sheet.coordinates is not None
    return COLLINEAR * float(np.ptp(np.array(sheet.coordinates, dtype=float), axis=0).max(initial=0.0))


def _with_vertex(sheet: Sheet, place: int | Sequence[float]) -> tuple[Sheet, int]:
    """Return the sheet, with one more vertex if a place is inside an edge, and the vertex at the place."""
    if isinstance(place, int):
        if not 0 <= place < sheet.vertices:
            expected = f"a vertex from 0 to {sheet.vertices - 1}"
            if sheet.vertices:
                expected += f"; the last is {vertex_in_words(sheet, sheet.vertices - 1)}"
            raise InvariantError("crease", f"{place} is no vertex", expected)
        return sheet, place
    if sheet.coordinates is None:
        raise UnsolvableError("a point needs coordinates, and the sheet has none: name vertices")
    width = len(sheet.coordinates[0])
    point = (*map(float, place), 0.0)[:width] if len(place) == 2 else tuple(map(float, place))
    if len(point) != width:
        raise InvariantError("crease", f"a point of {len(place)} numbers", f"{width} numbers")
    gaps = [dist(point, at) for at in sheet.coordinates]
    nearest = min(range(sheet.vertices), key=gaps.__getitem__)
    if gaps[nearest] <= _near(sheet):
        return sheet, nearest
    edge, gap = _nearest_edge(sheet, point)
    if gap > _near(sheet):
        near = f"{vertex_in_words(sheet, nearest)} and {edge_in_words(sheet, edge)}"
        wrong = f"the point ({', '.join(f'{x:g}' for x in point)}) is on no edge"
        raise InvariantError("crease", wrong, f"a vertex or a point of an edge; the nearest are {near}")
    return _split_edge(sheet, edge, point)


def _nearest_edge(sheet: Sheet, point: Sequence[float]) -> tuple[int, float]:
    """Return the edge nearest to a point, and how far it is."""
    ends = np.array(sheet.coordinates, dtype=float)[np.array(sheet.edges, dtype=int)]
    start, along = ends[:, 0], ends[:, 1] - ends[:, 0]
    squares = np.maximum((along * along).sum(axis=1), np.finfo(float).tiny)
    part = np.clip(((np.array(point) - start) * along).sum(axis=1) / squares, 0.0, 1.0)
    gaps = np.linalg.norm(start + part[:, None] * along - np.array(point), axis=1)
    edge = int(np.argmin(gaps))
    return edge, float(gaps[edge])


def _split_edge(sheet: Sheet, edge: int, point: Sequence[float]) -> tuple[Sheet, int]:
    """Put a vertex on an edge: the first part keeps its number, the second comes last."""
    assert sheet.coordinates is not None
    a, b = sheet.edges[edge]
    new = sheet.vertices
    faces = []
    for face in sheet.faces:
        around: list[int] = []
        for side in sides_of_face(face):
            around += [side[0], new] if frozenset(side) == {a, b} else [side[0]]
        faces.append(tuple(around))
    edges = list(sheet.edges)
    edges[edge] = (a, new)
    angles = sheet.fold_angles
    return replace(
        sheet,
        vertices=new + 1,
        edges=(*edges, (new, b)),
        assignments=sheet.assignments + sheet.assignments[edge],
        faces=tuple(faces),
        coordinates=(*sheet.coordinates, tuple(point)),
        fold_angles=None if angles is None else (*angles, angles[edge]),
    ), new


def _crossing_edges(sheet: Sheet, a: int, b: int) -> tuple[Sheet, list[int]]:
    """Put a vertex where the line from a to b crosses an edge; return all vertices on the line, in order."""
    assert sheet.coordinates is not None
    start, end = (np.array(sheet.coordinates[v][:2]) for v in (a, b))
    along, near = end - start, _near(sheet)
    length = float(np.linalg.norm(along))
    for edge in range(len(sheet.edges)):
        assert sheet.coordinates is not None
        p, q = (np.array(sheet.coordinates[v][:2]) - start for v in sheet.edges[edge])
        over, under = (float(along[0] * v[1] - along[1] * v[0]) / length for v in (p, q))
        if over * under >= 0 or min(abs(over), abs(under)) <= near:
            continue
        meet = p + (q - p) * (over / (over - under))
        if near < float(meet @ along) / length < length - near:
            height = sheet.coordinates[sheet.edges[edge][0]][2:]
            sheet, _ = _split_edge(sheet, edge, (*map(float, meet + start), *height))
    assert sheet.coordinates is not None
    places = np.array([place[:2] for place in sheet.coordinates]) - start
    parts, off = places @ along / length, np.abs(along[0] * places[:, 1] - along[1] * places[:, 0]) / length
    inside = [v for v in range(sheet.vertices) if off[v] <= near < parts[v] < length - near]
    used = {v for face in sheet.faces for v in face}
    return sheet, [a, *sorted(used.intersection(inside), key=parts.__getitem__), b]


def _creased_between(sheet: Sheet, p: int, q: int, letter: str) -> Sheet:
    """Crease a sheet between two vertices with no edge across: make the edge a crease, or split the face there."""
    there = [i for i, edge in enumerate(sheet.edges) if set(edge) == {p, q}]
    if there:
        letters = "".join(letter if i in there and old in FLAT else old for i, old in enumerate(sheet.assignments))
        return replace(sheet, assignments=letters)
    shared = [i for i, face in enumerate(sheet.faces) if p in face and q in face]
    if _is_flat(sheet):
        shared = [i for i in shared if _holds_middle(sheet, i, p, q)]
    if len(shared) != 1:
        of = "no face" if not shared else f"{len(shared)} faces"
        between = f"between {vertex_in_words(sheet, p)} and {vertex_in_words(sheet, q)}"
        raise UnsolvableError(
            f"{between} the crease lies in {of}, not in one: it would leave the sheet, or cross edges"
        )
    (face,) = shared
    around = sheet.faces[face]
    i, j = around.index(p), around.index(q)
    turned = around[i:] + around[:i]
    cut = (j - i) % len(around)
    faces = list(sheet.faces)
    faces[face] = turned[: cut + 1]
    angles = sheet.fold_angles
    return replace(
        sheet,
        edges=(*sheet.edges, (p, q)),
        assignments=sheet.assignments + letter,
        faces=(*faces, (*turned[cut:], p)),
        fold_angles=None if angles is None else (*angles, None),
    )


def _holds_middle(sheet: Sheet, face: int, p: int, q: int) -> bool:
    """Return whether the middle of two vertices is inside a face of a flat sheet."""
    import shapely

    assert sheet.coordinates is not None
    middle = (np.array(sheet.coordinates[p][:2]) + sheet.coordinates[q][:2]) / 2
    around = shapely.Polygon([sheet.coordinates[v][:2] for v in sheet.faces[face]])
    return bool(around.contains(shapely.Point(middle)))
