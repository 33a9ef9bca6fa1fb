"""What is in a catalogue: the mechanisms of a store, of rows, of a graph6 file or of a folder, one by one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from enumerate.chains.names import name_of
from enumerate.runner.job import Limits
from enumerate.strings.panel_strings import ChainString
from graphs.errors import FileError, InvariantError, SynthedraError, shown
from graphs.files.formats import read_all
from graphs.files.ids import is_id, mechanism_of_id
from graphs.mechanism.sc import SCGraph
from synth.drawing.catalogue.atlas_types import drawable_of_type
from synth.drawing.catalogue.rows import ROWS, Row, order_of_row, rows_of_file
from synth.drawing.mechanisms.orders import OrderOnCircle

__all__ = ["CatalogueEntry", "catalogue_entries", "entry_numbered", "is_catalogue"]

_LISTS = (*ROWS, ".g6")
_IDS = ("code", "mechanism", "chain")
"""Columns that may hold an id, the one that says most first."""


@dataclass(frozen=True, slots=True)
class CatalogueEntry:
    """One mechanism of a catalogue.

    Attributes
    ----------
    number : int
        Its place among all, from 1; those that a filter leaves out are counted.
    mechanism : SCGraph, or whatever else can be drawn
    name : str
        Its id, or where it is from.
    said : str
        Freedoms, centres, symmetry: what is known of them.
    mode : str or None
        Of an R/- string that is listed by its modes, which one.
    """

    number: int
    mechanism: Any
    name: str
    said: str
    mode: str | None = None


def is_catalogue(path: str | Path) -> bool:
    """Say whether a path names many mechanisms: a store, a list or a folder.

    >>> is_catalogue("chains.sqlite"), is_catalogue("watt.json")
    (True, False)
    """
    return not is_id(path) and (Path(path).suffix.lower() in _LISTS or Path(path).is_dir())


def catalogue_entries(
    path: str | Path, where: Mapping[str, Limits | str] | None = None, failures: list[str] | None = None
) -> Iterator[CatalogueEntry]:
    """Yield the mechanisms of rows (.sqlite, .jsonl, .parquet), of a graph6 file or of a folder, in order.

    Parameters
    ----------
    path : str or Path
    where : mapping of column to limits or text, optional
        Rows to show: numbers within limits, text that is equal. Only rows have columns.
    failures : list of str, optional
        What is wrong with files of a folder that cannot be read is added; without it, it is raised.

    Raises
    ------
    FileError
        If the file cannot be read, or a row has no mechanism.
    InvariantError
        If there is no such column.

    Examples
    --------
    >>> list(catalogue_entries("nowhere.jsonl"))
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: nowhere.jsonl: cannot be read: No such file or directory; expected a readable file
    """
    place = Path(path)
    if place.suffix.lower() in ROWS and not place.is_dir():
        for number, row in enumerate(rows_of_file(place), start=1):
            if all(_admits(row, column, asked) for column, asked in (where or {}).items()):
                yield _entry_of_row(place, number, row)
        return
    if where:
        raise InvariantError("filter", f"{shown(str(path))} has no columns", f"rows: {', '.join(ROWS)}")
    files = sorted(one for one in place.iterdir() if one.is_file()) if place.is_dir() else [place]
    number = 0
    for file in files:
        try:
            for entry in read_all(file):
                number += 1
                yield CatalogueEntry(number, entry.mechanism, Path(entry.label).name, repr(entry.mechanism)[1:-1])
        except SynthedraError as error:
            if failures is None or not place.is_dir():
                raise
            failures.append(str(error))


def entry_numbered(path: str | Path, number: int) -> CatalogueEntry:
    """Return one mechanism of a store, of rows, of a graph6 file or of a folder, by its place among all, from 1.

    Raise FileError if the file cannot be read, or holds fewer.
    """
    found = None
    for found in catalogue_entries(path):
        if found.number == number:
            return found
    there = "none" if found is None else str(found.number)
    raise FileError(path, "", f"there is no mechanism {number}", f"a number up to {there}")


def _admits(row: Row, column: str, asked: Limits | str) -> bool:
    if column not in row:
        raise InvariantError("filter", f"there is no column {shown(column)}", ", ".join(map(str, row)))
    value = row[column]
    if isinstance(asked, Limits):
        return isinstance(value, int) and value in asked
    text = ",".join(map(str, value)) if isinstance(value, list) else str(value)
    return text == asked


def _entry_of_row(place: Path, number: int, row: Row) -> CatalogueEntry:
    if isinstance(row.get("string"), str):
        mode = row["mode"] if isinstance(row.get("mode"), str) else None
        name = f"{row['string']} {mode}" if mode else row["string"]
        return CatalogueEntry(number, ChainString.parse(row["string"]), name, _said(row), mode)
    if "id" in row and "kind" in row:  # of an atlas
        name = row.get("name")
        told = ", ".join(filter(None, [name if isinstance(name, str) else "", _said(row)]))
        return CatalogueEntry(number, drawable_of_type(row["kind"], row["id"]), row["id"], told)
    for column in _IDS:
        code = row.get(column)
        if isinstance(code, str) and is_id(code):
            name = row.get("name") or name_of(str(row.get("chain", code)))
            told = f"{name}, {_said(row)}" if name else _said(row)
            chain = mechanism_of_id(code)
            thing = chain if "order" not in row else _on_circle(place, number, row, chain)
            return CatalogueEntry(number, thing, code, told)
    raise FileError(
        place, f"row {number}", "has no id", f"an id in one of the columns {', '.join(_IDS)}, or id and kind"
    )


def _on_circle(place: Path, number: int, row: Row, chain: SCGraph) -> OrderOnCircle:
    """Return the order of joints round a cone that a row of conical candidates tells."""
    try:
        return order_of_row(row, chain)
    except (KeyError, TypeError, ValueError) as error:
        told = f"has an order that is none: {type(error).__name__} {error}"
        raise FileError(place, f"row {number}", told, "columns order, loops, and slots or azimuths_deg") from None


def _said(row: Row) -> str:
    """Return freedoms, centres and symmetry of a row, those that it has."""
    words = []
    if isinstance(row.get("order"), list):  # of the joints round a cone
        words.append("order " + " ".join(map(str, row["order"])))
    freedoms = row.get("exact_dof", row.get("dof"))
    if freedoms is not None:
        words.append(f"M = {freedoms}")
    if "centres" in row:
        words.append(f"{row['centres']} centre{'s' * (row['centres'] != 1)}")
    if "symmetry" in row:
        words.append(f"symmetry {row['symmetry']}")
    if row.get("joints") and isinstance(row["joints"], str):
        words.append(row["joints"])
    return ", ".join(words)
