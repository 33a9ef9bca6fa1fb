"""FOLD files, 1.0 to 1.2: the frame that holds the pattern; faces that are not given are traced.

Read as a :class:`graphs.mechanism.sheet.Sheet`, whose mechanism follows by duality; written from a sheet. The
format is described at https://github.com/edemaine/fold; keys this reader does not know are left alone, as FOLD
demands, and told of when the sheet is written (:mod:`graphs.files.losses`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import chain
from math import isclose
from pathlib import Path
from typing import Any, cast

import numpy as np

from graphs.convert.loose_creases import creases_on_no_face, joins_faces, traced_anew
from graphs.errors import FileError, numbered
from graphs.files.check import Checker
from graphs.files.patterns.fold_frames import resolved_frame
from graphs.files.patterns.simple import with_simple_faces
from graphs.files.text import json_text, load_json
from graphs.limits import most
from graphs.mechanism.precision import flattened, written_by
from graphs.mechanism.sheet import FLAT, HINGES, Edge, Sheet, WrittenPrecision

__all__ = ["FoldFrames", "fold_text", "read_fold", "sheet_from_fold"]

_FAR = 1e300
_SPREAD = "synthedra:spread"
"""Own key: how far points were apart that were welded in tracing; centres and hinges hang on it."""
_PRECISION = "synthedra:precision"
"""Own key: the error that a coordinate may have, in the unit of the coordinates."""
_ASSIGNMENTS = HINGES + FLAT + "BC"
_TITLES = ("frame_title", "file_title")
"""The first that is there is the title."""
_HELD = {
    *("vertices_coords", "edges_vertices", "edges_assignment", "edges_foldAngle", "faces_vertices"),
    *(_SPREAD, _PRECISION),
}
"""Keys that a sheet holds."""
_NOTHING_NEW = {
    *("file_spec", "file_creator", "file_classes", "file_frames"),
    *("frame_attributes", "frame_inherit", "frame_parent"),
    *("vertices_vertices", "vertices_edges", "vertices_faces", "edges_edges", "edges_faces"),
    *("faces_edges", "faces_faces"),
}
"""Keys that speak of the file itself, or follow from those that are held; other frames are told by number."""


@dataclass(frozen=True)
class FoldFrames:
    """The frames of a FOLD file.

    `sheet` is that of the file when no frame is chosen, `unit` is its ``frame_unit``, and `left_out` are the keys
    of its frame that it does not hold. `document` is the parsed file, None if it has the key frame only.
    """

    path: Path
    sheet: Sheet
    document: Mapping[str, Any] | None
    left_out: tuple[str, ...]
    unit: str | None = None

    @property
    def others(self) -> int:
        """How many there are besides the key frame."""
        return 0 if self.document is None else len(self.document["file_frames"])

    def frame(self, number: int) -> Sheet:
        """Return the sheet of one frame, 0 for the key frame; FileError if there is no such frame."""
        if self.document is not None:
            return sheet_from_fold(self.document, self.path, number)
        if number:
            raise FileError(self.path, "", f"no frame {number}", "a frame from 0 to 0")
        return self.sheet

    def first_placed(self) -> Sheet:
        """Return the sheet as it was read, or if that has no coordinates, of the first frame that has."""
        if self.sheet.coordinates is not None or self.document is None:
            return self.sheet
        for number, frame in enumerate(self.document["file_frames"], start=1):
            if {**self.document, **frame}.get("vertices_coords"):
                placed = self.frame(number)
                if placed.coordinates is not None:
                    return placed
        return self.sheet


def read_fold(path: Path) -> Sheet:
    """Read a FOLD file; the sheet knows the frames of its file. The errors are those of `sheet_from_fold`."""
    document, check = load_json(path), Checker(path)
    frame, notes = _frame(document, check)
    sheet = _sheet(frame, notes, check)
    more = document if document.get("file_frames") else None
    of_file = {key: value for key, value in document.items() if key.startswith("file_") and value is not None}
    unit = frame.get("frame_unit")
    if unit is not None and not isinstance(unit, str):
        check.fail("frame_unit", unit, "the name of a unit")
    return sheet.with_frames(FoldFrames(path, sheet, more, _left_out(of_file | frame, sheet.title), unit))


def sheet_from_fold(value: Any, path: Path, frame: int | None = None) -> Sheet:
    """Build a sheet from a parsed FOLD document: from one frame, or by default the first that has a pattern.

    A FileError names the place if the document is no FOLD file.
    """
    check = Checker(path)
    return _sheet(*_frame(value, check, frame), check)


def _frame(document: Any, check: Checker, number: int | None = None) -> tuple[dict[str, Any], list[str]]:
    """Return a frame of a FOLD document with what it inherits, and notes on how it was found."""
    if not isinstance(document, dict):
        check.fail("", document, "a FOLD document (an object)")
    return resolved_frame(document, check, number)


def _left_out(frame: dict[str, Any], title: str) -> tuple[str, ...]:
    """Return the keys of a frame and its file that hold what the sheet, and its title, do not."""
    held = {*_HELD, *_NOTHING_NEW, *(key for key in _TITLES if frame.get(key) == title)}
    return tuple(key for key in frame if key not in held)


def _title(frame: dict[str, Any]) -> str:
    title = next((frame[key] for key in _TITLES if key in frame), "")
    return title if isinstance(title, str) else ""


def _sheet(value: dict[str, Any], notes: list[str], check: Checker) -> Sheet:
    """Build the sheet of a frame."""
    path = check.path
    faces = _indices(value.get("faces_vertices", []), "faces_vertices", check)
    edges = _indices(value.get("edges_vertices", []), "edges_vertices", check)
    for i, edge in enumerate(edges):
        if len(edge) != 2:
            raise FileError(path, f"edges_vertices[{i}]", f"{len(edge)} vertices", "two")
    coordinates = _coordinates(value.get("vertices_coords", []), check)
    vertices = len(coordinates) or 1 + max((v for row in (*faces, *edges) for v in row), default=-1)
    assignments, repairs = _assignments(value, len(edges), check)
    sheet = check.build(
        lambda: with_simple_faces(
            Sheet(
                vertices,
                cast("tuple[Edge, ...]", edges),
                assignments,
                faces,
                coordinates or None,
                _title(value),
                (*notes, *repairs),
                _fold_angles(value, len(edges), check),
                spread=abs(check.number(value.get(_SPREAD, 0), _SPREAD)),
                precision=_precision(value, coordinates, check),
            )
        ),
        lambda part: f"{part[0]}_vertices[{part[1]}]",
    )
    if not faces:
        return _traced(sheet, check)
    return _with_all_creases(sheet, check) if "edges_assignment" in value else sheet


def _traced(sheet: Sheet, check: Checker) -> Sheet:
    """Trace the faces of a pattern that comes without; it must be flat."""
    from graphs.convert.tracing import MOST  # tracing loads shapely
    from graphs.convert.welding import Lines
    from graphs.files.patterns.traced import traced_sheet

    if not sheet.edges or sheet.coordinates is None:
        raise FileError(check.path, "faces_vertices", "missing", "faces, or edges with coordinates to trace them")
    if any(abs(x) >= MOST for place in sheet.coordinates for x in place):
        raise FileError(
            check.path, "vertices_coords", "a number too large to trace faces", f"less than {MOST:.0e}"
        )
    flat = flattened(sheet)
    if flat is None:
        raise FileError(check.path, "faces_vertices", "missing, and the pattern is not flat", "the faces")
    ends = flat.places[np.array(sheet.edges)]
    lines = Lines(ends, sheet.assignments, sheet.fold_angles)
    found = traced_sheet(lines, check, title=sheet.title, precision=sheet.precision)
    turned = (flat.turned,) if flat.turned else ()
    return replace(found, repairs=("faces traced", *turned, *sheet.repairs, *found.repairs))


def _with_all_creases(sheet: Sheet, check: Checker) -> Sheet:
    """Trace a pattern anew if creases of it lie on no face, where that can be done."""
    loose = creases_on_no_face(sheet)
    if not loose:
        return sheet
    found = check.build(lambda: traced_anew(sheet))
    if found is not None and joins_faces(found):
        return replace(
            found, repairs=(f"{numbered(loose, 'crease line')} on no face: faces traced anew", *found.repairs)
        )
    if not joins_faces(sheet):
        wrong = f"{numbered(loose, 'crease line')} on no face, and none between two faces"
        raise FileError(check.path, "faces_vertices", wrong, "faces that have the creases as sides")
    return sheet


def fold_text(sheet: Sheet) -> str:
    """Return the text of a FOLD 1.2 file; without coordinates the frame is marked abstract."""
    document: dict[str, Any] = {
        "file_spec": 1.2,
        "file_creator": "synthedra",
        "file_classes": ["singleModel"],
    }
    if sheet.title:
        document["frame_title"] = sheet.title
    if sheet.spread:
        document[_SPREAD] = sheet.spread
    if _hides_precision(sheet):
        document[_PRECISION] = sheet.precision.length  # type: ignore[union-attr]
    if sheet.coordinates is None:
        document["frame_attributes"] = ["abstract"]
    else:
        document["frame_attributes"] = [f"{len(sheet.coordinates[0]) if sheet.coordinates else 2}D"]
        document["vertices_coords"] = [list(place) for place in sheet.coordinates]
    document["edges_vertices"] = [list(edge) for edge in sheet.edges]
    document["edges_assignment"] = list(sheet.assignments)
    if sheet.fold_angles is not None:
        document["edges_foldAngle"] = list(sheet.fold_angles)
    document["faces_vertices"] = [list(face) for face in sheet.faces]
    return json_text(document)


def _hides_precision(sheet: Sheet) -> bool:
    """Tell whether the precision of a sheet is known, and its numbers do not say the same."""
    if sheet.precision is None or sheet.coordinates is None:
        return False
    told = written_by(np.array(sheet.coordinates))
    return sheet.precision.stated or told is None or not isclose(told.length, sheet.precision.length)


def _indices(value: Any, key: str, check: Checker) -> tuple[tuple[int, ...], ...]:
    rows = check.list(value, key)
    if not _all_between(rows, 0, most("nodes"), {int}):
        for i, row in enumerate(rows):
            place = f"{key}[{i}]"
            for k, v in enumerate(check.list(row, place, what="a list of vertices")):
                check.how_many(v, f"{place}[{k}]")
    return tuple(map(tuple, rows))


def _all_between(rows: list[Any], least: float, greatest: float, kinds: set[type]) -> bool:
    """Tell whether rows are lists of numbers of some kinds, at once: what is large is read at this speed.

    Where they are not, each is looked at closely to say which.
    """
    if not set(map(type, rows)) <= {list}:
        return False
    numbers = [*chain.from_iterable(rows)]
    return not numbers or (set(map(type, numbers)) <= kinds and least <= min(numbers) and max(numbers) <= greatest)


def _coordinates(value: Any, check: Checker) -> tuple[tuple[float, ...], ...]:
    rows = check.list(value, "vertices_coords")
    if not (_all_between(rows, -_FAR, _FAR, {int, float}) and set(map(len, rows)) <= {2, 3}):
        for i, row in enumerate(rows):
            place = f"vertices_coords[{i}]"
            listed = check.list(row, place, what="two or three numbers")
            if len(listed) not in (2, 3):
                raise FileError(check.path, place, f"{len(listed)} numbers", "two or three")
            for k, x in enumerate(listed):
                check.number(x, f"{place}[{k}]")
    width = max(map(len, rows), default=0)
    return tuple(tuple(map(float, row if len(row) == width else (*row, 0.0))) for row in rows)


def _precision(
    value: dict[str, Any], coordinates: tuple[tuple[float, ...], ...], check: Checker
) -> WrittenPrecision | None:
    """Return the precision that a frame states, or else that its digits have."""
    if _PRECISION in value:
        length = check.number(value[_PRECISION], _PRECISION)
        if length < 0.0:
            check.fail(_PRECISION, length, "a length, zero or more")
        return WrittenPrecision(length, f"stated by {_PRECISION}", stated=True)
    return written_by(np.array(coordinates)) if coordinates else None


def _assignments(value: dict[str, Any], edges: int, check: Checker) -> tuple[str, tuple[str, ...]]:
    if "edges_assignment" not in value:
        repairs = ("no edges_assignment: every side between two faces taken as a crease",) if edges else ()
        return "U" * edges, repairs
    letters = check.list(value["edges_assignment"], "edges_assignment", edges, f"a list of {edges}, one an edge")
    missing = sum(letter is None for letter in letters)
    letters = ["U" if letter is None else letter for letter in letters]
    if not (set(map(type, letters)) <= {str} and set(letters) <= set(_ASSIGNMENTS)):
        for i, letter in enumerate(letters):
            if not isinstance(letter, str) or letter not in set(_ASSIGNMENTS):
                check.fail(f"edges_assignment[{i}]", letter, "one of " + " ".join(_ASSIGNMENTS))
    return "".join(letters), ((f"{numbered(missing, 'null assignment')} read as unassigned",) if missing else ())


def _fold_angles(value: dict[str, Any], edges: int, check: Checker) -> tuple[float | None, ...] | None:
    if "edges_foldAngle" not in value:
        return None
    listed = check.list(value["edges_foldAngle"], "edges_foldAngle", edges, f"a list of {edges}, one an edge")
    if not _all_between([[x for x in listed if x is not None]], -_FAR, _FAR, {int, float}):
        for i, x in enumerate(listed):
            if x is not None:
                check.number(x, f"edges_foldAngle[{i}]")
    return tuple(None if x is None else float(x) for x in listed)
