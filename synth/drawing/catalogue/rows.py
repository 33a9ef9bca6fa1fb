"""Rows of what an enumeration wrote: a store, JSON lines or Parquet, one by one."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from enumerate.runner.columns import row_as_dict
from enumerate.runner.store import read_meta, read_rows
from graphs.errors import FileError, UnsolvableError, shown

__all__ = ["ROWS", "Row", "rows_of_file"]

Row = Mapping[str, Any]
"""Column to value."""

_STORES = (".sqlite", ".db")
ROWS = (*_STORES, ".jsonl", ".parquet")
"""Extensions of files that hold rows."""
_AT_ONCE = 1024
"""Rows of a Parquet file that are in memory."""


def rows_of_file(place: Path) -> Iterator[Row]:
    """Yield the rows of a file, in order; what was read is let go.

    Parameters
    ----------
    place : Path
        Its extension is one of `ROWS`.

    Raises
    ------
    FileError
        If the file cannot be read.
    UnsolvableError
        If it is Parquet, and pyarrow is not installed.

    Examples
    --------
    >>> list(rows_of_file(Path("nowhere.jsonl")))
    Traceback (most recent call last):
    ...
    graphs.errors.FileError: nowhere.jsonl: cannot be read: No such file or directory; expected a readable file
    """
    suffix = place.suffix.lower()
    if suffix in _STORES:
        columns = read_meta(place)["columns"]
        return (row_as_dict(columns, row) for row in read_rows(place))
    return _rows_of_parquet(place) if suffix == ".parquet" else _rows_of_lines(place)


def _rows_of_lines(place: Path) -> Iterator[Row]:
    try:
        with place.open(encoding="utf-8") as lines:
            for number, line in enumerate(lines, start=1):
                row = json.loads(line)
                if not isinstance(row, dict):
                    raise FileError(place, f"line {number}", f"{shown(row)} is no object", "an object a line")
                yield row
    except OSError as error:
        raise FileError(place, "", f"cannot be read: {error.strerror}", "a readable file") from None
    except (ValueError, RecursionError) as error:
        raise FileError(place, "", f"is not JSON: {error}", "an object a line") from None


def _rows_of_parquet(place: Path) -> Iterator[Row]:
    try:
        from pyarrow import ArrowException
        from pyarrow.parquet import ParquetFile
    except ImportError:
        raise UnsolvableError("Parquet needs pyarrow: pip install 'synthedra[parquet]'") from None
    try:
        with place.open("rb") as stream, ParquetFile(stream) as file:
            for batch in file.iter_batches(_AT_ONCE):
                yield from batch.to_pylist()
    except ArrowException as error:
        raise FileError(place, "", f"is not Parquet: {error}", "rows that an enumeration wrote") from None
    except OSError as error:
        raise FileError(place, "", f"cannot be read: {error.strerror}", "a readable file") from None
