"""Sheets from panels: corners at the same place are one vertex, sides are listed with their letters."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

from graphs.mechanism.sheet import Sheet, sides_of_face
from graphs.types import Floats

Place = tuple[float, ...]
Corners = Sequence[Place]

DIGITS = 14
"""Special proportions are kept to these: rounding more would close the loops at one configuration only."""
_SAME = 12
"""Corners are one vertex if they agree to so many decimals."""
_NONE: Mapping[frozenset[int], str] = MappingProxyType({})


def sheet_of_panels(panels: Sequence[Corners], title: str = "") -> Sheet:
    """Return the sheet of panels by the places of their corners; corners at the same place are one vertex."""
    number: dict[Place, int] = {}
    places: list[Place] = []
    faces = []
    for panel in panels:
        face = []
        for place in panel:
            near = tuple(round(x, _SAME) + 0.0 for x in place)
            if near not in number:
                number[near] = len(number)
                places.append(tuple(place))
            face.append(number[near])
        faces.append(tuple(face))
    return sheet_of_faces(places, faces, title)


def sheet_of_faces(
    places: Sequence[Place],
    faces: Sequence[tuple[int, ...]],
    title: str = "",
    letters: Mapping[frozenset[int], str] = _NONE,
) -> Sheet:
    """Return a sheet with every side of its faces listed, by the letters of pairs of vertices, else U or B."""
    sides: dict[frozenset[int], int] = {}
    for face in faces:
        for side in sides_of_face(face):
            sides[frozenset(side)] = sides.get(frozenset(side), 0) + 1
    edges = tuple((min(side), max(side)) for side in sides)
    marks = "".join(letters.get(side, "U") if number > 1 else "B" for side, number in sides.items())
    return Sheet(len(places), edges, marks, tuple(faces), tuple(map(tuple, places)), title)


def rounded_vector(vector: Sequence[float] | Floats, digits: int = DIGITS) -> tuple[float, float, float]:
    """Return a vector with its coordinates rounded to so many decimals."""
    x, y, z = (round(float(part), digits) + 0.0 for part in vector)
    return (x, y, z)


def rounded(sheet: Sheet, digits: int) -> Sheet:
    """Return a sheet with its coordinates rounded to so many decimals."""
    assert sheet.coordinates is not None
    return replace(sheet, coordinates=tuple(tuple(round(x, digits) + 0.0 for x in p) for p in sheet.coordinates))
