"""A sheet: vertices, edges and faces of a crease pattern, with the repairs and the precision of its file.

The mechanism it is: :mod:`graphs.convert.duality`. Theory: docs/theory/crease-patterns.md.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, field, replace
from itertools import chain
from math import isfinite
from typing import Any, Literal, Protocol, TypeAlias, TypeVar

import numpy as np

from graphs.errors import InvariantError, numbered, shown
from graphs.input_limits import check_area, check_extent
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.types import Floats, Ints

Place: TypeAlias = tuple[tuple[float, ...], ...]
"""A point, both ends of a line, or the corners of a face, in the coordinates of the sheet."""

RepairKind: TypeAlias = Literal[
    "crossing split",
    "line split at an end",
    "ends welded",
    "line drawn twice",
    "line of no length",
    "line pruned",
    "vertex taken out",
    "hole",
]

_FIRST = 3  # places that a line names: enough to find them in the drawing, and the line is read to its end


@dataclass(frozen=True, slots=True)
class Repair:
    """Repairs of one kind.

    `what` names them with their number, as `Sheet.repairs` does. The places are those of all.
    """

    kind: RepairKind
    what: str
    places: tuple[Place, ...]

    def to_json(self) -> dict[str, Any]:
        """Return plain data; a place is a list of one point, two ends, or the corners of a face."""
        places = [[list(point) for point in place] for place in self.places]
        return {"kind": self.kind, "what": self.what, "places": places}

    def __str__(self) -> str:
        """Return the repairs with their first places."""
        first = ", ".join(_place_text(place) for place in self.places[:_FIRST])
        more = f" and {len(self.places) - _FIRST} more" if len(self.places) > _FIRST else ""
        return f"{self.what}: {first}{more}" if first else self.what


@dataclass(frozen=True, slots=True)
class Reading:
    """What was done to a drawing when it was read.

    `left_out` says which strokes were not understood; empty if all were.
    """

    repairs: tuple[Repair, ...] = ()
    left_out: str = ""

    @property
    def warning(self) -> str:
        """The warning that the pattern is not the whole drawing; empty if it is."""
        return f"{self.left_out}; state what they are by --colour or --layer" if self.left_out else ""

    def with_places(self, note: str) -> str:
        """Return a repair with its first places where they are known."""
        return next((str(repair) for repair in self.repairs if repair.what == note), note)

    def to_json(self) -> dict[str, Any]:
        """Return the key ``reading`` of an answer (docs/command-json.md)."""
        return {"left_out": self.left_out or None, "repairs": [repair.to_json() for repair in self.repairs]}


@dataclass(frozen=True, slots=True)
class WrittenPrecision:
    """The error that a coordinate may have, as it is written.

    ``length`` (`InvariantError` if negative, or not finite) is in the unit of the coordinates, ``source`` says how
    it is known: ``2 decimals``, ``stated``. If it is ``stated`` by the user, it is not judged by the geometry.
    """

    length: float
    source: str
    stated: bool = False

    def __post_init__(self) -> None:
        if not (isfinite(self.length) and self.length >= 0.0):
            raise InvariantError("precision", f"the precision is {self.length:g}", "a length, zero or more")


def _place_text(place: Place) -> str:
    points = ["({})".format(", ".join(f"{x + 0.0:.6g}" for x in point)) for point in place]
    if len(points) == 2:
        return f"from {points[0]} to {points[1]}"
    return f"at {points[0]}" if len(points) == 1 else f"round {points[0]}"


COLLINEAR = 1e-6
"""Points are in one line or plane if they lie this close to it, in units of their extent.

It is the tight tolerance: of hinges, coarser ones are tried too (``graphs.convert.hinges``).
"""
HINGES = "MVU"
"""Edge assignments that are hinges: mountain, valley, unassigned."""
FLAT = "FJ"
"""Edge assignments that hinge nothing: flat, and joins between parts of one panel."""

V = TypeVar("V")

Edge = tuple[int, int]


class Frames(Protocol):
    """The frames of the file that a sheet was read from: the same sheet in other configurations."""

    @property
    def others(self) -> int:
        """How many there are besides the key frame."""

    @property
    def unit(self) -> str | None:
        """The name of the unit of length in the file; None where it has none."""

    @property
    def left_out(self) -> tuple[str, ...]:
        """Names of further data of the file that the sheet does not hold."""

    def frame(self, number: int) -> Sheet:
        """Return the sheet of one frame; 0 is the key frame."""

    def first_placed(self) -> Sheet:
        """Return the sheet as it was read, or if that has no coordinates, of the first frame that has."""


@dataclass(frozen=True, repr=False)
class Sheet:
    """Vertices, edges with their assignments, and faces.

    Parameters
    ----------
    vertices : int
        How many; they are 0, 1, 2, ...
    edges : tuple of (vertex, vertex)
    assignments : str
        One letter per edge, as in FOLD: B border, M mountain, V valley, F flat, U unassigned, C cut, J join.
    faces : tuple of vertex cycles
    coordinates : tuple of (x, y) or (x, y, z), optional
        One for each vertex.
    title : str
    repairs : tuple of str
        What was repaired on reading.
    fold_angles : tuple of float or None, optional
        One for each edge, in radians; None where an edge has none.
    spread : float, optional
        Mean distance of points that were made one vertex, in the length unit of the coordinates.
    precision : WrittenPrecision, optional
        How precise the coordinates are as they are written or stated.
    frames : Frames, optional
        The frames of the file it was read from.
    reading : Reading, optional
        What was done to the drawing it was read from, with places. Equality of sheets does not depend on the last
        four.

    Raises
    ------
    InvariantError
        For an edge or face that names an unknown vertex, an edge from a vertex to itself, coordinates out of the
        range of `graphs.input_limits`, or faces whose vertices all lie in one line.

    Examples
    --------
    >>> from graphs.convert.duality import mechanism_of_sheet
    >>> square = Sheet(4, ((0, 1), (1, 2), (2, 3), (3, 0), (0, 2)), "BBBBV", ((0, 1, 2), (0, 2, 3)))
    >>> len(mechanism_of_sheet(square).sc.joints)
    1
    """

    vertices: int
    edges: tuple[Edge, ...]
    assignments: str
    faces: tuple[tuple[int, ...], ...]
    coordinates: tuple[tuple[float, ...], ...] | None = None
    title: str = ""
    repairs: tuple[str, ...] = ()
    fold_angles: tuple[float | None, ...] | None = None
    frames: Frames | None = field(default=None, compare=False)
    spread: float = field(default=0.0, compare=False)
    reading: Reading | None = field(default=None, compare=False)
    precision: WrittenPrecision | None = field(default=None, compare=False)

    def __post_init__(self) -> None:
        _check_vertices(self.edges, self.vertices, "edge")
        for i, (a, b) in enumerate(self.edges):
            if a == b:
                raise InvariantError("edge", f"edge {i} goes from vertex {a} to itself", part=("edges", i))
        _check_vertices(self.faces, self.vertices, "face")
        for i, face in enumerate(self.faces):
            if len(set(face)) < max(3, len(face)):
                raise InvariantError(
                    "face", f"face {i} has the vertices {shown(list(face))}", "three or more, each once", ("faces", i)
                )
        if self.coordinates is not None:
            check_extent(self.coordinates)
            if self.faces:
                check_area(self.coordinates)

    def with_frames(self, frames: Frames) -> Sheet:
        """Return the sheet with the frames of its file; what was checked is not checked again."""
        sheet = copy(self)
        object.__setattr__(sheet, "frames", frames)
        return sheet

    def placed(self, coordinates: Floats, fold_angles: Sequence[float | None] | None) -> Sheet:
        """Return the sheet with vertices elsewhere, float[V, 2 or 3], and no frames; creases and faces are the same.

        These are not checked again.
        """
        sheet = copy(self)
        places = tuple(map(tuple, coordinates.tolist()))
        check_extent(places)
        if self.faces:
            check_area(places)
        object.__setattr__(sheet, "coordinates", places)
        object.__setattr__(sheet, "fold_angles", None if fold_angles is None else tuple(fold_angles))
        object.__setattr__(sheet, "frames", None)
        return sheet

    def __repr__(self) -> str:
        creases = sum(map(self.assignments.count, HINGES))
        lies = "no coordinates"
        if self.coordinates is not None:
            heights = {place[2:] for place in self.coordinates}
            lies = "flat" if len(heights) < 2 else "in space"
        parts = [numbered(len(self.faces), "face"), numbered(creases, "crease")]
        return f"<Sheet: {', '.join(parts)}, {numbered(self.vertices, 'vertex', 'vertices')}, {lies}>"


def sheet_from_model(model: PolyhedronModel) -> Sheet:
    """Return the sheet whose faces are the links of a polyhedron model, with its coordinates.

    Parameters
    ----------
    model : PolyhedronModel
        Rods between two links become unassigned creases; raises `InvariantError` if it does not know its links.

    Examples
    --------
    >>> model = PolyhedronModel(4, [(0, 1), (1, 2), (2, 0), (1, 3), (3, 2)], links={0: (0, 1, 2), 1: (1, 3, 2)})
    >>> sheet_from_model(model).assignments
    'BUBBB'
    """
    if not model.links:
        raise InvariantError("links", "the polyhedron model does not say which vertices make up a link")
    number = {vertex: i for i, vertex in enumerate(model.nodes)}
    faces = tuple(tuple(number[v] for v in around) for around in model.links.values())
    sides = Counter(frozenset(side) for face in faces for side in sides_of_face(face))
    edges = tuple((min(side), max(side)) for side in sides)
    coordinates = tuple(model.coordinates[v] for v in model.nodes) if model.coordinates else None
    assignments = "".join("B" if number == 1 else "U" for number in sides.values())
    return Sheet(len(model), edges, assignments, faces, coordinates)


def with_all_edges(sheet: Sheet) -> Sheet:
    """Return the sheet with every side of a face listed as an edge, as the mechanism takes it.

    Sides between two faces that were not listed are unassigned creases, in the order of the faces, and come first:
    their places in the list are the ids of their joints. Other sides are borders.
    """
    listed = {(a, b) if a < b else (b, a) for a, b in sheet.edges}
    sides = Counter((a, b) if a < b else (b, a) for face in sheet.faces for a, b in sides_of_face(face))
    missing = [(side, faces) for side, faces in sides.items() if side not in listed]
    if not missing:
        return sheet
    creases = tuple(side for side, faces in missing if faces > 1)
    borders = tuple(side for side, faces in missing if faces == 1)
    angles = sheet.fold_angles
    return replace(
        sheet,
        edges=(*sheet.edges, *creases, *borders),
        assignments=sheet.assignments + "U" * len(creases) + "B" * len(borders),
        fold_angles=None if angles is None else (*angles, *(None,) * len(missing)),
    )


def sides_of_face(face: Sequence[V]) -> list[tuple[V, V]]:
    """Return the sides of a face, each from a vertex to the next."""
    return list(zip(face, (*face[1:], face[0]), strict=True))


def corners_of_faces(faces: Sequence[Sequence[int]]) -> tuple[Ints, Ints, Ints]:
    """Return of all corners, face by face: the vertex, the place of the next corner of the face, and the face."""
    sizes = np.array([len(face) for face in faces], dtype=np.int64)
    vertex = np.fromiter(chain.from_iterable(faces), dtype=np.int64, count=int(sizes.sum()))
    after = np.arange(1, len(vertex) + 1)
    last = np.cumsum(sizes) - 1
    after[last] = last - sizes + 1
    return vertex, after, np.repeat(np.arange(len(sizes)), sizes)


def panel_of_faces(panels: Sequence[Sequence[int]]) -> Ints:
    """Return the panel of each face by the faces of each panel: int[faces]."""
    sizes = np.array([len(faces) for faces in panels], dtype=np.int64)
    panel_of = np.empty(int(sizes.sum()), dtype=np.int64)
    panel_of[list(chain.from_iterable(panels))] = np.repeat(np.arange(len(sizes)), sizes)
    return panel_of


def _check_vertices(rows: Sequence[Sequence[int]], count: int, who: str) -> None:
    """Refuse the first edge or face that names a vertex that is not there."""
    named = set(chain.from_iterable(rows))
    if not named or (min(named) >= 0 and max(named) < count):
        return
    for i, row in enumerate(rows):
        for vertex in row:
            if not 0 <= vertex < count:
                raise InvariantError(
                    "vertex", f"{who} {i} names vertex {vertex}", f"a vertex from 0 to {count - 1}", (f"{who}s", i)
                )
