"""Rows of an atlas as files: tables, a folder of mechanisms, drawings on pages, panels with coordinates."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from enumerate.runner._run import run
from enumerate.runner.job import Column, ListColumn, Row, Unit
from enumerate.runner.sinks import sink_for
from enumerate.strings.panel_strings import chain_scd
from graphs.errors import FileError, InvariantError, UnsolvableError, shown
from graphs.files.native import dumps
from graphs.files.outputs import unknown_extension, write_as
from graphs.files.patterns.fold import sheet_from_fold
from graphs.mechanism.sheet import Sheet
from synth.exporters import EXPORTERS
from synth.making.drawing.list_pages import CatalogueEntry, catalogue_pages, drawable_of_type, write_catalogue
from synth.synthesis.atlas.atlas_file import AtlasRows
from synth.synthesis.atlas.columns import COLUMNS


def sheet_of_type(values: Mapping[str, Any]) -> Sheet | None:
    """Return the panels of a type, from its values in an atlas by column; None if none were found.

    Raise FileError if the stored file is damaged.
    """
    text, place = values.get("fold_file"), Path(f"fold_file of {values['id']}")
    if text is None:
        return None
    try:
        document = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise FileError(place, "", f"is not JSON: {error}", "a FOLD document; try to build the atlas again") from None
    return sheet_from_fold(document, place)


def write_rows(rows: AtlasRows, path: str | Path, *, force: bool = False) -> list[Path]:
    """Write rows in the format of the extension; without one, a folder with a file for each mechanism.

    Return the paths. The path ends in .csv, .json, .jsonl, .parquet, .tex, .svg, .png or .pdf; drawings and folders
    need columns ``kind`` and ``id``. `force` overwrites a file. Raise FileError for another extension, or if the file
    cannot be written.
    """
    place = Path(path)
    if not place.suffix:
        _check_mechanisms(rows)
        run(_Listed(rows), sink_for(place, force=force))
    elif place.suffix.lower() in EXPORTERS["pictures"]:
        return write_catalogue(catalogue_pages(_entries(rows)), place, force=force)
    elif place.suffix.lower() in EXPORTERS["tables"]:
        write_as(rows, place, EXPORTERS["tables"], force=force)
    else:
        raise unknown_extension(place, (*EXPORTERS["tables"], *EXPORTERS["pictures"]), ", or a folder")
    return [place]


@dataclass(frozen=True)
class _Listed:
    """Rows as a job for a sink."""

    rows: AtlasRows

    @property
    def columns(self) -> dict[str, Column]:
        """Names and types of the values; the type of a column of a statement is that of all its values."""
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
        """Return one unit of all rows."""
        return [Unit(None, len(self.rows))]

    def work(self, payload: None) -> list[Row]:
        """Return the rows."""
        columns = self.columns.items()
        return [tuple(_as_text(row[name]) if kind is str else row[name] for name, kind in columns) for row in self.rows]

    @staticmethod
    def mechanism_text(row: Mapping[str, Any]) -> str:
        """Return the native file of a row with ``kind`` and ``id``; UnsolvableError if it is an order."""
        if row["kind"] == "order":
            raise UnsolvableError(f"{shown(row['id'])} is an order without angles, so it has no file")
        drawable = drawable_of_type(row["kind"], row["id"])
        return dumps(chain_scd(drawable) if row["kind"] == "string" else drawable)


def _as_text(value: Any) -> str | None:
    """Return a value of a column of texts; a statement may select others beside them."""
    if value is None or isinstance(value, str):
        return value
    return value.hex() if isinstance(value, bytes) else str(value)


def _check_mechanisms(rows: AtlasRows) -> None:
    if not {"id", "kind"} <= set(rows.columns):
        raise InvariantError("query", "rows without id and kind", "both columns, for files and drawings")


def _entries(rows: AtlasRows) -> Iterator[CatalogueEntry]:
    _check_mechanisms(rows)
    for number, row in enumerate(rows, start=1):
        caption = [row.get("name") or "", f"M = {row['dof']}" if row.get("dof") is not None else ""]
        drawable = drawable_of_type(row["kind"], row["id"])
        yield CatalogueEntry(number, drawable, row["id"], ", ".join(filter(None, caption)))


def table_bytes(rows: AtlasRows, suffix: str) -> bytes:
    """Return rows as a sink of the runner writes them to a file with a suffix."""
    with TemporaryDirectory() as folder:
        place = Path(folder, f"rows{suffix}")
        run(_Listed(rows), sink_for(place))
        return place.read_bytes()


def json_bytes(rows: AtlasRows) -> bytes:
    """Return rows as a list of objects."""
    return f"{json.dumps(rows.to_json(), indent=1, allow_nan=False)}\n".encode()
