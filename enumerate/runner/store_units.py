"""How units lie in a store, and the digest that tells whether one is as it was written.

Tables: ``meta(key, value)`` says what was enumerated; ``unit(id, state, first, rows, seconds, digest)`` which are
there, the row each begins with and how many it has; ``type`` holds the rows, numbered as if the units had come one
after the other, each with its unit, lists as JSON text. A digest is made of the entry of a unit and of its rows,
column by column, as they will be read.
"""

from __future__ import annotations

import hashlib
import json
import marshal
import math
import sqlite3
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from typing import Any

from enumerate.runner.job import Row
from graphs.errors import StoreError, shown

__all__ = [
    "COMPLAINTS",
    "FORMAT",
    "VERSION",
    "StoredUnit",
    "UnitTable",
    "is_damage",
    "make_tables",
    "meta_in",
    "named",
    "quoted",
    "reading",
]

FORMAT = "synthedra/store"
VERSION = 3
_PATIENCE = 30.0
"""Seconds for which a lock of another process is waited for."""

_DAMAGE = {
    sqlite3.SQLITE_ERROR,  # a table or column is not there
    sqlite3.SQLITE_IOERR,
    sqlite3.SQLITE_CORRUPT,
    sqlite3.SQLITE_TOOBIG,
    sqlite3.SQLITE_FORMAT,
    sqlite3.SQLITE_NOTADB,
}
COMPLAINTS = (sqlite3.Error, UnicodeDecodeError)
"""What SQLite raises; where it quotes a damaged name, Python cannot read its message."""

_CHANGING = ("complete", "digest")
"""What a store says of itself that its digest does not cover."""


@dataclass(frozen=True, slots=True)
class StoredUnit:
    """The entry of a unit.

    Its rows follow each other from number `first`, counted from 1; `seconds` is how long they took.
    """

    number: int
    state: str
    first: int
    rows: int
    seconds: float
    digest: str


class UnitTable:
    """The units of an open store, by their numbers, with these columns in their rows."""

    def __init__(self, connection: sqlite3.Connection, columns: Sequence[str]) -> None:
        self._connection = connection
        names, marks = quoted(columns), ", ".join("?" * len(columns))
        self._append = f"INSERT INTO type (unit, {names}) VALUES ({{number}}, {marks})"
        self._insert = f"INSERT INTO type (rowid, unit, {names}) VALUES (?, ?, {marks})"
        self._select = f"SELECT {names} FROM type WHERE unit = ? AND rowid BETWEEN ? AND ? ORDER BY rowid"
        self._count = "SELECT count(*) FROM type WHERE rowid BETWEEN ? AND ?"

    def numbers(self) -> list[int]:
        """Return the numbers of all units."""
        return [number for (number,) in self._connection.execute("SELECT id FROM unit ORDER BY id")]

    def promised(self) -> float:
        """Return how many rows the units say that they have, together."""
        return float(self._connection.execute("SELECT total(rows) FROM unit").fetchone()[0])

    def entry(self, number: int) -> StoredUnit | None:
        """Return the entry of a unit, if there is one, whatever its values are."""
        found = self._connection.execute(
            "SELECT id, state, first, rows, seconds, digest FROM unit WHERE id = ?", (number,)
        ).fetchone()
        return None if found is None else StoredUnit(*found)

    def add(self, number: int, first: int, rows: Sequence[Row], seconds: float) -> None:
        """Write a unit with its rows; the transaction is the caller's."""
        [last] = self._connection.execute("SELECT max(rowid) FROM type").fetchone()
        if (last or 0) == first - 1:  # SQLite numbers them itself, in half the time
            self._connection.executemany(self._append.format(number=int(number)), rows)
        else:
            self._connection.executemany(
                self._insert, ((place, number, *row) for place, row in zip(count(first), rows, strict=False))
            )
        entry = (number, "done", first, len(rows), float(seconds))
        self._connection.execute("INSERT INTO unit VALUES (?, ?, ?, ?, ?, ?)", (*entry, _digest(entry, rows)))

    def rows(self, number: int) -> list[Row] | None:
        """Return the rows of a unit, as they are stored; None if it is not as it was written."""
        try:
            return self._rows_as_written(number)
        except sqlite3.OperationalError as error:
            if _has_code(error):
                raise
            return None  # text that is no UTF-8: SQLite gives it, Python cannot read it

    def _rows_as_written(self, number: int) -> list[Row] | None:
        unit = self.entry(number)
        if unit is None or not all(isinstance(value, int) and value >= 0 for value in (unit.first, unit.rows)):
            return None
        last = unit.first + unit.rows - 1
        rows = self._connection.execute(self._select, (number, unit.first, last)).fetchall()
        [(within,)] = self._connection.execute(self._count, (unit.first, last))
        entry = (number, unit.state, unit.first, unit.rows, unit.seconds)
        return rows if within == len(rows) == unit.rows and _digest(entry, rows) == unit.digest else None


def _digest(entry: Row, rows: Sequence[Row]) -> str:
    """Return the digest of a unit, of rows that are to be written or have been read."""
    columns = [_column_read_back(column) for column in zip(*rows, strict=True)]
    # Version 2 writes the values and nothing else: not whether two are one object, as later ones do.
    return hashlib.blake2b(marshal.dumps((entry, columns), 2), digest_size=16).hexdigest()


def _column_read_back(column: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return values as SQLite gives them back: truth values as numbers, what is not a number as NULL."""
    types = set(map(type, column))
    if types <= {int, str}:
        return column
    return tuple(map(int, column)) if types <= {int, bool} else tuple(map(_read_back, column))


def _read_back(value: Any) -> Any:
    if isinstance(value, float):  # numpy's too
        return None if math.isnan(value) else float(value)
    return int(value) if isinstance(value, int) else value


def make_tables(connection: sqlite3.Connection, meta: Mapping[str, Any]) -> None:
    """Make the tables of a store where they are not there; the transaction is the caller's.

    `meta` is what the store says of itself, without its digest.
    """
    texts = {key: json.dumps(value) for key, value in meta.items()}
    texts["digest"] = json.dumps(_meta_digest(texts))
    connection.execute("CREATE TABLE IF NOT EXISTS meta (key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID")
    connection.execute(
        "CREATE TABLE IF NOT EXISTS unit "
        "(id INTEGER PRIMARY KEY, state TEXT, first INTEGER, rows INTEGER, seconds REAL, digest TEXT)"
    )
    connection.execute(f"CREATE TABLE IF NOT EXISTS type (unit INTEGER, {quoted(meta['columns'])})")
    connection.executemany("INSERT OR IGNORE INTO meta VALUES (?, ?)", texts.items())


def _meta_digest(texts: Mapping[Any, Any]) -> str:
    """Return the digest of what a store says of itself, but for what changes while it grows."""
    fixed = sorted(repr(item) for item in texts.items() if item[0] not in _CHANGING)
    return hashlib.blake2b(repr(fixed).encode(), digest_size=16).hexdigest()


def meta_in(connection: sqlite3.Connection, path: Path) -> dict[str, Any]:
    """Return what a store says of itself.

    Raises `StoreError` if it is not a store that this version reads, or says so no more.
    """
    texts = dict(connection.execute("SELECT key, value FROM meta"))
    if texts.get("format") != json.dumps(FORMAT) or texts.get("version") != json.dumps(VERSION):
        raise StoreError(
            f"{path}: is not a store of version {VERSION}: format {shown(texts.get('format'))}, "
            f"version {shown(texts.get('version'))}"
        )
    if texts.get("digest") != json.dumps(_meta_digest(texts)) or texts.get("complete") not in ("true", "false"):
        raise StoreError(f"{path}: is damaged: what it says of itself was altered; begin again with another file")
    return {key: json.loads(text) for key, text in texts.items()}


@contextmanager
def reading(path: Path) -> Iterator[sqlite3.Connection]:
    """Open a store for reading, as it is at this moment, whatever other processes write meanwhile.

    Raises `StoreError` if there is no such file, or it cannot be read as a database.
    """
    if not path.is_file():
        raise StoreError(f"{path}: no such file")
    connection = None
    try:
        connection = sqlite3.connect(
            f"{path.resolve().as_uri()}?mode=ro", uri=True, isolation_level=None, timeout=_PATIENCE
        )
        connection.execute("PRAGMA writable_schema=ON")  # else a file that was cut off is not opened at all
        connection.execute("BEGIN")
        yield connection
    except COMPLAINTS as error:
        raise StoreError(f"{path}: cannot be read as a store: {_said(error)}") from None
    finally:
        if connection is not None:
            connection.close()


def _said(error: Exception) -> str:
    """Return what SQLite says, in one printable line: it may quote a damaged name."""
    if isinstance(error, UnicodeDecodeError):
        return "its schema is damaged"
    text = str(error)
    return text if text.isprintable() else ascii(text)[1:-1]


def is_damage(error: Exception) -> bool:
    """Return whether SQLite complains of what the file holds, not of locks, rights or room."""
    return (
        isinstance(error, UnicodeDecodeError)
        or getattr(error, "sqlite_errorcode", sqlite3.SQLITE_OK) & 0xFF in _DAMAGE
    )


def _has_code(error: Exception) -> bool:
    """Return whether SQLite itself complains, not Python of what it got."""
    return getattr(error, "sqlite_errorcode", None) is not None


@contextmanager
def named(path: Path) -> Iterator[None]:
    """Turn what SQLite says into one line that names the file."""
    try:
        yield
    except sqlite3.IntegrityError:
        raise StoreError(f"{path}: another run is writing to it") from None
    except COMPLAINTS as error:
        code = getattr(error, "sqlite_errorcode", sqlite3.SQLITE_OK) & 0xFF
        if code in (sqlite3.SQLITE_FULL, sqlite3.SQLITE_IOERR):
            hint = "; what was stored stays: make room and --resume"
        elif code == sqlite3.SQLITE_BUSY:
            hint = ": another process holds it; what was stored stays: --resume when that has ended"
        else:
            hint = ""
        raise StoreError(f"{path}: {_said(error)}{hint}") from None


def quoted(columns: Iterable[str]) -> str:
    """Return names of columns for a statement."""
    return ", ".join(f'"{column}"' for column in columns)
