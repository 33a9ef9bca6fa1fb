"""FOLD files, 1.0 to 1.2: the frame that holds the pattern; missing faces are traced.

The format is described at https://github.com/edemaine/fold; keys this reader does not know are left alone, as FOLD
demands, and named when the sheet is written. A frame with ``frame_inherit`` takes every key it lacks from its
``frame_parent``, the key frame (0) or an earlier or later one.
"""

from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from math import inf, isclose, nan, radians
from pathlib import Path
from typing import Any, cast

import numpy as np

from graphs.convert.faces import creases_on_no_face, joins_faces, traced_anew, with_simple_faces
from graphs.errors import FileError, numbered
from graphs.files.text import Checker, json_text, load_json
from graphs.input_limits import most
from graphs.mechanism.precision import flattened, lies_flat, written_by
from graphs.mechanism.sheet import FLAT, HINGES, Edge, Sheet, WrittenPrecision

_OLD_NAMES = {
    "edges_foldAngles": "edges_foldAngle",
    "edges_lengths": "edges_length",
    "edges_crease_angle_os": "edges_foldAngle",
}
"""Names of FOLD 1.0 and of early Origami Simulator to those of today."""


def _frame(document: Any, check: Checker, frame: int | None = None) -> tuple[dict[str, Any], list[str]]:
    """Return the frame that holds the pattern, and notes on how it was found.

    It is the key frame (number 0) if that has edges or faces, else the first frame that does; or the chosen frame.
    """
    if not isinstance(document, dict):
        check.fail("", document, "a FOLD document (an object)")
    frames: list[Mapping[str, Any]] = [document]
    if document.get("file_frames") is not None:
        listed = check.list(document["file_frames"], "file_frames", what="a list of frames")
        for i, item in enumerate(listed):
            if not isinstance(item, dict):
                check.fail(f"file_frames[{i}]", item, "a frame (an object)")
        frames += listed
    notes: list[str] = []
    if frame is not None:
        if frame >= len(frames):
            raise FileError(check.path, "", f"no frame {frame}", f"a frame from 0 to {len(frames) - 1}")
        return _inherited(frames, frame, check, notes), list(dict.fromkeys(notes))
    which = _first_with_pattern(frames, check, notes)
    chosen = _inherited(frames, which, check, notes)
    if which:
        notes.append(f"the key frame is empty; frame {which} of {len(frames) - 1} was read")
    return chosen, list(dict.fromkeys(notes))


_PATTERN = ("faces_vertices", "edges_vertices")


def _first_with_pattern(frames: list[Mapping[str, Any]], check: Checker, notes: list[str]) -> int:
    """Return the number of the first frame that has faces or edges, its own or inherited; else 0."""
    has: dict[int, dict[str, bool]] = {}
    for index in range(len(frames)):
        for number in reversed(_ancestors(frames, index, check, has)):
            own, parent = _named_today(frames[number], notes), _parent(frames, number, check)
            above = {} if parent is None else has[parent]
            has[number] = {key: bool(own[key]) if key in own else above.get(key, False) for key in _PATTERN}
        if any(has[index].values()):
            return index
    return 0


def _ancestors(frames: list[Mapping[str, Any]], index: int, check: Checker, known: Container[int] = ()) -> list[int]:
    """Return a frame, its parent, and so on up to one that is known or inherits nothing."""
    chain: dict[int, None] = {}
    above: int | None = index
    while above is not None and above not in known:
        if above in chain:
            place = f"file_frames[{above - 1}].frame_parent"
            raise FileError(check.path, place, "frames inherit in a circle", "parents without a circle")
        chain[above] = None
        above = _parent(frames, above, check)
    return list(chain)


def _parent(frames: list[Mapping[str, Any]], index: int, check: Checker) -> int | None:
    frame = frames[index]
    if not index or frame.get("frame_inherit") is not True:
        return None
    place = f"file_frames[{index - 1}].frame_parent"
    return check.integer(frame.get("frame_parent", 0), place, most=len(frames) - 1)


def _inherited(frames: list[Mapping[str, Any]], index: int, check: Checker, notes: list[str]) -> dict[str, Any]:
    """Return a frame with what it inherits."""
    merged: dict[str, Any] = {}
    for ancestor in reversed(_ancestors(frames, index, check)):
        merged |= _named_today(frames[ancestor], notes)
    return merged


def _named_today(frame: Mapping[str, Any], notes: list[str]) -> dict[str, Any]:
    """Return a frame without old key names, null keys and the list of frames."""
    renamed = {}
    for key, value in frame.items():
        if key == "file_frames" or value is None:
            continue
        today = _OLD_NAMES.get(key, key)
        if today != key and today in frame:
            continue
        if today != key:
            notes.append(f"old key {key} read as {today}")
        renamed[today] = value
    return renamed


_FAR = 1e300  # what is larger is refused here, as no number, before arrays of it overflow; limits are checked later
_SPREAD = "synthedra:spread"
"""Own key: the distances of points welded in tracing; centres and hinges depend on it."""
_PRECISION = "synthedra:precision"
"""Own key: the error that a coordinate may have, in the unit of the coordinates."""
_ASSIGNMENTS = HINGES + FLAT + "BC"
_TITLES = ("frame_title", "file_title")
"""The first of these keys that a frame has is the title."""
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
"""Keys that speak of the file itself, or follow from those that are held; other frames are counted."""


@dataclass(frozen=True)
class FoldFrames:
    """The frames of a FOLD file.

    `sheet` is that of the file if no frame is chosen, `left_out` the keys of its frame that the sheet does not
    hold. `document` is the parsed file, None if it has the key frame only.
    """

    path: Path
    sheet: Sheet
    document: Mapping[str, Any] | None
    left_out: tuple[str, ...]
    unit: str | None = None

    @property
    def others(self) -> int:
        """The number of frames besides the key frame."""
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
    """Build a sheet from a parsed FOLD document: from one frame, or by default the first that has a pattern."""
    check = Checker(path)
    return _sheet(*_frame(value, check, frame), check)


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
    """Trace the faces of a pattern without faces; it must be flat."""
    from graphs.convert.tracing import MOST, Lines  # tracing loads shapely
    from graphs.files.patterns.lines import traced_sheet

    if not sheet.edges or sheet.coordinates is None:
        raise FileError(check.path, "faces_vertices", "missing", "faces, or edges with coordinates to trace them")
    if any(abs(x) >= MOST for place in sheet.coordinates for x in place):
        wrong = "a number too large to trace faces"
        raise FileError(check.path, "vertices_coords", wrong, f"less than {MOST:.0e}")
    flat = flattened(sheet)
    if flat is None:
        raise FileError(check.path, "faces_vertices", "missing, and the pattern is not flat", "the faces")
    ends = flat.places[np.array(sheet.edges)]
    lines = Lines(ends, sheet.assignments, sheet.fold_angles)
    traced = traced_sheet(lines, check, title=sheet.title, precision=sheet.precision)
    turned = (flat.turned,) if flat.turned else ()
    return replace(traced, repairs=("faces traced", *turned, *sheet.repairs, *traced.repairs))


def _with_all_creases(sheet: Sheet, check: Checker) -> Sheet:
    """Trace a pattern anew if creases of it lie on no face and that can be done."""
    loose = creases_on_no_face(sheet)
    if not loose:
        return sheet
    traced = check.build(lambda: traced_anew(sheet))
    if traced is not None and joins_faces(traced):
        note = f"{numbered(loose, 'crease line')} on no face: faces traced anew"
        return replace(traced, repairs=(note, *traced.repairs))
    if not joins_faces(sheet):
        wrong = f"{numbered(loose, 'crease line')} on no face, and none between two faces"
        raise FileError(check.path, "faces_vertices", wrong, "faces that have the creases as sides")
    return sheet


def fold_text(sheet: Sheet) -> str:
    """Return the text of a FOLD 1.2 file; without coordinates the frame is marked abstract."""
    return json_text(_document(sheet))


def _document(sheet: Sheet) -> dict[str, Any]:
    """Return the keys of a FOLD file of a sheet."""
    document: dict[str, Any] = {"file_spec": 1.2, "file_creator": "synthedra", "file_classes": ["singleModel"]}
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
        document["edges_foldAngle"] = _in_degrees(sheet.fold_angles)
    document["faces_vertices"] = [list(face) for face in sheet.faces]
    return document


def _hides_precision(sheet: Sheet) -> bool:
    """Return whether the precision of a sheet is known, and its digits do not say the same."""
    if sheet.precision is None or sheet.coordinates is None:
        return False
    by_digits = written_by(np.array(sheet.coordinates))
    return sheet.precision.stated or by_digits is None or not isclose(by_digits.length, sheet.precision.length)


def _indices(value: Any, key: str, check: Checker) -> tuple[tuple[int, ...], ...]:
    rows = check.list(value, key)
    if not _all_between(rows, 0, most("nodes"), {int}):
        for i, row in enumerate(rows):
            place = f"{key}[{i}]"
            for k, v in enumerate(check.list(row, place, what="a list of vertices")):
                check.how_many(v, f"{place}[{k}]")
    return tuple(map(tuple, rows))


def _all_between(rows: list[Any], least: float, greatest: float, kinds: set[type]) -> bool:
    """Return whether rows are lists of numbers of some kinds in a range: fast, for large files."""
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
    return tuple(None if x is None else radians(x) for x in listed)


def _in_degrees(angles: Iterable[float | None]) -> list[float | None]:
    """Return fold angles in degrees, each as `in_degrees` does."""
    given = list(angles)
    radian = np.array([nan if angle is None else angle for angle in given], dtype=float)
    near = np.degrees(radian)
    short = np.array([float(f"{angle:.15g}") for angle in near.tolist()])
    result = near.copy()
    for candidate in (np.nextafter(near, inf), np.nextafter(near, -inf), near, short):  # the last that fits counts
        result = np.where(np.radians(candidate) == radian, candidate, result)
    return [None if angle is None else degree for angle, degree in zip(given, result.tolist(), strict=True)]


def fold_text_of_frames(sheet: Sheet, frames: Sequence[Sheet]) -> str:
    """Return the text of a FOLD file with frames of a sheet as frames, the last of them in the key frame too.

    Where the last frame lies flat, the key frame is the sheet: of panels that lie on each other no pattern is read.
    """
    folded = bool(frames) and not lies_flat(frames[-1])
    document = _document(replace(frames[-1], title=sheet.title) if folded else sheet)
    document["file_classes"] = ["animation"]
    document["file_frames"] = [
        {
            "frame_classes": ["foldedForm"],
            "frame_attributes": ["3D"],
            "frame_title": f"pose {number}",
            "frame_parent": 0,
            "frame_inherit": True,
            "vertices_coords": [list(place) for place in frame.coordinates or ()],
            **({} if frame.fold_angles is None else {"edges_foldAngle": _in_degrees(frame.fold_angles)}),
        }
        for number, frame in enumerate(frames)
    ]
    return json_text(document)
