"""Orientations of a body as native documents: what a linkage is to guide its coupler through.

The format is published as ``graphs/schema/orientations.schema.json``. Guide: docs/native-json.md.
What is read here is checked for its form; :func:`synth.guidance.orientations.read_orientations` makes orientations
of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from graphs.errors import FileError, shown
from graphs.files.check import Checker
from graphs.files.native.names import VERSION, head
from graphs.files.text import load_json

__all__ = ["KIND", "Rows", "holds_orientations", "orientation_rows", "orientations_document", "rows_from_document"]

KIND = "synthedra/orientations"

Rows = tuple[tuple[float, ...], ...]
"""Quaternions, four numbers each, or matrices, nine numbers each, row by row."""


def orientation_rows(path: str | Path) -> tuple[str, Rows]:
    """Return the key and the rows of a file of orientations.

    The key is ``"quaternions"`` (scalar first) or ``"matrices"`` (nine numbers, row by row). Raise FileError if
    the file cannot be read or has another form; that the rows are those of rotations is not checked here.
    """
    path = Path(path)
    return rows_from_document(load_json(path), path)


def holds_orientations(path: str | Path) -> bool:
    """Say whether a file is a JSON document of orientations by its format; what it lists is not read."""
    if Path(path).suffix.lower() != ".json":
        return False
    try:
        document = load_json(Path(path))
    except FileError:  # whoever reads it tells why
        return False
    return isinstance(document, dict) and document.get("format") == KIND


def rows_from_document(value: Any, path: Path) -> tuple[str, Rows]:
    """Return what a parsed document of orientations lists; see :func:`orientation_rows`."""
    check = Checker(path)
    check.mapping(value, "", ("format", "version"), ("quaternions", "matrices"))
    if value["format"] != KIND:
        raise FileError(path, "format", shown(value["format"]), KIND)
    if value["version"] != VERSION or isinstance(value["version"], bool):
        raise FileError(path, "version", shown(value["version"]), str(VERSION))
    if ("quaternions" in value) == ("matrices" in value):
        found = "both" if "quaternions" in value else "neither"
        raise FileError(path, "", f"{found} of 'quaternions' and 'matrices'", "one of them")
    if "quaternions" in value:
        listed = check.list(value["quaternions"], "quaternions", what="a list of quaternions")
        return "quaternions", tuple(_numbers(q, f"quaternions[{i}]", 4, check) for i, q in enumerate(listed))
    listed = check.list(value["matrices"], "matrices", what="a list of matrices")
    return "matrices", tuple(_matrix(m, f"matrices[{i}]", check) for i, m in enumerate(listed))


def orientations_document(quaternions: Sequence[Sequence[float]]) -> dict[str, Any]:
    """Return the native document of orientations, quaternions with the scalar first."""
    return head("orientations") | {"quaternions": [[float(x) for x in q] for q in quaternions]}


def _numbers(value: Any, place: str, size: int, check: Checker) -> tuple[float, ...]:
    words = {3: "three numbers", 4: "four numbers, the scalar first"}[size]
    return tuple(check.number(x, f"{place}[{k}]") for k, x in enumerate(check.list(value, place, size, words)))


def _matrix(value: Any, place: str, check: Checker) -> tuple[float, ...]:
    rows = check.list(value, place, 3, "three rows")
    return tuple(x for k, row in enumerate(rows) for x in _numbers(row, f"{place}[{k}]", 3, check))
