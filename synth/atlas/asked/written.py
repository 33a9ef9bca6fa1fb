"""Rows of an atlas written: tables, a folder of mechanisms, pictures on pages."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from enumerate.runner.job import Column, ListColumn, Row, Unit
from enumerate.runner.running import run
from enumerate.runner.sinks import sink_for
from graphs.errors import FileError, InvariantError
from graphs.files.atomic import write_text
from synth.atlas.asked.mechanisms import mechanism_file_of_type
from synth.atlas.asked.opened import AtlasRows
from synth.atlas.columns import COLUMNS
from synth.drawing.catalogue.atlas_types import drawable_of_type
from synth.drawing.catalogue.entries import CatalogueEntry
from synth.drawing.catalogue.pages import catalogue_pages
from synth.drawing.catalogue.writing import write_catalogue

__all__ = ["write_rows"]

_PICTURES = (".svg", ".png", ".pdf")
_THROUGH_SINKS = (".csv", ".jsonl", ".parquet", "")


def write_rows(rows: AtlasRows, path: str | Path, *, force: bool = False) -> list[Path]:
    """Write rows in the format of the extension; without one, a folder with a file for each mechanism.

    Return the paths. The path ends in .csv, .json, .jsonl, .parquet, .svg, .png or .pdf; pictures and folders need
    columns ``kind`` and ``id``. `force` overwrites a file. Raise FileError for another extension, or if the file
    cannot be written.
    """
    place = Path(path)
    suffix = place.suffix.lower()
    if suffix in _PICTURES:
        return write_catalogue(catalogue_pages(_entries(rows)), place, force=force)
    if suffix == ".json":
        write_text(place, json.dumps(rows.to_json(), indent=1, allow_nan=False) + "\n", force=force)
    elif suffix in _THROUGH_SINKS:
        if not suffix:
            _check_mechanisms(rows)
        run(_Listed(rows), sink_for(place, force=force))
    else:
        expected = ", ".join((".csv", ".json", ".jsonl", ".parquet", *_PICTURES))
        raise FileError(place, "", "the extension is not known", f"{expected}, or a folder")
    return [place]


@dataclass(frozen=True)
class _Listed:
    """Rows that are there already, as a job for a sink."""

    rows: AtlasRows

    @property
    def columns(self) -> dict[str, Column]:
        """Names and types of the values; those of a statement are what all its values are."""
        return {name: self._type(name) for name in self.rows.columns}

    def _type(self, name: str) -> Column:
        values = [row[name] for row in self.rows if row[name] is not None]
        if name in COLUMNS:
            holds = COLUMNS[name].holds
            read = tuple if isinstance(holds, ListColumn) else holds
            if all(isinstance(value, read) for value in values):
                return holds
        types = set(map(type, values)) or {str}
        return int if types == {int} else float if types <= {int, float} else str

    @property
    def key(self) -> dict[str, Any]:
        """Rows have no key: no store is made of them."""
        return {}

    def units(self) -> list[Unit]:
        """One."""
        return [Unit(None, len(self.rows))]

    def work(self, payload: None) -> list[Row]:
        """Return the rows."""
        columns = self.columns.items()
        return [
            tuple(_as_text(row[name]) if kind is str else row[name] for name, kind in columns) for row in self.rows
        ]

    @staticmethod
    def mechanism_text(row: Mapping[str, Any]) -> str:
        """Return the file of a row."""
        return mechanism_file_of_type(row)


def _as_text(value: Any) -> str | None:
    """Return a value of a column of texts; a statement may select others beside them."""
    return (
        value
        if value is None or isinstance(value, str)
        else value.hex()
        if isinstance(value, bytes)
        else str(value)
    )


def _check_mechanisms(rows: AtlasRows) -> None:
    if not {"id", "kind"} <= set(rows.columns):
        raise InvariantError("query", "rows without id and kind", "both among the columns, for files and pictures")


def _entries(rows: AtlasRows) -> Iterator[CatalogueEntry]:
    _check_mechanisms(rows)
    for number, row in enumerate(rows, start=1):
        said = [row.get("name") or "", f"M = {row['dof']}" if row.get("dof") is not None else ""]
        drawable = drawable_of_type(row["kind"], row["id"])
        yield CatalogueEntry(number, drawable, row["id"], ", ".join(filter(None, said)))
