"""Wavefront OBJ: vertices and faces of a folded or flat sheet.

Sides between two faces are creases. OBJ has no word for their kind; a comment ``#e a b M -90`` has the assignment
of the edge between two vertices (numbered from 1) and, if known, its fold angle in degrees.
"""

import re
from math import isfinite, radians
from pathlib import Path

import numpy as np

from graphs.convert.faces import with_simple_faces
from graphs.errors import FileError, UnsolvableError, shown
from graphs.files.text import Checker, in_degrees, read_text
from graphs.mechanism.precision import written_by
from graphs.mechanism.sheet import Sheet

_CREASE = re.compile(r"#e +(\d{1,9}) +(\d{1,9}) +([BMVFUCJ])(?: +([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?))?")


def sheet_from_obj(path: Path) -> Sheet:
    """Read the ``v`` and ``f`` lines and the crease comments of an OBJ file, and ignore others."""
    edges: dict[tuple[int, int], tuple[str, float | None]] = {}
    places: list[tuple[float, ...]] = []
    faces: list[tuple[int, ...]] = []
    lines: list[int] = []
    for number, line in enumerate(read_text(path).splitlines(), start=1):
        if crease := _CREASE.fullmatch(line.strip()):
            a, b, letter, angle = crease.groups()
            edges[int(a) - 1, int(b) - 1] = letter, None if angle is None else radians(float(angle))
            if angle is not None and not isfinite(float(angle)):
                raise FileError(path, f"line {number}", shown(line.strip()), "a fold angle in degrees")
        words = line.split("#", 1)[0].split()
        if not words or words[0] not in ("v", "f"):
            continue
        try:
            if words[0] == "v":
                places.append(_place(words[1:]))
            else:
                faces.append(tuple(_vertex(word, len(places)) for word in words[1:]))
                lines.append(number)
        except ValueError:
            expected = "three numbers" if words[0] == "v" else "numbers of vertices from 1 on"
            raise FileError(path, f"line {number}", shown(line.strip()), expected) from None
    if not faces:
        raise FileError(path, "", "no faces", "lines 'f a b c ...'")
    known = {(a, b): edge for (a, b), edge in edges.items() if a != b and 0 <= min(a, b) <= max(a, b) < len(places)}
    letters = "".join(letter for letter, _ in known.values())
    angles = tuple(angle for _, angle in known.values())
    return Checker(path).build(
        lambda: with_simple_faces(
            Sheet(
                len(places),
                tuple(known),
                letters,
                tuple(faces),
                tuple(places),
                fold_angles=angles if any(angle is not None for angle in angles) else None,
                precision=written_by(np.array(places)) if places else None,
            )
        ),
        lambda part: f"line {lines[int(str(part[1]))]}" if part[0] == "faces" else "",
    )


def obj_text(sheet: Sheet) -> str:
    """Return the OBJ text of a sheet, a flat one in z = 0; UnsolvableError if it has no coordinates."""
    if sheet.coordinates is None:
        raise UnsolvableError("an OBJ file needs coordinates, and the sheet has none")
    rows = ["v " + " ".join(repr(x) for x in (*place, 0.0)[:3]) for place in sheet.coordinates]
    angles = sheet.fold_angles or (None,) * len(sheet.edges)
    for (a, b), letter, angle in zip(sheet.edges, sheet.assignments, angles, strict=True):
        rows.append(f"#e {a + 1} {b + 1} {letter}" + ("" if angle is None else f" {in_degrees(angle)!r}"))
    rows += ["f " + " ".join(str(v + 1) for v in face) for face in sheet.faces]
    return "\n".join(rows) + "\n"


def _place(words: list[str]) -> tuple[float, ...]:
    place = tuple(float(word) for word in words[:3])
    if len(place) < 3 or not all(isfinite(x) for x in place):
        raise ValueError(words)
    return place


def _vertex(word: str, known: int) -> int:
    """Read ``7``, ``7/1``, ``7//3``, or a negative number that counts from the last vertex."""
    number = int(word.split("/", 1)[0])
    if number == 0:
        raise ValueError(word)
    return number - 1 if number > 0 else known + number
