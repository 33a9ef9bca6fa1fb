"""Rows of what an enumeration wrote: a store, JSON lines or Parquet, one by one; what a conical one says."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from math import pi, radians
from pathlib import Path
from typing import Any

from enumerate.runner.job import row_as_dict
from enumerate.runner.store import read_meta, read_rows
from graphs.errors import FileError, UnsolvableError, shown
from graphs.mechanism.sc import SCGraph
from synth.drawing.mechanisms.orders import OrderOnCircle

__all__ = ["ROWS", "Row", "order_of_row", "rows_of_file"]

Row = Mapping[str, Any]
"""Column to value."""

_STORES = (".sqlite", ".db")
ROWS = (*_STORES, ".jsonl", ".parquet")
"""Extensions of files that hold rows."""
_AT_ONCE = 1024
"""Rows of a Parquet file that are in memory."""


def rows_of_file(place: Path) -> Iterator[Row]:
    """Yield the rows of a file with an extension of `ROWS`, in order; none is kept in memory.

    Raise FileError if the file cannot be read, UnsolvableError if it is Parquet and pyarrow is not installed.
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


def order_of_row(row: Row, chain: SCGraph) -> OrderOnCircle:
    """Return the order of joints of a row of conical candidates, at its azimuths, or evenly spaced.

    Names of joints are those of the file of the chain, which the id does not know: which of them a link has beside
    each other is read from the loops. The row has ``order``, ``loops``, and ``azimuths_deg`` or ``slots``:
    azimuths are in the order of the joints of the chain (that of the row's id), and ``order`` names joints as they
    follow each other; a point opposite to one has a prime. Raise KeyError, TypeError or ValueError for another
    row.

    >>> from graphs.files.ids import mechanism_of_id
    >>> row = {"order": ["0", "1'", "3", "2"], "slots": [0, 5, 3, 2], "loops": [["0", "1", "3", "2"]]}
    >>> order = order_of_row(row, mechanism_of_id("k1:Cr"))
    >>> order.names, [round(azimuth / pi, 3) for azimuth in order.azimuths], order.pairs
    (['0', '1', '2', '3'], [0.0, 1.25, 0.75, 0.5], [(0, 1), (0, 2), (1, 3), (2, 3)])
    """
    azimuths = _azimuths(row)
    primed = "azimuths_deg" not in row and _has_opposites(row)
    turn = pi if primed else 2 * pi
    names = [""] * len(azimuths)
    ranked = sorted(range(len(azimuths)), key=lambda joint: azimuths[joint] % turn)
    for joint, name in zip(ranked, row["order"], strict=True):
        names[joint] = str(name).removesuffix("'") if primed else str(name)
    place = {name: joint for joint, name in enumerate(names)}
    pairs = {
        (min(place[a], place[b]), max(place[a], place[b]))
        for loop in row["loops"]
        for a, b in zip(loop, [*loop[1:], loop[0]], strict=True)
    }
    return OrderOnCircle(chain, names, azimuths, sorted(pairs))


def _azimuths(row: Row) -> list[float]:
    if "azimuths_deg" in row:
        return [radians(angle) for angle in row["azimuths_deg"]]
    slots = row["slots"]
    return [slot * pi / len(slots) * (1 if _has_opposites(row) else 2) for slot in slots]


def _has_opposites(row: Row) -> bool:
    """Tell whether orders are those of joints and of points opposite to them: others tell the most layers too."""
    return "most_layers" not in row
