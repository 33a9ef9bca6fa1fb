"""A crease pattern in other guises: renamed, mirrored, in other units, its creases in pieces, its panels joined.

Each guise is the same thing, so the verdict has to be the same. It knows which edge of the pattern each of its edges
is, or is a piece of.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from decimal import Decimal

import numpy as np

from graphs.mechanism.precision import in_space, precision_of_sheet
from graphs.mechanism.sheet import FLAT, Sheet, sides_of_face, with_all_edges

__all__ = ["COMPARED_WITH", "GUISES", "NOT_COMPARED", "Guise", "guises_of"]

EdgeKey = frozenset[int]
_EXACT = 1e-12
_INCH = 25.4


@dataclass(frozen=True, slots=True)
class Guise:
    """A sheet, and for edges of it (as sets of two vertices) the edge of the pattern that they are part of."""

    sheet: Sheet
    edges: Mapping[EdgeKey, EdgeKey]


def guises_of(pattern: Sheet, names: Iterable[str] | None = None) -> Iterator[tuple[str, Guise]]:
    """Yield a pattern as it is and in each guise that applies to it, or only in some and what these are compared with."""
    whole = replace(with_all_edges(pattern), frames=None)
    wanted = None if names is None else {*names, "as it is", *(COMPARED_WITH.get(name, "") for name in names)}
    for name, make in GUISES.items():
        guise = make(whole) if wanted is None or name in wanted else None
        if guise is not None:
            yield name, guise


def _as_it_is(sheet: Sheet) -> Guise:
    return Guise(sheet, _same_edges(sheet))


def _same_edges(sheet: Sheet) -> dict[EdgeKey, EdgeKey]:
    return {frozenset(edge): frozenset(edge) for edge in sheet.edges}


def _renamed(seed: int, *, turn_faces: bool = False) -> Callable[[Sheet], Guise]:
    """Return a guise with vertices, edges and faces in another order; face lists begin elsewhere, some go round the
    other way."""

    def guise(sheet: Sheet) -> Guise:
        rng = np.random.default_rng(seed)
        was = rng.permutation(sheet.vertices).tolist()  # new number -> old
        now = {old: new for new, old in enumerate(was)}
        edge_order = rng.permutation(len(sheet.edges)).tolist()
        face_order = rng.permutation(len(sheet.faces)).tolist()
        assert sheet.coordinates is not None
        edges = [tuple(now[v] for v in sheet.edges[e]) for e in edge_order]
        edges = [edge[::-1] if rng.random() < 0.5 else edge for edge in edges]
        faces = []
        for face in face_order:
            around = [now[v] for v in sheet.faces[face]]
            first = int(rng.integers(len(around)))
            around = around[first:] + around[:first]
            faces.append(tuple(around[::-1] if turn_faces and rng.random() < 0.5 else around))
        if turn_faces:  # marks are read with the first face as it is listed
            first_was = [now[v] for v in sheet.faces[face_order[0]]]
            if not _same_way(faces[0], first_was):
                faces[0] = faces[0][::-1]
        angles = sheet.fold_angles
        renamed = replace(
            sheet,
            edges=tuple(edges),
            assignments="".join(sheet.assignments[e] for e in edge_order),
            faces=tuple(faces),
            coordinates=tuple(sheet.coordinates[v] for v in was),
            fold_angles=None if angles is None else tuple(angles[e] for e in edge_order),
        )
        return Guise(renamed, {frozenset(e): frozenset(was[v] for v in e) for e in edges})

    return guise


def _same_way(around: tuple[int, ...], other: list[int]) -> bool:
    return set(sides_of_face(around)) == set(sides_of_face(other))


def _mirrored(sheet: Sheet) -> Guise:
    """Mountains stay mountains, seen from above."""
    places = tuple((-place[0], *place[1:]) for place in sheet.coordinates or ())
    faces = tuple(face[::-1] for face in sheet.faces)
    return Guise(replace(sheet, coordinates=places, faces=faces), _same_edges(sheet))


def _turned_over(sheet: Sheet) -> Guise:
    """Seen from below: mountains are valleys."""
    angles = sheet.fold_angles
    guise = replace(
        _mirrored(sheet).sheet,
        assignments=sheet.assignments.translate(str.maketrans("MV", "VM")),
        fold_angles=None if angles is None else tuple(None if one is None else -one for one in angles),
        coordinates=tuple((-x, y, *(-z for z in rest)) for x, y, *rest in sheet.coordinates or ()),
    )
    return Guise(guise, _same_edges(sheet))


def _scaled(factor: float, shift: int) -> Callable[[Sheet], Guise]:
    """Return a guise in another unit; rounded coordinates keep their digits, with the point elsewhere."""

    def guise(sheet: Sheet) -> Guise:
        exact = _is_exact(sheet)

        def one(number: float) -> float:
            return factor * number if exact else float(Decimal(repr(float(number))).scaleb(shift))

        places = tuple(tuple(map(one, place)) for place in sheet.coordinates or ())
        unit, written = factor if exact else 10.0**shift, sheet.precision
        precision = None if written is None else replace(written, length=unit * written.length)
        scaled = replace(sheet, coordinates=places, spread=unit * sheet.spread, precision=precision)
        return Guise(scaled, _same_edges(sheet))

    return guise


def _is_exact(sheet: Sheet) -> bool:
    return precision_of_sheet(sheet).size <= _EXACT


def _in_pieces(sheet: Sheet) -> Guise | None:
    """Every other edge is two edges that meet in its middle; rounded coordinates could not say where that is."""
    if not _is_exact(sheet):
        return None
    places = [np.array(place) for place in sheet.coordinates or ()]
    middle: dict[EdgeKey, int] = {}
    edges, letters, angles, of = [], [], [], {}
    for number, (a, b) in enumerate(sheet.edges):
        key = frozenset((a, b))
        parts = [(a, b)]
        if number % 2 and key not in middle:
            middle[key] = len(places)
            places.append((places[a] + places[b]) / 2.0)
            parts = [(a, middle[key]), (middle[key], b)]
        for part in parts:
            edges.append(part)
            letters.append(sheet.assignments[number])
            angles.append(None if sheet.fold_angles is None else sheet.fold_angles[number])
            of[frozenset(part)] = key
    faces = []
    for face in sheet.faces:
        around: list[int] = []
        for a, b in sides_of_face(face):
            around += [a, *([middle[frozenset((a, b))]] if frozenset((a, b)) in middle else [])]
        faces.append(tuple(around))
    guise = replace(
        sheet,
        vertices=len(places),
        edges=tuple(edges),
        assignments="".join(letters),
        faces=tuple(faces),
        coordinates=tuple(tuple(place.tolist()) for place in places),
        fold_angles=None if sheet.fold_angles is None else tuple(angles),
    )
    return Guise(guise, of)


def _in_triangles(sheet: Sheet) -> Guise | None:
    """Panels are cut into triangles that joins (J) hold together."""
    points = in_space(sheet.coordinates or ())
    faces: list[tuple[int, ...]] = []
    joins: list[tuple[int, int]] = []
    sides = {frozenset(edge) for edge in sheet.edges}
    for face in sheet.faces:
        triangles = _ears(face, points)
        cuts = Counter(frozenset(side) for one in triangles for side in sides_of_face(one))
        new = [tuple(sorted(cut)) for cut, times in cuts.items() if times == 2]
        if sides & set(map(frozenset, new)) or len(triangles) != len(face) - 2:
            faces.append(face)
            continue
        faces += triangles
        joins += new
        sides |= set(map(frozenset, new))
    if not joins:
        return None
    angles = sheet.fold_angles
    guise = replace(
        sheet,
        edges=(*sheet.edges, *joins),
        assignments=sheet.assignments + "J" * len(joins),
        faces=tuple(faces),
        fold_angles=None if angles is None else (*angles, *(0.0,) * len(joins)),
    )
    return Guise(guise, _same_edges(sheet))


def _ears(face: tuple[int, ...], points: np.ndarray) -> list[tuple[int, ...]]:
    """Return the triangles of a simple polygon, cut off one after the other; the list ends where none can be."""
    corners = points[list(face)]
    normal = np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    size = np.linalg.norm(normal)
    rest, triangles = list(face), []
    while len(rest) > 3:
        for place in range(len(rest)):
            a, b, c = rest[place - 1], rest[place], rest[(place + 1) % len(rest)]
            if _area(points[[a, b, c]], normal) <= 1e-6 * size**2:
                continue
            others = [v for v in rest if v not in (a, b, c)]
            if any(_inside(points[v], points[[a, b, c]], normal, size) for v in others):
                continue
            triangles.append((a, b, c))
            rest.pop(place)
            break
        else:
            return []
    if _area(points[rest], normal) <= 1e-6 * size**2:
        return []
    return [*triangles, tuple(rest)]


def _area(corners: np.ndarray, normal: np.ndarray) -> float:
    return float(np.cross(corners[1] - corners[0], corners[2] - corners[0]) @ normal)


def _inside(point: np.ndarray, corners: np.ndarray, normal: np.ndarray, size: float) -> bool:
    sides = zip(corners, np.roll(corners, -1, axis=0), strict=True)
    return all(float(np.cross(b - a, point - a) @ normal) >= -1e-9 * size**2 for a, b in sides)


def _without_joins(sheet: Sheet) -> Guise | None:
    """Faces that a flat edge or a join parts are one, where they share no other edge."""
    faces: list[tuple[int, ...]] = list(sheet.faces)
    gone = set()
    for number, (edge, letter) in enumerate(zip(sheet.edges, sheet.assignments, strict=True)):
        if letter not in FLAT:
            continue
        beside = [one for one in faces if frozenset(edge) in set(map(frozenset, sides_of_face(one)))]
        if len(beside) != 2 or len(set(beside[0]) & set(beside[1])) != 2:
            continue
        one, other = beside
        if edge in sides_of_face(one) and edge in sides_of_face(other):
            other = other[::-1]
        if edge not in sides_of_face(one):
            one, other = other, one
        if edge not in sides_of_face(one) or edge[::-1] not in sides_of_face(other):
            continue
        start, end = one.index(edge[1]), other.index(edge[0])
        joined = (*one[start:], *one[:start], *(other[end:] + other[:end])[1:-1])
        faces = [face for face in faces if face not in beside]
        faces.append(joined)
        gone.add(number)
    if not gone:
        return None
    kept = [number for number in range(len(sheet.edges)) if number not in gone]
    angles = sheet.fold_angles
    guise = replace(
        sheet,
        edges=tuple(sheet.edges[number] for number in kept),
        assignments="".join(sheet.assignments[number] for number in kept),
        faces=tuple(faces),
        fold_angles=None if angles is None else tuple(angles[number] for number in kept),
    )
    return Guise(guise, _same_edges(sheet))


def _unmarked(sheet: Sheet) -> Guise | None:
    if set(sheet.assignments) - set("BMVU") or sheet.fold_angles is not None:
        return None
    guise = replace(sheet, assignments=sheet.assignments.translate(str.maketrans("MV", "UU")))
    return Guise(guise, _same_edges(sheet))


def _not_listed(sheet: Sheet) -> Guise | None:
    """Without its edges: they are the sides of faces."""
    if _unmarked(sheet) is None:
        return None
    return Guise(replace(sheet, edges=(), assignments=""), _same_edges(sheet))


GUISES: dict[str, Callable[[Sheet], Guise | None]] = {
    "as it is": _as_it_is,
    "renamed": _renamed(1),
    "renamed, faces turned": _renamed(2, turn_faces=True),
    "mirrored": _mirrored,
    "turned over": _turned_over,
    "larger unit": _scaled(1.0 / _INCH, -1),
    "smaller unit": _scaled(1000.0 / 3.0, 2),
    "in pieces": _in_pieces,
    "in triangles": _in_triangles,
    "without joins": _without_joins,
    "without assignment": _unmarked,
    "edges not listed": _not_listed,
}
"""Each guise by its name."""

COMPARED_WITH = {"edges not listed": "without assignment"}
"""The guise that another is compared with, where that is not the pattern as it is."""
NOT_COMPARED = ("as it is", "without assignment")
